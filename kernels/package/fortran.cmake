# Sources of the Fortran module and of the Fortran 77 layer; the compiled module goes to folders named
# after the compiler, for no other one can use it.
include(fortran_compiler.cmake)
set(FORTRAN_SOURCES ${shared_data}/fortran)
set(FORTRAN_MODULES ${CMAKE_INSTALL_INCLUDEDIR}/cleave)
set(FORTRAN_ARCHIVES ${CMAKE_INSTALL_LIBDIR}/cleave)
install(DIRECTORY ${PROJECT_BINARY_DIR}/fortran/ DESTINATION ${FORTRAN_SOURCES} COMPONENT development
  FILES_MATCHING PATTERN *.f90 PATTERN mod EXCLUDE)
if(TARGET cleave_fortran)
  cleave_fortran_compiler(compiler)
  install(TARGETS cleave_fortran
    ARCHIVE DESTINATION ${FORTRAN_ARCHIVES}/${compiler} COMPONENT development)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/fortran/mod/ DESTINATION ${FORTRAN_MODULES}/${compiler}
    COMPONENT development FILES_MATCHING PATTERN *.mod)
endif()

# Cleave::Fortran and Cleave::F77; included by CleaveConfig.cmake, which sets Cleave_fortran_*.
# What is compiled here becomes part of the host's build, and only if the host links it.
include(${CMAKE_CURRENT_LIST_DIR}/fortran_compiler.cmake)
cleave_fortran_compiler(Cleave_compiler)

function(cleave_compile_fortran target source)
  if(TARGET ${target})
    return()
  endif()
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${Cleave_fortran_sources}/${source})
  set(modules ${CMAKE_CURRENT_BINARY_DIR}/${target}_modules)
  set_target_properties(${target} PROPERTIES
    POSITION_INDEPENDENT_CODE ON Fortran_MODULE_DIRECTORY ${modules})
  target_include_directories(${target} INTERFACE ${modules})
  target_link_libraries(${target} PUBLIC ${ARGN})
endfunction()

if(NOT TARGET Cleave::Fortran)
  set(Cleave_archive
    ${Cleave_fortran_archives}/${Cleave_compiler}/${CMAKE_STATIC_LIBRARY_PREFIX}cleave_fortran${CMAKE_STATIC_LIBRARY_SUFFIX})
  if(EXISTS ${Cleave_archive} AND NOT Cleave_FORTRAN_FROM_SOURCE)
    add_library(Cleave::Fortran STATIC IMPORTED)
    set_target_properties(Cleave::Fortran PROPERTIES
      IMPORTED_LOCATION ${Cleave_archive}
      IMPORTED_LINK_INTERFACE_LANGUAGES Fortran
      INTERFACE_INCLUDE_DIRECTORIES ${Cleave_fortran_modules}/${Cleave_compiler}
      INTERFACE_LINK_LIBRARIES Cleave::cleave)
  else()
    cleave_compile_fortran(cleave_fortran cleave.f90 Cleave::cleave)
    add_library(Cleave::Fortran ALIAS cleave_fortran)
  endif()
  unset(Cleave_archive)
endif()

if(NOT TARGET Cleave::F77)
  cleave_compile_fortran(cleave_f77 cleave77.f90 Cleave::Fortran)
  add_library(Cleave::F77 ALIAS cleave_f77)
endif()
unset(Cleave_compiler)

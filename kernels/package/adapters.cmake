# Adapters are compiled by the host's build, with its compiler and its include files. The one for CalculiX
# asks for neither and is there compiled as well, in a folder of its own: libCLEAVE.so is not libcleave.so.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/kernels/adapters/ DESTINATION ${shared_data}/adapters
  COMPONENT development
  FILES_MATCHING PATTERN *.f PATTERN *.f90 PATTERN *.F PATTERN *.F90 PATTERN *.inc PATTERN *.c
                 PATTERN *.h PATTERN *.cpp PATTERN *.hpp PATTERN *.md)
if(TARGET cleave_calculix)
  get_target_property(folder cleave_calculix BINARY_DIR)
  install(FILES ${folder}/laws.def DESTINATION ${shared_data}/adapters/calculix COMPONENT development)
  install(TARGETS cleave_calculix
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/cleave/calculix COMPONENT development)
endif()

# Module files belong to one compiler and version: cleave_fortran_compiler(name) sets `name` to that of
# their folder for the Fortran compiler in use, for example gfortran-12. Used by the build and by
# find_package(Cleave) alike.
function(cleave_fortran_compiler result)
  set(command_GNU gfortran)
  set(command_Intel ifort)
  set(command_IntelLLVM ifx)
  set(command_NVHPC nvfortran)
  set(command_NAG nagfor)
  set(command_LLVMFlang flang)
  set(command ${command_${CMAKE_Fortran_COMPILER_ID}})
  if(NOT command)
    string(TOLOWER "${CMAKE_Fortran_COMPILER_ID}" command)
  endif()
  string(REGEX MATCH "^[0-9]+" major "${CMAKE_Fortran_COMPILER_VERSION}")
  set(${result} ${command}-${major} PARENT_SCOPE)
endfunction()

# CLEAVE_RUNTIME: libraries that the archive needs at the end of a link line whose linker is not that
# of C++: -l names, in order.
find_package(OpenMP COMPONENTS CXX)
set(CLEAVE_RUNTIME ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER CLEAVE_RUNTIME INCLUDE REGEX "^(std)?c\\+\\+$")
list(REMOVE_DUPLICATES CLEAVE_RUNTIME)
if(CLEAVE_OPENMP AND OpenMP_CXX_FOUND)
  list(APPEND CLEAVE_RUNTIME ${OpenMP_CXX_LIB_NAMES})
endif()
list(APPEND CLEAVE_RUNTIME m)

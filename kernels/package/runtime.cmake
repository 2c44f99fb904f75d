# CLEAVE_RUNTIME: libraries that the archive needs at the end of a link line whose linker is not that
# of C++: -l names, in order.
find_package(Threads REQUIRED)
set(CLEAVE_RUNTIME ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER CLEAVE_RUNTIME INCLUDE REGEX "^(std)?c\\+\\+$")
list(REMOVE_DUPLICATES CLEAVE_RUNTIME)
if(CMAKE_THREAD_LIBS_INIT)  # empty where the C library has them
  list(APPEND CLEAVE_RUNTIME pthread)
endif()
if(CLEAVE_CHOLMOD)
  list(APPEND CLEAVE_RUNTIME cholmod)
endif()
list(APPEND CLEAVE_RUNTIME m)

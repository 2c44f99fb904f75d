# `cpack` in the build folder makes Debian packages of the three components: libcleave<number of the
# interface>, libcleave-dev and cleave.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME cleave)
set(CPACK_PACKAGE_VENDOR "Cleave")
set(CPACK_PACKAGE_CONTACT "The Cleave authors <maintainers@cleave.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL library development program)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)

set(library_package libcleave${CLEAVE_ABI_VERSION})
set(same_version "${library_package} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcleave-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${same_version}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "gfortran, cmake, pkg-config")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME cleave)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "${same_version}")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "gmsh, paraview")

string(CONCAT CPACK_COMPONENT_LIBRARY_DESCRIPTION
  "Kernels for deformation gradient, stress update and internal force, and models that do whole steps,\n"
  "behind a C interface.")
string(CONCAT CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "C header, archive, Fortran module with sources, adapters for the user routines of other codes, and\n"
  "package files for CMake and pkg-config.")
string(CONCAT CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "The program: runs namelist decks, writes results, histories and checkpoints.")

# Dependencies on system libraries are read from the binaries.
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
find_program(FILE_COMMAND file)
mark_as_advanced(DPKG_SHLIBDEPS FILE_COMMAND)
if(DPKG_SHLIBDEPS AND FILE_COMMAND)
  get_target_property(folder cleave_shared BINARY_DIR)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${folder})
endif()
# And those of packages that use the library, from its number.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

# Every package carries the licence, under Debian's name for it.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/debian_copyright.cmake)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
include(CPack)

// Exodus II files as meshes. Internal to io.
#pragma once

#include <cstddef>
#include <string>

#include "io/mesh.hpp"

namespace cleave::io {

enum class NetcdfForm { classic, hdf5 };  // CDF-1, CDF-2, CDF-5; netCDF-4

// file_size bounds what a damaged file can make the reader allocate.
Mesh read_exodus_mesh(const std::string& path, NetcdfForm form, std::size_t file_size);

}  // namespace cleave::io

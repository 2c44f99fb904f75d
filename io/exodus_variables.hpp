// Dimensions and variables of an Exodus results file, each compared with what Cleave writes before anything
// is allocated or read: a foreign or damaged file must give a message. Internal to io; not for meshes
// of other programs, whose layouts vary (exodus_mesh_input.hpp).
#pragma once

#include <netcdf.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/netcdf_file.hpp"

namespace cleave::io {

// The length of a dimension; 0 if the file does not have it (Exodus leaves out what is empty).
std::int64_t length_of(const NetcdfFile& file, const std::string& name);

bool has_variable(const NetcdfFile& file, const std::string& name);

// The variable `name` if it does not change with time and has the type and lengths expected; throws
// otherwise.
int find_variable(const NetcdfFile& file, const std::string& path, const std::string& name,
                  nc_type type, std::span<const std::int64_t> lengths);
// The same for a variable of reals with one record a frame; lengths: of one record.
int find_frame_variable(const NetcdfFile& file, const std::string& path, const std::string& name,
                        std::span<const std::int64_t> lengths);

// Rows of a character array, each cut at its end mark; none if there is no such dimension.
std::vector<std::string> read_names(const NetcdfFile& file, const std::string& path,
                                    const std::string& count_name, const std::string& variable_name,
                                    const std::string& length_name = "len_name");

// The times of the first `complete` frames.
std::vector<double> read_times(const NetcdfFile& file, const std::string& path,
                               std::int64_t complete);

// "" if there is no such text attribute.
std::string text_or_empty(const NetcdfFile& file, int variable, const std::string& name);

}  // namespace cleave::io

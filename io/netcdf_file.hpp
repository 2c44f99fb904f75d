// An open netCDF file that closes itself, and whose errors say which file, which step and what to do.
//
// A thin layer: callers use the netCDF C functions with id() and pass every status to check().
#pragma once

#include <netcdf.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace cleave::io {

// "path: cannot <operation>: <reason>; <remedy>" for a status other than NC_NOERR.
[[noreturn]] void throw_netcdf_error(const std::string& path, std::string_view operation,
                                     int status);

class NetcdfFile {
 public:
  // A new, empty CDF-5 file in define mode; an old file of that name is lost. Values not written
  // stay undefined, so write them all.
  static NetcdfFile create(const std::string& path);
  static NetcdfFile open(const std::string& path);  // for reading; records: record_file.hpp

  NetcdfFile(NetcdfFile&& other) noexcept;
  NetcdfFile& operator=(NetcdfFile&&) = delete;
  ~NetcdfFile();  // closes; errors are lost, so writers call close()

  int id() const { return id_; }
  // Throws (see throw_netcdf_error) unless status is NC_NOERR.
  void check(int status, std::string_view operation) const;
  void close();

  int define_dimension(const std::string& name, std::int64_t length) const;
  void end_definitions() const;
  void put_text(int variable, const std::string& name, const std::string& text) const;
  // Throws if the attribute is missing or not text.
  std::string text(int variable, const std::string& name) const;
  int variable(const std::string& name) const;  // throws if there is none
  // The name of variable `variable`, for messages and comparisons.
  std::string variable_name(int variable) const;

 private:
  NetcdfFile(std::string path, int id) : path_(std::move(path)), id_(id) {}
  std::string path_;
  int id_;  // -1: closed
};

}  // namespace cleave::io

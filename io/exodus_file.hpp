// A new Exodus II file that closes itself, and whose errors say what failed.
//
// A thin layer: callers use the Exodus functions with id() and pass every status to check().
// Exodus ids are netCDF ids, so netCDF functions can add what Exodus has no call for. Not for appending
// frames: Exodus opens files "shared", which writes the number of frames before the frame (results.cpp).
#pragma once

#include <exodusII.h>

#include <string>
#include <string_view>

namespace cleave::io {

class ExodusFile {
 public:
  // Doubles, 64-bit offsets, 64-bit integers in calls. An old file of that name is lost.
  static ExodusFile create(const std::string& path);

  ExodusFile(ExodusFile&& other) noexcept;
  ExodusFile& operator=(ExodusFile&&) = delete;
  ~ExodusFile();  // closes; errors are lost, so writers call close()

  int id() const { return id_; }
  // Throws "path: cannot <operation>: <reason>; <remedy>" if an Exodus call returned an error.
  void check(int status, std::string_view operation) const;
  // The same for a netCDF call.
  void check_netcdf(int status, std::string_view operation) const;
  void close();

 private:
  ExodusFile(std::string path, int id) : path_(std::move(path)), id_(id) {}
  std::string path_;
  int id_;  // negative: closed
};

}  // namespace cleave::io

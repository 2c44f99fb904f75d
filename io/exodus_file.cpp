#include "io/exodus_file.hpp"

#include <netcdf.h>

#include <utility>

#include "io/error.hpp"
#include "io/netcdf_file.hpp"

namespace cleave::io {
namespace {

constexpr int kFirstExodusError = 1000;  // below: errno; negative: netCDF

[[noreturn]] void fail(const std::string& path, std::string_view operation, int error) {
  if (error < kFirstExodusError) throw_netcdf_error(path, operation, error);
  const char *message = nullptr, *function = nullptr;
  ex_get_err(&message, &function, &error);
  throw Error(path + ": cannot " + std::string(operation) + ": " +
              (message != nullptr && *message != '\0' ? message : "the Exodus library refuses it") +
              "; the file is damaged, or Cleave did not write it");
}

}  // namespace

ExodusFile ExodusFile::create(const std::string& path) {
  int computed = 8, stored = 8;  // bytes of a real number
  const int id =
      ex_create(path.c_str(), EX_CLOBBER | EX_LARGE_MODEL | EX_ALL_INT64_API, &computed, &stored);
  if (id < 0) fail(path, "create the file", exerrval);
  return {path, id};
}

ExodusFile::ExodusFile(ExodusFile&& other) noexcept
    : path_(std::move(other.path_)), id_(std::exchange(other.id_, -1)) {}

ExodusFile::~ExodusFile() {
  if (id_ >= 0) ex_close(id_);
}

void ExodusFile::check(int status, std::string_view operation) const {
  if (status < 0) fail(path_, operation, exerrval);
}

void ExodusFile::check_netcdf(int status, std::string_view operation) const {
  if (status != NC_NOERR) throw_netcdf_error(path_, operation, status);
}

// As NetcdfFile::close: the library keeps quiet about what goes wrong while it closes.
void ExodusFile::close() {
  const std::string_view operation = "write and close the file";
  check(ex_update(id_), operation);
  check(ex_close(std::exchange(id_, -1)), operation);
}

}  // namespace cleave::io

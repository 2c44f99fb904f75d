// libFuzzer target: any bytes as a checkpoint are read or refused with an io::Error. Once as they are, and once
// with the checksum of the header made right, so that the fuzzer gets behind it.
#include <stdlib.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

#include "io/archive.hpp"
#include "io/archive_format.hpp"
#include "io/checksum.hpp"
#include "io/error.hpp"
#include "io/netcdf_layout.hpp"

namespace {

using namespace cleave::io;

std::string new_path() {
  const char* folder = getenv("TMPDIR");
  std::string path = std::string(folder != nullptr ? folder : "/tmp") + "/fuzzed-XXXXXX";
  if (mkstemp(path.data()) < 0) abort();
  return path;
}

void read_both_ways(const std::string& path) {
  try {
    verify_archive(path);
    read_archive(path);
  } catch (const Error&) {
  }
}

void correct_checksum(const std::string& path) {
  const NetcdfLayout layout = read_netcdf_layout(path);
  if (layout.variables.empty()) return;
  const std::uint64_t checksum = archive_format::checksum_of_beginning(path, layout.header_bytes);
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(layout.variables.front().begin);
  for (int shift = 56; shift >= 0; shift -= 8) file.put(static_cast<char>(checksum >> shift));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path = new_path();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  read_both_ways(path);
  try {
    correct_checksum(path);
  } catch (const Error&) {
    return 0;
  }
  read_both_ways(path);
  return 0;
}

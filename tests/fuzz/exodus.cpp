// libFuzzer target: any bytes as an Exodus mesh in a classic netCDF file are read or refused with an
// io::Error. Files in netCDF-4 are read in a child process first and are not fuzzed.
#include <stdlib.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

#include "io/error.hpp"
#include "io/exodus_mesh.hpp"

namespace {

std::string new_path() {
  const char* folder = getenv("TMPDIR");
  std::string path = std::string(folder != nullptr ? folder : "/tmp") + "/fuzzed-XXXXXX";
  if (mkstemp(path.data()) < 0) abort();
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cleave::io;
  // The caller of the reader tells the forms apart by these three bytes.
  if (size < 4 || data[0] != 'C' || data[1] != 'D' || data[2] != 'F') return 0;
  static const std::string path = new_path();
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const Mesh mesh = read_exodus_mesh(path, NetcdfForm::classic, size);
    for (const CellBlock* block : {&mesh.lines, &mesh.triangles, &mesh.tetrahedra}) {
      for (const std::int64_t node : block->nodes) {
        if (node < 0 || node >= mesh.point_count()) abort();
      }
    }
  } catch (const Error&) {
  }
  return 0;
}

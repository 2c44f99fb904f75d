// libFuzzer target: any bytes as a Gmsh mesh are read or refused with an io::Error.
#include "io/gmsh.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "io/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cleave::io;
  try {
    const Mesh mesh =
        gmsh::read("fuzzed.msh", std::string_view(reinterpret_cast<const char*>(data), size));
    for (const CellBlock* block : {&mesh.lines, &mesh.triangles, &mesh.tetrahedra}) {
      for (const std::int64_t node : block->nodes) {
        if (node < 0 || node >= mesh.point_count()) abort();
      }
    }
  } catch (const Error&) {
  }
  return 0;
}

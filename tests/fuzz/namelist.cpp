// libFuzzer target: any text as a deck is read or refused with an io::Error.
#include "io/namelist.hpp"

#include <cstddef>
#include <cstdint>

#include "io/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cleave::io;
  try {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const namelist::File file = namelist::parse(text, "fuzzed.nml");
    for (const namelist::Group& group : file.groups) {
      namelist::located(file, group.place, "here");
      for (const namelist::Assignment& assignment : group.assignments) {
        assignment.full_name();
        for (const namelist::Value& value : assignment.values) {
          double real = 0;
          namelist::as_real(value, real);
          namelist::located(file, value.place, "here");
        }
      }
    }
  } catch (const Error&) {
  }
  return 0;
}

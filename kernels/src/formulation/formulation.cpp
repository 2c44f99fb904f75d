#include "formulation/formulation.hpp"

#include "core/error.hpp"
#include "formulation/cbm/cbm.hpp"
#include "tables/tables.hpp"

namespace cleave {

using cbm::ContinuumBondMethod;

std::unique_ptr<Formulation> make_formulation(std::int32_t value) {
  switch (value) {
#define CLEAVE_FORMULATION(name, number, type, title, source) \
  case number:                                                \
    return std::make_unique<type>();
#include "cleave/tables/formulations.def"
    default:
      break;
  }
  std::string known;
  for (const auto& f : formulation_table()) {
    known += text(known.empty() ? "" : ", ", f.name, " = ", f.value);
  }
  throw Error(CLEAVE_UNKNOWN_NAME,
              text("formulation ", value, " is unknown; known formulations: ", known));
}

}  // namespace cleave

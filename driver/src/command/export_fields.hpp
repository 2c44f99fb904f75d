// The fields of a result: the variables of the file, one for each component, joined again, and the
// choice that a user makes among them by name.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/results_read.hpp"

namespace cleave::driver {

// A field, or one component of it that was asked for alone.
struct ExportField {
  std::string name;  // as in a deck: "cauchy_stress"
  std::string units;
  std::vector<std::string> components;  // "x", "xy", "1"; empty for a scalar
  std::vector<std::size_t> variables;   // of each component, in the file

  // "cauchy_stress_xy"
  std::string column(std::size_t component) const;
};

// Joins consecutive variables v_x v_y v_z, t_xx t_yx ..., w_1 w_2 ...; DISPLX, DISPLY, DISPLZ, which readers
// of Exodus know, are the components of "displacement".
std::vector<ExportField> joined_fields(const std::vector<io::ResultVariable>& variables);

struct ExportFields {
  std::vector<ExportField> nodal, element;
};

// The fields called `names`, or all of them if there are no names. A name is that of a field, or of one
// component. Throws DeckError for one that is not in the file.
ExportFields chosen_fields(const io::StoredResults& results, const std::vector<std::string>& names);

}  // namespace cleave::driver

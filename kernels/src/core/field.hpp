// The line of a field in the fields table.
#pragma once

#include "cleave/cleave.h"

namespace cleave {

// How a particle's value travels between domains: not at all, owner to halo, halo added to owner.
enum class Exchange { none, gather, add };

struct FieldSpec {
  const char* name;
  cleave_relation relation;
  int components;  // 1 scalar, 3 vector, 9 tensor
  cleave_type type;
  const char* units;
  cleave_lifetime lifetime;
  Exchange exchange;
  bool output;  // written to results unless the user chooses
  const char* rebuild;
  const char* description;
};

}  // namespace cleave

// Parameter groups that a formulation does not use: given all the same, the deck means something
// else than it says, so they are refused rather than ignored.
#pragma once

#include "model/body.hpp"

namespace cleave {

// Throws UNSUPPORTED if any parameter of the group was given.
inline void refuse_group(const Body& body, const char* group, const char* remedy) {
  if (!body.group(group).any_given()) return;
  throw Error(CLEAVE_UNSUPPORTED, text(body.label(), ": formulation ", body.formulation->name(),
                                       " has no use for group ", group, "; ", remedy));
}

}  // namespace cleave

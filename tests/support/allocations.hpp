// Number of allocations by `new` in this process so far. Linking it replaces the global operator
// new.
#pragma once

namespace cleave::test {

long allocations();

}  // namespace cleave::test

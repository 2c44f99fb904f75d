// What the tests of wrong arguments share: calls that must be refused, and valid arguments to spoil
// one at a time.
#pragma once

#include <functional>

#include "support/bonds.hpp"
#include "support/model.hpp"

namespace cleave::test {

struct Call {
  const char* function;
  const char* part;  // of the message
  std::function<int32_t()> run;
};

inline void expect_refused(const std::vector<Call>& calls, int32_t status) {
  for (const Call& call : calls) {
    EXPECT_EQ(call.run(), status) << call.function << " (" << call.part << "): " << last_message();
    EXPECT_EQ(last_message().rfind(std::string(call.function) + ": ", 0), 0u) << last_message();
    EXPECT_NE(last_message().find(call.part), std::string::npos) << last_message();
  }
}

class Arguments : public testing::Test {
 protected:
  Arguments() {
    fresh.add({}, mesh);
    ready.add({}, mesh, {{"fracture", "critical_strain", 0.5}});
    const int64_t particle = 0;
    const int32_t direction = 0, motion = CLEAVE_MOTION_EXACT;
    ok(cleave_body_prescribe(ready, 0, 1, &particle, &direction, &motion));
    ready.setup();
  }
  const SimplexMesh mesh = patch(3, 2, 1.0, 0.1, 71);
  const int64_t n = mesh.particles(), m = mesh.simplex_count();
  Bonds b{mesh};
  // The network with one thing spoilt.
  template <class Member, class Value>
  cleave_network with(Member member, Value value_in) const {
    cleave_network spoilt = b.network();
    spoilt.*member = value_in;
    return spoilt;
  }
  cleave_network net = b.network();
  Model fresh, ready;
  const double properties[3] = {1190, 3.24e9, 0.35};
  std::vector<double> three = std::vector<double>(static_cast<std::size_t>(3 * n), 0.0),
                      nine = std::vector<double>(static_cast<std::size_t>(9 * n), 0.0),
                      one = std::vector<double>(static_cast<std::size_t>(n), 1.0), w = b.weights();
  int64_t count = 0;
  int32_t value = 0;
  double real = 0;
  double vec[3] = {};
  cleave_table_entry entry{sizeof(cleave_table_entry), 0, "", "", ""};
};

}  // namespace cleave::test

#include "run/compact_integers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace cleave::driver {
namespace {

using Values = std::vector<std::int64_t>;

CompactIntegers compact(const Values& values, std::int64_t components = 1) {
  CompactIntegers integers;
  integers.assign(std::ssize(values), components,
                  [&](std::int64_t first, std::span<std::int64_t> to) {
                    EXPECT_EQ(std::ssize(to) % components, 0);
                    std::copy_n(values.begin() + first, to.size(), to.begin());
                  });
  return integers;
}

Values all_of(const CompactIntegers& integers) {
  Values values(static_cast<std::size_t>(integers.size()));
  integers.copy(0, values);
  return values;
}

// Several blocks; the value that needs room comes in the last one.
Values marks(std::int64_t last) {
  Values values(400001);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i % 3) - 1;
  values.back() = last;
  return values;
}

TEST(CompactIntegers, TakeTheBytesThatTheLargestNeeds) {
  struct Case {
    std::int64_t value, bytes;
  };
  using Limits = std::numeric_limits<std::int64_t>;
  for (const Case& c :
       {Case{2, 1}, Case{127, 1}, Case{-128, 1}, Case{128, 4}, Case{-129, 4}, Case{2147483647, 4},
        Case{2147483648, 8}, Case{Limits::min(), 8}, Case{Limits::max(), 8}}) {
    const Values values = marks(c.value);
    const CompactIntegers integers = compact(values);
    EXPECT_EQ(all_of(integers), values) << c.value;
    EXPECT_GE(integers.bytes(), c.bytes * std::ssize(values)) << c.value;
    EXPECT_LT(integers.bytes(), (c.bytes + 1) * std::ssize(values)) << c.value;
  }
}

TEST(CompactIntegers, KeepRowsTogetherAndCanBeEmpty) {
  const Values values = marks(7);
  EXPECT_EQ(all_of(compact(Values(values.begin(), values.end() - 1), 4)),
            Values(values.begin(), values.end() - 1));
  EXPECT_EQ(compact({}).size(), 0);
}

TEST(CompactIntegers, CanBeAssignedAgainAndCopiedInParts) {
  CompactIntegers integers = compact(marks(Values::value_type{1} << 40));
  const Values other{3, -1, 500};
  integers.assign(3, 1, [&](std::int64_t first, std::span<std::int64_t> to) {
    std::copy_n(other.begin() + first, to.size(), to.begin());
  });
  EXPECT_EQ(all_of(integers), other);
  Values two(2);
  integers.copy(1, two);
  EXPECT_EQ(two, (Values{-1, 500}));
}

}  // namespace
}  // namespace cleave::driver

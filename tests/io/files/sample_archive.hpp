// One archive with everything that can be in it, for several tests.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/archive.hpp"

inline cleave::io::Archive sample_archive() {
  using Limits = std::numeric_limits<double>;
  using Integers = std::numeric_limits<std::int64_t>;
  cleave::io::Archive archive;
  archive.attributes = {{"deck", std::string("&run\n  end_time = 1d-4\n/\n")},
                        {"empty", std::string()},
                        {"step", std::int64_t{Integers::max()}},
                        {"time", 0.1},
                        {"not_reached", Limits::quiet_NaN()}};
  const std::vector<double> special{
      0.0,    -0.0,         Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(),
      1e-310, Limits::max()};
  archive.arrays = {
      {"plate/x", "m", "current position", 3, std::vector<double>{1, 2, 3, 4, 5, 6.5}},
      {"plate/bonds", "1", "numbers of the pair", 2,
       std::vector<std::int64_t>{1, 2, 2, 3, Integers::min(), -1}},
      {"special", "1", "values that are easily lost", 1, special},
      {"none", "N", "no force", 3, std::vector<double>{}},
      {"no_ids", "", "", 1, std::vector<std::int64_t>{}},
      {"one", "s", "one value", 1, std::vector<double>{42}}};
  return archive;
}

inline std::vector<std::uint64_t> bits_of(const cleave::io::ArrayData& data) {
  std::vector<std::uint64_t> bits;
  std::visit(
      [&](const auto& values) {
        for (const auto& value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
      },
      data);
  return bits;
}

// Integers in memory with as few bytes each as the largest needs: marks such as "deleted" or "broken"
// take one byte instead of eight.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <variant>
#include <vector>

namespace cleave::driver {

class CompactIntegers {
 public:
  // Puts values first, first + 1, ... into the span.
  using Read = std::function<void(std::int64_t first, std::span<std::int64_t> values)>;

  // Replaces everything by `count` values, read in blocks of whole rows of `components`; reuses the
  // memory.
  void assign(std::int64_t count, std::int64_t components, const Read& read);
  std::int64_t size() const;
  std::int64_t bytes() const;
  // Copies values first, first + 1, ... to the span.
  void copy(std::int64_t first, std::span<std::int64_t> values) const;

 private:
  template <class T>
  void widen();

  std::variant<std::vector<std::int8_t>, std::vector<std::int32_t>, std::vector<std::int64_t>>
      values_;
};

}  // namespace cleave::driver

#include "run/compact_integers.hpp"

#include <algorithm>
#include <limits>

namespace cleave::driver {
namespace {

template <class T>
bool fit(std::span<const std::int64_t> values) {
  return std::all_of(values.begin(), values.end(), [](std::int64_t value) {
    return value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max();
  });
}

}  // namespace

template <class T>
void CompactIntegers::widen() {
  std::vector<T> wider = std::visit(
      [](const auto& values) { return std::vector<T>(values.begin(), values.end()); }, values_);
  values_ = std::move(wider);
}

void CompactIntegers::assign(std::int64_t count, std::int64_t components, const Read& read) {
  constexpr std::int64_t kBlockValues = std::int64_t{1} << 17;
  const std::int64_t block = std::max<std::int64_t>(1, kBlockValues / components) * components;
  std::visit([&](auto& values) { values.resize(static_cast<std::size_t>(count)); }, values_);
  std::vector<std::int64_t> buffer(static_cast<std::size_t>(std::min(block, count)));
  for (std::int64_t first = 0; first < count; first += block) {
    const std::span part =
        std::span(buffer).first(static_cast<std::size_t>(std::min(block, count - first)));
    read(first, part);
    if (std::holds_alternative<std::vector<std::int8_t>>(values_) && !fit<std::int8_t>(part))
      widen<std::int32_t>();
    if (std::holds_alternative<std::vector<std::int32_t>>(values_) && !fit<std::int32_t>(part))
      widen<std::int64_t>();
    std::visit(
        [&](auto& values) {
          using Value = typename std::decay_t<decltype(values)>::value_type;
          std::transform(part.begin(), part.end(), values.begin() + first,
                         [](std::int64_t value) { return static_cast<Value>(value); });
        },
        values_);
  }
}

std::int64_t CompactIntegers::size() const {
  return std::visit([](const auto& values) { return std::ssize(values); }, values_);
}

std::int64_t CompactIntegers::bytes() const {
  return std::visit(
      [](const auto& values) {
        return static_cast<std::int64_t>(values.capacity() * sizeof(values[0]));
      },
      values_);
}

void CompactIntegers::copy(std::int64_t first, std::span<std::int64_t> to) const {
  std::visit(
      [&](const auto& values) { std::copy_n(values.begin() + first, to.size(), to.begin()); },
      values_);
}

}  // namespace cleave::driver

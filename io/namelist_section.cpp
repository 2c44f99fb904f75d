// Fortran array sections for namelist assignments; bounds are checked before anything is computed
// with a subscript, so that no written number can overflow.
#include "io/namelist_section.hpp"

#include <algorithm>
#include <string>

#include "io/error.hpp"

namespace cleave::io::namelist {

namespace {

std::string text(std::int64_t n) { return std::to_string(n); }

void check_inside(std::int64_t subscript, const Bounds& bounds) {
  const std::int64_t upper = bounds.lower + bounds.count - 1;
  if (subscript < bounds.lower || subscript > upper) {
    throw Error("subscript " + text(subscript) + " is outside " + text(bounds.lower) + ":" +
                text(upper));
  }
}

struct Range {
  std::int64_t first, count, stride;  // first is 0-based
};

Range range_of(const Subscript& s, const Bounds& bounds) {
  const std::int64_t lower = bounds.lower;
  const std::int64_t upper = lower + bounds.count - 1;
  const std::int64_t first = s.has_first ? s.first : (s.stride > 0 ? lower : upper);
  const std::int64_t last = s.has_last ? s.last : (s.stride > 0 ? upper : lower);
  check_inside(first, bounds);
  check_inside(last, bounds);
  if ((s.stride > 0 && last < first) || (s.stride < 0 && last > first)) {
    throw Error("the range " + text(first) + ":" + text(last) +
                (s.stride != 1 ? ":" + text(s.stride) : "") + " is empty");
  }
  // A stride beyond the extent reaches the first element only; clamping it keeps products small.
  const std::int64_t stride = std::clamp(s.stride, -bounds.count, bounds.count);
  return {first - lower, (last - first) / stride + 1, stride};
}

}  // namespace

Section::Section(std::span<const Subscript> subscripts, std::span<const Bounds> bounds) {
  std::int64_t total = 1;
  for (const Bounds& b : bounds) total *= b.count;
  if (subscripts.empty()) {
    axes_ = {{0, total, 1}};
    size_ = total;
    return;
  }
  if (subscripts.size() != bounds.size()) {
    throw Error(text(static_cast<std::int64_t>(subscripts.size())) +
                " subscripts are given where " + text(static_cast<std::int64_t>(bounds.size())) +
                " are needed");
  }
  const bool any_range = std::any_of(subscripts.begin(), subscripts.end(),
                                     [](const Subscript& s) { return s.is_range; });
  std::int64_t pitch = 1;  // elements between neighbours of this dimension
  for (std::size_t d = 0; d < bounds.size(); ++d) {
    Subscript s = subscripts[d];
    if (!any_range) s.has_last = false;  // from here on
    const Range range = range_of(s, bounds[d]);
    axes_.push_back({range.first * pitch, range.count, range.stride * pitch});
    size_ *= range.count;
    pitch *= bounds[d].count;
  }
}

std::int64_t Section::element(std::int64_t k) const {
  std::int64_t element = 0;
  for (const Axis& axis : axes_) {
    element += axis.start + (k % axis.count) * axis.step;
    k /= axis.count;
  }
  return element;
}

void assign(const Assignment& assignment, std::span<const Bounds> bounds,
            std::vector<Scalar>& elements) {
  const std::vector<Value>& values = assignment.values;
  std::size_t count = values.size();
  while (count > 0 && std::holds_alternative<Null>(values[count - 1].scalar)) --count;

  const Section section(assignment.name.back().subscripts, bounds);
  if (static_cast<std::int64_t>(count) > section.size()) {
    throw Error(text(static_cast<std::int64_t>(count)) +
                " values are given where there is room for " + text(section.size()));
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (std::holds_alternative<Null>(values[k].scalar)) continue;
    const auto element = static_cast<std::size_t>(section.element(static_cast<std::int64_t>(k)));
    if (element >= elements.size()) elements.resize(element + 1);
    elements[element] = values[k].scalar;
  }
}

}  // namespace cleave::io::namelist

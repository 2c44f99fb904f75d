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
  bool any_range = false;
  std::int64_t offset = 0;
  std::int64_t pitch = 1;  // elements between neighbours of this dimension
  for (std::size_t d = 0; d < bounds.size(); ++d) {
    if (subscripts[d].is_range) {
      const Range range = range_of(subscripts[d], bounds[d]);
      axes_.push_back({range.first * pitch, range.count, range.stride * pitch});
      size_ *= range.count;
      any_range = true;
    } else {
      check_inside(subscripts[d].first, bounds[d]);
      offset += (subscripts[d].first - bounds[d].lower) * pitch;
    }
    pitch *= bounds[d].count;
  }
  if (!any_range) {
    axes_ = {{0, total - offset, 1}};
    size_ = total - offset;
  }
  axes_.front().start += offset;
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

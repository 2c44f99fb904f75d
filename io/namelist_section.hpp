// Where the values of a namelist assignment go in an array: Fortran's sections, as gfortran reads
// them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/namelist.hpp"

namespace cleave::io::namelist {

// One dimension of an array as declared: lower bound and number of elements.
struct Bounds {
  std::int64_t lower = 1, count = 0;
};

// The elements that the successive values of `name(subscripts) = ...` fill, first index fastest.
// - no subscripts: the whole array
// - only single subscripts, `v(2) = 1, 2, 3`: from there on, as if v(2:) were written; in more
//   dimensions `m(2,1)` is m(2:,1:)
// - any range: the elements of the section, and no more
class Section {
 public:
  // Throws io::Error (without a place: the caller knows it) if the number of subscripts is not the
  // number of dimensions, a subscript is outside its bounds, or a range is empty.
  Section(std::span<const Subscript> subscripts, std::span<const Bounds> bounds);

  std::int64_t size() const { return size_; }
  // Element of value k, 0 <= k < size(), 0-based in the order of memory.
  std::int64_t element(std::int64_t k) const;

 private:
  struct Axis {
    std::int64_t start, count, step;  // in elements
  };
  std::vector<Axis> axes_;
  std::int64_t size_ = 1;
};

// Puts the values of `assignment` (subscripts of its last part) into `elements`; nulls leave what
// is there. `elements` grows with Null entries as needed, up to the product of the bounds. Throws
// io::Error without a place: as Section, and for more values than the section has elements (nulls
// at the end do not count).
void assign(const Assignment& assignment, std::span<const Bounds> bounds,
            std::vector<Scalar>& elements);

}  // namespace cleave::io::namelist

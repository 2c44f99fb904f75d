// Vectors that begin at a cache line: rows of four numbers then never straddle two.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace cleave {

template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};
  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, n * sizeof(T), kLine); }
  template <class U>
  bool operator==(const LineAllocator<U>&) const {
    return true;
  }
};

using AlignedReals = std::vector<double, LineAllocator<double>>;

}  // namespace cleave

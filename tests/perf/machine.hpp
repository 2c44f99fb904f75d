// What this machine can do, to hold the step against: bytes a second of the STREAM triad and floating-point
// operations a second of multiply-adds in registers. Own loops, no library.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace cleave::perf {

double seconds_now();  // of a steady clock

// a = b + s c over three arrays far beyond the caches. Counts the three arrays once, as STREAM does,
// although a processor reads `a` before it writes it.
class Triad {
 public:
  explicit Triad(std::size_t bytes_of_all_three, int threads);
  void pass();
  double bytes() const { return 3.0 * 8.0 * static_cast<double>(n_); }

 private:
  std::size_t edge(int part) const;  // first entry of a thread's part

  std::size_t n_;
  int threads_;
  std::unique_ptr<double[]> a_, b_, c_;
};

// Independent chains of multiply and add in registers; `fused`: as one instruction. Only the widths that
// this processor has.
struct MultiplyAdd {
  std::string name;  // "AVX2 separate", "AVX-512 fused", ...
  double (*run)(long rounds);
  double operations;  // floating-point operations of a round
};
std::vector<MultiplyAdd> multiply_adds();
// Operations a second of `threads` running at once, measured over about `seconds`.
double operations_per_second(const MultiplyAdd& kind, int threads, double seconds);

}  // namespace cleave::perf

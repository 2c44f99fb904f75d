// Kernels for several instruction sets in one library, chosen when the program runs.
//
// A source file that is listed as a kernel in kernels/CMakeLists.txt is compiled once for each set, with
// the flags of the set and with the namespace renamed: -Dcleave=cleave_avx2. All that it defines, inline
// functions and templates of every header included, is so a set's own, and the linker cannot take code
// with AVX instructions for a machine without. What enters and leaves is plain data in the namespace
// cleave_call, which is not renamed; its member functions are always inlined. Such a file
//
//   defines    namespace cleave { constinit const cleave_call::Table kTable = {&kernel, ...}; }
//   throws nothing, and uses nothing that is defined in another source file
//
// and its users write, outside of any namespace, CLEAVE_DECLARE_KERNELS(cleave_call::Table, kTable) and
// then call CLEAVE_KERNELS(kTable).chosen().kernel(...). All sets give the same bits.
#pragma once

#include <type_traits>

namespace cleave {

// In order of preference, the best last.
enum class InstructionSet { baseline, avx2, avx512 };
inline constexpr int kInstructionSets = 3;

const char* name_of(InstructionSet set);
// Whether this library has kernels for it and this machine runs them.
bool available(InstructionSet set);

// The set named by the environment variable CLEAVE_INSTRUCTION_SET, which is read once; without it the
// best one up to `ceiling`, for kernels that gain nothing from wider registers. Throws UNSUPPORTED for a
// name that is unknown or that this machine cannot run.
InstructionSet instruction_set(InstructionSet ceiling = InstructionSet::avx512);

// The same table of functions for each set; NULL where this library has none.
template <class Table>
struct Kernels {
  const Table* of[kInstructionSets];
  const Table& in(InstructionSet set) const { return *of[static_cast<int>(set)]; }
  const Table& chosen(InstructionSet ceiling = InstructionSet::avx512) const {
    return in(instruction_set(ceiling));
  }
};

}  // namespace cleave

#if defined(__x86_64__)
#define CLEAVE_DECLARE_KERNELS(Table, name) \
  namespace cleave_baseline {               \
  extern const Table name;                  \
  }                                         \
  namespace cleave_avx2 {                   \
  extern const Table name;                  \
  }                                         \
  namespace cleave_avx512 {                 \
  extern const Table name;                  \
  }
#define CLEAVE_KERNELS(name)                                                  \
  (::cleave::Kernels<std::remove_const_t<decltype(::cleave_baseline::name)>>{ \
      {&::cleave_baseline::name, &::cleave_avx2::name, &::cleave_avx512::name}})
#else
#define CLEAVE_DECLARE_KERNELS(Table, name) \
  namespace cleave_baseline {               \
  extern const Table name;                  \
  }
#define CLEAVE_KERNELS(name)                                                  \
  (::cleave::Kernels<std::remove_const_t<decltype(::cleave_baseline::name)>>{ \
      {&::cleave_baseline::name, nullptr, nullptr}})
#endif

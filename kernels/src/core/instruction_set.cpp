#include "core/instruction_set.hpp"

#include <cstdlib>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace cleave {

namespace {

constexpr InstructionSet kAll[] = {InstructionSet::baseline, InstructionSet::avx2,
                                   InstructionSet::avx512};

constexpr const char* kVariable = "CLEAVE_INSTRUCTION_SET";

// What the environment asks for, or why that cannot be had.
struct Wish {
  std::optional<InstructionSet> set;
  std::string mistake;
};

Wish read_wish() {
  const char* given = std::getenv(kVariable);
  if (given == nullptr || *given == '\0') return {};
  std::string here, known;
  for (const InstructionSet set : kAll) {
    if (available(set) && name_of(set) == std::string(given)) return {set, ""};
    known += text(known.empty() ? "" : ", ", name_of(set));
    if (available(set)) here += text(here.empty() ? "" : ", ", name_of(set));
  }
  return {std::nullopt, text("the environment variable ", kVariable, " is '", given,
                             "'; known: ", known, "; this library runs on this machine: ", here,
                             "; choose one of these, or unset the variable for the best one")};
}

}  // namespace

const char* name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
    case InstructionSet::baseline:
      break;
  }
  return "baseline";
}

bool available(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2") != 0;
  if (set == InstructionSet::avx512) {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0;
  }
#endif
  return set == InstructionSet::baseline;
}

InstructionSet instruction_set(InstructionSet ceiling) {
  static const Wish wish = read_wish();
  if (!wish.mistake.empty()) throw Error(CLEAVE_UNSUPPORTED, wish.mistake);
  if (wish.set) return *wish.set;
  static const InstructionSet best = [] {
    InstructionSet last = InstructionSet::baseline;
    for (const InstructionSet set : kAll)
      if (available(set)) last = set;
    return last;
  }();
  return best < ceiling ? best : ceiling;
}

}  // namespace cleave

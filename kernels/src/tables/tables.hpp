// The tables as data: what the interface lists and what allocation, checkpoints and manuals derive
// from.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "core/field.hpp"
#include "core/parameter.hpp"

namespace cleave {

struct TableEntry {
  std::int32_t value;
  const char* name;
  const char* title;
  const char* source;
};
std::span<const TableEntry> status_table();
std::span<const TableEntry> formulation_table();

std::span<const ParameterGroup> parameter_groups();
// Parameters of a material law or of a group; throws UNKNOWN_NAME.
std::span<const ParameterSpec> parameters_of(std::string_view owner);

// Fields by owner: "core", a formulation, a material law.
struct FieldOwner {
  const char* name;
  std::span<const FieldSpec> specs;
};
std::span<const FieldOwner> field_owners();
std::span<const FieldSpec> fields_of(std::string_view owner);
// FNV-1a over every column of every line.
std::uint64_t field_table_fingerprint();

}  // namespace cleave

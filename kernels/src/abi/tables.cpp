// Interface functions about messages and tables.
#include "tables/tables.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include "abi/guard.hpp"
#include "material/material.hpp"

namespace cleave::abi {

namespace {

constexpr std::size_t kMessageCapacity = 4096;
struct Message {
  char text[kMessageCapacity] = "";
  std::size_t length = 0;
};
thread_local Message last_message;

void append(Message& m, const char* part) noexcept {
  const std::size_t n = std::min(std::strlen(part), kMessageCapacity - 1 - m.length);
  std::memcpy(m.text + m.length, part, n);
  m.length += n;
  m.text[m.length] = '\0';
}

std::vector<TableEntry> entries_of(std::int32_t table) {
  std::vector<TableEntry> out;
  switch (table) {
    case CLEAVE_TABLE_STATUS:
      out.assign(status_table().begin(), status_table().end());
      return out;
    case CLEAVE_TABLE_FORMULATION:
      out.assign(formulation_table().begin(), formulation_table().end());
      return out;
    case CLEAVE_TABLE_MATERIAL:
      for (const auto& m : material_table()) out.push_back({m.value, m.name, m.title, m.source});
      return out;
    case CLEAVE_TABLE_GROUP:
      for (const auto& g : parameter_groups()) out.push_back({0, g.name, g.title, g.source});
      return out;
    default:
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text("table ", table, " does not exist; see enum cleave_table (1 to 4)"));
  }
}

}  // namespace

void set_last_message(const char* function, const char* message) noexcept {
  last_message.length = 0;
  append(last_message, function);
  if (*function != '\0') append(last_message, ": ");
  append(last_message, message);
}

}  // namespace cleave::abi

using namespace cleave;
using namespace cleave::abi;

extern "C" {

const char* cleave_version(void) { return CLEAVE_VERSION; }

int32_t cleave_abi_check(int32_t abi) {
  return guarded("cleave_abi_check", [&] { check_abi(abi); });
}

int32_t cleave_set_last_message(const char* text) {
  return guarded("cleave_set_last_message", [&] { set_last_message("", &required(text, "text")); });
}

int32_t cleave_last_message(char* text, int64_t capacity, int64_t* length) {
  if (length != nullptr) *length = static_cast<int64_t>(last_message.length);
  if (text == nullptr || capacity <= 0)
    return text == nullptr ? CLEAVE_NULL_ARGUMENT : CLEAVE_BAD_ARGUMENT;
  const std::size_t n = std::min(last_message.length, static_cast<std::size_t>(capacity - 1));
  std::memcpy(text, last_message.text, n);
  text[n] = '\0';
  return CLEAVE_OK;
}

const char* cleave_status_text(int32_t status) {
  for (const auto& s : status_table()) {
    if (s.value == status) return s.title;
  }
  return "unknown status";
}

int32_t cleave_table_count(int32_t table, int64_t* count) {
  return guarded("cleave_table_count", [&] {
    required(count, "count") = static_cast<int64_t>(entries_of(table).size());
  });
}

int32_t cleave_table_get(int32_t table, int64_t index, cleave_table_entry* entry) {
  return guarded("cleave_table_get", [&] {
    const auto entries = entries_of(table);
    check_range(index, index + 1, static_cast<int64_t>(entries.size()));
    const TableEntry& e = entries[static_cast<std::size_t>(index)];
    fill_sized(entry, {0, e.value, e.name, e.title, e.source}, "entry");
  });
}

int32_t cleave_table_find(int32_t table, const char* name, int32_t* value) {
  return guarded("cleave_table_find", [&] {
    required(name, "name");
    const auto entries = entries_of(table);
    for (const auto& e : entries) {
      if (std::strcmp(e.name, name) == 0) {
        required(value, "value") = e.value;
        return;
      }
    }
    std::string known;
    for (const auto& e : entries) known += text(known.empty() ? "" : ", ", e.name);
    throw Error(CLEAVE_UNKNOWN_NAME, text("'", name, "' is unknown; known names: ", known));
  });
}

int32_t cleave_parameter_count(const char* owner, int64_t* count) {
  return guarded("cleave_parameter_count", [&] {
    required(count, "count") =
        static_cast<int64_t>(parameters_of(&required(owner, "owner")).size());
  });
}

int32_t cleave_parameter_get(const char* owner, int64_t index, cleave_parameter* parameter) {
  return guarded("cleave_parameter_get", [&] {
    const auto specs = parameters_of(&required(owner, "owner"));
    check_range(index, index + 1, static_cast<int64_t>(specs.size()));
    const ParameterSpec& s = specs[static_cast<std::size_t>(index)];
    fill_sized(parameter,
               {0, s.name, s.units, s.description, s.choices, s.default_choice, s.source,
                s.range.minimum, s.range.maximum, s.default_value, s.type, s.range.minimum_excluded,
                s.range.maximum_excluded, s.required},
               "parameter");
  });
}

int32_t cleave_field_table_count(int64_t* count) {
  return guarded("cleave_field_table_count", [&] {
    int64_t n = 0;
    for (const auto& owner : field_owners()) n += static_cast<int64_t>(owner.specs.size());
    required(count, "count") = n;
  });
}

int32_t cleave_field_table_get(int64_t index, cleave_field* field) {
  return guarded("cleave_field_table_get", [&] {
    int64_t n = 0;
    for (const auto& owner : field_owners()) {
      for (const auto& f : owner.specs) {
        if (n++ != index) continue;
        fill_sized(field,
                   {0, f.name, f.units, f.description, owner.name, f.rebuild, 0, f.components,
                    f.type, f.relation, f.lifetime, f.output},
                   "field");
        return;
      }
    }
    check_range(index, index + 1, n);
  });
}

int32_t cleave_field_table_fingerprint(uint64_t* fingerprint) {
  return guarded("cleave_field_table_fingerprint",
                 [&] { required(fingerprint, "fingerprint") = field_table_fingerprint(); });
}

}  // extern "C"

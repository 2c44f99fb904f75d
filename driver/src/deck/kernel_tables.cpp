#include "deck/kernel_tables.hpp"

#include <array>
#include <stdexcept>

namespace cleave::driver {
namespace {

void require(std::int32_t status) {
  if (status == CLEAVE_OK) return;
  std::array<char, 1024> text{};
  cleave_last_message(text.data(), static_cast<std::int64_t>(text.size()), nullptr);
  throw std::logic_error(text.data());
}

}  // namespace

std::vector<cleave_table_entry> table_entries(cleave_table table) {
  std::int64_t count = 0;
  require(cleave_table_count(table, &count));
  std::vector<cleave_table_entry> entries;
  for (std::int64_t i = 0; i < count; ++i) {
    cleave_table_entry entry{};
    entry.size = sizeof(entry);
    require(cleave_table_get(table, i, &entry));
    entries.push_back(entry);
  }
  return entries;
}

std::vector<std::string> table_names(cleave_table table) {
  std::vector<std::string> names;
  for (const cleave_table_entry& entry : table_entries(table)) names.emplace_back(entry.name);
  return names;
}

std::vector<cleave_parameter> table_parameters(const std::string& owner) {
  std::int64_t count = 0;
  require(cleave_parameter_count(owner.c_str(), &count));
  std::vector<cleave_parameter> parameters;
  for (std::int64_t i = 0; i < count; ++i) {
    cleave_parameter parameter{};
    parameter.size = sizeof(parameter);
    require(cleave_parameter_get(owner.c_str(), i, &parameter));
    parameters.push_back(parameter);
  }
  return parameters;
}

std::vector<cleave_field> table_fields() {
  std::int64_t count = 0;
  require(cleave_field_table_count(&count));
  std::vector<cleave_field> fields;
  for (std::int64_t i = 0; i < count; ++i) {
    cleave_field field{};
    field.size = sizeof(field);
    require(cleave_field_table_get(i, &field));
    fields.push_back(field);
  }
  return fields;
}

}  // namespace cleave::driver

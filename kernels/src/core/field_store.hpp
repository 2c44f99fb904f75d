// The fields of a body: named arrays made from table lines.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/field.hpp"

namespace cleave {

struct Field {
  FieldSpec spec;
  const char* owner;
  std::int64_t count = 0;  // entries
  std::vector<double> real;
  std::vector<std::int32_t> integer;
};

class FieldStore {
 public:
  // Adds every field of `owner`; storage comes with allocate().
  void declare(const char* owner, std::span<const FieldSpec> specs);
  // Takes a field away that this body has no use for; before anything points to it.
  void drop(std::string_view name);
  // Fields of relation `from` become fields of relation `to`; before allocate.
  void merge(cleave_relation from, cleave_relation to);
  // Gives all fields of a relation their size, zero-filled. Derived fields get a count only.
  void allocate(cleave_relation relation, std::int64_t count);

  // Memory of one field only: given back; taken again, zero-filled, unless it is there.
  void release(std::string_view name);
  void restore(std::string_view name);

  // Pointers stay valid until the field is allocated or released again. Throw INTERNAL for a wrong name or
  // type.
  double* real(std::string_view name);
  std::int32_t* integer(std::string_view name);

  Field* find(std::string_view name);  // nullptr if absent
  std::span<Field> all() { return fields_; }
  std::int64_t bytes() const;

 private:
  Field& existing(std::string_view name, cleave_type type);
  std::vector<Field> fields_;
};

}  // namespace cleave

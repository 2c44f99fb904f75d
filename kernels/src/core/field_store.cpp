#include "core/field_store.hpp"

#include "core/error.hpp"

namespace cleave {

void FieldStore::declare(const char* owner, std::span<const FieldSpec> specs) {
  for (const auto& s : specs) fields_.push_back({s, owner, 0, {}, {}});
}

void FieldStore::drop(std::string_view name) {
  std::erase_if(fields_, [&](const Field& f) { return name == f.spec.name; });
}

void FieldStore::merge(cleave_relation from, cleave_relation to) {
  for (auto& f : fields_) {
    if (f.spec.relation == from) f.spec.relation = to;
  }
}

void FieldStore::allocate(cleave_relation relation, std::int64_t count) {
  for (auto& f : fields_) {
    if (f.spec.relation != relation) continue;
    f.count = count;
    if (f.spec.lifetime == CLEAVE_LIFETIME_DERIVED) continue;
    const auto size = static_cast<std::size_t>(count * f.spec.components);
    if (f.spec.type == CLEAVE_REAL) {
      f.real.assign(size, 0.0);
    } else {
      f.integer.assign(size, 0);
    }
  }
}

void FieldStore::release(std::string_view name) {
  if (Field* f = find(name)) std::vector<double>().swap(f->real);
}

void FieldStore::restore(std::string_view name) {
  Field* f = find(name);
  if (f != nullptr) f->real.resize(static_cast<std::size_t>(f->count * f->spec.components), 0.0);
}

Field* FieldStore::find(std::string_view name) {
  for (auto& f : fields_) {
    if (name == f.spec.name) return &f;
  }
  return nullptr;
}

Field& FieldStore::existing(std::string_view name, cleave_type type) {
  Field* f = find(name);
  if (f == nullptr || f->spec.type != type) {
    throw Error(CLEAVE_INTERNAL,
                text("the fields table has no stored field '", name, "' of this type"));
  }
  return *f;
}

double* FieldStore::real(std::string_view name) { return existing(name, CLEAVE_REAL).real.data(); }
std::int32_t* FieldStore::integer(std::string_view name) {
  return existing(name, CLEAVE_INTEGER).integer.data();
}

std::int64_t FieldStore::bytes() const {
  std::size_t sum = 0;
  for (const auto& f : fields_) {
    sum += f.real.capacity() * sizeof(double) + f.integer.capacity() * sizeof(std::int32_t);
  }
  return static_cast<std::int64_t>(sum);
}

}  // namespace cleave

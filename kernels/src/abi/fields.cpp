// Fields of a body by name.
#include <algorithm>
#include <cmath>

#include "abi/guard.hpp"
#include "model/interpolation.hpp"
#include "model/model.hpp"
#include "model/resident.hpp"

using namespace cleave;
using namespace cleave::abi;

namespace {

cleave_field describe(const Field& f) {
  return {0,           f.spec.name,     f.spec.units,    f.spec.description,
          f.owner,     f.spec.rebuild,  f.count,         f.spec.components,
          f.spec.type, f.spec.relation, f.spec.lifetime, f.spec.output};
}

Body& body_with_fields(cleave_model* model, std::int64_t body) {
  required(model, "model").require_set_up();
  return model->body(body);
}

Field& find_field(Body& body, const char* name, std::int32_t type) {
  Field* f = body.fields.find(&required(name, "name"));
  if (f == nullptr) {
    std::string known;
    for (const auto& other : body.fields.all())
      known += text(known.empty() ? "" : ", ", other.spec.name);
    throw Error(CLEAVE_UNKNOWN_NAME,
                text(body.label(), " has no field '", name, "'; its fields: ", known));
  }
  if (type != 0 && f->spec.type != type) {
    throw Error(CLEAVE_WRONG_TYPE, text("field '", name, "' holds ",
                                        f->spec.type == CLEAVE_REAL ? "reals" : "integers",
                                        "; use the function for that type"));
  }
  return *f;
}

Field& stored_field(Body& body, const char* name, std::int32_t type) {
  Field& f = find_field(body, name, type);
  if (f.spec.lifetime == CLEAVE_LIFETIME_DERIVED) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("field '", name, "' is computed from others and cannot be set"));
  }
  return f;
}

// Before and after the host writes into a field.
void open_for_put(Body& body, const char* name) {
  if (std::string_view(name) != "external_force") fetch(body);
}
void close_after_put(Body& body, const char* name) {
  if (ResidentStep* resident = body.formulation->resident()) resident->changed(name);
}

// What a two-dimensional body has no use for is zero.
void clear_third_component(const Body& body, Field& f, std::int64_t first, std::int64_t last) {
  if (body.dimension() == 3 || f.spec.components != kVector ||
      f.spec.relation != CLEAVE_RELATION_POINT)
    return;
  for (std::int64_t i = first; i < last; ++i) f.real[static_cast<std::size_t>(kVector * i + 2)] = 0;
}

}  // namespace

extern "C" {

int32_t cleave_field_count(cleave_model* model, int64_t body, int64_t* count) {
  return guarded("cleave_field_count", [&] {
    required(count, "count") =
        static_cast<int64_t>(body_with_fields(model, body).fields.all().size());
  });
}

int32_t cleave_field_get(cleave_model* model, int64_t body, int64_t index, cleave_field* field) {
  return guarded("cleave_field_get", [&] {
    const auto all = body_with_fields(model, body).fields.all();
    check_range(index, index + 1, static_cast<int64_t>(all.size()));
    fill_sized(field, describe(all[static_cast<std::size_t>(index)]), "field");
  });
}

int32_t cleave_field_find(cleave_model* model, int64_t body, const char* name,
                          cleave_field* field) {
  return guarded("cleave_field_find", [&] {
    fill_sized(field, describe(find_field(body_with_fields(model, body), name, 0)), "field");
  });
}

int32_t cleave_field_get_real(cleave_model* model, int64_t body, const char* name, int64_t first,
                              int64_t last, double* values) {
  return guarded("cleave_field_get_real", [&] {
    Body& b = body_with_fields(model, body);
    const Field& f = find_field(b, name, CLEAVE_REAL);
    check_range(first, last, f.count);
    if (first == last) return;
    required(values, "values");
    fetch(b, name);
    if (f.spec.lifetime == CLEAVE_LIFETIME_DERIVED) {
      if (!derive_core(b, name, first, last, values) &&
          !b.formulation->derive(b, name, first, last, values)) {
        throw Error(CLEAVE_INTERNAL, text("nothing computes the derived field '", name, "'"));
      }
      return;
    }
    std::copy(f.real.begin() + f.spec.components * first, f.real.begin() + f.spec.components * last,
              values);
  });
}

int32_t cleave_field_put_real(cleave_model* model, int64_t body, const char* name, int64_t first,
                              int64_t last, const double* values) {
  return guarded("cleave_field_put_real", [&] {
    Body& b = body_with_fields(model, body);
    Field& f = stored_field(b, name, CLEAVE_REAL);
    check_range(first, last, f.count);
    if (first == last) return;
    required(values, "values");
    open_for_put(b, name);
    std::copy(values, values + f.spec.components * (last - first),
              f.real.begin() + f.spec.components * first);
    clear_third_component(b, f, first, last);
    close_after_put(b, name);
  });
}

int32_t cleave_field_get_integer(cleave_model* model, int64_t body, const char* name, int64_t first,
                                 int64_t last, int64_t* values) {
  return guarded("cleave_field_get_integer", [&] {
    Body& b = body_with_fields(model, body);
    const Field& f = find_field(b, name, CLEAVE_INTEGER);
    check_range(first, last, f.count);
    if (first == last) return;
    fetch(b, name);
    if (f.spec.lifetime == CLEAVE_LIFETIME_DERIVED) {
      if (!b.formulation->derive_integers(b, name, first, last, &required(values, "values"))) {
        throw Error(CLEAVE_INTERNAL, text("nothing computes the derived field '", name, "'"));
      }
      return;
    }
    std::copy(f.integer.begin() + f.spec.components * first,
              f.integer.begin() + f.spec.components * last, &required(values, "values"));
  });
}

int32_t cleave_field_put_integer(cleave_model* model, int64_t body, const char* name, int64_t first,
                                 int64_t last, const int64_t* values) {
  return guarded("cleave_field_put_integer", [&] {
    Body& b = body_with_fields(model, body);
    Field& f = stored_field(b, name, CLEAVE_INTEGER);
    check_range(first, last, f.count);
    if (first == last) return;
    required(values, "values");
    open_for_put(b, name);
    for (int64_t k = 0; k < f.spec.components * (last - first); ++k) {
      f.integer[static_cast<std::size_t>(f.spec.components * first + k)] =
          static_cast<std::int32_t>(values[k]);
    }
    close_after_put(b, name);
  });
}

int32_t cleave_body_locate(cleave_model* model, int64_t body, int64_t count, const double* X,
                           int64_t* simplex, double* weight) {
  return guarded("cleave_body_locate", [&] {
    Body& b = body_with_fields(model, body);
    if (count < 0) throw Error(CLEAVE_BAD_ARGUMENT, text("count is ", count, "; allowed: >= 0"));
    if (count == 0) return;
    required(X, "X");
    required(simplex, "simplex");
    required(weight, "weight");
    for (int64_t c = 0; c < kVector * count; ++c) {
      if (c % kVector < b.dimension() && !std::isfinite(X[c]))
        throw Error(CLEAVE_NOT_FINITE, text("point ", c / kVector, " is not finite"));
    }
    const auto found = locate(b, {X, static_cast<std::size_t>(kVector * count)});
    for (std::size_t p = 0; p < found.size(); ++p) {
      simplex[p] = found[p].simplex;
      std::copy(found[p].weight.begin(), found[p].weight.end(), weight + 4 * p);
    }
  });
}

int32_t cleave_field_interpolate(cleave_model* model, int64_t body, const char* name, int64_t count,
                                 const int64_t* simplex, const double* weight, double* values) {
  return guarded("cleave_field_interpolate", [&] {
    Body& b = body_with_fields(model, body);
    const Field& f = find_field(b, name, CLEAVE_REAL);
    if (f.spec.relation != CLEAVE_RELATION_POINT && f.spec.relation != CLEAVE_RELATION_SIMPLEX &&
        f.spec.relation != CLEAVE_RELATION_INTEGRATION_POINT) {
      throw Error(CLEAVE_BAD_ARGUMENT,
                  text("field '", name,
                       "' has no value at a point; ask for a field of particles, "
                       "simplices or integration points"));
    }
    if (count < 0) throw Error(CLEAVE_BAD_ARGUMENT, text("count is ", count, "; allowed: >= 0"));
    if (count == 0) return;
    required(simplex, "simplex");
    required(weight, "weight");
    required(values, "values");
    fetch(b, name);
    const Field* simplices = b.fields.find("simplex_particles");
    for (int64_t p = 0; p < count; ++p) {
      Location at{simplex[p], {}};
      if (at.simplex < -1 || at.simplex >= (simplices == nullptr ? 0 : simplices->count)) {
        throw Error(CLEAVE_BAD_RANGE, text("simplex ", at.simplex, " of point ", p,
                                           " does not exist; use what cleave_body_locate gave"));
      }
      std::copy_n(weight + 4 * p, 4, at.weight.begin());
      interpolate(b, f, at, values + f.spec.components * p);
    }
  });
}

}  // extern "C"

#include "scene/model.hpp"

namespace cleave::driver {

void check(std::int32_t status) {
  if (status == CLEAVE_OK) return;
  std::int64_t length = 0;
  cleave_last_message(nullptr, 0, &length);
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  cleave_last_message(text.data(), length + 1, &length);
  text.resize(static_cast<std::size_t>(length));
  if (text.empty()) text = cleave_status_text(status);
  throw KernelError(text, status);
}

Model::Model(int threads, std::int32_t order) {
  cleave_model* model = nullptr;
  check(cleave_model_create(CLEAVE_ABI_VERSION, &model));
  handle_.reset(model);
  check(cleave_model_set_threads(model, threads));
  check(cleave_model_set_order(model, order));
}

std::int64_t Model::add_body(const cleave_body_spec& spec) {
  std::int64_t body = 0;
  check(cleave_body_add(handle(), &spec, &body));
  ++bodies_;
  return body;
}

void Model::setup() { check(cleave_model_setup(handle())); }

double Model::time() const {
  std::int64_t step = 0;
  double time = 0;
  check(cleave_model_clock(handle(), &step, &time));
  return time;
}

double Model::stable_step() const {
  double step = 0;
  check(cleave_model_stable_step(handle(), &step));
  return step;
}

bool Model::is_stable(double dt) const {
  std::int32_t stable = 0;
  check(cleave_model_is_stable(handle(), dt, &stable));
  return stable != 0;
}

double Model::wave_speed(std::int64_t body) const {
  double speed = 0;
  check(cleave_body_wave_speed(handle(), body, &speed));
  return speed;
}

double Model::property(std::int64_t body, const char* name) const {
  double value = 0;
  check(cleave_body_get_real(handle(), body, "material", name, &value));
  return value;
}

std::int64_t Model::memory() const {
  std::int64_t bytes = 0;
  check(cleave_model_memory(handle(), &bytes));
  return bytes;
}

cleave_energies Model::energies(std::int64_t body) const {
  cleave_energies energies{};
  energies.size = sizeof energies;
  check(cleave_energies_get(handle(), body, &energies));
  return energies;
}

cleave_counts Model::counts(std::int64_t body) const {
  cleave_counts counts{};
  counts.size = sizeof counts;
  check(cleave_counts_get(handle(), body, &counts));
  return counts;
}

cleave_counts Model::total_counts() const {
  cleave_counts total{};
  for (std::int64_t body = 0; body < bodies_; ++body) {
    const cleave_counts one = counts(body);
    total.particles += one.particles;
    total.bonds += one.bonds;
    total.simplices += one.simplices;
    total.broken += one.broken;
    total.inert += one.inert;
    total.isolated += one.isolated;
    total.inverted += one.inverted;
  }
  return total;
}

std::vector<cleave_field> Model::fields(std::int64_t body) const {
  std::int64_t count = 0;
  check(cleave_field_count(handle(), body, &count));
  std::vector<cleave_field> fields(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    auto& field = fields[static_cast<std::size_t>(i)];
    field.size = sizeof field;
    check(cleave_field_get(handle(), body, i, &field));
  }
  return fields;
}

std::optional<cleave_field> Model::find_field(std::int64_t body, const std::string& name) const {
  cleave_field field{};
  field.size = sizeof field;
  const std::int32_t status = cleave_field_find(handle(), body, name.c_str(), &field);
  if (status == CLEAVE_UNKNOWN_NAME) return std::nullopt;
  check(status);
  return field;
}

cleave_field Model::field(std::int64_t body, const char* name) const {
  cleave_field field{};
  field.size = sizeof field;
  check(cleave_field_find(handle(), body, name, &field));
  return field;
}

void Model::get(std::int64_t body, const char* name, std::span<double> values) const {
  check(cleave_field_get_real(handle(), body, name, 0, field(body, name).count, values.data()));
}

void Model::get(std::int64_t body, const char* name, std::span<std::int64_t> values) const {
  check(cleave_field_get_integer(handle(), body, name, 0, field(body, name).count, values.data()));
}

void Model::get(std::int64_t body, const char* name, std::int64_t first, std::int64_t last,
                std::span<double> values) const {
  check(cleave_field_get_real(handle(), body, name, first, last, values.data()));
}

void Model::get(std::int64_t body, const char* name, std::int64_t first, std::int64_t last,
                std::span<std::int64_t> values) const {
  check(cleave_field_get_integer(handle(), body, name, first, last, values.data()));
}

void Model::put(std::int64_t body, const char* name, std::span<const double> values) {
  check(cleave_field_put_real(handle(), body, name, 0, field(body, name).count, values.data()));
}

void Model::put(std::int64_t body, const char* name, std::span<const std::int64_t> values) {
  check(cleave_field_put_integer(handle(), body, name, 0, field(body, name).count, values.data()));
}

std::vector<double> Model::reals(std::int64_t body, const char* name) const {
  const cleave_field info = field(body, name);
  std::vector<double> values(static_cast<std::size_t>(info.count * info.components));
  check(cleave_field_get_real(handle(), body, name, 0, info.count, values.data()));
  return values;
}

std::vector<std::int64_t> Model::integers(std::int64_t body, const char* name) const {
  const cleave_field info = field(body, name);
  std::vector<std::int64_t> values(static_cast<std::size_t>(info.count * info.components));
  check(cleave_field_get_integer(handle(), body, name, 0, info.count, values.data()));
  return values;
}

}  // namespace cleave::driver

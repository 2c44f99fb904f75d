// A kernels' model that owns itself and throws instead of returning a status. Nothing else: what
// the driver can do with it, a host can do through cleave.h.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "cleave/cleave.h"

namespace cleave::driver {

// A call of the kernels that was answered with an error; the text is cleave_last_message().
struct KernelError : std::runtime_error {
  KernelError(const std::string& message, std::int32_t code)
      : std::runtime_error(message), status(code) {}
  std::int32_t status;
};

// Throws KernelError unless status is CLEAVE_OK.
void check(std::int32_t status);

class Model {
 public:
  // order: enum cleave_order
  Model(int threads, std::int32_t order);

  cleave_model* handle() const { return handle_.get(); }
  std::int64_t bodies() const { return bodies_; }

  std::int64_t add_body(const cleave_body_spec& spec);
  void setup();

  double stable_step() const;
  double time() const;  // of its clock
  bool is_stable(double dt) const;
  double wave_speed(std::int64_t body) const;
  std::int64_t memory() const;
  cleave_energies energies(std::int64_t body = -1) const;
  cleave_counts counts(std::int64_t body) const;
  cleave_counts total_counts() const;

  // A property of the material of a body.
  double property(std::int64_t body, const char* name) const;
  std::vector<cleave_field> fields(std::int64_t body) const;
  std::optional<cleave_field> find_field(std::int64_t body, const std::string& name) const;
  // Whole fields: values has count * components entries.
  void get(std::int64_t body, const char* name, std::span<double> values) const;
  void get(std::int64_t body, const char* name, std::span<std::int64_t> values) const;
  // Entries first..last.
  void get(std::int64_t body, const char* name, std::int64_t first, std::int64_t last,
           std::span<double> values) const;
  void get(std::int64_t body, const char* name, std::int64_t first, std::int64_t last,
           std::span<std::int64_t> values) const;
  // Whole fields again.
  void put(std::int64_t body, const char* name, std::span<const double> values);
  void put(std::int64_t body, const char* name, std::span<const std::int64_t> values);
  std::vector<double> reals(std::int64_t body, const char* name) const;
  std::vector<std::int64_t> integers(std::int64_t body, const char* name) const;

 private:
  struct Destroy {
    void operator()(cleave_model* model) const { cleave_model_destroy(model); }
  };
  cleave_field field(std::int64_t body, const char* name) const;

  std::unique_ptr<cleave_model, Destroy> handle_;
  std::int64_t bodies_ = 0;
};

}  // namespace cleave::driver

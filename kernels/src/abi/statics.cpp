// Statics of a model: Newton's method with bonds that break, and dynamic relaxation.
#include "abi/checks.hpp"
#include "abi/guard.hpp"
#include "model/model.hpp"
#include "solver/relaxation.hpp"
#include "solver/static_solver.hpp"

using namespace cleave;
using namespace cleave::abi;
using Phase = cleave_model::Phase;

namespace {

constexpr const char* kBetweenSteps =
    "statics start after cleave_model_initialise, between two steps";

Breaking breaking_of(std::int32_t value) {
  if (value == CLEAVE_BREAKING_ALL) return Breaking::all;
  if (value == CLEAVE_BREAKING_ONE) return Breaking::one;
  if (value == CLEAVE_BREAKING_TIES) return Breaking::ties;
  throw Error(CLEAVE_BAD_ARGUMENT, text("breaking is ", value,
                                        "; allowed: CLEAVE_BREAKING_ALL, CLEAVE_BREAKING_ONE, "
                                        "CLEAVE_BREAKING_TIES"));
}

Solver solver_of(std::int32_t value) {
  if (value == CLEAVE_SOLVER_DIRECT) return Solver::direct;
  if (value == CLEAVE_SOLVER_ITERATIVE) return Solver::iterative;
  throw Error(CLEAVE_BAD_ARGUMENT, text("solver is ", value,
                                        "; allowed: CLEAVE_SOLVER_DIRECT, "
                                        "CLEAVE_SOLVER_ITERATIVE"));
}

std::int64_t corrections_of(std::int32_t value) {
  if (value >= -1) return value;
  throw Error(CLEAVE_BAD_ARGUMENT, text("corrections is ", value, "; allowed: >= -1"));
}

StaticOptions options_of(const cleave_static_options* options) {
  if (options == nullptr) return {};
  check_size(*options, "cleave_static_options");
  return {options->tolerance,          options->max_iterations,
          options->stop_at_limit != 0, breaking_of(options->breaking),
          solver_of(options->solver),  corrections_of(options->corrections)};
}

template <class Solve>
void answer(cleave_model* model, cleave_static_report* report, const Solve& solve) {
  required(model, "model").require(Phase::stepping, kBetweenSteps);
  if (report != nullptr) fill_sized(report, cleave_static_report{}, "report");
  const StaticReport done = solve();
  if (report == nullptr) return;
  fill_sized(report,
             cleave_static_report{0, done.iterations, done.unknowns, done.residual, done.fraction,
                                  done.broken, done.critical},
             "report");
}

}  // namespace

int32_t cleave_static_options_init(cleave_static_options* options) {
  return guarded("cleave_static_options_init", [&] {
    const StaticOptions defaults;
    required(options, "options") = {sizeof(cleave_static_options),
                                    defaults.tolerance,
                                    defaults.max_iterations,
                                    0,
                                    CLEAVE_SOLVER_DIRECT,
                                    CLEAVE_BREAKING_ALL,
                                    static_cast<std::int32_t>(defaults.corrections),
                                    0};
  });
}

int32_t cleave_model_solve_static(cleave_model* model, double time_new,
                                  const cleave_static_options* options,
                                  cleave_static_report* report) {
  return guarded("cleave_model_solve_static", [&] {
    answer(model, report, [&] { return solve_static(*model, time_new, options_of(options)); });
  });
}

int32_t cleave_model_break_static(cleave_model* model, const cleave_static_options* options,
                                  cleave_static_report* report) {
  return guarded("cleave_model_break_static", [&] {
    answer(model, report, [&] { return break_static(*model, options_of(options)); });
  });
}

int32_t cleave_relaxation_options_init(cleave_relaxation_options* options) {
  return guarded("cleave_relaxation_options_init", [&] {
    const RelaxationOptions defaults;
    required(options, "options") = {sizeof(cleave_relaxation_options),
                                    defaults.tolerance,
                                    defaults.max_iterations,
                                    defaults.slice,
                                    CLEAVE_BREAKING_ALL,
                                    0};
  });
}

int32_t cleave_model_relax(cleave_model* model, double time_new,
                           const cleave_relaxation_options* options,
                           cleave_relaxation_report* report) {
  return guarded("cleave_model_relax", [&] {
    if (required(model, "model").phase != Phase::relaxing)
      model->require(Phase::stepping, kBetweenSteps);
    if (report != nullptr) fill_sized(report, cleave_relaxation_report{}, "report");
    RelaxationOptions wanted;
    if (options != nullptr) {
      check_size(*options, "cleave_relaxation_options");
      wanted = {options->tolerance, options->max_iterations, options->slice,
                breaking_of(options->breaking)};
    }
    const RelaxationReport now = relax(*model, time_new, wanted);
    if (report != nullptr) {
      fill_sized(report,
                 cleave_relaxation_report{0, now.iterations, now.rounds, now.broken, now.unknowns,
                                          now.finished ? 1 : 0, now.residual},
                 "report");
    }
  });
}

int32_t cleave_model_relax_cancel(cleave_model* model) {
  return guarded("cleave_model_relax_cancel", [&] {
    required(model, "model")
        .require(Phase::relaxing,
                 "nothing is being relaxed; only a call of cleave_model_relax that "
                 "returned with finished = 0 can be cancelled");
    cancel_relaxation(*model);
  });
}

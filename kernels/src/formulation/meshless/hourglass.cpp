#include "formulation/meshless/hourglass.hpp"

#include <cmath>

namespace cleave::meshless {

namespace {

PairMotion motion_of(const Body& body) {
  return {body.point.X, body.point.x, body.point.u, body.point.h};
}

// err_ip - err_pi = 2 u_ip - (H_i + H_p) X_ip: changes its sign with the order of the pair, exactly.
template <int D>
Vec<D> pair_error(const PairMotion& m, std::int64_t i, std::int64_t p) {
  const Mat<D> own = load_tensor<D>(m.h, i), other = load_tensor<D>(m.h, p);
  const Vec<D> X = difference<D>(m.X, i, p), u = difference<D>(m.u, i, p);
  Vec<D> error;
  for (int r = 0; r < D; ++r) {
    double affine = 0;
    for (int c = 0; c < D; ++c) affine += (own(r, c) + other(r, c)) * X[c];
    error[r] = 2 * u[r] - affine;
  }
  return error;
}

// |u_ip - H_i X_ip|^2
template <int D>
double square_error(const PairMotion& m, std::int64_t i, std::int64_t p) {
  const Vec<D> affine = multiply(load_tensor<D>(m.h, i), difference<D>(m.X, i, p));
  Vec<D> error = difference<D>(m.u, i, p);
  for (int r = 0; r < D; ++r) error[r] -= affine[r];
  return dot(error, error);
}

// 1/2 sum over ordered pairs of c(i, p, half-bond) |err_ip|^2
template <class Stiffness>
double penalty_energy(const Body& body, const GradientOperator& g, const Stiffness& c) {
  const PairMotion m = motion_of(body);
  double sum = 0;
  for (std::int64_t i = 0; i < body.particles; ++i) {
    for (std::int32_t b = g.row_begin[i]; b < g.row_begin[i + 1]; ++b) {
      const std::int64_t p = g.neighbour[b];
      sum += 0.5 * c(i, p, b) *
             (body.dimension() == 2 ? square_error<2>(m, i, p) : square_error<3>(m, i, p));
    }
  }
  return sum;
}

}  // namespace

void Hourglass::setup(Body& body, const KernelGradient& gradient, const Kernel& kernel) {
  const ParameterSet& options = body.group("hourglass");
  kernel_ = kernel;
  half_modulus_ =
      0.5 * with_law(body.material, [](const auto& law) { return law.youngs_modulus(); });
  const double psi = options.real("psi");
  form_ = options.any_given() && psi > 0 ? static_cast<HourglassForm>(options.choice("form"))
                                         : HourglassForm::none;
  force_ = body.fields.real("hourglass_force");
  work_ = body.fields.real("hourglass_work");
  stiffness_.clear();
  if (!active()) return;
  if (!(half_modulus_ > 0)) {
    throw Error(CLEAVE_UNSUPPORTED,
                text(body.label(),
                     ": the hourglass penalty is scaled by Young's modulus, which is 0 "
                     "for law ",
                     body.law->name, "; leave the group hourglass out"));
  }
  if (form_ == HourglassForm::conservative && kernel.gradient == GradientForm::plain) {
    throw Error(CLEAVE_UNSUPPORTED,
                text(body.label(),
                     ": the conservative hourglass penalty needs the corrected "
                     "gradient; use form 'projected' in group hourglass, or gradient 'corrected' "
                     "in group kernel"));
  }
  const double strength = psi * half_modulus_;
  if (form_ == HourglassForm::conservative) {
    stiffness_ = gradient.pair_values([&](double volumes, double distance) {
      return strength * volumes * kernel.omega(distance);
    });
  } else {
    stiffness_ = gradient.pair_values([&](double volumes, double distance) {
      return strength * volumes * kernel.spline(distance) / (distance * distance);
    });
  }
}

template <int D>
Vec<D> Hourglass::force_on(const PairMotion& motion, const GradientOperator& g,
                           std::int64_t i) const {
  const bool projected = form_ == HourglassForm::projected;
  Vec<D> sum;
  for (std::int32_t b = g.row_begin[i]; b < g.row_begin[i + 1]; ++b) {
    const std::int64_t p = g.neighbour[b];
    Vec<D> along = pair_error<D>(motion, i, p);
    double scale = stiffness_[static_cast<std::size_t>(b)];
    if (projected) {
      const Vec<D> x = difference<D>(motion.x, i, p);
      const double square = dot(x, x);
      if (!(square > 0)) continue;  // no direction
      scale *= dot(along, x) / square;
      along = x;
    }
    for (int k = 0; k < D; ++k) sum[k] += scale * along[k];
  }
  return sum;
}

template <int D>
double Hourglass::add_force(const Body& body, const GradientOperator& g, std::int64_t first,
                            std::int64_t last) const {
  const PairMotion motion = motion_of(body);
  double power = 0;
  for (std::int64_t i = first; i < last; ++i) {
    const Vec<D> force = force_on<D>(motion, g, i);
    for (int k = 0; k < D; ++k) {
      const std::int64_t c = kVector * i + k;
      power += (force_[c] + force[k]) * body.point.v[c];
      force_[c] = force[k];
      body.point.internal[c] += force[k];
    }
  }
  return power;
}

void Hourglass::book(double power, double dt) const {
  if (form_ == HourglassForm::projected) *work_ -= 0.5 * dt * power;
}

double Hourglass::energy(const Body& body, const GradientOperator& g) const {
  if (form_ == HourglassForm::projected) return *work_;
  if (!active()) return 0;
  return penalty_energy(body, g, [&](std::int64_t, std::int64_t, std::int32_t b) {
    return stiffness_[static_cast<std::size_t>(b)];
  });
}

double Hourglass::diagnostic(const Body& body, const GradientOperator& g) const {
  return penalty_energy(body, g, [&](std::int64_t i, std::int64_t p, std::int32_t) {
    const Vec<3> d = difference<3>(body.point.X, i, p);
    return half_modulus_ * g.volume[i] * g.volume[p] * kernel_.omega(std::sqrt(dot(d, d)));
  });
}

#define CLEAVE_INSTANTIATE(D)                                                                      \
  template Vec<D> Hourglass::force_on<D>(const PairMotion&, const GradientOperator&, std::int64_t) \
      const;                                                                                       \
  template double Hourglass::add_force<D>(const Body&, const GradientOperator&, std::int64_t,      \
                                          std::int64_t) const;
CLEAVE_INSTANTIATE(2)
CLEAVE_INSTANTIATE(3)
#undef CLEAVE_INSTANTIATE

}  // namespace cleave::meshless

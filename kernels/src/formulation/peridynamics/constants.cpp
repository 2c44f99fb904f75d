#include "formulation/peridynamics/constants.hpp"

#include "formulation/cbm/parameters.hpp"

namespace cleave::peridynamics {

namespace {

constexpr double kSameRatio = 1e-6;  // of Poisson's ratio

bool plane_stress(const Body& body) { return body.kinematics == CLEAVE_PLANE_STRESS; }

}  // namespace

Elastic elastic_constants(const Body& body) {
  Elastic e;
  e.E = with_law(body.material, [](const auto& law) { return law.youngs_modulus(); });
  e.mu = with_law(body.material, [](const auto& law) { return law.shear_modulus(); });
  e.density = with_law(body.material, [](const auto& law) { return law.density(); });
  if (!body.law->history.empty() || !(e.E > 0) || !(e.mu > 0)) {
    throw Error(
        CLEAVE_UNSUPPORTED,
        text(body.label(), ": formulation ", body.formulation->name(),
             " has no stress at a point and takes the elastic constants of its material only; law ",
             body.law->name, " is more than that; use linear_elastic or svk"));
  }
  e.nu = e.E / (2 * e.mu) - 1;
  e.lambda = e.E * e.nu / ((1 + e.nu) * (1 - 2 * e.nu));
  if (plane_stress(body)) e.lambda = 2 * e.lambda * e.mu / (e.lambda + 2 * e.mu);
  return e;
}

double bond_constant(const Body& body, const Elastic& e, int dimension, double horizon,
                     double section, KeptModulus kept) {
  const double d3 = horizon * horizon * horizon;
  if (dimension == 1) return 2 * e.E / (section * horizon * horizon);
  // By the shear modulus, the same in the plane conditions; nu: the ratio for which all moduli agree.
  const double nu = dimension == 2 && plane_stress(body) ? 1.0 / 3 : 0.25;
  if (kept == KeptModulus::exact && std::fabs(e.nu - nu) > kSameRatio) {
    throw Error(CLEAVE_UNSUPPORTED,
                text(body.label(), ": nu = ", e.nu, ", but bond-based peridynamics has nu = ", nu,
                     dimension == 3       ? " in space"
                     : plane_stress(body) ? " in plane stress"
                                          : " in plane strain",
                     "; set nu = ", nu,
                     ", use cpd or lps, or say with modulus = 'shear', 'bulk' or 'young' in "
                     "group peridynamics which modulus to keep"));
  }
  double mu = e.mu;
  if (kept == KeptModulus::young) mu = e.E / (2 * (1 + nu));
  if (kept == KeptModulus::bulk) mu = e.bulk() * 3 * (1 - 2 * nu) / (2 * (1 + nu));
  return dimension == 3 ? 30 * mu / (kPi * d3 * horizon) : 24 * mu / (kPi * d3);
}

double critical_stretch(const Body& body, const Elastic& e, int dimension, double horizon) {
  const ParameterSet& options = body.group("fracture");
  if (!options.any_given() || options.choice("criterion") == static_cast<int>(cbm::Criterion::none))
    return -1;
  const double given = options.real("critical_strain"), Gf = options.real("Gf");
  if (given > 0 && Gf > 0) {
    throw Error(CLEAVE_BAD_ARGUMENT,
                text("group fracture of ", body.label(), " has critical_strain = ", given,
                     " and Gf = ", Gf, "; give one of them"));
  }
  if (options.real("length") > 0 ||
      options.choice("length_mode") == static_cast<int>(LengthMode::local)) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group fracture of ", body.label(), ": formulation ", body.formulation->name(),
                     " takes its length from the horizon; leave length and length_mode out"));
  }
  if (given > 0) return given;
  if (!(Gf > 0)) {
    throw Error(CLEAVE_MISSING_PARAMETER,
                text("group fracture of ", body.label(), " needs critical_strain > 0, or Gf > 0"));
  }
  if (options.choice("relation") == static_cast<int>(cbm::GriffithRelation::paper1d))
    return std::sqrt(3 * Gf / (2 * e.E * horizon));
  if (dimension == 3) return std::sqrt(5 * Gf / (9 * e.bulk() * horizon));
  if (dimension == 1) return std::sqrt(3 * Gf / (e.E * horizon));
  return plane_stress(body) ? std::sqrt(4 * kPi * Gf / (9 * e.E * horizon))
                            : std::sqrt(kPi * Gf / (6 * e.mu * horizon));
}

}  // namespace cleave::peridynamics

#include "formulation/peridynamics/constants.hpp"

#include "formulation/cbm/parameters.hpp"

namespace cleave::peridynamics {

namespace {

constexpr double kSameRatio = 1e-6;  // of Poisson's ratio

bool plane_stress(const Body& body) { return body.kinematics == CLEAVE_PLANE_STRESS; }

}  // namespace

std::string material_label(const Body& body, std::size_t region) {
  return region == 0 ? body.label() : text(body.label(), ", region ", region);
}

std::vector<Elastic> elastic_constants(const Body& body) {
  std::vector<Elastic> all;
  for (std::size_t k = 0; k <= body.regions.size(); ++k) {
    const MaterialEntry& law = k == 0 ? *body.law : *body.regions[k - 1].law;
    const Material& material = k == 0 ? body.material : body.regions[k - 1].material;
    Elastic e;
    e.E = with_law(material, [](const auto& l) { return l.youngs_modulus(); });
    e.mu = with_law(material, [](const auto& l) { return l.shear_modulus(); });
    e.density = with_law(material, [](const auto& l) { return l.density(); });
    if (!law.history.empty() || !(e.E > 0) || !(e.mu > 0)) {
      throw Error(
          CLEAVE_UNSUPPORTED,
          text(material_label(body, k), ": formulation ", body.formulation->name(),
               " has no stress at a point and takes the elastic constants of its material only; "
               "law ",
               law.name, " is more than that; use linear_elastic or svk"));
    }
    e.nu = e.E / (2 * e.mu) - 1;
    e.lambda = e.E * e.nu / ((1 + e.nu) * (1 - 2 * e.nu));
    if (plane_stress(body)) e.lambda = 2 * e.lambda * e.mu / (e.lambda + 2 * e.mu);
    all.push_back(e);
  }
  return all;
}

double bond_constant(const Body& body, std::size_t region, const Elastic& e, const Reach& reach,
                     KeptModulus kept) {
  const double d3 = reach.horizon * reach.horizon * reach.horizon;
  if (reach.dimension == 1) return 2 * e.E / (reach.section * reach.horizon * reach.horizon);
  // By the shear modulus, the same in the plane conditions; nu: the ratio for which all moduli agree.
  const double nu = reach.dimension == 2 && plane_stress(body) ? 1.0 / 3 : 0.25;
  if (kept == KeptModulus::exact && std::fabs(e.nu - nu) > kSameRatio) {
    throw Error(CLEAVE_UNSUPPORTED,
                text(material_label(body, region), ": nu = ", e.nu,
                     ", but bond-based peridynamics has nu = ", nu,
                     reach.dimension == 3 ? " in space"
                     : plane_stress(body) ? " in plane stress"
                                          : " in plane strain",
                     "; set nu = ", nu,
                     ", use cpd or lps, or say with modulus = 'shear', 'bulk' or 'young' in "
                     "group peridynamics which modulus to keep"));
  }
  double mu = e.mu;
  if (kept == KeptModulus::young) mu = e.E / (2 * (1 + nu));
  if (kept == KeptModulus::bulk) mu = e.bulk() * 3 * (1 - 2 * nu) / (2 * (1 + nu));
  return reach.dimension == 3 ? 30 * mu / (kPi * d3 * reach.horizon) : 24 * mu / (kPi * d3);
}

namespace {

// Of group fracture: critical_strain or Gf, the other 0; both 0: bonds do not break.
struct Toughness {
  double critical_strain = 0, Gf = 0;
};

Toughness toughness_of(const Body& body) {
  const ParameterSet& options = body.group("fracture");
  if (!options.any_given() || options.choice("criterion") == static_cast<int>(cbm::Criterion::none))
    return {};
  const Toughness given{options.real("critical_strain"), options.real("Gf")};
  if (given.critical_strain > 0 && given.Gf > 0) {
    throw Error(CLEAVE_BAD_ARGUMENT, text("group fracture of ", body.label(),
                                          " has critical_strain = ", given.critical_strain,
                                          " and Gf = ", given.Gf, "; give one of them"));
  }
  if (options.real("length") > 0 ||
      options.choice("length_mode") == static_cast<int>(LengthMode::local)) {
    throw Error(CLEAVE_UNSUPPORTED,
                text("group fracture of ", body.label(), ": formulation ", body.formulation->name(),
                     " takes its length from the horizon; leave length and length_mode out"));
  }
  if (!(given.critical_strain > 0) && !(given.Gf > 0)) {
    throw Error(CLEAVE_MISSING_PARAMETER,
                text("group fracture of ", body.label(), " needs critical_strain > 0, or Gf > 0"));
  }
  return given;
}

double stretch_of(const Body& body, const Toughness& given, const Elastic& e, const Reach& reach) {
  if (given.critical_strain > 0) return given.critical_strain;
  if (!(given.Gf > 0)) return kUnbounded;
  const double Gf = given.Gf, horizon = reach.horizon;
  if (body.group("fracture").choice("relation") == static_cast<int>(cbm::GriffithRelation::paper1d))
    return std::sqrt(3 * Gf / (2 * e.E * horizon));
  if (reach.dimension == 3) return std::sqrt(5 * Gf / (9 * e.bulk() * horizon));
  if (reach.dimension == 1) return std::sqrt(3 * Gf / (e.E * horizon));
  return plane_stress(body) ? std::sqrt(4 * kPi * Gf / (9 * e.E * horizon))
                            : std::sqrt(kPi * Gf / (6 * e.mu * horizon));
}

}  // namespace

std::vector<double> critical_stretches(const Body& body, const std::vector<Elastic>& materials,
                                       const Reach& reach) {
  const Toughness common = toughness_of(body);
  std::vector<double> limits;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    Toughness own = common;
    if (k > 0) {
      const MaterialRegion& r = body.regions[k - 1];
      if (r.critical_strain > 0 || r.Gf > 0) own = {r.critical_strain, r.Gf};
    }
    limits.push_back(stretch_of(body, own, materials[k], reach));
  }
  return limits;
}

}  // namespace cleave::peridynamics

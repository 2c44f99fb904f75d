#include "formulation/vcpm/softening.hpp"

#include <array>
#include <cmath>

namespace cleave::vcpm {

namespace {

// A bond with less than this share of its largest force is broken: the exponential law has no end.
constexpr double kNoForce = 1e-3;

constexpr std::array<const char*, 4> kLaws = {"none", "linear", "bilinear", "exponential"};

// The options as a message names them.
struct Given {
  const Body& body;
  const ParameterSet& options;
  Softening s;

  std::string label() const {
    return text("group vcpm of ", body.label(), ": softening '",
                kLaws[static_cast<std::size_t>(s.law)], "'");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(CLEAVE_BAD_ARGUMENT, text(label(), what));
  }
};

void refuse_unused(const Given& g) {
  const bool bilinear = g.s.law == SofteningLaw::bilinear;
  for (const char* key : {"final_strain", "softening_energy"})
    if (!g.s.active() && g.options.real(key) > 0)
      g.fail(text(" takes no ", key, "; leave it out, or choose linear, bilinear or exponential"));
  for (const char* key : {"kink_strain", "kink_force"})
    if (!bilinear && g.options.real(key) > 0)
      g.fail(text(" takes no ", key, "; leave it out, or use softening 'bilinear'"));
}

void check_onset(const Given& g, Criterion criterion) {
  if (criterion != Criterion::strain)
    g.fail(text(" goes by the strain of a bond, but criterion is '",
                criterion == Criterion::force ? "force" : "energy", "'; set criterion = 'strain'"));
  if (!std::isfinite(g.s.onset))
    g.fail(" needs the strain where it begins; give strength or limit > 0");
}

void check_kink(const Given& g) {
  if (g.s.law != SofteningLaw::bilinear) return;
  if (!(g.s.kink_strain > g.s.onset))
    g.fail(text(" has kink_strain = ", g.s.kink_strain, "; allowed: above the onset at ", g.s.onset,
                ", below final_strain"));
  if (!(g.s.kink_force > 0 && g.s.kink_force <= 1))
    g.fail(text(" has kink_force = ", g.s.kink_force, "; allowed: 0 < kink_force <= 1"));
}

// The area under the force over the force at the onset, times k e_0 d.                  [VCPM toughness]
double strain_from_energy(const Given& g, double energy, const Lattice& lattice) {
  if (lattice.kind != LatticeChoice::triangular)
    g.fail(text(" has softening_energy = ", energy,
                ", which is known for the triangular lattice alone; give final_strain"));
  const Softening& s = g.s;
  const double scale = lattice.shells.front().stiffness * s.onset * lattice.spacing;
  double least = 0.5 * s.onset, strain = 2 * energy / scale;
  if (s.law == SofteningLaw::bilinear) {
    least += 0.5 * (1 + s.kink_force) * (s.kink_strain - s.onset);
    strain = s.kink_strain + 2 * (energy / scale - least) / s.kink_force;
  }
  if (!(energy / scale > least))
    g.fail(text(" has softening_energy = ", energy, " [J m-2], but at spacing ", lattice.spacing,
                " [m] bonds have taken ", scale * least, " [J m-2] before they ",
                s.law == SofteningLaw::bilinear ? "reach kink_strain" : "soften",
                "; use a finer lattice, a larger softening_energy or a smaller ",
                s.law == SofteningLaw::bilinear ? "kink_strain" : "strength"));
  return strain;
}

}  // namespace

double Softening::envelope(double strain) const {
  if (!(strain > onset)) return 1;
  if (law == SofteningLaw::exponential) {
    const double f = std::exp(-2 * (strain - onset) / (final_strain - onset));
    return f > kNoForce ? f : 0.0;
  }
  if (strain >= final_strain) return 0;
  if (law == SofteningLaw::linear) return (final_strain - strain) / (final_strain - onset);
  if (strain >= kink_strain)
    return kink_force * (final_strain - strain) / (final_strain - kink_strain);
  return 1 - (1 - kink_force) * (strain - onset) / (kink_strain - onset);
}

double Softening::integrity(double strain) const {
  return strain > onset ? envelope(strain) * onset / strain : 1.0;
}

double Softening::end() const {
  if (law != SofteningLaw::exponential) return final_strain;
  return onset - 0.5 * std::log(kNoForce) * (final_strain - onset);
}

Softening read_softening(const Body& body, Criterion criterion, double onset,
                         const Lattice& lattice) {
  Given g{body, body.group("vcpm"), {}};
  g.s.law = static_cast<SofteningLaw>(g.options.choice("softening"));
  refuse_unused(g);
  if (!g.s.active()) return g.s;
  g.s.onset = onset;
  g.s.kink_strain = g.options.real("kink_strain");
  g.s.kink_force = g.options.real("kink_force");
  check_onset(g, criterion);
  check_kink(g);
  g.s.final_strain = g.options.real("final_strain");
  const double energy = g.options.real("softening_energy");
  if ((g.s.final_strain > 0) == (energy > 0))
    g.fail(text(" has final_strain = ", g.s.final_strain, " and softening_energy = ", energy,
                "; give one of them"));
  if (energy > 0) g.s.final_strain = strain_from_energy(g, energy, lattice);
  const bool kink = g.s.law == SofteningLaw::bilinear;
  const double least = kink ? g.s.kink_strain : onset;
  if (!(g.s.final_strain > least))
    g.fail(text(" has final_strain = ", g.s.final_strain, "; allowed: above ",
                kink ? "kink_strain = " : "the onset at ", least));
  return g.s;
}

}  // namespace cleave::vcpm

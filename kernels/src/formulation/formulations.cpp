// The formulations table as objects: the one file that knows every formulation's class.
#include "core/error.hpp"
#include "formulation/bond_pd/bond_pd.hpp"
#include "formulation/cbm/cbm.hpp"
#include "formulation/cpd/cpd.hpp"
#include "formulation/fem/fem.hpp"
#include "formulation/lps/lps.hpp"
#include "formulation/nosb/nosb.hpp"
#include "formulation/tlsph/tlsph.hpp"
#include "formulation/vcpm/vcpm.hpp"
#include "model/formulation.hpp"

namespace cleave {

using bond_pd::BondPeridynamics;
using cbm::ContinuumBondMethod;
using cpd::ContinuumKinematicsPeridynamics;
using fem::FiniteElements;
using lps::LinearPeridynamicSolid;
using nosb::CorrespondencePeridynamics;
using tlsph::TotalLagrangianSph;
using vcpm::VolumeCompensatedParticles;

std::unique_ptr<Formulation> make_formulation(std::int32_t value) {
  std::string known;
#define CLEAVE_FORMULATION(name, number, type, title, source) \
  if (value == number) return std::make_unique<type>();       \
  known += text(known.empty() ? "" : ", ", #name, " = ", number);
#include "cleave/tables/formulations.def"
  throw Error(CLEAVE_UNKNOWN_NAME,
              text("formulation ", value, " is unknown; known formulations: ", known));
}

}  // namespace cleave

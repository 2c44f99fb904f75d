#!/usr/bin/env python3
"""How much mesh, fillet, inertia, step and stabilisation matter for the errors (29): the default run with one thing changed.

    validation/tensile-bar/study.py [NAME...] [--cleave PATH]      prints the table of README.md

The finite-element reference comes first; the other lines need it, from this call or an earlier one.
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
from tools import python  # noqa: E402

if __name__ == "__main__":
    python.ensure(__file__)
import check  # noqa: E402
from tools import sensitivity  # noqa: E402
from tools.simulation import Result, Run  # noqa: E402

FINE = check.FINE


def sph(name, changes=None, radius=1.5, psi=0.07):
    return Run(name, "tlsph.nml", check.sph(radius, psi).changes | (changes or {}), check.mesh(FINE))


def runs():
    made = {"finite elements": check.fem("fem", check.REFERENCE["full"]), "CBM": check.cbm("cbm", FINE)}
    for spacing in (0.54, 0.545, 0.56, 0.8, 0.4):
        made[f"CBM, l_c = {spacing:g} mm"] = check.cbm(f"cbm-{spacing:g}", spacing)
    made["CBM, ramp 4 ms"] = check.cbm("cbm-slow", FINE, slower=check.SLOWER)
    made["TLSPH, cut-off 3 l_c, psi = 0.07"] = sph("sph")
    made["TLSPH, step 0.2 l_c/c0"] = sph("sph-step", {"run.step_factor": 0.1238})
    made["TLSPH, conservative penalty"] = sph("sph-conservative", {"hourglass.form": "conservative"})
    made["TLSPH, cut-off 4 l_c, psi = 1"] = sph("sph-strong", radius=2, psi=1)
    made["TLSPH, the same, half the step"] = sph("sph-strong-step", {"run.step_factor": 0.4}, radius=2, psi=1)
    return made


def row(result):
    """Particles, errors of plastic strain and equivalent stress (per cent), stress at the end (MPa), energy balance."""
    stress = check.curve(result)[1][-1]
    count = len(result.exodus.points)
    if check.is_static(result):
        return [str(count), "", "", f"{stress:.1f}", ""]
    reference = Result(Run("fem", "fem.nml"), result.folder.parent / "fem")
    errors = [check.field_error(result, reference, field) for field in check.FIELDS.values()]
    return [str(count), *(f"{error:.2f}" for error in errors), f"{stress:.1f}", f"{check.closure(result):.1e}"]


if __name__ == "__main__":
    sensitivity.main(HERE, runs(), ["particles", "plastic strain (%)", "equivalent stress (%)", "end stress (MPa)",
                                   "balance error"], row)

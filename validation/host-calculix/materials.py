"""Material and section of a CalculiX deck: our law j2 through the adapter's two interfaces, and *PLASTIC.

Both sides harden by tau_y = tau_y0 + (tau_inf - tau_y0) (1 - exp(-alpha eps_p)) + h0 eps_p and yield in the
Kirchhoff stress; *PLASTIC gets the curve by points.
"""
import dataclasses
import math

STATE_VARIABLES = 8  # history of j2
POINTS = 199         # of the hardening curve


@dataclasses.dataclass(frozen=True)
class Metal:
    """Properties of law j2 in the order of `cleave keys material`; largest_strain: where the curve ends."""

    rho: float
    E: float
    nu: float
    tau_y0: float
    tau_inf: float
    h0: float
    alpha: float
    largest_strain: float

    def yield_stress(self, strain):
        return self.tau_y0 + (self.tau_inf - self.tau_y0) * -math.expm1(-self.alpha * strain) + self.h0 * strain

    def constants(self):
        return (self.rho, self.E, self.nu, self.tau_y0, self.tau_inf, self.h0, self.alpha)


BAR = Metal(0.01, 206892.215879334, 0.290012569392677, 450.0, 715.0, 129.0, 16.93, 2.0)
COPPER = Metal(8930.0, 117e9, 0.35, 400e6, 400e6, 100e6, 0.0, 8.0)


def _numbers(values):
    return ", ".join(f"{value:.12g}" for value in values)


def cleave(metal, interface=""):
    """interface: '' native, 'ABAQUSNL'."""
    name = "@ABAQUSNL_CLEAVE_UMAT_J2@METAL" if interface else "@CLEAVE_J2@METAL"
    return (f"*MATERIAL, NAME={name}\n*USER MATERIAL, CONSTANTS=7\n{_numbers(metal.constants())}\n"
            f"*DEPVAR\n{STATE_VARIABLES}\n*DENSITY\n{metal.rho:.12g}\n*SOLID SECTION, ELSET=ALL, MATERIAL={name}\n")


def plastic(metal):
    """Points lie denser where the curve bends."""
    strains = [metal.largest_strain * (k / (POINTS - 1)) ** 2 for k in range(POINTS)]
    curve = "".join(f"{_numbers((metal.yield_stress(strain), strain))}\n" for strain in strains)
    return (f"*MATERIAL, NAME=METAL\n*ELASTIC\n{_numbers((metal.E, metal.nu))}\n*PLASTIC\n{curve}"
            f"*DENSITY\n{metal.rho:.12g}\n*SOLID SECTION, ELSET=ALL, MATERIAL=METAL\n")

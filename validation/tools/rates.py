"""Finite-strain J2 plasticity as rate equations, integrated to high order: what a return mapping must converge to.

Independent of the program: no return mapping, no step of an elastic trial.  Logarithmic strain, Kirchhoff stress,
hardening h(e) = h0 e + (tau_inf - tau_y0)(1 - exp(-alpha e)); state is Cpi = Cp^-1 and the plastic strain.  With
B = F Cpi F^T, n = dev(ln B)/|dev(ln B)| and the velocity gradient l, consistency gives

    rate of the plastic strain  g = 2 G sqrt(3/2) n:l / (3 G + h')        while tau_eq = tau_y and n:l > 0
    rate of Cpi                 = -2 sqrt(3/2) g F^-1 n F Cpi
"""
import dataclasses

import numpy

ROOT = numpy.sqrt(1.5)


@dataclasses.dataclass(frozen=True)
class J2:
    """Constants of the law."""

    G: float
    kappa: float
    tau_y0: float
    tau_inf: float
    h0: float
    alpha: float

    def strength(self, e):
        return self.tau_y0 + self.h0 * e + (self.tau_inf - self.tau_y0) * -numpy.expm1(-self.alpha * e)

    def hardening(self, e):
        return self.h0 + (self.tau_inf - self.tau_y0) * self.alpha * numpy.exp(-self.alpha * e)

    def plastic_work(self, e):
        """Work of plastic flow: the integral of the strength."""
        saturated = e + numpy.expm1(-self.alpha * e) / self.alpha
        return self.tau_y0 * e + self.h0 * e * e / 2 + (self.tau_inf - self.tau_y0) * saturated

    def log_strain(self, F, Cpi):
        values, vectors = numpy.linalg.eigh(F @ Cpi @ F.T)
        return vectors @ numpy.diag(0.5 * numpy.log(values)) @ vectors.T

    def kirchhoff(self, F, Cpi):
        strain = self.log_strain(F, Cpi)
        volume = numpy.trace(strain)
        return self.kappa * volume * numpy.eye(3) + 2 * self.G * (strain - volume / 3 * numpy.eye(3))

    def stress(self, F, Cpi):
        """First Piola-Kirchhoff stress."""
        return self.kirchhoff(F, Cpi) @ numpy.linalg.inv(F).T

    def equivalent(self, F, Cpi):
        return equivalent(self.kirchhoff(F, Cpi))

    def flow(self, F, rate, Cpi, e):
        """Rates of Cpi and of the plastic strain on the yield surface; negative: unloading."""
        strain = self.log_strain(F, Cpi)
        deviator = strain - numpy.trace(strain) / 3 * numpy.eye(3)
        n = deviator / numpy.linalg.norm(deviator)
        inverse = numpy.linalg.inv(F)
        g = 2 * self.G * ROOT * numpy.sum(n * (rate @ inverse)) / (3 * self.G + self.hardening(e))
        return -2 * ROOT * g * inverse @ n @ F @ Cpi, g


def equivalent(tau):
    """sqrt(3/2) times the norm of the deviator."""
    return ROOT * numpy.linalg.norm(tau - numpy.trace(tau) / 3 * numpy.eye(3))


def extrapolated(rate, start, end, state, levels=8):
    """One large step of Gragg, Bulirsch and Stoer: modified midpoint with 2, 4, 6, ... parts, extrapolated in the step squared."""
    rows = []
    for level in range(1, levels + 1):
        parts = 2 * level
        step = (end - start) / parts
        before, now = state, state + step * rate(start, state)
        for part in range(1, parts):
            before, now = now, before + 2 * step * rate(start + part * step, now)
        row = [0.5 * (now + before + step * rate(end, now))]
        for order, last in enumerate(rows[-1] if rows else [], 1):
            ratio = (level / (level - order)) ** 2
            row.append(row[-1] + (row[-1] - last) / (ratio - 1))
        rows.append(row)
    return rows[-1][-1]


def follow(law, corners, parts=40):
    """State after every straight piece of a path of deformation gradients: list of (F, Cpi, plastic strain).

    A piece is halved down to where flow starts or ends (bisection), then integrated in `parts` large steps.
    """
    Cpi, e = numpy.eye(3), 0.0
    states = [(numpy.asarray(corners[0], float), Cpi, e)]
    for begin, end in zip(corners[:-1], corners[1:]):
        begin, rate = numpy.asarray(begin, float), numpy.asarray(end, float) - begin
        Cpi, e = _piece(law, lambda s: begin + s * rate, rate, Cpi, e, parts)  # noqa: B023
        states.append((begin + rate, Cpi, e))
    return states


def _piece(law, F, rate, Cpi, e, parts):
    """A straight piece, s from 0 to 1: elastic, then plastic until it ends or unloads, and so on."""
    s, flowed = 0.0, False
    while s < 1:
        s = _elastic_end(law, F, Cpi, e, s, parts, flowed)
        flowed = True
        if s < 1:
            s, Cpi, e = _plastic(law, F, rate, Cpi, e, s, parts)
    return Cpi, e


def _elastic_end(law, F, Cpi, e, s, parts, unloading):
    """Where the elastic domain is left; s itself if flow goes on from the piece before."""
    excess = lambda t: law.equivalent(F(t), Cpi) - law.strength(e)  # noqa: E731
    small = 1e-10
    if not unloading and excess(min(1.0, s + small)) > 0 and excess(s) > -1e-9 * law.tau_y0:
        return s
    grid = numpy.linspace(min(1.0, s + small), 1, 50 * parts + 1)
    for low, high in zip(grid[:-1], grid[1:]):
        if excess(high) > 0:
            while low < (middle := 0.5 * (low + high)) < high:
                low, high = (low, middle) if excess(middle) > 0 else (middle, high)
            return high
    return 1.0


def _plastic(law, F, rate, Cpi, e, s, parts):
    """Flow from s until the end of the piece or until it unloads."""

    def rates(t, state):
        change, g = law.flow(F(t), rate, state[:9].reshape(3, 3), state[9])
        return numpy.append(change.ravel(), g)

    state = numpy.append(Cpi.ravel(), e)
    step = (1 - s) / parts
    while s < 1:
        end = min(1.0, s + step)
        end = 1.0 if 1.0 - end < 1e-3 * step else end
        tried = extrapolated(rates, s, end, state)
        if rates(end, tried)[9] >= 0:
            s, state = end, tried
        elif end - s > 1e-14:
            step = 0.5 * (end - s)                       # close in on the point of unloading
        else:
            break
    return s, state[:9].reshape(3, 3), state[9]

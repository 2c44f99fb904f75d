"""Measures of nominal stress-strain curves, and the error norm between two fields.

All take arrays; a curve is strain and stress, with the strain rising.
"""
import numpy


def error_norm(field, reference):
    """Equation (29) of the Continuum Bond Method paper, in per cent: L2 norm of the difference over that of the reference."""
    field, reference = numpy.asarray(field), numpy.asarray(reference)
    return 100 * numpy.sqrt(((reference - field) ** 2).sum() / (reference**2).sum())


def largest_difference(curve, reference, begin, end):
    """Largest relative difference of two curves between two strains, per cent; compared where the first has points."""
    strain, stress = curve
    inside = (strain >= begin) & (strain <= end)
    expected = numpy.interp(strain[inside], *reference)
    return 100 * abs(stress[inside] / expected - 1).max()


def slope(curve, low, high):
    """Slope of the straight line through the first rise between two stresses (least squares)."""
    strain, stress = curve
    last = int(numpy.argmax(stress > high)) if (stress > high).any() else len(stress)
    inside = stress[:last] >= low
    return numpy.polyfit(strain[:last][inside], stress[:last][inside], 1)[0]


def knee(curve, stiffness):
    """Stress at which the curve has turned half way: its tangent falls below half of `stiffness` for the first time."""
    strain, stress = curve
    distinct = numpy.concatenate([[True], numpy.diff(strain) > 1e-6 * strain.max()])
    strain, stress = strain[distinct], stress[distinct]
    tangent = numpy.diff(stress) / numpy.diff(strain)
    loaded = stress[:-1] > 0.3 * stress.max()
    first = int(numpy.argmax(loaded & (tangent < 0.5 * stiffness)))
    return 0.5 * (stress[first] + stress[first + 1])

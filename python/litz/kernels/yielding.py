"""The force between two crossed wires over their overlap: Hertz's, or that of metal that yields and keeps a dent."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .wire_pair import Numbers, properties

Floats = NDArray[np.float64]

#: `info` of litz_yielding_spot: the hardness is below the pressure at which the metal begins to yield
_TOO_SOFT = -12
#: Largest spot for which the law holds: radius of the circle of its area over the smaller radius
WIDEST_SPOT = 0.5


class NormalForce(NamedTuple):
    """The contact of two crossed wires at an overlap; floats, or arrays of the shape of the overlap."""

    #: Force [N], pushing the wires apart; 0 where they are apart or over the dent
    force: float | Floats
    #: Derivative of the force by the overlap [N/m]
    stiffness: float | Floats
    #: Derivative of the force by the angle at fixed overlap and largest force [N/rad]
    dforce_dangle: float | Floats
    #: Derivative of the force by the largest force at fixed overlap [-]; 0 while it is itself the largest
    dforce_dlargest: float | Floats
    #: Larger half axis of the spot [m]
    semi_major: float | Floats
    #: Smaller half axis of the spot [m]
    semi_minor: float | Floats
    #: Radius of the disc of the same conductance [m], ``G = 4 disc_radius/(rho1 + rho2)``
    disc_radius: float | Floats
    #: Overlap at which the wires part: the depth of the dent that the largest force has left [m]
    dent: float | Floats
    #: Largest force so far, this one included [N]
    largest_force: float | Floats
    #: Energy that comes back on unloading [J]
    energy: float | Floats
    #: Energy that yielding has dissipated so far [J]
    dissipation: float | Floats


def normal_law(
    overlap: Numbers,
    *,
    radius: Numbers,
    young: Numbers,
    poisson: Numbers,
    angle: float,
    yield_stress: Numbers | None = None,
    hardness: float | None = None,
    largest_force: Numbers = 0.0,
) -> NormalForce:
    """Force, stiffness and spot of two crossed round wires at an overlap, elastic or of metal that yields.

    Parameters
    ----------
    overlap : float or array_like
        Overlap of the undeformed surfaces [m]; negative: a gap.
    radius, young, poisson : float or array_like, shape (2,)
        Radii [m], Young's moduli [Pa] and Poisson's ratios [-] of the barred and the unbarred wire; one number serves
        both.
    angle : float
        Angle between the axes [rad], in (0, pi).
    yield_stress : float or array_like, shape (2,), optional
        Yield stress [Pa] of each wire; one number serves both. Without it the wires stay elastic.
    hardness : float, optional
        Hardness H [Pa] of the softer metal, to which the mean pressure rises; 2.8 times the smaller yield stress
        without it. Annealed metal hardens: its H is three to ten times its yield stress.
    largest_force : float or array_like
        Largest force that the contact has had [N], of the shape of `overlap` or one number for all. Wires that have
        had none load up from the start.

    Returns
    -------
    NormalForce
        `force`, `stiffness`, `dforce_dangle`, `dforce_dlargest`, `semi_major`, `semi_minor`, `disc_radius`, `dent`,
        `largest_force`, `energy`, `dissipation`.

    Raises
    ------
    ValueError
        A value that is not finite or out of its range; a hardness at or below the pressure at which the metal begins
        to yield; of metal that yields, a spot as large as a circle of half the smaller radius: the law then is that of
        compaction.

    Notes
    -----
    Hertz up to the onset of yielding (R. L. Jackson, I. Green, J. Tribol. 127 (2005) 343-354), power laws up to the
    hardness, elastic unloading with Barber's stiffness, a dent that stays, reloading on the same curve. Published
    laws for a sphere differ from it by up to 10 %, and from each other by up to 6 %, up to 110 times the overlap at
    the onset; for crossed cylinders none are known. Formulas: ``docs/theory.md``, section 15.

    Examples
    --------
    Hard copper, pressed together with an overlap of a micrometre, then let go to 0.9 of it:

    >>> from math import pi
    >>> wires = dict(radius=0.5e-3, young=120e9, poisson=0.34, angle=pi / 2, yield_stress=300e6)
    >>> pressed = normal_law(1e-6, **wires)
    >>> back = normal_law(0.9e-6, largest_force=pressed.force, **wires)
    >>> print(f"{pressed.force:.3f} N, then {back.force:.3f} N; dent {back.dent * 1e6:.3f} um")
    1.445 N, then 1.089 N; dent 0.456 um
    """
    of_wires = properties(radius, young, poisson, 1.0)[:3]
    overlaps, largest = np.broadcast_arrays(np.asarray(overlap, dtype=float), np.asarray(largest_force, dtype=float))
    checks.array("overlap", overlaps, overlaps.shape)
    if (checks.array("largest_force", largest, largest.shape) < 0).any():
        raise ValueError(f"largest_force must not be negative, but holds {largest.min():g}")
    stresses, hardness_value = yield_data(yield_stress, hardness)
    if yield_stress is None and (largest > 0).any():
        raise ValueError("largest_force needs yield_stress: elastic wires remember none")
    values, onset, info = _core.f2py_yielding.normal_law_of_points(
        overlaps.ravel(), 0, largest.ravel(), *of_wires, crossing_angle(angle), stresses, hardness_value
    )
    refuse(info, hardness_value, stresses, onset[0], angle)
    _, force, stiffness, _, by_angle, by_largest, major, minor, disc, dent, energy, dissipation, *_ = values
    shape = overlaps.shape
    if yield_stress is not None:
        refuse_wide(np.sqrt(major * minor), of_wires[0])
    of_points = (force, stiffness, by_angle, by_largest, major, minor, disc, dent)
    found = [*of_points, np.maximum(force, largest.ravel()), energy, dissipation]
    return NormalForce(*(float(each[0]) if shape == () else each.reshape(shape) for each in found))


def crossing_angle(angle: float) -> float:
    """Return the angle between two axes that are not parallel."""
    value = checks.number("angle", angle)
    if not 0 < value < np.pi:
        raise ValueError(f"angle must be between 0 and pi, not {value:g} rad; parallel wires have no point contact")
    return value


def yield_data(yield_stress: Numbers | None, hardness: float | None) -> tuple[Floats, float]:
    """Yield stresses, 0 of elastic wires, and hardness, 0 where it follows from them."""
    if yield_stress is None:
        if hardness is not None:
            raise ValueError("hardness needs yield_stress")
        return np.zeros(2), 0.0
    return checks.positive_pair("yield_stress", yield_stress), (
        0.0 if hardness is None else checks.positive("hardness", hardness)
    )


def single_yield_data(yield_stress: float | None, hardness: float | None, largest_force: float) -> tuple[float, ...]:
    """Yield stress, 0 of elastic wires, hardness, 0 where it follows from it, and largest force of a law of runs."""
    largest = checks.number("largest_force", largest_force)
    if largest < 0:
        raise ValueError(f"largest_force must not be negative, but is {largest:g}")
    if yield_stress is None:
        if largest > 0:
            raise ValueError("largest_force needs yield_stress: elastic wires remember none")
        return 0.0, 0.0, 0.0
    return (
        checks.positive("yield_stress", yield_stress),
        0.0 if hardness is None else checks.positive("hardness", hardness),
        largest,
    )


def refuse(info: int, hardness: float, stresses: Floats, yield_pressure: float, angle: float) -> None:
    """Raise what `info` of the law says."""
    if info == _TOO_SOFT:
        raise ValueError(
            f"hardness must be greater than the pressure at which wires with a yield stress of {stresses.min():g} Pa "
            f"begin to yield at this angle, {yield_pressure:g} Pa, not {hardness:g} Pa"
        )
    if info != 0:
        raise ValueError(f"angle is so close to parallel that the spot is infinitely long: {angle:g} rad")


def refuse_wide(spot_radius: ArrayLike, radius: Floats) -> None:
    """Raise a ValueError where a spot, a circle of this radius, is so large that the wires would be compacted."""
    widest = float(np.max(spot_radius, initial=0.0))
    if widest > WIDEST_SPOT * radius.min():
        raise ValueError(
            f"the spot has the area of a circle of {widest:g} m, more than half of the smaller radius, {radius.min():g} m: "
            "the wires would be compacted, for which the law does not hold"
        )

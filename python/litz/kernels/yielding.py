"""The force between two crossed wires over their overlap: Hertz's, or that of metal that yields and keeps a dent."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .batch import Batch
from .wire_pair import Numbers, take_properties

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
    angle: Numbers,
    yield_stress: Numbers | None = None,
    hardness: Numbers | None = None,
    largest_force: Numbers = 0.0,
) -> NormalForce:
    """Force, stiffness and spot of two crossed round wires at an overlap, elastic or of metal that yields.

    Parameters
    ----------
    overlap : float or array_like
        Overlap of the undeformed surfaces [m]; negative: a gap. All arguments may have leading axes, see `litz.kernels`.
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
    of = Batch()
    of.array("overlap", overlap)
    of.not_negative("largest_force", largest_force)
    if yield_stress is None and np.any(np.asarray(largest_force) > 0):
        raise ValueError("largest_force needs yield_stress: elastic wires remember none")
    crossing = Batch()
    radii = take_properties(crossing, radius, young, poisson)
    take_crossing_angle(crossing, angle)
    take_yielding(crossing, yield_stress, hardness)
    for name, value, own in crossing.taken():
        of.share(name, value, own)
    overlaps, largest = of.columns()
    values, onset, info = of.call(
        [(20,), (5,), ()], _core.f2py_yielding.normal_law_of_points, overlaps, 0, largest, *of.shared_columns()
    )
    refuse(of, info, onset[0])
    _, force, stiffness, _, by_angle, by_largest, major, minor, disc, dent, energy, dissipation, *_, widest = values
    if yield_stress is not None:
        refuse_wide(of, widest, radii)
    of_points = (force, stiffness, by_angle, by_largest, major, minor, disc, dent)
    return NormalForce(*of.results(np.array([*of_points, np.maximum(force, largest), energy, dissipation])))


def take_crossing_angle(of: Batch, angle: Numbers) -> None:
    """Take the angle between two axes that are not parallel."""
    value = of.array("angle", angle)
    checks.refuse(
        "angle",
        value,
        (value <= 0) | (value >= np.pi),
        0,
        "must be between 0 and pi, not {value:g} rad; parallel wires have no point contact",
    )


def take_yielding(of: Batch, yield_stress: Numbers | None, hardness: Numbers | None) -> None:
    """Take yield stresses, 0 of elastic wires, and hardness, 0 where it follows from them."""
    if yield_stress is None:
        if hardness is not None:
            raise ValueError("hardness needs yield_stress")
        of.pair("yield_stress", 0.0)
    else:
        of.positive_pair("yield_stress", yield_stress)
    if hardness is None:
        of.array("hardness", 0.0)
    else:
        of.positive("hardness", hardness)


def single_yield_data(yield_stress: Numbers | None, hardness: Numbers | None, largest_force: Numbers) -> Floats:
    """Yield stress, 0 of elastic wires, and hardness, 0 where it follows from it, of a law of runs: shape (..., 2)."""
    if yield_stress is None:
        if np.any(np.asarray(largest_force) > 0):
            raise ValueError("largest_force needs yield_stress: elastic wires remember none")
        return np.zeros(2)
    stress = checks.all_positive("yield_stress", yield_stress)
    return np.stack(
        np.broadcast_arrays(stress, 0.0 if hardness is None else checks.all_positive("hardness", hardness)), axis=-1
    )


def refuse(of: Batch, info: NDArray[np.int32], yield_pressure: ArrayLike = 0.0) -> None:
    """Raise what `info` of the law says of the first contact that it cannot be asked about."""
    if not info.any():
        return
    bad = int(np.argmax(info != 0))
    # what all contacts share is looked at once
    shape = of.shape if info.size == of.n else ()
    place = np.unravel_index(bad, shape) if shape else ()
    given = {
        name: np.broadcast_to(value, shape + value.shape[value.ndim - own :])
        for name, value, own in of.taken()
        if value.ndim - own <= len(shape)
    }
    at = of.named(info != 0, "contact") if shape else ""
    if info[bad] == _TOO_SOFT:
        raise ValueError(
            f"{at}hardness must be greater than the pressure at which wires with a yield "
            f"stress of {given['yield_stress'][place].min():g} Pa begin to yield at this angle, "
            f"{np.ravel(yield_pressure)[bad]:g} Pa, not {given['hardness'][place]:g} Pa"
        )
    raise ValueError(
        f"{at}angle is so close to parallel that the spot is infinitely long: {given['angle'][place]:g} rad"
    )


def refuse_wide(of: Batch, spot_radius: Floats, radii: Floats) -> None:
    """Raise a ValueError where a spot, a circle of this radius, is so large that the wires would be compacted."""
    smaller = np.broadcast_to(radii.min(axis=-1), of.shape).ravel()
    too_wide = spot_radius > WIDEST_SPOT * smaller
    if too_wide.any():
        widest = int(np.argmax(too_wide))
        raise ValueError(
            f"{of.named(too_wide, 'contact')}the spot has the area of a circle of {spot_radius[widest]:g} m, more than "
            f"half of the smaller radius, {smaller[widest]:g} m: the wires would be compacted, for which the law does not "
            "hold"
        )

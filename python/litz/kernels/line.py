"""Two wires that touch along a line: the law per length, and one point of the line."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .axes import AXES, Axis
from .batch import Batch, Floats
from .wire_pair import Numbers, take_geometry, take_properties

# The constants of the kernel
_LINE_ACTIVE = 0
_TOO_WIDE = (
    "the contact is wider than the law holds for: its half width is more than a quarter of the smaller radius; "
    "less force, or a smaller overlap, is needed"
)
_FAILURES = {
    -1: "the barred wire is curved about the point so much that its foot there is not well defined "
    "(M/|xb'|^2 must be above 1/4); exchange the wires",
    -2: "the foot was not found; do two nodes of an element coincide?",
    -3: "the axes meet, so that there is no normal",
    -4: _TOO_WIDE,
}


class LineLaw(NamedTuple):
    """Contact per length under a given force per length; arrays (n,) where the force is one."""

    #: Half of the width of the strip in which the wires touch [m]
    half_width: float | Floats
    #: Elastic approach of the two wires [m]
    approach: float | Floats
    #: Derivative of the approach by the force per length [m^2/N]
    dapproach_df: float | Floats
    #: Conductance per length [S/m]
    conductance: float | Floats
    #: Derivative of the conductance by the force per length at a fixed angle [S/N]
    dconductance_df: float | Floats
    #: Approach at which wires that have yielded part [m]; 0 of elastic ones
    dent: float | Floats = 0.0


class LinePoint(NamedTuple):
    """Result of one point of line contact; zero where it is not active, except place, gap, normal, angle and quality.

    Where the foot lies beyond the barred element, only place and quality are given.

    For many points each array has a leading axis n, and each number is an array (n,).
    """

    #: Tangent (28, 28) in the order {ub (12), u (12), Vb (2), V (2)}
    K: Floats
    #: Residual (28,): forces [N], moments [N m], currents leaving the nodes [A]
    R: Floats
    #: Whether the wires touch there
    active: bool | NDArray[np.bool_]
    #: Foot of the point in the barred element, which is [-1, 1]
    xi_bar: float | Floats
    #: Place of the point in the unbarred element, as given
    xi: float | Floats
    #: Gap between the surfaces [m], negative in contact
    gap: float | Floats
    #: Unit normal (3,) from the unbarred to the barred axis
    normal: Floats
    #: Force that the point stands for, weight times force per length [N], pushing the wires apart
    force: float | Floats
    #: Radius of the circle with the area of the strip that the point stands for [m]
    spot_radius: float | Floats
    #: Resistance of this strip [ohm]
    resistance: float | Floats
    #: Current from the barred to the unbarred beam [A]
    current: float | Floats
    #: Voltage across the strip, current times resistance [V]
    voltage_gap: float | Floats
    #: Angle between the axes there [rad]
    angle: float | Floats
    #: Half of the width of the strip [m]
    half_width: float | Floats
    #: Force per length [N/m]
    force_per_length: float | Floats
    #: Stored energy that the point stands for [J]
    energy: float | Floats
    #: ``M/|xb'|^2`` at the foot: 1 on a straight barred wire, 0 where it is wrapped about the point
    quality: float | Floats
    #: Whether the foot is held at an end of the barred axis
    at_end: bool | NDArray[np.bool_]


def line_law(
    force_per_length: Numbers,
    *,
    radius: Numbers,
    young: Numbers,
    poisson: Numbers,
    resistivity: Numbers,
    angle: Numbers = 0.0,
    film: Numbers = 0.0,
    yield_stress: Numbers | None = None,
    hardness: Numbers | None = None,
    largest_force_per_length: Numbers = 0.0,
) -> LineLaw:
    """Strip, approach and conductance per length of two round wires pressed together along a line.

    Parameters
    ----------
    force_per_length : float or array_like, shape (n,)
        Force per length [N/m]. Without a positive one there is no contact: all results are 0, although the slopes
        are infinite there. With an array, all other arguments may have a leading axis n, too.
    radius, young, poisson, resistivity : float or array_like, shape (2,) or (n, 2)
        Radii [m], Young's moduli [Pa], Poisson's ratios [-] and resistivities [ohm m] of the barred and the unbarred
        wire; one number serves both.
    angle : float or array_like, shape (n,)
        Angle between the axes [rad], from 0 (parallel) to pi.
    film : float or array_like, shape (n,)
        Resistance of a film on the strip times its area [ohm m^2]; 0: clean metal.
    yield_stress : float or array_like, shape (2,) or (n, 2), optional
        Yield stress of each wire [Pa]; one number serves both. Without it the wires stay elastic.
    hardness : float, optional
        With `yield_stress`: hardness H [Pa] of the softer metal, to which the mean pressure rises where the wires
        cross; 2.8 times the smaller yield stress without it. Wires side by side do not have it.
    largest_force_per_length : float or array_like, shape (n,)
        With `yield_stress`: largest force per length so far [N/m].

    Returns
    -------
    LineLaw
        `half_width` [m], `approach` [m], `dapproach_df` [m^2/N], `conductance` [S/m], `dconductance_df` [S/N], and the
        `dent` [m] that yielding has left.

    Raises
    ------
    ValueError
        A value that is not finite or out of its range; a strip whose half width is more than a quarter of the smaller
        radius.

    Notes
    -----
    Parallel wires: the strip of Hertz, the approach of two discs squeezed by line loads (K. L. Johnson, Contact
    Mechanics, section 5.6, with the load carried off by shear), and the constriction of the current in a disc,
    ``1/g' = (2 rho/pi) ln(2.266 r/b)`` of equal wires. Crossed wires: the integral over the lens of overlap is that of
    `contact_spot`, for the force as for the conductance. In between the smaller of lens and section is the far field.
    Formulas and derivatives are in ``docs/theory.md``, section 10; those of metal that yields in section 15.

    Examples
    --------
    Two parallel copper wires, pressed together with 1 N per millimetre:

    >>> law = line_law(1e3, radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
    >>> print(f"{law.half_width:.4g} m, {law.approach:.4g} m, {law.conductance:.4g} S/m")
    3.063e-06 m, 5.904e-08 m, 1.399e+07 S/m
    """
    of = Batch()
    force = of.array("force_per_length", force_per_length)
    take_properties(of, radius, young, poisson, resistivity)
    _take_angle(of, angle)
    of.not_negative("film", film)
    largest = checks.leading("largest_force_per_length", largest_force_per_length, ())
    checks.refuse("largest_force_per_length", largest, largest < 0, 0, "must not be negative, but is {value:g}")
    if yield_stress is None:
        if largest.any():
            raise ValueError("largest_force_per_length needs yield_stress: elastic wires remember none")
        if hardness is not None:
            raise ValueError("hardness needs yield_stress")
        values, too_wide = of.call([(5,), ()], _core.f2py_line.line_laws, *of.columns())
        values = np.vstack([values, np.zeros(of.n)])
    else:
        of.positive_pair("yield_stress", yield_stress)
        given = np.zeros(()) if hardness is None else checks.all_positive("hardness", hardness)
        of.take("hardness", given, 0)
        of.take("largest_force_per_length", largest, 0)
        force, *others, largest = of.columns()
        found, onset, too_wide = of.call(
            [(7,), (3,), ()], _core.f2py_yielding.line_law_of_points, force, 0, largest, *others
        )
        soft = (others[-1] > 0) & (others[-1] <= onset[0])
        if soft.any():
            first = int(np.argmax(soft))
            raise ValueError(
                f"{of.named(soft, 'point')}hardness must be greater than the pressure at which the wires begin to yield, "
                f"{onset[0, first]:g} Pa, not {others[-1][first]:g} Pa"
            )
        found[1] *= force > 0
        values = found[[3, 1, 2, 4, 5, 6]]
    if too_wide.any():
        raise ValueError(of.named(too_wide != 0, "point") + _TOO_WIDE)
    return LineLaw(*of.results(values))


def line_point(
    x: ArrayLike,
    t: ArrayLike,
    length: ArrayLike,
    v: ArrayLike,
    xi: Numbers,
    *,
    radius: Numbers,
    young: Numbers,
    poisson: Numbers,
    resistivity: Numbers,
    weight: Numbers,
    angle: Numbers = 0.0,
    film: Numbers = 0.0,
    hardness: Numbers | None = None,
    eps_l: Numbers | None = None,
    axis: Axis = "hermite",
    ends: ArrayLike = (False, False),
    normal_before: ArrayLike | None = None,
    start: Numbers | None = None,
    series_resistance: ArrayLike = (0.0, 0.0),
    rotation_vectors: ArrayLike | None = None,
    tangent: bool = True,
) -> LinePoint:
    """One point of the contact of two wires along a line: tangent and residual.

    The point is a fixed place of the unbarred element; its partner is the foot of the perpendicular on the barred one.
    A line is a sum of such points. For a contact that does not depend on the order of the wires, half of the weight
    goes to points of the one, half to points of the other wire.

    Parameters
    ----------
    x : array_like, shape (4, 3) or (n, 4, 3)
        Present nodal positions in the order barred 1, barred 2, 1, 2 [m]. With a leading axis n these are many points;
        every other argument then has that axis, too, or serves them all.
    t : array_like, shape (4, 3)
        Present unit tangents at the nodes, pointing from node 1 to node 2 of their element.
    length : array_like, shape (2,)
        Reference lengths of the barred and the unbarred element [m].
    v : array_like, shape (4,)
        Nodal voltages [V].
    xi : float
        Place in the unbarred element, from -1 to 1.
    radius, young, poisson, resistivity : float or array_like, shape (2,)
        Radii [m], Young's moduli [Pa], Poisson's ratios [-] and resistivities [ohm m] of the barred and the unbarred
        wire; one number serves both.
    weight : float
        Length of the unbarred wire for which the point stands [m]: weight of the quadrature times reference length.
    angle : float
        Angle of the law, whose sine is that of the lens of overlap; 0 for wires that lie side by side, also where their
        tangents enclose an angle, as in a strand. It is held fixed in `K`.
    film : float
        Resistance of a film on the strip times its area [ohm m^2]; 0: clean metal.
    hardness : float, optional
        Hardness H [Pa] of wires that yield: the strip that conducts then has the half width ``f/(2 H)``.
    eps_l : float, optional
        Penalty stiffness per length [N/m^2], ``f = eps_l |g|``, in place of the elastic law.
    axis : {"hermite", "linear"}
        Cubic axes between the nodes, or the straight ones of the chords (then rotations do not enter).
    ends : array_like of bool, shape (2,)
        Whether the barred axis ends at its first and at its second node: a foot that would lie beyond is held there.
    normal_before : array_like, shape (3,), optional
        Normal of the last converged state. With it the gap keeps its sign when the axes have passed each other.
    start : float, optional
        Foot of an earlier solution; without it the search begins at the nearest of some places in the element.
    series_resistance : array_like, shape (2,)
        ``rho L0/(4 A)`` of each element [ohm], see `contact_em`.
    rotation_vectors : array_like, shape (4, 3), optional
        Without it, rotational rows and columns refer to spins. With it, to additive changes of these vectors
        ``phi`` [rad], where ``t = exp(phi) t_start``.

    Returns
    -------
    LinePoint
        `K` (28, 28), `R` (28,), `active`, `xi_bar`, `xi`, `gap` [m], `normal` (3,), `force` [N], `spot_radius` [m],
        `resistance` [ohm], `current` [A], `voltage_gap` [V], `angle` [rad], `half_width` [m], `force_per_length`
        [N/m], `energy` [J], `quality`, `at_end`. Unknowns and signs are those of `contact_em`: {ub (12), u (12),
        Vb (2), V (2)}, internal minus external, Newton solves ``K dq = -R``. A point that is open, or whose foot lies
        beyond an element after which its wire goes on, has zeros and ``active=False``.

    Raises
    ------
    ValueError
        Invalid input; wires that overlap where the barred one is curved about the point (``M/|xb'|^2 <= 1/4``: the
        wires must be exchanged); a strip whose half width is more than a quarter of the smaller radius; axes that meet.

    Notes
    -----
    The residual is the gradient of the energy ``weight pi(-g)``, so that the mechanical block of `K` is symmetric with
    rotation vectors. The upper right block (24, 4) is zero. Formulas: ``docs/theory.md``, section 10;
    ``fortran/kernels/line_point.f90``, ``line_kinematics.f90`` and ``fortran/laws/line_law.f90``.

    Examples
    --------
    Two parallel copper wires of 4 mm overlap by 0.1 micrometres; 1 mV between them. A point in the middle, for all of it:

    >>> x = [[-2e-3, 0, 1.9999e-3], [2e-3, 0, 1.9999e-3], [-2e-3, 0, 0], [2e-3, 0, 0]]
    >>> t = [[1, 0, 0]] * 4
    >>> wires = dict(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
    >>> point = line_point(x, t, [4e-3, 4e-3], [1e-3, 1e-3, 0, 0], 0.0, weight=4e-3, **wires)
    >>> print(f"{point.force:.3f} N, {point.current:.3f} A")
    7.098 N, 58.484 A
    """
    of = Batch()
    take_geometry(of, x, t, length)
    of.array("v", v, (4,))
    place = of.array("xi", xi)
    checks.refuse("xi", place, (place < -1) | (place > 1), 0, "must be from -1 to 1, not {value:g}")
    of.positive("weight", weight)
    take_properties(of, radius, young, poisson, resistivity)
    _take_angle(of, angle)
    of.take("eps_l", np.zeros(()) if eps_l is None else checks.all_positive("eps_l", eps_l), 0)
    of.not_negative("film", film)
    of.take("hardness", np.zeros(()) if hardness is None else checks.all_positive("hardness", hardness), 0)
    of.array("ends", ends, (2,))
    of.array("normal_before", np.zeros(3) if normal_before is None else normal_before, (3,))
    of.array("start", 0.0 if start is None else start)
    of.not_negative("series_resistance", series_resistance, (2,))
    of.array("rotation_vectors", np.zeros((4, 3)) if rotation_vectors is None else rotation_vectors, (4, 3))
    columns = of.columns()
    k = of.room((28, 28), tangent)
    r, numbers, normal, info = of.call(
        [(28,), (12,), (3,), ()], _core.f2py_line.line_points,
        *columns, checks.choice("axis", axis, AXES), start is not None, rotation_vectors is not None, k, tangent,
    )  # fmt: skip
    of.raise_failures(info, _FAILURES, "point")
    places, weights = columns[4:6]
    xi_bar, gap, _, force, half_width, resistance, current, voltage_gap, per_length, energy, quality, at_end = numbers
    spot_radius = np.sqrt(2 * half_width * weights / np.pi)
    fields: list[NDArray[Any]] = [
        r, info == _LINE_ACTIVE, xi_bar, places, gap, normal, force, spot_radius, resistance, current, voltage_gap,
        numbers[2], half_width, per_length, energy, quality, at_end != 0,
    ]  # fmt: skip
    return LinePoint(of.result(k) if tangent else of.empty(0, 0), *map(of.result, fields))


def _take_angle(of: Batch, angle: Numbers) -> None:
    """Take the angle of a law of lines."""
    result = of.array("angle", angle)
    checks.refuse(
        "angle", result, (result < 0) | (result > np.pi), 0, "must be from 0 (parallel wires) to pi, not {value:g}"
    )

"""The electric-mechanical contact element of two wires."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .axes import AXES, Axis
from .batch import Batch, Floats
from .laws import NormalLaw, normal_law_data
from .spot import SpotLaw, spot_law_data
from .wire_pair import Numbers, take_geometry, take_properties
from .yielding import single_yield_data

#: Spot laws of wires that yield
_YIELDED_SPOTS = ("hertz", "film", "sharvin", "constant", "table", "none")
_NO_ROTATIONS = np.zeros((4, 3))
# The constants of the kernel
_CONTACT_ACTIVE = 0
_FAILURES = {
    -1: "the wires overlap where their axes are parallel (crossing angle below 0.06 degrees); "
    "a point contact needs wires that cross",
    -2: "the wires overlap, but their closest points are not unique",
    -3: "the closest points were not found; do two nodes of an element coincide?",
    -6: "the spot of wires that yield has the area of a circle of more than half of the smaller radius: the wires would "
    "be compacted, for which the law does not hold",
}


class ContactEM(NamedTuple):
    """Result of the contact element; zero where the pair is not active, except places and gap.

    For many pairs each array has leading axes, and each number is an array of these axes.
    """

    #: Tangent (28, 28) in the order {ub (12), u (12), Vb (2), V (2)}; without entries, (0, 0), with `tangent=False`
    K: Floats
    #: Residual (28,): forces [N], moments [N m], currents leaving the nodes [A]
    R: Floats
    #: Whether the wires touch within both elements
    active: bool | NDArray[np.bool_]
    #: Place of the closest point in the barred element, which is [-1, 1]
    xi_bar: float | Floats
    #: Place of the closest point in the unbarred element
    xi: float | Floats
    #: Gap between the surfaces [m], negative in contact
    gap: float | Floats
    #: Unit normal (3,) from the unbarred to the barred axis
    normal: Floats
    #: Contact force [N], pushing the wires apart
    force: float | Floats
    #: Radius of the circle that has the area of the spot [m]; 0 for laws without a spot
    spot_radius: float | Floats
    #: Resistance of the spot [ohm]; 0 with `spot_law="none"`
    resistance: float | Floats
    #: Current from the barred to the unbarred beam [A]
    current: float | Floats
    #: Voltage across the spot, current times resistance [V]
    voltage_gap: float | Floats
    #: Angle between the axes at the closest points [rad], in (0, pi); 0 where these lie beyond the elements
    angle: float | Floats
    #: Larger half axis of the spot [m]; 0 for laws without a spot
    semi_major: float | Floats
    #: Smaller half axis of the spot [m]
    semi_minor: float | Floats
    #: On which side of the other a wire lies, 1 or -1, what the argument `side` remembers; 0 where the closest points
    #: lie beyond the elements
    side: int | NDArray[np.int_]
    #: Of wires that yield: largest force so far, this one included [N], what the argument `largest_force` remembers
    largest_force: float | Floats
    #: Of wires that yield: overlap at which they part in the dent of that force [m]
    dent: float | Floats


class ContactCoupling(NamedTuple):
    """Parts of the block of `K` that couples the voltages to the mechanics, (4, 24) each [A/m, A]."""

    #: The contact point moves along the wires: G N_V (Vb' dxib - V' dxi)
    K_me1: Floats
    #: The force changes the spot: (dI/dg) N_V dg
    K_me2: Floats
    #: The current enters at another place: I [-dxib/2, dxib/2, dxi/2, -dxi/2]
    K_me3: Floats
    #: The crossing angle changes the spot (not in the paper; 0 with its laws): (dI/dangle) N_V dangle
    K_me4: Floats
    #: The series resistances change along the wires (not in the paper; 0 without them)
    K_me5: Floats


def contact_em(
    x: ArrayLike,
    t: ArrayLike,
    length: ArrayLike,
    v: ArrayLike,
    *,
    radius: Numbers,
    young: Numbers,
    poisson: Numbers,
    resistivity: Numbers,
    eps_n: Numbers | None = None,
    axis: Axis = "hermite",
    spot_law: SpotLaw = "paper",
    rotation_vectors: ArrayLike | None = None,
    normal_law: NormalLaw = "linear",
    hardness: Numbers | None = None,
    film_resistivity: Numbers | None = None,
    resistance: Numbers | None = None,
    law_value: Numbers | None = None,
    normal_value: Numbers | None = None,
    table: ArrayLike | None = None,
    side: ArrayLike = 0,
    series_resistance: ArrayLike = (0.0, 0.0),
    ends: ArrayLike = (0, 0),
    yield_stress: Numbers | None = None,
    largest_force: Numbers = 0.0,
    keeps_spot: bool = False,
    tangent: bool = True,
) -> ContactEM:
    """Electric-mechanical beam-to-beam contact element: tangent and residual of a pair of elements, or of many.

    Parameters
    ----------
    x : array_like, shape (4, 3)
        Present nodal positions in the order barred 1, barred 2, 1, 2 [m]. This and all other arguments that hold numbers
        may have leading axes, see `litz.kernels`: ``x`` of shape (n, 4, 3) holds n pairs.
    t : array_like, shape (4, 3)
        Present unit tangents at the nodes, pointing from node 1 to node 2 of their element.
    length : array_like, shape (2,)
        Reference lengths of the barred and the unbarred element [m].
    v : array_like, shape (4,)
        Nodal voltages [V].
    radius, young, poisson, resistivity : float or array_like, shape (2,)
        Radii [m], Young's moduli [Pa], Poisson's ratios [-] and resistivities [ohm m] of the barred and the unbarred
        wire; one number serves both.
    eps_n : float
        Penalty stiffness [N/m] of `normal_law="linear"`.
    axis : {"hermite", "linear"}
        Cubic axes between the nodes, or the straight ones of the chords (then rotations do not enter).
    spot_law : {"paper", "hertz", "plastic", "film", "constant", "table", "sharvin", "cluster", "none"}
        From force to conductance, see `contact_spot`; "none": no current. The default is that of the paper, to be
        compared with it; "hertz" is the law of two wires.
    rotation_vectors : array_like, shape (4, 3), optional
        Without it, rotational rows and columns refer to spins. With it, to additive changes of these vectors
        ``phi`` [rad], where ``t = exp(phi) t_start``.
    normal_law : {"linear", "hertz"}
        From gap to force: ``F = eps_n |g|``, or the exact Hertz contact, which needs no `eps_n`.
    normal_value : float or array_like, optional
        The number, or the numbers, of a normal law that has no argument of its own.
    hardness, film_resistivity, resistance, law_value, table : optional
        Data of the spot law, see `contact_spot`. With `yield_stress`, `hardness` is that of the metal that yields.
    side : {0, 1, -1}
        Sign of ``(xb - x) . (x' x xb')`` when the contact began: `side` of the last converged state. With it the gap
        keeps its sign when the axes have passed through each other; 0, for a pair that was open, takes the present sign.
    series_resistance : array_like, shape (2,)
        ``rho L0/(4 A)`` of each element [ohm], added in series as ``s (1 - xi^2)``: what the linear voltage within an
        element misses of the current that enters it at ``xi``. 0: the paper's voltage.
    ends : array_like of int, shape (2,)
        End of the barred and of the unbarred element, -1 or 1, with which that wire touches, as a hemisphere; 0: it
        touches with its side. The place is held at the node, and its foot on the other wire moves (a kink of a wire is
        a round joint, too). Whether the distance is least there is not looked at.
    yield_stress : float, optional
        With `normal_law="hertz"`: yield stress of the softer metal [Pa]; the law of runs with ``YIELD``, see `normal_law`.
        Its spot laws are "hertz", "film" and "sharvin", which follow the yielded spot, "constant", "table" and "none".
    largest_force : float
        With `yield_stress`: `largest_force` of the last converged state [N], which has made the dent; 0: none.
    keeps_spot : bool
        With `yield_stress`: the spot stays as wide as the largest force has made it while the wires touch
        (``SPOT=LARGEST FORCE``).
    tangent : bool
        False: `R` and the results alone, in half of the time; `K` then has no entries.

    Returns
    -------
    ContactEM
        `K` (28, 28), `R` (28,), `active`, `xi_bar`, `xi`, `gap` [m], `normal` (3,), `force` [N], `spot_radius` [m],
        `resistance` [ohm], `current` [A], `voltage_gap` [V], `angle` [rad], `semi_major` [m], `semi_minor` [m], `side`,
        `largest_force` [N], `dent` [m].
        Unknowns in the order {ub (12), u (12), Vb (2), V (2)}, each node ``ux uy uz phix phiy phiz``. `R` is internal
        minus external; Newton solves ``K dq = -R``. A pair that is open, or whose closest points lie beyond the
        elements' ends, has zeros and ``active=False``.

    Raises
    ------
    ValueError
        Invalid input, axes that do not broadcast; wires that overlap where they are parallel, or whose closest points are
        not unique. Of many pairs the message names the first.

    Notes
    -----
    D. P. Boso, P. Litewka, B. A. Schrefler, P. Wriggers, Electric-mechanical beam-to-beam contact. The upper right
    block (24, 4) of `K` is zero. `contact_coupling` gives the parts of the lower left block. The formulas are in
    ``docs/theory.md`` and in ``fortran/kernels/contact_kinematics.f90``, ``contact_mechanics.f90``,
    ``contact_turning.f90`` and ``contact_electricity.f90``.

    Examples
    --------
    Two copper wires cross at 90 degrees and overlap by 2 micrometres; 1 mV between them:

    >>> x = [[-0.01, 0, 1.998e-3], [0.01, 0, 1.998e-3], [0, -0.01, 0], [0, 0.01, 0]]
    >>> t = [[1, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]]
    >>> wires = dict(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
    >>> contact = contact_em(x, t, [0.02, 0.02], [1e-3, 1e-3, 0, 0], **wires, normal_law="hertz", spot_law="hertz")
    >>> print(f"{contact.force:.3f} N, {contact.current:.3f} A")
    8.091 N, 5.261 A
    >>> contact.K.shape, contact.R.shape
    ((28, 28), (28,))

    A thousand pairs in one call, under voltages of their own:

    >>> many = contact_em([x] * 1000, t, [0.02, 0.02], np.linspace(0, 1e-3, 1000)[:, None] * [1, 1, 0, 0], **wires,
    ...                   normal_law="hertz", spot_law="hertz")
    >>> many.K.shape, f"{many.current[-1]:.3f} A"
    ((1000, 28, 28), '5.261 A')
    """
    of, (k, r, numbers, normal, _, info) = _contact_em(
        x, t, length, v, radius, young, poisson, resistivity, eps_n, axis, spot_law, rotation_vectors, normal_law,
        hardness, film_resistivity, resistance, law_value, normal_value, table, side, series_resistance, ends,
        yield_stress, largest_force, keeps_spot, tangent, False,
    )  # fmt: skip
    xi_bar, xi, gap, angle, force, semi_major, semi_minor, spot_resistance, current, voltage_gap, now_on, most, dent = (
        of.results(numbers)
    )
    return ContactEM(
        K=of.result(k) if tangent else of.empty(0, 0),
        R=of.result(r),
        active=of.result(info == _CONTACT_ACTIVE),
        xi_bar=xi_bar,
        xi=xi,
        gap=gap,
        normal=of.result(normal),
        force=force,
        spot_radius=of.result(np.sqrt(numbers[5] * numbers[6])),
        resistance=spot_resistance,
        current=current,
        voltage_gap=voltage_gap,
        angle=angle,
        semi_major=semi_major,
        semi_minor=semi_minor,
        side=now_on.astype(int) if of.shape else int(now_on),
        largest_force=most,
        dent=dent,
    )


def contact_coupling(
    x: ArrayLike,
    t: ArrayLike,
    length: ArrayLike,
    v: ArrayLike,
    *,
    radius: Numbers,
    young: Numbers,
    poisson: Numbers,
    resistivity: Numbers,
    eps_n: Numbers | None = None,
    axis: Axis = "hermite",
    spot_law: SpotLaw = "paper",
    normal_law: NormalLaw = "linear",
    hardness: Numbers | None = None,
    film_resistivity: Numbers | None = None,
    resistance: Numbers | None = None,
    law_value: Numbers | None = None,
    normal_value: Numbers | None = None,
    table: ArrayLike | None = None,
    side: ArrayLike = 0,
    series_resistance: ArrayLike = (0.0, 0.0),
    ends: ArrayLike = (0, 0),
    yield_stress: Numbers | None = None,
    largest_force: Numbers = 0.0,
    keeps_spot: bool = False,
) -> ContactCoupling:
    """Parts of the coupling block of `contact_em`, as the paper names them; their sum is ``K[24:, :24]`` (spins).

    Parameters
    ----------
    x, t, ..., keeps_spot
        All as for `contact_em`.

    Returns
    -------
    ContactCoupling
        `K_me1`, `K_me2`, `K_me3`, `K_me4`, `K_me5` (4, 24) each, zero where the pair is not active.

    Raises
    ------
    ValueError
        As `contact_em`.
    """
    of, (*_, parts, _) = _contact_em(
        x, t, length, v, radius, young, poisson, resistivity, eps_n, axis, spot_law, None, normal_law,
        hardness, film_resistivity, resistance, law_value, normal_value, table, side, series_resistance, ends,
        yield_stress, largest_force, keeps_spot, False, True,
    )  # fmt: skip
    return ContactCoupling(*(of.result(parts[:, :, i]) for i in range(parts.shape[2])))


def _contact_em(
    x: ArrayLike,
    t: ArrayLike,
    length: ArrayLike,
    v: ArrayLike,
    radius: Numbers,
    young: Numbers,
    poisson: Numbers,
    resistivity: Numbers,
    eps_n: Numbers | None,
    axis: Axis,
    spot_law: SpotLaw,
    rotation_vectors: ArrayLike | None,
    normal_law: NormalLaw,
    hardness: Numbers | None,
    film_resistivity: Numbers | None,
    resistance: Numbers | None,
    law_value: Numbers | None,
    normal_value: Numbers | None,
    table: ArrayLike | None,
    side: ArrayLike,
    series_resistance: ArrayLike,
    ends: ArrayLike,
    yield_stress: Numbers | None,
    largest_force: Numbers,
    keeps_spot: bool,
    tangent: bool,
    parts: bool,
) -> tuple[Batch, tuple[Any, ...]]:
    """Check the input, call the kernel, raise what it could not do."""
    of = Batch()
    take_geometry(of, x, t, length)
    of.array("v", v, (4,))
    take_properties(of, radius, young, poisson, resistivity)
    of.take("side", _signs("side", side, 0), 0)
    of.not_negative("series_resistance", series_resistance, (2,))
    of_ends = _signs("ends", ends, 1)
    of.take("ends", of_ends, 1)
    of.not_negative("largest_force", largest_force)
    of.array("rotation_vectors", _NO_ROTATIONS if rotation_vectors is None else rotation_vectors, (4, 3))
    normal_number, normal_data = normal_law_data(normal_law, eps_n=eps_n, normal_value=normal_value)
    of_yielding = single_yield_data(yield_stress, hardness, largest_force)
    if yield_stress is not None:
        _check_yielding(normal_law, spot_law, of_ends, of_yielding)
    spot_number, spot_data = spot_law_data(
        "spot_law",
        spot_law,
        hardness=hardness if yield_stress is None else None,
        film_resistivity=film_resistivity,
        resistance=resistance,
        law_value=law_value,
        table=table,
    )
    of.share("data of the normal law", normal_data, 1)
    of.share("yield_stress and hardness", of_yielding, 1)
    of.share("data of the spot law", spot_data, 1)
    normal_column, yield_column, spot_column = of.shared_columns()
    k = of.room((28, 28), tangent)
    result = of.call(
        [(28,), (13,), (3,), (4, 24, 5), ()], _core.f2py_contact_em.contact_em,
        *of.columns(), normal_number, normal_column, yield_column, keeps_spot, spot_number, spot_column,
        checks.choice("axis", axis, AXES), rotation_vectors is not None, k, tangent, of.n if parts else 0,
    )  # fmt: skip
    of.raise_failures(result[-1], _FAILURES, "pair")
    return of, (k, *result)


def _signs(name: str, value: ArrayLike, own_axes: int) -> NDArray[np.int32]:
    """Numbers of which each is -1, 0 or 1, after checking them; of `own_axes` the last has two."""
    signs = checks.leading(name, value, (2,) * own_axes)
    bad = (signs != -1) & (signs != 0) & (signs != 1)
    checks.refuse(name, signs, bad, own_axes, f"must be -1, 0 or 1{' each' * own_axes}, not {{value:g}}")
    return signs.astype(np.int32)


def _check_yielding(normal_law: NormalLaw, spot_law: SpotLaw, ends: NDArray[np.int32], of_yielding: Floats) -> None:
    """Refuse what does not go with wires that yield."""
    if normal_law != "hertz":
        raise ValueError(f'yield_stress belongs to normal_law="hertz", not "{normal_law}"')
    if spot_law not in _YIELDED_SPOTS:
        raise ValueError(
            f'spot_law="{spot_law}" makes a spot of its own; with yield_stress it is one of {", ".join(_YIELDED_SPOTS)}'
        )
    if ends.any():
        raise ValueError("yield_stress: at the ends of wires the law of metal that yields is not known")
    stress, hardness = of_yielding.reshape(-1, 2).T
    onset = _core.f2py_yielding.largest_onset(stress)
    soft = (hardness > 0) & (hardness <= onset)
    if soft.any():
        first = int(np.argmax(soft))
        raise ValueError(
            f"hardness must be greater than the pressure at which crossed wires with a yield stress of {stress[first]:g} "
            f"Pa begin to yield, up to {onset[first]:g} Pa, not {hardness[first]:g} Pa"
        )

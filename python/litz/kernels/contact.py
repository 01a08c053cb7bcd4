"""The electric-mechanical contact element of two wires."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .axes import AXES, Axis
from .laws import NormalLaw, normal_law_data
from .spot import SpotLaw, spot_law_data
from .wire_pair import Numbers, geometry, properties
from .yielding import single_yield_data

#: Spot laws of wires that yield
_YIELDED_SPOTS = ("hertz", "film", "sharvin", "constant", "table", "none")
# The constants of the kernel
_CONTACT_ACTIVE, _CONTACT_OPEN, _CONTACT_BEYOND = 0, 1, 2
_FAILURES = {
    -1: "the wires overlap where their axes are parallel (crossing angle below 0.06 degrees); "
    "a point contact needs wires that cross",
    -2: "the wires overlap, but their closest points are not unique",
    -3: "the closest points were not found; do two nodes of an element coincide?",
    -6: "the spot of wires that yield has the area of a circle of more than half of the smaller radius: the wires would "
    "be compacted, for which the law does not hold",
}


class ContactEM(NamedTuple):
    """Result of the contact element; zero where the pair is not active, except places and gap."""

    #: Tangent (28, 28) in the order {ub (12), u (12), Vb (2), V (2)}
    K: NDArray[np.float64]
    #: Residual (28,): forces [N], moments [N m], currents leaving the nodes [A]
    R: NDArray[np.float64]
    #: Whether the wires touch within both elements
    active: bool
    #: Place of the closest point in the barred element, which is [-1, 1]
    xi_bar: float
    #: Place of the closest point in the unbarred element
    xi: float
    #: Gap between the surfaces [m], negative in contact
    gap: float
    #: Unit normal (3,) from the unbarred to the barred axis
    normal: NDArray[np.float64]
    #: Contact force [N], pushing the wires apart
    force: float
    #: Radius of the circle that has the area of the spot [m]; 0 for laws without a spot
    spot_radius: float
    #: Resistance of the spot [ohm]; 0 with `spot_law="none"`
    resistance: float
    #: Current from the barred to the unbarred beam [A]
    current: float
    #: Voltage across the spot, current times resistance [V]
    voltage_gap: float
    #: Angle between the axes at the closest points [rad], in (0, pi); 0 where these lie beyond the elements
    angle: float
    #: Larger half axis of the spot [m]; 0 for laws without a spot
    semi_major: float
    #: Smaller half axis of the spot [m]
    semi_minor: float
    #: On which side of the other a wire lies, 1 or -1, what the argument `side` remembers; 0 where the closest points
    #: lie beyond the elements
    side: int
    #: Of wires that yield: largest force so far, this one included [N], what the argument `largest_force` remembers
    largest_force: float
    #: Of wires that yield: overlap at which they part in the dent of that force [m]
    dent: float


class ContactCoupling(NamedTuple):
    """Parts of the block of `K` that couples the voltages to the mechanics, (4, 24) each [A/m, A]."""

    #: The contact point moves along the wires: G N_V (Vb' dxib - V' dxi)
    K_me1: NDArray[np.float64]
    #: The force changes the spot: (dI/dg) N_V dg
    K_me2: NDArray[np.float64]
    #: The current enters at another place: I [-dxib/2, dxib/2, dxi/2, -dxi/2]
    K_me3: NDArray[np.float64]
    #: The crossing angle changes the spot (not in the paper; 0 with its laws): (dI/dangle) N_V dangle
    K_me4: NDArray[np.float64]
    #: The series resistances change along the wires (not in the paper; 0 without them)
    K_me5: NDArray[np.float64]


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
    eps_n: float | None = None,
    axis: Axis = "hermite",
    spot_law: SpotLaw = "paper",
    rotation_vectors: ArrayLike | None = None,
    normal_law: NormalLaw = "linear",
    hardness: float | None = None,
    film_resistivity: float | None = None,
    resistance: float | None = None,
    law_value: Numbers | None = None,
    normal_value: Numbers | None = None,
    table: ArrayLike | None = None,
    side: Literal[-1, 0, 1] = 0,
    series_resistance: ArrayLike = (0.0, 0.0),
    ends: ArrayLike = (0, 0),
    yield_stress: float | None = None,
    largest_force: float = 0.0,
    keeps_spot: bool = False,
) -> ContactEM:
    """Electric-mechanical beam-to-beam contact element: tangent and residual of one pair of elements.

    Parameters
    ----------
    x : array_like, shape (4, 3)
        Present nodal positions in the order barred 1, barred 2, 1, 2 [m].
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
    spot_law : {"paper", "hertz", "plastic", "film", "constant", "table", "none"}
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
        Invalid input; wires that overlap where they are parallel, or whose closest points are not unique.

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
    """
    k, r, numbers, normal, _, info = _contact_em(
        x, t, length, v, radius, young, poisson, resistivity, eps_n, axis, spot_law, rotation_vectors, normal_law,
        hardness, film_resistivity, resistance, law_value, normal_value, table, side, series_resistance, ends,
        yield_stress, largest_force, keeps_spot,
    )  # fmt: skip
    xi_bar, xi, gap, angle, force, semi_major, semi_minor, spot_resistance, current, voltage_gap, now_on, most, dent = (
        map(float, numbers)
    )
    return ContactEM(
        K=k,
        R=r,
        active=info == _CONTACT_ACTIVE,
        xi_bar=xi_bar,
        xi=xi,
        gap=gap,
        normal=normal,
        force=force,
        spot_radius=float(np.sqrt(semi_major * semi_minor)),
        resistance=spot_resistance,
        current=current,
        voltage_gap=voltage_gap,
        angle=angle,
        semi_major=semi_major,
        semi_minor=semi_minor,
        side=int(now_on),
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
    eps_n: float | None = None,
    axis: Axis = "hermite",
    spot_law: SpotLaw = "paper",
    normal_law: NormalLaw = "linear",
    hardness: float | None = None,
    film_resistivity: float | None = None,
    resistance: float | None = None,
    law_value: Numbers | None = None,
    normal_value: Numbers | None = None,
    table: ArrayLike | None = None,
    side: Literal[-1, 0, 1] = 0,
    series_resistance: ArrayLike = (0.0, 0.0),
    ends: ArrayLike = (0, 0),
    yield_stress: float | None = None,
    largest_force: float = 0.0,
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
    parts = _contact_em(
        x, t, length, v, radius, young, poisson, resistivity, eps_n, axis, spot_law, None, normal_law,
        hardness, film_resistivity, resistance, law_value, normal_value, table, side, series_resistance, ends,
        yield_stress, largest_force, keeps_spot,
    )[4]  # fmt: skip
    return ContactCoupling(*np.moveaxis(parts, -1, 0))


def _contact_em(
    x: ArrayLike,
    t: ArrayLike,
    length: ArrayLike,
    v: ArrayLike,
    radius: Numbers,
    young: Numbers,
    poisson: Numbers,
    resistivity: Numbers,
    eps_n: float | None,
    axis: Axis,
    spot_law: SpotLaw,
    rotation_vectors: ArrayLike | None,
    normal_law: NormalLaw,
    hardness: float | None,
    film_resistivity: float | None,
    resistance: float | None,
    law_value: Numbers | None,
    normal_value: Numbers | None,
    table: ArrayLike | None,
    side: int,
    series_resistance: ArrayLike,
    ends: ArrayLike,
    yield_stress: float | None,
    largest_force: float,
    keeps_spot: bool,
) -> tuple[Any, ...]:
    """Check the input, call the kernel, raise what it could not do."""
    places = geometry(x, t, length)
    voltages = checks.array("v", v, (4,))
    of_wires = properties(radius, young, poisson, resistivity)
    normal_number, normal_data = normal_law_data(normal_law, eps_n=eps_n, normal_value=normal_value)
    of_yielding = single_yield_data(yield_stress, hardness, largest_force)
    if yield_stress is not None:
        _check_yielding(normal_law, spot_law, np.asarray(ends), of_yielding)
    spot_number, spot_data = spot_law_data(
        "spot_law",
        spot_law,
        hardness=hardness if yield_stress is None else None,
        film_resistivity=film_resistivity,
        resistance=resistance,
        law_value=law_value,
        table=table,
    )
    if side not in (-1, 0, 1):
        raise ValueError(f"side must be -1, 0 or 1, not {side!r}")
    series = checks.array("series_resistance", series_resistance, (2,))
    if (series < 0).any():
        raise ValueError(f"series_resistance must not be negative, but holds {series.min():g}")
    of_ends = checks.array("ends", ends, (2,))
    if not np.isin(of_ends, (-1, 0, 1)).all():
        raise ValueError(f"ends must be -1, 0 or 1 each, not {ends!r}")
    has_vectors = rotation_vectors is not None
    vectors = (
        np.zeros((4, 3)) if rotation_vectors is None else checks.array("rotation_vectors", rotation_vectors, (4, 3))
    )
    result = _core.f2py_contact.contact_em(
        *places, voltages, *of_wires, normal_number, normal_data, *of_yielding, keeps_spot, spot_number, spot_data,
        checks.choice("axis", axis, AXES), side, of_ends.astype(int), series, has_vectors, vectors.T,
    )  # fmt: skip
    if result[-1] < 0:
        raise ValueError(_FAILURES[result[-1]])
    return result


def _check_yielding(
    normal_law: NormalLaw, spot_law: SpotLaw, ends: NDArray[np.float64], of_yielding: tuple[float, ...]
) -> None:
    """Refuse what does not go with wires that yield."""
    if normal_law != "hertz":
        raise ValueError(f'yield_stress belongs to normal_law="hertz", not "{normal_law}"')
    if spot_law not in _YIELDED_SPOTS:
        raise ValueError(
            f'spot_law="{spot_law}" makes a spot of its own; with yield_stress it is one of {", ".join(_YIELDED_SPOTS)}'
        )
    if ends.any():
        raise ValueError("yield_stress: at the ends of wires the law of metal that yields is not known")
    yield_stress, hardness, _ = of_yielding
    onset = _core.f2py_yielding.largest_onset(yield_stress)
    if 0 < hardness <= onset:
        raise ValueError(
            f"hardness must be greater than the pressure at which crossed wires with a yield stress of {yield_stress:g} "
            f"Pa begin to yield, up to {onset:g} Pa, not {hardness:g} Pa"
        )

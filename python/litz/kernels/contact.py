"""The electric-mechanical contact of two wires: closest points, contact spot, and the contact element."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from litz import _core
from litz.kernels import checks

Axis = Literal["linear", "hermite"]
NormalLaw = Literal["linear", "hertz"]
#: "none", or the name of a law of `*GAP ELECTRICAL CONDUCTANCE` in lower case
SpotLaw = str
Status = Literal["inside", "beyond", "parallel", "not_unique", "not_converged"]

# The constants of fortran/base/laws.f90 and of the kernels
_AXES = {"linear": 1, "hermite": 2}
_NORMAL_LAWS = {"linear": 1, "hertz": 2}
_SPOT_NAMES, _SPOT_VALUES = (
    [name.decode().strip().lower() for name in names] for names in _core.f2py_contact.spot_law_names()
)
_SPOT_LAWS = {"none": 0} | {name: number for number, name in enumerate(_SPOT_NAMES, start=1) if name}
_STATUS: dict[int, Status] = {0: "inside", 1: "beyond", -1: "parallel", -2: "not_unique", -3: "not_converged"}
_CONTACT_ACTIVE, _CONTACT_OPEN, _CONTACT_BEYOND = 0, 1, 2
_FAILURES = {
    -1: "the wires overlap where their axes are parallel (crossing angle below 0.06 degrees); "
    "a point contact needs wires that cross",
    -2: "the wires overlap, but their closest points are not unique",
    -3: "the closest points were not found; do two nodes of an element coincide?",
}
#: The one number of each spot law that has one: an argument of its own, or `law_value`
_LAW_VALUES = {
    **{name: "law_value" for name, value in zip(_SPOT_NAMES, _SPOT_VALUES, strict=True) if value},
    "plastic": "hardness",
    "film": "film_resistivity",
    "constant": "resistance",
}

Numbers = float | ArrayLike


class ContactSpot(NamedTuple):
    """Contact spot under a given force."""

    #: Larger half axis of the spot [m]; 0 for laws without a spot (constant, table)
    semi_major: float
    #: Smaller half axis [m]
    semi_minor: float
    #: Elastic approach of the two axes [m]; 0 for laws without one (plastic, constant, table)
    approach: float
    #: Conductance of the spot [S]
    conductance: float
    #: Derivative of the conductance by the force at fixed angle [S/N]
    dconductance_dforce: float
    #: Derivative of the conductance by the angle at fixed force [S/rad]
    dconductance_dangle: float


class ClosestPoints(NamedTuple):
    """Closest points of two element axes."""

    #: Place in the barred element, which is [-1, 1]
    xi_bar: float
    #: Place in the unbarred element
    xi: float
    #: "inside", "beyond" an end, "parallel", "not_unique" or "not_converged"
    status: Status


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


def contact_spot(
    force: float,
    *,
    radius: Numbers,
    young: Numbers,
    poisson: Numbers,
    resistivity: Numbers,
    angle: float,
    law: SpotLaw = "hertz",
    hardness: float | None = None,
    film_resistivity: float | None = None,
    resistance: float | None = None,
    law_value: float | None = None,
    table: ArrayLike | None = None,
) -> ContactSpot:
    """Spot and conductance of two round wires pressed together.

    Parameters
    ----------
    force : float
        Contact force [N]. Without a positive force there is no spot: all results are 0, although the slope of the
        conductance over the force is infinite there for most laws.
    radius, young, poisson, resistivity : float or array_like, shape (2,)
        Radii [m], Young's moduli [Pa], Poisson's ratios [-] and resistivities [ohm m] of the barred and the unbarred
        wire; one number serves both.
    angle : float
        Angle between the axes [rad], in (0, pi).
    law : {"hertz", "paper", "plastic", "film", "constant", "table", "none"}
        - "hertz": exact ellipse with Holm's constriction resistance ``(rho1 + rho2) K(m)/(2 pi a)``;
        - "paper": circle of Hertz's contact of two spheres, ``r* = r rb/(r + rb)``. At 90 degrees the spot of equal
          wires is 21 % too small and the resistance 26 % too large;
        - "plastic": circle with ``F = pi a^2 hardness``;
        - "film": as "hertz", with ``film_resistivity/(pi a b)`` in series;
        - "constant": `resistance` under any positive force;
        - "table": through the pairs of `table`.
    hardness : float, optional
        For "plastic" [Pa].
    film_resistivity : float, optional
        For "film" [ohm m^2].
    resistance : float, optional
        For "constant" [ohm].
    law_value : float, optional
        The number of a law that has one without a name among these arguments.
    table : array_like, shape (2, n), optional
        For "table": forces [N], ascending, and resistances [ohm]. Interpolated smoothly and monotonically in
        logarithms; beyond its ends the power law of the end slope continues; a single pair is a constant.

    Returns
    -------
    ContactSpot
        `semi_major`, `semi_minor`, `approach`, `conductance`, `dconductance_dforce`, `dconductance_dangle`.

    Raises
    ------
    ValueError
        A value that is missing, not finite or out of its range; an unknown law.

    Notes
    -----
    K. L. Johnson, Contact Mechanics, ch. 4; R. Holm, Electric Contacts. The elastic contact and the conductance obey
    Barber's identity ``G = 2/(E* (rho1 + rho2)) dF/dapproach`` (Proc. R. Soc. A 459 (2003) 53-66). The formulas are in
    ``fortran/kernels/hertz.f90`` and ``contact_spot.f90``.

    Examples
    --------
    >>> from math import pi
    >>> wires = dict(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
    >>> spot = contact_spot(1.0, angle=pi / 2, **wires)
    >>> print(f"{spot.semi_major:.4g} m, {1 / spot.conductance:.4g} ohm")
    2.228e-05 m, 0.0003816 ohm
    """
    properties = _properties(radius, young, poisson, resistivity)
    law_number, law_value, force_table, resistance_table = _spot_law(
        "law",
        law,
        hardness=hardness,
        film_resistivity=film_resistivity,
        resistance=resistance,
        law_value=law_value,
        table=table,
    )
    angle = checks.number("angle", angle)
    if not 0 < angle < np.pi:
        raise ValueError(f"angle must be between 0 and pi, not {angle:g} rad; parallel wires have no point contact")
    values, info = _core.f2py_contact.contact_spot(
        law_number, checks.number("force", force), *properties, angle, law_value, force_table, resistance_table
    )
    if info != 0:
        raise ValueError(f"angle is so close to parallel that the spot is infinitely long: {angle:g} rad")
    return ContactSpot(*map(float, values))


def closest_points(
    x: ArrayLike, t: ArrayLike, length: ArrayLike, *, axis: Axis = "hermite", start: ArrayLike | None = None
) -> ClosestPoints:
    """Closest points of the axes of two elements.

    Parameters
    ----------
    x : array_like, shape (4, 3)
        Nodal positions in the order barred 1, barred 2, 1, 2 [m].
    t : array_like, shape (4, 3)
        Unit tangents at the nodes, pointing from node 1 to node 2 of their element; "linear" does not look at them.
    length : array_like, shape (2,)
        Reference lengths of the barred and the unbarred element [m].
    axis : {"hermite", "linear"}
        Cubic or straight axes between the nodes.
    start : array_like, shape (2,), optional
        Places (xi_bar, xi) to start from; the minimum of the distance next to it is found. Otherwise the closest pair
        of points within the elements is found.

    Returns
    -------
    ClosestPoints
        `xi_bar`, `xi` and `status`:

        - "inside": both points lie in their element, -1 <= xi <= 1 (to 1e-10);
        - "beyond": an axis continued beyond an end, up to abs(xi) = 1.5, comes closer than its own points do;
        - "parallel": the tangents there enclose less than 0.06 degrees; the points are at the least distance;
        - "not_unique": other points are as close; the points are one choice;
        - "not_converged": an axis has no tangent, for example where its nodes coincide.

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite, tangents that are not of unit length, a length that is not positive.

    Notes
    -----
    The conditions are ``w . x' = 0`` and ``w . xb' = 0`` with ``w = xb - x``. The method is described in
    ``fortran/kernels/closest_points.f90``.
    """
    geometry = _geometry(x, t, length)
    begin = np.zeros(2) if start is None else checks.array("start", start, (2,))
    xi_bar, xi, status = _core.f2py_contact.closest_points(
        *geometry, checks.choice("axis", axis, _AXES), start is not None, begin
    )
    return ClosestPoints(xi_bar, xi, _STATUS[status])


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
    law_value: float | None = None,
    table: ArrayLike | None = None,
    side: Literal[-1, 0, 1] = 0,
    series_resistance: ArrayLike = (0.0, 0.0),
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
    hardness, film_resistivity, resistance, law_value, table : optional
        Data of the spot law, see `contact_spot`.
    side : {0, 1, -1}
        Sign of ``(xb - x) . (x' x xb')`` when the contact began: `side` of the last converged state. With it the gap
        keeps its sign when the axes have passed through each other; 0, for a pair that was open, takes the present sign.
    series_resistance : array_like, shape (2,)
        ``rho L0/(4 A)`` of each element [ohm], added in series as ``s (1 - xi^2)``: what the linear voltage within an
        element misses of the current that enters it at ``xi``. 0: the paper's voltage.

    Returns
    -------
    ContactEM
        `K` (28, 28), `R` (28,), `active`, `xi_bar`, `xi`, `gap` [m], `normal` (3,), `force` [N], `spot_radius` [m],
        `resistance` [ohm], `current` [A], `voltage_gap` [V], `angle` [rad], `semi_major` [m], `semi_minor` [m], `side`.
        Unknowns in the order {ub (12), u (12), Vb (2), V (2)}, each node ``ux uy uz phix phiy phiz``. `R` is internal
        minus external; Newton solves ``K dq = -R``. A pair that is open, or whose closest points lie beyond the
        elements' ends, has zeros and ``active=False``.

    Raises
    ------
    ValueError
        Bad input, in words; wires that overlap where they are parallel, or whose closest points are not unique.

    Notes
    -----
    D. P. Boso, P. Litewka, B. A. Schrefler, P. Wriggers, Electric-mechanical beam-to-beam contact. The upper right
    block (24, 4) of `K` is zero. `contact_coupling` gives the parts of the lower left block. The formulas are in
    ``docs/theory.md`` and in ``fortran/kernels/contact_kinematics.f90``, ``contact_mechanics.f90`` and
    ``contact_electricity.f90``.

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
        hardness, film_resistivity, resistance, law_value, table, side, series_resistance,
    )  # fmt: skip
    xi_bar, xi, gap, angle, force, semi_major, semi_minor, spot_resistance, current, voltage_gap, now_on = map(
        float, numbers
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
    law_value: float | None = None,
    table: ArrayLike | None = None,
    side: Literal[-1, 0, 1] = 0,
    series_resistance: ArrayLike = (0.0, 0.0),
) -> ContactCoupling:
    """Parts of the coupling block of `contact_em`, as the paper names them; their sum is ``K[24:, :24]`` (spins).

    Parameters
    ----------
    x, t, ..., series_resistance
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
        hardness, film_resistivity, resistance, law_value, table, side, series_resistance,
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
    law_value: float | None,
    table: ArrayLike | None,
    side: int,
    series_resistance: ArrayLike,
) -> tuple[Any, ...]:
    """Check the input, call the kernel, raise what it could not do."""
    geometry = _geometry(x, t, length)
    voltages = checks.array("v", v, (4,))
    properties = _properties(radius, young, poisson, resistivity)
    normal_number = checks.choice("normal_law", normal_law, _NORMAL_LAWS)
    if normal_law == "linear":
        if eps_n is None:
            raise ValueError('normal_law="linear" needs eps_n, the penalty stiffness [N/m]')
        eps_n = checks.positive("eps_n", eps_n)
    elif eps_n is not None:
        raise ValueError('eps_n belongs to normal_law="linear"; the Hertz law has no penalty')
    spot_number, law_value, force_table, resistance_table = _spot_law(
        "spot_law",
        spot_law,
        hardness=hardness,
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
    has_vectors = rotation_vectors is not None
    vectors = (
        np.zeros((4, 3)) if rotation_vectors is None else checks.array("rotation_vectors", rotation_vectors, (4, 3))
    )
    result = _core.f2py_contact.contact_em(
        *geometry, voltages, *properties, normal_number, eps_n or 0.0, spot_number, law_value, force_table,
        resistance_table, checks.choice("axis", axis, _AXES), side, series, has_vectors, vectors.T,
    )  # fmt: skip
    if result[-1] < 0:
        raise ValueError(_FAILURES[result[-1]])
    return result


def _geometry(x: ArrayLike, t: ArrayLike, length: ArrayLike) -> tuple[NDArray[np.float64], ...]:
    """Positions and tangents as columns, and lengths, after checking them."""
    positions = checks.array("x", x, (4, 3))
    tangents = checks.unit_vectors("t", t, (4, 3))
    return positions.T, tangents.T, checks.positive_pair("length", checks.array("length", length, (2,)))


def _properties(
    radius: Numbers, young: Numbers, poisson: Numbers, resistivity: Numbers
) -> tuple[NDArray[np.float64], ...]:
    """Pairs of properties, after checking them."""
    nu = checks.pair("poisson", poisson)
    if not ((nu > -1) & (nu < 0.5)).all():
        bad = nu[(nu <= -1) | (nu >= 0.5)][0]
        raise ValueError(f"poisson must be between -1 and 0.5, both excluded, but holds {bad:g}")
    return (
        checks.positive_pair("radius", radius),
        checks.positive_pair("young", young),
        nu,
        checks.positive_pair("resistivity", resistivity),
    )


def _spot_law(
    parameter: str, law: SpotLaw, *, table: ArrayLike | None, **values: float | None
) -> tuple[int, float, NDArray[np.float64], NDArray[np.float64]]:
    """Number of a spot law, its value and its table; refuses data that belong to another law."""
    number = checks.choice(parameter, law, _SPOT_LAWS)
    wanted = _LAW_VALUES.get(law)
    for name, value in values.items():
        if value is not None and name != wanted:
            owners = [f'"{key}"' for key, needed in _LAW_VALUES.items() if needed == name]
            owner = f"the spot law {owners[0]}" if owners else "other laws"
            raise ValueError(f'{name} belongs to {owner}, not to "{law}"')
    if table is not None and law != "table":
        raise ValueError(f'table belongs to the spot law "table", not to "{law}"')
    law_value = 0.0
    if wanted is not None:
        value = values[wanted]
        if value is None:
            raise ValueError(f'the spot law "{law}" needs {wanted}')
        law_value = checks.positive(wanted, value)
    forces, resistances = _table(table) if law == "table" else (np.ones(1), np.ones(1))
    return number, law_value, forces, resistances


def _table(table: ArrayLike | None) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Forces and resistances of a table, after checking them."""
    if table is None:
        raise ValueError('the spot law "table" needs table: forces [N] and resistances [ohm], shape (2, n)')
    shape = np.shape(table)
    if len(shape) != 2 or shape[0] != 2 or shape[1] < 1:
        raise ValueError(f"table must have shape (2, n), forces and resistances, not {shape}")
    forces, resistances = checks.array("table", table, shape)
    if not ((forces > 0).all() and (resistances > 0).all()):
        raise ValueError("table must hold positive forces and resistances only")
    if (np.diff(forces) <= 0).any():
        raise ValueError("the forces of table must ascend")
    return forces, resistances

"""Heat: along wires, from their sides, into them, and through the spots in which they touch."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .wire_pair import Numbers

#: Sommerfeld's value of the Lorenz number [V^2/K^2]
LORENZ = 2.44e-8
#: Stefan-Boltzmann constant [W/(m^2 K^4)]
STEFAN_BOLTZMANN = 5.670374419e-8


class SpotHeat(NamedTuple):
    """Heat and temperatures of a contact spot."""

    #: To the bulk of wire 1 and of wire 2 (2,) [W]
    heat: NDArray[np.float64]
    #: Highest temperature of spot and bulks [K]
    hottest: float
    #: Derivatives of `heat` by voltage, conductance and the two temperatures (2, 4) [W/V, W/S, W/K]
    dheat: NDArray[np.float64]
    #: The same of `hottest` (4,) [K/V, K/S, 1]
    dhottest: NDArray[np.float64]


class HotConductance(NamedTuple):
    """What the heat of a spot does to its own conductance."""

    #: Conductance over that at the mean temperature of the bulks
    ratio: float
    #: Derivatives by voltage and the two temperatures (3,) [1/V, 1/K]
    dratio: NDArray[np.float64]


class ConductorHeat(NamedTuple):
    """Result of a conductor of current and heat; the unknowns are V1, V2, T1, T2."""

    #: Tangent (4, 4) [S, A/K, A, W/K]
    K: NDArray[np.float64]
    #: Currents, then heat, that leave the nodes (4,) [A, W]
    R: NDArray[np.float64]
    #: Current from the first to the second node [A]
    current: float
    #: Joule heat [W]
    heat: float
    #: Heat through the film to the surroundings [W]
    film_heat: float


class WireRadiation(NamedTuple):
    """What a wire radiates."""

    #: Tangent over the temperatures of the nodes (2, 2) [W/K]; diagonal
    K: NDArray[np.float64]
    #: Heat that leaves the nodes (2,) [W]
    R: NDArray[np.float64]


class HeatCapacity(NamedTuple):
    """What a wire stores over a time increment."""

    #: Tangent over the temperatures of the nodes (2, 2) [W/K]; diagonal
    K: NDArray[np.float64]
    #: Heat that the nodes take up (2,) [W]
    R: NDArray[np.float64]


def spot_heat(
    voltage: float,
    temperature: ArrayLike,
    *,
    current: float | None = None,
    lorenz: Numbers = LORENZ,
    conductance: float | None = None,
    resistivity: Numbers = 1.0,
    heat_conductance: float | Sequence[float | None] | None = None,
    film_resistance: float = 0.0,
    film_heat_conductance: float | None = None,
) -> SpotHeat:
    """Heat that a contact spot gives to its two wires, and its highest temperature.

    Parameters
    ----------
    voltage : float
        Between the bulks of the wires, V [V].
    temperature : array_like, shape (2,)
        Of the bulks of wire 1 and wire 2, from absolute zero [K].
    current : float, optional
        Through the spot [A], of the sign of the voltage. Without a voltage it says nothing about the spot: then, or in
        its place, give `conductance`.
    lorenz : float or array_like, shape (2,)
        Lorenz numbers L [V^2/K^2] of Wiedemann-Franz metals, whose product of heat conductivity and resistivity is L T.
    conductance : float, optional
        Of the spot, with its film, G [S]; 0: no current passes.
    resistivity : float or array_like, shape (2,)
        Of the two wires; only the ratio counts, by which they share the voltage of the constriction. One number serves both.
    heat_conductance : float or sequence of 2, optional
        Of the constriction in a wire of constant heat conductivity [W/K], in place of `lorenz`: ``4 a lambda`` of a round
        spot of the radius a. None in the place of a wire: it is a metal. Wires without a current between them need both.
    film_resistance : float
        Of a film between the faces [ohm]; it is part of V/I.
    film_heat_conductance : float, optional
        Of the film [W/K]; without it, the faces have one temperature.

    Returns
    -------
    SpotHeat
        `heat` (2,), positive into the wires, with the sum V I; `hottest`; `dheat` (2, 4) and `dhottest` (4,) by V at
        fixed G, by G at fixed V and film, and by the temperatures.

    Raises
    ------
    ValueError
        A number that is missing, not finite or out of its range; voltage and current of opposite signs.

    Notes
    -----
    Half of V I goes to either wire, of one metal and at any temperatures; what flows from the warmer to the colder one,
    ``G L (T1 + T2)/2`` per kelvin, comes on top. ``docs/theory.md``, section 13; ``fortran/laws/spot_heat.f90``.

    Examples
    --------
    The voltage at which a spot in copper at 20 degrees Celsius begins to soften, at 190:

    >>> spot = spot_heat(0.112, [293, 293], current=10.0)
    >>> print(f"{spot.hottest:.0f} K, {spot.heat[0]:.2f} W")
    463 K, 0.56 W
    """
    voltage = checks.number("voltage", voltage)
    bulk = _temperatures("temperature", temperature, 0.0)
    if not (bulk > 0).all():
        raise ValueError(f"temperature must be greater than 0 K, but holds {bulk.min():g}")
    g = _conductance(voltage, current, conductance)
    given = _heat_conductances(heat_conductance)
    is_metal = np.isnan(given)
    if is_metal.any() and g == 0:
        raise ValueError(
            "wires without a current between them need heat_conductance: lorenz relates heat to the current"
        )
    film_resistance = not_negative("film_resistance", film_resistance)
    if g * film_resistance >= 1:
        raise ValueError(f"film_resistance must be less than V/I, {1 / g:g} ohm, of which it is a part")
    film = 0.0 if film_heat_conductance is None else 1 / checks.positive("film_heat_conductance", film_heat_conductance)
    heat, hottest, dheat, dhottest, info = _core.f2py_heat.spot_heat(
        voltage,
        g,
        bulk,
        checks.positive_pair("resistivity", resistivity),
        np.where(is_metal, checks.positive_pair("lorenz", lorenz), 0.0),
        np.where(is_metal, 0.0, given),
        film_resistance,
        film,
    )
    if info != 0:
        raise ValueError("these numbers are too large or too small for the heat of a spot")
    return SpotHeat(heat, float(hottest), dheat, dhottest)


def hot_conductance(voltage: float, temperature: ArrayLike, *, lorenz: float = LORENZ) -> HotConductance:
    """How much less a spot conducts because its own heat raises its resistivity.

    Parameters
    ----------
    voltage : float
        Between the bulks of the wires [V].
    temperature : array_like, shape (2,)
        Of the bulks, from absolute zero [K].
    lorenz : float
        Lorenz number L [V^2/K^2] of a metal of constant heat conductivity, ``resistivity = L T/conductivity``.

    Returns
    -------
    HotConductance
        `ratio` to the conductance at the mean temperature, ``arctan(u)/u`` with ``u = V/(sqrt(L) (T1 + T2))``; `dratio` (3,).

    Examples
    --------
    At 0.2 V, half of the conductance of a cold spot is left; its middle is at 700 K:

    >>> ratio, _ = hot_conductance(0.2, [300, 300])
    >>> print(f"{ratio:.3f}")
    0.531
    """
    bulk = _temperatures("temperature", temperature, 0.0)
    if not (bulk > 0).all():
        raise ValueError(f"temperature must be greater than 0 K, but holds {bulk.min():g}")
    ratio, dratio = _core.f2py_heat.hot_conductance(
        checks.number("voltage", voltage), bulk, checks.positive("lorenz", lorenz)
    )
    return HotConductance(float(ratio), dratio)


def conductor_heat(
    v: ArrayLike,
    temperature: ArrayLike,
    length: float,
    *,
    area: float,
    conductivity: ArrayLike,
    resistivity: ArrayLike | None = None,
    heat_fraction: float = 1.0,
    film: float = 0.0,
    perimeter: float = 0.0,
    sink: float = 0.0,
) -> ConductorHeat:
    """Two-node conductor of current and heat, with a film on its side.

    Parameters
    ----------
    v, temperature : array_like, shape (2,)
        Potentials [V] and temperatures [K] of the nodes.
    length, area : float
        Reference length [m] and cross-section [m^2].
    conductivity, resistivity : float or array_like, shape (2, n)
        Heat conductivity [W/(m K)] and resistivity [ohm m]: a number, or temperatures, ascending, and values; linear
        between them, constant outside. They are those at the mean of the nodal temperatures. No resistivity: an insulator.
    heat_fraction : float
        Part of the electric power that becomes heat, from 0 to 1.
    film, perimeter, sink : float
        Heat transfer coefficient [W/(m^2 K)] of the side, perimeter of the cross-section [m], temperature of the
        surroundings [K].

    Returns
    -------
    ConductorHeat
        `K` (4, 4) and `R` (4,) over V1, V2, T1, T2, `current` from the first to the second node, `heat`, `film_heat`.

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite or out of its range.

    Notes
    -----
    Exact at the nodes for constant properties, with a film and with Joule heat, on any mesh; also for a conductivity that is
    linear in the temperature, without a film. ``docs/theory.md``, section 13; ``fortran/kernels/conductor_heat.f90``.

    Examples
    --------
    A wire with 20 mV from end to end, both at 300 K, is V^2/(8 lambda rho) warmer in the middle, where its halves are in balance:

    >>> metal = dict(area=1e-6, conductivity=400.0, resistivity=1.25e-8)
    >>> left = conductor_heat([0.02, 0.01], [300, 310], 0.05, **metal)
    >>> right = conductor_heat([0.01, 0.0], [310, 300], 0.05, **metal)
    >>> print(f"{left.heat:.3f} W of heat, {abs(left.R[3] + right.R[2]):.3f} W missing in the middle")
    0.160 W of heat, 0.000 W missing in the middle
    """
    fraction = checks.number("heat_fraction", heat_fraction)
    if not 0 <= fraction <= 1:
        raise ValueError(f"heat_fraction must be from 0 to 1, not {fraction:g}")
    rho = np.zeros((2, 1)) if resistivity is None else table("resistivity", resistivity)
    per_length = not_negative("film", film) * not_negative("perimeter", perimeter)
    k, r, flows = _core.f2py_heat.conductor_heat(
        checks.array("v", v, (2,)),
        checks.array("temperature", temperature, (2,)),
        checks.positive("length", length),
        checks.positive("area", area),
        rho,
        table("conductivity", conductivity),
        fraction,
        per_length,
        checks.number("sink", sink),
    )
    return ConductorHeat(k, r, *map(float, flows))


def wire_radiation(
    temperature: ArrayLike,
    length: float,
    *,
    perimeter: float,
    emissivity: float,
    surroundings: float,
    absolute_zero: float = 0.0,
    stefan_boltzmann: float = STEFAN_BOLTZMANN,
) -> WireRadiation:
    """Heat that a wire radiates from its side: ``emissivity sigma P l/2 (T^4 - Ts^4)`` from either node.

    Parameters
    ----------
    temperature : array_like, shape (2,)
        Of the nodes [K].
    length, perimeter : float
        Reference length and perimeter of the cross-section [m].
    emissivity, surroundings : float
        From 0 to 1; temperature of the surroundings [K].
    absolute_zero, stefan_boltzmann : float
        Absolute zero of the temperature scale, such as -273.15; Stefan-Boltzmann constant [W/(m^2 K^4)].

    Returns
    -------
    WireRadiation
        `K` (2, 2), diagonal, and `R` (2,), heat that leaves the nodes.

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite or out of its range, a temperature below absolute zero.

    Examples
    --------
    >>> wire_radiation([1000, 1000], 0.1, perimeter=3e-3, emissivity=1.0, surroundings=300).R.round(3)
    array([8.437, 8.437])
    """
    zero = checks.number("absolute_zero", absolute_zero)
    t = _temperatures("temperature", temperature, zero)
    around = checks.number("surroundings", surroundings)
    if around < zero:
        raise ValueError(f"surroundings must not be below absolute zero, {zero:g}, but is {around:g}")
    emissivity = checks.number("emissivity", emissivity)
    if not 0 <= emissivity <= 1:
        raise ValueError(f"emissivity must be from 0 to 1, not {emissivity:g}")
    coefficient = emissivity * checks.positive("stefan_boltzmann", stefan_boltzmann)
    coefficient *= checks.positive("perimeter", perimeter) * checks.positive("length", length)
    k, r, _ = _core.f2py_heat.wire_radiation(t, coefficient, around, zero)
    return WireRadiation(np.diag(k), r)


def heat_capacity(
    temperature: ArrayLike,
    before: ArrayLike,
    length: float,
    *,
    area: float,
    density: float,
    specific_heat: ArrayLike,
    time: float,
    latent_heat: ArrayLike = (),
) -> HeatCapacity:
    """Heat that the nodes of a wire take up per time: the difference of enthalpies, half of the element at either node.

    Parameters
    ----------
    temperature, before : array_like, shape (2,)
        Of the nodes now, and at the start of the increment [K].
    length, area, density : float
        Reference length [m], cross-section [m^2], density [kg/m^3].
    specific_heat : float or array_like, shape (2, n)
        [J/(kg K)]: a number, or temperatures, ascending, and values; linear between them, constant outside.
    time : float
        Time increment [s].
    latent_heat : array_like, shape (m, 3)
        Latent heat [J/kg], solidus and liquidus temperature [K] of each change of phase.

    Returns
    -------
    HeatCapacity
        `K` (2, 2), diagonal, and `R` (2,).

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite or out of its range.

    Examples
    --------
    >>> copper = dict(area=1e-6, density=8960, specific_heat=385.0)
    >>> heat_capacity([301, 300], [300, 300], 0.1, **copper, time=0.01).R
    array([17.248,  0.   ])
    """
    latent = np.asarray(latent_heat, dtype=float)
    latent = checks.array("latent_heat", latent, (len(latent), 3)) if latent.size else np.empty((0, 3))
    if not ((latent[:, 0] >= 0).all() and (latent[:, 2] > latent[:, 1]).all()):
        raise ValueError("latent_heat must not be negative, and the liquidus must be above the solidus")
    mass = checks.positive("density", density) * checks.positive("area", area) * checks.positive("length", length)
    k, r = _core.f2py_heat.heat_capacity(
        checks.array("temperature", temperature, (2,)),
        checks.array("before", before, (2,)),
        mass / checks.positive("time", time),
        table("specific_heat", specific_heat),
        latent.T,
    )
    return HeatCapacity(np.diag(k), r)


def _conductance(voltage: float, current: float | None, conductance: float | None) -> float:
    """Conductance of a spot that is described by its current or directly."""
    if conductance is None and current is None:
        raise ValueError("current or conductance is needed")
    if conductance is None:
        i = checks.number("current", current)  # type: ignore[arg-type]
        if voltage == 0:
            raise ValueError("without a voltage, the current does not tell what conducts: conductance is needed")
        if voltage * i < 0:
            raise ValueError(f"current must have the sign of the voltage, {voltage:g} V, but is {i:g} A")
        return i / voltage
    g = not_negative("conductance", conductance)
    if current is not None and not np.isclose(checks.number("current", current), g * voltage, rtol=1e-6, atol=0):
        raise ValueError(f"current and conductance contradict each other: G V is {g * voltage:g} A")
    return g


def _heat_conductances(value: float | Sequence[float | None] | None) -> NDArray[np.float64]:
    """Heat conductances of two constrictions, NaN for that of a metal."""
    pair = list(value) if isinstance(value, Sequence | np.ndarray) else [value, value]
    if len(pair) != 2:
        raise ValueError(f"heat_conductance must be a number or two, not {len(pair)}")
    return np.array([np.nan if one is None else checks.positive("heat_conductance", one) for one in pair])


def _temperatures(name: str, value: ArrayLike, absolute_zero: float) -> NDArray[np.float64]:
    """Temperatures of two nodes or wires, not below absolute zero."""
    result = checks.array(name, value, (2,))
    if (result < absolute_zero).any():
        raise ValueError(f"{name} must not be below absolute zero, {absolute_zero:g}, but holds {result.min():g}")
    return result


def not_negative(name: str, value: float) -> float:
    """The number, after checking it."""
    result = checks.number(name, value)
    if result < 0:
        raise ValueError(f"{name} must not be negative, but is {result:g}")
    return result


def table(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """A property over temperature (2, n), or one number as a table, after checking it."""
    if np.ndim(value) == 0:
        return np.array([[0.0], [checks.positive(name, value)]])  # type: ignore[arg-type]
    shape = np.shape(value)
    if len(shape) != 2 or shape[0] != 2 or shape[1] < 1:
        raise ValueError(f"{name} must be a number or have shape (2, n), temperatures and values, not {shape}")
    table = checks.array(name, value, shape)
    if (np.diff(table[0]) <= 0).any():
        raise ValueError(f"the temperatures of {name} must ascend")
    if (table[1] <= 0).any():
        raise ValueError(f"the values of {name} must be greater than 0, but hold {table[1].min():g}")
    return table

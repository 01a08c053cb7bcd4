"""Heat: along wires, from their sides, into them, and through the spots in which they touch.

Arguments that hold numbers may have leading axes, see `litz.kernels`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from . import checks
from .batch import Batch, Floats
from .wire_pair import Numbers

#: Sommerfeld's value of the Lorenz number [V^2/K^2]
LORENZ = 2.44e-8
#: Stefan-Boltzmann constant [W/(m^2 K^4)]
STEFAN_BOLTZMANN = 5.670374419e-8


class SpotHeat(NamedTuple):
    """Heat and temperatures of a contact spot."""

    #: To the bulk of wire 1 and of wire 2 (2,) [W]
    heat: Floats
    #: Highest temperature of spot and bulks [K]
    hottest: float | Floats
    #: Derivatives of `heat` by voltage, conductance and the two temperatures (2, 4) [W/V, W/S, W/K]
    dheat: Floats
    #: The same of `hottest` (4,) [K/V, K/S, 1]
    dhottest: Floats


class HotConductance(NamedTuple):
    """What the heat of a spot does to its own conductance."""

    #: Conductance over that at the mean temperature of the bulks
    ratio: float | Floats
    #: Derivatives by voltage and the two temperatures (3,) [1/V, 1/K]
    dratio: Floats


class ConductorHeat(NamedTuple):
    """Result of a conductor of current and heat; the unknowns are V1, V2, T1, T2."""

    #: Tangent (4, 4) [S, A/K, A, W/K]
    K: Floats
    #: Currents, then heat, that leave the nodes (4,) [A, W]
    R: Floats
    #: Current from the first to the second node [A]
    current: float | Floats
    #: Joule heat [W]
    heat: float | Floats
    #: Heat through the film to the surroundings [W]
    film_heat: float | Floats


class WireRadiation(NamedTuple):
    """What a wire radiates."""

    #: Tangent over the temperatures of the nodes (2, 2) [W/K]; diagonal
    K: Floats
    #: Heat that leaves the nodes (2,) [W]
    R: Floats


class HeatCapacity(NamedTuple):
    """What a wire stores over a time increment."""

    #: Tangent over the temperatures of the nodes (2, 2) [W/K]; diagonal
    K: Floats
    #: Heat that the nodes take up (2,) [W]
    R: Floats


def spot_heat(
    voltage: Numbers,
    temperature: ArrayLike,
    *,
    current: Numbers | None = None,
    lorenz: Numbers = LORENZ,
    conductance: Numbers | None = None,
    resistivity: Numbers = 1.0,
    heat_conductance: Numbers | Sequence[Numbers | None] | None = None,
    film_resistance: Numbers = 0.0,
    film_heat_conductance: Numbers | None = None,
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
    of = Batch()
    volts = of.array("voltage", voltage)
    g = _take_conductance(of, volts, current, conductance)
    _take_temperatures_above_zero(of, temperature)
    of.positive_pair("resistivity", resistivity)
    given = _heat_conductances(heat_conductance)
    is_metal = np.isnan(given)
    # without a current between them
    alone = np.broadcast_arrays(g == 0, is_metal.any(axis=-1))
    if (alone[0] & alone[1]).any():
        raise ValueError(
            "wires without a current between them need heat_conductance: lorenz relates heat to the current"
        )
    metal = checks.leading_pair("lorenz", lorenz)
    checks.refuse("lorenz", metal, metal <= 0, 1, "must be greater than 0, {but}")
    of.take("lorenz and heat_conductance", np.where(is_metal, metal, 0.0), 1)
    of.take("heat_conductance", np.where(is_metal, 0.0, given), 1)
    series = of.not_negative("film_resistance", film_resistance)
    too_large = g * series >= 1
    if too_large.any():
        limit = 1 / np.broadcast_to(g, too_large.shape)[too_large][0]
        raise ValueError(f"film_resistance must be less than V/I, {limit:g} ohm, of which it is a part")
    take_film(of, film_heat_conductance)
    heat, hottest, dheat, dhottest, info = of.call(
        [(2,), (), (2, 4), (4,), ()], _core.f2py_heat.spot_heat, *of.columns()
    )
    if (info != 0).any():
        raise ValueError(
            of.named(info != 0, "spot") + "these numbers are too large or too small for the heat of a spot"
        )
    return SpotHeat(*map(of.result, (heat, hottest, dheat, dhottest)))


def hot_conductance(voltage: Numbers, temperature: ArrayLike, *, lorenz: Numbers = LORENZ) -> HotConductance:
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
    of = Batch()
    of.array("voltage", voltage)
    _take_temperatures_above_zero(of, temperature)
    of.positive("lorenz", lorenz)
    return HotConductance(*map(of.result, of.call([(), (3,)], _core.f2py_heat.hot_conductance, *of.columns())))


def conductor_heat(
    v: ArrayLike,
    temperature: ArrayLike,
    length: Numbers,
    *,
    area: Numbers,
    conductivity: ArrayLike,
    resistivity: ArrayLike | None = None,
    heat_fraction: Numbers = 1.0,
    film: Numbers = 0.0,
    perimeter: Numbers = 0.0,
    sink: Numbers = 0.0,
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
    of = Batch()
    of.array("v", v, (2,))
    of.array("temperature", temperature, (2,))
    of.positive("length", length)
    of.positive("area", area)
    fraction = of.array("heat_fraction", heat_fraction)
    checks.refuse("heat_fraction", fraction, (fraction < 0) | (fraction > 1), 0, "must be from 0 to 1, not {value:g}")
    per_length = not_negative("film", film) * not_negative("perimeter", perimeter)
    of.take("film and perimeter", per_length, 0)
    of.array("sink", sink)
    share_table(of, "resistivity", resistivity)
    share_table(of, "conductivity", conductivity)
    k, r, flows = of.call([(4, 4), (4,), (3,)], _core.f2py_heat.conductor_heat, *of.columns(), *of.shared_columns())
    return ConductorHeat(of.result(k), of.result(r), *of.results(flows))


def wire_radiation(
    temperature: ArrayLike,
    length: Numbers,
    *,
    perimeter: Numbers,
    emissivity: Numbers,
    surroundings: Numbers,
    absolute_zero: Numbers = 0.0,
    stefan_boltzmann: Numbers = STEFAN_BOLTZMANN,
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
    of = Batch()
    zero = checks.leading("absolute_zero", absolute_zero, ())
    _take_temperatures(of, temperature, zero)
    share = checks.leading("emissivity", emissivity, ())
    checks.refuse("emissivity", share, (share < 0) | (share > 1), 0, "must be from 0 to 1, not {value:g}")
    coefficient = share * checks.all_positive("stefan_boltzmann", stefan_boltzmann)
    coefficient = coefficient * (checks.all_positive("perimeter", perimeter) * checks.all_positive("length", length))
    of.take("emissivity, perimeter, length or stefan_boltzmann", coefficient, 0)
    around = of.array("surroundings", surroundings)
    if (around < zero).any():
        raise ValueError(f"surroundings must not be below absolute zero, {np.max(zero):g}, but is {np.min(around):g}")
    of.take("absolute_zero", zero, 0)
    k, r, _ = of.call([(2, 2), (2,), ()], _core.f2py_heat.wire_radiation, *of.columns())
    return WireRadiation(of.result(k), of.result(r))


def heat_capacity(
    temperature: ArrayLike,
    before: ArrayLike,
    length: Numbers,
    *,
    area: Numbers,
    density: Numbers,
    specific_heat: ArrayLike,
    time: Numbers,
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
    of = Batch()
    of.array("temperature", temperature, (2,))
    of.array("before", before, (2,))
    mass = checks.all_positive("density", density) * checks.all_positive("area", area)
    mass = mass * checks.all_positive("length", length)
    of.take("density, area, length or time", mass / checks.all_positive("time", time), 0)
    share_table(of, "specific_heat", specific_heat)
    latent = np.asarray(latent_heat, dtype=float)
    latent = np.empty((0, 3)) if latent.size == 0 else latent
    latent = checks.leading("latent_heat", latent, (*latent.shape[-2:-1], 3))
    if latent.ndim == 1 or not ((latent[..., 0] >= 0).all() and (latent[..., 2] > latent[..., 1]).all()):
        raise ValueError(
            "latent_heat must have shape (m, 3), not be negative, and the liquidus must be above the solidus"
        )
    of.share("latent_heat", latent, 2)
    k, r = of.call([(2, 2), (2,)], _core.f2py_heat.heat_capacity, *of.columns(), *of.shared_columns())
    return HeatCapacity(of.result(k), of.result(r))


def _take_conductance(of: Batch, volts: Floats, current: Numbers | None, conductance: Numbers | None) -> Floats:
    """Take the conductance of a spot that is described by its current or directly."""
    if conductance is None and current is None:
        raise ValueError("current or conductance is needed")
    i = None if current is None else checks.leading("current", current, ())
    if conductance is not None:
        g = of.not_negative("conductance", conductance)
        if i is not None and not np.isclose(i, g * volts, rtol=1e-6, atol=0).all():
            at = "" if np.ndim(g * volts) else f": G V is {float(g * volts):g} A"
            raise ValueError(f"current and conductance contradict each other{at}")
        return g
    if i is None or (volts == 0).any():
        raise ValueError("without a voltage, the current does not tell what conducts: conductance is needed")
    against, pressed = np.broadcast_arrays(i, volts)
    opposite = pressed * against < 0
    if opposite.any():
        raise ValueError(
            f"current must have the sign of the voltage, {pressed[opposite][0]:g} V, but is {against[opposite][0]:g} A"
        )
    g = i / volts
    of.take("current and voltage", g, 0)
    return g


def _heat_conductances(value: Numbers | Sequence[Numbers | None] | None) -> Floats:
    """Heat conductances of two constrictions, NaN for that of a metal."""
    if isinstance(value, list | tuple):
        if len(value) != 2:
            raise ValueError(f"heat_conductance must be a number or two, not {len(value)}")
        ends = [np.array(np.nan) if one is None else checks.all_positive("heat_conductance", one) for one in value]
        return np.stack(np.broadcast_arrays(*ends), axis=-1)
    if value is None:
        return np.full(2, np.nan)
    result = checks.leading_pair("heat_conductance", value)  # type: ignore[arg-type]
    checks.refuse("heat_conductance", result, result <= 0, 1, "must be greater than 0, {but}")
    return result


def _take_temperatures(of: Batch, value: ArrayLike, zero: Floats) -> None:
    """Take temperatures of two nodes, not below absolute zero."""
    result = of.array("temperature", value, (2,))
    if (result < zero[..., np.newaxis]).any():
        raise ValueError(f"temperature must not be below absolute zero, {np.max(zero):g}, but holds {result.min():g}")


def _take_temperatures_above_zero(of: Batch, value: ArrayLike) -> None:
    """Take temperatures of two bulks, from absolute zero."""
    result = of.array("temperature", value, (2,))
    checks.refuse("temperature", result, result < 0, 1, "must not be below absolute zero, 0, but holds {value:g}")
    checks.refuse("temperature", result, result <= 0, 1, "must be greater than 0 K, but holds {value:g}")


def take_film(of: Batch, heat_conductance: Numbers | None) -> None:
    """Take the resistance of a film to heat, 0 without one."""
    film = (
        np.zeros(()) if heat_conductance is None else 1 / checks.all_positive("film_heat_conductance", heat_conductance)
    )
    of.take("film_heat_conductance", film, 0)


def not_negative(name: str, value: Numbers) -> Floats:
    """The numbers, after checking them."""
    result = checks.leading(name, value, ())
    checks.refuse(name, result, result < 0, 0, "must not be negative, but is {value:g}")
    return result


def share_table(of: Batch, name: str, value: ArrayLike | None) -> None:
    """Take a property over temperature, shape (..., 2, n), or numbers (n,) or one as tables of one pair; None: it is 0."""
    of.share(name, np.zeros((1, 2)) if value is None else np.swapaxes(_table(name, value), -1, -2), 2)


def _table(name: str, value: ArrayLike) -> Floats:
    if np.ndim(value) < 2:
        number = checks.all_positive(name, value)
        return np.stack([np.zeros_like(number), number], axis=-1)[..., np.newaxis]
    shape = np.shape(value)
    if shape[-2] != 2 or shape[-1] < 1:
        raise ValueError(f"{name} must be a number or have shape (2, n), temperatures and values, not {shape}")
    table = checks.leading(name, value, shape[-2:])
    if (np.diff(table[..., 0, :]) <= 0).any():
        raise ValueError(f"the temperatures of {name} must ascend")
    if (table[..., 1, :] <= 0).any():
        raise ValueError(f"the values of {name} must be greater than 0, but hold {table[..., 1, :].min():g}")
    return table

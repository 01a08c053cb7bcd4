"""Heat and current of a spot that its current warms."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .heat import not_negative, table


class HotSpot(NamedTuple):
    """A contact spot that its current warms, so that it resists more."""

    #: From wire 1 to wire 2 [A]
    current: float
    #: To the bulk of wire 1 and of wire 2 (2,) [W]
    heat: NDArray[np.float64]
    #: Highest temperatures in the constriction of either wire (2,) [K]
    hottest: NDArray[np.float64]
    #: Derivatives of the current by the voltage and the two temperatures (3,) [S, A/K]
    dcurrent: NDArray[np.float64]
    #: The same of `heat` (2, 3) [A, W/K]
    dheat: NDArray[np.float64]
    #: The same of `hottest` (2, 3) [K/V, 1]
    dhottest: NDArray[np.float64]


def hot_spot(
    voltage: float,
    temperature: ArrayLike,
    *,
    shape: float,
    resistivity: ArrayLike | Sequence[ArrayLike],
    conductivity: ArrayLike | Sequence[ArrayLike] | None = None,
    lorenz: float | None = None,
    film_resistance: float = 0.0,
    film_heat_conductance: float | None = None,
) -> HotSpot:
    """Current through a contact spot that is warmed by it, with all properties over the temperature.

    Parameters
    ----------
    voltage : float
        Between the bulks of the wires, of either sign [V].
    temperature : array_like, shape (2,)
        Of the bulks of wire 1 and wire 2 [K]; from absolute zero with `lorenz`.
    shape : float
        Of the constriction in either wire [1/m], whose resistance is ``shape*resistivity`` when it is cold: ``1/(4 a)`` of a
        round spot of the radius a.
    resistivity, conductivity : float, array_like of shape (2, n), or a pair of these
        Resistivity [ohm m] and heat conductivity [W/(m K)]: a number, or temperatures, ascending, and values; linear between
        them, constant outside. A list or tuple of two is for wire 1 and wire 2.
    lorenz : float, optional
        Lorenz number L [V^2/K^2] of Wiedemann-Franz metals, whose heat conductivity is ``L T/resistivity``, in place of
        `conductivity`.
    film_resistance : float
        Of a film between the faces [ohm].
    film_heat_conductance : float, optional
        Of the film [W/K]; without it, the faces have one temperature.

    Returns
    -------
    HotSpot
        `current`; `heat` (2,), positive into the wires, with the sum V I; `hottest` (2,); `dcurrent` (3,), `dheat` (2, 3)
        and `dhottest` (2, 3) by the voltage and the temperatures.

    Raises
    ------
    ValueError
        A number that is missing, not finite or out of its range; no solution.

    Notes
    -----
    Temperature and potential are functions of each other in a constriction; the current is the integral of the conductivity
    over the potential, divided by `shape`. ``docs/theory.md``, section 13; ``fortran/laws/hot_spot.f90``.

    Examples
    --------
    Copper at 0.1 V: to first order the spot resists more by 2/3 of what its highest temperature would give throughout, 37 %:

    >>> copper = [[293, 1293], [1.7e-8, 1.7e-8 * (1 + 3.93)]]
    >>> cold = hot_spot(1e-6, [293, 293], shape=1e4, resistivity=copper, lorenz=2.44e-8)
    >>> hot = hot_spot(0.1, [293, 293], shape=1e4, resistivity=copper, lorenz=2.44e-8)
    >>> ratio = 1e5 * cold.current / hot.current
    >>> print(f"{hot.hottest[0] - 293:.0f} K warmer, {100 * (ratio - 1):.0f} % more resistance")
    141 K warmer, 36 % more resistance
    """
    rho = _pair_of_tables("resistivity", resistivity)
    if (conductivity is None) == (lorenz is None):
        raise ValueError("conductivity or lorenz is needed, and not both")
    bulk = checks.array("temperature", temperature, (2,))
    if lorenz is not None and not (bulk > 0).all():
        raise ValueError(f"temperature must be greater than 0 K, but holds {bulk.min():g}")
    lam = _pair_of_tables("conductivity", 1.0 if conductivity is None else conductivity)
    film = 0.0 if film_heat_conductance is None else 1 / checks.positive("film_heat_conductance", film_heat_conductance)
    current, heat, hottest, dcurrent, dheat, dhottest, info = _core.f2py_heat.hot_spot(
        checks.number("voltage", voltage),
        bulk,
        checks.positive("shape", shape),
        rho[0],
        rho[1],
        lam[0],
        lam[1],
        int(lorenz is not None),
        0.0 if lorenz is None else checks.positive("lorenz", lorenz),
        not_negative("film_resistance", film_resistance),
        film,
    )
    if info != 0:
        raise ValueError("these numbers give no steady current and temperatures of a spot")
    return HotSpot(float(current), heat, hottest, dcurrent, dheat, dhottest)


def _pair_of_tables(
    name: str, value: ArrayLike | Sequence[ArrayLike]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A property over temperature of two wires: one for both, or one for each."""
    is_pair = isinstance(value, list | tuple) and len(value) == 2 and np.ndim(value[0]) != 1
    first, second = value if is_pair else (value, value)  # type: ignore[misc]
    return table(name, first), table(name, second)  # type: ignore[arg-type]

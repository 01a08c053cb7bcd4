"""Heat and current of a spot that its current warms."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from . import checks
from .batch import Batch, Floats
from .heat import share_table, take_film
from .wire_pair import Numbers


class HotSpot(NamedTuple):
    """A contact spot that its current warms, so that it resists more."""

    #: From wire 1 to wire 2 [A]
    current: float | Floats
    #: To the bulk of wire 1 and of wire 2 (2,) [W]
    heat: Floats
    #: Highest temperatures in the constriction of either wire (2,) [K]
    hottest: Floats
    #: Derivatives of the current by the voltage and the two temperatures (3,) [S, A/K]
    dcurrent: Floats
    #: The same of `heat` (2, 3) [A, W/K]
    dheat: Floats
    #: The same of `hottest` (2, 3) [K/V, 1]
    dhottest: Floats


def hot_spot(
    voltage: Numbers,
    temperature: ArrayLike,
    *,
    shape: Numbers,
    resistivity: ArrayLike | Sequence[ArrayLike],
    conductivity: ArrayLike | Sequence[ArrayLike] | None = None,
    lorenz: Numbers | None = None,
    film_resistance: Numbers = 0.0,
    film_heat_conductance: Numbers | None = None,
) -> HotSpot:
    """Current through a contact spot that is warmed by it, with all properties over the temperature.

    Parameters
    ----------
    voltage : float
        Between the bulks of the wires, of either sign [V]. All arguments that hold numbers may have leading axes, see
        `litz.kernels`.
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
    if (conductivity is None) == (lorenz is None):
        raise ValueError("conductivity or lorenz is needed, and not both")
    of = Batch()
    of.array("voltage", voltage)
    bulk = of.array("temperature", temperature, (2,))
    if lorenz is not None:
        checks.refuse("temperature", bulk, bulk <= 0, 1, "must be greater than 0 K, but holds {value:g}")
    of.positive("shape", shape)
    of.take("lorenz", np.zeros(()) if lorenz is None else checks.all_positive("lorenz", lorenz), 0)
    of.not_negative("film_resistance", film_resistance)
    take_film(of, film_heat_conductance)
    _share_pair_of_tables(of, "resistivity", resistivity)
    _share_pair_of_tables(of, "conductivity", 1.0 if conductivity is None else conductivity)
    *found, info = of.call(
        [(), (2,), (2,), (3,), (2, 3), (2, 3), ()], _core.f2py_heat.hot_spot,
        *of.columns(), *of.shared_columns(), int(lorenz is not None),
    )  # fmt: skip
    if (info != 0).any():
        raise ValueError(
            of.named(info != 0, "spot") + "these numbers give no steady current and temperatures of a spot"
        )
    return HotSpot(*map(of.result, found))


def _share_pair_of_tables(of: Batch, name: str, value: ArrayLike | Sequence[ArrayLike]) -> None:
    """Take a property over temperature of two wires: one for both, or one for each."""
    is_pair = isinstance(value, list | tuple) and len(value) == 2 and np.ndim(value[0]) != 1
    for one in value if is_pair else (value, value):  # type: ignore[union-attr]
        share_table(of, name, one)  # type: ignore[arg-type]

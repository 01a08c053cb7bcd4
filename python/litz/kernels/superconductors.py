"""Superconducting wires: critical current density, the power law in parallel with a metal, the element."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .batch import Batch
from .wire_pair import Numbers

#: Electric field at which a current counts as critical [V/m]
CRITERION = 1e-4


class CriticalDensity(NamedTuple):
    """A critical current density, of the area of the superconductor alone."""

    #: [A/m^2]
    value: float
    #: Derivative by the temperature [A/(m^2 K)]
    by_temperature: float
    #: Derivative by the flux density [A/(m^2 T)]
    by_field: float
    #: Derivative by the strain [A/m^2]
    by_strain: float


class ParallelField(NamedTuple):
    """The electric field of a current that filaments and metal share."""

    #: [V/m]
    value: float
    #: Derivative by the current density [ohm m]
    by_current: float
    #: Derivative by the conductivity of the metal [V^2/A]
    by_conductivity: float
    #: Derivative by the critical current density [ohm m]
    by_critical: float


class Superconductor(NamedTuple):
    """Result of an element with superconducting filaments, whose current is an unknown of its own."""

    #: Derivative of `R` by the potentials (2, 2) [S]
    K: NDArray[np.float64]
    #: Currents that leave the nodes (2,) [A], by the law linearised about the given current
    R: NDArray[np.float64]
    #: Electric field of the given current [V/m]
    field: float
    #: Voltage of the given current [V]
    drop: float


def nb3sn(
    temperature: Numbers,
    field: Numbers,
    strain: Numbers = 0.0,
    *,
    C: Numbers,
    Bc20: Numbers,
    Tc0: Numbers,
    p: Numbers,
    q: Numbers,
    Ca1: Numbers,
    Ca2: Numbers,
    e0: Numbers,
    em: Numbers = 0.0,
) -> CriticalDensity:
    """Critical current density of Nb3Sn by the ITER-2008 parametrization.

    Parameters
    ----------
    temperature, field, strain : float
        [K], flux density [T], axial strain [-].
    C : float
        Scaling constant [A T/m^2], of the area of the superconductor: that of a strand [A T] over this area.
    Bc20, Tc0 : float
        Upper critical flux density at 0 K without strain [T], critical temperature without flux and strain [K].
    p, q : float
        Exponents of the reduced flux density b and of 1 - b.
    Ca1, Ca2, e0, em : float
        Second and third invariant and residual strain of the strain function, strain at which it is largest.

    Returns
    -------
    CriticalDensity
        0 beyond the critical surface. L. Bottura, B. Bordini, IEEE Trans. Appl. Supercond. 19 (2009) 1521.

    Raises
    ------
    ValueError
        A number that is not finite or out of its range.

    Examples
    --------
    >>> strand = dict(C=7.5e10, Bc20=32.97, Tc0=16.06, p=0.63, q=2.1, Ca1=44.48, Ca2=0.0, e0=0.256e-2)
    >>> f"{nb3sn(4.2, 12.0, -0.005, **strand).value:.4g} A/m^2 at 4.2 K, 12 T and -0.5 %"
    '6.305e+08 A/m^2 at 4.2 K, 12 T and -0.5 %'
    """
    of = _at(temperature, field)
    of.array("strain", strain)
    given = Batch()
    for name, value in dict(C=C, Bc20=Bc20, Tc0=Tc0, p=p, q=q, Ca1=Ca1).items():
        given.positive(name, value)
    invariants = given.positive("Ca1", Ca1), given.not_negative("Ca2", Ca2)
    given.positive("e0", e0)
    given.array("em", em)
    beyond = (invariants[1] >= invariants[0]) | (invariants[0] * np.asarray(e0) >= 1)
    checks.refuse("Ca1", np.broadcast_to(invariants[0], beyond.shape), beyond, 0,
                  "must be more than Ca2 and less than 1/e0, {but}")  # fmt: skip
    _take_parameters(of, [C, Bc20, Tc0, p, q, Ca1, Ca2, e0, em])
    return CriticalDensity(*of.results(of.call_for_one((4,), _core.f2py_superconductor.nb3sn, *of.columns())))


def nbti(
    temperature: Numbers,
    field: Numbers,
    *,
    jref: Numbers,
    C0: Numbers,
    Bc20: Numbers,
    Tc0: Numbers,
    alpha: Numbers,
    beta: Numbers,
    gamma: Numbers,
) -> CriticalDensity:
    """Critical current density of Nb-Ti by Bottura's fit.

    Parameters
    ----------
    temperature, field : float
        [K], flux density [T].
    jref : float
        That at 4.2 K and 5 T [A/m^2].
    C0, Bc20, Tc0 : float
        Normalisation [T], upper critical flux density at 0 K [T], critical temperature without flux [K].
    alpha, beta, gamma : float
        Exponents of b, of 1 - b and of 1 - t^1.7.

    Returns
    -------
    CriticalDensity
        0 beyond the critical surface. L. Bottura, IEEE Trans. Appl. Supercond. 10 (2000) 1054.

    Raises
    ------
    ValueError
        A number that is not finite or out of its range.

    Examples
    --------
    >>> lhc = dict(jref=3e9, C0=27.04, Bc20=14.5, Tc0=9.2, alpha=0.57, beta=0.9, gamma=2.32)
    >>> f"{nbti(4.2, 5.0, **lhc).value / 3e9:.3f}"
    '0.977'
    """
    of = _at(temperature, field)
    given = Batch()
    for name, value in dict(jref=jref, C0=C0, Bc20=Bc20, Tc0=Tc0, alpha=alpha, beta=beta, gamma=gamma).items():
        given.positive(name, value)
    _take_parameters(of, [jref, C0, Bc20, Tc0, alpha, beta, gamma])
    return CriticalDensity(*of.results(of.call_for_one((4,), _core.f2py_superconductor.nbti, *of.columns())))


def critical_table(temperature: Numbers, field: Numbers, densities: ArrayLike) -> CriticalDensity:
    """Critical current density from a table, linear between its temperatures and flux densities, constant outside.

    Parameters
    ----------
    temperature, field : float
        [K], flux density [T].
    densities : array_like, shape (n, 3)
        Lines of critical current density [A/m^2], temperature [K] and flux density [T]: one for every temperature at every
        flux density, in any order.

    Returns
    -------
    CriticalDensity

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite or out of its range, a pair that is missing or there twice.

    Examples
    --------
    >>> rows = [(3e9, 4, 5), (2e9, 5, 5), (2e9, 4, 7), (1e9, 5, 7)]
    >>> critical_table(4.5, 6.0, rows).value
    2000000000.0
    """
    rows = np.asarray(densities, dtype=float)
    rows = checks.array("densities", rows, (len(rows), 3))
    temperatures, at_t = np.unique(rows[:, 1], return_inverse=True)
    fields, at_b = np.unique(rows[:, 2], return_inverse=True)
    grid = np.full((len(temperatures), len(fields)), np.nan)
    grid[at_t, at_b] = rows[:, 0]
    if np.isnan(grid).any() or len(rows) != grid.size:
        raise ValueError("densities must hold every temperature at every flux density, once")
    of = _at(temperature, field)
    found = of.call_for_one((4,), _core.f2py_superconductor.critical_table, *of.columns(), temperatures, fields, grid)
    return CriticalDensity(*of.results(found))


def parallel_field(
    current: Numbers, *, conductivity: Numbers, critical: Numbers, exponent: Numbers, criterion: Numbers = CRITERION
) -> ParallelField:
    """Electric field at which filaments and metal in parallel carry a current: ``J = s E + jc (E/Ec)^(1/n)``.

    Parameters
    ----------
    current : float
        J, per area of the whole cross-section [A/m^2].
    conductivity, critical : float
        s [S/m] and jc [A/m^2], each times its part of the cross-section.
    exponent, criterion : float
        n, and Ec [V/m].

    Returns
    -------
    ParallelField

    Raises
    ------
    ValueError
        A number that is not finite or out of its range.

    Examples
    --------
    Without the metal it is the power law:

    >>> f"{parallel_field(0.9e9, conductivity=1e-3, critical=1e9, exponent=10).value / 1e-4:.4f}"
    '0.3487'
    """
    of = Batch()
    of.array("current", current)
    _take_law(of, conductivity, critical, criterion, exponent)
    return ParallelField(*of.results(of.call_for_one((4,), _core.f2py_superconductor.parallel_field, *of.columns())))


def superconductor(
    current: Numbers,
    v: ArrayLike,
    length: Numbers,
    *,
    area: Numbers,
    resistivity: Numbers,
    fraction: Numbers,
    critical: Numbers,
    exponent: Numbers,
    criterion: Numbers = CRITERION,
) -> Superconductor:
    """A wire with superconducting filaments, whose current is an unknown beside the potentials.

    Parameters
    ----------
    current : float
        I, about which the law is linearised [A].
    v : array_like, shape (2,)
        Potentials of the nodes [V].
    length, area : float
        [m] and [m^2].
    resistivity : float
        Of the metal by itself [ohm m].
    fraction : float
        Part of the area that is superconductor.
    critical, exponent, criterion : float
        jc of the superconductor's area [A/m^2], n, and Ec [V/m].

    Returns
    -------
    Superconductor
        The equations that are left when the current is eliminated. With their solution `v` the next current is ``R[0]``.

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite or out of its range.

    Examples
    --------
    Newton's method for a wire with 90 A imposed, from no current at all:

    >>> wire = dict(area=0.5e-6, resistivity=1e-10, fraction=0.4, critical=4e8, exponent=20)
    >>> current, v = 0.0, np.zeros(2)
    >>> for _ in range(5):
    ...     flow = superconductor(current, v, 0.01, **wire)
    ...     v[0] += (90 - flow.R[0]) / flow.K[0, 0]
    ...     current = flow.R[0] + flow.K[0, 0] * ((90 - flow.R[0]) / flow.K[0, 0])
    >>> f"{v[0] / 0.01 / parallel_field(90 / 0.5e-6, conductivity=0.6e10, critical=1.6e8, exponent=20).value:.6f}"
    '1.000000'
    """
    of = Batch()
    of.array("current", current)
    of.array("v", v, (2,))
    of.positive("length", length)
    of.positive("area", area)
    rho = of.positive("resistivity", resistivity)
    part = Batch().positive("fraction", fraction)
    checks.refuse("fraction", part, part >= 1, 0, "must be less than 1, not {value:g}")
    _take_law(of, (1 - part) / rho, part * Batch().not_negative("critical", critical), criterion, exponent)
    flow = of.call_for_one((4,), _core.f2py_superconductor.superconductor, *of.columns())
    signs = np.array([1.0, -1.0])
    return Superconductor(
        of.result(np.outer(signs, signs)[:, :, None] * flow[1]),
        of.result(signs[:, None] * flow[0]),
        *of.results(flow[2:]),
    )


def _at(temperature: Numbers, field: Numbers) -> Batch:
    """Temperature and flux density, which are not negative."""
    of = Batch()
    of.not_negative("temperature", temperature)
    of.not_negative("field", field)
    return of


def _take_parameters(of: Batch, values: list[Any]) -> None:
    """The parameters of a fit, which have been checked, as one argument."""
    of.take(
        "parameters", np.stack(np.broadcast_arrays(*(np.asarray(value, dtype=float) for value in values)), axis=-1), 1
    )


def _take_law(of: Batch, conductivity: Any, critical: Any, criterion: Any, exponent: Any) -> None:
    """The numbers of the law as one argument, after checking them."""
    given = Batch()
    powers = given.array("exponent", exponent)
    checks.refuse("exponent", powers, powers < 1, 0, "must be 1 or more, not {value:g}")
    values = [
        given.positive("conductivity", conductivity),
        given.not_negative("critical", critical),
        given.positive("criterion", criterion),
        powers,
    ]
    of.take("the law", np.stack(np.broadcast_arrays(*values), axis=-1), 1)

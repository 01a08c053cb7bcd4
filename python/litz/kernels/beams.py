"""Beam elements B31 and B33 and the two-node conductor, one element at a time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks

Form = Literal["spin", "hessian"]


class Beam(NamedTuple):
    """Result of a beam element; each node has the unknowns ux uy uz phix phiy phiz."""

    #: Tangent (12, 12) [N/m, N, N m]
    K: NDArray[np.float64]
    #: Internal forces and moments (12,) [N, N m]
    R: NDArray[np.float64]
    #: Strain energy [J]
    energy: float
    #: N, Q2, Q3, T, M2, M3 (6,) [N, N m]
    section_forces: NDArray[np.float64]


class BeamStrains(NamedTuple):
    """Strains of a beam element, conjugate to its section forces."""

    #: Strains against the stress-free state (6,) [-, 1/m]
    strain: NDArray[np.float64]
    #: Derivatives of the strains by displacements and spins (6, 12) [1/m, -, 1/m^2]
    B: NDArray[np.float64]
    #: Reference length [m]; the energy is length * strain . section_forces / 2
    length: float


class Conductor(NamedTuple):
    """Result of a conductor element."""

    #: Derivative of `R` by the potentials (2, 2) [1/ohm]
    K: NDArray[np.float64]
    #: Currents leaving the nodes (2,) [A]
    R: NDArray[np.float64]
    #: Derivative of `R` by the positions of node 1, node 2 (2, 6) [A/m]
    K_me: NDArray[np.float64]
    #: Current from the first to the second node [A]
    current: float
    #: Joule heat [W]
    heat: float


def beam_b31(
    x: ArrayLike,
    triads: ArrayLike,
    x0: ArrayLike,
    triads0: ArrayLike,
    *,
    ea: float,
    ga2: float,
    ga3: float,
    gj: float,
    ei2: float,
    ei3: float,
    form: Form = "spin",
    sigma: ArrayLike | None = None,
    stress_free_strain: float = 0.0,
) -> Beam:
    """Geometrically exact, shear-flexible beam with one integration point.

    The stress-free state may be curved and twisted; the reference length of a curved element is that of the circular
    arc with its end tangents. Rotations and strains may be large, but the two triads must differ by less than half a
    turn.

    Parameters
    ----------
    x, x0 : array_like, shape (2, 3)
        Nodal positions now and in the stress-free state [m].
    triads, triads0 : array_like, shape (2, 3, 3)
        Nodal triads now and in the stress-free state; the columns of ``triads[i]`` are the unit tangent, the first and
        the second section axis.
    ea, ga2, ga3 : float
        Axial and shear stiffnesses [N].
    gj, ei2, ei3 : float
        Torsional and bending stiffnesses [N m^2]; `ei2` is for bending about the first section axis.
    form : {"spin", "hessian"}
        Rotational columns of `K`: derivative by spins (unsymmetric off equilibrium), or by the rotation vector of the
        increment (symmetric).
    sigma : array_like, shape (6,), optional
        Section forces for the geometric part of `K` only, in place of those of the strains [N, N m].
    stress_free_strain : float
        Axial strain of the stress-free state, as from temperature: alpha times the rise.

    Returns
    -------
    Beam
        `K` (12, 12), `R` (12,), `energy`, `section_forces` (N, Q2, Q3, T, M2, M3) at mid length, tension positive.

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite, triads that are not orthonormal and right-handed, a stiffness that is
        not positive, an element without length.

    Notes
    -----
    J. C. Simo, Comput. Methods Appl. Mech. Eng. 49 (1985) 55-70; M. A. Crisfield and G. Jelenic, Proc. R. Soc. A 455
    (1999) 1125-1147. The formulas are in ``fortran/kernels/beam_kinematics.f90`` and ``beam_b31.f90``.
    """
    stiffness = _stiffness(ea=ea, ga2=ga2, ga3=ga3, gj=gj, ei2=ei2, ei3=ei3)
    return _beam(_core.f2py_beams.beam_b31, x, triads, x0, triads0, stiffness, form, sigma, stress_free_strain)


def beam_b33(
    x: ArrayLike,
    triads: ArrayLike,
    x0: ArrayLike,
    triads0: ArrayLike,
    *,
    ea: float,
    gj: float,
    ei2: float,
    ei3: float,
    form: Form = "spin",
    sigma: ArrayLike | None = None,
    stress_free_strain: float = 0.0,
) -> Beam:
    """Euler-Bernoulli beam: cubic bending in a corotational frame, large rotations with small strains.

    The stress-free state may be curved and twisted. The two triads must differ by less than half a turn, and the chord
    must not point against the tangents.

    Parameters
    ----------
    x, x0 : array_like, shape (2, 3)
        Nodal positions now and in the stress-free state [m].
    triads, triads0 : array_like, shape (2, 3, 3)
        Nodal triads now and in the stress-free state; the columns of ``triads[i]`` are the unit tangent, the first and
        the second section axis.
    ea : float
        Axial stiffness [N].
    gj, ei2, ei3 : float
        Torsional and bending stiffnesses [N m^2]; `ei2` is for bending about the first section axis.
    form : {"spin", "hessian"}
        Rotational columns of `K`: derivative by spins (unsymmetric off equilibrium), or by the rotation vector of the
        increment (symmetric).
    sigma : array_like, shape (6,), optional
        Section forces for the geometric part of `K` only, in place of those of the strains [N, N m].
    stress_free_strain : float
        Axial strain of the stress-free state, as from temperature: alpha times the rise.

    Returns
    -------
    Beam
        `K` (12, 12), `R` (12,), `energy`, `section_forces` (N, Q2, Q3, T, M2, M3) at mid length, tension positive; the
        bending moments are M2 - Q3 L0/2, M3 + Q2 L0/2 at the first node and M2 + Q3 L0/2, M3 - Q2 L0/2 at the second.

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite, triads that are not orthonormal and right-handed, a stiffness that is
        not positive, an element without length.

    Notes
    -----
    Mean axial strain of the cubic: C. Oran, J. Struct. Div. ASCE 99 (1973) 987-1001. The formulas are in
    ``fortran/kernels/beam_kinematics.f90`` and ``beam_b33.f90``.
    """
    # the shear stiffnesses are not used
    stiffness = _stiffness(ea=ea, ga2=1.0, ga3=1.0, gj=gj, ei2=ei2, ei3=ei3)
    return _beam(_core.f2py_beams.beam_b33, x, triads, x0, triads0, stiffness, form, sigma, stress_free_strain)


def beam_b31_strains(x: ArrayLike, triads: ArrayLike, x0: ArrayLike, triads0: ArrayLike) -> BeamStrains:
    """Strains of `beam_b31`: axial, two shears, twist, two curvatures.

    Parameters are those of `beam_b31`.
    """
    return _strains(_core.f2py_beams.beam_b31, x, triads, x0, triads0)


def beam_b33_strains(x: ArrayLike, triads: ArrayLike, x0: ArrayLike, triads0: ArrayLike) -> BeamStrains:
    """Strains of `beam_b33`: mean axial strain, two rotations of the chord, twist, two curvatures.

    Parameters are those of `beam_b33`. The section forces are these strains times EA, 12 EI3/L0^2, 12 EI2/L0^2, GJ,
    EI2, EI3.
    """
    return _strains(_core.f2py_beams.beam_b33, x, triads, x0, triads0)


def beam_forces_by_temperature(
    strains: BeamStrains,
    *,
    rigidity: ArrayLike,
    drigidity: ArrayLike,
    stress_free_strain: float,
    dstress_free_strain: float,
) -> NDArray[np.float64]:
    """Derivative of the internal forces of a beam by its temperature, where nothing moves.

    Parameters
    ----------
    strains : BeamStrains
        Of `beam_b31_strains` or `beam_b33_strains`.
    rigidity, drigidity : array_like, shape (6,)
        What multiplies the strains in the section forces [N, N m^2], and its derivative by the temperature.
    stress_free_strain, dstress_free_strain : float
        Axial strain of the stress-free state, and its derivative by the temperature [1/K].

    Returns
    -------
    ndarray, shape (12,)
        ``L0 B^T (C' e - C e_T')`` [N/K, N m/K] with the strains `e` against the stress-free state.

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite.
    """
    strain = checks.array("strain", strains.strain, (6,)).copy()
    strain[0] -= checks.number("stress_free_strain", stress_free_strain)
    return _core.f2py_beams.forces_by_temperature(
        checks.positive("length", strains.length),
        checks.array("rigidity", rigidity, (6,)),
        checks.array("drigidity", drigidity, (6,)),
        strain,
        checks.number("dstress_free_strain", dstress_free_strain),
        checks.array("B", strains.B, (6, 12)),
    )


def conductor(
    x: ArrayLike,
    v: ArrayLike,
    length: float,
    *,
    area: float,
    resistivity: float,
    current_length: bool = False,
) -> Conductor:
    """Two-node conductor with linear voltage: ``R = (A/(rho l)) [[1, -1], [-1, 1]] V``.

    Parameters
    ----------
    x : array_like, shape (2, 3)
        Nodal positions [m]; they matter with `current_length` only.
    v : array_like, shape (2,)
        Nodal potentials [V].
    length : float
        Reference length [m].
    area, resistivity : float
        Cross-section [m^2] and resistivity [ohm m].
    current_length : bool
        Use the present distance of the nodes in place of `length`; the area stays.

    Returns
    -------
    Conductor
        `K` (2, 2), `R` (2,) with currents leaving the nodes positive, `K_me` (2, 6) (zero with the reference length),
        `current` from the first to the second node, `heat`.

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite, a property that is not positive, an element without length.
    """
    x = checks.element("x", x)
    v = checks.array("v", v, (2,))
    length = checks.positive("length", length)
    area = checks.positive("area", area)
    resistivity = checks.positive("resistivity", resistivity)
    return Conductor(*_core.f2py_beams.conductor(x.T, v, length, area, resistivity, bool(current_length)))


def potential_rise(
    xi: ArrayLike, current: ArrayLike, length: float, *, area: float, resistivity: float
) -> NDArray[np.float64]:
    """Potential inside a conductor above the linear one, where currents enter between its nodes.

    Parameters
    ----------
    xi : array_like, shape (n,)
        Places in [-1, 1], ascending.
    current : array_like, shape (n,)
        Currents that enter there [A].
    length : float
        Reference length [m].
    area, resistivity : float
        Cross-section [m^2] and resistivity [ohm m].

    Returns
    -------
    ndarray, shape (n,)
        ``rho L0/(4 A) sum_j (1 + min(xi_i, xi_j)) (1 - max(xi_i, xi_j)) I_j`` [V].

    Raises
    ------
    ValueError
        Wrong shape, a number that is not finite, a property that is not positive, places that are not in [-1, 1] or not
        ascending.
    """
    n = np.size(xi)
    xi = checks.array("xi", xi, (n,))
    current = checks.array("current", current, (n,))
    if n and (xi[0] < -1 or xi[-1] > 1 or (np.diff(xi) < 0).any()):
        raise ValueError("xi must ascend within [-1, 1]")
    length = checks.positive("length", length)
    area = checks.positive("area", area)
    resistivity = checks.positive("resistivity", resistivity)
    if n == 0:
        return np.empty(0)
    return _core.f2py_beams.potential_rise(resistivity * length / (4 * area), xi, current, n)


def _stiffness(**values: float) -> NDArray[np.float64]:
    return np.array([checks.positive(name, value) for name, value in values.items()])


def _beam(
    kernel: Callable[..., Any],
    x: ArrayLike,
    triads: ArrayLike,
    x0: ArrayLike,
    triads0: ArrayLike,
    stiffness: NDArray[np.float64],
    form: Form,
    sigma: ArrayLike | None,
    stress_free_strain: float,
) -> Beam:
    if form not in ("spin", "hessian"):
        raise ValueError(f"form must be 'spin' or 'hessian', not {form!r}")
    given = sigma is not None
    forces = np.zeros(6) if sigma is None else checks.array("sigma", sigma, (6,))
    geometry = _geometry(x, triads, x0, triads0)
    thermal = checks.number("stress_free_strain", stress_free_strain)
    return Beam(*kernel(*geometry, stiffness, thermal, forces, given, form == "spin")[:4])


def _strains(
    kernel: Callable[..., Any], x: ArrayLike, triads: ArrayLike, x0: ArrayLike, triads0: ArrayLike
) -> BeamStrains:
    geometry = _geometry(x, triads, x0, triads0)
    return BeamStrains(*kernel(*geometry, np.ones(6), 0.0, np.zeros(6), False, False)[4:])


def _geometry(
    x: ArrayLike, triads: ArrayLike, x0: ArrayLike, triads0: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return positions as (3, node) and triads as (3, axis, node), the kernels' order."""
    return (
        checks.element("x", x).T,
        checks.triads("triads", triads, 2).transpose(1, 2, 0),
        checks.element("x0", x0).T,
        checks.triads("triads0", triads0, 2).transpose(1, 2, 0),
    )

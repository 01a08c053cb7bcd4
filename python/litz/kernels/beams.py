"""Beam elements B31 and B33 and the two-node conductor."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from . import checks
from .batch import Batch, Floats
from .wire_pair import Numbers

Form = Literal["spin", "hessian"]
#: What the kernels of beams return: K, R, energy, section forces, strains, their derivatives, length
_BEAM_SHAPES: list[tuple[int, ...]] = [(12, 12), (12,), (), (6,), (6,), (6, 12), ()]
#: Which of the strains is the axial one
_AXIAL = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0])


class Beam(NamedTuple):
    """Result of a beam element; each node has the unknowns ux uy uz phix phiy phiz."""

    #: Tangent (12, 12) [N/m, N, N m]; without entries, (0, 0), with `tangent=False`
    K: Floats
    #: Internal forces and moments (12,) [N, N m]
    R: Floats
    #: Strain energy [J]
    energy: float | Floats
    #: N, Q2, Q3, T, M2, M3 (6,) [N, N m]
    section_forces: Floats


class BeamStrains(NamedTuple):
    """Strains of a beam element, conjugate to its section forces."""

    #: Strains against the stress-free state (6,) [-, 1/m]
    strain: Floats
    #: Derivatives of the strains by displacements and spins (6, 12) [1/m, -, 1/m^2]
    B: Floats
    #: Reference length [m]; the energy is length * strain . section_forces / 2
    length: float | Floats


class Conductor(NamedTuple):
    """Result of a conductor element."""

    #: Derivative of `R` by the potentials (2, 2) [1/ohm]
    K: Floats
    #: Currents leaving the nodes (2,) [A]
    R: Floats
    #: Derivative of `R` by the positions of node 1, node 2 (2, 6) [A/m]
    K_me: Floats
    #: Current from the first to the second node [A]
    current: float | Floats
    #: Joule heat [W]
    heat: float | Floats


def beam_b31(
    x: ArrayLike,
    triads: ArrayLike,
    x0: ArrayLike,
    triads0: ArrayLike,
    *,
    ea: Numbers,
    ga2: Numbers,
    ga3: Numbers,
    gj: Numbers,
    ei2: Numbers,
    ei3: Numbers,
    form: Form = "spin",
    sigma: ArrayLike | None = None,
    stress_free_strain: Numbers = 0.0,
    tangent: bool = True,
) -> Beam:
    """Geometrically exact, shear-flexible beam with one integration point.

    The stress-free state may be curved and twisted; the reference length of a curved element is that of the circular
    arc with its end tangents. Rotations and strains may be large, but the two triads must differ by less than half a
    turn.

    Parameters
    ----------
    x, x0 : array_like, shape (2, 3)
        Nodal positions now and in the stress-free state [m]. All arguments that hold numbers may have leading axes, see
        `litz.kernels`.
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
    tangent : bool
        False: `K` is not returned; it then has no entries.

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
    of = _geometry(x, triads, x0, triads0)
    _take_stiffness(of, ea=ea, ga2=ga2, ga3=ga3, gj=gj, ei2=ei2, ei3=ei3)
    return _beam(_core.f2py_beams.beam_b31, of, form, sigma, stress_free_strain, tangent)


def beam_b33(
    x: ArrayLike,
    triads: ArrayLike,
    x0: ArrayLike,
    triads0: ArrayLike,
    *,
    ea: Numbers,
    gj: Numbers,
    ei2: Numbers,
    ei3: Numbers,
    form: Form = "spin",
    sigma: ArrayLike | None = None,
    stress_free_strain: Numbers = 0.0,
    tangent: bool = True,
) -> Beam:
    """Euler-Bernoulli beam: cubic bending in a corotational frame, large rotations with small strains.

    The stress-free state may be curved and twisted. The two triads must differ by less than half a turn, and the chord
    must not point against the tangents.

    Parameters
    ----------
    x, x0 : array_like, shape (2, 3)
        Nodal positions now and in the stress-free state [m]. All arguments that hold numbers may have leading axes, see
        `litz.kernels`.
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
    tangent : bool
        False: `K` is not returned; it then has no entries.

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
    of = _geometry(x, triads, x0, triads0)
    _take_stiffness(of, ea=ea, ga2=1.0, ga3=1.0, gj=gj, ei2=ei2, ei3=ei3)
    return _beam(_core.f2py_beams.beam_b33, of, form, sigma, stress_free_strain, tangent)


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
    stress_free_strain: Numbers,
    dstress_free_strain: Numbers,
) -> Floats:
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
    of = Batch()
    of.positive("length", strains.length)
    of.array("rigidity", rigidity, (6,))
    of.array("drigidity", drigidity, (6,))
    strain = checks.leading("strain", strains.strain, (6,))
    free = checks.leading("stress_free_strain", stress_free_strain, ())
    of.take("strain and stress_free_strain", strain - free[..., np.newaxis] * _AXIAL, 1)
    of.array("dstress_free_strain", dstress_free_strain)
    of.take("B", np.swapaxes(checks.leading("B", strains.B, (6, 12)), -1, -2), 2)
    return of.result(of.call_for_one((12,), _core.f2py_beams.forces_by_temperature, *of.columns()))


def conductor(
    x: ArrayLike,
    v: ArrayLike,
    length: Numbers,
    *,
    area: Numbers,
    resistivity: Numbers,
    current_length: bool = False,
) -> Conductor:
    """Two-node conductor with linear voltage: ``R = (A/(rho l)) [[1, -1], [-1, 1]] V``.

    Parameters
    ----------
    x : array_like, shape (2, 3)
        Nodal positions [m]; they matter with `current_length` only. All arguments that hold numbers may have leading axes,
        see `litz.kernels`.
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
    of = Batch()
    of.take("x", checks.element("x", x), 2)
    of.array("v", v, (2,))
    of.positive("length", length)
    of.positive("area", area)
    of.positive("resistivity", resistivity)
    return Conductor(
        *map(
            of.result,
            of.call([(2, 2), (2,), (2, 6), (), ()], _core.f2py_beams.conductor, *of.columns(), bool(current_length)),
        )
    )


def potential_rise(
    xi: ArrayLike, current: ArrayLike, length: Numbers, *, area: Numbers, resistivity: Numbers
) -> Floats:
    """Potential inside a conductor above the linear one, where currents enter between its nodes.

    Parameters
    ----------
    xi : array_like, shape (n,)
        Places in [-1, 1], ascending. All arguments may have leading axes, see `litz.kernels`; they hold many elements with
        n places each.
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
    places = checks.leading("xi", xi, ())
    n = (places.shape or (0,))[-1]
    of = Batch()
    scale = checks.all_positive("resistivity", resistivity) * checks.all_positive("length", length)
    of.array("length, area or resistivity", scale / (4 * checks.all_positive("area", area)))
    of.array("xi", places, (n,))
    of.array("current", current, (n,))
    if (n and (abs(places) > 1).any()) or (np.diff(places) < 0).any():
        raise ValueError("xi must ascend within [-1, 1]")
    if n == 0:
        return of.empty(0)
    return of.result(of.call_for_one((n,), _core.f2py_beams.potential_rise, *of.columns()))


def _take_stiffness(of: Batch, **values: Numbers) -> None:
    """Take the stiffnesses of a section."""
    numbers = [checks.all_positive(name, value) for name, value in values.items()]
    try:
        of.take("stiffnesses", np.stack(np.broadcast_arrays(*numbers), axis=-1), 1)
    except ValueError:
        shapes = ", ".join(f"{value.shape} of {name}" for name, value in zip(values, numbers, strict=True))
        raise ValueError(f"the leading axes of the stiffnesses do not broadcast: {shapes}") from None


def _beam(
    kernel: Callable[..., Any],
    of: Batch,
    form: Form,
    sigma: ArrayLike | None,
    stress_free_strain: Numbers,
    tangent: bool,
) -> Beam:
    if form not in ("spin", "hessian"):
        raise ValueError(f"form must be 'spin' or 'hessian', not {form!r}")
    of.array("stress_free_strain", stress_free_strain)
    of.array("sigma", np.zeros(6) if sigma is None else sigma, (6,))
    k, *others = of.call(
        _BEAM_SHAPES, kernel, *of.columns(), sigma is not None, form == "spin", of.n if tangent else 0, 0
    )
    return Beam(of.result(k) if tangent else of.empty(0, 0), *map(of.result, others[:3]))


def _strains(
    kernel: Callable[..., Any], x: ArrayLike, triads: ArrayLike, x0: ArrayLike, triads0: ArrayLike
) -> BeamStrains:
    of = _geometry(x, triads, x0, triads0)
    _take_stiffness(of, **dict.fromkeys(("ea", "ga2", "ga3", "gj", "ei2", "ei3"), 1.0))
    of.array("stress_free_strain", 0.0)
    of.array("sigma", np.zeros(6), (6,))
    return BeamStrains(*map(of.result, of.call(_BEAM_SHAPES, kernel, *of.columns(), False, False, 0, of.n)[4:]))


def _geometry(x: ArrayLike, triads: ArrayLike, x0: ArrayLike, triads0: ArrayLike) -> Batch:
    """Take positions and triads, after checking them."""
    of = Batch()
    of.take("x", checks.element("x", x), 2)
    # the columns of a triad are contiguous in the kernel
    of.take("triads", np.swapaxes(checks.triads("triads", triads, 2), -1, -2), 3)
    of.take("x0", checks.element("x0", x0), 2)
    of.take("triads0", np.swapaxes(checks.triads("triads0", triads0, 2), -1, -2), 3)
    return of

"""Deflection of a long solid cylinder under a load along a generator, exact in cylindrical harmonics and wave numbers.

Source: the displacements of P. F. Papkovich and H. Neuber, u = grad(phi) + curl(psi e_z) + 4 (1 - nu) B - grad(x . B), with
harmonic phi, psi and B across the axis, in modified Bessel functions I_n(k r). Deflections are those of the surface from the
mean of the section, without what beams have: bending (1/k^4) and shear (1/k^2). Lengths are over the radius.

In a half-space the deflection goes with 1/s at distances s; in a wire it ends where the section takes the load.
"""

import functools

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.special import j1

#: Half width of the strip under the generator, which the difference to a half-space does not depend on
WIDTH = 0.06
#: Half lengths of strips at which that is computed
LENGTHS = np.array(
    [0.05, 0.075, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.75, 0.9, 1.1, 1.3, 1.6, 2, 2.5, 3, 4, 5, 6, 8]
)
#: Wave numbers below which the beam is taken off by the series of the rest
LONG_WAVES = 0.25


def ratio_of_bessel(n, x):
    """I_(n+1)(x)/I_n(x), by its continued fraction."""
    last = n + 60 + int(np.ceil(x.max()))
    ratio = x / (2 * (last + 1))
    for j in range(last, n, -1):
        ratio = 1 / (2 * j / x + ratio)
    return ratio


def deflection(n, k, poisson):
    """Inward radial displacement by the pressure cos(n theta) cos(k z), radius and shear modulus being 1."""
    lame = 2 * poisson / (1 - 2 * poisson)
    value, following = np.ones_like(k), ratio_of_bessel(n, k)
    first = following + n / k
    second = 1 + n**2 / k**2 - first / k
    first_following = 1 - (n + 1) / k * following
    second_following = (1 + (n + 1) ** 2 / k**2) * following - first_following / k
    zero, c = np.zeros_like(k), 4 * (1 - poisson)
    arm, arm_1 = following, following + k * first_following
    arm_2 = 2 * k * first_following + k**2 * second_following
    # radial, tangential and axial displacement, and their derivatives by r
    solutions = (
        (k * first, -n * value, -k * value, k**2 * second, -n * (k * first - value), -(k**2) * first),
        (n * value, -k * first, zero, n * (k * first - value), -(k**2) * second, zero),
        (
            c * following - arm_1, (c + n) * following, k * arm,
            c * k * first_following - arm_2, (c + n) * k * first_following, k * arm_1,
        ),
    )  # fmt: skip
    tractions = np.zeros((*k.shape, 3, 3))
    for j, (u, v, w, du, dv, dw) in enumerate(solutions):
        tractions[..., 0, j] = lame * (du + u + n * v + k * w) + 2 * du
        tractions[..., 1, j] = -n * u + dv - v
        tractions[..., 2, j] = -k * u + dw
    load = np.zeros((*k.shape, 3, 1))
    load[..., 0, 0] = -1
    parts = np.linalg.solve(tractions, load)[..., 0]
    return -sum(parts[..., j] * solutions[j][0] for j in range(3))


def without_beam(k, poisson):
    """The same of n = 1, less what bends and shears the beam."""
    few = np.array([0.02, 0.03, 0.04, 0.05, 0.06, 0.08])
    powers = np.stack([few**0, few**2, few**4, few**6], axis=1)
    bending, shear, rest, next_one = np.linalg.lstsq(powers, deflection(1, few, poisson) * few**4, rcond=None)[0]
    return np.where(k < LONG_WAVES, rest + next_one * k**2, deflection(1, k, poisson) - bending / k**4 - shear / k**2)


def approach_of_strips(half_lengths, poisson, half_width=WIDTH):
    """Deflection in the middle of strips that are pressed evenly along them, over f (1 - nu^2)/(pi E)."""
    highest = 12 / half_width
    step = min(0.02, 0.1 / max(half_lengths))
    k = np.arange(step / 2, highest, step)
    total = np.zeros_like(k)
    for n in range(int(highest) + 1):
        across = 1.0 if n == 0 else 2 * j1(n * half_width) / (n * half_width)
        of_load = across / (2 * np.pi if n == 0 else np.pi)
        total += of_load * (without_beam(k, poisson) if n == 1 else deflection(n, k, poisson))
    return np.array([2 * (1 + poisson) * np.pi / (1 - poisson**2) * np.sum(
        2 / np.pi * step * np.sin(k * a) / k * total) for a in half_lengths])  # fmt: skip


def approach_in_half_space(half_length, half_width=WIDTH):
    """The same of a half-space."""
    y = (np.arange(4000) + 0.5) / 4000 * half_width
    pressure = 2 / (np.pi * half_width**2) * np.sqrt(half_width**2 - y**2)
    return np.sum(pressure * 2 * np.arcsinh(half_length / y)) * 2 * half_width / 4000


@functools.cache
def _course(poisson):
    less = [approach_in_half_space(a) for a in LENGTHS] - approach_of_strips(LENGTHS, poisson)
    return CubicSpline(np.append(0, LENGTHS), np.append(0, less))


def less_than_half_space(distance, poisson):
    """By how much a force deflects the generator less than in a half-space, over F (1 - nu^2)/(pi E r)."""
    far = 1 / np.maximum(distance, LENGTHS[-1])
    return np.where(distance < LENGTHS[-1], _course(poisson)(np.minimum(distance, LENGTHS[-1]), 1) / 2, far)

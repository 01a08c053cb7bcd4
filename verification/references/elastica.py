"""The elastica: bending of an inextensible, shear-rigid rod in its plane, by elliptic integrals.

Source: K. E. Bisshopp, D. C. Drucker, "Large deflection of cantilever beams", Quart. Appl. Math. 3 (1945) 272-275, in
the form of Legendre's integrals; the same digits as K. Mattiasson, Int. J. Numer. Methods Eng. 17 (1981) 145-153,
table 1. Computed with mpmath to 20 digits.
"""

import mpmath as mp


def cantilever(alpha):
    """Deflection w/L, shortening u/L and tip angle [rad] of a cantilever under a transverse dead load at its tip.

    alpha = P L^2/(E I). The modulus k solves K(k) - F(asin(1/(k sqrt 2)), k) = sqrt(alpha).
    """
    with mp.workdps(25):
        root = mp.sqrt(mp.mpf(alpha))

        def phi(k):
            return mp.asin(1 / (k * mp.sqrt(2)))

        def excess(k):
            return mp.ellipk(k**2) - mp.ellipf(phi(k), k**2) - root

        low, high = mp.sqrt(mp.mpf(1) / 2) * (1 + mp.mpf(10) ** -15), 1 - mp.mpf(10) ** -12
        k = mp.findroot(excess, (low, high), solver="anderson", tol=1e-36, maxsteps=300)
        deflection = 1 - 2 / root * (mp.ellipe(k**2) - mp.ellipe(phi(k), k**2))
        shortening = 1 - mp.sqrt(2 * (2 * k**2 - 1) / mp.mpf(alpha))
        angle = mp.asin(2 * k**2 - 1)
        return float(deflection), float(shortening), float(angle)


def column(load_ratio):
    """Tip deflection w/L and shortening u/L of a clamped-free column beyond its Euler load.

    load_ratio = P/P_E > 1 with P_E = pi^2 E I/(4 L^2). The modulus k = sin(tip angle/2) solves K(k) = (pi/2) sqrt(P/P_E).
    Source: S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed., section 2.7.
    """
    with mp.workdps(25):
        length = mp.pi / 2 * mp.sqrt(mp.mpf(load_ratio))
        bracket = mp.mpf("1e-8"), 1 - mp.mpf(10) ** -12
        k = mp.findroot(lambda k: mp.ellipk(k**2) - length, bracket, solver="anderson")
        return float(2 * k / length), float(2 - 2 * mp.ellipe(k**2) / length)

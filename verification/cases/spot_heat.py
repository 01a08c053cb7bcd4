"""Heat of a contact spot and its hottest place, against the equations of current and heat in the constriction.

In both wires potential and temperature depend on one harmonic coordinate w alone, from 0 deep in wire 1 to 1 deep in wire 2:

    (sigma phi')' = 0,   (lambda T')' + sigma phi'^2 = 0

The heat conductance is constant in either wire; the resistivity is that of a Wiedemann-Franz metal, L T/lambda, or constant.
The kernel knows only what follows from this for the ends (F. Kohlrausch; R. Holm, Electric Contacts; J. A. Greenwood, J. B. P.
Williamson): heats and hottest temperature for a voltage, a current and the temperatures of both wires.
"""

import numpy as np
from scipy.integrate import solve_bvp

from litz import kernels
from verification import figures

LORENZ = 2.44e-8
#: Conductance of the constriction to heat [W/K], and resistances of constant wires to the current [ohm]
PASSES, OHMS = (2.0e-2, 5.0e-2), (1.0e-3, 0.2e-3)
BULKS = (300.0, 500.0)
VOLTS = (0.02, 0.1, 0.3)


def solve(volts, bulks, passes, resistance):
    """Current, heats into both wires, hottest temperature; `resistance(side, T)` and `passes` are those of a half of w."""

    def slopes(w, y):
        """Of the potential, the temperature and the heat that flows towards larger w in either half; the current."""
        current = y[6, 0]
        rows = []
        for side in (0, 1):
            rho = resistance(side, y[3 * side + 1])
            rows += [-current * rho, -y[3 * side + 2] / passes[side], current**2 * rho]
        return np.array([*rows, np.zeros_like(w)])

    def ends(a, b):
        return np.array([
            a[0] - volts, a[1] - bulks[0], b[0] - a[3], b[1] - a[4], b[2] - a[5], b[3], b[4] - bulks[1],
        ])  # fmt: skip

    w = np.linspace(0, 1, 401)
    middle = np.mean(bulks)
    current = volts / (resistance(0, middle) + resistance(1, middle))
    start = np.zeros((7, w.size))
    start[1], start[4], start[6] = middle, middle, current
    start[0], start[3] = volts * (1 - w / 2), volts * (1 - w) / 2
    found = solve_bvp(slopes, ends, w, start, tol=1e-11, max_nodes=200000)
    fine = found.sol(np.linspace(0, 1, 200001))
    return found.y[6, 0], -found.y[2, 0], found.y[5, -1], max(fine[1].max(), fine[4].max())


def metals(side, temperature):
    """Of one metal, whose constriction passes PASSES[0] on either side."""
    return LORENZ * temperature / PASSES[0]


def constant(side, temperature):
    return OHMS[side] * np.ones_like(temperature)


def exact_metals():
    """Of spots in one Wiedemann-Franz metal: equal and unequal bulks."""
    return [solve(v, bulks, (PASSES[0],) * 2, metals) for v in VOLTS for bulks in ((BULKS[0],) * 2, BULKS)]


def exact_constants():
    """Of two metals of constant conductivities."""
    return [solve(v, bulks, PASSES, constant) for v in VOLTS for bulks in ((BULKS[0],) * 2, BULKS)]


def by_kernel(cases, **wires):
    """Heats and hottest temperature of the kernel, with the current of each case."""
    values = []
    for (current, *_), (volts, bulks) in zip(
        cases, ((v, b) for v in VOLTS for b in ((BULKS[0],) * 2, BULKS)), strict=True
    ):
        spot = kernels.spot_heat(volts, bulks, current=current, **wires)
        values += [*spot.heat, spot.hottest]
    return [float(value) for value in values]


def measure(workspace):
    of_metals, of_constants = exact_metals(), exact_constants()
    return {
        "spot_heat.metal": by_kernel(of_metals, lorenz=LORENZ),
        "spot_heat.two_metals": by_kernel(of_constants, resistivity=OHMS, heat_conductance=PASSES),
        "figure": of_metals,
    }


def draw(values, path):
    """Hottest temperature over the voltage."""
    volts = np.linspace(0.0, 0.35, 141)
    with figures.panels(path, columns=1) as axes:
        for bulks, start in (((BULKS[0],) * 2, 0), (BULKS, 1)):
            hottest = [kernels.spot_heat(v, bulks, conductance=1.0, lorenz=LORENZ).hottest for v in volts]
            axes.plot(volts, hottest, label=f"kernel, wires of {bulks[0]:g} and {bulks[1]:g} K")
            axes.plot(
                VOLTS, [case[3] for case in values["figure"][start::2]], "o", label="equations of the constriction"
            )
        axes.set(xlabel="voltage [V]", ylabel="hottest temperature [K]")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["spot_heat"]))

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


def cases():
    """Voltages and temperatures of both wires."""
    return [(volts, bulks) for volts in VOLTS for bulks in ((BULKS[0],) * 2, BULKS)]


def references():
    """Heats and hottest temperature in each case: of a Wiedemann-Franz metal, and of two metals of constant conductivities."""
    of_metals = [solve(*case, (PASSES[0],) * 2, metals) for case in cases()]
    of_constants = [solve(*case, PASSES, constant) for case in cases()]
    return [[float(value) for row in rows for value in row[1:]] for rows in (of_metals, of_constants)]


def current_of_metals(volts, bulks):
    """The current, by the relation of Kohlrausch: T^2 = T_max^2 - v^2/L at the voltage v from the hottest place."""
    from_hottest = volts / 2 + np.array([1, -1]) * LORENZ * (bulks[1] ** 2 - bulks[0] ** 2) / (2 * volts)
    hottest = np.sqrt(bulks[0] ** 2 + from_hottest[0] ** 2 / LORENZ)
    return PASSES[0] / (2 * np.sqrt(LORENZ)) * np.arcsin(from_hottest / (np.sqrt(LORENZ) * hottest)).sum()


def by_kernel(current, **wires):
    """The same from the kernel, which is told the current."""
    values = []
    for volts, bulks in cases():
        spot = kernels.spot_heat(volts, bulks, current=current(volts, bulks), **wires)
        values += [*spot.heat, spot.hottest]
    return [float(value) for value in values]


def measure(workspace):
    return {
        "spot_heat.metal": by_kernel(current_of_metals, lorenz=LORENZ),
        "spot_heat.two_metals": by_kernel(
            lambda volts, bulks: volts / sum(OHMS), resistivity=OHMS, heat_conductance=PASSES
        ),
    }


def draw(values, path):
    """Hottest temperature over the voltage."""
    volts = np.linspace(0.0, 0.35, 141)
    hottest = values["spot_heat.metal"][2::3]
    with figures.panels(path, columns=1) as axes:
        for k, bulks in enumerate(((BULKS[0],) * 2, BULKS)):
            curve = [kernels.spot_heat(v, bulks, conductance=1.0, lorenz=LORENZ).hottest for v in volts]
            axes.plot(volts, curve, label=f"wires of {bulks[0]:g} and {bulks[1]:g} K")
            axes.plot(VOLTS, hottest[k::2], "o")
        axes.set(xlabel="voltage [V]", ylabel="hottest temperature [K]")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["spot_heat"]))

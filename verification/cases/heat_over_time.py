"""Temperatures of single wires over time: a bar between hot ends, a fuse, a wire that cools down.

Source: H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 2nd ed. (1959), section 3.3 (the series of a bar whose
ends are heated at once). Adiabatic heating with a resistivity that is linear in the temperature, T - T0 =
(exp(alpha k t) - 1)/alpha with k = I^2 rho0/(A^2 rho_m c): the formula of I. M. Onderdonk for the melting of fuses, see
E. R. Stauffacher, General Electric Review 31 (1928) 326; melting itself takes the latent heat at the power of that
temperature. A wire that a film cools: Newton's law, exp(-2 h t/(rho_m c r)).
"""

import numpy as np

from verification import figures
from verification.cases.warm_wires import (
    AREA,
    CONDUCTIVITY,
    FILM,
    LENGTH,
    LINEAR,
    RADIUS,
    RESISTIVITY,
    ROOM,
    SLOPE,
)

DENSITY, HEAT, LATENT, MELTING = 8960.0, 385.0, 205e3, 1357.0
DIFFUSIVITY = CONDUCTIVITY / (DENSITY * HEAT)
AMPERES, AROUND = 200.0, 250.0
#: Rate of the rise at room temperature [K/s], and the time at which melting begins [s]
RATE = AMPERES**2 * RESISTIVITY / (AREA**2 * DENSITY * HEAT)
BEGINS = np.log1p(SLOPE * (MELTING - ROOM)) / (SLOPE * RATE)
#: Time that melting takes at the power of its beginning; the kelvin over which it goes adds its own heat [s]
MELTS = (LATENT + HEAT) / (HEAT * RATE * (1 + SLOPE * (MELTING + 0.5 - ROOM)))
#: Time constant of the wire that a film cools [s]
CONSTANT = DENSITY * HEAT * RADIUS / (2 * FILM)
#: Time of the bar, in units of L^2/kappa, and its elements
FOURIER, BAR = 0.1, 64


def deck(elements, increments, *, length=LENGTH, procedure="", loads=""):
    """A wire along x, insulated unless the loads say otherwise."""
    nodes = "".join(f" {i}, {x:.17g}, 0, 0\n" for i, x in enumerate(np.linspace(0, length, elements + 1), 1))
    members = "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, elements + 1))
    return (
        "*HEADING\n A single wire: temperatures over time\n"
        f"*NODE, NSET=ALL\n{nodes}*ELEMENT, TYPE=B33, ELSET=WIRE\n{members}"
        "*MATERIAL, NAME=COPPER\n*ELASTIC\n 120.e9, 0.34\n"
        f"*ELECTRICAL CONDUCTIVITY\n{LINEAR}*CONDUCTIVITY\n {CONDUCTIVITY}\n*DENSITY\n {DENSITY}\n*SPECIFIC HEAT\n {HEAT}\n"
        f"*LATENT HEAT\n {LATENT}, {MELTING}, {MELTING + 1}\n"
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC\n {RADIUS}\n*NSET, NSET=ENDS\n 1, {elements + 1}\n"
        f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n ALL, {ROOM}\n*STEP, INC=100000\n"
        f"*COUPLED THERMAL-ELECTRICAL{procedure}\n {increments}\n*BOUNDARY\n {elements + 1}, 9\n{loads}*END STEP\n"
    )


def fuse(workspace, name, end):
    """Temperature of an insulated wire under a current, in 400 increments up to a time."""
    text = deck(2, f"{end / 400:.17g}, {end:.17g}", loads=f"*CECURRENT\n 1, , {AMPERES}\n")
    return workspace.run(name, text).field("temperature")[0]


def bar(workspace):
    """Temperatures of a bar whose ends have been heated by 100 K at once, over its length."""
    time = FOURIER * LENGTH**2 / DIFFUSIVITY
    text = deck(BAR, f"{time / 1024:.17g}, {time:.17g}", loads=f"*BOUNDARY\n ENDS, 11, 11, {ROOM + 100}\n")
    return workspace.run("bar", text).field("temperature")


def cooled(workspace):
    """Of a wire in a film, after one time constant, with increments that add 1e-4 K of error each."""
    text = deck(2, f"{1e-4 * CONSTANT:.17g}, {CONSTANT:.17g}, {1e-7 * CONSTANT:.17g}", length=1e-3,
                procedure=", ERROR=1e-4", loads=f"*FILM\n WIRE, F, {AROUND}, {FILM}\n")  # fmt: skip
    return workspace.run("cooled", text).field("temperature")[0]


def measure(workspace):
    profile = bar(workspace)
    return {
        "heat_over_time.fuse": fuse(workspace, "fuse", BEGINS) - ROOM,
        "heat_over_time.melting": fuse(workspace, "melting", BEGINS + MELTS / 2) - MELTING,
        "heat_over_time.bar": profile[[BAR // 4, BAR // 2]] - ROOM,
        "heat_over_time.cooled": cooled(workspace) - AROUND,
        "figure": profile,
    }


def draw(values, path):
    """The bar, and the series."""
    with figures.panels(path, columns=1) as axes:
        s = np.linspace(0, 1, BAR + 1)
        odd = np.arange(1, 30, 2)[:, None]
        series = 100 - 400 / np.pi * (np.sin(np.pi * odd * s) / odd * np.exp(-((np.pi * odd) ** 2) * FOURIER)).sum(0)
        axes.plot(1e3 * LENGTH * s, values["figure"] - ROOM, label="litz, 64 elements")
        axes.plot(1e3 * LENGTH * s[::4], series[::4], "k.", markersize=4, label="series")
        axes.set(xlabel="x [mm]", ylabel="rise [K]")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["heat_over_time"]))

"""Steady currents and temperatures in single wires: Joule heat, films, radiation, properties over temperature.

Source: H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 2nd ed. (1959): section 1.6 for Kirchhoff's
variable, 4.9 to 4.11 for wires heated by a current (the parabola, the fin with its heat, and a resistivity that is
linear in the temperature, whose steady state ends at I = (pi A/L) sqrt(lambda/(rho0 alpha))). On a mesh of n elements with
the resistivity of their mean temperatures the difference equation has the solution cos(2 p i)/cos(n p) with
tan p = m L/(2 n), counted from the middle. A resistivity that rises as exp(b (T - T0)): D. A. Frank-Kamenetskii, Acta
Physicochim. URSS 10 (1939) 365, has the same equation for a slab; no state is steady above
I^2 rho0 b L^2/(4 lambda A^2) = 0.87846. A wire that only radiates: the law of Stefan and Boltzmann.
"""

import contextlib
import warnings

import numpy as np

import litz
from verification import figures

LENGTH, RADIUS, ROOM, CONDUCTIVITY, RESISTIVITY, SLOPE = 0.1, 0.5e-3, 300.0, 390.0, 1.72e-8, 4e-3
AREA = np.pi * RADIUS**2
FILM, AROUND, EMISSIVITY, SIGMA = 40.0, 290.0, 0.8, 5.670374419e-8
#: Shares of the burn-out current
SHARES = (0.3, 0.6, 0.9)
#: The same on coarse meshes, and these
COARSE_SHARES, MESHES = (0.3, 0.6, 0.9, 0.99), (10, 40)
#: Exponent of the resistivity that rises exponentially [1/K], and the current of its fold
EXPONENT = 0.01
FOLD = 2 * AREA / LENGTH * np.sqrt(0.878457679781290 * CONDUCTIVITY / (RESISTIVITY * EXPONENT))
BURN_OUT = np.pi * AREA / LENGTH * np.sqrt(CONDUCTIVITY / (RESISTIVITY * SLOPE))
#: Resistivity linear from 100 K on, as conductivities at two temperatures
LINEAR = "".join(f" {1 / (RESISTIVITY * (1 + SLOPE * (t - ROOM))):.17g}, {t:.17g}\n" for t in (100.0, 1e7))

#: Resistivity exp(b (T - T0)), 1/200 of its exponent from point to point, far beyond the fold
EXPONENTIAL = "".join(
    f" {np.exp(-b) / RESISTIVITY:.17g}, {ROOM + b / EXPONENT:.17g}\n" for b in np.arange(-0.5, 3.0, 0.005)
)


def deck(elements, *, ends, supply, sigma=f" {1 / RESISTIVITY:.17g}\n", conductivity=f" {CONDUCTIVITY}\n", loads=""):
    """A wire along x with a node set of its ends."""
    nodes = "".join(f" {i}, {x:.17g}, 0, 0\n" for i, x in enumerate(np.linspace(0, LENGTH, elements + 1), 1))
    members = "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, elements + 1))
    return (
        "*HEADING\n A single wire: steady currents and temperatures\n"
        f"*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0, STEFAN BOLTZMANN={SIGMA}\n"
        f"*NODE, NSET=ALL\n{nodes}*ELEMENT, TYPE=B33, ELSET=WIRE\n{members}"
        "*MATERIAL, NAME=COPPER\n*ELASTIC\n 120.e9, 0.34\n"
        f"*ELECTRICAL CONDUCTIVITY\n{sigma}*CONDUCTIVITY\n{conductivity}"
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC\n {RADIUS}\n*NSET, NSET=ENDS\n 1, {elements + 1}\n"
        f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n ALL, {ROOM}\n*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n"
        f"*BOUNDARY\n {elements + 1}, 9\n{ends}{supply}{loads}*END STEP\n"
    )


def fixed(potential):
    """Both ends at room temperature, a voltage between them."""
    return dict(ends=f" ENDS, 11, 11, {ROOM}\n", supply=f" 1, 9, 9, {potential}\n")


def current(amperes):
    """Both ends at room temperature, a current through the wire."""
    return dict(ends=f" ENDS, 11, 11, {ROOM}\n", supply=f"*CECURRENT\n 1, , {amperes:.17g}\n")


def warm_profile(share, x):
    """Rise of a wire under a share of the burn-out current, x from its middle."""
    m = share * np.pi / LENGTH
    return (np.cos(m * x) / np.cos(m * LENGTH / 2) - 1) / SLOPE


def largest_steady_current(workspace, name, amperes, sigma):
    """What a run has reached when it ends because no temperature is steady any more."""
    with contextlib.suppress(litz.NotConvergedError):
        workspace.run(name, deck(200, **current(amperes), sigma=sigma))
    with warnings.catch_warnings():
        # that the run has not finished is what is expected
        warnings.simplefilter("ignore")
        return np.abs(litz.Results(workspace.directory / name).field("element_current")).max()


def measure(workspace):
    def temperature(name, elements, **options):
        return workspace.run(name, deck(elements, **options)).field("temperature")

    film = f"*FILM\n WIRE, F, {AROUND}, {FILM}\n"
    values = {
        "warm_wires.joule": temperature("joule", 4, **fixed(0.05))[1:4] - ROOM,
        "warm_wires.fin": temperature("fin", 4, ends=" 1, 11, 11, 400\n", supply=" 1, 9\n", loads=film)[1:],
        "warm_wires.heated_fin": temperature("heated_fin", 4, **fixed(0.05), loads=film)[1:4],
        "warm_wires.kirchhoff": temperature(
            "kirchhoff", 4, ends=" 1, 11, 11, 900\n 5, 11, 11, 300\n", supply=" 1, 9\n",
            conductivity=" 200, 200\n 1200, 1200\n")[1:4],
        "warm_wires.radiation": temperature(
            "radiation", 4, ends="", supply=" 1, 9, 9, 0.05\n", loads=f"*RADIATE\n WIRE, R, {AROUND}, {EMISSIVITY}\n").max(),
    }  # fmt: skip
    profiles = [temperature(f"current_{share:g}", 200, **current(share * BURN_OUT), sigma=LINEAR) for share in SHARES]
    values["warm_wires.rising_resistivity"] = [profile.max() - ROOM for profile in profiles]
    values["warm_wires.meshes"] = [
        temperature(f"mesh_{n}_{share:g}", n, **current(share * BURN_OUT), sigma=LINEAR).max() - ROOM
        for n in MESHES for share in COARSE_SHARES
    ]  # fmt: skip
    values["warm_wires.burn_out"] = largest_steady_current(workspace, "burn_out", 1.2 * BURN_OUT, LINEAR)
    largest = largest_steady_current(workspace, "fold", 1.2 * FOLD, EXPONENTIAL)
    values["warm_wires.fold"] = largest**2 * RESISTIVITY * EXPONENT * LENGTH**2 / (4 * CONDUCTIVITY * AREA**2)
    values["figure"] = profiles
    return values


def draw(values, path):
    """Profiles of temperature, and what the source says."""
    with figures.panels(path, columns=1) as axes:
        x = np.linspace(-LENGTH / 2, LENGTH / 2, 201)
        for share, profile in zip(SHARES, values["figure"], strict=True):
            axes.semilogy(1e3 * x[1:-1], profile[1:-1] - ROOM, label=f"{share:g} of the burn-out current")
            axes.semilogy(1e3 * x[1:-1:10], warm_profile(share, x[1:-1:10]), "k.", markersize=4)
        axes.set(xlabel="x [mm]", ylabel="rise [K]")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["warm_wires"]))

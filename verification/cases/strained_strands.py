"""Critical currents of strands over strain, temperature and field, and the strain that cooling down leaves in a pair.

Source: L. Bottura, B. Bordini, IEEE Trans. Appl. Supercond. 19 (2009) 1521-1524 (ITER-2008 parametrization); L. Bottura, IEEE
Trans. Appl. Supercond. 10 (2000) 1054-1057 (NbTi). S. Timoshenko, Strength of Materials I, 3rd ed. (1955), chapter I: of two
bars that are joined at their ends one contracts more, and both have one length; with the stiffnesses k = E A the strain of
the first is (alpha2 - alpha1) dT k2/(k1 + k2).
"""

import numpy as np
from scipy.optimize import brentq

from verification import figures
from verification.cases.superconducting_wires import AREA, CRITERION, LENGTH, PART, RADIUS, SIGMA, N, current_of

#: C, Bc20, Tc0, p, q, Ca1, Ca2, e0, em of a strand whose function of the strain is not symmetric
STRAND = (4e10, 32.57, 17.17, 0.7, 2.1, 45.74, 4.431, 2.32e-3, -0.61e-3)
#: Axial strains, temperatures [K], flux density [T], current of the sharing temperatures [A]
STRAINS, TEMPERATURES, FLUX, CURRENT = (-8e-3, -6e-3, -4e-3, -2e-3, 0.0, 3e-3), (4.2, 5.5, 7.0), 11.5, 60.0
#: jref, C0, Bc20, Tc0, alpha, beta, gamma of NbTi, and its places: K, T
NBTI, PLACES = (3e9, 27.04, 14.5, 9.2, 0.57, 0.9, 2.32), ((1.9, 9.0), (4.2, 5.0), (4.2, 8.0), (6.5, 3.0))
#: Of the pair: Young's moduli and expansions of strand and copper wire, radius of the latter; heat treatment and cold [K]
YOUNG, ALPHA, COPPER_RADIUS, TREATED, COLD = (110e9, 120e9), (9e-6, 17e-6), 0.3e-3, 923.0, 4.2


def critical_of_nb3sn(temperature, flux, strain):
    """The parametrization of Nb3Sn, as published [A/m^2]."""
    c, bc20, tc0, p, q, ca1, ca2, e0, em = STRAND
    shift = ca2 * e0 / np.sqrt(ca1**2 - ca2**2)
    e = strain - em
    s = 1 + (ca1 * (np.hypot(shift, e0) - np.hypot(e - shift, e0)) - ca2 * e) / (1 - ca1 * e0)
    t = temperature / (tc0 * s ** (1 / 3))
    b = np.minimum(flux / (bc20 * s * np.maximum(1 - t**1.52, 1e-9)), 1.0)
    return c / flux * s * (1 - t**1.52) * (1 - t**2) * b**p * (1 - b) ** q


def critical_of_nbti(temperature, flux):
    """The fit of NbTi, as published [A/m^2]."""
    jref, c0, bc20, tc0, alpha, beta, gamma = NBTI
    rest = 1 - (temperature / tc0) ** 1.7
    b = flux / (bc20 * rest)
    return jref * c0 / flux * b**alpha * (1 - b) ** beta * rest**gamma


def sharing_temperature(strain):
    """Where E = Ec at the current of this file [K]."""
    excess = lambda t: current_of(CRITERION, critical_of_nb3sn(t, FLUX, strain)) - CURRENT  # noqa: E731
    return brentq(excess, 1.0, 9.0, xtol=1e-13)


def mismatch():
    """Strain of the strand of the pair."""
    k = [young * np.pi * radius**2 for young, radius in zip(YOUNG, (RADIUS, COPPER_RADIUS), strict=True)]
    return (ALPHA[1] - ALPHA[0]) * (COLD - TREATED) * k[1] / sum(k)


def deck(wires, current):
    """Wires of three elements side by side: law of the filaments, temperature, strain by a prescribed length of each."""
    nodes = elements = model = warmth = held = fed = ""
    for i, (law, temperature, strain) in enumerate(wires):
        first, y = 10 * i + 1, 0.01 * i
        names = [first + j for j in range(4)]
        nodes += "".join(
            f" {n}, {x:.17g}, {y:.17g}, 0\n" for n, x in zip(names, np.linspace(0, LENGTH, 4), strict=True)
        )
        elements += f"*ELEMENT, TYPE=B33, ELSET=W{i}\n" + "".join(f" {n}, {n}, {n + 1}\n" for n in names[:3])
        model += (
            f"*MATERIAL, NAME=M{i}\n*ELASTIC\n {YOUNG[0]}, 0.3\n*ELECTRICAL CONDUCTIVITY\n {SIGMA}\n"
            f"*SUPERCONDUCTOR, N={N}, FRACTION={PART}, {law}\n*BEAM SECTION, ELSET=W{i}, MATERIAL=M{i}, SECTION=CIRC\n {RADIUS}\n"
        )
        warmth += "".join(f" {n}, {temperature:.17g}\n" for n in names)
        held += f" {first}, ENCASTRE\n {first}, 9\n" + "".join(f" {n}, 2, 6\n" for n in names[1:])
        fed += f"*BOUNDARY\n {first + 3}, 1, 1, {strain * LENGTH:.17g}\n*CECURRENT\n {first + 3}, , {-current}\n"
    return (
        f"*HEADING\n Strands under strain\n*NODE\n{nodes}{elements}{model}*INITIAL CONDITIONS, TYPE=TEMPERATURE\n{warmth}"
        f"*BOUNDARY\n{held}*STEP\n*STATIC\n{fed}*END STEP\n"
    )


def nb3sn(flux=FLUX):
    """The law of Nb3Sn for a deck."""
    return f"LAW=NB3SN, FIELD={flux}\n {', '.join(map(str, STRAND))}"


def pair_deck():
    """A strand and a copper wire that have one length, from the heat treatment to the cold."""
    x = np.linspace(0, LENGTH, 4)
    lines = [f" {10 * k + i}, {place:.17g}, {0.01 * k}, 0" for k in range(2) for i, place in enumerate(x, 1)]
    rows = ["\n".join(f" {10 * k + i}, {10 * k + i}, {10 * k + i + 1}" for i in (1, 2, 3)) for k in range(2)]
    members = [f"*ELEMENT, TYPE=B33, ELSET=W{k}\n{row}" for k, row in enumerate(rows)]
    guided = [f" {10 * k + i}, 2, 6" for k in range(2) for i in (2, 3, 4)]
    metal = f"*ELECTRICAL CONDUCTIVITY\n {SIGMA}\n*SUPERCONDUCTOR, N={N}, FRACTION={PART}, {nb3sn()}\n"
    materials = [
        f"*MATERIAL, NAME=M{k}\n*ELASTIC\n {YOUNG[k]}, 0.3\n*EXPANSION\n {ALPHA[k]}\n{'' if k else metal}"
        f"*BEAM SECTION, ELSET=W{k}, MATERIAL=M{k}, SECTION=CIRC\n {COPPER_RADIUS if k else RADIUS}"
        for k in range(2)
    ]
    return "\n".join([
        "*HEADING", " A strand and a copper wire that are joined at their ends cool down", "*NODE, NSET=ALL", *lines, *members,
        *materials, "*EQUATION", " 2", " 14, 1, 1., 4, 1, -1.", "*INITIAL CONDITIONS, TYPE=TEMPERATURE", f" ALL, {TREATED}",
        "*BOUNDARY", " 1, ENCASTRE", " 11, ENCASTRE", *guided, " 1, 9", "*STEP", "*STATIC", " 0.25, 1.",
        "*TEMPERATURE", f" ALL, {COLD}", "*CECURRENT", " 4, , -1", "*END STEP", "",
    ])  # fmt: skip


def measure(workspace):
    """All values of this case."""
    density = lambda results: results.field("critical_current")[::3] / (PART * AREA)  # noqa: E731
    scan = workspace.run("scan", deck([(nb3sn(), t, e) for t in TEMPERATURES for e in STRAINS], 1.0))
    sharing = workspace.run("sharing", deck([(nb3sn(), sharing_temperature(e), e) for e in STRAINS], CURRENT))
    fit = f"LAW=NBTI, FIELD={{}}\n {', '.join(map(str, NBTI))}"
    nbti = workspace.run("nbti", deck([(fit.format(b), t, 0.0) for t, b in PLACES], 1.0))
    pair = workspace.run("pair", pair_deck())
    strand = pair.field("critical_current")[0] / (PART * AREA)
    return {
        "strained_strands.nb3sn": density(scan),
        "strained_strands.sharing": sharing.field("electric_field")[::3] / CRITERION,
        "strained_strands.nbti": density(nbti),
        "strained_strands.mismatch": pair.field("axial_force")[0] / (YOUNG[0] * AREA),
        "strained_strands.pair": strand,
        "figure": density(scan),
    }


def draw(values, path):
    """Critical current densities over the strain, and the parametrization."""
    with figures.panels(path, columns=1) as axes:
        strain = np.linspace(-9e-3, 4e-3, 200)
        rows = np.reshape(values["figure"], (len(TEMPERATURES), len(STRAINS)))
        for temperature, row in zip(TEMPERATURES, rows, strict=True):
            (line,) = axes.plot(
                100 * strain, 1e-6 * critical_of_nb3sn(temperature, FLUX, strain), label=f"{temperature} K"
            )
            axes.plot(100 * np.array(STRAINS), 1e-6 * row, "o", color=line.get_color())
        axes.plot(100 * mismatch(), 1e-6 * values["strained_strands.pair"], "k*", markersize=8, label="cooled pair")
        axes.set(
            xlabel="strain [%]",
            ylabel="critical current density [A/mm$^2$]",
            title=f"Nb$_3$Sn at {FLUX} T; points: litz",
            ylim=(0, 700),
        )
        axes.legend(ncols=2, loc="upper left")


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["strained_strands"]))

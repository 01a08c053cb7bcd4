"""Wires with superconducting filaments: the law of filaments and metal in parallel, critical currents, current sharing.

Source: L. Bottura, B. Bordini, IEEE Trans. Appl. Supercond. 19 (2009) 1521 (ITER-2008 parametrization); its values in the
systems code PROCESS (UKAEA, tests of `itersc`) at 13 T and 0.16 % of strain, for a strand of 0.82 mm with C = 19922 A T
that is half copper. The fields of the power law in parallel with a metal, and the temperature at which a current is shared,
are roots found by bisection.
"""

import numpy as np
from scipy.optimize import brentq

from verification import figures

RADIUS, LENGTH, SIGMA, N, CRITERION = 0.41e-3, 0.03, 5e9, 30, 1e-4
AREA, PART, CURRENT, FLUX = np.pi * RADIUS**2, 0.5, 100.0, 12.0
#: C, Bc20, Tc0, p, q, Ca1, Ca2, e0, em
STRAND = (19922 / (PART * AREA), 32.97, 16.06, 0.63, 2.1, 44.48, 0.0, 2.56e-3, 0.0)
#: Where the values of PROCESS are
PLACES, PLACE_FLUX, PLACE_STRAIN = (4.75, 6.251), 13.008974843466492, 0.001601605753441172
#: Fields of the I-V curve [V/m]
FIELDS = np.logspace(-10, 2, 13)


def deck(options, parameters, cards, static="1, 1", initial=4.2):
    """A wire along x, earthed at its first node."""
    nodes = "".join(f" {i}, {x:.17g}, 0, 0\n" for i, x in enumerate(np.linspace(0, LENGTH, 4), 1))
    return (
        "*HEADING\n A wire with superconducting filaments\n"
        f"*NODE, NSET=ALL\n{nodes}*ELEMENT, TYPE=B33, ELSET=WIRE\n 1, 1, 2\n 2, 2, 3\n 3, 3, 4\n"
        f"*MATERIAL, NAME=STRAND\n*ELASTIC\n 100.e9, 0.3\n*ELECTRICAL CONDUCTIVITY\n {SIGMA}\n"
        f"*SUPERCONDUCTOR, N={N}, FRACTION={PART}{options}\n {', '.join(f'{x:.17g}' for x in parameters)}\n"
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=STRAND, SECTION=CIRC\n {RADIUS}\n"
        f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n ALL, {initial}\n*BOUNDARY\n 1, ENCASTRE\n 1, 9\n"
        f"*STEP, INC=1000\n*STATIC\n {static}\n{cards}*END STEP\n"
    )


def current_of(field, critical):
    """I of the law (theory 18.1) [A]."""
    return AREA * ((1 - PART) * SIGMA * field + PART * critical * (field / CRITERION) ** (1 / N))


def critical_density(temperature, flux, strain):
    """The parametrization, as published [A/m^2]."""
    c, bc20, tc0, p, q, ca1, ca2, e0, em = STRAND
    shift = ca2 * e0 / np.sqrt(ca1**2 - ca2**2)
    e = strain - em
    s = 1 + (ca1 * (np.hypot(shift, e0) - np.hypot(e - shift, e0)) - ca2 * e) / (1 - ca1 * e0)
    t = temperature / (tc0 * s ** (1 / 3))
    b = flux / (bc20 * s * (1 - t**1.52))
    return c / flux * s * (1 - t**1.52) * (1 - t**2) * b**p * (1 - b) ** q


def sharing_temperature():
    """Where E = Ec at the current of this file [K]."""
    excess = lambda t: current_of(CRITERION, critical_density(t, FLUX, 0.0)) - CURRENT  # noqa: E731
    return brentq(excess, 4.2, 10.0, xtol=1e-12)


def measure(workspace):
    """All values of this case."""
    fields = []
    for i, field in enumerate(FIELDS):
        fed = f"*CECURRENT\n 4, , {-current_of(field, 2e9):.17g}\n"
        results = workspace.run(f"current_{i}", deck("", (2e9,), fed))
        fields.append(results.field("electric_field")[1])
    values = {"superconducting_wires.i_v": np.log10(fields), "figure": fields}
    values["superconducting_wires.critical_density"] = [
        workspace.run(
            f"strand_{t}",
            deck(f", LAW=NB3SN, FIELD={PLACE_FLUX:.17g}", STRAND, f"*BOUNDARY\n 4, 1, 1, {PLACE_STRAIN * LENGTH:.17g}\n"
                 "*CECURRENT\n 4, , -1\n", initial=t),
        ).field("critical_current")[1] / (PART * AREA)
        for t in PLACES
    ]  # fmt: skip
    hot = sharing_temperature()
    results = workspace.run(
        "sharing", deck(f", LAW=NB3SN, FIELD={FLUX}", STRAND, f"*CECURRENT\n 4, , {-CURRENT}\n", initial=f"{hot:.17g}")
    )
    values["superconducting_wires.sharing"] = results.field("electric_field")[1] / CRITERION
    return values


def draw(values, path):
    """The I-V curve, and the law."""
    with figures.panels(path, columns=1) as axes:
        law = np.logspace(-11, 2.5, 200)
        axes.semilogy(current_of(law, 2e9), law, label="law")
        axes.semilogy(current_of(FIELDS, 2e9), values["figure"], "k.", label="litz")
        axes.set(xlabel="I [A]", ylabel="E [V/m]")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["superconducting_wires"]))

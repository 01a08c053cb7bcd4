"""Wires that expand with their temperature: buckling, the bow behind it, a bimetal, and swelling at a contact.

Source: S. P. Timoshenko, J. M. Gere, Theory of Elastic Stability, 2nd ed. (1961), sections 2.2 and 1.12: a round wire
between clamps buckles at alpha dT = pi^2 r^2/L^2; from a bow e of the shape 1 - cos(2 pi x/L) the bow w follows from
r^2 (1 - e/w) + (w^2 - e^2)/4 = r^2 dT/dTc. S. Timoshenko, J. Opt. Soc. Am. 11 (1925) 233-255: two bars at the distance a
that expand differently bend by k = (alpha1 - alpha2) dT/(a + (E1 I1 + E2 I2)(1/(E1 A1) + 1/(E2 A2))/a). H. Hertz (1882), see
K. L. Johnson, Contact Mechanics, section 4.2: crossed wires of equal radius r whose surfaces overlap by delta press with
F = 4/3 E* sqrt(r) delta^(3/2), 1/E* = 2 (1 - nu^2)/E; warmer wires between clamps overlap by 2 r alpha dT.
"""

import numpy as np

from verification import figures

LENGTH, RADIUS, ROOM = 0.1, 0.5e-3, 300.0
YOUNG, POISSON, ALPHA = 120e9, 0.34, 17e-6
CONDUCTIVITY, RESISTIVITY = 390.0, 1.72e-8
#: Rise at which a wire between clamps buckles
CRITICAL = np.pi**2 * RADIUS**2 / (ALPHA * LENGTH**2)
BOW = RADIUS / 20
#: Mean rise of the wires that bow, over the critical one
SHARES = (0.5, 1.0, 4.0)
#: Of the bimetal: radii, moduli, expansions, distance of the axes, rise
PAIR = ((1e-3, 120e9, 20e-6), (0.6e-3, 200e9, 12e-6))
APART, WARMTH = 4e-3, 0.2
#: Rise of the wires that swell
SWELLS = 100.0
N = 40


def wire(bow=0.0, elements=N):
    """Nodes, elements, material and section of a wire along x between clamps."""
    s = np.linspace(0, 1, elements + 1)
    y = bow / 2 * (1 - np.cos(2 * np.pi * s))
    nodes = "".join(f" {i + 1}, {LENGTH * s[i]:.17g}, {y[i]:.17g}, 0\n" for i in range(elements + 1))
    members = "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, elements + 1))
    return (
        "*HEADING\n A wire between clamps that expands with its temperature\n"
        f"*NODE, NSET=ALL\n{nodes}*ELEMENT, TYPE=B33, ELSET=WIRE\n{members}"
        f"*MATERIAL, NAME=COPPER\n*ELASTIC\n {YOUNG}, {POISSON}\n*EXPANSION\n {ALPHA}\n"
        f"*ELECTRICAL CONDUCTIVITY\n {1 / RESISTIVITY:.17g}\n*CONDUCTIVITY\n {CONDUCTIVITY}\n"
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC\n {RADIUS}\n*NSET, NSET=ENDS\n 1, {elements + 1}\n"
        f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n ALL, {ROOM}\n*BOUNDARY\n ENDS, ENCASTRE\n {elements + 1}, 9\n"
    )


def critical_share(workspace):
    """Rise in the middle of the increment in which the stiffness loses its sign, over the critical one."""
    steps = "".join(
        f"*STEP\n*STATIC, DIRECT\n {increment}, 1.\n*TEMPERATURE\n ALL, {ROOM + share * CRITICAL:.17g}\n"
        "*BOUNDARY\n 1, 9\n*END STEP\n"
        for increment, share in ((1.0, 0.98), (0.0125, 1.02))
    )
    status = workspace.run("critical", wire() + steps).status
    first = np.flatnonzero(np.asarray(status["negative_pivots"]) > 0)[0]
    return 0.98 + 0.04 * (status["step_time"][first] - 0.00625)


def bow(workspace, share):
    """Bow of a wire that a voltage heats, from BOW.

    The mean of the parabola is V^2/(12 lambda rho), that of N elements with the mean of their nodes less by 1/N^2.
    """
    volts = np.sqrt(12 * CONDUCTIVITY * RESISTIVITY * share * CRITICAL / (1 - 1 / N**2))
    loads = f"*BOUNDARY\n ENDS, 11, 11, {ROOM}\n 1, 9, 9, {volts:.17g}\n"
    procedure = "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE, ELECTRICAL\n 0.05, 1., , 0.05\n"
    results = workspace.run(f"bow_{share:g}", wire(BOW) + f"*STEP\n{procedure}{loads}*END STEP\n")
    return results.field("displacement")[N // 2, 1] + BOW, results.field("displacement")[:, 1]


def bimetal(workspace, elements=10):
    """Turn of the end of two wires that are tied to each other at every node, over their length."""
    lines = ["*HEADING", " Two wires of different expansion, tied to each other", "*NODE, NSET=ALL"]
    for k, z in enumerate((-APART / 2, APART / 2), 1):
        lines += [f" {100 * k + i}, {x:.17g}, 0, {z}" for i, x in enumerate(np.linspace(0, LENGTH, elements + 1))]
    for k, (radius, young, alpha) in enumerate(PAIR, 1):
        lines += [f"*ELEMENT, TYPE=B33, ELSET=W{k}"]
        lines += [f" {100 * k + i}, {100 * k + i}, {100 * k + i + 1}" for i in range(elements)]
        lines += [f"*MATERIAL, NAME=M{k}", "*ELASTIC", f" {young}, 0.3", "*EXPANSION", f" {alpha}"]
        lines += [f"*BEAM SECTION, ELSET=W{k}, MATERIAL=M{k}, SECTION=CIRC", f" {radius}"]
    for i in range(elements + 1):
        lines += [f"*NSET, NSET=N{i}", f" {200 + i}", f"*RIGID BODY, REF NODE={100 + i}, TIE NSET=N{i}"]
    lines += ["*BOUNDARY", " 100, 1, 6", "*STEP", "*STATIC", "*TEMPERATURE", f" ALL, {WARMTH}", "*END STEP", ""]
    results = workspace.run("bimetal", "\n".join(lines))
    return -results.field("rotation")[results.node_ids == 100 + elements][0, 1] / LENGTH


def swelling(workspace):
    """Force between two wires that cross between clamps and touch without force where they are cold."""
    half = LENGTH / 2
    text = (
        "*HEADING\n Crossed wires between clamps that swell\n"
        f"*NODE, NSET=ALL\n 1, {-half}, 0, 0\n 2, {half}, 0, 0\n 3, 0, {-half}, {2 * RADIUS}\n 4, 0, {half}, {2 * RADIUS}\n"
        "*ELEMENT, TYPE=B33, ELSET=LOWER\n 1, 1, 2\n*ELEMENT, TYPE=B33, ELSET=UPPER\n 2, 3, 4\n*ELSET, ELSET=BOTH\n 1, 2\n"
        f"*MATERIAL, NAME=COPPER\n*ELASTIC\n {YOUNG}, {POISSON}\n*EXPANSION\n {ALPHA}\n"
        f"*BEAM SECTION, ELSET=BOTH, MATERIAL=COPPER, SECTION=CIRC\n {RADIUS}\n"
        "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
        "*CONTACT PAIR, INTERACTION=TOUCH\n LOWER, UPPER\n*BOUNDARY\n ALL, ENCASTRE\n"
        f"*STEP\n*STATIC\n 0.1, 1.\n*TEMPERATURE\n ALL, {SWELLS}\n*END STEP\n"
    )
    return float(workspace.run("swelling", text).contacts_at(-1)["force"][0])


def measure(workspace):
    bows, shapes = zip(*(bow(workspace, share) for share in SHARES), strict=True)
    return {
        "expanding_wires.critical": critical_share(workspace),
        "expanding_wires.bow": bows,
        "expanding_wires.bimetal": bimetal(workspace),
        "expanding_wires.swelling": swelling(workspace),
        "figure": shapes,
    }


def draw(values, path):
    """Shapes of the wires that bow."""
    with figures.panels(path, columns=1) as axes:
        for share, shape in zip(SHARES, values["figure"], strict=True):
            axes.plot(np.linspace(0, 1e3 * LENGTH, N + 1), 1e3 * shape, label=f"{share:g} times the critical rise")
        axes.set(xlabel="x [mm]", ylabel="deflection [mm]")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["expanding_wires"]))

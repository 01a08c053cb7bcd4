"""A current that enters a wire inside an element: with and without the correction of the linear voltage.

Source: Ohm's law: the potential of a wire falls linearly to the place where the current leaves it and has a kink
there. The voltage of the element, linear between its nodes, has no kink; the resistance it misses at xi is rho L0 (1
- xi^2)/(4 A) per wire, from the Green's function (1 + xi)(1 - eta) rho L0/(4 A), xi <= eta, of a wire between nodes
of given potential. VOLTAGE=LINEAR is the paper's element (D. P. Boso, P. Litewka, B. A. Schrefler, P. Wriggers,
Electric-mechanical beam-to-beam contact, "voltages are computed linearly"); VOLTAGE=CORRECTED adds the missing
resistance of each contact. Two contacts in one element also act on each other, by the Green's function at different
places: the currents must not depend on whether there is a node between the contacts.
"""

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.wire_decks import COPPER, Crossing, interaction, section

LENGTH, ELEMENT, APPROACH, PENALTY, SPOT = 0.1, 0.01, 1e-8, 1e5, 1e-4
#: Nodes at 0, 10, 20, 30, 40, 45, 55, 60, ... mm: the crossing lies in the element in the middle
NODES = np.array([0, 10, 20, 30, 40, 45, 55, 60, 70, 80, 90, 100]) * 1e-3
PLACES = (-0.9, -0.6, -0.3, 0.0, 0.3, 0.6, 0.9)
VOLTAGES = ("CORRECTED", "LINEAR")
#: Two contacts in the element from 45 to 55 mm
TWO = (0.047, 0.053)


def missing(xi):
    """Resistance that the linear voltage of both wires misses."""
    return 2 * COPPER.resistance(ELEMENT) * (1 - np.asarray(xi) ** 2) / 4


def exact(xi):
    """Two arms and the contact."""
    return 2 * COPPER.resistance(LENGTH / 2 + np.asarray(xi) * ELEMENT / 2) + SPOT


def one(workspace, xi, voltage):
    """Resistance between the first ends of two wires that cross at xi of an element of each."""
    at = LENGTH / 2 + xi * ELEMENT / 2
    deck = Crossing(NODES, NODES, (at, at)).deck(
        interaction(("LOWER", "UPPER"), penalty=PENALTY, spot=f"CONSTANT, VOLTAGE={voltage}\n {SPOT}"),
        [APPROACH],
        "Model   copper, radius 1 mm, contact of 0.1 mohm inside elements of 10 mm; far ends insulated",
        "Source  two arms and the contact in series",
        potentials=" PLUS, 9, 9, 1.e-3\n MINUS, 9, 9, 0.",
    )
    return float(workspace.run(f"{voltage.lower()}_{xi:g}", deck).history["resistance PLUS to MINUS"][-1])


def two(workspace, name, nodes, voltage):
    """Currents of two wires that cross a third one in the same element, or with a node between."""
    blocks = [chain(np.outer(nodes, [1, 0, 0]), "B33", "LOWER", 1001)]
    for k, x in enumerate(TWO, 2):
        points = np.array([x, -LENGTH / 2, 2 * COPPER.radius]) + np.outer(NODES, [0, 1, 0])
        blocks.append(chain(points, "B33", f"UPPER{k}", 1000 * k + 1))
    last = len(NODES)
    ends = [end for k in (2, 3) for end in (1000 * k + 1, 1000 * k + last)]
    deck = join(
        heading(
            "Two wires cross a third one inside one of its elements",
            "Model   copper, radius 1 mm, contacts of 0.1 mohm; the current enters at the first end of the lower wire",
            "Source  Kirchhoff's laws",
        ),
        *blocks,
        section(COPPER, "COPPER", "LOWER", "UPPER2", "UPPER3", conducting=True),
        interaction(
            ("LOWER", "UPPER2"),
            ("LOWER", "UPPER3"),
            penalty=PENALTY,
            spot=f"CONSTANT, VOLTAGE={voltage}\n {SPOT}",
        ),
        "*BOUNDARY\n 1001, ENCASTRE",
        f" {1000 + len(nodes)}, ENCASTRE",
        *(f" {end}, 1, 2\n {end}, 4, 6" for end in ends),
        step(
            "*BOUNDARY",
            *(f" {end}, 3, 3, {-APPROACH:.16g}" for end in ends),
            " 1001, 9, 9, 1.e-3\n 2001, 9, 9, 0.\n 3001, 9, 9, 0.",
        ),
    )
    return [float(current) for current in workspace.run(name, deck).contacts_at(-1)["current"]]


def two_currents(voltage, *, node_between=False):
    """The two currents, from the influence of each on the potential at the other."""
    n = (np.array(TWO) - 0.045) / ELEMENT
    green = np.minimum.outer(n, n) - np.outer(n, n)
    if voltage == "LINEAR" and not node_between:
        green = 0 * green
    element = COPPER.resistance(ELEMENT) * (np.outer(n, n) + green)
    upper = np.diag([COPPER.resistance(LENGTH / 2) + SPOT] * 2)
    if voltage == "LINEAR":
        upper = upper - np.diag([COPPER.resistance(ELEMENT) / 4] * 2)
    return np.linalg.solve(COPPER.resistance(0.045) + element + upper, np.full(2, 1e-3))


def measure(workspace):
    found = {voltage: [one(workspace, xi, voltage) for xi in PLACES] for voltage in VOLTAGES}
    values = {
        "voltage_inside.corrected": found["CORRECTED"],
        "voltage_inside.linear": [float(e - r) for e, r in zip(exact(PLACES), found["LINEAR"], strict=True)],
        "voltage_inside.two.one_element": two(workspace, "two_in_one_element", NODES, "CORRECTED"),
        "voltage_inside.two.linear": two(workspace, "two_in_one_element_linear", NODES, "LINEAR"),
    }
    nodes = np.sort(np.append(NODES, 0.05))
    values["voltage_inside.two.node_between"] = two(workspace, "two_with_a_node_between", nodes, "CORRECTED")
    return values


def draw(values, path):
    xi = np.linspace(-1, 1, 50)
    with figures.panels(path) as (resistance, gap):
        resistance.plot(xi, exact(xi) * 1e3, label="exact: two arms and the contact", **figures.REFERENCE)
        resistance.plot(
            PLACES, np.array(values["voltage_inside.corrected"]) * 1e3, "s", color="#c4451c", label="VOLTAGE=CORRECTED"
        )
        linear = exact(PLACES) - values["voltage_inside.linear"]
        resistance.plot(PLACES, linear * 1e3, "o", color="#0b62a4", label="VOLTAGE=LINEAR")
        resistance.set(xlabel=r"place of the contact in its element, $\xi$", ylabel="resistance [mohm]")
        resistance.legend()
        gap.plot(xi, missing(xi) * 1e6, label=r"$2\rho L_0(1-\xi^2)/(4A)$", **figures.REFERENCE)
        gap.plot(PLACES, np.array(values["voltage_inside.linear"]) * 1e6, "o", color="#0b62a4", label="VOLTAGE=LINEAR")
        left = exact(PLACES) - values["voltage_inside.corrected"]
        gap.plot(PLACES, left * 1e6, "s", color="#c4451c", label="VOLTAGE=CORRECTED")
        gap.set(xlabel=r"place of the contact in its element, $\xi$", ylabel="missing resistance [µohm]")
        gap.legend(loc="lower center", bbox_to_anchor=(0.5, 0.12))


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["voltage_inside"]))

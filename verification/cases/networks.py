"""Current through wires and contacts of a given resistance: Ohm's and Kirchhoff's laws.

Source: G. S. Ohm (1827), G. Kirchhoff, Ann. Phys. 64 (1845) 497: the potentials of a network of resistors, solved by
themselves in references/network.py. Balance of a bridge: C. Wheatstone, Phil. Trans. R. Soc. 133 (1843) 303: no
current through the contact, whatever its resistance, where the crossing points of both wires have the same potential
without it. Wires are pressed together so little (1e-8 m) that the crossing moves by no more than 1e-10 m. The
resistances of the sixteen contacts of inputs/04_wire_grid are taken from its ledger.
"""

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.references import network
from verification.wire_decks import COPPER, INPUTS, Crossing, interaction, section

LENGTH, APPROACH, PENALTY = 0.1, 1e-8, 1e5
NODES = np.linspace(0.0, LENGTH, 11)
AT = (0.03, 0.06)
#: Potentials of the ends of the lower wire, then of the upper one [V]
ENDS = (1e-3, 2e-4, 0.0, 5e-4)
#: Without a contact both crossing points have 0.7 mV
BALANCED = (1e-3, 0.0, 1e-4, 1.1e-3)
RESISTANCES = (1e-6, 1e-4, 1e-2)


def crossing(workspace, name, ends, resistance):
    """Results of two wires with four potentials and a contact of constant resistance."""
    wires = Crossing(NODES, NODES, AT)
    nodes = (1001, wires.last[0], 2001, wires.last[1])
    deck = wires.deck(
        interaction(("LOWER", "UPPER"), penalty=PENALTY, spot=f"CONSTANT\n {resistance:.16g}"),
        [APPROACH],
        f"Model   copper, radius 1 mm, length 100 mm, contact of {resistance:g} ohm; potentials at all four ends",
        "Source  Kirchhoff's laws with four arms and the contact",
        potentials="\n".join(f" {node}, 9, 9, {v:.16g}" for node, v in zip(nodes, ends, strict=True)),
    )
    return workspace.run(name, deck)


def exact_crossing(ends, resistance):
    """Potentials of both crossing points and the current between them; the arms in the order of the ends."""
    arms = [COPPER.resistance(length) for at in AT for length in (at, LENGTH - at)]
    resistors = [(i, 4 + i // 2, arm) for i, arm in enumerate(arms)] + [(4, 5, resistance)]
    v = network.potentials(6, resistors, dict(enumerate(ends)))
    return v[4], v[5], (v[4] - v[5]) / resistance


def measured_crossing(results):
    contact = results.contacts_at(-1)
    v = results.field("potential")
    row = {node: i for i, node in enumerate(results.node_ids)}
    return [float(v[row[1004]]), float(v[row[2007]]), float(contact["current"][0])]


def stretched(workspace, option):
    """Resistance of a wire of uneven elements before and after it is stretched by a tenth."""
    x = LENGTH * np.array([0.0, 0.1, 0.15, 0.4, 0.42, 0.9, 1.0])
    points = np.column_stack([x, 0 * x, 0 * x])
    deck = join(
        heading("A wire is stretched by a tenth", "Source  R = rho L/A"),
        chain(points, "B33", "WIRE"),
        "*NSET, NSET=PLUS\n 1\n*NSET, NSET=MINUS\n 7",
        section(COPPER, "COPPER", "WIRE", conducting=True, options=f", CONDUCTION={option}"),
        "*BOUNDARY\n 1, ENCASTRE\n 7, 2, 6\n MINUS, 9",
        step("*BOUNDARY\n PLUS, 9, 9, 1.e-3\n*ELECTRODE PRINT\n PLUS, MINUS"),
        step(f"*BOUNDARY\n 7, 1, 1, {0.1 * LENGTH:.16g}"),
    )
    resistance = workspace.run(f"stretched_{option.split()[0].lower()}", deck).history["resistance PLUS to MINUS"]
    return [float(value) for value in resistance[1:]]


def grid(workspace):
    """Currents of the contacts of a grid: of litz, and of Kirchhoff for the places and resistances of its ledger."""
    results = workspace.run("04_wire_grid", (INPUTS / "04_wire_grid.inp").read_text())
    contacts = results.contacts_at(-1)
    n = len(contacts["id"])
    resistors = [(i, n + i, r) for i, r in enumerate(contacts["resistance"])]
    held = {}
    # contact i is node i on its lower and node n + i on its upper wire; electrodes come after these
    for group, axis, ending, voltage, first in (("LOWER", 0, "_bar", 1e-3, 0), ("UPPER", 1, "", 0.0, n)):
        ends = results.nodes[results.elements, axis]
        rows = {number: row for row, number in enumerate(results.element_ids)}
        row = np.array([rows[number] for number in contacts[f"element{ending}"]])
        xi = np.asarray(contacts[f"xi{ending}"])
        place = ((1 - xi) * ends[row, 0] + (1 + xi) * ends[row, 1]) / 2
        for wire in range(1, 5):
            elements = results.element_sets[f"{group}{wire}"]
            touching = np.flatnonzero(np.isin(row, elements))
            electrode = 2 * n + len(held)
            held[electrode] = voltage
            here, before = ends[elements].min(), electrode
            for i in touching[np.argsort(place[touching])]:
                resistors.append((before, first + i, COPPER.resistance(place[i] - here)))
                here, before = place[i], first + i
    v = network.potentials(2 * n + len(held), resistors, held)
    return np.asarray(contacts["current"]), (v[:n] - v[n : 2 * n]) / np.asarray(contacts["resistance"])


def measure(workspace):
    values = {
        "networks.reference_length": stretched(workspace, "REFERENCE LENGTH"),
        "networks.current_length": stretched(workspace, "CURRENT LENGTH"),
    }
    balanced = []
    for resistance in RESISTANCES:
        found = crossing(workspace, f"crossing_{resistance:g}", ENDS, resistance)
        values[f"networks.crossing.{resistance:g}"] = measured_crossing(found)
        found = crossing(workspace, f"balance_{resistance:g}", BALANCED, resistance)
        balanced.append(measured_crossing(found)[2])
    wire_current = (BALANCED[0] - BALANCED[1]) / COPPER.resistance(LENGTH)
    values["networks.balance"] = [abs(current) / wire_current for current in balanced]
    currents, exact = grid(workspace)
    values["networks.grid.total"] = float(currents.sum() / exact.sum() - 1)
    values["networks.grid.contacts"] = float(np.abs(currents - exact).max() / exact.max())
    return values | {"figure": (balanced, currents, exact)}


def draw(values, path):
    balanced, currents, exact = values["figure"]
    with figures.panels(path) as (bridge, contacts):
        resistances = np.geomspace(1e-7, 1e-1, 60)
        unbalanced = [values[f"networks.crossing.{r:g}"][2] for r in RESISTANCES]
        for ends, name, color, found in (
            (ENDS, "unbalanced", "#c4451c", unbalanced),
            (BALANCED, "balanced", "#0b62a4", balanced),
        ):
            bridge.semilogx(resistances, [exact_crossing(ends, r)[2] for r in resistances], **figures.REFERENCE)
            bridge.semilogx(RESISTANCES, found, "s", color=color, label=f"litz, {name}")
        bridge.plot([], [], label="Kirchhoff", **figures.REFERENCE)
        bridge.set(xlabel="contact resistance [ohm]", ylabel="contact current [A]")
        bridge.legend()
        order = np.argsort(exact)[::-1]
        contacts.bar(range(16), exact[order], color="#bbbbbb", label="Kirchhoff")
        contacts.plot(range(16), currents[order], "s", color="#c4451c", label="litz")
        contacts.set(xlabel="contacts of a grid of 4 x 4 wires", ylabel="contact current [A]", xticks=[])
        contacts.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["networks"]))

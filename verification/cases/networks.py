"""Current through wires and contacts of a given resistance: Ohm's and Kirchhoff's laws.

Source: G. S. Ohm (1827), G. Kirchhoff, Ann. Phys. 64 (1845) 497: the potentials of a network of resistors, solved by
themselves in references/network.py. Balance of a bridge: C. Wheatstone, Phil. Trans. R. Soc. 133 (1843) 303: no
current through the contact, whatever its resistance, where the crossing points of both wires have the same potential
without it. Wires are pressed together so little (1e-8 m) that the crossing moves by no more than 1e-10 m. The sixteen
contacts of inputs/04_wire_grid lie at the crossings of straight wires; their resistances are given, or those of Holm
for the forces from the deflections of clamped beams (Roark's table 8.1, references/crossed_wires.py) and Hertz.
"""

import numpy as np

from verification import figures
from verification.cases.crossings import Grid
from verification.deck_text import chain, heading, join, step
from verification.references import hertz, network
from verification.wire_decks import COPPER, INPUTS, Crossing, interaction, section

LENGTH, APPROACH, PENALTY = 0.1, 1e-8, 1e5
NODES = np.linspace(0.0, LENGTH, 11)
AT = (0.03, 0.06)
#: Potentials of the ends of the lower wire, then of the upper one [V]
ENDS = (1e-3, 2e-4, 0.0, 5e-4)
#: Without a contact both crossing points have 0.7 mV
BALANCED = (1e-3, 0.0, 1e-4, 1.1e-3)
RESISTANCES = (1e-6, 1e-4, 1e-2)
#: Crossings of the grid along its wires [m], and the resistance of its contacts where that is given [ohm]
GRID_PLACES, GIVEN = (0.035, 0.045, 0.055, 0.065), 1e-4


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


def grid_currents(results):
    """Currents of the sixteen contacts, lower wires from front to back, on each the upper ones from left to right."""
    contacts = results.contacts_at(-1)
    return np.asarray(contacts["current"])[np.lexsort((contacts["point_2_x"].round(3), contacts["point_2_y"].round(3)))]


def given_grid(workspace):
    """Currents of the grid with contacts of a given resistance, pressed together by no more than 10 nm."""
    text = (INPUTS / "04_wire_grid.inp").read_text()
    for card, other in {
        "LAW=HERTZ\n": f"LAW=CONSTANT\n {GIVEN:.16g}\n",
        " MOVING, 3, 3, -0.1e-3\n": f" MOVING, 3, 3, {-APPROACH}\n",
    }.items():
        if text.count(card) != 1:
            raise ValueError(f"inputs/04_wire_grid.inp no longer has {card!r} once")
        text = text.replace(card, other)
    return grid_currents(workspace.run("given_grid", text))


def exact_grid(resistances):
    """Currents of all contacts (lower wire, upper wire), by Kirchhoff's laws, for their resistances.

    Contact (i, j) is node 4 i + j on its lower and 16 + 4 i + j on its upper wire; electrodes come after these.
    """
    resistors = [(k, 16 + k, r) for k, r in enumerate(np.ravel(resistances))]
    arms = [COPPER.resistance(length) for length in np.diff([0.0, *GRID_PLACES])]
    for wire in range(4):
        lower = [32 + wire, *(4 * wire + j for j in range(4))]
        upper = [36 + wire, *(16 + 4 * i + wire for i in range(4))]
        for nodes in (lower, upper):
            resistors += list(zip(nodes, nodes[1:], arms, strict=False))
    v = network.potentials(40, resistors, {32 + w: 1e-3 for w in range(4)} | {36 + w: 0.0 for w in range(4)})
    return (v[:16] - v[16:32]) / np.ravel(resistances)


def exact_pressed_grid():
    """Currents of the grid of the deck: forces from the bending of all wires and Hertz, resistances from the forces."""
    modulus = hertz.effective_modulus((COPPER.young,) * 2, (COPPER.poisson,) * 2)
    pair = {"radius": (COPPER.radius,) * 2, "resistivity": (COPPER.resistivity,) * 2, "modulus": modulus}
    forces = Grid(4, None, push=1e-4, pitch=0.01).exact().ravel()
    return exact_grid([hertz.crossed_wires(force, np.pi / 2, **pair).resistance for force in forces])


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
    values["networks.grid.given"] = given_grid(workspace).tolist()
    results = workspace.run("04_wire_grid", (INPUTS / "04_wire_grid.inp").read_text())
    values["networks.grid.total"] = float(results.history["current PLUS to MINUS"][-1])
    values["networks.grid.contacts"] = grid_currents(results).tolist()
    return values | {"figure": balanced}


def draw(values, path):
    balanced, exact = values["figure"], exact_pressed_grid()
    currents = np.array(values["networks.grid.contacts"])
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
        contacts.bar(range(16), exact[order], color="#bbbbbb", label="beams, Hertz, Kirchhoff")
        contacts.plot(range(16), currents[order], "s", color="#c4451c", label="litz")
        contacts.set(xlabel="contacts of a grid of 4 x 4 wires", ylabel="contact current [A]", xticks=[])
        contacts.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["networks"]))

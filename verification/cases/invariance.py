"""Other units, other numbers, swapped contact partners, a turned model: the same results.

Source: dimensional analysis (E. Buckingham, Phys. Rev. 4 (1914) 345-376), frame indifference (C. Truesdell, W. Noll,
The Non-Linear Field Theories of Mechanics, section 19), and the meaning of a name: none of these changes the physics.
Decks: inputs/02_oblique_crossing (two materials, elliptic spot), inputs/04_wire_grid (16 contacts), and a crossing of
two clamped wires, which can be turned obliquely.
"""

from pathlib import Path

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join
from verification.deck_transform import Units, in_units, renumbered, rotated, swapped_contact_pairs
from verification.numerics import rotation

INPUTS = Path(__file__).parents[2] / "inputs"
DECKS = ("02_oblique_crossing", "04_wire_grid")

#: m, N, A, V in the units of the system
SYSTEMS = {
    "mm_n_v_a": Units(length=1e3),
    # tonne, mm, s, A: forces in N, voltages in mV
    "mm_tonne_s": Units(length=1e3, voltage=1e3),
    # kg, mm, ms, mA: forces in kN, voltages in kV
    "mm_kg_ms": Units(length=1e3, force=1e-3, current=1e3, voltage=1e-3),
}
TURN = rotation([0.7, -1.1, 0.4])
CYCLE = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


def crossing():
    """Two copper wires, clamped at all ends, that cross at 60 degrees and are pressed together and sideways."""
    x = np.linspace(-0.05, 0.05, 12)[:, None]
    direction = np.array([0.5, np.sqrt(0.75), 0.0])
    return join(
        heading(
            "Two clamped copper wires cross at 60 degrees",
            "Model   radius 1 mm, length 100 mm; the upper supports move by (0.2, 0.1, -0.15) mm",
            "Source  see verification/cases/invariance.py",
        ),
        chain(x * [1.0, 0.0, 0.0], "B33", "LOWER", first=1),
        chain(x * direction + [0.0, 0.0, 0.00201], "B31", "UPPER", first=101),
        "*NSET, NSET=MOVING\n 101, 112",
        "*MATERIAL, NAME=CU\n*ELASTIC\n 120.e9, 0.34\n*ELECTRICAL CONDUCTIVITY\n 58.e6",
        "*BEAM SECTION, ELSET=LOWER, MATERIAL=CU, SECTION=CIRC\n 1.e-3",
        "*BEAM SECTION, ELSET=UPPER, MATERIAL=CU, SECTION=CIRC\n 1.e-3",
        "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ",
        "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n*CONTACT PAIR, INTERACTION=TOUCH\n LOWER, UPPER",
        "*BOUNDARY\n 1, 1, 6\n 12, 1, 6\n MOVING, 1, 6\n 101, 9",
        "*STEP\n*STATIC\n 0.25, 1., 1.e-4, 0.25",
        "*BOUNDARY\n MOVING, 1, 1, 2.e-4\n MOVING, 2, 2, 1.e-4\n MOVING, 3, 3, -1.5e-4\n 1, 9, 9, 1.e-3",
        "*END STEP",
    )


def quantities(results, nodes=None, turn=None):
    """What is compared, by name: displacements and voltages by node, forces, gaps and currents by contact."""
    order = np.argsort(results.node_ids)
    if nodes is not None:
        # the position of old node i under its new number
        where = {number: i for i, number in enumerate(results.node_ids)}
        order = [where[nodes[old]] for old in sorted(nodes)]
    turn = np.eye(3) if turn is None else turn
    contacts = results.contacts_at(-1)
    places = [(contacts[f"point_2_{axis}"] + contacts[f"point_1_{axis}"]) / 2 for axis in "xyz"]
    found = {name: np.abs(contacts[name]) for name in ("force", "gap", "resistance", "current", "voltage_gap")}
    return found | {
        "place": np.column_stack(places) @ turn,
        "displacement": results.field("displacement")[order] @ turn,
        "potential": results.field("potential")[order],
    }


def difference(first, second, units=None):
    """Largest difference, relative to the largest value of each quantity, after a change of units."""
    units = units or Units()
    factor = {
        "force": units.force,
        "gap": units.length,
        "place": units.length,
        "displacement": units.length,
        "current": units.current,
        "resistance": units.voltage / units.current,
        "voltage_gap": units.voltage,
        "potential": units.voltage,
    }
    back = {name: values / factor[name] for name, values in second.items()}
    # the contact of the second run that is at the place of each of the first
    distance = np.linalg.norm(first["place"][:, None] - back["place"][None], axis=2)
    same = distance.argmin(axis=1)
    for name in ("place", "force", "gap", "resistance", "current", "voltage_gap"):
        back[name] = back[name][same]
    return max(float(np.abs(back[name] - first[name]).max() / np.abs(first[name]).max()) for name in first)


def measure(workspace):
    texts = {name: (INPUTS / f"{name}.inp").read_text(encoding="utf-8") for name in DECKS} | {"crossing": crossing()}
    if workspace.quick:
        texts.pop("04_wire_grid")
    found = {}
    for name, text in texts.items():
        plain = quantities(workspace.run(name, text))
        for system, units in SYSTEMS.items():
            results = workspace.run(f"{name}_{system}", in_units(text, units))
            found.setdefault(system, []).append(difference(plain, quantities(results), units))
        other, nodes, _ = renumbered(text)
        results = workspace.run(f"{name}_renumbered", other)
        found.setdefault("renumbered", []).append(difference(plain, quantities(results, nodes)))
        results = workspace.run(f"{name}_swapped", swapped_contact_pairs(text))
        found.setdefault("swapped", []).append(difference(plain, quantities(results)))
        results = workspace.run(f"{name}_cycled", rotated(text, CYCLE))
        found.setdefault("cycled_axes", []).append(difference(plain, quantities(results, turn=CYCLE)))
        if name == "crossing":
            results = workspace.run(f"{name}_turned", rotated(text, TURN))
            found["turned"] = [difference(plain, quantities(results, turn=TURN))]
    return {f"invariance.{name}": max(values) for name, values in found.items()} | {"figure": found}


def draw(values, path):
    found = values["figure"]
    with figures.panels(path, columns=1) as axes:
        for row, differences in enumerate(found.values()):
            axes.semilogx(np.maximum(differences, 1e-17), [row] * len(differences), "o", color="#0b62a4")
        axes.set_yticks(range(len(found)), [name.replace("_", " ") for name in found])
        axes.axvline(1e-8, color="#222222", linewidth=0.8, linestyle="--")
        axes.set(xlabel="largest relative difference", xlim=(1e-17, 1e-6))


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["invariance"]))

"""How many Newton iterations rods need in ONE load step, without cut-back and without tuning.

Sources: iterations of OpenSees, Kratos, CalculiX and Exudyn for the 45-degree bend at P = 600 in six steps, counted
in their logs (references/iterations.toml). That the iteration with section forces as unknowns needs few of them: D.
Magisano, L. Leonetti, G. Garcea, Comput. Methods Appl. Mech. Eng. 313 (2017) 986-1005. Bend, elastica and roll-up are
the cases on which the constants of the iteration were chosen; frame, half circle, S, helix and slender cantilever are
not. That the right state is found is claimed too: tips from shooting with a geometrically exact rod
(references/rod.py) and from elliptic integrals (references/elastica.py).

Missed: the circle of B33 needs 16. The helix of B31 under the threefold force, whose elements turn by 18 degrees each,
wanders and is cut back. It arrives at the right state. A cap of 0.4 rad on the rotations of an iteration lets it converge
in 9, but then the roll-up to a circle does not reach its end in 16 iterations.
"""

from itertools import product
from pathlib import Path

import numpy as np

from verification import figures
from verification.cases import bend, elastica
from verification.claims import tomllib
from verification.deck_text import Rigidity, chain, heading, join, step, straight
from verification.references.rod import Piece, free_shape
from verification.workspace import iterations

OTHERS = Path(__file__).parents[1] / "references" / "iterations.toml"
ELEMENTS = ("B31", "B33")
CORNER = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
RIGIDITY = Rigidity(ea=1e6, ga=1e6, gj=0.8, ei2=1.0, ei3=1.0)
SLENDER = Rigidity(ea=1.6e7, ga=1.6e7, gj=0.8, ei2=1.0, ei3=1.0)

#: Rods on which nothing was tuned: pieces of the free shape, tip force, elements per piece
NEW = {
    # two legs at right angles
    "frame": ([Piece(0.5, corner=CORNER), Piece(0.5)], (3.0, 2.0, 10.0), 16),
    "half_circle": ([Piece(1.0, (0.0, 0.0, np.pi))], (0.0, 0.0, 10.0), 20),
    "s_curve": ([Piece(0.5, (0.0, 0.0, np.pi)), Piece(0.5, (0.0, 0.0, -np.pi))], (-4.0, 3.0, 6.0), 16),
    # two turns
    "helix": ([Piece(1.0, (4 * np.pi * np.sin(0.2), 0.0, 4 * np.pi * np.cos(0.2)))], (0.0, 0.0, 15.0), 40),
}
#: Multiples of these forces
FACTORS = (1, 3)


def one_step(title, points, element, rigidity, load):
    """A clamped rod and one load at its end, in one increment."""
    cards = [f"*CLOAD\n {len(points)}, {dof}, {value:.16g}" for dof, value in load.items() if value]
    return join(
        heading(title, "Model   one load step that may be cut", "Source  see verification/cases/iterations.py"),
        chain(points, element, "ROD"),
        rigidity.block("ROD"),
        "*BOUNDARY\n 1, ENCASTRE",
        step(*cards, direct=False),
    )


def may_be_cut(deck):
    """The deck with steps whose increments may be cut, so that a cut-back shows in the count."""
    return deck.replace("*STATIC, DIRECT", "*STATIC")


def count(workspace, name, deck):
    """Iterations in all, cut-backs included, and the results."""
    results = workspace.run(name, deck)
    return iterations(results)[0], results


def measure(workspace):
    values = {}
    for element in ELEMENTS:
        for load in (600,) if workspace.quick else (600, 1200, 3000):
            deck = may_be_cut(bend.deck(element, 8, bend.TORSION["polar"], 1, loads=(load,)))
            values[f"iterations.{element}.bend_{load}"], _ = count(workspace, f"{element}_bend_{load}", deck)
        deck = may_be_cut(bend.deck(element, 8, bend.TORSION["polar"], 6, loads=(600,)))
        values[f"iterations.{element}.bend_600_six_steps"], _ = count(workspace, f"{element}_bend_six", deck)
        if workspace.quick:
            continue
        deck = may_be_cut(elastica.deck(element, 20, (10,)))
        values[f"iterations.{element}.elastica_10"], _ = count(workspace, f"{element}_elastica", deck)
        deck = one_step("Roll-up in one step", straight(1.0, 10), element, RIGIDITY, {6: 2 * np.pi})
        values[f"iterations.{element}.circle"], _ = count(workspace, f"{element}_circle", deck)
        deck = one_step("Slender cantilever, P L^2/(E I) = 30", straight(1.0, 20), element, SLENDER, {2: 30.0})
        values[f"iterations.{element}.slender"], results = count(workspace, f"{element}_slender", deck)
        u = results.field("displacement")[-1]
        values[f"iterations.{element}.slender.tip"] = [float(u[1]), float(-u[0])]
        for (name, (pieces, force, n)), factor in product(NEW.items(), FACTORS):
            load = {i + 1: factor * value for i, value in enumerate(force)}
            deck = one_step(name, free_shape(pieces, n), element, RIGIDITY, load)
            claim = f"{name}_x{factor}"
            values[f"iterations.{element}.{claim}"], results = count(workspace, f"{element}_{claim}", deck)
            values[f"iterations.{element}.{claim}.tip"] = results.positions()[-1].tolist()
    return values


def draw(values, path):
    with OTHERS.open("rb") as file:
        others = tomllib.load(file)["bend_600_six_steps"]
    with figures.panels(path) as (six, one):
        bars = {f"litz {element}": [values[f"iterations.{element}.bend_600_six_steps"]] * 2 for element in ELEMENTS}
        bars |= others
        for row, (name, (few, most)) in enumerate(bars.items()):
            color = figures.STYLES[name.split()[1]]["color"] if name.startswith("litz") else "#888888"
            six.barh(row, most, color=color, alpha=0.45)
            six.barh(row, few, color=color)
        six.set_yticks(range(len(bars)), list(bars))
        six.invert_yaxis()
        six.set(xlabel="iterations, all steps", title="45-degree bend, P = 600, six steps")
        names = [
            "bend_600",
            "bend_1200",
            "bend_3000",
            "elastica_10",
            "circle",
            "slender",
            *(f"{name}_x{f}" for name, f in product(NEW, FACTORS)),
        ]
        for shift, element in ((-0.2, "B31"), (0.2, "B33")):
            one.barh(
                np.arange(len(names)) + shift,
                [values[f"iterations.{element}.{name}"] for name in names],
                height=0.38,
                color=figures.STYLES[element]["color"],
                label=element,
            )
        one.set_yticks(range(len(names)), [name.replace("_", " ") for name in names])
        one.invert_yaxis()
        one.set(xlabel="iterations", title="one load step")
        one.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["iterations"]))

"""Two straight wires twisted together: line contact whose exact state is a pair of uniform helices.

Source: equilibrium of a helical rod, A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, 4th ed. (1927),
articles 270-271; two of them in contact, J. M. T. Thompson, G. H. M. van der Heijden, S. Neukirch, Proc. R. Soc. A 458
(2002) 959-985; evaluated in references/helical_rods.py, where the force of the contact over its overlap is included.
"""

import numpy as np

from verification import figures
from verification.line_decks import FIRST, SECOND, twisted_pair
from verification.references.helical_rods import Rod, TwistedPair
from verification.references.parallel_wires import ParallelWires, PressedWire

PAIR = TwistedPair(Rod(0.5e-3, 200e9, 0.3), 0.1)
#: Force over overlap of the linear law [N/m^2]
STIFFNESS = 1e11
#: Increments of the turn
STATES = 100
MESHES = (20, 40, 80)


def approach_of(*rods):
    """Approach of the axes over the line force, of round wires side by side."""
    return ParallelWires(*(PressedWire(rod.radius, rod.young, rod.poisson) for rod in rods)).approach


def states(approach):
    """Exact states up to one turn."""
    turns = np.arange(1, STATES + 1) / STATES
    return turns, [PAIR.stretched(turn, 1.0, approach) for turn in turns]


def line_force(results, length, elements):
    """Force of all contacts in the middle half of a length over that half [N/m]; places lie at nodes and between them."""
    contacts = results.contacts_at(-1)
    low = length / 4 + length / (4 * elements)
    inside = (contacts["point_1_z"] >= low) & (contacts["point_1_z"] < low + length / 2)
    return float(contacts["force"][inside].sum() / (length / 2))


def end_loads(history, starts):
    """Axial force and moment about z at the ends of the wires; `starts`: reference places (x, y) by their nodes."""
    force = moment = 0.0
    for node, (x, y) in starts.items():
        u, v, fx, fy, fz, mz = (history[f"{name} node {node}"][-1] for name in ("U1", "U2", "RF1", "RF2", "RF3", "RM3"))
        force += fz
        moment += mz + (x + u) * fy - (y + v) * fx
    return float(force), float(moment)


def loads_at(workspace, elements, stiffness):
    """Axial force, moment and line force in the middle half."""
    approach = approach_of(PAIR.rod, PAIR.rod) if stiffness is None else lambda force: force / stiffness
    turns, exact = states(approach)
    name = f"{'hertz' if stiffness is None else 'linear'}_{elements}"
    results = workspace.run(name, twisted_pair(PAIR, exact, turns, elements, stiffness=stiffness))
    a = PAIR.rod.radius
    force, moment = end_loads(results.history, {FIRST + elements: (a, 0.0), SECOND + elements: (-a, 0.0)})
    return [force, moment, line_force(results, PAIR.length, elements)]


def measure(workspace):
    meshes = MESHES if not workspace.quick else MESHES[1:2]
    found = {n: loads_at(workspace, n, None) for n in meshes}
    values = {f"twisted_pair.{name}": found[40][i] for i, name in enumerate(("force", "moment", "line_force"))}
    if workspace.quick:
        return values | {"figure": {}}
    linear = loads_at(workspace, 40, STIFFNESS)
    values |= {f"twisted_pair.linear.{name}": linear[i] for i, name in enumerate(("force", "moment", "line_force"))}
    _, exact = states(approach_of(PAIR.rod, PAIR.rod))
    truth = (exact[-1].force, exact[-1].moment, exact[-1].line_force)
    errors = [[abs(found[n][i] / truth[i] - 1) for n in meshes] for i in range(3)]
    return values | {"figure": {"errors": errors}}


def draw(values, path):
    if not values["figure"]:
        return
    with figures.panels(path) as (over_turns, error):
        turns = np.linspace(0.02, 1, 50)
        exact = [PAIR.stretched(turn, 1.0) for turn in turns]
        over_turns.plot(turns, [state.line_force for state in exact], label="line force [N/m]", **figures.REFERENCE)
        over_turns.plot(turns, [state.force for state in exact], "--", color="#222222", label="axial force [N]")
        over_turns.plot(
            [1], [values["twisted_pair.line_force"]], **figures.STYLES["B33"], linestyle="none", label="litz"
        )
        over_turns.plot([1], [values["twisted_pair.force"]], **figures.STYLES["B33"], linestyle="none")
        over_turns.set(xlabel="turns")
        over_turns.legend()
        for label, errors in zip(("force", "moment", "line force"), values["figure"]["errors"], strict=True):
            error.loglog(MESHES, errors, "o-", label=label)
        error.set(xlabel="elements", ylabel="relative error")
        error.set_xticks(MESHES, [str(n) for n in MESHES])
        error.minorticks_off()
        error.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["twisted_pair"]))

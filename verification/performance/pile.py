"""A pile of fibres with contact, pressed between two plates

A layered random mat of `litz.build` is pressed by a tenth of its height. No program of the Python package index that we know
solves this as a static problem of beams that touch anywhere: OpenSees, Kratos and Exudyn have no contact between beams,
MuJoCo and PyElastica let rods move in time until they rest. The nearest is OpenSees with the contacts given by hand: where two
fibres cross in plan, both get a node, and a spring that only pushes joins them along z. It then has no search, no
sliding, no direction of contact to follow, and more elements (they are cut at the crossings); litz finds all of it. Both take
the same penalty, load, increments and largest residual force. In litz the fibres have friction: without it some fibres of a
large mat snap aside, which springs along z cannot do.
"""

import itertools
import math

import numpy as np

from litz import build
from litz.model import Linear
from verification import figures

from . import peers
from .growth import exponent
from .networks import allowed_force, other_row, ours_row, reaction
from .process import run_litz

RADIUS, LAYERS = 0.1e-3, 6
#: Side of the smallest mat [m], elements of each of its fibres and bars of each of its plates
SIDE, ELEMENTS, BARS = 10e-3, 24, 6
#: Largest deviation of a fibre from the direction of its layer [rad]
SPREAD = math.radians(6)
#: Length over which a fibre bends [m]
SPAN = 2e-3
STEEL = build.Material("STEEL", young=200e9, poisson=0.3)
FRICTION = 0.2
#: Pressed height over the height of the layers, and increments
PRESSED, INCREMENTS = 0.068, 5
#: Fibres of each layer; they cross the whole mat, whose side grows with their number
SMALLEST = 8
SIZES = (8, 12, 16)
QUICK_SIZES = (8,)
#: Fibres of each layer up to which OpenSees is run
LIMIT = 240.0


def pile(per_layer, seed=1):
    """Model of a mat whose area grows with its fibres, and the contact's force over penetration [N/m]."""
    side = SIDE * per_layer / SMALLEST
    # ten times the stiffness of a clamped fibre between neighbouring crossings
    penalty = 10 * 192 * STEEL.young * math.pi * RADIUS**4 / 4 / SPAN**3
    model = build.fibre_mat(
        (side, side),
        per_layer,
        radius=RADIUS,
        seed=seed,
        n_layers=LAYERS,
        spread=SPREAD,
        n_elements=round(ELEMENTS * side / SIDE),
        n_bars=round(BARS * side / SIDE),
        material=STEEL,
        interaction=build.Interaction(behaviour=Linear(penalty), friction=FRICTION),
    )
    # a node with one rotation held and two free has an unsymmetric tangent
    for layer in range(1, LAYERS + 1):
        model.fix(f"LAYER{layer}_ENDS", "rotations")
    share = 1.0 / INCREMENTS
    step = model.press(PRESSED * 2 * RADIUS * (LAYERS + 1), increment=share, smallest=1e-3)
    step.node_print("PLATE_TOP", "RF", totals="ONLY")
    return model, penalty


def crossings(model):
    """Pairs of wires of neighbouring groups that cross in plan: (wire, wire, share of length along each, gap)."""
    found = []
    x = model.x
    for pair in model.contacts:
        for a in model.groups[pair.first].wires:
            for b in model.groups[pair.second].wires:
                (p, q), (r, s) = (x[np.array(wire.ends) - 1] for wire in (a, b))
                sides = np.column_stack([(q - p)[:2], (r - s)[:2]])
                along = np.linalg.solve(sides, (r - p)[:2])
                if (along > 0).all() and (along < 1).all():
                    found.append((a, b, *along, r[2] - p[2] - 2 * RADIUS))
    return found


def write_problem(path, model, penalty, tolerance):
    """The pile as the problem file of the other programs, with a node at each crossing."""
    old, nodes, elements, links, gaps = model.x, [], [], [], []
    number = {}
    places = {}
    pairs = crossings(model)
    for a, b, s, t, _ in pairs:
        places.setdefault(a, set()).add(s)
        places.setdefault(b, set()).add(t)
    at = {}
    for group in model.groups.values():
        for wire in group.wires:
            first, last = old[np.array(wire.ends) - 1]
            own = {i / len(wire.elements): node for i, node in enumerate(wire.nodes)}
            for share in sorted(own.keys() | places.get(wire, set())):
                at[wire, share] = len(nodes)
                if share in own:
                    number[own[share]] = len(nodes)
                nodes.append(first + share * (last - first))
            chain = range(len(nodes) - len(own.keys() | places.get(wire, set())), len(nodes))
            elements += itertools.pairwise(chain)
    for a, b, s, t, gap in pairs:
        links.append((at[a, s], at[b, t]))
        gaps.append(gap)
    held, moved = _supports(model, number, at)
    peers.write_frame(
        path,
        nodes=np.array(nodes),
        elements=np.array(elements),
        radius=np.full(len(elements), RADIUS),
        wire=np.zeros(len(elements), dtype=int),
        young=STEEL.young,
        poisson=STEEL.poisson,
        held=np.array(sorted(held)),
        moved=np.array([(node, 2) for node in moved]),
        value=np.array(list(moved.values())),
        increments=INCREMENTS,
        tolerance=tolerance,
        links=np.array(links),
        gap=np.array(gaps),
        penalty=penalty,
    )


def _supports(model, number, at):
    """Held (node, degree of freedom), and heights of the nodes that are moved."""
    held, moved = set(), {}
    for support in model.supports:
        for node in model.nodes_of(support.target):
            held |= {(number[node], dof - 1) for dof in range(support.first, support.last + 1)}
    for prescribed in model.steps[0].prescribed:
        for node in model.nodes_of(prescribed.target):
            moved[number[node]] = prescribed.value
    # all nodes of a plate belong to it, also those at crossings
    for name in ("PLATE_BOTTOM", "PLATE_TOP"):
        value = -PRESSED * 2 * RADIUS * (LAYERS + 1) * model.guides[name]
        for (wire, _), node in at.items():
            if wire in model.groups[name].wires:
                held |= {(node, dof) for dof in (0, 1, 3, 4, 5)}
                moved[node] = value
    still = [node for node, value in moved.items() if value == 0]
    held |= {(node, 2) for node in still}
    return held, {node: value for node, value in moved.items() if value != 0}


def measure(quick, directory):
    rows = []
    for per_layer in QUICK_SIZES if quick else SIZES:
        model, penalty = pile(per_layer)
        stem = f"pile_{per_layer}"
        deck, problem, results = model.write(directory / f"{stem}.inp"), directory / f"{stem}.npz", directory / stem
        ours = [run_litz(deck, results)]
        write_problem(problem, model, penalty, allowed_force(results, stem))
        others = []
        for _ in range(1 if quick else 3):
            ours.append(run_litz(deck, results))
            if not others or others[0].run.seconds < 60:
                others.append(peers.run_peer("OpenSeesPy", problem, "UmfPack", limit=LIMIT))
        row = {"fibres": per_layer * LAYERS, "elements": len(model.connectivity), "crossings": len(crossings(model))}
        row["litz"] = ours_row(ours, reaction(results, stem))
        row["other"] = other_row("OpenSeesPy", "UmfPack", others, row["litz"])
        rows.append(row)
    n = [row["elements"] for row in rows]
    growth = {key: exponent(n, [row["litz"][key] for row in rows]) for key in ("seconds_per_iteration", "memory")}
    return {"sizes": rows, "growth": growth}


def tables(values):
    header = "fibres,elements,crossings,program,iterations,time [s],per iteration [s],memory [MB],force [N],time / litz"
    lines = []
    for row in values["sizes"]:
        size = row["fibres"], row["elements"], row["crossings"]
        for name, run in (("litz", row["litz"]), ("OpenSeesPy, crossings given", row["other"])):
            if "failed" in run:
                lines.append([*size, name, run["failed"], *[None] * 5])
                continue
            label = name if run.get("finished", True) else f"{name} (gave up after increment {run['increments']})"
            numbers = run["iterations"], run["seconds"], run["seconds_per_iteration"], run["memory"] / 1e6
            lines.append([*size, label, *numbers, run["reaction"], run.get("time_ratio", 1)])
    return [("Time, memory and force on the upper plate", header.split(","), lines)]


def aims(values):
    return []


def draw(values, path):
    with figures.panels(path, columns=2) as (time, memory):
        for axes, key, scale, label in (
            (time, "seconds_per_iteration", 1.0, "time per iteration [s]"),
            (memory, "memory", 1e-6, "memory [MB]"),
        ):
            for name, style in (("litz", "o-"), ("other", "s--")):
                points = [(row["elements"], scale * row[name][key]) for row in values["sizes"] if key in row[name]]
                if points:
                    axes.loglog(*zip(*points, strict=True), style, label="OpenSees" if name == "other" else name)
            axes.set(xlabel="elements", ylabel=label)
        time.legend()

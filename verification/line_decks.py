"""Decks of round wires that touch along lines: what the cases of line contact share."""

import math

import numpy as np
from scipy.spatial.transform import Rotation

from verification.deck_text import chain, heading, join, step

#: Wires begin at these numbers of nodes and elements
FIRST, SECOND = 1, 10001


def material(name, wire, *sets):
    """Material and round section of element sets; `wire` has radius, young, poisson and, for conductors, resistivity."""
    lines = [f"*MATERIAL, NAME={name}", "*ELASTIC", f" {wire.young:.16g}, {wire.poisson:.16g}"]
    if getattr(wire, "resistivity", 0.0):
        lines += ["*ELECTRICAL CONDUCTIVITY", f" {1 / wire.resistivity:.17g}"]
    for elements in sets:
        lines += [f"*BEAM SECTION, ELSET={elements}, MATERIAL={name}, SECTION=CIRC", f" {wire.radius:.17g}"]
    return "\n".join(lines)


def touching(*pairs, stiffness=None, spot="", friction=None):
    """Contact of pairs of element sets.

    stiffness: force per length and overlap [N/m^2], None for Hertz; spot: law as *GAP ELECTRICAL CONDUCTANCE has it; friction:
    coefficient, or card and data of *FRICTION.
    """
    law = "HERTZ" if stiffness is None else f"LINEAR\n , {stiffness:.16g}"
    lines = ["*SURFACE INTERACTION, NAME=TOUCH", f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}"]
    if spot:
        lines.append(f"*GAP ELECTRICAL CONDUCTANCE, LAW={spot}")
    if isinstance(friction, str):
        lines.append(friction)
    elif friction is not None:
        lines += ["*FRICTION", f" {friction:.16g}"]
    for pair in pairs:
        lines += ["*CONTACT PAIR, INTERACTION=TOUCH", " " + ", ".join(pair)]
    return "\n".join(lines)


def uniform_spot(conductance):
    """Law of a contact with the same conductance per length [S/m] everywhere."""
    return f"CONSTANT, PER=LENGTH\n {1 / conductance:.17g}"


def prescribed(rows):
    """*BOUNDARY of (node, degree of freedom, value)."""
    return "\n".join(["*BOUNDARY", *(f" {node}, {dof}, {dof}, {value:.17g}" for node, dof, value in rows)])


def along_x(length, elements, z=0.0):
    """Points of a wire along x."""
    x = np.linspace(0.0, length, elements + 1)
    return np.column_stack([x, np.zeros_like(x), np.full_like(x, z)])


def on_helix(helix, angle, along):
    """Position and rotation of the section of a helix about z, where it has turned by `angle`, at the height `along`.

    The rotation takes a straight wire along z there.
    """
    outward = np.array([math.cos(angle), math.sin(angle), 0.0])
    tilted = Rotation.from_rotvec(-helix.angle * outward) * Rotation.from_rotvec([0.0, 0.0, angle])
    return helix.radius * outward + [0.0, 0.0, along], tilted


def rotation_vector(rotation, near):
    """The rotation vector of a rotation that is nearest to `near`: others differ by whole turns."""
    vector = rotation.as_rotvec()
    angle = np.linalg.norm(vector)
    if angle == 0:
        return vector
    turns = np.round((near @ vector / angle - angle) / (2 * math.pi))
    return vector * (1 + 2 * math.pi * turns / angle)


def twisted_pair(pair, states, turns, elements, *, stiffness=None, element="B33"):
    """Two straight wires along z that are twisted to helices; both ends are turned by half.

    pair: `helical_rods.TwistedPair`; states: `helical_rods.State` at `turns` (n), which the ends reach in equal increments
    from rest. Increments are not cut: between two states the ends would move along the chord, where they overlap.
    """
    z = np.linspace(0.0, pair.length, elements + 1)
    zero = np.zeros_like(z)
    a = pair.rod.radius
    ends = [
        (FIRST + elements, 0.0, 0.5),
        (FIRST, 0.0, -0.5),
        (SECOND + elements, math.pi, 0.5),
        (SECOND, math.pi, -0.5),
    ]
    motions = {node: _motion_of_end(pair, states, turns, phase, share) for node, phase, share in ends}
    leading = motions[FIRST + elements]
    tables = [amplitude(f"DOF{dof + 1}", column) for dof, column in enumerate(leading.T)]
    # all ends move alike but for signs
    led = [
        f"*BOUNDARY, AMPLITUDE=DOF{dof + 1}\n {node}, {dof + 1}, {dof + 1}, {1.0 if column @ leading[:, dof] >= 0 else -1.0}"
        for node, motion in motions.items()
        for dof, column in enumerate(motion.T)
    ]
    return join(
        heading(
            "Two straight wires twisted together",
            f"Model   {elements} {element} for each wire, ends as in the exact state",
        ),
        chain(np.column_stack([zero + a, zero, z]), element, "ONE", FIRST),
        chain(np.column_stack([zero - a, zero, z]), element, "OTHER", SECOND),
        f"*NSET, NSET=TURNED\n {FIRST + elements}, {SECOND + elements}",
        material("STEEL", pair.rod, "ONE", "OTHER"),
        touching(("ONE", "OTHER"), stiffness=stiffness),
        *tables,
        f"*STEP, INC={len(turns)}\n*STATIC, DIRECT\n {1 / len(turns):.17g}, 1.",
        *led,
        "*NODE PRINT, NSET=TURNED\n U, RF, RM\n*END STEP",
    )


def _motion_of_end(pair, states, turns, phase, share):
    """Displacements and rotation vectors of an end of a wire in each state, from rest, (n + 1, 6)."""
    start = np.array([pair.rod.radius * math.cos(phase), 0.0, pair.length * (0.5 + share)])
    motion = np.zeros((len(states) + 1, 6))
    for row, state, turned in zip(motion[1:], states, turns, strict=True):
        turn = 2 * math.pi * turned * share
        place, rotation = on_helix(state.helix, phase + turn, pair.length * (0.5 + share * state.helix.height))
        # the section turns from its place at the start, where the wire is straight
        rotation = rotation * Rotation.from_rotvec([0.0, 0.0, -phase])
        row[:3] = place - start
        row[3:] = rotation_vector(rotation, np.array([0.0, 0.0, turn]))
    return motion


def amplitude(name, values):
    """*AMPLITUDE through values at equal times of a step."""
    times = np.linspace(0.0, 1.0, len(values))
    return "\n".join(
        [f"*AMPLITUDE, NAME={name}", *(f" {t:.17g}, {v:.17g}" for t, v in zip(times, values, strict=True))]
    )


def pulled_strand(strand, states, length, elements, *, stiffness=None, element="B33", increments=2):
    """A strand along z, a step for each state of it; the ends of the wires move and turn with their helices.

    strand: `helical_rods.Strand` or `helical_rods.Bundle`; length [m]; states: `helical_rods.State` of each step.
    """
    z = np.linspace(0.0, length, elements + 1)
    free, names, blocks = strand.free, [], []
    if strand.core:
        zero = np.zeros_like(z)
        blocks = [
            chain(np.column_stack([zero, zero, z]), element, "CORE", FIRST),
            material("CORE_STEEL", strand.core, "CORE"),
        ]
    ends = {}
    for number in range(strand.count):
        phase = 2 * math.pi * number / strand.count
        angle = 2 * math.pi * z / strand.pitch + phase
        first = SECOND + 1000 * number
        names.append(f"WIRE{number + 1}")
        points = np.column_stack([free.radius * np.cos(angle), free.radius * np.sin(angle), z])
        blocks.append(chain(points, element, names[-1], first))
        ends |= {first: (phase, 0.0), first + elements: (angle[-1], length)}
    last = ([FIRST + elements] if strand.core else []) + [
        SECOND + 1000 * number + elements for number in range(strand.count)
    ]
    blocks += [
        "*NSET, NSET=PULLED\n " + "\n ".join(map(str, last)),
        "*ELSET, ELSET=WIRES\n " + "\n ".join(names),
        material("STEEL", strand.wire, *names),
        touching(("CORE", "WIRES") if strand.core else ("WIRES",), stiffness=stiffness),
        f"*BOUNDARY\n {FIRST}, ENCASTRE\n {FIRST + elements}, 1, 2\n {FIRST + elements}, 4, 5" if strand.core else "",
    ]
    for state in states:
        strain, turn = state.helix.height / free.height - 1, (state.helix.turn - free.turn) / free.height
        rows = [(FIRST + elements, 3, strain * length), (FIRST + elements, 6, turn * length)] if strand.core else []
        for node, (angle, along) in ends.items():
            start, tilted = on_helix(free, angle, along)
            place, rotation = on_helix(state.helix, angle + turn * along, (1 + strain) * along)
            motion = [*(place - start), *(rotation * tilted.inv()).as_rotvec()]
            rows += [(node, dof, value) for dof, value in enumerate(motion, start=1)]
        blocks.append(
            step(prescribed(rows), "*NODE PRINT, NSET=PULLED\n U, RF, RM", increments=increments, direct=False)
        )
    note = f"Model   {elements} {element} for each wire on {length:.6g} m, ends as in the exact state"
    return join(heading("A strand is pulled", note), *blocks)


def pressed_pair(pair, overlaps, length, elements, *, elements_2=None, spot="HERTZ", potentials="all", element="B33"):
    """Two straight wires, all nodes of which are led: the upper one is lowered by each of `overlaps` [m].

    pair: `parallel_wires.ParallelWires`. potentials: "all" nodes of each wire are electrodes, or the "lap" joint (in at the
    start of the lower wire, out at the end of the upper one) or the "hairpin" (both at the start); None: no current.
    """
    upper = elements if elements_2 is None else elements_2
    height = pair.first.radius + pair.second.radius
    electrodes = {
        "all": ("LOWER", "UPPER"),
        "lap": (FIRST, SECOND + upper),
        "hairpin": (FIRST, SECOND),
    }  # fmt: skip
    cards = []
    if potentials:
        plus, minus = electrodes[potentials]
        cards = ["*BOUNDARY\n PLUS, 9, 9, 1.\n MINUS, 9, 9, 0.", "*ELECTRODE PRINT\n PLUS, MINUS"]
    return join(
        heading("Two parallel wires pressed together", f"Model   {elements} and {upper} {element}, all nodes are led"),
        chain(along_x(length, elements), element, "LOWER", FIRST),
        chain(along_x(length, upper, height), element, "UPPER", SECOND),
        f"*NSET, NSET=PLUS\n {plus}\n*NSET, NSET=MINUS\n {minus}" if potentials else "",
        material("ONE", pair.first, "LOWER"),
        material("OTHER", pair.second, "UPPER"),
        touching(("LOWER", "UPPER"), spot=spot if potentials else ""),
        "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 1, 2\n UPPER, 4, 6",
        *(
            step(f"*BOUNDARY\n UPPER, 3, 3, {-overlap:.17g}", *cards, "*NODE PRINT, NSET=UPPER, TOTALS=ONLY\n RF")
            for overlap in overlaps
        ),
    )  # fmt: skip


def two_beams(
    wires, lengths, elements, supports, loading, *notes, stiffness=None, friction=None, printed="UPPER", element="B33"
):
    """A wire along x on another one; both lie in their common plane.

    wires, lengths, elements: of the lower and the upper wire; supports: data lines of *BOUNDARY besides the common plane;
    loading: cards of each step (a list of steps); printed: node set of the displacements in the history.
    """
    lower, upper = wires
    return join(
        heading("Two wires side by side that bend together", *notes),
        chain(along_x(lengths[0], elements[0]), element, "LOWER", FIRST),
        chain(along_x(lengths[1], elements[1], lower.radius + upper.radius), element, "UPPER", SECOND),
        f"*NSET, NSET=TIPS\n {FIRST + elements[0]}, {SECOND + elements[1]}",
        f"*NSET, NSET=STARTS\n {FIRST}, {SECOND}",
        material("ONE", lower, "LOWER"),
        material("OTHER", upper, "UPPER"),
        touching(("LOWER", "UPPER"), stiffness=stiffness, friction=friction),
        "*BOUNDARY\n LOWER, 2\n LOWER, 4\n LOWER, 6\n UPPER, 2\n UPPER, 4\n UPPER, 6",
        *supports,
        *(
            step(*cards, f"*NODE PRINT, NSET={printed}\n U, RF", "*NODE PRINT, NSET=STARTS\n U, RF, RM", direct=False)
            for cards in loading
        ),
    )  # fmt: skip


CLAMPED_STARTS = (f" {FIRST}, ENCASTRE", f" {SECOND}, ENCASTRE")


def cantilevers(lower, upper, beams, elements, **options):
    """A cantilever on a shorter one; the force at the tip of the upper one, as in `touching_beams.Cantilevers`."""
    tip = SECOND + elements[1]
    return two_beams(
        (lower, upper), (beams.support, beams.length), elements, CLAMPED_STARTS,
        [[f"*CLOAD\n {tip}, 3, {-beams.force:.17g}"]],
        "Expect  a point force at the tip of the lower one and a gap from there to the clamp",
        printed="TIPS", **options,
    )  # fmt: skip


def three_point_bending(lower, upper, beams, elements, **options):
    """Half of two beams in three-point bending, from the middle (x = 0) to the support of the lower one; the middle is lowered.

    beams: `touching_beams.ThreePointBending`.
    """
    supports = (
        f" {FIRST}, 1\n {FIRST}, 4, 6\n {FIRST + elements[0]}, 3",
        f" {SECOND}, 1\n {SECOND}, 4, 6",
    )
    return two_beams(
        (lower, upper), (beams.span / 2, beams.span / 2), elements, supports,
        [[f"*BOUNDARY\n {SECOND}, 3, 3, {-beams.deflection:.17g}"]],
        "Expect  point forces between the beams in the middle and at the end, nothing else",
        printed="TIPS", **options,
    )  # fmt: skip


def shared_load(lower, upper, beams, elements, **options):
    """Two beams clamped at both ends; a uniform load on the upper one, as in `touching_beams.SharedLoad`."""
    ends = [FIRST, FIRST + elements[0], SECOND, SECOND + elements[1]]
    force = -beams.load * beams.span / elements[1]
    loaded = "\n".join(f" {node}, 3, {force:.17g}" for node in range(SECOND + 1, SECOND + elements[1]))
    return two_beams(
        (lower, upper), (beams.span, beams.span), elements, [f" {node}, ENCASTRE" for node in ends],
        [[f"*CLOAD\n{loaded}"]],
        "Expect  a line force of q EI_2/(EI_1 + EI_2) away from the ends",
        stiffness=options.pop("stiffness", beams.stiffness), printed="STARTS", **options,
    )  # fmt: skip


def slipping_pair(wire, pair, elements, forces, elastic_slip, **options):
    """Two cantilevers pressed together by opposite line loads, then bent by forces at their tips, half on each.

    pair: `slipping_pair.SlippingPair`; forces: at the tips [N], a step for each; elastic_slip: before friction reaches its
    limit [m].
    """
    each = pair.pressing * pair.length / elements
    pressing = ["*CLOAD"]
    for first, sign in ((FIRST, 1), (SECOND, -1)):
        pressing += [f" {first + i}, 3, {sign * each:.17g}" for i in range(1, elements)]
        pressing.append(f" {first + elements}, 3, {sign * each / 2:.17g}")
    bending = []
    for force in forces:
        # a new value of a step replaces that of the step before
        tips = [each / 2 - force / 2, -each / 2 - force / 2]
        rows = [f" {first + elements}, 3, {tip:.17g}" for first, tip in zip((FIRST, SECOND), tips, strict=True)]
        bending.append(["*CLOAD\n" + "\n".join(rows), "*ENERGY PRINT"])
    return two_beams(
        (wire, wire), (pair.length, pair.length), (elements, elements), CLAMPED_STARTS,
        [["\n".join(pressing)], *bending],
        "Expect  one beam until the friction is reached everywhere at once, then two",
        friction=f"*FRICTION, ELASTIC SLIP={elastic_slip}\n {pair.friction:.16g}", printed="TIPS", **options,
    )  # fmt: skip

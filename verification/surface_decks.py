"""Decks of wires on rigid surfaces."""

import math

import numpy as np

from verification.deck_text import chain, heading, join
from verification.line_decks import material


def on_surface(name, shape, data, *, node=None, law="HERTZ", friction=None, wires="WIRE"):
    """A rigid surface with its contact pair; `node` is the number and the position of its reference node."""
    numbers = ", ".join(f"{value:.17g}" for value in data)
    lines = [f"*SURFACE INTERACTION, NAME=I{name}", f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}"]
    if friction:
        lines += ["*FRICTION", f" {friction:.17g}"]
    moves = ""
    if node is not None:
        number, place = node
        lines += ["*NODE", f" {number}, " + ", ".join(f"{value:.17g}" for value in place)]
        moves = f", REF NODE={number}"
    lines += [f"*RIGID SURFACE, NAME={name}, TYPE={shape}{moves}", f" {numbers}"]
    lines += [f"*CONTACT PAIR, INTERACTION=I{name}", f" {wires}, {name}"]
    return "\n".join(lines)


def boundary(rows, *, new=False):
    """*BOUNDARY of (node or set, first, last, value)."""
    lines = [f" {node}, {first}, {last}, {value:.17g}" for node, first, last, value in rows]
    return "\n".join(["*BOUNDARY, OP=NEW" if new else "*BOUNDARY", *lines])


def forces(rows, *, new=False):
    """*CLOAD of (node, direction, force)."""
    return "\n".join(
        ["*CLOAD, OP=NEW" if new else "*CLOAD", *(f" {node}, {way}, {value:.17g}" for node, way, value in rows)]
    )


def static(words, increments, most=400):
    """A step of time 1 with the numbers of *STATIC."""
    return f"*STEP, INC={most}\n*STATIC\n {increments}\n{words}\n*END STEP"


#: A wire along x that bends in the plane of x and z
IN_PLANE = [("WIRE", 2, 2, 0.0), ("WIRE", 4, 4, 0.0), ("WIRE", 6, 6, 0.0)]


def rod_over_drum(wire, radius, tension, elements, *, friction=0.0, pull=0.0):
    """A straight rod is hung over a drum by dead weights, and with `pull` [m] drawn over it by one end.

    radius: of the centre line on the drum; tension: of the weights [N].
    """
    length = math.pi * radius + 6 * radius
    x = np.linspace(-length / 2, length / 2, elements + 1)
    points = np.column_stack([x, np.zeros_like(x), np.full_like(x, radius + 1e-7)])
    middle, last = elements // 2 + 1, elements + 1
    middle_held = [*IN_PLANE, (middle, 1, 1, 0.0), (middle, 5, 5, 0.0)]
    steps = [
        static(boundary([(1, 3, 3, -2e-4), (last, 3, 3, -2e-4)]), "1, 1"),
        static(
            join(boundary(middle_held, new=True), forces([(1, 3, -tension), (last, 3, -tension)])),
            "0.01, 1, 1e-5, 0.1",
        ),
    ]
    if pull:
        drawn = join(boundary([*IN_PLANE, (last, 3, 3, -pull)], new=True), forces([(1, 3, -tension)], new=True))
        steps.append(static(drawn, "0.02, 1, 1e-5, 0.2"))
    return join(
        heading("A rod hangs over a drum, and is drawn over it"),
        chain(points, "B33", "WIRE"),
        material("M", wire, "WIRE"),
        on_surface("DRUM", "CYLINDER", [0, 0, 0, 0, 1, 0, radius - wire.radius], friction=friction),
        boundary(middle_held),
        *steps,
    )


def curved_beam_on_plane(wire, half_length, curvature, loads, elements):
    """A beam of constant curvature, convex towards the plane, is laid on it, and pressed by forces at its ends, a step each."""
    angle = np.linspace(-1.0, 1.0, elements + 1) * half_length * curvature
    points = np.column_stack([np.sin(angle), np.zeros_like(angle), 1 - np.cos(angle)]) / curvature
    points[:, 2] += wire.radius
    middle, last = elements // 2 + 1, elements + 1
    held = [*IN_PLANE, (middle, 1, 1, 0.0), (middle, 5, 5, 0.0)]
    steps = [static(boundary([(middle, 3, 3, -1e-8)]), "1, 1")]
    for load in loads:
        pressed = forces([(1, 3, -load), (last, 3, -load)], new=True)
        steps.append(static(join(boundary(held, new=True), pressed), "0.1, 1"))
    return join(
        heading("A curved beam is flattened on a plane"),
        chain(points, "B33", "WIRE"),
        material("M", wire, "WIRE"),
        on_surface("TABLE", "PLANE", [0, 0, 0, 0, 0, 1]),
        boundary(held),
        *steps,
    )


def beam_in_bore(wire, length, clearance, loads, elements):
    """A hinged beam is bent onto the wall of a bore and then compressed, a step for each load."""
    x = np.linspace(-length / 2, length / 2, elements + 1)
    middle, last = elements // 2 + 1, elements + 1
    held = [(1, 1, 4, 0.0), (last, 2, 4, 0.0), *IN_PLANE]
    steps = [static(boundary([(middle, 3, 3, -1.0001 * clearance)]), "1, 1")]
    push = forces([(middle, 3, -0.02), (last, 1, -loads[0])])
    steps.append(static(join(boundary(held, new=True), push), "0.2, 1"))
    steps += [static(join(boundary(held, new=True), forces([(last, 1, -load)], new=True)), "0.2, 1") for load in loads]
    return join(
        heading("A beam buckles in a bore"),
        chain(np.column_stack([x, 0 * x, 0 * x]), "B33", "WIRE"),
        material("M", wire, "WIRE"),
        on_surface("BORE", "BORE", [0, 0, 0, 1, 0, 0, wire.radius + clearance]),
        boundary(held),
        *steps,
    )


def ring_between_plates(wire, radius, shortening, elements):
    """A ring on a table is pressed by a plate; a node at half the height is moved by half, as symmetry wants it."""
    angle = 2 * np.pi * np.arange(elements) / elements
    points = radius * np.column_stack([np.sin(angle), np.zeros_like(angle), -np.cos(angle)])
    top = radius + wire.radius
    ring = chain(points, "B33", "WIRE") + f"\n {elements}, {elements}, 1"
    held = [*IN_PLANE, (1, 1, 1, 0.0), (1, 5, 5, 0.0), (10001, 1, 2, 0.0), (10001, 4, 6, 0.0)]
    return join(
        heading("A ring between two plates"),
        ring,
        material("M", wire, "WIRE"),
        on_surface("TABLE", "PLANE", [0, 0, -top, 0, 0, 1]),
        on_surface("PLATE", "PLANE", [0, 0, top, 0, 0, -1], node=(10001, (0, 0, top))),
        boundary(held),
        static(boundary([(10001, 3, 3, -shortening), (elements // 4 + 1, 3, 3, -shortening / 2)]), "0.25, 1"),
    )


def wire_between_plates(wire, length, approaches, elements):
    """A straight wire on a table is pressed by a plate, a step for each approach of the plates; both touch it at the start."""
    touch = wire.radius - min(approaches) / 20
    x = np.linspace(-length / 2, length / 2, elements + 1)
    held = [*IN_PLANE, ("WIRE", 1, 1, 0.0), ("WIRE", 5, 5, 0.0), (10001, 1, 2, 0.0), (10001, 4, 6, 0.0)]
    return join(
        heading("A wire between two plates"),
        chain(np.column_stack([x, 0 * x, 0 * x]), "B33", "WIRE"),
        material("M", wire, "WIRE"),
        on_surface("TABLE", "PLANE", [0, 0, -touch, 0, 0, 1]),
        on_surface("PLATE", "PLANE", [0, 0, touch, 0, 0, -1], node=(10001, (0, 0, touch))),
        boundary(held),
        *(static(boundary([(10001, 3, 3, 2 * (wire.radius - touch) - approach)]), "0.5, 1") for approach in approaches),
    )

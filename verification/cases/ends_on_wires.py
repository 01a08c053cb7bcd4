"""Round ends of wires on wires: tips, also as they pass each other, crossings before ends, short laps; lenses of small angles.

Clean metal conducts as it gives way (J. R. Barber, Proc. R. Soc. A 459 (2003) 53-66).

Source: boundary-element solutions, references/end_in_half_space.py: of contacts that are short beside the radius on a
half-space, of others on solid wires, references/solid_wire.py.
"""

import math

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.line_decks import FIRST, SECOND, material, touching
from verification.wire_decks import Wire

RADIUS, OVERLAP = 1e-3, 1e-5
WIRE = Wire(radius=RADIUS, young=120e9, poisson=0.34, resistivity=1.7e-8)
MODULUS = WIRE.young / (1 - WIRE.poisson**2) / 2
#: E* r^(1/2) [N m^(-3/2)], and sqrt(r delta) [m]
STIFFNESS, LENGTH = MODULUS * RADIUS**0.5, math.sqrt(RADIUS * OVERLAP)
#: Slopes of tips, in sqrt(delta/r)
SLOPES = (1.0, 0.5, 0.25, 0.15, 0.1, 0.05, 0.025)
#: Slopes at overlaps of a hundredth of a percent, of wedges up to a third of a radius long
SLIGHT_SLOPES, LIGHT = (1.0, 0.5, 0.25, 0.1, 0.05, 0.03), 1e-7
#: Those whose overlap is short
SHORT_TIPS = SLOPES[:3]
#: Lengths of laps, and of one whose wires part by these curvatures [1/r], in sqrt(r delta)
LAPS, ARCH, BENDS = (2.5, 5.0, 10.0, 20.0), 20.0, (0.01, 0.02, 0.03)
#: Slopes of tips that pass the end of the other wire, and how far they are before it [r]
PASSING, PLACES = (0.00873, 0.01746), (1.0, 0.5, 0.25, 0.0, -0.05)
#: Places of crossings before the end, in sqrt(r delta)
BEFORE = (0.0, 0.3, 0.6, 1.0)
#: Angles of crossings [degrees], and their place before the end of one wire or of both; the overlap of these [m]
ANGLES, ASIDE, SLIGHT = (60, 45, 30, 22), 0.6, 1e-6
#: Half lengths of lenses [r] at either overlap
LENSES = (0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0)


def measure(workspace):
    tips = [force_of(workspace, f"tip_{v}", straight((0, 0), v * math.sqrt(OVERLAP / RADIUS))) for v in SLOPES]
    laps = [force_of(workspace, f"lap_{length}", *lap(length * LENGTH)) for length in LAPS]
    arches = [force_of(workspace, f"arch_{bend}", *lap(ARCH * LENGTH, bend / RADIUS)) for bend in BENDS]
    across = [force_of(workspace, f"before_{place}", straight((0, -place * LENGTH), math.inf)) for place in BEFORE]
    return {
        "ends_on_wires.tips": tips,
        "ends_on_wires.light_tips": [
            force_of(workspace, f"light_tip_{v}", straight((0, 0), v * math.sqrt(LIGHT / RADIUS)), overlap=LIGHT)
            for v in SLIGHT_SLOPES
        ],
        "ends_on_wires.laps": laps,
        "ends_on_wires.arches": arches,
        "ends_on_wires.passing": [
            force_of(workspace, f"passing_{slope}_{place}", straight((-place * RADIUS, 0), slope), end=0.0)
            for slope in PASSING
            for place in PLACES
        ],
        "ends_on_wires.crossings": across,
        "ends_on_wires.oblique": [
            force_of(workspace, f"oblique_{angle}", oblique(angle), overlap=SLIGHT) for angle in ANGLES
        ],
        "ends_on_wires.two_ends": [
            force_of(workspace, f"two_ends_{angle}", oblique(angle), ASIDE * length_of(SLIGHT), overlap=SLIGHT)
            for angle in ANGLES
        ],
        "ends_on_wires.lenses": [
            force_of(workspace, f"lens_{overlap}_{half}", crossing(half * RADIUS, overlap), overlap=overlap)
            for overlap in (SLIGHT, OVERLAP)
            for half in LENSES
        ],
        "ends_on_wires.conductances_of_tips": [
            conductance_of(workspace, f"live_tip_{v}", straight((0, 0), v * math.sqrt(OVERLAP / RADIUS)))
            for v in SHORT_TIPS
        ],
        "ends_on_wires.conductances_at_two_ends": [
            conductance_of(workspace, f"live_ends_{angle}", oblique(angle), ASIDE * length_of(SLIGHT), overlap=SLIGHT)
            for angle in ANGLES
        ],
        "figure": {"tips": tips, "laps": laps},
    }


def draw(values, path):
    with figures.panels(path) as (tips, laps):
        tips.plot(SLOPES, values["figure"]["tips"], "o", label="litz")
        tips.plot(
            SLOPES, [1.133, 1.185, 1.612, 2.103, 2.741, 4.697, 8.66], label="boundary elements", **figures.REFERENCE
        )
        tips.set(xlabel="slope of the tip [(delta/r)^(1/2)]", ylabel="force [E* r^(1/2) delta^(3/2)]", ylim=(0, None))
        tips.legend()
        laps.plot(LAPS, values["figure"]["laps"], "o")
        laps.plot(LAPS, [2.404, 3.499, 5.642, 9.908], **figures.REFERENCE)
        laps.set(xlabel="length of the lap [(r delta)^(1/2)]", ylim=(0, None))


def straight(tip, slope, n=10, length=10 * RADIUS):
    """Points of a wire from its tip on: along x and up, or with an infinite slope along y; the other wire is along x."""
    s = np.linspace(0, length, n + 1)
    if math.isinf(slope):
        return np.column_stack([0 * s, tip[1] + s, 0 * s])
    return np.column_stack([tip[0] + s / math.hypot(1, slope), tip[1] + 0 * s, s * slope / math.hypot(1, slope)])


def oblique(degrees):
    """Points of a wire that crosses the x axis at an angle, just behind its own end."""
    along = np.linspace(-ASIDE * length_of(SLIGHT), 10 * RADIUS, 12)[:, None]
    return along * [math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0]


def crossing(half_length, overlap):
    """Points of a wire that crosses the x axis at the angle at which the lens is so long [m]."""
    sine = 2 * math.sqrt(RADIUS * overlap * (1 - overlap / (4 * RADIUS))) / half_length
    along = np.linspace(-11.87 * RADIUS, 10.13 * RADIUS, 23)[:, None]
    return along * [math.sqrt(1 - sine**2), sine, 0]


def lap(length, bend=0.0):
    """Points of the upper wire, which begins half a lap before the middle, and where the lower one ends [m].

    The upper one is an arc about the middle of the lap, lower at both ends of it by what its curvature makes of that.
    """
    x = np.arange(-length / 2, 10 * RADIUS, RADIUS / 2)
    height = bend / 2 * ((length / 2) ** 2 - x**2)
    return np.column_stack([x, 0 * x, height]), length / 2


def length_of(overlap):
    """The unit of lengths [m]."""
    return math.sqrt(RADIUS * overlap)


def force_of(workspace, name, upper, end=12 * RADIUS, overlap=OVERLAP):
    """Force of the upper wire on one along x that ends there, over E* r^(1/2) delta^(3/2)."""
    return float(contacts_of(workspace, name, upper, end, overlap)["force"].sum()) / (STIFFNESS * overlap**1.5)


def conductance_of(workspace, name, upper, end=12 * RADIUS, overlap=OVERLAP):
    """The same conductance, over (r delta)^(1/2) and the resistivity."""
    contacts = contacts_of(workspace, name, upper, end, overlap)
    return float((1 / contacts["resistance"]).sum()) * WIRE.resistivity / length_of(overlap)


def contacts_of(workspace, name, upper, end, overlap):
    """Contacts of the upper wire, pressed by this overlap on one along x that ends there."""
    lower = np.array([end, 0, 0]) - np.linspace(20 * RADIUS, 0, 21)[:, None] * [1, 0, 0]
    deck = join(
        heading("The end of a wire on another one", "Model   all nodes are led"),
        chain(lower, "B33", "LOWER", FIRST),
        chain(upper + np.array([0, 0, 2 * RADIUS]), "B33", "UPPER", SECOND),
        material("METAL", WIRE, "LOWER", "UPPER"),
        touching(("LOWER", "UPPER"), spot="HERTZ"),
        "*BOUNDARY\n LOWER, ENCASTRE\n LOWER, 9, 9\n UPPER, 1, 2\n UPPER, 4, 6",
        step(f"*BOUNDARY\n UPPER, 3, 3, {-overlap:.17g}\n UPPER, 9, 9, 1e-3"),
    )
    return workspace.run(name, deck).contacts_at(-1)


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["ends_on_wires"]))

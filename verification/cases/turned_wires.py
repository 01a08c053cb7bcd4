"""Two wires turned from crossed to parallel, and a wire turned over the crest of an arc: from point to line.

Source: H. Hertz (1882) and R. Holm for crossed wires, K. L. Johnson, Contact Mechanics (1985), section 4.2(c) and 5.6, for wires
side by side and, section by section, for those that cross at a very small angle; in references/hertz.py and
references/parallel_wires.py. In between, overlap, force and resistance change steadily, as the surfaces are smooth,
and fall as the contact grows.
"""

import math

import numpy as np

from verification import figures
from verification.deck_text import arc, chain, heading, join, straight
from verification.line_decks import FIRST, SECOND, material, touching
from verification.references import hertz
from verification.references.parallel_wires import ParallelWires, PressedWire

COPPER = PressedWire(0.5e-3, 120e9, 0.34, 1 / 5.88e7)
PAIR = ParallelWires(COPPER, COPPER)
FORCE, LENGTH, ELEMENTS = 10.0, 20e-3, 14
#: Angles between the wires [rad]: each 3 % below the one before, from 90 to 0.05 degrees; then none
ANGLES = np.radians([*(90 * 0.97 ** np.arange(247)), 0.0])
#: Angles that are compared with crossed wires, and with sections of parallel ones, as indices
CROSSED, SMALL = (
    [int(np.abs(np.degrees(ANGLES) - degrees).argmin()) for degrees in group] for group in ((87, 60, 30), (0.5, 0.1, 0))
)
FILM, PER_LENGTH, HARDNESS = 1e-11, 1e-7, 1e9
#: Angles from point to line [rad], each 2 % below the one before, from 20 to 0.5 degrees, and spots that are compared there
FINE = np.radians(20 * 0.98 ** np.arange(184))
#: Increments from one of these angles to the next where the resistance is held against the force: which part of it places
#: carry, and the angle they see, may be those of the increment before while they change by less than 2 %
CLOSE = 4
SPOTS = {
    "metal": "HERTZ, VOLTAGE=LINEAR",
    "film": f"FILM, VOLTAGE=LINEAR\n {FILM}",
    "hardness": f"PLASTIC, VOLTAGE=LINEAR\n {HARDNESS}",
    "per length": f"CONSTANT, PER=LENGTH, VOLTAGE=LINEAR\n {PER_LENGTH}",
}
#: Force on wires that bend between their ends, which do not follow each other yet at the smallest angle, and on those of
#: a hardness, whose lens is short at the largest ones [N]
GENTLE = 0.05
#: The wire that turns lies off the middle by this [m], so that the places of the two wires do not meet
SHIFT = 0.73e-4
#: Arc: its radius, the overlap at its crest [m], and the angles of the other wire [rad]
CREST, OVERLAP, TURNS = 0.5, 1e-6, np.radians(np.linspace(-6, 6, 121))
#: Reference node of the wire that turns
HEAD = 20001


def turned(lower, upper, angles, overlap, *, force=0.0, spot, elastic=False):
    """The upper one of two wires is a rigid body that is lowered by the overlap and then turned about z through the angles.

    With a force, it is held by that instead while it turns. Elastic wires are held at their ends only.
    """
    fixed, tied = ("LOWER_ENDS", "UPPER_ENDS") if elastic else ("LOWER", "UPPER")
    ends = [(FIRST, FIRST + len(lower) - 1), (SECOND, SECOND + len(upper) - 1)]
    held = f"*BOUNDARY, OP=NEW\n {fixed}, ENCASTRE\n {HEAD}, 1, 2\n {HEAD}, 4, 5\n LOWER, 9, 9, 0.\n UPPER, 9, 9, 1e-3"
    lowered = f" {HEAD}, 3, 3, {-overlap:.17g}"
    printed = "*NODE PRINT, NSET=HEAD\n U, RF\n*ELECTRODE PRINT\n UPPER, LOWER\n*END STEP"
    count = len(angles) - 1
    turn = [f" {1 + i}, {angle:.17g}" for i, angle in enumerate(angles)]
    return join(
        chain(lower, "B33", "LOWER", FIRST),
        chain(upper, "B33", "UPPER", SECOND),
        f"*NODE, NSET=HEAD\n {HEAD}, 0., 0., {2 * COPPER.radius}",
        material("COPPER", COPPER, "LOWER", "UPPER"),
        touching(("LOWER", "UPPER"), spot=spot),
        *(f"*NSET, NSET={name}_ENDS\n {a}, {b}" for name, (a, b) in zip(("LOWER", "UPPER"), ends, strict=True)),
        f"*RIGID BODY, REF NODE={HEAD}, TIE NSET={tied}",
        "\n".join(["*AMPLITUDE, NAME=TURN, TIME=TOTAL TIME", " 0., 0.", *turn]),
        f"*STEP\n*STATIC, DIRECT\n 1., 1.\n{held}\n{lowered}\n {HEAD}, 6",
        *([f"*CLOAD\n {HEAD}, 3, {-force}"] if force else []),
        printed,
        f"*STEP, INC={count}\n*STATIC, DIRECT\n 1., {count}.\n{held}",
        *([] if force else [lowered]),
        f"*BOUNDARY, OP=NEW, AMPLITUDE=TURN\n {HEAD}, 6, 6, 1.\n{printed}",
    )


def sweep(spot, shift=0.0, *, angles=ANGLES, force=FORCE, elements=ELEMENTS, elastic=False):
    """Two straight wires under a constant force, turned through angles that begin at 90 degrees."""
    lower = straight(LENGTH, elements) - [LENGTH / 2, 0, 0]
    upper = straight(LENGTH, elements, (0.0, 1.0, 0.0)) - [0, LENGTH / 2 - shift, -2 * COPPER.radius]
    return join(
        heading(
            "Two wires are turned from crossed to parallel under a constant force",
            f"Model   {elements} B33 each, one fixed, one free along z, {'at their ends' if elastic else 'rigid'}",
            "Expect  Hertz and Holm at first, parallel wires at last",
        ),
        turned(
            lower, upper, math.pi / 2 - angles, crossed(force=force).approach, force=force, spot=spot, elastic=elastic
        ),
    )


def from_point_to_line(run, spot, *, increments=1, **options):
    """Overlap and resistance at the angles `FINE`, with so many increments from one to the next; `run` takes a deck."""
    approaching = np.radians(np.geomspace(90, 20, 40))[:-1]
    turning = FINE[0] * (FINE[1] / FINE[0]) ** (np.arange((len(FINE) - 1) * increments + 1) / increments)
    text = sweep(spot, SHIFT, angles=np.concatenate([approaching, turning]), **options)
    return tuple(column[len(approaching) :: increments] for column in columns(run, text)[:2])


def unsteadiness(values):
    """Largest rise between angles that fall, and largest ripple, of a value at the angles `FINE`."""
    return [float((values[1:] / values[:-1] - 1).max()), ripple(-np.log(FINE), values)]


def over_arc(spot):
    """A straight wire at a fixed height over the crest of an arc."""
    angle, n = 16e-3 / CREST, 16
    x, z, _ = arc(CREST, angle, n).T
    # the crest is not at a node
    crest = angle / 2 + 0.3e-3 / CREST
    lower = np.column_stack([x, np.zeros(n + 1), z]) - [CREST * math.sin(crest), 0, CREST * (1 - math.cos(crest))]
    turn = np.array([[math.cos(crest), 0, math.sin(crest)], [0, 1, 0], [-math.sin(crest), 0, math.cos(crest)]])
    lower = (lower @ turn.T) * [1, 1, -1]
    first = TURNS[0]
    upper = straight(16e-3, n, (math.cos(first), math.sin(first), 0.0))
    upper = upper - upper.mean(0) + SHIFT * np.array([math.cos(first), math.sin(first), 0]) + [0, 0, 2 * COPPER.radius]
    return join(
        heading(
            "A straight wire is turned over the crest of an arc, through the position in which they are parallel",
            f"Model   {n} B33 each, both rigid",
            "Expect  a force that changes steadily",
        ),
        turned(lower, upper, TURNS - first, OVERLAP, spot=spot),
    )


def touching_length(overlap, angles):
    """Of two straight wires that overlap in their middle: the axes are less than two radii apart."""
    return 2 * np.sqrt((4 * COPPER.radius - overlap) * overlap) / np.sin(angles)


def crossed(angle=math.pi / 2, force=FORCE):
    """The spot of crossed wires."""
    modulus = hertz.effective_modulus([COPPER.young] * 2, [COPPER.poisson] * 2)
    return hertz.crossed_wires(
        force, angle, radius=[COPPER.radius] * 2, modulus=modulus, resistivity=[COPPER.resistivity] * 2
    )


def departure_from_round_spot(overlap, resistance):
    """Of wires that yield with the hardness of `SPOTS`, from F = pi a^2 H under Hertz's force of their overlap: while half
    of their lens is shorter than 0.3 radii, from where on it is a strip the more the longer it is."""
    force = np.array([(d / crossed(angle, 1.0).approach) ** 1.5 for d, angle in zip(overlap, FINE, strict=True)])
    exact = COPPER.resistivity / 2 * np.sqrt(math.pi * HARDNESS / force)
    is_short = touching_length(overlap, FINE) < 0.6 * COPPER.radius
    return float(np.abs(resistance / exact - 1)[is_short].max())


def ripple(x, values, neighbours=8):
    """Largest departure of a curve from the cubic through its neighbourhood, relative to the value."""
    worst = 0.0
    for i in range(neighbours, len(x) - neighbours):
        near = slice(i - neighbours, i + neighbours + 1)
        smooth = np.polyfit(x[near] - x[i], values[near], 3)[-1]
        worst = max(worst, abs(values[i] / smooth - 1))
    return float(worst)


def columns(run, text):
    """Overlap of the middle and resistance of each increment, and the force; `run` gives the results of a deck."""
    history = run(text).history
    node = f"node {HEAD}"
    return -history[f"U3 {node}"][1:], history["resistance UPPER to LOWER"][1:], -history[f"RF3 {node}"][1:]


def measure(workspace):
    def columns_of(name, text):
        return columns(lambda deck: workspace.run(name, deck), text)

    _, _, force = columns_of("over_arc", over_arc(f"FILM, VOLTAGE=LINEAR\n {FILM}"))
    values = {"turned_wires.arc": ripple(TURNS, force)}
    if workspace.quick:
        return values | {"figure": {}}
    overlap, resistance, _ = columns_of("sweep", sweep(SPOTS["metal"]))
    film, with_film, _ = columns_of("sweep_film", sweep(SPOTS["film"], SHIFT))
    fine = {
        name: from_point_to_line(
            lambda deck, name=name: workspace.run(f"fine_{name.replace(' ', '_')}", deck),
            spot,
            increments=CLOSE if name == "hardness" else 1,
            force=GENTLE if name == "hardness" else FORCE,
        )
        for name, spot in SPOTS.items()
    }
    fine["elastic wires"] = from_point_to_line(
        lambda deck: workspace.run("fine_elastic", deck), SPOTS["metal"], force=GENTLE, elastic=True
    )
    unsteady = np.array([unsteadiness(found) for _, found in fine.values()])
    given = fine["per length"][0]
    lengths = PER_LENGTH / fine["per length"][1]
    small = -np.log(ANGLES[:-1])
    values |= {
        "turned_wires.crossed.overlap": overlap[CROSSED].tolist(),
        "turned_wires.crossed.resistance": resistance[CROSSED].tolist(),
        "turned_wires.overlap": overlap[SMALL[:2]].tolist(),
        "turned_wires.parallel": float(overlap[-1]),
        "turned_wires.resistance": resistance[SMALL[1:]].tolist(),
        "turned_wires.rise": [
            float(np.diff(column).max() / column[0]) for column in (overlap, film, resistance, with_film)
        ],
        "turned_wires.ripple": [ripple(small, column[:-1]) for column in (overlap, film, resistance, with_film)],
        "turned_wires.fine.rise": [rise for name, rise in zip(fine, unsteady[:, 0], strict=True) if name != "hardness"],
        "turned_wires.fine.round": departure_from_round_spot(*fine["hardness"]),
        "turned_wires.fine.ripple": unsteady[:, 1].tolist(),
        "turned_wires.fine.sections": float(fine["metal"][1][-1]),
        "turned_wires.fine.length": float(np.abs(lengths / touching_length(given, FINE) - 1).max()),
    }
    return values | {
        "figure": {
            "overlap": overlap.tolist(),
            "resistance": resistance.tolist(),
            "force": force.tolist(),
            "fine": {name: found.tolist() for name, (_, found) in fine.items()},
        }
    }


def draw(values, path):
    found = values["figure"]
    if not found:
        return
    degrees, shown = np.degrees(ANGLES[:-1]), slice(0, -1)
    with figures.panels(path, columns=4) as (overlap, resistance, fine, force):
        small = degrees[degrees < 3]
        exact = np.array([PAIR.nearly_parallel(FORCE, math.radians(angle), LENGTH) for angle in small])
        overlap.loglog(small, 1e6 * exact[:, 0], label="parallel wires, summed", **figures.REFERENCE)
        overlap.plot([90], [1e6 * crossed().approach], "o", color="#222222", label="Hertz, Holm")
        overlap.plot(
            degrees, 1e6 * np.array(found["overlap"][shown]), color=figures.STYLES["B33"]["color"], label="litz"
        )
        overlap.set(xlabel="angle [degrees]", ylabel="overlap [micrometres]")
        overlap.legend()
        resistance.loglog(small, 1e6 / exact[:, 1], **figures.REFERENCE)
        resistance.plot([90], [1e6 * crossed().resistance], "o", color="#222222")
        resistance.plot(degrees, 1e6 * np.array(found["resistance"][shown]), color=figures.STYLES["B33"]["color"])
        resistance.set(xlabel="angle [degrees]", ylabel="resistance [microohm]")
        for i, (name, of_angle) in enumerate(found["fine"].items()):
            fine.loglog(np.degrees(FINE), np.array(of_angle) / of_angle[0], color=f"C{i}", label=name)
        fine.set(xlabel="angle [degrees]", ylabel="resistance, over that at 20 degrees")
        fine.legend()
        force.plot(np.degrees(TURNS), found["force"], color=figures.STYLES["B33"]["color"])
        force.set(xlabel="angle to the arc [degrees]", ylabel="force [N]")


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["turned_wires"]))

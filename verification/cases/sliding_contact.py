"""A wire dragged over five elements of another: force, energy, hand-over between elements; wires that would pass.

Source: deflection of a clamped beam at any point, Roark's Formulas for Stress and Strain, 7th ed., table 8.1; Hertz's
contact, Johnson, Contact Mechanics, section 4.2. Without friction the energy is stored, so that the work of dragging is
its change: U = F^2 (c1 + c2)/2 + 2 F delta/5. Three small things are known about the mesh and the tilt of the rail:
inside an element of length h, at xi, the mesh does not see the part h^3 (1 - xi^2)^3/(192 E I) of the deflection; where
the rail has a slope s, the contact lies 2 r s nearer the support, and the axes need r s^2 less of the approach. With
AXIS=LINEAR the drag jumps at a node by the force times the angle of the two chords. The deck of the positions is
inputs/03_large_sliding.inp.
"""

import math

import numpy as np

import litz
from verification import figures
from verification.references import crossed_wires, hertz
from verification.wire_decks import COPPER, INPUTS, Crossing, interaction

RAIL, SLIDER, APPROACH, ELEMENT, SLIDER_ELEMENT = 0.1, 0.04, 1e-4, 0.01, 0.008
#: Nodes of the rail that the slider passes [m]
NODES = (0.03, 0.04, 0.05, 0.06, 0.07)
#: Positions where the deck is compared [m]
POSITIONS = (0.025, 0.030, 0.040, 0.050, 0.060, 0.070, 0.075)
#: Increments of the fine drag, in each direction; with 199 none ends at a node, which is a kink of a linear axis
FINE = {"HERMITE": 200, "LINEAR": 199}
ONE, TEN = "1., 1.", "0.1, 1., 0.05, 0.1"
#: Contacts too soft: penalty [N/m], push [m], increments, clearance [m], motion aside [m]
PASSING = {
    "one": (1e3, 8e-3, ONE),
    "ten": (1e3, 8e-3, TEN),
    "far": (1e1, 60e-3, ONE, 30e-3),
    "aside": (1e1, 40e-3, ONE, 10e-3, 30e-3),
}
#: Stiff contacts: push [m], clearance [m], motion aside [m]
HELD = {"deep": (20e-3,), "far": (30e-3,), "from_afar": (50e-3, 20e-3), "aside": (10e-3, 5e-3, 30e-3)}
HELD_ELEMENTS = 40


def unit_approach():
    """Approach of the axes under 1 N."""
    modulus = hertz.effective_modulus((COPPER.young,) * 2, (COPPER.poisson,) * 2)
    radius = (COPPER.radius,) * 2
    return hertz.crossed_wires(1, math.pi / 2, radius=radius, modulus=modulus, resistivity=(1, 1)).approach


def unseen(position):
    """Deflection by a unit force that the rail's mesh misses."""
    xi = 2 * (position / ELEMENT - np.floor(position / ELEMENT)) - 1
    return ELEMENT**3 * (1 - xi**2) ** 3 / (192 * COPPER.ei)


def rail_compliance(at, load_at):
    """Deflection of the rail at `at` by a unit force at `load_at`."""
    return crossed_wires.deflection("clamped", RAIL, at, load_at, ei=COPPER.ei)


def slope(position):
    """Slope of the rail at a unit force there."""
    near = 1e-4 * ELEMENT
    return (rail_compliance(position + near, position) - rail_compliance(position - near, position)) / (2 * near)


def equilibrium(rail, slider, approach):
    """Force and stored energy for the compliances of rail and slider."""
    unit = unit_approach()
    force = crossed_wires.force(approach, rail + slider, lambda f: unit * f ** (2 / 3))
    return force, force**2 * (rail + slider) / 2 + 0.4 * unit * force ** (5 / 3)


def exact(position):
    """Force and stored energy at a position, for small slopes."""
    slider = crossed_wires.deflection("clamped", SLIDER, SLIDER / 2, SLIDER / 2, ei=COPPER.ei)
    return equilibrium(rail_compliance(position, position), slider, APPROACH)


def in_the_mesh(position):
    """The same with the tilt of the rail, less what the meshes of rail and slider do not see."""
    slider = crossed_wires.deflection("clamped", SLIDER, SLIDER / 2, SLIDER / 2, ei=COPPER.ei)
    slider -= SLIDER_ELEMENT**3 / (192 * COPPER.ei)
    force, _ = exact(position)
    for _ in range(4):
        tilt = force * slope(position)
        place = position - 2 * COPPER.radius * tilt
        rail = rail_compliance(place, place) - unseen(place)
        force, energy = equilibrium(rail, slider, APPROACH - COPPER.radius * tilt**2)
    return force, energy


def chord_jump(node):
    """Jump of the drag at a node of the rail where axes are interpolated linearly.

    The slider is then touched on the chord of its middle element, and half of the force goes to each node of it.
    """
    ends = SLIDER / 2 + np.array([-SLIDER_ELEMENT, SLIDER_ELEMENT]) / 2
    slider = sum(crossed_wires.deflection("clamped", SLIDER, ends[0], end, ei=COPPER.ei) for end in ends) / 2
    force, _ = equilibrium(rail_compliance(node, node), slider, APPROACH)
    before, here, after = (force * rail_compliance(node + d, node) for d in (-ELEMENT, 0.0, ELEMENT))
    return force * (2 * here - before - after) / ELEMENT


def at_positions(results):
    """Contact force and contact resistance where the slider stands at `POSITIONS`."""
    place = 0.025 + results.history["U1 mean MOVING"]
    pressed = results.times >= 1
    contacts = [results.contacts_at(int(np.argmin(np.where(pressed, np.abs(place - p), np.inf)))) for p in POSITIONS]
    return [float(c["force"][0]) for c in contacts], [float(c["resistance"][0]) for c in contacts]


def there_and_back(text, axis):
    """The deck of the positions with fine increments, and a third step that drags back."""
    n = FINE[axis]
    drags = (
        f"*STEP, NAME={name}, INC={n}\n*STATIC, DIRECT\n {1 / n:.17g}, 1.\n*BOUNDARY\n MOVING, 1, 1, {to}\n*END STEP\n"
        for name, to in (("DRAG", "50.e-3"), ("BACK", "0."))
    )
    return text[: text.index("*STEP, NAME=DRAG")].replace("AXIS=HERMITE", f"AXIS={axis}") + "".join(drags)


def crossing(penalty, push, static, clearance=0.0, aside=0.0):
    """Two clamped wires; the supports of the upper one go down by `push` and aside by `aside`.

    static: data line of *STATIC.
    """
    nodes = np.linspace(0.0, 0.1, 12)
    deck = Crossing(nodes, nodes, (0.05, 0.05), clearance=clearance).deck(
        interaction(("LOWER", "UPPER"), penalty=penalty),
        [push],
        "Model   the supports of the upper wire go far below those of the lower one",
    )
    return moved_aside(deck, static, aside)


def moved_aside(deck, static, aside):
    """The deck with other increments, `static`, and a motion aside of the upper supports."""
    deck = deck.replace("*STATIC, DIRECT\n 1, 1.", f"*STATIC\n {static}")
    return deck.replace("*BOUNDARY\n MOVING, 3", f"*BOUNDARY\n MOVING, 1, 1, {aside}\n MOVING, 3")


def passing(workspace):
    """Exit codes where a contact far too soft would let the wires through; 0: the run ended as if all was well."""
    codes = []
    for name, arguments in PASSING.items():
        try:
            workspace.run(f"pass_{name}", crossing(*arguments))
            codes.append(0)
        except litz.LitzError as error:
            said_so = any(words in str(error) for words in ("would pass through each other", "5 % are allowed"))
            codes.append(error.exit_code if said_so else -error.exit_code)
    return codes


def held(push, clearance=0.0, aside=0.0):
    """Two wires whose supports pass each other in one increment; in the end they cross at their middles.

    The ends are clamped and may slide along the wire, the middles may not: each half is bent alike, and nothing stretches
    the wires.
    """
    nodes = np.linspace(0.0, RAIL, HELD_ELEMENTS + 1)
    middles = [first + HELD_ELEMENTS // 2 for first in (1001, 2001)]
    wires = Crossing(nodes, nodes, (RAIL / 2 - aside, RAIL / 2), "sliding", clearance=clearance)
    return moved_aside(
        wires.deck(
            interaction(("LOWER", "UPPER")) + f"\n*BOUNDARY\n {middles[0]}, 1\n {middles[1]}, 2",
            [push],
            "Model   copper, radius 1 mm, length 100 mm; the supports of the upper wire go far below those of the lower one",
            "Source  each quarter of a wire is a cantilever of large deflection",
        ),
        ONE,
        aside,
    )


def one_increment(workspace):
    """Forces of stiff contacts after a large motion in one increment."""
    return [float(workspace.run(name, held(*HELD[name])).contacts_at(-1)["force"].sum()) for name in HELD]


def drag_jumps(position, drag):
    """Jump of the drag at each node, from straight lines through two points before it and two beyond it."""
    jumps = []
    for node in NODES:
        before, beyond = np.flatnonzero(position < node - 1e-9)[-2:], np.flatnonzero(position > node + 1e-9)[:2]
        sides = [np.polyval(np.polyfit(position[pair], drag[pair], 1), node) for pair in (before, beyond)]
        jumps.append(float(sides[1] - sides[0]))
    return jumps


def measure(workspace):
    text = (INPUTS / "03_large_sliding.inp").read_text(encoding="utf-8")
    force, resistance = at_positions(workspace.run("03_large_sliding", text))
    values = {
        "sliding_contact.force": force,
        "sliding_contact.resistance": resistance,
        "sliding_contact.passing": passing(workspace),
        "sliding_contact.one_increment": one_increment(workspace),
    }
    if workspace.quick:
        return values | {"figure": {}}
    runs = {axis: workspace.run(f"there_and_back_{axis}", there_and_back(text, axis)) for axis in FINE}
    way = {axis: np.flatnonzero(run.steps == 2) for axis, run in runs.items()}
    positions = {axis: 0.025 + run.history["U1 mean MOVING"][way[axis]] for axis, run in runs.items()}
    drags = {axis: run.history["RF1 sum MOVING"][way[axis]] for axis, run in runs.items()}
    contacts, position = runs["HERMITE"].contacts, positions["HERMITE"]
    there, back = (contacts["force"][contacts["step"] == number] for number in (2, 3))
    mesh = np.array([in_the_mesh(p) for p in position])
    values["sliding_contact.mesh"] = float(np.abs(there / mesh[:, 0] - 1).max())
    values["sliding_contact.identities"] = len(np.unique(contacts["id"]))
    # the work of the supports along the rail, Simpson's rule over pairs of increments of the way there
    work = np.concatenate([[0.0], np.cumsum(simpson(drags["HERMITE"], position))])
    stored = mesh[::2, 1]
    values["sliding_contact.work"] = float(np.abs(work - (stored - stored[0])[: len(work)]).max() / np.ptp(stored))
    # the way back ends where the way there began
    values["sliding_contact.reversal"] = float(np.abs(back[:-1][::-1] / mesh[:-1, 0] - 1).max())
    jumps = {axis: drag_jumps(positions[axis], drag) for axis, drag in drags.items()}
    values["sliding_contact.hermite"] = [
        float(jump / chord_jump(node)) for jump, node in zip(jumps["HERMITE"], NODES, strict=True)
    ]
    values["sliding_contact.linear"] = jumps["LINEAR"]
    figure = {"position": position, "positions": positions, "force": there, "mesh": mesh}
    return values | {"figure": figure | drags}


def simpson(values, places):
    """Integrals over pairs of equal intervals."""
    step = np.diff(places)[0]
    return step / 3 * (values[0:-2:2] + 4 * values[1:-1:2] + values[2::2])


def draw(values, path):
    figure = values["figure"]
    if not figure:
        return
    with figures.panels(path, columns=3) as (force, error, drag):
        place = 1e3 * figure["position"]
        truth = np.array([exact(p) for p in figure["position"]])
        force.plot(place, truth[:, 0], label="closed form", **figures.REFERENCE)
        force.plot(1e3 * np.array(POSITIONS), values["sliding_contact.force"], "o", color="#c4451c", label="litz")
        force.set(xlabel="position [mm]", ylabel="contact force [N]")
        force.legend()
        error.plot(place, figure["force"] / truth[:, 0] - 1, color="#c4451c", label="litz, every 0.25 mm")
        error.plot(
            place, figure["mesh"][:, 0] / truth[:, 0] - 1, "--", label="known of mesh and tilt", **figures.REFERENCE
        )
        error.set(xlabel="position [mm]", ylabel="relative error of the force", ylim=(0, 0.0045))
        error.legend()
        drag.plot(
            1e3 * figure["positions"]["LINEAR"],
            figure["LINEAR"],
            color="#0b62a4",
            linewidth=0.8,
            label="litz, linear axis",
        )
        drag.plot(place, figure["HERMITE"], color="#c4451c", label="litz, Hermite axis")
        drag.plot(
            place, np.gradient(truth[:, 1], figure["position"]), "--", label="slope of the energy", **figures.REFERENCE
        )
        drag.set(xlabel="position [mm]", ylabel="force along the rail [N]")
        drag.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["sliding_contact"]))

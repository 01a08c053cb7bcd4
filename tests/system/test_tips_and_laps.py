"""Tips that lean on another wire, and short laps, as they are pressed: against half-spaces and their own work."""

import numpy as np
import pytest
from verification.references.end_in_half_space import force_of_lap, force_of_tip, stiffness_of_two_ends

from line_wires import COPPER, HERTZ, spot, two_wires
from test_contact_at_ends import HELD, VOLT, from_tip, moved, solved

RADIUS = COPPER.radius
MODULUS = COPPER.young / (1 - COPPER.poisson**2) / 2
ALONG = np.linspace((-12 * RADIUS, 0, 0), (12 * RADIUS, 0, 0), 25)


def pressed(run, lower, upper, overlap, increments):
    """Overlaps over the radius, forces over E* r^2, and what is in no energy over what contacts hold."""
    deck = two_wires(lower, upper, HELD, moved(0, 0, -overlap * RADIUS, increments=increments))
    results = solved(run(deck.replace("*END STEP", "*ENERGY PRINT\n*END STEP")))
    forces = [results.contacts_at(i)["force"].sum() for i in range(1, len(results.times))]
    history = results.history
    return (
        overlap * np.asarray(results.times[1:]),
        np.array(forces) / (MODULUS * RADIUS**2),
        history["ETOTAL"][1:] / history["ALLCCE"][1:],
    )


@pytest.mark.parametrize(
    ("slope", "overlap", "is_short"), [(0.1, 0.02, True), (0.03, 0.02, False), (0.015, 0.015, False)]
)
def test_a_tip_has_the_force_of_solid_wires_and_holds_its_work(run, slope, overlap, is_short):
    """Its overlap is 0.2 to 1 radius long at last, where places along the line come to carry the most of it; one of up to
    0.2 radii is that of half-spaces."""
    upper = from_tip((0.1 * RADIUS, 0, 2 * RADIUS), (1, 0, slope), n=12)
    overlaps, forces, lost = pressed(run, ALONG, upper, overlap, 60)
    for i in (20, 40, 59):
        solid = 0 if is_short else overlaps[i]
        exact = force_of_tip(slope / overlaps[i] ** 0.5, cells=80, overlap=solid) * overlaps[i] ** 1.5
        assert forces[i] == pytest.approx(exact, rel=0.07)
    # mean forces of the first increments are those of a straight line
    assert np.abs(lost[20:]).max() < 0.025


@pytest.mark.parametrize("slope", [5e-3, 1e-3, 3e-4])
def test_a_lightly_pressed_tip_has_the_force_of_half_spaces(run, slope):
    """At an overlap of 0.01 % of the radius, along 0.02 to 0.3 radii: neither how long an overlap may be at most nor where
    the other wire ends matters."""
    upper = from_tip((0.1 * RADIUS, 0, 2 * RADIUS), (1, 0, slope), n=12)
    overlaps, forces, _ = pressed(run, ALONG, upper, 1e-4, 2)
    exact = force_of_tip(slope / overlaps[-1] ** 0.5, cells=80) * overlaps[-1] ** 1.5
    assert forces[-1] == pytest.approx(exact, rel=0.06)


@pytest.mark.parametrize("slope", [0.1, 0.03])
def test_a_tip_has_its_force_on_any_mesh(run, slope):
    """With elements of a radius and of a twelfth on both wires: the spot of a round end is none of a line."""
    forces = []
    for per_radius in (1, 12):
        lower = np.linspace((-2 * RADIUS, 0, 0), (4 * RADIUS, 0, 0), 6 * per_radius + 1)
        upper = from_tip((0.1 * RADIUS, 0, 2 * RADIUS), (1, 0, slope), n=3 * per_radius, length=3 * RADIUS)
        forces.append(pressed(run, lower, upper, 0.01, 2)[1][-1])
    assert forces[1] == pytest.approx(forces[0], rel=1e-3)


def test_a_wire_bent_over_a_lap_is_pressed_with_rising_force(run):
    """Its ends touch first, and what lies between them closes at an overlap of 1.2 % of the radius."""
    bend, half = 0.024 / RADIUS, RADIUS
    x = np.arange(-half, 8.1 * RADIUS, RADIUS / 2)
    upper = np.column_stack([x, 0 * x, 2 * RADIUS + bend / 2 * (half**2 - x**2)])
    lower = np.linspace((-11 * RADIUS, 0, 0), (half, 0, 0), 25)
    overlaps, forces, _ = pressed(run, lower, upper, 0.024, 48)
    assert np.diff(forces).min() > 0
    # ends alone on a half-space, all of the lap on solid wires
    for i, solid in ((15, 0.0), (30, overlaps[30])):
        exact = force_of_lap(2 / overlaps[i] ** 0.5, 0.024, cells=80, overlap=solid) * overlaps[i] ** 1.5
        assert forces[i] == pytest.approx(exact, rel=0.08)


FROM_TIP = from_tip((0.1 * RADIUS, 0, 2 * RADIUS), (1, 0, 0.03), n=12)
TO_END = np.linspace((-12 * RADIUS, 0, 0), (0, 0, 0), 13)
ENDS = {
    "tip": (ALONG, FROM_TIP),
    "tip beside a line": (ALONG, from_tip((0.1 * RADIUS, 0, 2 * RADIUS), (1, 0, 0.01), n=12)),
    "lap of a tenth of a radius": (TO_END, TO_END * [-1, 1, 1] + [-0.1 * RADIUS, 0, 2 * RADIUS]),
    "lap of a radius": (TO_END, TO_END * [-1, 1, 1] + [-RADIUS, 0, 2 * RADIUS]),
    "crossing": (
        TO_END + np.array([0.06 * RADIUS, 0, 0]),
        from_tip((-0.04 * RADIUS, -0.04 * RADIUS, 2 * RADIUS), (1, 1, 0)),
    ),
}


def conductances(run, wires, law, name):
    """Pressed, released and pressed again, in six increments each [S]."""
    steps = [
        moved(0, 0, -overlap * RADIUS, increments=6).replace("*END STEP", f"{VOLT}*END STEP")
        for overlap in (0.01, 0.0005, 0.01)
    ]
    results = solved(run(two_wires(*wires, HELD, *steps, law=HERTZ + spot(law)), name=name))
    return np.array([(1 / results.contacts_at(i)["resistance"]).sum() for i in range(1, 19)])


@pytest.mark.parametrize(("spot_law", "data"), [("HERTZ", ""), ("PLASTIC", "\n 1e9")])
@pytest.mark.parametrize("case", ENDS)
def test_next_to_an_end_a_spot_that_stays_has_the_shape_of_its_largest_force(run, case, spot_law, data):
    """A smaller overlap is cut less; where the wires touch along a line the spot stays where they still do."""
    kept = conductances(run, ENDS[case], f"{spot_law}, SPOT=LARGEST FORCE{data}", "kept")
    made, released = kept[5], kept[6:12]
    # places along the line have the conductance of the end to 1 %, and leave the contact to it as it becomes shorter
    assert np.diff([made, *released]).max() < 1e-2 * made
    if case == "tip beside a line":
        present = conductances(run, ENDS[case], spot_law + data, "present")
        assert (released > present[6:12]).all()
        assert (np.diff(released) < 0).all()
    else:
        assert released.min() > 0.995 * made
    assert kept[-1] == pytest.approx(made, rel=1e-6)


@pytest.mark.parametrize("law", ["HERTZ", "FILM"])
@pytest.mark.parametrize(("degrees", "before"), [(10, (0.5, 0.4)), (12, (0.3, 0.3)), (16, (0.5, 0.4))])
def test_between_two_ends_a_kept_spot_is_made_as_any_other_and_falls_without_a_step(run, degrees, before, law):
    """Before the ends of both wires the force of the crossing falls as they are pressed on, and places take over. The spot
    is made of the deepest overlap all the same, and is never less than the present one."""
    angle = np.radians(degrees)
    lower = np.linspace((-12 * RADIUS, 0, 0), (before[0] * RADIUS, 0, 0), 25)
    upper = np.array([0, 0, 2 * RADIUS]) + np.outer(
        np.linspace(-before[1], 11.9, 25) * RADIUS, [np.cos(angle), np.sin(angle), 0]
    )
    steps = [
        moved(0, 0, -overlap * RADIUS, increments=20).replace("*END STEP", f"{VOLT}*END STEP")
        for overlap in (0.012, 0.0006)
    ]

    def conductance(memory, name):
        film = "\n1e-12" if law == "FILM" else ""
        deck = two_wires(lower, upper, HELD, *steps, law=HERTZ + spot(law + memory + film))
        results = solved(run(deck, name=name))
        return np.array([(1 / results.contacts_at(i)["resistance"]).sum() for i in range(1, 41)])

    present, kept = conductance("", "present"), conductance(", SPOT=LARGEST FORCE", "kept")
    assert np.all(np.diff(present[:20]) > 0)
    assert kept[:20] == pytest.approx(present[:20], rel=1e-9)
    assert np.all(kept[20:] > (1 - 1e-9) * present[20:])
    assert np.all(np.diff(kept[19:]) < 0)


@pytest.mark.parametrize(("degrees", "before"), [(45, 0.1), (30, 0.1), (22, 0.1), (30, 0.3)])
def test_a_crossing_before_two_ends_conducts_as_it_gives_way(run, degrees, before):
    """Where the ends cut a spot, they leave less of its conductance than of its force: that of a half-space."""
    angle = np.radians(degrees)
    lower = np.linspace((-12 * RADIUS, 0, 0), (before * RADIUS, 0, 0), 25)
    upper = np.array([0, 0, 2 * RADIUS]) + np.outer(
        np.linspace(-before, 11.9, 25) * RADIUS, [np.cos(angle), np.sin(angle), 0]
    )
    step = moved(0, 0, -0.01 * RADIUS).replace("*END STEP", f"{VOLT}*END STEP")
    contacts = solved(run(two_wires(lower, upper, HELD, step, law=HERTZ + spot("HERTZ")))).contacts_at(-1)
    length = RADIUS * 0.01**0.5
    exact = stiffness_of_two_ends(degrees, before * RADIUS / length) * length / COPPER.resistivity
    assert (1 / contacts["resistance"]).sum() == pytest.approx(exact, rel=0.03)


def test_the_force_on_a_crossing_passes_to_places_within_one_increment(run):
    """0.3 radii before the ends of both wires, where places along the wires begin to carry their part at once."""
    angle = np.radians(20)
    lower = np.linspace((-12 * RADIUS, 0, 0), (0.3 * RADIUS, 0, 0), 25)
    upper = np.array([0, 0, 2 * RADIUS]) + np.outer(
        np.linspace(-0.3, 11.9, 25) * RADIUS, [np.cos(angle), np.sin(angle), 0]
    )
    _, forces, _ = pressed(run, lower, upper, 0.012, 40)
    assert np.abs(np.diff(forces, 2)[5:]).max() < 0.005 * forces[-1]


def test_a_short_lap_that_slides_does_the_work_that_it_holds(run):
    """From a lap of three radii to one of a radius: length, and far field, which the sections bound less and less."""
    lower = np.linspace((-12 * RADIUS, 0, 0), (0, 0, 0), 25)
    upper = np.linspace((-4 * RADIUS, 0, 2 * RADIUS), (8 * RADIUS, 0, 2 * RADIUS), 25)
    down = -0.01 * RADIUS
    steps = [moved(0, 0, down), moved(3 * RADIUS, 0, down, increments=60)]
    results = solved(run(two_wires(lower, upper, HELD, *steps).replace("*END STEP", "*ENERGY PRINT\n*END STEP")))
    energy, held = results.history["ETOTAL"], results.history["ALLCCE"]
    assert held[-1] < 0.3 * held[1]
    assert np.abs(energy[2:] - energy[1]).max() < 0.005 * held[1]

"""Wires that yield where they touch at ends and kinks: the law of the ellipse that has the force of all shapes there."""

import math

import numpy as np
import pytest

import litz
from line_wires import COPPER, STEEL, PressedWire, spot, two_wires
from litz import build
from test_contact_at_ends import ALONG_X, HELD, VOLT, carried_over, from_tip, moved

YIELD = 200e6
BEHAVIOR = f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD={YIELD}\n"


def solved(outcome):
    process, results = outcome
    assert process.returncode == 0, process.stderr
    return results


def sphere_on_cylinder(overlap, largest_force=0.0, *, ends=STEEL, other=COPPER):
    """The kernel's law of crossed wires with the curvatures of a round end on a cylinder: `1/r` and `1/r + 1/rb`, those of
    wires at right angles of the radii `r` and `r rb/(r + rb)`."""
    return litz.kernels.normal_law(
        overlap, radius=[ends.radius, ends.radius * other.radius / (ends.radius + other.radius)],
        young=[ends.young, other.young], poisson=[ends.poisson, other.poisson], angle=math.pi / 2,
        yield_stress=YIELD, largest_force=largest_force,
    )  # fmt: skip


@pytest.mark.parametrize("pair", ["LOWER, UPPER", "UPPER, LOWER"])
@pytest.mark.parametrize("degrees", [90, 60])
def test_the_end_of_a_wire_is_a_sphere_with_its_dent(run, degrees, pair):
    """Pressed, let go by a part, pressed again to less and to more: the first load on the metal, and the dent of then."""
    lean = np.radians(degrees)
    tip = from_tip((0.0003, 0, STEEL.radius + COPPER.radius), (np.cos(lean), 0.3, np.sin(lean) * 1.2))
    overlaps = [1e-6, 0.98e-6, 0.99e-6, 1.5e-6]
    steps = [moved(0, 0, -z).replace("*END STEP\n", VOLT + "*END STEP\n") for z in overlaps]
    deck = two_wires(
        ALONG_X, tip, HELD, *steps, wires=(COPPER, STEEL), pairs=(pair,), law=BEHAVIOR + spot("HERTZ"),
    )  # fmt: skip
    contacts = solved(run(deck)).contacts
    largest = 0.0
    for step, overlap in enumerate(overlaps, 1):
        last = np.flatnonzero(contacts["step"] == step)[-1]
        exact = sphere_on_cylinder(overlap, largest)
        assert contacts["force"][last] == pytest.approx(float(exact.force), rel=1e-6)
        largest = max(largest, float(exact.force))
        assert contacts["largest_force"][last] == pytest.approx(largest, rel=1e-6)
    # more of the overlap stays than comes back
    assert contacts["dent"][last] > 0.6 * overlaps[-1]


def test_wires_side_by_side_beside_an_end_are_pressed_without_a_step(run):
    """At 10 degrees, 1.3 radii before the end of one: places along the wires carry all, where the crossing loses its
    last share."""
    angle, radius, hard = np.radians(10), COPPER.radius, PressedWire(COPPER.radius, 210e9, 0.3, 1.4e-7)
    lower = np.linspace((-12 * radius, 0, 0), (1.3057668 * radius, 0, 0), 20)
    upper = np.array([0, 0, 2 * radius]) + np.outer(
        np.linspace(-10.3, 10.9, 31) * radius, [np.cos(angle), -np.sin(angle), 0]
    )
    steps = [moved(0, 0, -z * radius, increments=n) for z, n in ((0.014, 12), (0.015, 48))]
    law = BEHAVIOR.replace(str(YIELD), "3e8")
    results = solved(run(two_wires(lower, upper, HELD, *steps, wires=(hard, COPPER), law=law)))
    forces = np.array([results.contacts_at(i)["force"].sum() for i in range(12, 61)])
    assert np.diff(forces).min() > 0
    assert np.abs(np.diff(forces, 2)).max() < 1e-3 * forces[-1]


def test_the_energy_of_a_pressed_end_closes(run):
    tip = from_tip((0, 0, 2 * COPPER.radius), (0.3, 0.3, 1))
    steps = [moved(0, 0, -z, increments=20) for z in (1e-6, 0.9e-6, -1e-6, 1.5e-6)]
    deck = two_wires(ALONG_X, tip, HELD, *steps, law=BEHAVIOR).replace("*END STEP", "*ENERGY PRINT\n*END STEP")
    history = solved(run(deck)).history
    assert history["ALLPD"][-1] > 0
    assert np.abs(history["ETOTAL"]).max() < 5e-3 * history["ALLPD"][-1]


@pytest.mark.parametrize("degrees", [90, 30, 10])
def test_a_crossing_slides_off_the_end_of_a_wire_without_a_jump(run, degrees):
    """The force falls from that of crossed wires to zero, as the wire slides out of its dent and off the end."""
    angle, overlap = np.radians(degrees), 1e-6
    distance = 2 * COPPER.radius
    reach = math.sqrt(2 * distance * overlap) / math.sin(angle)
    lower = np.linspace((-0.02, 0, 0), (0, 0, 0), 9)
    upper = np.array([-2 * reach, 0, distance - overlap]) + np.outer(
        np.linspace(-0.0151, 0.0149, 13), [np.cos(angle), np.sin(angle), 0]
    )
    deck = two_wires(lower, upper, HELD, moved(4 * reach, increments=80), law=BEHAVIOR)
    results = solved(run(deck))
    force = np.array([results.contacts_at(i)["force"].sum() for i in range(1, len(results.times))])
    assert np.all(force[61:] == 0)
    assert np.max(-np.diff(force)) < 0.1 * force[0]
    assert np.max(np.diff(force)) < 0.02 * force[0]


@pytest.mark.parametrize("degrees", [90, 30])
def test_a_rod_slides_over_a_kink(run, degrees):
    """No contact is lost as its dent stays behind, and both legs are alike."""
    deck = carried_over(degrees, BEHAVIOR, 100)
    results = solved(run(deck))
    force = np.array([results.contacts_at(i)["force"].sum() for i in range(1, len(results.times))])
    assert len(force) == 100
    assert np.all(force > 0)
    assert np.max(np.abs(np.diff(force))) < 0.08 * force[0]
    assert force[:-1] == pytest.approx(force[-2::-1], rel=5e-3)


@pytest.mark.slow
def test_a_strand_of_wires_that_just_touch_yields_and_conducts(tmp_path):
    """Places whose wires touch to round-off as the strand begins to be pulled, and wires that end side by side."""
    touch = litz.Interaction(behaviour=litz.Hertz(yield_stress=YIELD), conductance=litz.HertzSpot())
    strand = build.strand([1, 3], radius=0.5e-3, lay_length=40e-3, length=10e-3, interaction=touch)
    pull = strand.step("PULL", increment=0.5)
    pull.potential(strand.groups["CORE"].start, 1e-3)
    pull.potential(strand.groups["LAYER1"].end, 0.0)
    for group in strand.groups.values():
        pull.move(group.end, "z", 2e-5)
    results = strand.run(tmp_path / "strand")
    contacts = results.contacts_at(-1)
    assert contacts["current"].sum() != 0
    assert np.isfinite(contacts["current"]).all()


def test_a_crossing_that_places_take_over_beside_an_end_is_followed(run):
    """As the places take over, the force of the last iteration is more than the part that is left could have at any
    overlap: the law has its largest force there, which is a number."""
    angle, radius = np.radians(10), COPPER.radius
    lower = np.linspace((-12 * radius, 0, 0), (1.3057666 * radius, 0, 0), 20)
    upper = np.array([0, 0, 2 * radius]) + np.outer(
        np.linspace(-10.3, 10.9, 31) * radius, [np.cos(angle), -np.sin(angle), 0]
    )
    press = moved(0, 0, -0.015 * radius, increments=24)
    thick = PressedWire(COPPER.radius, 210e9, 0.3, STEEL.resistivity)
    law = BEHAVIOR.replace("200000000.0", "300e6")
    results = solved(run(two_wires(lower, upper, HELD, press, wires=(thick, COPPER), law=law)))
    force = np.array([results.contacts_at(i)["force"].sum() for i in range(1, len(results.times))])
    assert np.all(np.diff(force) > 0)

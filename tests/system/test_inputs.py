"""The decks in inputs/ give the values that their headers state, and those are what the closed forms give."""

import importlib.util
import itertools
import math
import re

import numpy as np
import pytest
from verification.cases import yielded_wires
from verification.cases.twisted_pair import approach_of
from verification.references.capstan import capstan
from verification.references.helical_rods import Rod, Strand
from verification.references.hertz import effective_modulus, end_on_wire
from verification.references.line_joints import LineJoint
from verification.references.parallel_wires import ParallelWires, PressedWire

from litz import closed_forms as cf
from litz import kernels
from litz.results.summary import summary
from networks import Network, points_of_mat
from results_at import at

COPPER = {"radius": 1e-3, "young": 120e9, "poisson": 0.34, "resistivity": 1.7e-8}
COPPER_WIRE = cf.Wire(radius=1e-3, length=0.1, young=120e9, poisson=0.34, resistivity=1.7e-8)

DECKS = [
    "01_crossed_wires",
    "02_oblique_crossing",
    "03_large_sliding",
    "04_wire_grid",
    "05_clamped_pair",
    "06_supported_pair",
    "07_roll_up",
    "08_elastica",
    "09_paper_law",
    "10_pushed_cantilever",
    "11_fibre_mat",
    "12_woven_fabric",
    "13_stick_slip",
    "14_strand",
    "15_lap_joint",
    "16_bent_strand",
    "17_knot",
    "18_rod_over_drum",
    "19_fuse",
    "20_hot_spot",
    "21_heated_mat",
    "22_wiper",
    "23_dented_wires",
    "24_compacted_cable",
    "25_cable_of_45_strands",
]
#: Their jackets carry forces, too; they run for one and for seven minutes
PRESSED_CABLE, CABLE_OF_45 = "24_compacted_cable", "25_cable_of_45_strands"
#: Those that run for ten seconds
LONG = {"11_fibre_mat", "16_bent_strand", "18_rod_over_drum"}
THIN_COPPER = {"radius": 0.1e-3, "young": 120e9, "poisson": 0.34, "resistivity": 1 / 58.8e6}

#: Numbers with a point, as generators write them; names and counts stay text
NUMBER = r"(-?\d+\.\d*(?:[eE][-+]?\d+)?|-?\d+[eE][-+]?\d+)"


def only_contact(results, increment):
    """The values of the only contact at an increment."""
    ledger = results.contacts_at(increment)
    assert ledger.n_rows == 1
    return {name: ledger[name][0] for name in ledger}


def compliance(wire, support, position, element_length=0.0, element_position=0.5):
    """Deflection by a unit force of a beam of cubic elements.

    Nodal values of cubic elements are exact; inside an element that holds the force they miss the deflection of a beam
    clamped at the element's ends. Without `element_length` the force stands at a node.
    """
    exact = cf.beam_compliance(wire.bending_stiffness, wire.length, support, position)
    if not element_length:
        return exact
    return exact - cf.beam_compliance(wire.bending_stiffness, element_length, "clamped", element_position)


def curvature_seen(wire, support, position, element_length):
    """Curvature by a unit force where it acts, towards it, in the middle of an element: as contacts see it.

    There a cubic does not have the part F h/4 of the moment, and at its ends the mean is taken with the next element.
    """
    at_force = cf.beam_curvature(wire.bending_stiffness, wire.length, support, position)
    return at_force - 3 / 16 * element_length / wire.bending_stiffness


def test_every_deck_has_a_header_that_says_what_and_whence(inputs):
    decks = sorted(inputs.glob("*.inp"))
    assert [deck.stem for deck in decks] == DECKS
    for deck in decks:
        text = deck.read_text(encoding="utf-8")
        assert text.startswith("*HEADING\n"), deck.name
        for part in ("** Model ", "** Source ", "** Expect "):
            assert part in text, f"{deck.name}: {part}"


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.slow) if name in LONG else name
        for name in DECKS
        if name not in (PRESSED_CABLE, CABLE_OF_45)
    ],
)
def test_every_run_balances_forces_currents_and_power(results_of, name):
    results = results_of(name)
    assert results.finished
    forces = results.field("reaction_force", None) + results.field("applied_force", None)
    moments = results.field("reaction_moment", None) + results.field("applied_moment", None)
    largest = max(np.abs(forces).max(), np.abs(moments).max() / np.ptp(results.nodes))
    # the iteration stops at 1e-8 of the forces at each node; the thread of the last deck, whose E A is 5e8 times the
    # forces in it, at round-off: 2e-16*5e8 for each element
    assert np.abs(forces.sum(axis=1)).max() <= 1e-6 * largest
    currents = results.field("reaction_current", None) + results.field("applied_current", None)
    power = (results.field("potential", None) * currents).sum(axis=1)
    heat = results.field("joule_heat", None).sum(axis=1)
    heat += [results.contacts_at(increment)["joule_heat"].sum() for increment in range(len(heat))]
    # voltages come from a linear solve, to round-off; from the iteration, to 1e-8, with the monolithic step, and where
    # currents, heat and motions act on each other
    from_iteration = "COUPLING=MONOLITHIC" in results.deck or "*COUPLED TEMPERATURE-DISPLACEMENT" in results.deck
    tolerance = 1e-8 if from_iteration else 1e-12
    assert np.abs(currents.sum(axis=1)).max() <= tolerance * np.abs(currents).max()
    assert np.abs(power - heat).max() <= tolerance * power.max()


def test_crossed_wires_follow_hertz_and_holm_through_a_load_cycle(results_of, header):
    results = results_of("01_crossed_wires")
    history = results.history
    arm = COPPER_WIRE.resistance(0.5)
    c = compliance(COPPER_WIRE, "clamped", 0.5, element_length=0.01)
    bend = curvature_seen(COPPER_WIRE, "clamped", 0.5, 0.01)
    for time, approach in [(0.5, 0.045e-3), (1.0, 0.1e-3), (1.5, 0.045e-3), (3.0, 0.1e-3)]:
        increment = at(results, time)
        contact = only_contact(results, increment)
        force = cf.crossed_beams(approach, (c, c), curvatures=(bend, bend), **COPPER)
        spot = cf.hertz_contact(force, curvature=-force * bend, **COPPER)
        # wires that bend by 0.05 mm over 100 mm are linear to (0.05/50)^2 = 1e-6
        assert contact["force"] == pytest.approx(force, rel=1e-5)
        assert contact["resistance"] == pytest.approx(spot.resistance, rel=1e-5)
        assert history["resistance PLUS to MINUS"][increment] == pytest.approx(spot.resistance + 2 * arm, rel=1e-5)
    # the header has the solution for exact beams; the mesh makes the force 0.1 % larger
    for time, force, radius, spot, total, current in header("01_crossed_wires"):
        increment = at(results, time)
        contact = only_contact(results, increment)
        assert contact["force"] == pytest.approx(force, rel=1.5e-3)
        assert contact["semi_major"] * 1e6 == pytest.approx(radius, rel=5e-4)
        assert contact["resistance"] * 1e3 == pytest.approx(spot, rel=5e-4)
        assert history["resistance PLUS to MINUS"][increment] * 1e3 == pytest.approx(total, rel=5e-4)
        assert history["current PLUS to MINUS"][increment] == pytest.approx(current, rel=5e-4)
    # apart, and no current
    assert results.contacts_at(at(results, 2.0)).n_rows == 0
    assert history["resistance PLUS to MINUS"][at(results, 2.0)] == math.inf


def test_resistance_of_crossed_wires_falls_with_the_cube_root_of_the_force(results_of):
    ledger = results_of("01_crossed_wires").contacts
    constant = ledger["resistance"] * ledger["force"] ** (1 / 3)
    # Hertz and Holm, for any force; the wires bend about each other with up to r/R = 1e-4
    assert np.ptp(constant) < 1e-4 * constant.mean()


def test_oblique_wires_of_unequal_radii_and_metals_touch_in_hertz_ellipse(results_of, header):
    results = results_of("02_oblique_crossing")
    thin = cf.Wire(radius=0.5e-3, length=0.06, young=120e9, poisson=0.34, resistivity=1.7e-8)
    thick = cf.Wire(radius=0.8e-3, length=0.08, young=70e9, poisson=0.33, resistivity=2.8e-8)
    wires = {
        "radius": (0.5e-3, 0.8e-3),
        "young": (120e9, 70e9),
        "poisson": (0.34, 0.33),
        "resistivity": (1.7e-8, 2.8e-8),
        "angle": math.radians(40),
    }
    compliances = (
        compliance(thin, "clamped", 0.45, element_length=0.006),
        compliance(thick, "cantilever", 0.45, element_length=0.008),
    )
    bends = curvature_seen(thin, "clamped", 0.45, 0.006), curvature_seen(thick, "cantilever", 0.45, 0.008)
    arms = thin.resistance(0.45) + thick.resistance(0.45)
    for time, approach in [(1.0, 0.1e-3), (2.0, 0.2e-3)]:
        increment = at(results, time)
        contact = only_contact(results, increment)
        force = cf.crossed_beams(approach, compliances, curvatures=bends, **wires)
        spot = cf.hertz_contact(force, curvature=[-force * bend for bend in bends], **wires)
        # slopes of 0.007 of the cantilever and 0.002 of the thin wire change the angle by their products
        assert math.degrees(contact["angle"]) % 180 == pytest.approx(40, abs=3e-3)
        # the cantilever's slope moves its point of contact by 0.0066*1.3 mm/sin(40)^2 = 0.021 mm of 36 mm, to the cube
        # 1.7e-3 of its part in the force at the second level, half of it at the first; the resistance has a third of that
        slope = approach / 0.2e-3
        assert contact["force"] == pytest.approx(force, rel=1.2e-3 * slope)
        assert contact["semi_major"] == pytest.approx(spot.semi_major, rel=4e-4 * slope)
        assert contact["semi_minor"] == pytest.approx(spot.semi_minor, rel=4e-4 * slope)
        assert contact["resistance"] == pytest.approx(spot.resistance, rel=4e-4 * slope)
        # the arms change with the points of contact: 0.021 mm*14 mohm/m + 0.016 mm*22 mohm/m of 1.8 mohm
        assert results.history["resistance PLUS to MINUS"][increment] == pytest.approx(
            spot.resistance + arms, rel=6e-4 * slope
        )
    for row, time in zip(header("02_oblique_crossing"), (1.0, 2.0), strict=True):
        contact = only_contact(results, at(results, time))
        values = contact["force"], contact["semi_major"] * 1e6, contact["semi_minor"] * 1e6, contact["resistance"] * 1e3
        # the mesh adds 4e-4
        assert values == pytest.approx(tuple(row[1:5]), rel=1.6e-3)


def test_a_dragged_wire_keeps_one_contact_and_the_exact_force_over_five_elements(results_of):
    results = results_of("03_large_sliding")
    slider = cf.Wire(radius=1e-3, length=0.04, young=120e9, poisson=0.34, resistivity=1.7e-8)
    slider_compliance = compliance(slider, "clamped", 0.5, element_length=0.008)
    ledger = results.contacts
    assert set(ledger["id"]) == {ledger["id"][0]}, "the contact is handed over from element to element"
    dragged = np.flatnonzero(results.times >= 1.0 - 1e-9)
    assert len(dragged) >= 20
    for increment in dragged:
        x = 0.025 + 0.05 * (results.times[increment] - 1.0)
        within = x / 0.01 % 1.0
        # at a node: the exact beam
        inside = {"element_length": 0.01, "element_position": within} if 1e-6 < within < 1 - 1e-6 else {}
        compliances = compliance(COPPER_WIRE, "clamped", x / 0.1, **inside), slider_compliance
        force = cf.crossed_beams(1e-4, compliances, **COPPER)
        contact = only_contact(results, increment)
        # the rail's slope, at most 0.003, moves the points of contact by 0.003*2 mm of 25 mm: 2e-4, to the square and more
        assert contact["force"] == pytest.approx(force, rel=5e-4)
        total = cf.hertz_contact(force, **COPPER).resistance + COPPER_WIRE.resistance(x / 0.1) + slider.resistance(0.5)
        assert results.history["resistance PLUS to MINUS"][increment] == pytest.approx(total, rel=2e-4)


def test_the_values_of_the_header_hold_along_the_way_of_the_dragged_wire(results_of, header):
    results = results_of("03_large_sliding")
    for position, force, spot, total in header("03_large_sliding"):
        increment = at(results, 1.0 + (position - 25) / 50)
        contact = only_contact(results, increment)
        # at 25 and 75 mm, inside an element, the header allows 0.35 % for the mesh; a third of it for the spot
        assert contact["force"] == pytest.approx(force, rel=4e-3)
        assert contact["resistance"] * 1e3 == pytest.approx(spot, rel=1.4e-3)
        assert results.history["resistance PLUS to MINUS"][increment] * 1e3 == pytest.approx(total, rel=1.4e-3)


def test_a_grid_of_wires_shares_forces_and_current_as_beam_theory_and_kirchhoff_say(results_of, header, inputs):
    results = results_of("04_wire_grid")
    positions = (0.35, 0.45, 0.55, 0.65)
    force = cf.wire_grid(1e-4, positions, COPPER_WIRE)
    assert header("04_wire_grid") == pytest.approx(force, abs=1e-6)
    ledger = results.contacts_at(-1)
    assert ledger.n_rows == 16
    x, y = (np.rint(ledger[f"point_2_{axis}"] * 1e3).astype(int) for axis in "xy")
    found = np.zeros((4, 4))
    found[(y - 35) // 10, (x - 35) // 10] = ledger["force"]
    # slopes of 0.05/35 move the points of contact by 0.0014*2 mm of 35 mm; halved between the two wires
    assert found == pytest.approx(force, rel=2e-4)
    resistance = [[cf.hertz_contact(f, **COPPER).resistance for f in row] for row in force]
    current = cf.grid_network(1e-3, positions, COPPER_WIRE, resistance)
    # a resistance feels a third of it
    assert results.history["current PLUS to MINUS"][-1] == pytest.approx(current, rel=7e-5)
    assert f"total current {current:.6f} A" in (inputs / "04_wire_grid.inp").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "support", "levels"),
    [("05_clamped_pair", "clamped", (1e-5, 5e-5, 1e-4)), ("06_supported_pair", "supported", (1e-5, 1e-4))],
)
def test_crossed_pairs_have_their_exact_electro_mechanical_solution(results_of, header, name, support, levels):
    results = results_of(name)
    rows = header(name)
    assert len(rows) == len(levels)
    for step, (row, u) in enumerate(zip(rows, levels, strict=True), start=1):
        contact = only_contact(results, at(results, step))
        assert row[0] == pytest.approx(u)
        values = [contact[key] for key in ("force", "semi_major", "resistance", "current", "voltage_gap")]
        # linear to (u/2/50 mm)^2 = 1e-6; the header has seven digits, and the curvature is that of 2e-5 more or less force
        assert [values[0], -contact["gap"], *values[1:]] == pytest.approx(list(row[1:]), rel=1e-5)


def test_a_moment_rolls_a_wire_up_to_a_closed_circle(results_of):
    results = results_of("07_roll_up")
    half, full = at(results, 1.0), at(results, 2.0)
    tip = 10
    assert np.linalg.norm(results.field("rotation", half)[tip]) == pytest.approx(math.pi, abs=1e-7)
    # a polygon of ten sides in place of the arc: h/sin(pi/20)
    assert results.field("displacement", half)[tip] == pytest.approx([-1, 0.1 / math.sin(math.pi / 20), 0], abs=1e-7)
    # closed: what is left is the tolerance of the iteration
    assert results.field("displacement", full)[tip] == pytest.approx([-1, 0, 0], abs=1e-7)


def test_a_cantilever_follows_the_elastica(results_of, header):
    results = results_of("08_elastica")
    for step, (load, *expected) in enumerate(header("08_elastica"), start=1):
        assert expected == pytest.approx(list(cf.cantilever_elastica(load)), abs=1e-7)
        increment = at(results, step)
        u = results.field("displacement", increment)[20]
        angle = np.linalg.norm(results.field("rotation", increment)[20])
        # the wire stretches by P/(E A) = 1e-5 at most; twenty cubic elements add less
        assert [u[2] / 0.5, -u[0] / 0.5, angle] == pytest.approx(expected, rel=2e-5)


def test_the_law_of_the_paper_is_replayed(results_of, header):
    results = results_of("09_paper_law")
    c = compliance(COPPER_WIRE, "clamped", 0.5, element_length=0.01)
    # the linear voltage misses rho h/(4 A) in each wire
    arms = 2 * COPPER_WIRE.resistance(0.5) - 2 * COPPER_WIRE.resistance(0.1) / 4
    for row, time, approach in zip(header("09_paper_law"), (1.0, 2.0), (1e-5, 1e-4), strict=True):
        contact = only_contact(results, at(results, time))
        force = cf.crossed_beams(approach, (c, c), penalty=1e8)
        radius, resistance = cf.paper_contact(force, **COPPER)
        assert contact["force"] == pytest.approx(force, rel=1e-5)
        assert contact["semi_major"] == pytest.approx(radius, rel=1e-5)
        assert contact["resistance"] == pytest.approx(resistance, rel=1e-5)
        total = results.history["resistance PLUS to MINUS"][at(results, time)]
        assert total == pytest.approx(resistance + arms, rel=1e-5)
        # the header: exact beams
        values = [approach, contact["force"], contact["semi_major"] * 1e6, contact["resistance"] * 1e3, total * 1e3]
        assert values == pytest.approx(list(row), rel=1.5e-3)


def test_a_cantilever_pushed_far_aside_has_the_independent_solution(results_of, header):
    results = results_of("10_pushed_cantilever")
    for time, ux, uy, force, gap in header("10_pushed_cantilever"):
        increment = at(results, time)
        contact = only_contact(results, increment)
        u = results.field("displacement", increment)[10]
        # ten cubic elements that turn by 0.05 rad each; the finite elements of the source are as near to the solution
        assert u[:2] == pytest.approx([ux, uy], abs=1e-6)
        assert contact["force"] == pytest.approx(force, rel=1e-5)
        assert contact["gap"] == pytest.approx(gap, rel=1e-5)


def test_a_dragged_cantilever_sticks_and_slips_as_derived(results_of, header):
    results = results_of("13_stick_slip")
    rows = header("13_stick_slip")
    assert len(rows) == 9
    for time, way, force in rows:
        increment = at(results, time)
        assert results.history["U1 node 201"][increment] == pytest.approx(1e-3 * way, abs=1e-12)
        assert results.history["RF1 node 201"][increment] == pytest.approx(1e-3 * force, abs=1e-4 * 0.95e-3)
    # the spot keeps its size while the contact sticks under less force, but for the crossing angle, which changes by 5e-5
    contacts = results.contacts
    sticking = (contacts["step"] == 2) & (contacts["friction"] == "stick")
    np.testing.assert_allclose(contacts["resistance"][sticking], contacts["resistance"][0], rtol=1e-6)
    assert contacts["resistance"][contacts["friction"] == "slip"][0] > 1.0005 * contacts["resistance"][0]


def test_a_slip_that_goes_on_takes_no_iterations_to_be_found_again(results_of):
    """Only the first increments of a step and those in which the contact begins to slip take more than two."""
    status = results_of("13_stick_slip").status
    back = status["iterations"][(status["step"] == 3) & (status["step_time"] > 0.4)]
    assert len(back) == 24
    assert max(back) == 2


def test_a_strand_is_pulled_and_twisted_as_one_of_exact_helices(results_of, header):
    results = results_of("14_strand")
    rows = header("14_strand")
    assert len(rows) == 2
    strand = Strand(Rod(0.52e-3, 120e9, 0.34), Rod(0.5e-3, 120e9, 0.34), 6, 45e-3)
    approach = approach_of(strand.core, strand.wire)
    # the law is per length of either wire
    share = (1 + strand.free.height) / 2
    for (time, force), turn in zip(rows, (0.0, 0.05 / 30e-3), strict=True):
        exact = strand.state(5e-4, turn, lambda f: approach(f / share))
        assert force == pytest.approx(exact.force, rel=1e-5)
        found = results.history["RF3 node 149"][at(results, time)]
        # clamps hold the tilt of the wires at the ends of two thirds of a lay
        assert found == pytest.approx(force, rel=1e-3)
        if turn:
            # the clamps, which hold the tilt of the wires, press them on the core in the middle of so short a strand, too:
            # test_pulled_cables has one of two lays
            continue
        contacts = results.contacts_at(at(results, time))
        # the line force away from the clamps, over whole elements, per mean length of core and wire, whose places have half
        # of it each
        middle = np.abs(contacts["point_1_z"] - 15e-3) < 4.5e-3
        pressed = contacts["force"][middle].sum() / contacts["length"][middle].sum()
        assert pressed == pytest.approx(exact.line_force / share, rel=2e-3)
    conductance = 58.8e6 * np.pi * (0.52e-3**2 + 6 * 0.5e-3**2 * strand.free.height) / 30e-3
    assert results.history["resistance PLUS to MINUS"][at(results, 2)] == pytest.approx(1 / conductance, rel=1e-3)


def guided_beam(bending_stiffness, tension, length, deflection):
    """Force across on the end of a tensioned beam that is moved aside and does not turn."""
    k = math.sqrt(tension / bending_stiffness)
    return tension * deflection / (length - 2 / k * math.tanh(k * length / 2))


@pytest.mark.slow
def test_a_bent_strand_is_stiffer_than_its_wires_and_softer_than_a_rod(results_of, header):
    results = results_of("16_bent_strand")
    ((time, least, most),) = header("16_bent_strand")
    wires = math.pi / 4 * (0.52e-3**4 + 6 * 0.5e-3**4)
    # six wires at the distance R from the axis: the sum of A R^2 sin^2
    rod = wires + 3 * math.pi * 0.5e-3**2 * 1.02e-3**2
    for force, inertia in ((least, wires), (most, rod)):
        assert force == pytest.approx(guided_beam(120e9 * inertia, 324.78, 30e-3, 0.3e-3), rel=1e-3)
    across = results.history["RF2 node 149"]
    assert least < across[at(results, time)] < most
    # wires that have slipped do not come back by themselves
    assert across[at(results, 3)] < 0
    assert {"stick", "slip"} <= set(results.contacts_at(at(results, time))["friction"])


def test_current_passes_through_a_lap_as_between_two_conducting_lines(results_of, header):
    results = results_of("15_lap_joint")
    rows = header("15_lap_joint")
    assert len(rows) == 3
    wire = PressedWire(0.5e-3, 120e9, 0.34, 1 / 58.8e6)
    pair = ParallelWires(wire, wire, film=1e-11)
    modulus = effective_modulus([wire.young] * 2, [wire.poisson] * 2)
    end = end_on_wire(1.0, radius=[wire.radius] * 2, modulus=modulus, resistivity=[wire.resistivity] * 2)
    per_length = wire.resistivity / (math.pi * wire.radius**2)
    for time, force, resistance in rows:
        line_force = pair.force(0.4e-6 * time)
        joint = LineJoint(20e-3, pair.conductance(line_force), per_length, per_length)
        # half of the contact of the round end of either wire on the other one
        of_ends = float((0.4e-6 * time / end.approach) ** 1.5)
        assert force == pytest.approx(20e-3 * line_force + of_ends, rel=1e-5)
        assert 1e-3 * resistance == pytest.approx(joint.lap() + 20e-3 * per_length, rel=1e-5)
        increment = at(results, time)
        assert -results.history["RF3 node 64"][increment] == pytest.approx(force, rel=2e-5)
        # currents are lumped at places 0.2 mm apart, (m h)^2/12 with 1/m of 5 mm: 1e-4; round ends conduct 1e-3 of the lap
        assert results.history["resistance PLUS to MINUS"][increment] == pytest.approx(1e-3 * resistance, rel=1e-3)
        # from x = -10 mm on; half a contact length of 0.1 mm in 1/m of 5 mm
        current = results.field("element_current", increment)[:30]
        np.testing.assert_allclose(current[:10] / current[0], 1.0, rtol=1e-9)
        x = 1e-3 * np.arange(21)
        mean_current = (
            joint.lap_current(x[:-1]) + joint.lap_current(x[1:]) + 4 * joint.lap_current(x[:-1] + 0.5e-3)
        ) / 6
        np.testing.assert_allclose(current[10:] / current[0], mean_current, atol=0.01)


def test_a_fuse_melts_as_if_its_middle_were_alone(results_of, header):
    """Joule heat goes into the specific heat and, at the melting point, into the latent heat: Onderdonk's formula."""
    results = results_of("19_fuse")
    room, solidus, liquidus = 293.15, 1357.0, 1358.0
    slope, conductivity, per_volume, current = 3.93e-3, 390.0, 8960.0 * 385.0, 60.0
    resistivity, area = 1.72e-8, math.pi * 1e-4**2
    rate = (current / area) ** 2 * resistivity * slope / per_volume
    rows = header("19_fuse")
    assert len(rows) == 4
    middle = results.history["NT node 11"]
    for time, temperature in rows:
        assert temperature == pytest.approx(room + math.expm1(rate * time) / slope, abs=0.006)
        assert middle[at(results, time)] == pytest.approx(temperature, abs=0.1)
    begins = math.log1p(slope * (solidus - room)) / rate
    at_solidus = resistivity * (1 + slope * (solidus - room))
    latent = 8960.0 * 205e3 + per_volume * (liquidus - solidus)
    molten = begins + latent / ((current / area) ** 2 * at_solidus)
    # within an increment
    assert results.times[middle > solidus][0] == pytest.approx(begins, abs=1e-4)
    assert results.times[middle > liquidus][0] == pytest.approx(molten, abs=1e-4)
    # what the head of the deck says that it could carry for good, with its ends held
    assert math.pi * area / 0.02 * math.sqrt(conductivity / (resistivity * slope)) == pytest.approx(11.85, abs=0.005)


@pytest.mark.slow
def test_a_rod_is_drawn_over_a_drum_as_an_exact_elastica_with_friction(results_of, header):
    results = results_of("18_rod_over_drum")
    ((time, tension, moment),) = header("18_rod_over_drum")
    weight = 5 * 200e9 * np.pi * 0.5e-3**4 / 4 / 0.05**2
    exact = capstan(5, np.pi, 0.3, 0.01)
    assert tension == pytest.approx(weight * exact.tension / 5, rel=1e-5)
    assert moment == pytest.approx((tension - weight) * 0.05, rel=1e-4)
    last = at(results, time)
    # drawn downwards; the support of the drum turns it against the rod
    assert -results.history["RF3 node 161"][last] == pytest.approx(tension, rel=5e-4)
    assert -results.history["RM2 node 162"][last] == pytest.approx(moment, rel=5e-4)
    contacts = results.surface_contacts_at(last)
    assert set(contacts["friction"]) == {"slip"}
    angle = np.degrees(np.arctan2(contacts["point_x"], contacts["point_z"]))
    assert np.ptp(angle) == pytest.approx(np.degrees(exact.arc), abs=180 / np.pi * 0.457 / 160 / 0.05)


def wire_resistance(length):
    return THIN_COPPER["resistivity"] * length / (math.pi * THIN_COPPER["radius"] ** 2)


def kirchhoff(n_points, links, held):
    """Current into the points held at 1 V, with `links` (point, point, conductance) and `held` (point: potential)."""
    network = Network(n_points, links, held)
    potential = network.solve(np.zeros(n_points))
    return network.flowing_in(potential)[[point for point, value in held.items() if value == 1.0]].sum()


@pytest.fixture
def make_decks(inputs):
    """The module that writes the long decks."""
    specification = importlib.util.spec_from_file_location("make_decks", inputs / "make_decks.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def test_generated_decks_are_those_of_the_generator(inputs, make_decks):
    makers = {
        "11_fibre_mat": make_decks.fibre_mat,
        "12_woven_fabric": make_decks.woven_fabric,
        "14_strand": make_decks.strand,
        "15_lap_joint": make_decks.lap_joint,
        "16_bent_strand": make_decks.bent_strand,
        "18_rod_over_drum": make_decks.rod_over_drum,
        "17_knot": make_decks.knot,
        "21_heated_mat": make_decks.heated_mat,
        "22_wiper": make_decks.wiper,
        "24_compacted_cable": make_decks.compacted_cable,
        "25_cable_of_45_strands": make_decks.cable_of_45_strands,
    }
    for name, make in makers.items():
        kept, made = (
            re.split(NUMBER, text) for text in ((inputs / f"{name}.inp").read_text(encoding="utf-8"), make().to_deck())
        )
        assert kept[::2] == made[::2], name
        # processors round sums of products differently, in the last of 16 digits of coordinates that cancel
        np.testing.assert_allclose(
            [float(x) for x in kept[1::2]], [float(x) for x in made[1::2]], rtol=1e-12, atol=1e-15
        )


def test_a_knot_short_circuits_its_loop(results_of, make_decks):
    """Kirchhoff's laws: the wire between its contacts, and these. Before there are any, the whole wire."""
    results = results_of("17_knot")
    curve = np.array([make_decks.overhand(t) for t in np.linspace(-4, 4, 20001)])
    length = np.linalg.norm(np.diff(curve, axis=0), axis=1).sum()
    per_length = 1 / (1.25e6 * math.pi * 0.25e-3**2)
    resistance = results.history["resistance WIRE_START to WIRE_END"]
    n_elements = len(results.elements)
    for increment in range(1, len(results.times)):
        contacts = results.contacts_at(increment)
        n = contacts.n_rows
        # elements have equal lengths of the curve; those of its arcs are known to 1e-5
        arc = [(contacts[f"element_{k}"] - 1 + (contacts[f"xi_{k}"] + 1) / 2) * length / n_elements for k in (1, 2)]
        places = sorted(zip(np.concatenate([[0, length], *arc]), range(2 * n + 2), strict=True))
        links = [(p, q, 1 / (per_length * (b - a) + 1e-12)) for (a, p), (b, q) in itertools.pairwise(places)]
        links += [(2 + k, 2 + n + k, 1 / contacts["resistance"][k]) for k in range(n)]
        assert 1 / resistance[increment] == pytest.approx(kirchhoff(2 * n + 2, links, {0: 1.0, 1: 0.0}), rel=3e-5)
    # from the header
    assert resistance[1] == pytest.approx(0.3530, abs=5e-5)
    first = next(k for k in range(1, len(results.times)) if results.contacts_at(k).n_rows)
    assert resistance[first] == pytest.approx(0.215, abs=1e-3)
    assert resistance[-1] == pytest.approx(0.2745, abs=5e-4)


def test_a_knot_stays_as_it_is_when_it_is_turned_about(results_of):
    """Half a turn about the y axis exchanges its ends; contacts keep to places that have turned far enough to come back."""
    results = results_of("17_knot")
    x = results.nodes + results.field("displacement")
    # the knot is soft against turning on itself; iterations stop at 1e-8 of the forces
    assert x == pytest.approx(x[::-1] * [-1, 1, -1], abs=1e-6)
    contacts = results.contacts_at(-1)
    assert (contacts["length"] > 0).sum() > 20
    assert np.min(np.abs(contacts["element_1"] - contacts["element_2"])) > 20
    assert results.history["RF1 node 161"][-1] == pytest.approx(17.9, abs=0.1)


def test_the_work_on_a_knot_is_stored_in_it(results_of):
    history = results_of("17_knot").history
    stored = history["ALLSE"] + history["ALLCCE"]
    # the force over the increments by the trapezoidal rule
    assert stored == pytest.approx(history["ALLWK"], abs=2e-3 * stored[-1])


@pytest.mark.slow
def test_mat_conducts_better_the_more_it_is_pressed(results_of):
    results = results_of("11_fibre_mat")
    resistance = results.history["resistance PLUS to MINUS"]
    touching = np.isfinite(resistance)
    # the gaps of 5 microns are closed at 0.45 of the time
    assert results.times[touching][0] == pytest.approx(0.5)
    assert touching.sum() >= 6
    assert (np.diff(resistance[touching]) < 0).all()
    network = results.contact_network()
    assert len(network.wire_length) == 128 + 12
    for contact in range(0, len(network.id), 50):
        holm = cf.hertz_contact(network.force[contact], angle=network.angle[contact], **THIN_COPPER)
        # of straight wires: these are bent with radii of more than 100 of their own
        assert network.resistance[contact] == pytest.approx(holm.resistance, rel=2e-3)


@pytest.mark.slow
def test_mat_is_the_network_of_its_contacts(results_of):
    results = results_of("11_fibre_mat")
    network, n_points, stretches, plates = points_of_mat(results)
    links = [(2 * k, 2 * k + 1, 1 / resistance) for k, resistance in enumerate(network.resistance)]
    links += [(p, q, 1 / wire_resistance(length)) for p, q, length in stretches]
    held = {point: float(upper) for point, upper in plates.items()}
    # whatever the number of contacts on an element
    assert results.conductance("PLUS", "MINUS") == pytest.approx(kirchhoff(n_points, links, held), rel=1e-9)
    assert results.conductance("PLUS", "MINUS") * results.history["resistance PLUS to MINUS"][-1] == pytest.approx(1)


def fabric_cell(press, pitch, gap):
    """Force between plate and wire and between wires, far from the edges of a fabric."""
    radius = THIN_COPPER["radius"]
    x = (np.arange(2000) + 0.5) / 2000 * pitch
    slope = math.pi * (radius + gap / 2) / pitch * np.sin(math.pi * x / pitch)
    stiffness = THIN_COPPER["young"] * math.pi * radius**4 / 4
    # at their crests wires bend about each other, and away from the plates
    bend = (radius + gap / 2) * (math.pi / pitch) ** 2
    about = {"angle": math.pi / 2, "curvature": (-bend, -bend), **THIN_COPPER}
    away = {"angle": math.pi / 4, "curvature": (bend, 0.0), **THIN_COPPER}
    flexibility = np.mean((pitch / 2 - x) ** 2 * np.sqrt(1 + slope**2)) * pitch / stiffness

    def closing(crest):
        """How far the plates come down when the crests do by `crest`, and the two forces."""
        wires = cf.hertz_force(2 * crest - gap, **about)
        plate = wires + 4 * crest / flexibility
        return gap + crest + cf.hertz_contact(plate, **away).approach, plate, wires

    low, high = gap / 2 * (1 + 1e-9), press / 2
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if closing(middle)[0] < press / 2 else (low, middle)
    length = np.mean(np.sqrt(1 + slope**2)) * pitch
    return *closing(low)[1:], length, about, away


def test_fabric_carries_the_forces_of_its_unit_cell(results_of, inputs):
    results = results_of("12_woven_fabric")
    plate, wires, length, about, away = fabric_cell(6.5e-6, 1e-3, 1e-6)
    text = (inputs / "12_woven_fabric.inp").read_text(encoding="utf-8")
    assert f"plate F = {plate:.4f} N, wires N = {wires:.4f} N" in text
    network = results.contact_network()
    between_wires = (network.wires < 16).all(axis=1)
    middle = np.abs(network.point[:, :2] - 4e-3).max(axis=1) < 0.6e-3
    assert between_wires.sum() == 64
    assert len(network.id) == 3 * 64
    # shear and stretch of the wires, and the edges three crossings away
    assert network.force[between_wires & middle] == pytest.approx(wires, rel=5e-3)
    assert network.force[~between_wires & middle] == pytest.approx(plate, rel=5e-3)

    plate_spot = cf.hertz_contact(plate, **away).resistance
    to_plate = 1 / (plate_spot + wire_resistance(2 * THIN_COPPER["radius"]) / 4)
    between = 1 / cf.hertz_contact(wires, **about).resistance
    links, top, bottom = [], 128, 129
    for i, j in itertools.product(range(8), range(8)):
        warp, weft = 8 * i + j, 64 + 8 * i + j
        over, under = (warp, weft) if (i + j) % 2 == 0 else (weft, warp)
        links += [(top, over, to_plate), (over, under, between), (under, bottom, to_plate)]
        links += [(warp, warp + 8, 1 / wire_resistance(length))] if i < 7 else []
        links += [(weft, weft + 1, 1 / wire_resistance(length))] if j < 7 else []
    resistance = 1 / kirchhoff(130, links, {top: 1.0, bottom: 0.0})
    assert f"resistance between the plates {1e3 * resistance:.5f} mohm" in text
    # each wire element has two contacts, of which its linear potential knows each alone
    assert results.history["resistance PLUS to MINUS"][-1] == pytest.approx(resistance, rel=0.02)


def test_a_current_heats_the_spot_between_crossed_wires(results_of, header):
    """Wires and spot as resistances to current and heat; the hottest place by Kohlrausch's relation."""
    results = results_of("20_hot_spot")
    room, conductivity, sigma, lorenz, radius, arm = 293.15, 390.0, 58.8e6, 2.44e-8, 5e-4, 0.01
    area, spot = math.pi * radius**2, 1 / (2 * math.sqrt(radius * 4e-7) * sigma)
    rows = header("20_hot_spot")
    assert len(rows) == 3
    for time, *expected in rows:
        voltage = 0.15 * (time - 1)
        current = voltage / (2 * arm / (area * sigma) + spot)
        # half of the heat of the arm that carries the current enters at the crossing, and leaves through both arms
        entering = current**2 * (spot + arm / (area * sigma)) / 2
        wires = room + entering * arm / (2 * conductivity * area)
        hottest = math.sqrt(wires**2 + (current * spot) ** 2 / (4 * lorenz))
        assert expected == pytest.approx([current, wires, hottest], abs=0.006)
        contact = results.contacts_at(at(results, time))
        # the force bends the wires with radii of 10^4 of their own
        assert contact["current"] == pytest.approx(current, rel=3e-6)
        np.testing.assert_allclose([contact["temperature_1"], contact["temperature_2"]], wires, atol=0.01)
        assert contact["temperature_max"] == pytest.approx(hottest, abs=0.01)
    assert re.search(r"hottest spot +515\.6 K +in contact 1", summary(results))


@pytest.mark.slow
def test_crossed_wires_that_have_yielded_keep_a_dent(results_of, header):
    """A beam as a spring before the spot: force and resistance on the way up, back, and up again; the wires part while the
    beam is still bent."""
    results, rows = results_of("23_dented_wires"), header("23_dented_wires")
    times = [time for time, _, _ in rows]
    assert times == [0.5, 1, 1.5, 1.9, 2.3, 2.5, 3, 3.5, 3.9]
    largest = 0.0
    for (time, *expected), (force, resistance) in zip(rows, yielded_wires.history(times), strict=True):
        largest = max(largest, force)
        # the header has five digits; the beam bends by 0.2 % of its length
        assert expected == pytest.approx([force, 1e3 * resistance], rel=5e-5)
        contact = only_contact(results, at(results, time))
        assert contact["force"] == pytest.approx(force, rel=3e-5)
        assert contact["resistance"] == pytest.approx(resistance, rel=3e-5)
        assert contact["largest_force"] == pytest.approx(largest, rel=3e-5)
        assert contact["dent"] == pytest.approx(yielded_wires.SPOT.dent(largest), rel=3e-5)
    assert results.contacts_at(-1).n_rows == 0
    # trapezoids of the reference
    assert results.history["ALLPD"][-1] == pytest.approx(yielded_wires.SPOT.dissipation(largest), rel=1e-4)


@pytest.mark.slow
def test_a_compacted_cable_is_pressed_together_by_its_current(results_of):
    """Clamps and jacket carry the Lorentz force; under load bundles touch that lie apart without it."""
    results = results_of(PRESSED_CABLE)
    assert results.finished
    ends = [int(np.argmin(abs(np.asarray(results.times) - time))) for time in range(1, 7)]
    force = (results.field("reaction_force", None) + results.field("applied_force", None)).sum(axis=1)
    length = 20e-3 * (1 - 10e-6 * 918.5 - 3e-3)
    for step, loaded in ((1, 0.0), (2, 1.0), (3, 0.0), (4, 1.0), (5, 0.0)):
        jacket = sum(results.surface_contacts_at(ends[step])[f"surface_force_{axis}"].sum() * e
                     for axis, e in zip("xyz", np.eye(3), strict=True))  # fmt: skip
        # forces of contacts are those of the iterate to 1e-8, friction on the jacket to its increments
        np.testing.assert_allclose(force[ends[step]] - jacket, [0, -loaded * 9 * 75 * 11.5 * length, 0], atol=1e-5)
    # critical currents under load: the parametrization at the strain of each element and that of cooling down
    fit = dict(C=4e10, Bc20=32.57, Tc0=17.17, p=0.7, q=2.1, Ca1=45.74, Ca2=4.431, e0=2.32e-3, em=-0.61e-3)
    area = np.pi * 0.41e-3**2
    strains = results.field("axial_force", ends[2]) / (110e9 * area) - 3e-3
    critical = [area / 2 * kernels.nb3sn(4.5, 11.5, strain, **fit).value for strain in strains]
    np.testing.assert_allclose(results.field("critical_current", ends[2]), critical, rtol=1e-9)
    # most of the 0.3 % that the jacket takes; where strands leave the clamps they bend
    assert -6.3e-3 < strains.min() < -6e-3
    circuits = [results.interstrand_resistance(ends[step], superconducting=True) for step in (1, 2, 4)]
    between = [circuit.between("BUNDLE1", "BUNDLE2") for circuit in circuits]
    assert between[0] == np.inf
    assert all(0 < resistance < 2e-3 for resistance in between[1:])


@pytest.mark.slow
def test_jacket_and_ends_carry_the_lorentz_force_of_45_strands_over_ten_cycles(results_of):
    """Bundles press each other more or less under load, and ever less comes to that with each cycle."""
    results = results_of(CABLE_OF_45)
    assert results.finished
    ends = [int(np.argmin(abs(np.asarray(results.times) - time))) for time in range(1, 24)]
    force = (results.field("reaction_force", None) + results.field("applied_force", None)).sum(axis=1)
    lorentz = 45 * 75 * 11.5 * 12e-3 * (1 - 10e-6 * 918.5 - 3e-3)
    for step in (3, 4, 5, 22, 23):
        at = ends[step - 1]
        jacket = results.surface_contacts_at(at)
        held = force[at, :2] - [jacket[f"surface_force_{axis}"].sum() for axis in "xy"]
        np.testing.assert_allclose(held, [0, -lorentz if step % 2 == 0 else 0], atol=1e-3)
    between = []
    for step in (4, 6, 20, 22):
        circuit = results.interstrand_resistance(ends[step - 1], superconducting=True)
        between.append(np.array([circuit.between(f"BUNDLE{i}", f"BUNDLE{i % 5 + 1}") for i in range(1, 6)]))
    assert np.all((np.array(between) > 3.6e-4) & (np.array(between) < 8.2e-4))
    # the last cycle changes it by less than half of what the second does, but for round-off
    assert np.all(abs(between[3] - between[2]) < 0.5 * abs(between[1] - between[0]) + 1e-7)

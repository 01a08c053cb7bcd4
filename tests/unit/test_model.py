"""litz.Model: what is built is in the deck, the program accepts it, errors are raised immediately."""

import math
import subprocess

import numpy as np
import pytest

import litz
from litz import model as parts
from litz.deck.keyword_table import check_card

COPPER = litz.COPPER
WIRE = {"radius": 1e-3, "material": COPPER}


def crossed(**contact):
    """Two crossed copper wires with a step that presses them together."""
    model = litz.Model("crossed", units={"length": "m"})
    lower = model.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), elements=9, **WIRE)
    upper = model.wire("UPPER", (0, -0.05, 2e-3), (0, 0.05, 2e-3), elements=9, **WIRE)
    model.contact(lower, upper, **{"conductance": litz.HertzSpot(), **contact})
    model.fix(lower.ends)
    model.fix(upper.ends, "x", "y", "rotations")
    step = model.step(increment=0.25)
    step.move(upper.ends, "z", -1e-4)
    step.potential(lower.start, 1e-3)
    step.potential(upper.start, 0.0)
    return model, lower, upper, step


def deck_of(model):
    return litz.Deck.parse(model.to_deck())


# Wires


def test_a_straight_wire_has_its_elements_and_ends():
    model = litz.Model("one wire")
    wire = model.wire("A", (0, 0, 0), (0, 3, 4), elements=5, **WIRE)
    np.testing.assert_allclose(np.linalg.norm(np.diff(model.x, axis=0), axis=1), 1.0, rtol=1e-14)
    assert (wire.start, wire.end, wire.ends, wire.middle) == ((1,), (6,), (1, 6), (4,))
    assert wire.nearest((0, 1.2, 1.4)) == (3,)
    assert list(wire.elements) == [1, 2, 3, 4, 5]


def test_the_points_of_a_polygon_are_nodes():
    model = litz.Model("a polygon")
    points = np.array([(0, 0, 0), (1, 0, 0), (1, 2, 0)])
    model.wire("A", points=points, **WIRE)
    np.testing.assert_array_equal(model.x, points)


def test_a_polygon_with_elements_keeps_its_corners():
    model = litz.Model("a polygon")
    model.wire("A", points=[(0, 0, 0), (3, 0, 0), (3, 1, 0)], elements=8, **WIRE)
    np.testing.assert_allclose(np.linalg.norm(np.diff(model.x, axis=0), axis=1), 0.5, rtol=1e-14)


def test_a_curve_is_divided_into_equal_lengths():
    model = litz.Model("a helix")
    model.wire("A", curve=lambda t: (math.cos(t), math.sin(t), t**3), span=(0, 2), elements=16, **WIRE)
    x = model.x
    np.testing.assert_allclose(x[-1], [math.cos(2), math.sin(2), 8], rtol=1e-14)
    # nodes lie on the curve
    np.testing.assert_allclose(np.arctan2(x[:, 1], x[:, 0]), np.cbrt(x[:, 2]), atol=1e-12)
    # the length along the curve by a sum over fine chords, whose error falls with their square
    fine = np.linspace(0, 2, 200_001)
    points = np.column_stack([np.cos(fine), np.sin(fine), fine**3])
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    at_nodes = np.interp(np.cbrt(x[:, 2]), fine, along)
    np.testing.assert_allclose(np.diff(at_nodes), along[-1] / 16, rtol=2e-3)


def test_a_spline_goes_smoothly_through_its_points():
    # points of a circle: the spline leaves it by far less than the chords, which are 1 - cos(pi/16) = 0.019 away
    angles = np.linspace(0, 2 * np.pi, 17)[:-1]
    model = litz.Model("a ring")
    ring = model.wire(
        "A", points=np.column_stack([np.cos(angles), np.sin(angles)]), spline=True, closed=True, elements=50, **WIRE
    )
    np.testing.assert_allclose(np.linalg.norm(model.x, axis=1), 1.0, atol=1e-3)
    assert len(model.x) == 50
    assert ring.connectivity[-1].tolist() == [50, 1]


def test_wires_are_joined_at_shared_nodes():
    model = litz.Model("a corner")
    first = model.wire("A", (0, 0, 0), (1, 0, 0), elements=2, **WIRE)
    second = model.wire("B", first.end, (1, 1, 0), elements=2, **WIRE)
    third = model.wire("C", second.end, first.start, elements=2, **WIRE)
    assert second.nodes == (3, 4, 5)
    assert third.nodes == (5, 6, 1)
    assert len(model.x) == 6
    sets = {card["NSET"]: [node for row in card.data for node in row] for card in deck_of(model).find("NSET")}
    assert sets == {"B": [3, 4, 5], "C": [5, 6, 1]}


def test_a_group_of_many_wires():
    model = litz.Model("a group")
    group = model.wires("A", [[(0, y, 0), (1, y, 0), (2, y, 0)] for y in range(3)], **WIRE)
    assert [wire.ends for wire in group.wires] == [(1, 3), (4, 6), (7, 9)]
    assert (group.start, group.end) == ((1, 4, 7), (3, 6, 9))
    assert repr(group) == "<3 wires A: 6 B33 elements, radius 0.001, COPPER>"
    assert model.wire_of_element.tolist() == [0, 0, 1, 1, 2, 2]


def test_elements_between_given_nodes_are_found_as_wires():
    model = litz.Model("a star")
    nodes = model.nodes([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (0, 0, 1)], name="CORNERS")
    star = model.elements("STAR", [(1, 2), (2, 3), (1, 4), (1, 5)], **WIRE)
    assert list(nodes) == [1, 2, 3, 4, 5]
    assert sorted(len(wire.elements) for wire in star.wires) == [1, 1, 2]
    assert deck_of(model).card("NSET", nset="CORNERS")


# What stands in the deck


#: Keywords that models do not write
NOT_BUILT = {"INCLUDE", "MESH", "JOULE HEAT FRACTION", "BEAM GENERAL SECTION"}
#: Those of forces on the length of wires
OF_FORCES = {"DLOAD", "LORENTZ"}
#: Those of models with temperatures
OF_HEAT = {
    "INITIAL CONDITIONS", "TEMPERATURE", "CONDUCTIVITY", "EXPANSION", "PHYSICAL CONSTANTS", "COUPLED THERMAL-ELECTRICAL",
    "COUPLED TEMPERATURE-DISPLACEMENT", "DENSITY", "SPECIFIC HEAT", "LATENT HEAT", "CFLUX", "DFLUX", "FILM", "RADIATE",
}  # fmt: skip


#: Niobium-titanium in copper
STRAND = litz.Material(
    "STRAND",
    110e9,
    0.33,
    5e9,
    superconductor=litz.Superconductor(30, nbti=(3e9, 27, 14.5, 9.2, 0.57, 0.9, 2.3), ratio=1.6),
)


def test_the_program_accepts_all_that_can_be_said(litz_program, tmp_path):
    model, lower, upper, step = crossed(friction=litz.Friction(0.3, elastic_slip=1e-6), axis="LINEAR")
    beside = {"centroid": (1e-4, 0), "shear_center": (2e-4, -1e-4)}
    general = litz.General(1e-6, 1e-13, 2e-13, 3e-13, n1=(0, 0, 1), shear=(1e4, 2e4), contact_radius=5e-4, **beside)
    side = model.wire("SIDE", (0.2, 0, 0), (0.3, 0, 0), elements=2, section=general, material=litz.STEEL, element="B31")
    thick = litz.Circular(1e-3, contact_radius=2e-3, conduction="CURRENT LENGTH")
    more = model.wire("MORE", (0.2, 1, 0), (0.3, 1, 0), elements=2, section=thick, material=STRAND)
    model.fix(side.start)
    model.fix(more.start)
    model.fix(more.start, "potential")
    model.element_set("ALL", [lower, upper, "SIDE", 21])
    model.local_axes(more.start, (0, 0, 0), (0, 0, 1), "cylindrical")
    model.contact([side, more], behaviour=litz.Linear(1e5, penetration="UNLIMITED"), interference_fit=True)
    model.contact(lower, more, conductance=litz.PaperSpot(voltage="LINEAR"), name="SPOT1")
    model.contact(upper, more, conductance=litz.PlasticSpot(1e9, spot="LARGEST FORCE"))
    model.contact(lower, conductance=litz.FilmSpot(1e-12), heat=litz.GapConductance(film=1e-7))
    model.contact(
        upper, behaviour=litz.NamedBehaviour("linear", [[2e5]]), conductance=litz.NamedSpot("constant", [[1e-3]])
    )
    model.contact(side, conductance=litz.ConstantSpot(1e-3))
    model.contact(
        more,
        conductance=litz.TableSpot([1, 2], [3e-3, 1e-3]),
        heat=litz.GapConductance(
            "TABLE", [[1, 0.1], [2, 0.2]], softening=460, melting=1300, may_melt=True, per_length=True
        ),
        friction=litz.Friction(0.3, heat_fraction=0.5),
    )
    model.rigid_body((0.35, 1, 0), tie=more.middle, pin=more.end)
    model.equation((side.end, "ry", 1), (side.start, "ry", -0.5), (lower.middle, 1, 2))
    model.contact(more, model.plane("TABLE", (0, 0, -0.1), (0, 0, 1)))
    ramp = model.amplitude("RAMP", np.linspace(0, 1, 7), np.linspace(0, 1, 7) ** 2)
    step.force(side.end, "x", 1.0)
    step.moment(side.end, "y", 1e-3, amplitude=ramp)
    step.current(more.end, 1.0, amplitude="RAMP")
    step.node_print(upper, "U", "RF", totals="ONLY")
    step.node_print(upper.ends, "RM")
    step.el_print("ALL", "SF", totals="YES")
    step.electrode_print(lower.start, upper.start)
    for request in (step.energy_print, step.contact_print, step.contact_file, lambda: step.el_file("SE", "E11")):
        request()
    step.node_file(frequency=2)
    step.restart(frequency=5)
    step.controls("field", r_n=1e-4)
    step.controls("time incrementation", i_c=30, d_f=0.3)
    step.controls("rotation", cap=0.4)
    step.controls("stabilize")
    step.solver("umfpack", coupling="monolithic")
    step.solution_technique("modified Newton", reform_kernel=4)
    again = model.step(total=2.0, first=0.5, smallest=1e-3, largest=1.0, inc=20, boundary_op="NEW")
    again.hold([lower.ends, upper.ends])
    again.hold([side.start, more.start])
    again.hold(more.start, "potential")
    last = model.step("LAST", direct=True, first=0.5, cload_op="NEW")
    last.cload(int(side.end[0]), 2, 0.5)
    deck = model.write(tmp_path / "new" / "all.inp")
    done = subprocess.run([litz_program, "check", deck], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert all(words in done.stdout for words in ("step 3", "GA2 = 10000 N, GA3 = 20000 N"))
    used = {card.name for card in litz.Deck.read(deck)}
    assert set(litz.keywords()) - used == NOT_BUILT | OF_HEAT | OF_FORCES


def test_what_is_held_where_it_is_has_a_card_of_its_own():
    model = litz.Model("held")
    wire = model.wire("W", (0, 0, 0), (0.1, 0, 0), radius=1e-3, material=litz.COPPER, elements=4)
    model.fix(wire.start)
    step = model.step()
    step.move(wire.end, "z", 1e-3)
    step.hold_here(wire.end, "x", "y")
    step.hold(wire.end, "rotations")
    lines = model.to_deck().splitlines()
    step_cards = lines[lines.index(next(line for line in lines if line.startswith("*STEP"))) :]
    begin = step_cards.index("*BOUNDARY")
    assert step_cards[begin : begin + 6] == [
        "*BOUNDARY", " W_END, 3, 3, 1e-3", "*BOUNDARY, FIXED", " W_END, 1, 2", "*BOUNDARY", " W_END, 4, 6"
    ]  # fmt: skip


def warm_wire():
    """A wire of copper with all of its thermal properties."""
    copper = litz.Material(
        "COPPER", 120e9, 0.34, [(6e7, 20.0), (1e7, 1000.0)], expansion=17e-6,
        thermal_conductivity=[(400.0, 20.0), (350.0, 1000.0)], density=8960.0, specific_heat=385.0,
        latent_heat=(205e3, 1084.0, 1085.0),
    )  # fmt: skip
    model = litz.Model("warm")
    wire = model.wire("W", (0, 0, 0), (0.1, 0, 0), radius=1e-3, material=copper, elements=4)
    model.physical_constants(absolute_zero=-273.15, stefan_boltzmann=5.67e-8)
    model.initial_temperature(20.0)
    model.fix(wire.start)
    model.fix(wire.end, "potential")
    return model, wire


def test_the_program_accepts_all_that_can_be_said_of_heat(litz_program, tmp_path):
    model, wire = warm_wire()
    swell = model.step("WARM", procedure="static", increment=0.5)
    swell.temperature(wire, 100.0)
    steady = model.step("STEADY", procedure="COUPLED TEMPERATURE-DISPLACEMENT", steady_state=True)
    steady.temperature(wire.ends, 20.0)
    steady.current(wire.start, 1.0)
    heat = model.step("HEAT", procedure="coupled thermal-electrical", first=0.1, total=2.0, deltmx=50.0)
    wave = model.amplitude("WAVE", [0.0, 1.0], [1.0, 0.5])
    heat.film("W", 20.0, 10.0, amplitude=wave, film_amplitude="WAVE")
    heat.radiate(wire, 20.0, 0.5, amplitude=wave)
    heat.body_heat(wire, 1e3, amplitude=wave)
    heat.heat(wire.middle, 0.1)
    heat.node_print(wire, "NT", "RFL")
    deck = model.write(tmp_path / "warm.inp")
    done = subprocess.run([litz_program, "check", deck], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    read = litz.Deck.read(deck)
    assert {card.name for card in read} >= OF_HEAT
    assert [read.find(name)[0]["AMPLITUDE"] for name in ("DFLUX", "FILM", "RADIATE")] == ["WAVE"] * 3
    assert read.find("FILM")[0]["FILM AMPLITUDE"] == "WAVE"


@pytest.mark.parametrize(
    ("superconductor", "row"),
    [
        (dict(jc=2e9, fraction=0.4), ["2e+09"]),
        (dict(jc=[(2e9, 4, 5), (1e9, 6, 5)], fraction=0.4, strain=-5e-3), ["2e+09, 4, 5", "1e+09, 6, 5"]),
        (dict(nb3sn=(7.5e10, 33, 16, 0.6, 2.1, 44, 4, 2.56e-3, 0), ratio=1.0, field=12.0, criterion=1e-5), None),
    ],
)
def test_a_superconductor_is_a_card_of_its_material(litz_program, tmp_path, superconductor, row):
    model = litz.Model("A strand")
    wire = model.wire(
        "WIRE", (0, 0, 0), (0.1, 0, 0), elements=2, radius=4e-4,
        material=litz.Material("STRAND", 1e11, 0.3, 5e9, superconductor=litz.Superconductor(30, **superconductor)),
    )  # fmt: skip
    model.fix(wire.start)
    model.fix(wire.start, "potential")
    model.step().current(wire.end, 1.0)
    deck = model.write(tmp_path / "strand.inp")
    done = subprocess.run([litz_program, "check", deck], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    card = litz.Deck.read(deck).find("SUPERCONDUCTOR")[0]
    assert float(card["N"]) == 30
    if row is not None:
        assert [[float(x) for x in line] for line in card.data] == [[float(x) for x in line.split(",")] for line in row]


@pytest.mark.parametrize(
    ("superconductor", "message"),
    [
        (dict(fraction=0.4), "one of jc, nb3sn and nbti"),
        (dict(jc=1e9, nbti=(1,) * 7, fraction=0.4), "one of jc, nb3sn and nbti"),
        (dict(jc=1e9), "either fraction or ratio"),
        (dict(jc=1e9, fraction=1.2), "less than 1, not 1.2"),
        (dict(jc=-1e9, fraction=0.4), "jc of \\*SUPERCONDUCTOR"),
    ],
)
def test_bad_superconductors_are_refused(superconductor, message):
    with pytest.raises(ValueError, match=message):
        litz.Superconductor(30, **superconductor)


def test_a_superconductor_needs_a_metal_around_it():
    with pytest.raises(ValueError, match="needs the conductivity of the metal around it"):
        litz.Material("A", 1e11, 0.3, superconductor=litz.Superconductor(30, jc=1e9, fraction=0.4))


def test_forces_on_the_length_of_wires_are_cards_of_their_steps():
    model, wire = warm_wire()
    wave = model.amplitude("WAVE", [0.0, 1.0], [1.0, 0.5])
    first = model.step("FIRST")
    first.dload(wire, "px", 2.0, amplitude=wave)
    first.dload("W", "P1", -3.0)
    first.lorentz(wire, (0.1, 0.2, 0.3), [[1, 2, 3], [4, 5, 6], [7, 8, -6]])
    model.step("SECOND", dload_op="NEW", lorentz_op="NEW")
    deck = deck_of(model)
    assert [card.data for card in deck.find("DLOAD")] == [[["W", "PX", 2]], [["W", "P1", -3]], []]
    assert [card.get("AMPLITUDE") for card in deck.find("DLOAD")] == ["WAVE", None, None]
    assert deck.find("LORENTZ")[0].data == [["W", 0.1, 0.2, 0.3, 1, 4, 7, 2, 5, 8, 3, 6, -6]]
    assert deck.find("LORENTZ")[1]["OP"] == "NEW"
    with pytest.raises(ValueError, match="PX, PY, PZ, P1, P2 or GRAV"):
        first.dload(wire, "PQ", 1.0)


def test_weight_is_that_of_all_wires_unless_some_are_named():
    model, wire = warm_wire()
    step = model.step()
    step.gravity()
    step.gravity((0, 3, 4), wire)
    lines = deck_of(model).find("DLOAD")[0].data
    assert lines == [[None, "GRAV", 9.81, 0, 0, -9.81], ["W", "GRAV", 5, 0, 3, 4]]


def test_a_material_that_a_model_defines_has_all_properties_of_one():
    model = litz.Model("heavy")
    heavy = model.material("LEAD", young=16e9, poisson=0.44, density=11340, expansion=29e-6)
    assert heavy == litz.Material("LEAD", 16e9, 0.44, density=11340, expansion=29e-6)


def test_the_increments_of_a_step_over_time_are_those_of_the_keyword():
    model, _ = warm_wire()
    model.step(procedure="COUPLED THERMAL-ELECTRICAL", first=0.1, total=2.0)
    model.step(procedure="COUPLED THERMAL-ELECTRICAL", first=0.1, total=2.0, largest=0.5, deltmx=10.0)
    one, other = deck_of(model).find("COUPLED THERMAL-ELECTRICAL")
    model.step(procedure="COUPLED THERMAL-ELECTRICAL", first=0.1, total=2.0, error=0.5, steady_rate=1e-3)
    model.step(procedure="COUPLED THERMAL-ELECTRICAL", first=0.1, total=2.0, steady_rate=1e-3)
    *_, third, fourth = deck_of(model).find("COUPLED THERMAL-ELECTRICAL")
    assert (third["ERROR"], third["END"], third.data) == (0.5, "SS", [[0.1, 2, 2e-5, 2, 1e-3]])
    assert (fourth["END"], fourth.data[0][-1]) == ("SS", 1e-3)
    assert one.data == [[0.1, 2]]
    assert other.data == [[0.1, 2, 2e-5, 0.5]]
    assert other["DELTMX"] == 10.0


def test_a_step_that_follows_its_error_begins_with_the_smallest_increment():
    model, _ = warm_wire()
    model.step(procedure="COUPLED THERMAL-ELECTRICAL", total=2.0, error=0.5)
    model.step(procedure="COUPLED THERMAL-ELECTRICAL", total=2.0, error=0.5, smallest=1e-6)
    assert [card.data for card in deck_of(model).find("COUPLED THERMAL-ELECTRICAL")] == [
        [[2e-5, 2, 2e-5, 2]],
        [[1e-6, 2, 1e-6, 2]],
    ]


def test_a_wire_in_the_air_is_as_warm_as_its_film_and_its_current_say(tmp_path):
    model = litz.Model("in the air")
    metal = litz.Material("METAL", 1e11, 0.3, 1e7, thermal_conductivity=100.0)
    wire = model.wire("W", (0, 0, 0), (0.1, 0, 0), radius=1e-3, material=metal, elements=4)
    model.fix(wire.start)
    model.fix(wire.end, "potential")
    step = model.step(procedure="COUPLED THERMAL-ELECTRICAL", steady_state=True)
    step.film(wire, 20.0, 15.0)
    step.current(wire.start, 10.0)
    results = model.run(tmp_path / "air")
    area, perimeter = math.pi * 1e-6, 2 * math.pi * 1e-3
    np.testing.assert_allclose(results.field("temperature"), 20 + 100 / (1e7 * area) / (15 * perimeter), rtol=1e-9)


def test_an_increment_alone_is_the_first_and_the_largest():
    model, *_ = crossed()
    assert deck_of(model).card("STATIC").data == [[0.25, 1, 1e-5, 0.25]]
    assert deck_of(model).card("STEP")["INC"] == 100


def test_many_increments_get_room():
    model, *_ = crossed()
    model.step(increment=0.001)
    assert deck_of(model).card("STEP", step=2)["INC"] == 10_000


def test_numbers_come_back_exactly():
    model = litz.Model("numbers")
    x = np.random.default_rng(1).normal(size=(200, 3))
    model.wire("A", points=x, **WIRE)
    np.testing.assert_array_equal(np.array(deck_of(model).card("NODE").data)[:, 1:], x)


def test_equal_laws_share_an_interaction_and_others_do_not():
    model, lower, upper, _ = crossed()
    model.contact(lower, conductance=litz.HertzSpot())
    model.contact(upper, friction=0.1)
    assert [pair.interaction.name for pair in model.contacts] == ["TOUCH", "TOUCH", "TOUCH2"]
    assert len(deck_of(model).find("SURFACE INTERACTION")) == 2


def test_sets_are_written_when_they_are_used():
    model, _, upper, step = crossed()
    assert "UPPER_MIDDLE" not in model.node_sets
    step.node_print(upper.middle, "U")
    assert deck_of(model).card("NSET", nset="UPPER_MIDDLE").data == [[16]]


@pytest.mark.parametrize("mesh_file", [False, True])
def test_a_model_runs_and_gives_the_force_of_its_deck(mesh_file, tmp_path):
    model, _, upper, step = crossed()
    step.node_print(upper.ends, "RF", totals="ONLY")
    if mesh_file:
        deck = model.write(tmp_path / "run.inp", mesh_file=True)
        results = litz.run(deck, output_directory=tmp_path)
    else:
        results = model.run(tmp_path / "run")
    assert results.path.name == "run.vtkhdf"
    # equilibrium: the supports of the upper wire press with the contact force
    assert results.history["RF3 sum UPPER_ENDS"][-1] == pytest.approx(-results.contacts_at(-1)["force"].sum(), rel=1e-8)


def test_constants_of_the_package_pass_the_checks():
    for material in (litz.COPPER, litz.SILVER, litz.STEEL):
        for card in material.cards():
            check_card(*card)
        again = litz.Material(material.name, material.young, material.poisson, material.conductivity, units="SI")
        assert again == material
    assert litz.Interaction(conductance=litz.HertzSpot()) == parts.HERTZ_AND_HOLM


# Mistakes


@pytest.fixture
def built():
    model, lower, upper, step = crossed()
    return {"model": model, "lower": lower, "upper": upper, "step": step, "litz": litz, "np": np, "WIRE": WIRE}


@pytest.mark.parametrize(
    ("mistake", "message"),
    [
        ("model.wire('lower', (0, 0, 0), (1, 0, 0), elements=3, **WIRE)", "a group or set lower already"),
        ("model.wire('A', (0, 0, 0), (1, 0, 0), elements=0, **WIRE)", "whole number of 1 or more, not 0"),
        ("model.wire('A', (0, 0, 0), (1, 0, 0), **WIRE)", "elements is needed"),
        ("model.wire('A', (0, 0, 0), elements=2, **WIRE)", "from start to end, along points, or along a curve"),
        ("model.wire('A', (0, 0, 0), (0, 0, 0), elements=2, **WIRE)", "coincide"),
        ("model.wire('A', (0, 0), (1, 0), elements=2, **WIRE)", "start must be a position"),
        ("model.wire('A', (0, 0, np.nan), (1, 0, 0), elements=2, **WIRE)", "start must be a position"),
        ("model.wire('A', lower.ends, (1, 0, 0), elements=2, **WIRE)", "an end of a wire is one node"),
        ("model.wire('A', points=[(0, 0, 0)], **WIRE)", r"shape \(n, 3\)"),
        ("model.wire('A', points='line', **WIRE)", "points must be numbers"),
        ("model.wire('A', curve=lambda t: t, elements=2, **WIRE)", "must return the position"),
        ("model.wire('A', curve=lambda t: (t, 0, 0), span=(1, 1), elements=2, **WIRE)", "span must be"),
        ("model.wire('A', curve=lambda t: (t, 0, 0), elements=2, closed=True, **WIRE)", "1 m apart"),
        (
            "model.wire('A', points=[(0, 0), (1, 0), (1, 1)], elements=1, **WIRE)",
            "2 sides needs at least as many elements",
        ),
        ("model.wire('A', points=[(0, 0), (1, 0)], elements=3, spline=True, **WIRE)", "3 or more points"),
        ("model.wire('A', (0, 0, 0), (1, 0, 0), elements=2, radius=-1, material='COPPER')", "radius .* greater than 0"),
        ("model.wire('A', (0, 0, 0), (1, 0, 0), elements=2, material='COPPER')", "either a radius or a section"),
        ("model.wire('A', (0, 0, 0), (1, 0, 0), elements=2, section=1e-3, material='COPPER')", "Circular"),
        ("model.wire('A', (0, 0, 0), (1, 0, 0), elements=2, radius=1, material='COPER')", "did you mean 'COPPER'"),
        ("model.wire('A', (0, 0, 0), (1, 0, 0), elements=2, element='B32', **WIRE)", "B31 or B33, not 'B32'"),
        ("model.wire('A,B', (0, 0, 0), (1, 0, 0), elements=2, **WIRE)", "commas"),
        ("model.wires('A', [], **WIRE)", "at least one wire"),
        ("model.elements('A', [(1, 99)], **WIRE)", "nodes 1 to 20; found 1 to 99"),
        ("model.elements('A', [(1, 1)], **WIRE)", "joins a node with itself"),
        ("model.nodes([1, 2])", "positions"),
        ("model.material('COPPER', young=1.0, poisson=0.3)", "another material of the name COPPER"),
        ("model.material('A', young=1.0, poisson=0.5)", "between -1 and 0.5"),
        ("model.contact('LOWR')", "did you mean 'LOWER'"),
        ("model.contact(lower, behaviour='hertz')", r"Hertz\(\), Linear"),
        ("model.contact(lower, conductance='HERTZ')", r"HertzSpot\(\), PaperSpot"),
        ("model.contact(lower, friction=-0.1)", "mu of .* 0 or greater"),
        ("model.contact(lower, friction=0.1, interaction=litz.Interaction())", "not both"),
        ("model.contact(upper, lower)", "a contact of UPPER with LOWER already"),
        ("model.contact(lower, friction=0.1, name='TOUCH')", "another interaction of the name TOUCH"),
        ("model.fix('UPER_ENDS')", "did you mean 'UPPER_ENDS'"),
        ("model.fix(upper.ends, 'w')", "a direction must be one of"),
        ("model.fix(21)", "nodes 1 to 20, not 21"),
        ("model.fix([])", "no nodes"),
        ("model.node_set('UPPER', [1])", "already"),
        ("model.node_set('A', [])", "no members"),
        ("model.element_set('A', [19])", "elements 1 to 18, not 19"),
        ("model.amplitude('A', [0, 0], [1, 1])", "must ascend"),
        ("model.amplitude('A', [0, 1], [1])", "a factor for each time"),
        ("model.amplitude('A', [0, 1], [1, 1], time='CLOCK')", "STEP TIME or TOTAL TIME"),
        ("model.step(increments=0.1)", "did you mean 'increment'"),
        ("model.step('STEP1')", "a step STEP1 already"),
        ("model.step(total=0)", "greater than 0"),
        ("model.step(increment=2)", "larger than the step"),
        ("model.step(first=0.1, largest=0.05)", "smallest <= first <= largest"),
        ("model.step(increment=0.001, inc=20)", "needs at least 1000 increments, but inc allows 20"),
        ("model.step(cload_op='ADD')", "MOD or NEW"),
        ("model.press(1e-3)", "no guides"),
        ("model.card('STATIC')", "belongs in a step"),
        ("model.card('DAMPING')", "no keyword"),
        ("step.card('NODE')", "model part"),
        ("step.move(upper.ends, 'up', 1.0)", "a direction must be one of"),
        ("step.move(upper.ends, 9, 1.0)", "a direction must be one of"),
        ("step.move(upper.ends, 'z', '1')", "finite number, not '1'"),
        ("step.force(upper.ends, 'rx', 1.0)", "a direction must be one of"),
        ("step.potential(upper.ends, float('inf'))", "finite number"),
        ("step.potential(upper.ends, 1.0, amplitude='RAMP')", "no amplitude 'RAMP'"),
        ("step.boundary(upper.ends, 3, 1)", "comes before"),
        ("step.node_print(upper, 'RFF')", "U, UR, RF"),
        ("step.node_print(upper)", "needs the values quantity"),
        ("step.node_print(upper, 'U', totals='SUM')", "YES, NO or ONLY"),
        ("step.el_print('UPPER_ENDS', 'SF')", "no element set"),
        ("step.controls('fields')", "FIELD, TIME INCREMENTATION"),
        ("step.controls('field', i_c=3)", "has no i_c"),
        ("step.controls('time incrementation', i_0=3)", "does not use I_0"),
        ("step.solver('PARDISO')", "BLOCK, UMFPACK, SKYLINE or MUMPS"),
        ("step.node_file(frequency=0)", "greater than 0"),
        ("litz.Model('A', units='cgs')", 'must be "SI" or labels'),
        ("litz.Model('A').to_deck()", "no wires"),
        ("litz.Model('A').wire('B', (0, 0, 0), (1, 0, 0), elements=1, **WIRE) and litz.Model('A').run('x')", "no step"),
        ("litz.Model('A').contact(lower)", "belongs to another model"),
        ("litz.General(1, 1, 1, 1, n1=(1, 0))", "n1z is missing"),
        (
            "litz.General(1, 1, 1, 1, shear=(1e4,))",
            "two stiffnesses greater than 0, along the first and the second axis",
        ),
        ("litz.General(1, 1, 1, 1, shear=(0, 1e4))", "two stiffnesses greater than 0"),
        ("litz.Circular(1e-3, conduction='PRESENT')", "REFERENCE LENGTH or CURRENT LENGTH"),
        ("litz.NamedBehaviour('GREENWOOD')", "PRESSURE-OVERCLOSURE of .* must be LINEAR or HERTZ"),
        ("litz.NamedSpot('GREENWOOD')", "LAW of .* must be PAPER, HERTZ"),
        ("litz.Linear(0)", "greater than 0"),
        ("litz.TableSpot([1, 1], [2, 3])", "must ascend"),
        ("litz.TableSpot([1, 2], [2])", "as many resistances"),
        ("litz.Friction(0.1, elastic_slip=1e-6, stick_stiffness=1e6)", "not both"),
        ("litz.Friction(0.1, elastic_slip=0)", "greater than 0"),
        ("litz.Friction(0.1, heat_fraction=2)", "from 0 to 1"),
        ("litz.GapConductance('HERTZ')", "LAW of .* must be CONDUCTIVITY"),
        ("litz.Interaction(heat=0.1)", "heat must be None or GapConductance"),
        ("litz.Material('', young=1, poisson=0)", "may not be empty"),
    ],
)
def test_errors_are_raised_immediately(built, mistake, message):
    with pytest.raises(ValueError, match=message):
        eval(mistake, built)


def test_what_is_refused_leaves_no_trace(built):
    before = built["model"].to_deck()
    for mistake in (
        "model.wire('A', (0, 0, 0), (1, 0, 0), elements=2, element='B32', **WIRE)",
        "model.wire('LOWER', (0, 0, 0), (1, 0, 0), elements=2, **WIRE)",
        "model.contact('LOWER', friction=-1)",
        "step.move('UPPER', 'z', np.nan)",
        "model.fix('LOWER', 'w')",
    ):
        with pytest.raises(ValueError, match=r"."):
            eval(mistake, built)
    assert built["model"].to_deck() == before


def test_op_new_without_a_value_removes_the_loads_of_earlier_steps(built):
    model = built["model"]
    model.step(cload_op="NEW")
    last = model.to_deck().rpartition("*STEP")[2]
    assert [line for line in last.splitlines() if "CLOAD" in line] == ["*CLOAD, OP=NEW"]
    assert "*BOUNDARY" not in last


# Rigid bodies


def bundle():
    model = litz.Model("a pair")
    axes = [[(0, y, 0), (0.05, y, 0), (0.1, y, 0)] for y in (-1.5e-3, 1.5e-3)]
    return model, model.wires("PAIR", axes, **WIRE)


def test_nodes_move_with_a_new_node_or_one_of_the_model(litz_program, tmp_path):
    model, pair = bundle()
    clamp = model.rigid_body((0.1, 0, 0), tie=pair.end)
    assert (clamp, model.x[clamp - 1].tolist()) == (7, [0.1, 0, 0])
    assert model.rigid_body(1, tie=[4], pin=[5]) == 1
    assert model.rigid_body(model.nodes([(0, 0, 0.01)]), pin=[2]) == 8
    model.fix(clamp)
    model.fix(pair.start, "potential")
    model.step().move(1, "rx", 0.1)
    cards = deck_of(model).find("RIGID BODY")
    assert [card["REF NODE"] for card in cards] == [7, 1, 8]
    assert [list(card.parameters) for card in cards] == [
        ["REF NODE", "TIE NSET"],
        ["REF NODE", "TIE NSET", "PIN NSET"],
        ["REF NODE", "PIN NSET"],
    ]
    (tmp_path / "deck.inp").write_text(model.to_deck())
    done = subprocess.run([litz_program, "check", tmp_path / "deck.inp"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "rigid body of reference node 7: 2 nodes tied, 0 pinned" in done.stdout


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ("model.rigid_body(1)", "needs nodes that follow its reference node"),
        ("model.rigid_body(pair.end, tie=[1])", "one reference node, not <Nodes PAIR_END"),
        ("model.rigid_body(99, tie=[1])", "there are nodes 1 to 6, not 99"),
        ("model.rigid_body((0, 0), tie=[1])", r"points must be finite positions, an array of shape \(n, 3\)"),
        ("model.rigid_body(1, tie='PAIRS')", "there is no node set 'PAIRS'; did you mean 'PAIR'"),
    ],
)
def test_a_rigid_body_needs_one_reference_node_and_others(call, message):
    model, pair = bundle()
    with pytest.raises(ValueError, match=message):
        eval(call, {"model": model, "pair": pair})

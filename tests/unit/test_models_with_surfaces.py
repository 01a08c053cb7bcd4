"""Rigid surfaces in models of Python."""

import subprocess

import numpy as np
import pytest

import litz

WIRE = {"radius": 1e-3, "material": litz.COPPER}


def deck_of(model):
    return litz.Deck.parse(model.to_deck())


def beam():
    model = litz.Model("a wire under a plate")
    return model, model.wire("WIRE", (-0.05, 0, 0), (0.05, 0, 0), elements=10, **WIRE)


def test_surfaces_stand_in_the_deck_as_they_were_given():
    model, _ = beam()
    model.plane("TABLE", (0, 0, -1e-3), (0, 0, 1))
    model.cylinder("DRUM", (0, 0, 0.011), (0, 2, 0), 0.01, reference=(0, 0, 0.011))
    model.bore("JACKET", (0, 0, 0), (1, 0, 0), 0.02, reference=1)
    cards = deck_of(model).find("RIGID SURFACE")
    assert [dict(card.parameters) for card in cards] == [
        {"NAME": "TABLE", "TYPE": "PLANE"},
        {"NAME": "DRUM", "TYPE": "CYLINDER", "REF NODE": 12},
        {"NAME": "JACKET", "TYPE": "BORE", "REF NODE": 1},
    ]
    assert [card.data[0] for card in cards] == [
        [0, 0, -1e-3, 0, 0, 1],
        [0, 0, 0.011, 0, 2, 0, 0.01],
        [0, 0, 0, 1, 0, 0, 0.02],
    ]
    assert model.x[11].tolist() == [0, 0, 0.011]


def test_a_surface_stands_for_its_reference_node():
    model, wire = beam()
    plate = model.plane("PLATE", (0, 0, 1e-3), (0, 0, -1), reference=(0, 0, 0.01))
    model.contact(wire, plate)
    model.fix(plate, "x", "y", "rotations")
    step = model.step()
    step.move(plate, "z", -1e-4)
    step.force(plate, "x", 2.0)
    step.node_print(plate, "RF")
    deck = deck_of(model)
    assert deck.card("BOUNDARY", step=1).data == [[12, 3, 3, -1e-4]]
    assert deck.card("CLOAD", step=1).data == [[12, 1, 2.0]]
    assert deck.card("NODE PRINT", step=1)["NSET"] == "PLATE_NODE"
    assert deck.card("NSET", nset="PLATE_NODE").data == [[12]]


def test_the_program_reads_what_a_model_says_of_surfaces(litz_program, tmp_path):
    model, wire = beam()
    table = model.plane("TABLE", (0, 0, -1e-3), (0, 0, 1))
    drum = model.cylinder("DRUM", (0, 0, 0.011), (0, 1, 0), 0.01, reference=(0, 0, 0.011))
    jacket = model.bore("JACKET", (0, 0, 0), (1, 0, 0), 0.02)
    first = model.contact(wire, table, friction=0.2)
    model.contact([wire], drum, behaviour=litz.Linear(line_penalty=1e10))
    model.contact(wire, "jacket", friction=0.2)
    assert [pair.second for pair in model.contacts] == ["TABLE", "DRUM", jacket.name]
    # equal laws are one interaction, for wires and for surfaces
    assert [one.name for one in model.interactions] == [first.interaction.name, "TOUCH2"]
    model.fix(wire.ends)
    model.fix(drum)
    model.fix(wire.start, "potential")
    model.step().move(drum, "z", -1e-4)
    deck = model.write(tmp_path / "deck.inp")
    done = subprocess.run([litz_program, "check", deck], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    for name in ("TABLE", "DRUM", "JACKET"):
        assert name in done.stdout


def test_current_and_heat_pass_to_the_reference_node_of_a_surface(litz_program, tmp_path):
    model, wire = beam()
    plate = model.plane("PLATE", (0, 0, -1e-3), (0, 0, 1), reference=(0, 0, -2e-3))
    heat = litz.GapConductance("TABLE", [[100, 1], [1000, 5]], per_length=True)
    model.contact(wire, plate, conductance=litz.ConstantSpot(1e-4, per_length=True), heat=heat)
    model.fix(wire.ends)
    model.fix(plate)
    model.fix(plate, "potential")
    model.step()
    deck = deck_of(model)
    assert deck.card("GAP ELECTRICAL CONDUCTANCE")["PER"] == deck.card("GAP CONDUCTANCE")["PER"] == "LENGTH"
    done = subprocess.run(
        [litz_program, "check", model.write(tmp_path / "deck.inp")], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "the rigid surface PLATE: TOUCH, Hermite axis" in done.stdout
    assert "spot CONSTANT with R_c = 1e-04" in done.stdout


def test_a_linear_law_has_a_penalty_for_crossings_for_lines_or_both():
    assert litz.Linear(1e5).card()[2] == [[1e5]]
    assert litz.Linear(1e5, line_penalty=1e10).card()[2] == [[1e5, 1e10]]
    assert litz.Linear(line_penalty=1e10).card()[2] == [[None, 1e10]]
    with pytest.raises(ValueError, match="a penalty, a line_penalty, or both"):
        litz.Linear()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        ("model.plane('P', (0, 0), (0, 0, 1))", "the point of a surface must be three finite numbers"),
        ("model.plane('P', (0, 0, 0), (0, 0, 0))", "the direction of the surface P cannot be 0 0 0"),
        ("model.cylinder('P', (0, 0, 0), (0, 0, 1), -1)", "greater than 0"),
        ("model.plane('WIRE', (0, 0, 0), (0, 0, 1))", "there is a group or set WIRE already"),
        ("model.plane('Table', (0, 0, 0), (0, 0, 1))", "there is a rigid surface Table already"),
        ("model.wire('TABLE', (0, 0, 1), (1, 0, 1), elements=1, **WIRE)", "there is a rigid surface TABLE already"),
        ("model.plane('P', (0, 0, 0), (0, 0, 1), reference=wire.ends)", "a rigid surface has one reference node"),
        ("model.plane('P', (0, 0, 0), (0, 0, 1), reference=99)", "there are nodes 1 to 11, not 99"),
        ("model.fix(table)", "the surface TABLE is fixed in space"),
        ("model.contact(table, wire)", "the wires come first"),
        (
            "model.contact(wire, table, conductance=litz.HertzSpot())",
            "current passes to the rigid surface TABLE along a line",
        ),
        (
            "model.contact(wire, table, interaction=litz.Interaction(conductance=litz.HertzSpot()))",
            "possible are ConstantSpot and TableSpot with per_length=True",
        ),
        (
            "model.contact(wire, table, heat=litz.GapConductance('METAL'))",
            "heat passes to the rigid surface TABLE along a line",
        ),
        (
            "model.contact(wire, table, conductance=litz.ConstantSpot(1e-3, per_length=True))",
            "current passes to the reference node of the rigid surface TABLE: give it a reference",
        ),
        ("model.contact(wire, table, behaviour=litz.Linear(1e5))", "along a line: Linear needs its line_penalty"),
        ("model.contact(wire, table, interference_fit=True)", "interference_fit is for wires"),
        ("model.contact(wire, other)", "the rigid surface TABLE belongs to another model"),
        ("[model.contact(wire, table) for _ in range(2)]", "there is a contact of WIRE with TABLE already"),
    ],
)
def test_what_is_wrong_with_a_surface_is_said(call, message):
    model, wire = beam()
    table = model.plane("TABLE", (0, 0, -1e-3), (0, 0, 1))
    other = beam()[0].plane("TABLE", (0, 0, -1e-3), (0, 0, 1))
    with pytest.raises(ValueError, match=message):
        eval(call, {"model": model, "wire": wire, "table": table, "other": other, "litz": litz, "WIRE": WIRE})


def test_plates_just_touch_the_wires_of_a_model():
    """Wires that cross at the height of two radii, and a bow whose top lies between its nodes."""
    model = litz.Model("crossed")
    model.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), elements=4, **WIRE)
    model.wire("BOW", curve=lambda t: (0, 0.02 * np.sin(t), 0.02 * np.cos(t)), span=(-1, 1), elements=9, **WIRE)
    lower, upper = litz.build.press_plates(model, friction=0.1)
    assert lower.point[2] == pytest.approx(-1e-3, abs=1e-12)
    # the top of the bow on its cubic axis, `R angle^4/128` below the circle
    assert upper.point[2] == pytest.approx(0.021, abs=0.02 * (2 / 9) ** 4 / 100)
    assert (lower.direction, upper.direction) == ((0, 0, 1), (0, 0, -1))
    assert (lower.node, tuple(model.x[upper.node - 1])) == (None, upper.point)
    assert [(pair.first, pair.second) for pair in model.contacts] == [
        ("LOWER_BOW", "PLATE_1"),
        ("LOWER_BOW", "PLATE_2"),
    ]
    # free along z only
    assert [(held.first, held.last) for held in model.supports if held.target == upper.node] == [(1, 2), (4, 6)]
    only = litz.Model("one of two")
    other = only.wire("OTHER", (0, 0, 1), (1, 0, 1), elements=1, **WIRE)
    only.wire("FAR", (0, 0, 5), (1, 0, 5), elements=1, **WIRE)
    low, high = litz.build.press_plates(only, other, axis="y", clearance=1e-4)
    assert (low.point[1], high.point[1]) == pytest.approx((-1.1e-3, 1.1e-3))
    assert {pair.first for pair in only.contacts} == {"OTHER"}


@pytest.mark.parametrize(
    ("options", "message"),
    [({"axis": "up"}, 'axis must be "x", "y" or "z"'), ({"clearance": -1e-3}, "clearance must not be negative")],
)
def test_plates_need_an_axis_and_room(options, message):
    model, _ = beam()
    with pytest.raises(ValueError, match=message):
        litz.build.press_plates(model, **options)
    with pytest.raises(ValueError, match="no wires that plates could press"):
        litz.build.press_plates(litz.Model("nothing"))

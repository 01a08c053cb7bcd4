"""Cells of cables with periodic ends: lays by which ends fit, and equations that tie them."""

from dataclasses import replace

import numpy as np
import pytest

from litz import Circular, FilmSpot, Interaction, Linear, Material, build

PLAN = {"radius": 0.41e-3, "ends": "periodic"}


def ends_of(model, length):
    """Where wires begin, and where they end, moved down by the length."""
    wires = [wire for name, group in model.groups.items() if "BEYOND" not in name for wire in group.wires]
    starts, ends = (np.array([model.x[wire.nodes[k] - 1] for wire in wires]) for k in (0, -1))
    return starts, ends - (0, 0, length)


@pytest.mark.parametrize(
    ("stages", "lays", "length", "fit"),
    [
        # positions have eight digits
        ([[3]], [80e-3], 80e-3 / 3, 1e-9),
        ([[1, 6]], [[45e-3]], 15e-3, 1e-9),
        ([[3], [3]], [20e-3, 40e-3], 40e-3 / 3, 1e-9),
        # bundles within bundles differ in length, and have as many turns
        ([[3], [3], [5]], [80e-3, 140e-3, 190e-3], 190e-3, 1e-8),
    ],
)
def test_wires_end_where_others_begin(stages, lays, length, fit):
    model = build.cable(stages, lay_lengths=lays, length=length, **PLAN)
    starts, ends = ends_of(model, length)
    distance = np.linalg.norm(ends[:, None] - starts[None], axis=2)
    assert distance.min(axis=1).max() < fit
    assert sorted(distance.argmin(axis=1)) == list(range(len(starts)))
    deck = model.to_deck()
    assert deck.count("*EQUATION") >= 1
    assert "lay of" in deck


def test_a_lay_is_changed_so_that_ends_fit():
    model = build.cable([[3]], lay_lengths=[80e-3], length=28e-3, **PLAN)
    assert any("lay of 0.084 m, for 0.08" in comment for comment in model.comments)


def test_strands_of_two_materials_need_whole_turns():
    bronze = build.Material("BRONZE", young=110e9, poisson=0.34, conductivity=9e6)
    mixed = {"material": [[bronze, bronze, build.COPPER]], "lay_lengths": [80e-3]}
    build.cable([[3]], length=80e-3, **mixed, **PLAN)
    with pytest.raises(ValueError, match=r"0\.3333 turns from end to end; periodic ends need a whole number of turns:"):
        build.cable([[3]], length=80e-3 / 3, **mixed, **PLAN)


def test_a_length_that_does_not_fit_is_said():
    with pytest.raises(
        ValueError, match=r"whole number of turns over 3: .* A length of .* or 1\.333 times this one fits"
    ):
        build.cable([[3]], lay_lengths=[80e-3], length=20e-3, **PLAN)
    with pytest.raises(ValueError, match=r"stages of one layer of bundles, stage 2 has 2"):
        build.cable([[3], [1, 6]], lay_lengths=[20e-3, [40e-3]], length=40e-3, **PLAN)


def test_a_jacket_takes_the_place_of_what_holds_a_cell_across():
    model = build.cable([[3]], lay_lengths=[80e-3], length=80e-3 / 3, **PLAN)
    held = model.groups["LAYER1"].wires[0].nodes[0]

    def directions():
        return sorted(k for one in model.supports if one.target == held for k in range(one.first, one.last + 1))

    assert directions() == [1, 2, 3, 6]
    build.compact(model, 0.35)
    assert directions() == [3]


def test_wires_of_two_stages_go_on_beyond_the_ends_as_images():
    length = 40e-3 / 3
    model = build.cable([[3], [3]], lay_lengths=[20e-3, 40e-3], length=length, **PLAN)
    wires = list(model.groups["LAYER1"].wires)
    nodes = {(round(x, 8), round(y, 8), round(z, 8)) for x, y, z in model.x[: wires[-1].nodes[-1]]}
    for name, sense in (("BEYOND_PLUS", 1), ("BEYOND_MINUS", -1)):
        group = model.groups[f"{name}_LAYER1"]
        assert len(group.elements) == 2 * len(wires)
        # each element leads on upwards, from or to the end of a wire
        joints = {node for wire in wires for node in (wire.nodes[-1] if sense > 0 else wire.nodes[0],)}
        assert joints == set(group.connectivity[:, (1 - sense) // 2].tolist()) & joints
        assert (np.diff(model.x[group.connectivity - 1], axis=1)[:, 0, 2] > 0).all()
        # and lies where another one lies in the cell, within the round-off of positions of eight digits
        beyond = model.x[sorted(set(group.nodes) - joints)[0] - 1 : max(group.nodes)] - (0, 0, sense * length)
        inside = np.array(sorted(nodes))
        assert np.linalg.norm(beyond[:, None] - inside[None], axis=2).min(axis=1).max() < 1e-7
    assert [pair.interaction.name for pair in model.contacts] == ["TOUCH", "TOUCH", "BEYOND", "BEYOND"]


@pytest.mark.parametrize(
    ("stages", "lays", "length", "beyond"),
    [
        ([[3]], [80e-3], 80e-3 / 3, False),
        ([[1, 6]], [[45e-3]], 15e-3, False),
        ([[1, 6, 12]], [[45e-3, -45e-3]], 7.5e-3, True),
    ],
)
def test_wires_go_on_where_they_cross_others(stages, lays, length, beyond):
    model = build.cable(stages, lay_lengths=lays, length=length, **PLAN)
    assert any(name.startswith("BEYOND") for name in model.groups) == beyond


def test_a_jacket_is_on_the_wires_of_the_cell_alone():
    """But for the axes at the ends, which there follow what lies beyond them: 1e-4 of the radius."""
    model = build.cable([[3], [3]], lay_lengths=[20e-3, 40e-3], length=40e-3 / 3, **PLAN)
    plain = build.cable([[3], [3]], radius=0.41e-3, lay_lengths=[20.2576e-3, 40e-3], length=40e-3 / 3, ends="sliding")
    for one in (model, plain):
        build.compact(one, 0.48)
    assert model.contacts[-1].first == "LAYER1"
    assert model.surfaces["JACKET"].radius == pytest.approx(plain.surfaces["JACKET"].radius, rel=2e-4)
    shrunk = [one.amplitudes["JACKET"].a[-1] for one in (model, plain)]
    assert shrunk[0] == pytest.approx(shrunk[1], rel=2e-4)


def test_images_conduct_and_weigh_nothing():
    """They are wires of the same metal and radius that have next to no stiffness, mass and store of heat."""
    metal = Material("METAL", 110e9, 0.34, 9e6, thermal_conductivity=90.0, density=8900.0, specific_heat=380.0)
    model = build.cable([[3], [3]], lay_lengths=[20e-3, 40e-3], length=40e-3 / 3, material=metal, **PLAN)
    for name in ("BEYOND_PLUS_LAYER1", "BEYOND_MINUS_LAYER1"):
        image = model.groups[name]
        assert image.section == Circular(PLAN["radius"], stiffness=1e-5)
        assert replace(image.material, name="METAL", density=8900.0) == metal
        assert image.material.density == pytest.approx(1e-9 * 8900.0)
    insulator = Material("METAL", 110e9, 0.34)
    model = build.cable([[3], [3]], lay_lengths=[20e-3, 40e-3], length=40e-3 / 3, material=insulator, **PLAN)
    assert replace(model.groups["BEYOND_PLUS_LAYER1"].material, name="METAL") == insulator


def test_temperatures_of_a_step_are_those_of_images_too():
    model = build.cable([[3], [3]], lay_lengths=[20e-3, 40e-3], length=40e-3 / 3, **PLAN)
    group = model.groups["LAYER1"]
    model.initial_temperature(300.0, group)
    model.step("COOL").temperature(group, 4.0)
    model.step("WARM").temperature(group.wires[0].nodes[1], 300.0)
    assert [one.target for one in model.steps[0].temperatures] == ["LAYER1", "IMAGES_LAYER1"]
    beyond = {node for name, one in model.groups.items() if name.startswith("BEYOND") for node in one.nodes}
    assert set(model.node_sets["IMAGES_LAYER1"]) == beyond - set(group.nodes) == set(model.images)
    one, images = (item.target for item in model.steps[1].temperatures)
    assert {model.images[node] for node in model.nodes_of(images)} == {one}


@pytest.mark.parametrize("wrap", [build.Wrap(0.1e-3, 5.3e-7), Interaction("TAPE", Linear(2e6, line_penalty=2e9))])
def test_bundles_touch_across_the_ends_as_they_do_within(wrap):
    film = Interaction(conductance=FilmSpot(1e-11))
    model = build.cable(
        [[3], [3]], lay_lengths=[20e-3, 40e-3], length=40e-3 / 3, interaction=film, wrap=wrap, **PLAN
    )  # fmt: skip
    elements = model.groups["BEYOND_PLUS_LAYER1"].elements
    joints = {wire.nodes[-1]: wire for wire in model.groups["LAYER1"].wires}
    parts = [model.elements_of(f"BEYOND_PLUS_BUNDLE{number}") for number in (1, 2, 3)]
    assert sorted(one for part in parts for one in part) == sorted(elements)
    for number, part in enumerate(parts, start=1):
        own = set(model.elements_of(f"BUNDLE{number}"))
        # each goes on from a wire of its bundle
        first = model.groups["BEYOND_PLUS_LAYER1"].connectivity[np.isin(elements, part)][::2, 0]
        assert {joints[node].elements[0] for node in first.tolist()} <= own
    laws = {(pair.first, pair.second): pair.interaction.name for pair in model.contacts}
    name = laws["BUNDLE1", "BUNDLE2"]
    assert name == ("TAPE" if isinstance(wrap, Interaction) else "WRAP")
    across = {first: second for first, second in laws if second and "BEYOND_PLUS_BUNDLE" in second}
    assert set(across) == {"BUNDLE1", "BUNDLE2", "BUNDLE3"}
    assert all(laws[pair] == name for pair in across.items())
    for number, second in enumerate(across.values(), start=1):
        others = [one for other, part in enumerate(parts, start=1) for one in part if other != number]
        assert sorted(model.elements_of(second)) == sorted(others)

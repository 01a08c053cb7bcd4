"""Jackets that shrink around wires, and mandrels that grow: radii of rigid surfaces over time."""

import numpy as np
import pytest

import litz
from test_restart import KEEP_ALL, assert_goes_on_from_everywhere
from test_rigid_surfaces import ELASTIC, HERTZ, STIFF, along_x, step, surface, wire

RADIUS, BORE = 5e-4, 2e-3
FRICTION = "*FRICTION\n 0.4\n"


def amplitude(*corners, time="TOTAL TIME"):
    """Of the radius of a surface."""
    return f"*AMPLITUDE, NAME=R, TIME={time}\n" + "".join(f" {t}, {factor:.17g}\n" for t, factor in corners)


def jacket(radius, factors=None, shape="BORE", laws=HERTZ):
    """Around the x axis; `factors`: of its radius at the times 0, 1, 2 ..."""
    words = surface(shape, f"0, 0, 0, 1, 0, 0, {radius:.17g}", laws=laws)
    if factors is None:
        return words
    return amplitude(*enumerate(factors)) + words.replace(f"TYPE={shape}", f"TYPE={shape}, RADIUS AMPLITUDE=R")


def straight(height):
    """A wire along x at this height, held everywhere."""
    return wire(along_x(0.016, 4, height), RADIUS) + "*BOUNDARY\n W, 1, 2\n W, 4, 6\n"


HELD = step("*BOUNDARY\n W, 3, 3, 0\n")


def total_force(results, increment=-1):
    return results.surface_contacts_at(increment)["force"].sum()


@pytest.mark.parametrize(("shape", "side"), [("BORE", -1), ("CYLINDER", 1)])
@pytest.mark.parametrize("laws", [HERTZ, STIFF])
def test_a_surface_that_comes_to_a_wire_presses_as_one_that_the_wire_comes_to(run, shape, side, laws):
    """The same radius and the same place: the same force per length, whoever has moved."""
    depth = 1e-6
    height = BORE + side * RADIUS
    final = BORE + side * depth
    _, grown = run(straight(height) + jacket(BORE, (1, final / BORE), shape, laws) + HELD, name="grown")
    moved_wire = step(f"*BOUNDARY\n W, 3, 3, {-side * 1e-5:.17g}\n")
    away = straight(height + side * 1e-5) + jacket(final, None, shape, laws)
    _, pushed = run(away + moved_wire, name="pushed")
    assert total_force(grown) == pytest.approx(total_force(pushed), rel=1e-9)
    assert total_force(grown) > 1


def test_what_a_jacket_does_as_it_shrinks_is_the_energy_of_the_contact(run):
    """By the mean of the forces of an increment: four times better with increments half as long."""
    errors = []
    for n in (4, 8, 16):
        static = f"{1 / n}, 1, {1 / n}, {1 / n}"
        deck = straight(BORE - RADIUS) + jacket(BORE, (1, 0.999))
        _, results = run(deck + step("*BOUNDARY\n W, 3, 3, 0\n*ENERGY PRINT\n", static), name=f"work{n}")
        work, energy = (results.history[name][-1] for name in ("ALLWK", "ALLCCE"))
        errors.append(work / energy - 1)
    assert abs(errors[-1]) < 1e-2
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.3)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.3)


def test_a_wire_that_goes_with_the_wall_of_its_jacket_does_not_rub(run):
    """It moves across the axis as far as the wall does. One that stays where it is along the axis and around it does
    not rub either, but for its overlap; one that is moved around does."""
    shrink = 0.99
    way = -(1 - shrink) * BORE
    start = straight(BORE - RADIUS + 1e-6) + jacket(BORE, (1, 1, shrink), laws=HERTZ + FRICTION)
    press = step("*BOUNDARY\n W, 3, 3, 0\n")
    forces = {}
    for name, words in {
        "along": f" W, 3, 3, {way:.17g}\n",
        "around": f" W, 3, 3, {way:.17g}\n W, 2, 2, 1e-4\n",
    }.items():
        process, results = run(start + press + step(f"*BOUNDARY\n{words}", "0.1, 1"), name=name)
        assert process.returncode == 0, process.stderr
        table = results.surface_contacts_at(-1)
        on_wall, normal = (
            np.transpose([table[f"{what}_{axis}"] for axis in "xyz"]) for what in ("surface_force", "normal")
        )
        friction = on_wall - normal * (on_wall * normal).sum(axis=1, keepdims=True)
        forces[name] = np.linalg.norm(friction.sum(axis=0)) / table["force"].sum()
    assert forces["along"] < 1e-6
    assert forces["around"] == pytest.approx(0.4, rel=1e-3)


def test_a_run_with_a_jacket_that_shrinks_goes_on_from_everywhere(litz, tmp_path):
    deck = straight(BORE - RADIUS) + jacket(BORE, (1, 0.9995, 0.999), laws=HERTZ + FRICTION)
    steps = step(f"*BOUNDARY\n W, 3, 3, 0\n{KEEP_ALL}") + step(f"*BOUNDARY\n W, 3, 3, 0\n{KEEP_ALL}")
    assert_goes_on_from_everywhere(litz, tmp_path, deck + steps)


@pytest.mark.parametrize("other", [(1, 0.9995, 0.9991), None])
def test_a_run_goes_on_with_the_same_radii_only(litz, tmp_path, other):
    rest = step(f"*BOUNDARY\n W, 3, 3, 0\n{KEEP_ALL}") + HELD
    (tmp_path / "deck.inp").write_text(straight(BORE - RADIUS) + jacket(BORE, (1, 0.9995, 0.999)) + rest)
    done = litz("run", "deck.inp", "-o", "kept", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    (tmp_path / "other.inp").write_text(straight(BORE - RADIUS) + jacket(BORE, other) + rest)
    done = litz("run", "other.inp", "-o", "other", "--restart", "kept/deck.restart.h5:1:1", cwd=tmp_path)
    assert done.returncode == 1
    assert "the deck differs from that of the run that wrote it" in done.stderr


def conducting(deck):
    """Of a material that has temperatures over time."""
    laws = "*CONDUCTIVITY\n 400\n*DENSITY\n 8900\n*SPECIFIC HEAT\n 385\n"
    return deck.replace(ELASTIC, ELASTIC + laws)


def held_step(procedure, words=""):
    """Temperatures alone, from 1 to 2 s; the wire is warmed."""
    return f"*STEP\n{procedure}\n 0.25, 1\n*BOUNDARY\n W, 11, 11, 10\n{words}*END STEP\n"


HEAT_STEPS = ["*COUPLED THERMAL-ELECTRICAL, STEADY STATE", "*COUPLED THERMAL-ELECTRICAL"]


@pytest.mark.parametrize("procedure", HEAT_STEPS)
@pytest.mark.parametrize("factor", [0.9995, 1.0005])
def test_a_radius_stays_while_motions_are_held_and_catches_up_evenly(run, procedure, factor):
    """A free wire on the bottom of a bore carries its load whatever the amplitude does in a step of temperatures; in the
    next one that moves wires the wall comes to where the amplitude has it, and the wire goes with it."""
    deck = conducting(straight(-BORE + RADIUS - 1e-8)) + jacket(BORE, (1, 1, factor, factor), laws=STIFF)
    load = "*CLOAD\n W, 3, -2\n"
    process, results = run(deck + step(load, "1, 1") + held_step(procedure) + step(load))
    assert process.returncode == 0, process.stderr
    loaded, last = np.searchsorted(results.times, [1, 2])
    at_once = results.surface_contacts_at(loaded)["force"]
    for increment in range(loaded, last + 1):
        assert results.surface_contacts_at(increment)["force"] == pytest.approx(at_once, rel=1e-12)
        assert results.rigid_surfaces["S"].radius_at(results, increment) == BORE
    part = results.times[last:] - 2
    rows = range(last, len(results.times))
    reached = [results.rigid_surfaces["S"].radius_at(results, i) / BORE for i in rows]
    assert reached == pytest.approx(1 + part * (factor - 1), rel=1e-12)
    heights = np.array([results.field("displacement", i)[:, 2].mean() for i in rows])
    assert heights - heights[0] == pytest.approx(part * (1 - factor) * BORE, rel=1e-4, abs=1e-12)
    assert total_force(results) == pytest.approx(10, rel=1e-6)


def test_a_steady_state_waits_for_the_radius_that_was_held(run):
    """END=SS ends a step once temperatures stay, but not before the wall is where its amplitude has it."""
    deck = conducting(straight(-BORE + RADIUS + 1e-6)) + jacket(BORE, (1, 1, 0.9995), laws=STIFF)
    over_time = (
        "*STEP, INC=100\n*COUPLED TEMPERATURE-DISPLACEMENT, END=SS, DELTMX=50\n 0.25, 1, , , 1\n" + "*END STEP\n"
    )
    held = "*BOUNDARY\n W, 3, 3, 0\n"
    process, results = run(deck + step(held) + held_step(HEAT_STEPS[0]) + over_time.replace("*END", held + "*END"))
    assert process.returncode == 0, process.stderr
    assert results.times[-1] == pytest.approx(3)
    assert results.rigid_surfaces["S"].radius_at(results) == pytest.approx(0.9995 * BORE, rel=1e-12)


def test_a_run_goes_on_where_a_radius_is_held(litz, tmp_path):
    deck = conducting(straight(BORE - RADIUS)) + jacket(BORE, (1, 0.9995, 0.999, 0.999), laws=HERTZ + FRICTION)
    pressed = step(f"*BOUNDARY\n W, 3, 3, 0\n{KEEP_ALL}")
    assert_goes_on_from_everywhere(litz, tmp_path, deck + pressed + held_step(HEAT_STEPS[1], KEEP_ALL) + pressed)


def test_wires_fill_a_jacket_that_is_shrunk_to_a_void_fraction(tmp_path):
    """Three wires in a bore touch each other and the wall; by symmetry each has the same force on the wall."""
    model = litz.Model("three wires in a jacket")
    copper = model.material("COPPER", young=120e9, poisson=0.34)
    reach = 2 * RADIUS / np.sqrt(3) * 1.001
    places = [(reach * np.cos(a), reach * np.sin(a)) for a in (0.3, 0.3 + 2 * np.pi / 3, 0.3 + 4 * np.pi / 3)]
    heights = np.linspace(0, 8e-3, 9)
    wires = model.wires("WIRES", [[(x, y, z) for z in heights] for x, y in places], radius=RADIUS, material=copper)
    hexagon = RADIUS * (1 + 2 / np.sqrt(3))
    shrink = model.amplitude("SHRINK", [0, 1], [1.002, 0.998], time="TOTAL TIME")
    jacket = model.bore("JACKET", (0, 0, 0), (0, 0, 1), hexagon, radius_amplitude=shrink)
    model.contact(wires, interaction=litz.Interaction("BETWEEN", friction=0.3))
    model.contact(wires, jacket, friction=0.3)
    model.fix(wires, "z", "rotations")
    step = model.step(increment=0.1)
    step.controls("STABILIZE")
    results = model.run(tmp_path)
    radii = [results.rigid_surfaces["JACKET"].radius_at(results, i) for i in (0, -1)]
    assert radii == pytest.approx([hexagon * 1.002, hexagon * 0.998], rel=1e-12)
    wall = results.surface_contacts_at(-1)
    by_wire = [wall["force"][np.isin(wall["element"], range(1 + 8 * i, 9 + 8 * i))].sum() for i in range(3)]
    assert by_wire == pytest.approx([by_wire[0]] * 3, rel=1e-6)
    between = results.contacts_at(-1)["force"].sum()
    # each wire is pushed inwards by the wall, outwards by two others at 30 degrees to that
    assert between == pytest.approx(sum(by_wire) / np.sqrt(3), rel=1e-3)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("TIME=TOTAL TIME", "TIME=STEP TIME", "the amplitude R needs TIME=TOTAL TIME"),
        ("AMPLITUDE=R", "AMPLITUDE=Q", 'there is no amplitude "Q"'),
        (" 1, 0.9", " 1, -0.9", "the factors of the amplitude R must be positive for a radius"),
        (", TYPE=BORE", ", TYPE=PLANE", "a plane has no radius; its reference node moves it"),
    ],
)
def test_what_is_wrong_with_a_radius_over_time_is_said(run, old, new, message):
    deck = straight(BORE - RADIUS) + jacket(BORE, (1, 0.9)) + HELD
    deck = deck.replace("1, 0, 0, 0.002", "1, 0, 0") if "PLANE" in new else deck
    process, _ = run(deck.replace(old, new))
    assert process.returncode == 1
    assert message in process.stderr

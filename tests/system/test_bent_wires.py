"""Wires that are bent where they cross: Hertz's contact of two tori at any angle, without a jump at nodes, and with the
forces that its energy has as wires are rolled, dragged, or bent otherwise."""

import math
from dataclasses import replace

import numpy as np
import pytest
from verification.references.hertz import bent_wires, effective_modulus

from decks import wire
from line_wires import COPPER, HERTZ, LOWER, STEEL, UPPER, material, spot, step, two_wires

R = COPPER.radius
HELD = "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, ENCASTRE\n LOWER, 9\n UPPER, 9\n"
HEAD = 3001
PRINT = "*NODE PRINT, NSET=HEAD\n U, RF, RM\n*ENERGY PRINT\n"


def arc(curvature, *, degrees=0.0, height=0.0, shift=0.0, half=12 * R, n=24, up=1):
    """Points of an arc that touches a plane at the origin and bends away from it, in a direction, moved along itself."""
    s = np.linspace(-half, half, n + 1) + shift
    along, away = (
        (np.sin(curvature * s) / curvature, (1 - np.cos(curvature * s)) / curvature) if curvature else (s, 0 * s)
    )
    yaw = math.radians(degrees)
    return np.column_stack([along * math.cos(yaw), along * math.sin(yaw), height + up * away])


def reference(force, degrees, curvature, wires):
    return bent_wires(
        force, math.radians(degrees), radius=[each.radius for each in wires], curvature=curvature,
        modulus=effective_modulus([each.young for each in wires], [each.poisson for each in wires]),
        resistivity=[each.resistivity for each in wires],
    )  # fmt: skip


def solved(outcome):
    process, results = outcome
    assert process.returncode == 0, process.stderr
    return results


@pytest.mark.parametrize("degrees", [90, 45, 20, 12, 9, 6])
@pytest.mark.parametrize(
    ("bend", "wires"),
    [((0.02, 0.02), (COPPER, COPPER)), ((0.05, 0.0), (COPPER, COPPER)), ((-0.02, 0.04), (COPPER, STEEL))],
    ids=["both", "one", "about"],
)
def test_bent_wires_touch_as_tori_do(run, degrees, bend, wires):
    """Force and resistance at an overlap, of radii of curvature down to 20 radii: away from each other, and one about the
    other. The lens is short beside the radius."""
    shallow = min(1.0, math.sin(math.radians(degrees)) / math.sin(math.radians(25))) ** 2
    overlap, curvature = 0.002 * shallow * wires[1].radius, [k / R for k in bend]
    height = wires[0].radius + wires[1].radius
    lower = arc(curvature[0], shift=0.013 * R, up=-1, n=72)
    upper = arc(curvature[1], degrees=degrees, height=height, shift=0.27 * R, n=72)
    push = f" UPPER, 3, 3, {-overlap:.17g}\n LOWER, 9, 9, 1e-3\n UPPER, 9\n"
    law = HERTZ + spot("HERTZ")
    results = solved(run(two_wires(lower, upper, HELD, step(boundary=push), law=law, wires=wires)))
    contact = results.contacts_at(-1)
    force = (overlap / reference(1.0, degrees, curvature, wires).approach) ** 1.5
    assert contact["force"].sum() == pytest.approx(force, rel=5e-4)
    resistance = reference(force, degrees, curvature, wires).resistance
    assert 1 / (1 / contact["resistance"]).sum() == pytest.approx(resistance, rel=1e-3)


@pytest.mark.parametrize("ratio", [2, 5, 10])
@pytest.mark.parametrize("degrees", [90, 75, 60, 45])
def test_bent_wires_of_unlike_radii_touch_as_tori_do(run, degrees, ratio):
    """The thin one is bent with ten of its radii: across the thick one the contact is rounder than that of any straight
    wires of these radii."""
    wires = (COPPER, replace(STEEL, radius=R / ratio))
    thin = wires[1].radius
    overlap, curvature = 0.002 * thin, [0.0, 0.1 / thin]
    lower = arc(0.0, shift=0.013 * R)
    upper = arc(
        curvature[1], degrees=degrees, height=R + thin, shift=0.27 * thin, half=6 * thin, n=12
    )  # fmt: skip
    push = f" UPPER, 3, 3, {-overlap:.17g}\n LOWER, 9, 9, 1e-3\n UPPER, 9\n"
    law = HERTZ + spot("HERTZ")
    results = solved(run(two_wires(lower, upper, HELD, step(boundary=push), law=law, wires=wires)))
    contact = results.contacts_at(-1)
    force = (overlap / reference(1.0, degrees, curvature, wires).approach) ** 1.5
    assert contact["force"].sum() == pytest.approx(force, rel=2e-3)
    resistance = reference(force, degrees, curvature, wires).resistance
    assert 1 / (1 / contact["resistance"]).sum() == pytest.approx(resistance, rel=2e-3)


def moved_by(lower, upper, *steps):
    """Two rigid wires, the upper one with its head over the origin."""
    return (
        wire("LOWER", lower, LOWER, element="B33")
        + wire("UPPER", upper, UPPER, element="B33")
        + f"*NODE, NSET=HEAD\n {HEAD}, 0., 0., {2 * R}\n*RIGID BODY, REF NODE={HEAD}, TIE NSET=UPPER\n"
        + material("LOWER", COPPER)
        + material("UPPER", COPPER)
        + f"*SURFACE INTERACTION, NAME=TOUCH\n{HERTZ}*CONTACT PAIR, INTERACTION=TOUCH\n LOWER, UPPER\n"
        + "".join(steps)
    )


def led(increments, boundary):
    size = 1 / increments
    held = "*BOUNDARY, OP=NEW\n LOWER, ENCASTRE\n LOWER, 9\n UPPER, 9\n"
    return f"*STEP, INC=1000\n*STATIC\n {size}, 1., {size / 8}, {size}\n{held}{boundary}{PRINT}*END STEP\n"


@pytest.mark.parametrize("degrees", [30, 60, 90])
def test_the_work_of_rolling_a_bent_wire_is_what_the_contact_holds(run, degrees):
    """About its tangent at the contact, from bent away to bent sideways, at an overlap that stays. The torque that belongs
    to this is the only one there."""
    lower, upper = arc(0.0, shift=0.013 * R), arc(0.05 / R, degrees=degrees, height=2 * R, shift=0.27 * R)
    yaw = math.radians(degrees)
    turns = [math.pi / 2 * math.cos(yaw), math.pi / 2 * math.sin(yaw)]
    down = f" HEAD, 1, 2\n HEAD, 3, 3, {-0.004 * R}\n"
    roll = f"{down} HEAD, 4, 4, {turns[0]:.17g}\n HEAD, 5, 5, {turns[1]:.17g}\n HEAD, 6\n"
    history = solved(run(moved_by(lower, upper, led(10, f"{down} HEAD, 4, 6\n"), led(60, roll)))).history
    rolling = history["step"] == 2
    held = history["ALLCCE"]
    # by Hertz the energy at an overlap goes with the force
    ratio = (
        reference(1.0, degrees, [0, 0.05 / R], (COPPER, COPPER)).approach
        / reference(1.0, degrees, [0, 0], (COPPER, COPPER)).approach
    )
    assert held[rolling][-1] / held[~rolling][-1] == pytest.approx(ratio**1.5, rel=1e-3)
    left_over = np.ptp(history["ETOTAL"][rolling])
    assert left_over < 0.05 * abs(held[rolling][-1] - held[~rolling][-1])


@pytest.mark.slow
def test_the_work_of_dragging_a_wire_over_waves_is_what_the_contact_holds(run):
    """From a crest, where the axis is bent away with a radius of curvature of 12 radii, to where it is straight."""
    x = np.linspace(-24 * R, 24 * R, 97)
    lower = np.column_stack([x, 0 * x, 0.3 * R * (np.cos(2 * np.pi * x / (12 * R)) - 1)])
    upper = arc(0.0, degrees=60, height=2 * R, shift=0.03 * R)
    down = f" HEAD, 2\n HEAD, 3, 3, {-0.02 * R}\n HEAD, 4, 6\n"
    drag = f" HEAD, 2\n HEAD, 4, 6\n HEAD, 1, 1, {3 * R}\n*CLOAD\n HEAD, 3, -30.\n"
    history = solved(run(moved_by(lower, upper, led(10, f"{down} HEAD, 1\n"), led(240, drag)))).history
    dragging = (history["step"] == 2) & (history["time"] > history["time"][history["step"] == 1][-1] + 0.1)
    assert np.ptp(history["ETOTAL"][dragging]) < 2e-3 * history["ALLCCE"].max()


@pytest.mark.parametrize("degrees", [30, 60])
def test_the_force_has_no_step_where_the_curvature_of_the_axis_has_one(run, degrees):
    """At a node where straight elements end and a bend begins."""
    straight = [[k * R, 0, 0] for k in range(-10, 1)]
    bend = arc(-0.05 / R, n=12, half=6 * R, shift=6 * R)[1:]
    points, forces = np.vstack([straight, bend]), []
    for place in (-1e-5, 1e-5):
        rod = arc(0.0, degrees=degrees, height=2 * R, shift=0.03 * R) + np.array([place * R, 0, 0])
        push = f" UPPER, 3, 3, {-0.005 * R}\n"
        results = solved(run(two_wires(points, rod, HELD, step(boundary=push)), name=f"at{len(forces)}"))
        forces.append(results.contacts_at(-1)["force"].sum())
    assert forces == pytest.approx([forces[0]] * 2, rel=2e-4)


@pytest.mark.parametrize("degrees", [12, 20])
def test_the_force_has_no_step_where_the_bend_turns_about_the_axis_at_a_node(run, degrees):
    """By a little less or a little more than a right angle."""
    forces = []
    for turn in (89.9, 90.1):
        bend = arc(-0.05 / R, half=6 * R, shift=6 * R, n=24)[1:]
        cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        turned = np.column_stack([bend[:, 0], -bend[:, 2] * sine, bend[:, 2] * cosine])
        points = np.vstack([(bend * [-1, 1, 1])[::-1], [[0, 0, 0]], turned])
        rod = arc(0.0, degrees=degrees, height=2 * R, shift=0.27 * R, half=4 * R, n=8)
        push = step(boundary=f" UPPER, 3, 3, {-0.002 * R}\n")
        results = solved(run(two_wires(points, rod, HELD, push), name=f"turned{len(forces)}"))
        forces.append(results.contacts_at(-1)["force"].sum())
    assert forces[1] == pytest.approx(forces[0], rel=5e-3)


def test_the_force_has_small_steps_at_small_angles_beside_the_node_at_which_a_bend_begins(run):
    """The length of the overlap follows the curvature of the axis, which has no jump; steps of the places are left."""
    bend = (arc(-0.05 / R, n=12, half=6 * R, shift=6 * R)[1:] * [-1, 1, 1])[::-1]
    points, forces = np.vstack([bend, [[k * R, 0, 0] for k in range(11)]]), []
    places = np.linspace(0.9, 1.1, 9)
    for place in places:
        rod = arc(0.0, degrees=12, height=2 * R, shift=0.03 * R) + np.array([place * R, 0, 0])
        results = solved(run(two_wires(points, rod, HELD, step(boundary=f" UPPER, 3, 3, {-0.02 * R}\n"))))
        forces.append(results.contacts_at(-1)["force"].sum())
    assert np.abs(np.diff(forces)).max() < 0.05 * max(forces)


@pytest.mark.parametrize(
    ("degrees", "half", "push", "elements"), [(20, 6, 0.3, 16), (14, 12, 1.5, 24), (24, 18, 2, 24)]
)
def test_wires_that_bend_about_each_other_take_few_iterations(run, tmp_path, degrees, half, push, elements):
    """Their closest points go far as they turn a little: the tangent has what that changes of how they resist."""
    lower = arc(0.0, shift=0.013 * R, half=half * R, n=elements)
    upper = arc(0.0, degrees=degrees, height=2 * R, shift=0.27 * R, half=half * R, n=elements)
    ends = f"*NSET, NSET=ENDS\n {UPPER}, {UPPER + elements}\n*NSET, NSET=BELOW\n {LOWER}, {LOWER + elements}\n"
    held = "*BOUNDARY\n BELOW, ENCASTRE\n LOWER, 9\n UPPER, 9\n ENDS, 1, 2\n ENDS, 4, 6\n"
    press = step(static="0.02, 1., 1e-5, 0.02", boundary=f" ENDS, 3, 3, {-push * R}\n")
    results = solved(run(two_wires(lower, upper, ends, held, press), name="about"))
    assert results.history["increment"][-1] == 50
    rows = [line.split() for line in (tmp_path / "about" / "about.sta").read_text().splitlines()]
    assert sum(int(row[3]) for row in rows if row and row[0] == "1") < 5 * 50


def test_a_run_with_bent_wires_goes_on_from_a_restart_file(run, tmp_path):
    lower, upper = arc(0.0, shift=0.013 * R), arc(0.05 / R, degrees=30, height=2 * R, shift=0.27 * R)
    down = f" HEAD, 1, 2\n HEAD, 3, 3, {-0.01 * R}\n HEAD, 6\n"
    turns = [0.8 * math.cos(math.radians(30)), 0.8 * math.sin(math.radians(30))]
    roll = f"{down} HEAD, 4, 4, {turns[0]}\n HEAD, 5, 5, {turns[1]}\n*RESTART, WRITE, FREQUENCY=1\n"
    steps = led(4, f"{down} HEAD, 4, 5\n"), led(8, roll)
    whole = solved(run(moved_by(lower, upper, *steps), name="whole"))
    kept = tmp_path / "whole" / "whole.restart.h5"
    part = solved(run(moved_by(lower, upper, *steps), "--restart", f"{kept}:2:3", name="part"))
    for name in ("ALLCCE", "ETOTAL"):
        assert part.history[name][-1] == whole.history[name][-1]

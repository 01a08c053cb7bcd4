"""Strands and cables of `litz.build` are pulled without a warning."""

import math

import numpy as np
import pytest
from verification.cases.twisted_pair import approach_of
from verification.references.helical_rods import Rod, Strand

from litz import Results, build
from litz.model import Interaction, Material

CABLES = {
    "1+6": lambda: build.strand([1, 6], radius=[0.52e-3, 0.5e-3], lay_length=45e-3, length=12e-3),
    "1+6 thin": lambda: build.strand([1, 6], radius=[5.3e-6, 5e-6], lay_angle=math.radians(6), length=0.1e-3),
    "1+6 laid off": lambda: build.strand([1, 6], radius=0.5e-3, lay_length=45e-3, length=12e-3, enlarge=True),
    "1+6+12": lambda: build.strand(
        [1, 6, 12], radius=[0.55e-3, 0.5e-3, 0.5e-3], lay_length=[30e-3, 60e-3], direction="SZ", length=6e-3, enlarge=True
    ),
    "3": lambda: build.strand([3], radius=0.41e-3, lay_length=25e-3, length=12e-3),
    "3 x 3": lambda: build.cable([[3], [3]], radius=0.41e-3, lay_lengths=[20e-3, 40e-3], length=12e-3),
    "3 x 3, opposite": lambda: build.cable([[3], [3]], radius=0.41e-3, lay_lengths=[20e-3, -40e-3], length=12e-3),
}  # fmt: skip


@pytest.mark.parametrize("name", CABLES)
def test_a_cable_is_pulled_without_a_warning(name, litz, tmp_path):
    model = CABLES[name]()
    model.press(-2e-4 * model.x[:, 2].max(), voltage=1e-3, increment=0.5)
    deck = model.write(tmp_path / "cable.inp")
    checked = litz("check", deck)
    assert (checked.returncode, checked.stderr) == (0, "")
    process = litz("run", deck, "-o", tmp_path)
    assert (process.returncode, process.stderr) == (0, "")
    assert "cut:" not in process.stdout
    results = Results(tmp_path / "cable.vtkhdf")
    assert results.warnings == []
    # wires that are laid on each other hold each other as soon as they are pulled
    assert results.contacts_at(-1)["force"].sum() > 0


def test_shares_of_places_and_crossings_that_change_with_the_load_take_no_iterations_of_their_own(litz, tmp_path):
    """A first step that carries the prescribed motion, and three that square a miss of some hundredths down to 1e-8.

    On the way the overlap grows by a tenth to a fifth in each increment, and with it what is carried along the line.
    """
    model = build.strand([1, 6], radius=[0.52e-3, 0.5e-3], lay_length=45e-3, length=22.5e-3)
    model.press(-5e-4 * 22.5e-3)
    process = litz("run", model.write(tmp_path / "strand.inp"), "-o", tmp_path)
    assert process.returncode == 0, process.stderr
    iterations = Results(tmp_path / "strand.vtkhdf").status["iterations"]
    assert len(iterations) == 10
    assert max(iterations[3:]) <= 4


def pulled_and_let_go(layers, increment):
    """A strand of 15 mm with friction between clamps, stretched by a thousandth and let go; size of the increments."""
    length, pull = 15e-3, 1e-3
    model = build.strand(
        layers,
        radius=[0.52e-3] + [0.5e-3] * (len(layers) - 1),
        lay_length=[45e-3, 80e-3][: len(layers) - 1],
        length=length,
        enlarge=True,
        material=Material("STEEL", young=200e9, poisson=0.3),
        interaction=Interaction(friction=0.2),
    )
    model.supports = []
    model.fix(model.rigid_body((0, 0, 0), tie="MINUS"), "encastre")
    model.node_set("CLAMP", model.rigid_body((0, 0, length), tie="PLUS"))
    step = model.step("PULL", increment=increment)
    step.hold("CLAMP", "x", "y", "rotations")
    step.move("CLAMP", "z", pull * length)
    step.node_print("CLAMP", "RF")
    step = model.step("RELEASE", increment=increment)
    step.move("CLAMP", "z", 0.0)
    step.node_print("CLAMP", "RF")
    return model


def test_what_a_strand_has_held_counts_as_its_work_is_weighed(litz, tmp_path):
    """Let go in two increments: hardly anything is left, and what is in no energy is far more than that, but nothing beside
    what the wires have held and given back."""
    process = litz("run", pulled_and_let_go([1, 6], 0.5).write(tmp_path / "strand.inp"), "-o", tmp_path)
    assert (process.returncode, process.stderr) == (0, "")


@pytest.mark.slow
@pytest.mark.parametrize("layers", [[1, 6], [1, 6, 12]], ids=("1+6", "1+6+12"))
def test_a_strand_with_friction_lets_go_as_it_was_gripped_without_a_cut(layers, litz, tmp_path):
    """As the wires come off each other the overlaps become short, and crossings take over from the places of lines: twice
    in an increment, which costs a few iterations each time."""
    by_increment = {}
    for increment in (0.5, 0.05):
        model = pulled_and_let_go(layers, increment)
        folder = tmp_path / str(increment)
        process = litz("run", model.write(tmp_path / f"strand_{increment}.inp"), "-o", folder)
        assert (process.returncode, process.stderr) == (0, "")
        assert "cut:" not in process.stdout
        by_increment[increment] = Results(folder / f"strand_{increment}.vtkhdf")
    coarse, fine = by_increment.values()
    assert max(coarse.status["iterations"]) <= 15
    for time in (0.5, 1.0, 1.5):
        # a lens has the force of the places in it to 2 %, and few wires have one
        assert force_at(coarse, time) == pytest.approx(force_at(fine, time), rel=5e-3)
    # where hardly any force is left, most contacts are lenses
    assert force_at(coarse, 2.0) == pytest.approx(force_at(fine, 2.0), rel=0.05)


def force_at(results: Results, time: float) -> float:
    """Sum of the forces of all contacts [N]."""
    return results.contacts_at(int(np.argmin(np.abs(np.array(results.times) - time))))["force"].sum()


@pytest.mark.slow
def test_wires_of_a_strand_press_on_its_core_as_exact_helices(litz, tmp_path):
    """Pulled, then twisted, by clamps that are two lays apart: in the middle, where they are no longer felt."""
    length, radii = 90e-3, (0.52e-3, 0.5e-3)
    model = build.strand([1, 6], radius=radii, lay_length=45e-3, length=length)
    model.supports = []
    model.fix(model.rigid_body((0, 0, 0), tie="MINUS"), "encastre")
    model.node_set("CLAMP", model.rigid_body((0, 0, length), tie="PLUS"))
    model.fix("MINUS", "potential")
    pull = model.step("PULL", increment=0.25)
    pull.hold("CLAMP", "x", "y", "rotations")
    pull.move("CLAMP", "z", 5e-4 * length)
    twist = 5 / 3 * length
    model.step("TWIST", increment=0.25).move("CLAMP", "rz", twist)
    process = litz("run", model.write(tmp_path / "strand.inp"), "-o", tmp_path)
    assert process.returncode == 0, process.stderr
    results = Results(tmp_path / "strand.vtkhdf")
    core, wire = (Rod(radius, 120e9, 0.34) for radius in radii)
    strand = Strand(core, wire, 6, 45e-3)
    approach = approach_of(core, wire)
    # the law is per length of either wire
    share = (1 + strand.free.height) / 2
    times = np.array(results.times)
    for time, turn, tolerance in ((1, 0.0, 2e-3), (2, twist / length, 4e-3)):
        exact = strand.state(5e-4, turn, lambda f: approach(f / share))
        contacts = results.contacts_at(int(np.argmin(np.abs(times - time))))
        # over whole elements, along which the force has ripples
        middle = np.abs(contacts["point_1_z"] - length / 2) < 9e-3
        pressed = contacts["force"][middle].sum() / contacts["length"][middle].sum()
        # twisted, the clamps raise it by 2.5 % over two thirds of a lay, 0.7 % over 4/3 and 0.3 % over two lays
        assert pressed == pytest.approx(exact.line_force / share, rel=tolerance)

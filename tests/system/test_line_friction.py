"""Friction of wires that touch along lines: it acts on their surfaces."""

import math

import numpy as np
import pytest
from verification.references.parallel_wires import PressedWire
from verification.references.slipping_pair import SlippingPair

from line_wires import COPPER, HERTZ, LED, LOWER, UPPER, along, step, two_wires

NO_FIELD = "*BOUNDARY\n LOWER, 9, 9, 0.\n UPPER, 9, 9, 0.\n"
LENGTH = 20e-3


def rubbing(mu, parameters=""):
    return HERTZ + f"*FRICTION{parameters}\n {mu}\n"


def solved(outcome):
    process, results = outcome
    assert process.returncode == 0, process.stderr
    return results


def nodal(results, name):
    """A field of all nodes at the end."""
    return results.field(name, len(results.times) - 1)


def on_the_upper_wire(contacts):
    """Sum of the friction that acts on the upper wire (3) [N]."""
    # the traction is what the barred wire feels
    sign = np.where(contacts["element_1"] >= UPPER, 1.0, -1.0)
    return np.array([np.sum(sign * contacts[f"traction_{axis}"]) for axis in "xyz"])


class TestDragged:
    """All nodes of the upper wire are lowered, then led along or across the lower one, which is held."""

    MU, OVERLAP = 0.2, 2e-7

    @pytest.mark.parametrize("direction", [(1, 0), (0, 1), (-0.6, 0.8)], ids=["along", "across", "oblique"])
    def test_the_friction_is_mu_times_the_force_against_the_motion(self, run, direction):
        # so short a way that the wire does not leave the top of the other one
        way = 2e-6 * np.array(direction)
        led = "".join(f" UPPER, {axis}, {axis}, {moved:.17g}\n" for axis, moved in zip((1, 2), way, strict=True))
        deck = two_wires(
            along(LENGTH, 8), along(LENGTH, 11, height=2e-3), LED,
            step(NO_FIELD, boundary=f" UPPER, 3, 3, {-self.OVERLAP}\n"),
            step(static="0.25, 1.", boundary=led), law=rubbing(self.MU),
        )  # fmt: skip
        contacts = solved(run(deck)).contacts_at(-1)
        assert (contacts["friction"] == "slip").all()
        force = contacts["force"].sum()
        # across, the wire climbs down by 1e-3 of a radian
        assert on_the_upper_wire(contacts)[:2] == pytest.approx(
            -self.MU * force * np.array(direction), abs=5e-3 * force
        )

    def test_each_wire_gets_the_moment_of_the_friction_on_its_surface(self, run):
        deck = two_wires(
            along(LENGTH, 8), along(LENGTH, 8, height=2e-3), LED,
            step(NO_FIELD, boundary=f" UPPER, 3, 3, {-self.OVERLAP}\n"),
            step(static="0.25, 1.", boundary=" UPPER, 2, 2, 2e-6\n"), law=rubbing(self.MU),
        )  # fmt: skip
        results = solved(run(deck))
        moment = nodal(results, "reaction_moment")[:, 0]
        couple = self.MU * results.contacts_at(-1)["force"].sum() * COPPER.radius
        assert moment[:9].sum() == pytest.approx(couple, rel=2e-3)
        assert moment[9:].sum() == pytest.approx(couple, rel=2e-3)


def test_a_wire_rolls_over_another_one_without_slip(run):
    """Pushed sideways and free to turn, it turns by twice the angle by which it goes around its equal."""
    shift = 0.1e-3
    deck = two_wires(
        along(LENGTH, 8), along(LENGTH, 8, height=2e-3 - 1e-7),
        "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 1\n UPPER, 5, 6\n",
        step("*CLOAD\n UPPER, 3, -1.\n", NO_FIELD, boundary=" UPPER, 2\n"),
        step(static="0.02, 1., 1e-4, 0.02", boundary=f" UPPER, 2, 2, {shift}\n"), law=rubbing(0.3),
    )  # fmt: skip
    results = solved(run(deck))
    contacts = results.contacts_at(-1)
    assert contacts["slip_path"].max() == 0
    # the strip is below the distance of the axes by the overlap, 1e-4 of it
    turn = nodal(results, "rotation")[9:, 0]
    assert turn == pytest.approx(-2 * math.asin(shift / 2e-3), rel=5e-4)
    # nothing holds the wire against turning
    assert np.abs(on_the_upper_wire(contacts)).max() < 1e-6 * contacts["force"].sum()


@pytest.mark.slow
def test_a_wire_around_a_drum_holds_what_its_surface_holds(run):
    """Capstan: with the couple of the friction on the surface the exponent is that of Euler times R/(R + r)."""
    mu, big, small, elements = 0.3, 10e-3, 0.2e-3, 72
    drum, wire = (PressedWire(radius, 200e9, 0.3, 1e-7) for radius in (big, small))
    angle = np.linspace(np.pi, 0, elements + 1)
    axis = big + small - 1e-7
    half_turn = np.column_stack([axis * np.cos(angle), axis * np.sin(angle), 0 * angle])
    core = np.column_stack([np.zeros(5), np.zeros(5), np.linspace(-20e-3, 20e-3, 5)])
    last = UPPER + elements
    deck = two_wires(
        core, half_turn, f"*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 3, 5\n {last}, 2\n",
        step(f"*CLOAD\n {UPPER}, 2, -1.\n", NO_FIELD),
        step(static="0.25, 1.", boundary=f" {last}, 2, 2, -5e-5\n"), law=rubbing(mu), wires=(drum, wire),
    )  # fmt: skip
    results = solved(run(deck))
    pull = -nodal(results, "reaction_force")[-1, 1]
    exponent = mu * math.pi * big / (big + small)
    # elements of 2.5 degrees; without the couple it would be 1.9 % more
    assert pull == pytest.approx(math.exp(exponent), rel=3e-3)


def cantilevers(pair, forces, elements=50, static="1., 1.", elastic_slip=1e-11):
    """Two wires pressed together and bent by forces at their tips, one step each; see references/slipping_pair.py."""
    wire = PressedWire(pair.radius, pair.young, 0.3, 1e-7)
    each = pair.pressing * pair.length / elements
    tips = LOWER + elements, UPPER + elements
    pressing = "".join(
        f" {first + i}, 3, {sign * each * (0.5 if i == elements else 1):.17g}\n"
        for first, sign in ((LOWER, 1), (UPPER, -1))
        for i in range(1, elements + 1)
    )
    steps = [step("*CLOAD\n" + pressing, NO_FIELD)]
    for force in forces:
        loads = "".join(
            f" {tip}, 3, {sign * each / 2 - force / 2:.17g}\n" for tip, sign in zip(tips, (1, -1), strict=True)
        )
        steps.append(step("*CLOAD\n" + loads, "*ENERGY PRINT\n", static=static))
    return two_wires(
        along(pair.length, elements), along(pair.length, elements, height=2 * pair.radius),
        f"*BOUNDARY\n LOWER, 2\n UPPER, 2\n {LOWER}, ENCASTRE\n {UPPER}, ENCASTRE\n", *steps,
        law=rubbing(pair.friction, f", ELASTIC SLIP={elastic_slip}"), wires=(wire, wire),
    )  # fmt: skip


class TestCantileversThatSlip:
    PAIR = SlippingPair(0.5e-3, 0.05, 200e9, 20.0, 0.3)

    def test_they_bend_as_one_beam_and_then_as_two(self, run):
        forces = np.array([0.9, 2.0]) * self.PAIR.slip_force
        results = solved(run(cantilevers(self.PAIR, forces)))
        tip = nodal(results, "displacement")[[50, 101], 2]
        # the ends of the contact are spread over an element, and that at the clamps has half of its force
        assert -tip.mean() == pytest.approx(self.PAIR.path(forces)[-1], rel=2e-3)

    @pytest.mark.slow
    def test_the_heat_of_a_cycle_is_that_of_the_loop_and_the_energies_balance(self, run):
        forces = np.array([2.0, -2.0, 2.0]) * self.PAIR.slip_force
        history = solved(run(cantilevers(self.PAIR, forces, static="0.1, 1."))).history
        heat = (
            history["ALLFD"][np.flatnonzero(history["step"] == 4)[-1]]
            - history["ALLFD"][np.flatnonzero(history["step"] == 2)[-1]]
        )
        assert heat == pytest.approx(self.PAIR.loss(2 * self.PAIR.slip_force), rel=1e-2)
        assert np.abs(history["ETOTAL"]).max() < 1e-3 * history["ALLFD"][-1]


def test_what_wires_remember_turns_with_them(run):
    """A pair that holds a traction is turned as a whole by 40 degrees: the traction along the wires stays."""
    way, turn = 2e-8, math.radians(40)
    x = np.linspace(0, LENGTH, 9)
    led = "".join(
        f" {first + i}, 1, 1, {s * (math.cos(turn) - 1) - y * math.sin(turn) + shift * math.cos(turn):.17g}\n"
        f" {first + i}, 2, 2, {s * math.sin(turn) + shift * math.sin(turn):.17g}\n"
        for first, y, shift in ((LOWER, 0.0, 0.0), (UPPER, 0.0, way))
        for i, s in enumerate(x)
    )
    deck = two_wires(
        along(LENGTH, 8), along(LENGTH, 8, height=2e-3), "*BOUNDARY\n LOWER, 1, 6\n UPPER, 1, 2\n UPPER, 4, 6\n",
        step(NO_FIELD, boundary=" UPPER, 3, 3, -2e-7\n"),
        step(boundary=f" UPPER, 1, 1, {way}\n"),
        step(boundary=led + f" LOWER, 6, 6, {turn}\n UPPER, 6, 6, {turn}\n"), law=rubbing(0.5),
    )  # fmt: skip
    results = solved(run(deck))
    before, after = (on_the_upper_wire(results.contacts_at(i)) for i in (-2, -1))
    assert after[:2] == pytest.approx(before[0] * np.array([math.cos(turn), math.sin(turn)]), rel=1e-6)


@pytest.mark.parametrize("degrees", [3, 6])
@pytest.mark.parametrize("increments", [2, 4])
def test_friction_leaves_the_force_of_wires_that_become_a_line_as_it_is(run, degrees, increments):
    """As wires are pressed together at a small angle, places take over from the crossing: as fast as without friction."""
    lower = along(LENGTH, 24, start=-LENGTH / 2)
    upper = along(LENGTH, 24, start=-LENGTH / 2, degrees=degrees, height=2 * COPPER.radius)
    push = f" UPPER, 1, 2, 0.\n UPPER, 3, 3, {-3e-3 * COPPER.radius:.17g}\n"
    words = step(static=f"{1 / increments}, 1., 1e-3, {1 / increments}", boundary=push)
    held = "*BOUNDARY\n LOWER, 1, 6\n UPPER, 4, 6\n" + NO_FIELD
    forces = [
        solved(run(two_wires(lower, upper, held, words, law=law), name=name)).contacts_at(-1)["force"].sum()
        for name, law in {"smooth": HERTZ, "rough": rubbing(0.3)}.items()
    ]
    assert forces[1] == pytest.approx(forces[0], rel=2e-3)

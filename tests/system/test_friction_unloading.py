"""Friction where the normal force falls and the tangential stiffness with it: the elastic slip is held, and no energy is made."""

import numpy as np
import pytest

from test_friction import FORCE, MU, OVERLAP, PENALTY, move, reaction, rubbing

#: Elastic slip at the limit [m]
SLIP = 1e-6
ELASTIC_SLIP = f"*FRICTION, ELASTIC SLIP={SLIP}\n {MU}"
#: Part of the overlap that is left after the lift
LEFT = 1e-3


def hertz(deck):
    return deck.replace(f"PRESSURE-OVERCLOSURE=LINEAR\n {PENALTY}", "PRESSURE-OVERCLOSURE=HERTZ")


def at_end_of(results, step, column):
    return results.history[column][results.history["step"] == step][-1]


@pytest.mark.parametrize("increments", [1, 7])
def test_a_spring_that_softens_with_the_force_keeps_its_length(run, increments):
    """k = mu F/c: lifted without motion, T goes with F, and mu u^2/(2 c) per force becomes heat; nothing slips."""
    u = 0.7 * SLIP
    deck = rubbing(move(u, increments=1), move(u, z=-LEFT * OVERLAP, increments=increments), friction=ELASTIC_SLIP)
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    assert reaction(results)[-1, 0] == pytest.approx(MU * LEFT * FORCE * u / SLIP, rel=1e-6)
    assert at_end_of(results, 3, "ALLFD") == pytest.approx(MU * u**2 / (2 * SLIP) * (1 - LEFT) * FORCE, rel=1e-6)
    spring = at_end_of(results, 3, "ALLCCE") - PENALTY * (LEFT * OVERLAP) ** 2 / 2
    assert spring == pytest.approx(MU * LEFT * FORCE * u**2 / (2 * SLIP), rel=1e-5)
    assert results.contacts_at(-1)["slip_path"] == pytest.approx(0, abs=1e-18)


@pytest.mark.parametrize("increments", [1, 7])
def test_a_contact_at_its_limit_that_is_lifted_has_slipped_no_further(run, increments):
    u = 10 * SLIP
    deck = rubbing(move(u, increments=100), move(u, z=-LEFT * OVERLAP, increments=increments), friction=ELASTIC_SLIP)
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    assert reaction(results)[-1, 0] == pytest.approx(MU * LEFT * FORCE, rel=1e-6)
    assert results.contacts_at(-1)["slip_path"] == pytest.approx(u - SLIP, rel=1e-6)
    expected = MU * FORCE * (u - SLIP) + MU * (1 - LEFT) * FORCE * SLIP / 2
    assert at_end_of(results, 3, "ALLFD") == pytest.approx(expected, rel=1e-6)
    assert abs(at_end_of(results, 3, "ETOTAL")) < 1e-6 * expected


@pytest.mark.parametrize("increments", [1, 7])
def test_a_slip_under_a_falling_force_has_the_heat_of_the_mean_force(run, increments):
    """Beside the spring, which loses its energy."""
    u, further = 10 * SLIP, 5 * SLIP
    deck = rubbing(
        move(u, increments=100),
        move(u + further, z=-LEFT * OVERLAP, increments=increments),
        friction=ELASTIC_SLIP,
    )
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    heat = at_end_of(results, 3, "ALLFD") - at_end_of(results, 2, "ALLFD")
    expected = MU * (1 + LEFT) * FORCE / 2 * further + MU * (1 - LEFT) * FORCE * SLIP / 2
    assert heat == pytest.approx(expected, rel=1e-6)
    assert abs(at_end_of(results, 3, "ETOTAL")) < 1e-6 * at_end_of(results, 3, "ALLWK")


@pytest.mark.parametrize("increments", [1, 7])
def test_the_spring_of_a_hertz_contact_softens_with_the_spot(run, increments):
    """k goes with the square root of the overlap."""
    u = 1e-8
    deck = hertz(
        rubbing(move(u, increments=1), move(u, z=-OVERLAP / 4, increments=increments), friction=f"*FRICTION\n {MU}")
    )
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    before, after = (reaction(results)[results.history["step"] == step][-1, 0] for step in (2, 3))
    assert after == pytest.approx(before / 2, rel=1e-6)
    assert at_end_of(results, 3, "ALLFD") == pytest.approx(before * u / 4, rel=1e-6)


@pytest.mark.parametrize("friction", [ELASTIC_SLIP, f"*FRICTION\n {MU}"], ids=["elastic slip", "Mindlin"])
def test_a_closed_cycle_makes_heat_and_never_energy(run, friction):
    """Pressed, dragged, lifted, drawn back, opened: with the traction kept, the soft spring gave back more than it took."""
    u = 5e-9 if "SLIP" not in friction else 0.5 * SLIP
    cycle = [
        move(u, increments=1),
        move(u, z=-OVERLAP / 64, increments=20),
        move(0, z=-OVERLAP / 64, increments=5),
        move(0, z=1e-8, increments=1),
        move(0, z=-OVERLAP, increments=5),
    ]
    process, results = run(hertz(rubbing(*cycle, friction=friction)))
    assert process.returncode == 0, process.stderr
    heat = results.history["ALLFD"]
    assert np.diff(heat).min() >= 0
    assert heat[-1] > 0
    assert results.history["ALLCCE"].min() >= 0

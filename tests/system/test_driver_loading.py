"""Prescribed values and loads over steps, as the driver takes them to the structure."""

import numpy as np
import pytest

from decks import cantilever

TORSION_STIFFNESS = 200e9 / 2.6 * np.pi * 1e-3**4 / 2 / 0.1


@pytest.mark.parametrize("element", ["B31", "B33"])
@pytest.mark.parametrize("held", ["4, 4", "4, 6"])
@pytest.mark.parametrize("angle", [3.3, -7.0, 4 * np.pi])
def test_a_prescribed_twist_may_pass_full_turns_in_one_increment(run, element, held, angle):
    others = " 21, 5, 6\n" if held == "4, 6" else ""
    process, results = run(cantilever(f"*BOUNDARY\n{others} 21, 4, 4, {angle!r}", element=element, n=20))
    assert process.returncode == 0, process.stderr
    assert len(results.times) == 2
    np.testing.assert_allclose(results.field("rotation")[20], [angle, 0, 0], atol=1e-9)
    assert results.field("reaction_moment")[20, 0] == pytest.approx(TORSION_STIFFNESS * angle, rel=1e-9)


def test_a_prescribed_bend_beyond_a_full_turn_is_the_same_in_one_and_in_many_increments(run):
    bend = "*BOUNDARY\n 11, 6, 6, 6.5"
    results = [
        run(cantilever(bend, static=static), name=name)[1]
        for name, static in (("one", "1, 1, 1e-3, 1"), ("many", "0.05, 1, 1e-3, 0.05"))
    ]
    for result in results:
        assert result.field("rotation")[-1] == pytest.approx([0, 0, 6.5], abs=1e-9)
    np.testing.assert_allclose(*[result.field("displacement") for result in results], atol=1e-9)


def test_an_angle_about_one_axis_that_is_held_stays_where_it_is(run):
    """Step 2 changes nothing: neither does the solution, although the angle is no component of the rotation vector."""
    turn = "*BOUNDARY\n 11, 4, 4, 1.0\n*CLOAD\n 11, 2, 20\n 11, 3, 10"
    process, results = run(cantilever(turn, "*CLOAD\n 11, 2, 20", static="0.25, 1, 1e-3, 0.25"))
    assert process.returncode == 0, process.stderr
    first, second = (results.field("displacement", results.index(step, 4)) for step in (1, 2))
    assert results.field("rotation")[-1, 0] != pytest.approx(1.0, abs=1e-4)
    np.testing.assert_array_equal(first, second)


def test_nothing_to_do_takes_no_iteration(run):
    process, results = run(cantilever("*BOUNDARY\n 11, 1, 6, 0.03", "*CLOAD\n 11, 1, 5", static="0.5, 1, 1e-3, 0.5"))
    assert process.returncode == 0, process.stderr
    # loads on a held node change its reaction, not the structure: held values are not taken back and forth by round-off
    assert (results.convergence["iteration"][results.convergence["step"] == 2] == 0).all()


def test_op_new_without_data_lines_takes_all_loads_back_over_the_step(run):
    """As every load that a step no longer names, they ramp to zero."""
    loads = "*CLOAD\n 11, 2, 20\n 6, 3, 10\n 11, 4, 0.1"
    process, results = run(cantilever(loads, "*CLOAD, OP=NEW", static="0.25, 1, 1e-3, 0.25"))
    assert process.returncode == 0, process.stderr
    for increment in range(1, 5):
        left = 1 - increment / 4
        force = results.field("applied_force", results.index(2, increment))
        assert force[[10, 5]] == pytest.approx(left * np.array([[0, 20, 0], [0, 0, 10]]), abs=1e-12)
        moment = results.field("applied_moment", results.index(2, increment))
        assert moment[10] == pytest.approx([left * 0.1, 0, 0], abs=1e-12)
    # an elastic wire without loads is straight again
    np.testing.assert_allclose(results.field("displacement"), 0, atol=1e-9)
    assert abs(results.field("displacement", results.index(1, 4))).max() > 1e-2


def test_op_new_without_data_lines_takes_all_currents_back(run):
    deck = cantilever(
        "*BOUNDARY\n 1, 9\n 6, 9, 9, 1e-3\n*CECURRENT\n 11, , 2", "*CECURRENT, OP=NEW", static="0.5, 1, 1e-3, 0.5"
    )
    process, results = run(deck.replace(" 200e9, 0.3\n", " 200e9, 0.3\n*ELECTRICAL CONDUCTIVITY\n 5e6\n"))
    assert process.returncode == 0, process.stderr
    entering = [results.field("applied_current", results.index(*at))[10] for at in ((1, 2), (2, 1), (2, 2))]
    assert entering == pytest.approx([2, 1, 0], abs=1e-12)
    # behind the node that is held at 1 mV no current flows any more
    np.testing.assert_allclose(results.field("potential")[5:], 1e-3, rtol=1e-9)


def test_op_new_without_data_lines_sets_all_supports_free(run):
    """Those of the model part, too: the wire is then held nowhere, and litz says so."""
    process, _ = run(cantilever("*CLOAD\n 11, 2, 1", "*BOUNDARY, OP=NEW"))
    assert process.returncode == 1
    assert "nothing holds WIRE (10 connected elements from element 1 on) in step 2" in process.stderr
    moved = "*BOUNDARY, OP=NEW\n*BOUNDARY, OP=NEW\n 11, ENCASTRE"
    process, results = run(cantilever("*CLOAD\n 11, 2, 1", moved), name="moved")
    assert process.returncode == 0, process.stderr
    assert (results.field("reaction_force")[0] == 0).all()
    assert results.field("reaction_force")[10].any()

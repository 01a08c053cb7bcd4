"""`*BOUNDARY, TYPE=VELOCITY` of Abaqus: `litz convert` writes the displacement, the integral of the velocity over time."""

import numpy as np
import pytest

from in_process import command
from litz import Results

#: Two cantilevers, whose ends are E and F
MODEL = """\
*Heading
*Node
1, 0., 0., 0.
2, 10., 0., 0.
3, 0., 9., 0.
4, 10., 9., 0.
*Element, type=B33, elset=W
1, 1, 2
2, 3, 4
*Nset, nset=Held
1, 3
*Nset, nset=E
2
*Nset, nset=F
4
*Nset, nset=Ends
E, F
*Beam Section, elset=W, material=S, section=CIRC
1.
0., 0., -1.
*Material, name=S
*Elastic
210000., 0.3
*Amplitude, name=UP
0., 0., 1., 1., 2., 1., 3., -1.
*Amplitude, name=FALLING, time=TOTAL TIME
0., 1., 6., 0.
*Boundary
Held, ENCASTRE
"""


def step(*lines, time=2.0):
    """A step of increments of a quarter of a second."""
    body = "\n".join(lines)
    return f"*Step, nlgeom=YES\n*Static\n0.25, {time}, 1e-5, 0.25\n{body}\n*End Step\n"


@pytest.fixture
def converted(tmp_path):
    """Converts a model with steps; the process and the deck that it has written."""

    def of(*steps):
        (tmp_path / "old.inp").write_text(MODEL + "".join(steps))
        return command("convert", "old.inp", "new.inp", "--dialect", "abaqus", cwd=tmp_path), tmp_path / "new.inp"

    return of


@pytest.fixture
def motion(converted, litz, tmp_path):
    """Times of the increments of a converted deck, and displacements of E and F, (n, 2, 3)."""

    def of(*steps):
        done, deck = converted(*steps)
        assert done.returncode == 0, done.stderr
        assert litz("run", deck.name, cwd=tmp_path).returncode == 0
        results = Results(tmp_path / "new.vtkhdf")
        return results.times, results.field("displacement", None)[:, [1, 3]]

    return of


def test_a_velocity_is_there_at_once_and_goes_on_until_it_is_changed(motion):
    times, moved = motion(
        step("*Boundary, type=VELOCITY", "E, 3, 3, 0.1", "F, 2, 3, 0.05"),
        step("*Boundary, type=VELOCITY", "F, 2, 2, -0.01", "F, 3, 3, 0."),
    )
    later = np.maximum(times - 2.0, 0.0)
    assert moved[:, 0, 2] == pytest.approx(0.1 * times, abs=1e-12)
    assert moved[:, 1, 1] == pytest.approx(0.05 * (times - later) - 0.01 * later, abs=1e-12)
    assert moved[:, 1, 2] == pytest.approx(0.05 * (times - later), abs=1e-12)


def test_a_velocity_that_follows_an_amplitude_moves_as_far_as_its_integral(motion):
    times, moved = motion(step("*Boundary, type=VELOCITY, amplitude=UP", "E, 3, 3, 0.1", time=4.0), step(time=1.0))
    t = np.clip(times, 0.0, None)
    # 1, 1 and 2 s of rising, constant and falling velocity; from 3 s on it is -1, in the next step, too
    exact = np.select(
        [t <= 1, t <= 2, t <= 3], [t**2 / 2, t - 0.5, 1.5 + (t - 2) - (t - 2) ** 2], default=1.5 - (t - 3)
    )
    # chords of a parabola, 20 for each piece: off by (1/20)^2/8 times the change of the velocity, which is 2
    assert moved[:, 0, 2] == pytest.approx(0.1 * exact, abs=0.1 * 2 / 3200)
    at_ends = np.isin(t, (1, 2, 3, 4, 5))
    assert moved[at_ends, 0, 2] == pytest.approx(0.1 * exact[at_ends], abs=1e-12)


def test_over_the_total_time_an_amplitude_goes_on(motion):
    times, moved = motion(
        step("*Boundary", "F, 3, 3, 0.2"), step("*Boundary, type=VELOCITY, amplitude=FALLING", "F, 3, 3, 0.3", time=5.0)
    )
    until = np.minimum(times, 6.0)
    exact = 0.2 + 0.3 * ((until - 2.0) - (until**2 - 4.0) / 12)
    is_later = times >= 2.0
    assert moved[is_later, 1, 2] == pytest.approx(exact[is_later], abs=0.3 * 4 * (2 / 3) / 3200)


def test_a_velocity_begins_where_its_node_is_by_whatever_set_it_has_been_moved(motion):
    times, moved = motion(
        step("*Boundary, type=VELOCITY", "2, 3, 3, 0.1"),
        step("*Boundary", "E, 3, 3, 0.5"),
        step("*Boundary, type=VELOCITY", "2, 3, 3, 0.1"),
        step("*Boundary, fixed", "Ends, 3, 3"),
        step("*Boundary, type=VELOCITY", "E, 3, 3, -0.2"),
    )
    assert moved[np.isin(times, (2, 4, 6, 8, 10)), 0, 2] == pytest.approx([0.2, 0.5, 0.7, 0.7, 0.3], abs=1e-12)


def test_nodes_of_a_set_go_on_each_from_where_it_is(motion):
    times, moved = motion(
        step("*Boundary, type=VELOCITY", "E, 3, 3, 0.1", "F, 3, 3, 0.05"),
        step("*Boundary, type=VELOCITY", "Ends, 3, 3, 0.2"),
    )
    assert moved[times == 4.0, :, 2] == pytest.approx(np.array([[0.6, 0.5]]), abs=1e-12)


@pytest.mark.parametrize(
    ("steps", "reason"),
    [
        ((step("*Cload", "E, 3, 1."), step("*Boundary, type=VELOCITY", "E, 3, 3, 0.1")), "when the step begins is not known"),
        (
            (step("*Boundary", "E, 3, 3, 0.1"), step("*Boundary, op=NEW", "Held, ENCASTRE"),
             step("*Boundary, type=VELOCITY", "E, 3, 3, 0.1")),
            "when the step begins is not known",
        ),
        ((step("*Boundary, type=VELOCITY", "E, 4, 5, 0.1"),), "turns about several axes"),
        (
            (step("*Boundary, type=VELOCITY", "E, 4, 4, 0.1", "*Boundary, type=VELOCITY", "2, 5, 5, 0.1"),),
            "node 2 turns about several axes",
        ),
        (
            (step("*Boundary", "Ends, 4, 4, 0.1"), step("*Boundary, type=VELOCITY", "E, 5, 5, 0.1")),
            "node 2 turns about several axes",
        ),
        ((step("*Boundary, type=VELOCITY", "GONE, 3, 3, 0.1"),), "there is no node or node set GONE"),
        ((step("*Boundary, type=VELOCITY, amplitude=GONE", "E, 3, 3, 0.1"),), "NAME=GONE is no table"),
        ((step("*Boundary, type=VELOCITY", "E, 9, 9, 0.1"),), "of the degrees of freedom 1 to 6"),
    ],
)  # fmt: skip
def test_where_no_displacement_is_known_the_velocity_is_refused_with_the_reason(converted, steps, reason):
    done, _ = converted(*steps)
    assert done.returncode == 1
    assert reason in done.stderr


def test_a_turn_about_one_axis_is_an_angle(motion):
    times, moved = motion(step("*Boundary, type=VELOCITY", "E, 6, 6, 0.01"))
    # the end of a beam with a clamped base whose tip turns by an angle and bears no force moves by half of that times its length
    assert moved[-1, 0, 1] == pytest.approx(0.5 * 10 * 0.01 * times[-1], rel=1e-3)

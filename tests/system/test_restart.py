"""A run that goes on from a written increment gives the same bits as one that never stopped."""

import pytest

from decks import cantilever, crossed
from litz import Results
from same_results import KEEP_ALL, assert_same_end, written


def assert_goes_on_from_everywhere(litz, tmp_path, text, *arguments):
    deck = tmp_path / "deck.inp"
    deck.write_text(text)
    done = litz("run", deck, "-o", tmp_path / "whole", "--threads", 1, *arguments)
    assert done.returncode == 0, done.stderr
    whole = Results(tmp_path / "whole")
    kept = written(tmp_path / "whole" / "deck.restart.h5")
    assert len(kept) >= 3
    for step, increment in kept:
        part = tmp_path / f"part_{step}_{increment}"
        place = f"{tmp_path / 'whole' / 'deck.restart.h5'}:{step}:{increment}"
        done = litz("run", deck, "-o", part, "--threads", 1, "--restart", place, *arguments)
        assert done.returncode == 0, done.stderr
        assert_same_end(whole, Results(part), step, increment)


@pytest.mark.parametrize("solver", ["BLOCK", "UMFPACK", "SKYLINE", pytest.param("MUMPS", marks=pytest.mark.mumps)])
def test_a_restarted_run_equals_the_uninterrupted_one_bit_for_bit(litz, tmp_path, solver):
    """Contacts close, slide over nodes and open; increments are cut and grow."""
    text = crossed(push="-8e-4", static="0.05, 1, 1e-3, 0.3", extra=KEEP_ALL + "*SOLVER, NAME=" + solver)
    text += """\
*STEP, INC=200
*STATIC
 0.2, 1, 1e-3, 0.3
*BOUNDARY
 UPPER_ENDS, 1, 1, 0.012
 UPPER_ENDS, 3, 3, -2e-4
*END STEP
*STEP, INC=200
*STATIC
 0.5, 1
*BOUNDARY
 UPPER_ENDS, 3, 3, 1e-4
*END STEP
"""
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_an_interference_fit_and_single_rotations_go_on(litz, tmp_path):
    static, extra = "0.25, 1, 1e-3, 0.25", KEEP_ALL + "*ENERGY PRINT"
    text = crossed(height="1.9e-3", pair=", INTERFERENCE FIT", push="0", static=static, extra=extra)
    assert_goes_on_from_everywhere(litz, tmp_path, text)


@pytest.mark.slow
def test_large_rotations_amplitudes_and_loads_go_on(litz, tmp_path):
    ramp = "*AMPLITUDE, NAME=WAVE, TIME=TOTAL TIME\n 0, 0, 0.7, 1, 1.6, -1, 2, 0\n"
    text = ramp + cantilever(
        KEEP_ALL + "*BOUNDARY, AMPLITUDE=WAVE\n 11, 6, 6, 4.0\n*CLOAD\n 6, 3, 0.5",
        "*CLOAD, AMPLITUDE=WAVE\n 6, 2, 1.0",
        static="0.2, 1, 1e-3, 0.4",
    )
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_damping_that_ends_goes_on(litz, tmp_path):
    """The first increment without it has the work of what held the wire at its start."""
    load, damping = KEEP_ALL + "*ENERGY PRINT\n*CLOAD\n 11, 3, {}", "\n*CONTROLS, PARAMETERS=STABILIZE\n {}"
    text = cantilever(
        load.format(2) + damping.format(1e-3), load.format(3) + damping.format(0), static="0.5, 1, 1e-3, 0.5"
    )
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_a_run_that_goes_on_can_itself_be_continued(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.2, 1, 1e-3, 0.2", extra=KEEP_ALL))
    restart = []
    for name, increment in (("whole", 2), ("first", 4), ("second", 5)):
        done = litz("run", deck, "-o", tmp_path / name, "--threads", 1, *restart)
        assert done.returncode == 0, done.stderr
        restart = ["--restart", f"{tmp_path / name / 'deck.restart.h5'}:1:{increment}"]
    assert written(tmp_path / "first" / "deck.restart.h5") == [(1, 3), (1, 4), (1, 5)]
    assert_same_end(Results(tmp_path / "whole"), Results(tmp_path / "second"), 1, 4)


def test_every_nth_increment_and_the_last_of_a_step_are_kept(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    step = "*CLOAD\n 6, 3, 0.5"
    deck.write_text(
        cantilever("*RESTART, WRITE, FREQUENCY=3\n" + step, step, "*RESTART\n" + step, static="0.2, 1, 1e-3, 0.2")
    )
    done = litz("run", deck, "-o", tmp_path)
    assert done.returncode == 0, done.stderr
    assert written(tmp_path / "deck.restart.h5") == [(1, 3), (1, 5), (2, 3), (2, 5)]


@pytest.fixture
def kept(litz, tmp_path):
    """A deck, and a restart file of its run."""
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.5, 1", extra=KEEP_ALL))
    assert litz("run", deck, "-o", tmp_path / "first").returncode == 0
    return deck, tmp_path / "first" / "deck.restart.h5"


def refused(litz, deck, place, code, *words):
    output = deck.parent / "refused"
    done = litz("run", deck, "-o", output, "--restart", place)
    assert done.returncode == code, done.stderr
    for word in words:
        assert word in done.stderr
    assert not list(output.glob("*")) if output.exists() else True


def test_what_cannot_be_continued_is_refused_in_words(litz, kept, tmp_path):
    deck, path = kept
    refused(litz, deck, f"{path}:1:7", 1, "no increment 1:7", "it has 1:1 1:2")
    refused(litz, deck, tmp_path / "missing.h5", 4, "missing.h5", "does not exist")
    (tmp_path / "text.h5").write_text("text")
    refused(litz, deck, tmp_path / "text.h5", 4, "text.h5", "not an HDF5 file")
    refused(litz, deck, tmp_path / "first" / "deck.vtkhdf", 4, "not a restart file")
    text = deck.read_text()
    deck.write_text(text.replace("13, 0, -0.005,", "13, 0, -0.0051,"))
    refused(litz, deck, path, 1, "the nodes: positions changed")
    deck.write_text(text.replace("UPPER_ENDS, 4, 6", "UPPER_ENDS, 4, 5"))
    refused_here = litz("run", deck, "-o", tmp_path / "refused", "--restart", f"{path}:1:1")
    assert refused_here.returncode == 1
    assert "step 1: *BOUNDARY of degree of freedom 6 changed" in refused_here.stderr


def test_the_results_that_are_continued_are_not_overwritten(litz, kept):
    deck, path = kept
    before = {file.name: file.read_bytes() for file in path.parent.iterdir()}
    done = litz("run", deck, "-o", path.parent, "--restart", path)
    assert done.returncode == 4
    assert "would be overwritten" in done.stderr
    assert {file.name: file.read_bytes() for file in path.parent.iterdir()} == before

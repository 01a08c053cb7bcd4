"""A quick part of the fuzzing, the same decks every time; CONTRIBUTING says how to run more."""

import sys
from pathlib import Path
from random import Random

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from mutations import mutated
from plain_reader import listing
from run import INPUTS, Reader, fuzz, judge

#: Decks of a few kilobytes, of which thousands are read in seconds
SHORT = [path.read_bytes() for path in sorted(INPUTS.glob("*.inp")) if path.stat().st_size < 20_000]


@pytest.fixture
def ask(read_decks, tmp_path):
    """Code, accepted model and reason of a deck given as bytes."""
    reader = Reader(read_decks, limited=False)

    def give(deck):
        path = tmp_path / "deck.inp"
        path.write_bytes(deck)
        return reader.ask(path)

    yield give
    reader.stop()


@pytest.mark.slow
def test_changed_decks_are_refused_or_mean_what_they_say(read_decks):
    totals, found = fuzz(read_decks, 2000, seed=1, limited=False, decks=SHORT)
    assert not found, f"{len(found)} findings, the first: {found[0]}"
    # both ways of the reader have been walked
    assert totals["accepted"] > 200
    assert totals["refused"] > 1000


@pytest.mark.parametrize("path", sorted(INPUTS.glob("*.inp")), ids=lambda path: path.stem)
def test_both_readers_find_the_same_model_in_the_decks_of_inputs(path, ask):
    answer, reason = ask(path.read_bytes())
    assert answer[0].split()[:2] == [b"0", b"0"]
    assert judge(path.read_bytes(), answer, reason) == ""


def test_a_model_that_differs_in_one_bit_is_found():
    deck = (INPUTS / "01_crossed_wires.inp").read_bytes()
    answer = [b"0 0 0", *(line.encode("latin-1") for line in listing(deck))]
    assert judge(deck, answer, "") == ""
    at = next(i for i, line in enumerate(answer) if line.startswith(b"node"))
    answer[at] = answer[at][:-1] + (b"1" if answer[at].endswith(b"0") else b"0")
    assert "means something else" in judge(deck, answer, "")


def test_the_same_seed_makes_the_same_decks():
    decks = [path.read_bytes() for path in sorted(INPUTS.glob("*.inp"))]
    first, second = ([mutated(decks[0], Random(f"7 {i}"), decks) for i in range(50)] for _ in range(2))
    assert first == second
    assert len(set(first)) > 40


@pytest.mark.parametrize(
    "deck", [b"", b"\n", b"** nothing\n", b"\xef\xbb\xbf", b"\x00", b"1", b"*", b"**", b"*NODE", b'"']
)
def test_the_shortest_decks_are_refused(deck, ask):
    answer, reason = ask(deck)
    assert reason == ""
    assert answer[0].split()[0] == b"1"

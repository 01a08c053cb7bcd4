"""No wire passes through another with exit code 0: a hundred random decks, the same every time; ./setup passages runs more."""

import os

import pytest
from random_decks import FAMILIES, deck_of, names
from trials import FAILURES, table, try_all

CASES = names(100)


@pytest.fixture(scope="module")
def trials(litz_program):
    return try_all(CASES, litz_program, jobs=min(2, os.cpu_count() or 1), limit=120.0)


@pytest.mark.slow
def test_runs_of_random_decks_end_right_or_in_words(trials):
    failed = [trial for trial in trials if trial.verdict in FAILURES]
    assert not failed, "\n".join(["", *(str(trial) for trial in failed), *table(trials)])


def test_ordinary_random_decks_are_not_refused(trials):
    """A program that refuses all is right, too. Other families have much in them that litz does not model and may refuse."""
    ordinary = [trial for trial in trials if trial.family in ("thread", "pile", "aside", "loop", "load", "weave")]
    assert sum(trial.code == 0 for trial in ordinary) > 2 / 3 * len(ordinary), "\n".join(table(ordinary))


def test_a_name_makes_the_same_deck_again():
    decks = [deck_of(name) for name in CASES]
    assert decks == [deck_of(name) for name in CASES]
    assert len(set(decks)) == len(decks)
    assert {name.rsplit("-", 1)[0] for name in CASES} == set(FAMILIES)

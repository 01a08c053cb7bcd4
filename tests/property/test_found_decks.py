"""Decks in which a contact was lost with exit code 0, found by trying; each ends right now, or is refused."""

import subprocess
from pathlib import Path

import pytest

from litz import Results

FOUND = Path(__file__).parent / "found"
#: Decks that litz can compute, and their contacts at the end; all others ask for a contact that is not modelled, or
#: that cannot be followed
RIGHT = {
    "bent_wire_pressed_on_its_crest": 1,
    "bent_short_wire_pressed_on_its_crest": 1,
    # the fit from the first increment on, and beside it the crossing that closes
    "fit_beside_an_ordinary_crossing": 2,
    # it slides over the round end, and off it
    "wire_moved_over_the_end_of_a_post": 0,
}


@pytest.mark.parametrize("deck", sorted(FOUND.glob("*.inp")), ids=lambda deck: deck.stem)
@pytest.mark.filterwarnings("ignore:.*did not finish")
def test_a_deck_that_lost_a_contact_keeps_it_or_is_refused(litz_program, tmp_path, deck):
    done = subprocess.run(
        [litz_program, "run", deck, "-o", tmp_path, "--quiet"], capture_output=True, text=True, timeout=120, check=False
    )
    if deck.stem in RIGHT:
        assert done.returncode == 0, done.stderr
        results = Results(tmp_path / f"{deck.stem}.vtkhdf")
        assert len(results.contacts_at(-1)["force"]) == RIGHT[deck.stem]
    else:
        assert done.returncode == 2, done.stderr
        assert "error: step" in done.stderr

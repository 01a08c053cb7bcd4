"""A newcomer adds a law by the blocks of its page: applied to a copy of the sources, built, run."""

import shutil

import pytest

from new_things import PAGES_OF_LAWS, do, steps_of


@pytest.mark.parametrize("page", PAGES_OF_LAWS)
@pytest.mark.skipif(not all(map(shutil.which, ("meson", "ninja", "git"))), reason="needs meson, ninja and git")
def test_the_steps_of_the_page_lead_to_a_run_with_the_new_law(page, changed_sources):
    _, steps = steps_of(page)
    printed = [do(block, changed_sources) for block in steps]
    assert PAGES_OF_LAWS[page] in " ".join("".join(printed).split())
    assert "expected" in printed[-1]

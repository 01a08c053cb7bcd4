"""A newcomer adds a law, an element, a field, a term by the blocks of a page: applied to a copy of the sources, built, run."""

import shutil

import pytest

from new_things import PAGES, do, steps_of


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES)
@pytest.mark.skipif(not all(map(shutil.which, ("meson", "ninja", "git"))), reason="needs meson, ninja and git")
def test_the_steps_of_the_page_lead_to_a_run_with_what_is_new(page, changed_sources):
    _, steps = steps_of(page)
    printed = [do(block, changed_sources) for block in steps]
    assert PAGES[page] in " ".join("".join(printed).split())
    assert "expected" in printed[-1]

"""A newcomer adds two outputs, a line each, by the patch of CONTRIBUTING.md: applied to a copy of the sources, built, run."""

import shutil

import h5py
import numpy as np
import pytest

from decks import crossed
from litz import Results
from new_things import call, patch_of_outputs
from same_results import KEEP_ALL, assert_same_end

PENALTY = 1e5  # [N/m]
DECK = crossed(
    static="0.25, 1, 1e-3, 0.25",
    behavior=f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n {PENALTY}",
    extra=KEEP_ALL
    + "*CONTROLS, PARAMETERS=STABILIZE\n 1e-4\n"
    + "*NODE PRINT, NSET=LOWER, TOTALS=YES\n STF, RF\n*NODE PRINT, NSET=UPPER, TOTALS=YES\n STF, RF",
)

pytestmark = pytest.mark.skipif(
    not all(map(shutil.which, ("meson", "ninja", "git"))), reason="needs meson, ninja and git"
)


@pytest.fixture(scope="module")
def run_of_the_copy(changed_sources):
    """The folder of a run of the changed program, and a function that calls it."""
    call(["meson", "setup", "build", "--buildtype=debug", "-Dpython=disabled"], changed_sources, "the copy")
    call(["ninja", "-C", "build", "fortran/litz"], changed_sources, "the copy")
    (changed_sources / "deck.inp").write_text(DECK)

    def litz(*arguments):
        call([changed_sources / "build" / "fortran" / "litz", *arguments], changed_sources, "the changed program")

    litz("run", "deck.inp", "-o", "whole", "--quiet", "--threads", "1")
    return changed_sources, litz


def test_the_patch_has_one_line_for_each_output():
    changed = [line for line in patch_of_outputs().splitlines() if line[:1] in "+-" and line[:3] not in ("+++", "---")]
    assert [line.split("(")[0].split() for line in changed] == [["+", "call", "add"], ["+", "call", "table%field"]]


@pytest.mark.slow  # the first of these compiles all sources
def test_a_new_contact_quantity_is_in_the_ledger_and_in_the_points(run_of_the_copy):
    copy, _ = run_of_the_copy
    contacts = Results(copy / "whole").contacts
    assert contacts.units["stiffness"] == "N/m"
    assert contacts.n_rows > 0
    np.testing.assert_allclose(contacts["stiffness"], PENALTY)
    with h5py.File(copy / "whole" / "deck_contacts.vtkhdf") as file:
        points = file["VTKHDF/PointData/stiffness"]
        assert points.attrs["unit"] == b"N/m"
        assert points.attrs["description"] == b"derivative of the force by the overlap"
        np.testing.assert_allclose(points[()], PENALTY)


@pytest.mark.slow
def test_a_new_nodal_quantity_is_a_field_and_a_word_of_decks(run_of_the_copy):
    copy, _ = run_of_the_copy
    results = Results(copy / "whole")
    assert results.units["damping_force"] == "N"
    history = results.history
    damping, support = (sum(history[f"{name}3 sum {wires}"] for wires in ("LOWER", "UPPER")) for name in ("STF", "RF"))
    # without loads, supports and damping hold each other: each increment leaves 5e-3 of the largest force at most
    assert np.abs(damping[1:]).min() > 1e-3 * np.abs(history["RF3 sum UPPER"]).max()
    np.testing.assert_allclose(support, -damping, atol=1e-5 * np.abs(history["RF3 sum UPPER"]).max())
    np.testing.assert_array_equal(history["STF3 node 13"], results.field("damping_force", None)[:, 8, 2])
    assert history.units["STF3 node 13"] == "N"


@pytest.mark.slow
def test_a_run_that_goes_on_has_the_new_quantities_too(run_of_the_copy):
    copy, litz = run_of_the_copy
    place = copy / "whole" / "deck.restart.h5"
    litz("run", "deck.inp", "-o", "part", "--quiet", "--threads", "1", "--restart", f"{place}:1:2")
    assert_same_end(Results(copy / "whole"), Results(copy / "part"), 1, 2)

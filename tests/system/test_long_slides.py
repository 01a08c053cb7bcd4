"""A contact that slides over many elements in one increment is the same contact: it keeps its identity, friction and spot."""

import re

import numpy as np
import pytest

from decks import wire
from test_friction import FORCE, MU, OVERLAP, STICK, move, rubbing

#: Along the nodes of a hairpin: 0 on the first leg, 1 on the second one
RAMP = np.r_[np.zeros(8), (1 - np.cos(np.linspace(0, np.pi, 13)[1:-1])) / 2, np.ones(8)]


def long_slide(x, y=0.0, *, degrees=90.0, increments=1, **changes):
    """The wire across the fixed one begins at one end of it, and is moved along it; its elements are 4 mm long."""
    return rubbing(
        move(-x / 2, -y / 2, increments=40), move(x / 2, y / 2, increments=increments), degrees=degrees, **changes
    )


@pytest.mark.parametrize(
    ("x", "y", "degrees"), [(1.2e-2, 0, 90), (3.4e-2, 0, 90), (-3.4e-2, 0, 90), (1.6e-2, 1.2e-2, 60)]
)
def test_a_contact_that_slides_far_in_one_increment_keeps_its_identity_and_makes_its_heat(run, x, y, degrees):
    process, results = run(long_slide(x, y, degrees=degrees))
    assert process.returncode == 0, process.stderr
    assert set(results.contacts["id"]) == {1}
    heat = results.history["ALLFD"]
    # the stick goes back by its limit, and forth by it, before the slip
    slip = np.hypot(x, y) - 2 * MU * FORCE / STICK
    assert heat[-1] - heat[-2] == pytest.approx(MU * FORCE * slip, rel=1e-6)
    assert results.contacts_at(-1)["dissipation"] == pytest.approx(heat[-1], rel=1e-12)


def hairpin(gap, *steps, rise=0.0):
    """As the wire that rubs, but with two legs across the fixed wire, at -gap/2 and gap/2; the second one is higher by `rise`."""
    angle = np.linspace(np.pi, 0, 13)[1:-1]
    leg = np.linspace(-0.011, 0.01, 8)
    x = np.r_[np.full(8, -gap / 2), gap / 2 * np.cos(angle), np.full(8, gap / 2)]
    y = np.r_[leg, 0.01 + gap / 2 * np.sin(angle), leg[::-1]]
    upper = wire("UPPER", np.c_[x, y, 2e-3 + rise * RAMP], 101, element="B33")
    return re.sub(r"\*NODE, NSET=UPPER.*?(?=\*MATERIAL)", upper, rubbing(*steps), flags=re.DOTALL)


@pytest.mark.parametrize("x", [6e-3, 1.2e-2, -6e-3])
def test_each_of_two_contacts_of_the_same_wires_keeps_its_own_identity(run, x):
    """The one slides to where the other was, in a single increment."""
    process, results = run(hairpin(6e-3, move(x, increments=1)))
    assert process.returncode == 0, process.stderr
    before, after = results.contacts_at(-2), results.contacts_at(-1)

    def leg_of(contacts):
        """Element of the hairpin by identity."""
        return dict(zip(contacts["id"].tolist(), contacts["element"].tolist(), strict=True))

    assert len(leg_of(before)) == 2
    assert leg_of(after) == leg_of(before)
    np.testing.assert_allclose(after["dissipation"], MU * FORCE * (abs(x) - MU * FORCE / STICK), rtol=1e-6)


def test_a_slide_in_one_increment_leaves_the_same_spot_as_in_many(run):
    spot = "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, SPOT=LARGEST FORCE\n"
    once, often = (run(long_slide(3e-2, increments=n, spot=spot), name=f"in_{n}")[1].contacts_at(-1) for n in (1, 50))
    assert once["resistance"] == pytest.approx(often["resistance"], rel=1e-9)
    assert once["id"] == often["id"] == 1


def swapped(card):
    """While the hairpin slides by three elements, its first leg rises from the fixed wire and its second one comes down on it."""
    rise = 3e-3
    heights = rise * (1 - 2 * RAMP) - OVERLAP * RAMP
    rows = "\n".join(f" {101 + i}, 3, 3, {height:.17g}" for i, height in enumerate(heights))
    return f"""{hairpin(6e-3, rise=rise)}*STEP, INC=1000
{card}
*BOUNDARY
 UPPER, 1, 1, 1.2e-2
{rows}
*END STEP
"""


@pytest.mark.filterwarnings("ignore:.*did not finish")
def test_a_contact_that_cannot_be_told_from_a_new_one_ends_the_run_in_words(run):
    process, _ = run(swapped("*STATIC, DIRECT\n 1, 1"))
    assert process.returncode == 2
    assert "slides so far in this increment that it cannot be distinguished from others" in process.stderr
    assert "Begin with a smaller increment" in process.stderr


def test_smaller_increments_tell_them_apart(run):
    process, results = run(swapped("*STATIC\n 1, 1"))
    assert process.returncode == 0, process.stderr
    assert results.contacts_at(-1)["id"].tolist() == [2]

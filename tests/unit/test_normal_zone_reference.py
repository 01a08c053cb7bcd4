"""The reference solution of normal zones against the closed form of a heat that sets in at once."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))

from verification.references.normal_zone import Wire, velocity, velocity_of_step

COLD, AT, FULL, CONDUCTIVITY, CAPACITY = 4.2, 7.0, 2e8, 300.0, 8900.0


@pytest.mark.parametrize("part", [0.0, 0.2, 0.7])
def test_a_narrow_range_of_sharing_has_the_velocity_of_a_step(part):
    cooling, width = part * FULL / (AT - COLD), 0.05
    wire = Wire(
        COLD, AT + width / 2, lambda t: FULL * np.clip((t - AT) / width + 0.5, 0, 1), FULL,
        lambda _: CONDUCTIVITY, lambda _: CAPACITY, cooling,
    )  # fmt: skip
    exact = velocity_of_step(AT - COLD, FULL, CONDUCTIVITY, CAPACITY, cooling)
    # terms of the second order in the width over the rise: (0.05/2.8)^2 = 3e-4
    assert velocity(wire, (0.5 * exact, 1.5 * exact)) == pytest.approx(exact, rel=3e-4)

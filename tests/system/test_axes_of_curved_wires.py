"""The smooth axis of a wire follows a circle through its nodes, at any distance of them: seen by a wire that crosses it."""

import re

import numpy as np
import pytest

from decks import MATERIAL, straight, wire

RADIUS, CIRCLE, GAP = 1e-3, 0.05, 1e-4


def arch(angles, backwards=()):
    """An arch in the xz plane with nodes at these angles from its top, and a straight wire across above it."""
    angles = np.array(angles)
    points = CIRCLE * np.stack([np.sin(angles), 0 * angles, np.cos(angles)], axis=1)
    height = CIRCLE + 2 * RADIUS + GAP
    across = straight((0, -0.01, height), (0, 0.01, height), 1)
    return f"""{wire("ARCH", points, backwards=backwards)}{wire("ACROSS", across, 101)}{MATERIAL}*ELSET, ELSET=WIRES
 ARCH, ACROSS
*BEAM SECTION, ELSET=WIRES, MATERIAL=STEEL, SECTION=CIRC
 {RADIUS}
*SURFACE INTERACTION, NAME=TOUCH
*CONTACT PAIR, INTERACTION=TOUCH
 ARCH, ACROSS
*BOUNDARY
 ARCH, ENCASTRE
 ACROSS, ENCASTRE
*STEP
*STATIC
*END STEP
"""


@pytest.mark.parametrize("backwards", [(), (1,), (0, 2)])
@pytest.mark.parametrize(
    "angles",
    [(-0.25, -0.05, 0.05, 0.15), (-0.15, -0.05, 0.05, 0.35), (-0.05, 0.05, 0.15, 0.25), (-0.3, -0.15, -0.05, 0.05)],
    ids=["after a longer element", "before a longer element", "in the first element", "in the last element"],
)
def test_the_axis_passes_the_top_of_the_arch(litz, tmp_path, angles, backwards):
    deck = tmp_path / "deck.inp"
    deck.write_text(arch(angles, backwards))
    process = litz("check", deck)
    assert process.returncode == 0, process.stderr
    (gap,) = re.findall(r"gap +(\S+)", process.stdout)
    # cubics through points at 0.1 rad are within R 0.1^4/384 of the circle, and tangents of parabolas within 0.1^3
    assert float(gap) == pytest.approx(GAP, abs=2e-6)

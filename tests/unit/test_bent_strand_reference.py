"""The references of a strand that is bent: against each other, against published formulas, and as they stand in the claims."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))

from verification.cases import bent_strand as case
from verification.claims import read_claims
from verification.references.bent_strand import Papailiou, Rods
from verification.references.helical_rods import Rod, Strand
from verification.strand_decks import bent_strand

CORE, WIRE = Rod(0.52e-3, 120e9, 0.34), Rod(0.5e-3, 120e9, 0.34)


def both(lay, friction=0.2, tension=50.0):
    strand = Strand(CORE, WIRE, 6, lay)
    return Papailiou(strand, friction, tension), Rods(strand, friction, tension)


@pytest.mark.parametrize("lay", [25e-3, 45e-3, 90e-3])
def test_smooth_rods_are_costellos_wires(lay):
    """A helical wire that slides freely: E I 2 cos b/(2 + nu sin^2 b)."""
    _, rods = both(lay)
    angle = rods.strand.free.angle
    wire = 2 * math.cos(angle) / (2 + WIRE.poisson * math.sin(angle) ** 2) * WIRE.ei
    assert rods.free == pytest.approx(CORE.ei + 6 * wire, rel=1e-12)


def test_both_agree_but_for_the_square_of_the_lay_angle():
    """Ten times the lay has a hundredth of the difference."""
    for name in ("sticking", "slipping", "first_slip"):
        differences = [abs(getattr(rods, name) / getattr(plane, name) - 1) for plane, rods in map(both, (0.9, 9.0))]
        assert differences[0] < 1e-4
        assert differences[1] == pytest.approx(differences[0] / 100, rel=0.05), name
    plane, rods = both(0.9)
    assert rods.friction_moment == pytest.approx(plane.friction_moment(1.0), rel=1e-3)


def test_stiffness_of_the_whole_section():
    """Steiner's theorem for straight wires: no lay angle."""
    plane, _ = both(1e3)
    radius = plane.strand.free.radius
    section = CORE.ei + 6 * WIRE.ei + 3 * WIRE.ea * radius**2
    assert plane.sticking == pytest.approx(section, rel=1e-6)


def test_moment_of_plane_sections():
    """Steady and without a kink where the first wires slip, and where all do; then with the stiffness of wires."""
    plane, _ = both(45e-3)
    first = plane.first_slip
    assert plane.moment(0.9 * first) == pytest.approx(plane.sticking * 0.9 * first, rel=1e-9)
    slope = (plane.moment(2.5 * first) - plane.moment(2.2 * first)) / (0.3 * first)
    assert slope == pytest.approx(plane.slipping, rel=1e-9)
    for place in (first, math.pi / 2 * 1.02 * first):
        around = [plane.moment(place * (1 + step)) for step in (-1e-4, 0, 1e-4)]
        assert around[2] - 2 * around[1] + around[0] == pytest.approx(0, abs=1e-2 * (around[2] - around[1]))


def test_the_loop_is_the_area_between_its_branches():
    plane, _ = both(45e-3)
    largest = 3 * plane.first_slip
    place = np.linspace(-largest, largest, 4001)
    down = np.array([plane.unloading(x, largest) for x in place])
    up = -down[::-1]
    assert plane.loop(largest) == pytest.approx(np.trapezoid(up - down, place), rel=1e-6)
    assert down[-1] == pytest.approx(plane.moment(largest), rel=1e-12)
    # opposite to where it began, after twice the first loading
    assert down[0] == pytest.approx(-plane.moment(largest), rel=1e-12)


def test_the_claims_have_the_values_of_the_references():
    claims = {
        one.id: one.reference for one in read_claims() if one.script == "bent_strand" and one.comparison != "at_most"
    }
    expected = {}
    for lay in case.LAYS:
        plane, rods = (case.theory(kind, lay) for kind in (Papailiou, Rods))
        expected |= {
            f"bent_strand.sticking.{lay}": plane.sticking,
            f"bent_strand.sticking_rods.{lay}": rods.sticking,
            f"bent_strand.smooth.{lay}": rods.free,
            f"bent_strand.first_slip.{lay}": plane.first_slip,
            f"bent_strand.first_slip_rods.{lay}": rods.first_slip,
        }
    plane, rods = (case.theory(kind, "short") for kind in (Papailiou, Rods))
    largest = case.LARGEST * plane.first_slip
    expected |= {
        "bent_strand.moment": [plane.moment(x * plane.first_slip) for x in case.COMPARED],
        "bent_strand.slipped": rods.slipping * largest + rods.friction_moment,
        "bent_strand.loop": plane.loop(largest),
    }
    assert set(expected) == set(claims)
    for key, value in expected.items():
        assert claims[key] == pytest.approx(value, rel=1e-10), key


def test_the_deck_is_read(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    options = dict(friction=0.2, elastic_slip=1e-11, stiffness=1e13, increments=[2])
    deck.write_text(bent_strand(case.strand_of("short"), 1e-4, [0.01], 6, **options))
    done = litz("check", deck)
    assert done.returncode == 0, done.stderr

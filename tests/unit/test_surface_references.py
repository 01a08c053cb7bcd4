"""The reference solutions of wires on rigid surfaces, against other methods."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_bvp, solve_ivp

sys.path.insert(0, str(Path(__file__).parents[2]))

from verification.cases import capstan as drums
from verification.cases import rigid_surfaces as planes
from verification.claims import CLAIMS, read_claims
from verification.references import pressed_on_plane
from verification.references.capstan import capstan

LISTED = {claim.id: claim.reference for claim in read_claims(CLAIMS)}


def test_friction_on_the_surface_of_a_thin_rod_is_that_on_its_centre_line():
    thin, line = capstan(5, math.pi, 0.3, 1e-6), capstan(5, math.pi, 0.3)
    assert thin == pytest.approx(line, rel=2e-6)


def test_the_moment_of_friction_takes_off_its_share_of_the_tension():
    """A limp rod: moments about the axis of the drum give the exponent `mu (1 - a/R)`, to the second order in `mu a/R`."""
    pull = capstan(1e6, math.pi, 0.1, 0.002).tension / 1e6
    # its lift-offs, at angles of 1e-3, take 1 % of this
    assert pull == pytest.approx(math.exp(0.1 * math.pi * (1 - 0.002)), rel=3e-4)
    line = capstan(1e6, math.pi, 0.1).tension / 1e6
    assert pull / line == pytest.approx(math.exp(-0.1 * math.pi * 0.002), rel=1e-5)


def test_forces_on_the_drum_are_those_of_its_differential_equations():
    """Tension, shear force and line force integrated numerically from the slack end, then the point force."""
    friction, thickness, slack = 0.3, 0.05, 5.0
    found = capstan(slack, math.pi, friction, thickness)
    inside = slack - 0.5

    def slopes(_, state):
        tension, force = state
        return [friction * force - thickness * friction * force, (tension - force) / (thickness * friction)]

    begin = [inside, found.slack_force / (thickness * friction)]
    way = solve_ivp(slopes, (0, found.arc), begin, method="Radau", rtol=1e-10, atol=1e-12)
    tension, force = way.y[:, -1]
    along, bend = tension + friction * found.pulling_force, 1 - thickness * friction * found.pulling_force
    across = found.pulling_force - thickness * friction * force
    assert math.hypot(along, across) == pytest.approx(found.tension, rel=1e-8)
    assert along + bend**2 / 2 == pytest.approx(found.tension, rel=1e-8)
    assert found.arc + math.acos(inside / slack) + math.acos(along / found.tension) == pytest.approx(math.pi)


@pytest.mark.parametrize("load", [1.5, 2.0, 3.9])
def test_a_beam_in_a_bore_follows_its_differential_equation(load):
    """One half, `B w'''' + P w'' = 0`, hinged at one end and held at the clearance without slope at the other."""
    load *= math.pi**2 / 4
    ends = solve_bvp(
        lambda x, w: np.array([w[1], w[2], w[3], -load * w[2]]),
        lambda a, b: np.array([a[0], a[2], b[0] - 1, b[1]]),
        np.linspace(0, 1, 50),
        np.zeros((4, 50)),
        tol=1e-8,
    )
    # two halves, each with the shear force and the inclined load at its hinge
    force = 2 * (ends.sol(0)[3] + load * ends.sol(0)[1])
    assert pressed_on_plane.force_in_bore(load, 1.0, 1.0, 1.0) == pytest.approx(force, rel=1e-5)


def test_a_beam_in_a_bore_touches_in_one_point_up_to_four_times_the_load_of_euler():
    for load in (0.9, 4.1):
        with pytest.raises(ValueError, match="touches in one point between"):
            pressed_on_plane.force_in_bore(load * math.pi**2 / 4, 1.0, 1.0, 1.0)


def test_a_curved_beam_touches_in_one_point_until_its_middle_is_flat():
    assert pressed_on_plane.flat_half(0.9, 1.0, 1.0, 1.0) == 0.0
    assert pressed_on_plane.flat_half(4.0, 1.0, 1.0, 1.0) == 0.75


def test_a_ring_is_shortened_by_the_work_of_its_moments():
    """Castigliano: the moment of a quarter is `F R (sin(a)/2 - 1/pi)` from the point between the forces."""
    angle = (np.arange(20000) + 0.5) / 20000 * np.pi / 2
    unit_moment = np.sin(angle) / 2 - 1 / np.pi
    shortening = 4 * np.mean(unit_moment**2) * np.pi / 2
    assert pressed_on_plane.ring_stiffness(1.0, 1.0) == pytest.approx(1 / shortening, rel=1e-5)


def test_the_force_per_length_of_a_pressed_wire_has_the_approach_of_its_strip():
    """Back from the force: strip of Hertz for a cylinder on a plane, and the approach of its section."""
    radius, young, poisson = 0.5e-3, 200e9, 0.3
    force = pressed_on_plane.line_force(1e-6, radius, young, poisson)
    modulus = young / (1 - poisson**2)
    width = 2 * math.sqrt(force * radius / (math.pi * modulus))
    approach = force / (math.pi * modulus) * (2 * math.log(2 * radius / width) - 1 / (4 * (1 - poisson)))
    assert approach == pytest.approx(1e-6, rel=1e-12)


def test_the_list_of_claims_has_the_values_of_the_references():
    for name, (tension, friction, _) in drums.CASES.items():
        found = capstan(tension, math.pi, friction, drums.THICKNESS)
        assert LISTED[f"capstan.{name}.tension"] == pytest.approx(found.tension / tension, rel=1e-9)
        ends = [math.degrees(found.arc), found.slack_force, found.pulling_force]
        assert LISTED[f"capstan.{name}.ends"] == pytest.approx(ends, rel=1e-9)
    hanging = capstan(5, math.pi, 0.0)
    assert LISTED["capstan.hanging"] == pytest.approx(
        [math.degrees(hanging.arc), hanging.slack_force, hanging.pulling_force], rel=1e-9
    )
    flat = [pressed_on_plane.flat_half(load, planes.HALF, planes.BENDING, planes.CURVATURE) for load in planes.LOADS]
    assert LISTED["rigid_surfaces.flat"] == pytest.approx(flat, rel=1e-9)
    half = planes.LENGTH / 2
    bore = [
        pressed_on_plane.force_in_bore(load, half, planes.BENDING, planes.CLEARANCE) for load in planes.COMPRESSIONS
    ]
    assert LISTED["rigid_surfaces.bore"] == pytest.approx(bore, rel=1e-9)
    ring = pressed_on_plane.ring_stiffness(planes.RING, planes.BENDING)
    assert LISTED["rigid_surfaces.ring"] == pytest.approx(ring, rel=1e-9)
    wire = planes.WIRE
    pressed = [
        pressed_on_plane.line_force(approach / 2, wire.radius, wire.young, wire.poisson)
        for approach in planes.APPROACHES
    ]
    assert LISTED["rigid_surfaces.pressed"] == pytest.approx(pressed, rel=1e-9)

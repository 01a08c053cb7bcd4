"""Reference solutions for wires side by side: against printed values, and against computations of another kind."""

import importlib
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_bvp
from scipy.special import j1

sys.path.insert(0, str(Path(__file__).parents[2]))

from verification import line_decks
from verification.cases import turned_wires
from verification.claims import read_claims
from verification.references.capstan import capstan
from verification.references.closed_coil import ClosedCoil, next_turn
from verification.references.helical_rods import (
    STRAIGHT,
    Bundle,
    Helix,
    Rod,
    Strand,
    TwistedPair,
    energy,
    loads,
    neighbour,
)
from verification.references.hertz import end_on_end, end_on_wire
from verification.references.line_joints import LineJoint
from verification.references.parallel_wires import ParallelWires, PressedWire
from verification.references.plectoneme import under_tension
from verification.references.slipping_pair import SlippingPair
from verification.references.touching_beams import Cantilevers, SharedLoad, ThreePointBending
from verification.run import main

PAIR = TwistedPair(Rod(0.5e-3, 200e9, 0.3), 0.1)
STRAND = Strand(Rod(1.97e-3, 188e9, 0.3), Rod(1.865e-3, 188e9, 0.3), 6, 0.115)
TRIPLE = Bundle(PAIR.rod, 3, 30e-3).state(1e-4, 0.1, lambda line: line / 1e10)
COPPER = PressedWire(1e-3, 120e9, 0.34, 1.7e-8)
STEEL = PressedWire(0.3e-3, 200e9, 0.28, 1.4e-7)


@pytest.mark.parametrize("free", [STRAIGHT, Helix(1.1e-3, 0.9, 290.0)])
def test_loads_of_a_helix_are_the_derivatives_of_its_energy(free):
    rod, helix, step = PAIR.rod, Helix(1e-3, 0.95, 300.0), 1e-5
    for i, found in enumerate(loads(rod, helix, free)):
        up, down = ([*helix] for _ in range(2))
        up[i] *= 1 + step
        down[i] *= 1 - step
        slope = (energy(rod, Helix(*up), free) - energy(rod, Helix(*down), free)) / (2 * step * helix[i])
        assert found == pytest.approx(slope, rel=1e-6)


@pytest.mark.parametrize(
    ("turns", "load", "penalty", "line", "force", "moment", "height", "degrees"),
    [
        (1, {"height": 1.0}, None, 170.516858272, 154.899100139, 0.951994993981, 1.0, 1.79940817416),
        (1, {"height": 1.0}, 1e11, 170.516046592, 154.898572274, 0.951994975479, 1.0, 1.7994051079),
        (1, {"force": 200.0}, None, 214.996237621, 200.0, 0.95270282471, 1.00014370219, 1.79914980236),
        (2, {"height": 1.0}, None, 2721.19501692, 618.015172814, 1.9218944909, 1.0, 3.59527377987),
        (2, {"force": 0.0}, None, 282.479201045, 0.0, 1.90249664248, 0.998025028021, 3.60236967967),
        (2, {"height": 1.0}, 1e11, 2720.98865574, 617.981640167, 1.92189213819, 1.0, 3.59517620946),
        (2, {"force": 200.0}, 1e11, 1072.73212532, 200.0, 1.90878227068, 0.998664209241, 3.60003158082),
    ],
)
def test_two_wires_twisted_together(turns, load, penalty, line, force, moment, height, degrees):
    """Values computed with 40 digits from the energy alone."""
    approach = None if penalty is None else lambda p: p / penalty
    solve = PAIR.stretched if "height" in load else PAIR.pulled
    state = solve(turns, *load.values(), approach)
    assert state.line_force == pytest.approx(line, rel=1e-8)
    assert state.force == pytest.approx(force, rel=1e-9, abs=1e-8)
    assert state.moment == pytest.approx(moment, rel=1e-10)
    assert state.helix.height == pytest.approx(height, rel=1e-11)
    assert math.degrees(state.helix.angle) == pytest.approx(degrees, rel=1e-10)


def test_stiffness_of_a_strand():
    """Values computed with 40 digits from the linearised equations of helical rods."""
    k_ee, k_et, k_tt, line = STRAND.stiffness()
    assert k_ee == pytest.approx(13849885.9899, rel=1e-8)
    assert k_et == pytest.approx(9258.028498, rel=1e-8)
    assert k_tt == pytest.approx(17.9574156058, rel=1e-8)
    assert line == pytest.approx(21528002.4099, rel=1e-7)
    assert math.degrees(STRAND.free.angle) == pytest.approx(11.8340164121, rel=1e-11)
    # the matrix is symmetric
    strained = [STRAND.state(sign * 1e-6).moment for sign in (1, -1)]
    assert (strained[0] - strained[1]) / 2e-6 == pytest.approx(k_et, rel=1e-8)


def test_stiffness_of_a_strand_with_contraction():
    strand = Strand(STRAND.core, STRAND.wire, 6, STRAND.pitch, contraction=1.0)
    up, down = (strand.state(sign * 1e-6) for sign in (1, -1))
    assert (up.force - down.force) / 2e-6 == pytest.approx(13702063, rel=1e-6)
    assert (up.moment - down.moment) / 2e-6 == pytest.approx(9130.7174, rel=1e-6)


@pytest.mark.parametrize(
    ("strain", "force", "moment", "line", "free_force", "free_turn"),
    [
        (0.001, 13850.6105455, 9.24939746426, 21507.8998915, 9119.97800427, -0.514022974663),
        (0.003, 41556.1625901, 27.6965473745, 64403.4139717, 27618.6522518, -1.5325543586),
        (0.005, 69267.4530526, 46.075149617, 107139.275891, 46461.9310872, -2.53769553893),
    ],
)
def test_a_strand_is_pulled(strain, force, moment, line, free_force, free_turn):
    held = STRAND.state(strain)
    assert [held.force, held.moment, held.line_force] == pytest.approx([force, moment, line], rel=1e-9)
    turn, free = STRAND.pulled_free(strain)
    assert [turn, free.force] == pytest.approx([free_turn, free_force], rel=1e-9)


def test_a_closed_coil_has_the_loads_of_its_energy():
    """Derivatives of the energy by differences; turns that just do not touch, and brute force for the next turn."""
    rod = Rod(1e-3, 200e9, 0.3)
    turn = math.hypot(2 * math.pi * 3e-3, 2.2e-3)
    coil = ClosedCoil(rod, Helix(3e-3, 2.2e-3 / turn, 2 * math.pi / turn), 1e9)
    for height in (1.99e-3, 2.1e-3):
        helix = coil.state(height / turn).helix
        angle = np.linspace(1.5 * math.pi, 2 * math.pi, 400001)
        places = np.stack([3 * np.cos(angle), 3 * np.sin(angle), 1e3 * helix.height * angle / helix.turn])
        places[:2] *= helix.radius / 3e-3
        distance = 1e-3 * np.linalg.norm(places - [[1e3 * helix.radius], [0], [0]], axis=0).min()
        assert next_turn(helix)[0] == pytest.approx(distance, rel=1e-10)
        assert coil.line_force(helix) == pytest.approx(1e9 * max(0, 2e-3 - distance), rel=1e-6)
        for i, load in enumerate(coil.loads(helix)):
            up, down = (helix._replace(**{helix._fields[i]: helix[i] * (1 + h)}) for h in (1e-6, -1e-6))
            slope = (coil.energy(up) - coil.energy(down)) / (2e-6 * helix[i])
            assert slope == pytest.approx(load, rel=1e-5, abs=1e-3 if i == 0 else 0)
    # a coil is pushed out of its shape by little: the old formula of close-coiled springs
    spring = ClosedCoil(
        rod, Helix(0.1, 1e-2 / math.hypot(0.2 * math.pi, 1e-2), 2 * math.pi / math.hypot(0.2 * math.pi, 1e-2)), 1e9
    )
    push = spring.state(0.99 * spring.free.height)
    shear = rod.young / (2 * (1 + rod.poisson))
    assert push.force == pytest.approx(-shear * 2e-3**4 * 1e-4 / (8 * 0.2**3), rel=2e-3)


@pytest.mark.parametrize(
    ("force", "degrees", "moment", "line"),
    [(0.005, 13.6227640, 0.0285652835, 0.00346134198), (0.05, 23.5308751, 0.171300110, 0.0372965972)],
)
def test_a_ply_is_stationary(force, degrees, moment, line):
    """The closed forms, computed with 40 digits, and the derivatives of the potential of the ply."""
    ply = under_tension(force, 1.0, 1.0)
    assert math.degrees(ply.angle) == pytest.approx(degrees, rel=1e-8)
    assert [ply.moment, ply.line_force] == pytest.approx([moment, line], rel=1e-8)

    def potential(angle, radius):
        return math.sin(angle) ** 4 / (2 * radius**2) + ply.force - ply.moment * math.sin(2 * angle) / (2 * radius)

    step = 1e-5
    assert potential(ply.angle, 1.0) == pytest.approx(0, abs=1e-12)
    assert potential(ply.angle + step, 1.0) == pytest.approx(potential(ply.angle - step, 1.0), abs=1e-12)
    pressed = (potential(ply.angle, 1 + step) - potential(ply.angle, 1 - step)) / (2 * step)
    assert pressed == pytest.approx(line, rel=1e-7)
    # strands that give way are closer to each other, as far as their force is
    soft = under_tension(force, 1.0, 1.0, stiffness=2.0)
    assert soft.line_force == pytest.approx(2.0 * 2 * (1.0 - soft.radius), rel=1e-10)


def test_a_strand_of_soft_surfaces_is_softer_and_stands_in_equilibrium():
    soft = STRAND.state(1e-3, approach=lambda p: p / 1e10)
    assert STRAND.free.radius - soft.helix.radius == pytest.approx(soft.line_force / 1e10, rel=1e-9)
    assert soft.force < STRAND.state(1e-3).force
    # what the wires press on the core is the tension times the curvature, as of a rope, and little besides
    wire, helix = STRAND.wire, soft.helix
    assert soft.line_force == pytest.approx(wire.ea * (helix.stretch - 1) * helix.bending, rel=0.02)


@pytest.mark.parametrize(
    ("conductance", "resistance"),
    [(1e2, 0.5002887143662095), (1e4, 0.005288508912896968), (1e6, 0.0003238820733496021)],
)
def test_resistance_of_a_lap_joint(conductance, resistance):
    r = 1 / (5.88e7 * math.pi * 0.5e-3**2)
    assert LineJoint(20e-3, conductance, r, r).lap() == pytest.approx(resistance, rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("hairpin", [False, True])
def test_joints_are_the_limit_of_a_ladder_of_resistors(hairpin):
    joint, n = LineJoint(20e-3, 3e4, 0.02, 0.07), 2000
    h = joint.length / n
    size = 2 * (n + 1)
    network = np.zeros((size, size))

    def resistor(i, j, value):
        network[[i, j], [i, j]] += 1 / value
        network[[i, j], [j, i]] -= 1 / value

    for i in range(n + 1):
        resistor(2 * i, 2 * i + 1, 1 / (joint.conductance * h * (0.5 if i in (0, n) else 1.0)))
        if i < n:
            resistor(2 * i, 2 * i + 2, joint.resistance * h)
            resistor(2 * i + 1, 2 * i + 3, joint.resistance_2 * h)
    out = 1 if hairpin else size - 1
    keep = np.delete(np.arange(size), out)
    current = np.zeros(size)
    current[0] = 1.0
    v = np.zeros(size)
    v[keep] = np.linalg.solve(network[np.ix_(keep, keep)], current[keep])
    # the ladder converges with the square of m h = 1/2000 of m L = 1
    assert (joint.hairpin() if hairpin else joint.lap()) == pytest.approx(v[0], rel=1e-6)
    along = joint.hairpin_current if hairpin else joint.lap_current
    currents = -np.diff(v[::2]) / (joint.resistance * h)
    np.testing.assert_allclose(along((np.arange(n) + 0.5) * h), currents, atol=2e-6)


def test_the_approach_of_a_disc_is_that_of_its_fourier_series():
    """A disc under a semi-elliptic load on its rim, held by shear all over, by Michell's stress functions.

    Radial traction p_n cos(n phi) on the rim of a disc of unit radius, plane strain, displacement of the rim per p_n/(2 G):
    n = 0: 1 - 2 nu; n = 1, balanced by a uniform body force: (1 - 2 nu)/2; n > 1: from A r^n and B r^(n+2).
    """
    nu = 0.3
    kappa = 3 - 4 * nu
    n = np.arange(2, 400_000)
    # unit traction, none along the rim: n (n-1) A + (n+1) (n-2) B = 1, (n-1) A + (n+1) B = 0
    a, b = 1 / (2 * (n - 1)), -1 / (2 * (n + 1))
    rim = n * a - (kappa - n - 1) * b

    def beyond_the_series(width):
        load, first = (2 * j1(k * width) / (k * width) / math.pi for k in (n, 1))
        # 2 G = 1/(1 + nu) for E = 1; inward under the middle of the strip, of the unit load per length
        series = (1 + nu) * ((1 - 2 * nu) / (2 * math.pi) + first * (1 - 2 * nu) / 2 + np.sum(load * rim))
        wire = PressedWire(1.0, 1.0, nu)
        pair = ParallelWires(wire, wire)
        force = (width / pair.half_width(1.0)) ** 2
        return pair.approach(force) / (2 * force) - series

    # a term of first order in b/r is left out, 0.1 of it; extrapolated to none, terms of the order (b/r)^2 ln(b/r) are left
    assert abs(beyond_the_series(0.01)) < 1.5e-3
    assert 2 * beyond_the_series(0.01) - beyond_the_series(0.02) == pytest.approx(0, abs=1e-4)


def test_the_resistance_of_a_disc_is_that_of_the_logarithmic_potential():
    """Flux on an arc of the rim, the distribution that keeps the arc at one potential, and a uniform sink all over.

    Neumann's function of the unit disc with a uniform sink and the mean 0: (-ln|x - y| + 1/8)/pi for both on the rim.
    """
    half, n = 0.3, 4000
    # equilibrium on an arc: sin(phi/2) = sin(half/2) cos(theta), theta uniform
    theta = (np.arange(n) + 0.5) * math.pi / n
    phi = 2 * np.arcsin(math.sin(half / 2) * np.cos(theta))
    at = 2 * math.asin(math.sin(half / 2) * math.cos(1.0 * math.pi * 1234 / n))
    potential = np.mean(-np.log(np.abs(2 * np.sin((at - phi) / 2))) + 1 / 8) / math.pi
    wire = PressedWire(1.0, 1.0, 0.0, 1.0)
    pair = ParallelWires(wire, wire)
    force = (half / pair.half_width(1.0)) ** 2
    assert pair.resistance_of_arc(force) / 2 == pytest.approx(potential, rel=1e-3)
    assert 1 / pair.conductance(force) == pytest.approx(pair.resistance_of_arc(force), rel=half**2 / 24)


def test_equal_clean_wires_have_the_conductance_of_one_logarithm():
    pair = ParallelWires(COPPER, COPPER)
    b = pair.half_width(100.0)
    logarithm = math.log(2 * math.exp(1 / 8) * COPPER.radius / b)
    assert pair.conductance(100.0) == pytest.approx(math.pi / (2 * COPPER.resistivity * logarithm), rel=1e-12)


def test_unequal_wires_with_a_film():
    clean, filmed = ParallelWires(COPPER, STEEL), ParallelWires(COPPER, STEEL, film=1e-12)
    assert ParallelWires(STEEL, COPPER).approach(50.0) == clean.approach(50.0)
    assert clean.force(clean.approach(50.0)) == pytest.approx(50.0, rel=1e-10)
    added = 1 / filmed.conductance(50.0) - 1 / clean.conductance(50.0)
    assert added == pytest.approx(1e-12 / (2 * clean.half_width(50.0)), rel=1e-10)


def test_cantilevers_touch_at_the_tip_of_the_shorter_one_only():
    beams = Cantilevers(0.15, 0.1, 2.0, 3.0, 1.0)
    x = np.linspace(0, 0.1, 101)
    gap = beams.gap(x)
    assert gap[-1] == pytest.approx(0, abs=1e-18)
    assert np.all(gap[1:-1] > 0)
    # moments integrated twice
    s = np.linspace(0, 0.15, 150001)
    step = s[1]
    moment = 1.0 * (0.15 - s) - beams.contact_force * np.clip(0.1 - s, 0, None)
    slope = np.cumsum((moment[1:] + moment[:-1]) / 2) * step / 2.0
    deflection = np.cumsum(np.concatenate([[0], slope]))[:-1] * step + slope * step / 2
    assert deflection[-1] == pytest.approx(beams.deflection, rel=1e-4)
    assert deflection[99999] == pytest.approx(beams.support_deflection, rel=1e-4)


def test_cantilevers_of_one_length_share_the_force_as_their_stiffnesses():
    beams = Cantilevers(0.1, 0.1, 2.0, 3.0, 1.0)
    assert beams.contact_force == pytest.approx(0.6)
    assert beams.gap(np.linspace(0, 0.1, 11)) == pytest.approx(0, abs=1e-18)
    assert beams.deflection == pytest.approx(0.1**3 / (3 * 5.0))


def test_beams_in_three_point_bending_bend_alike():
    beams = ThreePointBending(0.2, 2.0, 3.0, 10.0)
    upper = (beams.force - beams.middle_force) * 0.2**3 / (48 * 2.0)
    lower = beams.middle_force * 0.2**3 / (48 * 3.0)
    assert [upper, lower] == pytest.approx(2 * [beams.deflection])
    assert 2 * beams.end_force + beams.middle_force == pytest.approx(10.0)


@pytest.mark.parametrize("stiffness", [1e3, 1e6])
def test_two_clamped_beams_share_a_load(stiffness):
    """Against a collocation of both beams, not of their difference."""
    beams = SharedLoad(0.2, 2.0, 3.0, 100.0, stiffness)

    def bent(x, y):
        pressure = stiffness * (y[0] - y[4])
        return np.vstack([y[1:4], [(100.0 - pressure) / 2.0], y[5:], [pressure / 3.0]])

    def clamped(start, end):
        return np.array([*start[:2], *start[4:6], *end[:2], *end[4:6]])

    x = np.linspace(0, 0.2, 201)
    found = solve_bvp(bent, clamped, x, np.zeros((8, len(x))), tol=1e-8, max_nodes=100_000)
    assert found.success
    pressure = stiffness * (found.sol(x)[0] - found.sol(x)[4])
    np.testing.assert_allclose(beams.pressure(x), pressure, atol=2e-5 * beams.far_pressure)
    # the shear at the clamp of the lower beam
    assert beams.reaction == pytest.approx(abs(3.0 * found.sol(0.0)[7]), rel=1e-5)


def test_a_slipping_pair():
    pair = SlippingPair(0.5e-3, 50e-3, 200e9, 200.0, 0.3)
    assert pair.slip_force == pytest.approx(0.075, rel=1e-12)
    assert pair.stuck_stiffness == pytest.approx(2356.194490192345, rel=1e-12)
    assert pair.slipping_stiffness == pytest.approx(471.23889803846896, rel=1e-12)
    load = [0.075, 0.15, 0.0, -0.15, 0.15]
    first, second, *_, last = pair.path(load)
    assert [first, second, last] == pytest.approx([3.183098861837907e-5, *2 * [1.9098593171027435e-4]], rel=1e-12)
    assert pair.loss(0.15) == pytest.approx(3.8197186342054865e-5, rel=1e-12)
    # the loop that the path encloses
    turn = 0.15 * np.concatenate([np.linspace(1, -1, 4001), np.linspace(-1, 1, 4001)[1:]])
    way = np.array(pair.path(np.concatenate([[0.15], turn]))[1:])
    loop = np.sum((turn[1:] + turn[:-1]) / 2 * np.diff(way))
    assert abs(loop) == pytest.approx(pair.loss(0.15), rel=1e-3)
    assert pair.loss(0.07) == 0.0


@pytest.mark.parametrize(
    ("slack", "friction", "ratio", "arc", "slack_force", "pulling_force"),
    [
        (5, 0.0, 1.0, 128.316134474, 2.17944947177, 2.17944947177),
        (5, 0.1, 1.33855345838, 131.870568153, 2.17944947177, 2.53826068242),
        (5, 0.3, 2.42600086522, 137.650032915, 2.17944947177, 3.44673821549),
        (20, 0.0, 1.0, 154.322863718, 4.44409720866, 4.44409720866),
        (20, 0.1, 1.3606248014, 156.161103006, 4.44409720866, 5.19254234726),
        (20, 0.3, 2.52748295469, 159.096101791, 4.44409720866, 7.09222524556),
    ],
)
def test_a_capstan_with_bending_stiffness(slack, friction, ratio, arc, slack_force, pulling_force):
    found = capstan(slack, math.pi, friction)
    # the printed values come from an integration to 1e-8
    assert found.tension / slack == pytest.approx(ratio, rel=1e-8)
    assert math.degrees(found.arc) == pytest.approx(arc, rel=1e-8)
    assert [found.slack_force, found.pulling_force] == pytest.approx([slack_force, pulling_force], rel=1e-8)


def test_a_capstan_of_a_limp_rod_is_that_of_euler():
    assert capstan(1e6, math.pi, 0.3).tension / 1e6 == pytest.approx(math.exp(0.3 * math.pi), rel=2e-3)


def test_a_rod_that_is_pulled_too_little_does_not_reach_the_drum():
    with pytest.raises(ValueError, match="does not bring the rod onto the drum"):
        capstan(0.4, math.pi, 0.1)


def test_a_list_of_claims_of_its_own_is_read(capsys, tmp_path):
    text = (Path(__file__).parents[2] / "verification" / "claims.toml").read_text(encoding="utf-8")
    own = next(case for case in text.split("[[case]]") if 'script = "slipping_pair"' in case)
    (tmp_path / "own.toml").write_text(f"[[case]]{own}", encoding="utf-8")
    assert main(["--claims", str(tmp_path / "own.toml"), "elastica"]) == 2
    assert "there is no case elastica; there are slipping_pair" in capsys.readouterr().err


def test_neighbours_on_a_helix_are_as_far_apart_as_fine_polygons():
    radius, pitch, step = 1.1e-3, 17e-3, 1e-7
    angle = np.linspace(-2.5, -1.5, 200001)
    apart = [radius * np.cos(angle) - radius, radius * np.sin(angle), pitch * (angle + 2 * math.pi / 3) / (2 * math.pi)]
    distance, by_radius, by_pitch = neighbour(radius, pitch, 3)
    assert distance == pytest.approx(np.sqrt(np.sum(np.square(apart), 0)).min(), rel=1e-9)
    for slope, change in ((by_radius, (step, 0)), (by_pitch, (0, step))):
        up, down = (neighbour(radius + sign * change[0], pitch + sign * change[1], 3)[0] for sign in (1, -1))
        assert slope == pytest.approx((up - down) / (2 * step), rel=1e-5)


def test_loads_of_three_wires_are_the_derivatives_of_their_energy():
    """With an elastic contact, energy and loads at equilibrium."""
    bundle, stiffness, strain, turn, step = Bundle(PAIR.rod, 3, 30e-3), 1e10, 1e-3, 1.0, 1e-6

    def whole_energy(strain, turn):
        state = bundle.state(strain, turn, lambda line: line / stiffness)
        return 3 * (energy(bundle.wire, state.helix, bundle.free) + state.line_force**2 / (2 * stiffness))

    state = bundle.state(strain, turn, lambda line: line / stiffness)
    # of the wires, per length of the bundle
    height = bundle.free.height
    by_strain = (whole_energy(strain + step, turn) - whole_energy(strain - step, turn)) / (2 * step)
    by_turn = (whole_energy(strain, turn + 1e-2) - whole_energy(strain, turn - 1e-2)) / 2e-2
    assert state.force == pytest.approx(by_strain / height, rel=1e-5)
    assert state.moment == pytest.approx(by_turn / height, rel=1e-5)


def nearly_parallel(case, i):
    return case.PAIR.nearly_parallel(case.FORCE, case.ANGLES[i], case.LENGTH)


@pytest.mark.parametrize("degrees", [0.0, 0.02, 0.3])
def test_sections_of_wires_that_cross_at_a_small_angle_carry_the_force(degrees):
    pair, length, force = ParallelWires(COPPER, STEEL), 30e-3, 20.0
    overlap, conductance = pair.nearly_parallel(force, math.radians(degrees), length)
    # the middles of 4000 pieces; the axes of straight wires at their distance
    x = (np.arange(4000) + 0.5) / 4000 * length / 2
    distance = pair.first.radius + pair.second.radius
    apart = np.hypot(distance - overlap, x * math.sin(math.radians(degrees)))
    forces = [pair.force(distance - each) for each in apart if each < distance]
    assert 2 * sum(forces) * length / 8000 == pytest.approx(force, rel=1e-3)
    assert 2 * sum(map(pair.conductance, forces)) * length / 8000 == pytest.approx(conductance, rel=1e-3)


#: What the reference solutions give for each claim of a case
EXPECTED = {
    "twisted_pair": lambda case: {
        f"twisted_pair.{law}{name}": getattr(case.states(approach)[1][-1], name)
        for law, approach in (("", case.approach_of(case.PAIR.rod, case.PAIR.rod)), ("linear.", lambda f: f / 1e11))
        for name in ("force", "moment", "line_force")
    },
    "pulled_strand": lambda case: {
        f"pulled_strand.{name}": getattr(case.exact(), name) for name in ("force", "moment", "line_force")
    },
    "closed_coil": lambda case: {
        "closed_coil.apart.force": case.exact()[0].force,
        **{f"closed_coil.{name}": getattr(case.exact()[1], name) for name in ("force", "moment", "line_force")},
    },
    "line_joints": lambda case: (
        {
            f"line_joints.{name}.{what}": value
            for name, pair in case.PAIRS.items()
            for force in [pair.force(case.OVERLAP)]
            for what, value in (("force", force), ("conductance", pair.conductance(force)))
        }
        | {
            f"line_joints.{kind}": [
                getattr(LineJoint(case.LENGTH, g, case.RESISTANCE, case.RESISTANCE), kind)() for g in case.CONDUCTANCES
            ]
            for kind in ("lap", "hairpin")
        }
    ),
    "current_sharing": lambda case: {
        "current_sharing.ladder": [
            case.LADDER.hairpin(),
            LineJoint(case.LENGTH / 2, case.CONDUCTANCE, *case.PER_LENGTH).hairpin() / 2,
        ],
        "current_sharing.share": case.LADDER.lap_current(np.array(case.PLACES) * case.LENGTH),
        "current_sharing.length": 1 / case.LADDER.rate,
        "current_sharing.joint.between": case.ONE_JOINT.between(),
        "current_sharing.joint.resistance": case.ONE_JOINT.resistance(),
        "current_sharing.joint.share": case.ONE_JOINT.share(),
    },
    "ends": lambda case: {
        "ends.side.force": [case.exact(end_on_wire)[0]] * len(case.ANGLES),
        "ends.side.resistance": [case.exact(end_on_wire)[1]] * len(case.ANGLES),
        "ends.end.force": case.exact(end_on_end)[0],
        "ends.end.resistance": case.exact(end_on_end)[1],
        "ends.lap": [1.0] * (len(case.LAPS) - 1),
        "ends.lap.ends": case.force_of_round_ends(),
    },
    "touching_beams": lambda case: {
        "touching_beams.tip": [case.TIPS.support_deflection, case.TIPS.deflection],
        "touching_beams.tip_force": case.TIPS.contact_force,
        "touching_beams.middle": [case.BENDING.force / 2, case.BENDING.deflection],
        "touching_beams.reaction": case.SHARED.reaction,
    },
    "slipping_pair": lambda case: {
        "slipping_pair.path": case.PAIR.path(case.FORCES),
        "slipping_pair.loss": case.PAIR.loss(case.FORCES[-1]),
    },
    "turned_strands": lambda case: {
        f"turned_strands.{name}.{what}": [getattr(state, what) for state in states]
        for name, states in (("strand", case.strand_states()), ("triangle", case.triangle_states()))
        for what in ("force", "moment", "line_force")
    },
    "turned_wires": lambda case: (
        {
            f"turned_wires.crossed.{what}": [getattr(case.crossed(case.ANGLES[i]), name) for i in case.CROSSED]
            for what, name in (("overlap", "approach"), ("resistance", "resistance"))
        }
        | {
            "turned_wires.overlap": [nearly_parallel(case, i)[0] for i in case.SMALL[:2]],
            "turned_wires.parallel": nearly_parallel(case, -1)[0],
            "turned_wires.resistance": [1 / nearly_parallel(case, i)[1] for i in case.SMALL[1:]],
            "turned_wires.fine.sections": 1 / case.PAIR.nearly_parallel(case.FORCE, case.FINE[-1], case.LENGTH)[1],
        }
    ),
}


@pytest.mark.parametrize("name", EXPECTED)
def test_the_values_of_the_claims_are_those_of_the_reference_solutions(name):
    case = importlib.import_module(f"verification.cases.{name}")
    claims = {
        claim.id: claim.reference for claim in read_claims() if claim.script == name and claim.comparison != "at_most"
    }
    expected = EXPECTED[name](case)
    assert set(expected) == set(claims)
    for key, value in expected.items():
        # as many digits as stand in the claims
        assert claims[key] == pytest.approx(value, rel=1e-10), key


@pytest.mark.parametrize(
    "text",
    [
        lambda: line_decks.twisted_pair(PAIR, [PAIR.stretched(0.02, 1.0)], [0.02], 6),
        lambda: line_decks.pulled_strand(STRAND, [STRAND.state(1e-4)], 0.02, 6),
        lambda: line_decks.cantilevers(PAIR.rod, PAIR.rod, Cantilevers(0.15, 0.1, 2.0, 3.0, 1.0), (4, 7)),
        lambda: line_decks.three_point_bending(PAIR.rod, PAIR.rod, ThreePointBending(0.2, 2.0, 3.0, 10.0), (4, 5)),
        lambda: line_decks.shared_load(
            PAIR.rod, PAIR.rod, SharedLoad(0.2, 2.0, 3.0, 100.0, 1e9), (4, 5), stiffness=None
        ),
        lambda: line_decks.pressed_pair(ParallelWires(COPPER, STEEL), [1e-7], 0.02, 4, elements_2=5),
        lambda: line_decks.pressed_pair(ParallelWires(COPPER, STEEL), [1e-7], 0.02, 4, potentials="lap"),
        lambda: line_decks.slipping_pair(PAIR.rod, SlippingPair(0.5e-3, 50e-3, 200e9, 200.0, 0.3), 4, [0.1], 1e-11),
        lambda: line_decks.pulled_strand(Bundle(PAIR.rod, 3, 30e-3), [TRIPLE], 0.02, 30),
        lambda: turned_wires.sweep("HERTZ"),
        lambda: turned_wires.over_arc("HERTZ"),
    ],
    ids=[
        "twisted",
        "strand",
        "cantilevers",
        "three points",
        "shared",
        "pressed",
        "lap",
        "slipping",
        "three",
        "turned",
        "arc",
    ],
)
def test_the_decks_are_read(text, litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(text())
    done = litz("check", deck)
    assert "error" not in done.stderr.replace("errors", "") or "not modelled" in done.stderr, done.stderr


def test_the_ends_of_a_twisted_pair_follow_its_helices():
    """The section at the end of a helix stands normal to its tangent, and turns on without a jump."""
    vector = np.zeros(3)
    for turn in np.linspace(0, 1.5 * math.pi, 200):
        helix = Helix(0.5e-3, 1.0, 100.0)
        place, rotation = line_decks.on_helix(helix, turn, 0.3)
        w = helix.turn
        tangent = [-helix.radius * w * math.sin(turn), helix.radius * w * math.cos(turn), helix.height]
        np.testing.assert_allclose(rotation.apply([0, 0, 1]), tangent / np.linalg.norm(tangent), atol=1e-14)
        np.testing.assert_allclose(
            place, [helix.radius * math.cos(turn), helix.radius * math.sin(turn), 0.3], atol=1e-18
        )
        following = line_decks.rotation_vector(rotation, np.array([0.0, 0.0, turn]))
        assert np.linalg.norm(following - vector) < 0.1 + (turn == 0)
        vector = following

"""Forces on the length of wires: *DLOAD against closed forms and against integrated rod equations."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp, solve_ivp

from decks import straight, wire
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

YOUNG, RADIUS, LENGTH, DENSITY = 200e9, 1e-3, 0.1, 7850.0
AREA = np.pi * RADIUS**2
EI = YOUNG * np.pi * RADIUS**4 / 4
#: The wire lies along x; its first section axis is y, the second one z
AXIS = " 0, 1, 0"


def beam(*steps, held="1, ENCASTRE", element="B33", points=None, n=8, closed=False, static="1, 1, 1e-3, 1", axis=AXIS):
    """A steel wire along x, or through points; `steps` are the cards of each step."""
    points = straight((0, 0, 0), (LENGTH, 0, 0), n) if points is None else points
    text = wire("WIRE", points, element=element, closed=closed)
    text += f"*MATERIAL, NAME=STEEL\n*ELASTIC\n {YOUNG}, 0\n*DENSITY\n {DENSITY}\n"
    text += f"*BEAM SECTION, ELSET=WIRE, MATERIAL=STEEL, SECTION=CIRC\n {RADIUS}\n{axis}\n*BOUNDARY\n {held}\n"
    return text + "".join(
        f"*STEP, INC=500\n*STATIC\n {static}\n{cards}\n*NODE PRINT, NSET=WIRE, TOTALS=ONLY\n RF\n*ENERGY PRINT\n*END STEP\n"
        for cards in steps
    )


def finished(run, deck, *arguments):
    process, results = run(deck, *arguments)
    assert process.returncode == 0, process.stderr
    return results


#: Small enough that the deflection of a cantilever is linear in it to 1e-9 [N/m]
SMALL = 1e-4


@pytest.mark.parametrize("n", [1, 5])
@pytest.mark.parametrize(("label", "component"), [("PY", 1), ("PZ", 2), ("P1", 1), ("P2", 2)])
def test_cubic_elements_bend_exactly_under_a_uniform_load(run, n, label, component):
    """q L^4/(8 EI) at the end of a cantilever, q L at its support, and the moment q L^2/2 there."""
    results = finished(run, beam(f"*DLOAD\n WIRE, {label}, {SMALL}", n=n))
    assert results.field("displacement")[-1, component] == pytest.approx(SMALL * LENGTH**4 / (8 * EI), rel=1e-8)
    assert results.field("reaction_force")[0, component] == pytest.approx(-SMALL * LENGTH, rel=1e-9)
    about, sign = (5, 1) if component == 1 else (4, -1)
    moment = results.field("reaction_moment")[0]
    assert moment[about - 3] == pytest.approx(-sign * SMALL * LENGTH**2 / 2, rel=1e-8)


def test_a_wire_on_two_supports_sags_by_five_parts_in_384(run):
    deck = beam(f"*DLOAD\n WIRE, PZ, -{SMALL}", held="1, 1, 4\n 9, 2, 3", n=8)
    results = finished(run, deck)
    assert results.field("displacement")[4, 2] == pytest.approx(-5 * SMALL * LENGTH**4 / (384 * EI), rel=1e-8)
    np.testing.assert_allclose(results.field("reaction_force")[[0, 8], 2], SMALL * LENGTH / 2, rtol=1e-9)


@pytest.mark.parametrize("n", [4, 9])
def test_straight_elements_get_half_of_their_load_at_either_node(run, n):
    """With that the end of a cantilever of elements with one point each moves as it should, shear included."""
    results = finished(run, beam(f"*DLOAD\n WIRE, PZ, {SMALL}", element="B31", n=n))
    assert results.field("reaction_force")[0, 2] == pytest.approx(-SMALL * LENGTH, rel=1e-9)
    assert results.field("reaction_moment")[0, 1] == pytest.approx(SMALL * LENGTH**2 / 2, rel=1e-7)
    # E/2 is the shear modulus without Poisson's ratio, 6/7 of the area carries shear
    shear = SMALL * LENGTH**2 / (2 * YOUNG / 2 * AREA * 6 / 7)
    assert results.field("displacement")[-1, 2] == pytest.approx(SMALL * LENGTH**4 / (8 * EI) + shear, rel=1e-6)


def test_weight_is_density_times_area_times_acceleration(run):
    """The direction may have any length; without an element set all wires are heavy."""
    weight = DENSITY * AREA * 9.81
    whole = finished(run, beam("*DLOAD\n , GRAV, 9.81, 0, 0, -5"))
    given = finished(run, beam(f"*DLOAD\n WIRE, PZ, {-weight!r}"))
    np.testing.assert_allclose(whole.field("displacement"), given.field("displacement"), rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(whole.field("line_load")[:, 2], -weight, rtol=1e-12)
    assert whole.history["RF3 sum WIRE"][-1] == pytest.approx(weight * LENGTH, rel=1e-9)


def heavy_elastica(load):
    """Tip of a cantilever under a large weight per length: EI theta'' = -q (L - s) cos(theta), inextensible."""
    s, given = np.linspace(0, 1, 101), load * LENGTH**3 / EI
    solution = solve_bvp(
        lambda s, y: [y[1], -given * (1 - s) * np.cos(y[0]), np.cos(y[0]), np.sin(y[0])],
        lambda a, b: [a[0], b[1], a[2], a[3]],
        s,
        np.zeros((4, len(s))),
        tol=1e-8,
        max_nodes=50000,
    )
    assert solution.success
    return LENGTH * solution.sol(1)[2:]


def test_a_heavy_cantilever_hangs_as_the_elastica(run):
    load = 20 * EI / LENGTH**3
    results = finished(run, beam(f"*DLOAD\n WIRE, PY, {load!r}", n=16, static="0.05, 1, 1e-3, 0.05"))
    tip = results.positions(-1)[-1, :2]
    # axial forces stretch the wire by q L/EA = 5e-4 at most, and elements are curved to the fourth order
    np.testing.assert_allclose(tip, heavy_elastica(load), atol=3e-4 * LENGTH)
    # it goes with the square of the increments: forces are means of their values at both ends
    assert np.abs(results.history["ETOTAL"]).max() < 2.5e-3 * results.history["ALLWK"][-1]


def following_elastica(load):
    """Tip under a load that stays normal to the wire. From the free end, with the forces in the axes of the section:
    N' = kappa Q, Q' = -kappa N - p, M' = -Q, kappa = M/EI; then the wire is turned so that its root is along x."""

    def slopes(s, y):
        normal, shear, moment, angle = y[:4]
        kappa = moment / EI
        return [kappa * shear, -kappa * normal - load, -shear, kappa, np.cos(angle), np.sin(angle)]

    back = solve_ivp(slopes, [LENGTH, 0], np.zeros(6), rtol=1e-11, atol=1e-13).y[:, -1]
    angle, x, y = back[3:]
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return turn @ [-x, -y], back[2]


def test_a_load_that_turns_with_the_sections_bends_as_the_rod_equations_say(run):
    load = 30 * EI / LENGTH**3
    tip, moment = following_elastica(load)
    results = finished(run, beam(f"*DLOAD\n WIRE, P1, {load!r}", n=16, static="0.1, 1, 1e-3, 0.1"))
    # the wire is shorter by 1e-4 of its length, where the rod equations have no stretch
    np.testing.assert_allclose(results.positions(-1)[-1, :2], tip, atol=1e-4 * LENGTH)
    assert results.field("reaction_moment")[0, 2] == pytest.approx(-moment, rel=2e-4)


@pytest.mark.parametrize(("element", "order"), [("B33", 4), ("B31", 2)])
def test_shorter_elements_carry_a_turning_load_better(run, element, order):
    """Ends of wires of 4, 8 and 16 elements come together with a power of the length of an element."""
    load = 10 * EI / LENGTH**3
    ends = [
        finished(run, beam(f"*DLOAD\n WIRE, P1, {load!r}", n=n, element=element, static="0.2, 1, 1e-3, 0.2")).positions(
            -1
        )[-1, 1]
        for n in (4, 8, 16)
    ]
    assert np.log2((ends[1] - ends[0]) / (ends[2] - ends[1])) == pytest.approx(order, abs=0.3)


@pytest.mark.parametrize("element", ["B31", "B33"])
def test_pressure_in_a_ring_pulls_along_it(run, element):
    """N = p r in a closed circle under p, outwards all around."""
    n, radius, pressure = 48, 0.02, 50.0
    angles = 2 * np.pi * np.arange(n) / n
    points = radius * np.c_[np.cos(angles), np.sin(angles), 0 * angles]
    held = "1, 2, 6\n 25, 2, 6\n 13, 1"
    deck = beam(
        f"*DLOAD\n WIRE, P2, {pressure}", held=held, points=points, closed=True, element=element, axis=" 0, 0, 1"
    )
    results = finished(run, deck)
    # chords for arcs: (pi/n)^2/2 of it
    np.testing.assert_allclose(results.field("axial_force"), pressure * radius, rtol=3e-3)
    # nothing from outside holds the ring
    assert np.abs(results.field("reaction_force")).max() < 1e-6 * pressure * radius


def test_loads_ramp_go_on_and_end_like_concentrated_ones(run):
    """Over four increments each: to 2, to 6; removed, and replaced by another; then along an amplitude."""
    quarters = "0.25, 1, 1e-3, 0.25"
    wave = "*AMPLITUDE, NAME=WAVE\n 0, 0, 0.5, 1, 1, 0.5\n"
    deck = wave + beam(
        "*DLOAD\n WIRE, PY, 2",
        "*DLOAD\n WIRE, PY, 4\n 3, PY, 1\n WIRE, PY, 2",
        "*DLOAD, OP=NEW\n WIRE, PZ, 1",
        "*DLOAD, OP=NEW, AMPLITUDE=WAVE\n WIRE, PZ, 8",
        "*CLOAD\n 9, 3, 0.1",
        static=quarters,
    )
    results = finished(run, deck)
    load = results.field("line_load", None)
    assert load[1:9, 0, 1] == pytest.approx([0.5, 1, 1.5, 2, 3, 4, 5, 6], rel=1e-9)
    assert load[8, 2, 1] == pytest.approx(7, rel=1e-9)
    assert load[9:13, 0, 1] == pytest.approx([4.5, 3, 1.5, 0], abs=1e-9)
    assert load[9:13, 0, 2] == pytest.approx([0.25, 0.5, 0.75, 1], rel=1e-9)
    assert load[13:17, 0, 2] == pytest.approx([4, 8, 6, 4], rel=1e-9)
    assert load[17:, 0, 2] == pytest.approx([4] * 4, rel=1e-9)
    assert results.field("line_load", None).shape[1:] == (8, 3)


def test_the_work_of_loads_is_in_the_balance_of_energy(run):
    """q u/2 over a step in which the load grows from nothing."""
    results = finished(run, beam(f"*DLOAD\n WIRE, PZ, {SMALL}", static="0.25, 1, 1e-3, 0.25"))
    work = SMALL**2 * LENGTH**5 / (40 * EI)
    assert results.history["ALLWK"][-1] == pytest.approx(work, rel=1e-7)
    assert np.abs(results.history["ETOTAL"]).max() < 1e-7 * work


def test_a_run_with_loads_goes_on_from_everywhere(litz, tmp_path):
    grow = "*AMPLITUDE, NAME=GROW, TIME=TOTAL TIME\n 0, 0, 2, 2\n"
    load = 2 * EI / LENGTH**3
    deck = grow + beam(
        f"*DLOAD, AMPLITUDE=GROW\n WIRE, P1, {load!r}\n{KEEP_ALL}",
        f"*DLOAD\n , GRAV, 9.81, 0, 0, -1\n{KEEP_ALL}",
        static="0.25, 1, 1e-3, 0.25",
    )
    assert_goes_on_from_everywhere(litz, tmp_path, deck)


def test_a_restart_notices_another_load(run, litz, tmp_path):
    deck = beam(f"*DLOAD\n WIRE, PY, 2\n{KEEP_ALL}", static="0.25, 1, 1e-3, 0.25")
    finished(run, deck)
    changed = tmp_path / "changed.inp"
    changed.write_text(deck.replace("PY, 2", "PY, 3"))
    done = litz("run", changed, "-o", tmp_path / "out", "--restart", f"{tmp_path}/deck/deck.restart.h5:1:2")
    assert done.returncode == 1
    assert "loads PY on elements" in done.stderr


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("*DLOAD\n WIRE, PY, 1, 0, 0, 1", "PY has one value, force per length; a direction belongs to GRAV"),
        ("*DLOAD\n , PY, 1", "value 1, element, is missing; GRAV alone acts on the whole model without it"),
        ("*DLOAD\n WIRE, GRAV, 9.81", "GRAV needs a direction, x, y, z, behind its magnitude"),
        ("*DLOAD\n WIRE, PQ, 1", "must be PX, PY, PZ, P1, P2 or GRAV"),
        ("*DLOAD\n 77, PX, 1", "there is no element 77"),
        ("*DLOAD, OP=NEW\n WIRE, PX, 1\n*DLOAD\n 2, PX, 1", "all *DLOAD of a step must have the same OP"),
        ("*DLOAD\n 2, PX, 1\n*DLOAD, AMPLITUDE=UP\n 2, PX, 1", "element 2 has loads PX of different amplitudes"),
        (
            "*LORENTZ\n WIRE, 0, 0, 1",
            "element 1 carries no current: its material STEEL has no *ELECTRICAL CONDUCTIVITY",
        ),
    ],
)
def test_what_is_wrong_about_a_load_is_named(litz, tmp_path, line, message):
    (tmp_path / "bad.inp").write_text(
        "*AMPLITUDE, NAME=UP\n 0, 0, 1, 1\n" + beam(line, "*DLOAD, AMPLITUDE=UP\n 1, P1, 1")
    )
    done = litz("check", "bad.inp", cwd=tmp_path)
    assert done.returncode == 1
    assert message in done.stderr


def test_weight_needs_a_density(litz, tmp_path):
    (tmp_path / "bad.inp").write_text(
        beam("*DLOAD\n WIRE, GRAV, 9.81, 0, 0, -1").replace(f"*DENSITY\n {DENSITY}\n", "")
    )
    done = litz("check", "bad.inp", cwd=tmp_path)
    assert done.returncode == 1
    assert "element 1 has no weight: its material STEEL has no *DENSITY" in done.stderr


def test_forces_do_not_belong_in_a_step_that_holds_motions(litz, tmp_path):
    deck = beam("*DLOAD\n WIRE, PX, 1").replace("*STATIC\n 1, 1, 1e-3, 1", "*COUPLED THERMAL-ELECTRICAL, STEADY STATE")
    (tmp_path / "bad.inp").write_text(deck)
    done = litz("check", "bad.inp", cwd=tmp_path)
    assert done.returncode == 1
    assert "put this *DLOAD into a *STATIC" in done.stderr

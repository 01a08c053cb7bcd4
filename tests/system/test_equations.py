"""*EQUATION: linear equations between degrees of freedom, against closed forms and against models without them."""

import numpy as np
import pytest

from decks import CONDUCTOR, MATERIAL, straight, wire
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

YOUNG, RADIUS, LENGTH = 200e9, 1e-3, 0.1
AREA = np.pi * RADIUS**2
EI = YOUNG * np.pi * RADIUS**4 / 4
STATIC = "1, 1, 1e-3, 1"


def equation(*terms):
    """An equation of terms `(node or set, dof, coefficient)`, at most five of which are on a line."""
    lines = [terms[i : i + 5] for i in range(0, len(terms), 5)]
    return f"{len(terms)}\n" + "".join(
        " " + ", ".join(f"{node}, {dof}, {factor!r}" for node, dof, factor in line) + "\n" for line in lines
    )


def equal(first, second, dofs):
    return "".join(equation((first, dof, 1.0), (second, dof, -1.0)) for dof in dofs)


def deck_of(wires, equations, boundary, *steps, material=MATERIAL, static=STATIC, before=""):
    """Steel wires W with equations; `steps` are the cards of each step."""
    text = f"{wires}{before}{material}*BEAM SECTION, ELSET=W, MATERIAL={material[16:].split()[0]}, SECTION=CIRC\n {RADIUS}\n"
    text += (f"*EQUATION\n{equations}" if equations else "") + f"*BOUNDARY\n{boundary}"
    return text + "".join(f"*STEP, INC=500\n*STATIC\n {static}\n{step}*ENERGY PRINT\n*END STEP\n" for step in steps)


def finished(run, deck, name="deck"):
    process, results = run(deck, name=name)
    assert process.returncode == 0, process.stderr
    return results


LAY, COIL = 0.02, 4e-3


def helix(lays, n):
    angles = 2 * np.pi * np.arange(lays * n + 1) / n
    return np.c_[LAY * angles / (2 * np.pi), COIL * np.cos(angles), COIL * np.sin(angles)]


def periodic_helix(lays, strain, step="", n=24, static="0.25, 1, 1e-3, 0.25"):
    """Both ends move and turn alike but for the lengthening of the cell, the displacement of node 999; n elements a lay."""
    last = lays * n + 1
    wires = wire("W", helix(lays, n), element="B33") + "*NODE\n 999, 0, 0, 0\n"
    equations = equation((last, 1, 1.0), (1, 1, -1.0), (999, 1, -1.0)) + equal(last, 1, range(2, 7))
    pull = f"*BOUNDARY\n 999, 1, 1, {lays * LAY * strain!r}\n*NODE PRINT, NSET=CELL\n RF\n"
    return deck_of(wires, equations, " 1, 1, 4\n", pull + step, static=static, before="*NSET, NSET=CELL\n 999\n")


def test_one_lay_of_a_helix_with_periodic_ends_is_one_of_many(run):
    """The axis of a wire is one of third order less exact at its ends, which one lay and three have alike."""
    difference = []
    for n in (24, 48):
        one, three = (finished(run, periodic_helix(lays, 0.3, n=n), f"lays{lays}_{n}") for lays in (1, 3))
        force = [results.field("reaction_force")[-1, 0] for results in (one, three)]
        difference.append(abs(force[0] / force[1] - 1))
        # the second lay of three, from where it begins
        first, all_three = (results.positions(-1) for results in (one, three))
        second = all_three[n : 2 * n + 1] - all_three[n] + first[0]
        np.testing.assert_allclose(first[:-1], second, atol=2e-3 * COIL * (24 / n) ** 3)
        # the node that both hold holds nothing
        assert np.abs(one.field("reaction_force")[0]).max() < 1e-6 * force[0]
    assert difference[1] < difference[0] / 7 < 2e-5


def test_the_stiffness_of_a_helix_is_that_of_a_spring(run):
    """The energy of bending, twist and stretch of one lay under an axial force, of which no end turns about the axis."""
    strain = 1e-4
    results = finished(run, periodic_helix(1, strain, n=48, static=STATIC))
    pitch = np.arctan2(LAY, 2 * np.pi * COIL)
    length = LAY / np.sin(pitch)
    shear = YOUNG / 2 / 1.3
    gj = shear * np.pi * RADIUS**4 / 2
    # force F and torque T along the axis: twist (F R cos a + T sin a)/GJ, bending (T cos a - F R sin a)/EI
    sine, cosine = np.sin(pitch), np.cos(pitch)
    mixed = COIL * sine * cosine * (1 / gj - 1 / EI)
    a = np.array([
        [(COIL * cosine) ** 2 / gj + (COIL * sine) ** 2 / EI + sine**2 / (YOUNG * AREA), mixed],
        [mixed, sine**2 / gj + cosine**2 / EI],
    ])  # fmt: skip
    force = np.linalg.solve(a * length, [strain * LAY, 0])[0]
    # of second order in the length of the elements: 5e-3 with half as many
    assert results.field("reaction_force")[-1, 0] == pytest.approx(force, rel=2e-3)


def test_work_and_balance_close_over_equations(run):
    results = finished(run, periodic_helix(1, 0.3, static="0.05, 1, 1e-3, 0.05"))
    assert results.history["ALLWK"][-1] > 0
    assert np.abs(results.history["ETOTAL"]).max() < 2e-3 * results.history["ALLWK"][-1]


def test_a_lever_divides_a_force(run):
    """u_a = 2 u_b between the ends of two bars: the force on the eliminated end acts on the other one twice."""
    wires = wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 1), 1) + wire("W", straight((0, 1, 0), (LENGTH, 1, 0), 1), 11)
    deck = deck_of(wires, equation((2, 1, 1.0), (12, 1, -2.0)), " 1, 1, 6\n 11, 1, 6\n", "*CLOAD\n 2, 1, 10.0\n")
    results = finished(run, deck)
    # k (u_b + 4 u_b) = 2 P
    other = 2 * 10 / (5 * YOUNG * AREA / LENGTH)
    assert results.field("displacement")[[1, 3], 0] == pytest.approx([2 * other, other], rel=1e-7)
    assert -results.field("reaction_force")[[0, 2], 0] == pytest.approx(
        YOUNG * AREA / LENGTH * np.array([2 * other, other]), rel=1e-6
    )
    assert results.history["ETOTAL"][-1] == pytest.approx(0, abs=1e-9 * results.history["ALLWK"][-1])


def test_a_prescribed_value_is_passed_on(run):
    wires = wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 1), 1) + wire("W", straight((0, 1, 0), (LENGTH, 1, 0), 1), 11)
    deck = deck_of(wires, equation((2, 1, -2.0), (12, 1, 1.0)), " 1, 1, 6\n 11, 1, 6\n", "*BOUNDARY\n 12, 1, 1, 1e-6\n")
    results = finished(run, deck)
    assert results.field("displacement")[1, 0] == pytest.approx(5e-7, rel=1e-9)
    # its own force, and half of that of the other bar
    force = YOUNG * AREA / LENGTH * 1e-6 * (1 + 0.25)
    assert results.field("reaction_force")[3, 0] == pytest.approx(force, rel=1e-6)


def test_two_ends_turn_alike_by_any_angle(run):
    """A wire rolled up by a prescribed end makes the other one roll up, though its own end is free to move."""
    wires = wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 10), 1) + wire(
        "W", straight((0, 0, 1), (0, LENGTH, 1), 10), 21
    )
    deck = deck_of(
        wires, equal(31, 11, range(4, 7)), " 1, 1, 6\n 21, 1, 6\n",
        f"*BOUNDARY\n 11, 6, 6, {2.5 * np.pi!r}\n 11, 4, 5\n", static="0.05, 1, 1e-3, 0.05",
    )  # fmt: skip
    results = finished(run, deck)
    # M = phi E I/L in each, held by the one support
    moment = 2.5 * np.pi * EI / LENGTH
    assert results.field("reaction_moment")[10, 2] == pytest.approx(2 * moment, rel=1e-6)
    assert results.field("rotation")[[10, 21], 2] == pytest.approx([2.5 * np.pi] * 2, rel=1e-9)


def test_sets_stand_for_an_equation_of_each_of_their_nodes(run):
    ends = "*NSET, NSET=STARTS\n 1, 11, 21\n*NSET, NSET=ENDS\n 2, 12, 22\n*NODE\n 99, 0, 0, 0\n"
    wires = "".join(wire("W", straight((0, y, 0), (LENGTH, y, 0), 1), 10 * y + 1) for y in range(3))
    deck = deck_of(
        wires, equation(("ENDS", 1, 1.0), (99, 1, -1.0)), " STARTS, 1, 6\n", "*CLOAD\n 99, 1, 30.0\n", before=ends
    )
    results = finished(run, deck)
    np.testing.assert_allclose(results.field("axial_force"), 10, rtol=1e-6)
    assert results.field("displacement")[-1, 0] == pytest.approx(10 * LENGTH / (YOUNG * AREA), rel=1e-6)


def test_reference_nodes_of_rigid_bodies_take_part(run):
    """Clamps at both ends of a bundle, the one eliminated by the other, bend it as those of a periodic cell."""
    wires = "".join(
        wire("W", straight((0, 0.01 * y, 0), (LENGTH, 0.01 * y, 0), 4), 10 * y + 1, element="B33") for y in (0, 1)
    )
    bodies = (
        "*NODE\n 91, 0, 0.005, 0\n 92, 0.1, 0.005, 0\n 93, 0, 0, 0\n*NSET, NSET=A\n 1, 11\n*NSET, NSET=B\n 5, 15\n"
        "*RIGID BODY, REF NODE=91, TIE NSET=A\n*RIGID BODY, REF NODE=92, TIE NSET=B\n"
    )
    equations = equation((92, 3, 1.0), (91, 3, -1.0), (93, 3, -1.0)) + equal(92, 91, (1, 2, 4, 5, 6))
    step = "*BOUNDARY\n 93, 3, 3, 1e-5\n*NODE PRINT, NSET=B\n RF\n"
    deck = deck_of(wires, equations, " 91, 1, 6\n", step, before=bodies)
    results = finished(run, deck)
    # two wires between clamps that do not turn
    assert results.field("reaction_force")[-1, 2] == pytest.approx(2 * 12 * EI / LENGTH**3 * 1e-5, rel=1e-4)


def test_equal_potentials_join_conductors(run):
    """Two wires in parallel of which the ends have one potential, without a contact."""
    wires = wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 2), 1) + wire("W", straight((0, 1, 0), (LENGTH, 1, 0), 4), 11)
    deck = deck_of(
        wires, equal(11, 1, [9]) + equal(15, 3, [9]), " 1, 1, 6\n 11, 1, 6\n", "*BOUNDARY\n 1, 9\n*CECURRENT\n 15, , 4.0\n",
        material=CONDUCTOR,
    )  # fmt: skip
    results = finished(run, deck)
    np.testing.assert_allclose(results.field("element_current"), -2.0, rtol=1e-9)
    assert results.field("reaction_current")[0] == pytest.approx(-4, rel=1e-9)


def test_equal_temperatures_pass_heat(run):
    """A hot end and a cold end, the gap between two rods closed by an equation."""
    warm = CONDUCTOR + "*CONDUCTIVITY\n 400\n"
    wires = wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 2), 1) + wire("W", straight((1, 0, 0), (1.1, 0, 0), 2), 11)
    deck = deck_of(wires, equal(11, 3, [11, 9]), " 1, 1, 6\n 11, 1, 6\n 1, 9\n", "*BOUNDARY\n 1, 11, 11, 10\n 13, 11, 11, 50\n",
                   material=warm).replace(f"*STATIC\n {STATIC}", "*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n 1, 1")  # fmt: skip
    results = finished(run, deck)
    assert results.field("temperature") == pytest.approx([10, 20, 30, 30, 40, 50], rel=1e-9)
    assert results.field("reaction_heat")[[0, 5]] == pytest.approx(
        np.array([-1, 1]) * 400 * AREA * 20 / LENGTH, rel=1e-8
    )


def test_a_run_with_equations_goes_on_from_everywhere(litz, tmp_path):
    assert_goes_on_from_everywhere(litz, tmp_path, periodic_helix(1, 0.3, KEEP_ALL))


def test_a_restart_notices_another_equation(run, litz, tmp_path):
    deck = periodic_helix(1, 0.3, KEEP_ALL)
    finished(run, deck)
    changed = tmp_path / "changed.inp"
    changed.write_text(deck.replace("999, 1, -1.0", "999, 1, -2.0"))
    done = litz("run", changed, "-o", tmp_path / "out", "--restart", f"{tmp_path}/deck/deck.restart.h5:1:2")
    assert done.returncode == 1
    assert "the equations (*EQUATION)" in done.stderr


@pytest.mark.parametrize(
    ("equations", "boundary", "message"),
    [
        ("3\n 2, 1, 1, 1, 1, -1\n", "", "this equation has 3 terms; 2 of them follow"),
        ("2\n 2, 1, 1, 1, 1, -1, 3, 1, 1\n", "", "this equation has 2 terms; this would be another one"),
        ("1\n 2, 1, 1\n", "", "the number of its terms, at least 2; found \"1\""),
        ("2\n 2, 1, 1, 1, 7, -1\n", "", "degree of freedom 7 does not exist"),
        ("2\n 2, 1, 0, 1, 1, -1\n", "", "its coefficient must not be zero"),
        ("2\n 2, 1, 1, 1, 1\n", "", "a term of an equation has three values"),
        ("2\n 2, 1, 1, 2, 1, -1\n", "", "names a degree of freedom that another term has already"),
        ("2\n 2, 1, 1, 2, 9, -1\n", "", "an equation between motions and other unknowns"),
        ("2\n 2, 9, 1, 3, 9, -1\n", "", "node 2 has no electric potential"),
        ("2\n W, 1, 1, SOME, 1, -1\n", "", "term 2 of the equation has 2 nodes, the first term has 3"),
        ("2\n 77, 1, 1, 1, 1, -1\n", "", "there is no node 77"),
        ("2\n 2, 1, 1, 3, 1, -1\n2\n 2, 1, 1, 3, 1, 1\n", "", "degree of freedom 1 of node 2 is eliminated by two equations"),
        ("2\n 2, 1, 1, 3, 1, -1\n2\n 3, 1, 1, 1, 1, 1\n", "", "of node 3 is in this equation, and eliminated by another one"),
        ("2\n 2, 1, 1, 3, 1, -1\n", " 2, PINNED\n", "degree of freedom 1 of node 2 is eliminated by the *EQUATION in"),
        ("2\n 2, 1, 1, 91, 1, -1\n2\n 3, 2, 1, 2, 2, 1\n", "BODY", "node 3 has no degree of freedom 2 of its own"),
    ],
)  # fmt: skip
def test_what_is_wrong_about_an_equation_is_named(litz, tmp_path, equations, boundary, message):
    body = (
        "*NODE\n 91, 0, 0, 0\n*NSET, NSET=TIED\n 3\n*RIGID BODY, REF NODE=91, TIE NSET=TIED\n"
        if boundary == "BODY"
        else ""
    )
    wires = wire("W", straight((0, 0, 0), (LENGTH, 0, 0), 2)) + "*NSET, NSET=SOME\n 1, 2\n"
    held = " 1, 1, 6\n" + (boundary if boundary != "BODY" else "")
    (tmp_path / "deck.inp").write_text(deck_of(wires, equations, held, "", before=body))
    done = litz("check", "deck.inp", cwd=tmp_path)
    assert done.returncode == 1
    assert message in done.stderr


def test_what_equations_do_not_hold_is_reported(litz, tmp_path):
    """A wire with periodic ends still moves as a whole."""
    deck = periodic_helix(1, 0.3).replace("*BOUNDARY\n 1, 1, 4\n", "*BOUNDARY\n 1, 2, 4\n")
    (tmp_path / "deck.inp").write_text(deck)
    done = litz("check", "deck.inp", cwd=tmp_path)
    assert done.returncode == 1
    assert "can still move: translation along x" in done.stderr

"""What the driver promises of every run: rates, invariants, refusals, independence of solver and threads."""

import numpy as np
import pytest

from decks import MATERIAL, cantilever, crossed, grid, pair_of_wires, straight, thin_mat, wire
from litz import Results

SOFT = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR{}\n 1e3"


def residual_history(results, name, attempt=1):
    """Residuals of the last increment, iteration by iteration."""
    table = results.convergence
    last = table["increment"].max()
    rows = (table["increment"] == last) & (table["attempt"] == attempt)
    return table[name][rows], table[name + "_allowed"][rows]


@pytest.mark.parametrize("behavior", ["HERTZ", "LINEAR\n 1e7"])
@pytest.mark.parametrize("element", ["B31", "B33"])
def test_newton_converges_quadratically(run, element, behavior):
    """Force and current of the monolithic step: each residual at most a constant times the square of the last one.

    Where the iteration has converged, the axes of B31 that touch take the shear of the new state: the residual rises once
    more, and that by much less each time.
    """
    text = crossed(
        element=element,
        behavior=f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={behavior}",
        push="-2e-3",
        static="1, 1, 1e-3, 1",
        extra="*SOLVER, NAME=UMFPACK, COUPLING=MONOLITHIC",
    )
    process, results = run(text)
    assert process.returncode == 0, process.stderr
    residual, allowed = residual_history(results, "force")
    assert residual[-1] <= allowed[-1]
    # from the largest residual on, each exponent is at least 1.5 times the one before, down to round-off
    start = residual.argmax() + 1
    assert len(residual) - start >= 3
    rises = [residual.max()]
    for before, after, bound in zip(residual[start:], residual[start + 1 :], allowed[start + 1 :], strict=False):
        if element == "B31" and before < 1e-9 * residual.max() and bound < after:
            assert after < 1e-3 * rises[-1]
            rises.append(after)
            continue
        assert after <= max(before * np.sqrt(before / residual.max()), bound)
    assert len(rises) <= 3
    assert len(residual) <= 12


def test_coupled_equations_know_how_a_conductor_that_is_stretched_resists(run):
    """Half of a wire is stretched by e: it has the more of the voltage, to first order in the first iteration already."""
    solver = "*SOLVER, NAME=UMFPACK, COUPLING=MONOLITHIC\n"
    deck = cantilever(f"{solver}*BOUNDARY\n 1, 9, 9, 1e-3\n 11, 9", "*CLOAD\n 6, 1, 6000", element="B33")
    deck = deck.replace(" 200e9, 0.3\n", " 200e9, 0.3\n*ELECTRICAL CONDUCTIVITY\n 5e6\n")
    process, results = run(deck.replace("SECTION=CIRC", "SECTION=CIRC, CONDUCTION=CURRENT LENGTH"))
    assert process.returncode == 0, process.stderr
    stretch = 6000 / (200e9 * np.pi * 1e-3**2)
    assert results.field("potential")[5] == pytest.approx(1e-3 / (2 + stretch), rel=1e-6)
    loaded = results.convergence.where(results.convergence["step"] == 2)
    current = results.field("reaction_current")[0]
    assert loaded["current"][1] < 2 * current * stretch**2


def test_coupled_equations_know_that_a_remembered_spot_does_not_follow_the_force(run):
    """Released, it conducts as before: the currents are right as soon as the displacements are, in the third iteration.
    After the second one the law sees how the wires are bent then."""
    deck = crossed(
        static="1, 1",
        spot="*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, SPOT=LARGEST FORCE",
        extra="*SOLVER, NAME=UMFPACK, COUPLING=MONOLITHIC",
    )
    process, results = run(deck + "*STEP\n*STATIC\n 1, 1\n*BOUNDARY\n UPPER_ENDS, 3, 3, -5e-5\n*END STEP\n")
    assert process.returncode == 0, process.stderr
    released = results.convergence.where(results.convergence["step"] == 2)
    assert released["force"][3] < 1e-5 * released["force"][1]
    # the square of what was left of the displacements
    assert released["current"][3] < 1e-7 * released["current"][1]


@pytest.mark.parametrize("push", [1e-5, 5e-5, 5e-4])
def test_hertz_contacts_of_slender_wires_close_in_one_increment(run, push):
    """At first touch no force is known: none may enter the geometric stiffness. A contact that would pull opens."""
    process, results = run(thin_mat(push))
    assert process.returncode == 0, process.stderr
    assert results.status["attempts"].tolist() == [1]
    assert results.status["iterations"][0] <= 10
    assert (results.contacts["force"] > 0).all()


def test_a_shear_stiffness_far_above_the_axial_one_converges_to_its_own_round_off(run):
    shear = "*SURFACE INTERACTION, NAME=SPOT"
    process, results = run(
        crossed(element="B31", push="-2e-6").replace(shear, f"*TRANSVERSE SHEAR STIFFNESS\n 1e8, 1e8\n{shear}")
    )
    assert process.returncode == 0, process.stderr
    assert results.status["attempts"].tolist() == [1]


def test_forces_currents_and_power_balance(run):
    process, results = run(crossed(push="-5e-4"))
    assert process.returncode == 0, process.stderr
    force = results.field("reaction_force")
    scale = np.abs(force).max()
    assert np.abs(force.sum(axis=0)).max() < 1e-7 * scale
    moment = results.field("reaction_moment") + np.cross(results.positions(), force)
    assert np.abs(moment.sum(axis=0)).max() < 1e-7 * np.abs(moment).max()
    current = results.field("reaction_current")
    assert abs(current.sum()) < 1e-9 * np.abs(current).max()
    assert np.abs(current).max() > 0.1
    heat = results.field("joule_heat").sum() + results.contacts_at(-1)["joule_heat"].sum()
    power = (results.field("potential") * current).sum()
    assert power == pytest.approx(heat, rel=1e-9)


def test_voltages_scale_the_currents_and_leave_the_mechanics_alone(run):
    _, small = run(crossed(), name="small")
    _, large = run(crossed().replace("1, 9, 9, 1e-3", "1, 9, 9, 7e-3"), name="large")
    assert large.contacts["current"][-1] == pytest.approx(7 * small.contacts["current"][-1], rel=1e-9)
    assert large.contacts["force"][-1] == small.contacts["force"][-1]


@pytest.mark.parametrize("solver", ["SKYLINE", "UMFPACK", pytest.param("MUMPS", marks=pytest.mark.mumps)])
def test_solvers_give_the_same_iterates(run, solver):
    """The monolithic step, iteration by iteration: corrections agree until they are round-off themselves."""
    extra = "*SOLVER, NAME={}, COUPLING=MONOLITHIC"
    _, block = run(crossed(extra=extra.format("BLOCK"), static="0.25, 1, 1e-3, 0.25"), name="block")
    _, other = run(crossed(extra=extra.format(solver), static="0.25, 1, 1e-3, 0.25"), name="other")
    assert block.convergence["iteration"].tolist() == other.convergence["iteration"].tolist()
    for column in ("displacement", "rotation", "potential"):
        scale = block.convergence[column].max()
        np.testing.assert_allclose(other.convergence[column], block.convergence[column], rtol=1e-6, atol=1e-9 * scale)
    for name in ("displacement", "rotation", "potential"):
        scale = np.abs(block.field(name)).max()
        np.testing.assert_allclose(other.field(name), block.field(name), rtol=0, atol=1e-10 * scale)


def test_results_do_not_depend_on_the_number_of_threads(run):
    import os

    text = crossed(static="0.2, 1, 1e-3, 0.2")
    files = []
    for threads in (1, 2):
        process, results = run(text, "--threads", str(threads), name=f"threads{threads}", env=dict(os.environ))
        assert process.returncode == 0, process.stderr
        files.append(results)
    for name in ("displacement", "rotation", "potential", "reaction_force"):
        assert np.array_equal(files[0].field(name, None), files[1].field(name, None))


def test_enough_elements_and_contacts_for_threads_give_the_same_bits_with_any_number_of_them(run):
    files = []
    for threads in (1, 2, 3):
        process, results = run(grid(24), "--threads", str(threads), name=f"threads{threads}")
        assert process.returncode == 0, process.stderr
        files.append(results)
    # loops are shared out from 512 on
    assert len(files[0].contacts["id"]) == 24 * 24
    assert files[0].contacts["current"].min() > 0
    for other in files[1:]:
        for name in ("displacement", "rotation", "potential", "reaction_force"):
            assert np.array_equal(files[0].field(name, None), other.field(name, None))
        for name in ("force", "gap", "resistance", "current"):
            assert np.array_equal(files[0].contacts[name], other.contacts[name])


@pytest.mark.parametrize("closed", [False, True])
def test_neighbours_of_a_ring_are_no_pair_also_where_it_closes(litz, tmp_path, closed):
    """A ring of a dozen radii. Cut open, its two ends are near each other and no neighbours any more."""
    angle = np.arange(36) * 2 * np.pi / 36
    ring = wire("RING", np.c_[0.01 * np.cos(angle), 0.01 * np.sin(angle), 0 * angle], closed=closed)
    deck = tmp_path / "ring.inp"
    deck.write_text(
        f"{ring}{MATERIAL}*BEAM SECTION, ELSET=RING, MATERIAL=STEEL, SECTION=CIRC\n 0.8e-3\n"
        "*SURFACE INTERACTION, NAME=TOUCH\n*CONTACT PAIR, INTERACTION=TOUCH\n RING\n"
        "*BOUNDARY\n 1, ENCASTRE\n*STEP\n*STATIC\n 1., 1.\n*END STEP\n"
    )
    process = litz("check", deck)
    assert process.returncode == 0, process.stderr
    pairs = int(process.stdout.split("contact search: ")[1].split()[0])
    assert (pairs == 0) == closed


def test_the_table_of_times_adds_up(run):
    process, _ = run(crossed(), "--timing")
    assert process.returncode == 0, process.stderr
    table = process.stdout[process.stdout.index("phase ") :].splitlines()
    phases = {line.split()[0]: float(line.split()[1]) for line in table[1:14]}
    assert {"search", "elements", "contact", "check", "assembly", "analyse", "factor", "solve", "output"} < set(phases)
    total = phases.pop("total")
    assert sum(phases.values()) == pytest.approx(total, abs=0.0006 * len(phases))
    assert "of memory" in process.stdout


def test_wires_pushed_through_each_other_are_refused(run):
    """A contact too soft for its load would let the axes pass: every increment that does is cut, then the run fails."""
    process, results = run(crossed(behavior=SOFT.format(""), push="-8e-3", static="0.25, 1, 0.05, 0.25"))
    assert process.returncode == 2
    assert "5 % are allowed" in process.stderr or "would pass through each other" in process.stderr
    assert "elements 3 and 13" in process.stderr or "elements 13 and 3" in process.stderr
    assert not results.finished
    assert (results.contacts["gap"] > -2e-3).all()


def test_wires_that_start_apart_and_pass_each_other_by_far_in_one_increment_are_refused(run):
    """Afterwards they are as far apart again: only where they came from tells that they have passed."""
    soft = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n 1."
    process, _ = run(crossed(height="30e-3", push="-60e-3", behavior=soft, static="1., 1., 0.5, 1."))
    assert process.returncode == 2
    assert "would pass through each other in this increment" in process.stderr


def test_a_wire_that_is_taken_through_another_and_off_its_end_is_refused(run):
    """On the way the axes meet 0.5 mm before the end, then it goes on beyond: afterwards the wires do not cross at all."""
    first = wire("A", straight((-0.01, 0, 0), (0.01, 0, 0), 3), element="B33")
    second = wire("B", straight((0.007, -0.01, 5e-3), (0.007, 0.01, 5e-3), 3), 101, element="B33")
    moves = " B, 1, 1, 5e-3\n B, 3, 3, -10e-3\n"
    supports = " A, ENCASTRE\n B, 2\n B, 4, 6\n"
    process, _ = run(pair_of_wires(first, second, supports, moves).replace("*STATIC\n", "*STATIC, DIRECT\n"))
    assert process.returncode == 2
    assert "would pass through each other in this increment" in process.stderr


def test_a_wire_that_moves_aside_and_down_in_one_increment_is_held(run):
    """The crossing is found in another element than the one above which the wire started."""
    forces = []
    for static in ("1., 1.", "0.1, 1., 0.05, 0.1"):
        deck = crossed(height="8e-3", push="-11e-3", static=static)
        process, results = run(deck.replace(" UPPER_ENDS, 1, 2", " UPPER_ENDS, 1, 1, 30e-3\n UPPER_ENDS, 2, 2"))
        assert process.returncode == 0, process.stderr
        forces.append(float(results.contacts_at(-1)["force"][0]))
    assert forces[0] > 1.0
    assert forces[0] == pytest.approx(forces[1], rel=1e-6)


def test_an_overlap_of_many_radii_is_not_lost_between_short_elements(run):
    soft = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR, PENETRATION=UNLIMITED\n 1."
    process, results = run(crossed(push="-60e-3", behavior=soft, static="0.1, 1., 0.05, 0.1"))
    assert process.returncode == 0, process.stderr
    assert results.contacts_at(-1)["gap"][0] == pytest.approx(-60e-3, rel=1e-3)


#: Nodes [mm] of a wire beside one along x. Chord and curve of an element cross the other wire in opposite senses.
BESIDE = {
    "an element": ((-27, 2.7, -0.3), (-7, 2.7, -0.9), (13, 3.1, 0.3), (33, 3.7, -0.9)),
    "its neighbour": ((-31, 3.5, -0.5), (-11, 4.1, 0.7), (9, 4.1, 0.0), (29, 4.1, 0.3)),
}


@pytest.mark.parametrize("where", BESIDE)
def test_wires_side_by_side_at_a_distance_do_not_overlap(litz, tmp_path, where):
    """Nothing has moved yet, so nothing has passed, however the tangents are turned."""
    deck = tmp_path / "deck.inp"
    along = wire("A", np.c_[np.linspace(-0.03, 0.03, 4), np.zeros((4, 2))])
    deck.write_text(pair_of_wires(along, wire("B", 1e-3 * np.array(BESIDE[where]), 11), " A, ENCASTRE\n B, ENCASTRE\n"))
    process = litz("check", deck)
    assert process.returncode == 0, process.stderr


def test_wires_that_turn_through_parallel_have_not_passed_each_other(run):
    """The upper wire turns from one side of the lower one's direction to the other, 0.3 mm above it."""
    lower = wire("A", np.c_[np.linspace(-0.05, 0.05, 6), np.zeros((6, 2))])
    s = np.linspace(-1, 1, 6)
    upper = wire("B", np.c_[0.05 * s, 0.01 * s, np.full(6, 2.3e-3)], 11)
    turn = " 11, 2, 2, 20e-3\n 16, 2, 2, -20e-3\n 11, 3\n 16, 3\n 11, 1\n 11, 4\n"
    process, results = run(pair_of_wires(lower, upper, " A, ENCASTRE\n", turn, static="0.4, 1., 1e-3, 0.4"))
    assert process.returncode == 0, process.stderr
    assert results.status["attempts"].max() == 1
    assert not (results.contacts["force"] > 0).any()


def bows():
    """Two arches whose crowns are nodes and touch there."""
    s = np.array([-30e-3, -12e-3, 0, 12e-3, 30e-3])
    lower = wire("A", np.c_[s, 0 * s, -3 * s**2])
    upper = wire("B", np.c_[0 * s, s, 2e-3 + 3 * s**2], 11)
    return pair_of_wires(lower, upper, " 1, ENCASTRE\n 5, ENCASTRE\n", held_and_pushed((11, 15), 3))


def ring():
    """A wire that touches a ring at the node where its numbering begins and ends."""
    angle = np.arange(36) * 2 * np.pi / 36
    s = np.linspace(-20e-3, 20e-3, 5)
    around = wire("A", np.c_[10e-3 * np.cos(angle), 10e-3 * np.sin(angle), 0 * angle], closed=True)
    across = wire("B", np.c_[np.full(5, 12e-3), 0 * s, s], 101)
    return pair_of_wires(around, across, " 19, ENCASTRE\n", held_and_pushed((101, 105), 1))


def held_and_pushed(nodes, dof):
    """Both nodes are clamped and moved by -0.1 mm."""
    return "".join(
        f" {node}, {other}, {other}, {-1e-4 if other == dof else 0}\n" for node in nodes for other in range(1, 7)
    )


@pytest.mark.parametrize("deck", [bows, ring])
def test_a_contact_at_nodes_of_curved_wires_is_one_contact(run, deck):
    process, results = run(deck())
    assert process.returncode == 0, process.stderr
    contacts = results.contacts_at(-1)
    assert len(contacts["force"]) == 1
    # it did not leave the node: this is the case that is meant
    assert abs(contacts["xi_2"][0]) == pytest.approx(1, abs=1e-9) or abs(contacts["xi_1"][0]) == pytest.approx(
        1, abs=1e-9
    )
    pushed = np.abs(results.field("reaction_force")[results.node_sets["B"]].sum(axis=0)).max()
    assert contacts["force"][0] == pytest.approx(pushed, rel=1e-9)


def test_penetration_beyond_the_axes_can_be_allowed_and_keeps_its_sign(run):
    process, results = run(
        crossed(behavior=SOFT.format(", PENETRATION=UNLIMITED"), push="-8e-3", static="0.25, 1, 0.05, 0.25")
    )
    assert process.returncode == 0, process.stderr
    last = results.contacts_at(-1)
    assert last["gap"][0] < -2e-3
    assert last["force"][0] == pytest.approx(-1e3 * last["gap"][0], rel=1e-12)
    # the upper wire is still pushed up and the lower one down
    force = results.field("reaction_force")
    ends = results.node_sets["LOWER_ENDS"]
    assert force[ends, 2].sum() > 0


def test_an_increment_that_cannot_converge_ends_the_run_and_keeps_what_was_reached(run):
    process, results = run(
        crossed(static="0.25, 1, 0.2, 0.25", extra="*CONTROLS, PARAMETERS=TIME INCREMENTATION\n , , , 1")
    )
    assert process.returncode == 2
    assert "step 1, increment 1 did not converge" in process.stderr
    assert not results.finished
    assert len(results.times) == 1


def held_at_the_ends(most, n=12):
    """A grid of n by n wires whose upper ones follow their supports only, with I_C = `most`."""
    deck = grid(n).replace(" LOWER, 3\n", "")
    for dofs in ("1, 2", "4, 6", "3, 3"):
        deck = deck.replace(f" UPPER, {dofs}", f" UPPER_ENDS, {dofs}")
    return deck.replace(" 1., 1.\n", f" 1., 1.\n*CONTROLS, PARAMETERS=TIME INCREMENTATION\n , , , {most}\n")


def test_iterations_in_which_contacts_open_and_close_as_predicted_do_not_count(run):
    """Linear contacts at zero gap: which of them stay closed is the same for any load, so a cut would not help.

    Nearly all of that is known from the first step, which is taken anew with the contacts that it closes; the rest are not
    worth that.
    """
    process, results = run(held_at_the_ends(1, n=24))
    assert process.returncode == 0, process.stderr
    assert results.status["attempts"].tolist() == [1]
    assert 1 < results.status["iterations"][0] <= 4
    active = results.convergence["active"]
    assert active[1] != active[2] == active[-1] == pytest.approx(active[1], rel=0.05)


def test_voltages_are_not_blamed_while_the_displacements_have_not_converged(run):
    rubbing = held_at_the_ends(1).replace("*SURFACE BEHAVIOR", "*FRICTION\n 0.3\n*SURFACE BEHAVIOR")
    process, _ = run(rubbing.replace(" 1., 1.\n", " 1., 1., 0.5\n"))
    assert process.returncode == 2
    assert "the largest force residual" in process.stderr or "the largest moment residual" in process.stderr
    assert "current residual" not in process.stderr


def test_wires_that_overlap_at_the_start_are_refused(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    text = crossed(height="1.9e-3")
    deck.write_text(text)
    for command in ("run", "check"):
        process = litz(command, deck, cwd=tmp_path)
        assert process.returncode == 1
        assert "overlap at the start by 1.00E-04 m" in process.stderr
        assert "INTERFERENCE FIT" in process.stderr
        line = 2 + text.splitlines().index("*CONTACT PAIR, INTERACTION=SPOT")
        assert f"deck.inp:{line}" in process.stderr
    assert not (tmp_path / "deck.vtkhdf").exists()


@pytest.mark.parametrize(("beside", "crossing"), [(3, 2), (2, 3)])
def test_of_overlaps_at_crossings_and_along_lines_the_deepest_is_named(litz, tmp_path, beside, crossing):
    """A wire with one beside it and one across it below, which overlap it by so many percent of the radius."""
    radius = 1e-3
    heights = [0, (2 - beside / 100) * radius, -(2 - crossing / 100) * radius]
    ends = [((-0.01, 0), (0.01, 0)), ((-0.01, 0), (0.01, 0)), ((0, -0.01), (0, 0.01))]
    nodes = "".join(
        f"{2 * wire + end + 1}, {x}, {y}, {heights[wire]}\n"
        for wire in range(3)
        for end, (x, y) in enumerate(ends[wire])
    )
    deck = tmp_path / "deck.inp"
    deck.write_text(
        f"*UNITS, SYSTEM=SI\n*NODE\n{nodes}"
        f"*ELEMENT, TYPE=B33, ELSET=WIRES\n1, 1, 2\n2, 3, 4\n3, 5, 6\n*MATERIAL, NAME=M\n*ELASTIC\n1e11, 0.3\n"
        f"*BEAM SECTION, ELSET=WIRES, MATERIAL=M, SECTION=CIRC\n{radius}\n*SURFACE INTERACTION, NAME=T\n"
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n*CONTACT PAIR, INTERACTION=T\nWIRES\n*BOUNDARY\n"
        + "".join(f"{node}, 1, 6\n" for node in range(1, 7))
        + "*STEP\n*STATIC\n1, 1\n*END STEP\n"
    )
    process = litz("check", deck)
    assert process.returncode == 1
    assert "overlap at the start by 3.00E-05 m, that is 3 % of the smaller radius" in process.stderr
    named = process.stderr.partition("the wires of elements ")[2].partition(" overlap")[0]
    assert set(named.split(" and ")) == ({"1", "2"} if beside > crossing else {"1", "3"})
    places = int(process.stderr.split("allowed: 1 %; ")[1].split()[0])
    assert places > 2  # one where they cross, the others along the line


def test_an_interference_fit_is_resolved_over_the_first_step(run):
    process, results = run(crossed(height="1.9e-3", pair=", INTERFERENCE FIT", push="0", static="0.25, 1, 1e-3, 0.25"))
    assert process.returncode == 0, process.stderr
    force = results.contacts["force"]
    assert (np.diff(force) > 0).all()
    _, pressed = run(crossed(height="2e-3", push="-1e-4"), name="pressed")
    # pushing supports by the overlap is the same small-displacement problem
    assert force[-1] == pytest.approx(pressed.contacts["force"][-1], rel=2e-3)


def test_a_contact_keeps_its_force_and_identity_over_the_nodes(litz, tmp_path, request):
    """The slider of input 03: force, gap and angle change smoothly, element boundaries included."""
    deck = request.config.rootpath / "inputs" / "03_large_sliding.inp"
    process = litz("run", deck, "-o", tmp_path)
    assert process.returncode == 0, process.stderr
    contacts = Results(tmp_path / "03_large_sliding.vtkhdf").contacts
    drag = contacts.where(contacts["step"] == 2)
    elements = drag["element_1"] + drag["element_2"]
    assert len(np.unique(elements)) >= 5
    assert len(np.unique(contacts["id"])) == 1
    assert len(drag["force"]) == len(np.unique(drag["increment"]))
    second_difference = np.abs(np.diff(drag["force"], 2)) / drag["force"][1:-1]
    handed_over = np.flatnonzero(np.diff(elements) != 0)
    elsewhere = np.delete(
        second_difference, np.clip(np.r_[handed_over - 1, handed_over], 0, len(second_difference) - 1)
    )
    assert second_difference.max() <= 2 * elsewhere.max()


def test_a_conductor_that_loses_contact_keeps_its_potential_without_current(run):
    """The upper wire floats while the contact is open: no singular system, no current."""
    process, results = run(crossed(push="1e-4", static="0.5, 1, 1e-3, 0.5").replace(" 11, 9, 9, 0\n", ""))
    assert process.returncode == 0, process.stderr
    assert np.abs(results.field("element_current")).max() < 1e-12
    assert results.field("potential")[results.node_sets["LOWER"]] == pytest.approx(1e-3)

"""Forces of a given magnetic field on the currents that are computed: *LORENTZ against closed forms."""

import numpy as np
import pytest

from decks import crossed, straight, wire
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

YOUNG, RADIUS, LENGTH, SIGMA = 120e9, 0.5e-3, 0.1, 5e7
AREA = np.pi * RADIUS**2
EI = YOUNG * np.pi * RADIUS**4 / 4
CURRENT, FIELD = 2.0, 0.05


def bar(
    cards, held="1, ENCASTRE\n 9, 2, 3", points=None, element="B33", closed=False, static="1, 1, 1e-3, 1", material=""
):
    """A copper wire along x, or through points, in one step with these cards."""
    points = straight((0, 0, 0), (LENGTH, 0, 0), 8) if points is None else points
    return (
        wire("WIRE", points, element=element, closed=closed)
        + f"*MATERIAL, NAME=COPPER\n*ELASTIC\n {YOUNG}, 0\n*ELECTRICAL CONDUCTIVITY\n {SIGMA}\n{material}"
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC\n {RADIUS}\n*BOUNDARY\n {held}\n"
        f"*STEP, INC=100\n*STATIC\n {static}\n{cards}\n*NODE PRINT, NSET=WIRE, TOTALS=ONLY\n RF\n*ENERGY PRINT\n*END STEP\n"
    )


def finished(run, deck, *arguments):
    process, results = run(deck, *arguments)
    assert process.returncode == 0, process.stderr
    return results


def fed(node, current=CURRENT):
    return f"*BOUNDARY\n 1, 9\n*CECURRENT\n {node}, , {-current}\n"


COUPLINGS = pytest.mark.parametrize(
    "solver",
    ["*SOLVER, NAME=BLOCK, COUPLING=UPDATED\n", "", "*SOLVER, NAME=UMFPACK\n"],
    ids=["turns", "full", "UMFPACK"],
)


@COUPLINGS
@pytest.mark.parametrize("element", ["B31", "B33"])
def test_a_straight_wire_is_a_beam_under_i_b(run, element, solver):
    """I t x B: a current along x in a field along z pulls along -y; both supports carry I B L together."""
    held = "1, 1, 5\n 9, 2, 3"
    results = finished(run, bar(fed(9) + f"*LORENTZ\n WIRE, 0, 0, {FIELD}\n{solver}", held=held, element=element))
    load = CURRENT * FIELD
    np.testing.assert_allclose(results.field("line_load"), [[0, -load, 0]] * 8, atol=1e-3 * load)
    np.testing.assert_allclose(results.field("reaction_force")[[0, 8], 1], load * LENGTH / 2, rtol=1e-6)
    sag = -5 * load * LENGTH**4 / (384 * EI)
    # eight elements with one point each bend a little too easily
    assert results.field("displacement")[4, 1] == pytest.approx(sag, rel=1e-4 if element == "B33" else 0.03)


def test_the_work_of_the_field_is_in_the_balance_of_energy(run):
    """The current and the field grow together, so that the load goes with the square of time."""
    cards = fed(9) + f"*LORENTZ\n WIRE, 0, 0, {FIELD}"
    results = finished(run, bar(cards, held="1, 1, 5\n 9, 2, 3", static="0.25, 1, 1e-3, 0.25"))
    assert results.field("line_load", None)[1:, 0, 1] == pytest.approx(
        -CURRENT * FIELD * np.array([1, 4, 9, 16]) / 16, rel=1e-3
    )
    # q u/2, with u the mean deflection q L^4/(120 EI)
    work = (CURRENT * FIELD) ** 2 * LENGTH**5 / (240 * EI)
    assert results.history["ALLWK"][-1] == pytest.approx(work, rel=1e-3)
    assert np.abs(results.history["ETOTAL"]).max() < 1e-6 * work


@pytest.mark.parametrize("element", ["B31", "B33"])
def test_a_loop_in_a_uniform_field_is_pulled_along_itself_and_nowhere_else(run, element):
    """No net force whatever its shape; N = I B r in a circle across the field."""
    n, radius = 48, 0.02
    angles = 2 * np.pi * np.arange(n + 1) / n
    points = radius * np.c_[np.cos(angles), np.sin(angles), 0 * angles]
    # its ends meet, where the current enters and leaves
    held = "1, 1, 6\n 49, 1, 6"
    cards = fed(49) + f"*LORENTZ\n WIRE, 0, 0, {FIELD}"
    results = finished(run, bar(cards, held=held, points=points, element=element))
    np.testing.assert_allclose(results.field("axial_force"), CURRENT * FIELD * radius, rtol=0.02)
    assert np.abs(results.field("reaction_force").sum(axis=0)).max() < 1e-7 * CURRENT * FIELD * radius


def test_a_loop_in_a_field_that_changes_feels_its_moment_times_the_gradient(run):
    """F = grad(m . B), and the torque m x B: of a stiff circle, m = I A n, A that of its polygon."""
    n, radius = 24, 0.02
    angles = 2 * np.pi * np.arange(n + 1) / n
    points = radius * np.c_[np.cos(angles), np.sin(angles), 0 * angles] + [0.1, -0.2, 0.3]
    gradient = np.array([[3.0, -1.0, 2.0], [4.0, 1.0, -2.0], [5.0, 0.5, -4.0]])
    row = ", ".join(f"{x}" for x in gradient.T.ravel())
    cards = fed(n + 1) + f"*LORENTZ\n WIRE, 0.1, 0.2, {FIELD}, {row}"
    deck = bar(cards, held=f"1, 1, 6\n {n + 1}, 1, 6", points=points, element="B31").replace(str(YOUNG), "1e13")
    results = finished(run, deck)
    moment = CURRENT * n / 2 * radius**2 * np.sin(2 * np.pi / n) * np.array([0, 0, 1])
    np.testing.assert_allclose(-results.field("reaction_force").sum(axis=0), gradient.T @ moment, rtol=1e-4, atol=1e-6)
    reaction, torque = results.field("reaction_force"), results.field("reaction_moment").sum(axis=0)
    centre = np.array([0.1, -0.2, 0.3])
    torque = torque + np.cross(results.positions(-1) - centre, reaction).sum(axis=0)
    field = np.array([0.1, 0.2, FIELD]) + gradient @ centre
    np.testing.assert_allclose(-torque, np.cross(moment, field), rtol=1e-4, atol=1e-7)


def test_contacts_pass_the_current_that_the_field_pulls(run):
    """Two crossing wires: the reaction is that of the currents found, whose contact the field itself changes."""
    cards = "*LORENTZ\n WIRES, 0.02, 0.03, 0.01"
    both = [finished(run, crossed(extra=cards + solver)) for solver in ("", "\n*SOLVER, NAME=BLOCK, COUPLING=UPDATED")]
    current, total = both[0].field("element_current"), np.zeros(3)
    points, b = both[0].positions(-1), np.array([0.02, 0.03, 0.01])
    # of each wire, elements between neighbours
    for first, i in zip([*range(5), *range(6, 11)], current, strict=True):
        total += np.cross(i * (points[first + 1] - points[first]), b)
    np.testing.assert_allclose(both[0].field("reaction_force").sum(axis=0), -total, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(both[0].field("displacement"), both[1].field("displacement"), atol=1e-12)


def test_a_run_in_a_field_goes_on_from_everywhere(litz, tmp_path):
    cards = fed(9) + f"*LORENTZ\n WIRE, 0, 0, {FIELD}, 0, 1, 0, 1, 0, 0, 0, 0, 0\n{KEEP_ALL}"
    assert_goes_on_from_everywhere(litz, tmp_path, bar(cards, held="1, 1, 5\n 9, 2, 3", static="0.25, 1, 1e-3, 0.25"))


def test_a_field_has_no_divergence(litz, tmp_path):
    (tmp_path / "bad.inp").write_text(bar(fed(9) + "*LORENTZ\n WIRE, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1"))
    done = litz("check", "bad.inp", cwd=tmp_path)
    assert done.returncode == 1
    assert "dBx/dx + dBy/dy + dBz/dz must be zero; found 3" in done.stderr

"""Section forces at the nodes of elements, strains, curvatures, and stresses of fibres, against statics and closed forms."""

import numpy as np
import pytest

from decks import cantilever, wire
from litz import Results
from litz.base.names import ON_REQUEST
from litz.results.scalars import find_scalar
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

YOUNG, RADIUS, LENGTH = 200e9, 1e-3, 0.1
AREA = np.pi * RADIUS**2
INERTIA = np.pi * RADIUS**4 / 4
#: Small enough for linear theory to 1e-8 [N]
SMALL = 1e-4
ASK = "*EL PRINT, ELSET=WIRE\n SFN, SE, SK, E11, S11\n"


def finished(run, deck):
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    return results


def at_nodes(results, first, second):
    """Values at the two nodes of each element (n_elements, 2, 3)."""
    return np.stack([results.field(first), results.field(second)], axis=1)


@pytest.mark.parametrize("element", ["B31", "B33"])
@pytest.mark.parametrize("n", [1, 4])
def test_the_root_of_a_cantilever_carries_the_whole_moment(run, element, n):
    """P along z at the tip: Q = P everywhere, M = P (L - x) at every node, from both of its sides."""
    results = finished(run, cantilever(f"*CLOAD\n {n + 1}, 3, {SMALL}\n{ASK}", element=element, n=n))
    moments, forces = (at_nodes(results, f"end_{what}_1", f"end_{what}_2") for what in ("moment", "force"))
    arms = LENGTH - np.linspace(0, LENGTH, n + 1)
    expected = np.stack([arms[:-1], arms[1:]], axis=1) * SMALL
    np.testing.assert_allclose(np.linalg.norm(moments[:, :, 1:], axis=2), expected, atol=1e-7 * SMALL * LENGTH)
    np.testing.assert_allclose(np.linalg.norm(forces[:, :, 1:], axis=2), SMALL, rtol=1e-7)
    # signs as at mid length, where the moment is the mean
    middle = np.c_[results.field("bending_moment_2"), results.field("bending_moment_3")]
    np.testing.assert_allclose(moments[:, :, 1:].mean(axis=1), middle, atol=1e-7 * SMALL * LENGTH)
    shear = np.c_[results.field("shear_force_2"), results.field("shear_force_3")]
    np.testing.assert_allclose(forces[:, 0, 1:], shear, atol=1e-7 * SMALL)


@pytest.mark.parametrize("element", ["B31", "B33"])
def test_loads_on_an_element_are_in_its_forces_at_the_nodes(run, element):
    """q along z: M = q (L - x)^2/2 at every node; the middle of an element shows another one."""
    results = finished(run, cantilever(f"*DLOAD\n WIRE, PZ, {SMALL}\n{ASK}", element=element, n=4))
    moments = np.linalg.norm(at_nodes(results, "end_moment_1", "end_moment_2")[:, :, 1:], axis=2)
    arms = LENGTH - np.linspace(0, LENGTH, 5)
    expected = SMALL / 2 * np.stack([arms[:-1], arms[1:]], axis=1) ** 2
    np.testing.assert_allclose(moments, expected, atol=1e-7 * SMALL * LENGTH**2)
    forces = np.linalg.norm(at_nodes(results, "end_force_1", "end_force_2")[:, :, 1:], axis=2)
    np.testing.assert_allclose(forces, SMALL * np.stack([arms[:-1], arms[1:]], axis=1), atol=1e-7 * SMALL * LENGTH)


def test_a_stretched_wire_has_its_strain_and_stress_everywhere(run):
    results = finished(run, cantilever(f"*CLOAD\n 5, 1, 50.0\n{ASK}", element="B33", n=4))
    strain = 50 / (YOUNG * AREA)
    for name in ("axial_strain", "strain_max", "strain_min"):
        np.testing.assert_allclose(results.field(name), strain, rtol=1e-4)
    np.testing.assert_allclose(results.field("stress_max"), 50 / AREA, rtol=1e-4)
    np.testing.assert_allclose(results.field("end_force_2")[:, 0], 50, rtol=1e-6)
    np.testing.assert_allclose(results.field("curvature_2"), 0, atol=1e-9)


def test_bent_and_twisted_wires_have_their_curvature_twist_and_fibres(run):
    """M = E I kappa and T = G J theta'; fibres at the radius have r kappa on either side."""
    moment, torque = 0.01, 0.02
    results = finished(run, cantilever(f"*CLOAD\n 5, 6, {moment}\n 5, 4, {torque}\n{ASK}", element="B33", n=4))
    curvature = np.hypot(results.field("curvature_2"), results.field("curvature_3"))
    # the torque about the fixed axis bends the turned wire, too: of second order in the turn
    np.testing.assert_allclose(curvature, moment / (YOUNG * INERTIA), rtol=0.02)
    np.testing.assert_allclose(results.field("twist"), torque / (YOUNG / 2.6 * 2 * INERTIA), rtol=0.02)
    np.testing.assert_allclose(results.field("strain_max"), RADIUS * moment / (YOUNG * INERTIA), rtol=0.02)
    np.testing.assert_allclose(results.field("strain_min"), -results.field("strain_max"), rtol=0.02)
    np.testing.assert_allclose(results.field("stress_max"), moment * RADIUS / INERTIA, rtol=0.02)


def test_the_stress_at_the_root_is_that_of_the_root(run):
    """Of a cantilever of four elements the middle of the first one has an eighth less moment than its root."""
    results = finished(run, cantilever(f"*CLOAD\n 5, 3, {SMALL}\n{ASK}", element="B33", n=4))
    assert results.field("stress_max")[0] == pytest.approx(SMALL * LENGTH * RADIUS / INERTIA, rel=1e-6)
    assert results.history["S11MAX element 1"][-1] == pytest.approx(results.field("stress_max")[0], rel=1e-12)
    assert results.history["SMI2 element 1"][-1] == pytest.approx(results.field("end_moment_1")[0, 1], rel=1e-12)


def test_files_hold_them_only_where_a_step_asks(run):
    plain = finished(run, cantilever("*CLOAD\n 5, 3, 1\n*EL PRINT, ELSET=WIRE\n SF\n", n=4))
    assert not {"end_force_1", "strain_max", "axial_strain"} & set(plain.fields)
    asked = finished(run, cantilever("*CLOAD\n 5, 3, 1\n*EL FILE\n E11\n", n=4))
    assert {"end_force_1", "strain_max", "axial_strain"} <= set(asked.fields)


def test_a_field_that_nobody_asked_for_says_how_to(run):
    plain = finished(run, cantilever("*CLOAD\n 5, 3, 1\n*EL PRINT, ELSET=WIRE\n SF\n", n=4))
    assert "axial_strain" not in plain.fields
    asked = finished(run, cantilever("*CLOAD\n 5, 3, 1\n*EL FILE\n E11\n", n=4))
    for word, fields in ON_REQUEST.items():
        for name in fields:
            assert name in asked.fields, "the program has it under this name"
            with pytest.raises(KeyError, match=rf"the run did not write it\. .*\*EL FILE and a line {word},"):
                plain.field(name)
            with pytest.raises(KeyError, match="the run did not write it"):
                find_scalar(plain, name)


def test_a_run_with_section_results_goes_on_from_everywhere(litz, tmp_path):
    cards = f"*DLOAD\n WIRE, P2, 200\n{ASK}{KEEP_ALL}"
    assert_goes_on_from_everywhere(litz, tmp_path, cantilever(cards, static="0.25, 1, 1e-3, 0.25"))


def test_a_curved_wire_shows_what_bends_it(run):
    """A quarter of a circle, clamped at one end, pulled along its radius at the other: M = P r (1 - cos phi)."""
    radius, n = 0.05, 16
    angles = np.linspace(0, np.pi / 2, n + 1)
    points = radius * np.c_[np.sin(angles), 1 - np.cos(angles), 0 * angles]
    deck = cantilever(f"*CLOAD\n {n + 1}, 1, {SMALL}\n{ASK}", element="B33", n=n)
    start, end = deck.index("*NODE"), deck.index("*MATERIAL")
    deck = deck[:start] + wire("WIRE", points, element="B33") + deck[end:]
    results = finished(run, deck)
    moments = np.linalg.norm(at_nodes(results, "end_moment_1", "end_moment_2")[:, :, 1:], axis=2)
    height = points[-1, 1] - points[:, 1]
    expected = SMALL * np.stack([height[:-1], height[1:]], axis=1)
    np.testing.assert_allclose(moments, expected, atol=1e-6 * SMALL * radius)


def test_a_run_that_goes_on_may_ask_for_them_anew(run, litz, tmp_path):
    """The file to go on from holds none; the increments after it do, and a step that is added has loads."""
    plain = cantilever(f"*CLOAD\n 5, 3, 1\n{KEEP_ALL}", n=4, static="0.25, 1, 1e-3, 0.25")
    finished(run, plain)
    longer = cantilever(
        f"*CLOAD\n 5, 3, 1\n{KEEP_ALL}{ASK}", "*DLOAD\n WIRE, PZ, 1\n", n=4, static="0.25, 1, 1e-3, 0.25"
    )
    (tmp_path / "longer.inp").write_text(longer)
    place = f"{tmp_path}/deck/deck.restart.h5:1:2"
    done = litz("run", tmp_path / "longer.inp", "-o", tmp_path / "longer", "--restart", place)
    assert done.returncode == 0, done.stderr
    results = Results(tmp_path / "longer")
    moments = np.linalg.norm(results.field("end_moment_1", None)[:, 0, 1:], axis=1)
    # not known where the run begins again; then P L at three quarters and at the end, and with q L^2/2
    assert moments[0] == 0
    expected = np.array([0.75, 1, 1 + LENGTH / 8, 1 + LENGTH / 4, 1 + 3 * LENGTH / 8, 1 + LENGTH / 2]) * LENGTH
    np.testing.assert_allclose(moments[1:], expected, rtol=5e-3)

"""Current and heat from wires into rigid surfaces: a wire that is earthed by a plate, or cooled by it."""

import re

import numpy as np
import pytest
from matplotlib.figure import Figure

from litz.pictures.charts import contact_heat
from litz.reports.report_tables import balance
from run_of_deck import refusal_of_deck, run_of_deck
from same_results import KEEP_ALL
from test_heat_of_friction_on_surfaces import deck as rubbing_deck
from test_restart import assert_goes_on_from_everywhere

RADIUS, LENGTH = 0.5e-3, 0.1
AREA = np.pi * RADIUS**2
SIGMA, LAMBDA = 5e7, 400.0
#: Resistance of the wire per length [ohm/m]
ALONG = 1 / (SIGMA * AREA)
#: Conductances into the surface, per length [S/m], [W/(m K)], and the force per length [N/m]
G, H, FORCE = 1e4, 1.5, 1e3
CURRENT = f"*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n{1 / G}\n"
HEAT = f"*GAP CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n{H}\n"
STATIC, STEADY = "*STATIC", "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE, ELECTRICAL"
EARTHED = "1, 9, 9, 1e-3\n99, 9\n"
#: A plane below the wire, a drum and a bore that it lies along
SHAPES = {
    "PLANE": "0, 0, 0, 0, 0, 1",
    "CYLINDER": "0, 0, -0.01, 1, 0, 0, 0.01",
    "BORE": "0, 0, 0.02, 1, 0, 0, 0.02",
}


def deck(laws, values, *, elements=20, shape="PLANE", procedure=STATIC, later="", reference=", REF NODE=99", keep="",
         press=f"WIRE, 3, 3, {-FORCE / 1e9}\n"):  # fmt: skip
    """A wire that is held all over and pressed evenly on a surface."""
    nodes = "".join(f"{i + 1}, {LENGTH * i / elements}, 0, {RADIUS}\n" for i in range(elements + 1))
    return f"""\
*NODE, NSET=WIRE
{nodes}*NODE
99, 0, 0, -0.01
*ELEMENT, TYPE=B33, ELSET=WIRE
{"".join(f"{i}, {i}, {i + 1}" + chr(10) for i in range(1, elements + 1))}*MATERIAL, NAME=COPPER
*ELASTIC
1e11, 0.3
*ELECTRICAL CONDUCTIVITY
{SIGMA}
*CONDUCTIVITY
{LAMBDA}
*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC
{RADIUS}
*RIGID SURFACE, NAME=PLATE, TYPE={shape}{reference}
{SHAPES[shape]}
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1e7, 1e9
{laws}*CONTACT PAIR, INTERACTION=TOUCH
WIRE, PLATE
*INITIAL CONDITIONS, TYPE=TEMPERATURE
WIRE, 20
99, 20
*BOUNDARY
WIRE, 1, 2
WIRE, 4, 6
99, 1, 6
*STEP, INC=1000
{procedure}
*BOUNDARY
{press}{values}*NODE PRINT, NSET=WIRE
EPOT, NT
{keep}*END STEP
{later}"""


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


def along(results, name, elements):
    """Values of the nodes of the wire at the end, in its order."""
    return np.array([results.history[f"{name} node {node}"][-1] for node in range(1, elements + 2)])


def decay(length, elements):
    """From 1 at the first node of a wire whose other end is free."""
    x = np.linspace(0, LENGTH, elements + 1)
    return np.cosh((LENGTH - x) / length) / np.cosh(LENGTH / length)


def at_plate(results, name):
    """A value of the reference node at the end."""
    return results.field(name)[list(results.node_ids).index(99)]


# Closed forms


def test_a_current_passes_into_an_earthed_plate_over_the_transfer_length(run):
    """V'' = r' g' V. Linear elements: the error falls with the square of their length."""
    transfer = 1 / np.sqrt(ALONG * G)
    errors = []
    for elements in (20, 40):
        results = run(CURRENT, EARTHED, elements=elements)
        errors.append(np.abs(along(results, "EPOT", elements) / 1e-3 - decay(transfer, elements)).max())
    assert errors[0] < (LENGTH / 20 / transfer) ** 2 / 12
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.02)
    fed = 1e-3 * np.sqrt(G / ALONG) * np.tanh(LENGTH / transfer)
    assert -at_plate(results, "reaction_current") == pytest.approx(fed, rel=1e-3)
    assert results.surface_contacts["current"].sum() == pytest.approx(-at_plate(results, "reaction_current"), rel=1e-12)


def test_a_plate_cools_a_wire_as_a_fin(run):
    """T'' = h'/(lambda A) (T - T0)."""
    transfer = np.sqrt(LAMBDA * AREA / H)
    errors = []
    for elements in (20, 40):
        results = run(HEAT, "1, 11, 11, 120\n99, 11, 11, 20\n1, 9\n", elements=elements, procedure=STEADY)
        errors.append(np.abs((along(results, "NT", elements) - 20) / 100 - decay(transfer, elements)).max())
    assert errors[0] < (LENGTH / 20 / transfer) ** 2 / 12
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.05)
    # what comes in at the end leaves at the reference node
    assert -at_plate(results, "reaction_heat") == pytest.approx(results.field("reaction_heat")[0], rel=1e-9)
    assert results.surface_contacts["heat_of_surface"].sum() == pytest.approx(
        -at_plate(results, "reaction_heat"), rel=1e-9
    )


@pytest.mark.parametrize("shape", SHAPES)
def test_a_wire_that_its_current_heats_is_warmer_than_the_plate_by_q_over_h(run, shape):
    values = "99, 11, 11, 20\n21, 9\n*CECURRENT\n1, 9, 20\n"
    results = run(HEAT, values, shape=shape, procedure=STEADY)
    np.testing.assert_allclose(along(results, "NT", 20), 20 + 20**2 * ALONG / H, rtol=1e-12)


@pytest.mark.parametrize("shape", SHAPES)
def test_tables_hold_over_the_force_per_length(run, shape):
    """The wire at 1 mV and 120, the surface at 0 and 20."""
    laws = (
        f"*GAP ELECTRICAL CONDUCTANCE, LAW=TABLE, PER=LENGTH\n{FORCE / 10}, 1e-3\n{FORCE}, {1 / G}\n{10 * FORCE}, 1e-5\n"
        f"*GAP CONDUCTANCE, LAW=TABLE, PER=LENGTH\n{FORCE / 10}, 0.5\n{FORCE}, {H}\n{10 * FORCE}, 5\n"
    )
    results = run(laws, "WIRE, 9, 9, 1e-3\n99, 9\nWIRE, 11, 11, 120\n99, 11, 11, 20\n", shape=shape, procedure=STEADY)
    contacts = results.surface_contacts
    assert contacts["conductance"].sum() == pytest.approx(G * LENGTH, rel=1e-9)
    assert contacts["current"].sum() == pytest.approx(G * LENGTH * 1e-3, rel=1e-9)
    joule = G * LENGTH * 1e-6
    assert contacts["joule_heat"].sum() == pytest.approx(joule, rel=1e-9)
    # half of what the current makes enters either side
    assert contacts["heat"].sum() == pytest.approx(joule / 2 - H * LENGTH * 100, rel=1e-9)
    assert contacts["heat_of_surface"].sum() == pytest.approx(joule / 2 + H * LENGTH * 100, rel=1e-9)
    assert not results.warnings


def test_a_force_beyond_the_table_is_a_warning(run):
    law = f"*GAP ELECTRICAL CONDUCTANCE, LAW=TABLE, PER=LENGTH\n{2 * FORCE}, 1e-4\n{4 * FORCE}, 5e-5\n"
    warnings = run(law, EARTHED).warnings
    assert {warning.kind for warning in warnings} == {"outside_table"}
    assert "on the rigid surface PLATE has a force of" in warnings[0].message


def test_a_warm_wire_cools_on_a_plate_by_an_exponential(litz, tmp_path):
    """rho c A dT/dt = -h' (T - T0). Increments that are each exact to 1e-4 K."""
    storage = "*DENSITY\n8960\n*SPECIFIC HEAT\n385\n*BEAM SECTION"
    time = 8960 * 385 * AREA / H
    procedure = f"*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, ERROR=1e-4\n{time / 1000}, {time}"
    text = deck(HEAT, "99, 11, 11, 20\n1, 9\n", elements=2, procedure=procedure)
    text = text.replace("*BEAM SECTION", storage, 1).replace("WIRE, 20\n", "WIRE, 120\n", 1)
    results = run_of_deck(litz, tmp_path, lambda: text)()
    np.testing.assert_allclose(along(results, "NT", 2), 20 + 100 * np.exp(-1), atol=0.01)


#: On the side of the wire, from 20 on: an element of half the length passes as much through it as along the wire
FILM = 1000
COOLED = f"*FILM\nWIRE, F, 20, {FILM}\n"


@pytest.mark.parametrize("elements", [1, 5, 20])
def test_what_enters_evenly_gives_an_even_temperature_under_a_film_on_any_mesh(run, elements):
    """Half of the heat of the current and what the warm plate gives leave through the film, at one temperature."""
    values = "WIRE, 9, 9, 0.1\n99, 9\n99, 11, 11, 120\n"
    results = run(CURRENT + HEAT, values, elements=elements, procedure=STEADY, keep=COOLED)
    through_film = FILM * 2 * np.pi * RADIUS
    rise = (G * 0.1**2 / 2 + H * 100) / (through_film + H)
    assert along(results, "NT", elements) == pytest.approx(20 + rise, rel=1e-9)
    assert results.field("surface_heat") == pytest.approx(through_film * rise * LENGTH / elements, rel=1e-9)
    assert results.surface_contacts["heat"].sum() == pytest.approx(through_film * rise * LENGTH, rel=1e-9)


def test_a_wire_between_a_film_and_a_plate_warms_by_an_exponential_on_any_mesh(litz, tmp_path):
    """rho c A dT/dt = h' (T0 - T) - h P (T - T_s). Increments that are each exact to 1e-4 K."""
    through_film = FILM * 2 * np.pi * RADIUS
    time = 8960 * 385 * AREA / (H + through_film)
    procedure = f"*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, ERROR=1e-4\n{time / 1000}, {time}"
    storage = "*DENSITY\n8960\n*SPECIFIC HEAT\n385\n*BEAM SECTION"
    reached = []
    for elements in (1, 10):
        text = deck(HEAT, "99, 11, 11, 120\n1, 9\n", elements=elements, procedure=procedure, keep=COOLED)
        results = run_of_deck(litz, tmp_path, lambda text=text: text.replace("*BEAM SECTION", storage, 1))()
        reached.append(along(results, "NT", elements))
    np.testing.assert_allclose(reached[0], 20 + 100 * H / (H + through_film) * (1 - np.exp(-1)), atol=0.01)
    np.testing.assert_allclose(reached[1], reached[0][0], rtol=1e-9)


@pytest.mark.parametrize("strength", [0.1, 1, 10])
def test_a_wire_that_swells_between_plates_presses_itself_cooler(litz, tmp_path, strength):
    """It is held between a cold plate, whose conductance grows with the force, and a warm one: h'(f) dT = h' (100 - dT) with
    f = f0 + k r alpha dT. What the swelling does to forces and conductances is in the tangent: increments are as large as
    asked for, and Newton's method takes few iterations, however strongly the heat acts on itself."""
    expansion, stiffness, overlap, slope = 1.7e-5, 1e9, 1e-8, strength * H / FORCE
    table = f"*GAP CONDUCTANCE, LAW=TABLE, PER=LENGTH\n1, {slope}\n{10 * FORCE}, {slope * 10 * FORCE}\n"
    above = (
        f"*NODE\n98, 0, 0, 0.02\n*RIGID SURFACE, NAME=ABOVE, TYPE=PLANE, REF NODE=98\n0, 0, {2 * RADIUS - overlap}, 0, 0, -1\n"
        "*SURFACE INTERACTION, NAME=UPPER\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e7, 1e9\n"
        f"{HEAT}*CONTACT PAIR, INTERACTION=UPPER\nWIRE, ABOVE\n*INITIAL CONDITIONS"
    )
    swelling = f"*EXPANSION, ZERO=20\n{expansion}\n*BEAM SECTION"
    values = "99, 11, 11, 20\n98, 11, 11, 120\n98, 1, 6\n1, 9\n"
    text = deck(table, values, procedure=f"{STEADY}\n0.25, 1", press="WIRE, 3, 3, 0\n")
    text = text.replace("*INITIAL CONDITIONS", above, 1).replace("*BEAM SECTION", swelling, 1)
    text = text.replace("WIRE, 20\n", "WIRE, 20\n98, 20\n", 1).replace(
        "\n0, 0, 0, 0, 0, 1\n", f"\n0, 0, {overlap}, 0, 0, 1\n"
    )
    results = run_of_deck(litz, tmp_path, lambda: text)()
    quadratic = slope * stiffness * RADIUS * expansion
    linear = slope * stiffness * overlap + H
    rise = (-linear + np.sqrt(linear**2 + 4 * quadratic * H * 100)) / (2 * quadratic)
    assert along(results, "NT", 20) == pytest.approx(20 + rise, rel=1e-9)
    assert list(results.status["attempts"]) == [1, 1, 1, 1]
    assert results.status["iterations"].max() <= 10


# Surfaces as conductors


def test_a_plate_that_floats_takes_the_potential_at_which_nothing_leaves_it(run):
    """Half of the wire at 1 mV, half earthed: the plate is half-way, and carries the current of half a wire."""
    halves = "".join(f"{node}, 9, 9, {1e-3 if node <= 11 else 0}\n" for node in range(1, 22) if node != 11)
    results = run(CURRENT, halves + "11, 9, 9, 0.5e-3\n")
    assert at_plate(results, "potential") == pytest.approx(0.5e-3, rel=1e-12)
    assert results.surface_contacts["current"].sum() == pytest.approx(0, abs=1e-12 * G * LENGTH * 1e-3)


def test_without_a_law_for_heat_the_wire_keeps_half_of_that_of_the_current(run):
    results = run(CURRENT, "1, 11, 11, 20\n" + EARTHED, procedure=STEADY)
    joule = results.surface_contacts["joule_heat"].sum()
    assert results.surface_contacts["heat"].sum() == pytest.approx(joule / 2, rel=1e-12)
    assert -results.field("reaction_heat")[0] == pytest.approx(joule / 2 + results.field("joule_heat").sum(), rel=1e-9)


def test_the_heat_on_surfaces_is_in_all_that_tells_of_heat(run):
    """The power of the current is the heat of summary, report, charts and slices; a wire has half of that on the plate."""
    results = run(CURRENT, EARTHED)
    power = -1e-3 * at_plate(results, "reaction_current")
    wires, on_plate = results.field("joule_heat").sum(), results.surface_contacts["joule_heat"].sum()
    assert wires + on_plate == pytest.approx(power, rel=1e-9)
    assert re.search(r"Joule heat +(\S+)", results.summary()).group(1) == f"{power:.5g}"
    assert f"on rigid surfaces {on_plate:.5g}" in results.summary()
    assert "Joule heat on rigid surfaces" in balance(results)
    table = results.wire_heat()
    assert table["contacts"] == pytest.approx(on_plate / 2, rel=1e-12)
    assert table["total"] == pytest.approx(wires + on_plate / 2, rel=1e-12)
    slices = results.along_cable(count=7)
    all_heat = slices["heat_on_surfaces_per_length"] + slices["wire_heat_per_length"]
    assert all_heat.sum() * LENGTH / 7 == pytest.approx(power, rel=1e-9)
    axes = Figure().add_subplot()
    contact_heat(axes, results)
    drawn = {line.get_label(): line.get_ydata()[-1] for line in axes.get_lines()}
    assert drawn["on rigid surfaces"] / drawn["wires"] == pytest.approx(on_plate / wires, rel=1e-12)


def test_heat_and_current_pass_while_all_motions_are_held(run):
    later = (
        "*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n*BOUNDARY\n1, 11, 11, 120\n99, 11, 11, 20\n"
        "*NODE PRINT, NSET=WIRE\nEPOT, NT\n*END STEP\n"
    )
    results = run(CURRENT + HEAT, EARTHED, later=later)
    at_once = run(CURRENT + HEAT, "1, 11, 11, 120\n99, 11, 11, 20\n" + EARTHED, procedure=STEADY)
    for name in ("EPOT", "NT"):
        np.testing.assert_allclose(along(results, name, 20), along(at_once, name, 20), rtol=1e-9)


def test_what_is_lifted_passes_nothing(run):
    later = "*STEP\n*STATIC\n*BOUNDARY\nWIRE, 3, 3, 1e-6\n99, 9, 9, 5e-4\n*NODE PRINT, NSET=WIRE\nEPOT\n*END STEP\n"
    results = run(CURRENT, EARTHED, later=later)
    np.testing.assert_allclose(along(results, "EPOT", 20), 1e-3, rtol=1e-9)
    assert at_plate(results, "reaction_current") == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("coupling", ["MONOLITHIC", "UPDATED", "FULL"])
def test_motions_and_flows_in_one_step_agree_with_flows_after_motions(run, coupling):
    """Ends that are pressed differently, and forces between them: conductances vary along the wire."""
    law = f"*GAP ELECTRICAL CONDUCTANCE, LAW=TABLE, PER=LENGTH\n1e2, 1e-3\n1e4, 5e-5\n{HEAT}"
    forces = "*CLOAD\n" + "".join(f"{node}, 3, {-0.3 * node}\n" for node in range(2, 21))
    ends = "1, 3, 3, -1e-7\n21, 3, 3, -3e-6\n"
    fixed = "1, 11, 11, 120\n99, 11, 11, 20\n"
    later = f"*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n*BOUNDARY\n{fixed}*NODE PRINT, NSET=WIRE\nEPOT, NT\n*END STEP\n"
    solver = f"*SOLVER, NAME=BLOCK, COUPLING={coupling}\n"
    one = run(law, EARTHED + fixed + forces + solver, press=ends, procedure=STEADY)
    potential, temperature = along(one, "EPOT", 20), along(one, "NT", 20)
    assert one.surface_contacts["current"].sum() == pytest.approx(-at_plate(one, "reaction_current"), rel=1e-8)
    after = run(law, EARTHED + forces, press=ends, later=later)
    np.testing.assert_allclose(potential, along(after, "EPOT", 20), rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(temperature, along(after, "NT", 20), rtol=1e-7)


def test_the_rest_of_the_heat_of_friction_enters_a_plate_with_a_temperature(litz, tmp_path):
    """As much as the wire keeps of it: what leaves the plate at its reference node is the other half of the power."""
    law = "*GAP CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n1e-9\n"
    text = rubbing_deck("0.01, 0.1", "at once", law=law).replace("TYPE=PLANE", "TYPE=PLANE, REF NODE=999")
    text = text.replace("*MATERIAL, NAME=STEEL", "*NODE\n999, 0, 0, -0.01\n*MATERIAL, NAME=STEEL")
    text = text.replace("WIRE, ENCASTRE\n", "WIRE, ENCASTRE\n999, 1, 6\n")
    text = text.replace("*ENERGY PRINT\n", "*BOUNDARY\n999, 11, 11, 20\n*ENERGY PRINT\n")
    results = run_of_deck(litz, tmp_path, lambda: text)()
    power = np.diff(results.history["ALLFD"])[-1] / 0.01
    plate = results.field("reaction_heat")[list(results.node_ids).index(999)]
    assert -plate == pytest.approx(power / 2, rel=1e-6)


def test_a_run_goes_on_from_every_increment(litz, tmp_path):
    values = "1, 11, 11, 120\n99, 11, 11, 20\n" + EARTHED
    text = deck(CURRENT + HEAT, values, elements=5, procedure=f"{STEADY}\n0.25, 1, , 0.25", keep=KEEP_ALL)
    assert_goes_on_from_everywhere(litz, tmp_path, text)


# What is refused


@pytest.mark.parametrize(
    ("laws", "message"),
    [
        (
            "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n",
            "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, a law of spots between wires",
        ),
        (
            "*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT\n1e-3\n",
            "possible are LAW=CONSTANT and LAW=TABLE with PER=LENGTH",
        ),
        (CURRENT.replace("PER=", "SPOT=LARGEST FORCE, PER="), "possible is SPOT=PRESENT FORCE"),
        (
            CURRENT.replace("PER=", "MUTUAL RESISTANCE=YES, PER="),
            "MUTUAL RESISTANCE=YES of *GAP ELECTRICAL CONDUCTANCE",
        ),
        ("*GAP CONDUCTANCE, LAW=METAL\n", "*GAP CONDUCTANCE, LAW=METAL, a law of spots between wires"),
        (HEAT.replace("PER=", "TMELT=1300, PER="), "TSOFT or TMELT of *GAP CONDUCTANCE"),
    ],
)
def test_laws_of_spots_are_refused_by_name(refused, laws, message):
    said = refused(1, laws + ("*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0\n" if "METAL" in laws else ""), EARTHED)
    assert message in said
    assert "surface interaction TOUCH has" in said
    assert "wire.inp:" in said


def test_a_surface_without_a_reference_node_cannot_take_a_current(refused):
    said = refused(1, CURRENT, "1, 9, 9, 1e-3\n", reference="")
    assert "passes current to the rigid surface PLATE, which needs a reference node for it: REF NODE=" in said


def test_an_insulating_surface_has_no_potential(refused):
    assert "node 99 has no electric potential" in refused(1, "", EARTHED)
    assert "node 99 has no temperature as an unknown" in refused(1, CURRENT, "99, 11\n", procedure=STEADY)


def test_a_wire_on_a_plate_that_nothing_earths_is_named(refused):
    said = refused(1, CURRENT, "")
    assert "the conductor WIRE (20 connected elements from element 1 on) has no path to a prescribed potential" in said


def test_a_plate_whose_potential_only_contacts_give_is_named_by_the_check(litz, tmp_path):
    path = tmp_path / "wire.inp"
    path.write_text(deck(CURRENT, "1, 9, 9, 1e-3\n"))
    said = litz("check", path).stdout
    assert "the rigid surface PLATE has no prescribed potential; only contacts can connect it to one" in said
    path.write_text(deck(CURRENT, "99, 9, 9, 1e-3\n"))
    assert (
        "the conductor WIRE (20 connected elements from element 1 on) has no prescribed potential"
        in litz("check", path).stdout
    )


def test_a_plate_whose_temperature_nothing_fixes_is_named(refused):
    """The wire is lifted, and has a temperature."""
    said = refused(2, HEAT, "1, 11, 11, 20\n1, 9\n", press="WIRE, 3, 3, 1e-5\n", procedure=STEADY)
    assert "the temperature of the rigid surface PLATE is not determined" in said
    assert "prescribe degree of freedom 11 of its reference node 99" in said


def test_a_misspelt_surface_does_not_make_its_potential_an_error(litz, tmp_path):
    wrong = deck(CURRENT, EARTHED).replace("WIRE, PLATE", "WIRE, PLAET")
    text = refusal_of_deck(litz, tmp_path, lambda: wrong)(1)
    assert "did you mean PLATE?" in text
    assert text.count("error: ") == 1


@pytest.mark.parametrize(
    ("procedure", "dof", "flow"),
    [
        (STATIC, 9, "a current to its rigid surface (*GAP ELECTRICAL CONDUCTANCE, PER=LENGTH"),
        (STEADY, 11, "heat to its rigid surface (*GAP CONDUCTANCE, PER=LENGTH"),
    ],
)
def test_a_reference_node_to_which_nothing_passes_is_told_what_would_pass(refused, procedure, dof, flow):
    text = refused(1, "", f"1, 9, 9, 1e-3\n99, {dof}\n", procedure=procedure)
    assert f"no contact pair passes {flow}" in text

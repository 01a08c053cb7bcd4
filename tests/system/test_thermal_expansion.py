"""Wires that expand with their temperature: bars, a bimetal, buckling, contacts that swell, and the balance of energy."""

import numpy as np
import pytest

from decks import crossed
from litz import Results, kernels
from test_restart import assert_goes_on_from_everywhere

#: A wire of 0.1 m along x of 8 elements of 1 mm radius, clamped at its first node
WIRE = """\
*NODE, NSET=ALL
{nodes}
*ELEMENT, TYPE={element}, ELSET=WIRE
{elements}
*MATERIAL, NAME=COPPER
*ELASTIC
{elastic}
*EXPANSION{zero}
{alpha}
{conductivity}
*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*INITIAL CONDITIONS, TYPE=TEMPERATURE
 ALL, 20
*BOUNDARY
 1, ENCASTRE
{supports}
*STEP, INC=500
*STATIC
{static}
*TEMPERATURE
{temperature}
*ENERGY PRINT
{extra}
*END STEP
"""
LENGTH, RADIUS, AREA = 0.1, 1e-3, np.pi * 1e-6
YOUNG, ALPHA = 120e9, 17e-6
#: Strains of 1e-4 are differences of stretches near 1, whose last bit is 2e-16
ROUND_OFF = 1e-11

both_elements = pytest.mark.parametrize("element", ["B31", "B33"])


def wire(element="B33", bow=0.0, **options):
    """The deck of a wire, with a bow as a clamped column buckles [m]."""
    x = np.linspace(0, LENGTH, 9)
    defaults = {
        "elastic": f"{YOUNG}, 0.34", "alpha": f"{ALPHA}", "zero": "", "conductivity": "", "supports": "",
        "static": "0.25, 1, 1e-4, 0.25", "temperature": "ALL, 120", "extra": "",
    }  # fmt: skip
    assert options.keys() <= defaults.keys()
    return WIRE.format(
        element=element,
        nodes="\n".join(f"{i}, {v}, 0, {bow * np.sin(np.pi * v / LENGTH) ** 2}" for i, v in enumerate(x, 1)),
        elements="\n".join(f"{i}, {i}, {i + 1}" for i in range(1, 9)),
        **{**defaults, **options},
    )


def run(litz, tmp_path, text):
    deck = tmp_path / "deck.inp"
    deck.write_text(text)
    done = litz("run", deck, "-o", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    return Results(tmp_path / "out"), done.stderr


@both_elements
def test_a_free_wire_gets_longer_and_has_no_force(litz, tmp_path, element):
    results, messages = run(litz, tmp_path, wire(element))
    np.testing.assert_allclose(results.field("displacement")[-1], [ALPHA * 100 * LENGTH, 0, 0], rtol=1e-12, atol=1e-18)
    assert np.abs(results.field("axial_force", None)).max() < 1e-9 * YOUNG * AREA * ALPHA * 100
    assert "critical load" not in messages
    assert np.abs(results.history["ALLTW"]).max() < 1e-12 * YOUNG * AREA * LENGTH * (ALPHA * 100) ** 2


def arc(element, angle, section=None, height=0.03):
    """The wire as part of an ellipse of half axes of 30 mm and `height` in the plane of x and z, with nodes at these angles."""
    x = np.column_stack([0.03 * np.sin(angle), np.zeros(len(angle)), height * (1 - np.cos(angle))])
    text = wire(element)
    nodes = "\n".join(f"{i}, {a:.17g}, 0, {c:.17g}" for i, (a, _, c) in enumerate(x, 1))
    before, after = text.index("*NODE, NSET=ALL\n") + len("*NODE, NSET=ALL\n"), text.index("\n*ELEMENT")
    text = text[:before] + nodes + text[after:]
    return (text.replace("SECTION=CIRC\n 1e-3\n", f"SECTION={section}") if section else text), x


@both_elements
@pytest.mark.parametrize("turn", [1.5, 6.0])
def test_a_curved_wire_that_is_free_grows_in_all_directions_alike(litz, tmp_path, element, turn):
    """The chord of an element grows, the angles of its bend do not: it has no force, however coarse the mesh."""
    text, x = arc(element, np.linspace(0, turn, 9))
    results, _ = run(litz, tmp_path, text)
    np.testing.assert_allclose(results.field("displacement"), ALPHA * 100 * x, atol=ROUND_OFF * 0.03)
    assert np.abs(results.field("axial_force")).max() < ROUND_OFF * YOUNG * AREA


#: Their centroid or shear centre lies beside the nodes, within the plane of the bend or out of it
BESIDE = {
    "inner": "RECT, OFFSET2=0.5\n 1e-3, 2e-3\n 0, 1, 0\n",
    "outer": "RECT, OFFSET2=-0.5\n 1e-3, 2e-3\n 0, 1, 0\n",
    "beside": "RECT, OFFSET1=0.5, OFFSET2=0.2\n 1e-3, 2e-3\n 0, 1, 0\n",
    "I": "I\n 0.1e-3, 2e-3, 1e-3, 1e-3, 0.2e-3, 0.2e-3, 0.2e-3\n 0, 1, 0\n",
    "box": "BOX\n 2e-3, 2e-3, 0.4e-3, 0.1e-3, 0.4e-3, 0.6e-3\n 0, 1, 0\n",
    "L": "L\n 2e-3, 2e-3, 0.3e-3, 0.2e-3\n 0, 1, 0\n",
}


@both_elements
@pytest.mark.parametrize("section", BESIDE)
def test_a_curved_wire_beside_its_nodes_grows_as_they_do(litz, tmp_path, element, section):
    """A free body of one temperature grows alike everywhere, wherever its nodes are.

    Rigid arms do not grow, so that the axis at their ends grows by what the nodes do: its own length is by arm/R another
    one.
    """
    text, x = arc(element, np.linspace(0, 1.5, 9), BESIDE[section])
    results, _ = run(litz, tmp_path, text)
    np.testing.assert_allclose(results.field("displacement"), ALPHA * 100 * x, atol=ROUND_OFF * 0.03)
    assert np.abs(results.field("axial_force")).max() < 10 * ROUND_OFF * YOUNG * 2e-6


@both_elements
def test_a_curved_wire_of_unlike_elements_grows_alike(litz, tmp_path, element):
    """A chord of an ellipse has other angles to the tangents of its ends: its shear strain grows, too."""
    angle = np.array([0, 0.1, 0.35, 0.45, 0.7, 0.8, 1.05, 1.15, 1.4])
    text, x = arc(element, angle, height=0.015)
    results, _ = run(litz, tmp_path, text)
    np.testing.assert_allclose(results.field("displacement"), ALPHA * 100 * x, atol=ROUND_OFF * 0.03)


@both_elements
def test_a_clamped_wire_is_pressed_and_temperature_does_the_work(litz, tmp_path, element):
    results, _ = run(litz, tmp_path, wire(element, supports="9, ENCASTRE", temperature="ALL, 25"))
    np.testing.assert_allclose(results.field("axial_force"), -YOUNG * AREA * ALPHA * 5, rtol=ROUND_OFF)
    history = results.history
    np.testing.assert_allclose(history["ALLTW"][-1], YOUNG * AREA * LENGTH * (ALPHA * 5) ** 2 / 2, rtol=ROUND_OFF)
    np.testing.assert_allclose(history["ALLSE"], history["ALLTW"], rtol=ROUND_OFF, atol=1e-18)
    assert np.abs(history["ETOTAL"]).max() < ROUND_OFF * history["ALLTW"][-1]


def test_expansion_is_that_of_secant_coefficients_from_their_zero(litz, tmp_path):
    """alpha is 15e-6 at 20 and 20e-6 at 120 degrees, from 0 degrees on; between 70 degrees are half-way."""
    text = wire(zero=", ZERO=0", alpha="15e-6, 20\n20e-6, 120", temperature="ALL, 70")
    results, _ = run(litz, tmp_path, text)
    expected = 17.5e-6 * 70 - 15e-6 * 20
    np.testing.assert_allclose(results.field("displacement")[-1, 0], expected * LENGTH, rtol=1e-12)


def test_an_element_has_the_mean_temperature_of_its_nodes(litz, tmp_path):
    results, _ = run(litz, tmp_path, wire(temperature="ALL, 20\n".replace("ALL", "1") + " 9, 100"))
    np.testing.assert_allclose(results.field("displacement")[-1, 0], ALPHA * 80 / 2 * LENGTH / 8, rtol=1e-12)


@both_elements
def test_stiffness_follows_the_temperature(litz, tmp_path, element):
    """E falls from 120 to 100 GPa between 0 and 100 degrees, and is constant beyond; the wire is clamped."""
    table = "120e9, 0.34, 0\n100e9, 0.3, 100"
    supports = "9, ENCASTRE"
    for at, young in ((25, 115e9), (-40, 120e9)):
        text = wire(element, elastic=table, supports=supports, temperature=f"ALL, {at}")
        results, _ = run(litz, tmp_path, text)
        np.testing.assert_allclose(results.field("axial_force"), -young * AREA * ALPHA * (at - 20), rtol=ROUND_OFF)
        assert np.abs(results.history["ETOTAL"]).max() < 1e-9 * results.history["ALLTW"][-1]


@pytest.mark.parametrize("card", ["", "*TRANSVERSE SHEAR STIFFNESS\n 1e5, 1e5"])
def test_a_bent_wire_sinks_as_it_gets_softer(litz, tmp_path, card):
    """A cantilever of B31 under a tip force, heated to half of its modulus: bending and the shear that follows from it."""
    left = []
    for increment in (0.2, 0.05):
        options = {"alpha": "0", "static": f"{increment}, 1, 1e-4, {increment}"}
        text = wire("B31", elastic="120e9, 0.34, 20\n60e9, 0.34, 120", **options)
        text = text.replace(" 1e-3\n*INITIAL", f" 1e-3\n{card}\n*INITIAL")
        load = "*CLOAD\n 9, 3, 1e-3\n"
        text = text.replace("*STEP, INC=500", f"*STEP\n*STATIC\n{load}*END STEP\n*STEP, INC=500")
        results, _ = run(litz, tmp_path, text.replace("*ENERGY PRINT", f"{load}*ENERGY PRINT"))
        before, after = (results.field("displacement", i)[-1, 2] for i in (1, -1))
        shear = 1e-3 * LENGTH / 1e5 if card else 0
        assert (after - shear) / (before - shear) == pytest.approx(2, rel=1e-6)
        left.append(abs(results.history["ETOTAL"][-1]) / results.history["ALLWK"][-1])
    # the work of the temperature is a mean of both ends of an increment: of second order
    assert left[0] / left[1] == pytest.approx(16, rel=0.1)
    assert left[1] < 1e-3


def test_resistance_follows_the_temperature(litz, tmp_path):
    """The resistivity is linear between the lines, not the conductivity: half-way it is the mean of 1/6e7 and 1/3e7."""
    text = wire(
        conductivity="*ELECTRICAL CONDUCTIVITY\n 6e7, 20\n 3e7, 120",
        temperature="ALL, 70",
        extra="*BOUNDARY\n 1, 9\n 9, 9, 9, 1e-3",
    )
    results, _ = run(litz, tmp_path, text)
    resistance = (1 / 6e7 + 1 / 3e7) / 2 * LENGTH / AREA
    np.testing.assert_allclose(results.field("element_current"), -1e-3 / resistance, rtol=1e-12)


@both_elements
def test_a_bimetal_strip_bends_as_timoshenko_has_it(litz, tmp_path, element):
    """Two wires of square distance `a` beside each other, tied by rigid bodies at every node, of other expansions.

    Each keeps its own bending stiffness EI: with the forces +-P in the wires, P a = 2 EI k and the strains
    alpha1 T + P/(EA) + a k/2 and alpha2 T - P/(EA) - a k/2 are equal: k = (alpha2 - alpha1) T a/(a^2 + 4 I/A).
    Timoshenko, J. Opt. Soc. Am. 11 (1925) 233-255, for strips with these sections. The ties make this exact at nodes.
    """
    n, a = 10, 4e-3
    x = np.linspace(0, LENGTH, n + 1)
    lines = ["*NODE, NSET=ALL"]
    for k, z in enumerate((-a / 2, a / 2)):
        lines += [f"{100 * (k + 1) + i}, {v}, 0, {z}" for i, v in enumerate(x)]
    for k, name in enumerate(("LOW", "TOP")):
        lines += [f"*ELEMENT, TYPE={element}, ELSET={name}"]
        lines += [f"{100 * (k + 1) + i}, {100 * (k + 1) + i}, {100 * (k + 1) + i + 1}" for i in range(n)]
        lines += [f"*MATERIAL, NAME={name}", "*ELASTIC", f"{YOUNG}, 0.3", "*EXPANSION", f"{(20e-6, 12e-6)[k]}"]
        lines += [f"*BEAM SECTION, ELSET={name}, MATERIAL={name}, SECTION=CIRC", "1e-3"]
    for i in range(n + 1):
        lines += [f"*NSET, NSET=N{i}", f"{200 + i}", f"*RIGID BODY, REF NODE={100 + i}, TIE NSET=N{i}"]
    lines += ["*BOUNDARY", "100, 1, 6", "*STEP", "*STATIC", "*TEMPERATURE", "ALL, 20", "*ENERGY PRINT", "*END STEP"]
    results, _ = run(litz, tmp_path, "\n".join(lines) + "\n")
    curvature = (20e-6 - 12e-6) * 20 * a / (a**2 + 4 * RADIUS**2 / 4)
    turn = results.field("rotation")[results.node_ids == 100 + n][0, 1]
    # a lower wire that expands more lifts the free end: a negative turn about y; strains of 1e-4 count beside 1
    assert turn == pytest.approx(-curvature * LENGTH, rel=1e-3)
    history = results.history
    assert abs(history["ETOTAL"][-1]) < 1e-3 * history["ALLTW"][-1]


def test_a_heated_clamped_wire_buckles_and_bows(litz, tmp_path):
    """Euler: dT = pi^2 r^2/(alpha L^2); beyond it the bow is w = 2 r sqrt(dT/dTc - 1), with w/2 (1 - cos(2 pi x/L)).

    The shortening pi^2 w^2/(4 L) of the bow takes up what the force does not: it stays at Euler's. Eight elements have a
    buckling load 0.1 % too high; the second order of the bow (1 + w^2/8 (pi/L)^2) is below 1e-3.
    """
    critical = np.pi**2 * RADIUS**2 / (ALPHA * LENGTH**2)
    for factor, least, most in ((0.8, 0, 0.15), (3.0, 0.98, 1.02)):
        text = wire(
            bow=2e-5,
            supports="9, ENCASTRE",
            temperature=f"ALL, {20 + factor * critical}",
            static="0.02, 1, 1e-5, 0.05",
            extra="*NODE PRINT, NSET=ALL\n U",
        )
        results, _ = run(litz, tmp_path, text)
        bow = abs(results.history["U3 node 5"][-1]) + 2e-5
        expected = 2 * RADIUS * np.sqrt(max(factor - 1, 1))
        assert least < bow / expected < most
    euler = 4 * np.pi**2 * YOUNG * np.pi * RADIUS**4 / 4 / LENGTH**2
    assert results.field("axial_force").min() == pytest.approx(-euler, rel=0.02)
    history = results.history
    assert abs(history["ETOTAL"][-1]) < 0.01 * history["ALLTW"][-1]


def swelling_pair(temperatures, extra="", element="B33"):
    """Two crossed wires that touch without force, all their nodes clamped."""
    text = crossed(push="0", element=element, static="0.05, 1, 1e-4, 0.05", extra=temperatures + "\n*ENERGY PRINT")
    text = text.replace("*ELECTRICAL COND", f"*EXPANSION\n {ALPHA}\n*ELECTRICAL COND")
    text = text.replace(" LOWER_ENDS, 1, 6\n", " LOWER, 1, 6\n UPPER, 1, 6\n", 1)
    return text.replace(" UPPER_ENDS, 1, 2\n UPPER_ENDS, 4, 6\n UPPER_ENDS, 3, 3, 0\n", extra)


def hertz_force(overlap):
    """By the approach of 1 N, which goes with the force to the power 2/3."""
    pair = {"radius": [RADIUS] * 2, "young": [YOUNG] * 2, "poisson": [0.34] * 2, "resistivity": [1.7e-8] * 2}
    return (overlap / kernels.contact_spot(1.0, angle=np.pi / 2, **pair).approach) ** 1.5


def test_wires_that_touch_swell_into_each_other(litz, tmp_path):
    """At constant distance the approach is 2 r alpha dT."""
    results, _ = run(litz, tmp_path, swelling_pair("*TEMPERATURE\n LOWER, 100\n UPPER, 100"))
    contact = results.contacts
    assert contact["gap"][-1] == pytest.approx(-2 * RADIUS * ALPHA * 100, rel=1e-9)
    assert contact["force"][-1] == pytest.approx(hertz_force(2 * RADIUS * ALPHA * 100), rel=1e-9)
    # trapezoids of 20 increments over a force with the power 3/2
    history = results.history
    assert abs(history["ETOTAL"][-1]) < 1e-3 * history["ALLCCE"][-1]
    assert history["ALLTW"][-1] > history["ALLSE"][-1]


def test_the_radius_swells_with_the_temperature_of_the_place(litz, tmp_path):
    """The contact is at 0.6 of the way from node 3 to 4 of the lower wire, and at 5/11 from 13 to 14 of the upper."""
    results, _ = run(litz, tmp_path, swelling_pair("*TEMPERATURE\n 3, 50\n 4, 100\n 13, 30"))
    rise = (0.4 * 50 + 0.6 * 100) + 30 * 6 / 11
    assert results.contacts["gap"][-1] == pytest.approx(-RADIUS * ALPHA * rise, rel=1e-6)


def test_swelling_does_not_jump_where_a_contact_slides_over_a_node(litz, tmp_path):
    """The lower wire has a peak of temperature at the node that the contact slides over, by 1 K in 20 um."""
    text = swelling_pair("*TEMPERATURE\n 3, 50\n 4, 100\n 5, 0\n UPPER, 20", extra="")
    text += "*STEP, INC=500\n*STATIC, DIRECT\n 0.02, 1\n*BOUNDARY\n UPPER, 1, 1, 0.008\n*END STEP\n"
    results, _ = run(litz, tmp_path, text)
    contacts = results.contacts.where(results.contacts["time"] > 1.001)
    x = contacts["point_1_x"]
    rise = np.interp(x, [-0.006, 0.004, 0.02], [50, 100, 0])
    assert x.min() < 0.004 < x.max()
    np.testing.assert_allclose(contacts["gap"], -RADIUS * ALPHA * (rise + 20), rtol=1e-3)
    assert len(set(contacts["id"].tolist())) == 1


def test_a_wire_swells_on_a_rigid_plane(litz, tmp_path):
    """Force of a clamped wire on a plane that it just touches: a penalty of 1e10 N/m^2 over the length."""
    text = wire(supports="ALL, 1, 6", temperature="ALL, 120")
    text = text.replace(
        "*INITIAL",
        "*SURFACE INTERACTION, NAME=T\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n 1e7, 1e10\n"
        "*RIGID SURFACE, NAME=FLOOR, TYPE=PLANE\n 0, 0, -1e-3, 0, 0, 1\n*CONTACT PAIR, INTERACTION=T\n WIRE, FLOOR\n*INITIAL",
    )
    results, _ = run(litz, tmp_path, text)
    gap = -RADIUS * ALPHA * 100
    inner = results.surface_contacts["element"] == 4
    np.testing.assert_allclose(results.surface_contacts["gap"][inner][-1], gap, rtol=1e-9)
    np.testing.assert_allclose(results.surface_contacts["force"][inner][-1], -gap * 1e10 * LENGTH / 8, rtol=1e-9)


#: All of a wire is warmed by 100 K, in one step over temperatures that are given, and in one that solves for them
WARMED = {
    "given": {"static": "1, 1", "temperature": "ALL, 120"},
    "in steps": {"static": "0.1, 1, 1e-4, 0.1", "temperature": "ALL, 120"},
    "solved for": {"static": "0.25, 1, 1e-4, 0.25", "temperature": "ALL, 11, 11, 120"},
}


#: A plane and a drum of 10 mm below a wire
BODIES = {"plane": "TYPE=PLANE\n 0, 0, {top!r}, 0, 0, 1", "drum": "TYPE=CYLINDER\n 0.05, 0, {centre!r}, 0, 1, 0, 0.01"}


@pytest.mark.parametrize("body", BODIES)
def test_swelling_presses_a_wire_on_a_surface_as_a_motion_does(litz, tmp_path, body):
    """Laws take the reference radius, whatever the increments; gaps see the one that has swollen."""

    def force(raised, **options):
        top = -RADIUS + raised
        contact = (
            "*SURFACE INTERACTION, NAME=T\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
            f"*RIGID SURFACE, NAME=BODY, {BODIES[body].format(top=top, centre=top - 0.01)}\n"
            "*CONTACT PAIR, INTERACTION=T\n WIRE, BODY\n"
        )
        text = wire(supports="ALL, 1, 6", conductivity="*CONDUCTIVITY\n 400", **options)
        if "11, 11" in options["temperature"]:
            text = text.replace("*STATIC", "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE")
            text = text.replace("*TEMPERATURE", "*BOUNDARY")
        results, _ = run(litz, tmp_path, text.replace("*INITIAL", f"{contact}*INITIAL"))
        return results.surface_contacts_at(-1)["force"].sum()

    expected = force(RADIUS * ALPHA * 100, temperature="ALL, 20")
    for name, options in WARMED.items():
        assert force(0.0, **options) == pytest.approx(expected, rel=1e-7), name


@pytest.mark.slow
def test_a_heated_run_goes_on_bit_for_bit(litz, tmp_path):
    text = wire(
        bow=2e-5,
        supports="9, ENCASTRE",
        elastic="120e9, 0.34, 0\n100e9, 0.3, 100",
        static="0.2, 1, 1e-5, 0.2",
        extra="*RESTART, WRITE",
    )
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_temperatures_that_nothing_depends_on_are_a_remark(litz, tmp_path):
    text = wire().replace(f"*EXPANSION\n{ALPHA}\n", "")
    _, messages = run(litz, tmp_path, text)
    assert "no material of the model depends on temperature" in messages
    assert "depends on temperature" not in run(litz, tmp_path, wire())[1]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"elastic": "120e9, 0.34, 20\n100e9, 0.34, 20"}, "the temperatures of *ELASTIC must ascend; 20 follows 20"),
        ({"elastic": "120e9, 0.34\n100e9, 0.34, 20"}, "a temperature is missing: every line of a table has one"),
        ({"alpha": "17e-6, 30\n18e-6, 10"}, "the temperatures of *EXPANSION must ascend"),
        ({"alpha": "17e-6\n*EXPANSION\n17e-6"}, "the material COPPER has two *EXPANSION"),
        ({"zero": ", TYPE=ORTHO"}, "give the coefficient along the wire"),
        ({"elastic": "120e9, 0.34, 20, 1"}, "material data depend on temperature alone"),
    ],
)
def test_tables_that_are_wrong_are_errors(litz, tmp_path, options, message):
    deck = tmp_path / "bad.inp"
    deck.write_text(wire(**options))
    done = litz("check", deck)
    assert done.returncode == 1
    assert message in " ".join(done.stderr.split())

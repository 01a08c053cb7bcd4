"""Laws of contacts with the elasticity and the resistivity of the temperatures of their places."""

import numpy as np
import pytest

from decks import crossed
from line_wires import COPPER, pressed, spot
from litz import kernels
from test_restart import assert_goes_on_from_everywhere
from test_strips_of_one_wire import OVERLAP, VOLTS, parallel
from test_thermal_expansion import ALPHA, RADIUS, swelling_pair, wire

#: Lines of *ELASTIC and *ELECTRICAL CONDUCTIVITY; what they say at a temperature between 0 and 100
ELASTIC, CONDUCTIVITY = " 120e9, 0.34, 0\n 60e9, 0.4, 100\n", " 5e7, 0\n 2e7, 100\n"


def young(t):
    return 120e9 - 0.6e9 * t


def poisson(t):
    return 0.34 + 0.0006 * t


def resistivity(t):
    return 2e-8 + 3e-10 * t


def tabulated(text):
    """With these tables in all materials in place of constants."""
    parts = text.split("*ELASTIC\n")
    text = parts[0] + "".join(f"*ELASTIC\n{ELASTIC}{part.split(chr(10), 1)[1]}" for part in parts[1:])
    parts = text.split("*ELECTRICAL CONDUCTIVITY\n")
    return parts[0] + "".join(
        f"*ELECTRICAL CONDUCTIVITY\n{CONDUCTIVITY}{part.split(chr(10), 1)[1]}" for part in parts[1:]
    )


def constant(text, t):
    """With the constants of these tables at one temperature."""
    with_tables = tabulated(text)
    return with_tables.replace(ELASTIC, f" {young(t):.17g}, {poisson(t):.17g}\n").replace(
        CONDUCTIVITY, f" {1 / resistivity(t):.17g}\n"
    )


def solved(outcome):
    process, results = outcome
    assert process.returncode == 0, process.stderr
    return results


def test_a_crossing_has_the_law_of_the_temperatures_of_its_places(run):
    """0.6 of the way from node 3 to 4 of the lower wire, and 5/11 from 13 to 14 of the upper one."""
    lower, upper = 0.4 * 30 + 0.6 * 80, 90 * 5 / 11 + 20 * 6 / 11
    text = swelling_pair("*TEMPERATURE\n 3, 30\n 4, 80\n 13, 20\n 14, 90\n*BOUNDARY\n 1, 9, 9, 1e-3\n 11, 9, 9, 0")
    contact = solved(run(tabulated(text))).contacts
    t = [lower, upper]
    assert [contact["temperature_1"][-1], contact["temperature_2"][-1]] == pytest.approx(t, rel=1e-12)
    assert contact["temperature_max"][-1] == pytest.approx(max(t), rel=1e-12)
    overlap = RADIUS * ALPHA * sum(t)
    spots = {
        "radius": [RADIUS] * 2, "young": [young(v) for v in t], "poisson": [poisson(v) for v in t],
        "resistivity": [resistivity(v) for v in t], "angle": np.pi / 2,
    }  # fmt: skip
    assert contact["gap"][-1] == pytest.approx(-overlap, rel=1e-6)
    assert contact["force"][-1] == pytest.approx(
        (overlap / kernels.contact_spot(1.0, **spots).approach) ** 1.5, rel=1e-5
    )
    expected = kernels.contact_spot(contact["force"][-1], **spots).conductance
    assert 1 / contact["resistance"][-1] == pytest.approx(expected, rel=1e-6)


SHAPES = {
    "crossing": lambda: crossed(push="-2e-6", extra="*TEMPERATURE\n LOWER, 70\n UPPER, 70"),
    "line": lambda: pressed(1e-6, law="*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n" + spot("HERTZ"), cards=(
        "*BOUNDARY\n LOWER, 9, 9, 1e-3\n UPPER, 9, 9, 0\n*TEMPERATURE\n LOWER, 70\n UPPER, 70\n",)),
    "lens": lambda: pressed(1e-6, degrees=3, law="*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n" + spot("HERTZ"), cards=(
        "*BOUNDARY\n LOWER, 9, 9, 1e-3\n UPPER, 9, 9, 0\n*TEMPERATURE\n LOWER, 70\n UPPER, 70\n",)),
    "strips": lambda: parallel([(0, 0), (0, 2 * COPPER.radius - OVERLAP), (0, 4 * COPPER.radius - 2 * OVERLAP)],
        [COPPER.radius] * 3, [(0, 1), (1, 2)], {0: VOLTS, 2: 0.0}).replace(
        "*END STEP", "*TEMPERATURE\n W0, 70\n W1, 70\n W2, 70\n*END STEP"),
}  # fmt: skip


@pytest.mark.parametrize("shape", SHAPES)
def test_wires_at_one_temperature_touch_as_with_the_constants_of_it(run, shape):
    """The iteration ends at a residual of 1e-9 of the largest force or so; contacts are the same."""
    text = SHAPES[shape]()
    found, expected = solved(run(tabulated(text))).contacts, solved(run(constant(text, 70))).contacts
    assert len(found["force"]) == len(expected["force"])
    for name in ("force", "resistance", "current", "semi_minor"):
        np.testing.assert_allclose(found[name], expected[name], rtol=1e-7, err_msg=name)


def on_a_floor(elastic):
    """A wire with all nodes held, which swells on the plane that it just touches; both ends are on it, too."""
    text = wire(
        supports="ALL, 1, 6", temperature="ALL, 90", elastic=elastic.strip(), static="0.05, 1, 1e-4, 0.05",
    )  # fmt: skip
    return text.replace(
        "*INITIAL",
        "*SURFACE INTERACTION, NAME=F\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n*RIGID SURFACE, NAME=FLOOR, "
        "TYPE=PLANE\n 0, 0, -1e-3, 0, 0, 1\n*CONTACT PAIR, INTERACTION=F\n WIRE, FLOOR\n*INITIAL",
    )


def test_wires_on_rigid_surfaces_have_the_elasticity_of_their_temperature(run):
    found = solved(run(on_a_floor(ELASTIC))).surface_contacts
    expected = solved(run(on_a_floor(f"{young(90):.17g}, {poisson(90):.17g}"), name="constant")).surface_contacts
    last = found["time"] == found["time"].max()
    assert last.sum() == 8
    np.testing.assert_allclose(found["force"][last], expected["force"][last], rtol=1e-12)


@pytest.mark.parametrize("shape", ["plane", "drum"])
def test_a_wire_that_swells_on_a_rigid_surface_is_one_that_is_pressed_as_much(run, shape):
    """Laws have the radius of the reference: only the overlap grows. On a drum the lens grows with it, which laws follow to
    1e-4."""
    text = on_a_floor("1.2e11, 0.34")
    if shape == "drum":
        text = text.replace("TYPE=PLANE\n 0, 0, -1e-3, 0, 0, 1", "TYPE=CYLINDER\n 0.05, 0, -11e-3, 0, 1, 0, 10e-3")
    warm = solved(run(text)).surface_contacts
    overlap = RADIUS * ALPHA * (90 - 20)
    assert "*TEMPERATURE\nALL, 90" in text
    pressed = solved(
        run(text.replace("*TEMPERATURE\nALL, 90", f"*BOUNDARY\nALL, 3, 3, {-overlap:.17g}"), name="pressed")
    )
    forces = [found["force"][found["time"] == found["time"].max()].sum() for found in (warm, pressed.surface_contacts)]
    assert forces[0] > 1
    assert forces[0] == pytest.approx(forces[1], rel=1e-10 if shape == "plane" else 1e-4)


@pytest.mark.parametrize("what", ["crossing", "floor"])
def test_energy_balances_as_contacts_swell_and_soften(run, what):
    """Where no wire moves, all energy of a contact is the work of the temperature, which is a mean of both ends of an
    increment: what is left is at least of second order. On the floor nu is constant: what it does to
    the far field of a line is not in this work."""
    left = []
    for increment in (0.1, 0.025):
        if what == "crossing":
            text = tabulated(swelling_pair("*TEMPERATURE\n LOWER, 90\n UPPER, 90"))
        else:
            text = on_a_floor(ELASTIC.replace("0.4", "0.34"))
        history = solved(run(text.replace("0.05, 1, 1e-4, 0.05", f"{increment}, 1, 1e-4, {increment}"))).history
        left.append(history["ETOTAL"][-1] / history["ALLCCE"][-1])
    assert left[0] / left[1] > 14
    assert abs(left[1]) < 5e-3


def test_a_run_with_contacts_that_soften_goes_on_bit_for_bit(litz, tmp_path):
    text = crossed(
        push="-1e-4", static="0.25, 1, 1e-4, 0.25",
        extra="*TEMPERATURE\n LOWER, 90\n 13, 30\n 14, 80\n*ENERGY PRINT\n*RESTART, WRITE",
    )  # fmt: skip
    assert_goes_on_from_everywhere(litz, tmp_path, tabulated(text))

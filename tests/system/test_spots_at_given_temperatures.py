"""The hottest place of a spot in steps that do not solve for temperatures: by its voltage, as Kohlrausch and Holm have it."""

import numpy as np
import pytest

from crossing_conductors import LAMBDA, METAL, ROOM, crossing
from run_of_deck import refusal_of_deck, run_of_deck
from same_results import keeping
from test_restart import assert_goes_on_from_everywhere

LORENZ = 2.44e-8
#: Holm's voltages of copper by its temperatures: sqrt(4 L (T^2 - T0^2))
SOFTENS, MELTS = 463.0, 1358.0
STATIC = "*STATIC"


def deck(volts, *, law=METAL, procedure=STATIC, later="", without=""):
    """Two wires between whose far ends there is a voltage."""
    text = crossing(2, "5.88e7", "1, 1", load=f"1001, 9, 9, {volts}\n", law=law)
    text = text.replace("*COUPLED THERMAL-ELECTRICAL", procedure)
    if procedure == STATIC:
        text = text.replace(f"ENDS, 11, 11, {ROOM}\n", "")
    assert without in text
    return text.replace(without, "") + later


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


def hottest(voltage, beside):
    return np.sqrt(beside**2 + voltage**2 / (4 * LORENZ))


@pytest.mark.parametrize("volts", [0.05, 0.2, 1.0])
def test_a_static_step_has_that_of_the_voltage(run, volts):
    contacts = run(volts).contacts_at(-1)
    assert contacts["temperature_1"][0] == ROOM
    assert contacts["temperature_max"][0] == pytest.approx(hottest(contacts["voltage_gap"][0], ROOM), rel=1e-9)


@pytest.mark.parametrize("law", ["*GAP CONDUCTANCE, LAW=CONDUCTIVITY", ""])
def test_constant_conductivities_have_a_parabola(run, law):
    """T + V^2/(8 lambda rho), also where nothing is said of heat."""
    contacts = run(0.2, law=law).contacts_at(-1)
    rise = contacts["voltage_gap"][0] ** 2 * 5.88e7 / (8 * LAMBDA)
    assert contacts["temperature_max"][0] == pytest.approx(ROOM + rise, rel=1e-9)


def test_without_a_current_it_is_the_temperature_beside_it(run):
    assert run(0.0).contacts_at(-1)["temperature_max"][0] == ROOM


def test_a_step_after_one_with_heat_keeps_it(run):
    """The crossing is at nodes, and the current flows on."""
    results = run(0.2, procedure="*COUPLED THERMAL-ELECTRICAL, STEADY STATE", later="*STEP\n*STATIC\n1, 1\n*END STEP\n")
    coupled, static = (results.contacts_at(increment)["temperature_max"][0] for increment in (-2, -1))
    assert coupled > ROOM + 20
    assert static == pytest.approx(coupled, rel=1e-9)


def test_metal_that_softens_is_a_warning(run):
    law = f"{METAL}, TSOFT={SOFTENS}, TMELT={MELTS}"
    cool = run(0.1, law=law)
    assert not cool.warnings
    results = run(0.5, law=law)
    (warning,) = results.warnings
    assert warning.kind == "hot_spot"
    assert warning.worst == pytest.approx(hottest(results.contacts_at(-1)["voltage_gap"][0], ROOM), rel=1e-9)
    assert SOFTENS < warning.worst < MELTS


def test_it_is_told_where_a_model_has_no_temperatures(run):
    """Holm's voltage gives the hottest place above the wires, of which nothing is known."""
    results = run(0.5, law=f"{METAL}, TSOFT={SOFTENS}", without=f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, {ROOM}\n")
    (warning,) = results.warnings
    assert warning.kind == "unwatched_spots"
    assert "the model has no temperatures" in warning.message
    assert "*INITIAL CONDITIONS, TYPE=TEMPERATURE" in warning.message


def test_it_is_told_where_wires_do_not_conduct_heat(run):
    """No spot without their conductivity; that of the wires beside it is known."""
    results = run(0.5, law=f"{METAL}, TMELT={MELTS}", without=f"*CONDUCTIVITY\n{LAMBDA}\n")
    (warning,) = (warning for warning in results.warnings if warning.kind == "unwatched_spots")
    assert "*CONDUCTIVITY: elements of" in warning.message


def test_metal_that_melts_ends_the_run(refused):
    assert f"and melt (TMELT={MELTS:g} of *GAP CONDUCTANCE" in refused(2, 2.0, law=f"{METAL}, TMELT={MELTS}")


def test_a_run_goes_on_from_every_increment(litz, tmp_path):
    later = "*STEP\n*STATIC\n0.5, 1\n*BOUNDARY\n1001, 9, 9, 0.3\n*END STEP\n"
    text = deck(0.2, procedure="*COUPLED THERMAL-ELECTRICAL, STEADY STATE", later=later)
    assert_goes_on_from_everywhere(litz, tmp_path, keeping(text))

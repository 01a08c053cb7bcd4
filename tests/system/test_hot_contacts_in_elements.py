"""Contacts within elements take resistances at the temperatures of their wires there, whatever the mesh."""

import numpy as np
import pytest
from scipy.optimize import brentq

from crossing_conductors import AMPERES, HALF, LAMBDA, METAL, RADIUS, ROOM, crossing
from run_of_deck import refusal_of_deck, run_of_deck

AREA = np.pi * RADIUS**2
RHO, ALPHA = 1.7e-8, 4e-3
#: rho is linear in the temperature, five times as much at 1300 K
SIGMA = f"{1 / RHO:.17g}, {ROOM}\n{1 / (5 * RHO):.17g}, 1300"


def deck(elements, *, amperes=AMPERES, law=METAL, spot="HERTZ", sigma=SIGMA):
    """Both wires cross in the middle of their middle elements; in five steady increments."""
    load = f"*CECURRENT\n1001, , {amperes}\n"
    return crossing(elements, sigma, "0.2, 1, 0.01", procedure=", STEADY STATE", law=law, spot=spot, load=load)


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


def cold_resistance(run):
    return run(1, amperes=1e-3).contacts_at(-1)["resistance"][0]


def temperature_of_the_wires(cold):
    """At the contact, both alike: `theta'' = -k^2 theta` of `rho(T) = rho0 alpha theta` on the half with a current, a straight
    line on the other; half of the heat of the spot enters either wire."""
    k = AMPERES / AREA * np.sqrt(RHO * ALPHA / LAMBDA)

    def left(theta):
        slope = (theta * np.cos(k * HALF) - 1 / ALPHA) * k / np.sin(k * HALF)
        return AMPERES**2 * cold * ALPHA * theta / 2 - LAMBDA * AREA * (slope + (theta - 1 / ALPHA) / HALF)

    return ROOM + brentq(left, 0, 1e4) - 1 / ALPHA


def test_the_resistance_is_that_of_the_closed_form_to_second_order(run):
    cold = cold_resistance(run)
    exact = cold * (1 + ALPHA * (temperature_of_the_wires(cold) - ROOM))
    assert exact > 1.2 * cold
    errors = [abs(run(n).contacts_at(-1)["resistance"][0] / exact - 1) for n in (1, 3, 9, 27)]
    # one element makes its heat at its mean temperature
    assert errors[0] < 0.015
    # a ninth from one to the next, as soon as elements are short
    assert errors[1] / errors[2] > 7.5
    assert errors[2] / errors[3] > 8.5
    assert errors[3] < 1e-4


@pytest.mark.parametrize(
    "law",
    ["*GAP CONDUCTANCE, LAW=METAL", "*GAP CONDUCTANCE, LAW=CONDUCTIVITY", "*GAP CONDUCTANCE, LAW=CONSTANT\n2", ""],
)
@pytest.mark.parametrize("elements", [1, 3])
def test_the_ledger_has_the_resistance_of_its_temperatures(run, law, elements):
    cold = cold_resistance(run)
    row = {name: values[0] for name, values in run(elements, law=law).contacts_at(-1).items()}
    mean = (row["temperature_1"] + row["temperature_2"]) / 2
    assert row["resistance"] == pytest.approx(cold * (1 + ALPHA * (mean - ROOM)), rel=1e-9)
    assert row["voltage_gap"] == pytest.approx(row["current"] * row["resistance"], rel=1e-12)
    assert row["heat_1"] + row["heat_2"] == pytest.approx(row["current"] * row["voltage_gap"], rel=1e-10)


def test_a_resistance_that_is_given_stays(run):
    results = run(1, spot="CONSTANT\n7e-4")
    assert results.contacts_at(-1)["resistance"][0] == pytest.approx(7e-4, rel=1e-12)


def up_to(temperature):
    """A table of the resistivity that ends there."""
    rho = RHO * (1 + ALPHA * (temperature - ROOM))
    return f"{1 / RHO:.17g}, {ROOM}\n{1 / rho:.17g}, {temperature}"


@pytest.mark.parametrize(
    ("elements", "words"),
    [(1, "where it touches element"), (2, "the temperature in element"), (31, "the temperature in")],
)
def test_a_contact_beyond_the_table_of_its_resistivity_ends_the_run(refused, elements, words):
    """The wires would be at 367 K where they touch; means of elements of 10 mm would be below 340 K."""
    message = refused(2, elements, sigma=up_to(345))
    assert words in message
    assert "where the table of *ELECTRICAL CONDUCTIVITY ends at 345" in message


def test_a_table_beyond_the_hottest_wire_is_enough(run):
    assert run(3, sigma=up_to(370)).contacts_at(-1)["temperature_max"][0] > 420

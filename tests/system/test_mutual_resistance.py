"""Spots near each other on one wire: the current of each raises the potential at the other, by as much as the modes of
a cylinder say (`MUTUAL RESISTANCE=YES`)."""

import re

import numpy as np
import pytest
from scipy.special import jnp_zeros
from verification.cases import two_spots
from verification.cases.two_spots import THICK, VOLTAGE

#: Radius of the spots [m]
SPOT = 2e-5
#: rho/(4 a) on either side
ALONE = THICK.resistivity / (2 * SPOT)


def modes(angle, along):
    """Potential of a point source on an infinite cylinder above the mean of the section, over rho I/r."""
    total = 0.0
    for m in range(100):
        zeros = jnp_zeros(m, 100)
        weight = (1 if m == 0 else 2) / (2 * np.pi * zeros * (1 - (m / zeros) ** 2))
        total += np.cos(m * angle) * np.sum(weight * np.exp(-zeros * along))
    return total


def deck(angle, along, options="VOLTAGE=LINEAR, MUTUAL RESISTANCE=YES"):
    """Two thin wires across a thick one at a distance along it, in its radii, and an angle round it."""
    return two_spots.deck(SPOT, along * THICK.radius, angle, options, stations=3)


def contacts(run, text):
    process, results = run(text)
    assert process.returncode == 0, process.stderr
    return results, results.contacts_at(-1)


@pytest.mark.parametrize(
    ("angle", "along"),
    [(0, 0.1), (0, 0.25), (0, 1), (0.5, 0.1), (0.5, 0.5), (1.5, 0.3), (3.1, 0.1), (3.1, 1), (2, 2.5)],
)
def test_each_of_two_spots_sees_the_potential_of_the_other(run, angle, along):
    _, ledger = contacts(run, deck(angle, along))
    expected = VOLTAGE / (ALONE + modes(angle, along) * THICK.resistivity / THICK.radius)
    # 0.02 rho/r of the potential, 0.008 in the mean
    np.testing.assert_allclose(np.abs(ledger["current"]), expected, rtol=0.02 * 2 * SPOT / THICK.radius)


def test_what_flows_is_heat(run):
    """The power of the electrodes is the heat of the contacts, of both spots together with what they add to each other."""
    _, ledger = contacts(run, deck(0, 0.1))
    assert ledger["joule_heat"].sum() == pytest.approx(VOLTAGE * np.abs(ledger["current"]).sum(), rel=1e-12)


def test_far_spots_and_spots_without_the_option_are_alone(run):
    for text in (deck(0, 3.01), deck(0, 0.1, "VOLTAGE=LINEAR")):
        _, ledger = contacts(run, text)
        np.testing.assert_allclose(np.abs(ledger["current"]), VOLTAGE / ALONE, rtol=1e-9)


def test_contacts_within_elements_feel_each_other_beside_the_voltage_that_the_element_adds(run):
    """With VOLTAGE=CORRECTED the wires between the spots are resistances besides; the mutual resistance adds to them."""
    text, alone = (deck(0, 0.25, f"MUTUAL RESISTANCE={option}") for option in ("YES", "NO"))
    (_, with_it), (_, without) = contacts(run, text), contacts(run, alone)
    added = VOLTAGE / np.abs(with_it["current"]) - VOLTAGE / np.abs(without["current"])
    np.testing.assert_allclose(added, modes(0, 0.25) * THICK.resistivity / THICK.radius, rtol=0.04)


@pytest.mark.parametrize("resistance", [1e-9, 1e-7, 1e-5])
def test_no_resistance_is_too_small(run, resistance):
    """Contacts that are given less resistance than a spot can have, at unequal voltages: each current follows its own."""
    text = re.sub(r"LAW=PLASTIC(.*)\n .*", rf"LAW=CONSTANT\1\n {resistance}", deck(0, 0.1))
    results, ledger = contacts(run, text.replace("THIN2, 9, 9, 0.", f"THIN2, 9, 9, {VOLTAGE / 2}"))
    current = np.abs(ledger["current"])
    assert current[0] > current[1] > 0
    power = VOLTAGE * current[0] + VOLTAGE / 2 * current[1]
    assert ledger["joule_heat"].sum() == pytest.approx(power, rel=1e-9)
    assert results.finished

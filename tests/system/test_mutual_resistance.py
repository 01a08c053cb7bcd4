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


def deck(angle, along, options="VOLTAGE=LINEAR, MUTUAL RESISTANCE=YES", **changes):
    """Two thin wires across a thick one at a distance along it, in its radii, and an angle round it."""
    return two_spots.deck(SPOT, along * THICK.radius, angle, options, stations=3, **changes)


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


@pytest.mark.slow
def test_a_free_end_mirrors_the_spots(run):
    """Two spots near the end of the thick wire, whose round end counts as a flat one 2/3 r beyond its node: what is added
    there are both images, its own, too."""
    along, depth = 0.25, 0.1
    near, far = (
        contacts(run, deck(0, along, thick=np.linspace(-0.01, end * THICK.radius, 5)))[1]["current"]
        for end in (along / 2 + depth, 10)
    )
    added = VOLTAGE * (1 / np.abs(near) - 1 / np.abs(far)) * THICK.radius / THICK.resistivity
    below = np.array([along + depth, depth]) + 2 / 3
    expected = np.array([sum(modes(0, a + b) for b in below) for a in below])
    # the fit of one image is within 0.005 there
    np.testing.assert_allclose(added, expected, atol=0.01)
    assert expected.max() > 0.02


def bent(text, radius):
    """The wire along x as an arc about y, with all that lies on it, and moved as the arc has turned there."""

    def place(match):
        x, y, z = (float(part) for part in match.group(2).split(","))
        turn, out = x / radius, radius + z
        return f"{match.group(1)}, {out * np.sin(turn):.17g}, {y:.17g}, {out * np.cos(turn) - radius:.17g}"

    turns = {f"THIN{k}": float(re.search(rf"^ {k}01, ([^,]*)", text, re.M).group(1)) / radius for k in (1, 2)}
    text = re.sub(r"^( \d+), ([^,\n]+, [^,\n]+, [^,\n]+)$", place, text, flags=re.M)
    for name, turn in turns.items():
        down = -1e-6 * np.array([np.sin(turn), np.cos(turn)])
        text = text.replace(f" {name}, 3, 3, -1e-06", f" {name}, 1, 1, {down[0]:.17g}\n {name}, 3, 3, {down[1]:.17g}")
    return text


def test_in_a_bend_directions_round_the_wire_turn_with_its_axis(run):
    """On the outside of an arc of three radii: as on a straight wire at the same distance along the axis."""
    text = deck(0, 0.5, thick=np.linspace(-4e-3, 4e-3, 33))
    straight, arc = (contacts(run, each)[1]["current"] for each in (text, bent(text, 3 * THICK.radius)))
    # of what the other spot adds, 0.4 rho/r of 25; angles between fixed directions would change it by 5 %
    np.testing.assert_allclose(arc, straight, rtol=1e-4)


def test_what_spots_add_to_each_other_heats_the_wire_that_they_share(run):
    """Equal metals whose sections have one temperature: each half of a spot makes half of its own heat, the thick wire the rest.
    There the heat of the one spot is to the temperature at the other as the current is to the potential, and what passes for it
    to the thin wire is the same part of it, as heat meets lambda rho times less in the spot."""
    text = deck(0, 0.1)
    text = text.replace("*ELECTRICAL CONDUCTIVITY", "*CONDUCTIVITY\n 400.\n*ELECTRICAL CONDUCTIVITY")
    heated = "*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n*BOUNDARY\n"
    heated += "".join(f" {name}, 11, 11, 293.\n" for name in ("THICK", "THIN1", "THIN2"))
    _, ledger = contacts(run, text + heated + "*END STEP\n")
    current = np.abs(ledger["current"])
    added = VOLTAGE * current - ALONE * current**2
    assert (added > 0.04 * ALONE * current**2).all()
    own = ALONE * current**2
    into_thick = (own / 2 + added) / (1 + added / own)
    np.testing.assert_allclose(ledger["heat_1"], into_thick, rtol=1e-6)
    np.testing.assert_allclose(ledger["heat_2"], own + added - into_thick, rtol=1e-6)


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

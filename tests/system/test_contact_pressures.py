"""Pressures of elastic contacts in the results, and those at which metals begin to yield beside them."""

import numpy as np
import pytest
from verification.references import hertz

from line_wires import COPPER, HERTZ, linear, lowered, pressed, spot
from litz.reports.report_tables import worst_contacts
from litz.results.contact_pressures import onsets

YIELDING = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD=50e6\n"
NO_FIELD = "*BOUNDARY\n LOWER, 9, 9, 0.\n UPPER, 9, 9, 0.\n"
MODULUS = float(hertz.effective_modulus((COPPER.young,) * 2, (COPPER.poisson,) * 2))


def contacts_of(outcome):
    process, results = outcome
    assert process.returncode == 0, process.stderr
    return results.contacts_at(-1)


def of_crossing(force, degrees):
    """Largest pressure under a force, with 30 digits."""
    angle, radii = np.radians(degrees), (COPPER.radius,) * 2
    return hertz.crossed_wires(force, angle, radius=radii, modulus=MODULUS, resistivity=(1, 1)).peak_pressure


@pytest.mark.parametrize("degrees", [90, 45, 20])
def test_a_crossing_has_the_largest_pressure_of_its_ellipse(run, degrees):
    contacts = contacts_of(run(pressed(1e-6, degrees=degrees, cards=(NO_FIELD,))))
    assert contacts.n_rows == 1
    assert contacts["pressure"][0] == pytest.approx(of_crossing(contacts["force"][0], degrees), rel=1e-9)


def test_the_pressure_is_that_of_the_force_whatever_law_gives_it_and_the_spot(run):
    laws = linear(1e6) + spot("PAPER")
    contacts = contacts_of(run(pressed(1e-6, degrees=45, law=laws, cards=(NO_FIELD,))))
    assert contacts["force"][0] == pytest.approx(1.0, rel=1e-6)
    assert contacts["pressure"][0] == pytest.approx(of_crossing(contacts["force"][0], 45), rel=1e-9)


def test_a_place_of_a_line_has_that_of_its_strip(run):
    contacts = contacts_of(run(pressed(1e-6, cards=(NO_FIELD,))))
    per_length = contacts["force"] / contacts["length"]
    # 2 f/(pi b) with b^2 = 4 f R/(pi E*), R = r/2
    width = np.sqrt(4 * per_length * COPPER.radius / 2 / (np.pi * MODULUS))
    assert contacts["pressure"] == pytest.approx(2 * per_length / (np.pi * width), rel=1e-9)


def test_the_pressure_does_not_jump_where_a_crossing_becomes_a_line(run):
    # lenses of 0.5 to 1.2 radii, whose far field comes to be the section; the largest one of all points stands for the contact
    largest = [
        contacts_of(run(pressed(1e-6, degrees=degrees, cards=(NO_FIELD,))))["pressure"].max()
        for degrees in (8, 6, 5, 4, 3)
    ]
    assert np.abs(np.diff(np.log(largest))).max() < 0.02


def test_summary_and_report_have_it_beside_what_metals_bear(run):
    _, results = run("*UNITS, SYSTEM=SI\n" + pressed(1e-6, degrees=45, cards=(NO_FIELD,)))
    pressure = results.contacts_at(-1)["pressure"][0]
    text = " ".join(results.summary().split())
    assert f"largest pressure {pressure:.5g} Pa in contact 1 at time 1 s (step 1, increment 1), if the wires" in text
    assert "soft to hard metal yields from (MPa): aluminium 50 to 210, copper 80 to 500" in text
    page = worst_contacts(results)
    assert "<th>pressure</th>" in page
    assert "copper 80 to 500" in page
    assert f"Largest pressure {pressure:.5g} Pa in contact 1 at time 1 s" in page


@pytest.mark.parametrize(("law", "whose"), [(HERTZ, "if the wires stay elastic"), (YIELDING, "of wires that yield")])
def test_the_largest_pressure_is_that_of_the_whole_run(run, law, whose):
    # pressed in two increments, relieved in a third, apart in the last step
    half_way = lowered(0.5e-6, static="1., 1.")
    deck = pressed(1e-6, degrees=45, law=law, static="0.5, 1.", cards=(NO_FIELD,)) + half_way + lowered(-1e-6)
    _, results = run("*UNITS, SYSTEM=SI\n" + deck)
    pressure = results.contacts["pressure"]
    assert pressure.argmax() == 1
    assert results.contacts_at(-1).n_rows == 0
    expected = f"{pressure.max():.5g} Pa in contact 1 at time 1 s (step 1, increment 2), {whose}"
    assert f"over all increments: largest pressure {expected}" in " ".join(results.summary().split())
    assert f"Largest pressure {expected}" in worst_contacts(results)


def test_the_report_has_the_largest_pressure_of_wires_that_touch_along_lines(run):
    _, results = run("*UNITS, SYSTEM=SI\n" + pressed(1e-6, cards=(NO_FIELD,)))
    assert f"Largest pressure {results.contacts['pressure'].max():.5g} Pa" in worst_contacts(results)


def test_the_pressures_at_the_onset_are_those_of_jackson_and_green():
    # 1.295 exp(0.736 nu) Y, copper with nu = 0.34 and Y = 50, 300 MPa
    assert onsets()["copper"] == pytest.approx((83.16, 498.97), rel=1e-3)


def test_without_contact_there_is_no_such_line(run):
    _, results = run(pressed(-1e-6, degrees=45, cards=(NO_FIELD,)))
    assert "largest pressure" not in results.summary()

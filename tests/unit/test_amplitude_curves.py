"""Amplitudes of Abaqus that are closed curves over time become tables, within a thousandth of their coefficients."""

import numpy as np
import pytest

from litz.deck import Card, Deck
from litz.model.amplitude_curves import curve_as_table

STEPS = "*STEP\n*STATIC\n 0.1, 3.\n*END STEP\n*STEP\n*STATIC\n 0.1, 2.\n*END STEP\n"


def periodic(time):
    """Two terms from 0.25 on."""
    s = time - 0.25
    after = 0.5 + np.cos(4 * s) + 0.2 * np.sin(4 * s) - 0.1 * np.cos(8 * s) + 0.3 * np.sin(8 * s)
    return np.where(s >= 0, after, 0.5)


CURVES = {
    "PERIODIC": (" 2, 4., 0.25, 0.5\n 1., 0.2, -0.1, 0.3\n", periodic, 1.6),
    "MODULATED": (" 0.1, 2., 0., 7., 3.\n", lambda time: 0.1 + 2 * np.sin(7 * time) * np.sin(3 * time), 2.0),
    "DECAY": (" 0.1, 2., -1., 0.4\n", lambda time: 0.1 + 2 * np.exp(-(time + 1) / 0.4), 2.0),
}


@pytest.mark.parametrize("definition", CURVES)
@pytest.mark.parametrize(("time", "end"), [("", 3.0), (", TIME=TOTAL TIME", 5.0)])
def test_a_table_is_a_closed_curve_up_to_the_end_of_the_steps(definition, time, end):
    data, curve, size = CURVES[definition]
    card = Card.parse(f"*AMPLITUDE, NAME=A, DEFINITION={definition}{time}\n{data}")
    times, factors = np.reshape(curve_as_table(card, definition, list(Deck.parse(STEPS))), (-1, 2)).T
    assert (np.diff(times) > 0).all()
    assert times[-1] == end
    # at its points it is exact, between them within the error that conversions tell
    jump = np.isclose(times, 0.25, rtol=0, atol=1e-5)
    np.testing.assert_allclose(factors[~jump], curve(times[~jump]), rtol=1e-9, atol=1e-9)
    between = np.setdiff1d(np.linspace(0, end, 5000), np.linspace(0.2499, 0.2501, 3))
    np.testing.assert_allclose(np.interp(between, times, factors), curve(between), rtol=0, atol=1.001e-3 * size)


@pytest.mark.parametrize(
    ("definition", "data"),
    [("PERIODIC", " 1.5, 4., 0., 0.\n"), ("PERIODIC", " 1, 1e9, 0., 0.\n 1., 0.\n"), ("DECAY", " 0., 1., 0., 0.\n")],
)
def test_what_is_no_curve_or_has_too_many_points_is_left_as_it_is(definition, data):
    card = Card.parse(f"*AMPLITUDE, NAME=A, DEFINITION={definition}\n{data}")
    assert curve_as_table(card, definition, list(Deck.parse(STEPS))) == []


def test_a_curve_that_begins_after_the_end_is_constant():
    card = Card.parse("*AMPLITUDE, NAME=A, DEFINITION=DECAY\n 0.5, 2., 9., 1.\n")
    assert curve_as_table(card, "DECAY", list(Deck.parse(STEPS))) == [0.0, 0.5, 3.0, 0.5]

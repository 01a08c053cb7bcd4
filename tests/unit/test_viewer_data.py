"""Numbers of the viewer: JSON with few digits."""

import json

import numpy as np
import pytest

from litz.viewer.data import _column


def test_numbers_have_eight_digits():
    random = np.random.default_rng(0)
    values = random.choice([-1, 1], 2000) * random.uniform(1, 9.99, 2000) * 10.0 ** random.integers(-15, 22, 2000)
    column = _column(values, 8)
    assert column == [float(f"{value:.8g}") for value in values]


@pytest.mark.parametrize("value", [0.0, 5e-324, 1.7e308, -2.5e-200, 1e300])
def test_sizes_at_the_limits_of_numbers_are_kept(value):
    assert _column(np.array([value]), 8) == [pytest.approx(value, rel=1e-7, abs=0)]


def test_what_is_no_number_is_a_text_or_nothing():
    column = _column(np.array([1.0, np.inf, -np.inf, np.nan]), 8)
    assert column == [1.0, "\u221e", "-\u221e", None]
    json.dumps(column, allow_nan=False)


def test_whole_numbers_and_names_stay_what_they_are():
    assert _column(np.array([1, 123456789012]), 8) == [1, 123456789012]
    assert _column(np.array(["PLATE"]), 8) == ["PLATE"]

"""Numbers of the viewer: JSON with few digits."""

import json

import numpy as np
import pytest

from litz.viewer.data import PLAIN, SHORT, WebData, _column
from litz.viewer.page import fitting_viewer
from test_packed import read


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


class TestLessDetail:
    """Increments of many contacts in a page."""

    @pytest.fixture
    def data(self, results):
        return WebData(results)

    @pytest.fixture
    def full_and_short(self, data):
        last = len(data.increments) - 1
        return read(data.packed_increment(last)), read(data.packed_increment(last, SHORT))

    def test_colours_are_within_the_64th_part_of_the_largest(self, full_and_short):
        full, short = full_and_short
        assert short["fields"].keys() == full["fields"].keys()
        for name, values in full["fields"].items():
            error = np.abs(short["fields"][name] - values)
            assert (error <= 0.51 / 64 * np.abs(values).max(axis=0)).all()

    def test_wires_and_spots_are_where_they_are_seen(self, full_and_short, results):
        """A twentieth of the radius, and the 512th part of the largest displacement."""
        full, short = full_and_short
        allowed = 0.51 * (0.05 * results.radius.min() + np.abs(full["curves"]).max() / 512)
        assert np.abs(short["curves"] - full["curves"]).max() <= allowed
        for name in ("rest", "now"):
            assert np.abs(short["spots"][name] - full["spots"][name]).max() <= allowed

    def test_contacts_have_what_the_table_of_the_viewer_shows_in_three_digits(self, full_and_short, data):
        full, short = full_and_short
        assert list(short["contacts"]) == ["id", "element_1", "element_2", "gap", "force", "current"]
        for name in ("id", "element_1", "element_2"):
            assert short["contacts"][name].tolist() == full["contacts"][name].tolist()
        assert short["contacts"]["force"] == [float(f"{force:.3g}") for force in full["contacts"]["force"]]
        assert (
            read(data.packed_increment(len(data.increments) - 1, PLAIN))["contacts"].keys() == full["contacts"].keys()
        )


def test_where_full_detail_of_all_increments_has_no_room_less_detail_has_it(results):
    n = len(results.times)
    assert fitting_viewer(results, list(range(n)), 10**7)[1:] == (list(range(n)), False)
    data = WebData(results)
    size = len(data.packed_model()) + sum(len(data.packed_increment(k)) for k in range(n))
    assert fitting_viewer(results, list(range(n)), size - 1)[1:] == (list(range(n)), True)
    _, picked, reduced = fitting_viewer(results, list(range(n)), 1)
    assert picked == [n - 1]
    assert reduced


@pytest.mark.parametrize(("letters", "detail"), [(10, PLAIN), (5, SHORT)])
def test_of_an_increment_that_has_no_room_at_all_nothing_else_is_put_together(results, monkeypatch, letters, detail):
    """Which of many contacts have a size at least that is known."""
    n, n_contacts = len(results.times), results.contacts_at(-1).n_rows
    packed = WebData.packed_increment
    made = []

    def noted(self, place, detail=None):
        made.append((self.increments[place], detail))
        return packed(self, place, detail)

    monkeypatch.setattr(WebData, "packed_increment", noted)
    _, picked, reduced = fitting_viewer(results, list(range(n)), letters * n_contacts - 1)
    assert (picked, reduced) == ([n - 1], True)
    assert made == [(n - 1, detail)]

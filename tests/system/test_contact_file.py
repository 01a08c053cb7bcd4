"""Contacts that are written at every n-th increment, or not at all: what is not there is told in words, and is no zero."""

import json
import re

import h5py
import numpy as np
import pytest

import litz
from line_wires import HERTZ, pressed, spot
from litz import Results
from litz.results.history_table import history_table
from litz.viewer.data import WebData

VOLT = "*BOUNDARY\n LOWER, 9, 9, 1.\n UPPER, 9, 9, 0.\n*ELECTRODE PRINT\n LOWER, UPPER\n"
#: Five increments, and as many of a second step
SECOND = "*STEP\n*STATIC\n 0.2, 1., 1e-3, 0.2\n{}*END STEP\n"
NOT_WRITTEN = "contacts were not written at this increment (*CONTACT FILE)"


def deck(first="", second=""):
    """Two wires pressed together along a line, with a current, in two steps; cards of the steps."""
    return pressed(2e-6, law=HERTZ + spot("HERTZ"), cards=(VOLT, first), static="0.2, 1., 1e-3, 0.2") + SECOND.format(
        second
    )


@pytest.fixture(scope="module")
def runs(litz_program, tmp_path_factory):
    """Results of decks with cards of the steps, run once each."""
    folder, known = tmp_path_factory.mktemp("contact_file"), {}

    def results_of(first="", second=""):
        if (first, second) not in known:
            path = folder / f"run{len(known)}.inp"
            path.write_text(deck(first, second))
            known[first, second] = litz.run(path, output_directory=folder, quiet=True)
        return known[first, second]

    return results_of


def increments_of(table):
    """Step and increment of the rows of a table."""
    return sorted({(int(s), int(i)) for s, i in zip(table["step"], table["increment"], strict=True)})


@pytest.mark.parametrize(
    ("first", "second", "written"),
    [
        ("", "", [(1, i) for i in range(1, 6)] + [(2, i) for i in range(1, 6)]),
        # the last of a step always, and later steps as the one before
        ("*CONTACT FILE, FREQUENCY=2\n CDIS\n", "", [(1, 2), (1, 4), (1, 5), (2, 2), (2, 4), (2, 5)]),
        ("*CONTACT FILE, FREQUENCY=99\n", "", [(1, 5), (2, 5)]),
        ("*CONTACT FILE, FREQUENCY=0\n", "*CONTACT FILE, FREQUENCY=3\n", [(2, 3), (2, 5)]),
        ("*CONTACT FILE, FREQUENCY=0\n", "", []),
        # of increments without fields, too
        ("*NODE FILE, FREQUENCY=2\n*CONTACT FILE, FREQUENCY=3\n", "", [(1, 3), (1, 5), (2, 3), (2, 5)]),
    ],
)
def test_rows_of_those_increments_are_in_the_ledger(runs, first, second, written):
    results, everything = runs(first, second), runs()
    assert increments_of(results.contacts) == written
    has = results.has_contacts()
    numbers = list(zip(results.steps.tolist(), results.increments.tolist(), strict=True))
    assert [number for number, one in zip(numbers, has, strict=True) if one and number[0]] == [
        number for number in numbers if number in written
    ]
    # what is there is what a run that writes all has
    for step, increment in written:
        mine, theirs = (
            each.where((each["step"] == step) & (each["increment"] == increment))
            for each in (results.contacts, everything.contacts)
        )
        for name in (name for name in mine if name != "status"):
            np.testing.assert_array_equal(mine[name], theirs[name])


def test_the_points_for_paraview_are_those_of_the_table(runs):
    results = runs("*CONTACT FILE, FREQUENCY=2\n")
    with h5py.File(results.path.with_name(f"{results.path.stem}_contacts.vtkhdf")) as file:
        times = file["VTKHDF/Steps/Values"][:]
    np.testing.assert_allclose(times, [0.0, 0.4, 0.8, 1.0, 1.4, 1.8, 2.0])


def test_a_contact_is_new_against_the_last_increment_written(runs):
    ledger = runs("*CONTACT FILE, FREQUENCY=2\n").contacts
    of_first = ledger["status"][(ledger["step"] == 1) & (ledger["increment"] == 2)]
    assert set(of_first) == {"new"}
    assert "active" in ledger["status"][ledger["step"] == 2]


def test_contacts_that_are_written_more_often_than_fields_are_all_there(runs):
    results, everything = runs("*NODE FILE, FREQUENCY=2\n"), runs()
    assert results.contacts.n_rows == everything.contacts.n_rows
    assert results.contacts["status"].tolist() == everything.contacts["status"].tolist()
    assert results_table(results)[2:] == results_table(everything)[2:]


def results_table(results):
    """Lines of `litz table`."""
    return history_table(results).splitlines()


class TestIncrementsWithoutContacts:
    """What asks for contacts that are not there is told so."""

    @pytest.mark.parametrize(
        "ask",
        [
            lambda results: results.contacts_at(1),
            lambda results: results.contact_zones(1),
            lambda results: results.wire_pairs(1),
            lambda results: results.contact_network(1),
            lambda results: results.circuit(1),
            lambda results: results.wire_heat(1),
            lambda results: results.along_cable(1),
            lambda results: results.conductance("LOWER", "UPPER", 1) and results.contacts_at(1),
        ],
    )
    def test_is_an_error_in_words(self, runs, ask):
        results = runs("*CONTACT FILE, FREQUENCY=2\n")
        words = (
            "has no contacts of increment 1 of step 1 (*CONTACT FILE, FREQUENCY=): there are those of 0:0, 1:2, 1:4, "
        )
        with pytest.raises(LookupError, match=re.escape(words)):
            ask(results)

    def test_numbers_over_time_are_none_and_no_zeros(self, runs):
        table, whole = (runs(card).contacts_over_time for card in ("*CONTACT FILE, FREQUENCY=2\n", ""))
        has = runs("*CONTACT FILE, FREQUENCY=2\n").has_contacts()
        assert not has[1]
        assert np.isnan(table["force"][~has]).all()
        assert np.isnan(table["contacts"][~has]).all()
        np.testing.assert_array_equal(table["force"][has], whole["force"][has])
        np.testing.assert_array_equal(table["zones"][has], whole["zones"][has])

    def test_the_table_has_a_dash(self, runs):
        lines = results_table(runs("*CONTACT FILE, FREQUENCY=2\n"))
        assert f"-: {NOT_WRITTEN}" in lines
        assert "contacts: zones of contact along lines; contact force: the sum of all their forces" in lines
        assert [line.split()[1:3] for line in lines if line.split()[0] in ("0.2", "0.6")] == [["-", "-"]] * 2

    def test_the_summary_says_so(self, runs):
        text = runs("*CONTACT FILE, FREQUENCY=0\n").summary()
        assert re.search(r"contacts +not written \(\*CONTACT FILE\)", text)
        assert "without that of contacts" in text
        assert "contacts not written (*CONTACT FILE))" in text
        text = runs("*CONTACT FILE, FREQUENCY=2\n").summary()
        assert "over the increments with contacts in the ledger:" in text
        assert "not written" not in text

    @pytest.mark.parametrize("frequency", [0, 2])
    def test_report_viewer_and_exports_cope(self, runs, tmp_path, frequency, reports_without_pictures):
        results = runs(f"*CONTACT FILE, FREQUENCY={frequency}\n")
        page = litz.report(results, tmp_path / "report.html").read_text()
        assert NOT_WRITTEN not in page  # in what is compressed
        assert "increments have no contacts in the ledger (*CONTACT FILE)" in page
        assert ("not written (*CONTACT FILE)" in page) == (frequency == 0)
        data = WebData(results, list(range(len(results.times))))
        assert json.loads(data.model())["contact_texts"] == [
            "" if has else NOT_WRITTEN for has in results.has_contacts()
        ]
        for to in ("csv", "vtkhdf"):
            litz.export(results, to, tmp_path)
        rows = (tmp_path / f"{results.path.stem}_zones.csv").read_text().splitlines()[1:]
        written = {(1, 2), (1, 4), (1, 5), (2, 2), (2, 4), (2, 5)} if frequency else set()
        assert {tuple(map(int, row.split(",")[:2])) for row in rows} == written

    @pytest.mark.parametrize("kind", ["overview", "wires", "contacts", "lines", "section", "resistance", "friction"])
    @pytest.mark.parametrize("frequency", [0, 2])
    def test_pictures_cope(self, runs, tmp_path, kind, frequency):
        results = runs(f"*CONTACT FILE, FREQUENCY={frequency}\n")
        for increment in (1, -1):
            path = tmp_path / f"{increment}.svg"
            if kind == "lines" and not results.has_contacts()[increment]:
                with pytest.raises(LookupError, match="has no contacts of increment"):
                    litz.plot(results, kind, path, increment=increment)
                continue
            litz.plot(results, kind, path, increment=increment)
            assert path.stat().st_size > 0


def test_a_sweep_has_no_number_where_none_are_written(tmp_path, monkeypatch):
    (tmp_path / "deck.inp").write_text(deck("*CONTACT FILE, FREQUENCY=0\n").replace("120000000000.0", "{YOUNG}"))
    monkeypatch.chdir(tmp_path)
    table = litz.sweep(tmp_path / "deck.inp", {"YOUNG": [120e9]}, directory=tmp_path / "sweep", progress=False)
    assert np.isnan(table["contact force"]).all()


@pytest.mark.parametrize("frequency", ["-1", "1.5", "often"])
def test_a_bad_frequency_is_an_error(litz, tmp_path, frequency):
    (tmp_path / "deck.inp").write_text(deck(f"*CONTACT FILE, FREQUENCY={frequency}\n"))
    process = litz("run", "deck.inp", cwd=tmp_path)
    assert process.returncode == 1
    assert "FREQUENCY" in process.stderr
    assert frequency.upper() in process.stderr.upper()


def test_a_run_that_gives_up_shows_the_contacts_of_its_last_iterate(litz, tmp_path):
    # an overlap of more than 5 % of the radius
    text = pressed(
        2e-4,
        law=HERTZ + spot("HERTZ"),
        cards=(
            VOLT,
            "*CONTACT FILE, FREQUENCY=0\n",
        ),
        static="1., 1.",
    )
    (tmp_path / "deck.inp").write_text(text)
    process = litz("run", "deck.inp", cwd=tmp_path)
    assert process.returncode == 2
    with pytest.warns(UserWarning, match="did not finish"):
        last = Results(tmp_path / "deck_unconverged.vtkhdf")
    assert last.contacts_at(-1).n_rows > 0


def test_python_writes_the_card():
    model = litz.Model("a wire", units={"length": "m"})
    model.wire("A", (0, 0, 0), (1, 0, 0), elements=2, radius=0.1, material=litz.Material("M", young=1e9, poisson=0.3))
    model.step(increment=0.5).contact_file(0)
    assert "*CONTACT FILE, FREQUENCY=0" in model.to_deck()


@pytest.mark.parametrize("late", [False, True])
def test_contacts_in_hand_are_never_those_of_another_run(tmp_path, monkeypatch, late):
    """Few are read at once; many as they are needed, which a run that has written the files anew ends in words."""
    if late:
        monkeypatch.setattr("litz.results.ledger._FEW_ROWS", 0)
    path = tmp_path / "run.inp"

    def results_of(first):
        path.write_text(deck(first))
        return litz.run(path, output_directory=tmp_path, quiet=True)

    contacts = results_of("").contacts
    force = contacts["force"].copy()
    results_of("*CONTACT FILE, FREQUENCY=2\n")
    assert contacts["force"].tolist() == force.tolist()
    if late:
        with pytest.raises(RuntimeError, match="written anew"):
            contacts["current"]
    else:
        assert len(contacts["current"]) == len(force)

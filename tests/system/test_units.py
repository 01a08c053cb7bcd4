"""*UNITS: labels of units in the heads of tables, in result files, messages and pictures; numbers stay as they are."""

import json
import re

import matplotlib.figure
import matplotlib.text
import numpy as np
import pytest

import decks
import litz
from litz import export
from litz.base.quantities import engineering
from litz.results.history_table import history_table
from litz.viewer.data import WebData

REQUESTS = (
    "*ELECTRODE PRINT\n LOWER_ENDS, UPPER_ENDS\n*ENERGY PRINT\n*NODE PRINT, NSET=UPPER_ENDS\n U, RM\n*CONTACT PRINT"
)
LABELS = "*UNITS, LENGTH=mm, FORCE=mN, TIME=ms, CURRENT=mA, VOLTAGE=uV\n"


def crossed(**changes):
    """The crossed wires, in a deck that does not name its units."""
    return decks.crossed(**changes).replace("*UNITS, SYSTEM=SI\n", "")


@pytest.fixture
def two_runs(run):
    """The same numbers without labels and with them."""
    deck = crossed(extra=REQUESTS).replace("1, 9, 9, 1e-3\n 11, 9", "LOWER_ENDS, 9, 9, 1e-3\n UPPER_ENDS, 9")
    plain, labelled = run(deck, name="plain"), run(LABELS + deck, name="labelled")
    assert plain[0].returncode == labelled[0].returncode == 0, labelled[0].stderr
    return plain, labelled


def test_labels_change_no_number(two_runs):
    (_, plain), (_, labelled) = two_runs
    for name in plain.fields:
        np.testing.assert_array_equal(plain.field(name), labelled.field(name))
    for one, other in ((plain.history, labelled.history), (plain.contacts, labelled.contacts)):
        assert list(one) == list(other)
        for name in one:
            np.testing.assert_array_equal(one[name], other[name])


def test_tables_and_fields_have_the_labels(two_runs):
    _, (_, results) = two_runs
    history, ledger = results.history.units, results.contacts.units
    assert history["U1 node 11"] == "mm"
    assert history["RM1 node 11"] == "mN mm"
    assert history["ALLSE"] == "mN mm"
    assert history["resistance LOWER_ENDS to UPPER_ENDS"] == "uV/mA"
    assert (ledger["time"], ledger["force"], ledger["joule_heat"]) == ("ms", "mN", "uV mA")
    assert ledger["angle"] == results.units["rotation"] == "rad"
    assert results.units["current_density"] == "mA/mm^2"
    assert results.status.units["moment"] == "mNmm"
    assert results.convergence.units["penetration"] == "mm"
    assert (results.unit("displacement"), results.unit("force"), results.unit("id")) == ("mm", "mN", "1")


@pytest.mark.parametrize("card", ["*UNITS, SYSTEM=SI", "*UNITS"])
def test_a_deck_may_say_that_it_is_in_si(run, card):
    process, results = run(f"{card}\n{crossed(extra=REQUESTS)}")
    assert results.unit_labels == {key: key for key in ("m", "N", "s", "A", "V", "N m", "W", "ohm", "J")}
    assert "sum of F [N]" in process.stdout
    assert results.units["current_density"] == "A/m^2"
    assert "at time 1 s (" in results.summary()
    assert "soft to hard metal yields" in results.summary()


#: A unit in brackets or behind a number; angles have theirs in any system
UNIT = re.compile(
    r"\[(?!rad\])[^\]\n]*\]|\d (?:mm|[munpkMGµ]?(?:m|N|Nm|N·m|s|V|A|W|J|S|K|Pa|ohm|Ω)(?:[/²^·]\S+)?)(?![\w.])"
)


def test_without_labels_tables_and_messages_have_no_units(two_runs, litz, tmp_path):
    (process, results), _ = two_runs
    assert set(results.unit_labels.values()) == {""}
    assert {unit for unit in results.units.values() if unit} == {"1", "rad"}
    assert {*results.history.units.values(), *results.contacts.units.values()} == {"", "rad"}
    checked = litz("check", tmp_path / "plain.inp").stdout
    # the time that the run has taken, and its memory, have units of their own
    printed = re.sub(r"^finished.*$", "", process.stdout, flags=re.MULTILINE)
    export(results, "csv")
    tables = [path.read_text() for ending in ("*.csv", "*.sta", "*.cvg") for path in results.path.parent.glob(ending)]
    contacts_file = tmp_path / "network.csv"
    results.contact_network().to_csv(contacts_file)
    texts = [printed, checked, results.summary(), history_table(results), contacts_file.read_text()]
    for text in texts + tables:
        assert not UNIT.search(text), UNIT.search(text)


def test_without_labels_columns_keep_their_place(two_runs, run):
    (process, results), _ = two_runs
    in_si, _ = run(f"*UNITS\n{crossed()}")
    head, line = results.path.with_suffix(".sta").read_text().splitlines()[:2]
    assert len(head.split("remark")[0].rstrip()) == pytest.approx(len(line.rstrip()), abs=6)
    plain = next(line for line in process.stdout.splitlines() if "sum of F" in line)
    named = next(line for line in in_si.stdout.splitlines() if "sum of F" in line)
    assert plain.index("contacts") == named.index("contacts")
    assert "time  " in plain


def texts_of(figure):
    return [one.get_text() for one in figure.findobj(matplotlib.text.Text)]


@pytest.mark.slow
def test_without_labels_pictures_and_the_report_have_no_units(two_runs, monkeypatch):
    (_, plain), (_, labelled) = two_runs
    figures = []
    draw = matplotlib.figure.Figure.draw
    monkeypatch.setattr(matplotlib.figure.Figure, "draw", lambda self, *rest: (figures.append(self), draw(self, *rest)))
    for results, has_units in ((plain, False), (labelled, True)):
        figures.clear()
        for kind in ("overview", "resistance", "residuals", "contacts", "currents", "network", "history"):
            litz.plot(results, kind)
        texts = [text for figure in figures for text in texts_of(figure)]
        assert any("contact force" in text for text in texts)
        assert any(UNIT.search(text) for text in texts) == has_units, [text for text in texts if UNIT.search(text)]
    page = re.sub(r"<(script|style|pre).*?</\1>|<[^>]*>", "", litz.report(plain).read_text(), flags=re.DOTALL)
    page = page.partition("Deck")[0]
    assert "largest force" in page
    assert not UNIT.search(page), UNIT.search(page)
    assert set(json.loads(WebData(plain, [0]).model())["units"].values()) == {""}


def test_the_terminal_shows_the_labels(two_runs, litz, tmp_path):
    _, (process, results) = two_runs
    assert "time [ms]" in process.stdout
    assert "sum of F [mN]" in process.stdout
    assert "uV/mA, current" in process.stdout
    assert "at time 1 ms" in results.summary()
    assert " mN, sum " in results.summary()
    checked = litz("check", tmp_path / "labelled.inp").stdout
    assert "E = 1.2e+11 mN/mm^2" in checked
    assert "sigma = 5.88235e+07 mA/uV/mm" in checked


def test_the_head_of_the_status_table_stands_over_its_columns(two_runs):
    for _, results in two_runs:
        head, line = results.path.with_suffix(".sta").read_text().splitlines()[:2]
        assert len(head.split("remark")[0].rstrip()) == pytest.approx(len(line.rstrip()), abs=6)


def test_a_labelled_unit_gets_no_prefix():
    assert engineering(np.array([2e-6]), "m") == (1e6, "µm")
    assert engineering(np.array([2e-6]), "mm") == (1.0, "mm")
    assert engineering(np.array([2e6]), "mN mm") == (1.0, "mN mm")


@pytest.mark.parametrize(
    ("card", "message"),
    [
        ("*UNITS, LENGTH=m m", "at most 12 letters"),
        ("*UNITS, LENGTH=[mm]", "at most 12 letters"),
        ("*UNITS, FORCE=kilogramforces", "at most 12 letters"),
        ("*UNITS, MASS=kg", 'unknown parameter "MASS"'),
        ("*UNITS, LENGTH=mm\n*UNITS, FORCE=N", r"two *UNITS"),
    ],
)
def test_a_wrong_label_is_an_error_with_its_place(run, card, message):
    process, _ = run(f"{card}\n{crossed()}")
    assert process.returncode == 1
    assert message in process.stderr


def test_a_model_in_python_has_labels(tmp_path):
    model = litz.Model("labels", units={"length": "mm", "force": "mN"})
    model.wire("A", (0, 0, 0), (1, 0, 0), elements=2, radius=1.0, material=litz.Material("COPPER", 120e6, 0.34))
    assert litz.Deck.parse(model.to_deck()).card("UNITS").parameters == {"LENGTH": "mm", "FORCE": "mN"}
    with pytest.raises(ValueError, match="no parameter MASS"):
        litz.Model("labels", units={"mass": "kg"})


@pytest.mark.parametrize(
    ("units", "material", "found"),
    [
        (None, litz.Material("OWN", 1.0, 0.3), {}),
        (None, litz.COPPER, {"SYSTEM": "SI"}),
        ("SI", litz.Material("OWN", 1.0, 0.3), {"SYSTEM": "SI"}),
        ({"length": "m"}, litz.SILVER, {"LENGTH": "m"}),
    ],
)
def test_a_model_in_python_is_in_si_if_it_or_a_material_says_so(units, material, found):
    model = litz.Model("labels", units=units)
    model.wire("A", (0, 0, 0), (1, 0, 0), elements=2, radius=1.0, material=material)
    cards = litz.Deck.parse(model.to_deck()).find("UNITS")
    assert [dict(card.parameters) for card in cards] == ([found] if found else [])


def test_copper_in_si_is_refused_in_a_model_in_millimetres():
    model = litz.Model("labels", units={"length": "mm"})
    model.wire("A", (0, 0, 0), (1, 0, 0), elements=2, radius=1.0, material=litz.COPPER)
    with pytest.raises(ValueError, match=r"COPPER is in SI, and the model has LENGTH=mm: give a litz\.Material"):
        model.to_deck()
    with pytest.raises(ValueError, match='units of a material must be "SI" or None'):
        litz.Material("OWN", 1.0, 0.3, units="cgs")

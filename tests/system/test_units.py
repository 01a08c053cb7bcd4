"""*UNITS: labels of units in the heads of tables, in result files, messages and pictures; numbers stay as they are."""

import numpy as np
import pytest

import litz
from decks import crossed
from litz.base.quantities import engineering

REQUESTS = (
    "*ELECTRODE PRINT\n LOWER_ENDS, UPPER_ENDS\n*ENERGY PRINT\n*NODE PRINT, NSET=UPPER_ENDS\n U, RM\n*CONTACT PRINT"
)
LABELS = "*UNITS, LENGTH=mm, FORCE=mN, TIME=ms, CURRENT=mA, VOLTAGE=uV\n"


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


def test_without_labels_units_are_si(two_runs):
    (process, results), _ = two_runs
    assert results.unit_labels == {key: key for key in ("m", "N", "s", "A", "V", "N m", "W", "ohm", "J")}
    assert "sum of F [N]" in process.stdout


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
    model.wire("A", (0, 0, 0), (1, 0, 0), elements=2, radius=1.0, material=litz.COPPER)
    assert litz.Deck.parse(model.to_deck()).card("UNITS").parameters == {"LENGTH": "mm", "FORCE": "mN"}
    with pytest.raises(ValueError, match="no parameter MASS"):
        litz.Model("labels", units={"mass": "kg"})

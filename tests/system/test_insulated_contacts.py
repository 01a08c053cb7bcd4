"""Contacts that no current can pass: their resistance is infinite in every file and to every reader, never 0."""

import csv
import json
import subprocess
import warnings
from pathlib import Path
from xml.etree import ElementTree

import h5py
import numpy as np
import pytest

import litz
from decks import crossed
from litz.pictures.plots import plot
from litz.reports.report_tables import worst_contacts
from litz.viewer.data import WebData

STATIC = "0.5, 1, 1e-3, 0.5"
#: The conductors touch, but nothing lets a current cross
WITHOUT_LAW = crossed(spot="", static=STATIC)
#: One of the two does not conduct
ONE_INSULATOR = (
    crossed(static=STATIC)
    .replace("*BEAM SECTION, ELSET=WIRES", "*BEAM SECTION, ELSET=LOWER")
    .replace(
        "*SURFACE INTERACTION",
        "*MATERIAL, NAME=NYLON\n*ELASTIC\n 120e9, 0.34\n"
        "*BEAM SECTION, ELSET=UPPER, MATERIAL=NYLON, SECTION=CIRC\n 1e-3\n*SURFACE INTERACTION",
    )
    .replace(" 11, 9, 9, 0\n", "")
)
#: Neither does
INSULATORS = (
    crossed(spot="", static=STATIC)
    .replace("*ELECTRICAL CONDUCTIVITY\n 58.823529411764706e6\n", "")
    .replace(" 1, 9, 9, 1e-3\n 11, 9, 9, 0\n", "")
)


@pytest.fixture(scope="module", params=["without law", "one insulator", "insulators"])
def insulated(request, litz_program, tmp_path_factory):
    """Results of wires that touch without a current between them."""
    directory = tmp_path_factory.mktemp("insulated")
    deck = directory / "deck.inp"
    deck.write_text(
        {"without law": WITHOUT_LAW, "one insulator": ONE_INSULATOR, "insulators": INSULATORS}[request.param]
    )
    done = subprocess.run([litz_program, "run", deck, "-o", directory], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return litz.Results(directory)


def test_the_resistance_is_infinite_in_both_files(insulated):
    ledger = insulated.contacts
    assert ledger.n_rows == 2
    assert (ledger["force"] > 0).all()
    assert np.isposinf(ledger["resistance"]).all()
    assert (ledger["current"] == 0).all()
    assert (ledger["joule_heat"] == 0).all()
    base = insulated.path.with_suffix("")
    with Path(f"{base}_contacts.csv").open(newline="") as file:
        assert {row["resistance [ohm]"] for row in csv.DictReader(file)} == {"Inf"}
    with h5py.File(f"{base}_contacts.vtkhdf") as file:
        resistance = file["VTKHDF/PointData/resistance"]
        assert np.isposinf(resistance[()]).all()
        assert resistance.attrs["description"].decode() == "contact resistance, infinite where no current can pass"


def test_other_readers_find_infinity(insulated):
    pd = pytest.importorskip("pandas")
    table = pd.read_csv(f"{insulated.path.with_suffix('')}_contacts.csv")
    assert table["resistance [ohm]"].dtype == float
    assert np.isposinf(table["resistance [ohm]"]).all()
    assert np.isposinf(insulated.to_pandas("contacts")["resistance"]).all()


def test_paraview_reads_it_and_has_a_range_for_the_finite_values(insulated):
    pv = pytest.importorskip("pyvista")
    points = pv.read(f"{insulated.path.with_suffix('')}_contacts.vtkhdf")
    assert not np.isfinite(points["resistance"]).any()
    # VTK colours by this range, and leaves values beyond all numbers out of it
    mixed = pv.PolyData(np.zeros((3, 3)))
    mixed["resistance"] = np.array([1.0, 2.0, np.inf])
    assert mixed.GetPointData().GetArray("resistance").GetFiniteRange() == (1.0, 2.0)


def test_the_network_has_the_contact_and_its_infinite_resistance(insulated, tmp_path):
    network = insulated.contact_network()
    assert np.isposinf(network.resistance).tolist() == [True]
    with network.to_csv(tmp_path / "network.csv").open(newline="") as file:
        assert [float(row["resistance [ohm]"]) for row in csv.DictReader(file)] == [np.inf]
    root = ElementTree.parse(network.to_graphml(tmp_path / "network.graphml")).getroot()
    values = [data.text for data in root.iter() if data.get("key") == "edge_resistance_ohm"]
    # the word that Java's, Python's and C's readers of numbers share
    assert values == ["Infinity"]


def test_graphs_of_networkx_have_it(insulated, tmp_path):
    nx = pytest.importorskip("networkx")
    ((_, _, edge),) = insulated.contact_network().to_networkx().edges(data=True)
    assert edge["resistance"] == np.inf
    read = nx.read_graphml(insulated.contact_network().to_graphml(tmp_path / "network.graphml"))
    ((_, _, edge),) = read.edges(data=True)
    assert edge["resistance_ohm"] == np.inf


def test_tables_show_it(insulated):
    assert "<td>inf</td>" in insulated.contacts._repr_html_()
    assert "<td>∞</td>" in worst_contacts(insulated)


def test_the_viewer_gets_it_in_valid_json(insulated):
    data = json.loads(WebData(insulated).increment(-1), parse_constant=pytest.fail)
    assert data["contacts"]["resistance"] == ["∞"]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["overview", "resistance", "contacts", "network", "currents"])
def test_pictures_are_drawn_without_a_warning(insulated, kind, tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert plot(insulated, kind, tmp_path / f"{kind}.svg").stat().st_size > 1000


@pytest.mark.usefixtures("reports_without_pictures")
def test_the_report_leaves_the_chart_of_resistances_out(insulated, tmp_path):
    page = litz.report(insulated, tmp_path / "page.html").read_text(encoding="utf-8")
    assert "The contacts over time" in page
    assert "Contact resistance over contact force" not in page
    assert "∞" in page


def test_the_terminal_says_infinity(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(WITHOUT_LAW.replace("*END STEP", "*CONTACT PRINT\n*END STEP"))
    done = litz("run", deck, "-o", tmp_path)
    assert "resistance    Infinity ohm, current  0.0000E+00 A" in done.stdout


def test_a_run_that_goes_on_keeps_it(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(WITHOUT_LAW.replace("*END STEP", "*RESTART, WRITE\n*END STEP"))
    assert litz("run", deck, "-o", tmp_path / "first").returncode == 0
    restart = f"{tmp_path / 'first' / 'deck.restart.h5'}:1:1"
    done = litz("run", deck, "-o", tmp_path / "on", "--restart", restart)
    assert done.returncode == 0, done.stderr
    rows = (tmp_path / "on" / "deck_contacts.csv").read_text().splitlines()[1:]
    assert len(rows) == 2
    assert all(",Inf," in row for row in rows)

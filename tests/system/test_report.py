"""`litz report`: what the page says is what the results hold."""

import base64
import gzip
import json
import re

import numpy as np
import pytest

import litz
from litz.base.table import Table
from litz.cli import main
from litz.reports import report_tables
from litz.viewer.data import WebData

pytestmark = pytest.mark.filterwarnings("ignore:.*drawn with matplotlib only")


@pytest.fixture(scope="module")
def grid(run_of_input):
    return litz.Results(run_of_input("04_wire_grid"))


@pytest.fixture(scope="module")
def page(report_of_grid):
    return report_of_grid.read_text(encoding="utf-8")


def plain(text):
    """A page without tags, in one line."""
    return " ".join(re.sub(r"<[^>]+>", " ", re.sub(r"<(script|style).*?</\1>", "", text, flags=re.S)).split())


class TestPage:
    @pytest.mark.slow
    def test_it_is_the_same_when_processes_share_the_work(self, grid, page, tmp_path):
        shared = litz.report(grid, tmp_path / "shared.html", processes=2)
        assert shared.read_text(encoding="utf-8") == page

    def test_it_needs_nothing_from_outside(self, page):
        addresses = re.findall(r'(?:src|href)="([^"]{0,30})', page)
        assert addresses
        assert all(address.startswith("data:") for address in addresses)
        assert not re.findall(r"url\((?!#)", page.split("<body>")[0])

    def test_it_has_every_section(self, page):
        for heading in ("Model", "Balance", "Convergence", "Worst contacts", "Pictures", "To turn and look at", "Deck"):
            assert f"<h2>{heading}</h2>" in page

    def test_model_and_run_are_counted(self, page, grid):
        text = plain(page)
        assert f"nodes {len(grid.nodes)} elements {len(grid.elements)} wires 8" in text
        assert f"The run finished at time 1 s: 4 increments, {grid.status['iterations'].sum()} iterations" in text

    def test_the_worst_figures_of_the_audit_are_told(self, page, grid):
        worst = grid.audit["current_balance"]
        place = worst.argmax()
        assert f"currents {worst.max():.2g} {grid.steps[place]}:{grid.increments[place]}" in plain(page)

    def test_moments_that_are_round_off_have_no_picture(self, page, run_of_input, tmp_path):
        """The wires of a lap joint are pressed without bending."""
        lap = litz.report(run_of_input("15_lap_joint"), tmp_path / "lap.html").read_text(encoding="utf-8")
        assert "Bending moment." in page
        assert "Bending moment." not in lap

    def test_what_goes_in_comes_out(self, page, grid):
        entering = grid.field("reaction_current")
        shown = report_tables.amount(entering[entering > 0].sum(), "A")
        assert f"current in {shown} current out {shown}" in plain(page)

    def test_it_is_small_enough_to_be_sent(self, page):
        """Seven pictures, the model of 56 elements at 4 increments, and the viewer."""
        assert len(page.encode()) < 1e6

    def test_its_pictures_are_inside(self, page):
        assert page.count('<img alt="') >= 7
        assert page.count("data:image/webp;base64,UklGR") == page.count('<img alt="')

    def test_it_is_not_large(self, page):
        assert len(page) < 5e6

    def test_the_text_of_the_deck_is_escaped(self, page, grid):
        assert "<pre>*HEADING" in page
        assert grid.deck.splitlines()[-2] in page


@pytest.mark.slow
@pytest.mark.parametrize("name", ["11_fibre_mat", "14_strand"])
def test_pages_of_many_contacts_are_small_too(run_of_input, tmp_path, name):
    """The last increment at least, more of them where there is room, and pictures of less quality where there is none."""
    results = litz.Results(run_of_input(name))
    page = litz.report(results, tmp_path / "report.html").read_text(encoding="utf-8")
    assert len(page.encode()) < 1e6
    told = re.search(r"(\d+) of (\d+) increments are in this page", page)
    count = int(told[1]) if told else len(results.times)
    assert page.count('id="litz-increment-') == count >= 1
    assert page.count("data:image/webp;base64,UklGR") == page.count('<img alt="')
    if len(results.deck) > 20000:
        zipped = re.search(r'<details id="litz-deck" data-deck="([^"]*)"', page)[1]
        assert gzip.decompress(base64.b64decode(zipped)).decode() == results.deck


class TestWorstContacts:
    def test_each_contact_is_named_once_with_its_worst_increment(self):
        rows = report_tables._worst_of_each(np.array([1, 2, 1, 3, 2]), np.array([5.0, 1.0, 7.0, 6.0, 2.0]))
        assert rows.tolist() == [2, 3, 4]

    def test_current_density_is_current_over_the_area_of_the_spot(self):
        ledger = Table(
            {"semi_major": np.array([2e-5, 0.0]), "semi_minor": np.array([1e-5, 0.0]), "current": np.array([-3.0, 1.0])}, {}
        )  # fmt: skip
        np.testing.assert_allclose(report_tables.current_density(ledger), [3 / (np.pi * 2e-10), 0])

    def test_currents_that_are_only_round_off_are_none(self, tmp_path):
        results = litz.run(litz.new("film", tmp_path / "film.inp"), output_directory=tmp_path)
        current = np.abs(results.contacts["current"])
        # through wires that lead nowhere
        dead = (current > 0) & (current < 1e-9 * current.max())
        assert dead.any()
        assert re.search(r"e-\d+ [a-z]?A", plain(report_tables.worst_contacts(results))) is None
        shown = np.abs(json.loads(WebData(results).increment(len(results.times) - 1))["contacts"]["current"])
        assert shown[shown > 0].min() > 1e-9 * current.max()

    def test_the_largest_force_is_that_of_the_ledger(self, grid):
        text = plain(report_tables.worst_contacts(grid))
        ledger = grid.contacts
        k = ledger["force"].argmax()
        after = text.split("largest force")[1]
        assert report_tables.amount(ledger["force"][k], "N") in after.split("contact")[1]


GIVES_UP = "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n ,,,2,,,,1\n"


class TestUnconverged:
    @pytest.fixture
    def gave_up(self, run, inputs):
        """A run whose second increment on is pressed far too hard for the two iterations that it may take."""
        deck = (inputs / "05_clamped_pair.inp").read_text()
        step = deck.index("*STATIC")
        process, results = run(deck[:step] + deck[step:].replace("*BOUNDARY", GIVES_UP + "*BOUNDARY", 1))
        assert process.returncode == 2, process.stdout
        return process, results

    @pytest.mark.slow
    @pytest.mark.filterwarnings("ignore:.*did not finish")
    def test_the_page_says_what_failed_at_which_node_and_contact(self, gave_up):
        process, results = gave_up
        text = plain(litz.report(results).read_text(encoding="utf-8"))
        assert "The run did not finish" in text
        assert "What failed" in text
        # the node that the program names
        node = re.search(r"at node (\d+)", process.stderr)[1]
        assert f"at node {node}" in text
        first, second = re.search(r"that of elements (\d+) and (\d+)", process.stderr).groups()
        assert re.search(rf"deepest contacts .* contact \d+ {first}, {second} ", text)
        assert "not an equilibrium" in text

    @pytest.mark.filterwarnings("ignore:.*did not finish")
    @pytest.mark.usefixtures("reports_without_pictures")
    def test_the_iterate_leads_to_the_report_of_the_run(self, gave_up):
        _, results = gave_up
        iterate = results.path.with_name(f"{results.path.stem}_unconverged.vtkhdf")
        assert litz.report(iterate) == results.path.with_name(f"{results.path.stem}_report.html")


@pytest.mark.slow
def test_the_command_writes_the_page_beside_the_results(run_of_input, capsys):
    directory = run_of_input("07_roll_up")
    assert main(["report", str(directory)]) == 0
    path = directory / "07_roll_up_report.html"
    assert str(path) in capsys.readouterr().out
    assert "No wires have touched" in plain(path.read_text(encoding="utf-8"))

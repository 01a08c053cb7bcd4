"""Warnings are data: what a run warns of is on standard error, in .sta, in the results, and raised in Python."""

import re
import signal
import subprocess
import time
import warnings

import numpy as np
import pytest

import litz
from decks import cantilever, crossed
from litz.results.run_warnings import read_warnings
from litz.results.summary import summary

TENTHS = "0.1, 1, 1e-3, 0.1"
AT_POINTS = "*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT\n 1e-3"
SHALLOW = "contact 1 (elements 3 and 13) crosses at 8 degrees, below 10, where spots are long and point contact is less accurate"
SOFT = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR{}\n {}"


def shallow(**changes):
    """The upper wire lies 8 degrees from the lower one: its contact closes in the first increment and stays.

    A given resistance is that of a contact at a point, for which the angle is small.
    """
    turn = np.radians(8)
    deck = crossed(**{"push": "-2e-5", "static": TENTHS, "spot": AT_POINTS, **changes})
    for node, y in ((11, -0.05), (12, -0.02), (13, -0.005), (14, 0.006), (15, 0.02), (16, 0.05)):
        old = next(line for line in deck.splitlines() if line.startswith(f" {node}, 0, "))
        deck = deck.replace(old, f" {node}, {y * np.cos(turn):.17g}, {y * np.sin(turn):.17g}, 2e-3", 1)
    return deck


def too_few_increments():
    """It ends after 12 increments, the first of which are small."""
    return shallow(static="1e-3, 1, 1e-4, 0.1").replace("INC=200", "INC=12")


def kinds(found):
    return [entry.kind for entry in found]


class TestOneListInEveryPlace:
    def test_a_quiet_run_warns_on_standard_error_once_and_ends_with_the_counts(self, run, tmp_path):
        process, _ = run(shallow(), "--quiet")
        assert process.returncode == 0
        assert process.stdout == ""
        first, second, last = process.stderr.splitlines()
        assert first.startswith("warning: 2 pairs of elements lie close side by side")
        assert second == f"warning: {SHALLOW}"
        assert last == f"2 warnings (side_by_side: 1, shallow_angle: 1); see {tmp_path}/deck/deck.sta"

    def test_wires_that_can_touch_along_lines_are_not_warned_of(self, run):
        process, results = run(shallow(spot="*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ"), "--quiet")
        assert (process.returncode, process.stderr) == (0, "")
        assert results.warnings == []

    def test_a_run_without_warnings_says_nothing_of_them(self, run, tmp_path):
        process, results = run(crossed(), "--quiet")
        assert (process.stdout, process.stderr) == ("", "")
        assert results.warnings == []
        assert "warnings:" not in summary(results).replace(str(tmp_path), "")
        assert "#" not in (tmp_path / "deck" / "deck.sta").read_text()

    def test_the_results_keep_first_last_count_and_worst(self, run):
        _, results = run(shallow())
        side_by_side, angle = results.warnings
        assert (side_by_side.kind, side_by_side.step, side_by_side.increment, side_by_side.count) == (
            "side_by_side", 0, 0, 1,
        )  # fmt: skip
        assert angle.kind == "shallow_angle"
        assert angle.message == SHALLOW
        assert angle.elements == (3, 13)
        assert (angle.first, angle.last, angle.count) == ("1:1", "1:10", 10)
        assert (angle.time, angle.last_time) == (pytest.approx(0.1), pytest.approx(1.0))
        assert angle.unit == "degrees"
        # the ledger has the angle of each increment by itself
        assert angle.worst == pytest.approx(np.degrees(results.contacts["angle"].min()), rel=1e-12)
        with pytest.raises(AttributeError):
            angle.count = 3

    def test_the_sta_file_has_them_as_comments_and_its_rows_as_before(self, run, tmp_path):
        _, results = run(shallow())
        lines = (tmp_path / "deck" / "deck.sta").read_text().splitlines()
        where = lines.index(f"# warning: {SHALLOW}")
        assert lines[where + 1].split()[:2] == ["1", "1"]
        assert lines[-1] == f"# shallow_angle: {SHALLOW} (10 increments, 1:1 to 1:10, worst 8 degrees)"
        assert results.status["increment"].tolist() == list(range(1, 11))
        # numpy takes the lines for comments without being asked to
        rows = np.loadtxt(tmp_path / "deck" / "deck.sta", skiprows=1, usecols=range(17))
        np.testing.assert_array_equal(rows[:, 1], results.status["increment"])

    @pytest.mark.usefixtures("reports_without_pictures")
    def test_the_summary_and_the_report_list_them(self, run, tmp_path):
        _, results = run(shallow())
        text = summary(results)
        assert "2 warnings:" in text
        assert f"  shallow_angle: {SHALLOW} (10 increments, 1:1 to 1:10, worst 8 degrees)" in text
        page = litz.report(results, tmp_path / "page.html").read_text(encoding="utf-8")
        assert "<h2>Warnings</h2>" in page
        assert SHALLOW in page


class TestInPython:
    def test_a_run_raises_each_as_a_python_warning_at_the_line_that_called_it(self, tmp_path):
        (tmp_path / "deck.inp").write_text(shallow())
        with pytest.warns(litz.RunWarning) as caught:
            results = litz.run(tmp_path / "deck.inp", output_directory=tmp_path)
        assert [one.message.entry for one in caught] == results.warnings
        assert all(one.filename == __file__ for one in caught)
        assert issubclass(litz.RunWarning, RuntimeWarning)

    def test_they_can_be_silenced_by_their_category(self, tmp_path):
        (tmp_path / "deck.inp").write_text(shallow())
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", category=litz.RunWarning)
            results = litz.run(tmp_path / "deck.inp", output_directory=tmp_path)
        assert kinds(results.warnings) == ["side_by_side", "shallow_angle"]

    def test_a_check_raises_those_of_the_start(self, tmp_path):
        (tmp_path / "deck.inp").write_text(shallow())
        with pytest.warns(litz.RunWarning, match="close side by side") as caught:
            litz.check(tmp_path / "deck.inp")
        assert len(caught) == 1

    def test_a_sweep_counts_them_for_each_run_and_raises_none(self, tmp_path):
        places = shallow(push="{push}")
        (tmp_path / "deck.inp").write_text(places)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for _ in range(2):
                # the second time from what the first has left
                table = litz.sweep(
                    tmp_path / "deck.inp", {"push": [1e-6, -2e-5]}, directory=tmp_path / "sweep", progress=False
                )
                assert table["warnings"].tolist() == [1, 2]


class TestKinds:
    def test_an_overlap_that_is_allowed_is_warned_of_when_it_is_deep(self, run):
        """Without the law of contact: overlap from the ledger, over the radius of 1 mm."""
        soft = SOFT.format(", PENETRATION=UNLIMITED", "1e3")
        process, results = run(crossed(behavior=soft, push="-5e-4", static=TENTHS))
        assert process.returncode == 0, process.stderr
        overlap = -results.contacts["gap"] / 1e-3
        (deep,) = results.warnings
        assert deep.kind == "unlimited_penetration"
        assert deep.elements == (3, 13)
        assert deep.count == (overlap > 0.05).sum()
        assert (deep.increment, deep.last_increment) == (np.flatnonzero(overlap > 0.05)[0] + 1, 10)
        assert deep.worst == pytest.approx(100 * overlap.max(), rel=1e-12)

    def test_an_allowed_overlap_below_five_percent_is_none(self, run):
        soft = SOFT.format(", PENETRATION=UNLIMITED", "1e6")
        _, results = run(crossed(behavior=soft, push="-5e-4", static=TENTHS))
        assert 0 < -results.contacts["gap"].min() < 5e-5
        assert results.warnings == []

    def test_round_off_is_warned_of_where_it_is_a_part_of_real_forces(self, run):
        """2 km from the origin, the places of nodes are known to 2e-13 m: a stiffness EA/L of 2e7 N/m makes 5e-6 N of it."""
        nodes, mark, rest = crossed(push="-1e-6", static=TENTHS).partition("*NSET, NSET=LOWER_ENDS")
        far, n = re.subn(r"^( \d+, )(\S+),", lambda m: f"{m[1]}{float(m[2]) + 2000:.17g},", nodes, flags=re.MULTILINE)
        assert n == 12
        process, results = run(far + mark + rest)
        assert process.returncode == 0, process.stderr
        assert "round_off" in kinds(results.warnings)
        entry = next(entry for entry in results.warnings if entry.kind == "round_off")
        assert entry.unit == "%"
        assert entry.worst > 0.01

    def test_round_off_of_a_field_that_has_nothing_else_is_none(self, inputs, run_of_input):
        """A rolled-up beam has moments and no forces: the residual of the forces is as large as they are."""
        results = litz.Results(run_of_input("07_roll_up"))
        assert "accepted at the limit of round-off" in results.status["remark"]
        assert results.warnings == []

    @pytest.mark.parametrize(("increments", "load"), [(1, 20.0), (1, 1.01), (10, 2.1), (10, 1.01)])
    def test_a_load_beyond_the_critical_one_is_warned_of_from_the_increment_on_that_passes_it(
        self, run, increments, load
    ):
        euler = np.pi**2 * 200e9 * np.pi / 4 * 1e-12 / (4 * 0.1**2)
        beyond = load * np.arange(1, increments + 1) / increments > 1
        deck = cantilever(
            f"*CLOAD\n 11, 1, {-load * euler:.17g}",
            element="B33",
            static=f"{1 / increments}, 1, 1e-5, {1 / increments}",
        )
        process, results = run(deck, "--quiet")
        assert process.returncode == 0, process.stderr
        (entry,) = results.warnings
        assert entry.kind == "negative_pivots"
        assert (entry.increment, entry.last_increment) == (np.flatnonzero(beyond)[0] + 1, increments)
        assert entry.count == beyond.sum()

    @pytest.mark.parametrize("increments", [1, 10])
    def test_a_load_below_the_critical_one_is_not(self, run, increments):
        euler = np.pi**2 * 200e9 * np.pi / 4 * 1e-12 / (4 * 0.1**2)
        deck = cantilever(f"*CLOAD\n 11, 1, {-0.99 * euler:.17g}", element="B33", static=f"{1 / increments}, 1")
        _, results = run(deck, "--quiet")
        assert results.warnings == []

    @pytest.mark.parametrize(("table", "beyond"), [((1e-3, 1e3), 0), ((1e-3, 0.5), 1), ((1e2, 1e3), -1)])
    def test_a_contact_whose_force_leaves_its_table_is_named(self, run, table, beyond):
        rows = "\n".join(f" {force}, {1e-3 * force ** (-1 / 3)}" for force in table)
        process, results = run(
            crossed(spot=f"*GAP ELECTRICAL CONDUCTANCE, LAW=TABLE\n{rows}", static=TENTHS), "--quiet"
        )
        assert process.returncode == 0, process.stderr
        contacts = results.contacts
        # a power law is continued by itself
        np.testing.assert_allclose(contacts["resistance"], 1e-3 * contacts["force"] ** (-1 / 3), rtol=1e-9)
        ratio = {0: 0 * contacts["force"], 1: contacts["force"] / table[-1], -1: table[0] / contacts["force"]}[beyond]
        assert (ratio > 1).any() == (beyond != 0)
        assert kinds(results.warnings) == ["outside_table"] * (beyond != 0)
        for entry in results.warnings:
            assert entry.elements == (3, 13)
            assert entry.worst == pytest.approx(ratio.max(), rel=1e-9)
            assert entry.count == (ratio > 1).sum()

    @pytest.mark.parametrize("third", ["", " 16, 9, 9, 5e-4\n", "*CECURRENT\n 6, , -0.1\n"])
    def test_current_that_goes_elsewhere_than_from_electrode_to_electrode_is_warned_of(self, run, third):
        electrodes = "*NSET, NSET=PL\n 1\n*NSET, NSET=MI\n 11\n"
        deck = crossed(extra=f"{third}*NODE PRINT, NSET=MI\n RCURR\n*ELECTRODE PRINT\n PL, MI\n")
        process, results = run(deck.replace("*NSET, NSET=LOWER_ENDS", electrodes + "*NSET, NSET=LOWER_ENDS"), "--quiet")
        assert process.returncode == 0, process.stderr
        into_plus = results.history["current PL to MI"][-1]
        out_of_minus = -results.history["RCURR node 11"][-1]
        assert kinds(results.warnings) == ["third_electrode"] * bool(third)
        for entry in results.warnings:
            elsewhere = abs(into_plus - out_of_minus) / max(abs(into_plus), abs(out_of_minus))
            assert entry.worst == pytest.approx(100 * elsewhere, rel=1e-9)
            assert elsewhere > 0.05

    def test_stabilization_is_a_remark_and_no_warning(self, run):
        _, results = run(crossed(extra="*CONTROLS, PARAMETERS=STABILIZE\n 1e-6\n"))
        assert "stabilization has taken" in results.status["remark"][-1]
        assert results.warnings == []

    @pytest.mark.parametrize("damped", [True, False])
    def test_what_the_deck_reader_warns_of_is_in_the_list(self, run, damped):
        """A conductor that only the contact leads to a potential, a spare node, and a wire that only the contact holds,
        unless it is damped."""
        damping = "*CONTROLS, PARAMETERS=STABILIZE\n 1e-6\n" * damped
        text = crossed(extra=f"{damping}*CLOAD\n 13, 3, -0.1\n 14, 3, -0.1\n")
        for line in (" UPPER_ENDS, 1, 2\n", " UPPER_ENDS, 4, 6\n", " UPPER_ENDS, 3, 3, -1e-4\n", " 11, 9, 9, 0\n"):
            assert line in text
            text = text.replace(line, "")
        process, results = run(text.replace("*NSET, NSET=LOWER_ENDS", "*NODE\n 99, 1, 1, 1\n*NSET, NSET=LOWER_ENDS"))
        assert ("nothing holds UPPER" in process.stderr) != damped
        assert process.stderr.count("node 99 belongs to no element") == 1
        if not damped:
            return
        assert process.returncode == 0, process.stderr
        found = {entry.kind: entry for entry in results.warnings}
        assert "spare_nodes" in found
        # what holds wires, or gives them their potential, in any network
        assert not {"held_by_contact", "potential_by_contact"} & set(found)
        assert found["spare_nodes"].message == "node 99 belongs to no element"


class TestRunsThatAreCutShort:
    @pytest.mark.slow
    def test_a_run_of_many_increments_keeps_one_entry(self, run):
        deck = shallow(static="2e-3, 1, 1e-4, 2e-3").replace("INC=200", "INC=1000")
        process, results = run(deck, "--quiet")
        assert process.returncode == 0, process.stderr
        assert process.stderr.count("\n") == 3
        angle = results.warnings[1]
        assert (angle.first, angle.last, angle.count) == ("1:1", "1:500", 500)
        assert len(results.warnings) == 2

    def test_a_run_that_goes_on_goes_on_with_the_list(self, run, tmp_path):
        deck = shallow(extra="*RESTART, WRITE, FREQUENCY=4")
        _, whole = run(deck, name="whole")
        restart = f"{tmp_path}/whole/whole.restart.h5:1:4"
        process, rest = run(deck, "--quiet", "--restart", restart, name="rest")
        assert process.returncode == 0, process.stderr
        assert rest.increments.tolist()[-1] == 10
        assert rest.warnings == whole.warnings
        # what the first run has said is not said again, but counted
        assert process.stderr == f"2 warnings (side_by_side: 1, shallow_angle: 1); see {tmp_path}/rest/rest.sta\n"
        assert f"# warning: {SHALLOW}" in (tmp_path / "rest" / "rest.sta").read_text()

    @pytest.mark.filterwarnings("ignore:.*did not finish")
    def test_a_failed_run_keeps_its_own(self, tmp_path):
        (tmp_path / "deck.inp").write_text(too_few_increments())
        with pytest.warns(litz.RunWarning) as caught, pytest.raises(litz.NotConvergedError) as error:
            litz.run(tmp_path / "deck.inp", output_directory=tmp_path)
        assert str(error.value).startswith("error: ")
        kept = litz.Results(tmp_path / "deck.vtkhdf").warnings
        assert [one.message.entry for one in caught if one.category is litz.RunWarning] == kept == error.value.warnings
        assert (kept[1].kind, kept[1].count, kept[1].last) == ("shallow_angle", 12, "1:12")
        assert "# shallow_angle" in (tmp_path / "deck.sta").read_text()

    def test_an_error_comes_before_warnings_that_are_made_exceptions(self, tmp_path):
        (tmp_path / "deck.inp").write_text(too_few_increments())
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with pytest.raises(litz.NotConvergedError):
                litz.run(tmp_path / "deck.inp", output_directory=tmp_path)

    def test_a_run_that_fails_before_its_first_increment_leaves_the_list_of_an_older_one(self, run, tmp_path):
        _, older = run(shallow())
        before = older.warnings
        loose = shallow(push="-5", static="1, 1, 0.5, 1")
        process, results = run(loose, "--quiet")
        assert process.returncode == 2
        assert results.warnings == before
        last = process.stderr.split("error:")[0].splitlines()[-1]
        assert last == f"1 warning (side_by_side: 1); see {tmp_path}/deck/deck_unconverged.sta"
        assert "# side_by_side" in (tmp_path / "deck" / "deck_unconverged.sta").read_text()

    @pytest.mark.filterwarnings("ignore:.*did not finish")
    def test_a_run_that_is_killed_keeps_what_it_has_warned_of(self, litz_program, tmp_path):
        deck = tmp_path / "deck.inp"
        deck.write_text(shallow(static="1e-4, 1, 1e-5, 1e-4").replace("INC=200", "INC=100000"))
        process = subprocess.Popen(
            [litz_program, "run", deck, "-o", tmp_path, "--quiet"], stderr=subprocess.PIPE, text=True
        )
        for line in process.stderr:
            if line == f"warning: {SHALLOW}\n":
                break
        while not (tmp_path / "deck.vtkhdf").exists() and process.poll() is None:
            time.sleep(0.01)
        time.sleep(0.1)
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stderr.close()
        assert process.returncode == -signal.SIGKILL
        side_by_side, angle = read_warnings(tmp_path / "deck.vtkhdf")
        assert side_by_side.kind == "side_by_side"
        assert angle.message == SHALLOW
        assert angle.count >= 1

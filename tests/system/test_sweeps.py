"""litz.sweep: grids of parameters, failures kept, runs that are there not repeated; litz.run with progress; litz.check."""

import io
import json
import os
import re
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

import litz
from decks import crossed
from litz.base import notebook
from litz.runs import progress as progress_module
from litz.runs.progress import Progress, total_time

#: Where decks and conftest are
TESTS = Path(__file__).parents[1]
REQUEST = "*NODE PRINT, NSET=UPPER_ENDS, TOTALS=ONLY\n RF"


@pytest.fixture
def template(tmp_path):
    path = tmp_path / "wires.inp"
    path.write_text(crossed(push="{push}", extra=REQUEST).replace("120e9", "{young}"))
    return path


def model(push):
    """Crossed wires; a push of more than 1 m needs more increments than it may take."""
    made = litz.Model("crossed")
    properties = {"radius": 1e-3, "material": litz.STEEL, "elements": 5}
    lower = made.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), **properties)
    upper = made.wire("UPPER", (0, -0.05, 2e-3), (0, 0.05, 2e-3), **properties)
    made.contact(lower, upper)
    made.fix(lower)
    made.fix(upper, "x", "y", "rotations")
    step = made.step(inc=1)
    step.move(upper, "z", -push)
    step.node_print(upper, "RF", totals="ONLY")
    return made


def test_a_template_runs_for_all_combinations(template, tmp_path):
    table = litz.sweep(
        template, {"young": [60e9, 120e9], "push": np.array([-5e-5, -1e-4])}, directory=tmp_path / "sweep", processes=2
    )
    assert table["young"].tolist() == [60e9, 60e9, 120e9, 120e9]
    assert table["push"].tolist() == [-5e-5, -1e-4, -5e-5, -1e-4]
    assert set(table["status"]) == {"finished"}
    force = -table["RF3 sum UPPER_ENDS"].reshape(2, 2)
    assert table.units["RF3 sum UPPER_ENDS"] == "N"
    # elastic wires and the law of Hertz: forces are in proportion to the modulus
    np.testing.assert_allclose(force[1], 2 * force[0], rtol=1e-6)
    # the same as one run of the same deck
    alone = litz.run(table["directory"][3] + "/deck.inp", output_directory=tmp_path / "alone", threads=1)
    assert alone.history["RF3 sum UPPER_ENDS"][-1] == table["RF3 sum UPPER_ENDS"][3]


def test_finished_runs_are_not_repeated_unless_asked(tmp_path):
    def times():
        return {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*.vtkhdf")}

    arguments = {"directory": tmp_path, "progress": False}
    first = litz.sweep(model, {"push": [1e-6, 2e-6]}, **arguments)
    before = times()
    again = litz.sweep(model, {"push": [1e-6, 2e-6, 3e-6]}, **arguments)
    after = times()
    assert {path: after[path] for path in before} == before
    assert len(after) == len(before) * 3 // 2
    np.testing.assert_array_equal(again["RF3 sum UPPER"][:2], first["RF3 sum UPPER"])
    litz.sweep(model, {"push": [1e-6]}, again=True, **arguments)
    assert sum(times()[path] != after[path] for path in after) >= 1


def test_a_changed_model_is_run_again(tmp_path):
    def stiffer(push):
        made = model(push)
        made.steps[0].controls("field", r_n=1e-4)
        return made

    litz.sweep(model, {"push": [1e-6]}, directory=tmp_path, progress=False)
    (outcome,) = tmp_path.rglob("outcome.json")
    before = json.loads(outcome.read_text())["identity"]
    litz.sweep(stiffer, {"push": [1e-6]}, directory=tmp_path, progress=False)
    assert json.loads(outcome.read_text())["identity"] != before


def test_a_deck_is_run_again_if_a_file_that_it_reads_has_changed(template, tmp_path):
    """Directly, and through another file."""
    text = template.read_text().replace("{young}", "120e9")
    (tmp_path / "inc").mkdir()
    inner, outer = tmp_path / "inc" / "inner.inp", tmp_path / "outer.inp"
    first = text.index("*ELASTIC")
    last = text.index("*", first + 1)
    template.write_text(text[:first] + "*INCLUDE,\n INPUT=outer.inp\n" + text[last:])
    outer.write_text('*INCLUDE, INPUT="inc/inner.inp"\n')
    forces = []
    for young in ("120e9", "120e9", "60e9"):
        inner.write_text(text[first:last].replace("120e9", young))
        table = litz.sweep(template, {"push": [-5e-5]}, directory=tmp_path / "sweep", progress=False)
        forces.append(table["contact force"][0])
    assert forces[1] == forces[0]
    assert forces[2] == pytest.approx(forces[0] / 2, rel=1e-3)
    outer.write_text(inner.read_text().replace("60e9", "120e9"))
    table = litz.sweep(template, {"push": [-5e-5]}, directory=tmp_path / "sweep", progress=False)
    assert table["contact force"][0] == pytest.approx(forces[0])


#: A rod that is drawn further in a second step
ROD = """\
*NODE
 1, 0, 0, 0
 2, 1, 0, 0
*ELEMENT, TYPE=B31, ELSET=ROD
 1, 1, 2
*MATERIAL, NAME=M
*ELASTIC
 1e9, 0.3
*BEAM SECTION, ELSET=ROD, MATERIAL=M, SECTION=CIRC
 0.01
*BOUNDARY
 1, ENCASTRE
*STEP
*STATIC
 first, 1, , first
*BOUNDARY
 2, 1, 1, 1e-3
*RESTART, WRITE
*END STEP
*STEP
*STATIC
*BOUNDARY
 2, 1, 1, {second}
*ENERGY PRINT
*END STEP
"""


def test_a_deck_is_run_again_if_what_it_goes_on_from_has_changed(tmp_path):
    """How many increments the first step had is told by the restart file alone."""
    template = tmp_path / "rod.inp"
    template.write_text(ROD.replace("first", "1.0"))
    written = []
    for first in (1.0, None, 0.5):
        if first is not None:
            (tmp_path / "saved.inp").write_text(ROD.replace("first", repr(first)).replace("{second}", "3e-3"))
            litz.run(tmp_path / "saved.inp", output_directory=tmp_path)
        saved = f"{tmp_path / 'saved.restart.h5'}:1:1"
        litz.sweep(template, {"second": [3e-3]}, directory=tmp_path / "sweep", progress=False, restart=saved)
        (results,) = (tmp_path / "sweep").rglob("deck.vtkhdf")
        written.append(results.stat().st_mtime_ns)
    assert written[1] == written[0]
    assert written[2] > written[1]


def test_failed_runs_are_told_and_kept(tmp_path):
    with pytest.warns(UserWarning, match=r"1 of 2 runs failed; the first, push=5.0: error: .*increments"):
        table = litz.sweep(model, {"push": [1e-6, 5.0]}, directory=tmp_path, progress=False)
    assert table["status"].tolist() == ["finished", "failed"]
    assert np.isnan(table["RF3 sum UPPER"][1])
    # the warnings that the program gave before are no reason
    assert re.match(r"error: .*increments", table["message"][1])
    (outcome,) = [path for path in tmp_path.rglob("outcome.json") if "push=5" in path.parent.name]
    written = outcome.stat().st_mtime_ns
    with pytest.warns(UserWarning, match="1 of 2"):
        litz.sweep(model, {"push": [1e-6, 5.0]}, directory=tmp_path, progress=False)
    assert outcome.stat().st_mtime_ns == written
    with pytest.warns(UserWarning, match="1 of 2"):
        litz.sweep(model, {"push": [1e-6, 5.0]}, directory=tmp_path, progress=False, again="failed")
    assert outcome.stat().st_mtime_ns != written


def test_a_run_that_was_interrupted_is_repeated(tmp_path):
    litz.sweep(model, {"push": [1e-6]}, directory=tmp_path, progress=False)
    (outcome,) = tmp_path.rglob("outcome.json")
    outcome.unlink()
    (results,) = tmp_path.rglob("deck.vtkhdf")
    before = results.stat().st_mtime_ns
    litz.sweep(model, {"push": [1e-6]}, directory=tmp_path, progress=False)
    assert results.stat().st_mtime_ns != before


def test_a_mistake_in_the_users_function_is_a_failed_run(tmp_path):
    with pytest.warns(UserWarning, match="ZeroDivisionError"):
        table = litz.sweep(lambda a: {"b": 1 / a}, {"a": [0, 2]}, directory=None, progress=False)
    assert table["status"].tolist() == ["failed", "finished"]
    assert table["b"].tolist()[1] == 0.5


def test_collect_says_what_goes_into_the_table(tmp_path):
    table = litz.sweep(
        model,
        {"push": [1e-6]},
        directory=tmp_path,
        progress=False,
        collect=lambda results: {"force": results.contacts_at(-1)["force"].sum()},
    )
    assert table["force"][0] > 0
    assert "RF3 sum UPPER" not in table
    array = table.to_array()
    assert array["force"][0] == table["force"][0]


def test_a_collect_without_names_is_told_what_it_returns(tmp_path):
    with pytest.warns(UserWarning, match="are numbers by name, as {'force': 1.5}, not ndarray"):
        litz.sweep(
            model,
            {"push": [1e-6]},
            directory=tmp_path,
            progress=False,
            collect=lambda results: results.contacts_at(-1)["force"],
        )


def test_a_line_tells_how_many_runs_are_over(tmp_path, capsys):
    litz.sweep(lambda a: {"b": a}, [{"a": 1}, {"a": 2}], directory=None)
    assert capsys.readouterr().err.startswith("2 of 2 runs, ")


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({}, "one parameter"),
        ({"push": []}, "no values"),
        ({"push": 1.0}, "needs a sequence"),
        ({"push": "abc"}, "needs a sequence"),
        ({"status": [1]}, "may not be called status"),
        ([{"a": 1}, {"b": 1}], "the same parameters"),
        ({"push": [1, 1]}, "two runs"),
    ],
)
def test_parameters_that_make_no_sense_are_refused(parameters, message, tmp_path):
    with pytest.raises(ValueError, match=message):
        litz.sweep(model, parameters, directory=tmp_path)
    assert not list(tmp_path.iterdir())


def test_parameters_that_a_function_does_not_take_are_told_before_any_run(tmp_path):
    with pytest.raises(TypeError, match=r"^model\(.*the parameters pusch: missing a required argument: 'push'"):
        litz.sweep(model, {"pusch": [1e-6]}, directory=tmp_path / "runs")
    assert not list(tmp_path.iterdir())


def test_an_option_that_is_none_is_told_before_any_run(tmp_path):
    with pytest.raises(TypeError, match="no option 'colect'; did you mean 'collect'"):
        litz.sweep(model, {"push": [1e-6]}, directory=tmp_path / "runs", colect=len)
    assert not list(tmp_path.iterdir())


def test_places_and_parameters_of_a_template_must_fit(template, tmp_path):
    with pytest.raises(ValueError, match=r"no place \{yung\}; did you mean 'young'"):
        litz.sweep(template, {"yung": [1], "push": [1]}, directory=tmp_path)
    with pytest.raises(ValueError, match=r"the placeholder \{young\}, for which there is no parameter"):
        litz.sweep(template, {"push": [1]}, directory=tmp_path)
    with pytest.raises(litz.FileError, match=r"missing\.inp"):
        litz.sweep("missing.inp", {"push": [1]}, directory=tmp_path)


# Executors, and what is done with those that run when a sweep is cancelled


def slow_if_deep(push):
    """A model that takes a minute and more if it is pushed by 2e-6 or 4e-6 m."""
    made = model(push)
    if push in (2e-6, 4e-6):
        made.steps.clear()
        step = made.step(total=1.0, increment=1e-6, inc=1000000, direct=True)
        step.move("UPPER", "z", -push)
    return made


@pytest.mark.parametrize("make", [lambda: ThreadPoolExecutor(1), lambda: ProcessPoolExecutor(1, get_context("fork"))])
def test_an_executor_runs_the_models(make, tmp_path):
    with make() as executor:
        table = litz.sweep(model, {"push": [2e-6, 1e-6]}, directory=tmp_path, executor=executor, progress=False)
        # it is the user's, who can go on with it
        assert executor.submit(max, 1, 2).result() == 2
    assert table["push"].tolist() == [2e-6, 1e-6]
    assert table["status"].tolist() == ["finished", "finished"]
    assert table["RF3 sum UPPER"][0] < table["RF3 sum UPPER"][1] < 0
    assert not list(tmp_path.glob("running-*"))


def test_workers_of_dask_run_the_models(tmp_path):
    distributed = pytest.importorskip("distributed")
    with distributed.Client(processes=False, n_workers=1, dashboard_address=None) as client:
        table = litz.sweep(
            lambda push: model(1 * push),
            {"push": [1e-6]},
            directory=tmp_path,
            executor=client.get_executor(),
            progress=False,
        )
    assert table["status"].tolist() == ["finished"]


def test_what_cannot_be_sent_to_workers_is_refused(tmp_path):
    with (
        ProcessPoolExecutor(1, get_context("fork")) as executor,
        pytest.raises(ValueError, match="define them in a module"),
    ):
        litz.sweep(
            lambda push: model(1 * push), {"push": [1e-6]}, directory=tmp_path, executor=executor, progress=False
        )
    with pytest.raises(ValueError, match="an executor has its own number"):
        litz.sweep(model, {"push": [1e-6]}, directory=tmp_path, executor=executor, processes=2)


def test_cancelling_ends_what_runs_and_keeps_what_is_finished(tmp_path, capsys):
    finished = []

    def collect(results):
        finished.append(results)
        if len(finished) == 2:
            raise KeyboardInterrupt
        return {"n": 1}

    start = time.monotonic()
    pushes = {"push": [2e-6, 1e-6, 3e-6, 4e-6]}
    with pytest.raises(KeyboardInterrupt):
        litz.sweep(slow_if_deep, pushes, directory=tmp_path, processes=2, collect=collect)
    assert time.monotonic() - start < 60
    assert capsys.readouterr().err.startswith("1 of 4 runs")
    assert [path.parent.name[:10] for path in tmp_path.rglob("outcome.json")] == ["push=1e-6-"]
    assert not list(tmp_path.glob("running-*"))
    (slow,) = tmp_path.glob("push=2e-6-*")
    # a program that was ended has removed its lock, and writes no more
    assert not list(slow.glob("*.lock"))
    size = (slow / "deck.sta").stat().st_size
    time.sleep(0.5)
    assert (slow / "deck.sta").stat().st_size == size


TERMINATED = """
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import litz
from test_sweeps import slow_if_deep

if __name__ == "__main__":
    with ProcessPoolExecutor(2, get_context(sys.argv[1])) as executor:
        litz.sweep(slow_if_deep, {"push": [2e-6, 4e-6]}, directory=sys.argv[2], executor=executor, progress=False)
"""


def children_of(pid):
    """Processes that a process has started, and those that these have, and so on."""
    found = []
    for task in Path(f"/proc/{pid}/task").iterdir():
        for child in (task / "children").read_text().split():
            found += [int(child), *children_of(int(child))]
    return found


@pytest.mark.slow
@pytest.mark.parametrize("method", ["fork", "spawn"])
@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="/proc lists the processes of a process")
def test_sigterm_ends_the_workers_and_what_they_run(method, tmp_path):
    script = tmp_path / "terminated.py"
    script.write_text(TERMINATED)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), str(TESTS)])}
    command = [sys.executable, script, method, tmp_path / "sweep"]
    with subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True) as process:
        start = time.monotonic()
        while len(list(tmp_path.glob("sweep/*/deck.sta"))) < 2:
            assert process.poll() is None
            assert time.monotonic() - start < 60
            time.sleep(0.1)
        children = children_of(process.pid)
        process.terminate()
        assert process.wait(30) == 128 + signal.SIGTERM
    # two workers, each with a program
    assert len(children) >= 4
    start = time.monotonic()
    while any(Path(f"/proc/{child}").exists() for child in children):
        assert time.monotonic() - start < 20
        time.sleep(0.1)
    assert not list(tmp_path.glob("sweep/running-*"))


def test_a_column_called_runs_stays():
    def count(runs, seed):
        return {"n": 1.0 * runs}

    table = litz.sweep(count, {"runs": [5, 7], "seed": [0, 1]}, directory=None, progress=False)
    means = table.over("seed")
    assert list(means) == ["runs", "finished runs", "n", "n std"]
    assert means["runs"].tolist() == [5, 7]
    assert means["finished runs"].tolist() == [2, 2]
    table = litz.sweep(lambda seed: {"runs": 2.0 + seed}, {"seed": [0, 1]}, directory=None, progress=False)
    assert table.over("seed")["runs"].tolist() == [2.5]
    clash = litz.sweep(lambda seed: {"a": 1.0, "a std": 2.0}, {"seed": [0, 1]}, directory=None, progress=False)
    with pytest.raises(ValueError, match="the table has a column a std"):
        clash.over("seed")


def test_means_over_seeds():
    def noisy(side, seed):
        if seed == 3:
            raise ValueError("bad luck")
        return {"area": side * (1 + seed)}

    with pytest.warns(UserWarning, match="2 of 8 runs failed"):
        table = litz.sweep(noisy, {"side": [1.0, 2.0], "seed": [0, 1, 2, 3]}, directory=None, progress=False)
    means = table.over("seed")
    assert list(means) == ["side", "runs", "area", "area std"]
    assert means["side"].tolist() == [1.0, 2.0]
    assert means["runs"].tolist() == [3, 3]
    # of 1, 2, 3 and of 2, 4, 6
    assert means["area"].tolist() == [2.0, 4.0]
    assert means["area std"].tolist() == [1.0, 2.0]
    assert table.where(table["side"] == 2.0).over("seed", "side")["area"].tolist() == [4.0]
    with pytest.raises(ValueError, match="no parameter 'sede'"):
        table.over("sede")


def test_columns_of_contacts_and_conductances(tmp_path):
    def conducting(push):
        made = litz.Model("crossed")
        properties = {"radius": 1e-3, "material": litz.COPPER, "elements": 5}
        lower = made.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), **properties)
        upper = made.wire("UPPER", (0, -0.05, 2e-3), (0, 0.05, 2e-3), **properties)
        made.contact(lower, upper, conductance=litz.HertzSpot())
        made.fix(lower)
        made.fix(upper, "x", "y", "rotations")
        step = made.step()
        step.move(upper, "z", -push)
        step.potential(lower.start, 1e-3)
        step.potential(upper.start, 0)
        step.electrode_print(lower.start, upper.start)
        return made

    table = litz.sweep(conducting, {"push": [1e-6]}, directory=tmp_path, progress=False)
    ledger = litz.Results(table["directory"][0]).contacts_at(-1)
    assert table["contacts"].tolist() == [1]
    assert table["contact force"].tolist() == ledger["force"].tolist()
    of_electrodes = "LOWER_START to UPPER_START"
    assert table[f"conductance {of_electrodes}"][0] == 1 / table[f"resistance {of_electrodes}"][0]
    assert table.units[f"conductance {of_electrodes}"] == "S"


# Progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


LINES = [
    "heading\n",
    "    1     1    1     4  2.50000E-01  2.50000E-01         0  0.00000E+00\n",
    "    1     2    1     4  9.99000E-01  2.50000E-01         7  1.00000E+00  cut: did not converge\n",
    "    1     2    2     4  5.00000E-01  2.50000E-01         7  1.00000E+00\n",
    "    1     3    1     4  1.00000E+00  5.00000E-01         7  2.00000E+00  a remark\n",
]


def test_a_terminal_has_one_line_that_is_written_over(monkeypatch):
    monkeypatch.setattr(progress_module, "_MIN_INTERVAL", 0.0)
    stream = Terminal()
    shown = Progress(1.0, "wires", stream)
    for line in LINES:
        shown.feed(line)
    shown.close(finished=True)
    versions = stream.getvalue().split("\r")
    assert stream.getvalue().count("\n") == 1
    assert [version[23:27].strip() for version in versions[1:4]] == ["25%", "50%", "100%"]
    assert "7 contacts" in versions[2]
    assert "wires: finished" in versions[-1]


def test_a_log_gets_a_few_lines():
    stream = io.StringIO()
    shown = Progress(1.0, "wires", stream)
    for line in LINES:
        shown.feed(line)
    shown.close(finished=False)
    lines = stream.getvalue().splitlines()
    assert [line.split(",")[0] for line in lines[:2]] == ["wires:  25%", "wires:  50%"]
    assert lines[-1].startswith("wires: gave up after")


def test_a_notebook_gets_a_bar(monkeypatch):
    shown = []

    class Handle:
        def update(self, thing):
            shown.append(thing)

    monkeypatch.setattr(notebook, "place", Handle)
    monkeypatch.setattr(progress_module, "_MIN_INTERVAL", 0.0)
    bar = Progress(1.0, "<wires>")
    for line in LINES:
        bar.feed(line)
    bar.close(finished=True)
    assert '<progress value="0.250"' in shown[0]._repr_html_()
    assert "&lt;wires&gt;: finished" in shown[-1]._repr_html_()
    assert repr(shown[-1]).startswith("<wires>: finished")


def test_a_notebook_gets_a_bar_for_a_sweep(monkeypatch, capsys):
    shown = []

    class Handle:
        def update(self, thing):
            shown.append(thing)

    monkeypatch.setattr(notebook, "place", Handle)
    litz.sweep(lambda side: side**2, {"side": [1.0, 2.0]}, directory=None)
    assert [re.search(r'value="(.*?)"', thing._repr_html_())[1] for thing in shown] == ["0.500", "1.000"]
    assert repr(shown[-1]).startswith("2 of 2 runs")
    assert capsys.readouterr().err == ""


def test_the_time_of_all_steps_is_found_through_includes(inputs, tmp_path):
    assert total_time(inputs / "13_stick_slip.inp") == 4.0
    (tmp_path / "deck.inp").write_text(
        "*STEP\n*Static, direct\n** first, total\n 0.5, 2.5D0\n*INCLUDE, INPUT=step.inp\n"
    )
    (tmp_path / "step.inp").write_text("*STEP\n*STATIC\n*END STEP\n")
    assert total_time(tmp_path / "deck.inp") == 3.5
    assert total_time(tmp_path / "missing.inp") == 0.0


def test_a_run_shows_its_progress(inputs, tmp_path, capsys):
    litz.run(inputs / "08_elastica.inp", output_directory=tmp_path, progress=True)
    told = capsys.readouterr()
    assert told.out == ""
    assert "08_elastica: finished after" in told.err


def test_check_returns_the_model_in_words(inputs, tmp_path):
    assert "21 nodes, 20 elements" in litz.check(inputs / "08_elastica.inp")
    (tmp_path / "bad.inp").write_text("*NODES\n")
    with pytest.raises(litz.InputError, match="did you mean"):
        litz.check(tmp_path / "bad.inp")

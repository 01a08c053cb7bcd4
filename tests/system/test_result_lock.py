"""Several runs of decks of one name into one directory: one at a time writes, the others say who does."""

import os
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import litz as package
from decks import crossed
from same_results import assert_same_numbers

LONG = "0.005, 1, 1e-3, 0.005"


def start(litz_program, deck, output, **options):
    return subprocess.Popen(
        [litz_program, "run", deck, "-o", output, "--threads", "1"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )


@pytest.fixture
def running(litz_program, tmp_path):
    """A run that takes seconds, its deck and its directory; it has taken the lock."""
    deck, output = tmp_path / "deck.inp", tmp_path / "out"
    deck.write_text(crossed(static=LONG).replace("INC=200", "INC=400"))
    process = start(litz_program, deck, output)
    wait_for(output / "deck.lock.part")
    yield process, deck, output
    process.kill()
    process.communicate()


def wait_for(path):
    deadline = time.monotonic() + 30
    while not path.exists() or not path.read_text().endswith("\n"):
        assert time.monotonic() < deadline, f"{path} does not come"
        time.sleep(0.002)


def test_the_second_run_is_refused_and_told_which_process_holds_the_results(running, litz):
    first, deck, output = running
    second = litz("run", deck, "-o", output)
    assert second.returncode == 4
    assert f"another run is writing the results {output}/deck.* (process {first.pid} on " in second.stderr
    assert "choose another directory with -o" in second.stderr
    with pytest.raises(package.FileError, match=f"process {first.pid} on"):
        package.run(deck, output_directory=output)
    first.communicate()
    assert first.returncode == 0
    assert package.Results(output).finished
    assert not list(output.glob("*.part"))


def test_another_directory_and_another_name_are_free(running, litz, tmp_path):
    _, deck, output = running
    other = tmp_path / "other.inp"
    other.write_text(crossed())
    assert litz("run", other, "-o", output).returncode == 0
    deck.write_text(crossed())
    assert litz("run", deck, "-o", tmp_path / "elsewhere").returncode == 0


def test_another_way_to_the_same_directory_is_locked_too(running, litz, tmp_path):
    _, deck, output = running
    (tmp_path / "link").symlink_to(output)
    assert litz("run", deck, "-o", tmp_path / "link").returncode == 4


def test_the_lock_of_a_killed_run_holds_nobody_up(running, litz):
    process, deck, output = running
    process.kill()
    process.communicate()
    assert (output / "deck.lock.part").exists()
    deck.write_text(crossed())
    assert litz("run", deck, "-o", output).returncode == 0
    assert not (output / "deck.lock.part").exists()


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_run_that_is_ended_by_its_user_takes_its_lock_file_away(running, number):
    process, _, output = running
    process.send_signal(number)
    process.communicate(timeout=30)
    # what a shell in the background, or nohup, has its children ignore does not end them
    if number != signal.SIGTERM and process.returncode == 0:
        pytest.skip(f"this session ignores {number.name}")
    assert process.returncode == -number
    assert not (output / "deck.lock.part").exists()


@pytest.mark.parametrize(("change", "code"), [("first increment fails", 2), ("no directory", 4)])
def test_a_run_that_ends_with_an_error_takes_its_lock_file_away(litz, tmp_path, change, code):
    deck = tmp_path / "deck.inp"
    failing = "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n , , , 1\n"
    deck.write_text(crossed(extra=failing if code == 2 else ""))
    output = tmp_path / "out"
    if code == 4:
        (output / "deck.sta").mkdir(parents=True)
    assert litz("run", deck, "-o", output).returncode == code
    assert not list(output.glob("*.lock*"))


def test_of_twenty_runs_at_once_each_has_whole_results_of_its_own_or_is_refused(litz_program, tmp_path):
    """The decks differ, so that files of two runs cannot be mistaken for those of one."""
    output = tmp_path / "out"
    pushes = np.linspace(-1e-4, -2e-4, 20)
    alone = {}
    for i, push in enumerate(pushes):
        (tmp_path / str(i)).mkdir()
        deck = tmp_path / str(i) / "deck.inp"
        deck.write_text(crossed(static="0.1, 1, 1e-3, 0.1", push=repr(float(push))))
    processes = [start(litz_program, tmp_path / str(i) / "deck.inp", output) for i in range(len(pushes))]
    for process in processes:
        _, message = process.communicate(timeout=120)
        assert process.returncode in (0, 4), message
        if process.returncode == 4:
            assert re.search(r"another run is writing the results .*/out/deck\.\* \(process \d+", message), message
        alone[process.pid] = process.returncode
    assert 0 in alone.values()
    results = package.Results(output)
    assert results.finished
    assert not list(output.glob("*.part"))
    # all files are of the run whose deck is in them
    i = int(np.argmin(abs(pushes - results.field("displacement")[results.node_ids == 11][0, 2])))
    assert processes[i].returncode == 0
    subprocess.run(
        [litz_program, "run", tmp_path / str(i) / "deck.inp", "-o", tmp_path / "alone", "--threads", "1"], check=True
    )
    same = package.Results(tmp_path / "alone")
    np.testing.assert_array_equal(results.field("displacement", None), same.field("displacement", None))
    for table in ("contacts", "history", "status", "convergence"):
        rows, others = getattr(results, table), getattr(same, table)
        assert rows.n_rows == others.n_rows
        for column in rows:
            assert_same_numbers(rows[column], others[column])


def test_a_sweep_does_not_keep_that_a_run_was_refused(litz_program, tmp_path):
    """The next sweep runs it; a run that another one has held up has not failed."""
    make = lambda push: crossed(push=repr(push))  # noqa: E731
    first = package.sweep(make, {"push": [-1e-4]}, directory=tmp_path)
    home = next(path for path in tmp_path.iterdir() if path.is_dir())
    assert first["status"].tolist() == ["finished"]
    deck = home / "deck.inp"
    short = deck.read_text()
    deck.write_text(crossed(static=LONG).replace("INC=200", "INC=400"))
    process = start(litz_program, deck, home)
    wait_for(home / "deck.lock.part")
    deck.write_text(short)
    with pytest.warns(UserWarning, match="1 of 1 runs failed"):
        refused = package.sweep(make, {"push": [-1e-4]}, directory=tmp_path, again=True)
    assert "another run is writing the results" in refused["message"][0]
    process.kill()
    process.communicate()
    assert package.sweep(make, {"push": [-1e-4]}, directory=tmp_path)["status"].tolist() == ["finished"]


def test_the_interrupt_of_a_notebook_takes_the_lock_file_away(tmp_path):
    """There the kernel alone gets the interrupt, and ends the program."""
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static=LONG).replace("INC=200", "INC=400"))
    code = f"""
import litz, litz.results, os, pathlib, signal, threading, time
def interrupt():
    while not pathlib.Path({str(tmp_path)!r}, "deck.lock.part").exists():
        time.sleep(0.01)
    os.kill(os.getpid(), signal.SIGINT)
signal.signal(signal.SIGINT, signal.default_int_handler)
threading.Thread(target=interrupt, daemon=True).start()
litz.run({str(deck)!r}, output_directory={str(tmp_path)!r})
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "OMP_NUM_THREADS": "1"},
    )
    assert done.stderr.rstrip().endswith("KeyboardInterrupt"), done.stderr
    assert not (tmp_path / "deck.lock.part").exists()

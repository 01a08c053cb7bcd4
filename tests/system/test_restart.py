"""A run that goes on from a written increment gives the same bits as one that never stopped."""

import os
import resource
import shutil
import signal
import subprocess
import time
import warnings

import h5py
import numpy as np
import pytest

from decks import cantilever, crossed
from litz import Results

KEEP_ALL = "*RESTART, WRITE\n"


def keeping(deck, card=KEEP_ALL):
    """The deck with a card in its first step."""
    return deck.replace("*END STEP", card + "*END STEP", 1)


def written(path):
    """(step, increment) of what a restart file holds."""
    with h5py.File(path, "r") as file:
        return [tuple(row) for row in file["increment"][: file.attrs["n_increments"]].tolist()]


def assert_same_numbers(a, b):
    assert np.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def later_rows(table, step, increment):
    return table.where((table["step"] > step) | ((table["step"] == step) & (table["increment"] > increment)))


def assert_same_end(whole, part, step, increment):
    """Everything after the given increment is the same, to the last bit."""
    start = whole.index(step, increment)
    assert part.steps[0] == step
    assert part.increments[0] == increment
    assert np.array_equal(part.times, whole.times[start:])
    for name in whole.fields:
        assert np.array_equal(part.field(name, None), whole.field(name, None)[start:]), name
    for table in ("contacts", "history", "status", "convergence"):
        a, b = (later_rows(getattr(results, table), step, increment) for results in (whole, part))
        assert list(a) == list(b)
        for column in a:
            assert_same_numbers(a[column], b[column])


def assert_goes_on_from_everywhere(litz, tmp_path, text, *arguments):
    deck = tmp_path / "deck.inp"
    deck.write_text(text)
    done = litz("run", deck, "-o", tmp_path / "whole", "--threads", 1, *arguments)
    assert done.returncode == 0, done.stderr
    whole = Results(tmp_path / "whole")
    kept = written(tmp_path / "whole" / "deck.restart.h5")
    assert len(kept) >= 3
    for step, increment in kept:
        part = tmp_path / f"part_{step}_{increment}"
        place = f"{tmp_path / 'whole' / 'deck.restart.h5'}:{step}:{increment}"
        done = litz("run", deck, "-o", part, "--threads", 1, "--restart", place, *arguments)
        assert done.returncode == 0, done.stderr
        assert_same_end(whole, Results(part), step, increment)


@pytest.mark.parametrize("solver", ["BLOCK", "UMFPACK", "SKYLINE"])
def test_a_restarted_run_equals_the_uninterrupted_one_bit_for_bit(litz, tmp_path, solver):
    """Contacts close, slide over nodes and open; increments are cut and grow."""
    text = crossed(push="-8e-4", static="0.05, 1, 1e-3, 0.3", extra=KEEP_ALL + "*SOLVER, NAME=" + solver)
    text += """\
*STEP, INC=200
*STATIC
 0.2, 1, 1e-3, 0.3
*BOUNDARY
 UPPER_ENDS, 1, 1, 0.012
 UPPER_ENDS, 3, 3, -2e-4
*END STEP
*STEP, INC=200
*STATIC
 0.5, 1
*BOUNDARY
 UPPER_ENDS, 3, 3, 1e-4
*END STEP
"""
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_an_interference_fit_and_single_rotations_go_on(litz, tmp_path):
    text = crossed(height="1.9e-3", pair=", INTERFERENCE FIT", push="0", static="0.25, 1, 1e-3, 0.25", extra=KEEP_ALL)
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_large_rotations_amplitudes_and_loads_go_on(litz, tmp_path):
    ramp = "*AMPLITUDE, NAME=WAVE, TIME=TOTAL TIME\n 0, 0, 0.7, 1, 1.6, -1, 2, 0\n"
    text = ramp + cantilever(
        KEEP_ALL + "*BOUNDARY, AMPLITUDE=WAVE\n 11, 6, 6, 4.0\n*CLOAD\n 6, 3, 0.5",
        "*CLOAD, AMPLITUDE=WAVE\n 6, 2, 1.0",
        static="0.2, 1, 1e-3, 0.4",
    )
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_a_run_that_goes_on_can_itself_be_continued(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.2, 1, 1e-3, 0.2", extra=KEEP_ALL))
    restart = []
    for name, increment in (("whole", 2), ("first", 4), ("second", 5)):
        done = litz("run", deck, "-o", tmp_path / name, "--threads", 1, *restart)
        assert done.returncode == 0, done.stderr
        restart = ["--restart", f"{tmp_path / name / 'deck.restart.h5'}:1:{increment}"]
    assert written(tmp_path / "first" / "deck.restart.h5") == [(1, 3), (1, 4), (1, 5)]
    assert_same_end(Results(tmp_path / "whole"), Results(tmp_path / "second"), 1, 4)


def test_every_nth_increment_and_the_last_of_a_step_are_kept(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    step = "*CLOAD\n 6, 3, 0.5"
    deck.write_text(
        cantilever("*RESTART, WRITE, FREQUENCY=3\n" + step, step, "*RESTART\n" + step, static="0.2, 1, 1e-3, 0.2")
    )
    done = litz("run", deck, "-o", tmp_path)
    assert done.returncode == 0, done.stderr
    assert written(tmp_path / "deck.restart.h5") == [(1, 3), (1, 5), (2, 3), (2, 5)]


@pytest.fixture
def kept(litz, tmp_path):
    """A deck, and a restart file of its run."""
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.5, 1", extra=KEEP_ALL))
    assert litz("run", deck, "-o", tmp_path / "first").returncode == 0
    return deck, tmp_path / "first" / "deck.restart.h5"


def refused(litz, deck, place, code, *words):
    output = deck.parent / "refused"
    done = litz("run", deck, "-o", output, "--restart", place)
    assert done.returncode == code, done.stderr
    for word in words:
        assert word in done.stderr
    assert not list(output.glob("*")) if output.exists() else True


def test_what_cannot_be_continued_is_refused_in_words(litz, kept, tmp_path):
    deck, path = kept
    refused(litz, deck, f"{path}:1:7", 1, "no increment 1:7", "it has 1:1 1:2")
    refused(litz, deck, tmp_path / "missing.h5", 4, "missing.h5", "does not exist")
    (tmp_path / "text.h5").write_text("text")
    refused(litz, deck, tmp_path / "text.h5", 4, "text.h5", "not an HDF5 file")
    refused(litz, deck, tmp_path / "first" / "deck.vtkhdf", 4, "not a restart file")
    text = deck.read_text()
    deck.write_text(text.replace("13, 0, -0.005,", "13, 0, -0.0051,"))
    refused(litz, deck, path, 1, "another mesh")
    deck.write_text(text.replace("UPPER_ENDS, 4, 6", "UPPER_ENDS, 4, 5"))
    refused_here = litz("run", deck, "-o", tmp_path / "refused", "--restart", f"{path}:1:1")
    assert refused_here.returncode == 1
    assert "supports" in refused_here.stderr


def test_the_results_that_are_continued_are_not_overwritten(litz, kept):
    deck, path = kept
    before = {file.name: file.read_bytes() for file in path.parent.iterdir()}
    done = litz("run", deck, "-o", path.parent, "--restart", path)
    assert done.returncode == 4
    assert "would be overwritten" in done.stderr
    assert {file.name: file.read_bytes() for file in path.parent.iterdir()} == before


# Kills, full disks

KILL_AT_WRITE = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <unistd.h>
/* Ends the program like kill -9 just before its n-th write to an HDF5 file, or counts these writes. */
static long n = 0;
ssize_t pwrite(int file, const void *buffer, size_t size, off_t offset)
{
   static ssize_t (*real)(int, const void *, size_t, off_t) = NULL;
   if (!real) real = (ssize_t (*)(int, const void *, size_t, off_t))dlsym(RTLD_NEXT, "pwrite64");
   const char *at = getenv("KILL_AT");
   n++;
   if (at && n == atol(at)) kill(getpid(), SIGKILL);
   return real(file, buffer, size, offset);
}
ssize_t pwrite64(int file, const void *buffer, size_t size, off_t offset) { return pwrite(file, buffer, size, offset); }
__attribute__((destructor)) static void report(void)
{
   const char *path = getenv("KILL_COUNT");
   FILE *out = path ? fopen(path, "w") : NULL;
   if (out) { fprintf(out, "%ld\n", n); fclose(out); }
}
"""


@pytest.fixture(scope="module")
def kill_at_write(tmp_path_factory):
    """Environment under which the program dies at its n-th write to an HDF5 file."""
    directory = tmp_path_factory.mktemp("kill")
    compiler = shutil.which("gcc") or pytest.skip("no C compiler")
    (directory / "kill.c").write_text(KILL_AT_WRITE)
    subprocess.run(
        [compiler, "-shared", "-fPIC", "-o", directory / "kill.so", directory / "kill.c", "-ldl"], check=True
    )

    def environment(at=None, count=None):
        added = {"LD_PRELOAD": str(directory / "kill.so")}
        added |= {"KILL_AT": str(at)} if at else {}
        return os.environ | added | ({"KILL_COUNT": str(count)} if count else {})

    return environment


def readable(directory, reference):
    """Read all there is of the files a killed run has left; return the number of its increments."""
    n = 0
    if (directory / "deck.vtkhdf").exists():
        with warnings.catch_warnings():
            # a run may have finished before it was killed
            warnings.filterwarnings("ignore", message=".*did not finish")
            part = Results(directory)
        n = len(part.times)
        assert np.array_equal(part.times, reference.times[:n])
        for name in ("displacement", "potential", "joule_heat"):
            assert np.array_equal(part.field(name, None), reference.field(name, None)[:n])
        for table in ("contacts", "history", "status", "convergence"):
            rows = getattr(part, table)
            for column in rows:
                assert_same_numbers(rows[column], getattr(reference, table)[column][: rows.n_rows])
    if (directory / "deck_contacts.vtkhdf").exists():
        with h5py.File(directory / "deck_contacts.vtkhdf", "r") as file:
            times = file["VTKHDF/Steps/Values"][: file["VTKHDF/Steps"].attrs["NSteps"]]
            assert np.array_equal(times, reference.times[: len(times)])
            rows = file["VTKHDF/NumberOfPoints"][: len(times)].sum()
            assert len(file["VTKHDF/PointData/force"][:rows]) == rows
    return n


def test_a_run_killed_at_any_write_leaves_files_that_are_whole_and_can_be_continued(litz, tmp_path, kill_at_write):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.1, 1, 1e-3, 0.1", extra=KEEP_ALL))
    count = tmp_path / "count"
    done = litz("run", deck, "-o", tmp_path / "whole", "--threads", 1, env=kill_at_write(count=count))
    assert done.returncode == 0, done.stderr
    whole = Results(tmp_path / "whole")
    n_writes = int(count.read_text())
    assert n_writes > 500
    reached = set()
    # a stride that is prime to the writes of an increment meets all of its places in turn
    for at in range(1, n_writes + 1, 23):
        killed = tmp_path / "killed"
        shutil.rmtree(killed, ignore_errors=True)
        done = litz("run", deck, "-o", killed, "--threads", 1, env=kill_at_write(at=at))
        assert done.returncode == -signal.SIGKILL
        reached.add(readable(killed, whole))
        if (killed / "deck.restart.h5").exists():
            last = written(killed / "deck.restart.h5")[-1]
            if at % 5 == 0:
                shutil.rmtree(tmp_path / "on", ignore_errors=True)
                done = litz("run", deck, "-o", tmp_path / "on", "--threads", 1, "--restart", killed / "deck.restart.h5")
                assert done.returncode == 0, done.stderr
                assert_same_end(whole, Results(tmp_path / "on"), *last)
    assert len(reached) > 5


def test_a_run_killed_at_any_time_leaves_files_that_are_whole(litz_program, litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.02, 1, 1e-3, 0.02", extra=KEEP_ALL))
    start = time.monotonic()
    assert litz("run", deck, "-o", tmp_path / "whole", "--threads", 1).returncode == 0
    duration = time.monotonic() - start
    whole = Results(tmp_path / "whole")
    random = np.random.default_rng(5)
    for delay in random.uniform(0, duration, 30):
        killed = tmp_path / "killed"
        shutil.rmtree(killed, ignore_errors=True)
        process = subprocess.Popen(
            [litz_program, "run", deck, "-o", killed, "--threads", "1"], stdout=subprocess.DEVNULL
        )
        time.sleep(delay)
        process.kill()
        process.wait()
        readable(killed, whole)
        if (killed / "deck.restart.h5").exists():
            assert written(killed / "deck.restart.h5")


def test_an_older_result_stays_whole_until_the_new_one_has_an_increment(litz, tmp_path, kill_at_write):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.5, 1", extra=KEEP_ALL))
    assert litz("run", deck, "-o", tmp_path / "out").returncode == 0
    before = {path.name: path.read_bytes() for path in (tmp_path / "out").glob("deck*.vtkhdf")}
    assert litz("run", deck, "-o", tmp_path / "out", env=kill_at_write(at=10)).returncode == -signal.SIGKILL
    assert {path.name: path.read_bytes() for path in (tmp_path / "out").glob("deck*.vtkhdf")} == before


@pytest.mark.parametrize("kilobytes", [30, 100, 200, 400, 800])
def test_a_full_disk_leaves_what_fits_and_says_so(litz_program, tmp_path, kilobytes):
    """A limit on the size of files stands for the disk."""
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.02, 1, 1e-3, 0.02", extra=KEEP_ALL))

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (kilobytes * 1024,) * 2)

    done = subprocess.run(
        [litz_program, "run", deck, "-o", tmp_path / "out"],
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=limit,
    )
    assert done.returncode == 4
    assert "is the disk full?" in done.stderr
    assert "HDF5-DIAG" not in done.stderr
    assert not list((tmp_path / "out").glob("*.part"))
    if (tmp_path / "out" / "deck.restart.h5").exists():
        last = written(tmp_path / "out" / "deck.restart.h5")[-1]
        on = subprocess.run(
            [litz_program, "run", deck, "-o", tmp_path / "on", "--restart", tmp_path / "out" / "deck.restart.h5"],
            capture_output=True,
            text=True,
            check=False,
        )
        assert on.returncode == 0, on.stderr
        assert (Results(tmp_path / "on").steps[0], Results(tmp_path / "on").increments[0]) == last

"""Runs that are killed or run out of disk, and results of an earlier run in the same place."""

import os
import resource
import shutil
import signal
import subprocess
import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import h5py
import numpy as np
import pytest

from decks import crossed
from litz import Results
from same_results import KEEP_ALL, assert_same_end, assert_same_numbers, written

#: Writes to HDF5 files and lines of tables count alike
KILL_AT_WRITE = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <unistd.h>
/* Ends the program like kill -9 just before its n-th write to an HDF5 file, flush of a table or renaming, or counts
   these. */
static long n = 0;
static void count(void)
{
   const char *at = getenv("KILL_AT");
   n++;
   if (at && n == atol(at)) kill(getpid(), SIGKILL);
}
int fflush(FILE *file)
{
   static int (*real)(FILE *) = NULL;
   if (!real) real = (int (*)(FILE *))dlsym(RTLD_NEXT, "fflush");
   if (file) count();
   return real(file);
}
int rename(const char *old, const char *new)
{
   static int (*real)(const char *, const char *) = NULL;
   if (!real) real = (int (*)(const char *, const char *))dlsym(RTLD_NEXT, "rename");
   count();
   return real(old, new);
}
ssize_t pwrite(int file, const void *buffer, size_t size, off_t offset)
{
   static ssize_t (*real)(int, const void *, size_t, off_t) = NULL;
   if (!real) real = (ssize_t (*)(int, const void *, size_t, off_t))dlsym(RTLD_NEXT, "pwrite64");
   count();
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


def two_at_a_time(run, places, tmp_path):
    """The places with what `run(place, directory)` returns and the directory, which is removed after each.

    The runs go on while the results of those before are looked at.
    """
    directories = [tmp_path / f"run_{k}" for k in range(len(places))]
    with ThreadPoolExecutor(2) as pool:
        for place, done, directory in zip(places, pool.map(run, places, directories), directories, strict=True):
            yield place, done, directory
            shutil.rmtree(directory, ignore_errors=True)


class Whole:
    """What a run that ended as it should has written, read once."""

    FIELDS = ("displacement", "potential", "joule_heat")
    TABLES = ("contacts", "history", "status", "convergence")

    def __init__(self, directory):
        self.results = Results(directory)
        self.times = self.results.times
        self.fields = {name: self.results.field(name, None) for name in self.FIELDS}
        self.tables = {name: getattr(self.results, name) for name in self.TABLES}
        self.forces = [self.results.contacts_at(k)["force"] for k in range(len(self.times))]


def increments_of(path):
    """Times in the whole lines of a table, each once."""
    lines = path.read_text().rpartition("\n")[0].splitlines()
    heads = lines[0].split("," if path.suffix == ".csv" else None)
    column = heads.index(next(head for head in heads if head.startswith("time")))
    cells = [line.split("," if path.suffix == ".csv" else None) for line in lines[1:]]
    return list(dict.fromkeys(float(row[column]) for row in cells if not row[-1].startswith("cut")))


def assert_in_step(directory, part, whole):
    """No table is ahead of the fields, none is more than one increment behind; read together they agree."""
    with h5py.File(directory / "deck.vtkhdf", "r") as file:
        times = file["VTKHDF/Steps/Values"][: file["VTKHDF/Steps"].attrs["NSteps"]].tolist()
    history, status = increments_of(directory / "deck_history.csv"), increments_of(directory / "deck.sta")
    contacts = increments_of(directory / "deck_contacts.csv")
    # the fields and the history begin with the start of the run
    assert len(times) >= len(history) >= len(status) + 1 >= len(times) - 1
    assert len(times) - 1 >= len(contacts) >= len(status)
    n = len(part.times)
    assert n == min(len(times), len(status) + 1)
    assert part.history["time"].tolist() == part.times.tolist()
    assert part.status["time"].tolist() == pytest.approx(part.times.tolist()[1:], rel=1e-6)
    assert part.contacts.n_rows == sum(map(len, whole.forces[:n]))
    for k, force in enumerate(whole.forces[:n]):
        assert_same_numbers(part.contacts_at(k)["force"], force)


def readable(directory, whole):
    """Read all there is of the files a killed run has left; return the number of its increments."""
    n = 0
    if (directory / "deck.vtkhdf").exists():
        with warnings.catch_warnings():
            # a run may have finished before it was killed
            warnings.filterwarnings("ignore", message=".*did not finish")
            part = Results(directory)
        n = len(part.times)
        assert np.array_equal(part.times, whole.times[:n])
        for name, values in whole.fields.items():
            assert np.array_equal(part.field(name, None), values[:n])
        for name, table in whole.tables.items():
            rows = getattr(part, name)
            for column in rows:
                assert_same_numbers(rows[column], table[column][: rows.n_rows])
        assert_in_step(directory, part, whole)
    if (directory / "deck_contacts.vtkhdf").exists():
        with h5py.File(directory / "deck_contacts.vtkhdf", "r") as file:
            times = file["VTKHDF/Steps/Values"][: file["VTKHDF/Steps"].attrs["NSteps"]]
            assert np.array_equal(times, whole.times[: len(times)])
            rows = file["VTKHDF/NumberOfPoints"][: len(times)].sum()
            assert len(file["VTKHDF/PointData/force"][:rows]) == rows
    return n


@pytest.mark.slow
def test_a_run_killed_at_any_write_leaves_files_that_are_whole_and_can_be_continued(litz, tmp_path, kill_at_write):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.1, 1, 1e-3, 0.1", extra=KEEP_ALL))
    count = tmp_path / "count"
    done = litz("run", deck, "-o", tmp_path / "whole", "--threads", 1, env=kill_at_write(count=count))
    assert done.returncode == 0, done.stderr
    whole = Whole(tmp_path / "whole")
    n_writes = int(count.read_text())
    assert n_writes > 500
    reached = set()

    def run(at, directory):
        return litz("run", deck, "-o", directory, "--threads", 1, env=kill_at_write(at=at))

    # a stride that is prime to the writes of an increment meets all of its places in turn
    for at, done, killed in two_at_a_time(run, range(1, n_writes + 1, 23), tmp_path):
        assert done.returncode == -signal.SIGKILL
        reached.add(readable(killed, whole))
        if (killed / "deck.restart.h5").exists():
            last = written(killed / "deck.restart.h5")[-1]
            if at % 5 == 0:
                shutil.rmtree(tmp_path / "on", ignore_errors=True)
                on = litz("run", deck, "-o", tmp_path / "on", "--threads", 1, "--restart", killed / "deck.restart.h5")
                assert on.returncode == 0, on.stderr
                assert_same_end(whole.results, Results(tmp_path / "on"), *last)
    assert len(reached) > 5


@pytest.mark.slow
def test_a_run_killed_at_any_time_leaves_files_that_are_whole(litz_program, litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.02, 1, 1e-3, 0.02", extra=KEEP_ALL))
    start = time.monotonic()
    assert litz("run", deck, "-o", tmp_path / "whole", "--threads", 1).returncode == 0
    duration = time.monotonic() - start
    whole = Whole(tmp_path / "whole")
    random = np.random.default_rng(5)

    def run(delay, directory):
        process = subprocess.Popen(
            [litz_program, "run", deck, "-o", directory, "--threads", "1"], stdout=subprocess.DEVNULL
        )
        time.sleep(delay)
        process.kill()
        process.wait()

    for _, _, killed in two_at_a_time(run, random.uniform(0, duration, 30), tmp_path):
        readable(killed, whole)
        if (killed / "deck.restart.h5").exists():
            assert written(killed / "deck.restart.h5")


#: All files of a run that are there from its first increment on
FILES = ("deck.vtkhdf", "deck_contacts.vtkhdf", "deck_contacts.csv", "deck_history.csv", "deck.sta", "deck.cvg")


def contents(directory):
    return {path.name: path.read_bytes() for path in directory.iterdir() if path.suffix != ".part"}


@pytest.fixture
def older(litz, tmp_path):
    """The deck and the directory of an earlier run."""
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.5, 1", extra=KEEP_ALL))
    assert litz("run", deck, "-o", tmp_path / "out").returncode == 0
    return deck, tmp_path / "out"


@pytest.mark.slow
def test_older_results_stay_whole_until_the_new_run_has_an_increment_and_then_all_are_new(
    litz, older, tmp_path, kill_at_write
):
    deck, output = older
    before = contents(output)
    kept = killed = 0
    for at in range(1, 10_000, 17):
        done = litz("run", deck, "-o", output, env=kill_at_write(at=at))
        assert done.returncode == -signal.SIGKILL
        now = contents(output)
        # the last file to be renamed
        if now.get("deck.vtkhdf", before["deck.vtkhdf"]) != before["deck.vtkhdf"]:
            break
        killed += 1
        kept += now == before
        # no new tables beside older fields
        assert now == before or "deck.vtkhdf" not in now
    # one kill may fall between the renamings of six files, which follow each other without other writes
    assert killed - kept <= 1
    # the header, the datasets, and the state that the run starts from take more writes than that
    assert kept > 10
    with pytest.warns(UserWarning, match="did not finish|still runs"):
        results = Results(output)
    assert results.status.n_rows == 1
    assert all((output / name).read_bytes() != before[name] for name in FILES)


def failing(deck):
    """The same deck with a first increment that cannot converge."""
    more = "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n , , , 1\n"
    deck.write_text(deck.read_text().replace(" 0.5, 1\n", " 0.5, 1, 0.4\n" + more))


def test_a_run_that_fails_in_its_first_increment_leaves_older_results_and_says_where_its_tables_are(litz, older):
    deck, output = older
    before = contents(output)
    good = deck.read_text()
    failing(deck)
    done = litz("run", deck, "-o", output)
    assert done.returncode == 2
    assert "results of an earlier run stay as they are" in done.stderr
    assert "deck_unconverged.sta and .cvg" in done.stderr
    after = contents(output)
    assert {name: after.pop(name) for name in before} == before
    assert b"force_allowed" in after["deck_unconverged.cvg"]
    assert len(after["deck_unconverged.sta"].splitlines()) > 1
    assert not list(output.glob("*.part"))
    deck.write_text(good)
    assert litz("run", deck, "-o", output).returncode == 0
    assert not list(output.glob("*unconverged*"))


def test_a_run_that_fails_in_its_first_increment_without_older_results_shows_where_it_began(litz, older, tmp_path):
    deck, _ = older
    failing(deck)
    done = litz("run", deck, "-o", tmp_path / "new")
    assert done.returncode == 2
    assert "earlier run" not in done.stderr
    with pytest.warns(UserWarning, match="did not finish"):
        results = Results(tmp_path / "new")
    assert results.times.tolist() == [0]
    assert results.convergence.n_rows > 0


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


@pytest.mark.slow
def test_whatever_fits_on_the_disk_can_be_read(litz_program, litz, tmp_path):
    """Files end at many places, also in the middle of what HDF5 writes at once."""
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.02, 1, 1e-3, 0.02", extra=KEEP_ALL))
    assert litz("run", deck, "-o", tmp_path / "whole").returncode == 0
    whole = Whole(tmp_path / "whole")
    reached = set()

    def run(kilobytes, directory):
        # by the shell: Python's own way is not safe in threads
        limited = ["bash", "-c", f'ulimit -f {kilobytes} && exec "$@"', "limited"]
        return subprocess.run(
            [*limited, litz_program, "run", deck, "-o", directory], capture_output=True, text=True, check=False
        )

    for _, done, output in two_at_a_time(run, range(40, 1420, 20), tmp_path):
        assert done.returncode == 4
        reached.add(readable(output, whole))
        if (output / "deck.restart.h5").exists():
            assert written(output / "deck.restart.h5")
    assert len(reached) > 3, reached


@pytest.fixture
def small_disk(tmp_path):
    """Mount an empty file system of so many kilobytes."""
    if os.geteuid() != 0:
        pytest.skip("only root may mount a file system of its own")
    place = tmp_path / "disk"
    place.mkdir()
    mounted = []

    def mount(kilobytes):
        done = subprocess.run(
            ["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", place],
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode != 0:
            pytest.skip(f"no file system can be mounted here: {done.stderr.strip()}")
        mounted.append(place)
        return place

    yield mount
    for directory in mounted:
        subprocess.run(["umount", directory], check=True)


@pytest.mark.parametrize("kilobytes", [100, 400, 2000])
def test_a_file_system_that_is_full_ends_the_run_in_words_and_keeps_what_was_whole(
    litz, small_disk, tmp_path, kilobytes
):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.02, 1, 1e-3, 0.02", extra=KEEP_ALL))
    assert litz("run", deck, "-o", tmp_path / "whole").returncode == 0
    disk = small_disk(kilobytes)
    done = litz("run", deck, "-o", disk)
    assert done.returncode == 4
    assert "is the disk full?" in done.stderr
    assert "HDF5-DIAG" not in done.stderr
    assert not list(disk.glob("*.part"))
    if kilobytes >= 2000:
        assert readable(disk, Whole(tmp_path / "whole")) > 1


def test_a_file_system_without_room_for_a_second_run_keeps_the_first(litz, small_disk, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(static="0.5, 1"))
    disk = small_disk(4000)
    assert litz("run", deck, "-o", disk).returncode == 0
    used = sum(path.stat().st_blocks for path in disk.iterdir()) * 512
    with (disk / "other").open("wb") as file:
        file.truncate(0)
        os.posix_fallocate(file.fileno(), 0, shutil.disk_usage(disk).free - used // 2)
    before = contents(disk)
    done = litz("run", deck, "-o", disk)
    assert done.returncode == 4
    assert "is the disk full?" in done.stderr
    after = contents(disk)
    assert {name: after[name] for name in before} == before
    assert not list(disk.glob("*.part"))

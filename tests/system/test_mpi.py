"""`litz-mpi`: the first process runs the deck, all factor its matrices. On any number of them the answers are the same."""

import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

from decks import cantilever
from litz import Results
from same_results import KEEP_ALL, keeping, written

#: Factorisations on several processes add in another order: round-off, in histories and in fields beside their largest
#: value, after an iteration that contracts it
HISTORY, FIELD = 1e-10, 1e-9


@pytest.fixture(scope="module")
def mpirun(litz_program):
    """`mpirun(2, program)` is the command line of a program on so many processes."""
    found = shutil.which("mpirun")
    if found is None:
        pytest.skip("there is no mpirun (Debian package openmpi-bin)")
    rules = litz_program.resolve().parents[1] / "build.ninja"
    if not (rules.is_file() and "build fortran/litz-mpi:" in rules.read_text()):
        pytest.skip("built without litz-mpi (-Dmpi=enabled, Debian packages libmumps-dev, libopenmpi-dev)")

    def command(ranks, *words):
        as_root = ["--allow-run-as-root"] if os.geteuid() == 0 else []
        return [found, "--oversubscribe", *as_root, "-n", str(ranks), *map(str, words)]

    return command


@pytest.fixture(scope="module")
def mpi_command(mpirun, build_target):
    """`mpi_command(2, "run", deck)` is the command line of `litz-mpi`."""
    program = build_target("fortran/litz-mpi")
    return lambda ranks, *words: mpirun(ranks, program, *words)


@pytest.fixture
def mpi(mpi_command):
    def run(ranks, *words):
        return subprocess.run(
            mpi_command(ranks, *words), capture_output=True, text=True, check=False, timeout=300, env=one_thread()
        )

    return run


def one_thread():
    return os.environ | {"OMP_NUM_THREADS": "1"}


def kind(column):
    """`RF` of `RF1 node 11`; energies are of one kind, as `ETOTAL` is what is left of the others."""
    name = column.split()[0].rstrip("0123456789")
    return "energy" if name == "ETOTAL" or name.startswith("ALL") else name


def accepted(status, column):
    """Values of the increments that have converged. Iterations that lead nowhere end sooner or later by round-off."""
    return [value for value, remark in zip(status[column], status["remark"], strict=True) if "cut" not in remark]


def assert_same_answers(found, expected):
    for column in ("iterations", "attempts", "negative_pivots", "contacts"):
        assert accepted(found.status, column) == accepted(expected.status, column) != [], column
    for name in expected.history:
        # forces that are zero are round-off of those of the other components
        scale = max(
            np.nanmax(np.abs(expected.history[other])) for other in expected.history if kind(other) == kind(name)
        )
        np.testing.assert_allclose(
            found.history[name], expected.history[name], rtol=0, atol=HISTORY * scale, err_msg=name
        )
    for name in ("displacement", "rotation", "potential"):
        field = expected.field(name, None)
        np.testing.assert_allclose(
            found.field(name, None), field, rtol=0, atol=FIELD * np.abs(field).max(), err_msg=name
        )


@pytest.mark.parametrize(
    "name", ["04_wire_grid", *(pytest.param(name, marks=pytest.mark.slow) for name in ("08_elastica", "17_knot"))]
)
def test_one_two_and_four_processes_give_the_same_answers(mpi, inputs, tmp_path, name):
    results = {}
    for ranks in (1, 2, 4):
        done = mpi(ranks, "run", inputs / f"{name}.inp", "--quiet", "-o", tmp_path / str(ranks))
        assert done.returncode == 0, done.stderr
        results[ranks] = Results(tmp_path / str(ranks))
    for ranks in (2, 4):
        assert_same_answers(results[ranks], results[1])


def test_a_run_goes_on_with_another_number_of_processes(mpi, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(keeping(cantilever("*CLOAD\n 11, 3, -50.", static="0.25, 1"), KEEP_ALL))
    done = mpi(2, "run", deck, "--quiet", "-o", tmp_path / "whole")
    assert done.returncode == 0, done.stderr
    kept = tmp_path / "whole" / "deck.restart.h5"
    step, increment = written(kept)[1]
    done = mpi(4, "run", deck, "--quiet", "-o", tmp_path / "part", "--restart", f"{kept}:{step}:{increment}")
    assert done.returncode == 0, done.stderr
    whole, part = (Results(tmp_path / name).field("displacement") for name in ("whole", "part"))
    np.testing.assert_allclose(part, whole, rtol=0, atol=FIELD * np.abs(whole).max())


def test_an_error_ends_all_processes_with_its_message_and_exit_code(mpi, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text("*NONSENSE\n")
    done = mpi(2, "run", deck)
    assert done.returncode == 1
    assert done.stderr.count("NONSENSE") >= 1
    deck.write_text(cantilever("*CLOAD\n 11, 3, -1e9", static="1, 1, 1, 1"))
    one, two = (mpi(ranks, "run", deck, "--quiet", "-o", tmp_path / str(ranks)) for ranks in (1, 2))
    assert one.returncode == two.returncode == 2, two.stderr
    message = one.stderr.splitlines()[0]
    assert message.startswith("error: step 1, increment 1")
    assert two.stderr.splitlines()[0] == message.replace(str(tmp_path / "1"), str(tmp_path / "2"))


def test_a_process_that_is_killed_ends_all(mpi_command, inputs, tmp_path):
    """None waits for ever for one that is no longer there."""
    words = mpi_command(2, "run", inputs / "11_fibre_mat.inp", "--quiet", "-o", tmp_path)
    with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=one_thread()) as mpirun:
        children = Path(f"/proc/{mpirun.pid}/task/{mpirun.pid}/children")
        processes = []
        deadline = time.monotonic() + 60
        while len(processes) < 2 and time.monotonic() < deadline:
            time.sleep(0.1)
            processes = children.read_text().split()
        time.sleep(1)
        os.kill(int(processes[-1]), signal.SIGKILL)
        assert mpirun.wait(timeout=60) != 0


def test_the_contact_search_over_processes_finds_the_pairs_of_one(mpirun, build_target):
    """Each process has the elements of its share and those within their reach; the program fails where pairs differ."""
    program = build_target("tests/search_over_processes")
    found = {}
    for ranks in (1, 2, 4):
        done = subprocess.run(
            mpirun(ranks, program), capture_output=True, text=True, check=True, timeout=120, env=one_thread()
        )
        found[ranks], *shares = map(int, done.stdout.partition(":")[2].split())
        assert len(shares) == ranks
        assert sum(shares) == found[ranks]
        assert min(shares) > 0
    assert found[1] == found[2] == found[4] > 100_000


def test_sums_and_maxima_over_a_model_in_shares_are_those_of_the_whole_one(mpirun, build_target, tmp_path):
    """Each process has its share of elements, contacts and nodes; the program fails where an answer is another one."""
    program = build_target("tests/model_over_processes")
    for ranks in (1, 2, 4):
        done = subprocess.run(
            mpirun(ranks, program),
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
            env=one_thread(),
            cwd=tmp_path,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        whole, *shares = map(int, done.stdout.partition(":")[2].split())
        contacts, nodes = shares[:ranks], shares[ranks:]
        assert sum(contacts) == whole > 4
        # some are shared
        assert sum(nodes) > 70 or ranks == 1
        assert max(nodes) < 70 or ranks == 1

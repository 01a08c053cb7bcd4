"""Limits of size and memory end in words, and decks of many or long entries are read in a time proportional to them."""

import os
import re
import resource
import subprocess
from pathlib import Path

import pytest

INPUTS = Path(__file__).parents[2] / "inputs"
GRID = (INPUTS / "04_wire_grid.inp").read_text()
EXIT_MEMORY = 6


def with_cards(cards, before="*MATERIAL"):
    """The deck of the wire grid with more cards in front of a keyword."""
    return GRID.replace(before, cards + before, 1)


def doubling_sets(n):
    """Each set names the one before twice."""
    sets = "*NSET, NSET=D0\n LOWER1\n"
    return sets + "".join(f"*NSET, NSET=D{i + 1}\n D{i}, D{i}\n" for i in range(n))


LARGE = {
    "sets that name others twice": (with_cards(doubling_sets(60)), 0),
    "a set that names itself": (with_cards("*NSET, NSET=A\n 101\n" + "*NSET, NSET=A\n A, LOWER1, A\n" * 20000), 0),
    "ranges over all numbers": (with_cards("*NSET, NSET=G, GENERATE\n" + " 1, 2147483647, 1\n" * 20000), 0),
    "many sets": (with_cards("".join(f"*NSET, NSET=S{i}\n 101\n" for i in range(20000))), 0),
    "a long data line": (with_cards("*NSET, NSET=L\n" + "101," * 500000 + "101\n"), 0),
    "a long keyword line": (with_cards("*NSET" + ", A=1" * 100000 + "\n"), 1),
    "a long name": (with_cards("*NSET, NSET=" + "A" * 1000000 + "\n 101\n"), 1),
    "a long heading": ("*HEADING\n" + "words\n" * 100000 + GRID, 0),
    "a long title": (GRID.replace("*STATIC", "words\n" * 100000 + "*STATIC", 1), 0),
    "many interactions": (with_cards("".join(f"*SURFACE INTERACTION, NAME=A{i}\n" for i in range(20000))), 1),
    "many requests": (GRID.replace("*END STEP", "*NODE PRINT, NSET=LOWER1\n U\n" * 10000 + "*END STEP", 1), 0),
    "many steps": (GRID + "*STEP\n*STATIC\n*END STEP\n" * 3000, 0),
    "the largest number of increments": (GRID.replace("*STEP", "*STEP, INC=2147483647", 1), 0),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", LARGE)
def test_large_decks_need_seconds_and_little_memory(litz_program, tmp_path, name):
    """1 GB of addresses, of which OpenBLAS and the libraries take a half, and 20 s, which quadratic work exceeds."""
    text, code = LARGE[name]
    (tmp_path / "deck.inp").write_text(text)
    done = limited(litz_program, 1000, "check", tmp_path / "deck.inp", timeout=20)
    assert done.returncode == code, done.stderr[:2000]


def limited(program, megabytes, *arguments, timeout=60):
    """The program with so many megabytes of addresses, code and libraries included."""

    def limit():
        if "LITZ_TEST_NO_MEMORY_LIMIT" not in os.environ:
            resource.setrlimit(resource.RLIMIT_AS, (megabytes * 10**6,) * 2)

    return subprocess.run(
        [program, *map(str, arguments)], preexec_fn=limit, capture_output=True, text=True, timeout=timeout, check=False,
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"},
    )  # fmt: skip


@pytest.fixture(scope="module")
def long_wire(tmp_path_factory):
    """A wire of 100 000 elements."""
    n = 100_000
    path = tmp_path_factory.mktemp("long") / "wire.inp"
    nodes = "".join(f"{i + 1}, {i}e-3, 0, 0\n" for i in range(n + 1))
    elements = "".join(f"{i + 1}, {i + 1}, {i + 2}\n" for i in range(n))
    path.write_text(
        f"*NODE\n{nodes}*ELEMENT, TYPE=B33, ELSET=W\n{elements}*MATERIAL, NAME=M\n*ELASTIC\n 1e11, 0.3\n"
        f"*BEAM SECTION, ELSET=W, MATERIAL=M, SECTION=CIRC\n 1e-3\n*BOUNDARY\n 1, ENCASTRE\n"
        f"*STEP\n*STATIC\n*CLOAD\n {n + 1}, 2, 1e-12\n*END STEP\n"
    )
    return path


needs_limit = pytest.mark.skipif("LITZ_TEST_NO_MEMORY_LIMIT" in os.environ, reason="this build needs the address space")


@needs_limit
def test_a_model_that_cannot_fit_is_refused_with_the_estimate(litz_program, long_wire, tmp_path):
    done = limited(litz_program, 500, "run", long_wire, "-o", tmp_path / "results")
    assert done.returncode == EXIT_MEMORY, done.stderr
    assert re.fullmatch(
        r"error: not enough memory: 100000 elements need 500\.000 MB at least, and [0-9.]+ MB are available\n",
        done.stderr,
    )
    assert not (tmp_path / "results").exists()


@pytest.mark.slow
@needs_limit
def test_want_of_memory_ends_in_words_wherever_it_comes_up(litz_program, long_wire, tmp_path):
    """From limits that the deck's text exceeds up to those that all arrays but the last fit into."""
    codes = []
    for megabytes in range(120, 800, 40):
        done = limited(litz_program, megabytes, "check", long_wire)
        codes.append(done.returncode)
        if done.returncode:
            assert done.returncode == EXIT_MEMORY, done.stderr
            assert "error: not enough memory: " in done.stderr
    assert codes[0] == EXIT_MEMORY
    assert codes[-1] == 0
    assert sorted(codes, reverse=True) == codes

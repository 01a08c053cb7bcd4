"""Pipes, devices and directories where a file should be: answered in words at once, never waited for."""

import os
import subprocess

import pytest

import litz as package
from decks import crossed

PIPE = "it is a pipe, not a regular file; write its content to a file and name that"


@pytest.fixture
def pipe(tmp_path):
    """A named pipe that nobody writes to."""
    os.mkfifo(tmp_path / "pipe")
    return tmp_path / "pipe"


@pytest.mark.parametrize("command", ["run", "check"])
def test_a_named_pipe_as_deck(litz, pipe, command):
    done = litz(command, pipe.name, cwd=pipe.parent, timeout=20)
    assert done.returncode == 4
    assert done.stderr == f'error: the deck file "pipe" cannot be read: {PIPE}\n'


def test_a_process_substitution_and_standard_input_as_deck(litz_program, tmp_path):
    """The results take their names from that of the deck, and /dev/fd/63 is no name."""
    (tmp_path / "wires.inp").write_text(crossed())
    for command in ("{} run <(cat wires.inp)", "cat wires.inp | {} run /dev/stdin"):
        done = subprocess.run(
            ["bash", "-c", command.format(litz_program)],
            cwd=tmp_path, capture_output=True, text=True, timeout=20, check=False,
        )  # fmt: skip
        assert done.returncode == 4
        assert PIPE in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["wires.inp"]


def test_standard_input_that_is_a_file_is_read(litz_program, tmp_path):
    (tmp_path / "wires.inp").write_text(crossed())
    with (tmp_path / "wires.inp").open() as file:
        done = subprocess.run(
            [litz_program, "check", "/dev/stdin"], stdin=file, capture_output=True, text=True, timeout=20, check=False
        )
    assert done.returncode == 0, done.stderr


def test_a_device_and_a_directory_as_deck(litz, tmp_path):
    done = litz("check", "/dev/null", timeout=20)
    assert done.returncode == 4
    assert "it is a device or a socket, not a regular file" in done.stderr
    done = litz("check", tmp_path, timeout=20)
    assert done.returncode == 4
    assert done.stderr.endswith("cannot be read: it is a directory\n")


@pytest.mark.parametrize("card", ["*INCLUDE", "*MESH"])
def test_a_pipe_that_a_deck_names(litz, pipe, tmp_path, card):
    deck = tmp_path / "deck.inp"
    deck.write_text(f"{card}, INPUT=pipe\n{crossed()}")
    done = litz("check", deck, timeout=20)
    assert done.returncode in (1, 4)
    assert PIPE in done.stderr
    assert "deck.inp:1:" in done.stderr


def test_a_pipe_as_restart_file(litz, pipe, tmp_path):
    (tmp_path / "deck.inp").write_text(crossed())
    done = litz("run", tmp_path / "deck.inp", "-o", tmp_path / "out", "--restart", pipe, timeout=20)
    assert done.returncode == 4
    assert PIPE in done.stderr


def test_python_does_not_wait_for_a_pipe_either(pipe, tmp_path):
    with pytest.raises(package.FileError, match="it is a pipe"):
        package.run(pipe, output_directory=tmp_path, progress=True)
    with pytest.raises(package.FileError, match="not a regular file"):
        package.Deck.read(pipe)
    with pytest.raises(package.FileError, match="no result file"):
        package.Results(pipe)

"""The line that a terminal shows while a long run goes on."""

import os
import pty
import re
import subprocess
import sys

import pytest


def output_on_a_terminal(command):
    """What a program writes to a terminal."""
    master, slave = pty.openpty()
    process = subprocess.Popen([str(word) for word in command], stdout=slave, stderr=slave, stdin=subprocess.DEVNULL)
    os.close(slave)
    chunks = []
    while True:
        try:
            chunk = os.read(master, 65536)
        except OSError:  # the program has closed its side
            break
        if not chunk:
            break
        chunks.append(chunk)
    os.close(master)
    assert process.wait() == 0
    return b"".join(chunks).decode()


def test_a_terminal_shows_where_a_long_run_stands(litz_program, inputs, tmp_path):
    text = output_on_a_terminal([litz_program, "run", inputs / "12_woven_fabric.inp", "-o", tmp_path, "--threads", 1])
    lines = re.findall(
        r"\rstep 1, increment (\d+), iteration \d+, (\d+) contacts, \d+:\d\d:\d\d(, about \d+:\d\d:\d\d to go)?", text
    )
    assert lines
    assert any(left for _, _, left in lines)
    # lines that stay begin on a cleared line
    assert re.search(r"\r {100}\r +1 +\d+ ", text)


def test_a_file_or_a_pipe_gets_lines_that_stay_only(litz, inputs, tmp_path):
    result = litz("run", inputs / "12_woven_fabric.inp", "-o", tmp_path)
    assert result.returncode == 0
    assert "\r" not in result.stdout


SCRIPT = "import litz, sys; litz.run(sys.argv[1], output_directory=sys.argv[2]{})"


@pytest.fixture
def script(inputs, tmp_path, litz_program, monkeypatch):
    """Command of a Python script that runs a deck, with options of `litz.run`."""
    monkeypatch.setenv("LITZ_PROGRAM", str(litz_program))
    return lambda options="": [sys.executable, "-c", SCRIPT.format(options), inputs / "08_elastica.inp", tmp_path]


def test_a_script_shows_a_bar_on_a_terminal(script):
    text = output_on_a_terminal(script())
    assert re.search(r"\r\[#*\.*\] +\d+% step 1, increment \d+, 0 contacts, 0:00:0", text)
    assert re.search(r"\r08_elastica: finished after 0:00:\d\d \(step \d, increment \d+, 0 contacts\)", text)


@pytest.mark.parametrize("options", [", progress=False", ", quiet=False"])
def test_a_script_shows_no_bar_if_it_says_so(script, options):
    assert "[" + "#" not in output_on_a_terminal(script(options)).replace("[N]", "")


def test_a_script_in_a_pipe_is_quiet(script):
    done = subprocess.run(script(), capture_output=True, text=True, check=True)
    assert done.stdout + done.stderr == ""

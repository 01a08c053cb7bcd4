"""The line that a terminal shows while a long run goes on."""

import os
import pty
import re
import subprocess


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

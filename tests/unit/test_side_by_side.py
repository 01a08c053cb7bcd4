"""Files that forked processes make, and those that they fail to make."""

import os
import signal

import pytest

from litz.reports import side_by_side


def writer(path, text="made"):
    def make():
        path.write_text(f"{text} by {os.getpid()}")

    return path, make


@pytest.mark.parametrize("processes", [0, 1, 2, 9])
def test_all_files_are_there_at_the_end(tmp_path, processes):
    jobs = [writer(tmp_path / str(number)) for number in range(5)]
    side_by_side.begin(jobs, processes)()
    makers = {int(path.read_text().split()[-1]) for path, _ in jobs}
    assert len(makers) == min(max(processes, 1), 5)
    assert (os.getpid() in makers) == (processes == 0)


def fail():
    raise MemoryError


def be_killed():
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.parametrize("end", [fail, be_killed])
def test_what_a_process_fails_to_make_is_made_here(tmp_path, end):
    here = os.getpid()
    path = tmp_path / "late"

    def make():
        path.write_text("half")
        if os.getpid() != here:
            end()
        path.write_text("whole")

    side_by_side.begin([(path, make)], 1)()
    assert path.read_text() == "whole"


def test_an_error_is_raised_where_it_is_seen(tmp_path):
    def make():
        raise ValueError("no such chart")

    finish = side_by_side.begin([(tmp_path / "never", make)], 1)
    with pytest.raises(ValueError, match="no such chart"):
        finish()

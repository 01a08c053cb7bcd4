"""The report of `./setup coverage`."""

import pytest

from coverage_report import File, percentage, report


def test_lines_count_not_files():
    assert percentage([File("long", 90, 45), File("short", 10, 10)]) == pytest.approx(55)


def test_nothing_measured_counts_as_nothing_run():
    assert percentage([]) == 0


def test_a_language_below_the_limit_is_named():
    text, missed = report({"Fortran": [File("a.f90", 1000, 900)], "Python": [File("b.py", 1000, 899)]})
    assert missed == ["Python"]
    assert "Fortran: 90.0 % of 1000 lines" in text
    assert "Python is below 90 %" in text
    assert "Fortran is below" not in text


def test_files_with_most_lines_left_out_come_first():
    files = [File("good.f90", 500, 499), File("bad.f90", 40, 10), File("worse.f90", 400, 350)]
    lines = report({"Fortran": files})[0].splitlines()
    assert [line.split()[-1] for line in lines[1:4]] == ["worse.f90", "bad.f90", "good.f90"]

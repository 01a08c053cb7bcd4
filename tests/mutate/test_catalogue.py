"""The catalogue of faults fits the sources: a text that has been rewritten is mended there."""

from dataclasses import replace

import pytest
from catalogue import ROOT, CatalogueError, read_catalogue
from scratch import mirror
from verdicts import BROKEN, FOUND, SURVIVED, Verdict, report

QUICK, FAULTS = read_catalogue()


@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: fault.name)
def test_a_fault_can_be_put_into_the_sources(fault):
    source = fault.path().read_text(encoding="utf-8")
    assert fault.put_into(source) != source


def test_the_tests_that_are_run_exist():
    for path in {*QUICK, *(test for fault in FAULTS for test in fault.tests)}:
        assert (ROOT / path).is_file(), path


def test_the_faults_are_told_apart_by_their_names():
    names = [fault.name for fault in FAULTS]
    assert len(set(names)) == len(names) >= 80


def test_a_text_that_is_no_longer_there_is_an_error():
    with pytest.raises(CatalogueError, match="'no such text' occurs 0 times, not 1"):
        replace(FAULTS[0], text="no such text").put_into("some source")
    with pytest.raises(CatalogueError, match="there are 0 files of this name"):
        replace(FAULTS[0], file="no_such_file.f90").path()


def verdicts(*kinds):
    return [Verdict(FAULTS[i], kind, "", 1.0) for i, kind in enumerate(kinds)]


def test_nineteen_of_twenty_have_to_be_found():
    assert report(verdicts(*[FOUND] * 19, SURVIVED))[1]
    assert not report(verdicts(*[FOUND] * 18, SURVIVED, SURVIVED))[1]


def test_what_is_not_found_is_listed_with_its_reason():
    fault = replace(FAULTS[0], survives="it only costs iterations")
    lines, _ = report([Verdict(fault, SURVIVED, "", 1.0), *verdicts(BROKEN, SURVIVED)])
    assert f"survives: {fault.name} (it only costs iterations)" in lines
    assert f"does not compile: {FAULTS[0].name}" in lines
    assert f"survives: {FAULTS[1].name} (a test is missing)" in lines


def test_the_copy_follows_the_sources_and_leaves_alone_what_is_the_same(tmp_path):
    fresh, copy = tmp_path / "fresh", tmp_path / "copy"
    for folder, names in ((fresh, ("same", "new", "changed")), (copy, ("same", "old", "changed"))):
        folder.mkdir()
        for name in names:
            (folder / name).write_text(name if name != "changed" else str(folder))
    before = (copy / "same").stat().st_mtime_ns
    mirror(fresh, copy)
    assert {path.name: path.read_text() for path in copy.iterdir()} == {
        "same": "same", "new": "new", "changed": str(fresh),
    }  # fmt: skip
    assert (copy / "same").stat().st_mtime_ns == before

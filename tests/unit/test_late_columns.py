"""Columns that are read late are those that were read at once; text behind the last comma of a table, however large."""

import pickle

import numpy as np
import pytest

from litz.base.table import LateColumns, Table
from litz.results import text_tables
from litz.results.text_tables import count_rows, read_last_column

VALUES = {"time": np.array([0.5, 1.0, 1.5]), "status": np.array(["new", "", "active"])}


@pytest.fixture
def asked():
    return []


@pytest.fixture
def table(asked):
    def read(name):
        asked.append(name)
        return VALUES[name]

    return Table(LateColumns(VALUES, read, 3), {"time": "s", "status": ""})


def test_columns_are_read_once_when_asked_for(table, asked):
    assert (table.n_rows, list(table), "time" in table, "force" in table) == (3, ["time", "status"], True, False)
    rows = table.where(VALUES["time"] > 0.7)
    assert (rows.n_rows, asked) == (2, [])
    for _ in range(2):
        assert rows["time"].tolist() == [1.0, 1.5]
    assert asked == ["time"]
    assert rows.where(np.array([1]))["status"].tolist() == ["active"]
    with pytest.raises(KeyError, match="tome"):
        table["tome"]


def test_a_column_takes_other_values_and_the_others_are_still_read_late(table, asked):
    other = table.with_column("status", np.array(["a", "b", "c"]))
    assert (list(other), other.n_rows, other.units, asked) == (list(table), 3, table.units, [])
    assert other["status"].tolist() == ["a", "b", "c"]
    assert other.where(np.array([2]))["time"].tolist() == [1.5]
    assert asked == ["time"]
    read = Table(VALUES, {"time": "s"})
    assert read.with_column("time", np.arange(3.0))["time"].tolist() == [0.0, 1.0, 2.0]
    assert read["time"].tolist() == VALUES["time"].tolist()


def test_a_mask_may_change_afterwards(table):
    mask = np.array([True, False, True])
    rows = table.where(mask)
    mask[:] = False
    assert rows["time"].tolist() == [0.5, 1.5]


def test_another_process_gets_all_columns(table):
    copy = pickle.loads(pickle.dumps(table.where(np.array([2, 0]))))
    assert copy.n_rows == 2
    assert copy["status"].tolist() == ["active", "new"]


@pytest.mark.parametrize("at_once", [1, 7, 2**20])
def test_last_column_of_whole_rows(tmp_path, monkeypatch, at_once):
    monkeypatch.setattr(text_tables, "_BYTES_AT_ONCE", at_once)
    path = tmp_path / "table.csv"
    path.write_bytes("# of litz\nstep,status\n1,new\n2,\n# 3,remark\n3,café \r\n4,not comple".encode())
    assert read_last_column(path).tolist() == ["new", "", "café"]
    assert count_rows(path) == 3


@pytest.mark.parametrize("text", ["", "step,status\n", "step,sta"])
def test_tables_without_rows(tmp_path, text):
    path = tmp_path / "table.csv"
    path.write_text(text)
    assert (read_last_column(path).tolist(), count_rows(path)) == ([], 0)

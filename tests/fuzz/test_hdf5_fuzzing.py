"""A quick part of the fuzzing of HDF5 files, the same files every time; CONTRIBUTING says how to run more."""

import os
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))
from hdf5_mutations import datasets
from run_hdf5 import MeshFuzzer, RestartFuzzer, fuzz

#: The address sanitizer needs more addresses than any memory has
LIMITED = "ASAN_OPTIONS" not in os.environ


@pytest.mark.slow
def test_changed_mesh_files_are_refused_or_mean_what_they_say(read_decks):
    totals, found = fuzz("mesh", read_decks, 300, seed=1, limited=LIMITED)
    assert not found, f"{len(found)} findings, the first: {found[0]}"
    # both ways of the reader have been walked
    assert totals["accepted"] > 20
    assert totals["refused"] > 100


@pytest.mark.slow
def test_changed_restart_files_are_refused_or_lead_to_the_same_results(litz_program):
    totals, found = fuzz("restart", litz_program, 120, seed=1, limited=LIMITED)
    assert not found, f"{len(found)} findings, the first: {found[0]}"
    assert totals["accepted"] > 10
    assert totals["refused"] > 40


def test_a_mesh_that_means_something_else_than_its_text_is_found(read_decks, tmp_path, monkeypatch):
    fuzzer = MeshFuzzer(read_decks, tmp_path, limited=LIMITED)
    fuzzer.changed.write_bytes(fuzzer.original.read_bytes())
    assert fuzzer.judge() == (True, "")
    monkeypatch.setattr("run_hdf5.as_text", lambda path: text.replace("17, 0.05", "17, 0.051"))
    text = "*NODE\n" + "".join(f"{i}, {0.01 * k!r}, 0, 0\n" for k, i in enumerate((3, 5, 7, 11, 13, 17, 19, 23, 29)))
    accepted, wrong = fuzzer.judge()
    fuzzer.stop()
    assert accepted
    assert wrong


@pytest.mark.parametrize("name", ["displacement", "rotation", "increment", "row_ends", "checksums", "loading_fixed"])
def test_a_restart_file_with_one_changed_bit_is_refused(litz_program, tmp_path, name):
    fuzzer = RestartFuzzer(litz_program, tmp_path, limited=LIMITED)
    fuzzer.changed.write_bytes(fuzzer.original.read_bytes())
    with h5py.File(fuzzer.changed, "r+") as file:
        data = file[name][...]
        # of the increment that is read
        data[-1:].reshape(-1).view(np.int64)[0] ^= 1
        file[name][...] = data
    assert fuzzer.judge() == (False, "")


def test_a_dataset_that_was_never_written_takes_no_memory(read_decks, tmp_path):
    fuzzer = MeshFuzzer(read_decks, tmp_path, limited=LIMITED)
    fuzzer.changed.write_bytes(fuzzer.original.read_bytes())
    with h5py.File(fuzzer.changed, "r+") as file:
        del file["nodes/position"], file["nodes/id"]
        file.create_dataset("nodes/id", shape=(4 * 10**8,), dtype="i4", chunks=(1000,))
        file.create_dataset("nodes/position", shape=(4 * 10**8, 3), dtype="f8", chunks=(1000, 3))
    answer, reason = fuzzer.reader.ask(fuzzer.deck)
    fuzzer.stop()
    assert (reason, answer[0].split()[0]) == ("", b"1")


def test_a_compressed_mesh_is_read(read_decks, tmp_path):
    fuzzer = MeshFuzzer(read_decks, tmp_path, limited=LIMITED)
    with h5py.File(fuzzer.original, "r") as original, h5py.File(fuzzer.changed, "w") as file:
        for name in datasets(original):
            file.create_dataset(name, data=original[name][...], compression="gzip", shuffle=True, fletcher32=True)
    accepted, wrong = fuzzer.judge()
    fuzzer.stop()
    assert not wrong
    assert accepted

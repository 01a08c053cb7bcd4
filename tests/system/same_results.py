"""What tests of restart files and of interrupted runs share: what a file holds, and equality of results."""

import h5py
import numpy as np

KEEP_ALL = "*RESTART, WRITE\n"


def keeping(deck, card=KEEP_ALL):
    """The deck with a card in its first step."""
    return deck.replace("*END STEP", card + "*END STEP", 1)


def written(path):
    """(step, increment) of what a restart file holds."""
    with h5py.File(path, "r") as file:
        return [tuple(row) for row in file["increment"][: file.attrs["n_increments"]].tolist()]


def assert_same_numbers(a, b):
    assert np.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def later_rows(table, step, increment):
    return table.where((table["step"] > step) | ((table["step"] == step) & (table["increment"] > increment)))


def assert_same_end(whole, part, step, increment):
    """Everything after the given increment is the same, to the last bit."""
    start = whole.index(step, increment)
    assert part.steps[0] == step
    assert part.increments[0] == increment
    assert np.array_equal(part.times, whole.times[start:])
    for name in whole.fields:
        assert np.array_equal(part.field(name, None), whole.field(name, None)[start:]), name
    for table in ("contacts", "history", "status", "convergence"):
        a, b = (later_rows(getattr(results, table), step, increment) for results in (whole, part))
        assert list(a) == list(b)
        for column in a:
            assert_same_numbers(a[column], b[column])

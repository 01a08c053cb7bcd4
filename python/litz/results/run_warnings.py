"""The warnings of a run, as its result file keeps them."""

from pathlib import Path

import h5py
import numpy as np

from ..errors import WarningEntry


def read_warnings(path: Path) -> list[WarningEntry]:
    """The warnings in a result file, in the order of their occurrence; files written before version 0.2 have none."""
    with h5py.File(path, "r", locking=False) as file:
        group = file.get("litz/warnings")
        if group is None:
            return []
        n = int(group.attrs["n_warnings"])
        lines = bytes(np.asarray(group["text"], np.uint8)).decode("utf-8", errors="replace").split("\n")[:n]
        integers, reals = group["integers"][:n].tolist(), group["reals"][:n].tolist()
    entries = []
    for line, row, (time, last_time, worst) in zip(lines, integers, reals, strict=True):
        kind, unit, message = line.split("\t", 2)
        step, increment, last_step, last_increment, count, is_rest = row[2:]
        entries.append(
            WarningEntry(
                kind,
                message,
                tuple(element for element in row[:2] if element > 0),
                step,
                increment,
                time,
                last_step,
                last_increment,
                last_time,
                count,
                worst if unit else None,
                "" if unit == "-" else unit,
                bool(is_rest),
            )
        )
    return entries

"""Which increments have their contacts in the ledger: `*CONTACT FILE, FREQUENCY=` leaves some out."""

from pathlib import Path

import h5py
import numpy as np

#: What there is to be said of the contacts of an increment that has none of them in the ledger: as a note, and by itself
NOT_WRITTEN_NOTE = "contacts were not written at this increment (*CONTACT FILE)"
NOT_WRITTEN = f"C{NOT_WRITTEN_NOTE[1:]}"
_MAX_NAMED = 8


def contacts_written(file: h5py.File, steps: np.ndarray, increments: np.ndarray) -> np.ndarray:
    """Which of these increments have their contacts in the ledger, (n) of bool."""
    if "contact_increments" not in file["litz"]:
        # those of earlier versions have all of them
        return np.ones(len(steps), dtype=bool)
    written = set(map(tuple, file["litz/contact_increments"][:].tolist()))
    return np.array([one in written for one in zip(steps.tolist(), increments.tolist(), strict=True)], dtype=bool)


def refuse_missing(path: Path, steps: np.ndarray, increments: np.ndarray, has: np.ndarray, increment: int) -> None:
    """An error where an increment (index in the file) has no contacts in the ledger, which tells those that have them."""
    if has[increment]:
        return
    written = [f"{s}:{i}" for s, i in zip(steps[has].tolist(), increments[has].tolist(), strict=True)]
    shown = ", ".join(written if len(written) <= _MAX_NAMED else [*written[:3], "...", *written[-3:]])
    there = f"there are those of {shown}" if written else "there are none"
    raise LookupError(
        f"{path} has no contacts of increment {increments[increment]} of step {steps[increment]} "
        f"(*CONTACT FILE, FREQUENCY=): {there}"
    )


def as_far_as_written(text: str, has: np.ndarray) -> str:
    """A statement about all contacts of a run, of whose increments those that `has` tells have contacts in the ledger."""
    return text if has.all() else f"{text}\nin the increments with contacts in the ledger (*CONTACT FILE)"

"""Data of the viewer inside a page: numbers with as many digits as a picture shows, in few bytes.

A part of a page is the length of its JSON as four bytes, the JSON, and the bytes of its arrays. An array is whole numbers of
steps: the differences down each column as 0, -1, 1, -2, ... -> 0, 1, 2, 3, ..., the low bytes of all of them before the next
ones. `data.js` reads it.
"""

import base64
import gzip
import json
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

# Steps of a column where none is given: a colour is one of 256, and a bar of the field has three digits
_STEPS = 2**14
# Differences have at most four bytes
_MAX_STEPS = 2.0**30
# Of gzip: more takes longer and gains nothing
_COMPRESSION = 6


@dataclass(frozen=True)
class Numbers:
    """An array for the viewer.

    Attributes
    ----------
    values : array
        One row per node, element, contact, ...
    kind : type
        How it is sent where size does not count.
    step : float, optional
        How exactly a page has it; default: a part of the largest value of the column.
    parts : int
        How small a part.
    """

    values: ArrayLike
    kind: type = np.float32
    step: float | None = None
    parts: int = _STEPS

    def text(self) -> str:
        """All digits, as base64."""
        return base64.b64encode(np.ascontiguousarray(self.values, dtype=self.kind).tobytes()).decode()

    def packed(self) -> tuple[dict[str, Any], bytes]:
        """Description and bytes."""
        values = np.asarray(self.values, dtype=float)
        values = values.reshape(len(values), math.prod(values.shape[1:]))
        known = np.isfinite(values)
        shown = np.where(known, values, 0.0)
        largest = np.abs(shown).max(axis=0, initial=0.0)
        steps = largest / self.parts if self.step is None else np.maximum(self.step, largest / _MAX_STEPS)
        steps[steps == 0] = 1.0
        described: dict[str, Any] = {"rows": len(values), "steps": [float(f"{step:.9g}") for step in steps.tolist()]}
        counts = np.rint(shown / described["steps"]).astype(np.int64)
        if not known.all():
            described["none"] = int(np.abs(counts).max()) + 1
            counts[~known] = described["none"]
        differences = np.diff(counts, axis=0, prepend=0)
        folded = np.where(differences < 0, -2 * differences - 1, 2 * differences).astype(np.uint32)
        described["planes"] = n = max(1, (int(folded.max(initial=0)).bit_length() + 7) // 8)
        return described, folded.T.copy().view(np.uint8).reshape(-1, 4)[:, :n].T.tobytes()


def as_text(data: dict) -> str:
    """JSON with all digits."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False, default=Numbers.text)


def as_part(data: dict) -> str:
    """What a page has inside."""
    arrays: list[bytes] = []

    def packed(numbers: Numbers) -> dict[str, Any]:
        described, content = numbers.packed()
        described["at"] = sum(map(len, arrays))
        arrays.append(content)
        return described

    head = json.dumps(data, separators=(",", ":"), allow_nan=False, default=packed).encode()
    return zipped(b"".join([len(head).to_bytes(4, "little"), head, *arrays]))


def zipped(content: bytes) -> str:
    """Compressed, as base64."""
    return base64.b64encode(gzip.compress(content, _COMPRESSION, mtime=0)).decode()


def resolution(moved: NDArray[np.floating], visible: float, parts: int = 2 * _STEPS) -> float:
    """How exactly displacements are kept: what is visible, and a part of the largest, which may be shown enlarged."""
    largest = float(np.abs(moved).max(initial=0.0))
    return min(visible, largest / parts) if largest > 0 else visible

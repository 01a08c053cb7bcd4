"""Values of result files."""

import h5py


def n_steps(file: h5py.File) -> int:
    """Number of increments in the file."""
    return int(file["VTKHDF/Steps"].attrs["NSteps"])


def numbers_of(file: h5py.File, index: int) -> tuple[int, int]:
    """Numbers of the step and of the increment in it."""
    return int(file["litz/increments/step"][index]), int(file["litz/increments/increment"][index])


def text_of(value: bytes | str) -> str:
    """An attribute, or a dataset, that is text."""
    text = value.decode("utf-8", errors="replace") if isinstance(value, bytes) else str(value)
    return text.rstrip("\0")

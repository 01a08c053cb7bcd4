"""Files that are written."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import FileError


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Within this block a file is written; its directory is created if need be, and what the system refuses is a FileError."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield
    except OSError as error:
        raise FileError(f"cannot write {path}: {error.strerror or error}") from None

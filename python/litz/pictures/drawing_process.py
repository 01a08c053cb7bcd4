"""The process that draws with VTK: started early, it loads VTK beside what comes before the pictures."""

import os
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

_PROGRAM = Path(__file__).with_name("render_wires.py")
# The one that waits for its first pictures, if there is one
_waiting: list[subprocess.Popen[str]] = []


@contextmanager
def ready() -> Iterator[None]:
    """Have a process that draws load VTK beside what follows, whose first pictures it makes; one of no use ends."""
    process = _start(None)
    _waiting.append(process)
    try:
        yield
    finally:
        if process in _waiting:
            _waiting.remove(process)
            process.kill()
            process.communicate()


def run(folder: str, longest: float, environment: Mapping[str, str] | None = None) -> tuple[int, str]:
    """Exit code and messages of a process that makes the pictures of a folder.

    Parameters
    ----------
    folder : str
        Where `render_wires.py` finds what it draws.
    longest : float
        Time after which it is ended, and `subprocess.TimeoutExpired` raised [s].
    environment : mapping, optional
        Other variables than this process has: a process that waits is left alone.
    """
    process = _waiting.pop() if _waiting and environment is None else _start(environment)
    try:
        _, messages = process.communicate(f"{folder}\n", timeout=longest)
    except BaseException:
        process.kill()
        process.communicate()
        raise
    return process.returncode, messages


def _start(environment: Mapping[str, str] | None) -> subprocess.Popen[str]:
    # it finds packages where this process does, and need not go through the files that say where (-S)
    known = {**(environment or os.environ), "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
    command = [sys.executable, "-S", str(_PROGRAM)]
    return subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=known
    )

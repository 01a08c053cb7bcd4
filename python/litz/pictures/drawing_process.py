"""The process that draws with VTK: started early, it loads VTK beside what comes before the pictures."""

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

_PROGRAM = Path(__file__).with_name("render_wires.py")
# How often pictures are looked for [s]
_OFTEN = 0.02
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


def run(
    folder: str,
    longest: float,
    environment: Mapping[str, str] | None = None,
    look: Callable[[], None] = lambda: None,
) -> tuple[int, str]:
    """Exit code and messages of a process that makes the pictures of a folder.

    Parameters
    ----------
    folder : str
        Where `render_wires.py` finds what it draws.
    longest : float
        Time after which it is ended, and `subprocess.TimeoutExpired` raised [s].
    environment : mapping, optional
        Other variables than this process has: a process that waits is left alone.
    look : callable, optional
        Called again and again while it draws: a picture that is there is whole.
    """
    process = _waiting.pop() if _waiting and environment is None else _start(environment)
    end = time.monotonic() + longest
    try:
        _ask(process, folder)
        while True:
            try:
                _, messages = process.communicate(timeout=min(_OFTEN, longest))
                return process.returncode, messages
            except subprocess.TimeoutExpired:
                if time.monotonic() >= end:
                    raise
            look()
    except BaseException:
        process.kill()
        process.communicate()
        raise


def _ask(process: subprocess.Popen[str], folder: str) -> None:
    """Name the folder: `communicate` might be interrupted before it has, and would not go on."""
    # one that has crashed tells so by its exit code
    with suppress(BrokenPipeError):
        print(folder, file=process.stdin, flush=True)


def _start(environment: Mapping[str, str] | None) -> subprocess.Popen[str]:
    # it finds packages where this process does, and need not go through the files that say where (-S)
    known = {**(environment or os.environ), "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
    command = [sys.executable, "-S", str(_PROGRAM)]
    return subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, env=known
    )

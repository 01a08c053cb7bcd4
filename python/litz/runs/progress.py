"""Progress of a run: a line on a terminal, a bar in a notebook, a few lines in a log."""

import re
import shutil
import sys
import time
from pathlib import Path
from typing import TextIO

from ..base import notebook

#: step, increment, attempt, iterations, time, increment of time, contacts, sum of forces, remark
_INCREMENT = re.compile(r"\s*(\d+)\s+(\d+)\s+\d+\s+\d+\s+(\S+)\s+\S+\s+(\d+)\s+\S+(.*)")
_STATIC = re.compile(
    r"^[ \t]*\*[ \t]*static\b[^\n]*\n(?:[ \t]*(?:\*\*[^\n]*)?\n)*([^*\n]*)", re.IGNORECASE | re.MULTILINE
)
_INCLUDE = re.compile(r"^[ \t]*\*[ \t]*include\b[^\n]*?input[ \t]*=[ \t]*\"?([^\n\",]+)", re.IGNORECASE | re.MULTILINE)
_MAX_INCLUDE_DEPTH = 20
#: Minimum time between two updates of the line [s], and its maximum width
_MIN_INTERVAL = 0.1
_WIDTH = 100
_BAR = 20
#: Lines of a log for a whole run
_LOG_LINES = 10


def total_time(deck: Path, depth: int = 0) -> float:
    """Time of all steps of a deck and what it includes; 0 if it cannot be read, which the run reports [s]."""
    if not deck.is_file():
        return 0.0
    try:
        text = deck.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return 0.0
    total = 0.0
    for data in _STATIC.findall(text):
        values = data.split(",")
        try:
            total += float(values[1].upper().replace("D", "E")) if len(values) > 1 and values[1].strip() else 1.0
        except ValueError:
            continue
    if depth < _MAX_INCLUDE_DEPTH:
        total += sum(total_time(deck.parent / name.strip(), depth + 1) for name in _INCLUDE.findall(text))
    return total


def someone_watches() -> bool:
    """Whether progress can be seen: in a notebook, or on a terminal."""
    return notebook.in_notebook() or sys.stderr.isatty()


class Progress:
    """Shows the progress of a run, based on the lines that the program prints.

    Parameters
    ----------
    total : float
        Time of all steps [s].
    title : str
        What runs.
    stream : text file, optional
        Where lines go; standard error when left out.
    """

    def __init__(self, total: float, title: str, stream: TextIO | None = None):
        self._total = total
        self._title = title
        self._stream = sys.stderr if stream is None else stream
        self._start = time.monotonic()
        self._last = 0.0
        self._done = 0.0
        self._began: float | None = None
        self._n_logged = 0
        self._text = ""
        # a line of the full width would wrap
        self._width = min(_WIDTH, shutil.get_terminal_size().columns - 1)
        self._handle = notebook.place() if stream is None else None
        self._on_terminal = self._handle is None and self._stream.isatty()

    def feed(self, line: str) -> None:
        """Process a line of the program."""
        match = _INCREMENT.fullmatch(line.rstrip("\n"))
        if match is None or "cut:" in match[5]:
            return
        try:
            self._done = float(match[3])
        except ValueError:
            return
        if self._began is None:
            # a restart begins in the middle
            self._began = self._done
        self._text = f"step {match[1]}, increment {match[2]}, {match[4]} contacts"
        self._show()

    def close(self, finished: bool) -> None:
        """Show the end."""
        end = "finished" if finished else "gave up"
        text = f"{self._title}: {end} after {_clock(time.monotonic() - self._start)}"
        if self._text:
            text += f" ({self._text})"
        if self._handle is not None:
            self._handle.update(notebook.bar(1.0 if finished else self._share(), text))
        elif self._on_terminal:
            self._stream.write("\r" + text[: self._width].ljust(self._width) + "\n")
        else:
            self._stream.write(text + "\n")
        self._stream.flush()

    def _share(self) -> float:
        return min(1.0, self._done / self._total) if self._total > 0 else 0.0

    def _show(self) -> None:
        now = time.monotonic()
        share = self._share()
        if self._handle is None and not self._on_terminal:
            if int(share * _LOG_LINES) > self._n_logged and share < 1:
                self._n_logged = int(share * _LOG_LINES)
                self._stream.write(f"{self._title}: {share:4.0%}, {self._text}\n")
                self._stream.flush()
            return
        if now - self._last < _MIN_INTERVAL:
            return
        self._last = now
        text = f"{share:4.0%} {self._text}, {_clock(now - self._start)}{self._left(now)}"
        if self._handle is not None:
            self._handle.update(notebook.bar(share, f"{self._title}: {text}"))
            return
        bar = ("#" * round(share * _BAR)).ljust(_BAR, ".")
        self._stream.write("\r" + f"[{bar}] {text}"[: self._width].ljust(self._width))
        self._stream.flush()

    def _left(self, now: float) -> str:
        """Remaining time at the present rate."""
        if self._began is None or self._done <= self._began or self._total <= 0:
            return ""
        rate = (now - self._start) / (self._done - self._began)
        return f", {_clock(rate * max(0.0, self._total - self._done))} to go"


def _clock(seconds: float) -> str:
    whole = round(seconds)
    return f"{whole // 3600}:{whole // 60 % 60:02}:{whole % 60:02}"

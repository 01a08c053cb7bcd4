"""Pictures that are drawn in several processes at a time."""

import os
from collections.abc import Callable, Sequence
from pathlib import Path

#: A file, and what makes it
Job = tuple[Path, Callable[[], object]]


def begin(jobs: Sequence[Job], processes: int) -> Callable[[], None]:
    """Make files in processes that are forked from this one, beside what it does until it calls what is returned.

    What is returned makes the files that are missing, as without further processes: errors are raised where everyone sees them.

    Parameters
    ----------
    jobs : sequence of tuple
        Files that do not exist, and what makes each of them in one go.
    processes : int
        Processes besides this one; 0: none. More are for programs with a single thread.
    """
    count = min(processes, len(jobs))
    children = [_fork(jobs[first::count]) for first in range(count)]

    def finish() -> None:
        for child in children:
            os.waitpid(child, 0)
        for path, make in jobs:
            if not path.exists():
                make()

    return finish


def _fork(jobs: Sequence[Job]) -> int:
    """Number of a process that makes files; where it fails, one may be missing or broken, which is removed."""
    child = os.fork()
    if child:
        return child
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        for path, make in jobs:
            try:
                make()
            except BaseException:
                path.unlink(missing_ok=True)
                raise
    finally:
        # nothing that is the parent's to end, such as files and temporary folders
        os._exit(0)

"""Pictures that are drawn in several processes at a time."""

import gc
import os
import warnings
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
    shares = [jobs[first::count] for first in range(count)]
    # what exists is no garbage: to look at it would copy its memory for each process
    gc.freeze()
    children = [_fork(share) for share in shares]
    gc.unfreeze()

    def finish() -> None:
        for child, share in zip(children, shares, strict=True):
            _, status = os.waitpid(child, 0)
            for path, _ in share if status else []:
                # which of them is whole is not known
                path.unlink(missing_ok=True)
        for path, make in jobs:
            if not path.exists():
                make()

    return finish


def _fork(jobs: Sequence[Job]) -> int:
    """Number of a process that makes files, which ends with another status than 0 where it fails."""
    with warnings.catch_warnings():
        # Python 3.12 warns of any further thread; those of BLAS are at rest, and started anew in the child
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child:
        return child
    status = 1
    try:
        # it ends soon, and all of its memory with it
        gc.disable()
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        for _, make in jobs:
            make()
        status = 0
    finally:
        # nothing that is the parent's to end, such as files and temporary folders
        os._exit(status)

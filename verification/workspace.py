"""Where a case works: a directory of its own for decks, results and pictures."""

import os
from pathlib import Path

import litz


class Workspace:
    """Directory of one case.

    Attributes
    ----------
    directory : Path
        Decks, results and the picture of the case.
    quick : bool
        Only the claims marked `quick` are wanted.
    decks : list of str
        Names of the decks that were run.
    """

    def __init__(self, directory, quick=False):
        self.directory = Path(directory)
        self.directory.mkdir(parents=True, exist_ok=True)
        self.quick = quick
        self.decks = []

    def run(self, name, text, **options):
        """Write a deck as NAME.inp, run it, and return its `litz.Results`; options are those of `litz.run`."""
        deck = self.directory / f"{name}.inp"
        deck.write_text(text, encoding="utf-8")
        self.decks.append(deck.name)
        options.setdefault("threads", 1)
        return litz.run(deck, output_directory=self.directory / name, **options)


def iterations(results):
    """Iterations of a run in all, with those of increments that were cut back; and the number of cut-backs."""
    status = results.status
    rows = results.convergence
    total = 0
    keys = zip(rows["step"], rows["increment"], rows["attempt"], strict=True)
    last = dict(zip(keys, rows["iteration"], strict=True))
    total = sum(int(count) for count in last.values())
    return total, int((status["attempts"] - 1).sum())


def two_processes():
    """Let numerical libraries of the workers use one thread each."""
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ.setdefault(name, "1")

"""Sticks dropped at random on a square begin to lead from one side to the other at the published density.

Source: J. Li, S.-L. Zhang, Phys. Rev. E 80 (2009) 040104(R): 5.63726 sticks of length L per area L^2 on an infinite square;
confirmed, as 5.6373, by R. K. Daniels, arXiv 2603.05374 (2026). The probability of a path across a square is one half at the
threshold, so that the median over squares approaches it quickly as they grow. Places, crossings and edges are those of
`litz.build.nanowire_film`.
"""

import numpy as np

from litz import percolation
from verification import figures

SQUARES, RATIO = 100, 16.0


def measure(workspace):
    found = percolation.threshold(SQUARES, ratio=RATIO)
    return {"percolation.sticks": found.density, "figure": found}


def draw(values, path):
    found = values["figure"]
    with figures.panels(path, columns=1) as axes:
        axes.plot(
            np.sort(found.densities),
            (np.arange(SQUARES) + 0.5) / SQUARES,
            color="#c4451c",
            label="squares that conduct",
        )
        axes.axvline(percolation.STICKS, label="Li and Zhang (2009)", **figures.REFERENCE)
        axes.axhline(0.5, linestyle="--", **figures.REFERENCE)
        axes.set(xlabel="sticks per square of their length", ylabel="share", title=f"squares of {RATIO:g} lengths")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["percolation"]))

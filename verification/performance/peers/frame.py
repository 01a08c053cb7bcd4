"""The problem that all programs solve, and the clock of a run; numpy and the standard library only.

A problem file holds

    nodes (n, 3), elements (m, 2) from 0, radius (m)   straight round beams [m]
    wire (m)                                           beam of which each element is a part
    young, poisson                                     [Pa], [-]
    held (k, 2)                                        node, degree of freedom 0-5 held at zero
    moved (p, 2), value (p)                            node, degree of freedom and its final value
    increments                                         equal increments of the load
    tolerance                                          largest residual force [N]
    links (c, 2), gap (c), penalty                     nodes that touch along z after `gap` [m], [N/m]; maybe none
"""

import json
import math
import sys
import time
from pathlib import Path

import numpy as np


class Frame:
    """A problem file."""

    def __init__(self, path):
        with np.load(path) as file:
            self.__dict__.update({key: file[key] if file[key].ndim else file[key].item() for key in file.files})
        self.section = {}

    def section_of(self, radius):
        """Area, second moment of area and torsion constant of a round section."""
        return math.pi * radius**2, math.pi * radius**4 / 4, math.pi * radius**4 / 2

    @property
    def shear_modulus(self):
        return self.young / (2 * (1 + self.poisson))


class Clock:
    """Runs the increments until the limit, and prints what came of them."""

    def __init__(self, frame, limit):
        self.frame, self.limit = frame, float(limit)

    def run(self, solve, reaction, **more):
        """`solve(i)`: increment i from 0; its iterations, and whether it converged. `reaction()`: sum along z of what moves."""
        iterations, reactions, in_vain = [], [], 0
        begin = time.perf_counter()
        for i in range(self.frame.increments):
            done, converged = solve(i)
            if not converged:
                in_vain = done
                break
            iterations.append(done)
            reactions.append(reaction())
            if time.perf_counter() - begin > self.limit:
                break
        seconds = time.perf_counter() - begin
        finished = len(iterations) == self.frame.increments
        result = {"seconds": seconds, "iterations": iterations, "in_vain": in_vain, "reactions": reactions}
        result |= {"finished": finished, "memory": most_memory(), **more}
        print("\n" + json.dumps(result), flush=True)


def most_memory():
    """Most memory this process has had [bytes]."""
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return next(1024 * int(line.split()[1]) for line in status.splitlines() if line.startswith("VmHWM:"))


def arguments():
    """Problem, clock and the further words of the command line."""
    frame = Frame(sys.argv[1])
    return frame, Clock(frame, sys.argv[2]), sys.argv[3:]

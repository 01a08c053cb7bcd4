"""A thread that a crossing wire pushes far aside: the contact is never lost, whatever the mesh and the increments.

The thread is clamped at one end; without its contact it would spring straight, with the wire on its far side, which is an
equilibrium as well. Source of the values: the integrated elastica of verification/references/pushed_cantilever.py.
"""

import math

import numpy as np
import pytest
from verification.references import pushed_cantilever

from litz.closed_forms import hertz_contact

LENGTH, YOUNG, RADIUS = 0.163, 110e9, 0.4e-3
PUSHER = {"young": 200e9, "poisson": 0.28, "radius": 0.7e-3}
PLACE, HEIGHT, PUSH = 0.07335, 0.0031, -0.0394816
PENALTY = 1e5


def deck(n, first_increment, behavior):
    """The thread in n elements along x, the wire along z above it."""
    nodes = [f"{i + 1}, {LENGTH * i / n!r}, 0, 0" for i in range(n + 1)]
    return "\n".join(
        [
            "*NODE, NSET=THREAD", *nodes,
            "*ELEMENT, TYPE=B33, ELSET=THREAD", *(f"{i}, {i}, {i + 1}" for i in range(1, n + 1)),
            f"*NODE, NSET=ENDS\n9001, {PLACE}, {HEIGHT}, -0.02\n9002, {PLACE}, {HEIGHT}, 0.02",
            "*ELEMENT, TYPE=B33, ELSET=PUSHER\n9001, 9001, 9002",
            f"*MATERIAL, NAME=THREAD\n*ELASTIC\n{YOUNG}, 0.3",
            f"*MATERIAL, NAME=PUSHER\n*ELASTIC\n{PUSHER['young']}, {PUSHER['poisson']}",
            f"*BEAM SECTION, ELSET=THREAD, MATERIAL=THREAD, SECTION=CIRC\n{RADIUS}",
            f"*BEAM SECTION, ELSET=PUSHER, MATERIAL=PUSHER, SECTION=CIRC\n{PUSHER['radius']}",
            f"*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={behavior}",
            "*CONTACT PAIR, INTERACTION=TOUCH\nTHREAD, PUSHER",
            "*BOUNDARY\n1, ENCASTRE\nENDS, 1\nENDS, 3, 6",
            f"*STEP\n*STATIC\n{first_increment}, 1.\n*BOUNDARY\nENDS, 2, 2, {PUSH}\n*END STEP\n",
        ]
    )  # fmt: skip


@pytest.fixture(scope="module")
def elastica():
    """Position of the tip for both laws of contact; that of Hertz by the stiffness that it has at its force."""
    found = {}
    stiffness = {"ei": YOUNG * math.pi * RADIUS**4 / 4, "ea": YOUNG * math.pi * RADIUS**2}
    both = {
        "radius": (PUSHER["radius"], RADIUS), "young": (PUSHER["young"], YOUNG), "poisson": (PUSHER["poisson"], 0.3),
        "resistivity": (1e-8, 1e-8), "angle": math.pi / 2,
    }  # fmt: skip
    for behavior in ("HERTZ", f"LINEAR\n{PENALTY}"):
        state, penalty = None, PENALTY
        for push in [*np.linspace(0, PUSH, 9)[1:], PUSH, PUSH, PUSH]:
            line = (PLACE, HEIGHT + push)
            state = pushed_cantilever.solve(line, LENGTH, RADIUS + PUSHER["radius"], penalty, **stiffness, start=state)
            if behavior == "HERTZ":
                penalty = state.force / hertz_contact(state.force, **both).approach
        found[behavior] = state.tip
    return found


@pytest.mark.parametrize("behavior", ["HERTZ", f"LINEAR\n{PENALTY}"], ids=["hertz", "linear"])
@pytest.mark.parametrize("n", [10, 15, 20, 27, 40, 60, 80, 160])
def test_a_thread_pushed_far_aside_keeps_its_contact(run, elastica, n, behavior):
    for first_increment in (0.05, 0.1, 0.25, 0.5, 1.0):
        process, results = run(deck(n, first_increment, behavior), name=f"first{first_increment}")
        assert process.returncode == 0, process.stderr
        assert len(results.contacts_at(-1)["force"]) == 1
        # an element misses the deflection under a force inside it: F h^3/(192 E I) in the worst place, 1e-3 h with 10 elements
        allowed = 5e-5 * (10 / n) ** 2 * LENGTH
        assert results.positions(-1)[n] == pytest.approx([*elastica[behavior], 0], abs=max(allowed, 1e-6 * LENGTH))


def test_the_increments_that_it_takes_are_few(run):
    """A regression value: what the iteration needed when this was written, and a half more."""
    process, results = run(deck(40, 0.1, "HERTZ"))
    assert process.returncode == 0, process.stderr
    assert results.status["iterations"].sum() <= 45

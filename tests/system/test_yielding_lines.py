"""Wires that yield where they touch along lines: the law per length with its dents, from crossings to wires side by side."""

import numpy as np
import pytest

import litz
from line_wires import COPPER, along, pressed, two_wires
from line_wires import LED as GUIDED

YIELD, HARDNESS = 60e6, 168e6
BEHAVIOR = f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD={YIELD}, HARDNESS={HARDNESS}\n"
CLEAN = "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, VOLTAGE=LINEAR\n"
LENGTH = 20e-3
OVERLAPS = [1e-7, 6e-7, 1e-6, 9e-7, 7e-7, 9.5e-7, 1.3e-6, 1e-6, 0.4e-6, 1.2e-6]


def to(overlap, *, increments=1, extra=""):
    """The upper wire is lowered by `overlap` [m]."""
    return (
        f"*STEP, INC=1000\n*STATIC, DIRECT\n {1 / increments!r}, 1\n*BOUNDARY\n UPPER, 3, 3, {-overlap:.17g}\n"
        f" LOWER, 9, 9, 1.\n UPPER, 9, 9, 0.\n*ENERGY PRINT\n*NODE PRINT, NSET=UPPER, TOTALS=ONLY\n RF\n"
        f"{extra}*END STEP\n"
    )


def wires(*steps, degrees=0.0, elements=(8, 8), law=BEHAVIOR + CLEAN, interaction=""):
    lower, upper = (
        along(LENGTH, n, start=-LENGTH / 2, degrees=a, height=h)
        for n, a, h in zip(elements, (0.0, degrees), (0.0, 2 * COPPER.radius), strict=True)
    )
    return two_wires(lower, upper, GUIDED, *steps, law=law, interaction=interaction)


def law(force, largest=0.0):
    return litz.kernels.line_law(
        force, radius=COPPER.radius, young=COPPER.young, poisson=COPPER.poisson, resistivity=COPPER.resistivity,
        yield_stress=YIELD, largest_force_per_length=largest,
    )  # fmt: skip


def force_at(overlap, largest=0.0):
    """f of the law per length, by bisection."""
    low, high = 0.0, 3e4
    if overlap <= law(1e-6, largest).approach:
        return 0.0
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if law(middle, largest).approach < overlap else (low, middle)
    return low


def middle_of(results, step):
    """Places within the wires at the end of a step, away from the ends."""
    contacts = results.contacts
    last = contacts["increment"][contacts["step"] == step].max(initial=0)
    here = (contacts["step"] == step) & (contacts["increment"] == last) & (contacts["length"] > 0)
    here &= np.abs(contacts["point_1_x"]) < LENGTH / 4
    return {name: contacts[name][here] for name in ("force", "length", "resistance", "dent")}


@pytest.mark.parametrize("elements", [(8, 8), (8, 11)])
def test_parallel_wires_follow_the_law_per_length_with_its_memory(run, elements):
    process, results = run(wires(*(to(z) for z in OVERLAPS), elements=elements))
    assert process.returncode == 0, process.stderr
    largest = 0.0
    for step, z in enumerate(OVERLAPS, 1):
        found = middle_of(results, step)
        expected = force_at(z, largest)
        if not expected > 0:
            assert len(found["force"]) == 0
            continue
        assert found["force"] / found["length"] == pytest.approx(expected, rel=1e-7)
        exact = law(expected, largest)
        assert 1 / (found["resistance"] * found["length"]) == pytest.approx(exact.conductance, rel=1e-7)
        largest = max(largest, expected)
        assert found["dent"] == pytest.approx(law(expected, largest).dent, rel=1e-7)


def test_the_balance_of_energy_closes_with_what_yielding_dissipates(run):
    errors = []
    for n in (20, 40):
        _, results = run(wires(to(1.2e-6, increments=n), to(0, increments=n), to(1.2e-6, increments=n)))
        history = results.history
        errors.append(np.abs(history["ETOTAL"]).max() / history["ALLPD"][-1])
    assert errors[0] < 0.02
    assert errors[0] / errors[1] > 2.5


def total(results, step):
    contacts = results.contacts
    last = contacts["increment"][contacts["step"] == step].max(initial=0)
    here = (contacts["step"] == step) & (contacts["increment"] == last)
    return contacts["force"][here].sum(), (1 / contacts["resistance"][here]).sum()

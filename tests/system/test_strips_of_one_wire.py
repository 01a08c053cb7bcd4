"""Several strips on one wire: their currents meet in its section, which is a disc with strips on its rim."""

import math

import numpy as np
import pytest
from verification.references.parallel_wires import ParallelWires, PressedWire
from verification.references.strips_on_discs import from_arc_to_arc, from_each_of

from decks import wire
from line_wires import COPPER, HERTZ, along, material, spot, step

LENGTH, VOLTS = 20e-3, 1e-3
OVERLAP = 5e-7


def parallel(places, radii, pairs, potentials, voltage="LINEAR", elements=(8,)):
    """Straight wires along x through places in the y-z plane, which overlap: all nodes held, those with potentials at them."""
    names = [f"W{i}" for i in range(len(places))]
    chains = "".join(
        wire(name, along(LENGTH, elements[i % len(elements)]) + np.array([0.0, *place]), 1000 * i + 1, element="B33")
        for i, (name, place) in enumerate(zip(names, places, strict=True))
    )
    sections = "".join(
        material(name, PressedWire(radius, COPPER.young, COPPER.poisson, COPPER.resistivity))
        for name, radius in zip(names, radii, strict=True)
    )
    contact = (
        f"*SURFACE INTERACTION, NAME=TOUCH\n{HERTZ}"
        + spot(f"HERTZ, VOLTAGE={voltage}")
        + "".join(f"*CONTACT PAIR, INTERACTION=TOUCH, INTERFERENCE FIT\n W{a}, W{b}\n" for a, b in pairs)
    )
    held = "*BOUNDARY\n" + "".join(f" {name}, ENCASTRE\n" for name in names)
    prescribed = "*BOUNDARY\n" + "".join(f" W{i}, 9, 9, {value}\n" for i, value in potentials.items())
    return chains + sections + contact + held + step(prescribed)


def solved(outcome):
    process, results = outcome
    assert process.returncode == 0, process.stderr
    return results


def current_of(results):
    """From the supports at one potential to those at the other [A]."""
    entering = results.field("reaction_current", len(results.times) - 1)
    return entering[entering > 0].sum()


@pytest.mark.parametrize("voltage", ["LINEAR", "CORRECTED"])
@pytest.mark.parametrize("elements", [(8,), (8, 11, 9)], ids=["nodes match", "nodes do not match"])
def test_a_stack_of_wires_conducts_as_discs_between_opposite_arcs(run, voltage, elements):
    """Through the middle one from top to bottom, whose section is a disc between two arcs at potentials of their own."""
    step_up = 2 * COPPER.radius - OVERLAP
    deck = parallel(
        [(0, 0), (0, step_up), (0, 2 * step_up)], [COPPER.radius] * 3, [(0, 1), (1, 2)], {0: VOLTS, 2: 0.0}, voltage,
        elements,
    )  # fmt: skip
    results = solved(run(deck))
    pair = ParallelWires(COPPER, COPPER)
    beta = pair.half_width(pair.force(OVERLAP)) / COPPER.radius
    middle = from_arc_to_arc(COPPER.resistivity, beta)
    outer = pair.resistance_of_arc(pair.force(OVERLAP)) / 2
    # within an element of a held wire: from its nodes to where the current leaves it, rho l^2/(12 A) per length
    lengths = LENGTH / elements[0], LENGTH / elements[-1]
    inside = COPPER.resistivity / (math.pi * COPPER.radius**2) * sum(each**2 / 12 for each in lengths)
    expected = middle + 2 * outer + (inside if voltage == "CORRECTED" else 0)
    # the law has b/r in place of 2 sin(b/2r), and places have lumps of current; strips that do not meet would have 5 % less
    assert VOLTS * LENGTH / current_of(results) == pytest.approx(expected, rel=2e-3)
    heat = results.contacts_at(-1)["joule_heat"].sum() + results.field("joule_heat", len(results.times) - 1).sum()
    assert heat == pytest.approx(VOLTS * current_of(results), rel=1e-9)


def test_a_core_feeds_six_wires_around_it(run):
    """They share its section: each strip has less resistance than alone."""
    n, core = 6, 1.1e-3
    thick = PressedWire(core, COPPER.young, COPPER.poisson, COPPER.resistivity)
    pair = ParallelWires(thick, COPPER)
    distance = core + COPPER.radius - OVERLAP
    around = [(distance * math.cos(a), distance * math.sin(a)) for a in 2 * np.pi * np.arange(n) / n]
    deck = parallel(
        [(0, 0), *around], [core] + [COPPER.radius] * n, [(0, i + 1) for i in range(n)],
        {0: VOLTS, **dict.fromkeys(range(1, n + 1), 0.0)},
    )  # fmt: skip
    results = solved(run(deck))
    b = pair.half_width(pair.force(OVERLAP))
    core_to_strip = from_each_of(n, COPPER.resistivity, b / core)
    strip_to_wire = from_each_of(1, COPPER.resistivity, b / COPPER.radius)
    current = current_of(results)
    alone = pair.conductance(pair.force(OVERLAP))
    assert current / n / LENGTH / VOLTS == pytest.approx(1 / (core_to_strip + strip_to_wire), rel=2e-3)
    assert current / n / LENGTH / VOLTS > 1.05 * alone


def as_heat(deck, conductivity):
    """The same wires as insulators that conduct heat, with temperatures in place of potentials, once they overlap."""
    deck = deck.replace(f"*ELECTRICAL CONDUCTIVITY\n {1 / COPPER.resistivity:.17g}", f"*CONDUCTIVITY\n {conductivity}")
    deck = deck.replace(
        "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, VOLTAGE=CORRECTED", "*GAP CONDUCTANCE, LAW=CONDUCTIVITY"
    )
    before, pressed = deck.split("*STEP")
    prescribed = pressed[pressed.index("*BOUNDARY") :]
    temperatures = prescribed.replace(", 9, 9, ", ", 11, 11, ")
    static = "*STEP" + pressed.replace(prescribed, "*END STEP\n")
    return before + static + "*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n" + temperatures


@pytest.mark.parametrize("contacts", ["a stack", "a core"])
def test_heat_passes_as_the_current_does(run, contacts):
    """Strips side by side warm each other as they raise each other's potential, where the conductivity is that of 1/rho."""
    n, core = 6, 1.1e-3
    distance = core + COPPER.radius - OVERLAP
    around = [(distance * math.cos(a), distance * math.sin(a)) for a in 2 * np.pi * np.arange(n) / n]
    step_up = 2 * COPPER.radius - OVERLAP
    deck = {
        "a stack": parallel(
            [(0, 0), (0, step_up), (0, 2 * step_up)], [COPPER.radius] * 3, [(0, 1), (1, 2)], {0: VOLTS, 2: 0.0},
            "CORRECTED",
        ),
        "a core": parallel(
            [(0, 0), *around], [core] + [COPPER.radius] * n, [(0, i + 1) for i in range(n)],
            {0: VOLTS, **dict.fromkeys(range(1, n + 1), 0.0)}, "CORRECTED",
        ),
    }[contacts]  # fmt: skip
    current = current_of(solved(run(deck)))
    results = solved(run(as_heat(deck, 400.0)))
    entering = results.field("reaction_heat", len(results.times) - 1)
    assert entering[entering > 0].sum() / 400.0 == pytest.approx(current * COPPER.resistivity, rel=1e-6)
    # the equations are linear, and the tangent has what the strips do to each other
    assert results.status["iterations"][-1] <= 2

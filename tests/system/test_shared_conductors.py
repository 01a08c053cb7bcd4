"""Several contacts on the same element: their currents are those of Kirchhoff's laws, whatever the mesh."""

import itertools

import numpy as np
import pytest

from decks import CONDUCTOR, straight, wire

RADIUS = 1e-3
RESISTANCE_PER_LENGTH = 1 / (5e7 * np.pi * RADIUS**2)
RAILS = (-0.02, 0.015)
RUNGS = (-0.031, -0.012, 0.003, 0.004, 0.027)
HALF = 0.05


def ladder(elements, controls="", spot="LAW=HERTZ"):
    """Two rails along x and five rungs across them, pressed into each other by moving all nodes of the rungs.

    Every wire has the same number of elements: with one, a rail has five contacts on its element and a rung two.
    """
    cards = ["*HEADING\nladder of a test\n"]
    for i, y in enumerate(RAILS):
        cards.append(wire("RAILS", straight((-HALF, y, 0), (HALF, y, 0), elements), 1 + 100 * i, element="B33"))
    for i, x in enumerate(RUNGS):
        points = straight((x, -HALF, 2 * RADIUS), (x, HALF, 2 * RADIUS), elements)
        cards.append(wire("RUNGS", points, 1001 + 100 * i, element="B33"))
    return (
        "".join(cards)
        + f"""\
*ELSET, ELSET=WIRES
 RAILS, RUNGS
{CONDUCTOR.strip()}
*BEAM SECTION, ELSET=WIRES, MATERIAL=COPPER, SECTION=CIRC
 {RADIUS}
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ
*GAP ELECTRICAL CONDUCTANCE, {spot}
*CONTACT PAIR, INTERACTION=TOUCH
 RAILS, RUNGS
*BOUNDARY
 RAILS, ENCASTRE
 RUNGS, 1, 2
 RUNGS, 4, 5
*STEP
*STATIC
 0.5, 1.
*BOUNDARY
 RUNGS, 3, 3, -1e-6
 1, 9, 9, 1e-3
 {101 + elements}, 9, 9, 0
*NODE PRINT, NSET=RAILS
 RCURR
{controls}
*END STEP
"""
    )


def kirchhoff(resistance):
    """Current from the first node of one rail to the last of the other, 1 mV between them, and those of the contacts."""
    rows = {}

    def row(*name):
        return rows.setdefault(name, len(rows))

    links = []
    for rail in range(2):
        places = [
            (-HALF, ("end", rail, 0)),
            *((x, ("rail", rail, i)) for i, x in enumerate(RUNGS)),
            (HALF, ("end", rail, 1)),
        ]
        for (a, first), (b, second) in itertools.pairwise(places):
            links.append((row(*first), row(*second), 1 / (RESISTANCE_PER_LENGTH * (b - a))))
    for i in range(len(RUNGS)):
        links.append((row("rung", 0, i), row("rung", 1, i), 1 / (RESISTANCE_PER_LENGTH * (RAILS[1] - RAILS[0]))))
        links += [(row("rail", rail, i), row("rung", rail, i), 1 / resistance[rail, i]) for rail in range(2)]
    matrix = np.zeros((len(rows), len(rows)))
    for a, b, value in links:
        matrix[[a, b], [a, b]] += value
        matrix[[a, b], [b, a]] -= value
    potential = np.zeros(len(rows))
    held = [row("end", 0, 0), row("end", 1, 1)]
    potential[held[0]] = 1e-3
    free = np.setdiff1d(np.arange(len(rows)), held)
    potential[free] = np.linalg.solve(matrix[np.ix_(free, free)], -(matrix @ potential)[free])
    through = [
        [
            (potential[row("rail", rail, i)] - potential[row("rung", rail, i)]) / resistance[rail, i]
            for i in range(len(RUNGS))
        ]
        for rail in range(2)
    ]
    return (matrix @ potential)[held[0]], np.array(through)


def by_place(contacts, name):
    """A column of the ledger by rail and rung."""
    values = np.empty((2, len(RUNGS)))
    rail = np.argmin(np.abs(contacts["point_2_y"][:, None] - RAILS), axis=1)
    rung = np.argmin(np.abs(contacts["point_2_x"][:, None] - RUNGS), axis=1)
    values[rail, rung] = contacts[name]
    assert len(contacts["id"]) == values.size
    return values


# the last spot leaves only the wires between its contacts
@pytest.mark.parametrize("spot", ["LAW=HERTZ", "LAW=CONSTANT\n 1e-9"])
@pytest.mark.parametrize(
    "controls",
    [
        "",
        "*SOLVER, NAME=BLOCK, COUPLING=MONOLITHIC",
        "*SOLVER, NAME=UMFPACK",
        "*SOLVER, NAME=SKYLINE, COUPLING=UPDATED",
    ],
    ids=["block", "block monolithic", "umfpack", "skyline updated"],
)
@pytest.mark.parametrize("elements", [1, 2, 20])
def test_the_ladder_is_the_network_of_its_wires(run, elements, controls, spot):
    process, results = run(ladder(elements, controls, spot))
    assert process.returncode == 0, process.stderr
    contacts = results.contacts_at(-1)
    current, through = kirchhoff(by_place(contacts, "resistance"))
    entering = results.field("reaction_current")
    assert entering.max() == pytest.approx(current, rel=1e-9)
    np.testing.assert_allclose(by_place(contacts, "current"), through, rtol=1e-8, atol=1e-9 * np.abs(through).max())
    # power in is heat in spots and wires
    heat = results.field("joule_heat").sum() + contacts["joule_heat"].sum()
    assert heat == pytest.approx(1e-3 * current, rel=1e-9)
    # the first piece of the first rail carries all of it
    assert np.abs(results.wire_currents()[0]) == pytest.approx(current, rel=1e-9)


def test_linear_voltages_stay_those_of_the_paper(run):
    """VOLTAGE=LINEAR: each contact sees the voltages of its element's nodes alone."""
    process, results = run(ladder(1, spot="LAW=HERTZ, VOLTAGE=LINEAR"))
    assert process.returncode == 0, process.stderr
    contacts = results.contacts_at(-1)
    potential = dict(zip(results.element_ids, results.field("potential")[results.elements], strict=True))

    def at(element, xi):
        first, second = potential[element]
        return (1 - xi) / 2 * first + (1 + xi) / 2 * second

    for row in range(len(contacts["id"])):
        voltage = at(contacts["element_1"][row], contacts["xi_1"][row]) - at(
            contacts["element_2"][row], contacts["xi_2"][row]
        )
        assert contacts["current"][row] == pytest.approx(voltage / contacts["resistance"][row], rel=1e-9)

"""Currents through one contact of two wires of different metals: potentials and heat are those of the resistances."""

import numpy as np
import pytest

from decks import straight, wire

#: Of the lower and of the upper wire: radius [m], conductivity [S/m]
RADII, CONDUCTIVITIES = (1e-3, 0.7e-3), (5e7, 1e7)
#: Where the wires cross, from the first end of each [m], and their lengths [m]
CROSSING, LENGTHS = (0.033, 0.019), (0.1, 0.06)
PER_LENGTH = [
    1 / (conductivity * np.pi * radius**2) for radius, conductivity in zip(RADII, CONDUCTIVITIES, strict=True)
]
SPOT = 2e-4
CURRENT = 3.0


def crossing(cards, elements=(5, 3), *, held=1, touching=True, later="", backwards=((), ())):
    """Wires that cross within elements, all nodes held, and the potential of node `held`.

    In the first step they are pressed into each other, or moved apart, in the second `cards` feed them.
    """
    height = sum(RADII)
    lower = wire("LOWER", straight((0, 0, 0), (LENGTHS[0], 0, 0), elements[0]), 1, backwards=backwards[0])
    start = (CROSSING[0], -CROSSING[1], height)
    upper = wire(
        "UPPER",
        straight(start, (CROSSING[0], LENGTHS[1] - CROSSING[1], height), elements[1]),
        101,
        backwards=backwards[1],
    )
    materials = "".join(
        f"*MATERIAL, NAME={name}\n*ELASTIC\n 120e9, 0.34\n*ELECTRICAL CONDUCTIVITY\n {conductivity}\n"
        f"*BEAM SECTION, ELSET={name}, MATERIAL={name}, SECTION=CIRC\n {radius}\n"
        for name, radius, conductivity in zip(("LOWER", "UPPER"), RADII, CONDUCTIVITIES, strict=True)
    )
    return f"""{upper}{lower}{materials}*NSET, NSET=PLUS
 1
*NSET, NSET=MINUS
 101
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
 1e6
*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT
 {SPOT}
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*BOUNDARY
 LOWER, ENCASTRE
 UPPER, 1, 2
 UPPER, 4, 6
*STEP
*STATIC
 0.5, 1.
*BOUNDARY
 UPPER, 3, 3, {-1e-6 if touching else 1e-6}
 {held}, 9
*END STEP
*STEP
*STATIC
 0.5, 1.
{cards}*END STEP
{later}"""


#: 3 A into the first end of the lower wire, and out of the first end of the upper one
THROUGH = f"*CECURRENT\n 1, , {CURRENT}\n"


def potential_of(results, node):
    return results.field("potential")[np.flatnonzero(results.node_ids == node)[0]]


def heat_of(results, name):
    return results.field("joule_heat")[results.element_sets[name]].sum()


@pytest.mark.parametrize("elements", [(5, 3), (1, 1), (3, 7)])
def test_each_wire_has_the_heat_of_the_current_up_to_its_contact(run, elements):
    """I^2 R of the part between its end and the contact, wherever in an element that lies; the spot has I^2 R_c."""
    process, results = run(crossing(THROUGH, elements, held=101))
    assert process.returncode == 0, process.stderr
    for side, name in enumerate(("LOWER", "UPPER")):
        heat = CURRENT**2 * PER_LENGTH[side] * CROSSING[side]
        assert heat_of(results, name) == pytest.approx(heat, rel=1e-9)
    assert results.contacts_at(-1)["joule_heat"] == pytest.approx(CURRENT**2 * SPOT, rel=1e-9)


def test_a_wire_that_is_fed_through_a_contact_is_no_floating_one(run):
    """The current passes the contact, and all voltages are those of Ohm's law."""
    process, results = run(crossing(THROUGH, held=101))
    assert process.returncode == 0, process.stderr
    arms = [CURRENT * PER_LENGTH[side] * CROSSING[side] for side in range(2)]
    contact = results.contacts_at(-1)
    assert contact["current"] == pytest.approx(CURRENT, rel=1e-9)
    assert contact["voltage_gap"] == pytest.approx(CURRENT * SPOT, rel=1e-9)
    assert potential_of(results, 1) == pytest.approx(arms[0] + CURRENT * SPOT + arms[1], rel=1e-9)
    # behind the contact there is no current
    assert potential_of(results, 6) == pytest.approx(arms[1] + CURRENT * SPOT, rel=1e-9)
    assert potential_of(results, 104) == pytest.approx(arms[1], rel=1e-9)


def test_a_wire_that_only_touches_takes_the_potential_at_its_contact(run):
    """Nothing is fed into it and nothing holds it: no current passes the contact."""
    voltage = 1e-3
    process, results = run(crossing(f"*BOUNDARY\n 1, 9, 9, {voltage}\n 6, 9, 9, 0\n"))
    assert process.returncode == 0, process.stderr
    contact = results.contacts_at(-1)
    assert contact["current"] == pytest.approx(0, abs=1e-12 * voltage / SPOT)
    there = voltage * (1 - CROSSING[0] / LENGTHS[0])
    upper = results.field("potential")[results.node_sets["UPPER"]]
    np.testing.assert_allclose(upper, there, rtol=1e-12)
    assert heat_of(results, "UPPER") < 1e-20
    assert heat_of(results, "LOWER") == pytest.approx(voltage**2 / (PER_LENGTH[0] * LENGTHS[0]), rel=1e-9)


def test_a_wire_that_has_lost_its_contact_keeps_its_potential_while_others_change(run):
    """Apart from the wire that is held, it stays at what it had; closed again, it follows."""
    again = "".join(
        f"*STEP\n*STATIC\n 0.5, 1\n*BOUNDARY\n UPPER, 3, 3, {z}\n 1, 9, 9, {v}\n*END STEP\n"
        for z, v in ((1e-6, 1e-3), (1e-6, 4e-3), (-1e-6, 4e-3))
    )
    process, results = run(crossing("*BOUNDARY\n 1, 9, 9, 1e-3\n", later=again))
    assert process.returncode == 0, process.stderr
    upper = results.field("potential", None)[:, results.node_sets["UPPER"]]
    ends = [upper[results.index(step, results.increments[results.steps == step].max())] for step in (2, 3, 4, 5)]
    for values, expected in zip(ends, (1e-3, 1e-3, 1e-3, 4e-3), strict=True):
        np.testing.assert_allclose(values, expected, rtol=1e-12)


def test_a_current_into_a_wire_that_touches_no_other_is_refused(run):
    process, _ = run(crossing(THROUGH, held=101, touching=False))
    assert process.returncode == 2
    assert (
        "a current is fed into the conductor at node 1, which has no path to a prescribed potential" in process.stderr
    )


def test_one_node_that_is_held_anywhere_holds_a_conductor(run):
    """In the middle of the wire: both ends can be fed."""
    process, results = run(crossing("*CECURRENT\n 1, , 2\n 6, , 1\n", held=3, touching=False))
    assert process.returncode == 0, process.stderr
    assert results.field("reaction_current")[results.node_ids == 3] == pytest.approx([-3], rel=1e-12)
    assert potential_of(results, 1) == pytest.approx(2 * PER_LENGTH[0] * LENGTHS[0] * 2 / 5, rel=1e-9)


def test_two_wires_that_conduct_do_not_feed_an_insulator(run):
    """The upper one is made of an insulator: it touches, and no current passes."""
    deck = crossing("*BOUNDARY\n 1, 9, 9, 1e-3\n 6, 9\n").replace(
        f"*ELECTRICAL CONDUCTIVITY\n {CONDUCTIVITIES[1]}\n", ""
    )
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    contact = results.contacts_at(-1)
    assert contact["force"] == pytest.approx(1e6 * 1e-6, rel=1e-6)
    assert np.isposinf(contact["resistance"]).all()
    assert not contact["current"].any()


def test_the_network_knows_its_wires_by_whatever_numbers_and_directions_their_elements_have(run):
    """The upper wire comes first in the deck, so that the numbers of elements fall; some run against their wire."""
    printed = "*ELECTRODE PRINT\n PLUS, MINUS\n"
    process, results = run(crossing(THROUGH + printed, held=101, backwards=((1, 3), (1, 2))))
    assert process.returncode == 0, process.stderr
    assert list(np.sign(np.diff(results.element_ids))) == [1, 1, -1, 1, 1, 1, 1]
    network = results.contact_network()
    assert network.first_element.tolist() == [101, 1]
    np.testing.assert_allclose(network.wire_length, LENGTHS[::-1], rtol=1e-9)
    # the barred wire, named first in the contact pair, is the lower one
    assert network.wires.tolist() == [[1, 0]]
    np.testing.assert_allclose(network.arc, [CROSSING], rtol=1e-9)
    # up the lower wire and back to the first node of the upper one
    np.testing.assert_allclose(network.wire_current, [-CURRENT, CURRENT], rtol=1e-9)
    voltage = potential_of(results, 1)
    assert results.conductance("PLUS", "MINUS") == pytest.approx(CURRENT / voltage, rel=1e-9)
    # the history has the same of the electrodes: the current is fed in there, and no reaction
    assert results.history["current PLUS to MINUS"][-1] == pytest.approx(CURRENT, rel=1e-9)
    assert results.history["resistance PLUS to MINUS"][-1] == pytest.approx(voltage / CURRENT, rel=1e-9)


def test_the_current_of_a_wire_is_negative_where_it_flows_from_its_last_to_its_first_node(run):
    """Fed in at the other end, through elements of both directions."""
    process, results = run(crossing(f"*CECURRENT\n 6, , {CURRENT}\n", held=101, backwards=((1, 3), (1, 2))))
    assert process.returncode == 0, process.stderr
    np.testing.assert_allclose(results.wire_currents(), [-CURRENT, -CURRENT], rtol=1e-9)

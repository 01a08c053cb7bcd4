"""What *NODE PRINT and *EL PRINT write over time is what the result file holds; what a step and its contacts are told of."""

import re

import numpy as np
import pytest

from decks import crossed, grid
from litz.results.history_table import history_table

#: Quantity of a node: the field of the result file, and its unit
OF_NODES = {
    "U": ("displacement", "m"),
    "UR": ("rotation", "rad"),
    "RF": ("reaction_force", "N"),
    "RM": ("reaction_moment", "N m"),
    "CF": ("applied_force", "N"),
    "CM": ("applied_moment", "N m"),
    "EPOT": ("potential", "V"),
    "RCURR": ("reaction_current", "A"),
    "CECUR": ("applied_current", "A"),
}
PRINTED = f"""\
*CLOAD
 13, 2, 1e-3
 13, 4, 2e-6
*CECURRENT
 4, , 3e-3
*NODE PRINT, NSET=SOME
 {", ".join(list(OF_NODES)[:5])}
*NODE PRINT, NSET=SOME
 {", ".join(list(OF_NODES)[5:])}
*EL PRINT, ELSET=UPPER, TOTALS=YES
 SF, EPG, JOULE"""
SOME = (4, 11, 13)


@pytest.fixture
def printed(run):
    """Results of the crossed wires, pressed and loaded, with columns of three nodes."""
    deck = crossed(extra=PRINTED, static="0.5, 1, 1e-3, 0.5").replace(
        "*NSET, NSET=LOWER_ENDS", f"*NSET, NSET=SOME\n {', '.join(map(str, SOME))}\n*NSET, NSET=LOWER_ENDS"
    )
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    return results


@pytest.mark.parametrize("quantity", OF_NODES)
def test_columns_of_nodes_are_the_fields_of_the_result_file(printed, quantity):
    name, unit = OF_NODES[quantity]
    rows = {int(node): i for i, node in enumerate(printed.node_ids)}
    largest = 0.0
    for increment in range(len(printed.times)):
        field = printed.field(name, increment).reshape(len(rows), -1)
        for node in SOME:
            for component, value in enumerate(field[rows[node]], 1):
                column = f"{quantity}{component if field.shape[1] > 1 else ''} node {node}"
                assert printed.history.units[column] == unit
                # both are written with all digits of the same numbers
                assert printed.history[column][increment] == value
                largest = max(largest, abs(value))
    assert largest > 0


def test_totals_of_elements_are_sums_of_what_adds_up_and_means_of_the_rest(printed):
    upper = printed.element_ids >= 11
    history = printed.history
    assert history["JOULE sum UPPER"][-1] == pytest.approx(printed.field("joule_heat")[upper].sum(), rel=1e-12)
    assert history["current mean UPPER"][-1] == pytest.approx(printed.field("element_current")[upper].mean(), rel=1e-12)
    forces = [printed.field(name)[upper].mean() for name in ("axial_force", "shear_force_2", "shear_force_3")]
    columns = [history[f"{name} mean UPPER"][-1] for name in ("N", "Q2", "Q3")]
    # to round-off of the largest of them
    assert columns == pytest.approx(forces, abs=1e-12 * np.abs(forces).max())


def test_a_step_that_needs_more_increments_than_it_may_have_ends_in_words(run):
    """Increments are cut where the first one fails; here INC= leaves none for the rest."""
    deck = crossed(static="0.25, 1, 1e-3, 0.5").replace("*STEP, INC=200", "*STEP, INC=2")
    process, results = run(deck)
    assert process.returncode == 2
    told = re.search(r"step 1: the 2 increments of INC= are used up at step time +(\S+) of +(\S+)", process.stderr)
    assert [float(time) for time in told.groups()] == pytest.approx([results.times[-1], 1.0])
    # the start and two increments
    assert results.times.tolist() == [0, 0.25, 0.5]


def test_a_current_into_a_conductor_without_a_potential_is_refused(run):
    deck = crossed(push="0", extra="*CECURRENT\n 13, , 1e-3").replace(" 11, 9, 9, 0\n", "")
    process, _ = run(deck)
    assert process.returncode == 2
    assert (
        "a current is fed into the conductor at node 13, which has no path to a prescribed potential" in process.stderr
    )


def test_contacts_below_ten_degrees_are_remarked(run):
    """The upper wire lies 8 degrees from the lower one, with a surface interaction for contact at points."""
    turn = np.radians(8)
    deck = crossed(push="-2e-5").replace("*CONTACT PAIR", "*FRICTION, STICK STIFFNESS=1e6\n 0.1\n*CONTACT PAIR", 1)
    for node, y in ((11, -0.05), (12, -0.02), (13, -0.005), (14, 0.006), (15, 0.02), (16, 0.05)):
        old = next(line for line in deck.splitlines() if line.startswith(f" {node}, 0, "))
        deck = deck.replace(old, f" {node}, {y * np.cos(turn):.17g}, {y * np.sin(turn):.17g}, 2e-3", 1)
    process, results = run(deck)
    assert process.returncode == 0, process.stderr
    assert len(results.contacts_at(-1)["force"]) == 1
    assert np.degrees(results.contacts_at(-1)["angle"][0]) == pytest.approx(8, abs=0.1)
    assert "1 contacts cross at less than 10 degrees" in results.status["remark"][-1]


def test_the_contacts_and_their_force_are_those_of_the_increment(run):
    """Four equal contacts, pressed in a first step and half released in a second one of as many increments."""
    release = "*STEP\n*STATIC\n 0.5, 1\n*BOUNDARY\n UPPER, 3, 3, -1e-5\n*END STEP\n"
    process, results = run(grid(2).replace("*STATIC\n 1., 1.", "*STATIC\n 0.5, 1.") + release)
    assert process.returncode == 0, process.stderr
    overlap = np.array([0, 1e-5, 2e-5, 1.5e-5, 1e-5])
    shown = [line.split() for line in history_table(results).splitlines()[2:]]
    for i in range(5):
        contacts = results.contacts_at(i)
        assert len(contacts["id"]) == (0 if i == 0 else 4)
        # a penalty of 1e5 N/m between wires that hardly bend between their nodes
        assert contacts["force"] == pytest.approx(1e5 * overlap[i], rel=1e-2)
        assert float(shown[i][1]) == len(contacts["id"])
        assert float(shown[i][2]) == pytest.approx(contacts["force"].sum(), rel=1e-6)

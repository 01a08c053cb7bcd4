"""Which contact pair two elements belong to, where several name them."""

import pytest

from decks import crossed, pair_of_wires, straight, wire

OVERLAP = 1e-6
PENALTIES = {"ALL": 1e5, "SOFT": 2e4}


def held(*pairs):
    """Crossed wires, every node held, pressed together; the pairs are (interaction, sets)."""
    deck = crossed(
        push="0", behavior=f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n {PENALTIES['ALL']}", spot="",
        extra=f"*BOUNDARY\n UPPER, 3, 3, {-OVERLAP}",
    )  # fmt: skip
    deck = deck.replace(" LOWER_ENDS, 1, 6\n", " LOWER, 1, 6\n UPPER, 1, 2\n UPPER, 4, 6\n", 1)
    deck = deck.replace(" UPPER_ENDS, 3, 3, 0\n", "").replace("NAME=SPOT\n", "NAME=ALL\n")
    cards = "*SURFACE INTERACTION, NAME=SOFT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n 2e4\n"
    cards += "".join(f"*CONTACT PAIR, INTERACTION={name}\n {sets}\n" for name, sets in pairs)
    return deck.replace("*CONTACT PAIR, INTERACTION=SPOT\n LOWER, UPPER\n", cards)


@pytest.mark.parametrize(("first", "last"), [("ALL", "SOFT"), ("SOFT", "ALL")])
def test_the_last_pair_that_names_both_elements_counts(run, first, last):
    process, results = run(held((first, "WIRES, WIRES"), (last, "LOWER, UPPER")))
    assert process.returncode == 0, process.stderr
    assert results.contacts_at(-1)["force"] == pytest.approx([PENALTIES[last] * OVERLAP], rel=1e-9)


def test_the_set_that_is_named_first_is_the_barred_one(run):
    for name, sets, element in (("forward", "LOWER, UPPER", 3), ("backward", "UPPER, LOWER", 13)):
        process, results = run(held(("SOFT", "WIRES"), ("ALL", sets)), name=name)
        assert process.returncode == 0, process.stderr
        assert results.contacts_at(-1)["element_1"].tolist() == [element]


@pytest.mark.parametrize(
    "pairs",
    ["LEFT, B\n*CONTACT PAIR, INTERACTION=TOUCH\n B, RIGHT", "WIRES\n*CONTACT PAIR, INTERACTION=TOUCH\n B, RIGHT"],
)
def test_a_contact_keeps_its_memory_where_the_next_pair_names_its_wires_in_the_other_order(run, pairs):
    """B is pressed on the left half of A and dragged to the right half, which another pair names: one contact."""
    deck = pair_of_wires(
        wire("A", straight((-0.06, 0, 0), (0.06, 0, 0), 12), 1, element="B33"),
        wire("B", straight((-0.016, -0.06, 0.002), (-0.016, 0.06, 0.002), 12), 101, element="B33"),
        "1, 1, 6\n13, 1, 6\n101, 1, 2\n101, 4, 6\n113, 1, 2\n113, 4, 6\n",
        "101, 3, 3, -6e-5\n113, 3, 3, -6e-5\n",
    ).replace("*SURFACE INTERACTION, NAME=TOUCH\n", "*SURFACE INTERACTION, NAME=TOUCH\n*FRICTION\n 0.3\n")
    sets = "*ELSET, ELSET=LEFT\n 1, 2, 3, 4, 5, 6\n*ELSET, ELSET=RIGHT\n 7, 8, 9, 10, 11, 12\n"
    drag = "*STEP\n*STATIC\n1., 1.\n*BOUNDARY\n101, 1, 1, 0.03\n113, 1, 1, 0.03\n*END STEP\n"
    identities, heat = [], []
    for name, named in (("one", "A, B"), ("two", pairs)):
        text = deck.replace("\n A, B\n*BOUNDARY", f"\n {named}\n{sets}*BOUNDARY", 1) + drag
        process, results = run(text, name=name)
        assert process.returncode == 0, process.stderr
        identities.append(results.contacts_at(-1)["id"].tolist())
        heat.append(results.contacts_at(-1)["dissipation"][0])
    assert identities == [[1], [1]]
    assert heat[1] == pytest.approx(heat[0], rel=1e-9)

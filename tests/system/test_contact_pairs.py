"""Which contact pair two elements belong to, where several name them."""

import pytest

from decks import crossed

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

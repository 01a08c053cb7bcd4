"""Rigid bodies with one mistake each: what is said about it, and where."""

import pytest

from test_bad_decks import DECK, check_one_error, errors_in

#: Node 3 moves with node 9, which belongs to no element
CARD = "*RIGID BODY, REF NODE=9, TIE NSET=END"
GOOD = DECK.replace(
    "*MATERIAL", f"*NODE\n9, -0.02, 0., 0.\n*NSET, NSET=END\n3\n*NSET, NSET=FAR\n4\n{CARD}\n*MATERIAL"
).replace("3, 1, 6\n", "9, 1, 6\n")


def line_number(deck, text):
    return max(i for i, line in enumerate(deck.splitlines(), 1) if line == text)


AT = f"bad.inp:{line_number(GOOD, CARD)}"


def test_the_deck_without_a_mistake_is_accepted(litz, tmp_path):
    (tmp_path / "good.inp").write_text(GOOD)
    result = litz("check", "good.inp", cwd=tmp_path)
    assert (result.returncode, result.stderr) == (0, "")


@pytest.mark.parametrize(
    ("card", "message", "marked"),
    [
        ("REF NODE=99, TIE NSET=END", "there is no node 99", "99"),
        ("REF NODE=NOPE, TIE NSET=END", 'there is no node set "NOPE"', "NOPE"),
        ("REF NODE=PLUS, TIE NSET=END", "a rigid body has one reference node; the node set PLUS has 2 members", "PLUS"),
        ("TIE NSET=END", "*RIGID BODY needs the parameter REF NODE=...", "RIGID BODY"),
        ("REF NODE=9", "*RIGID BODY needs the parameter TIE NSET=... or PIN NSET=...", "RIGID BODY"),
        ("REF NODE=9, TIE NSET=AND", 'there is no node set "AND"; did you mean END?', "AND"),
        (
            "REF NODE=9, PIN NSET=UPPER",
            "(there is an element set of this name; *NSET, NSET=..., ELSET=... has its nodes)",
            "UPPER",
        ),
        ("REF NODE=9, TIE NSET=3", "(a name is needed here; a set may hold one node)", "3"),
        ("REF NODE=3, TIE NSET=END", "node 3 of END is the reference node of this rigid body", "END"),
        ("REF NODE=3, PIN NSET=END", "node 3 of END is the reference node of this rigid body", "END"),
        ("REF NODE=9, TIE NSET=END, PIN NSET=END", "node 3 is in TIE NSET and in PIN NSET", "RIGID BODY"),
        ("REF NODE=9, TIE NSET=END, NSET=END", "NSET means the same as TIE NSET; give one of them", "END"),
        ("REF NODE=9, NSET=END, ROT NODE=9", "REF NODE has the rotations, too: degrees of freedom 4-6", "ROT NODE"),
    ],
)
def test_a_card_with_a_mistake(litz, tmp_path, card, message, marked):
    """One error: that node 9, which is held, belongs to no element would follow from it."""
    deck = GOOD.replace(CARD, f"*RIGID BODY, {card}")
    line = f"*RIGID BODY, {card}"
    if marked == "END":
        # the caret stands below the last name of the set
        (tmp_path / "bad.inp").write_text(deck)
        (error,) = errors_in(litz("check", "bad.inp", cwd=tmp_path))
        assert message in error["message"]
        assert (int(error["line"]), int(error["column"])) == (line_number(deck, line), line.rindex("END") + 1)
    else:
        check_one_error(litz, tmp_path, deck, message, line_number(deck, line), marked)


@pytest.mark.parametrize(
    ("second", "message"),
    [
        ("REF NODE=9, TIE NSET=FAR", f"node 9 is the reference node of two rigid bodies; the other is in {AT}"),
        ("REF NODE=2, TIE NSET=END", f"node 3 would move with two rigid bodies; the other is in {AT}"),
        ("REF NODE=2, PIN NSET=END", f"node 3 would move with two rigid bodies; the other is in {AT}"),
        ("REF NODE=3, TIE NSET=FAR", f"the reference node of this rigid body, 3, moves with the rigid body in {AT}"),
    ],
)
def test_two_rigid_bodies_that_exclude_each_other(litz, tmp_path, second, message):
    deck = GOOD.replace(CARD, f"{CARD}\n*RIGID BODY, {second}").replace("4, 1, 6\n", "")
    check_one_error(litz, tmp_path, deck, message, line_number(deck, f"*RIGID BODY, {second}"), "RIGID BODY")


@pytest.mark.parametrize(
    ("kind", "cards", "line", "dof"),
    [
        ("TIE", "3, 1, 6\n", "3, 1, 6", 1),
        ("TIE", "3, 6\n", "3, 6", 6),
        ("TIE", "3, ENCASTRE\n", "3, ENCASTRE", 1),
        ("TIE", "END, 2, 2, 1e-3\n", "END, 2, 2, 1e-3", 2),
        ("TIE", "*CLOAD\n3, 5, 1e-3\n", "3, 5, 1e-3", 5),
        ("PIN", "3, 3, 6\n", "3, 3, 6", 3),
        ("PIN", "*CLOAD\n3, 1, 1e-3\n", "3, 1, 1e-3", 1),
    ],
)
def test_values_of_nodes_that_move_with_others(litz, tmp_path, kind, cards, line, dof):
    deck = GOOD.replace("TIE", kind).replace("3, 9, 9, 0.01\n", f"3, 9, 9, 0.01\n{cards}")
    message = f"node 3 has no degree of freedom {dof} of its own: it moves with node 9, the reference node of the"
    check_one_error(litz, tmp_path, deck, f"{message} *RIGID BODY in {AT}", line_number(deck, line), line.split(",")[0])


def test_what_is_free_at_a_node_can_be_prescribed_and_loaded(litz, tmp_path):
    """Rotations of pinned nodes, and potentials."""
    deck = GOOD.replace("TIE", "PIN").replace("9, 1, 6\n", "9, 1, 6\n3, 4, 5\n").replace("2, 4, 1e-6\n", "3, 6, 1e-6\n")
    (tmp_path / "good.inp").write_text(deck)
    result = litz("check", "good.inp", cwd=tmp_path)
    assert (result.returncode, result.stderr) == (0, "")


def test_a_rigid_body_of_loose_nodes(litz, tmp_path):
    deck = GOOD.replace("*NSET, NSET=END\n3\n", "*NODE, NSET=END\n10, 0., 0., 1.\n").replace("9, 1, 6\n", "3, 1, 6\n")
    message = "no node of this rigid body belongs to an element"
    check_one_error(litz, tmp_path, deck, message, line_number(deck, CARD), "RIGID BODY")


@pytest.mark.parametrize("keyword", ["COUPLING, REF NODE=9", "KINEMATIC COUPLING", "MPC"])
def test_other_constraints_lead_to_rigid_bodies(litz, tmp_path, keyword):
    (tmp_path / "bad.inp").write_text(DECK.replace("*MATERIAL", f"*{keyword}\n*MATERIAL", 1))
    result = litz("check", "bad.inp", cwd=tmp_path)
    assert result.returncode == 1
    assert "nodes that move with another one are a *RIGID BODY, REF NODE=..., TIE NSET=..." in result.stderr


@pytest.mark.parametrize(
    "cards", ["*KINEMATIC COUPLING, REF NODE=9\nEND, 1, 5\n", "*COUPLING, REF NODE=9, SURFACE=S\n*KINEMATIC\n1, 5\n"]
)
def test_what_follows_from_a_coupling_that_litz_lacks_is_not_told(litz, tmp_path, cards):
    """That the reference node is of no element, and that the card of the coupled motions is another one litz lacks."""
    begin = GOOD.index("*RIGID BODY")
    stop = GOOD.index("*", begin + 1)
    (tmp_path / "bad.inp").write_text(GOOD[:begin] + cards + GOOD[stop:])
    result = litz("check", "bad.inp", cwd=tmp_path)
    assert result.returncode == 1
    assert result.stderr.count("error: ") == 1
    assert "COUPLING: nodes that move with another one are a *RIGID BODY" in result.stderr

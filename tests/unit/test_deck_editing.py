"""litz.Deck: decks read, changed and written; litz.keywords and the checks of cards."""

import json
from pathlib import Path

import numpy as np
import pytest

import litz
from litz.deck.keyword_table import check_card

INPUTS = sorted((Path(__file__).parents[2] / "inputs").glob("*.inp"))

DECK = """\
** what the deck is about
*HEADING
 a heading, with a comma
*Node, nset=ALL
 1, 0., 0., 0.{blanks}
** between the nodes
 2,\t1.,0 , 0.

*ELEMENT, TYPE=B31,
** in the middle of a keyword line
 ELSET="first wire"
 1, 1, 2
*step, inc=10
*STATIC
*BOUNDARY
 1, 1, 6
*END STEP
*STEP
*STATIC, DIRECT
 0.5, 1.
*END STEP
** the end""".replace("{blanks}", "   ")


@pytest.mark.parametrize("path", INPUTS, ids=lambda path: path.stem)
def test_a_deck_is_written_byte_by_byte_as_it_was_read(path, tmp_path):
    assert litz.Deck.read(path).write(tmp_path / path.name).read_bytes() == path.read_bytes()


@pytest.mark.parametrize("text", [DECK, DECK.replace("\n", "\r\n"), "\ufeff" + DECK, "", "** only\n\n", "*HEADING"])
def test_any_form_of_a_deck_comes_back(text, tmp_path):
    path = tmp_path / "deck.inp"
    path.write_bytes(text.encode())
    assert litz.Deck.read(path).write(tmp_path / "copy.inp").read_bytes() == text.encode()


def test_bytes_that_are_no_utf_8_come_back(tmp_path):
    path = tmp_path / "deck.inp"
    path.write_bytes(b"*HEADING\n R\xf6hre\n")
    assert litz.Deck.read(path).write(tmp_path / "copy.inp").read_bytes() == path.read_bytes()


def test_cards_know_their_keyword_parameters_and_data():
    deck = litz.Deck.parse(DECK)
    assert [card.name for card in deck][:4] == ["HEADING", "NODE", "ELEMENT", "STEP"]
    element = deck.card("element")
    assert element.parameters == {"TYPE": "B31", "ELSET": "first wire"}
    assert element["Elset"] == "first wire"
    assert deck.card("STEP", step=1)["INC"] == 10
    assert deck.card("NODE").data == [[1, 0.0, 0.0, 0.0], [2, 1.0, 0, 0.0]]
    assert deck.card("HEADING").comments == ["** what the deck is about\n"]
    assert deck.card("STATIC", step=2)["DIRECT"] is True
    assert "DIRECT" not in deck.card("STATIC", step=1)


def test_numbers_may_have_fortrans_exponent_and_places_may_be_empty():
    card = litz.Card.parse("*X\n 1.5D-3, , -2, .5, NAME, 1_000, inf")
    assert card.data == [[1.5e-3, None, -2, 0.5, "NAME", "1_000", "inf"]]


def test_a_change_of_a_value_leaves_all_else():
    deck = litz.Deck.parse(DECK)
    deck.card("NODE")[1, 1] = 2.5
    deck.card("ELEMENT")["TYPE"] = "B33"
    deck.card("STEP", step=1)["INC"] = 200
    changed = DECK.replace("\t1.,0", "\t2.5,0").replace("inc=10", "inc=200")
    changed = changed.replace("TYPE=B31,\n** in the middle of a keyword line\n ELSET", "TYPE=B33, ELSET")
    assert deck.text == changed


def test_a_value_beyond_the_end_of_a_line_fills_the_places_between():
    card = litz.Card.parse("*STATIC\n 0.1")
    card[0, 3] = 0.2
    assert card.data == [[0.1, None, None, 0.2]]


def test_parameters_come_and_go():
    card = litz.Card.parse("*STATIC\n")
    card["DIRECT"] = True
    assert card.text == "*STATIC, DIRECT\n"
    del card["direct"]
    assert card.text == "*STATIC\n"
    with pytest.raises(KeyError, match="DIRECT"):
        del card["DIRECT"]


def test_data_may_be_an_array():
    card = litz.Card.make("NODE", {"NSET": "ALL"})
    card.data = [[1, *np.array([0.1, 0.2, 1 / 3])]]
    assert card.text == "*NODE, NSET=ALL\n 1, 0.1, 0.2, 0.3333333333333333\n"
    assert card.data[0][3] == 1 / 3


def test_cards_are_inserted_and_removed():
    deck = litz.Deck.parse(DECK)
    deck.insert("*SOLVER, NAME=BLOCK", after=deck.card("STATIC", step=1))
    deck.insert("*ENERGY PRINT\n*CONTACT PRINT", before=deck.find("END STEP")[1])
    deck.remove(deck.card("BOUNDARY"))
    names = [card.name for card in deck][3:]
    assert names == [
        "STEP",
        "STATIC",
        "SOLVER",
        "END STEP",
        "STEP",
        "STATIC",
        "ENERGY PRINT",
        "CONTACT PRINT",
        "END STEP",
    ]
    assert litz.Deck.parse(deck.text).text == deck.text


def test_a_card_after_a_deck_without_a_last_line_end_begins_a_line():
    deck = litz.Deck.parse("*HEADING\n text")
    deck.insert("*NODE")
    assert deck.text == "*HEADING\n text\n*NODE\n"


def test_a_card_that_is_not_there_or_twice_is_told():
    deck = litz.Deck.parse(DECK)
    with pytest.raises(LookupError, match=r"0 cards \*ELASTIC, NAME=COPPER in step 1, not one \(cards are: HEADING"):
        deck.card("ELASTIC", step=1, name="COPPER")
    with pytest.raises(LookupError, match=r"2 cards \*STATIC"):
        deck.card("STATIC")
    with pytest.raises(ValueError, match="keyword line such as"):
        litz.Deck.parse("1, 2\n*HEADING")


def test_a_deck_in_another_directory_finds_what_it_includes(tmp_path):
    (tmp_path / "mesh").mkdir()
    (tmp_path / "mesh" / "nodes.inp").write_text("*NODE\n 1, 0, 0, 0\n")
    (tmp_path / "deck.inp").write_text("*INCLUDE, INPUT=mesh/nodes.inp\n")
    deck = litz.Deck.read(tmp_path / "deck.inp")
    assert deck.included(deck.card("INCLUDE")).card("NODE").data == [[1, 0, 0, 0]]
    (tmp_path / "other").mkdir()
    moved = litz.Deck.read(deck.write(tmp_path / "other" / "deck.inp"))
    assert moved.card("INCLUDE")["INPUT"] == "../mesh/nodes.inp"
    assert moved.included(moved.card("INCLUDE")).card("NODE")
    assert deck.card("INCLUDE")["INPUT"] == "mesh/nodes.inp"


def test_a_deck_that_is_not_there():
    with pytest.raises(litz.FileError, match=r"missing\.inp"):
        litz.Deck.read("missing.inp")


# The table of keywords


def test_the_table_is_what_the_program_prints(request):
    program = request.getfixturevalue("litz")
    printed = program("keywords", "--json")
    assert printed.returncode == 0
    names = [keyword["name"] for keyword in json.loads(printed.stdout)]
    # help goes on below itself
    listed = [line[1:34].strip() for line in program("keywords").stdout.splitlines() if line[1:34].strip()]
    assert names == listed


def test_the_table_tells_limits_choices_and_forms():
    table = litz.keywords()
    young, poisson, _ = table["ELASTIC"]["data"][0]["values"]
    assert (young["unit"], young["exclusive_minimum"]) == ("Pa", 0)
    assert (poisson["exclusive_minimum"], poisson["exclusive_maximum"]) == (-1, 0.5)
    (kind,) = [p for p in table["ELEMENT"]["parameters"] if p["name"] == "TYPE"]
    assert (kind["choices"], kind["required"]) == (
        ["B31", "B33", "B31R", "B31H", "B33H", "B32", "B32R", "B32H"],
        True,
    )
    assert [form["when"] for form in table["NSET"]["data"]] == ["GENERATE=NO", "GENERATE=YES"]
    assert table["NODE"]["data"][0]["last"] is None


@pytest.mark.parametrize("path", INPUTS, ids=lambda path: path.stem)
def test_the_cards_of_all_decks_pass_the_checks(path):
    for card in litz.Deck.read(path):
        rows = [] if card.is_a("HEADING") or card.is_a("STEP") else card.data[:100]
        check_card(card.name, card.parameters, rows)


@pytest.mark.parametrize(
    ("name", "parameters", "rows", "message"),
    [
        ("MATERIL", {}, [], r"no keyword \*MATERIL; did you mean 'MATERIAL'"),
        ("MATERIAL", {}, [], "needs the parameter NAME: name of the material"),
        ("MATERIAL", {"NAME": "A,B"}, [], "commas"),
        ("MATERIAL", {"NAME": "12"}, [], "may not be a number"),
        ("MATERIAL", {"NAM": "A"}, [], r"\*MATERIAL has no parameter NAM; did you mean 'NAME'"),
        ("STATIC", {"DIRECT": 1}, [], "takes no value"),
        ("ELASTIC", {}, [[-1.0, 0.3]], r"E of \*ELASTIC must be greater than 0, not -1 \(Young's modulus \[Pa\]\)"),
        ("ELASTIC", {}, [[1.0, 0.5]], "nu of .* must be between -1 and 0.5, not 0.5"),
        ("ELASTIC", {}, [[1.0, np.nan]], "finite number"),
        ("ELASTIC", {}, [["stiff", 0.3]], "must be a finite number, not 'stiff'"),
        ("ELASTIC", {}, [[1.0]], "nu is missing"),
        ("ELASTIC", {}, [], "needs the values E, nu"),
        ("FRICTION", {}, [[0.3], [0.3]], "takes 1 data lines here, not 2"),
        ("ELASTIC", {}, [[1.0, 0.3, 4.0, 5.0]], "not 4 values"),
        ("ELEMENT", {"TYPE": "B21"}, [], "not 'B21'"),
        ("ELEMENT", {"TYPE": "B31"}, [[0, 1, 2]], "id of .* must be greater than 0"),
        ("ELEMENT", {"TYPE": "B31"}, [[1, 1.5, 2]], "must be a whole number"),
        ("CONTROLS", {"PARAMETERS": "TIME INCREMENTATION"}, [[3]], "does not use I_0"),
        ("SURFACE BEHAVIOR", {"PRESSURE-OVERCLOSURE": "HERTZ"}, [[1e5]], "takes 0 data lines here"),
    ],
)
def test_a_card_that_the_table_does_not_allow_is_refused(name, parameters, rows, message):
    with pytest.raises(ValueError, match=message):
        check_card(name, parameters, rows)

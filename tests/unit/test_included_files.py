"""Files that decks include: their lines stand in place of the `*INCLUDE`, whatever they begin and end with."""

import pytest

import litz
from litz.deck.instances import flat_cards, flat_text, is_rearranged
from litz.errors import InputError
from litz.model.foreign_deck import convert_deck

NODES = "*NODE\n1, 0., 0., 0.\n3, 2., 0., 0.\n"
GENERATED = NODES + "*NGEN\n1, 3\n"


@pytest.fixture
def deck(tmp_path):
    def write(text, **included):
        (tmp_path / "inc").mkdir(exist_ok=True)
        for name, content in included.items():
            (tmp_path / "inc" / f"{name}.inp").write_text(content)
        path = tmp_path / "deck.inp"
        path.write_text(text)
        return path

    return write


def cards_of(path):
    return [(card.name, card.data) for card in flat_cards(path)]


def test_data_lines_behind_an_include_go_on_with_the_last_card_of_the_file(deck):
    path = deck("*INCLUDE, INPUT=inc/loads.inp\n3, 3, 3.\n*END STEP\n", loads="*CLOAD\n3, 1, 1.")
    assert cards_of(path) == [("CLOAD", [[3, 1, 1.0], [3, 3, 3.0]]), ("END STEP", [])]


def test_a_file_of_data_lines_alone_goes_on_with_the_card_before_it(deck):
    path = deck("*CLOAD\n*INCLUDE, INPUT=inc/data.inp\n3, 3, 3.\n*END STEP\n", data="** of a table\n3, 1, 1.\n3, 2, 2.")
    assert cards_of(path) == [("CLOAD", [[3, 1, 1.0], [3, 2, 2.0], [3, 3, 3.0]]), ("END STEP", [])]


def test_files_that_include_others_go_on_through_all_of_them(deck):
    path = deck(
        "*CLOAD\n*INCLUDE, INPUT=inc/outer.inp\n3, 4, 4.\n",
        outer="3, 1, 1.\n*INCLUDE, INPUT=inner.inp\n3, 3, 3.\n",
        inner="3, 2, 2.\n",
    )
    assert cards_of(path) == [("CLOAD", [[3, i, float(i)] for i in range(1, 5)])]


def test_comments_stay_with_what_they_stand_before(deck):
    path = deck(
        "** loads\n*INCLUDE, INPUT=inc/loads.inp\n** more\n3, 3, 3.\n", loads="** of the file\n*CLOAD\n3, 1, 1.\n"
    )
    (card,) = flat_cards(path)
    assert card.text == "** loads\n** of the file\n*CLOAD\n3, 1, 1.\n** more\n3, 3, 3.\n"


def test_messages_name_the_include_for_what_is_in_another_file(deck):
    text = flat_text(
        deck(GENERATED + "*INCLUDE, INPUT=inc/loads.inp\n3, 3, 3.\n", loads="*CLOAD\n3, 1, 1.\n3, 2, 2.\n")
    )
    lines = text.splitlines()
    for line in ("*CLOAD", "3, 1, 1.", "3, 2, 2.", "3, 3, 3."):
        assert lines[lines.index(line) - 1] == "**litz line 6"


def test_a_deck_that_begins_with_data_lines_of_a_file_is_an_error(deck):
    with pytest.raises(InputError, match=r"data lines before the first keyword line\n --> .*deck\.inp:1"):
        flat_cards(deck("*INCLUDE, INPUT=inc/data.inp\n", data="1, 2\n"))


def test_a_file_that_includes_itself_is_an_error(deck):
    with pytest.raises(
        InputError, match=r"inner\.inp includes itself, directly or through others\n --> .*outer\.inp:1"
    ):
        flat_cards(
            deck(
                GENERATED + "*INCLUDE, INPUT=inc/inner.inp\n",
                inner="*INCLUDE, INPUT=outer.inp\n",
                outer="*INCLUDE, INPUT=../inc/inner.inp\n",
            )
        )


def test_the_same_file_twice_is_none(deck):
    assert len(cards_of(deck("*INCLUDE, INPUT=inc/a.inp\n" * 2, a="*CLOAD\n3, 1, 1.\n"))) == 2


def test_an_include_that_names_no_file_is_an_error(deck):
    with pytest.raises(InputError, match=r"\*INCLUDE needs INPUT=file\n --> .*deck\.inp:2"):
        flat_cards(deck("*HEADING\n*INCLUDE\n"))


@pytest.mark.parametrize(
    "keyword", ["*NODE, SYSTEM=C", "*NODE,\n SYSTEM=C", "*NODE, NSET=A, \n NSET=A,\nSYSTEM=C", "*NGEN"]
)
def test_keyword_lines_that_go_on_are_seen(deck, keyword):
    assert is_rearranged(deck("*INCLUDE,\n INPUT=inc/mesh.inp\n", mesh=f"{keyword}\n1, 1., 90., 0.\n"))
    assert not is_rearranged(deck("*INCLUDE,\n INPUT=inc/mesh.inp\n", mesh="*NODE, NSET=A\n1, 1., 90., 0.\n"))


@pytest.mark.parametrize("nodes", [NODES + "2, 1., 0., 0.\n", GENERATED], ids=["given", "generated"])
def test_runs_and_conversions_have_all_loads(deck, nodes, tmp_path):
    """The program reads the first deck by itself; the second one is written out for it."""
    path = deck(
        nodes + "*ELEMENT, TYPE=B33, ELSET=ALL\n*INCLUDE, INPUT=inc/elements.inp\n2, 2, 3\n"
        "*MATERIAL, NAME=M\n*ELASTIC\n1e7, 0.3\n*BEAM SECTION, ELSET=ALL, SECTION=RECT, MATERIAL=M\n0.1, 0.05\n"
        "*BOUNDARY\n1, 1, 6\n*STEP\n*STATIC\n*INCLUDE, INPUT=inc/loads.inp\n3, 2, -2e-3\n*END STEP\n",
        elements="1, 1, 2\n",
        loads="*CLOAD\n3, 1, 1e-3\n",
    )
    expected = [-1e-3, 2e-3, 0]
    converted = tmp_path / "converted.inp"
    converted.write_text(convert_deck(path, "abaqus").text)
    for one in (path, converted):
        results = litz.run(one, output_directory=tmp_path / "out", quiet=True)
        assert results.field("reaction_force")[0] == pytest.approx(expected, abs=1e-9)

"""Keywords of Abaqus and CalculiX that litz does not have: each is answered by what to write in its place."""

import json
import re
import subprocess

import pytest


@pytest.fixture(scope="module")
def keywords(litz_program_text):
    return {keyword["name"]: keyword for keyword in json.loads(litz_program_text("keywords", "--json"))}


@pytest.fixture(scope="module")
def rows(litz_program_text):
    """Rows of the last chapter of the reference: words, advice."""
    chapter = litz_program_text("keywords", "--markdown").split("## Keywords of Abaqus and CalculiX")[1]
    found = re.findall(r"^\| (`.*?) \| (.*) \|$", chapter, re.MULTILINE)
    assert len(found) > 80
    return found


@pytest.fixture(scope="module")
def litz_program_text(litz_program):
    def text(*arguments):
        return subprocess.run([litz_program, *arguments], capture_output=True, text=True, check=True).stdout

    return text


def words_of(form):
    return re.findall("`(.*?)`", form)


def test_each_keyword_is_answered_by_its_advice(litz, rows):
    lacking = [row for row in rows if ":" not in row[0] and "data" not in row[0]]
    assert len(lacking) > 30
    for form, advice in lacking:
        for word in words_of(form):
            # as a user of Abaqus writes it
            answer = litz("keywords", word.title())
            assert answer.returncode == 1
            assert (
                answer.stderr.removesuffix("; ignored\n").removesuffix("\n") == f"error: litz has no {word}: {advice}"
            )


def test_no_advice_is_cut_off(rows):
    """They are stored in fields of one length: the longest of them has all its words."""
    longest = max(rows, key=lambda row: len(row[1]))[1]
    assert longest.endswith("there is no inertia for accelerations")


def test_litz_has_none_of_the_keywords_and_all_that_the_advice_names(rows, keywords):
    for form, advice in rows:
        for word in words_of(form):
            if word.startswith("*") and ":" not in form and "data" not in form:
                assert word[1:] not in keywords
        for name in re.findall(r"\*([A-Z][A-Z -]*[A-Z])", advice):
            # the name may be followed by words in capitals that are none of it
            assert any(name == known or name.startswith(known + " ") for known in keywords), (form, advice)
        for name, word in re.findall(r"\b([A-Z][A-Z-]+)=([A-Z]+)", advice):
            choices = [
                parameter["choices"]
                for keyword in keywords.values()
                for parameter in keyword["parameters"]
                if parameter["name"] == name
            ]
            assert any(not one or word in one for one in choices), (form, advice)


def test_each_parameter_is_answered_by_its_advice(litz, tmp_path, rows, keywords):
    n_tried = 0
    for form, advice in rows:
        owners, colon, lacking = form.partition(": ")
        if not colon or "=" in lacking or "`" not in lacking or "data" in owners:
            continue
        for owner in words_of(owners):
            keyword, words = keywords[owner[1:]], words_of(lacking)
            assert not {parameter["name"] for parameter in keyword["parameters"]} & set(words)
            told = answer(litz, tmp_path, keyword, [f"{owner}, {word}" for word in words])
            for word in words:
                n_tried += 1
                assert f'unknown parameter "{word}" of {owner}: {advice}' in told
    assert n_tried > 60


def test_each_value_is_answered_by_its_advice(litz, tmp_path, rows, keywords):
    n_tried = 0
    for form, advice in rows:
        owners, _, lacking = form.partition(": ")
        words = [word for word in words_of(lacking) if "=" in word]
        for owner in words_of(owners) if words else ():
            told = answer(litz, tmp_path, keywords[owner[1:]], [f"{owner}, {word}" for word in words])
            for word in words:
                n_tried += 1
                assert f'found "{word.partition("=")[2]}"; {advice}' in told
        owners, _, lacking = form.partition(", data: ")
        for owner in words_of(owners) if lacking else ():
            words, node = words_of(lacking), "1, " if owner in ("*BOUNDARY", "*DLOAD") else ""
            card = {"*NODE PRINT": f"{owner}, NSET=ALL", "*EL PRINT": f"{owner}, ELSET=ALL"}.get(owner, owner)
            lines = [line for word in words for line in (card, f"{node}{word}")]
            told = answer(litz, tmp_path, keywords[owner[1:]], lines)
            for word in words:
                n_tried += 1
                assert f'found "{word}"; {advice}' in told
    assert n_tried > 60


def answer(litz, directory, keyword, lines):
    """What is said about a deck with these lines where the keyword may stand."""
    if "step" in keyword["place"] and keyword["name"] != "STEP":
        lines = ["*STEP", *lines]
    elif keyword["after"]:
        lines = [f"*{keyword['after']}, NAME=A", *lines]
    # a node, so that data lines have one to be about
    (directory / "foreign.inp").write_text("\n".join(["*NODE, NSET=ALL", "1, 0, 0, 0", *lines, ""]))
    told = litz("check", "foreign.inp", cwd=directory)
    assert told.returncode == 1
    return told.stderr


def test_a_procedure_that_litz_lacks_is_not_told_twice(litz, tmp_path, keywords):
    assert "this step has no *STATIC" in answer(litz, tmp_path, keywords["BOUNDARY"], ["*OUTPUT", "*END STEP"])
    told = answer(litz, tmp_path, keywords["BOUNDARY"], ["*DYNAMIC", "*END STEP"])
    assert "this step has no *STATIC" not in told
    assert "litz has no *DYNAMIC" in told


def test_a_file_in_utf_16_is_told_as_such(litz_program, tmp_path):
    (tmp_path / "wide.inp").write_bytes("*HEADING\n*STEP\n".encode("utf-16"))
    told = subprocess.run([litz_program, "check", "wide.inp"], cwd=tmp_path, capture_output=True, check=False)
    assert told.returncode == 1
    assert b"not plain text (UTF-8): it may be UTF-16" in told.stderr

"""Every value of every data line that the keyword table describes: what is wrong about it is refused at its place."""

import json
import os

import pytest

from in_parts import in_parts

#: A value that is taken, by its kind
GOOD = {"integer": "1", "real": "0.1", "name": "A", "number or set": "1"}
#: Numbers that break a limit
BEYOND = {
    "greater than 0": "-1",
    "0 or greater": "-1",
    "1 or greater": "0.9",
    "between -1 and 0.5": "0.5",
    "0": "1",
    "left empty, litz does not use it": "1",
}


def good(value):
    if value.get("limit") in ("0", "1 or greater"):
        return value["limit"][0]
    if value.get("limit", "").startswith("left empty"):
        return ""
    return value["choices"][0] if value["choices"] else GOOD[value["kind"]]


def card_of(keyword, when):
    """The keyword with what it must have, and the parameter under which a form of its data lines holds."""
    parameters = {}
    for parameter in keyword["parameters"]:
        if parameter["required"]:
            parameters[parameter["name"]] = parameter["choices"][0] if parameter["choices"] else "A"
    if when:
        name, _, word = when.partition("=")
        parameters[name] = word
    words = [
        name if word == "YES" and kind_of(keyword, name) == "flag" else f"{name}={word}"
        for name, word in parameters.items()
        if not (word == "NO" and kind_of(keyword, name) == "flag")
    ]
    return ", ".join([f"*{keyword['name']}", *words])


def kind_of(keyword, name):
    return next(parameter["kind"] for parameter in keyword["parameters"] if parameter["name"] == name)


def mistakes(values, repeats):
    """Data lines with one mistake: the values of the line, the place that is marked, and a word of the message."""
    right = [good(value) for value in values]
    for i, value in enumerate(values):
        wrong = []
        if value["kind"] in ("integer", "real") and not value.get("limit", "").startswith("left empty"):
            wrong += [("@", "must be a"), ("1e999" if value["kind"] == "real" else "9" * 12, "too large")]
        if value["kind"] == "integer":
            wrong.append(("1.5", "must be a whole number"))
        if value["kind"] == "real" and value.get("limit") in (None, "greater than 0", "0 or greater"):
            wrong += [("nan", "finite"), ("1e61", "too large")]
        if value["choices"]:
            wrong.append(("@", "must be"))
        if "limit" in value:
            wrong.append((BEYOND[value["limit"]], "must be"))
        if value["kind"] in ("name", "number or set"):
            wrong.append(("Q" * 81, "longer than 80"))
        for word, message in wrong:
            yield [*right[:i], word, *right[i + 1 :]], word, message
        if value["required"] and i + 1 < len(values):
            yield [*right[:i], "", *right[i + 1 :]], ",", "is missing"
    if repeats == 1 and right[-1]:
        yield [*right, "QZX"], "QZX", "too many values"


def forms(litz):
    """Keyword, form of its data lines, and the lines that come before it."""
    for keyword in json.loads(litz("keywords", "--json").stdout):
        for form in keyword["data"]:
            if any(value["kind"] == "text" for value in form["values"]):
                continue
            card = card_of(keyword, form["when"])
            unsaid = [one for one in keyword["parameters"] if f"{one['name']}=" not in card]
            defaults = [f"{one['name']}={one['default']}" for one in unsaid]
            before = [
                other
                for other in keyword["data"]
                if other["first"] < form["first"]
                and (other["when"] in (form["when"], None, *defaults) or other["when"] in card)
            ]
            yield keyword, form, [", ".join(good(value) for value in other["values"]) for other in before]


def lines_of(keyword, form, before, *after):
    """A deck that ends with the keyword and lines of data."""
    lines = ["*STEP"] if keyword["place"] == "step" else []
    lines += [f"*{keyword['after']}"] if keyword["after"] else []
    return [*lines, card_of(keyword, form["when"]), *before, *after]


def marked(stderr, line):
    """Messages with what the caret of each stands below, of the errors at a line."""
    for block in stderr.split("error: ")[1:]:
        rows = block.splitlines()
        if f":{line}:" not in rows[1]:
            continue
        at = next(k for k, row in enumerate(rows) if row.lstrip().startswith("|") and "^" in row)
        first = rows[at].index("^")
        yield rows[0], rows[at - 1][first : rows[at].rindex("^") + 1], int(rows[1].rsplit(":", 1)[1])


def test_every_value_of_every_data_line_is_checked_at_its_place(litz, tmp_path):
    all_forms, missed, n_cases = list(forms(litz)), [], 0
    for keyword, form, before, some in (
        (*one, some) for one in all_forms for some in in_parts(mistakes(one[1]["values"], one[1]["repeats"]))
    ):
        lines, cases = [], []
        for values, word, message in some:
            lines += lines_of(keyword, form, before, ", ".join(values))
            cases.append((len(lines), word, message))
        (tmp_path / "bad.inp").write_text("\n".join(lines) + "\n")
        result = litz("check", "bad.inp", cwd=tmp_path)
        assert result.returncode == 1
        for line, word, message in cases:
            told = [one for one in marked(result.stderr, line) if message in one[0]]
            if not told or told[0][1] != word or not lines[line - 1][told[0][2] - 1 :].startswith(word):
                missed.append(f"{lines[:line]}\nshould say: {message}\n{result.stderr}")
        n_cases += len(cases)
    assert not missed, f"{len(missed)} mistakes are missed, the first:\n" + "\n".join(missed[:3])
    # the walk has found the table
    assert len(all_forms) >= 30
    assert n_cases >= 250


def test_missing_data_lines_are_told_for_every_keyword_that_needs_them(litz, tmp_path):
    n = 0
    for keyword, form, before in forms(litz):
        if before or not form["required"]:
            continue
        lines = lines_of(keyword, form, before)
        (tmp_path / "bad.inp").write_text("\n".join(lines) + "\n")
        result = litz("check", "bad.inp", cwd=tmp_path)
        assert result.returncode == 1
        assert f"bad.inp:{len(lines)}:" in result.stderr, f"{lines}\n{result.stderr}"
        n += 1
    assert n >= 15


def fields_of(keyword, value):
    """Names of the fields of a value of a data line, with their degrees of freedom."""
    values = keyword["data"][0]["values"]
    fields = next(one["fields"] for one in values if one["name"] == value)
    return {field["name"]: (field["first"], field["last"]) for field in fields}


def test_values_that_are_degrees_of_freedom_name_their_fields(litz):
    table = {keyword["name"]: keyword for keyword in json.loads(litz("keywords", "--json").stdout)}
    mechanical = {"displacement": (1, 3), "rotation": (4, 6)}
    assert fields_of(table["BOUNDARY"], "first") == {**mechanical, "potential": (9, 9), "temperature": (11, 11)}
    assert fields_of(table["CLOAD"], "dof") == mechanical
    assert fields_of(table["CECURRENT"], "dof") == {"potential": (9, 9)}
    assert fields_of(table["CFLUX"], "dof") == {"temperature": (11, 11)}


def test_no_help_is_cut_off(litz):
    """Texts are shorter than the room that the program has for them: a longer one would fill it."""
    for keyword in json.loads(litz("keywords", "--json").stdout):
        values = [value for form in keyword["data"] for value in form["values"]]
        for described in [keyword, *keyword["parameters"], *values]:
            assert 0 < len(described["help"]) < 1000, described["name"]


@pytest.mark.parametrize("columns", [60, 140])
def test_help_is_wrapped_to_the_width_of_the_terminal(litz, columns):
    shown = litz("keywords", "CONTROLS", env={**os.environ, "COLUMNS": str(columns)}).stdout
    assert columns - 20 < max(map(len, shown.splitlines())) <= columns
    narrow = litz("keywords", "CONTROLS", env={**os.environ, "COLUMNS": "60"}).stdout
    assert shown.split() == narrow.split()

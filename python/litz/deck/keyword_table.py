"""The keyword table of the program, and checks of cards against it.

There is one definition of what a deck can say, in the Fortran program; `litz keywords --json` prints it.
"""

import json
import math
import re
import subprocess
from collections.abc import Mapping, Sequence
from functools import cache
from numbers import Integral, Real
from typing import Any

from ..base.names import nearest_name
from ..base.program import program_path
from ..errors import InternalError


@cache
def keywords() -> dict[str, dict[str, Any]]:
    """The table of keywords by name, as `litz keywords --json` prints it.

    Examples
    --------
    >>> import litz
    >>> section = litz.keywords()["BEAM SECTION"]
    >>> [parameter["name"] for parameter in section["parameters"] if parameter["required"]]
    ['ELSET', 'MATERIAL', 'SECTION']
    """
    done = subprocess.run([program_path(), "keywords", "--json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise InternalError(f"litz keywords --json failed: {done.stderr.strip()}")
    return {keyword["name"]: keyword for keyword in json.loads(done.stdout)}


def squeezed(name: str) -> str:
    """A name as the deck reader compares it: without blanks, in upper case."""
    return re.sub(r"\s+", "", name).upper()


def keyword(name: str) -> dict[str, Any]:
    """The description of a keyword, in any spelling that the reader accepts."""
    wanted = squeezed(name.removeprefix("*"))
    for known, description in keywords().items():
        if squeezed(known) == wanted:
            return description
    raise ValueError(f"there is no keyword *{name}{nearest_name(wanted, keywords())}; litz keywords lists them all")


def check_card(name: str, parameters: Mapping[str, Any], rows: Sequence[Sequence[Any]] = ()) -> None:
    """Raise an error for a card that the keyword table does not allow.

    Parameters
    ----------
    name : str
        Keyword, such as "BEAM SECTION".
    parameters : mapping of str
        Values of the parameters; True for a flag.
    rows : sequence of sequences
        Values of the data lines; None where a place is left empty.

    Raises
    ------
    ValueError
        With what was found and what is allowed.
    """
    description = keyword(name)
    known = {squeezed(parameter["name"]): parameter for parameter in description["parameters"]}
    for parameter, value in parameters.items():
        if squeezed(parameter) not in known:
            allowed = [parameter["name"] for parameter in description["parameters"]]
            there = "there is " + ", ".join(allowed) if allowed else "it has none"
            raise ValueError(f"*{name} has no parameter {parameter}{nearest_name(parameter, allowed)}; {there}")
        _check_parameter(name, known[squeezed(parameter)], value)
    for parameter in known.values():
        if parameter["required"] and not any(squeezed(given) == squeezed(parameter["name"]) for given in parameters):
            raise ValueError(f"*{name} needs the parameter {parameter['name']}: {parameter['help']}")
    _check_rows(name, description, parameters, rows)


def _check_parameter(name: str, description: dict[str, Any], value: Any) -> None:
    what = f"{description['name']} of *{name}"
    if description["kind"] == "flag":
        if value is not True:
            raise ValueError(f"{what} takes no value: give True, or leave it out; found {value!r}")
    elif value is True:
        if not description["value_optional"]:
            raise ValueError(f"{what} needs a value")
    else:
        _check_value(what, description, value)


def _check_rows(name: str, description: dict, parameters: Mapping[str, Any], rows: Sequence[Sequence[Any]]) -> None:
    forms = [form for form in description["data"] if _holds(form["when"], description, parameters)]
    for number, row in enumerate(rows, start=1):
        form = next((f for f in forms if f["first"] <= number <= (f["last"] or math.inf)), None)
        if form is None:
            allowed = max((f["last"] for f in forms), default=0)
            raise ValueError(f"*{name} takes {allowed} data lines here, not {len(rows)}")
        _check_row(name, form, row)
    for form in forms:
        optional = form["optional_with"] is not None and _holds(form["optional_with"], description, parameters)
        if form["required"] and not optional and len(rows) < form["first"]:
            wanted = ", ".join(value["name"] for value in form["values"])
            raise ValueError(f"*{name} needs the values {wanted}")


def _check_row(name: str, form: dict[str, Any], row: Sequence[Any]) -> None:
    values = form["values"]
    names = ", ".join(value["name"] for value in values)
    if form["repeats"] is not None and len(row) > form["repeats"] * len(values):
        raise ValueError(f"*{name} takes the values {names} on a line, not {len(row)} values")
    for place, value in enumerate(row):
        description = values[place % len(values)]
        if value is None:
            if description["required"]:
                raise ValueError(f"*{name} needs {description['name']}: {description['help']}")
            continue
        if "unused" in description:
            raise ValueError(f"litz does not use {description['name']} of *{name}; leave it out")
        _check_value(f"{description['name']} of *{name}", description, value)
    # the first group of values on a line must have all that are required
    for description in values[len(row) :] if len(row) < len(values) else ():
        if description["required"] and form["repeats"] is not None and description["kind"] != "text":
            raise ValueError(f"*{name} needs the values {names} on a line; {description['name']} is missing")


def _holds(when: str | None, description: dict[str, Any], parameters: Mapping[str, Any]) -> bool:
    """Whether a form of the data lines applies to the given parameters."""
    if when is None:
        return True
    name, _, wanted = when.partition("=")
    given = next((value for key, value in parameters.items() if squeezed(key) == squeezed(name)), None)
    if not wanted:
        return given is not None
    if given is None:
        default = next(p["default"] for p in description["parameters"] if squeezed(p["name"]) == squeezed(name))
        given = default or "NO"
    given = "YES" if given is True else str(given)
    return squeezed(given) == squeezed(wanted)


def _check_value(what: str, description: dict[str, Any], value: Any) -> None:
    kind = description["kind"]
    means = f" ({description['help']}{_unit(description)})"
    if kind == "choice":
        if squeezed(str(value)) not in map(squeezed, description["choices"]):
            raise ValueError(f"{what} must be {_either(description['choices'])}, not {value!r}")
    elif kind == "integer":
        if not isinstance(value, Integral) or isinstance(value, bool):
            raise ValueError(f"{what} must be a whole number, not {value!r}{means}")
        _check_limit(what, description, int(value), means)
    elif kind == "real":
        if not isinstance(value, Real) or isinstance(value, bool) or not math.isfinite(value):
            raise ValueError(f"{what} must be a finite number, not {value!r}{means}")
        _check_limit(what, description, float(value), means)
    elif kind in ("name", "number or set") and not isinstance(value, Integral):
        check_name(value, what)


def _check_limit(what: str, description: dict[str, Any], value: float, means: str) -> None:
    low, high = description.get("minimum", -math.inf), description.get("maximum", math.inf)
    above, below = description.get("exclusive_minimum", -math.inf), description.get("exclusive_maximum", math.inf)
    if not (low <= value <= high and above < value < below):
        raise ValueError(f"{what} must be {description['limit']}, not {value:g}{means}")


def _unit(description: dict[str, Any]) -> str:
    return f" [{description['unit']}]" if description.get("unit") else ""


def _either(choices: Sequence[str]) -> str:
    return choices[0] if len(choices) == 1 else ", ".join(choices[:-1]) + " or " + choices[-1]


def check_name(name: str, what: str = "a name") -> str:
    """Return a name that is valid in a deck; raise an error for others."""
    if not isinstance(name, str):
        raise ValueError(f"{what} must be a text, not {name!r}")
    if not re.fullmatch(r"[^\s,=\"*][^,=\"\n\r]*", name) or name != name.strip():
        raise ValueError(
            f"{what} may not be empty, begin with *, or hold commas, equals signs or quotes; found {name!r}"
        )
    if name.isdecimal():
        raise ValueError(f"{what} may not be a number, which would mean a node or element; found {name!r}")
    return name

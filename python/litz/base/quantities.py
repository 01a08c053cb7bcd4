"""Units with prefixes, for axes and legends."""

import re

import numpy as np

_PREFIXES = {-15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
_SI = frozenset(["m", "N", "Nm", "A", "V", "W", "J", "Pa", "S", "ohm"])
_SYMBOLS = {"ohm": "Ω", "A/m^2": "A/m²", "N m": "N·m", "Nm": "N·m", "1": ""}


def engineering(values: np.ndarray, unit: str) -> tuple[float, str]:
    """Factor and prefixed unit that bring the largest value between 1 and 1000, such as (1000, "mV").

    Dimensionless values, times, units labelled by the deck (`*UNITS`), and values of decks that do not name their units
    are unchanged.

    Examples
    --------
    >>> engineering(np.array([0.002]), "V"), engineering(np.array([0.002]), "mm")
    ((1000.0, 'mV'), (1.0, 'mm'))
    """
    symbol = _SYMBOLS.get(unit, unit)
    finite = np.abs(np.asarray(values, dtype=float))
    finite = finite[np.isfinite(finite)]
    largest = finite.max() if finite.size else 0.0
    if re.split(r"[ /^]", unit)[0] not in _SI or symbol in ("", "s") or largest == 0:
        return 1.0, symbol
    # a value that rounds up to 1000 takes the next prefix
    exponent = int(np.clip(3 * np.floor(np.log10(largest * (1 + 1e-9)) / 3), min(_PREFIXES), max(_PREFIXES)))
    return 10.0**-exponent, _PREFIXES[exponent] + symbol


def label(name: str, unit: str) -> str:
    """Text for an axis: `axial_force`, "kN" -> "axial force [kN]"."""
    text = name.replace("_", " ")
    return f"{text} [{unit}]" if unit else text


def with_unit(number: str, unit: str) -> str:
    """A number and its unit, if that has a name: "1.5", "N" -> "1.5 N"."""
    return f"{number} {unit}" if unit else number


def in_brackets(unit: str) -> str:
    """A unit as it stands after the name of a column: "N" -> " [N]"."""
    return f" [{unit}]" if unit else ""


def attribute(name: str, unit: str) -> str:
    """Name of an attribute of a file, with its unit if that has a name: "length", "m" -> "length_m"."""
    return f"{name}_{unit}" if unit else name


def per(unit: str, other: str) -> str:
    """The unit of a quotient: "N", "m" -> "N/m"; "" of a deck that does not name its units."""
    return f"{unit}/{other}" if unit and other else ""


def unit_of_conductance(resistance: str) -> str:
    """The unit of a conductance, given that of a resistance: "ohm" -> "S"."""
    return "S" if resistance == "ohm" else per("1", resistance)

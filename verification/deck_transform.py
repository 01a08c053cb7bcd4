"""Decks that say the same in other words: other units, other numbers, other axes, contact partners swapped.

A deck is read into cards, the cards are changed, and written again. Comments are left out.
"""

from dataclasses import dataclass

import numpy as np


@dataclass
class Card:
    """A keyword line with its data lines."""

    keyword: str
    parameters: list
    data: list


def read_cards(text):
    """The cards of a deck."""
    cards = []
    for line in text.splitlines():
        if line.startswith("**") or not line.strip():
            continue
        fields = [field.strip() for field in line.split(",")]
        if line.startswith("*"):
            cards.append(Card(fields[0][1:].upper(), fields[1:], []))
        elif cards[-1].keyword in ("HEADING", "STEP"):
            cards[-1].data.append([line])
        else:
            cards[-1].data.append(fields)
    return cards


def write_cards(cards):
    """The text of a deck."""
    lines = []
    for card in cards:
        lines.append(", ".join(["*" + card.keyword, *card.parameters]))
        lines += [" " + ", ".join(row) for row in card.data]
    return "\n".join(lines) + "\n"


def _number(value):
    return f"{value:.17g}"


def _is_number(word):
    return word.lstrip("+-").isdigit()


# ---- Units -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Units:
    """What 1 m, 1 N, 1 A and 1 V are in other units."""

    length: float = 1.0
    force: float = 1.0
    current: float = 1.0
    voltage: float = 1.0


def in_units(text, units):
    """The deck with all its numbers in other units."""
    length, force, current, voltage = units.length, units.force, units.current, units.voltage
    pressure, resistance = force / length**2, voltage / current
    first_line = {
        "NODE": [None, length, length, length],
        "ELASTIC": [pressure, None],
        "ELECTRICAL CONDUCTIVITY": [1.0 / (resistance * length)],
        "BEAM SECTION CIRC": [length],
        "BEAM SECTION GENERAL": [length**2, *[length**4] * 4],
        "TRANSVERSE SHEAR STIFFNESS": [force, force],
        "SURFACE BEHAVIOR LINEAR": [force / length],
        "GAP ELECTRICAL CONDUCTANCE PLASTIC": [pressure],
        "GAP ELECTRICAL CONDUCTANCE FILM": [resistance * length**2],
        "GAP ELECTRICAL CONDUCTANCE CONSTANT": [resistance],
        "GAP ELECTRICAL CONDUCTANCE TABLE": [force, resistance],
        "CECURRENT": [None, None, current],
    }
    by_dof = {
        "BOUNDARY": lambda dof: {9: voltage}.get(dof, length if dof <= 3 else 1.0),
        "CLOAD": lambda dof: force if dof <= 3 else force * length,
    }
    cards = read_cards(text)
    for card in cards:
        variant = [value.split("=")[1].strip() for value in card.parameters if value.split("=")[0].strip() in _VARIANTS]
        factors = first_line.get(" ".join([card.keyword, *variant])) or first_line.get(card.keyword)
        if factors:
            n_rows = 1 if card.keyword == "BEAM SECTION" else len(card.data)
            card.data[:n_rows] = [_scaled(row, factors) for row in card.data[:n_rows]]
        elif card.keyword in by_dof:
            card.data = [
                [*row[:-1], _number(float(row[-1]) * by_dof[card.keyword](int(row[1])))]
                if len(row) == (4 if card.keyword == "BOUNDARY" else 3)
                else row
                for row in card.data
            ]
        for i, value in enumerate(card.parameters):
            if value.startswith("CONTACT RADIUS"):
                card.parameters[i] = f"CONTACT RADIUS={_number(float(value.split('=')[1]) * length)}"
    return write_cards(cards)


#: Parameters that decide what the numbers of a card mean
_VARIANTS = ("SECTION", "PRESSURE-OVERCLOSURE", "LAW")


def _scaled(row, factors):
    return [
        word if factor is None or not word else _number(float(word) * factor)
        for word, factor in zip(row, factors, strict=False)
    ]


# ---- Numbers ---------------------------------------------------------------------------------------------------------


def renumbered(text, seed=1):
    """The deck with other numbers of nodes and elements, their lines in another order; and both maps old -> new."""
    cards = read_cards(text)
    random = np.random.default_rng(seed)
    maps = {}
    for keyword in ("NODE", "ELEMENT"):
        old = [int(row[0]) for card in cards if card.keyword == keyword for row in card.data]
        maps[keyword] = dict(zip(old, (7 * random.permutation(len(old)) + 11).tolist(), strict=True))
    nodes, elements = maps["NODE"], maps["ELEMENT"]
    for card in cards:
        if card.keyword == "NODE":
            card.data = [[str(nodes[int(row[0])]), *row[1:]] for row in card.data]
        elif card.keyword == "ELEMENT":
            card.data = [[str(elements[int(row[0])]), *(str(nodes[int(n)]) for n in row[1:])] for row in card.data]
        elif card.keyword in ("NSET", "ELSET"):
            if "GENERATE" in card.parameters:
                raise ValueError("sets with GENERATE cannot be renumbered")
            members = nodes if card.keyword == "NSET" else elements
            card.data = [[str(members[int(w)]) if _is_number(w) else w for w in row] for row in card.data]
        elif card.keyword in ("BOUNDARY", "CLOAD", "CECURRENT"):
            card.data = [[str(nodes[int(row[0])]) if _is_number(row[0]) else row[0], *row[1:]] for row in card.data]
        if card.keyword in ("NODE", "ELEMENT"):
            card.data = [card.data[i] for i in random.permutation(len(card.data))]
    return write_cards(cards), nodes, elements


def swapped_contact_pairs(text):
    """The deck with the two sets of each contact pair in the other order."""
    cards = read_cards(text)
    for card in cards:
        if card.keyword == "CONTACT PAIR":
            card.data = [row[::-1] for row in card.data]
    return write_cards(cards)


# ---- Axes ------------------------------------------------------------------------------------------------------------


def rotated(text, turn):
    """The deck turned in space by a rotation matrix.

    Prescribed values must be given for all three displacements or rotations of a node in one *BOUNDARY, unless the
    rotation only exchanges axes.
    """
    turn = np.asarray(turn)
    cards = read_cards(text)
    for card in cards:
        if card.keyword == "NODE":
            card.data = [[row[0], *_turned(turn, row[1:])] for row in card.data]
        elif card.keyword == "BEAM SECTION":
            card.data[1:] = [_turned(turn, row) for row in card.data[1:]]
        elif card.keyword == "CLOAD":
            card.data = [line for row in card.data for line in _turned_load(turn, row)]
        elif card.keyword == "BOUNDARY":
            card.data = _turned_boundary(turn, card.data)
    return write_cards(cards)


def _turned(turn, words):
    return [_number(value) for value in turn @ np.array(words, dtype=float)]


def _turned_load(turn, row):
    dof = int(row[1])
    group = 3 * ((dof - 1) // 3)
    vector = turn[:, dof - 1 - group] * float(row[2])
    return [[row[0], str(group + i + 1), _number(value)] for i, value in enumerate(vector) if abs(value) > 0.0]


def _turned_boundary(turn, rows):
    kept, values = [], {}
    for row in rows:
        if not _is_number(row[1]) or int(row[1]) > 6:
            kept.append(row)
            continue
        value = float(row[3]) if len(row) > 3 else 0.0
        for dof in range(int(row[1]), int(row[2] if len(row) > 2 else row[1]) + 1):
            values.setdefault((row[0], (dof - 1) // 3), {})[(dof - 1) % 3] = value
    for (node, group), given in values.items():
        vector, present = np.zeros(3), np.zeros(3)
        for axis, value in given.items():
            vector[axis], present[axis] = value, 1.0
        held = np.abs(turn) @ present
        if not np.all(np.isclose(held, 0.0) | np.isclose(held, 1.0)) and len(given) < 3:
            raise ValueError(f"node {node}: only some directions are prescribed, which cannot be turned obliquely")
        for axis, value in enumerate(turn @ vector):
            if held[axis] > 0.5:
                dof = str(3 * group + axis + 1)
                kept.append([node, dof, dof, _number(value)])
    return kept

"""The laws of a contact by their names: numbers in the tables of the program, and the data that each takes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import _core
from . import checks
from .wire_pair import Numbers

#: The name of a law of `*SURFACE BEHAVIOR` in lower case
NormalLaw = str


def law_table(names: NDArray[Any], values: NDArray[Any]) -> tuple[dict[str, int], dict[str, list[str]]]:
    """Numbers of the laws of a family, and the names of the numbers that are their data."""
    laws = [name.decode().strip().lower() for name in names]
    fields = [[name.decode().strip() for name in column if name.strip()] for column in values.T]
    numbers = {law: number for number, law in enumerate(laws, start=1) if law}
    return numbers, {law: fields[number - 1] for law, number in numbers.items()}


#: The tables of `fortran/laws`
NORMAL_LAWS, NORMAL_FIELDS = law_table(*_core.f2py_contact.normal_law_names()[:2])
_SPOT_NAMES, _SPOT_VALUES, _SPOT_NEEDED = _core.f2py_contact.spot_law_names()
SPOT_LAWS, SPOT_FIELDS = law_table(_SPOT_NAMES, _SPOT_VALUES)
#: How many of its numbers each spot law needs; the others follow them
SPOT_NEEDED = {law: int(_SPOT_NEEDED[number - 1]) for law, number in SPOT_LAWS.items()}
PRESSURE_LAWS, PRESSURE_FIELDS = law_table(*_core.f2py_surface.pressure_law_names()[:2])
CONDUCTANCE_LAWS, CONDUCTANCE_FIELDS = law_table(*_core.f2py_surface.conductance_law_names()[:2])
#: The arguments that have the numbers of any law
_MANY_NUMBERS = ("law_value", "normal_value")
#: The argument that has the numbers of each normal law that has some
_NORMAL_VALUES = {**{law: "normal_value" for law, fields in NORMAL_FIELDS.items() if fields}, "linear": "eps_n"}


def law_per_spot(argument: str, law: str, laws: dict[str, int], laws_per_area: dict[str, int]) -> int:
    """Number of a law of wires; one that holds per area only is refused by that name."""
    if law in laws_per_area and law not in laws:
        raise ValueError(f'{argument}: "{law}" is a law per area, and wires touch in spots: {_list_names(laws)}')
    return checks.choice(argument, law, laws)


def law_per_area(argument: str, law: str, laws: dict[str, int], laws_per_spot: dict[str, int]) -> int:
    """Number of a law of surfaces; one that holds per spot only is refused by that name."""
    if law in laws_per_spot and law not in laws:
        raise ValueError(f'{argument}: "{law}" is a law per spot, and this contact has an area: {_list_names(laws)}')
    return checks.choice(argument, law, laws)


def _list_names(laws: dict[str, int]) -> str:
    return ", ".join(f'"{law}"' for law in laws)


def normal_law_data(law: NormalLaw, **values: Numbers | None) -> tuple[int, NDArray[np.float64]]:
    """Number of a normal law and its data; refuses data that belong to another law."""
    number = law_per_spot("normal_law", law, NORMAL_LAWS, PRESSURE_LAWS)
    wanted = _NORMAL_VALUES.get(law)
    if wanted == "eps_n" and values["eps_n"] is None:
        raise ValueError('normal_law="linear" needs eps_n, the penalty stiffness [N/m]')
    if wanted != "eps_n" and values["eps_n"] is not None:
        raise ValueError(f'eps_n belongs to normal_law="linear"; "{law}" has no penalty')
    if wanted != "normal_value" and values["normal_value"] is not None:
        raise ValueError(f'normal_value does not belong to normal_law="{law}"')
    # where wires cross, "linear" has one number; that per length is of line contact
    fields = NORMAL_FIELDS[law][:1] if wanted == "eps_n" else NORMAL_FIELDS[law]
    return number, law_data(f'normal_law="{law}"', wanted, values, fields)


def law_data(
    law: str,
    wanted: str | None,
    values: dict[str, Numbers | None],
    fields: list[str],
    n_needed: int | None = None,
) -> NDArray[np.float64]:
    """The numbers of a law, shape (..., numbers), after checking them; one that it does not look at if it has none.

    `n_needed` of `fields` must be given, all of them when it is None. An argument for numbers of any law has them in its
    last axis; that of a single number has none of its own.
    """
    if wanted is None:
        return np.ones(1)
    value = values[wanted]
    if value is None:
        raise ValueError(f"{law} needs {wanted}")
    numbers = checks.all_positive(wanted, value)
    if wanted not in _MANY_NUMBERS:
        return numbers[..., np.newaxis]
    n_needed = len(fields) if n_needed is None else n_needed
    numbers = np.atleast_1d(numbers)
    if not n_needed <= numbers.shape[-1] <= len(fields):
        names = ", ".join(fields[:n_needed] + [f"{field}, optional" for field in fields[n_needed:]])
        number = f"{len(fields)}" if n_needed == len(fields) else f"{n_needed} to {len(fields)}"
        raise ValueError(f"{wanted} of {law} must have {number} numbers ({names}), not {numbers.shape[-1]}")
    return numbers

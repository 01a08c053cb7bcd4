"""The laws per area by their names: numbers in the tables of the program, and the data that each takes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import _core
from . import checks
from .batch import Floats
from .laws import (
    CONDUCTANCE_FIELDS,
    CONDUCTANCE_LAWS,
    NORMAL_LAWS,
    PRESSURE_FIELDS,
    PRESSURE_LAWS,
    SPOT_LAWS,
    law_per_area,
)

#: Which properties of the bodies a law may look at, in the order of the kernel's flags
_BODY_DATA = (("resistivity",), ("young", "poisson"))

_AUGMENTED = _core.f2py_surface.pressure_law_names()[2]
_LOOKS_AT = _core.f2py_surface.conductance_law_names()[2]


class AreaLaws(NamedTuple):
    """What the kernels take: numbers of the laws, their data, and the bodies (..., 3, 2): young, poisson, resistivity."""

    #: Place of the pressure law in the table of the program
    normal: int
    #: Its numbers
    normal_data: Floats
    #: Place of the conductance law; 0: no current
    spot: int
    #: Its numbers, line after line
    spot_data: Floats
    #: Young's moduli, Poisson's ratios and resistivities of both bodies (..., 3, 2)
    bodies: Floats

    @property
    def can_be_augmented(self) -> bool:
        """The pressure law takes a pressure of augmentation."""
        return bool(_AUGMENTED[self.normal - 1])


def area_laws(normal_law: str, spot_law: str, data: dict[str, ArrayLike]) -> AreaLaws:
    """The laws with their data, after checking them; data that no law takes, or that one lacks, are refused."""
    normal = law_per_area("normal_law", normal_law, PRESSURE_LAWS, NORMAL_LAWS)
    spot = law_per_area("spot_law", spot_law, {"none": 0} | CONDUCTANCE_LAWS, SPOT_LAWS)
    wanted = {f'normal_law="{normal_law}"': PRESSURE_FIELDS[normal_law], f'spot_law="{spot_law}"': _spot_data(spot_law)}
    taken = [name for names in wanted.values() for name in names]
    for name in data:
        if name not in taken:
            takes = "; ".join(f"{law} takes {', '.join(names) or 'none'}" for law, names in wanted.items())
            raise ValueError(f"{name} is no number of these laws: {takes}")
    for law, names in wanted.items():
        missing = [name for name in names if name not in data]
        if missing:
            raise ValueError(f"{law} needs {', '.join(missing)}")
    return AreaLaws(
        normal, _numbers(PRESSURE_FIELDS[normal_law], data), spot, _spot_numbers(spot_law, data), _bodies(data)
    )


def _spot_data(law: str) -> list[str]:
    """Names of the data of a conductance law, of its own and of the bodies."""
    if law == "none":
        return []
    *looks_at, has_table = _LOOKS_AT[:, CONDUCTANCE_LAWS[law] - 1]
    own = ["table"] if has_table else CONDUCTANCE_FIELDS[law]
    return own + [name for used, names in zip(looks_at, _BODY_DATA, strict=True) if used for name in names]


def _numbers(names: list[str], data: dict[str, ArrayLike]) -> Floats:
    """The numbers of a law, shape (..., numbers); one that has none gets one that it does not look at."""
    numbers = [checks.all_positive(name, data[name]) for name in names] or [np.ones(())]
    return np.stack(np.broadcast_arrays(*numbers), axis=-1)


def _spot_numbers(law: str, data: dict[str, ArrayLike]) -> Floats:
    if "table" not in data:
        return _numbers([] if law == "none" else CONDUCTANCE_FIELDS[law], data)
    shape = np.shape(data["table"])
    table = checks.leading("table", data["table"], (2, shape[-1] if len(shape) > 1 else 1))
    if not ((table > 0).all() and (np.diff(table[..., 0, :]) > 0).all()):
        raise ValueError("table must have ascending pressures and positive resistances")
    return np.swapaxes(table, -1, -2).reshape(*shape[:-2], 2 * shape[-1])


def _bodies(data: dict[str, ArrayLike]) -> Floats:
    """Young's moduli, Poisson's ratios and resistivities (..., 3, 2) of both bodies; those that no law uses are 1, 0, 1."""
    poisson = checks.leading_pair("poisson", data.get("poisson", 0.0))
    if not ((poisson > -1) & (poisson <= 0.5)).all():
        raise ValueError("poisson must be above -1, and at most 0.5")
    young, resistivity = (checks.leading_pair(name, data.get(name, 1.0)) for name in ("young", "resistivity"))
    for name, value in (("young", young), ("resistivity", resistivity)):
        checks.refuse(name, value, value <= 0, 1, "must be greater than 0, {but}")
    return np.stack(np.broadcast_arrays(young, poisson, resistivity), axis=-2)

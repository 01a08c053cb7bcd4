"""The laws per area by their names: numbers in the tables of the program, and the data that each takes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
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
    """What the kernels take: numbers of the laws, their data, and the bodies (2, 3): young, poisson, resistivity."""

    normal: int
    normal_data: NDArray[np.float64]
    spot: int
    spot_data: NDArray[np.float64]
    bodies: NDArray[np.float64]

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


def _numbers(names: list[str], data: dict[str, ArrayLike]) -> NDArray[np.float64]:
    """The numbers of a law; one that has none gets one that it does not look at."""
    return np.array([checks.positive(name, data[name]) for name in names] or [1.0])  # type: ignore[arg-type]


def _spot_numbers(law: str, data: dict[str, ArrayLike]) -> NDArray[np.float64]:
    if "table" not in data:
        return _numbers([] if law == "none" else CONDUCTANCE_FIELDS[law], data)
    table = np.asarray(data["table"], dtype=float)
    table = checks.array("table", table, (2, table.shape[-1] if table.ndim == 2 else 1))
    if not ((table > 0).all() and (np.diff(table[0]) > 0).all()):
        raise ValueError("table must have ascending pressures and positive resistances")
    return table.T.ravel()


def _bodies(data: dict[str, ArrayLike]) -> NDArray[np.float64]:
    """Young's moduli, Poisson's ratios and resistivities of both bodies (2, 3); those that no law uses are 1, 0, 1."""
    poisson = checks.pair("poisson", data.get("poisson", 0.0))
    if not ((poisson > -1) & (poisson <= 0.5)).all():
        raise ValueError("poisson must be above -1, and at most 0.5")
    young, resistivity = (checks.positive_pair(name, data.get(name, 1.0)) for name in ("young", "resistivity"))
    return np.stack([young, poisson, resistivity], axis=1)

"""The scalars of a result file: quantities that can colour the wires, by name, for any fields."""

from dataclasses import dataclass

import numpy as np

from ..base.names import unknown_field
from ..base.quantities import per
from .result_file import ResultFile

# Fields with numbers and positions, which are not results
_BOOKKEEPING = (
    "node_id",
    "element_id",
    "section",
    "wire",
    "place_in_wire",
    "direction_in_wire",
    "reference_position",
)
_AXES = "xyz"
# Heat of an element depends on its length; this does not
_HEAT, _HEAT_PER_LENGTH = "joule_heat", "joule_heat_per_length"
_POTENTIAL, _HAS_POTENTIAL = "potential", "has_potential"
_SEQUENTIAL = "viridis"
_DIVERGING = "coolwarm"
# A smaller range relative to the values is round-off
_MIN_RANGE = 1e-6


@dataclass(frozen=True)
class Scalar:
    """One number at each node or element.

    Attributes
    ----------
    name : str
        How it is asked for: a field of the file (a vector stands for its length), `FIELD.x`, `FIELD.y` or `FIELD.z`, or
        `NAME` where the file has `NAME_2` and `NAME_3`, for the length of both.
    fields : tuple of str
        What `scalar_field` has of it: fields of the file, or one that follows from them.
    component : int or None
        Component of a vector; None for its length, and for scalars.
    unit : str
    at_nodes : bool
        Given at nodes; else at elements.
    text : str
        What to call it on a picture.
    """

    name: str
    fields: tuple[str, ...]
    component: int | None
    unit: str
    at_nodes: bool
    text: str

    @property
    def is_length(self) -> bool:
        """Whether it is the length of a vector, which is never negative."""
        return self.text.endswith(", magnitude")

    def of(self, values: list[np.ndarray]) -> np.ndarray:
        """The scalar (n), given the values of `fields`, each (n) or (n, 3)."""
        if len(values) == 1 and values[0].ndim == 1:
            return values[0]
        if self.component is not None:
            return values[0][:, self.component]
        return np.linalg.norm(values[0] if len(values) == 1 else np.stack(values, axis=1), axis=1)


def scalars(results: ResultFile) -> dict[str, Scalar]:
    """All scalars of a result file by name, those of the nodes first.

    Parameters
    ----------
    results : Results
        A run with at least one increment.

    Returns
    -------
    dict of Scalar
    """
    found: dict[str, Scalar] = {}
    names = [name for name in results.fields if name not in _BOOKKEEPING]
    for name in sorted(names, key=lambda name: (name not in results.point_fields, name)):
        unit, at_nodes = results.units[name], name in results.point_fields
        if name in results.vector_fields:
            found[name] = Scalar(name, (name,), None, unit, at_nodes, f"{name}, magnitude")
            for component, axis in enumerate(_AXES):
                one = f"{name}.{axis}"
                found[one] = Scalar(one, (name,), component, unit, at_nodes, f"{name} {axis}")
        else:
            found[name] = Scalar(name, (name,), None, unit, at_nodes, name)
        if name == _HEAT:
            per_length = per(unit, results.unit_labels["m"])
            found[_HEAT_PER_LENGTH] = Scalar(
                _HEAT_PER_LENGTH, (_HEAT_PER_LENGTH,), None, per_length, at_nodes, "Joule heat per length"
            )
    for name in names:
        base, pair = name[:-2], (name, f"{name[:-2]}_3")
        if name.endswith("_2") and pair[1] in names and base not in found:
            found[base] = Scalar(
                base, pair, None, results.units[name], name in results.point_fields, f"{base}, magnitude"
            )
    return found


def find_scalar(results: ResultFile, name: str) -> Scalar:
    """The scalar of a name; a `KeyError` suggests similar names and lists all."""
    known = scalars(results)
    if name not in known:
        raise KeyError(unknown_field(name, [one for one in known if "." not in one]))
    return known[name]


def default_scalar(results: ResultFile, increment: int) -> str:
    """The potential where there is one, else the displacement."""
    return "potential" if np.ptp(results.field("potential", increment)) > 0 else "displacement"


def scalar_values(results: ResultFile, scalar: Scalar, increment: int) -> np.ndarray:
    """Values at the nodes (n_nodes) or elements (n_elements), in the unit of the scalar."""
    return scalar.of([scalar_field(results, field, increment) for field in scalar.fields])


def values_of_wires(results: ResultFile, scalar: Scalar, values: np.ndarray) -> np.ndarray:
    """Those at wires, of values at all nodes or elements: ranges are not those of images beyond the ends of a cell."""
    if not results.images.any():
        return values
    within = ~results.images
    return values[np.unique(results.elements[within])] if scalar.at_nodes else values[within]


def scalar_field(results: ResultFile, name: str, increment: int) -> np.ndarray:
    """A field of `Scalar.fields` at an increment, (n) or (n, 3): one of the file, or Joule heat per length [W/m].

    The potential is NaN where it means nothing.
    """
    if name == _POTENTIAL:
        return known_potential(results, increment)
    if name != _HEAT_PER_LENGTH:
        return results.field(name, increment)
    first, second = results.nodes[results.elements].transpose(1, 0, 2)
    return results.field(_HEAT, increment) / np.linalg.norm(second - first, axis=1)


def known_potential(results: ResultFile, increment: int) -> np.ndarray:
    """Potentials of the nodes, NaN where no conducting path leads to a prescribed one, if any is prescribed, (n_nodes) [V]."""
    potential = results.field(_POTENTIAL, increment)
    if _HAS_POTENTIAL not in results.fields:
        return potential
    has = results.field(_HAS_POTENTIAL, increment) > 0
    return np.where(has, potential, np.nan) if has.any() else potential


def end_values(results: ResultFile, scalar: Scalar, increment: int) -> np.ndarray:
    """Values at the two ends of each element, (n_elements, 2)."""
    values = scalar_values(results, scalar, increment)
    return values[results.elements] if scalar.at_nodes else np.repeat(values[:, None], 2, axis=1)


def colours_and_limits(low: float, high: float, one_sided: bool) -> tuple[str, tuple[float, float]]:
    """Name of the colour map, and the range of the colour bar.

    Values of both signs take a map whose middle is zero, so that the colour shows the sign; all others one from
    dark to bright. A constant gets a range around it, so that the bar can be drawn.
    """
    if not high - low > _MIN_RANGE * max(abs(low), abs(high)):
        margin = 0.5 * abs(low) or 0.5
        return _SEQUENTIAL, (low - margin, high + margin)
    if low < 0 < high and not one_sided and -low > 0.05 * high and high > -0.05 * low:
        largest = max(-low, high)
        return _DIVERGING, (-largest, largest)
    return _SEQUENTIAL, (low, high)

"""Helical strands and cables of several stages."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain, islice
from typing import Any

import numpy as np

from ..model import COPPER, HERTZ_AND_HOLM, Interaction, Material, Model
from ..model.wires import Wire
from .beyond_ends import Passage, go_on_beyond
from .geometry import rounded, smallest_gap
from .helices import Lay
from .layers import Layer, radius_of_layer
from .periodic_ends import STRETCH, tie_ends, whole_turns
from .strand_groups import Materials, add_strands, hold_ends
from .winding import StraightAxis, WoundAxis, points
from .wraps import Wrap, wrap_bundles

#: Wires may overlap by this share of the smallest radius where their axes are interpolated between the nodes
OVERLAP = 2e-4
#: Elements by default: length in radii of the thinnest wire, and share of OVERLAP that interpolation may take
_LENGTH, _SHARE = 3.0, 0.5
#: Pieces per element in the search for overlaps
_PARTS = 2
#: Maximum number of attempts to lay a cable without overlaps, each with larger gaps
_TRIES = 20


def strand(
    layers: Sequence[int],
    *,
    radius: float | Sequence[float],
    length: float,
    lay_length: float | Sequence[float] | None = None,
    lay_angle: float | Sequence[float] | None = None,
    direction: str | None = None,
    clearance: float = 0.0,
    enlarge: bool = False,
    element_length: float | None = None,
    elements_per_lay: int | None = None,
    material: Material | Sequence[Materials] = COPPER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
    ends: str = "clamped",
) -> Model:
    """Helical strand along z: a straight core wire, if the first layer has one wire, and layers of helices around it.

    Each layer lies on the one inside. Inclined round wires take more room side by side than straight ones: where the wires of a
    layer would overlap each other, that is an error, which says by how much and what fits; with `enlarge` the layer gets
    the radius at which its wires touch each other. Distances of neighbours are exact, over the whole length.

    Parameters
    ----------
    layers : sequence of int
        Number of wires of each layer, from the inside: `[1, 6, 12]`.
    radius : float or sequence of float
        Radius of the wires [m], of all or of each layer.
    length : float
        Length of the strand [m].
    lay_length : float or sequence of float
        Length of one turn along z [m], of all layers around the core or of each; positive: right-handed (Z), negative:
        left-handed (S); or else
    lay_angle : float or sequence of float
        Angle between wires and z at their centre lines [rad], with the same signs.
    direction : str, optional
        Hand of the layers around the core in place of signs, a letter for each, repeated: "Z" lays all right-handed,
        "SZ" in turns, the innermost left-handed.
    clearance : float
        Smallest gap between the surfaces of wires [m]; 0: they just touch.
    enlarge : bool
        Layers whose wires would overlap each other get a larger radius.
    element_length : float, optional
        Length of the elements along z [m]; or else
    elements_per_lay : int, optional
        Elements of a wire on each turn of the shortest lay. Left out both: three radii at most, as contact along lines
        needs, and so short that wires overlap by 1e-4 of their radius at most between the nodes.
    material : Material or sequence of Material
        What the wires are made of, all or those of each layer; that of a layer may be a sequence of those of its wires, as
        `[[bronze, bronze, copper]]` of a triplet. Such a layer is a group for each material, LAYER1_COPPER etc., and an
        element set LAYER1.
    interaction, element
        The laws of their contacts, type of the elements.
    ends : {"clamped", "sliding", "periodic"}
        Whether the ends of the wires are held across the strand, as in terminations, or only along it and in their directions,
        so that a jacket can press them together (`compact`); or move alike at both ends of a cell that is one of many (Notes).

    Returns
    -------
    Model
        Groups CORE, LAYER1, LAYER2, ...; element set WIRES with all; node sets MINUS (z = 0, clamped) and PLUS (z = length,
        free along z only, and guided: `model.press(-d)` pulls by d). `model.groups["LAYER1"].start` and `.end` are the
        ends of one layer.

    Raises
    ------
    ValueError
        For arguments out of range, and for layers that do not fit.

    Notes
    -----
    The nodes lie exactly on the helices. Between them the program takes the axis as a cubic with tangents of second order,
    which lies by `3/128 R x^4` inside a helix of radius R with elements of the turn x [rad]. Where such axes
    overlap by more than 2e-4 of the smallest radius, all gaps are enlarged until they do not.

    With periodic ends each wire goes on in one that begins where it ends, a part of a turn further. Lay lengths are changed, by
    10 % at most, so that this is so, which the comments of the deck say. Displacements and rotations of both ends are alike
    but for a stretch along z, the displacement of the node set STRETCH (`model.press(-d)` stretches by d; without it the cell is
    free to); potentials are not. Where wires cross, of several layers or stages, they go on beyond both ends by two elements,
    and 2.5 radii at least, the groups BEYOND_PLUS_LAYER1, BEYOND_MINUS_LAYER1, ..., as images of those that they go on in: so
    contacts near the ends are those of wires without ends. These elements have next to no stiffness and no weight. For
    currents they are a part of the wires that they go on from: contacts across the upper end belong to these, as `Results`
    has them.

    Examples
    --------
    >>> strand([1, 6], radius=[1.97e-3, 1.865e-3], lay_length=0.23, length=0.115)
    <Model 'Strand of 1+6 wires': 154 nodes, 147 elements
      <wire CORE: 21 B33 elements, radius 0.00197, COPPER>
      <6 wires LAYER1: 126 B33 elements, radius 0.001865, COPPER>
      contact among WIRES: TOUCH>
    """
    if (lay_length is None) == (lay_angle is None):
        raise ValueError("a strand needs either lay_length or lay_angle")
    lays = _lays(layers, lay_length, lay_angle, direction)
    name = f"Strand of {'+'.join(map(str, layers))} wires"
    return _Plan(
        name, [layers], [lays], radius, length, clearance, enlarge, element_length, elements_per_lay, material
    ).model(interaction, element, ends)


def cable(
    stages: Sequence[Sequence[int]],
    *,
    radius: float | Sequence[float],
    lay_lengths: Sequence[float | Sequence[float]],
    length: float,
    clearance: float = 0.0,
    enlarge: bool = True,
    element_length: float | None = None,
    elements_per_lay: int | None = None,
    material: Material | Sequence[Materials] = COPPER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
    ends: str = "clamped",
    wrap: Wrap | Interaction | None = None,
) -> Model:
    """Cable of several stages along z: wires are laid to strands, strands to ropes, and so on.

    The first stage lays wires, every later one lays bundles of the stage before: `[[3], [3], [5]]` is a petal of an ITER
    cable. Centre lines are exact: helices about helices, in the planes normal to these, each turn along the arc of what it is
    wound around. In a layer, bundles have the room of round rods; if wires still overlap, because curved bundles
    bend towards each other, the cable is laid again with larger gaps.

    Parameters
    ----------
    stages : sequence of sequences of int
        Members of each layer of each stage, from the inside: `[[1, 6], [1, 6]]` is a 7 x 7 rope.
    radius : float or sequence of float
        Radius of the wires [m], of all or of each layer of the first stage.
    lay_lengths : sequence
        Lay length of each stage [m], or a sequence of those of its layers; a layer of a single member in the middle has
        none. Positive: right-handed (Z), negative: left-handed (S).
    length : float
        Length of the cable [m].
    clearance : float
        Smallest gap between the surfaces of wires [m]; 0: some just touch.
    enlarge : bool
        Layers whose members would overlap each other get a larger radius; False: that is an error.
    element_length, elements_per_lay, material, interaction, element, ends
        As those of `strand`; elements per turn of the shortest lay of all.
    wrap : Wrap or Interaction, optional
        A tape around each bundle of the last stage, through which strands of different bundles touch; or the laws of contact
        between these bundles, as measured resistances (`TableSpot`).

    Returns
    -------
    Model
        Groups CORE, LAYER1, ... with the wires of each layer of the first stage; element set WIRES with all; node sets MINUS
        (z = 0, clamped) and PLUS (z = length, free along z only, and guided: `model.press(-d)` pulls by d). With several
        stages, also element sets BUNDLE1, BUNDLE2, ... of the members of the last stage, BUNDLE1_1, BUNDLE1_2, ... of the
        members of each of these, and so on, and node sets of their ends, BUNDLE1_MINUS, BUNDLE1_PLUS, ..., for clamps and
        terminals.

    Raises
    ------
    ValueError
        For arguments out of range, and for layers that do not fit.

    Examples
    --------
    >>> cable([[3], [3]], radius=0.41e-3, lay_lengths=[80e-3, 140e-3], length=70e-3)
    <Model 'Cable of 3 x 3 wires': 522 nodes, 513 elements
      <9 wires LAYER1: 513 B33 elements, radius 0.00041, COPPER>
      contact among WIRES: TOUCH>
    """
    if not all(isinstance(layers, Sequence | np.ndarray) for layers in stages):
        raise ValueError(f"stages: the counts of the layers of each, from inside, as [[1, 6], [3]]; found {stages!r}")
    if len(stages) != len(lay_lengths) or not stages:
        raise ValueError(f"a lay length is needed for each of the {len(stages)} stages, not {len(lay_lengths)}")
    lays = [_lays(layers, lay, None, None) for layers, lay in zip(stages, lay_lengths, strict=True)]
    name = f"Cable of {' x '.join('+'.join(map(str, layers)) for layers in reversed(stages))} wires"
    return _Plan(
        name, stages, lays, radius, length, clearance, enlarge, element_length, elements_per_lay, material
    ).model(interaction, element, ends, wrap)


@dataclass(frozen=True)
class _Plan:
    """What is to be laid."""

    name: str
    stages: Sequence[Sequence[int]]
    #: Of each layer of each stage; None for a straight core
    lays: list[list[Lay | None]]
    radius: float | Sequence[float]
    length: float
    clearance: float
    enlarge: bool
    element_length: float | None
    elements_per_lay: int | None
    material: Material | Sequence[Materials]

    def __post_init__(self) -> None:
        if not self.length > 0 or not min(self.radii) > 0 or not self.clearance >= 0:
            raise ValueError("a cable needs a positive radius and length, and a clearance of 0 or more")
        if not any(lay for stage in self.lays for lay in stage):
            raise ValueError("a cable needs at least one layer around a core")
        if self.element_length is not None and self.elements_per_lay is not None:
            raise ValueError("give either element_length or elements_per_lay")
        if self.element_length is not None and not self.element_length > 0:
            raise ValueError(f"element_length must be greater than 0, not {self.element_length:g}")
        if self.elements_per_lay is not None and self.elements_per_lay < 4:
            raise ValueError(f"elements_per_lay must be 4 or more, not {self.elements_per_lay}")

    @property
    def radii(self) -> list[float]:
        """Radius of the wires of each layer of the first stage [m]."""
        return _each("radius", self.radius, len(self.stages[0]))

    @property
    def group_names(self) -> list[str]:
        """Names of the layers of the first stage."""
        core = self.lays[0][0] is None
        return ["CORE"] * core + [f"LAYER{number + 1}" for number in range(len(self.stages[0]) - core)]

    @property
    def _alike(self) -> list[list[int]]:
        """Parts of a turn after which each layer of each stage looks as before."""
        materials = _each("material", self.material, len(self.radii))
        first = [
            count if isinstance(of_layer, Material) else 1
            for count, of_layer in zip(self.stages[0], materials, strict=True)
        ]
        return [first, *(list(counts) for counts in self.stages[1:])]

    def model(self, interaction: Interaction, element: str, ends: str, wrap: Wrap | Interaction | None = None) -> Model:
        """The model, with gaps that are enlarged until no wires overlap."""
        room, allowed = self.clearance, OVERLAP * min(self.radii)
        remarks = [layer.remark for stage in self._laid(room, self.enlarge) for layer in stage if layer.remark]
        for _ in range(_TRIES):
            asked = laid = self._laid(room, enlarge=True)
            if ends == "periodic":
                laid = whole_turns(asked, self.length, self._alike)
            model = self._meshed(laid, element)
            gap = smallest_gap(model, within=2 * self.clearance + allowed, parts=_PARTS)
            if gap >= self.clearance - allowed:
                break
            room += self.clearance - gap
        else:
            raise ValueError("the wires overlap for any gap: the lay is too short")
        model.comments += remarks
        passages: list[Passage] = []
        if ends == "periodic":
            model.comments += [
                f"lay of {new.lay_length:.6g} m, for {old.lay_length:.6g}, so that both ends are alike"
                for before, after in zip(asked, laid, strict=True)
                for old, new in zip(before, after, strict=True)
                if new.at > 0
            ]
            passages = tie_ends(model, self.length)
        else:
            hold_ends(model, ends)
        model.contact("WIRES", interaction=interaction)
        bundles = sum(self.stages[-1]) if len(self.stages) > 1 else 1
        wrapped = None if wrap is None else wrap_bundles(model, wrap, interaction, bundles)
        # of a single layer each cross-section is like any other
        if passages and sum(layer.at > 0 for stage in laid for layer in stage) > 1:
            go_on_beyond(model, passages, STRETCH, interaction, bundles, wrapped)
        return model

    def _laid(self, room: float, enlarge: bool) -> list[list[Layer]]:
        """Layers of each stage with their radii."""
        stages: list[list[Layer]] = []
        members = self.radii
        for number, (counts, lays) in enumerate(zip(self.stages, self.lays, strict=True)):
            inside = 0.0
            laid = []
            for layer, (count, lay) in enumerate(zip(counts, lays, strict=True)):
                what = f"layer {layer + (lays[0] is not None)}" + f" of stage {number + 1}" * (len(self.stages) > 1)
                laid.append(radius_of_layer(what, count, members[layer], lay, inside, room, enlarge))
                inside = laid[-1].outside
            stages.append(laid)
            members = [inside] * len(self.stages[min(number + 1, len(self.stages) - 1)])
        return stages

    def _meshed(self, laid: list[list[Layer]], element: str) -> Model:
        """Wires, their sets and ends."""
        z = np.linspace(0, self.length, self._n_elements(laid) + 1)
        materials = _each("material", self.material, len(self.radii))
        first, *later = laid
        bundles: list[StraightAxis | WoundAxis] = [StraightAxis(self.length)]
        if later:
            bundles = _wound(bundles, later[-1])
        members: list[list[list[Wire]]] = [[] for _ in bundles]
        model = Model(self.name)
        laid_alike = zip(first, self.group_names, self.radii, materials, self.stages[0], strict=True)
        for layer, name, radius, material, count in laid_alike:
            axes = [
                [rounded(points(axis, z), min(self.radii)) for axis in _wound([bundle], *reversed(later[:-1]), [layer])]
                for bundle in bundles
            ]
            strands = add_strands(
                model, name, list(chain(*axes)), radius=radius, material=material, element=element, count=count
            )
            wires = iter(strands)
            for of_bundle, its_members in zip(axes, members, strict=True):
                its_members.append(list(islice(wires, len(of_bundle))))
        model.element_set("WIRES", list(model.groups))
        if later:
            counts = [sum(stage) for stage in self.stages[-2:0:-1]]
            for number, layers in enumerate(members, start=1):
                _name_bundles(model, f"BUNDLE{number}", layers, counts)
        return model

    def _n_elements(self, laid: list[list[Layer]]) -> int:
        """Elements of each wire."""
        shortest = min(abs(layer.lay_length) for stage in laid for layer in stage)
        if self.elements_per_lay is not None:
            longest = shortest / self.elements_per_lay
        elif self.element_length is not None:
            longest = self.element_length
        else:
            thinnest = min(self.radii)
            longest = _LENGTH * thinnest
            for layer in (layer for stage in laid for layer in stage if layer.at > 0):
                turn = (_SHARE * OVERLAP * thinnest / (3 / 128 * layer.at)) ** 0.25
                longest = min(longest, turn / (2 * math.pi) * abs(layer.lay_length))
        return max(1, math.ceil(self.length / longest * (1 - 1e-12)))


def _lays(
    layers: Sequence[int],
    lengths: float | Sequence[float] | None,
    angles: float | Sequence[float] | None,
    direction: str | None,
) -> list[Lay | None]:
    """How each layer is laid; None for one member in the middle."""
    if not layers or min(layers) < 1:
        raise ValueError("each layer needs at least one member")
    core = layers[0] == 1
    n_laid = len(layers) - core
    what = "lay length" if angles is None else "lay angle"
    given = lengths if angles is None else angles
    values = [float(value) for value in _each(what, given, n_laid)]
    if not all(math.isfinite(value) and value != 0 for value in values):
        raise ValueError(f"{_layers_need(n_laid)} a {what} other than 0 each; given are {values}")
    if angles is not None and not all(abs(value) < math.pi / 2 for value in values):
        raise ValueError(f"a lay angle is below pi/2 (90 degrees); given are {values}")
    if direction is not None and (not direction or set(direction.upper()) - set("SZ") or min(values) < 0):
        raise ValueError(
            'direction is made of the letters S (left-handed) and Z (right-handed), as "SZ"; lays are then positive'
        )
    hands = [math.copysign(1, value) for value in values]
    if direction is not None:
        hands = [1 if direction.upper()[i % len(direction)] == "Z" else -1 for i in range(n_laid)]
    kind = "length" if angles is None else "angle"
    return [None] * core + [
        Lay(**{kind: abs(value)}, hand=int(hand)) for value, hand in zip(values, hands, strict=True)
    ]


def _wound(curves: list[StraightAxis | WoundAxis], *stages: Sequence[Layer]) -> list[StraightAxis | WoundAxis]:
    """Members of stages, from the outermost, wound about each curve, and so on."""
    for stage in stages:
        curves = [axis for curve in curves for layer in stage for axis in layer.wound(curve)]
    return curves


def _each(what: str, value: Any, count: int) -> list[Any]:
    """A value for each of `count` layers, from one for all or a sequence."""
    values = list(value) if isinstance(value, Sequence | np.ndarray) else [value] * count
    if len(values) != count:
        allowed = f"one {what}" if count == 1 else f"one {what} for all or {count}"
        raise ValueError(f"{_layers_need(count)} {allowed}; given are {len(values)}: {values}")
    return values


def _layers_need(count: int) -> str:
    return "1 layer needs" if count == 1 else f"{count} layers need"


def _name_bundles(model: Model, name: str, layers: list[list[Wire]], counts: list[int]) -> None:
    """Element sets of a bundle and of those within it, node sets of their ends.

    Parameters
    ----------
    model : Model
    name : str
        Of the bundle; the bundles within it are NAME_1, NAME_2, ...
    layers : list of lists of wires
        Its wires in the layers of the first stage, in the order of the bundles within it.
    counts : list of int
        Bundles within it, bundles within each of these, and so on.
    """
    wires = [wire for layer in layers for wire in layer]
    model.element_set(name, [element for wire in wires for element in wire.elements])
    model.node_set(f"{name}_MINUS", [wire.nodes[0] for wire in wires])
    model.node_set(f"{name}_PLUS", [wire.nodes[-1] for wire in wires])
    if not counts:
        return
    for number in range(counts[0]):
        parts = [layer[number * len(layer) // counts[0] : (number + 1) * len(layer) // counts[0]] for layer in layers]
        _name_bundles(model, f"{name}_{number + 1}", parts, counts[1:])

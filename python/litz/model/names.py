"""What a deck can refer to by name or number: nodes, wires, sets, amplitudes."""

from collections.abc import Iterable, Sequence
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..base.names import nearest_name
from ..deck.keyword_table import check_name, squeezed
from .loading import Amplitude, Target
from .surfaces import RigidSurface
from .wires import Nodes, Points, WireGroup

#: A node, some nodes, the nodes of a wire, the reference node of a rigid surface, or the name of a node set
AnyNodes = int | str | Nodes | WireGroup | RigidSurface


class Names:
    """Nodes, groups of wires, sets and amplitudes, by their names and numbers.

    Attributes
    ----------
    groups : dict of str to WireGroup
        The wires.
    node_sets : dict of str to list
        Node numbers of each node set besides those of the groups.
    element_sets : dict of str to list
        Names of groups, and numbers of elements, of each element set.
    surfaces : dict of str to RigidSurface
        The rigid surfaces.
    amplitudes : dict of str to Amplitude
        Factors over time.
    """

    def __init__(self) -> None:
        self.groups: dict[str, WireGroup] = {}
        self.node_sets: dict[str, list[int]] = {}
        self.element_sets: dict[str, list[str | int]] = {}
        self.surfaces: dict[str, RigidSurface] = {}
        self.amplitudes: dict[str, Amplitude] = {}
        #: Nodes beyond the ends of a cell, and the nodes within it that they are images of
        self.images: dict[int, int] = {}
        self._points = Points()
        self._n_elements = 0

    def _check_node(self, node: int) -> int:
        if isinstance(node, bool) or not 1 <= node <= len(self._points):
            raise ValueError(f"there are nodes 1 to {len(self._points)}, not {node}")
        return int(node)

    def _claim(self, name: str) -> None:
        """Refuse a name that a group, set or surface has."""
        check_name(name)
        known = [*self.groups, *self.node_sets, *self.element_sets]
        if squeezed(name) in map(squeezed, known):
            raise ValueError(f"there is a group or set {name} already")
        if squeezed(name) in map(squeezed, self.surfaces):
            raise ValueError(f"there is a rigid surface {name} already")

    def amplitude_name(self, amplitude: Amplitude | str | None) -> str | None:
        """The name of an amplitude of the model, given itself or by its name; None stays None."""
        if amplitude is None:
            return None
        name = amplitude.name if isinstance(amplitude, Amplitude) else amplitude
        if name not in self.amplitudes:
            known = list(self.amplitudes)
            raise ValueError(f"there is no amplitude {name!r}{nearest_name(name, known)}; there are: {known or 'none'}")
        return name

    def node_set(self, name: str, nodes: Any) -> Nodes:
        """Name nodes.

        Parameters
        ----------
        name : str
            Name of the set.
        nodes : int, Nodes, WireGroup, str, or a sequence of them
            Its members.
        """
        members = list(dict.fromkeys(self._members(nodes)))
        if not members:
            raise ValueError(f"the node set {name} has no members")
        self._claim(name)
        self.node_sets[name] = members
        return Nodes(name, members)

    def element_set(self, name: str, elements: Any) -> str:
        """Name elements: the groups, element sets and element numbers of a sequence. Returns the name."""
        items = [elements] if isinstance(elements, str | WireGroup | Integral) else list(elements)
        members: list[str | int] = []
        for item in items:
            if isinstance(item, Integral):
                if not 1 <= int(item) <= self._n_elements:
                    raise ValueError(f"there are elements 1 to {self._n_elements}, not {item}")
                members.append(int(item))
            else:
                members.append(self.element_set_of(item))
        if not members:
            raise ValueError(f"the element set {name} has no members")
        self._claim(name)
        self.element_sets[name] = members
        return name

    def _members(self, nodes: Any) -> Iterable[int]:
        if isinstance(nodes, str):
            return self.nodes_of(self._known_node_set(nodes))
        if isinstance(nodes, WireGroup):
            return nodes.nodes
        if isinstance(nodes, RigidSurface):
            return [self._own_surface(nodes).reference_node]
        if isinstance(nodes, Integral):
            return [self._check_node(int(nodes))]
        if isinstance(nodes, np.ndarray):
            nodes = nodes.ravel().tolist()
        return [member for one in nodes for member in self._members(one)]

    def _known_node_set(self, name: str) -> str:
        known = [*self.groups, *self.node_sets]
        for one in known:
            if squeezed(one) == squeezed(name):
                return one
        there = ", ".join(known[:40]) or "none"
        raise ValueError(f"there is no node set {name!r}{nearest_name(name, known)}; there are: {there}")

    def target(self, nodes: AnyNodes) -> Target:
        """What stands for nodes on a data line: a number, or the name of a node set, which is made if need be."""
        if isinstance(nodes, Integral):
            return self._check_node(int(nodes))
        if not isinstance(nodes, str | WireGroup | Nodes):
            members = list(dict.fromkeys(self._members(nodes)))
            if len(members) == 1:
                return members[0]
            nodes = Nodes(span_name(members), members)
        return self.node_set_of(nodes)

    def with_images(self, nodes: AnyNodes) -> list[Target]:
        """What stands on data lines for nodes, and for those that are images of them beyond the ends of a cell."""
        target = self.target(nodes)
        members = set(self.nodes_of(target))
        images = [image for image, node in self.images.items() if node in members and image not in members]
        return [target, self.target(Nodes(f"IMAGES_{target}", images))] if images else [target]

    def node_set_of(self, nodes: AnyNodes) -> str:
        """Name of the node set of some nodes, which is made if need be."""
        if isinstance(nodes, str):
            return self._known_node_set(nodes)
        if isinstance(nodes, WireGroup):
            return self._own(nodes).name
        if isinstance(nodes, RigidSurface):
            nodes = Nodes(f"{nodes.name}_NODE", self._members(nodes))
        elif not isinstance(nodes, Nodes):
            members = list(dict.fromkeys(self._members(nodes)))
            nodes = Nodes(span_name(members), members)
        if not nodes:
            raise ValueError(f"{nodes!r} is empty")
        for node in nodes:
            self._check_node(node)
        if nodes.name in self.groups or nodes.name in self.node_sets:
            if set(self.nodes_of(nodes.name)) != set(nodes):
                raise ValueError(f"there is another node set {nodes.name}, with other members")
            return nodes.name
        return self.node_set(nodes.name, nodes).name

    def element_set_of(self, elements: str | WireGroup) -> str:
        """Name of an element set or group."""
        if isinstance(elements, WireGroup):
            return self._own(elements).name
        known = [*self.groups, *self.element_sets]
        for one in known:
            if isinstance(elements, str) and squeezed(one) == squeezed(elements):
                return one
        there = ", ".join(known[:40]) or "none"
        raise ValueError(f"there is no element set {elements!r}{nearest_name(elements, known)}; there are: {there}")

    def _own(self, group: WireGroup) -> WireGroup:
        if self.groups.get(group.name) is not group:
            raise ValueError(f"{group!r} belongs to another model")
        return group

    def _own_surface(self, surface: RigidSurface) -> RigidSurface:
        if self.surfaces.get(surface.name) is not surface:
            raise ValueError(f"the rigid surface {surface.name} belongs to another model")
        return surface

    def nodes_of(self, target: Target) -> list[int]:
        """Node numbers of a node, a group or a node set."""
        if isinstance(target, int):
            return [target]
        return list(self.groups[target].nodes) if target in self.groups else self.node_sets[target]

    def elements_of(self, elements: str | WireGroup) -> list[int]:
        """Element numbers of a group or an element set."""
        name = self.element_set_of(elements)
        if name in self.groups:
            return list(self.groups[name].elements)
        members = self.element_sets[name]
        return [number for one in members for number in ([one] if isinstance(one, int) else self.elements_of(one))]

    @property
    def x(self) -> NDArray[np.float64]:
        """Positions of the nodes, (n, 3) [m]; node i is in row i - 1."""
        return self._points.positions


def span_name(members: Sequence[int]) -> str:
    """Name of a set of nodes that has none."""
    if not members:
        raise ValueError("no nodes are given")
    return f"NODES_{members[0]}_TO_{members[-1]}_{len(members)}"

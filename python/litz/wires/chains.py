"""Wires as chains of elements."""

from dataclasses import dataclass

import numpy as np

#: Element sets of what wires of a cell with periodic ends have beyond these: images of elements within the cell
BEYOND = ("BEYOND_PLUS", "BEYOND_MINUS")


@dataclass(frozen=True)
class Wire:
    """Elements that follow each other without a branch.

    Attributes
    ----------
    nodes : ndarray
        Rows of the nodes along the wire, (n + 1); in a closed wire the last is the first.
    elements : ndarray
        Rows of the elements, (n).
    signs : ndarray
        +1 where the element points along the wire, -1 where against it, (n).
    """

    nodes: np.ndarray
    elements: np.ndarray
    signs: np.ndarray


def find_wires(elements: np.ndarray) -> list[Wire]:
    """Chains of elements between free ends and branches, and closed rings, in the order of their first elements.

    Parameters
    ----------
    elements : ndarray
        Rows of the two nodes of each element, (n_elements, 2).
    """
    plain = _follow_each_other(elements)
    if plain is not None:
        return plain
    at_node: dict[int, list[int]] = {}
    for element, ends in enumerate(elements):
        for node in ends:
            at_node.setdefault(int(node), []).append(element)
    left = dict.fromkeys(range(len(elements)))
    starts = [int(node) for pair in elements for node in pair if len(at_node[int(node)]) != 2]

    wires = []
    for node in starts:
        wires += [_follow(node, element, elements, at_node, left) for element in at_node[node] if element in left]
    while left:
        element = next(iter(left))
        wires.append(_follow(int(elements[element, 0]), element, elements, at_node, left))
    return sorted(wires, key=lambda wire: wire.elements.min())


def _follow_each_other(elements: np.ndarray) -> list[Wire] | None:
    """The wires, if each element of a wire follows the one before it in the list; None: some do not."""
    if not len(elements):
        return []
    is_inner = np.bincount(elements.ravel()) == 2
    joined = (elements[:-1, 1] == elements[1:, 0]) & is_inner[elements[1:, 0]]
    if joined.sum() < is_inner.sum():
        return None
    chains = np.split(np.arange(len(elements)), np.flatnonzero(~joined) + 1)
    return [
        Wire(np.append(elements[chain, 0], elements[chain[-1], 1]), chain, np.ones(len(chain), dtype=int))
        for chain in chains
    ]


def without_images(wires: list[Wire], is_image: np.ndarray) -> list[Wire]:
    """The wires without elements at their ends that are images of others.

    Parameters
    ----------
    wires : list of Wire
        All wires.
    is_image : ndarray of bool
        Of each element, (n_elements).
    """
    if not is_image.any():
        return wires
    trimmed = []
    for wire in wires:
        own = np.flatnonzero(~is_image[wire.elements])
        if len(own):
            kept = slice(own[0], own[-1] + 1)
            trimmed.append(Wire(wire.nodes[own[0] : own[-1] + 2], wire.elements[kept], wire.signs[kept]))
    return trimmed


def ends_of_images(wires: list[Wire], is_image: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ends of wires from which images go on.

    Parameters
    ----------
    wires, is_image
        As those of `without_images`.

    Returns
    -------
    element, xi : (n_elements) arrays
        Row of the last element of the wire before each image, and the end of it where the image begins, -1 or 1; of other
        elements -1 and 0.
    """
    element, xi = np.full(len(is_image), -1), np.zeros(len(is_image))
    for wire in wires:
        own = np.flatnonzero(~is_image[wire.elements])
        if not len(own):
            continue
        for images, last, outward in ((slice(None, own[0]), own[0], -1), (slice(own[-1] + 1, None), own[-1], 1)):
            element[wire.elements[images]] = wire.elements[last]
            xi[wire.elements[images]] = outward * wire.signs[last]
    return element, xi


def numbered_wires(elements: np.ndarray, wire: np.ndarray, place: np.ndarray, direction: np.ndarray) -> list[Wire]:
    """The wires with given numbers of their elements.

    Parameters
    ----------
    elements : ndarray
        Rows of the two nodes of each element, (n_elements, 2).
    wire, place, direction : ndarray
        Number of the wire of each element, place along it, and +1 where the element points along it, -1 where against it,
        (n_elements).
    """
    order = np.lexsort((place, wire))
    begins, ends = (np.where(direction > 0, elements[:, i], elements[:, 1 - i]) for i in (0, 1))
    chains = np.split(order, np.flatnonzero(np.diff(wire[order])) + 1) if len(order) else []
    return [Wire(np.append(begins[chain], ends[chain[-1]]), chain, direction[chain]) for chain in chains]


def _follow(node: int, element: int | None, elements: np.ndarray, at_node: dict, left: dict) -> Wire:
    """The wire that leaves a node through an element; its elements are removed from `left`."""
    nodes, chain, signs = [node], [], []
    while element is not None:
        del left[element]
        first, second = (int(end) for end in elements[element])
        signs.append(1 if first == node else -1)
        node = second if first == node else first
        chain.append(element)
        nodes.append(node)
        onward = [other for other in at_node[node] if other in left] if len(at_node[node]) == 2 else []
        element = onward[0] if onward else None
    if signs[chain.index(min(chain))] < 0:
        nodes, chain, signs = nodes[::-1], chain[::-1], [-sign for sign in signs[::-1]]
    return Wire(np.array(nodes), np.array(chain), np.array(signs))

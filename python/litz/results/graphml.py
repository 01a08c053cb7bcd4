"""Graphs as GraphML files."""

from os import PathLike
from pathlib import Path
from xml.etree import ElementTree

import numpy as np


def write_graphml(
    path: str | PathLike,
    name: str,
    nodes: list[str],
    of_nodes: dict[str, np.ndarray],
    ends: np.ndarray,
    of_edges: dict[str, np.ndarray],
    edges: list[str] | None = None,
) -> Path:
    """Write an undirected graph, in which several edges may join the same two nodes.

    Parameters
    ----------
    path, name
        The file, and what the graph is called.
    nodes : list of str
        Names of the nodes.
    of_nodes, of_edges : dict of arrays
        Columns of numbers, a row for each node (n) or edge (m).
    ends : (m, 2) array of int
        Rows of the nodes that each edge joins.
    edges : list of str, optional
        Names of the edges; default: edge1, edge2, ...
    """
    root = ElementTree.Element("graphml", xmlns="http://graphml.graphdrawing.org/xmlns")
    for what, columns in (("node", of_nodes), ("edge", of_edges)):
        for column, values in columns.items():
            kind = "long" if np.issubdtype(values.dtype, np.integer) else "double"
            key = {"id": f"{what}_{column}", "for": what, "attr.name": column, "attr.type": kind}
            ElementTree.SubElement(root, "key", key)
    graph = ElementTree.SubElement(root, "graph", id=name, edgedefault="undirected")
    for row, node in enumerate(nodes):
        _add_data(ElementTree.SubElement(graph, "node", id=node), "node", of_nodes, row)
    names = edges or [f"edge{number + 1}" for number in range(len(ends))]
    for row, (edge, (first, second)) in enumerate(zip(names, ends.tolist(), strict=True)):
        made = ElementTree.SubElement(graph, "edge", id=edge, source=nodes[first], target=nodes[second])
        _add_data(made, "edge", of_edges, row)
    path = Path(path)
    ElementTree.indent(root)
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
    return path


def _add_data(parent: ElementTree.Element, what: str, columns: dict[str, np.ndarray], row: int) -> None:
    for name, values in columns.items():
        # as Java, Python and C read it
        text = repr(values[row].item()).replace("inf", "Infinity").replace("nan", "NaN")
        ElementTree.SubElement(parent, "data", key=f"{what}_{name}").text = text

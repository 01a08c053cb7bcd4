"""Currents in a network of resistors: Kirchhoff's laws."""

import numpy as np


def potentials(n_nodes, resistors, held):
    """Potentials of the nodes.

    Parameters
    ----------
    n_nodes : int
    resistors : list of (node, node, resistance)
    held : dict of node -> potential
    """
    matrix, right = np.zeros((n_nodes, n_nodes)), np.zeros(n_nodes)
    for a, b, resistance in resistors:
        matrix[[a, b], [a, b]] += 1.0 / resistance
        matrix[[a, b], [b, a]] -= 1.0 / resistance
    for node, potential in held.items():
        matrix[node] = 0.0
        matrix[node, node] = 1.0
        right[node] = potential
    return np.linalg.solve(matrix, right)

"""Networks of conductances, and a mat between electrodes as one."""

import itertools

import numpy as np

from litz.wires.chains import find_wires


class Network:
    """Points joined by conductances; some are held, into others something flows."""

    def __init__(self, n_points, links, held):
        self.held = held
        self.free = [point for point in range(n_points) if point not in held]
        self.matrix = np.zeros((n_points, n_points))
        for first, second, value in links:
            self.matrix[[first, second], [first, second]] += value
            self.matrix[[first, second], [second, first]] -= value

    def solve(self, flowing_in):
        values = np.zeros(len(self.matrix))
        values[list(self.held)] = list(self.held.values())
        right = flowing_in - self.matrix @ values
        values[self.free] = np.linalg.solve(self.matrix[np.ix_(self.free, self.free)], right[self.free])
        return values

    def flowing_in(self, values):
        """What must flow into each point for these values."""
        return self.matrix @ values


def points_of_mat(results, increment=-1):
    """Points of the wires at contacts, the stretches between them, the spots, and the points that electrodes hold."""
    network = results.contact_network(increment)
    n_contacts = len(network.id)
    point = np.arange(2 * n_contacts).reshape(n_contacts, 2)
    n_points = point.size
    stretches, plates = [], {}
    for number, wire in enumerate(find_wires(results.elements)):
        k, side = np.nonzero(network.wires == number)
        along = list(zip(network.arc[k, side], point[k, side], strict=True))
        if number < 12:  # bars of the electrodes
            arc = np.linalg.norm(results.nodes[wire.nodes] - results.nodes[wire.nodes[0]], axis=1)
            nodes = range(n_points, n_points + len(arc))
            plates |= dict.fromkeys(nodes, number >= 6)
            along += zip(arc, nodes, strict=True)
            n_points += len(arc)
        along.sort()
        stretches += [(p, q, b - a) for (a, p), (b, q) in itertools.pairwise(along)]
    return network, n_points, stretches, plates

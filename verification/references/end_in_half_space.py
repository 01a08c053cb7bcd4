"""Round ends of cylinders are pressed into an elastic half-space or onto a cylinder: forces by a boundary-element method.

Source: the deflection of a half-space under even pressure on a rectangle, A. E. H. Love, Phil. Trans. R. Soc. A 228 (1929)
377-420; contact as a linear complementarity problem, solved by projected conjugate gradients as I. A. Polonsky, L. M. Keer,
Wear 231 (1999) 206-219, do. Lengths along the surface are over sqrt(rho delta), heights over the approach delta, so that a
sphere of the radius rho has the height (x^2 + y^2)/2 and the force 4/3; E* is 1.

Contacts along wires that are not short beside their radius feel their sections: solid_wire.py.
"""

import numpy as np

from verification.references.solid_wire import less_than_half_space

#: Of the wires whose sections count
POISSON = 0.34


def deflection_of_cells(shape, size, overlap=0.0):
    """Deflection by a pressure of 1 on one cell, as the transform over twice the grid.

    overlap: over the radius, of two solid wires along x; 0: a half-space.
    """
    (nx, ny), (dx, dy) = shape, size
    x, y = np.meshgrid(np.arange(-nx, nx) * dx, np.arange(-ny, ny) * dy, indexing="ij")

    def corner(x, y):
        r = np.hypot(x, y)
        return x * np.log(y + r) + y * np.log(x + r)

    a, b = dx / 2, dy / 2
    whole = corner(x + a, y + b) - corner(x - a, y + b) - corner(x + a, y - b) + corner(x - a, y - b)
    if overlap > 0:
        unit = np.sqrt(overlap)
        whole -= dx * dy * unit * less_than_half_space(unit * np.abs(x[:, :1]), POISSON)
    return np.fft.rfft2(np.fft.ifftshift(whole / np.pi))


def contact_force(height, size, tolerance=1e-7, most_iterations=2000, overlap=0.0):
    """Force of a rigid body of these heights [delta] on cells of this size, approached by 1; overlap: of solid wires."""
    kernel = deflection_of_cells(height.shape, size, overlap)
    nx, ny = height.shape

    def deflection(pressure):
        padded = np.zeros((2 * nx, 2 * ny))
        padded[:nx, :ny] = pressure
        return np.fft.irfft2(np.fft.rfft2(padded) * kernel, s=padded.shape)[:nx, :ny]

    overlap = 1 - height
    pressure = np.sqrt(np.maximum(overlap, 0))
    direction, last, conjugate = np.zeros_like(pressure), 1.0, False
    for _ in range(most_iterations):
        gap = deflection(pressure) - overlap
        touching = pressure > 0
        if np.abs(gap[touching]).max() < tolerance and gap[~touching].min() > -tolerance:
            return pressure.sum() * size[0] * size[1]
        square = (gap[touching] ** 2).sum()
        direction = np.where(touching, gap + conjugate * square / last * direction, 0)
        last = square
        way = (gap[touching] * direction[touching]).sum() / (deflection(direction) * direction)[touching].sum()
        pressure = np.maximum(pressure - way * direction, 0)
        enters = (pressure == 0) & (gap < 0)
        pressure[enters] -= way * gap[enters]
        conjugate = not enters.any()
    raise RuntimeError("the contact did not converge")


def force_of_end(slope, bend, cells=70):
    """Force over that of the sphere alone.

    slope: v = t sqrt(rho/delta) at which the cylinder rises from the end on, positive; bend: kappa = k rho of its curvature
    away from the surface. The curvature is that of the distance from the surface: 1/rho of the sphere, kappa/rho of the
    cylinder along itself.
    """
    first = -slope - 1.4
    last = max(1.7, 0.5 + 2 / (slope + np.sqrt(slope**2 + 2 * bend)))
    n, m = round(cells * (last - first) / 2.8), cells + cells % 2
    size = ((last - first) / n, 2.8 / m)
    x = first + (np.arange(n) + 0.5) * size[0]
    y = -1.4 + (np.arange(m) + 0.5) * size[1]
    along = slope * x + np.where(x < 0, 1, bend) * x**2 / 2 + slope**2 / 2
    return contact_force(along[:, None] + y[None, :] ** 2 / 2, size) / (4 / 3)


def force_of_tip(slope, cells=120, overlap=0.0):
    """Force over E* r^(1/2) delta^(3/2) of the end of a wire that leans on an equal one, in the plane of both.

    slope: v = t sqrt(r/delta) at which it rises from its end on, positive; overlap: delta/r of solid wires, 0: a half-space.
    """
    return force_of_wires(lambda x: slope * x + sphere(-x), (-1.5 - slope, 0.4 + 1 / slope), cells, overlap=overlap)


def force_of_lap(length, bend=0.0, cells=120, overlap=0.0):
    """The same of two equal wires side by side whose ends are a length apart, over sqrt(r delta).

    bend: k r of the curvature with which they part between the ends, so that these touch first.
    """
    half = length / 2
    return force_of_wires(
        lambda x: bend / 2 * (half**2 - x**2) + sphere(x - half) + sphere(-x - half), (-half - 1.5, half + 1.5), cells,
        overlap=overlap,
    )  # fmt: skip


def force_of_passing(slope, lap, cells=120, overlap=0.0):
    """The same of a tip that leans as in `force_of_tip` and passes the end of a wire that leads the other way.

    lap: from the tip to that end, over sqrt(r delta); negative: the tip is beyond it, at the same height.
    """
    ends = (min(lap, 0) - 1.5, min(1 / slope + slope / 2, max(lap, 0) + 1.5))
    return force_of_wires(
        lambda x: np.where(x < slope, x**2 / 2, slope * x - slope**2 / 2) + sphere(x - lap), ends, cells, overlap=overlap,
        lowest=0.0,
    )  # fmt: skip


def force_of_lens(half_length, overlap=0.0, cells=80):
    """The same of two wires that cross at a small angle, in a lens of this half length over sqrt(r delta)."""
    return force_of_wires(lambda x: (x / half_length) ** 2, (-1.02 * half_length, 1.02 * half_length), cells,
        overlap=overlap)  # fmt: skip


def force_of_crossing(before, cells=120):
    """The same of a wire across an equal one, at this length before its end, over sqrt(r delta)."""
    return force_of_wires(lambda x: x**2 / 2 + sphere(-x - before), (-2.0, 2.0), cells, across=1.0)


def force_of_oblique(degrees, before, behind=np.inf, cells=120):
    """The same of wires that cross at an angle: at a length before the end of one, and perhaps behind that of the other."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))

    def height(x, y):
        one = y**2 / 2 + sphere(x - before)
        return one + (y * c - x * s) ** 2 / 2 + sphere(-behind - x * c - y * s)

    coarse = np.linspace(-3 / s, 3 / s, 1201)
    x, y = np.meshgrid(coarse, coarse, indexing="ij")
    touching = height(x, y) < 1
    ends = [(axis[touching].min(), axis[touching].max()) for axis in (x, y)]
    n, m = cells, max(cells // 3, round(cells * np.ptp(ends[1]) / np.ptp(ends[0])))
    size = (np.ptp(ends[0]) / n, np.ptp(ends[1]) / m)
    x = ends[0][0] + (np.arange(n) + 0.5) * size[0]
    y = ends[1][0] + (np.arange(m) + 0.5) * size[1]
    return contact_force(height(*np.meshgrid(x, y, indexing="ij")), size, 1e-6)


def stiffness_of(force, change=0.02):
    """Stiffness over E* r^(1/2) delta^(1/2) of a force that is told for places and slopes in units of the overlap.

    force: of the overlap, over the one at which the stiffness is asked for.
    """
    more, less = (z**1.5 * force(z) for z in (1 + change, 1 - change))
    return (more - less) / (2 * change)


def stiffness_of_tip(slope):
    """The same of a tip; a contact conducts as it gives way (Barber): over the resistivity of equal wires."""
    return stiffness_of(lambda z: force_of_tip(slope / z**0.5))


def stiffness_of_two_ends(degrees, before):
    """The same of wires that cross this far before the ends of both."""
    return stiffness_of(lambda z: force_of_oblique(degrees, before / z**0.5, before / z**0.5))


def sphere(beyond):
    """What the surface of a round end falls below that of the wire, beyond it."""
    return np.maximum(beyond, 0) ** 2 / 2


def force_of_wires(height, ends, cells, across=2.0, overlap=0.0, lowest=None):
    """Force of heights [delta] along a wire between two places [sqrt(r delta)], and the curvature across it.

    lowest: height that is approached by delta; None: the least one.
    """
    n, m = round(cells * max(1.0, (ends[1] - ends[0]) / 8)), cells // 2
    size = ((ends[1] - ends[0]) / n, 3.2 / m)
    along = height(ends[0] + (np.arange(n) + 0.5) * size[0])
    y = -1.6 + (np.arange(m) + 0.5) * size[1]
    if lowest is None:
        lowest = height(np.linspace(*ends, 100 * n)).min()
    heights = (along - lowest)[:, None] + across * y[None, :] ** 2 / 2
    return contact_force(heights, size, 1e-6, overlap=overlap)


if __name__ == "__main__":
    for slope, bend in ((1.2, 0.0), (0.5, 0.0), (0.3, 0.0), (0.2, 0.0), (0.3, 0.1), (0.2, 0.3)):
        print(slope, bend, *(force_of_end(slope, bend, cells) for cells in (50, 70, 100)))
    print(*(round(force_of_tip(v), 3) for v in (1.0, 0.5, 0.25, 0.15, 0.1, 0.05, 0.03)))
    print(*(round(force_of_tip(v, overlap=0.01), 3) for v in (1.0, 0.5, 0.25, 0.15, 0.1, 0.05, 0.025)))
    print(*(round(force_of_lap(length, overlap=0.01), 3) for length in (2.5, 5.0, 10.0, 20.0)))
    print(*(round(force_of_lap(20.0, bend, overlap=0.01), 3) for bend in (0.01, 0.02, 0.03)))
    for slope in (0.00873, 0.01746):
        print(*(round(force_of_passing(10 * slope, 10 * lap, overlap=0.01), 3) for lap in (1.0, 0.5, 0.25, 0.0, -0.05)))
    for overlap in (0.001, 0.01):
        print(*(round(force_of_lens(a / overlap**0.5, overlap), 3) for a in (0.3, 0.5, 0.7, 1, 1.5, 2, 3)))
    print(*(round(force_of_crossing(before), 3) for before in (0.0, 0.3, 0.6, 1.0)))
    print(*(round(force_of_oblique(degrees, 0.6), 3) for degrees in (60, 45, 30, 22)))
    print(*(round(force_of_oblique(degrees, 0.6, 0.6), 3) for degrees in (60, 45, 30, 22)))
    print(*(round(stiffness_of_tip(v), 3) for v in (1.0, 0.5, 0.25)))
    print(*(round(stiffness_of_two_ends(degrees, 0.6), 3) for degrees in (60, 45, 30, 22)))

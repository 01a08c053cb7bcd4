"""Wires of metal that yields on rigid planes and cylinders: the laws between wires, with a partner that does not give way."""

import numpy as np
import pytest

import litz
from test_restart import KEEP_ALL, assert_goes_on_from_everywhere
from test_rigid_surfaces import along_x, leaning, surface, wire

#: Of the wire, which is half a millimetre thick, and of the kernels
YOUNG, POISSON, RADIUS = 200e9, 0.3, 5e-4
YIELD, HARDNESS = 300e6, 840e6
HERTZ = f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD={YIELD}, HARDNESS={HARDNESS}\n"
RIGID = {"young": (YOUNG, 1e25), "poisson": (POISSON, POISSON)}
#: Up, back, apart, up again on the same curve and beyond, and back [m]
COURSE = [0.5e-6, 2e-6, 1.8e-6, 1.6e-6, 0.3e-6, 1.6e-6, 2e-6, 2.6e-6, 2.4e-6]
LENGTH = 0.016


def to(depth, more="", increments=1):
    """The nodes of the wire, or the surface, go to this depth [m]."""
    return (
        f"*STEP, INC=1000\n*STATIC, DIRECT\n {1 / increments!r}, 1\n*BOUNDARY\n W, 3, 3, {-depth:.17g}\n*ENERGY PRINT\n"
        f"{more}*END STEP\n"
    )


def on_plane(points, *steps, hold=" W, 1, 2\n W, 4, 6\n", law=HERTZ):
    lowest = min(z for _, _, z in points)
    points = [(x, y, z - lowest + RADIUS) for x, y, z in points]
    plane = surface("PLANE", "0, 0, 0, 0, 0, 1", laws=law)
    return wire(points, RADIUS) + plane + f"*BOUNDARY\n{hold}" + "".join(steps)


def on_drum(*steps, shift=0.0, n=4, radius=RADIUS, law=HERTZ):
    """The wire is lowered on a drum across it, and may be drawn along itself."""
    points = [(x + shift, y, radius + RADIUS) for x, y, _ in along_x(LENGTH, n)]
    drum = surface("CYLINDER", f"0, 0, 0, 0, 1, 0, {radius}", laws=law)
    return wire(points, RADIUS) + drum + "*BOUNDARY\n W, 2, 2\n W, 4, 6\n" + "".join(steps)


def strip(force, largest=0.0):
    """The law per length of the wire beside a wire that is as good as a plane."""
    return litz.kernels.line_law(
        force, radius=(RADIUS, 1e9 * RADIUS), **RIGID, resistivity=1e-8, yield_stress=YIELD, largest_force_per_length=largest
    )


def force_of_strip(overlap, largest=0.0):
    """f of the law per length, by bisection [N/m]."""
    low, high = 0.0, 2e5
    if overlap <= strip(1e-6, largest).approach:
        return 0.0
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if strip(middle, largest).approach < overlap else (low, middle)
    return low


def sphere(overlap, largest=0.0):
    """The law of crossed wires of one radius at a right angle, whose spot is round."""
    return litz.kernels.normal_law(
        overlap, radius=(RADIUS, RADIUS), **RIGID, angle=np.pi / 2, yield_stress=YIELD, hardness=HARDNESS, largest_force=largest
    )  # fmt: skip


def ends_of_steps(results, name):
    """Sums over the surfaces at the end of each step."""
    table = results.surface_contacts
    found = []
    for step in range(1, results.history["step"].max() + 1):
        last = results.history["increment"][results.history["step"] == step].max()
        found.append(table[name][(table["step"] == step) & (table["increment"] == last)].sum())
    return np.array(found)


def test_a(run):
    process, results = run(on_plane(along_x(LENGTH, 8), *(to(z) for z in COURSE)))
    assert process.returncode == 0, process.stderr
    f = ends_of_steps(results, "force")
    largest = 0
    for z, force in zip(COURSE, f):
        e = force_of_strip(z, largest)
        largest = max(largest, e)
        print(z, force / LENGTH, e, force / LENGTH / max(e, 1e-30) - 1)
    print(ends_of_steps(results, "dent")/8, strip(largest, largest).dent, results.history["ALLPD"], results.history["ETOTAL"])


def test_b(run):
    for shift in (0, 1e-3):
        process, results = run(on_drum(*(to(z) for z in COURSE), shift=shift), name=f"s{shift}")
        assert process.returncode == 0, process.stderr
        f = ends_of_steps(results, "force")
        largest = 0
        for z, force in zip(COURSE, f):
            e = sphere(z, largest)
            largest = max(largest, e.force)
            print(z, force, e.force, force / max(e.force, 1e-30) - 1)
        print(results.iterations if hasattr(results, "iterations") else "", ends_of_steps(results, "dent"), e)


def test_c(run):
    process, results = run(on_plane(leaning(40), *(to(z) for z in COURSE)))
    assert process.returncode == 0, process.stderr
    f = ends_of_steps(results, "force")
    largest = 0
    for z, force in zip(COURSE, f):
        e = sphere(z, largest)
        largest = max(largest, e.force)
        print(z, force, e.force, force / max(e.force, 1e-30) - 1)
    print(ends_of_steps(results, "dent"), e)

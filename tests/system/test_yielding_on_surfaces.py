"""Wires of metal that yields on rigid planes and cylinders: the laws between wires, with a partner that does not give way."""

import numpy as np
import pytest

import litz
from strips import force_of_strip
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


def to(depth, along=0.0, increments=1, more=""):
    """The nodes of the wire are lowered to this depth, and drawn along its axis by `along` [m]."""
    return (
        f"*STEP, INC=1000\n*STATIC, DIRECT\n {1 / increments!r}, 1\n*BOUNDARY\n W, 1, 1, {along:.17g}\n"
        f" W, 3, 3, {-depth:.17g}\n*ENERGY PRINT\n{more}*END STEP\n"
    )


def on_plane(points, *steps):
    lowest = min(z for _, _, z in points)
    points = [(x, y, z - lowest + RADIUS) for x, y, z in points]
    plane = surface("PLANE", "0, 0, 0, 0, 0, 1", laws=HERTZ)
    return wire(points, RADIUS) + plane + "*BOUNDARY\n W, 2, 2\n W, 4, 6\n" + "".join(steps)


def on_drum(*steps, shift=0.0, n=4, radius=RADIUS):
    """A wire over a drum across it."""
    points = [(x + shift, y, radius + RADIUS) for x, y, _ in along_x(LENGTH, n)]
    drum = surface("CYLINDER", f"0, 0, 0, 0, 1, 0, {radius}", laws=HERTZ)
    return wire(points, RADIUS) + drum + "*BOUNDARY\n W, 2, 2\n W, 4, 6\n" + "".join(steps)


def strip(force, largest=0.0):
    """The law per length of the wire beside a wire that is as good as a plane."""
    return litz.kernels.line_law(
        force,
        radius=(RADIUS, 1e9 * RADIUS),
        **RIGID,
        resistivity=1e-8,
        yield_stress=YIELD,
        largest_force_per_length=largest,
    )


def round_spot(overlap, largest=0.0):
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


def test_a_wire_on_a_plane_follows_the_law_per_length_with_its_memory(run):
    process, results = run(on_plane(along_x(LENGTH, 8), *(to(z) for z in COURSE)))
    assert process.returncode == 0, process.stderr
    largest = 0.0
    for z, force, dents in zip(COURSE, *(ends_of_steps(results, name) for name in ("force", "dent")), strict=True):
        expected = force_of_strip(strip, z, largest, up_to=2e5)
        largest = max(largest, expected)
        # a wire beside a thousand million times thicker one, and the tolerance of the bisection
        assert force / LENGTH == pytest.approx(expected, rel=1e-8)
        if expected > 0:
            assert dents / 8 == pytest.approx(strip(largest, largest).dent, rel=1e-7)


@pytest.mark.parametrize(("n", "shift"), [(4, 0.0), (4, 1e-3), (40, 1.13e-3)])
def test_a_drum_across_a_wire_is_the_contact_of_two_crossed_wires(run, n, shift):
    """At a node, in a long element, in a short one. The places of a lens add up to the crossing on loading, which the section
    of the wire makes a little stiffer; on the way back the lens opens as strips do, and not as a round spot does."""
    process, results = run(on_drum(*(to(z) for z in COURSE), n=n, shift=shift))
    assert process.returncode == 0, process.stderr
    largest = 0.0
    for z, force in zip(COURSE, ends_of_steps(results, "force"), strict=True):
        exact = round_spot(z, largest).force
        loads = exact >= largest
        largest = max(largest, exact)
        assert force == pytest.approx(exact, abs=(7e-3 if loads else 0.06) * largest)


def test_a_wire_that_stands_on_a_plane_has_the_dent_of_a_sphere(run):
    """And what is above its end adds less than 2 %."""
    process, results = run(on_plane(leaning(90), *(to(z) for z in COURSE)))
    assert process.returncode == 0, process.stderr
    largest = 0.0
    for z, force, dent in zip(COURSE, *(ends_of_steps(results, name) for name in ("force", "dent")), strict=True):
        exact = round_spot(z, largest)
        largest = max(largest, exact.force)
        assert force == pytest.approx(exact.force, abs=0.02 * largest)
        if exact.force > 0:
            assert dent == pytest.approx(exact.dent, rel=1e-9)


def test_a_contact_that_has_left_its_dent_along_the_wire_is_one_without_a_dent(run):
    """A drum is pressed on the wire, lifted, and pressed next to the dent; then in the dent again."""
    drum, lens = 20 * RADIUS, 2 * np.sqrt(2 * 2e-6 * 20 * RADIUS)
    away = 4 * lens
    course = [(2e-6, 0), (-1e-5, 0), (-1e-5, away), (1.9e-6, away), (-1e-5, away), (-1e-5, 0), (1.9e-6, 0)]
    _, results = run(on_drum(*(to(*place) for place in course), shift=1e-3, radius=drum))
    _, fresh = run(on_drum(to(1.9e-6), shift=1e-3, radius=drum), name="fresh")
    first, *_, beside, _, _, within = ends_of_steps(results, "force")
    # by the places in which the overlap of either is kept, of some twenty in a lens
    assert beside == pytest.approx(ends_of_steps(fresh, "force")[0], rel=5e-3)
    assert within < 0.9 * beside < first


def dragged(increments):
    return on_drum(
        to(2e-6, increments=4), to(2e-6, 4e-4, increments), to(0, 4e-4, 10), n=16, shift=1e-3, radius=20 * RADIUS
    )


@pytest.mark.slow
def test_a_wire_that_is_dragged_over_a_drum_ploughs_a_groove(run):
    """Only the front of the lens bears then. What the drag takes is dissipated."""
    _, results = run(dragged(80))
    table, history = results.surface_contacts, results.history
    force = [table["force"][(table["step"] == 2) & (table["increment"] == i)].sum() for i in (1, 79, 80)]
    assert 0.5 * force[0] < force[2] < 0.85 * force[0]
    assert force[2] == pytest.approx(force[1], rel=0.01)
    ends = [history["step"] == step for step in (1, 2)]
    work, lost = (history[name][ends[1]][-1] - history[name][ends[0]][-1] for name in ("ALLWK", "ALLPD"))
    held = history["ALLCCE"][ends[1]][-1] - history["ALLCCE"][ends[0]][-1]
    assert work - held == pytest.approx(lost, rel=0.03)


@pytest.mark.parametrize("where", ["plane", "drum", "end"])
def test_the_balance_of_energy_closes_with_what_yielding_dissipates(run, where):
    errors = []
    for n in (10, 20):
        steps = (to(z, increments=n) for z in (2e-6, 0, 2.4e-6))
        deck = {
            "plane": lambda steps: on_plane(along_x(LENGTH, 4), *steps),
            "drum": lambda steps: on_drum(*steps, shift=1e-3),
            "end": lambda steps: on_plane(leaning(90), *steps),
        }[where](steps)
        process, results = run(deck, name=f"{n}")
        assert process.returncode == 0, process.stderr
        history = results.history
        errors.append(np.abs(history["ETOTAL"]).max() / history["ALLPD"][-1])
        table = results.surface_contacts
        last = (table["step"] == 3) & (table["increment"] == table["increment"][-1])
        assert table["yield_dissipation"][last].sum() == pytest.approx(history["ALLPD"][-1], rel=1e-9)
    # by means of forces over increments; the force is no straight line as wires part
    assert errors[0] < 0.05
    assert errors[0] / errors[1] > 2.5


def test_a_wire_between_two_plates_yields_where_they_press_it(run):
    """A wavy wire is pressed, relieved and pressed on: it keeps its dents, the forces of both plates balance."""
    wave, points = 3e-4, [(x, 0, 3e-4 * np.cos(2 * np.pi * x / 0.01)) for x in np.linspace(-0.01, 0.01, 21)]
    top = wave + RADIUS
    plates = surface("PLANE", f"0, 0, {-top}, 0, 0, 1", laws=HERTZ, name="LOWER")
    plates += surface("PLANE", f"0.01, 0, {top}, 0, 0, -1", (99, f"0, 0, {top}"), laws=HERTZ, name="UPPER")
    hold = "*BOUNDARY\n W, 2, 2\n W, 4, 4\n W, 6, 6\n 11, 1\n 99, 1, 2\n 99, 4, 6\n"
    steps = "".join(
        f"*STEP, INC=400\n*STATIC\n 0.25, 1, 1e-5, 0.25\n*BOUNDARY\n 99, 3, 3, {-way}\n*ENERGY PRINT\n*END STEP\n"
        for way in (1e-4, 0.5e-4, 1.2e-4)
    )
    process, results = run(wire(points, RADIUS) + plates + hold + steps)
    assert process.returncode == 0, process.stderr
    history = results.history
    assert history["ALLPD"][-1] > history["ALLCCE"][-1] > 0
    assert np.abs(history["ETOTAL"]).max() < 0.02 * history["ALLPD"][-1]
    last = results.surface_contacts_at(-1)
    lower, upper = (last["force"][last["surface"] == name].sum() for name in ("LOWER", "UPPER"))
    assert lower == pytest.approx(upper, rel=1e-6)


def test_a_run_with_dents_goes_on_from_everywhere(litz, tmp_path):
    keep = [to(z, along, 2, KEEP_ALL) for z, along in ((2e-6, 0), (-1e-5, 1e-4), (1.8e-6, 2e-4))]
    assert_goes_on_from_everywhere(litz, tmp_path, on_drum(*keep, shift=1e-3))


def test_yield_and_an_elasticity_over_temperature_exclude_each_other(run):
    deck = on_plane(along_x(LENGTH, 4), to(1e-6)).replace(
        f" {YOUNG}, {POISSON}\n", f" {YOUNG}, {POISSON}, 0\n 1e11, 0.3, 100\n"
    )
    process, _ = run(deck)
    assert process.returncode == 1
    assert "an elasticity over temperature" in process.stderr

"""Wires that yield where they touch along lines: the law per length with its dents, from crossings to wires side by side."""

from itertools import pairwise

import numpy as np
import pytest

import litz
from line_wires import COPPER, HERTZ, along, two_wires
from line_wires import LED as GUIDED
from strips import force_of_strip

YIELD, HARDNESS = 60e6, 168e6
BEHAVIOR = f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD={YIELD}, HARDNESS={HARDNESS}\n"
CLEAN = "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, VOLTAGE=LINEAR\n"
LENGTH = 20e-3
OVERLAPS = [1e-7, 6e-7, 1e-6, 9e-7, 7e-7, 9.5e-7, 1.3e-6, 1e-6, 0.4e-6, 1.2e-6]


def to(overlap, *, increments=1, extra=""):
    """The upper wire is lowered by `overlap` [m]."""
    return (
        f"*STEP, INC=1000\n*STATIC, DIRECT\n {1 / increments!r}, 1\n*BOUNDARY\n UPPER, 3, 3, {-overlap:.17g}\n"
        f" LOWER, 9, 9, 1.\n UPPER, 9, 9, 0.\n*ENERGY PRINT\n*NODE PRINT, NSET=UPPER, TOTALS=ONLY\n RF\n"
        f"{extra}*END STEP\n"
    )


def wires(*steps, degrees=0.0, elements=(8, 8), law=BEHAVIOR + CLEAN, interaction=""):
    lower, upper = (
        along(LENGTH, n, start=-LENGTH / 2, degrees=a, height=h)
        for n, a, h in zip(elements, (0.0, degrees), (0.0, 2 * COPPER.radius), strict=True)
    )
    return two_wires(lower, upper, GUIDED, *steps, law=law, interaction=interaction)


def law(force, largest=0.0):
    return litz.kernels.line_law(
        force, radius=COPPER.radius, young=COPPER.young, poisson=COPPER.poisson, resistivity=COPPER.resistivity,
        yield_stress=YIELD, largest_force_per_length=largest,
    )  # fmt: skip


def middle_of(results, step):
    """Places within the wires at the end of a step, away from the ends."""
    contacts = results.contacts
    last = contacts["increment"][contacts["step"] == step].max(initial=0)
    here = (contacts["step"] == step) & (contacts["increment"] == last) & (contacts["length"] > 0)
    here &= np.abs(contacts["point_1_x"]) < LENGTH / 4
    return {name: contacts[name][here] for name in ("force", "length", "resistance", "dent")}


@pytest.mark.parametrize("elements", [(8, 8), (8, 11)])
def test_parallel_wires_follow_the_law_per_length_with_its_memory(run, elements):
    process, results = run(wires(*(to(z) for z in OVERLAPS), elements=elements))
    assert process.returncode == 0, process.stderr
    largest = 0.0
    for step, z in enumerate(OVERLAPS, 1):
        found = middle_of(results, step)
        expected = force_of_strip(law, z, largest, up_to=3e4)
        if not expected > 0:
            assert len(found["force"]) == 0
            continue
        assert found["force"] / found["length"] == pytest.approx(expected, rel=1e-7)
        exact = law(expected, largest)
        assert 1 / (found["resistance"] * found["length"]) == pytest.approx(exact.conductance, rel=1e-7)
        largest = max(largest, expected)
        assert found["dent"] == pytest.approx(law(expected, largest).dent, rel=1e-7)


@pytest.mark.slow
def test_the_balance_of_energy_closes_with_what_yielding_dissipates(run):
    errors = []
    for n in (20, 40):
        _, results = run(wires(to(1.2e-6, increments=n), to(0, increments=n), to(1.2e-6, increments=n)))
        history = results.history
        errors.append(np.abs(history["ETOTAL"]).max() / history["ALLPD"][-1])
    assert errors[0] < 0.02
    assert errors[0] / errors[1] > 2.5


def total(results, step):
    """Force [N] and conductance [S] of all contacts at the end of a step."""
    contacts = results.contacts
    last = contacts["increment"][contacts["step"] == step].max(initial=0)
    here = (contacts["step"] == step) & (contacts["increment"] == last)
    return contacts["force"][here].sum(), (1 / contacts["resistance"][here]).sum()


#: Up, back, apart, up again on the same curve and beyond, and back
COURSE = [0.3e-6, 1e-6, 0.9e-6, 0.8e-6, 0.3e-6, 0.8e-6, 1e-6, 1.3e-6, 1.2e-6]


def crossing(overlap, degrees, largest=0.0):
    return litz.kernels.normal_law(
        overlap, radius=COPPER.radius, young=COPPER.young, poisson=COPPER.poisson, angle=np.radians(degrees),
        yield_stress=YIELD, hardness=HARDNESS, largest_force=largest,
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("degrees", "part", "force_within", "conductance_within"), [(8, 0.27, 0.02, 0.02), (5, 0.1, 0.03, 0.02)]
)
def test_places_along_a_short_lens_have_the_force_and_conductance_of_the_crossing(
    run, degrees, part, force_within, conductance_within
):
    """With elements as short as this the lens is one of many places, up, on the way back, and up again."""
    course = part * np.array(COURSE)
    process, results = run(wires(*(to(z) for z in course), degrees=degrees, elements=(200, 200)))
    assert process.returncode == 0, process.stderr
    assert (results.contacts["length"] > 0).sum() > 20
    largest = 0.0
    for step, z in enumerate(course, 1):
        force, conductance = total(results, step)
        exact = crossing(z, degrees, largest)
        largest = max(largest, exact.force)
        assert force == pytest.approx(exact.force, abs=force_within * largest)
        if exact.force > 0:
            expected = 4 * exact.disc_radius / (2 * COPPER.resistivity)
            assert conductance == pytest.approx(expected, rel=conductance_within)


@pytest.mark.parametrize("degrees", [17, 25])
@pytest.mark.parametrize("spot", [CLEAN, "*GAP ELECTRICAL CONDUCTANCE, LAW=FILM\n 1e-12\n"])
def test_a_lens_that_never_yields_conducts_as_an_elastic_one(run, spot, degrees):
    """Half lengths of 0.27 to 1.2 radii, where a lens is round spot and strip at once, and places along it come in."""
    overlaps = np.array([5, 10, 15, 20, 25, 30]) * 1e-6
    elastic, strong = (
        run(wires(*(to(z) for z in overlaps), degrees=degrees, law=behavior + spot), name=name)[1]
        for name, behavior in (("elastic", HERTZ), ("strong", HERTZ.replace("\n", ", YIELD=1e13\n")))
    )
    for step in range(1, len(overlaps) + 1):
        assert total(strong, step) == pytest.approx(total(elastic, step), rel=2e-3)
    half_lengths = elastic.contacts["semi_major"][elastic.contacts["length"] == 0] / COPPER.radius
    assert half_lengths.min() < 0.5
    assert half_lengths.max() > 0.75


@pytest.mark.parametrize("degrees", [3, 9, 17])
def test_a_lens_that_never_yields_is_an_elastic_one(run, degrees):
    """In force, conductance and energy, while places take over from the crossing and the section comes to count. The energy was
    that of the present far field: up to 4 % more."""
    overlaps = np.linspace(2e-6, 16e-6, 8)
    elastic, strong = (
        run(wires(*(to(z) for z in overlaps), degrees=degrees, law=behavior + CLEAN), name=name)[1]
        for name, behavior in (("elastic", HERTZ), ("strong", HERTZ.replace("\n", ", YIELD=1e13\n")))
    )
    for step in range(2, len(overlaps) + 1):
        assert total(strong, step) == pytest.approx(total(elastic, step), rel=1e-3)
        held = [results.history["ALLCCE"][results.history["step"] == step][-1] for results in (strong, elastic)]
        assert held[0] == pytest.approx(held[1], rel=1e-3)
    assert (strong.history["ALLPD"] == 0).all()


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [12, 5, 3, 2, 1])
def test_force_and_conductance_hardly_depend_on_the_mesh(run, degrees):
    found = []
    for n in (8, 40):
        process, results = run(wires(*(to(z) for z in COURSE), degrees=degrees, elements=(n, n)), name=f"{n}")
        assert process.returncode == 0, process.stderr
        found.append(np.array([total(results, step) for step in range(1, len(COURSE) + 1)]))
    coarse, fine = found
    np.testing.assert_allclose(coarse[:, 0], fine[:, 0], atol=0.025 * fine[:, 0].max())
    # lenses of a half to one radius, which are strip and round spot at once, conduct less on the way back if a crossing has them
    error = 0.04 if degrees in (3, 5) else 0.025
    np.testing.assert_allclose(coarse[:, 1], fine[:, 1], atol=error * fine[:, 1].max())
    # it comes again on the way on which it went
    np.testing.assert_allclose(fine[5], fine[3], rtol=5e-3)
    np.testing.assert_allclose(fine[6], fine[1], rtol=5e-3)


@pytest.mark.slow
def test_force_and_conductance_change_steadily_with_the_angle(run):
    """Up and on the way back, from wires that cross to wires side by side."""
    rows = []
    angles = [8, 7, 6, 5, 4.2, 3.5, 3, 2.5, 2.1, 1.8, 1.5, 1.25, 1]
    for degrees in angles:
        process, results = run(wires(to(1e-6), to(0.85e-6), degrees=degrees, elements=(16, 16)), name=f"{degrees}")
        assert process.returncode == 0, process.stderr
        rows.append([*total(results, 1), *total(results, 2)])
    # of straight wires the lens is as long as this
    scaled = np.array(rows) * np.sin(np.radians(angles))[:, None]
    for before, after in pairwise(scaled):
        assert after / before == pytest.approx([1, 1, 1, 1], abs=0.13)


def test_a_film_lies_on_the_strips(run):
    film = 1e-11
    process, results = run(
        wires(to(1e-6), to(0.9e-6), law=BEHAVIOR + f"*GAP ELECTRICAL CONDUCTANCE, LAW=FILM\n {film}\n")
    )
    assert process.returncode == 0, process.stderr
    largest = 0.0
    for step, z in enumerate((1e-6, 0.9e-6), 1):
        found, force = middle_of(results, step), force_of_strip(law, z, largest, up_to=3e4)
        exact = law(force, largest)
        expected = 1 / (1 / exact.conductance + film / (2 * exact.half_width))
        assert 1 / (found["resistance"] * found["length"]) == pytest.approx(expected, rel=1e-6)
        largest = max(force, largest)


@pytest.mark.parametrize("between", [0.7e-6, -1.5e-2])
@pytest.mark.parametrize("degrees", [0.0, 3.0])
def test_a_restart_goes_on_with_the_dents(run, tmp_path, degrees, between):
    """Bit for bit, also of wires that have been far apart."""
    steps = [to(z, increments=2, extra="*RESTART, WRITE\n") for z in (1e-6, between, 0.8e-6)]
    deck = wires(*steps, degrees=degrees)
    process, whole = run(deck, name="whole")
    assert process.returncode == 0, process.stderr
    process, going_on = run(deck, "--restart", f"{tmp_path / 'whole' / 'whole.restart.h5'}:2:2", name="second")
    assert process.returncode == 0, process.stderr
    assert going_on.contacts_at(-1).n_rows > 0
    for name in ("force", "resistance", "largest_force", "dent", "yield_dissipation"):
        assert going_on.contacts_at(-1)[name].tolist() == whole.contacts_at(-1)[name].tolist()
    assert going_on.history["ALLPD"][-1] == whole.history["ALLPD"][-1]


@pytest.mark.parametrize(
    ("spot", "words"),
    [
        ("*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, SPOT=LARGEST FORCE\n", "SPOT=LARGEST FORCE"),
        (
            "*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n 1e-6\n",
            "LAW=CONSTANT of *GAP ELECTRICAL CONDUCTANCE",
        ),
        ("*GAP ELECTRICAL CONDUCTANCE, LAW=SHARVIN\n 4e-8\n", "LAW=SHARVIN of *GAP ELECTRICAL CONDUCTANCE"),
    ],
)
def test_spots_that_do_not_follow_strips_end_the_run_in_words(run, spot, words):
    process, _ = run(wires(to(1e-6), law=BEHAVIOR + spot))
    assert process.returncode != 0
    assert words in process.stderr


@pytest.mark.slow
@pytest.mark.parametrize(("bend", "angle"), [(10, 8), (15, 20), (15, 30)])
def test_a_wire_that_is_dragged_over_a_bend_keeps_its_contact(run, bend, angle):
    """The bend lies in the plane of contact: at the same height the force falls steadily as the wire comes onto the other leg,
    alike in increments of 0.04 and of 0.02 radii."""
    radius = COPPER.radius
    legs = [np.radians(side * bend / 2) for side in (1, -1)]
    out = np.arange(0, 14, 2) * radius
    left, right = (np.column_stack([out * np.cos(a), -out * np.sin(abs(a)), 0 * out]) for a in legs)
    lower = np.concatenate([(left * [-1, 1, 1])[::-1], right[1:]])
    upper = along(16 * radius, 32, start=-8 * radius, degrees=angle, height=2 * radius) - [radius, 0, 0]
    guided = "*BOUNDARY\n LOWER, ENCASTRE\n LOWER, 9\n UPPER, 9\n UPPER, 2, 2\n UPPER, 4, 6\n"
    forces = []
    for increments in (25, 50):
        steps = [
            f"*STEP, INC=1000\n*STATIC, DIRECT\n {1 / n!r}, 1\n*BOUNDARY\n UPPER, 3, 3, {-0.02 * radius}\n"
            f" UPPER, 1, 1, {x * radius}\n*NODE PRINT, NSET=UPPER, TOTALS=ONLY\n RF\n*END STEP\n"
            for n, x in ((4, 0), (increments, 1))
        ]
        law = f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD={300e6}, HARDNESS={950e6}\n"
        process, results = run(two_wires(lower, upper, guided, *steps, law=law), name=f"drag{increments}")
        assert process.returncode == 0, process.stderr
        forces.append(-results.history["RF3 sum UPPER"][4:])
    coarse, fine = forces
    assert np.all(np.diff(fine) / fine[:-1] > -0.035)
    assert np.all(np.diff(fine) / fine[:-1] < 0.025)
    np.testing.assert_allclose(coarse, fine[::2], rtol=0.03)

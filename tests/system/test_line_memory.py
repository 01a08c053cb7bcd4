"""Spots along lines that remember their largest force per length (SPOT=LARGEST FORCE), place by place."""

import numpy as np
import pytest
from verification.references.parallel_wires import ParallelWires

from line_wires import (
    COPPER,
    HERTZ,
    LED,
    along,
    conductances_of_places,
    crossing_at_a_small_angle,
    linear,
    lowered,
    spot,
    step,
    two_wires,
)
from litz import Results
from litz.kernels import line_law
from same_results import KEEP_ALL, assert_same_end

VOLT = "*BOUNDARY\n LOWER, 9, 9, 1.\n UPPER, 9, 9, 0.\n*ELECTRODE PRINT\n LOWER, UPPER\n"
OVERLAP, PENALTY = 2e-7, 5e10
MEMORY = ", SPOT=LARGEST FORCE"


def to(overlap, along_x=0.0):
    """A step that brings the upper wire to an overlap [m] and a place along the lower one [m]."""
    return step(boundary=f" UPPER, 3, 3, {-overlap:.17g}\n UPPER, 1, 1, {along_x:.17g}\n")


def led(*steps, law=HERTZ, of_spot="HERTZ, VOLTAGE=LINEAR" + MEMORY):
    """Parallel wires, the lower one longer, all of whose nodes are led."""
    wires = along(24e-3, 8, start=-12e-3), along(20e-3, 8, start=-10e-3, height=2e-3)
    return two_wires(*wires, LED, *steps, law=law + spot(of_spot))


def conductances(outcome):
    """Of the whole contact at the end of each step [S]."""
    process, results = outcome
    assert process.returncode == 0, process.stderr
    steps = results.history["step"]
    last = [np.flatnonzero(steps == number)[-1] for number in range(1, int(steps[-1]) + 1)]
    return 1 / results.history["resistance LOWER to UPPER"][last]


@pytest.mark.parametrize("law", [HERTZ, linear("", PENALTY)], ids=["Hertz", "penalty"])
@pytest.mark.parametrize(
    "of_spot",
    ["HERTZ", "FILM{}\n 1e-12", "PLASTIC{}\n 1e9", "TABLE, PER=LENGTH{}\n 1., 1e-5\n 1e5, 1e-7"],
    ids=["Hertz", "film", "plastic", "table"],
)
def test_a_strip_keeps_the_conductance_of_its_largest_force_until_it_opens(run, law, of_spot):
    def run_with(memory):
        words = memory + ", VOLTAGE=LINEAR"
        steps = [
            lowered(OVERLAP, VOLT),
            to(OVERLAP / 4),
            to(2 * OVERLAP),
            to(OVERLAP / 4),
            to(-OVERLAP),
            to(OVERLAP / 4),
        ]
        deck = led(*steps, law=law, of_spot=of_spot.format(words) if "{}" in of_spot else of_spot + words)
        return conductances(run(deck, name="memory" if memory else "plain"))

    plain, kept = run_with(""), run_with(MEMORY)
    assert plain[1] < 0.99 * plain[0]
    largest = [plain[0], plain[0], plain[2], plain[2]]
    assert kept[:4] == pytest.approx(largest, rel=1e-8)
    assert kept[5] == pytest.approx(plain[5], rel=1e-8)
    assert plain[5] == pytest.approx(plain[1], rel=1e-8)


def test_the_conductance_kept_is_that_of_a_strip_of_the_largest_force(run):
    process, results = run(led(lowered(OVERLAP, VOLT), to(OVERLAP / 4)))
    assert process.returncode == 0, process.stderr
    contacts = results.contacts_at(-1)
    exact = ParallelWires(COPPER, COPPER)
    # the round ends of the upper wire, on its last places, have more
    between = np.abs(contacts["point_2_x"]) < 9.9e-3
    length = contacts["length"][between]
    assert len(length) == len(contacts["length"]) - 2
    assert contacts["force"][between] / length == pytest.approx(exact.force(OVERLAP / 4), rel=1e-8)
    assert 1 / (contacts["resistance"][between] * length) == pytest.approx(
        exact.conductance(exact.force(OVERLAP)), rel=1e-8
    )


def test_without_friction_a_strip_stays_until_it_has_slid_by_more_than_its_half_width(run):
    half_width = ParallelWires(COPPER, COPPER).half_width(ParallelWires(COPPER, COPPER).force(OVERLAP))
    ways = [share * half_width for share in (0.5, -0.9, 1.5, 2.0)]
    kept = conductances(run(led(lowered(OVERLAP, VOLT), to(OVERLAP / 4), *(to(OVERLAP / 4, way) for way in ways))))
    plain = conductances(
        run(led(lowered(OVERLAP, VOLT), to(OVERLAP / 4), of_spot="HERTZ, VOLTAGE=LINEAR"), name="plain")
    )
    assert kept[:4] == pytest.approx([plain[0]] * 4, rel=1e-8)
    assert kept[4:] == pytest.approx([plain[1]] * 2, rel=1e-8)


def test_with_friction_a_strip_stays_until_it_slips(run):
    """The stick is Mindlin's: along the wires a slip of mu f over it, less than the half width, is the limit."""
    ways = [1e-9, 1e-6, 0.999e-6]
    law = HERTZ + "*FRICTION\n 0.3\n"
    steps = [lowered(OVERLAP, VOLT), to(OVERLAP / 4), *(to(OVERLAP / 4, way) for way in ways)]
    process, results = run(led(*steps, law=law))
    kept = conductances((process, results))
    plain = conductances(run(led(*steps[:2], law=law, of_spot="HERTZ, VOLTAGE=LINEAR"), name="plain"))
    status = [set(results.contacts["friction"][results.contacts["step"] == i]) for i in (3, 4, 5)]
    assert status == [{"stick"}, {"slip"}, {"stick"}]
    assert kept[:3] == pytest.approx([plain[0]] * 3, rel=1e-8)
    # it sticks again, and has forgotten the larger force
    # what the places at the ends stand for follows the wire one step behind, by 1 um of 20 mm
    assert kept[3:] == pytest.approx([plain[1]] * 2, rel=1e-5)


def crossing(n, of_spot="HERTZ, VOLTAGE=LINEAR" + MEMORY, extra="", back=None):
    """Wires at 5 degrees are pressed until their short contact is a line, and lifted again, in so many increments each."""
    wires = along(60e-3, 24, start=-30e-3), along(60e-3, 24, start=-30e-3, degrees=5, height=2e-3)
    static, lifting = (f"{1 / each:.17g}, 1., 1e-4, {1 / each:.17g}" for each in (n, back or n))
    return two_wires(
        *wires, LED, lowered(1e-5, VOLT + extra, static=static), step(static=lifting, boundary=" UPPER, 3, 3, -2e-7\n"),
        law=HERTZ + spot(of_spot),
    )  # fmt: skip


def test_the_memory_goes_over_from_the_line_to_the_crossing(run):
    """As the contact retreats it conducts less and less, and always more than one that remembers nothing."""
    n = 20
    process, results = run(crossing(n))
    assert process.returncode == 0, process.stderr
    is_crossing = results.contacts["length"] == 0
    ends = [results.contacts["force"][is_crossing & (results.contacts["step"] == 2)
            & (results.contacts["increment"] == i)].sum() for i in (1, n)]  # fmt: skip
    assert ends[0] == 0
    assert ends[1] > 0
    kept = 1 / results.history["resistance LOWER to UPPER"]
    process, results = run(crossing(n, "HERTZ, VOLTAGE=LINEAR"), name="plain")
    plain = 1 / results.history["resistance LOWER to UPPER"]
    loading, unloading = slice(1, n + 1), slice(n + 1, None)
    assert kept[loading] == pytest.approx(plain[loading], rel=1e-8)
    # what is left at the end is a point, which keeps its spot: it was made while the line had a share, on which it depends
    assert (np.diff(kept[unloading]) < 0.02 * kept[unloading][:-1]).all()
    assert (kept[unloading] > plain[unloading] * (1 - 1e-8)).all()
    assert kept[-1] > 1.5 * plain[-1]


def test_the_crossing_remembers_in_however_few_increments_the_contact_retreats(run):
    few, many = (conductances(run(crossing(20, back=back), name=f"back{back}"))[-1] for back in (1, 20))
    # the force that it has carried is greatest between two increments
    assert few == pytest.approx(many, rel=0.02)


def test_a_run_that_goes_on_remembers_the_spots(litz, tmp_path):
    (tmp_path / "deck.inp").write_text(crossing(10, extra=KEEP_ALL))
    done = litz("run", "deck.inp", "-o", "whole", "--threads", 1, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    for step_number, increment in ((1, 6), (2, 3), (2, 8)):
        part = f"part_{step_number}_{increment}"
        place = f"whole/deck.restart.h5:{step_number}:{increment}"
        done = litz("run", "deck.inp", "-o", part, "--threads", 1, "--restart", place, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        assert_same_end(Results(tmp_path / "whole"), Results(tmp_path / part), step_number, increment)


def test_at_a_new_largest_force_a_spot_has_nothing_to_remember(run):
    """Where places and a crossing share a contact, too, and hand it to each other as the force falls and rises."""
    overlaps = [2e-6, 1e-6, 3e-6, 0.2e-6, 4e-6]
    with_memory, without = (
        conductances_of_places(
            run(crossing_at_a_small_angle(overlaps, MEMORY * memory), name=f"memory{memory}")[1], len(overlaps)
        )
        for memory in (True, False)
    )
    np.testing.assert_allclose(with_memory[[0, 2, 4]], without[[0, 2, 4]], rtol=1e-12)
    assert (with_memory[[1, 3]] > 1.2 * without[[1, 3]]).all()


@pytest.mark.slow
@pytest.mark.parametrize("sine", [0.12, 0.06, 0.03])
@pytest.mark.parametrize(
    "law", [("HERTZ", ""), ("FILM", " 1e-12"), ("PLASTIC", " 1e9")], ids=["Hertz", "film", "plastic"]
)
def test_spots_where_a_crossing_becomes_a_line_are_the_same_on_every_mesh(run, law, sine):
    """Under loads that rise and fall, with lenses of up to 4 radii: elements of 2.2, 0.5 and 0.12 radii, of which the
    crossing carries most, some or nothing."""
    overlaps = [2e-6, 1e-6, 3e-6, 2e-7, 4e-6, 2e-6, 1e-6, 5e-7, 1e-7, 2e-8]

    def conductances_with(elements):
        deck = crossing_at_a_small_angle(overlaps, MEMORY, law=law[0], data=law[1], n=elements, sine=sine)
        return conductances_of_places(run(deck, name=f"elements{elements}")[1], len(overlaps))

    coarse, medium, fine = (conductances_with(elements) for elements in (9, 40, 160))
    # the spot of a film is that of crossed wires at a crossing and the strip along the lens in places: 1.5 % at most
    error = 1.5e-2 if law[0] == "FILM" else 3e-3
    assert coarse == pytest.approx(fine, rel=error)
    assert medium == pytest.approx(fine, rel=error)


@pytest.mark.parametrize("elements", [9, 40, 160])
def test_a_short_lens_keeps_all_of_its_spot(run, elements):
    """Half a length of 0.24 radii: Hertz's spot of the largest force, in whatever the wires still touch."""
    deck = crossing_at_a_small_angle([2e-7, 1e-7, 2e-8, 2e-9], MEMORY, n=elements, sine=0.12)
    kept = conductances_of_places(run(deck)[1], 4)
    assert kept == pytest.approx(kept[0], rel=1e-3)


@pytest.mark.parametrize("elements", [9, 160])
def test_of_a_long_lens_the_strip_stays_where_the_wires_touch(run, elements):
    """Half a length of 4.2 radii at the largest force: the law per length, of the largest overlap at each place."""
    overlaps, sine = [4e-6, 2e-6, 5e-7, 2e-8], 0.03
    kept = conductances_of_places(
        run(crossing_at_a_small_angle(overlaps, MEMORY, n=elements, sine=sine))[1], len(overlaps)
    )
    forces = np.geomspace(1e-3, 3e5, 2000)
    wires = dict(radius=[1e-3] * 2, young=[120e9] * 2, poisson=[0.34] * 2, resistivity=[1 / 5.88e7] * 2)
    law = line_law(forces, angle=np.arcsin(sine), **wires)
    for overlap, found in zip(overlaps, kept, strict=True):
        touching = np.sqrt(4e-3 * overlap) / sine
        arc = np.linspace(0, 1, 1001)[:-1] * touching
        largest = overlaps[0] - (sine * arc) ** 2 / 4e-3
        assert found == pytest.approx(
            2 * np.trapezoid(np.interp(largest, law.approach, law.conductance), arc), rel=1e-2
        )


def test_shares_in_the_results_are_those_that_the_forces_have(run):
    """What a place carries per length is the law of its gap: f grows with the overlap, the same at both wires."""
    contacts = run(crossing_at_a_small_angle([2e-6, 1e-6]))[1].contacts
    of_line = (contacts["length"] > 0) & (contacts["force"] > 0) & (contacts["gap"] < -1e-7)
    per_length = contacts["force"][of_line] / contacts["length"][of_line]
    order = np.argsort(contacts["gap"][of_line])
    assert of_line.sum() > 10
    # the force per length of Hertz goes nearly with the overlap: no more than a logarithm lies between
    ratio = per_length[order] / -contacts["gap"][of_line][order]
    assert ratio.max() < 1.5 * ratio.min()

"""Crossed wires whose spots yield: the force, the spot, the dent that stays, and the energy that does not come back."""

import re
from itertools import pairwise

import numpy as np
import pytest

import litz
from decks import CONDUCTOR, crossed, straight, wire
from litz.results.contact_pressures import pressure_lines

RADIUS, YOUNG, POISSON, YIELD, HARDNESS = 1e-3, 120e9, 0.34, 200e6, 800e6
#: rho1 + rho2 [ohm m]
RESISTIVITY = 2 / 50e6
BEHAVIOR = f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD={YIELD}, HARDNESS={HARDNESS}"


def held(
    *steps, degrees=90.0, behavior=BEHAVIOR, spot="*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ", friction="", density=10
):
    """A fixed wire along x, and one across it that `steps` move, all of it alike: overlaps are given."""
    a = np.radians(degrees)
    along = 0.02 * np.array([np.cos(a), np.sin(a), 0.0])
    up = np.array([0, 0, 2 * RADIUS])
    lower = wire("LOWER", straight((-0.02, 0, 0), (0.02, 0, 0), density), 1, element="B33")
    upper = wire("UPPER", straight(up - along, up + along, density), 101, element="B33", backwards=(4, 7))
    return f"""*HEADING
held
{lower}{upper}{CONDUCTOR}*BEAM SECTION, ELSET=LOWER, MATERIAL=COPPER, SECTION=CIRC
 {RADIUS}
*BEAM SECTION, ELSET=UPPER, MATERIAL=COPPER, SECTION=CIRC
 {RADIUS}
*SURFACE INTERACTION, NAME=TOUCH
{behavior}
{friction}
{spot}
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*BOUNDARY
 LOWER, ENCASTRE
 UPPER, 1, 6
 1, 9
 101, 9
{"".join(steps)}"""


def to(z, x=0.0, y=0.0, *, increments=10):
    """A step that moves the upper wire to `x`, `y`, and down by `z`."""
    return f"""*STEP, INC=1000
*STATIC, DIRECT
 {1 / increments!r}, 1
*BOUNDARY
 UPPER, 1, 1, {x:.17g}
 UPPER, 2, 2, {y:.17g}
 UPPER, 3, 3, {-z:.17g}
*NODE PRINT, NSET=UPPER, TOTALS=ONLY
 RF
*ENERGY PRINT
*END STEP
"""


def law(overlap, largest_force=0.0, degrees=90.0):
    return litz.kernels.normal_law(
        overlap, radius=RADIUS, young=YOUNG, poisson=POISSON, angle=np.radians(degrees), yield_stress=YIELD,
        hardness=HARDNESS, largest_force=largest_force,
    )  # fmt: skip


def contacts(results):
    """The only contact of each increment, or none."""
    found = [results.contacts_at(i) for i in range(len(results.times))]
    return [{name: values[0] for name, values in each.items()} if each.n_rows else None for each in found]


OVERLAPS = [2e-6 * part for part in (0.001, 0.1, 0.5, 1.0, 0.95, 0.8, 0.62, 0.3, 0.7, 1.0, 1.4, 1.1)]


@pytest.mark.parametrize("degrees", [90, 45, 32])
def test_force_and_spot_follow_the_law_with_its_memory(run, degrees):
    """Loaded, unloaded until the dent is open, loaded again and beyond: the force, the spot and the resistance of each
    overlap are those of the law with the largest force before it."""
    process, results = run(held(*(to(z, increments=1) for z in OVERLAPS), degrees=degrees))
    assert process.returncode == 0, process.stderr
    largest = 0.0
    for z, contact in zip(OVERLAPS, contacts(results)[1:], strict=True):
        expected = law(z, largest, degrees)
        if not expected.force > 0:
            assert contact is None
            continue
        assert contact["force"] == pytest.approx(expected.force, rel=1e-9)
        assert contact["semi_major"] == pytest.approx(expected.semi_major, rel=1e-9)
        assert contact["semi_minor"] == pytest.approx(expected.semi_minor, rel=1e-9)
        assert contact["resistance"] == pytest.approx(RESISTIVITY / (4 * expected.disc_radius), rel=1e-9)
        largest = max(largest, expected.force)
        assert contact["largest_force"] == pytest.approx(largest, rel=1e-12)
        assert contact["dent"] == pytest.approx(law(z, largest, degrees).dent, rel=1e-9)
        assert contact["yield_dissipation"] == pytest.approx(law(z, largest, degrees).dissipation, rel=1e-9, abs=1e-18)


def test_what_yielding_dissipates_closes_the_balance_of_energy(run):
    """Work of the supports = elastic energy + ALLPD; the path is followed by trapezoids, so that the error falls with
    the square of the increments."""
    errors = []
    for increments in (20, 40):
        _, results = run(
            held(to(2e-6, increments=increments), to(0, increments=increments), to(2e-6, increments=increments))
        )
        history = results.history
        assert history["ALLPD"][-1] == pytest.approx(law(2e-6).dissipation, rel=1e-9)
        errors.append(np.abs(history["ETOTAL"]).max() / history["ALLPD"][-1])
    assert errors[0] < 0.02
    assert errors[0] / errors[1] > 2.5


def test_below_the_onset_wires_are_those_of_hertz(run):
    """The largest pressure is below that of the onset: nothing is dissipated, no dent stays."""
    elastic, yielding = (
        run(held(to(2e-8), to(1e-8), behavior=behavior), name=name)[1]
        for name, behavior in (("elastic", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"), ("yielding", BEHAVIOR))
    )
    for one, other in zip(contacts(elastic)[1:], contacts(yielding)[1:], strict=True):
        for name in ("force", "resistance", "semi_major", "pressure"):
            assert other[name] == pytest.approx(one[name], rel=1e-9)
        assert other["dent"] == 0
    assert yielding.history["ALLPD"][-1] == 0
    np.testing.assert_allclose(yielding.history["ALLCCE"], elastic.history["ALLCCE"], rtol=1e-9)


def test_the_pressure_rises_to_the_hardness(run):
    """In the middle of the spot: Hertz's at the onset, the even one of the hardness in the end."""
    _, results = run(held(to(4e-5, increments=1)))
    assert contacts(results)[-1]["pressure"] == pytest.approx(HARDNESS, rel=0.05)


def test_a_kept_spot_has_the_resistance_of_the_largest_force(run):
    """SPOT=LARGEST FORCE: metal that has welded as it was pressed, while the contact is closed."""
    spot = "*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, SPOT=LARGEST FORCE"
    _, results = run(held(to(2e-6, increments=1), to(1.5e-6, increments=1), spot=spot))
    pressed, back = contacts(results)[1:]
    assert back["force"] < 0.7 * pressed["force"]
    assert back["resistance"] == pytest.approx(pressed["resistance"], rel=1e-12)


def test_a_film_lies_in_series_on_the_area_of_the_spot(run):
    film = 1e-12
    spot = f"*GAP ELECTRICAL CONDUCTANCE, LAW=FILM\n {film}"
    _, results = run(held(to(2e-6, increments=1), to(1.5e-6, increments=1), spot=spot))
    largest = law(2e-6).force
    for z, contact in zip((2e-6, 1.5e-6), contacts(results)[1:], strict=True):
        found = law(z, largest)
        area = np.pi * found.semi_major * found.semi_minor
        assert contact["resistance"] == pytest.approx(RESISTIVITY / (4 * found.disc_radius) + film / area, rel=1e-9)


@pytest.mark.parametrize("lift", [5e-5, 1.5e-2])
def test_a_contact_that_opens_keeps_its_dent(run, lift):
    """Lifted and lowered again, it touches where it left off: near, and beyond the reach of the search."""
    _, results = run(held(to(2e-6, increments=1), to(-lift, increments=2), to(1.5e-6, increments=2)))
    pressed, _, lifted, _, back = contacts(results)[1:]
    assert lifted is None
    assert back["force"] == pytest.approx(law(1.5e-6, pressed["force"]).force, rel=1e-9)


def test_a_wire_that_slides_leaves_its_dent(run):
    """By half the width of the spot it feels the overlap of two circles, by more than the spot nothing: there it makes
    a dent of its own."""
    along = law(2e-6).semi_major
    overlap = 2 / np.pi * (np.arccos(0.25) - 0.25 * np.sqrt(1 - 0.25**2))
    _, results = run(held(to(2e-6, increments=1), to(1.2e-6, 0.5 * along, increments=1), to(1.2e-6, 3 * along, increments=1),
                          to(1.2e-6, 3.001 * along, increments=1)))  # fmt: skip
    pressed, half, _, off = contacts(results)[1:]
    assert half["largest_force"] == pytest.approx(overlap * pressed["force"], rel=1e-6)
    assert off["force"] == pytest.approx(law(1.2e-6).force, rel=1e-9)


def ploughing_force(overlap, degrees=90.0):
    """(2/pi) F D'(F)/a of a round spot: what a contact that slides makes anew of its dent, over the length in which it does."""
    step = 1e-5 * overlap
    below, here, above = (law(z, degrees=degrees) for z in (overlap - step, overlap, overlap + step))
    growth = (above.dissipation - below.dissipation) / (above.force - below.force)
    return 2 / np.pi * here.force * growth / np.sqrt(here.semi_major * here.semi_minor)


@pytest.mark.parametrize("increments", [2, 16])
def test_a_contact_that_slides_ploughs(run, increments):
    """At the same overlap: a force along the wire that makes the dent anew, and whose work is dissipated, in long increments
    as in short ones. The stick before is as stiff as that of friction."""
    far = 4 * law(2e-6).semi_major
    process, results = run(held(to(2e-6, increments=1), to(2e-6, far, increments=increments)))
    assert process.returncode == 0, process.stderr
    force = ploughing_force(2e-6)
    # of a sphere in the groove that it has ploughed, with its front half or with all of its spot: 4a/(3 pi R), 2a/(3 pi R)
    relative = law(2e-6).semi_major / (np.pi * RADIUS)
    assert 0.6 * relative < force / law(2e-6).force < 1.4 * relative
    history = results.history
    np.testing.assert_allclose(history["RF1 sum UPPER"][2:], force, rtol=1e-6)
    modulus = YOUNG / (2 * (1 - POISSON**2))
    stick = 2 * (1 - POISSON) / (2 - POISSON) * 2 * modulus * law(2e-6).disc_radius
    made = history["ALLPD"][-1] - law(2e-6).dissipation
    assert made == pytest.approx(force * (far - force / stick), rel=1e-6)
    assert contacts(results)[-1]["yield_dissipation"] == pytest.approx(history["ALLPD"][-1], rel=1e-12)
    # sliding changes nothing in the balance
    assert history["ETOTAL"][-1] - history["ETOTAL"][1] == pytest.approx(0, abs=1e-6 * made)
    assert history["ALLFD"][-1] == pytest.approx(0, abs=1e-9 * made)


def test_ploughing_adds_to_friction(run):
    far = 4 * law(2e-6).semi_major
    _, results = run(held(to(2e-6, increments=1), to(2e-6, far, increments=4), friction="*FRICTION\n 0.1"))
    pressed, ploughed = law(2e-6).force, ploughing_force(2e-6)
    assert results.history["RF1 sum UPPER"][-1] == pytest.approx(0.1 * pressed + ploughed, rel=1e-6)
    made = results.history["ALLPD"][-1] - law(2e-6).dissipation
    assert made / results.history["ALLFD"][-1] == pytest.approx(ploughed / (0.1 * pressed), rel=1e-6)


@pytest.mark.slow
def test_what_climbing_out_of_a_dent_takes_is_in_the_balance(run):
    """Let go half way, then slid up the side of the dent until it is left: work = elastic energy + ALLPD, to first order in
    the increments; the force rises to that of metal that has not yielded before."""
    far = 2.5 * law(2e-6).semi_major
    errors = []
    for increments in (20, 40):
        _, results = run(
            held(to(2e-6, increments=40), to(1.6e-6, increments=40), to(1.6e-6, far, increments=increments))
        )
        history = results.history
        assert contacts(results)[-1]["force"] == pytest.approx(law(1.6e-6).force, rel=1e-3)
        errors.append(np.abs(history["ETOTAL"] - history["ETOTAL"][80])[81:].max() / history["ALLPD"][-1])
    assert errors[1] < 0.025
    assert errors[0] / errors[1] > 1.7


#: Overlaps of wires at 60 degrees whose lens is shorter, and longer, than 0.3 radii on either side, where sections begin to count
SHORT, LONG = 1.65e-5, 2e-5


@pytest.mark.parametrize("overlap", [SHORT, LONG, 3e-5])
def test_a_long_lens_ploughs_as_a_short_one(run, overlap):
    far = 3 * law(overlap, degrees=60).semi_major
    _, results = run(
        held(to(overlap, increments=3), to(overlap, far, increments=6), degrees=60, friction="*FRICTION\n 0.1")
    )
    rubbed = 0.1 * contacts(results)[-1]["force"]
    assert results.history["RF1 sum UPPER"][-1] - rubbed == pytest.approx(ploughing_force(overlap, 60), rel=0.02)
    assert results.history["ETOTAL"][-1] == pytest.approx(
        results.history["ETOTAL"][3], abs=1e-6 * results.history["ALLPD"][-1]
    )


@pytest.mark.parametrize("overlap", [SHORT, LONG])
def test_a_long_lens_climbs_out_of_its_dent_by_work(run, overlap):
    """Relieved, and slid until its force is that of metal that has not yielded before: what it then holds has been done by
    the force along the wires, of which a part is dissipated."""
    far = 2.5 * law(overlap, degrees=60).semi_major
    _, results = run(held(to(overlap), to(0.9 * overlap), to(0.9 * overlap, far, increments=40), degrees=60))
    history = results.history
    off = law(0.9 * overlap, degrees=60)
    assert contacts(results)[-1]["force"] == pytest.approx(off.force, rel=0.01)
    held_then, held_now = history["ALLCCE"][[20, -1]]
    done, dissipated = history["ALLWK"][-1] - history["ALLWK"][20], history["ALLPD"][-1] - history["ALLPD"][20]
    assert held_now > 2 * held_then
    assert done == pytest.approx(held_now - held_then + dissipated, rel=0.02)
    # the dent is made anew on the way
    assert dissipated > 0.5 * off.dissipation


@pytest.mark.parametrize("part", [1.0, 0.95, 0.9])
def test_the_spot_of_a_long_lens_is_that_of_its_mechanics(run, part):
    _, results = run(held(to(LONG, increments=1), to(part * LONG, increments=1), degrees=60))
    pressed, found = contacts(results)[1:]
    expected = law(part * LONG, law(LONG, degrees=60).force, degrees=60)
    for name in ("semi_major", "semi_minor"):
        assert found[name] == pytest.approx(getattr(expected, name), rel=0.005)
    assert found["largest_semi_major"] == pytest.approx(pressed["semi_major"], rel=0.005)


def carried(degrees, *steps):
    """The same, with the upper wire carried by a reference node over the contact."""
    deck = held(*steps, degrees=degrees)
    assert deck.count(" UPPER, 1, 6\n") == 1
    return deck.replace(" UPPER, 1, 6\n", "").replace(
        "*BOUNDARY\n",
        f"*NODE, NSET=HOLDER\n 9999, 0, 0, {2 * RADIUS}\n*RIGID BODY, TIE NSET=UPPER, REF NODE=9999\n*BOUNDARY\n", 1
    )  # fmt: skip


def turn(z, degrees=0.0, *, increments=10):
    """A step that moves the holder down by `z` and turns it about the normal by `degrees` in all."""
    return f"""*STEP, INC=1000
*STATIC, DIRECT
 {1 / increments!r}, 1
*BOUNDARY
 9999, 1, 2
 9999, 3, 3, {-z:.17g}
 9999, 4, 5
 9999, 6, 6, {np.radians(degrees):.17g}
*NODE PRINT, NSET=HOLDER
 RF
*ENERGY PRINT
*END STEP
"""


@pytest.mark.parametrize("increments", [2, 20])
@pytest.mark.parametrize(("first", "last"), [(45, 80), (20, 60), (80, 45)])
def test_wires_that_are_turned_have_not_been_pressed_deeper(run, first, last, increments):
    """At the overlap at which they have yielded: at any angle the force is that of wires which are pressed so deep there,
    whether the spot gets shorter or longer."""
    process, results = run(carried(first, turn(2e-6), turn(2e-6, last - first, increments=increments)))
    assert process.returncode == 0, process.stderr
    contact = contacts(results)[-1]
    assert contact["angle"] == pytest.approx(np.radians(last), rel=1e-9)
    assert contact["force"] == pytest.approx(law(2e-6, degrees=last).force, rel=1e-9)
    assert contact["dent"] == pytest.approx(law(2e-6, degrees=last).dent, rel=1e-9)


def test_wires_that_turn_back_feel_their_dent_as_before(run):
    """Let go by a tenth, turned to where the spot is shorter, and back: the force is again that of the largest force."""
    process, results = run(
        carried(45, turn(2e-6), turn(1.8e-6), turn(1.8e-6, 35, increments=5), turn(1.8e-6, 0, increments=5))
    )
    assert process.returncode == 0, process.stderr
    found = contacts(results)
    largest = law(2e-6, degrees=45).force
    there = law(1.8e-6, law(2e-6, degrees=80).force, degrees=80)
    assert found[25]["force"] == pytest.approx(there.force, rel=1e-9)
    assert found[25]["resistance"] == pytest.approx(RESISTIVITY / (4 * there.disc_radius), rel=1e-9)
    assert found[-1]["force"] == pytest.approx(law(1.8e-6, largest, degrees=45).force, rel=1e-9)
    assert found[-1]["largest_force"] == pytest.approx(largest, rel=1e-9)


@pytest.mark.slow
def test_wires_that_are_pressed_on_while_they_turn_keep_their_dent(run):
    """At 25 degrees to 2 um; to 80 degrees, where the spot is shorter, and to 2.04 um on the way; let go and turned back. The
    force at 80 degrees is the largest one there, but not the largest of all."""
    process, results = run(
        carried(25, turn(2e-6), turn(2.04e-6, 55, increments=20), turn(1.98e-6, 55), turn(1.98e-6, 0, increments=20))
    )
    assert process.returncode == 0, process.stderr
    largest = law(2e-6, degrees=25).force
    assert law(2.04e-6, degrees=80).force < largest
    last = contacts(results)[-1]
    assert last["largest_force"] == pytest.approx(largest, rel=1e-9)
    assert last["force"] == pytest.approx(law(1.98e-6, largest, degrees=25).force, rel=1e-9)


@pytest.mark.parametrize("lift", [False, True])
def test_a_larger_force_at_less_overlap_does_not_fill_a_dent(run, lift):
    """Pressed to 2 um and let go to 1.6 um, at right angles; at 30 degrees, where the spot is longer, the same overlap takes
    more force than ever before. Back at right angles the dent is that of 2 um, also where the wires part in between."""
    between = [turn(-1e-5)] if lift else []
    after = [turn(-1e-5, -60)] if lift else []
    back = [turn(-1e-5, 0)] if lift else []
    process, results = run(
        carried(
            90,
            turn(2e-6),
            turn(1.6e-6),
            *between,
            *after,
            turn(1.6e-6, -60, increments=5),
            *after,
            *back,
            turn(1.6e-6, 0),
        )
    )
    assert process.returncode == 0, process.stderr
    largest = law(2e-6).force
    assert law(1.6e-6, degrees=30).force > largest
    last = contacts(results)[-1]
    assert last["force"] == pytest.approx(law(1.6e-6, largest).force, rel=1e-9)
    assert last["dent"] == pytest.approx(law(1.6e-6, largest).dent, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("back", [2e-6, 1.7e-6])
def test_turning_in_a_dent_is_in_the_balance_of_energy(run, back):
    """Turned to where the spot is shorter, and back: work = elastic energy + ALLPD to first order in the increments, and in the
    end ALLPD is what it was."""
    errors = []
    for increments in (10, 20):
        process, results = run(
            carried(45, turn(2e-6), turn(back), turn(back, 35, increments=increments),
                    turn(back, 0, increments=increments))
        )  # fmt: skip
        assert process.returncode == 0, process.stderr
        total, made = results.history["ETOTAL"], results.history["ALLPD"]
        errors.append(np.abs(total - total[20])[21:].max() / made[20])
    assert errors[1] < 0.01
    assert errors[0] / errors[1] > 1.7
    assert made[-1] == pytest.approx(made[20], rel=0.01)


def test_leaving_a_dent_in_one_increment_is_warned_of(run):
    """Where the contact lies in its dent; one that makes it anew as it slides may take long increments."""
    along = law(2e-6).semi_major
    for z, warned in ((1.6e-6, True), (2e-6, False)):
        _, results = run(held(to(2e-6, increments=1), to(z, increments=1), to(z, along, increments=1)))
        assert ("left_dent" in [warning.kind for warning in results.warnings]) == warned


@pytest.mark.parametrize(("increments", "warned"), [(1, True), (4, False)])
def test_work_that_is_in_no_energy_is_warned_of(run, increments, warned):
    """The work of an increment is that of the mean force, which a single one of a force that grows with the power 1.3 of the
    overlap makes 15 % too large: a quarter of what is dissipated."""
    process, results = run(held(to(4e-6, increments=increments)))
    assert process.returncode == 0, process.stderr
    told = [warning for warning in results.warnings if warning.kind == "energy_balance"]
    assert len(told) == warned
    if warned:
        history = results.history
        part = 100 * abs(history["ETOTAL"][-1]) / history["ALLPD"][-1]
        assert float(re.search(r"in no energy, (\S+) %", told[0].message)[1]) == pytest.approx(part, rel=1e-4)
        assert told[0].message in process.stderr


def test_elastic_wires_in_one_increment_are_not_warned_of(run):
    """Nothing there depends on the path."""
    _, results = run(held(to(4e-6, increments=1), behavior="*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"))
    assert [warning.kind for warning in results.warnings] == []


@pytest.mark.parametrize(
    ("overlap", "wide", "refused"), [(4e-5, False, False), (6e-5, True, False), (2e-4, True, True)]
)
def test_spots_that_are_wide_for_their_wires_are_warned_of_and_refused(run, overlap, wide, refused):
    """A circle of the area of the spot of 0.3 and of 0.5 radii."""
    process, results = run(held(to(overlap, increments=1), behavior=BEHAVIOR + ", PENETRATION=UNLIMITED"))
    assert (process.returncode != 0) == refused
    if refused:
        assert "the metal is compacted" in process.stderr + process.stdout
        return
    assert (law(overlap).semi_major > 0.3 * RADIUS) == wide
    assert ("wide_spot" in [warning.kind for warning in results.warnings]) == wide


def test_an_elasticity_over_temperature_is_refused(run):
    deck = held(to(2e-6, increments=1))
    assert deck.count("*ELASTIC\n") == 1
    line = deck.split("*ELASTIC\n")[1].split("\n")[0]
    process, _ = run(deck.replace(line, f"{line}, 293.\n {line}, 400.", 1))
    assert process.returncode == 1
    assert "an elasticity over temperature, which YIELD of surface interaction TOUCH does not follow" in process.stderr


def two_steps(back, **changes):
    """The ends of the upper wire are pushed, then taken back to `back`."""
    deck = crossed(behavior=BEHAVIOR, static="0.1, 1, 1e-3, 0.1", extra="*ENERGY PRINT", **changes)
    return (
        f"{deck}*STEP\n*STATIC\n 0.05, 1, 1e-5, 0.05\n*BOUNDARY\n UPPER_ENDS, 3, 3, {back}\n*ENERGY PRINT\n*END STEP\n"
    )


def test_wires_that_bend_show_a_loop_of_resistance_over_force(run):
    """Pressed through their ends and let go: at the same force the spot is larger on the way back, and opens at no
    force, with the resistances of the law."""
    process, results = run(two_steps(0.0))
    assert process.returncode == 0, process.stderr
    rows = [each for each in contacts(results) if each is not None]
    steps = results.history["step"]
    assert steps[-1] == 2
    force = np.array([each["force"] for each in rows])
    resistance = np.array([each["resistance"] for each in rows])
    top = force.argmax()
    for before, each in pairwise(rows):
        # as the wires bend they slide, and leave up to some 1e-5 of the dent behind in an increment
        expected = law(-each["gap"], before["largest_force"], np.degrees(each["angle"]))
        assert each["force"] == pytest.approx(expected.force, rel=1e-9)
        assert each["resistance"] == pytest.approx(2 / 58.823529411764706e6 / (4 * expected.disc_radius), rel=1e-9)
    half = force[top] / 2
    going = np.interp(half, force[: top + 1], resistance[: top + 1])
    back = np.interp(-half, -force[top:], resistance[top:])
    assert back < 0.9 * going


def test_friction_sticks_with_the_stiffness_of_the_elastic_metal_around_the_spot(run):
    """Mindlin's ratio times `2 E* a_e`, not times the plastic slope of the loading."""
    pressed, moved = 2e-6, 1e-9
    process, results = run(
        held(to(pressed, increments=4), to(pressed, moved, increments=1), friction="*FRICTION\n 0.5")
    )
    assert process.returncode == 0, process.stderr
    modulus = YOUNG / (2 * (1 - POISSON**2))
    expected = 2 * (1 - POISSON) / (2 - POISSON) * 2 * modulus * law(pressed).disc_radius
    change = results.history["RF1 sum UPPER"][-1] - results.history["RF1 sum UPPER"][-2]
    assert change / moved == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("between", [1.5e-6, -1.5e-2])
def test_a_restart_goes_on_with_the_dent(run, tmp_path, between):
    """The second half of a run that is stopped and goes on is that of the whole run, bit for bit."""
    steps = [to(2e-6, increments=2), to(between, increments=2), to(1.5e-6, increments=2)]
    deck = held(*(step.replace("*NODE PRINT", "*RESTART, WRITE\n*NODE PRINT") for step in steps))
    process, whole = run(deck, name="whole")
    assert process.returncode == 0, process.stderr
    process, going_on = run(deck, "--restart", f"{tmp_path / 'whole' / 'whole.restart.h5'}:2:2", name="second")
    assert process.returncode == 0, process.stderr
    for name in ("force", "resistance", "largest_force", "dent", "yield_dissipation"):
        assert going_on.contacts_at(-1)[name].tolist() == whole.contacts_at(-1)[name].tolist()
    assert going_on.history["ALLPD"][-1] == whole.history["ALLPD"][-1]


@pytest.mark.parametrize(
    ("behavior", "message"),
    [
        (BEHAVIOR.replace("HERTZ", "LINEAR") + "\n 1e6", "YIELD is for PRESSURE-OVERCLOSURE=HERTZ"),
        (BEHAVIOR.replace(f"YIELD={YIELD}, ", ""), "HARDNESS is for wires that yield: give YIELD, too"),
        (BEHAVIOR.replace(f"HARDNESS={HARDNESS}", "HARDNESS=3e8"), "is not above the pressure at which the metal"),
    ],
)
def test_data_that_do_not_belong_together_are_refused(run, behavior, message):
    process, results = run(held(to(1e-6), behavior=behavior))
    assert process.returncode == 1
    assert message in process.stderr
    assert results is None


@pytest.mark.parametrize("spot", ["LAW=PLASTIC\n 1e9", "LAW=PAPER"])
def test_a_spot_of_other_mechanics_is_refused(run, spot):
    process, _ = run(held(to(1e-6), spot=f"*GAP ELECTRICAL CONDUCTANCE, {spot}"))
    assert process.returncode == 1
    assert "follow the force of wires that yield" in process.stderr


@pytest.mark.parametrize("law", ["CMY", "ELASTIC ROUGH", "HERZ"])
def test_a_law_that_decks_do_not_have_is_one_error(run, law):
    process, _ = run(held(to(1e-6), spot=f"*GAP ELECTRICAL CONDUCTANCE, LAW={law}, SUPERTEMPERATURE=YES"))
    assert process.returncode == 1
    assert process.stderr.count("error:") == 1, process.stderr
    assert law in process.stderr


def test_a_displacement_that_passes_zero_is_not_lost_in_round_off(run):
    """At the middle of the second step it is 2e-22 m, and the wires are apart; at its end they have come to rest."""
    process, results = run(held(to(2e-6), to(-2e-6), to(0.0, increments=3)))
    assert process.returncode == 0, process.stderr
    assert [entry.kind for entry in results.warnings] == []


def test_a_contact_closes_again_in_its_dent_without_cut_backs(run, inputs):
    """Pressed, released, pressed again, little by little: where its force ends in the dent, the line of the loading on which
    it closes first leaves the dent to no force."""
    deck = (inputs / "01_crossed_wires.inp").read_text()
    process, results = run(deck.replace("=HERTZ\n", "=HERTZ, YIELD=50e6, HARDNESS=450e6\n", 1))
    assert process.returncode == 0, process.stderr
    assert max(results.status["attempts"]) == 1
    assert max(results.status["iterations"]) <= 5


def test_the_summary_says_whose_pressure_is_the_largest(run):
    _, elastic = run(held(to(2e-6, increments=1), behavior="*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"))
    assert "if the wires stay elastic" in pressure_lines(elastic)[0]
    _, yielding = run(held(to(2e-6, increments=1)))
    assert pressure_lines(yielding)[0].endswith("of wires that yield")


def test_few_iterations_are_taken_on_loading_and_unloading(run):
    """Newton's method: the loading of wires that yield takes about as many iterations as that of elastic ones."""
    counts = []
    for behavior in ("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ", BEHAVIOR):
        process, results = run(two_steps(-5e-5).replace(BEHAVIOR, behavior))
        assert process.returncode == 0, process.stderr
        counts.append(sum(results.status["iterations"]))
    assert counts[1] <= counts[0] + 10

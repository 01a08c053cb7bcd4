"""Contact of wires side by side in runs: against closed forms, and what must hold whatever the wires do."""

import math
import re

import numpy as np
import pytest
from verification.line_decks import pulled_strand
from verification.references.helical_rods import Rod, Strand
from verification.references.line_joints import LineJoint
from verification.references.parallel_wires import ParallelWires
from verification.references.touching_beams import Cantilevers

from decks import wire
from line_wires import (
    COPPER,
    HERTZ,
    LED,
    LOWER,
    STEEL,
    UPPER,
    along,
    linear,
    lowered,
    pressed,
    spot,
    step,
    two_wires,
)  # fmt: skip
from litz import Results
from same_results import KEEP_ALL, assert_same_end, assert_same_numbers, written

#: Between the wires is a volt, and no resistance but that of their contact
VOLT = "*BOUNDARY\n LOWER, 9, 9, 1.\n UPPER, 9, 9, 0.\n*ELECTRODE PRINT\n LOWER, UPPER\n"
NO_FIELD = "*BOUNDARY\n LOWER, 9, 9, 0.\n UPPER, 9, 9, 0.\n"
OVERLAP, LENGTH = 2e-7, 20e-3


def solved(outcome):
    """Results of a run that went well, without a warning."""
    process, results = outcome
    assert process.returncode == 0, process.stderr
    assert results.warnings == []
    return results


def forces_on_the_upper_wire(contacts):
    """Total force on the upper wire, whichever of the two is the barred one [N]."""
    # the normal points from the unbarred to the barred wire
    sign = np.where(contacts["element_1"] >= UPPER, 1.0, -1.0)
    return np.array([np.sum(sign * contacts["force"] * contacts[f"normal_{axis}"]) for axis in "xyz"])


def nodal(results, name):
    """A field of all nodes at the end."""
    return results.field(name, len(results.times) - 1)


def place_of(deck, start):
    """`file:line` of the first line of a deck that begins so."""
    return f"deck.inp:{next(i for i, text in enumerate(deck.splitlines(), start=1) if text.startswith(start))}"


class TestParallelWires:
    """Johnson's approach of two cylinders, and the potential of a disc with a strip on its rim."""

    @pytest.mark.parametrize("elements", [(8, 8), (8, 11)], ids=["nodes match", "nodes do not match"])
    @pytest.mark.parametrize("wires", [(COPPER, COPPER), (COPPER, STEEL)], ids=["equal", "unequal"])
    @pytest.mark.parametrize("film", [0.0, 1e-12], ids=["clean", "film"])
    def test_force_and_conductance_per_length(self, run, elements, wires, film):
        law = spot(f"FILM, VOLTAGE=LINEAR\n {film}" if film else "HERTZ, VOLTAGE=LINEAR")
        results = solved(run(pressed(OVERLAP, elements=elements, wires=wires, cards=(VOLT,), law=HERTZ + law)))
        exact = ParallelWires(*wires, film)
        contacts = results.contacts_at(-1)
        per_length = exact.force(OVERLAP)
        # the same at each point: the weights of the quadrature add up to the length; the overlap is known to 1e-16/2e-7
        assert contacts["force"] / contacts["length"] == pytest.approx(per_length, rel=1e-8)
        assert forces_on_the_upper_wire(contacts) == pytest.approx([0, 0, per_length * LENGTH], rel=1e-8, abs=1e-8)
        resistance = results.history["resistance LOWER to UPPER"][-1]
        assert 1 / (resistance * LENGTH) == pytest.approx(exact.conductance(per_length), rel=1e-8)

    @pytest.mark.parametrize("elements", [(8, 8), (8, 11), (9, 13), (14, 15), (20, 7)])
    def test_wires_that_end_together_touch_over_their_length(self, run, elements):
        """Whose ends lie side by side is a matter of round-off: nothing is lost or counted twice there."""
        contacts = solved(run(pressed(OVERLAP, elements=elements, cards=(NO_FIELD,)))).contacts_at(-1)
        assert contacts["length"].sum() == pytest.approx(LENGTH, rel=1e-9)
        assert contacts["force"].sum() == pytest.approx(LENGTH * ParallelWires(COPPER, COPPER).force(OVERLAP), rel=1e-7)

    @pytest.mark.parametrize("stiffnesses", [("", 5e10), (1e6, 5e10)], ids=["eps_l", "eps_N and eps_l"])
    def test_a_penalty_per_length(self, run, stiffnesses):
        results = solved(run(pressed(OVERLAP, law=linear(*stiffnesses) + spot("HERTZ, VOLTAGE=LINEAR"), cards=(VOLT,))))
        per_length = 5e10 * OVERLAP
        assert results.contacts_at(-1)["force"].sum() == pytest.approx(per_length * LENGTH, rel=1e-8)
        # the strip is that of the force
        resistance = results.history["resistance LOWER to UPPER"][-1]
        assert 1 / (resistance * LENGTH) == pytest.approx(
            ParallelWires(COPPER, COPPER).conductance(per_length), rel=1e-8
        )

    def test_wires_that_yield_conduct_through_the_strip_of_their_hardness(self, run):
        hardness = 1e9
        law = HERTZ + spot(f"PLASTIC, VOLTAGE=LINEAR\n {hardness}")
        results = solved(run(pressed(OVERLAP, law=law, cards=(VOLT,))))
        b = ParallelWires(COPPER, COPPER).force(OVERLAP) / (2 * hardness)
        per_length = math.pi / (2 * COPPER.resistivity * (math.log(2 * COPPER.radius / b) + 1 / 8))
        assert 1 / (results.history["resistance LOWER to UPPER"][-1] * LENGTH) == pytest.approx(per_length, rel=1e-8)

    def test_the_ledger_has_the_length_of_each_point_and_their_sum_is_that_of_the_contact(self, run):
        contacts = solved(run(pressed(OVERLAP, elements=(8, 11), cards=(NO_FIELD,)))).contacts_at(-1)
        assert contacts["length"].min() > 0
        assert contacts["length"].sum() == pytest.approx(LENGTH, rel=1e-12)

    @pytest.mark.parametrize(
        ("lower", "upper"),
        [((20e-3, 8), (20e-3, 11)), ((24e-3, 8), (18e-3, 6))],
        ids=["ends together", "ends at nodes"],
    )
    @pytest.mark.parametrize("overlap", [1e-7, 1e-6, 2e-6, 1e-5])
    def test_a_lap_between_exact_ends_has_its_length(self, run, lower, upper, overlap):
        """Round-off must not decide which of two places next to an end stands for what is left there."""
        wires = [
            along(length, n, start=-length / 2, height=height)
            for (length, n), height in ((lower, 0.0), (upper, 2e-3 - overlap))
        ]
        held = "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, ENCASTRE\n"
        results = solved(run(two_wires(*wires, held, step(NO_FIELD), pair=", INTERFERENCE FIT")))
        assert results.contacts_at(-1)["length"].sum() == pytest.approx(upper[0], rel=1e-9)

    def test_no_length_belongs_to_a_crossing(self, run):
        contacts = solved(run(pressed(OVERLAP, degrees=60, cards=(NO_FIELD,)))).contacts_at(-1)
        assert contacts["length"].tolist() == [0.0]


class TestLongElements:
    """Over two radii the pressure decays: nodes that do not match and are further apart than three make it uneven."""

    def test_the_longest_one_is_named_once(self, run):
        process, results = run(pressed(OVERLAP, elements=(5, 7), cards=(NO_FIELD,), static="0.5, 1."))
        assert process.returncode == 0, process.stderr
        (warning,) = results.warnings
        assert (warning.kind, warning.count) == ("long_elements", 2)
        assert warning.worst == pytest.approx(4, rel=1e-12)
        assert "is a place of a contact along a line, with elements of up to 4 radii" in process.stderr
        named = re.search(r"\(elements (\d+) and (\d+)\)", warning.message)
        assert sorted(int(number) > UPPER - 1 for number in named.groups()) == [False, True]

    @pytest.mark.parametrize("elements", [(5, 5), (8, 7)], ids=["nodes match", "short"])
    def test_no_others_are(self, run, elements):
        solved(run(pressed(OVERLAP, elements=elements, cards=(NO_FIELD,))))


def bent_pair(lower_first=True, backwards=((), ()), **model):
    """Two wires at 3 degrees, the upper one bent towards the other: a crossing, and points along a line beside it."""
    s = np.linspace(-1, 1, 9)
    lower = along(30e-3, 10, start=-15e-3)
    upper = np.column_stack([12e-3 * s, 0.6e-3 * s, 2e-3 + 5e-4 * s**2])
    chains = [
        wire(name, points, first, element="B33", backwards=against)
        for name, points, first, against in (
            ("LOWER", lower, LOWER, backwards[0]),
            ("UPPER", upper, UPPER, backwards[1]),
        )
    ]
    sets = "LOWER, UPPER" if lower_first else "UPPER, LOWER"
    return two_wires(
        *chains, LED, lowered(5e-6, VOLT), law=HERTZ + spot("HERTZ, VOLTAGE=LINEAR"), pairs=(sets,), **model
    )


class TestNothingDependsOnTheOrder:
    """Of the wires in the contact pair, and of the nodes in an element."""

    @pytest.mark.parametrize(
        "changed",
        [
            dict(lower_first=False),
            dict(backwards=(range(10), ())),
            dict(backwards=((2, 3, 4), (0, 5))),
            dict(lower_first=False, backwards=((4, 6), range(8))),
        ],
        ids=["wires", "one wire", "some elements", "all"],
    )
    def test_the_forces_and_currents_are_the_same(self, run, changed):
        ours, theirs = solved(run(bent_pair(), name="ours")), solved(run(bent_pair(**changed), name="theirs"))
        assert {0.0} < set(ours.contacts_at(-1)["length"])
        for name in ("reaction_force", "reaction_moment", "reaction_current"):
            a, b = nodal(ours, name), nodal(theirs, name)
            # round-off: 1e-16 of 10 mm over an overlap of 5e-6
            assert np.abs(a - b).max() < 1e-9 * np.abs(a).max()

    def test_the_two_wires_push_each_other_alike(self, run):
        results = solved(run(bent_pair()))
        x, force, moment = (nodal(results, name) for name in ("displacement", "reaction_force", "reaction_moment"))
        x = x + results.field("reference_position", 0)
        lower = np.arange(len(x)) < 11
        size = np.abs(force[lower].sum(axis=0)).max()
        assert size > 1
        assert np.abs(force.sum(axis=0)).max() < 1e-12 * size
        # about any point: the arm is at most the length of the wires
        assert np.abs((np.cross(x, force) + moment).sum(axis=0)).max() < 1e-12 * size * 30e-3
        assert forces_on_the_upper_wire(results.contacts_at(-1)) == pytest.approx(force[lower].sum(axis=0), rel=1e-9)

    def test_wires_that_are_turned_in_space_push_alike(self, run):
        # of two parallel wires, neither knows which way is up
        shifted = [along(LENGTH, 8), along(LENGTH, 8, height=2e-3)]
        up = solved(run(two_wires(*shifted, LED, lowered(OVERLAP, NO_FIELD)), name="up"))
        down = solved(run(two_wires(*shifted[::-1], LED, lowered(-OVERLAP, NO_FIELD)), name="down"))
        assert np.sort(down.contacts_at(-1)["force"]) == pytest.approx(np.sort(up.contacts_at(-1)["force"]), rel=1e-9)


class TestFromCrossingToLine:
    """Wires that are turned from 90 degrees to parallel at a constant overlap, each at several shifts along the upper one."""

    DEGREES = (90, 60, 30, 15, 10, 8, 6, 5, 4, 3, 2, 1.5, 1, 0.7, 0.5, 0.3, 0.2)
    #: Over a node and the middle of an element, in elements
    SHIFTS = (0.0, 0.15, 0.3, 0.4, 0.5, 0.7, 0.85)
    ELEMENTS, SPAN, DEEP, STIFFNESS = 24, 60e-3, 1e-6, 5e10

    def forces(self, run, law):
        """Of each angle and shift, (n, m) [N]: all pairs in one deck, above each other."""
        lower, upper = [], []
        places = [(degrees, shift) for degrees in self.DEGREES for shift in self.SHIFTS]
        for i, (degrees, shift) in enumerate(places):
            moved = shift * self.SPAN / self.ELEMENTS
            for cards, first, place in (
                (lower, 0, dict(height=0.01 * i)),
                (upper, 500, dict(height=0.01 * i + 2e-3, degrees=degrees, shift=moved)),
            ):
                points = along(self.SPAN, self.ELEMENTS, start=-self.SPAN / 2, **place)
                cards.append(wire("UPPER" if first else "LOWER", points, 1000 * (i + 1) + first, element="B33"))
        deck = two_wires("".join(lower), "".join(upper), LED, lowered(self.DEEP, NO_FIELD), law=law)
        contacts = solved(run(deck)).contacts_at(-1)
        forces = np.zeros(len(places))
        np.add.at(forces, contacts["element_1"] // 1000 - 1, contacts["force"])
        return forces.reshape(len(self.DEGREES), len(self.SHIFTS))

    @pytest.mark.parametrize("law", [HERTZ, linear("", STIFFNESS)], ids=["Hertz", "penalty"])
    def test_the_force_is_the_same_over_nodes_and_grows_towards_parallel(self, run, law):
        forces = self.forces(run, law)
        mean = forces.mean(axis=1)
        assert (np.ptp(forces, axis=1) / mean).max() < 0.02
        assert (np.diff(forces.max(axis=1)) > 0).all()
        assert (np.diff(forces.min(axis=1)) > 0).all()
        # short lenses are one point, wherever they are
        assert (np.ptp(forces[:6], axis=1) / mean[:6]).max() < 1e-6

    def test_the_force_of_a_penalty_is_its_integral_over_the_lens(self, run):
        """The overlap of straight wires along one of them is a parabola: F = (4/3) eps_l delta sqrt(2 d delta)/sin psi."""
        forces = self.forces(run, linear("", self.STIFFNESS))
        half = math.sqrt(2 * 2e-3 * self.DEEP) / np.sin(np.radians(self.DEGREES))
        exact = 4 / 3 * self.STIFFNESS * self.DEEP * half
        # also between a point and a line, where each has a share
        assert np.abs(forces / exact[:, None] - 1).max() < 0.02
        # a point alone: the parabola to delta/d
        assert forces[:6] == pytest.approx(np.broadcast_to(exact[:6, None], (6, len(self.SHIFTS))), rel=1e-3)


def cantilevers(load, gap, elements, **model):
    """Two steel wires clamped at x = 0, the upper one longer and `gap` above the lower one, with a force at its tip."""
    lower, upper = (along(length, n, height=height) for length, n, height in zip(
        (0.05, 0.075), elements, (0.0, 2 * STEEL.radius + gap), strict=True))  # fmt: skip
    in_plane = "".join(f" {name}, {dof}\n" for name in ("LOWER", "UPPER") for dof in (2, 4, 6))
    return two_wires(
        lower, upper,
        f"*BOUNDARY\n {LOWER}, ENCASTRE\n {UPPER}, ENCASTRE\n{in_plane}",
        step(NO_FIELD, f"*CLOAD\n {UPPER + elements[1]}, 3, {-load}\n", static="0.25, 1., 1e-4, 0.25"),
        wires=(STEEL, STEEL), **model,
    )  # fmt: skip


class TestCantilevers:
    """The longer one, with a force at its tip, touches the tip of the other and nothing else (leaf springs)."""

    @pytest.mark.parametrize("elements", [(20, 30), (20, 31), (13, 31)], ids=["match", "do not match", "coarse"])
    @pytest.mark.parametrize("gap", [0.0, 2e-5, 2e-4], ids=["just touch", "gap", "wide gap"])
    def test_deflections_are_those_of_a_point_force_at_the_tip(self, run, elements, gap):
        load, ei = 0.2, STEEL.young * math.pi * STEEL.radius**4 / 4
        results = solved(run(cantilevers(load, gap, elements)))
        beams = Cantilevers(0.075, 0.05, ei, ei, load)
        # the gap is closed first: the tip of the shorter one is pushed by what is left
        force = beams.contact_force - gap / (2 * beams.support**3 / (3 * ei))
        lifted = force * beams.support**2 * (3 * beams.length - beams.support) / (6 * ei)
        down = -nodal(results, "displacement")[:, 2]
        tips = down[elements[0]], down[-1]
        # the Hertzian approach is 1e-4 of the deflections; point forces act within half an element of the tip
        assert tips[0] == pytest.approx(force * beams.support**3 / (3 * ei), rel=5e-3)
        assert tips[1] == pytest.approx(load * beams.length**3 / (3 * ei) - lifted, rel=5e-3)
        contacts = results.contacts_at(-1)
        assert contacts["force"].sum() == pytest.approx(force, rel=5e-3)
        assert contacts["point_1_x"][contacts["force"] > 1e-3 * force].min() > 0.04


STRAND = Strand(Rod(1.97e-3, 188e9, 0.3), Rod(1.865e-3, 188e9, 0.3), 6, 0.115)


def test_a_strand_of_one_and_six_wires_is_pulled(run):
    """Half a lay, at 0.1 % strain; force, moment about the axis and line force of exact helices on a stiff contact."""
    stiffness = 1e10
    state = STRAND.state(1e-3, approach=lambda force: force / stiffness)
    length, elements = STRAND.pitch / 2, 12
    results = solved(run(pulled_strand(STRAND, [state], length, elements, stiffness=stiffness)))
    x = nodal(results, "displacement") + results.field("reference_position", 0)
    force, moment = nodal(results, "reaction_force"), nodal(results, "reaction_moment")
    top = x[:, 2] > 0.999 * length
    assert top.sum() == 7
    # cubic axes of twelve elements in half a turn, with tangents from three nodes: the helix to 3/128 of (0.26 rad)^4
    assert force[top, 2].sum() == pytest.approx(state.force, rel=5e-3)
    total = (np.cross(x[top], force[top]) + moment[top])[:, 2].sum()
    assert total == pytest.approx(state.moment, rel=1e-2)


class TestGivenPerLength:
    """What is given per length holds where wires cross, too: over the length along which they overlap."""

    @pytest.mark.parametrize("degrees", [90.0, 60.0, 30.0])
    def test_a_crossing_conducts_over_the_length_of_its_overlap(self, run, degrees):
        law = HERTZ + spot("CONSTANT, PER=LENGTH, VOLTAGE=LINEAR\n 1e-5")
        results = solved(run(pressed(OVERLAP, degrees=degrees, law=law, cards=(VOLT,))))
        (resistance,) = results.contacts_at(-1)["resistance"]
        length = 2 * math.sqrt(2 * (2 * COPPER.radius) * OVERLAP) / math.sin(math.radians(degrees))
        assert 1 / resistance == pytest.approx(1e5 * length, rel=2e-3)


class TestWhatLinesAreNotFor:
    """Wires that come to lie side by side under a law that is for crossings only: the run ends in words."""

    @pytest.mark.parametrize(
        ("model", "words"),
        [
            (dict(law=linear(1e6)), "LINEAR without a stiffness per length"),
            (
                dict(law=HERTZ + "*FRICTION, STICK STIFFNESS=1e6\n 0.2\n"),
                "STICK STIFFNESS of *FRICTION, which is that of a contact at a point",
            ),
            (dict(interaction=", AXIS=LINEAR"), "AXIS=LINEAR"),
            (
                dict(law=HERTZ + spot("CONSTANT\n 1e-3")),
                "LAW=CONSTANT of *GAP ELECTRICAL CONDUCTANCE, which is that of a spot without PER=LENGTH",
            ),
        ],
        ids=["penalty", "stick stiffness", "straight axes", "constant spot"],
    )
    @pytest.mark.parametrize("degrees", [0.0, 0.3])
    def test_the_run_ends_in_words(self, litz, tmp_path, model, words, degrees):
        deck = pressed(2e-5, degrees=degrees, cards=(NO_FIELD,), static="0.5, 1.", **model)
        (tmp_path / "deck.inp").write_text(deck)
        process = litz("run", "deck.inp", cwd=tmp_path)
        assert process.returncode == 2, process.stderr
        assert "touch side by side, along a line, and overlap by" in process.stderr
        assert f"{words} does not serve contact along a line" in process.stderr
        # no increment is small enough for that
        assert process.stdout.count(" cut: ") == 1
        assert "Smaller increments would not help." in process.stderr

    def test_an_overlap_that_is_too_deep_names_the_stiffness_per_length(self, litz, tmp_path):
        (tmp_path / "deck.inp").write_text(pressed(2e-4, law=linear("", 2e10) + spot("HERTZ"), cards=(NO_FIELD,)))
        process = litz("run", "deck.inp", cwd=tmp_path)
        assert process.returncode == 2, process.stderr
        found = re.search(r"requires a penalty of at least (\S+)", process.stderr)
        assert found, process.stderr
        # that which leaves 5 % at the force of now
        overlap = float(re.search(r"overlap by (\S+) % of the smaller radius, 5 % are allowed", process.stderr)[1])
        assert float(found[1]) == pytest.approx(2e10 * overlap / 5, rel=1e-4)

    @pytest.mark.parametrize(
        ("model", "words"),
        [
            (dict(law=linear("", 1e10) + "*FRICTION, STICK STIFFNESS=1e6\n 0.2\n"), "STICK STIFFNESS of *FRICTION"),
            (dict(law=linear("", 1e10), interaction=", AXIS=LINEAR"), "AXIS=LINEAR"),
            (dict(law=linear("", 1e10) + spot("CONSTANT\n 1e-3")), "LAW=CONSTANT"),
        ],
    )
    def test_a_penalty_per_length_alone_is_refused_with_its_place(self, litz, tmp_path, model, words):
        deck = pressed(1e-6, cards=(NO_FIELD,), **model)
        (tmp_path / "deck.inp").write_text(deck)
        for command in ("check", "run"):
            process = litz(command, "deck.inp", cwd=tmp_path)
            assert process.returncode == 1
            assert place_of(deck, "*CONTACT PAIR") in process.stderr
            assert f"has a stiffness per length alone, which is not possible with {words}" in process.stderr

    @pytest.mark.parametrize("data", [",", ", ,"])
    def test_a_penalty_needs_a_number(self, litz, tmp_path, data):
        deck = pressed(1e-6, law=linear(data), cards=(NO_FIELD,))
        (tmp_path / "deck.inp").write_text(deck)
        process = litz("check", "deck.inp", cwd=tmp_path)
        assert process.returncode == 1
        assert place_of(deck, f" {data}") in process.stderr
        assert "the line has none of the numbers of LINEAR" in process.stderr

    @pytest.mark.parametrize(("percent", "code"), [(0.9, 0), (1.1, 1)])
    def test_wires_may_overlap_a_little_at_the_start(self, litz, tmp_path, percent, code):
        depth = percent / 100 * COPPER.radius
        deck = two_wires(
            along(LENGTH, 8), along(LENGTH, 8, height=2 * COPPER.radius - depth), LED, lowered(0.0, NO_FIELD)
        )
        (tmp_path / "deck.inp").write_text(deck)
        process = litz("check", "deck.inp", cwd=tmp_path)
        assert process.returncode == code, process.stderr
        if code:
            assert place_of(deck, " LOWER, UPPER") in process.stderr
            assert "overlap at the start by" in process.stderr
            assert "1.1 % of the smaller radius" in process.stderr


class TestWrapped:
    """A turn of wire around a straight one: it is curved about the axis of the other, whose places have no clear foot."""

    OVERLAP, STIFFNESS = 1e-6, 1e10

    @pytest.mark.parametrize("coil_first", [False, True])
    def test_the_places_are_those_of_the_coil(self, run, coil_first):
        angle = np.linspace(-np.pi, np.pi, 37)
        pitch = 3e-3
        coil = np.column_stack([2e-3 * np.cos(angle), 2e-3 * np.sin(angle), pitch * angle / (2 * np.pi)])
        core = np.column_stack([np.zeros(9), np.zeros(9), np.linspace(-8e-3, 8e-3, 9)])
        inward = "".join(
            f" {UPPER + i}, 1, 1, {-self.OVERLAP * math.cos(a):.17g}\n {UPPER + i}, 2, 2, {-self.OVERLAP * math.sin(a):.17g}\n"
            for i, a in enumerate(angle)
        )
        sets = "UPPER, LOWER" if coil_first else "LOWER, UPPER"
        deck = two_wires(
            core, coil, "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 3, 6\n", step(NO_FIELD, boundary=inward),
            law=linear("", self.STIFFNESS), pairs=(sets,),
        )  # fmt: skip
        contacts = solved(run(deck)).contacts_at(-1)
        # all points stand for the coil alone, and for the whole of it
        assert (contacts["element_2"] >= UPPER).all()
        length = 2 * math.pi * math.hypot(2e-3, pitch / (2 * math.pi))
        # the chords of 10 degrees: 1 - 10^2/24 in radians
        assert contacts["length"].sum() == pytest.approx(length, rel=2e-3)
        assert contacts["force"].sum() == pytest.approx(self.STIFFNESS * self.OVERLAP * length, rel=0.05)


def sliding(extra="", friction=""):
    """A bent wire on a straight one, pressed and dragged along it over nodes, with a current, in five increments each."""
    s = np.linspace(-1, 1, 8)
    upper = np.column_stack([10e-3 * s, 0.2e-3 * s, 2e-3 + 1e-6 + 1e-4 * s**2])
    ends = f"*NSET, NSET=ENDS\n {UPPER}, {UPPER + 7}\n"
    return two_wires(
        along(40e-3, 14, start=-20e-3), upper,
        ends + f"*BOUNDARY\n {LOWER}, ENCASTRE\n {LOWER + 14}, ENCASTRE\n ENDS, 1, 2\n ENDS, 4, 6\n",
        step(f"*BOUNDARY\n {LOWER}, 9, 9, 1e-3\n {UPPER}, 9, 9, 0.\n{extra}", static="0.2, 1., 1e-4, 0.2",
             boundary=" ENDS, 3, 3, -2e-4\n"),
        step(static="0.2, 1., 1e-4, 0.2", boundary=" ENDS, 1, 1, 3e-3\n"),
        law=HERTZ + friction + spot("HERTZ"),
    )  # fmt: skip


class TestRunsThatGoOn:
    @pytest.mark.parametrize("friction", ["", "*FRICTION\n 0.2\n"], ids=["without friction", "with friction"])
    def test_a_restarted_run_equals_the_uninterrupted_one_bit_for_bit(self, litz, tmp_path, friction):
        (tmp_path / "deck.inp").write_text(sliding(KEEP_ALL, friction))
        done = litz("run", "deck.inp", "-o", "whole", "--threads", 1, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        whole = Results(tmp_path / "whole")
        assert max(whole.contacts["length"]) > 0
        for step_number, increment in written(tmp_path / "whole" / "deck.restart.h5")[2:-1:10]:
            place = f"whole/deck.restart.h5:{step_number}:{increment}"
            part = f"part_{step_number}_{increment}"
            done = litz("run", "deck.inp", "-o", part, "--threads", 1, "--restart", place, cwd=tmp_path)
            assert done.returncode == 0, done.stderr
            assert_same_end(whole, Results(tmp_path / part), step_number, increment)

    def test_the_number_of_threads_changes_nothing(self, run):
        one, two = (solved(run(sliding(), "--threads", str(n), name=f"threads{n}")) for n in (1, 2))
        assert np.array_equal(one.times, two.times)
        for column in one.contacts:
            assert_same_numbers(one.contacts[column], two.contacts[column])


class TestCurrents:
    """A lap joint: current enters the lower wire at x = 0 and leaves the upper one at its other end."""

    ELEMENTS, VOLTS = 80, 1e-3

    def joint(self, run):
        """Results, and the current through the joint [A]."""
        cards = f"*BOUNDARY\n {LOWER}, 9, 9, {self.VOLTS}\n {UPPER + self.ELEMENTS}, 9, 9, 0.\n"
        law = HERTZ + spot("HERTZ, VOLTAGE=LINEAR")
        results = solved(
            run(pressed(OVERLAP, length=LENGTH, elements=(self.ELEMENTS, self.ELEMENTS), cards=(cards,), law=law))
        )
        entering = nodal(results, "reaction_current")
        assert entering[-1] == pytest.approx(-entering[0], rel=1e-10)
        return results, entering[0]

    def test_resistance_and_currents_are_those_of_a_line(self, run):
        results, current = self.joint(run)
        exact = ParallelWires(COPPER, COPPER)
        each = COPPER.resistivity / (math.pi * COPPER.radius**2)
        line = LineJoint(LENGTH, exact.conductance(exact.force(OVERLAP)), each, each)
        # lumped points: of second order in m h
        error = (line.rate * LENGTH / self.ELEMENTS) ** 2
        assert self.VOLTS / current == pytest.approx(line.lap(), rel=error)
        middles = (np.arange(self.ELEMENTS) + 0.5) * LENGTH / self.ELEMENTS
        currents = results.field("element_current", len(results.times) - 1)[: self.ELEMENTS]
        assert currents / current == pytest.approx(line.lap_current(middles), abs=error)

    def test_what_leaves_one_wire_enters_the_other(self, run):
        results, current = self.joint(run)
        contacts = results.contacts_at(-1)
        sign = np.where(contacts["element_1"] < UPPER, 1.0, -1.0)
        assert np.sum(sign * contacts["current"]) == pytest.approx(current, rel=1e-10)
        # the power of the source is the heat of wires and contacts
        heat = contacts["joule_heat"].sum() + results.field("joule_heat", len(results.times) - 1).sum()
        assert heat == pytest.approx(current * self.VOLTS, rel=1e-10)

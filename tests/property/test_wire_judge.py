"""The judge of passages, on motions whose answers are known."""

import itertools

import numpy as np
import pytest
from random_decks import straight
from scipy.spatial.transform import Rotation
from wire_judge import Motion, Pair, judge

R = 1e-3


class Scene:
    """Wires through points, and states of them: each wire moved by a rigid motion, or its nodes one by one."""

    def __init__(self, *wires, radius=R, closed=False, **laws):
        self.wires = [np.asarray(points, float) for points in wires]
        starts = np.cumsum([0, *(len(points) for points in self.wires)])
        self.nodes = [np.arange(a, b) for a, b in itertools.pairwise(starts)]
        chains = [np.append(nodes, nodes[:1]) if closed else nodes for nodes in self.nodes]
        self.elements = np.concatenate([np.stack([chain[:-1], chain[1:]], 1) for chain in chains])
        self.reference = np.concatenate(self.wires)
        self.radius = np.full(len(self.elements), radius)
        self.laws = laws
        still = np.zeros_like(self.reference)
        self.displacement, self.rotation, self.contacts = [still], [still.copy()], [([], [])]

    def then(self, wire=None, shift=(0, 0, 0), turn=(0, 0, 0), about=(0, 0, 0), contacts=()):
        """Another state: the last one, but with a wire (all: None) turned about a point of its first place and shifted.

        `contacts` are places on both axes with the two elements.
        """
        u, w = self.displacement[-1].copy(), self.rotation[-1].copy()
        for nodes in self.nodes if wire is None else [self.nodes[wire]]:
            x = self.reference[nodes]
            rotation = Rotation.from_rotvec(turn)
            u[nodes] = rotation.apply(x - about) + about + shift - x
            w[nodes] = rotation.as_rotvec()
        return self.state(u, w, contacts)

    def state(self, displacement, rotation, contacts=()):
        self.displacement.append(np.asarray(displacement, float))
        self.rotation.append(np.asarray(rotation, float))
        self.contacts.append(([place for place, _ in contacts], [elements for _, elements in contacts]))
        return self

    @property
    def motion(self):
        everything = np.ones(len(self.elements), bool)
        contacts = [
            (np.reshape(places, (-1, 2, 3)), np.reshape(pair, (-1, 2)).astype(int)) for places, pair in self.contacts
        ]
        return Motion(
            self.reference,
            self.elements,
            self.radius,
            np.array(self.displacement),
            np.array(self.rotation),
            [Pair(everything, everything, **self.laws)],
            contacts,
            [f"1:{k}" for k in range(len(self.displacement))],
        )

    @property
    def found(self):
        """Kinds of the findings, without doubts."""
        return [finding.kind for finding in judge(self.motion) if not finding.doubt]

    @property
    def doubts(self):
        return [finding.kind for finding in judge(self.motion) if finding.doubt]


def along(angle):
    return np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle)), 0])


def crossed(height=4 * R, angle=90.0, n=(4, 4), half=40 * R, at=(0, 0), **laws):
    """A wire along x, and one above it at an angle; `at` is where it is crossed along its two wires."""
    middle = np.array([at[0], 0, height]) - at[1] * along(angle)
    return Scene(
        straight((-half, 0, 0), (half, 0, 0), n[0]),
        straight(middle - half * along(angle), middle + half * along(angle), n[1]),
        **laws,
    )


# Passages


@pytest.mark.parametrize("angle", [5, 20, 90, 160])
@pytest.mark.parametrize("n", [(1, 1), (4, 4), (3, 7)])
@pytest.mark.parametrize("at", [(0, 0), (3.3 * R, -7.1 * R)])
def test_a_wire_that_is_put_through_another_has_passed(angle, n, at):
    assert crossed(angle=angle, n=n, at=at).then(1, (0, 0, -8 * R)).found == ["passage"]


def test_a_wire_that_goes_through_and_comes_back_has_passed_twice():
    scene = crossed().then(1, (0, 0, -8 * R)).then(1, (0, 0, 0))
    assert scene.found == ["passage", "passage"]


def test_a_passage_far_away_and_with_turns_is_found():
    """Like a thread that springs back through its pusher: by 80 mm and half a radian in one increment."""
    scene = crossed(height=2.2 * R, half=60 * R, n=(10, 3))
    scene.then(1, shift=(10 * R, 20 * R, -60 * R), turn=(0.3, 0.5, -0.2), about=(0, 0, 0))
    assert scene.found == ["passage"]


def test_a_wire_that_slides_along_another_without_touching_has_not_passed():
    scene = crossed(height=2.001 * R)
    for k in range(5):
        scene.then(1, (4 * R * k, 2 * R * k, 0))
    assert scene.found == []
    assert scene.doubts == []


@pytest.mark.slow
def test_wires_that_move_together_have_not_passed():
    scene = crossed(height=2.001 * R, angle=35)
    scene.then(None, turn=(0, 0, 2.8), shift=(30 * R, 0, 50 * R)).then(None, turn=(0, 1.5, 0)).then(
        None, turn=(1.2, 0, 2.5)
    )
    assert scene.found == []


def test_a_wire_that_turns_through_parallel_above_another_has_not_passed():
    scene = crossed(height=2.01 * R, angle=30).then(1, turn=(0, 0, np.radians(-60)), about=(0, 0, 2.01 * R))
    assert scene.found == []


@pytest.mark.slow
def test_a_wire_that_turns_through_another_has_passed():
    """It goes up, then down by 60 degrees in one increment, about an axis near its one end."""
    scene = crossed(height=4 * R, at=(0, 15 * R)).then(1, turn=(np.radians(30), 0, 0), about=(0, -50 * R, 4 * R))
    scene.then(1, turn=(np.radians(-30), 0, 0), about=(0, -50 * R, 4 * R))
    assert scene.found == ["passage"]


@pytest.mark.parametrize("angle", [0, 0.5, 3])
def test_wires_side_by_side_that_change_sides_have_passed(angle):
    half = 30 * R
    start = np.array([0, 6 * R, 0])
    scene = Scene(
        straight((-half, 0, 0), (half, 0, 0), 5), straight(start - half * along(angle), start + half * along(angle), 4)
    ).then(1, (0, -12 * R, 0))
    assert set(scene.found) == {"passage"}


def test_a_wire_that_is_lifted_over_one_beside_it_has_not_passed():
    half = 30 * R
    scene = Scene(straight((-half, 0, 0), (half, 0, 0), 5), straight((-half, 6 * R, 0), (half, 6 * R, 0), 4))
    scene.then(1, (0, -3 * R, 2.5 * R)).then(1, (0, -9 * R, 2.5 * R)).then(1, (0, -12 * R, 0))
    assert scene.found == []
    assert scene.doubts == []


def test_a_wire_that_goes_round_the_end_of_another_has_not_passed():
    scene = crossed(height=3 * R, half=30 * R, at=(25 * R, 0))
    scene.then(1, (10 * R, 0, 0)).then(1, (10 * R, 0, -6 * R)).then(1, (0, 0, -6 * R))
    assert scene.found == []


def test_a_short_cut_through_an_end_is_a_doubt():
    """In one increment it may have gone round the end, though the straight way goes through."""
    scene = crossed(height=3 * R, half=30 * R, at=(25 * R, 0)).then(1, (6 * R, 0, -6 * R))
    assert scene.found == []
    assert scene.doubts == ["passage"]


def test_a_wire_beside_the_end_of_another_has_not_passed():
    scene = crossed(height=3 * R, half=30 * R, at=(33 * R, 0)).then(1, (0, 0, -6 * R))
    assert scene.found == []
    assert scene.doubts == []


def hairpin(gap=6 * R, leg=40 * R):
    arc = np.linspace(np.pi / 2, -np.pi / 2, 9)
    bend = np.stack([leg + gap * np.cos(arc), gap * np.sin(arc), 0 * arc], 1)
    return np.concatenate(
        [straight((0, gap, 0), (leg, gap, 0), 4)[:-1], bend, straight((leg, -gap, 0), (0, -gap, 0), 4)[1:]]
    )


def test_both_legs_of_a_hairpin_pass_a_rod():
    rod = straight((20 * R, -50 * R, 4 * R), (20 * R, 50 * R, 4 * R), 3)
    scene = Scene(hairpin(), rod).then(1, (0, 0, -8 * R))
    # one finding for two wires and an increment
    assert scene.found == ["passage"]


def test_a_hairpin_that_is_drawn_back_under_a_rod_and_pushed_out_above_it_has_not_passed():
    rod = straight((30 * R, -50 * R, 4 * R), (30 * R, 50 * R, 4 * R), 3)
    scene = Scene(hairpin(), rod).then(0, (-30 * R, 0, 0)).then(0, (-30 * R, 0, 8 * R)).then(0, (0, 0, 8 * R))
    assert scene.found == []


def loop(rise, n=24, big=15 * R, leg=30 * R):
    arc = np.linspace(-np.pi / 2, 3 * np.pi / 2, n + 1)
    circle = np.stack([big * np.cos(arc), big + big * np.sin(arc), rise * np.linspace(-0.5, 0.5, n + 1)], 1)
    legs = straight((-leg, 0, -rise / 2), circle[0], 3)[:-1], straight(circle[-1], (leg, 0, rise / 2), 3)[1:]
    return np.concatenate([legs[0], circle, legs[1]])


def test_a_loop_does_not_touch_itself_where_it_is_bent():
    scene = Scene(loop(3 * R)).then(None, turn=(0.5, 0, 0))
    assert scene.found == []


def test_a_wire_passes_through_itself():
    """The two legs of a loop change places in height."""
    scene = Scene(loop(3 * R))
    u = loop(-3 * R) - loop(3 * R)
    scene.state(u, 0 * u)
    assert "passage" in scene.found


def coil(radius, pitch, turns=1.25, n=20):
    angle = np.linspace(0, 2 * np.pi * turns, int(turns * n) + 1)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), pitch * angle / (2 * np.pi)], 1)


@pytest.mark.slow
@pytest.mark.parametrize("radius", [1.3 * R, 6 * R])
def test_turns_of_a_coil_overlap_however_short_they_are(radius):
    """Turns of 8 radii, and of 38: the last quarter overlaps the first one by a fifth of the radius, and no turn itself."""
    scene = Scene(coil(radius, 2.3 * R))
    pressed = coil(radius, 1.8 * R) - coil(radius, 2.3 * R)
    scene.state(pressed, 0 * pressed)
    assert set(scene.found) == {"unseen"}
    assert Scene(coil(radius, 2.3 * R)).then(None, (R, 0, 0)).found == []


def test_the_legs_of_a_hairpin_overlap_and_its_bend_does_not():
    scene = Scene(hairpin(gap=3 * R, leg=12 * R))
    closer = hairpin(gap=0.95 * R, leg=12 * R) - hairpin(gap=3 * R, leg=12 * R)
    scene.state(closer, 0 * closer)
    assert set(scene.found) == {"unseen"}
    assert Scene(hairpin(gap=1.05 * R, leg=12 * R)).then(None, (R, 0, 0)).found == []


def test_a_ring_of_few_elements_is_no_overlap():
    angle = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    points = 10 * R * np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    assert Scene(points, closed=True).then(None, (R, 0, 0)).found == []


def test_a_sharp_v_does_not_overlap_itself():
    for degrees in (20, 60, 120):
        leg = 30 * R * along(180 - degrees)
        points = np.array([(-30 * R, 0, 0), (-15 * R, 0, 0), (0, 0, 0), leg / 2, leg])
        assert Scene(points).then(None, (R, 0, 0)).found == []


@pytest.mark.parametrize(("linear", "expected"), [(False, ["passage"]), (True, [])])
def test_an_element_that_bends_passes_with_its_bow(linear, expected):
    """Only its end nodes turn, by 30 degrees: the bow of the cubic is L tan/4, that of the chord nothing."""
    half = 20 * R
    rod = straight((0, -half, -2.5 * R), (0, half, -2.5 * R), 2)
    scene = Scene(straight((-half, 0, 0), (half, 0, 0), 1), rod, linear=linear)
    w = np.zeros_like(scene.reference)
    w[0, 1], w[1, 1] = np.radians(30), -np.radians(30)
    assert scene.state(0 * w, w).found == expected


# Overlaps


def contact(scene, height):
    """Where the wires of `crossed` touch in the middle of their axes: the elements on one side of it."""
    n = len(scene.nodes[0]) - 1
    return [(np.array([(0, 0, 0), (0, 0, height)]), (n // 2, n + (len(scene.nodes[1]) - 1) // 2))]


@pytest.mark.parametrize(
    ("overlap", "known", "expected"),
    [
        (-0.01, False, []),
        (0.004, False, []),
        (0.006, False, ["unseen"]),
        (0.045, True, []),
        (0.055, True, ["deep"]),
        (0.3, False, ["unseen"]),
    ],
)
def test_overlaps_are_measured_and_looked_up_in_the_ledger(overlap, known, expected):
    height = (2 - overlap) * R
    scene = crossed(height=3 * R, angle=50)
    scene.then(1, (0, 0, height - 3 * R), contacts=contact(scene, height) if known else ())
    assert scene.found == expected
    if expected:
        (finding,) = judge(scene.motion)
        assert finding.amount == pytest.approx(overlap, abs=1e-9)


def test_a_contact_elsewhere_does_not_excuse_an_overlap():
    """A wire bent like a v upside down overlaps a rod at two places; the ledger has one of them."""
    rod = straight((-40 * R, 0, 0), (40 * R, 0, 0), 5)
    across = [straight((x, -20 * R, 3 * R), (x, 20 * R, 3 * R), 3) for x in (-10 * R, 10 * R)]
    wire = np.concatenate([across[0], across[1][::-1]])
    scene = Scene(rod, wire)
    place = np.array([(-10 * R, 0, 0), (-10 * R, 0, 1.97 * R)])
    scene.then(1, (0, 0, -1.03 * R), contacts=[(place, (1, 6))])
    (finding,) = judge(scene.motion)
    assert finding.kind == "unseen"
    assert finding.place[0] == pytest.approx(10 * R)


def test_the_end_of_a_wire_is_round():
    """It is half a radius too near to the side of another: its axis ends 1.5 r from the axis of that."""
    rod = straight((-20 * R, 0, 0), (20 * R, 0, 0), 3)
    scene = Scene(rod, straight((0, 2.5 * R, 0), (0, 30 * R, 0), 3)).then(1, (0, -R, 0))
    (finding,) = judge(scene.motion)
    assert finding.kind == "unseen"
    assert finding.amount == pytest.approx(0.5)
    assert "at an end" in finding.text


def test_wires_that_no_contact_pair_names_may_do_what_they_want():
    scene = crossed().then(1, (0, 0, -3 * R)).then(1, (0, 0, -8 * R))
    motion = scene.motion
    first = np.arange(len(motion.elements)) < len(scene.nodes[0]) - 1
    motion.pairs = [Pair(first, first)]
    assert judge(motion) == []


def test_soft_penalties_and_interference_fits_may_overlap():
    height = 1.5 * R
    for laws in ({"unlimited": True}, {"fit": True}):
        scene = crossed(height=3 * R, **laws)
        assert scene.then(1, (0, 0, height - 3 * R), contacts=contact(scene, height)).found == []


@pytest.mark.parametrize(("known", "expected"), [(True, []), (False, ["passage"])])
def test_with_unlimited_penetration_a_contact_may_sink_in_beyond_the_axis(known, expected):
    scene = crossed(height=4 * R, unlimited=True)
    assert scene.then(1, (0, 0, -7 * R), contacts=contact(scene, -3 * R) if known else ()).found == expected


def test_unequal_radii_count():
    scene = crossed(height=4 * R)
    scene.radius[: len(scene.nodes[0]) - 1] = 2 * R
    scene.then(1, (0, 0, -1.1 * R))
    (finding,) = judge(scene.motion)
    assert finding.amount == pytest.approx(0.1)

"""Contact of solids in the plane: tangents, balances, closed forms, and the patch test of pressure and current."""

import itertools

import numpy as np
import pytest

from litz.kernels import contact_em, node_to_segment_em, segment_to_segment_em

BODIES = {"young": [3.0, 2.0], "poisson": [0.3, 0.2], "resistivity": [0.7, 0.4]}
NORMAL = {"linear": {"eps_n": 5.0}, "exponential": {"p_0": 0.4, "decay": 0.3}}
CMY = {"hardness": 7.0, "slope": 0.2, "roughness": 0.3, "resistivity": BODIES["resistivity"]}
SPOT = {
    "none": {},
    "cmy": CMY,
    "film": {**CMY, "sigma_f": 0.6},
    "elastic rough": BODIES,
    "constant": {"resistance": 0.8},
    "table": {"table": [[0.1, 1.0, 10.0], [3.0, 0.5, 0.2]]},
}
LAWS = [
    pytest.param({"normal_law": normal, "spot_law": spot, **NORMAL[normal], **SPOT[spot]}, id=f"{normal}-{spot}")
    for normal, spot in itertools.product(NORMAL, SPOT)
]
#: A step of central differences at which their errors, h^2 and round-off/h, are about equal
STEP = 1e-5
TOLERANCE = 1e-8


def node_pair(q, v, laws):
    """The element as a function of the displacements (6) and the voltages (3)."""
    return node_to_segment_em(q[:4].reshape(2, 2), q[4:], v[:2], v[2], area=0.6, **laws)


def segment_pair(q, v, laws):
    """The same of the displacements (8) and the voltages (4)."""
    x = q.reshape(4, 2)
    return segment_to_segment_em(x[:2], x[2:], v[:2], v[2:], length=1.3, width=[0.9, 1.4], **laws)


PAIRS = {
    "node": (node_pair, [0.1, 0.2, 1.3, -0.1, 0.6, 0.16], [1.0, 1.4, 0.2]),
    "segment, cut at both its ends": (segment_pair, [0, 0.1, 1.1, 0, 1.6, 0.05, -0.5, 0.25], [1, 1.4, 0.2, 0.1]),
    "segment, cut at its first end": (segment_pair, [0, 0.1, 1.1, 0, 1.6, 0.05, 0.2, 0.25], [1, 1.4, 0.2, 0.1]),
    "segment, cut at its second end": (segment_pair, [0, 0.1, 1.1, 0, 0.9, 0.05, -0.3, 0.25], [1, 1.4, 0.2, 0.1]),
    "segment, whole": (segment_pair, [0, 0.1, 1.1, 0, 0.9, 0.05, 0.2, 0.25], [1, 1.4, 0.2, 0.1]),
}


@pytest.fixture(params=PAIRS)
def pair(request):
    """The element, its displacements and its voltages."""
    function, q, v = PAIRS[request.param]
    return function, np.array(q, dtype=float), np.array(v, dtype=float)


class TestTangent:
    @pytest.mark.parametrize("laws", LAWS)
    def test_it_is_the_derivative_of_the_residual(self, pair, laws):
        function, q, v = pair
        contact = function(q, v, laws)
        assert contact.active
        unknowns = np.concatenate([q, v])
        differences = np.empty_like(contact.K)
        for i in range(len(unknowns)):
            step = STEP * np.eye(len(unknowns))[i]
            ends = [function(*np.split(unknowns + sign * step, [len(q)]), laws).R for sign in (1, -1)]
            differences[:, i] = (ends[0] - ends[1]) / (2 * STEP)
        np.testing.assert_allclose(contact.K, differences, atol=TOLERANCE * np.abs(contact.K).max())

    def test_currents_do_not_act_on_forces(self, pair):
        function, q, v = pair
        contact = function(q, v, {"normal_law": "linear", "spot_law": "cmy", **NORMAL["linear"], **CMY})
        assert not contact.K[: len(q), len(q) :].any()
        assert contact.K[len(q) :, : len(q)].any()

    def test_that_of_a_node_under_a_penalty_is_symmetric(self):
        function, q, v = PAIRS["node"]
        k = function(np.array(q), np.array(v), {"normal_law": "linear", "spot_law": "none", "eps_n": 5.0}).K[:6, :6]
        np.testing.assert_allclose(k, k.T, atol=1e-15)


class TestBalance:
    @pytest.mark.parametrize("laws", LAWS)
    def test_forces_moments_and_currents_sum_to_zero(self, pair, laws):
        function, q, v = pair
        residual = function(q, v, laws).R
        forces, currents = residual[: len(q)].reshape(-1, 2), residual[len(q) :]
        x = q.reshape(-1, 2)
        assert np.abs(forces).max() > 0.01
        np.testing.assert_allclose(forces.sum(axis=0), 0, atol=1e-15)
        assert abs(currents.sum()) < 1e-15
        moment = x[:, 0] @ forces[:, 1] - x[:, 1] @ forces[:, 0]
        assert moment == pytest.approx(0, abs=1e-15)

    @pytest.mark.parametrize("laws", LAWS)
    def test_a_rigid_motion_turns_the_forces_with_it(self, pair, laws):
        function, q, v = pair
        c, s = np.cos(0.7), np.sin(0.7)
        turn = np.array([[c, -s], [s, c]])
        here, there = function(q, v, laws), function((q.reshape(-1, 2) @ turn.T + [3, -2]).ravel(), v, laws)
        turned = (here.R[: len(q)].reshape(-1, 2) @ turn.T).ravel()
        np.testing.assert_allclose(there.R, np.concatenate([turned, here.R[len(q) :]]), rtol=1e-13, atol=1e-13)

    def test_a_point_is_opposite_its_place_in_the_master(self):
        function, q, v = PAIRS["segment, cut at its second end"]
        contact = function(
            np.array(q, dtype=float), np.array(v), {"normal_law": "linear", "spot_law": "none", "eps_n": 5.0}
        )
        x = np.array(q).reshape(4, 2)
        for i in range(2):
            at_master = (x[0] * (1 - contact.xi_bar[i]) + x[1] * (1 + contact.xi_bar[i])) / 2
            at_slave = (x[2] * (1 - contact.xi[i]) + x[3] * (1 + contact.xi[i])) / 2
            np.testing.assert_allclose(at_master - at_slave, contact.gap[i] * contact.normal, atol=1e-15)
            assert contact.pressure[i] == pytest.approx(-5.0 * contact.gap[i])
        force = np.linalg.norm(contact.R[:2] + contact.R[2:4])
        assert force == pytest.approx(contact.area @ contact.pressure)

    def test_the_dissipated_power_is_voltage_times_current(self, pair):
        function, q, v = pair
        contact = function(q, v, {"normal_law": "linear", "spot_law": "constant", "eps_n": 5.0, "resistance": 0.8})
        assert v @ contact.R[len(q) :] == pytest.approx(v @ contact.K[len(q) :, len(q) :] @ v)
        assert v @ contact.R[len(q) :] > 0


class TestLaws:
    def conductance(self, spot, pressure, normal="linear"):
        laws = {"linear": {"eps_n": 2.0}, "exponential": {"p_0": 0.5, "decay": 0.25}}[normal]
        depth = pressure / 2.0 if normal == "linear" else 0.25 * np.log(pressure / 0.5)
        contact = node_to_segment_em(
            [[0, 0], [1, 0]],
            [0.5, depth],
            [1, 1],
            0.0,
            area=1.0,
            normal_law=normal,
            spot_law=spot,
            **laws,
            **SPOT[spot],
        )
        assert contact.pressure == pytest.approx(pressure)
        return contact.conductance

    def test_cmy(self):
        # 1.25 k m/sigma (p/H)^0.95, k the harmonic mean of 1/0.7 and 1/0.4
        k = 2 / (0.7 + 0.4)
        assert self.conductance("cmy", 1.5) == pytest.approx(1.25 * k * 0.2 / 0.3 * (1.5 / 7.0) ** 0.95)

    def test_a_film_lies_on_the_true_area(self):
        film = 1 / self.conductance("film", 1.5) - 1 / self.conductance("cmy", 1.5)
        assert film == pytest.approx(0.6 * 7.0 / 1.5)

    @pytest.mark.parametrize(("normal", "stiffness"), [("linear", 2.0), ("exponential", 1.5 / 0.25)])
    def test_elastic_surfaces_conduct_in_proportion_to_their_stiffness(self, normal, stiffness):
        modulus = 1 / ((1 - 0.3**2) / 3.0 + (1 - 0.2**2) / 2.0)
        assert self.conductance("elastic rough", 1.5, normal) == pytest.approx(2 * stiffness / (modulus * (0.7 + 0.4)))

    def test_constant_and_table_are_resistances_times_area(self):
        assert self.conductance("constant", 1.5) == pytest.approx(1 / 0.8)
        assert self.conductance("table", 1.0) == pytest.approx(1 / 0.5)

    def test_rough_surfaces_press_each_other_across_a_gap(self):
        contact = node_to_segment_em(
            [[0, 0], [1, 0]], [0.5, -0.25], [0, 0], 0.0, area=2.0, normal_law="exponential", p_0=0.5, decay=0.25, spot_law="none"
        )  # fmt: skip
        assert contact.gap == 0.25
        assert contact.pressure == pytest.approx(0.5 / np.e)

    def test_augmentation_adds_to_the_penalty(self):
        laws = {"area": 2.0, "normal_law": "linear", "eps_n": 2.0, "spot_law": "none"}
        contact = node_to_segment_em([[0, 0], [1, 0]], [0.5, 0.1], [0, 0], 0.0, augmentation=0.3, **laws)
        assert contact.pressure == pytest.approx(0.5)
        assert contact.R[4:6] == pytest.approx([0, 1.0])
        apart = node_to_segment_em([[0, 0], [1, 0]], [0.5, -0.2], [0, 0], 0.0, augmentation=0.3, **laws)
        assert not apart.active
        assert not apart.K.any()


PAIRING = {"normal_law": "linear", "eps_n": 2.0, "spot_law": "constant", "resistance": 1.0}


class TestPairing:
    def test_a_node_opposite_a_joint_counts_once(self):
        found = [
            node_to_segment_em(x_bar, [1.0, 0.1], [0, 0], 0.0, area=1.0, **PAIRING).active
            for x_bar in ([[0, 0], [1, 0]], [[1, 0], [2, 0]])
        ]
        assert found == [False, True]

    def test_the_reach_of_a_segment_takes_in_nodes_beyond_the_end_of_a_surface(self):
        x_bar, x = [[0, 0], [2, 0]], [2.1, 0.1]
        assert not node_to_segment_em(x_bar, x, [0, 0], 0.0, area=1.0, reach=[0.1, 0.04], **PAIRING).active
        beyond = node_to_segment_em(x_bar, x, [0, 0], 0.0, area=1.0, reach=[0, 0.06], **PAIRING)
        assert beyond.active
        assert beyond.xi_bar == pytest.approx(1.1)

    @pytest.mark.parametrize("x", [[-0.1, 0.1], [1.2, 0.1], [0.5, -0.1]])
    def test_nothing_acts_where_nothing_touches(self, x):
        contact = node_to_segment_em([[0, 0], [1, 0]], x, [1, 1], 0.0, area=1.0, **PAIRING)
        assert not contact.active
        assert not contact.K.any()
        assert not contact.R.any()

    def test_segments_whose_bodies_lie_on_the_same_side_do_not_face_each_other(self):
        x_bar, x = [[0, 0], [1, 0]], [[0, 0.1], [1, 0.1]]
        assert not segment_to_segment_em(x_bar, x, [1, 1], [0, 0], length=1.0, **PAIRING).active
        assert segment_to_segment_em(x_bar, x[::-1], [1, 1], [0, 0], length=1.0, **PAIRING).active

    def test_many_pairs_at_once_are_the_single_ones(self):
        corners = np.array([[0, 0], [1, 0], [1.2, 0.1], [-0.1, 0.1]])
        shapes = corners + np.random.default_rng(3).uniform(-0.05, 0.05, (20, 4, 2))
        volts = np.linspace(0, 1, 80).reshape(20, 4)
        lengths = np.linspace(1, 2, 20)
        many = segment_to_segment_em(
            shapes[:, :2], shapes[:, 2:], volts[:, :2], volts[:, 2:], length=lengths, **PAIRING
        )
        nodes = node_to_segment_em(
            shapes[:, :2], shapes[:, 3] + [0.5, 0], volts[:, :2], volts[:, 3], area=1.0, **PAIRING
        )
        for i, (x, v) in enumerate(zip(shapes, volts, strict=True)):
            one = segment_to_segment_em(x[:2], x[2:], v[:2], v[2:], length=lengths[i], **PAIRING)
            node = node_to_segment_em(x[:2], x[3] + [0.5, 0], v[:2], v[3], area=1.0, **PAIRING)
            for name in one._fields:
                np.testing.assert_array_equal(getattr(many, name)[i], getattr(one, name))
            for name in node._fields:
                np.testing.assert_array_equal(getattr(nodes, name)[i], getattr(node, name))


def chain(ends, n):
    """Nodes of n segments of unequal lengths between two abscissae."""
    return np.interp(np.linspace(0, 1, n + 1) ** 1.3, [0, 1], ends)


UNIFORM = {"normal_law": "linear", "eps_n": 2.0, "spot_law": "constant", "resistance": 0.5}


class TestUniformPressure:
    """Two flat surfaces overlap by 0.1, with meshes that do not match: every node gets its tributary share."""

    def shares(self, n_master, n_slave):
        """Forces and currents of master and slave nodes from `segment_to_segment_em`."""
        masters, slaves = chain([0, 1], n_master), chain([1, 0], n_slave)
        of_master, of_slave = np.zeros((n_master + 1, 2)), np.zeros((n_slave + 1, 2))
        for i, j in itertools.product(range(n_master), range(n_slave)):
            x_bar, x = (np.stack([s[k : k + 2], [y, y]], axis=1) for s, k, y in ((masters, i, 0), (slaves, j, 0.1)))
            contact = segment_to_segment_em(x_bar, x, [1, 1], [0, 0], length=abs(np.diff(x[:, 0])[0]), **UNIFORM)
            of_master[i : i + 2] += np.stack([contact.R[1:4:2], contact.R[8:10]], axis=1)
            of_slave[j : j + 2] += np.stack([contact.R[5:8:2], contact.R[10:12]], axis=1)
        return masters, of_master, slaves, of_slave

    @pytest.mark.parametrize(("n_master", "n_slave"), [(4, 7), (7, 4), (1, 5), (5, 1)])
    def test_it_passes_from_segments_to_segments(self, n_master, n_slave):
        masters, of_master, slaves, of_slave = self.shares(n_master, n_slave)
        for x, found in ((masters, of_master), (slaves, of_slave)):
            lengths = np.abs(np.diff(x))
            tributary = (np.append(lengths, 0) + np.append(0, lengths)) / 2
            np.testing.assert_allclose(np.abs(found[:, 0]), 0.2 * tributary, rtol=1e-13)
            np.testing.assert_allclose(np.abs(found[:, 1]), tributary / 0.5, rtol=1e-13)

    def test_it_does_not_pass_from_nodes_to_segments(self):
        masters, slaves = chain([0, 1], 5), chain([1, 0], 3)
        lengths = np.abs(np.diff(slaves))
        areas = (np.append(lengths, 0) + np.append(0, lengths)) / 2
        forces = np.zeros(6)
        for i, (x, area) in itertools.product(range(5), zip(np.clip(slaves, 1e-9, 1 - 1e-9), areas, strict=True)):
            x_bar = np.stack([masters[i : i + 2], [0, 0]], axis=1)
            forces[i : i + 2] += node_to_segment_em(x_bar, [x, 0.1], [1, 1], 0.0, area=area, **UNIFORM).R[1:4:2]
        lengths = np.diff(masters)
        tributary = (np.append(lengths, 0) + np.append(0, lengths)) / 2
        assert np.abs(forces / (0.2 * tributary)).max() > 1.3


GOOD = {"area": 1.0, "normal_law": "linear", "eps_n": 1.0, "spot_law": "constant", "resistance": 1.0}


class TestBadInput:
    @pytest.mark.parametrize(
        ("change", "words"),
        [
            ({"eps_n": None}, 'normal_law="linear" needs eps_n'),
            ({"p_0": 1.0}, "p_0 is no number of these laws"),
            ({"area": 0.0}, "area must be greater than 0"),
            ({"eps_n": -1.0}, "eps_n must be greater than 0"),
            ({"spot_law": "hertz", "resistance": None}, '"hertz" is a law per spot, and this contact has an area'),
            ({"normal_law": "hertz", "eps_n": None}, '"hertz" is a law per spot, and this contact has an area'),
            ({"spot_law": "cmz"}, "spot_law must be one of"),
            ({"spot_law": "table", "resistance": None, "table": [[2.0, 1.0], [1.0, 1.0]]}, "ascending pressures"),
            ({"spot_law": "cmy", "resistance": None, "slope": 0.1}, 'spot_law="cmy" needs hardness, roughness, resistivity'),
        ],
    )  # fmt: skip
    def test_it_is_answered_in_words(self, change, words):
        data = {name: value for name, value in {**GOOD, **change}.items() if value is not None}
        with pytest.raises(ValueError, match=words):
            node_to_segment_em([[0, 0], [1, 0]], [0.5, 0.1], [0, 0], 0.0, **data)

    def test_segments_without_length(self):
        with pytest.raises(ValueError, match="the two nodes of a segment coincide"):
            node_to_segment_em([[1, 0], [1, 0]], [0.5, 0.1], [0, 0], 0.0, **GOOD)

    def test_an_overlap_beyond_all_numbers(self):
        laws = dict(normal_law="exponential", p_0=1e6, decay=1e-6, spot_law="none")
        master, deep = [[0, 0], [1e-3, 0]], [[3e-4, 1e-5], [3e-4, 1e-3]]
        with pytest.raises(ValueError, match="pair 1: the bodies overlap so deeply"):
            node_to_segment_em(master, deep, [0, 0], 0.0, area=1e-7, **laws)
        with pytest.raises(ValueError, match=r"^the bodies overlap so deeply"):
            segment_to_segment_em(master, [[1e-3, 1e-3], [0, 1e-3]], [0, 0], [0, 0], length=1e-3, **laws)

    def test_augmentation_is_of_the_penalty_only(self):
        with pytest.raises(ValueError, match='augmentation belongs to normal_law="linear"'):
            node_to_segment_em(
                [[0, 0], [1, 0]], [0.5, 0.1], [0, 0], 0.0, area=1.0, normal_law="exponential", p_0=1.0, decay=1.0,
                spot_law="none", augmentation=1.0,
            )  # fmt: skip

    def test_wires_refuse_laws_per_area(self):
        wires = {"radius": 1e-3, "young": 1e11, "poisson": 0.3, "resistivity": 1e-8, "eps_n": 1e5}
        with pytest.raises(ValueError, match='"cmy" is a law per area, and wires touch in spots'):
            contact_em(np.eye(4, 3), np.tile([1.0, 0, 0], (4, 1)), [1, 1], np.zeros(4), spot_law="cmy", **wires)

"""The kernels, called for many elements, pairs or points at once: each result is that of a call of its own, bit for bit."""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from contact_pair import Pair
from derivatives import rotation
from litz import kernels

N = 7


def crossings(seed, n=N):
    """Pairs of crossed elements, of which some touch and some do not."""
    rng = np.random.default_rng(seed)
    x = np.array([[-1e-2, 0, 1.95e-3], [1e-2, 0, 1.95e-3], [0, -1e-2, 0], [0, 1e-2, 0]])
    turned = np.array([rotation(vector) for vector in rng.uniform(-0.01, 0.01, (4 * n, 3))]).reshape(n, 4, 3, 3)
    t = turned @ np.array([[1.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]])[..., None]
    x = x + rng.uniform(-1e-5, 1e-5, (n, 4, 3))
    x[::3, :2, 2] += 1e-3
    return dict(x=x, t=t[..., 0], length=rng.uniform(1.9e-2, 2.1e-2, (n, 2)), v=rng.uniform(0, 1e-3, (n, 4)))


def wires(seed, n=N):
    rng = np.random.default_rng(seed)
    return dict(
        radius=1e-3 * rng.uniform(0.99, 1.01, (n, 2)),
        young=120e9 * rng.uniform(0.5, 2, (n, 2)),
        poisson=rng.uniform(0.1, 0.4, (n, 2)),
        resistivity=1.7e-8 * rng.uniform(0.5, 2, (n, 2)),
    )


def beams(seed, n=N):
    rng = np.random.default_rng(seed)
    triads = np.array([rotation(vector) for vector in rng.uniform(-0.3, 0.3, (4 * n, 3))]).reshape(2, n, 2, 3, 3)
    x = np.array([[0.0, 0, 0], [1, 0, 0]]) + rng.uniform(-0.1, 0.1, (2, n, 2, 3))
    return dict(x=x[0], triads=triads[0], x0=x[1], triads0=triads[1])


def numbers(seed, **ranges):
    """Numbers within limits: `name=(low, high)`, or with a shape of one call behind these."""
    rng = np.random.default_rng(seed)
    return {name: rng.uniform(low, high, (N, *shape)) for name, (low, high, *shape) in ranges.items()}


METAL = np.stack([np.broadcast_to([300.0, 400, 500], (N, 3)), np.linspace(1, 2, 3 * N).reshape(N, 3)], axis=1)
SCALE = np.array([1.0, 1e-8])[:, None]

#: kernel, arguments that each call has of its own, arguments that all share
CASES = {
    "nb3sn": (
        kernels.nb3sn,
        numbers(81, temperature=(2, 20), field=(0, 30), strain=(-5e-3, 3e-3), em=(0, 1e-3), C=(1e10, 9e10)),
        dict(Bc20=33.0, Tc0=16.0, p=0.6, q=2.1, Ca1=44.0, Ca2=4.0, e0=2.56e-3),
    ),
    "nbti": (
        kernels.nbti,
        numbers(82, temperature=(2, 10), field=(0, 12), jref=(1e9, 3e9), gamma=(2, 2.5)),
        dict(C0=27.0, Bc20=14.5, Tc0=9.2, alpha=0.57, beta=0.9),
    ),
    "critical_table": (
        kernels.critical_table,
        numbers(83, temperature=(2, 7), field=(3, 9)),
        dict(densities=[(3e9, 4, 5), (2e9, 5, 5), (2e9, 4, 7), (1e9, 5, 7)]),
    ),
    "parallel_field": (
        kernels.parallel_field,
        numbers(84, current=(-2e9, 2e9), conductivity=(1e9, 5e9), critical=(0, 1e9), exponent=(1, 40)),
        {},
    ),
    "superconductor": (
        kernels.superconductor,
        numbers(85, current=(-400, 400), v=(-1e-6, 1e-6, 2), length=(0.01, 0.02), fraction=(0.2, 0.6)),
        dict(area=5e-7, resistivity=2e-10, critical=2e9, exponent=30.0),
    ),
    "contact_em hertz": (
        kernels.contact_em,
        crossings(1) | wires(2) | numbers(3, series_resistance=(0, 1e-4, 2)),
        dict(normal_law="hertz", spot_law="hertz"),
    ),
    "contact_em penalty": (
        kernels.contact_em,
        crossings(4)
        | wires(5)
        | numbers(6, eps_n=(1e6, 1e7), law_value=(1.0, 2.0, 2), rotation_vectors=(-0.2, 0.2, 4, 3)),
        dict(spot_law="sharvin"),
    ),
    "contact_em table": (
        kernels.contact_em,
        crossings(7)
        | wires(8)
        | dict(table=np.stack([np.tile([1.0, 10.0], (N, 1)), np.linspace(2e-3, 1e-3, 2 * N).reshape(N, 2)], axis=1)),
        dict(normal_law="hertz", spot_law="table", axis="linear"),
    ),
    "contact_em yielding": (
        kernels.contact_em,
        crossings(9) | wires(10) | numbers(11, yield_stress=(200e6, 300e6), largest_force=(0, 20)),
        dict(normal_law="hertz", spot_law="hertz"),
    ),
    "contact_em ends": (
        kernels.contact_em,
        crossings(12) | wires(13) | dict(ends=np.tile([0, 0], (N, 1)), side=np.resize([0, 1, -1], N)),
        dict(normal_law="hertz", spot_law="film", film_resistivity=1e-12, tangent=False),
    ),
    "contact_coupling": (
        kernels.contact_coupling,
        crossings(14) | wires(15),
        dict(normal_law="hertz", spot_law="hertz"),
    ),
    "closest_points": (kernels.closest_points, {k: v for k, v in crossings(16).items() if k != "v"}, {}),
    "closest_points start": (
        kernels.closest_points,
        {k: v for k, v in crossings(17).items() if k != "v"} | numbers(18, start=(-0.1, 0.1, 2)),
        dict(axis="linear"),
    ),
    "contact_spot": (
        kernels.contact_spot,
        wires(19) | numbers(20, force=(-0.1, 2), angle=(0.5, 2)),
        dict(law="hertz"),
    ),
    "contact_spot film": (
        kernels.contact_spot,
        wires(21) | numbers(22, force=(0.1, 2), angle=(0.5, 2), film_resistivity=(1e-13, 1e-12)),
        dict(law="film"),
    ),
    "contact_spot yielding": (
        kernels.contact_spot,
        wires(23)
        | numbers(24, force=(0.1, 2), angle=(0.5, 2), yield_stress=(2e8, 3e8, 2), largest_force=(0, 3), hardness=(1e9, 2e9))
        | numbers(25, mean_free_path=(0, 1e-7, 2)),
        dict(law="hertz"),
    ),
    "normal_law": (
        kernels.normal_law,
        {k: v for k, v in wires(26).items() if k != "resistivity"}
        | numbers(27, overlap=(-1e-6, 1e-5), angle=(0.5, 2), yield_stress=(2e8, 3e8, 2), largest_force=(0, 3)),
        {},
    ),
    "line_law": (kernels.line_law, wires(28) | numbers(29, force_per_length=(-1, 1e3), angle=(0, 3), film=(0, 1e-12)), {}),
    "line_law yielding": (
        kernels.line_law,
        wires(30)
        | numbers(31, force_per_length=(1, 1e3), yield_stress=(2e8, 3e8, 2), largest_force_per_length=(0, 1e3)),
        {},
    ),
    "line_point": (
        kernels.line_point,
        crossings(32) | wires(33) | numbers(34, xi=(-0.1, 0.1), weight=(1e-4, 2e-4), eps_l=(1e9, 2e9)),
        {},
    ),
    "beam_b31": (
        kernels.beam_b31,
        beams(35)
        | numbers(36, ea=(1, 2), ga2=(1, 2), ga3=(1, 2), gj=(1, 2), ei2=(1, 2), ei3=(1, 2), stress_free_strain=(0, 0.1)),
        {},
    ),
    "beam_b33": (
        kernels.beam_b33,
        beams(37) | numbers(38, ea=(1, 2), gj=(1, 2), ei2=(1, 2), ei3=(1, 2), sigma=(-1, 1, 6)),
        dict(form="hessian"),
    ),
    "beam_b31_strains": (kernels.beam_b31_strains, beams(39), {}),
    "beam_b33_strains": (kernels.beam_b33_strains, beams(40), {}),
    "conductor": (
        kernels.conductor,
        numbers(41, x=(0, 1, 2, 3), v=(0, 1, 2), length=(1, 2), area=(1, 2), resistivity=(1, 2)),
        dict(current_length=True),
    ),
    "potential_rise": (
        kernels.potential_rise,
        dict(xi=np.sort(numbers(42, xi=(-1, 1, 4))["xi"], axis=-1))
        | numbers(43, current=(-1, 1, 4), length=(1, 2), area=(1, 2), resistivity=(1, 2)),
        {},
    ),
    "spot_heat": (
        kernels.spot_heat,
        numbers(44, voltage=(0.01, 0.1), temperature=(290, 400, 2), current=(1, 2), lorenz=(2e-8, 3e-8, 2)),
        {},
    ),
    "spot_heat insulated": (
        kernels.spot_heat,
        numbers(45, voltage=(-0.1, 0.1), temperature=(290, 400, 2), conductance=(0, 2), heat_conductance=(0.1, 1, 2))
        | numbers(46, film_resistance=(0, 0.1), film_heat_conductance=(1, 2)),
        {},
    ),
    "hot_conductance": (kernels.hot_conductance, numbers(47, voltage=(0, 0.3), temperature=(290, 400, 2)), {}),
    "hot_spot": (
        kernels.hot_spot,
        numbers(48, voltage=(-0.1, 0.1), temperature=(300, 350, 2), shape=(1e4, 2e4)) | dict(resistivity=METAL * SCALE),
        dict(lorenz=2.44e-8),
    ),
    "hot_spot of tables": (
        kernels.hot_spot,
        numbers(49, voltage=(-0.1, 0.1), temperature=(300, 350, 2)) | dict(conductivity=METAL * [[1.0], [400]]),
        dict(shape=1e4, resistivity=METAL[0] * SCALE),
    ),
    "conductor_heat": (
        kernels.conductor_heat,
        numbers(50, v=(0, 0.1, 2), temperature=(300, 450, 2), length=(0.01, 0.02), area=(1e-6, 2e-6), film=(0, 10))
        | numbers(51, perimeter=(1e-3, 2e-3), sink=(290, 300), heat_fraction=(0.5, 1))
        | dict(resistivity=METAL * SCALE, conductivity=np.linspace(300, 400, N)),
        {},
    ),
    "wire_radiation": (
        kernels.wire_radiation,
        numbers(52, temperature=(300, 1000, 2), length=(0.1, 0.2), perimeter=(1e-3, 2e-3), emissivity=(0.1, 1)),
        dict(surroundings=300),
    ),
    "heat_capacity": (
        kernels.heat_capacity,
        numbers(53, temperature=(300, 500, 2), before=(300, 500, 2), length=(0.1, 0.2), time=(0.1, 1))
        | dict(specific_heat=METAL),
        dict(area=1e-6, density=9000, latent_heat=[[2e5, 400, 410]]),
    ),
    "node_to_segment_em": (
        kernels.node_to_segment_em,
        dict(x_bar=np.array([[0, 0], [1e-3, 0]]) + numbers(54, d=(-1e-5, 1e-5, 2, 2))["d"])
        | numbers(55, x=(2e-4, 4e-4, 2), v_bar=(0, 1, 2), v=(0, 1), area=(1e-7, 2e-7), slope=(0.1, 0.2), eps_n=(1e9, 2e9)),
        dict(normal_law="linear", spot_law="cmy", hardness=1e9, roughness=1e-6, resistivity=1.7e-8),
    ),
    "segment_to_segment_em": (
        kernels.segment_to_segment_em,
        dict(x_bar=np.array([[1e-3, 0], [0, 0]]) + numbers(56, d=(-1e-5, 1e-5, 2, 2))["d"])
        | dict(x=np.array([[-1e-3, 0], [2e-3, 0]]) + numbers(57, d=(-1e-5, 1e-5, 2, 2))["d"])
        | numbers(58, v_bar=(0, 1, 2), v=(0, 1, 2), length=(2e-3, 3e-3), width=(1e-3, 2e-3, 2), resistivity=(1e-8, 2e-8, 2)),
        dict(normal_law="exponential", p_0=1e6, decay=1e-5, spot_law="elastic rough", young=1e11, poisson=0.3),
    ),
}  # fmt: skip


def one_by_one(kernel, own, shared, n=N):
    """Results of as many calls, field by field, as one array each."""
    calls = [kernel(**{name: value[i] for name, value in own.items()}, **shared) for i in range(n)]
    if not isinstance(calls[0], tuple):
        return [np.array(calls)]
    return [np.array(field) for field in zip(*calls, strict=True)]


def fields_of(result):
    return list(result) if isinstance(result, tuple) else [result]


@pytest.mark.parametrize("case", CASES)
class TestManyCalls:
    def test_are_those_of_a_loop_bit_for_bit(self, case):
        kernel, own, shared = CASES[case]
        for found, expected in zip(fields_of(kernel(**own, **shared)), one_by_one(kernel, own, shared), strict=True):
            assert found.shape == expected.shape
            assert np.array_equal(found, expected)

    def test_have_any_leading_axes(self, case):
        # (N, 1) of the first argument against (2,) of all others: (N, 2)
        kernel, own, shared = CASES[case]
        first = next(iter(own))
        mixed = {name: np.expand_dims(value, 1) if name == first else value[:2] for name, value in own.items()}
        many = fields_of(kernel(**mixed, **shared))
        for i, j in ((0, 0), (N - 1, 1), (3, 1)):
            alone = fields_of(kernel(**{k: v[i if k == first else j] for k, v in own.items()}, **shared))
            for found, expected in zip(many, alone, strict=True):
                assert found.shape == (N, 2, *np.shape(expected))
                assert np.array_equal(found[i, j], expected)

    def test_may_be_none_at_all(self, case):
        kernel, own, shared = CASES[case]
        for found, one in zip(
            fields_of(kernel(**{name: value[:0] for name, value in own.items()}, **shared)),
            fields_of(kernel(**{name: value[0] for name, value in own.items()}, **shared)),
            strict=True,
        ):
            assert found.shape == (0, *np.shape(one))

    def test_that_do_not_broadcast_are_refused_with_their_shapes(self, case):
        kernel, own, shared = CASES[case]
        first = next(iter(own))
        with pytest.raises(ValueError, match=rf"broadcast.*\({N},\)"):
            kernel(**own | {first: own[first][:-1]}, **shared)

    def test_do_not_change_what_they_are_given(self, case):
        kernel, own, shared = CASES[case]
        before = {name: value.copy() for name, value in own.items()}
        kernel(**own, **shared)
        assert all(np.array_equal(own[name], value) for name, value in before.items())


def test_all_kernels_are_tried():
    tried = {kernel.__name__ for kernel, *_ in CASES.values()}
    callables = {name for name in kernels.__all__ if name[0].islower()}
    # the search has its own kind of many; the other is below
    assert callables - tried == {"contact_search", "beam_forces_by_temperature"}


def test_forces_by_temperature_of_many_beams():
    strains = kernels.beam_b31_strains(**beams(1))
    data = numbers(
        2, rigidity=(1, 2, 6), drigidity=(1, 2, 6), stress_free_strain=(0, 0.1), dstress_free_strain=(0, 0.1)
    )
    many = kernels.beam_forces_by_temperature(strains, **data)
    for i in range(N):
        one = kernels.BeamStrains(*(field[i] for field in strains))
        alone = kernels.beam_forces_by_temperature(one, **{name: value[i] for name, value in data.items()})
        assert np.array_equal(many[i], alone)


class TestThreads:
    """More pairs than one thread takes at a time."""

    def test_the_result_is_that_of_a_loop(self):
        own, shared = crossings(1, 300) | wires(2, 300), dict(normal_law="hertz", spot_law="hertz")
        many = kernels.contact_em(**own, **shared)
        assert 150 < many.active.sum() < 250
        for found, expected in zip(many, one_by_one(kernels.contact_em, own, shared, 300), strict=True):
            assert np.array_equal(found, expected)

    @pytest.mark.slow
    def test_their_number_does_not_matter(self, tmp_path):
        script = (
            "import sys; sys.path.insert(0, sys.argv[1]); import numpy as np; from test_batches import *;"
            "many = kernels.contact_em(**crossings(1, 300), **wires(2, 300), normal_law='hertz', spot_law='hertz');"
            "points = kernels.line_point(**crossings(3, 300), **wires(4, 300), xi=0.0, weight=1e-4, eps_l=1e9);"
            "beam = kernels.beam_b31(**beams(5, 300), ea=1, ga2=1, ga3=1, gj=1, ei2=1, ei3=1);"
            "np.savez(sys.argv[2], *many, *points, *beam)"
        )
        results = []
        for threads in ("1", "3"):
            path = tmp_path / f"{threads}.npz"
            subprocess.run(
                [sys.executable, "-c", script, str(Path(__file__).parent), path],
                env=os.environ | {"OMP_NUM_THREADS": threads},
                check=True,
                timeout=120,
            )
            with np.load(path) as file:
                results.append({name: file[name] for name in file})
        one, three = results
        assert one
        assert all(np.array_equal(one[name], three[name]) for name in one)


class TestWithoutTangent:
    @pytest.mark.parametrize("case", ["contact_em hertz", "contact_em penalty", "contact_em yielding", "line_point"])
    def test_all_else_is_the_same(self, case):
        kernel, own, shared = CASES[case]
        whole, rest = kernel(**own, **shared), kernel(**own, **shared, tangent=False)
        assert rest.K.shape == (N, 0, 0)
        assert all(np.array_equal(a, b) for a, b in zip(whole[1:], rest[1:], strict=True))

    def test_of_the_random_pairs_of_all_laws(self):
        for seed in range(12):
            pair = Pair(seed)
            whole, rest = pair.evaluate(), pair.evaluate(tangent=False)
            assert rest.K.shape == (0, 0)
            assert all(np.array_equal(a, b) for a, b in zip(whole[1:], rest[1:], strict=True))

    def test_of_beams(self):
        kernel, own, shared = CASES["beam_b31"]
        whole, rest = kernel(**own, **shared), kernel(**own, **shared, tangent=False)
        assert rest.K.shape == (N, 0, 0)
        assert all(np.array_equal(a, b) for a, b in zip(whole[1:], rest[1:], strict=True))


class TestWhatIsRefused:
    """The message names the first of many."""

    def refuse(self, words, case="contact_em hertz", **changes):
        kernel, own, shared = CASES[case]
        with pytest.raises(ValueError, match=words):
            kernel(**own | changes, **shared)

    def test_a_number_of_one_of_many(self):
        radius = CASES["contact_em hertz"][1]["radius"].copy()
        radius[4, 1] = -1.0
        self.refuse(r"radius\[4\] must be greater than 0, but holds -1", radius=radius)
        radius[2, 0] = math.nan
        self.refuse(r"radius\[2\] must be finite, but holds nan", radius=radius)

    def test_a_tangent_that_is_not_of_unit_length(self):
        t = CASES["contact_em hertz"][1]["t"].copy()
        t[3, 2] *= 1.1
        self.refuse(r"t\[3, 2\] must have unit length", t=t)

    def test_a_pair_that_overlaps_where_it_is_parallel(self):
        x, t = (CASES["contact_em hertz"][1][name].copy() for name in "xt")
        x[5] = [[-1e-2, 0, 1.9e-3], [1e-2, 0, 1.9e-3], [-1e-2, 0, 0], [1e-2, 0, 0]]
        t[5] = [1, 0, 0]
        self.refuse("pair 5: the wires overlap where their axes are parallel", x=x, t=t)
        places = np.reshape([0, 1, 2, 5], (2, 2))
        kernel, own, shared = CASES["contact_em hertz"]
        with pytest.raises(ValueError, match="pair 1, 1: the wires overlap"):
            kernel(**{name: value[places] for name, value in (own | dict(x=x, t=t)).items()}, **shared)

    def test_one_number_for_each_pair_is_told_from_one_for_each_wire(self):
        self.refuse(
            r"radius must have shape \(2,\), barred and unbarred, not \(7,\).*last axis of 1", radius=np.ones(N)
        )
        kernel, own, shared = CASES["contact_em hertz"]
        radius = np.linspace(1e-3, 1.1e-3, N)
        one = kernel(**own | dict(radius=radius[:, None]), **shared)
        both = kernel(**own | dict(radius=np.stack([radius, radius], axis=1)), **shared)
        assert np.array_equal(one.K, both.K)

    def test_a_spot_of_one_of_many(self):
        self.refuse(r"angle\[2\] must be between 0 and pi", "contact_spot", angle=np.array([1, 1, 4, 1, 1, 1, 1.0]))
        self.refuse(
            "contact 3: hardness must be greater", "contact_spot yielding", hardness=np.array([1e9] * 3 + [1e8] * 4)
        )

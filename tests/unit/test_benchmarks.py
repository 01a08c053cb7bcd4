"""What the benchmarks share."""

import importlib

import numpy as np
import pytest
from verification.performance import accuracy, factorisation, growth, networks, page, pile, process
from verification.performance.lattice import lattice
from verification.performance.run import BENCHMARKS


@pytest.mark.parametrize("name", BENCHMARKS)
def test_a_benchmark_says_what_it_measures(name):
    module = importlib.import_module(f"verification.performance.{name}")
    title, empty, text = module.__doc__.split("\n", 2)
    assert title
    assert not empty
    assert text
    assert all(callable(getattr(module, part)) for part in ("measure", "tables", "aims", "draw"))


def test_the_exponent_of_a_power_is_found():
    sizes = np.array([10.0, 100.0, 3000.0])
    assert growth.exponent(sizes, 5 * sizes**1.3) == pytest.approx(1.3)
    assert growth.exponent([7], [1.0]) is None


def test_the_table_of_times_is_read():
    printed = "head\nphase seconds\nsearch 1.5 10 %\nfactor 2 20 %\ntotal 3.5\nmore\n"
    assert process.timing_table(printed) == {"search": 1.5, "factor": 2.0, "total": 3.5}
    with pytest.raises(ValueError, match="no total"):
        process.timing_table("phase seconds\nsearch 1.5\n")


def test_the_stiffness_of_struts_is_that_of_a_free_body_and_of_a_cantilever():
    along = np.array([[0.3, -0.4, 1.2], [1.3, 0.0, 0.0]])
    for k, vector in zip(factorisation.strut_stiffness(along), along, strict=True):
        length = np.linalg.norm(vector)
        # rigid translations and rotations about the first end cost nothing
        for axis in np.eye(3):
            turn = np.concatenate([np.zeros(3), axis, np.cross(axis, vector), axis])
            assert abs(k @ np.concatenate([axis, np.zeros(3)] * 2)).max() < 1e-12 * abs(k).max()
            assert abs(k @ turn).max() < 1e-12 * abs(k).max()
        across = np.cross(vector, [0.1, 0.7, 0.2])
        across /= np.linalg.norm(across)
        deflection = np.linalg.solve(k[6:, 6:], np.concatenate([across, np.zeros(3)]))[:3] @ across
        second = np.pi * factorisation.RADIUS**4 / 4
        assert deflection == pytest.approx(length**3 / (3 * factorisation.YOUNG * second), rel=1e-9)


def test_the_stiffness_of_the_lattice_is_symmetric_and_over_its_free_unknowns():
    matrix, elements = factorisation.lattice_stiffness(200)
    nodes, connectivity, height = lattice(200)
    assert elements == len(connectivity)
    assert matrix.shape[0] == 6 * np.count_nonzero((nodes[:, 2] > 0) & (nodes[:, 2] < height))
    assert abs(matrix - matrix.T).max() < 1e-12 * abs(matrix).max()
    assert np.linalg.eigvalsh(matrix.toarray()).min() > 0


def test_the_pile_of_the_other_programs_has_a_node_of_both_fibres_at_each_crossing(tmp_path):
    model, penalty = pile.pile(8)
    pile.write_problem(tmp_path / "pile.npz", model, penalty, 1e-7)
    with np.load(tmp_path / "pile.npz") as problem:
        nodes, links, gap = problem["nodes"], problem["links"], problem["gap"]
        assert len(links) == len(pile.crossings(model)) > 100
        apart = nodes[links[:, 1]] - nodes[links[:, 0]]
        assert abs(apart[:, :2]).max() < 1e-9
        assert np.allclose(apart[:, 2], gap + 2 * pile.RADIUS, atol=1e-12)
        lengths = np.linalg.norm(np.diff(nodes[problem["elements"]], axis=1), axis=2)
        assert lengths.sum() == pytest.approx(
            np.linalg.norm(np.diff(model.x[model.connectivity], axis=1), axis=2).sum()
        )


def test_litz_is_compared_at_the_fewest_elements_with_which_it_is_as_accurate_as_the_other_program():
    def run(program, per_strut, deviation, seconds):
        return {"program": program, "per_strut": per_strut, "deviation": deviation, "seconds": seconds}

    runs = [
        run("litz", 1, 2e-3, 0.1),
        run("litz", 2, 4e-4, 0.2),
        run("litz", 4, 1e-5, 0.4),
        run("OpenSeesPy Mumps", 4, 4e-3, 1.0),
        run("OpenSeesPy UmfPack", 8, 9e-4, 5.0),
        run("OpenSeesPy Mumps", 8, 9e-4, 4.0),
    ]
    assert [found["seconds"] for found in accuracy.compared(runs)] == [0.2, 4.0]
    assert accuracy.compared(runs[:3]) == (None, None)
    found = accuracy.aims({"sizes": [{"size": 1000, "runs": runs}]})
    assert [value for _, value, _ in found] == [4e-4, pytest.approx(0.05)]


@pytest.mark.parametrize(("elements", "bounds"), [(10368, (1 / 8, 1 / 12)), (98496, (1 / 4, 1 / 6))])
def test_the_targets_beside_open_sees_are_those_of_the_size(elements, bounds):
    ours = {"elements": elements}
    other = {"program": "OpenSeesPy", "seconds_per_iteration": 1.0, "iteration_ratio": 5.0, "time_ratio": 9.0}
    row = ours | {"others": [other | {"memory": 1.0, "memory_ratio": 2.0}]}
    found = networks.aims({"sizes": [row]})
    assert [bound for *_, bound in found] == [*bounds, 1.0]
    assert [value for _, value, _ in found] == [pytest.approx(value) for value in (1 / 5, 1 / 9, 1 / 2)]


def test_a_lattice_has_the_same_joints_with_any_number_of_elements_per_strut(tmp_path):
    (coarse, two, _), (fine, eight, _) = lattice(200), lattice(800, per_strut=8)
    assert len(eight) == 4 * len(two)
    joints = len(coarse) - len(two) // 2
    np.testing.assert_array_equal(coarse[:joints], fine[:joints])
    networks.write_problem(tmp_path / "fine.npz", 800, 1e-7, per_strut=8)
    with np.load(tmp_path / "fine.npz") as problem:
        assert (np.bincount(problem["wire"]) == 8).all()


def test_a_benchmark_that_failed_is_on_the_page(tmp_path):
    machine = {"time": "now", "processor": "any", "cores": 2}
    record = {
        "failure": "RuntimeError: no <network>",
        "load_average": [1, 2],
        "seconds": 3.0,
        "quick": True,
        "machine": machine,
    }
    page.write_page({"program": "litz", "benchmarks": {"search": record}}, tmp_path)
    assert "Failed: RuntimeError: no &lt;network&gt;" in (tmp_path / "bench.html").read_text(encoding="utf-8")
    assert "Failed: RuntimeError: no <network>" in (tmp_path / "bench.md").read_text(encoding="utf-8")

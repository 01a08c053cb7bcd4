"""Generated models: what was asked for is there, wires do not overlap, the program accepts the decks."""

import functools
import itertools
import math

import numpy as np
import pytest

from litz import build, closed_forms
from litz.build.geometry import end_distance, segment_distance
from litz.model import COPPER, STEEL
from litz.wires.chains import find_wires
from litz.wires.curves import element_curves, hermite

MODELS = {
    "layered mat": lambda seed=3: build.fibre_mat((10e-3, 8e-3), 5, radius=0.1e-3, seed=seed, n_layers=3),
    "isotropic mat": lambda seed=3: build.fibre_mat(
        (5e-3, 5e-3, 3e-3), 40, radius=0.1e-3, seed=seed, orientation="isotropic", n_elements=4
    ),
    "grid": lambda: build.wire_grid(3, 4, pitch=5e-3, radius=0.5e-3, clearance=1e-5),
    "fabric": lambda: build.woven_fabric(4, 5, pitch=1e-3, radius=0.1e-3),
    "strand": lambda: build.strand(
        [1, 6, 12],
        radius=0.1e-3,
        lay_length=[6e-3, -9e-3],
        length=6e-3,
        clearance=2e-6,
        enlarge=True,
        elements_per_lay=16,
    ),
    "film": lambda seed=3: build.nanowire_film((10e-6, 5e-6), 50, length=5e-6, radius=30e-9, seed=seed, n_elements=4),
    "draped film": lambda seed=3: build.nanowire_film(
        (8e-6, 6e-6), 14, length=6e-6, radius=30e-9, seed=seed, reach=0.6e-6
    ),
    "deposited mat": lambda seed=3: build.fibre_mat(
        (1e-3, 1e-3), 14, radius=10e-6, seed=seed, orientation="deposited", length=1e-3
    ),
}
RANDOM = ["layered mat", "isotropic mat", "film", "draped film", "deposited mat"]


def wires_of(model):
    """Nodal positions of each wire."""
    return [model.x[np.array(wire.nodes) - 1] for group in model.groups.values() for wire in group.wires]


def smooth(x, parts=8):
    """Points of the smooth axis through the nodes of a wire."""
    elements = np.column_stack([np.arange(len(x) - 1), np.arange(1, len(x))])
    still = np.zeros_like(x)
    positions, slopes = element_curves(x, still, still, find_wires(elements), len(elements))
    along = [hermite(positions, slopes, np.full(len(elements), xi)) for xi in np.linspace(-1, 1, parts + 1)[:-1]]
    return np.vstack([np.stack(along, axis=1).reshape(-1, 3), x[-1]])


@functools.cache
def brute_force_gap(name):
    """Smallest distance of the surfaces of any two wires of a model, their axes taken as fine polygons."""
    model = MODELS[name]()
    radius = np.array([group.radius for group in model.groups.values() for _ in group.wires])
    smallest = math.inf
    for (i, first), (j, second) in itertools.combinations(enumerate(map(smooth, wires_of(model))), 2):
        a, c = np.indices((len(first) - 1, len(second) - 1)).reshape(2, -1)
        distance = segment_distance(first[a], first[a + 1], second[c], second[c + 1]).min()
        smallest = min(smallest, distance - radius[i] - radius[j])
    return smallest


def test_distance_of_segments():
    # crossing, end to side, end to end, parallel side by side
    a = [[-1, 0, 0], [-1, 0, 0], [-1, 0, 0], [0, 0, 0]]
    b = [[1, 0, 0], [1, 0, 0], [1, 0, 0], [2, 0, 0]]
    c = [[0, -1, 0.5], [0, 0.25, 0], [4, 4, 0], [1, 0.125, 0]]
    d = [[0, 1, 0.5], [0, 9, 0], [4, 9, 0], [7, 0.125, 0]]
    np.testing.assert_allclose(segment_distance(a, b, c, d), [0.5, 0.25, 5.0, 0.125], rtol=1e-15)


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
def test_no_two_wires_overlap(name):
    assert brute_force_gap(name) > 0


@pytest.mark.parametrize("name", ["layered mat", "grid", "film"])
def test_smallest_gap_is_that_of_all_pairs(name):
    # straight wires, so that polygon and smooth axis are the same
    assert build.smallest_gap(MODELS[name]()) == pytest.approx(brute_force_gap(name), rel=1e-9)


@pytest.mark.parametrize("name", RANDOM)
def test_the_seed_makes_the_model(name):
    assert MODELS[name](seed=5).to_deck() == MODELS[name](seed=5).to_deck()
    assert MODELS[name](seed=5).to_deck() != MODELS[name](seed=6).to_deck()


@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("mesh_file", [False, True])
def test_the_program_accepts_the_deck(name, mesh_file, litz, tmp_path):
    model = MODELS[name]()
    model.press(1e-9, voltage=1e-3)
    done = litz("check", model.write(tmp_path / "model.inp", mesh_file=mesh_file))
    assert done.returncode == 0, done.stderr
    n_wires = sum(len(group.wires) for group in model.groups.values())
    assert f"{len(model.x)} nodes, {len(model.connectivity)} elements" in done.stdout
    assert f"wires (chains of elements): {n_wires}" in done.stdout


@pytest.mark.parametrize("name", MODELS)
def test_conductors_are_pressed_without_a_voltage(name, litz, tmp_path):
    model = MODELS[name]()
    model.press(1e-9)
    assert model.to_deck().count(" MINUS, 9\n") == 1
    done = litz("check", model.write(tmp_path / "model.inp"))
    assert done.returncode == 0, done.stderr


def test_what_else_prescribes_potentials_or_currents_grounds_the_model_itself():
    def deck(*, fix=None, step=None, material=COPPER):
        model = build.strand([1, 6], radius=[0.52e-3, 0.5e-3], lay_length=45e-3, length=12e-3, material=material)
        if fix:
            model.fix("PLUS", fix)
        pressed = model.press(-1e-6)
        if step:
            step(pressed)
        return model.to_deck()

    ground = "MINUS, 9\n"
    assert ground in deck()
    assert ground not in deck(material=STEEL)
    assert ground not in deck(fix="potential")
    assert ground not in deck(step=lambda step: step.potential("PLUS", 1e-3))
    assert ground not in deck(step=lambda step: step.current("PLUS", 1.0))
    assert ground not in deck(step=lambda step: step.card("BOUNDARY", {}, [["PLUS", 9, 9, 1e-3]]))


def test_text_and_mesh_file_give_the_same_run(litz, tmp_path):
    model = build.woven_fabric(3, 3, pitch=1e-3, radius=0.1e-3)
    model.press(10e-6, voltage=1e-3)
    ledgers = []
    for mesh_file in (False, True):
        directory = tmp_path / str(mesh_file)
        done = litz("run", model.write(tmp_path / "model.inp", mesh_file=mesh_file), "-o", directory)
        assert done.returncode == 0, done.stderr
        ledgers.append((directory / "model_contacts.csv").read_text())
    assert len(ledgers[0].splitlines()) > 100
    assert ledgers[0] == ledgers[1]


def test_layers_of_a_mat_lie_at_their_heights_and_turn():
    model = MODELS["layered mat"]()
    assert [len(group.wires) for group in model.groups.values()] == [6, 6, 5, 5, 5]
    for number in (1, 2, 3):
        for wire in model.groups[f"LAYER{number}"].wires:
            x = model.x[np.array(wire.nodes) - 1]
            # the bar below, then layers of two radii and a gap of a tenth of the radius each
            assert x[:, 2] == pytest.approx(number * 2.1e-4, rel=1e-6)
            along = np.abs(x[-1] - x[0]) / np.linalg.norm(x[-1] - x[0])
            assert along[(number + 1) % 2] < math.sin(math.radians(30)) + 1e-6


def test_isotropic_fibres_have_all_directions():
    model = build.fibre_mat(
        (1.0, 1.0, 1.0), 400, radius=1e-4, seed=1, orientation="isotropic", n_elements=1, overlap=True
    )
    along = np.array([x[-1] - x[0] for x in wires_of(model)])
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    # the mean of n n^T of uniform directions is 1/3; its standard deviation is sqrt(4/45/400) = 0.015. Lines that cut a
    # corner are left out, which favours no axis of a cube.
    np.testing.assert_allclose(np.einsum("ki,kj->ij", along, along) / 400, np.eye(3) / 3, atol=4 * 0.015)


@pytest.mark.slow
def test_overlapping_fibres_where_they_are_asked_for():
    arguments = {"size": (5e-3, 5e-3, 3e-3), "n_fibres": 15, "radius": 0.6e-3, "seed": 1, "orientation": "isotropic"}
    with pytest.raises(ValueError, match=r"only \d+ of 15 fibres fit"):
        build.fibre_mat(**arguments)
    model = build.fibre_mat(**arguments, overlap=True)
    assert len(model.groups["FIBRES"].wires) == 15
    assert build.smallest_gap(model) < 0
    assert "INTERFERENCE FIT" in model.to_deck()


def test_grid_has_its_pitch():
    model = build.wire_grid(3, 4, pitch=5e-3, radius=0.5e-3)
    lower = [x for x in wires_of(model) if np.ptp(x[:, 0]) > 0]
    upper = [x for x in wires_of(model) if np.ptp(x[:, 1]) > 0]
    assert [x[0, 1] for x in lower] == pytest.approx([2.5e-3, 7.5e-3, 12.5e-3])
    assert [x[0, 0] for x in upper] == pytest.approx([2.5e-3, 7.5e-3, 12.5e-3, 17.5e-3])
    assert all(np.ptp(x[:, 0]) == pytest.approx(20e-3) for x in lower)
    assert build.smallest_gap(model) == pytest.approx(0, abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(("n_x", "n_y"), [(3, 4), (12, 12)])
def test_all_crossings_of_a_pressed_grid_have_the_force_of_clamped_spans(n_x, n_y, tmp_path):
    """By symmetry no wire turns at its supports: spans of a pitch, loaded in their middles."""
    pitch, radius, push = 10e-3, 0.5e-3, 20e-6
    model = build.wire_grid(n_x, n_y, pitch=pitch, radius=radius)
    model.press(push, voltage=1e-3, increment=0.5)
    results = model.run(tmp_path / "grid")
    bending = 192 * build.COPPER.young * math.pi * radius**4 / 4 / pitch**3
    wires = {"radius": radius, "young": build.COPPER.young, "poisson": build.COPPER.poisson, "angle": math.pi / 2}
    low, high = 0.0, push * bending / 2
    for _ in range(60):
        force = (low + high) / 2
        approach = closed_forms.hertz_contact(force, **wires, resistivity=1.0).approach
        low, high = (force, high) if 2 * force / bending + approach < push else (low, force)
    contacts = results.contacts_at(-1)
    assert contacts.n_rows == n_x * n_y
    # spans that bend by 2e-3 of their length get longer, which pulls at them
    np.testing.assert_allclose(contacts["force"], force, rtol=2e-4)
    assert not results.warnings


def test_yarns_of_a_fabric_go_over_and_under():
    model = build.woven_fabric(4, 5, pitch=1e-3, radius=0.1e-3, clearance=4e-6, plates=False)
    heights = {}
    for name in ("WARP", "WEFT"):
        for number, wire in enumerate(model.groups[name].wires):
            x = smooth(model.x[np.array(wire.nodes) - 1])
            # four elements per pitch in eight parts each, a half element at the start: crossings after 20, 52, ... parts
            for crossing, height in enumerate(x[20::32, 2]):
                heights[name, number, crossing] = height
    for warp, weft in itertools.product(range(4), range(5)):
        over = 1 if (warp + weft) % 2 == 0 else -1
        assert heights["WARP", warp, weft] - heights["WEFT", weft, warp] == pytest.approx(over * 2.04e-4, rel=1e-5)


def test_yarns_that_would_touch_beside_the_crossings_are_refused():
    with pytest.raises(ValueError, match="pitch must be at least"):
        build.woven_fabric(4, 4, pitch=0.4e-3, radius=0.1e-3)


@pytest.mark.slow
def test_a_run_of_a_strand_says_nothing_of_its_lines(litz, tmp_path):
    model = MODELS["strand"]()
    model.press(1e-9, voltage=1e-3)
    deck = model.write(tmp_path / "strand.inp")
    for command in (["check", deck], ["run", deck, "-o", tmp_path]):
        done = litz(*command)
        assert (done.returncode, done.stderr) == (0, "")


def test_a_run_of_a_grid_says_nothing_about_line_contact(litz, tmp_path):
    model = MODELS["grid"]()
    model.press(1e-6, voltage=1e-3)
    assert "side by side" not in litz("check", model.write(tmp_path / "grid.inp")).stderr


def test_wires_of_a_film_lie_on_those_they_cross():
    model = MODELS["film"]()
    wires = wires_of(model)
    assert len(wires) == 50
    heights = np.array([x[0, 2] for x in wires])
    assert all(np.ptp(x[:, 2]) == 0 for x in wires)
    pitch = 2.01 * 30e-9
    for i, (x, height) in enumerate(zip(wires, heights, strict=True)):
        flat = [y * [1, 1, 0] for y in wires[:i]]
        crossed = [
            heights[j]
            for j, y in enumerate(flat)
            if segment_distance(*([end * [1, 1, 0]] for end in (x[0], x[-1])), [y[0]], [y[-1]])[0] < pitch
        ]
        assert height == pytest.approx(max(crossed) + pitch if crossed else 0, abs=1e-6 * pitch)
    for name, wall in (("MINUS", 0.0), ("PLUS", 10e-6)):
        assert model.x[np.array(model.node_sets[name]) - 1, 0] == pytest.approx(wall, abs=1e-12)


def test_no_end_of_a_wire_of_a_film_lies_on_another():
    ends = np.array([x[[0, -1], :2] for x in wires_of(MODELS["film"]())])
    for i, wire in enumerate(ends[1:], start=1):
        first, second = (np.broadcast_to(end, (i, 2)) for end in wire)
        assert end_distance(first, second, ends[:i, 0], ends[:i, 1]).min() > 3.9 * 30e-9


@pytest.mark.parametrize("name", ["layered mat", "isotropic mat", "film", "fabric"])
def test_a_model_is_pressed_by_less_than_its_height(name):
    model = MODELS[name]()
    heights = [model.x[np.array(model.nodes_of(target)) - 1, 2].mean() for target in model.guides]
    assert model.height == pytest.approx(np.ptp(heights), rel=1e-4)
    with pytest.raises(ValueError, match="upside down: press by less than its height"):
        model.press(1.01 * model.height)
    assert not model.steps
    model.press(model.height)
    assert min(one.value for one in model.steps[-1].prescribed) == -model.height


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: build.fibre_mat((1, 1), 3, radius=0, seed=1), "positive radius"),
        (lambda: build.fibre_mat((1, 1, 1), 3, radius=1e-3, seed=1), "x and y"),
        (lambda: build.fibre_mat((1, 1), 3, radius=1e-3, seed=1, orientation="felt"), "layered"),
        (lambda: build.fibre_mat((1, 1), 3, radius=1e-3, seed=1, spread=1.0), "spread"),
        (lambda: build.fibre_mat((1, 1), 20, radius=3e-2, seed=1), r"of 20 fibres fit"),
        (lambda: build.fibre_mat(1e-2, 9, radius=1e-4, seed=1), "a mat, layered: its lengths along x and y"),
        (lambda: build.fibre_mat((1, 1), 9, radius=1e-4, seed=1, orientation="isotropic"), "along x, y and z"),
        (lambda: build.nanowire_film((1,), 9, length=1e-5, radius=3e-8, seed=1), "a film: its lengths along x and y"),
        (
            lambda: build.cable([3, 3], radius=4e-4, lay_lengths=[2e-2, 4e-2], length=1e-2),
            "counts of the layers of each",
        ),
        (lambda: build.wire_grid(2, 2, pitch=1e-3, radius=1e-3), "pitch"),
        (lambda: build.wire_grid(2, 2, pitch=1e-2, radius=1e-3, supports="all"), 'must be "between" or "ends"'),
        (lambda: build.nanowire_film((1, 1), 2, length=1e-2, radius=1e-3, seed=1), "electrodes"),
    ],
)
def test_what_cannot_be_built_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()

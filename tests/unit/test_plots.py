"""Pictures: they are made for every kind, show what the results hold, and survive a machine without OpenGL."""

import stat
import warnings
from types import SimpleNamespace

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread

import litz
from litz.base.quantities import engineering, label
from litz.base.table import Table
from litz.pictures import charts, drawing_process, friction_charts, plots, residual_charts
from litz.pictures.chart_tools import wire_names
from litz.pictures.contact_marks import Spots
from litz.pictures.margins import arrange
from litz.pictures.scene import SceneMaker, aim
from litz.pictures.tube_mesh import tubes
from litz.results.contact_history import contacts_over_time

KINDS = (
    "overview", "wires", "resistance", "residuals", "contacts", "lines", "currents", "shares", "section", "network",
    "friction", "surfaces", "history",
)  # fmt: skip


def coloured(picture):
    """Pixels that are neither white nor grey, (n, 3)."""
    pixels = picture[..., :3].reshape(-1, 3)
    return pixels[np.ptp(pixels, axis=1) > 0.15]


def near(pixels, colour, distance=0.15):
    """Number of pixels of about the hue of a colour, whatever light falls on them."""
    direction = np.array(mpl.colors.to_rgb(colour)) / np.linalg.norm(mpl.colors.to_rgb(colour))
    cosine = pixels @ direction / np.linalg.norm(pixels, axis=1)
    return np.count_nonzero(cosine > np.cos(distance))


def orange(pixels):
    """Number of pixels in the colour of the contact spots."""
    return np.count_nonzero((pixels[:, 0] > 0.8) & (pixels[:, 1] < 0.65) & (pixels[:, 2] < 0.55))


@pytest.fixture
def without_opengl(monkeypatch, tmp_path):
    """Where VTK would draw, a program ends by the signal that VTK without OpenGL ends by."""
    program = tmp_path / "crash"
    program.write_text("#!/bin/sh\nkill -SEGV $$\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setattr(drawing_process.sys, "executable", str(program))


@pytest.fixture(scope="module")
def picture_of(written, tmp_path_factory):
    """`picture_of("wires")` is the picture of this kind, which is drawn once."""
    folder, pictures = tmp_path_factory.mktemp("pictures"), {}

    def draw(kind):
        if kind not in pictures:
            with warnings.catch_warnings():
                # on a machine without OpenGL the picture is drawn without it, and says so
                warnings.filterwarnings("ignore", message=".*drawn with matplotlib only")
                path = litz.plot(litz.Results(written / "crossed.vtkhdf"), kind, folder / f"{kind}.png")
            pictures[kind] = imread(path)
        return pictures[kind]

    return draw


class TestPictures:
    # these wires cross: tests/system/test_zones.py draws contact along lines, test_surface_results.py rigid surfaces,
    # test_along_cable.py what a cable has
    @pytest.mark.parametrize("kind", [kind for kind in KINDS if kind not in ("lines", "surfaces", "shares", "section")])
    @pytest.mark.slow
    def test_every_kind_makes_a_picture_with_something_on_it(self, picture_of, kind):
        picture = picture_of(kind)
        assert picture.shape[0] > 500
        assert picture.shape[1] > 900
        assert len(coloured(picture)) > 1e-3 * picture.shape[0] * picture.shape[1]

    def test_the_wires_have_the_colours_of_the_whole_scale_and_a_spot(self, picture_of):
        picture = picture_of("wires")
        # above the colour bar
        above = coloured(picture[: int(0.85 * len(picture))])
        for part in (0.0, 0.25, 0.5, 0.75, 1.0):
            assert near(above, mpl.colormaps["viridis"](part)) > 50
        assert orange(above) > 20

    def test_without_opengl_matplotlib_draws_the_wires_and_a_warning_says_so(self, results, tmp_path, without_opengl):
        with pytest.warns(UserWarning, match="VTK ended by signal 11.*drawn with matplotlib only"):
            picture = imread(litz.plot(results, "wires", tmp_path / "picture.png"))
        above = coloured(picture[: int(0.85 * len(picture))])
        for part in (0.0, 0.25, 0.5, 0.75, 1.0):
            assert near(above, mpl.colormaps["viridis"](part)) > 50
        assert orange(above) > 20

    def test_the_picture_goes_beside_the_results_by_default(self, writer, tmp_path):
        import subprocess

        subprocess.run([writer, tmp_path], check=True)
        assert litz.plot(tmp_path / "crossed", "residuals") == tmp_path / "crossed_residuals.png"
        assert (tmp_path / "crossed_residuals.png").stat().st_size > 10_000

    def test_vector_formats(self, results, tmp_path):
        assert litz.plot(results, "residuals", tmp_path / "picture.pdf").read_bytes().startswith(b"%PDF")

    def test_wrong_arguments_are_answered_in_words(self, results):
        with pytest.raises(ValueError, match="did you mean 'residuals'"):
            litz.plot(results, "residual")
        with pytest.raises(ValueError, match='may be "current", "force" or "none"'):
            litz.plot(results, "wires", spots="voltage")
        with pytest.raises(KeyError, match="did you mean 'potential'"):
            litz.plot(results, "wires", field="potentials")

    def test_every_kind_is_documented(self):
        assert set(plots.KINDS) == set(plots._DRAWERS) == set(KINDS)
        for kind in KINDS:
            assert f'"{kind}"' in litz.plot.__doc__


class TestScene:
    def test_colours_are_the_field_along_the_wires(self, results):
        scene = SceneMaker(results, [0]).scene(0)
        assert scene.title == "potential [V]"
        assert scene.limits == (1, 6)
        np.testing.assert_array_equal(scene.value[[0, scene.starts[1] - 1, scene.starts[1], -1]], [1, 3, 4, 6])

    def test_points_run_through_the_current_nodes(self, results):
        scene = SceneMaker(results, [-1]).scene(-1)
        current = results.positions(-1)
        ends = [0, scene.starts[1] - 1, scene.starts[1], -1]
        np.testing.assert_allclose(scene.points[ends], current[[0, 2, 3, 5]], atol=1e-14)
        np.testing.assert_allclose(scene.reference[ends], results.nodes[[0, 2, 3, 5]], atol=1e-14)

    def test_displacements_are_scaled(self, results):
        scene = SceneMaker(results, [-1], scale=10.0).scene(-1)
        np.testing.assert_allclose(scene.points[0], results.nodes[0] + 10 * results.field("displacement")[0])

    def test_a_vector_field_is_shown_by_its_length_in_a_readable_unit(self, results):
        scene = SceneMaker(results, [-1], "displacement").scene(-1)
        assert scene.title == "displacement, magnitude [mm]"
        assert scene.limits[1] == pytest.approx(1e3 * np.linalg.norm(results.field("displacement"), axis=1).max())

    def test_spots_by_force(self, results):
        scene = SceneMaker(results, [1], spots="force").scene(1)
        assert scene.spot_text.startswith("2 contacts: disc area proportional to force")
        assert "maximum 20 N" in scene.spot_text
        assert len(SceneMaker(results, [1], spots="none").scene(1).spot_radius) == 0

    def test_contacts_with_a_round_off_current_have_no_discs(self, results, monkeypatch):
        ledger = results.contacts_at(1)
        current = ledger["current"] * [1, 1e-12]
        monkeypatch.setattr(
            results, "written_contacts_at", lambda _: Table({**ledger, "current": current}, ledger.units)
        )
        scene = SceneMaker(results, [1], spots="current").scene(1)
        assert len(scene.spot_radius) == 1
        assert scene.spot_text.startswith("1 contact: disc area proportional to current")
        assert scene.spot_text.endswith("(1 without current)")

    def test_tubes_end_in_half_spheres(self):
        points = np.array([[0.0, 0, 0], [0, 0, 5], [1, 0, 0], [3, 0, 0], [7, 0, 0]])
        mesh = tubes(points, np.array([0, 2, 5]), np.array([0.5, 0.5, 0.25, 0.25, 0.25]), 12)
        for rows, r in (((0, 1), 0.5), ((2, 3, 4), 0.25)):
            first, last = points[rows[0]], points[rows[-1]]
            corners = mesh.points[np.isin(mesh.source, rows)]
            length = np.linalg.norm(last - first)
            along = (corners - first) @ (last - first) / length
            nearest = first + np.clip(along, 0, length)[:, None] * (last - first) / length
            np.testing.assert_allclose(np.linalg.norm(corners - nearest, axis=1), r)
            assert along.min() == pytest.approx(-r)
            assert along.max() == pytest.approx(length + r)

    def test_a_tube_is_smooth_along_a_curve_in_space_and_round_at_a_kink(self):
        """Every corner is a radius away from the axis, along its normal; no side of the tube turns about a curved axis."""
        t = np.linspace(0, 4 * np.pi, 200)
        helix = np.stack([np.cos(t), np.sin(t), 0.3 * t], axis=1)
        kinked = np.array([[5.0, 0, 0], [6, 0, 0], [6, 1, 0]])
        points = np.concatenate([helix, kinked])
        mesh = tubes(points, np.array([0, 200, 203]), np.full(203, 0.1), 16)
        outward = mesh.points - points[mesh.source]
        np.testing.assert_allclose(outward, 0.1 * mesh.normals, atol=1e-12)
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1.0)
        edges = np.linalg.norm(mesh.points[mesh.triangles[::2, 0]] - mesh.points[mesh.triangles[::2, 1]], axis=1)
        assert edges.max() <= 2 * 0.1 * np.sin(np.pi / 16) * (1 + 1e-9)
        # a corner and the one behind it on the next ring: their normals turn with the axis only
        turned = mesh.normals[mesh.triangles[1::2, 0]] - mesh.normals[mesh.triangles[1::2, 2]]
        assert np.linalg.norm(turned, axis=1).max() < 0.35
        # the joint at the kink is a ball: its corners surround the node on all sides but those inside the two legs
        ball = mesh.normals[mesh.source == 201]
        outside = np.array([1, -1, 0]) / np.sqrt(2)
        assert np.min(ball @ outside) < -0.6
        # at 45 degrees of latitude, between rings at 36 and 54, and half a side of the ring at 36 away
        assert np.max(ball @ outside) > np.cos(np.hypot(np.radians(9), np.cos(np.radians(36)) * np.pi / 16))

    def test_the_outside_of_a_tube_is_its_front(self):
        mesh = tubes(np.array([[0.0, 0, 0], [0, 0, 1], [0, 1, 2]]), np.array([0, 3]), np.full(3, 0.1), 8)
        a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        has_area = np.linalg.norm(normal, axis=1) > 1e-9
        facing = np.sum(normal * mesh.normals[mesh.triangles].sum(axis=1), axis=1)
        assert np.all(facing[has_area] > 0)

    def test_a_contact_behind_another_wire_is_hidden(self):
        """Three crossing layers, seen from above: the upper contact is before its wires, the lower one behind the top wire."""
        spots = Spots(
            places=np.array([[0.0, 0, 0], [0, 0, 2.0]]),
            normals=np.array([[0.0, 0, 1], [0, 0, -1]]),
            radii=np.ones((2, 2)),
            tangents=np.array([[[0.0, 1, 0], [1, 0, 0]], [[0.0, 1, 0], [1, 0, 0]]]),
        )
        # layers with their axes at -1, 1 and 3
        drawn = spots.places[:, 2] + 1.05 * spots.reach(np.array([0.0, 0, 1]), spots.radii)
        assert 2.0 < drawn[0] < 4.0 < drawn[1]

    @pytest.mark.parametrize("tilt", [0.0, 0.4, 0.9])
    def test_a_contact_is_before_the_two_wires_that_touch(self, tilt):
        """The front of the upper wire where lines of sight through the disc meet it, found from the equation of the cylinder."""
        toward = np.array([np.sin(tilt), 0.0, np.cos(tilt)])
        spots = Spots(np.zeros((1, 3)), np.array([[0.0, 0, 1]]), np.ones((1, 2)), np.array([[[1.0, 0, 0], [0, 1, 0]]]))
        reach = 1.05 * spots.reach(toward, spots.radii)[0]
        right, up = np.array([0.0, 1, 0]), np.cross(toward, [0.0, 1, 0])
        for a, b in np.random.default_rng(1).uniform(-0.6, 0.6, (50, 2)):
            start = a * right + b * up - np.array([0, 0, 1.0])
            flat, way = start[1:], toward[1:]
            roots = np.roots([way @ way, 2 * flat @ way, flat @ flat - 1])
            assert reach > np.max(roots.real[np.abs(roots.imag) < 1e-9], initial=-np.inf)

    def test_everything_is_inside_the_picture(self, results):
        scene = SceneMaker(results, [-1]).scene(-1)
        for view in (None, (1, 0, 0), (0, 0, 1), (1, 2, 3), (0, 0, -1)):
            camera = aim(np.concatenate([scene.points, scene.reference]), scene.radius.max(), 1.5, view)
            seen = camera.project(np.concatenate([scene.points, scene.reference]))
            assert np.abs(seen[:, 0]).max() < camera.half_width
            assert np.abs(seen[:, 1]).max() < camera.half_height
            frame = np.stack([camera.right, camera.up, camera.toward])
            np.testing.assert_allclose(frame @ frame.T, np.eye(3), atol=1e-14)
            assert np.linalg.det(frame) == pytest.approx(1)


class TestCharts:
    def test_residual_lines_hold_the_norms_and_the_allowed_values(self, results):
        axes = Figure().add_subplot()
        residual_charts.residual_lines(axes, results.convergence, "force")
        solid = [line for line in axes.lines if line.get_linestyle() == "-"]
        dashed = [line for line in axes.lines if line.get_linestyle() == "--"]
        assert len(solid) == len(dashed) == 3
        np.testing.assert_array_equal(solid[0].get_ydata(), [1e-2, 1e-4, 1e-8])
        np.testing.assert_array_equal(dashed[0].get_ydata(), [1e-7] * 3)
        assert axes.get_yscale() == "log"

    def test_the_resistance_chart_is_logarithmic_with_a_line_for_each_contact(self, results):
        axes = Figure().add_subplot()
        charts.resistance_over_force(axes, results, -1)
        assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
        lines = {line.get_label(): line for line in axes.lines}
        np.testing.assert_allclose(lines["contact 2"].get_xdata(), [20, 30])
        np.testing.assert_allclose(lines["contact 2"].get_ydata(), [1, 1])
        assert axes.get_ylabel() == "resistance [mΩ]"

    def test_the_way_back_of_a_contact_is_told_from_its_way_up(self, results):
        """A spot that keeps its size: loaded, let go by half, and loaded beyond."""
        force, resistance = np.array([1.0, 4.0, 2.0, 3.0, 4.0, 9.0]), np.array([6.0, 3.0, 3.5, 3.2, 3.0, 2.0])
        ledger = Table(
            {"id": np.ones(6, dtype=int), "force": force, "resistance": resistance, "angle": np.ones(6)},
            {"id": "", "force": "N", "resistance": "ohm", "angle": "rad"},
        )
        axes = Figure().add_subplot()
        charts.resistance_over_force(axes, SimpleNamespace(contacts=ledger, unit_labels=results.unit_labels), -1)
        up, way_back, below = axes.lines[:3]
        np.testing.assert_allclose(up.get_xydata(), np.stack([force, resistance], axis=1)[[0, 1, 4, 5]])
        np.testing.assert_allclose(way_back.get_xydata(), np.stack([force, resistance], axis=1)[[2, 3, 1]])
        np.testing.assert_allclose(below.get_xdata(), [2, 3])
        assert "below the largest force so far" in axes.get_legend_handles_labels()[1]
        # the slopes go through the middle of the way up
        slope = next(line for line in axes.lines if "Hertz" in line.get_label())
        there = np.interp(np.log([1, 4, 4, 9]).mean(), np.log(slope.get_xdata()), np.log(slope.get_ydata()))
        np.testing.assert_allclose(there, np.log([6, 3, 3, 2]).mean())

    @pytest.mark.parametrize("placed", [True, False])
    def test_a_legend_and_a_scale_of_colours_do_not_hide_each_other(self, results, placed):
        """Of many contacts, in axes of a grid, which are arranged later, and in axes at a place, as in an overview."""
        n = charts.MAX_LINES + 5
        columns = {"id": np.arange(n), "force": np.logspace(0, 2, n), "resistance": np.logspace(1, -1, n)}
        ledger = Table(
            columns | {"angle": np.linspace(0.5, 1.5, n)}, {"id": "", "force": "N", "resistance": "ohm", "angle": "rad"}
        )
        with mpl.rc_context(plots.STYLE):
            figure = Figure(figsize=(9, 4), dpi=100)
            axes = figure.add_axes((0.1, 0.2, 0.5, 0.7)) if placed else figure.add_subplot()
            charts.resistance_over_force(axes, SimpleNamespace(contacts=ledger, unit_labels=results.unit_labels), -1)
            arrange(figure)
        bar = next(one for one in figure.axes if one is not axes)
        legend = axes.get_legend().get_window_extent()
        assert not legend.overlaps(bar.get_window_extent())

    def test_the_number_of_contacts_is_zero_where_there_are_none(self, results):
        axes = Figure().add_subplot()
        charts.contact_number(axes, results, contacts_over_time(results, results.steps, results.increments))
        np.testing.assert_array_equal(axes.lines[0].get_ydata(), [0, 2, 1])

    def test_friction_that_is_round_off_is_none(self):
        for traction, acts in ((1e-13, False), (1e-6, True)):
            columns = {f"traction_{axis}": np.array([0.0, traction if axis == "y" else 0.0]) for axis in "xyz"}
            ledger = Table(columns | {"force": np.array([0.0, 0.9])}, {})
            assert friction_charts.has_friction(SimpleNamespace(contacts=ledger)) is acts

    def test_currents_are_counted_along_the_wire(self, results):
        axes = Figure().add_subplot()
        charts.current_per_wire(axes, results, -1)
        np.testing.assert_allclose([bar.get_height() for bar in axes.patches], [(9 + 18) / 2, (27 + 36) / 2])

    def test_bars_have_the_names_of_their_wires_where_there_is_room(self, results):
        names = wire_names(results, results.wires)
        for inches, expected in ((6.4, names), (0.1, None)):
            axes = Figure(figsize=(inches, 4)).add_subplot()
            charts.current_per_wire(axes, results, -1)
            assert ([text.get_text() for text in axes.get_xticklabels()] == expected) == (expected is not None)

    def test_the_history_has_a_chart_for_each_quantity(self):
        columns = {"time": "s", "RF1 node 1": "N", "RF2 node 1": "N", "N element 2": "N", "Q3 element 2": "N"}
        # in millimetres moments and energies have one unit; ALLWK is no moment
        columns |= {"M2 element 2": "N mm", "RM3 node 1": "N mm", "ALLWK": "N mm", "ETOTAL": "N mm"}
        table = Table({name: np.array([0.0, k + 1.0]) for k, name in enumerate(columns)}, columns)
        figure = Figure()
        charts.history(figure, SimpleNamespace(history=table, unit_labels={"s": "s"}), -1)
        shown = {axes.get_ylabel(): [line.get_label() for line in axes.lines] for axes in figure.axes}
        assert shown == {
            "RF [N]": ["RF1 node 1", "RF2 node 1"],
            "section force [N]": ["N element 2", "Q3 element 2"],
            "section moment [N mm]": ["M2 element 2"],
            "RM [N mm]": ["RM3 node 1"],
            "energy [N mm]": ["ALLWK", "ETOTAL"],
        }


class TestQuantities:
    @pytest.mark.parametrize(
        ("values", "unit", "expected"),
        [
            ([0.009], "V", (1e3, "mV")),
            ([1.0], "V", (1.0, "V")),
            ([-2500.0, 10.0], "N", (1e-3, "kN")),
            ([3e-5], "ohm", (1e6, "µΩ")),
            ([0.5], "s", (1.0, "s")),
            ([1e-4], "1", (1.0, "")),
            ([0.0], "A", (1.0, "A")),
            ([np.inf, np.nan, 2e-3], "ohm", (1e3, "mΩ")),
            ([1e30], "W", (1e-12, "TW")),
        ],
    )
    def test_prefixes(self, values, unit, expected):
        factor, symbol = engineering(np.array(values), unit)
        assert (factor, symbol) == (pytest.approx(expected[0]), expected[1])

    def test_labels(self):
        assert label("axial_force", "kN") == "axial force [kN]"
        assert label("semi_major", "") == "semi major"

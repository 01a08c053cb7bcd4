"""Pictures of real runs: what they show is what the results hold."""

import shutil
import sys
from types import SimpleNamespace

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.image import imread
from PIL import Image

import litz
from in_process import command
from litz.cli import main
from litz.pictures import animation, charts, plots, residual_charts
from litz.pictures.chart_tools import from_zero
from litz.pictures.friction_charts import friction_loops
from litz.pictures.scene import SceneMaker, aim
from litz.pictures.wire_picture import discs
from litz.reports import report_tables

pytestmark = pytest.mark.filterwarnings("ignore:.*drawn with matplotlib only")


@pytest.fixture
def grid(run_of_input):
    return litz.Results(run_of_input("04_wire_grid"))


@pytest.fixture
def friction(run_of_input):
    return litz.Results(run_of_input("13_stick_slip"))


class TestResiduals:
    def test_what_is_allowed_is_seen_where_there_is_one_iteration(self, run_of_input):
        """A linear problem has one."""
        axes = Figure().subplots()
        residual_charts.residual_lines(axes, litz.Results(run_of_input("20_hot_spot")).convergence, "current")
        dashed = [line for line in axes.get_lines() if line.get_linestyle() == "--"]
        single = [line for line in dashed if (line.get_ydata() > 0).sum() == 1]
        assert single
        assert all(line.get_marker() == "_" for line in single)


class TestFiles:
    def test_missing_directories_are_made_and_a_name_without_ending_is_png(self, grid, tmp_path):
        made = litz.plot(grid, "residuals", tmp_path / "a b" / "ü" / "residuals")
        assert made == tmp_path / "a b" / "ü" / "residuals.png"
        assert made.read_bytes().startswith(b"\x89PNG")

    @pytest.mark.parametrize("name", ["chart.jpg", "chart.PNG", "chart.svg", "chart.pdf"])
    def test_other_formats(self, grid, tmp_path, name):
        assert litz.plot(grid, "residuals", tmp_path / name).stat().st_size > 1000

    @pytest.mark.slow
    @pytest.mark.parametrize("command", ["plot", "report"])
    def test_what_cannot_be_written_is_said_in_a_line(self, grid, tmp_path, command, capsys):
        (tmp_path / "file").touch()
        target = tmp_path / "file" / "page"
        assert main([command, str(grid.path), "-o", str(target)]) == 4
        assert f"error: cannot write {target}" in capsys.readouterr().err


def not_white(picture):
    return np.count_nonzero(np.any(picture[..., :3] < 0.9, axis=2))


class TestSpots:
    def test_a_disc_for_each_contact_with_its_area_by_the_force(self, grid):
        scene = SceneMaker(grid, [-1], spots="force").scene(-1)
        assert len(scene.spot_radius) == 16
        force = grid.contacts_at(-1)["force"]
        large = scene.spot_radius > 0.2 * scene.spot_radius.max()
        np.testing.assert_allclose(
            scene.spot_radius[large] ** 2 / force[large], scene.spot_radius.max() ** 2 / force.max()
        )

    def test_a_disc_is_between_the_two_wires(self, grid):
        """Wires of equal radius: halfway between the points of the ledger, up to the overlap."""
        scene = SceneMaker(grid, [-1]).scene(-1)
        ledger = grid.contacts_at(-1)
        middle = np.stack([(ledger[f"point_1_{axis}"] + ledger[f"point_2_{axis}"]) / 2 for axis in "xyz"], axis=1)
        np.testing.assert_allclose(scene.spots.places, middle, atol=1e-3 * grid.radius.min())

    def test_a_disc_is_a_circle_from_above_and_thin_from_the_side(self, grid):
        """The contact planes of the grid are horizontal, but for the slopes of the wires."""
        scene = SceneMaker(grid, [-1]).scene(-1)
        for view, thickness in (((0, 0, 1), 1.0), ((1, 0, 0), 0.18), ((1, 0, 1), np.sqrt(0.5))):
            width, height, _ = discs(scene, aim(scene.points, 1e-3, 1.5, view))
            # slopes of a tenth of a degree to a degree
            np.testing.assert_allclose(height / width, thickness, atol=0.02)


class TestColours:
    def test_the_bar_has_the_range_of_the_field(self, grid):
        scene = SceneMaker(grid, [-1], "joule_heat").scene(-1)
        heat = grid.field("joule_heat")
        assert scene.title == "joule heat [µW]"
        np.testing.assert_allclose(scene.limits, (1e6 * heat.min(), 1e6 * heat.max()))

    def test_the_names_of_two_bars_stay_apart(self, run_of_input):
        """A moment that is round-off has a small unit, and a power of ten in its name."""
        results = litz.Results(run_of_input("15_lap_joint"))
        scene = SceneMaker(results, [-1], "bending_moment").scene(-1)
        camera = aim(scene.outline, scene.reach, 1.4)
        figure = Figure(figsize=(10, 7))
        FigureCanvasAgg(figure)
        with mpl.rc_context(plots.STYLE):
            plots.place_wires(figure, (0.01, 0.13, 0.98, 0.76), scene, camera, None, 1.0)
            figure.draw_without_rendering()
        names = [axes.xaxis.label for axes in figure.axes if axes.get_xlabel()]
        assert [name.get_text().split(" [")[0] for name in names] == ["bending moment, magnitude", "force per length"]
        first, second = (name.get_window_extent() for name in names)
        assert first.x0 > 0
        assert first.x1 < second.x0
        assert not any(axes.xaxis.offsetText.get_text() for axes in figure.axes)

    def test_several_increments_share_one_range(self, grid):
        increments = range(len(grid.times))
        maker = SceneMaker(grid, list(increments), "element_current")
        currents = grid.field("element_current", None)
        for increment in increments:
            scene = maker.scene(increment)
            assert scene.colours == "coolwarm"
            np.testing.assert_allclose(scene.limits[1], np.abs(currents).max())


class TestFriction:
    def test_the_loop_is_as_high_as_the_friction_and_its_work_is_heat(self, friction):
        """Coulomb: the force stays within 0.3 of the contact force; the springs of Mindlin keep little of the work."""
        (loop,) = friction_loops(friction, [1])
        ledger = friction.contact(1)
        assert np.abs(loop.force).max() == pytest.approx(0.3 * ledger["force"].max(), rel=0.01)
        work = np.sum((loop.force[1:] + loop.force[:-1]) / 2 * np.diff(loop.sliding))
        assert work == pytest.approx(ledger["dissipation"][-1], rel=0.01)

    def test_the_loop_is_as_wide_as_the_clamp_goes_less_the_bending(self, friction):
        """The clamp moves 0.2 mm to and fro; the two cantilevers take 0.06 mm of it (2 F L^3/(3 E I))."""
        (loop,) = friction_loops(friction, [1])
        force, length, stiffness = 0.94e-3, 0.0825, 120e9 * np.pi * 0.5e-3**4 / 4
        bending = force * length**3 / (3 * stiffness)
        assert np.ptp(loop.sliding) == pytest.approx(0.2e-3 - 2 * bending, rel=0.05)


@pytest.fixture
def without_vtk(monkeypatch):
    """Wires are drawn by matplotlib alone, which starts at once."""
    monkeypatch.setattr(animation, "render", lambda scenes, camera, pixels: [None] * len(scenes))


class TestAnimation:
    @pytest.mark.slow
    def test_a_gif_has_a_frame_for_each_increment_and_they_differ(self, grid, tmp_path):
        path = animation.animate(grid, tmp_path / "grid.gif", field="displacement", size=(300, 210))
        with Image.open(path) as moving:
            assert moving.n_frames == len(grid.times)
            assert moving.size == (300, 210)
            frames = []
            for number in range(moving.n_frames):
                moving.seek(number)
                frames.append(np.asarray(moving.convert("RGB")) / 255)
        for frame in frames:
            assert not_white(frame) > 0.02 * frame.shape[0] * frame.shape[1]
        assert not np.array_equal(frames[0], frames[-1])

    @pytest.mark.usefixtures("without_vtk")
    def test_of_many_increments_an_even_choice_is_shown(self, grid, tmp_path):
        path = animation.animate(grid, tmp_path / "grid.gif", size=(300, 210), max_frames=2)
        with Image.open(path) as moving:
            assert moving.n_frames == 2

    @pytest.mark.usefixtures("without_vtk")
    def test_the_former_name_of_the_number_of_frames_warns(self, grid, tmp_path):
        with pytest.warns(DeprecationWarning, match="most_frames is called max_frames now"):
            path = animation.animate(grid, tmp_path / "grid.gif", size=(300, 210), most_frames=2)
        with Image.open(path) as moving:
            assert moving.n_frames == 2

    def test_mp4_without_its_package_says_what_to_install(self, grid, tmp_path, monkeypatch):
        monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
        with pytest.raises(litz.FileError, match=r"pip install 'litz\[video\]'"):
            animation.animate(grid, tmp_path / "grid.mp4")

    @pytest.mark.usefixtures("without_vtk")
    def test_mp4_gets_every_frame_in_even_sizes(self, grid, tmp_path, monkeypatch):
        """The package itself is not needed for this: what it is given is looked at."""
        given = []

        def write_frames(path, size, fps, **_):
            assert size == (300, 210)
            while True:
                given.append((yield))

        monkeypatch.setitem(sys.modules, "imageio_ffmpeg", SimpleNamespace(write_frames=write_frames))
        animation.animate(grid, tmp_path / "grid.mp4", size=(301, 211), max_frames=2, frames_per_second=2)
        assert len(given) == 2 + 3  # the last one is held for 1.5 s
        assert all(frame.shape == (210, 300, 3) for frame in given)

    def test_mp4_of_the_real_package(self, grid, tmp_path):
        pytest.importorskip("imageio_ffmpeg", reason="imageio-ffmpeg is not installed: pip install imageio-ffmpeg")
        path = animation.animate(grid, tmp_path / "grid.mp4", size=(300, 210), max_frames=2)
        assert path.read_bytes()[4:8] == b"ftyp"


class TestCommand:
    def test_options_of_the_wires(self, run_of_input, tmp_path, capsys):
        picture = tmp_path / "wires.png"
        directory = run_of_input("04_wire_grid")
        options = ["--field", "displacement.z", "--increment", "1:2", "--view", "1,-1,1", "--size", "600x400"]
        assert main(["plot", str(directory), "wires", *options, "--spots", "force", "-o", str(picture)]) == 0
        drawn = imread(picture)
        assert drawn.shape[:2] == (400, 600)
        assert not_white(drawn) > 0.02 * 600 * 400
        assert str(picture) in capsys.readouterr().out

    def test_the_ending_of_the_file_asks_for_an_animation(self, run_of_input, tmp_path):
        moving = tmp_path / "wires.gif"
        assert main(["plot", str(run_of_input("05_clamped_pair")), "-o", str(moving), "--size", "300x200"]) == 0
        assert moving.read_bytes().startswith(b"GIF89a")

    def test_the_fields_are_listed_with_their_units(self, run_of_input, capsys):
        assert main(["plot", str(run_of_input("04_wire_grid")), "--list-fields"]) == 0
        listed = capsys.readouterr().out
        assert "joule_heat" in listed
        assert "[W]" in listed
        assert "bending_moment " in listed

    @pytest.mark.parametrize(
        ("options", "message"),
        [
            (["wires", "--view", "up"], "there is no view 'up'"),
            (["wires", "--view", "1,2"], "a direction has three numbers"),
            (["wires", "--view", "0,0,0"], "not all zero"),
            (["wires", "--size", "large"], "WIDTHxHEIGHT"),
            (["wires", "--size", "20x20"], "too small"),
            (["wires", "--increment", "last"], "STEP:INCREMENT"),
            (["wires", "--increment", "7:1"], "increment 1 of step 7 is not in"),
            (["wires", "--field", "voltage"], "there is no field 'voltage'"),
            (["residuals", "--animate"], "only the wires can be animated"),
            (["--animate", "-o", "a.avi"], "a .gif or .mp4 file"),
        ],
    )
    def test_wrong_options_are_answered_in_words(self, run_of_input, options, message):
        done = command("plot", run_of_input("05_clamped_pair"), *options)
        assert done.returncode == 1
        assert message in done.stderr

    def test_what_results_do_not_have_is_told_without_how_the_command_is_used(self, run_of_input):
        done = command("plot", run_of_input("05_clamped_pair"), "section")
        assert done.returncode == 1
        assert done.stderr.startswith("error: wire ")
        assert len(done.stderr.splitlines()) == 1

    @pytest.mark.parametrize(
        ("arguments", "message"),
        [
            (["wires", "deck"], "the results come first: litz plot deck wires"),
            (["wires"], "the results come first: litz plot RESULTS wires"),
        ],
    )
    def test_a_kind_before_the_results_is_told_the_order(self, arguments, message, tmp_path, monkeypatch, capsys):
        monkeypatch.chdir(tmp_path)
        with pytest.raises(SystemExit):
            main(["plot", *arguments])
        assert message in capsys.readouterr().err

    def test_results_may_have_the_name_of_a_kind(self, run_of_input, tmp_path, monkeypatch):
        monkeypatch.chdir(tmp_path)
        shutil.copytree(run_of_input("05_clamped_pair"), "wires")
        assert main(["plot", "wires", "--list-fields"]) == 0


class TestUnits:
    def test_pictures_have_the_labels_of_the_deck(self, run, inputs):
        deck = (inputs / "05_clamped_pair.inp").read_text().replace("*UNITS, SYSTEM=SI\n", "")
        _, results = run("*UNITS, LENGTH=mm, FORCE=mN, TIME=ms\n" + deck)
        scene = SceneMaker(results, [-1], "displacement").scene(-1)
        assert (scene.title, scene.length_unit) == ("displacement, magnitude [mm]", "mm")
        axes = Figure().add_subplot()
        charts.forces_over_time(axes, results, -1)
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [ms]", "force [mN]")
        assert "mN" in report_tables.worst_contacts(results)


def test_a_contact_that_opens_has_no_force_until_it_closes_again(run_of_input):
    results = litz.Results(run_of_input("01_crossed_wires"))
    axes = Figure().add_subplot()
    charts.forces_over_time(axes, results, -1)
    (line,) = axes.get_lines()
    force = dict(zip(np.round(line.get_xdata(), 9), line.get_ydata(), strict=True))
    assert len(force) == len(results.times)
    assert force[2.0] == 0
    assert min(force[1.9], force[2.1]) > 0


def test_values_that_are_all_alike_are_below_the_top_of_their_axes():
    axes = Figure().add_subplot()
    axes.plot([1.0], [1.19], "o")
    axes.fill_between([1.0], [1.18], [1.2])
    from_zero(axes)
    assert axes.get_ylim() == pytest.approx((0.0, 1.05 * 1.2))


@pytest.mark.parametrize(("card", "text"), [
    ("*Beam Section, elset=WIRE, material=M, section=GENERAL\n 1e-6, 1e-12, 0, 1e-12, 2e-12", "sections are drawn as circles"),
    ("*Beam Section, elset=WIRE, material=M, section=RECT\n 1e-3, 2e-3", ""),
    ("*BEAM SECTION, ELSET=WIRE, MATERIAL=M, SECTION=PIPE\n 1e-3, 2e-4", ""),
])  # fmt: skip
def test_a_picture_says_where_sections_have_no_outline(run, card, text):
    _, results = run(
        f"*NODE, NSET=N\n 1, 0, 0, 0\n 2, 0.1, 0, 0\n*ELEMENT, TYPE=B33, ELSET=WIRE\n 1, 1, 2\n*MATERIAL, NAME=M\n*ELASTIC\n"
        f" 2e11, 0.3\n{card}\n 0, 1, 0\n*BOUNDARY\n 1, ENCASTRE\n*STEP\n*STATIC\n*CLOAD\n 2, 3, 1\n*END STEP\n"
    )
    assert SceneMaker(results, [-1]).scene(-1).shape_text == text
    figure = Figure(figsize=(8, 6))
    plots._wires(figure, results, -1, plots.Look())
    assert any(text in note.get_text() for note in figure.texts) or not text

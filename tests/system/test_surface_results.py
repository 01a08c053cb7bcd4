"""Rigid surfaces and the contacts with them in results, pictures, reports and files for other programs."""

import json
import threading
import warnings

import numpy as np
import pytest
import pyvista as pv
from matplotlib.image import imread
from PIL import Image

import litz
from browser import open_browser
from litz.pictures.scene import SceneMaker
from litz.results.history_table import history_table
from litz.results.surface_patches import surface_patches
from litz.viewer.data import WebData
from litz.viewer.server import ViewServer
from test_view import errors, ledger_row, load, picture_of

RADIUS = 1e-3
#: Reference node of the plate, beside the wires
HANDLE = (0.01, -0.004, 0.006)


def crossed_between_plates():
    """Two crossed wires on a table, pressed by a plate that then moves along and turns on its normal."""
    model = litz.Model("two crossed wires between plates", units="SI")
    steel = model.material("STEEL", young=200e9, poisson=0.3)
    lower = model.wire("LOWER", (-0.011, 0, 0), (0.009, 0, 0), elements=7, radius=RADIUS, material=steel)
    above = 2 * RADIUS - 1e-8
    upper = model.wire("UPPER", (0, -0.009, above), (0, 0.011, above), elements=7, radius=RADIUS, material=steel)
    table = model.plane("TABLE", (0, 0, -RADIUS + 1e-8), (0, 0, 1))
    plate = model.plane("PLATE", (0, 0, 3 * RADIUS - 2e-8), (0, 0, -1), reference=HANDLE)
    model.contact(lower, upper)
    model.contact(lower, table, friction=0.2)
    model.contact(upper, plate, friction=0.2)
    for wire in (lower, upper):
        model.fix(wire, "x", "y", "rotations")
    model.fix(plate, "x", "y", "rotations")
    model.step("PRESS", increment=0.5).move(plate, "z", -1e-6)
    slide = model.step("SLIDE", increment=0.25)
    slide.move(plate, "x", 2e-4)
    slide.move(plate, "rz", 0.3)
    return model


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", litz.RunWarning)
        return crossed_between_plates().run(tmp_path_factory.mktemp("plates") / "plates")


def handle_row(results):
    return int(np.flatnonzero(results.node_ids == results.rigid_surfaces["PLATE"].reference_node)[0])


def vectors(table, name):
    return np.column_stack([table[f"{name}_{axis}"] for axis in "xyz"])


class TestForces:
    def test_what_a_surface_feels_is_what_its_reference_node_is_held_with(self, results):
        """All contacts of a surface together, force and moment, to round-off."""
        forces = results.surface_forces
        plate = forces.where(forces["surface"] == "PLATE")
        assert plate.n_rows == len(results.times)
        for name, reaction in (("surface_force", "reaction_force"), ("surface_moment", "reaction_moment")):
            held = results.field(reaction, None)[:, handle_row(results)]
            assert np.abs(held[-1]).min() > 0
            np.testing.assert_allclose(vectors(plate, name), -held, rtol=0, atol=1e-13 * np.abs(held).max())

    def test_a_fixed_surface_feels_what_the_supports_and_the_other_one_do_not_carry(self, results):
        """Balance of the whole model: forces, and moments about the origin."""
        forces = results.surface_forces
        table = forces.where(forces["surface"] == "TABLE")
        held, moments = results.field("reaction_force", None), results.field("reaction_moment", None)
        arms = results.nodes + results.field("displacement", None)
        scale = np.abs(held).max()
        np.testing.assert_allclose(vectors(table, "surface_force"), held.sum(axis=1), atol=1e-7 * scale)
        turning = (moments + np.cross(arms, held)).sum(axis=1)
        np.testing.assert_allclose(vectors(table, "surface_moment"), turning, atol=1e-7 * scale * 0.01)

    def test_the_ledger_has_force_friction_wires_and_surface_of_each_element(self, results):
        now = results.surface_contacts_at(-1)
        assert set(zip(now["wires"], now["surface"], strict=True)) == {("LOWER", "TABLE"), ("UPPER", "PLATE")}
        on_plate = now["surface"] == "PLATE"
        assert set(now["friction"][on_plate]) == {"slip"}
        size = np.linalg.norm(vectors(now, "traction")[on_plate], axis=1)
        np.testing.assert_allclose(size, 0.2 * now["force"][on_plate], rtol=1e-6)
        # a plane has one normal: what each element does to it is its force and its friction, reversed
        pushed = -now["force"][:, None] * vectors(now, "normal") - vectors(now, "traction")
        np.testing.assert_allclose(vectors(now, "surface_force"), pushed, rtol=1e-9, atol=1e-9 * now["force"].max())

    def test_totals_count_elements_lengths_and_the_deepest_overlap(self, results):
        now, forces = results.surface_contacts_at(-1), results.surface_forces
        last = forces.where(forces["surface"] == "PLATE")
        on_plate = now["surface"] == "PLATE"
        assert last["contacts"][-1] == on_plate.sum()
        assert last["length"][-1] == pytest.approx(now["length"][on_plate].sum())
        assert last["penetration"][-1] == -now["gap"][on_plate].min()
        assert last["contacts"][0] == last["force"][0] == 0
        assert last.units["surface_moment_x"] == "N m"

    def test_a_model_without_rigid_surfaces_has_empty_tables(self, run_of_input):
        results = litz.Results(run_of_input("04_wire_grid"))
        assert results.rigid_surfaces == {}
        assert results.surface_contacts.n_rows == results.surface_forces.n_rows == 0


class TestPlaces:
    def test_the_surfaces_are_those_of_the_deck(self, results):
        plate, table = (results.rigid_surfaces[name] for name in ("PLATE", "TABLE"))
        assert (plate.shape, plate.radius, table.reference_node) == ("PLANE", 0.0, None)
        np.testing.assert_array_equal(plate.direction, [0, 0, -1])
        np.testing.assert_array_equal(results.nodes[handle_row(results)], HANDLE)

    def test_a_point_moves_with_the_reference_node(self, results):
        """The plate has turned by 0.3 rad about the node, and has moved with it."""
        plate, arm = results.rigid_surfaces["PLATE"], np.array([0.002, 0.001, -0.003])
        c, s = np.cos(0.3), np.sin(0.3)
        turned = np.array([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1], arm[2]])
        expected = turned + HANDLE + np.array([2e-4, 0, -1e-6])
        moved = plate.moved(results, np.array([HANDLE + arm]))
        np.testing.assert_allclose(moved, [expected], rtol=1e-9)
        np.testing.assert_allclose(plate.brought_back(results, moved), [HANDLE + arm], rtol=1e-12)

    def test_a_patch_lies_beside_all_wires_at_every_increment(self, results):
        n = len(results.times)
        wires = np.unique(results.elements)
        for patch in surface_patches(results, list(range(n))):
            low, high = patch.points.min(axis=0), patch.points.max(axis=0)
            for k in range(n):
                seen = patch.surface.brought_back(results, results.positions(k)[wires], k)
                assert (seen[:, :2] > low[:2] + RADIUS).all()
                assert (seen[:, :2] < high[:2] - RADIUS).all()
            # and is not much larger
            assert (high - low)[:2].max() < 2 * np.ptp(results.nodes[wires], axis=0).max()

    @pytest.mark.parametrize(
        ("radius", "full"), [(0.01, True), (10.0, False)], ids=["drum", "drum as large as a house"]
    )
    def test_a_large_cylinder_is_shown_where_the_wires_are(self, tmp_path, radius, full):
        model = litz.Model("drum")
        steel = model.material("STEEL", young=200e9, poisson=0.3)
        wire = model.wire("WIRE", (-0.01, 0, 2e-3), (0.01, 0, 2e-3), elements=4, radius=RADIUS, material=steel)
        model.contact(wire, model.cylinder("DRUM", (0, 0, -radius), (0, 1, 0), radius))
        model.fix(wire)
        model.step()
        results = model.run(tmp_path / "drum")
        (patch,) = surface_patches(results, [0])
        np.testing.assert_allclose(np.hypot(patch.points[:, 0], patch.points[:, 2] + radius), radius)
        assert np.ptp(patch.points[:, 0]) < 0.04
        assert (len(patch.quads) * 2 == len(patch.points)) == full


class TestPictures:
    def test_a_scene_has_the_surfaces_where_they_are_and_a_disc_for_each_element(self, results):
        scene = SceneMaker(results, [-1], spots="force").scene(-1)
        assert len(scene.surface_quads) == 2
        heights = np.unique(scene.surface_points[:, 2].round(9))
        np.testing.assert_allclose(heights, [-RADIUS + 1e-8, 3 * RADIUS - 2e-8 - 1e-6], atol=1e-9)
        wires, surfaces = results.contacts_at(-1).n_rows, results.surface_contacts_at(-1)
        assert len(scene.spot_radius) == wires + surfaces.n_rows
        # the discs lie on the surfaces
        np.testing.assert_allclose(np.unique(scene.spots.places[wires:, 2].round(6)), heights.round(6), atol=1e-6)
        force = surfaces["force"]
        large = scene.spot_radius[wires:] > 0.2 * scene.spot_radius.max()
        ratio = scene.spot_radius[wires:][large] ** 2 / force[large]
        np.testing.assert_allclose(ratio, ratio[0])

    def test_displacements_are_exaggerated_for_surfaces_too(self, results):
        scene = SceneMaker(results, [-1], scale=100).scene(-1)
        assert scene.surface_points[:, 2].max() == pytest.approx(3 * RADIUS - 2e-8 - 100e-6)

    @pytest.mark.slow
    @pytest.mark.parametrize("with_opengl", [True, False])
    @pytest.mark.filterwarnings("ignore:.*drawn with matplotlib only")
    def test_a_picture_shows_them_half_transparent(self, results, tmp_path, monkeypatch, with_opengl):
        if not with_opengl:
            monkeypatch.setattr("litz.pictures.plots.render", lambda scenes, *_: [None] * len(scenes))
        path = litz.plot(results, "wires", tmp_path / "wires.png", view="z", reference=False)
        picture = imread(path)[..., :3]
        bluish = (picture[..., 2] > picture[..., 0] + 0.02) & (picture.min(axis=2) > 0.5)
        # most of what the plate covers, and the wires shine through it
        assert bluish.mean() > 0.15
        assert (picture.max(axis=2) - picture.min(axis=2) > 0.25).mean() > 0.005

    @pytest.mark.slow
    @pytest.mark.filterwarnings("ignore:.*drawn with matplotlib only")
    def test_an_animation_has_them_in_every_frame(self, results, tmp_path):
        with Image.open(litz.animate(results, tmp_path / "plates.gif", max_frames=2, view="z")) as frames:
            assert frames.n_frames == 2
            for k in range(2):
                frames.seek(k)
                picture = np.asarray(frames.convert("RGB")).astype(int)
                bluish = (picture[..., 2] > picture[..., 0] + 5) & (picture.min(axis=2) > 128)
                assert bluish.mean() > 0.15

    def test_the_chart_of_forces_ends_at_the_force_on_each_surface(self, results, tmp_path):
        from matplotlib.figure import Figure

        from litz.pictures.surface_charts import surface_forces_over_time

        axes = Figure().subplots()
        surface_forces_over_time(axes, results, -1)
        ends = {line.get_label(): line.get_ydata()[-1] for line in axes.lines}
        assert axes.get_ylabel() == "force [N]"
        assert set(ends) == {"PLATE", "TABLE"}
        assert ends["PLATE"] == pytest.approx(np.linalg.norm(results.field("reaction_force")[handle_row(results)]))
        assert litz.plot(results, "surfaces", tmp_path / "surfaces.png").is_file()


class TestViewer:
    def test_the_page_has_the_surfaces_and_one_ledger_of_all_contacts(self, results):
        data = WebData(results)
        model, last = json.loads(data.model()), json.loads(data.increment(len(results.times) - 1))
        assert [one["name"] for one in model["surfaces"]] == list(results.rigid_surfaces)
        assert len(last["surfaces"]) == 2
        n = results.contacts_at(-1).n_rows + results.surface_contacts_at(-1).n_rows
        assert {len(values) for values in last["contacts"].values()} == {n}
        assert model["largest"]["force"] == max(
            results.contacts["force"].max(), results.surface_contacts["force"].max()
        )

    @pytest.mark.slow
    def test_the_surfaces_are_seen_and_their_contacts_are_picked(self, results):
        with open_browser() as browser, ViewServer(results.path) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            load(browser, server.url)
            browser.find_element("css selector", "[data-view=z]").click()
            picture = picture_of(browser)
            bluish = (picture[..., 2] > picture[..., 0] + 0.02) & (picture.min(axis=2) > 0.5)
            assert bluish.mean() > 0.1
            now = results.surface_contacts_at(-1)
            row = next(row for row in browser.find_elements("css selector", ".litz-contacts tr") if "PLATE" in row.text)
            row.click()
            shown = ledger_row(browser)
            assert (shown["surface"], shown["wires"]) == ("PLATE", "UPPER")
            assert int(shown["element"]) in now["element"]
            assert errors(browser) == []
            server.shutdown()


class TestWords:
    def test_the_summary_has_a_line_for_each_surface(self, results):
        lines = [line for line in results.summary().splitlines() if "force on" in line]
        assert [line.split()[:3] for line in lines] == [["force", "on", "PLATE"], ["force", "on", "TABLE"]]
        force = np.linalg.norm(results.field("reaction_force")[handle_row(results)])
        assert float(lines[0].split()[3]) == pytest.approx(force, rel=1e-4)

    def test_the_table_of_the_history_counts_contacts_with_surfaces(self, results):
        last = history_table(results).splitlines()[-1].split()
        n = results.contacts_at(-1).n_rows + results.surface_contacts_at(-1).n_rows
        assert int(last[1]) == n

    @pytest.mark.usefixtures("reports_without_pictures")
    def test_the_report_has_the_surfaces_and_their_worst_contacts(self, results, tmp_path):
        text = litz.report(results, tmp_path / "page.html").read_text(encoding="utf-8")
        assert "<h2>Rigid surfaces</h2>" in text
        assert "fixed in space" in text
        assert "largest force on a rigid surface" in text
        assert "Forces on the rigid surfaces." in text

    @pytest.mark.usefixtures("reports_without_pictures")
    def test_the_iterate_of_a_failed_run_has_them_too(self, run, tmp_path):
        deck = crossed_between_plates().to_deck()
        # half a radius, all at once
        process, before = run(deck.replace(" 3, 3, -1e-6\n", " 3, 3, -5e-4\n").replace("1e-5, 0.5", "0.5, 0.5"))
        assert process.returncode == 2, process.stderr
        with pytest.warns(UserWarning, match="did not finish"):
            iterate = litz.Results(before.path.with_name("deck_unconverged.vtkhdf"))
        assert iterate.surface_contacts.n_rows > 0
        text = litz.report(before, tmp_path / "page.html").read_text(encoding="utf-8")
        assert "deepest contacts with rigid surfaces" in text


class TestOtherPrograms:
    @pytest.mark.parametrize("to", ["vtu", "vtkhdf"])
    def test_they_get_surfaces_and_contacts(self, results, tmp_path, to):
        results.export(to, tmp_path)
        surfaces, contacts = (last_of(tmp_path, f"plates_{ending}", to, results) for ending in ("rigid", "surfaces"))
        forces = results.surface_forces
        np.testing.assert_allclose(surfaces.cell_data["surface_force"], vectors(forces, "surface_force")[-2:])
        heights = np.unique(np.asarray(surfaces.points)[:, 2].round(9))
        np.testing.assert_allclose(heights, [-RADIUS + 1e-8, 3 * RADIUS - 2e-8 - 1e-6], atol=1e-9)
        now = results.surface_contacts_at(-1)
        np.testing.assert_array_equal(contacts.points, vectors(now, "point"))
        np.testing.assert_array_equal(contacts.cell_data["force"], now["force"])

    def test_the_files_beside_the_results_do_not_hide_them(self, results, tmp_path):
        results.export("vtkhdf", tmp_path)
        assert litz.Results(tmp_path).path == tmp_path / "plates.vtkhdf"


def last_of(folder, stem, to, results):
    """The last increment of a series."""
    if to == "vtu":
        reader = pv.get_reader(folder / f"{stem}.pvd")
        reader.set_active_time_value(results.times[-1])
        return reader.read()[0]
    reader = pv.get_reader(folder / f"{stem}.vtkhdf").reader
    reader.SetStep(len(results.times) - 1)
    reader.Update()
    return pv.wrap(reader.GetOutput())

"""`litz convert` and `litz export`; results as data frames and files of other programs."""

import csv
import re
from pathlib import Path

import numpy as np
import pytest
import pyvista as pv

import litz
from in_process import command
from litz import Results

DECK = "05_clamped_pair"


@pytest.fixture
def results(run_of_input):
    return litz.Results(run_of_input(DECK))


def test_csv_has_every_node_at_every_increment(results, tmp_path):
    path = litz.export(results, "csv", tmp_path / "new")
    with path.open(newline="") as file:
        heads, *rows = csv.reader(file)
    assert len(rows) == len(results.nodes) * len(results.times)
    table = np.array(rows, dtype=float)
    columns = [heads.index(f"displacement_{axis} [m]") for axis in "xyz"]
    last = table[:, 2] == results.times[-1]
    np.testing.assert_array_equal(table[last][:, columns], results.field("displacement"))
    np.testing.assert_array_equal(table[last][:, heads.index("node")], results.node_ids)
    with (tmp_path / "new" / f"{DECK}_elements.csv").open(newline="") as file:
        heads, *rows = csv.reader(file)
    assert len(rows) == len(results.elements) * len(results.times)
    assert "joule_heat [W]" in heads


def test_vtu_is_a_series_that_a_reader_finds(results, tmp_path):
    path = results.export("vtu", tmp_path)
    reader = pv.get_reader(path)
    np.testing.assert_array_equal(reader.time_values, results.times)
    reader.set_active_time_value(results.times[-1])
    (grid,) = reader.read()
    np.testing.assert_array_equal(grid.points, results.positions())
    np.testing.assert_array_equal(grid.point_data["potential"], results.field("potential"))
    np.testing.assert_array_equal(grid.cell_data["axial_force"], results.field("axial_force"))
    contacts = pv.get_reader(tmp_path / f"{DECK}_contacts.pvd")
    contacts.set_active_time_value(results.times[-1])
    (points,) = contacts.read()
    np.testing.assert_array_equal(points.point_data["force"], results.contacts_at(-1)["force"])


def test_xdmf_is_what_meshio_reads(results, tmp_path):
    meshio = pytest.importorskip("meshio")
    path = results.export("xdmf", tmp_path)
    with meshio.xdmf.TimeSeriesReader(path) as reader:
        points, cells = reader.read_points_cells()
        assert reader.num_steps == len(results.times)
        time, point_data, cell_data = reader.read_data(reader.num_steps - 1)
    np.testing.assert_array_equal(points, results.nodes)
    np.testing.assert_array_equal(cells[0].data, results.elements)
    assert time == results.times[-1]
    np.testing.assert_array_equal(point_data["displacement"], results.field("displacement"))
    np.testing.assert_array_equal(cell_data["joule_heat"][0], results.field("joule_heat"))


def test_results_named_by_a_relative_path_are_exported(results, tmp_path, monkeypatch):
    pytest.importorskip("meshio")
    monkeypatch.chdir(results.path.parent.parent)
    relative = results.path.relative_to(results.path.parent.parent)
    for to in ("xdmf", "vtu", "csv", "vtkhdf"):
        litz.export(relative, to, tmp_path / to)
    assert (tmp_path / "xdmf" / f"{DECK}.xdmf").read_text().count("<Time ") == len(results.times)
    assert Path.cwd() == results.path.parent.parent


def test_xdmf_does_not_replace_the_mesh_of_the_deck(results, tmp_path):
    pytest.importorskip("meshio")
    (tmp_path / f"{DECK}.h5").write_text("a mesh")
    with pytest.raises(litz.FileError, match="into another directory"):
        results.export("xdmf", tmp_path)
    assert (tmp_path / f"{DECK}.h5").read_text() == "a mesh"


def test_vtkhdf_is_a_copy(results, tmp_path):
    path = results.export("vtkhdf", tmp_path)
    assert path.read_bytes() == results.path.read_bytes()
    assert (tmp_path / f"{DECK}_contacts.vtkhdf").is_file()


def test_the_command_exports(results, tmp_path):
    done = command("export", results.path, "--to", "csv", "-o", tmp_path)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / f"{DECK}_nodes.csv").is_file()
    wrong = command("export", results.path, "--to", "vtuu", "-o", tmp_path)
    assert wrong.returncode == 1
    assert "did you mean 'vtu'" in wrong.stderr


def test_tables_as_data_frames(results):
    pytest.importorskip("pandas")
    frame = results.to_pandas("contacts")
    np.testing.assert_array_equal(frame["force"], results.contacts["force"])
    assert frame.attrs["units"]["force"] == "N"
    assert len(results.to_pandas()) == results.history.n_rows
    with pytest.raises(ValueError, match="did you mean 'contacts'"):
        results.to_pandas("contact")


def test_a_converted_mesh_runs_when_it_is_held(litz, tmp_path):
    (tmp_path / "mesh.inp").write_text("*Node\n 1, 0, 0, 0\n 2, 0.1, 0, 0\n*Element, type=B31, elset=WIRE\n 1, 1, 2\n")
    done = command("convert", "mesh.inp", "deck.inp", "--radius", "1e-3", "--length", "m", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "2 nodes, 1 elements" in done.stdout
    deck = tmp_path / "deck.inp"
    text = deck.read_text()
    assert litz("check", deck).returncode == 1
    deck.write_text(text.replace("*STEP", "*BOUNDARY\n 1, ENCASTRE\n*STEP", 1))
    assert litz("run", deck, "-o", tmp_path).returncode == 0
    again = command("convert", "mesh.inp", "deck.inp", "--radius", "1e-3", "--length", "m", cwd=tmp_path)
    assert again.returncode == 4
    assert "is not overwritten" in again.stderr
    without = command("convert", "mesh.inp", "other.inp", cwd=tmp_path)
    assert without.returncode == 1
    assert "radius" in without.stderr
    assert not (tmp_path / "other.inp").exists()


def test_a_round_section_is_converted_in_the_dialect_that_is_told(litz, tmp_path):
    """A cantilever of 0.1 m under 1 N at its end sinks by P L^3/(3 E I): 16 times more where the value is the diameter."""
    (tmp_path / "mesh.inp").write_text(
        "*Node\n 1, 0, 0, 0\n 2, 0.1, 0, 0\n*Element, type=B33, elset=WIRE\n 1, 1, 2\n*Material, name=M\n*Elastic\n 200e9, 0.3\n"
        "*Beam Section, elset=WIRE, material=M, section=CIRC\n 4e-3\n"
    )
    untold = command("convert", "mesh.inp", "untold.inp", cwd=tmp_path)
    assert untold.returncode == 1
    assert "--dialect abaqus or --dialect ccx" in untold.stderr
    assert not (tmp_path / "untold.inp").exists()
    for dialect, radius in (("abaqus", 4e-3), ("ccx", 2e-3)):
        done = command("convert", "mesh.inp", f"{dialect}.inp", "--dialect", dialect, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        text = (tmp_path / f"{dialect}.inp").read_text()
        text = text.replace("*STEP", "*BOUNDARY\n 1, ENCASTRE\n*STEP", 1).replace(
            "*END STEP", "*CLOAD\n 2, 3, 1e-3\n*END STEP"
        )
        (tmp_path / f"{dialect}.inp").write_text(text)
        assert litz("run", f"{dialect}.inp", "-o", dialect, cwd=tmp_path).returncode == 0
        sag = 1e-3 * 0.1**3 / (3 * 200e9 * np.pi / 4 * radius**4)
        # the deflection is 1e-8 of the length: large displacements change nothing
        assert Results(tmp_path / dialect).field("displacement")[1, 2] == pytest.approx(sag, rel=1e-9)


@pytest.mark.parametrize("conductivity", [[], ["--conductivity", "5.8e7"]], ids=["insulator", "conductor"])
def test_the_outline_of_a_converted_mesh_is_a_deck_that_runs(litz, tmp_path, conductivity):
    """Its comments, taken as they stand, hold the wires at their sets, move one of them, and make contacts."""
    (tmp_path / "mesh.inp").write_text(
        "*Node\n 1, -0.1, 0, 0\n 2, 0.1, 0, 0\n 3, 0, -0.1, 0.00063\n 4, 0, 0.01, 0.00063\n 5, 0, 0.1, 0.00063\n"
        "*Element, type=B31, elset=LOWER\n 1, 1, 2\n*Element, type=B31, elset=UPPER\n 2, 3, 4\n 3, 4, 5\n"
        "*Nset, nset=LOWER_ENDS\n 1, 2\n*Nset, nset=UPPER_ENDS\n 3, 5\n"
    )
    done = command("convert", "mesh.inp", "deck.inp", "--radius", "3e-4", "--length", "m", *conductivity, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    outline, n_lines = re.subn(r"^\*\* ([* ])", r"\1", (tmp_path / "deck.inp").read_text(), flags=re.MULTILINE)
    assert n_lines >= 9
    assert ("GAP ELECTRICAL CONDUCTANCE" in outline) == bool(conductivity)
    (tmp_path / "outline.inp").write_text(outline)
    run = litz("run", "outline.inp", "-o", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    results = Results(tmp_path / "out")
    np.testing.assert_allclose(results.field("displacement")[[2, 4], 2], -3e-4)
    assert results.contacts_at(-1).n_rows == 1

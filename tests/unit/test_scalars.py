"""What wires can be coloured by: every field of the file, whatever it is called."""

import shutil
from types import SimpleNamespace

import h5py
import numpy as np
import pytest

import litz
from litz.pictures.scene import SceneMaker
from litz.results.scalars import Scalar, colours_and_limits, find_scalar, scalar_values, scalars, values_of_wires

OF_WIRES = ("wire", "place_in_wire", "direction_in_wire")


@pytest.fixture
def with_temperature(written, tmp_path):
    """The results of a program that has also computed a temperature at the nodes: 300 K, 10 K more at each node."""
    for file in written.iterdir():
        shutil.copy(file, tmp_path)
    path = tmp_path / "crossed.vtkhdf"
    with h5py.File(path, "r+") as file:
        root = file["VTKHDF"]
        n, increments = len(root["PointData/node_id"]), root["Steps"].attrs["NSteps"]
        data = root["PointData"].create_dataset("temperature", data=np.tile(300.0 + 10 * np.arange(n), increments))
        data.attrs["unit"], data.attrs["description"] = np.bytes_(b"K"), np.bytes_(b"temperature")
        root["Steps/PointDataOffsets"].create_dataset("temperature", data=n * np.arange(increments))
    return litz.Results(path)


def test_a_field_that_is_new_in_the_file_colours_the_wires(with_temperature):
    assert find_scalar(with_temperature, "temperature").at_nodes
    scene = SceneMaker(with_temperature, [-1], "temperature").scene(-1)
    assert scene.title == "temperature [K]"
    assert scene.limits == (300, 350)
    np.testing.assert_allclose(scene.value[[0, -1]], [300, 350])


def test_every_field_but_names_and_places_can_be_chosen(results):
    known = scalars(results)
    assert set(results.fields) - set(known) == {"node_id", "reference_position", "element_id", "section", *OF_WIRES}
    for name, scalar in known.items():
        expected = len(results.nodes if scalar.at_nodes else results.elements)
        assert scalar_values(results, scalar, -1).shape == (expected,), name


def test_vectors_have_components_and_a_length(results):
    displacement = results.field("displacement")
    for component, axis in enumerate("xyz"):
        values = scalar_values(results, find_scalar(results, f"displacement.{axis}"), -1)
        np.testing.assert_array_equal(values, displacement[:, component])
    length = scalar_values(results, find_scalar(results, "displacement"), -1)
    np.testing.assert_allclose(length, np.linalg.norm(displacement, axis=1))


def test_heat_per_length_does_not_depend_on_the_length_of_elements(results):
    heat = find_scalar(results, "joule_heat_per_length")
    assert (heat.unit, heat.at_nodes) == ("W/m", False)
    ends = results.nodes[results.elements]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    per_length = scalar_values(results, heat, -1)
    assert per_length.any()
    np.testing.assert_allclose(per_length * length, results.field("joule_heat"))


def test_the_bending_moment_is_that_of_both_axes(results):
    both = scalar_values(results, find_scalar(results, "bending_moment"), -1)
    parts = [results.field(f"bending_moment_{axis}") for axis in (2, 3)]
    np.testing.assert_allclose(both, np.hypot(*parts))


def test_the_length_of_two_components_is_that_of_both():
    moment = Scalar("M", ("M_2", "M_3"), None, "N m", False, "M, magnitude")
    np.testing.assert_allclose(moment.of([np.array([3.0, 0.0]), np.array([-4.0, 2.0])]), [5, 2])


def test_unknown_names_are_answered_with_the_nearest(results):
    with pytest.raises(KeyError, match="did you mean 'axial_force'"):
        find_scalar(results, "axial_forces")


@pytest.mark.parametrize(
    ("low", "high", "one_sided", "expected"),
    [
        (-1.0, 2.0, False, ("coolwarm", (-2.0, 2.0))),
        (0.0, 2.0, False, ("viridis", (0.0, 2.0))),
        (-1e-9, 2.0, False, ("viridis", (-1e-9, 2.0))),
        (1.0, 2.0, True, ("viridis", (1.0, 2.0))),
        (5.0, 5.0 + 1e-12, False, ("viridis", (2.5, 7.5))),
        (0.0, 0.0, False, ("viridis", (-0.5, 0.5))),
    ],
)
def test_values_of_both_signs_have_a_scale_with_zero_in_the_middle(low, high, one_sided, expected):
    colours, limits = colours_and_limits(low, high, one_sided)
    assert (colours, limits) == (expected[0], pytest.approx(expected[1]))


@pytest.mark.parametrize(("at_nodes", "expected"), [(True, [0, 1, 2]), (False, [0, 1])])
def test_ranges_are_those_of_wires_without_images_beyond_the_ends_of_a_cell(at_nodes, expected):
    """These have next to no force, and not the field of a magnet."""
    elements = np.array([[0, 1], [1, 2], [2, 3], [3, 4]])
    scalar, values = Scalar("x", ("x",), None, "", at_nodes, "x"), np.arange(5 if at_nodes else 4)
    cell = SimpleNamespace(elements=elements, images=np.array([False, False, True, True]))
    assert values_of_wires(cell, scalar, values).tolist() == expected
    whole = SimpleNamespace(elements=elements, images=np.zeros(4, dtype=bool))
    assert values_of_wires(whole, scalar, values) is values

"""The contact network of a run, as arrays and as files."""

import csv
import sys
from xml.etree import ElementTree

import numpy as np
import pytest

import litz
from litz import Results

GRAPHML = "{http://graphml.graphdrawing.org/xmlns}"


@pytest.fixture
def results(run_of_input):
    """A grid of 4 x 4 wires: 16 contacts, current enters at the lower wires and leaves at the upper ones."""
    return Results(run_of_input("04_wire_grid"))


def test_wires_and_contacts_of_a_grid(results):
    network = results.contact_network()
    assert len(network.wire_length) == 8
    np.testing.assert_allclose(network.wire_length, 0.1, rtol=1e-12)
    assert sorted(map(tuple, np.sort(network.wires, axis=1))) == [(i, j) for i in range(4) for j in range(4, 8)]
    # the wires lie at 35, 45, 55 and 65 mm, and move along each other by 1e-4 of that
    place = np.array([0.035, 0.045, 0.055, 0.065])
    for pair, arc in zip(network.wires, network.arc, strict=True):
        other = pair[::-1] % 4
        np.testing.assert_allclose(arc, place[other], rtol=1e-3)


def test_currents_obey_kirchhoff(results):
    network = results.contact_network()
    into_wire = np.zeros(8)
    np.add.at(into_wire, network.wires[:, 0], network.current)
    np.add.at(into_wire, network.wires[:, 1], -network.current)
    total = results.history["current PLUS to MINUS"][-1]
    assert abs(into_wire).sum() == pytest.approx(2 * abs(total), rel=1e-9)
    # each wire carries its whole current between its electrode and the first crossing
    assert np.abs(results.wire_currents()) == pytest.approx(np.abs(into_wire), rel=1e-9)


def test_conductance_is_that_of_the_history(results):
    for increment in (-1, len(results.times) // 2):
        resistance = results.history["resistance PLUS to MINUS"][increment]
        assert results.conductance("PLUS", "MINUS", increment) == pytest.approx(1 / resistance, rel=1e-9)


def test_conductance_asks_for_sets_and_a_voltage(results):
    with pytest.raises(KeyError, match="there is no node set 'PULS'; did you mean 'PLUS'"):
        results.conductance("PULS", "MINUS")
    with pytest.raises(ValueError, match="there is no voltage between PLUS and PLUS"):
        results.conductance("PLUS", "PLUS")


def test_csv_has_a_row_for_each_contact(results, tmp_path):
    network = results.contact_network()
    with network.to_csv(tmp_path / "network.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [int(row["id"]) for row in rows] == network.id.tolist()
    assert [[int(row["wire_1"]), int(row["wire_2"])] for row in rows] == (network.wires + 1).tolist()
    assert [float(row["resistance [ohm]"]) for row in rows] == network.resistance.tolist()
    assert [float(row["z [m]"]) for row in rows] == network.point[:, 2].tolist()


def test_graphml_has_the_wires_and_contacts(results, tmp_path):
    network = results.contact_network()
    root = ElementTree.parse(network.to_graphml(tmp_path / "network.graphml")).getroot()
    graph = root.find(f"{GRAPHML}graph")
    assert len(graph.findall(f"{GRAPHML}node")) == 8
    edges = graph.findall(f"{GRAPHML}edge")
    assert [(edge.get("source"), edge.get("target")) for edge in edges] == [
        (f"wire{first}", f"wire{second}") for first, second in network.wires + 1
    ]
    keys = {key.get("id"): key.get("attr.name") for key in root.findall(f"{GRAPHML}key")}
    values = [{keys[data.get("key")]: float(data.text) for data in edge} for edge in edges]
    assert [value["resistance_ohm"] for value in values] == network.resistance.tolist()


def test_network_before_the_first_touch_is_empty(run_of_input):
    network = Results(run_of_input("12_woven_fabric")).contact_network(0)
    assert network.wires.shape == (0, 2)
    assert len(network.wire_length) == 46
    np.testing.assert_array_equal(network.wire_current, 0)


def test_wires_at_an_electrode_are_those_with_a_node_of_it(results):
    network = results.contact_network()
    assert network.wires_at["PLUS"].tolist() == [0, 1, 2, 3]
    assert network.wires_at["MINUS"].tolist() == [4, 5, 6, 7]


def test_contacts_as_a_table(results):
    network = results.contact_network()
    table = network.table()
    assert table["wire_2"].tolist() == network.wires[:, 1].tolist()
    assert table["z"].tolist() == network.point[:, 2].tolist()
    assert table.units["resistance"] == "ohm"
    assert table.units["arc_1"] == "m"
    assert repr(network) == "<ContactNetwork: 8 wires, 16 contacts>"


def test_a_data_frame_has_the_units(results):
    pytest.importorskip("pandas")
    frame = results.contact_network().to_pandas()
    assert len(frame) == 16
    assert frame.attrs["units"]["force"] == "N"


def test_the_graph_of_networkx_has_wires_and_contacts(results):
    networkx = pytest.importorskip("networkx")
    network = results.contact_network()
    graph = network.to_networkx()
    assert (graph.number_of_nodes(), graph.number_of_edges()) == (8, 16)
    assert graph.nodes[7]["node_sets"].count("MINUS") == 1
    assert graph.nodes[7]["length"] == pytest.approx(0.1)
    first, second = (int(wire) for wire in network.wires[3])
    assert graph.edges[first, second, int(network.id[3])]["force"] == network.force[3]
    assert networkx.is_connected(graph)


def test_a_graph_needs_networkx(results, monkeypatch):
    monkeypatch.setitem(sys.modules, "networkx", None)
    with pytest.raises(litz.FileError, match="pip install networkx"):
        results.contact_network().to_networkx()


@pytest.mark.parametrize("along", [1, -1])
@pytest.mark.parametrize("inlet", [1, -1])
@pytest.mark.parametrize("first", [1, -1])
def test_current_between_two_contacts_of_one_element(tmp_path, along, inlet, first):
    """A wire of one element, along x or against it, takes current from one wire and hands it to another."""
    model = litz.Model("a bridge")
    wire = {"radius": 1e-3, "material": litz.COPPER, "elements": 2}
    bridge = model.wire("BRIDGE", (-0.02 * along, 0, 0), (0.02 * along, 0, 0), **{**wire, "elements": 1})
    x = [0.006 * first, -0.007 * first]
    across = [model.wire(f"ACROSS{i}", (x[i], -0.02, 1.999e-3), (x[i], 0.03, 1.999e-3), **wire) for i in range(2)]
    model.contact(bridge, across, conductance=litz.HertzSpot())
    for group in (bridge, *across):
        model.fix(group.ends)
    step = model.step()
    plus = x.index(max(x, key=lambda place: place * inlet))
    step.potential(across[plus].start, 1e-3)
    step.potential(across[1 - plus].start, 0.0)
    step.electrode_print(across[plus].start, across[1 - plus].start)
    results = model.run(tmp_path)
    (total,) = (values[-1] for name, values in results.history.items() if name.startswith("current "))
    assert total > 0.1
    # from the inlet to the outlet, which is along x where the inlet is at the smaller x
    assert results.wire_currents()[0] == pytest.approx(-inlet * along * total, rel=1e-6)
    assert results.contact_network().wire_current[0] == results.wire_currents()[0]

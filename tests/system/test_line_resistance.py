"""Resistance of a contact that changes its length: places conduct with what touches of them, not as a whole."""

import numpy as np
import pytest
from verification.cases import turned_wires
from verification.cases.turned_wires import FINE, GENTLE, PER_LENGTH, SHIFT, SPOTS


@pytest.fixture
def results_of(run):
    """Results of a deck."""

    def results(deck):
        process, found = run(deck)
        assert process.returncode == 0, process.stderr
        return found

    return results


class TestFromPointToLine:
    """Two wires that are turned from 20 to 0.5 degrees under a constant force, 2 % each time."""

    @pytest.mark.parametrize("spot", SPOTS)
    def test_the_resistance_of_stiff_wires_falls_steadily(self, results_of, spot):
        _, resistance = turned_wires.from_point_to_line(results_of, SPOTS[spot])
        rise, ripple = turned_wires.unsteadiness(resistance)
        # the plastic spot of crossed wires has the same resistance at all angles, to round-off
        assert rise < 1e-12
        # that of the force is half a per cent; a place that begins to conduct as a whole is a step of 5 to 20 %
        assert ripple < 1e-2

    def test_so_does_that_of_wires_that_bend(self, results_of):
        _, resistance = turned_wires.from_point_to_line(results_of, SPOTS["metal"], force=GENTLE, elastic=True)
        rise, ripple = turned_wires.unsteadiness(resistance)
        assert rise < 0
        assert ripple < 1e-2

    @pytest.mark.parametrize("elements", [9, 40])
    def test_a_given_resistance_per_length_is_that_of_the_length_that_touches(self, results_of, elements):
        """Tubes whose axes are a height h apart, h < 2 r, overlap over 2 sqrt(4 r^2 - h^2)/sin(psi)."""
        overlap, resistance = turned_wires.from_point_to_line(results_of, SPOTS["per length"], elements=elements)
        exact = turned_wires.touching_length(overlap, FINE)
        # the distance to the second order about each place; half a place at each end would be 2 to 20 %
        assert PER_LENGTH / resistance == pytest.approx(exact, rel=3e-3)


class TestPlacesAtTheEnds:
    """Of two wires at half a degree, which touch over 4 mm of 20 mm."""

    @pytest.fixture
    def results(self, results_of):
        angles = np.radians(np.geomspace(90, 0.5, 60))
        return results_of(turned_wires.sweep(SPOTS["per length"], SHIFT, angles=angles))

    def test_some_conduct_that_do_not_touch_themselves(self, results):
        ledger = results.contacts_at(-1)
        beside = ledger["force"] == 0
        # at most one at either end for the places of each wire
        assert 1 <= beside.sum() <= 4
        assert (ledger["gap"][beside] >= 0).all()
        # less than half of its cell touches, and each wire has half of the contact
        assert (ledger["length"][beside] < ledger["spacing"][beside] / 4).all()
        # between nodes at 1 mV each has the current of what touches
        current = 1e-3 * ledger["length"][beside] / PER_LENGTH
        assert np.abs(ledger["current"][beside]) == pytest.approx(current, rel=1e-9)

    def test_they_lie_beyond_their_zone_and_count_for_its_current(self, results):
        ledger, zones = results.contacts_at(-1), results.contact_zones()
        assert zones.n_rows == 1
        current = np.abs(ledger["current"])
        assert abs(zones["current"][0]) == pytest.approx(current.sum(), rel=1e-12)
        assert current.sum() > current[ledger["force"] > 0].sum()
        # of either wire, to half a distance of places at both ends
        overlap = results.history[f"U3 node {turned_wires.HEAD}"][-1]
        touching = turned_wires.touching_length(-overlap, np.radians(0.5))
        assert zones["length"][0] == pytest.approx(touching, abs=ledger["spacing"].max())

    def test_in_the_network_they_are_part_of_their_contact(self, results):
        network = results.contact_network(-1)
        assert abs(network.current[0]) == pytest.approx(np.abs(results.contacts_at(-1)["current"]).sum(), rel=1e-12)

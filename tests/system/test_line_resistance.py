"""Resistance of a contact that changes its length: places conduct with what touches of them, not as a whole."""

import numpy as np
import pytest
from verification.cases import turned_wires
from verification.cases.turned_wires import FINE, GENTLE, PER_LENGTH, SHIFT, SPOTS
from verification.references import hertz
from verification.references.parallel_wires import ParallelWires, PressedWire

from line_wires import conductances_of_places, crossing_at_a_small_angle


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

    @pytest.mark.slow
    @pytest.mark.parametrize("spot", SPOTS)
    def test_the_resistance_of_stiff_wires_falls_steadily(self, results_of, spot):
        _, resistance = turned_wires.from_point_to_line(results_of, SPOTS[spot])
        rise, ripple = turned_wires.unsteadiness(resistance)
        # the plastic spot of crossed wires has the same resistance at all angles: to round-off at the crossing, and in
        # places to half of the error with which they sum up the force of the lens, which changes by 0.1 % in a step
        assert rise < (1e-3 if spot == "hardness" else 1e-12)
        # that of the force is half a per cent; a place that begins to conduct as a whole is a step of 5 to 20 %
        assert ripple < 1e-2

    @pytest.mark.slow
    def test_so_does_that_of_wires_that_bend(self, results_of):
        _, resistance = turned_wires.from_point_to_line(results_of, SPOTS["metal"], force=GENTLE, elastic=True)
        rise, ripple = turned_wires.unsteadiness(resistance)
        assert rise < 0
        assert ripple < 1e-2

    @pytest.mark.slow
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

    @pytest.mark.slow
    def test_in_the_network_they_are_part_of_their_contact(self, results):
        network = results.contact_network(-1)
        assert abs(network.current[0]) == pytest.approx(np.abs(results.contacts_at(-1)["current"]).sum(), rel=1e-12)


class TestWiresThatYield:
    """Crossed at small angles: the spot of a hardness, which is round, turns into the strip of it along the lens."""

    HARDNESS = 1e9
    WIRE = PressedWire(1e-3, 120e9, 0.34, 1 / 5.88e7)

    def conductances(self, results_of, overlaps, sine, elements):
        deck = crossing_at_a_small_angle(overlaps, law="PLASTIC", data=f" {self.HARDNESS}", n=elements, sine=sine)
        return conductances_of_places(results_of(deck), len(overlaps))

    @pytest.mark.slow
    @pytest.mark.parametrize("sine", [0.12, 0.06, 0.03])
    def test_conduct_the_same_on_every_mesh(self, results_of, sine):
        """Lenses of 0.2 to 6 radii, which are the matter of the crossing, of the places or of both."""
        overlaps = [2e-7, 5e-7, 1e-6, 2e-6, 4e-6, 8e-6]
        coarse, medium, fine = (self.conductances(results_of, overlaps, sine, n) for n in (9, 40, 160))
        assert coarse == pytest.approx(fine, rel=6e-3)
        assert medium == pytest.approx(fine, rel=6e-3)

    @pytest.mark.parametrize("elements", [9, 160])
    def test_by_the_round_spot_where_the_lens_is_short(self, results_of, elements):
        """Shorter than the radius: 0.12, 0.17 and 0.29 radii."""
        overlaps, sine = np.array([5e-8, 1e-7, 3e-7]), 0.12
        found = self.conductances(results_of, overlaps, sine, elements)
        modulus = hertz.effective_modulus([self.WIRE.young] * 2, [self.WIRE.poisson] * 2)
        one = hertz.crossed_wires(
            1.0,
            np.arcsin(sine),
            radius=[self.WIRE.radius] * 2,
            modulus=modulus,
            resistivity=[self.WIRE.resistivity] * 2,
        )
        force = (overlaps / one.approach) ** 1.5
        exact = 4 * np.sqrt(force / (np.pi * self.HARDNESS)) / (2 * self.WIRE.resistivity)
        assert found == pytest.approx(exact, rel=2e-3)

    def test_by_the_strip_of_parallel_wires_where_the_lens_is_long(self, results_of):
        """26 radii, so that the section is the nearer bound of the far field: A/B is a hundredth."""
        overlap, sine = 1.6e-6, 0.003
        (found,) = self.conductances(results_of, [overlap], sine, 9)
        pair = ParallelWires(self.WIRE, self.WIRE)
        arc = np.linspace(-9.75e-3, 9.75e-3, 2001)
        forces = np.array([pair.force(overlap - (sine * s) ** 2 / (4 * self.WIRE.radius)) for s in arc])
        # b = f/(2 H): 1/g' = (2 rho/pi) (ln(2 r/b) + 1/8)
        logarithm = np.log(4 * self.WIRE.radius * self.HARDNESS / forces) + 1 / 8
        strips = np.pi / (2 * self.WIRE.resistivity * logarithm)
        # of each wire one round end lies beside the other wire: half of the round spot of a hemisphere
        modulus = hertz.effective_modulus([self.WIRE.young] * 2, [self.WIRE.poisson] * 2)
        whole = hertz.end_on_wire(1.0, radius=[1e-3] * 2, modulus=modulus, resistivity=[self.WIRE.resistivity] * 2)
        force = ((overlap - (sine * arc[0]) ** 2 / (4 * self.WIRE.radius)) / whole.approach) ** 1.5
        ends = 2 * np.sqrt(float(force) / (np.pi * self.HARDNESS)) / self.WIRE.resistivity
        assert found == pytest.approx(np.trapezoid(strips, arc) + ends, rel=2e-2)

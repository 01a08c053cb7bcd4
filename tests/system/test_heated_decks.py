"""The decks whose wires are heated by a current and by friction, against networks and series that know nothing of litz."""

import math

import numpy as np
import pytest

from litz import closed_forms as cf
from networks import Network, points_of_mat
from results_at import at

ROOM = 293.15


def test_a_mat_is_two_networks_of_current_and_heat(results_of, header):
    results = results_of("21_heated_mat")
    radius, resistivity, conductivity = 0.1e-3, 1 / 0.9e6, 11.3
    area = math.pi * radius**2
    for time, resistance, hottest in header("21_heated_mat"):
        increment = at(results, time)
        voltage = 1e-3 + 59e-3 * (time - 1)
        network, n_points, stretches, plates = points_of_mat(results, increment)
        spots = [(2 * k, 2 * k + 1, 1 / r) for k, r in enumerate(network.resistance)]
        for k in range(0, len(spots), 20):
            holm = cf.hertz_contact(
                network.force[k],
                angle=network.angle[k],
                radius=radius,
                young=220e9,
                poisson=0.3,
                resistivity=resistivity,
            )
            # fibres are bent where they cross, r/R of some 1e-3: two tori, in place of straight wires
            assert network.resistance[k] == pytest.approx(holm.resistance, rel=1e-3)
        links = [(p, q, area / (resistivity * length)) for p, q, length in stretches] + spots
        circuit = Network(n_points, links, {p: voltage * upper for p, upper in plates.items()})
        potential = circuit.solve(np.zeros(n_points))
        current = circuit.flowing_in(potential)[[p for p, upper in plates.items() if upper]].sum()
        heat = np.zeros(n_points)
        for p, q, g in links:
            heat[[p, q]] += g * (potential[p] - potential[q]) ** 2 / 2
        # a spot of one metal and a wire have the same shape for both: heat conductance = k rho times the electric one
        as_heat = [(p, q, conductivity * resistivity * g) for p, q, g in links]
        temperature = Network(n_points, as_heat, dict.fromkeys(plates, ROOM)).solve(heat)

        ledger = results.contacts_at(increment)
        in_ledger = np.column_stack([ledger["temperature_1"], ledger["temperature_2"]])
        np.testing.assert_allclose(in_ledger, temperature[: in_ledger.size].reshape(-1, 2), atol=1e-5)
        assert results.history["resistance PLUS to MINUS"][increment] == pytest.approx(voltage / current, rel=1e-8)
        assert [1e3 * voltage / current, temperature.max()] == pytest.approx([resistance, hottest], abs=0.006)


def test_a_mat_between_held_ends_loses_force_as_it_gets_hot(results_of):
    results = results_of("21_heated_mat")
    force = [results.contacts_at(at(results, time))["force"].sum() for time in (1.0, 1.5, 2.0)]
    assert force[0] > force[1] > force[2]


class Rod:
    """Sum of sines for the temperature of a rod above that of its held ends; heat enters at a place and up to it."""

    def __init__(self, length, held_at_both_ends, area, conductivity, capacity, n=600):
        number = np.arange(1, n + 1)
        self.wave = (number if held_at_both_ends else number - 0.5) * np.pi / length
        self.rate = conductivity / capacity * self.wave**2
        self.gain = 2 / (length * conductivity * area * self.wave**2)
        self.amplitude = np.zeros(n)

    def advance(self, duration, place, heat, heat_per_length):
        """Over a time in which these do not change."""
        decay = np.exp(-self.rate * duration)
        self.sine = np.sin(self.wave * place)
        self.response = self.gain * (1 - decay)
        along = heat_per_length * (1 - np.cos(self.wave * place)) / self.wave
        self.amplitude = self.amplitude * decay + self.response * (heat * self.sine + along)

    def add(self, heat):
        """More heat at the place, in the same time."""
        self.amplitude = self.amplitude + self.response * heat * self.sine

    def rise(self):
        return self.amplitude @ self.sine

    def rise_by_heat(self):
        return self.response @ self.sine**2


def test_a_wiper_is_heated_by_friction_and_current(results_of, header):
    results = results_of("22_wiper")
    radius, resistivity, conductivity, capacity, current = 0.5e-3, 1 / 8e6, 62.0, 8800.0 * 380.0, 10.0
    area, modulus = math.pi * radius**2, 110e9 / (2 * (1 - 0.34**2))
    sliding = [k for k in range(len(results.times)) if results.times[k] > 1 - 1e-9]
    rows = [results.contacts_at(k) for k in sliding]
    time = results.times[sliding]
    force = np.array([row["force"][0] for row in rows])
    on_track = np.array([row["point_1_x"][0] for row in rows])
    on_arm = np.array([20e-3 + row["point_2_y"][0] for row in rows])
    path = np.array([row["slip_path"][0] for row in rows])
    dissipated = results.history["ALLFD"][sliding]
    # the dissipation of each increment is mu F times its slip; the spring bends before it slips, within the second
    assert np.diff(dissipated)[2:] == pytest.approx(0.3 * force[3:] * np.diff(path)[2:], rel=1e-3)
    assert path[-1] == pytest.approx(20e-3, rel=2e-2)

    track = Rod(40e-3, True, area, conductivity, capacity)
    arm = Rod(21.3e-3, False, area, conductivity, capacity)
    per_length = current**2 * resistivity / area
    exact, steps = [], 8
    for i in range(1, len(time)):
        friction = 0.3 * force[i] * (path[i] - path[i - 1]) / (time[i] - time[i - 1])
        for part in (np.arange(steps) + 1) / steps:
            f, x, s = (v[i - 1] + part * (v[i] - v[i - 1]) for v in (force, on_track, on_arm))
            a = (3 * f * radius / (4 * modulus)) ** (1 / 3)
            half = (current**2 * resistivity / (2 * a) + friction) / 2
            for rod, place in ((track, x), (arm, s)):
                rod.advance((time[i] - time[i - 1]) / steps, place, half, per_length)
            passing = 2 * a * conductivity
            passing *= (track.rise() - arm.rise()) / (1 + passing * (track.rise_by_heat() + arm.rise_by_heat()))
            track.add(-passing)
            arm.add(passing)
        exact.append((track.rise(), arm.rise()))
    exact = ROOM + np.array(exact)
    for when, *temperatures in header("22_wiper"):
        k = int(np.argmin(np.abs(time - when)))
        assert temperatures == pytest.approx(list(exact[k - 1]), abs=0.006)
    begun = time[1:] > 1.1
    in_ledger = np.array([(row["temperature_1"][0], row["temperature_2"][0]) for row in rows[1:]])
    np.testing.assert_allclose(in_ledger[begun, 0], exact[begun, 0], atol=0.2)
    np.testing.assert_allclose(in_ledger[begun, 1], exact[begun, 1], atol=0.15)

"""Temperatures and motions together: wires that their own currents heat push, buckle and bend; and what ends a run."""

import itertools

import numpy as np
import pytest

from run_of_deck import refusal_of_deck, run_of_deck
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

LENGTH, RADIUS, ROOM = 0.1, 0.5e-3, 300.0
AREA = np.pi * RADIUS**2
LAMBDA, RHO, YOUNG, ALPHA = 390.0, 1.72e-8, 1.2e11, 17e-6
#: Rise at which a round wire clamped at both ends buckles
CRITICAL = np.pi**2 * RADIUS**2 / (ALPHA * LENGTH**2)
PROCEDURE = "*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE, ELECTRICAL\n"


def voltage_for(rise):
    """Between cold ends, for a mean rise: two thirds of V^2/(8 lambda rho)."""
    return np.sqrt(12 * LAMBDA * RHO * rise)


def deck(volts, *, elements=20, bow=0.0, ends="ENDS, ENCASTRE", procedure=PROCEDURE, increments="", supply=None,
         loads="", later="", sigma=f"{1 / RHO:.17g}", elastic=f"{YOUNG}, 0.34", expansion=f"{ALPHA}", conductivity=LAMBDA,
         model="", heat="ENDS, 11, 11, 300", step="", section=""):  # fmt: skip
    """A wire along x between cold ends, with a bow of the buckling mode along y."""
    s = np.linspace(0, 1, elements + 1)
    y = bow / 2 * (1 - np.cos(2 * np.pi * s))
    nodes = "\n".join(f"{i + 1}, {LENGTH * s[i]:.17g}, {y[i]:.17g}, 0" for i in range(elements + 1))
    members = "\n".join(f"{i}, {i}, {i + 1}" for i in range(1, elements + 1))
    supply = f"*BOUNDARY\n1, 9, 9, {volts:.17g}\n{elements + 1}, 9\n" if supply is None else supply
    return f"""\
*NODE, NSET=ALL
{nodes}
*ELEMENT, TYPE=B33, ELSET=WIRE
{members}
*MATERIAL, NAME=COPPER
*ELASTIC
{elastic}
*EXPANSION
{expansion}
*ELECTRICAL CONDUCTIVITY
{sigma}
*CONDUCTIVITY
{conductivity}
*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC{section}
{RADIUS}
*NSET, NSET=ENDS
1, {elements + 1}
*BOUNDARY
{ends}
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, {ROOM}
{model}*STEP
{procedure}{increments}{step}*BOUNDARY
{heat}
{supply}{loads}*NODE PRINT, NSET=ALL
U, RF, NT, RFL
*ENERGY PRINT
*END STEP
{later}"""


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


class TestAWireThatItsCurrentHeats:
    def test_it_pushes_against_its_clamps(self, run):
        """EA alpha times the mean rise; the profile of the temperatures is that of the wire at rest."""
        results = run(voltage_for(0.5 * CRITICAL), elements=7)
        s = np.linspace(0, 1, 8)
        rise = 6 * 0.5 * CRITICAL * s * (1 - s)
        np.testing.assert_allclose(results.field("temperature") - ROOM, rise, atol=1e-10 * rise.max())
        # means of the elements, less than the parabola by (1/7)^2
        force = YOUNG * AREA * ALPHA * 0.5 * CRITICAL * (1 - 1 / 49)
        assert results.field("reaction_force")[[0, -1], 0] == pytest.approx([force, -force], rel=1e-9)
        # nothing moves, temperature does all the work; the inner nodes shift to where the force is the same
        energies = results.history
        assert energies["ALLTW"][-1] == pytest.approx(energies["ALLSE"][-1], rel=1e-9)

    def test_it_lengthens_where_it_can(self, run):
        results = run(voltage_for(60.0), elements=7, ends="1, ENCASTRE")
        assert results.field("displacement")[-1, 0] == pytest.approx(ALPHA * 60 * (1 - 1 / 49) * LENGTH, rel=1e-9)
        assert abs(results.field("reaction_force")).max() < 1e-9 * YOUNG * AREA * ALPHA * 60

    @pytest.mark.parametrize("share", [0.5, 1.0, 4.0])
    def test_it_buckles_and_bows(self, run, share):
        """r^2 (1 - e/w) + (w^2 - e^2)/4 = share r^2: a bow w from one of e, clamped ends."""
        bow = RADIUS / 20
        results = run(voltage_for(share * CRITICAL), elements=40, bow=bow, increments="0.05, 1, , 0.05\n")
        w = max(np.roots([0.25 / RADIUS**2, 0, 1 - share - 0.25 * (bow / RADIUS) ** 2, -bow]).real)
        assert results.field("displacement")[20, 1] + bow == pytest.approx(w, rel=3e-3)

    def test_the_potential_and_the_temperatures_do_not_see_the_motion(self, run):
        bent = run(voltage_for(4 * CRITICAL), elements=40, bow=RADIUS / 20, increments="0.05, 1, , 0.05\n").field(
            "temperature"
        )
        still = run(voltage_for(4 * CRITICAL), elements=40, bow=RADIUS / 20,
                    procedure="*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n")  # fmt: skip
        np.testing.assert_allclose(bent, still.field("temperature"), rtol=1e-10)

    def test_a_wire_that_conducts_over_its_present_length(self, run):
        """The mean rise is V^2/(12 lambda rho) whatever the length, the current that of the longer wire: both in one iterate."""
        results = run(voltage_for(150.0), elements=7, ends="1, ENCASTRE", section=", CONDUCTION=CURRENT LENGTH")
        longer = results.field("displacement")[-1, 0]
        # the parabola is one over the present length, the mean that lengthens the wire one over the reference length
        assert longer == pytest.approx(ALPHA * 150 * (1 - 1 / 49) * LENGTH, rel=ALPHA * 150)
        power = voltage_for(150.0) ** 2 * AREA / (RHO * (LENGTH + longer))
        assert -results.field("reaction_heat").sum() == pytest.approx(power, rel=1e-9)

    def test_stiffness_follows_the_temperature_that_is_solved_for(self, run):
        """Half of the stiffness 600 K above, along a wire of one temperature: N = E(T) A alpha (T - T0)."""
        results = run(0.0, elements=3, elastic=f"{YOUNG}, 0.34, 300\n{YOUNG / 2}, 0.34, 900", heat="ALL, 11, 11, 312")
        force = YOUNG * (1 - 12 / 1200) * AREA * ALPHA * 12
        assert results.field("reaction_force")[0, 0] == pytest.approx(force, rel=1e-9)

    def test_the_balance_of_energies_closes_with_the_increments(self, run):
        left = []
        for n in (10, 20):
            results = run(voltage_for(2 * CRITICAL), elements=20, bow=RADIUS / 4, increments=f"{1 / n}, 1, , {1 / n}\n")
            left.append(abs(results.history["ETOTAL"][-1]) / results.history["ALLTW"][-1])
        assert left[0] < 1e-2
        assert left[0] / left[1] == pytest.approx(4, rel=0.3)

    def test_a_wire_whose_resistivity_follows_the_temperature_needs_sweeps_of_a_few_iterations(self, run):
        sigma = "\n".join(f"{1 / (RHO * (1 + 4e-3 * (t - ROOM))):.17g}, {t:.17g}" for t in (100.0, 1e7))
        results = run(0.2, sigma=sigma, ends="1, ENCASTRE")
        # four of potentials and temperatures, as for a wire that is held, two of the motion
        assert results.status["iterations"][-1] <= 9


class TestStepsThatFollow:
    LATER = "*STEP\n*STATIC\n*CLOAD, OP=NEW\n{load}*END STEP\n"

    def test_a_static_step_keeps_the_temperatures(self, run):
        later = self.LATER.format(load="8, 1, 5.\n")
        results = run(voltage_for(60.0), elements=7, ends="1, ENCASTRE", later=later)
        warm, pulled = (results.field("temperature", increment=i) for i in (1, -1))
        np.testing.assert_array_equal(pulled, warm)
        moved = ALPHA * 60 * (1 - 1 / 49) * LENGTH + 5.0 * LENGTH / (YOUNG * AREA)
        assert results.field("displacement")[-1, 0] == pytest.approx(moved, rel=1e-5)
        assert abs(results.field("heat_flux")).max() == 0

    def test_temperatures_of_a_static_step_can_be_given(self, run):
        later = "*STEP\n*STATIC\n*TEMPERATURE\nALL, 300\n*END STEP\n"
        results = run(voltage_for(60.0), elements=7, ends="1, ENCASTRE", later=later)
        np.testing.assert_allclose(results.field("temperature"), ROOM, rtol=1e-14)
        assert abs(results.field("displacement")).max() < 1e-12 * LENGTH

    def test_a_second_step_takes_up_the_temperatures_of_the_first(self, run):
        """Over a *STATIC between them, in which what the first has prescribed of temperatures waits."""
        again = f"*STEP\n{PROCEDURE}*BOUNDARY\n1, 9, 9, {voltage_for(30.0):.17g}\n*END STEP\n"
        results = run(
            voltage_for(60.0), elements=7, ends="1, ENCASTRE", later=self.LATER.format(load="8, 1, 5.\n") + again
        )
        assert results.field("temperature")[3:5].mean() - ROOM == pytest.approx(6 * 30 * 12 / 49, rel=1e-9)
        assert results.field("reaction_heat").sum() == pytest.approx(-results.field("joule_heat").sum(), rel=1e-10)

    def test_a_run_goes_on_from_every_increment(self, litz, tmp_path):
        later = "*STEP\n*STATIC\n0.5, 1\n*CLOAD\n8, 1, 5.\n*END STEP\n"
        later += f"*STEP\n{PROCEDURE}0.5, 1\n*BOUNDARY\n1, 9, 9, {voltage_for(30.0):.17g}\n*END STEP\n"
        text = deck(
            voltage_for(60.0), elements=7, ends="1, ENCASTRE", increments="0.5, 1\n", step=KEEP_ALL, later=later
        )
        assert_goes_on_from_everywhere(litz, tmp_path, text)


class TestWhatIsRefused:
    def test_currents_that_the_step_does_not_speak_of(self, refused):
        message = refused(1, 0.01, procedure="*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE\n")
        assert "material COPPER conducts currents" in message
        assert "needs the parameter ELECTRICAL" in message

    def test_temperatures_prescribed_in_a_step_that_does_not_solve_for_them(self, refused):
        message = refused(1, 0.01, later="*STEP\n*STATIC\n*BOUNDARY\n1, 11, 11, 310\n*CFLUX\n3, , 1.\n*END STEP\n")
        assert message.count("this step does not solve for temperatures") == 2
        assert "give them by *TEMPERATURE" in message

    def test_sources_of_heat_in_a_static_step(self, refused):
        message = refused(1, 0.01, later="*STEP\n*STATIC\n*FILM\nWIRE, F, 290, 10\n*END STEP\n")
        assert "a step that does not solve for temperatures has no *FILM" in message

    def test_no_steady_temperature(self, refused):
        """Above the burn-out current the run ends with the largest one that was steady."""
        sigma = "\n".join(f"{1 / (RHO * (1 + 4e-3 * (t - ROOM))):.17g}, {t:.17g}" for t in (100.0, 1e7))
        burn_out = np.pi * AREA / LENGTH * np.sqrt(LAMBDA / (RHO * 4e-3))
        message = refused(2, 0.0, supply=f"*CECURRENT\n1, , {2 * burn_out:.17g}\n*BOUNDARY\n21, 9\n", sigma=sigma,
                          ends="1, ENCASTRE", increments="0.1, 1, 1e-3\n")  # fmt: skip
        assert "There may be no steady temperature above I = " in message
        assert "third value of *COUPLED TEMPERATURE-DISPLACEMENT" in message


def motion_solves(folder):
    """How often a run has solved for motions: rows of the convergence file with another correction of theirs."""
    lines = next(folder.glob("**/*.cvg")).read_text(encoding="utf-8").splitlines()
    column = lines[0].split().index("displacement")
    corrections = [line.split()[column] for line in lines]
    return sum(a != b for a, b in itertools.pairwise(corrections[1:]))


def test_a_current_costs_no_more_solutions_for_the_motions_than_its_heat(run, tmp_path):
    """Temperatures take the first turn of an increment: the motions are found once, as with these temperatures given."""
    shape = {"bow": RADIUS, "elements": 40, "loads": "*CLOAD\n21, 2, 1\n"}
    hot = run(voltage_for(CRITICAL), **shape)
    coupled = motion_solves(tmp_path)
    bent, rise = hot.field("displacement"), hot.field("temperature")
    given = "\n".join(f"{i + 1}, 11, 11, {value:.17g}" for i, value in enumerate(rise))
    alone = run(0.0, heat=given, **shape)
    np.testing.assert_allclose(alone.field("displacement"), bent, atol=1e-9 * abs(bent).max())
    assert motion_solves(tmp_path) >= 4
    assert coupled <= motion_solves(tmp_path)

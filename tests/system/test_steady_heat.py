"""Steady currents and temperatures in wires: what the equations give in closed form, what ends a run, and what is reported."""

import numpy as np
import pytest

from litz import Results, report
from run_of_deck import refusal_of_deck, run_of_deck
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

LENGTH, RADIUS, ROOM = 0.1, 0.5e-3, 300.0
AREA = np.pi * RADIUS**2
LAMBDA, RHO, SLOPE = 390.0, 1.72e-8, 4e-3
#: Resistivity linear in the temperature from 100 K to far above
SIGMA = "\n".join(f"{1 / (RHO * (1 + SLOPE * (t - ROOM))):.17g}, {t:.17g}" for t in (100.0, 1e7))
#: The largest steady current of a wire whose resistivity is linear in the temperature (ends at room temperature)
BURN_OUT = np.pi * AREA / LENGTH * np.sqrt(LAMBDA / (RHO * SLOPE))


def deck(elements=8, sigma=f"{1 / RHO:.17g}", conductivity=LAMBDA, supply="1, 9, 9, 0.05", heat="ENDS, 11, 11, 300",
         model="", procedure="", loads="", material="", section="", flags=""):  # fmt: skip
    """A straight wire along x, led at its ends."""
    nodes = "\n".join(f"{i + 1}, {x:.17g}, 0, 0" for i, x in enumerate(np.linspace(0, LENGTH, elements + 1)))
    members = "\n".join(f"{i}, {i}, {i + 1}" for i in range(1, elements + 1))
    return f"""\
*UNITS, SYSTEM=SI
*NODE, NSET=ALL
{nodes}
*ELEMENT, TYPE=B31, ELSET=WIRE
{members}
*MATERIAL, NAME=COPPER
*ELASTIC
1.2e11, 0.34
*ELECTRICAL CONDUCTIVITY
{sigma}
*CONDUCTIVITY
{conductivity}
{material}*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC{section}
{RADIUS}
*NSET, NSET=ENDS
1, {elements + 1}
*BOUNDARY
1, ENCASTRE
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, {ROOM}
{model}*STEP
*COUPLED THERMAL-ELECTRICAL, STEADY STATE{flags}
{procedure}*BOUNDARY
{heat}
{elements + 1}, 9
{supply}
{loads}*NODE PRINT, NSET=ALL, TOTALS=YES
NT, RFL, RCURR
*EL PRINT, ELSET=WIRE, TOTALS=YES
HFL, JOULE
*END STEP
"""


def current(amperes, elements=8):
    """A deck's supply by a current."""
    return dict(supply="", loads=f"*CECURRENT\n1, , {amperes:.17g}\n", elements=elements)


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


class TestClosedForms:
    @pytest.mark.parametrize("elements", [2, 7])
    def test_joule_heat_between_cold_ends(self, run, elements):
        """The parabola V^2/(2 lambda rho) s (1 - s), exact at the nodes on any mesh; half of the heat leaves at either end."""
        results = run(elements=elements)
        s = np.linspace(0, 1, elements + 1)
        rise = 0.05**2 / (2 * LAMBDA * RHO) * s * (1 - s)
        np.testing.assert_allclose(results.field("temperature") - ROOM, rise, atol=1e-10 * rise.max())
        power = 0.05**2 * AREA / (RHO * LENGTH)
        assert results.field("reaction_heat")[[0, -1]] == pytest.approx([-power / 2, -power / 2], rel=1e-10)
        assert results.field("joule_heat").sum() == pytest.approx(power, rel=1e-12)
        middle = (s[1:] + s[:-1]) / 2
        flux = -LAMBDA * 0.05**2 / (2 * LAMBDA * RHO) * (1 - 2 * middle) / LENGTH
        np.testing.assert_allclose(results.field("heat_flux"), flux, atol=1e-10 * abs(flux).max())
        assert results.units["heat_flux"] == "W/m^2"

    def test_heat_alone_flows_along_a_wire_whose_conductivity_is_linear_in_the_temperature(self, run):
        """Kirchhoff: int lambda dT is linear; exact at the nodes."""
        results = run(conductivity="200, 200\n1200, 1200", heat="1, 11, 11, 900\n9, 11, 11, 300", supply="1, 9")
        expected = np.sqrt(np.linspace(900**2, 300**2, 9))
        np.testing.assert_allclose(results.field("temperature"), expected, rtol=1e-9)
        assert results.field("reaction_heat")[0] == pytest.approx((900**2 - 300**2) / 2 * AREA / LENGTH, rel=1e-8)

    @pytest.mark.parametrize("share", [0.3, 0.9, 0.98])
    def test_resistivity_linear_in_the_temperature_under_a_current(self, run, share):
        """T - T0 = (cos(m x)/cos(m L/2) - 1)/alpha, m^2 = I^2 rho0 alpha/(lambda A^2); second order in the mesh."""
        errors = []
        for elements in (40, 80):
            temperature = run(sigma=SIGMA, **current(share * BURN_OUT, elements)).field("temperature")
            m = share * np.pi / LENGTH
            x = np.linspace(-LENGTH / 2, LENGTH / 2, elements + 1)
            expected = ROOM + (np.cos(m * x) / np.cos(m * LENGTH / 2) - 1) / SLOPE
            errors.append(abs(temperature - expected).max() / (expected.max() - ROOM))
        # the burn-out current of n elements is 2n tan(pi/2n)/pi of the exact one: 5e-4 high of 40, which 1/(1 - share) enlarges
        assert errors[0] < 1.3e-3 / (1 - share)
        assert errors[0] / errors[1] == pytest.approx(4, rel=0.15)

    def test_part_of_the_power_becomes_heat(self, run):
        results = run(material="*JOULE HEAT FRACTION\n0.25\n")
        rise = 0.25 * 0.05**2 / (8 * LAMBDA * RHO)
        assert results.field("temperature").max() - ROOM == pytest.approx(rise, rel=1e-10)
        assert results.field("reaction_heat").sum() == pytest.approx(
            -0.25 * results.field("joule_heat").sum(), rel=1e-10
        )

    def test_heat_that_is_fed_in_leaves_at_the_ends(self, run):
        results = run(elements=4, supply="1, 9", loads="*CFLUX\n2, 11, 3.0\n")
        assert results.field("reaction_heat")[[0, 4]] == pytest.approx([-2.25, -0.75], rel=1e-10)
        assert results.field("temperature")[1] - ROOM == pytest.approx(2.25 * LENGTH / 4 / (LAMBDA * AREA), rel=1e-9)

    def test_wires_that_are_stretched_conduct_over_their_present_length(self, run):
        pulled = "*STEP\n*STATIC\n*BOUNDARY\n1, 9\n9, 9\n9, 1, 1, 2e-2\n9, 2, 6\n*END STEP\n"
        results = run(model=pulled, section=", CONDUCTION=CURRENT LENGTH")
        assert results.field("reaction_heat").sum() == pytest.approx(-(0.05**2) * AREA / (RHO * 1.2 * LENGTH), rel=1e-8)
        assert results.field("temperature").max() - ROOM == pytest.approx(0.05**2 / (8 * LAMBDA * RHO), rel=1e-8)


class TestSides:
    FIN = "*FILM\nWIRE, F, 290, 40.\n"
    ROD = "*RADIATE\nWIRE, R, 290, 0.8\n"
    SIGMA = 5.670374419e-8
    CONSTANTS = f"*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0, STEFAN BOLTZMANN={SIGMA}\n"

    @pytest.mark.parametrize("volt", [0.0, 0.05])
    @pytest.mark.parametrize("source", [0.0, 2e7])
    def test_a_fin_of_four_elements_is_exact_at_its_nodes(self, run, volt, source):
        """lambda A T'' - h P (T - Ts) + q = 0 with both ends at 300 K."""
        loads = self.FIN + f"*DFLUX\nWIRE, BF, {source}\n"
        results = run(elements=4, supply=f"1, 9, 9, {volt}", loads=loads)
        per_length = 40.0 * 2 * np.pi * RADIUS
        made = ((volt / LENGTH) ** 2 / RHO + source) * AREA
        m = np.sqrt(per_length / (LAMBDA * AREA))
        x = np.linspace(-LENGTH / 2, LENGTH / 2, 5)
        far = 290 + made / per_length
        expected = far + (ROOM - far) * np.cosh(m * x) / np.cosh(m * LENGTH / 2)
        np.testing.assert_allclose(results.field("temperature"), expected, rtol=1e-11)
        lost = made * LENGTH + 2 * LAMBDA * AREA * (ROOM - far) * m * np.tanh(m * LENGTH / 2)
        assert results.field("surface_heat").sum() == pytest.approx(lost, rel=1e-8)

    def test_all_heat_of_a_wire_without_cold_ends_passes_the_film(self, run):
        results = run(heat="1, 9, 9, 0.05", loads=self.FIN)
        power = results.field("joule_heat").sum()
        assert results.field("surface_heat").sum() == pytest.approx(power, rel=1e-9)
        rise = power / (40.0 * 2 * np.pi * RADIUS * LENGTH)
        np.testing.assert_allclose(results.field("temperature"), 290 + rise, rtol=1e-9)

    @pytest.mark.parametrize(("unit", "zero"), [("K", 0.0), ("C", -273.15)])
    def test_a_wire_that_only_radiates_has_one_temperature(self, run, unit, zero):
        """I^2 R = eps sigma P L (T^4 - Ts^4)."""
        constants = self.CONSTANTS.replace("ZERO=0", f"ZERO={zero}")
        loads = f"*RADIATE\nWIRE, R, {290 + zero}, 0.8\n"
        results = run(heat="1, 9, 9, 0.05", loads=loads, model=constants)
        power = 0.05**2 * AREA / (RHO * LENGTH)
        expected = (290**4 + power / (0.8 * self.SIGMA * 2 * np.pi * RADIUS * LENGTH)) ** 0.25 + zero
        np.testing.assert_allclose(results.field("temperature"), expected, rtol=1e-8)

    @pytest.mark.parametrize("conductivity", [LAMBDA, 1.0, 0.01])
    def test_a_wire_that_radiates_under_a_film_has_one_temperature_on_any_mesh(self, run, conductivity):
        """q = h (T - Ts) + eps sigma (T^4 - Ts^4), also where elements are much longer than the length of the fin."""
        from scipy.optimize import brentq

        power = 0.05**2 * AREA / (RHO * LENGTH) / (2 * np.pi * RADIUS * LENGTH)
        expected = brentq(lambda t: 400 * (t - 290) + 0.8 * self.SIGMA * (t**4 - 290**4) - power, 290, 2000, xtol=1e-10)
        results = run(
            elements=2,
            heat="1, 9, 9, 0.05",
            conductivity=conductivity,
            loads="*FILM\nWIRE, F, 290, 400\n*RADIATE\nWIRE, R, 290, 0.8\n",
            model=self.CONSTANTS,
        )
        np.testing.assert_allclose(results.field("temperature"), expected, rtol=1e-8)
        assert results.field("surface_heat").sum() == pytest.approx(results.field("joule_heat").sum(), rel=1e-8)

    def test_a_radiating_wire_between_hot_ends(self, run):
        """Without a current: (lambda A/2) T'^2 = eps sigma P (T^5/5 - Ts^4 T) + constant; integrated by another program."""
        from scipy.integrate import solve_bvp

        c = 0.8 * self.SIGMA * 2 / (LAMBDA * RADIUS)
        x = np.linspace(0, LENGTH, 81)
        bvp = solve_bvp(
            lambda x, y: np.array([y[1], c * (y[0] ** 4 - 290**4)]),
            lambda a, b: np.array([a[0] - 1300, b[0] - 1300]),
            x,
            np.array([1300 + 0 * x, 0 * x]),
            tol=1e-8,
        )
        errors = []
        for elements in (10, 20):
            results = run(
                elements=elements, heat="ENDS, 11, 11, 1300", supply="1, 9", loads=self.ROD, model=self.CONSTANTS
            )
            s = np.linspace(0, LENGTH, elements + 1)
            errors.append(abs(results.field("temperature") - bvp.sol(s)[0]).max() / (1300 - bvp.sol(LENGTH / 2)[0]))
        # second order in the mesh, (m l)^2/12 with m^2 = 4 eps sigma P T^3/(lambda A)
        assert errors[0] < 4 * c * 1300**3 * (LENGTH / 10) ** 2 / 12
        assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)

    def test_steps_keep_films_and_remove_them(self, litz, tmp_path):
        """Of two more steps, the first keeps the source and the film, the second has neither."""
        more = "*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n{}*END STEP\n"
        text = deck(loads=self.FIN + "*DFLUX\nWIRE, BF, 1e6\n1, BF, 1e6\n") + more.format("")
        text += more.format("*FILM, OP=NEW\n*DFLUX, OP=NEW\n")
        (tmp_path / "wire.inp").write_text(text)
        done = litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire", "--quiet")
        assert done.returncode == 0, done.stderr
        results = Results(tmp_path / "wire")
        temperature, lost = results.field("temperature", None), results.field("surface_heat", None)
        np.testing.assert_allclose(temperature[2], temperature[1], rtol=1e-10)
        assert abs(lost[2]).min() > 0
        np.testing.assert_array_equal(lost[3], 0)
        rise = 0.05**2 / (8 * LAMBDA * RHO)
        assert temperature[3].max() - ROOM == pytest.approx(rise, rel=1e-8)

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            (dict(loads=ROD), "*RADIATE needs the Stefan-Boltzmann constant"),
            (
                dict(loads=ROD, model="*PHYSICAL CONSTANTS, STEFAN BOLTZMANN=5.67e-8\n"),
                "*RADIATE needs temperatures from absolute zero",
            ),
            (dict(loads="*RADIATE\nWIRE, R, 290, 1.2\n", model=CONSTANTS), "an emissivity is not larger than 1"),
            (dict(loads=FIN + "*FILM\n1, F, 290, 1\n"), "element 1 has another *FILM"),
            (dict(loads="*FILM\nWIRE, R, 290, 1\n"), "F"),
            (dict(loads="*FILM\nWIRE, F, 290, 0\n"), "h"),
            (dict(loads=FIN + "*FILM, OP=NEW\n"), "all *FILM of a step must have the same OP"),
        ],
    )
    def test_refusals(self, refused, changes, words):
        assert words in refused(1, **changes)

    def test_an_element_that_conducts_no_heat_has_no_film(self, litz, tmp_path):
        text = deck(loads=self.FIN).replace("*CONDUCTIVITY\n390.0\n", "").replace("*ELECTRICAL CONDUCTIVITY\n", "** ")
        (tmp_path / "wire.inp").write_text(text)
        done = litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire")
        assert done.returncode == 1
        assert "conducts no heat: its material COPPER has no *CONDUCTIVITY" in done.stderr

    def test_a_static_step_has_no_film(self, litz, tmp_path):
        text = deck(loads=self.FIN, model="*STEP\n*STATIC\n*FILM\nWIRE, F, 290, 40.\n*BOUNDARY\n1, 9\n*END STEP\n")
        (tmp_path / "wire.inp").write_text(text)
        done = litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire")
        assert done.returncode == 1
        assert "a step that does not solve for temperatures has no *FILM" in done.stderr


class TestIteration:
    @pytest.mark.parametrize(("volt", "most"), [(0.2, 6), (0.4, 7), (1, 8), (3, 9)])
    def test_a_cold_start_converges_whatever_the_rise(self, run, volt, most, tmp_path):
        """Rises from 400 K to 9000 K: 40 elements, where Newton's method for all unknowns at once diverges from 0.4 V on."""
        results = run(elements=40, sigma=SIGMA, supply=f"1, 9, 9, {volt}")
        lines = (tmp_path / "wire" / "wire.cvg").read_text().splitlines()
        assert len(lines) - 1 <= most
        power = volt * results.field("reaction_current")[0]
        assert results.field("joule_heat").sum() == pytest.approx(power, rel=1e-7)
        assert results.field("reaction_heat").sum() == pytest.approx(-power, rel=1e-6)

    def test_a_step_in_increments_ends_at_the_same_temperatures(self, run):
        once = run(elements=20, sigma=SIGMA, supply="1, 9, 9, 0.4").field("temperature")
        several = run(elements=20, sigma=SIGMA, supply="1, 9, 9, 0.4", procedure="0.25, 1\n").field("temperature")
        np.testing.assert_allclose(several, once, rtol=1e-8)

    @pytest.mark.parametrize("solver", ["UMFPACK", "SKYLINE", "BLOCK", pytest.param("MUMPS", marks=pytest.mark.mumps)])
    def test_every_solver(self, run, solver):
        found = run(elements=20, sigma=SIGMA, supply="1, 9, 9, 0.4", loads=f"*SOLVER, NAME={solver}\n").field(
            "temperature"
        )
        if solver != "BLOCK":
            other = run(elements=20, sigma=SIGMA, supply="1, 9, 9, 0.4").field("temperature")
            np.testing.assert_allclose(found, other, rtol=1e-8)

    def test_above_the_burn_out_current_no_temperature_is_steady(self, refused):
        words = refused(2, sigma=SIGMA, **current(1.1 * BURN_OUT, 40))
        largest = float(words.split("no steady temperature above I = ")[1].split()[0])
        # of 40 elements: 2n tan(pi/2n)/pi
        assert largest == pytest.approx(BURN_OUT * 80 / np.pi * np.tan(np.pi / 80), rel=1e-4)

    def test_no_current_is_named_where_none_was_steady(self, refused):
        words = refused(2, sigma=SIGMA, flags=", DIRECT", **current(1.1 * BURN_OUT, 40))
        assert "There may be no steady temperature above this load" in words

    def test_a_table_that_ends_below_the_temperature(self, refused):
        sigma = "5e7, 200\n4e7, 310"
        assert "where the table of *ELECTRICAL CONDUCTIVITY ends at 310" in refused(2, sigma=sigma)


class TestRefusals:
    def test_temperatures_that_nothing_determines(self, refused):
        words = refused(1, heat="1, 9, 9, 0.05")
        assert "the temperature of the wires at node 1 is not determined" in words
        assert "degree of freedom 11" in words

    def test_temperatures_below_absolute_zero(self, refused):
        assert "below absolute zero, 0 (*PHYSICAL CONSTANTS" in refused(2, heat="ENDS, 11, 11, -10")

    def test_degrees_celsius_below_zero_need_absolute_zero(self, run):
        results = run(heat="ENDS, 11, 11, -10", model="*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15\n")
        assert results.field("temperature")[0] == -10

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            (dict(material="*CONDUCTIVITY\n1\n"), "has two *CONDUCTIVITY"),
            (dict(conductivity="400, 300\n390, 300"), "the temperatures of *CONDUCTIVITY must ascend; 300 follows 300"),
            (dict(sigma="4e7, 300\n3e7"), "a temperature is missing"),
            (dict(material="*JOULE HEAT FRACTION\n1.5\n"), "cannot be more than 1"),
            (dict(loads="*CLOAD\n9, 1, 1.0\n"), "motions are held in *COUPLED THERMAL-ELECTRICAL; put this *CLOAD"),
            (dict(heat="9, 1, 1, 1e-3"), "motions are held in *COUPLED THERMAL-ELECTRICAL; prescribe them"),
            (dict(procedure="*STATIC\n"), "this step has two *STATIC"),
            (dict(heat="ENDS, 11, 12, 300"), "degree of freedom 12 does not exist"),
        ],
    )
    def test_decks(self, refused, changes, words):
        assert words in refused(1, **changes)

    def test_a_procedure_without_steady_state(self, litz, tmp_path):
        (tmp_path / "wire.inp").write_text(deck().replace(", STEADY STATE", ""))
        done = litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire")
        assert done.returncode == 1
        assert "in a step without STEADY STATE it needs *DENSITY and *SPECIFIC HEAT" in done.stderr

    @pytest.mark.parametrize("keyword", ["CONDUCTIVITY", "ELECTRICAL CONDUCTIVITY"])
    def test_a_misspelt_property_is_one_error(self, litz, tmp_path, keyword):
        text = deck(loads="*FILM\nWIRE, F, 290, 40\n").replace(f"*{keyword}", f"*{keyword[:-2]}Y")
        (tmp_path / "wire.inp").write_text(text)
        done = litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire")
        assert done.returncode == 1
        assert done.stderr.count("error:") == 1
        assert f"did you mean *{keyword}" in done.stderr

    def test_a_conductor_that_keeps_its_heat(self, litz, tmp_path):
        (tmp_path / "wire.inp").write_text(deck().replace("*CONDUCTIVITY\n390.0\n", ""))
        done = litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire")
        assert done.returncode == 1
        assert "conducts currents, but not their heat; give it *CONDUCTIVITY" in done.stderr


def test_a_static_step_with_given_temperatures_has_their_resistivity(litz, tmp_path):
    text = (
        deck(sigma=SIGMA)
        .replace("*COUPLED THERMAL-ELECTRICAL, STEADY STATE", "*STATIC")
        .replace("ENDS, 11, 11, 300\n", "")
    )
    text = text.replace("NT, RFL, RCURR", "NT, RCURR").replace("HFL, JOULE", "JOULE")
    (tmp_path / "wire.inp").write_text(text.replace("*NODE PRINT", "*TEMPERATURE\nALL, 400\n*NODE PRINT"))
    done = litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire", "--quiet")
    assert done.returncode == 0, done.stderr
    expected = 0.05 * AREA / (RHO * (1 + 100 * SLOPE) * LENGTH)
    assert Results(tmp_path / "wire").field("reaction_current")[0] == pytest.approx(expected, rel=1e-10)


def test_motions_stay_as_a_step_before_has_made_them(run):
    pulled = "*STEP\n*STATIC\n*BOUNDARY\n1, 9\n*CLOAD\n9, 2, 0.01\n9, 4, 1e-4\n*END STEP\n"
    results = run(model=pulled)
    displacement = results.field("displacement", None)
    assert abs(displacement[1]).max() > 1e-5
    np.testing.assert_array_equal(displacement[2], displacement[1])
    assert results.field("temperature").max() - ROOM == pytest.approx(0.05**2 / (8 * LAMBDA * RHO), rel=1e-9)


class TestHeldMotions:
    """A wire between two walls, 40 K warmer, in which a current then flows: its forces stay those of the first step."""

    ALPHA = 17e-6
    WARM = "*STEP\n*STATIC\n*BOUNDARY\n1, 9\n9, ENCASTRE\n*TEMPERATURE\nALL, 340\n{}*END STEP\n"

    def text(self, first="", **changes):
        text = deck(model=self.WARM.format(first + "*ENERGY PRINT\n"), sigma=SIGMA, **changes)
        # given temperatures end where they are solved for
        text = text.replace("*NODE PRINT", "*TEMPERATURE, OP=NEW\n*NODE PRINT")
        text = text.replace("*BEAM SECTION", f"*EXPANSION\n{self.ALPHA}\n*BEAM SECTION")
        return text.replace("*ELASTIC\n1.2e11, 0.34", "*ELASTIC\n1.2e11, 0.34, 300\n1.0e11, 0.34, 400")

    def test_forces_and_energies_are_those_of_the_temperatures_at_which_the_wire_moved_last(self, litz, tmp_path):
        (tmp_path / "wire.inp").write_text(self.text())
        done = litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire", "--quiet")
        assert done.returncode == 0, done.stderr
        results = Results(tmp_path / "wire")
        temperature, force = results.field("temperature", None), results.field("axial_force", None)
        np.testing.assert_array_equal(temperature[1], 340)
        assert temperature[2][0] == ROOM
        # E falls by a sixth over 100 K
        np.testing.assert_allclose(force[1], -1.12e11 * AREA * self.ALPHA * 40, rtol=1e-12)
        np.testing.assert_array_equal(force[2], force[1])
        support = results.field("reaction_force", None)
        np.testing.assert_array_equal(support[2], support[1])
        for energy in ("ALLSE", "ALLTW", "ALLWK"):
            np.testing.assert_array_equal(results.history[energy][1:], results.history[energy][1])

    def test_a_run_goes_on_bit_for_bit(self, litz, tmp_path):
        text = self.text(first=KEEP_ALL, procedure="0.25, 1\n", loads=KEEP_ALL)
        assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_a_run_goes_on_bit_for_bit(litz, tmp_path):
    """Sources, films and radiation over two steps, of which the first is interrupted anywhere."""
    loads = KEEP_ALL + TestSides.FIN + TestSides.ROD + "*DFLUX\nWIRE, BF, 1e6\n*CFLUX\n3, 11, 0.5\n"
    text = deck(sigma=SIGMA, procedure="0.25, 1\n", loads=loads, model=TestSides.CONSTANTS)
    text += "*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n0.5, 1\n*DFLUX, OP=NEW\nWIRE, BF, 2e6\n*BOUNDARY\n1, 9, 9, 0.1\n"
    assert_goes_on_from_everywhere(litz, tmp_path, text + "*END STEP\n")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("WIRE, BF, 1e6", "WIRE, BF, 2e6"), "*DFLUX"),
        (("F, 290, 40.", "F, 290, 41."), "*FILM"),
        (("390.0", "391.0"), "*CONDUCTIVITY"),
    ],
)
def test_a_run_does_not_go_on_with_other_heat(litz, tmp_path, change, words):
    loads = KEEP_ALL + TestSides.FIN + "*DFLUX\nWIRE, BF, 1e6\n"
    (tmp_path / "wire.inp").write_text(deck(procedure="0.5, 1\n", loads=loads))
    assert litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire", "--quiet").returncode == 0
    (tmp_path / "wire.inp").write_text(deck(procedure="0.5, 1\n", loads=loads).replace(*change))
    kept = f"{tmp_path / 'wire' / 'wire.restart.h5'}:1:1"
    done = litz("run", tmp_path / "wire.inp", "-o", tmp_path / "other", "--restart", kept)
    assert done.returncode == 1
    assert words in done.stderr


def test_the_summary_of_a_deck_lists_heat(litz, tmp_path):
    loads = TestSides.FIN + TestSides.ROD.replace("WIRE", "2") + "*DFLUX\n1, BF, 1e6\n"
    (tmp_path / "wire.inp").write_text(deck(sigma="5e7, 200\n3e7, 400", loads=loads, model=TestSides.CONSTANTS))
    summary = litz("check", tmp_path / "wire.inp").stdout
    assert "sigma = 5e+07 S/m at 200 K (2 temperatures), lambda = 390 W/(m K)" in summary
    assert "step 1: currents and temperatures" in summary
    assert "heat sources in 1 element, films on 8 elements, radiation from 1 element" in summary


@pytest.mark.slow
def test_results_tell_temperatures_and_where_heat_leaves(litz, tmp_path):
    (tmp_path / "wire.inp").write_text(deck(loads=TestSides.FIN, model=TestSides.CONSTANTS))
    assert litz("run", tmp_path / "wire.inp", "-o", tmp_path / "wire", "--quiet").returncode == 0
    results = Results(tmp_path / "wire" / "wire.vtkhdf")
    highest = results.field("temperature").max()
    ends, sides = -results.field("reaction_heat").sum(), results.field("surface_heat").sum()
    assert min(ends, sides) > 0
    assert ends + sides == pytest.approx(results.field("joule_heat").sum(), rel=1e-9)
    words = results.summary()
    assert f"to {highest:.5g} K at node 5" in words
    assert f"(prescribed temperatures {ends:.5g} W, films and radiation {sides:.5g} W)" in words
    page = report(results, tmp_path / "report.html").read_text(encoding="utf-8")
    assert "highest temperature, at node 5" in page
    assert "heat out by films and radiation" in page

"""Heat through the contacts of wires: against networks solved in other ways, its laws, and what ends a run."""

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import fsolve

from litz import Results
from run_of_deck import refusal_of_deck, run_of_deck
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

RADIUS, LAMBDA, RHO, LORENZ = 0.5e-3, 400.0, 1.7e-8, 2.44e-8
AREA = np.pi * RADIUS**2
#: Places along x at which wires along y cross one along x, from -10 to 10 mm
CROSSINGS = (-0.004, 0.001, 0.006)
#: Places on the crossing wires, from -6 to 14 mm, which the wire along x crosses at y = 0
ENDS_OF_CROSSING = (-0.006, 0.014)
#: Wires side by side
HOT_SPOT = Path(__file__).parents[2] / "inputs" / "20_hot_spot.inp"
LAP_JOINT = Path(__file__).parents[2] / "inputs" / "15_lap_joint.inp"
HEAT = "*COUPLED THERMAL-ELECTRICAL, STEADY STATE"


def net(*, fine=False, current="*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT\n1e-3", heat="", other=LAMBDA, sigma=f"{1 / RHO:.17g}",
        conductivity=f"{LAMBDA}", volts=0.05, temperatures=(293, 320, 300, 310, 320), procedure=HEAT, time="1, 1",
        constants="*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0", loads="", material="", model="", later=""):  # fmt: skip
    """Three wires that cross one; `fine`: with nodes where they cross, else each wire is one element."""
    lines, elements, wires = [], [], []
    for wire in range(4):
        places = (-0.01, *CROSSINGS, 0.01) if wire == 0 else (ENDS_OF_CROSSING[0], 0.0, ENDS_OF_CROSSING[1])
        places = places if fine else (places[0], places[-1])
        nodes = []
        for s in places:
            x, y, z = (s, 0, 0) if wire == 0 else (CROSSINGS[wire - 1], s, 2 * RADIUS - 5e-7)
            lines.append(f"{len(lines) + 1}, {x:.17g}, {y:.17g}, {z:.17g}")
            nodes.append(len(lines))
        wires.append(nodes)
        elements.append([])
        for first, second in itertools.pairwise(nodes):
            number = sum(map(len, elements)) + 1
            elements[-1].append(f"{number}, {first}, {second}")
    names = ("A", "B", "B", "B")
    members = "\n".join(
        f"*ELEMENT, TYPE=B33, ELSET={name}\n" + "\n".join(some) for name, some in zip(names, elements, strict=True)
    )
    newline = "\n"
    feet = [wire[0] for wire in wires]
    held = [feet[0], wires[0][-1], *feet[1:]]
    hot = "\n".join(
        f"{node}, 11, 11, {value}" for node, value in zip(held, temperatures, strict=True) if value is not None
    )
    supply = "\n".join(f"{node}, 9, 9, {v:.17g}" for node, v in zip(feet, (volts, 0.0, 0.002, 0.004), strict=True))
    return f"""\
*UNITS, SYSTEM=SI
*NODE, NSET=ALL
{newline.join(lines)}
{members}
*MATERIAL, NAME=FIRST
*ELASTIC
1.2e11, 0.34
{material}*ELECTRICAL CONDUCTIVITY
{sigma}
*CONDUCTIVITY
{conductivity}
*MATERIAL, NAME=SECOND
*ELASTIC
1.2e11, 0.34
{material}*ELECTRICAL CONDUCTIVITY
{sigma}
*CONDUCTIVITY
{other}
*BEAM SECTION, ELSET=A, MATERIAL=FIRST, SECTION=CIRC
{RADIUS}
*BEAM SECTION, ELSET=B, MATERIAL=SECOND, SECTION=CIRC
{RADIUS}
{constants}
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1e4
{current}
{heat}
*CONTACT PAIR, INTERACTION=TOUCH
A, B
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 293
{model}*BOUNDARY
ALL, ENCASTRE
*STEP
{procedure}
{time}
*BOUNDARY
{hot}
{supply}
{loads}*NODE PRINT, NSET=ALL, TOTALS=YES
NT, RFL, RCURR
*EL PRINT, ELSET=A, TOTALS=YES
HFL, JOULE
*END STEP
{later}"""


def without_conductors(deck):
    """The lap joint of wires that conduct no current."""
    for card in (r"\*ELECTRICAL CONDUCTIVITY\n.*\n", r"\*ELECTRODE PRINT\n.*\n", r" ?(PLUS|MINUS), 9.*\n"):
        deck = re.sub(card, "", deck)
    return deck


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, net)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, net)


COLUMNS = ("current", "joule_heat", "temperature_1", "temperature_2", "temperature_max", "heat_1", "heat_2")


def contacts_of(results):
    """Columns of the last increment (columns, crossings), in the order of the crossings."""
    last = results.contacts_at(-1)
    order = np.argsort(last["point_2_x"])
    return np.array([last[name][order] for name in COLUMNS])


def spot_heats(law, heat, bulk_1, bulk_2, conductance, other):
    """What a spot gives to either wire, in closed form for wires of the same resistivity."""
    if law == "METAL":
        first = heat / 2 + conductance * LORENZ * (bulk_2**2 - bulk_1**2) / 2
    else:
        # heat conductances of the two constrictions, each with half of the resistance
        h1, h2 = 2 * conductance * RHO * LAMBDA, 2 * conductance * RHO * other
        if law == "CONSTANT":
            h1 = h2 = 0.1
        first = (bulk_2 - bulk_1 + heat / 4 / h1 + 3 * heat / 4 / h2) / (1 / h1 + 1 / h2)
    return first, heat - first


def network(law, other, volts=0.05, temperatures=(293, 320, 300, 310, 320), conductance=1e3):
    """The same wires as a network of resistances to currents and heat, with a node at each place and half of the heat of
    a piece at either end: potentials, then temperatures. Columns as `contacts_of`."""
    pieces, lambdas, at = [], [], {}
    places = np.array([-0.01, *CROSSINGS, 0.01])
    for i in range(4):
        pieces.append((i, i + 1, places[i + 1] - places[i]))
        lambdas.append(LAMBDA)
    for i in range(3):
        foot, crossing, tip = 5 + 3 * i, 6 + 3 * i, 7 + 3 * i
        pieces += [(foot, crossing, 0.006), (crossing, tip, 0.014)]
        lambdas += [other, other]
        at[i] = (i + 1, crossing)
    n = 14
    fixed_v = {0: volts, 5: 0.0, 8: 0.002, 11: 0.004}
    fixed_t = dict(zip((0, 4, 5, 8, 11), temperatures, strict=True))

    def kirchhoff(v):
        flow = np.zeros(n)
        for a, b, length in pieces:
            i = (v[a] - v[b]) * AREA / (RHO * length)
            flow[[a, b]] += [i, -i]
        for a, b in at.values():
            i = conductance * (v[a] - v[b])
            flow[[a, b]] += [i, -i]
        return np.array([v[k] - fixed_v[k] if k in fixed_v else flow[k] for k in range(n)])

    matrix = np.array([kirchhoff(unit) - kirchhoff(np.zeros(n)) for unit in np.eye(n)]).T
    v = np.linalg.solve(matrix, -kirchhoff(np.zeros(n)))

    def balance(t):
        flow = np.zeros(n)
        for (a, b, length), conductivity in zip(pieces, lambdas, strict=True):
            q = (t[a] - t[b]) * conductivity * AREA / length
            half = (v[a] - v[b]) ** 2 * AREA / (RHO * length) / 2
            flow[[a, b]] += [q - half, -q - half]
        for a, b in at.values():
            flow[[a, b]] -= spot_heats(law, conductance * (v[a] - v[b]) ** 2, t[a], t[b], conductance, other)
        return np.array([t[k] - fixed_t[k] if k in fixed_t else flow[k] for k in range(n)])

    t = fsolve(balance, np.full(n, 310.0), xtol=1e-13)
    table = []
    for a, b in at.values():
        heat = conductance * (v[a] - v[b]) ** 2
        first, second = spot_heats(law, heat, t[a], t[b], conductance, other)
        table.append([conductance * (v[a] - v[b]), heat, t[a], t[b], np.nan, first, second])
    return np.array(table).T


def fins(film, around, temperatures=(293, 320, 300, 310, 320), conductance=0.05):
    """The same wires in films, without currents: temperatures of both wires at the crossings, and heat into the first."""
    places = np.array([-0.01, *CROSSINGS, 0.01])
    pieces = [(i, i + 1, places[i + 1] - places[i]) for i in range(4)]
    for foot in (5, 8, 11):
        pieces += [(foot, foot + 1, 0.006), (foot + 1, foot + 2, 0.014)]
    slope = np.sqrt(film * 2 * np.pi * RADIUS / (LAMBDA * AREA))
    matrix, fixed = np.zeros((14, 14)), dict(zip((0, 4, 5, 8, 11), temperatures, strict=True))
    for a, b, length in pieces:
        own, other = 1 / np.tanh(slope * length), -1 / np.sinh(slope * length)
        matrix[np.ix_([a, b], [a, b])] += slope * LAMBDA * AREA * np.array([[own, other], [other, own]])
    pairs = np.array([(1, 6), (2, 9), (3, 12)])
    for a, b in pairs:
        matrix[np.ix_([a, b], [a, b])] += conductance * np.array([[1, -1], [-1, 1]])
    right = np.zeros(14)
    for node, value in fixed.items():
        matrix[node], right[node] = np.eye(14)[node], value - around
    excess = np.linalg.solve(matrix, right)[pairs].T
    return excess + around, conductance * (excess[1] - excess[0])


LAWS = {
    "CONDUCTIVITY": "*GAP CONDUCTANCE, LAW=CONDUCTIVITY",
    "METAL": f"*GAP CONDUCTANCE, LAW=METAL, LORENZ={LORENZ}",
    "CONSTANT": "*GAP CONDUCTANCE, LAW=CONSTANT\n0.05",
}


class TestAgainstNetworks:
    """Wires and spots as resistances to currents and heat, solved by other means."""

    @pytest.mark.parametrize("fine", [True, False], ids=["at nodes", "within elements"])
    @pytest.mark.parametrize(
        ("law", "other"), [("CONDUCTIVITY", LAMBDA), ("CONDUCTIVITY", 150.0), ("METAL", LAMBDA), ("CONSTANT", LAMBDA)]
    )
    def test_crossed_wires_are_the_network_of_their_spots(self, run, law, other, fine):
        """Exact also where several contacts lie within one element."""
        found = contacts_of(run(fine=fine, heat=LAWS[law], other=other))
        expected = network(law, other)
        keep = np.isfinite(expected[:, 0])
        np.testing.assert_allclose(found[keep], expected[keep], rtol=1e-7)

    @pytest.mark.parametrize("fine", [True, False], ids=["at nodes", "within elements"])
    def test_wires_in_a_film_are_the_network_of_their_fins(self, run, fine):
        """What comes to the nodes of an element, what its film takes between these, and what heat does at other places."""
        film, around = 3000.0, 285.0
        results = run(fine=fine, current="*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT\n1e12", heat=LAWS["CONSTANT"],
                      loads=f"*FILM\nA, F, {around}, {film}\nB, F, {around}, {film}\n")  # fmt: skip
        found = contacts_of(results)
        temperatures, heat = fins(film, around)
        np.testing.assert_allclose(found[2:4], temperatures, rtol=1e-9)
        np.testing.assert_allclose(found[5], heat, rtol=1e-8)
        np.testing.assert_allclose(found[6], -heat, rtol=1e-8)
        assert {warning.kind for warning in results.warnings} <= {"round_off"}

    def test_without_the_keyword_heat_passes_as_the_current_does(self, run):
        """By the heat conductivities of the wires, in the constrictions of the current."""
        np.testing.assert_array_equal(contacts_of(run()), contacts_of(run(heat=LAWS["CONDUCTIVITY"])))

    @pytest.mark.parametrize("solver", ["BLOCK, COUPLING=MONOLITHIC", "UMFPACK", "SKYLINE, COUPLING=UPDATED"])
    def test_every_solver_finds_the_same(self, run, solver):
        found = contacts_of(run(heat=LAWS["METAL"], loads=f"*SOLVER, NAME={solver}\n"))
        np.testing.assert_allclose(found, contacts_of(run(heat=LAWS["METAL"])), rtol=1e-7)

    @pytest.mark.parametrize("metal", ["", ", YIELD=60e6"], ids=["elastic", "yielding"])
    def test_heat_passes_side_by_side_as_the_current_does(self, litz, tmp_path, metal):
        """The resistance of a lap joint to heat is that to the current, times sigma over lambda."""
        deck = LAP_JOINT.read_text().replace("*ELECTRICAL CONDUCTIVITY", "*CONDUCTIVITY\n400\n*ELECTRICAL CONDUCTIVITY")
        deck = deck.replace("LAW=FILM\n 1e-11", "LAW=HERTZ").replace("OVERCLOSURE=HERTZ", f"OVERCLOSURE=HERTZ{metal}")
        deck += f"*STEP\n{HEAT}\n1, 1\n*BOUNDARY\nPLUS, 9, 9, 0\nPLUS, 11, 11, 310\nMINUS, 11, 11, 300\n*END STEP\n"
        (tmp_path / "lap.inp").write_text(deck)
        done = litz("run", tmp_path / "lap.inp", "-o", tmp_path / "lap", "--quiet")
        assert done.returncode == 0, done.stderr
        results = Results(tmp_path / "lap")
        resistance = results.history["resistance PLUS to MINUS"][-2]
        heat = np.abs(results.field("reaction_heat")).max()
        assert 10 / heat == pytest.approx(resistance * 5.88e7 / 400, rel=1e-12)

    @pytest.mark.slow
    @pytest.mark.parametrize(
        ("law", "metal"), [("CONDUCTIVITY", ""), ("CONDUCTIVITY", ", YIELD=60e6"), ("CONSTANT, PER=LENGTH\n20", "")]
    )
    @pytest.mark.parametrize("insulated", ["a film that no current passes", "no conductors"])
    def test_lines_pass_heat_without_a_current(self, litz, tmp_path, law, metal, insulated):
        """As much as with one: the strip of clean metal, whatever its resistivity."""
        deck = LAP_JOINT.read_text().replace("*ELECTRICAL CONDUCTIVITY", "*CONDUCTIVITY\n400\n*ELECTRICAL CONDUCTIVITY")
        deck = deck.replace("*CONTACT PAIR", f"*GAP CONDUCTANCE, LAW={law}\n*CONTACT PAIR").replace(
            "LAW=FILM\n 1e-11", "LAW=HERTZ"
        )
        deck = deck.replace("OVERCLOSURE=HERTZ", f"OVERCLOSURE=HERTZ{metal}")
        heat = f"*STEP\n{HEAT}\n1, 1\n*BOUNDARY\nPLUS, 9, 9, 0\nPLUS, 11, 11, 310\nMINUS, 11, 11, 300\n*END STEP\n"
        passed = []
        for name in ("current", "none"):
            text = deck + heat
            if name == "none":
                text = text.replace("*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ\n", "")
                text = without_conductors(text) if insulated == "no conductors" else text
            (tmp_path / f"{name}.inp").write_text(text)
            done = litz("run", tmp_path / f"{name}.inp", "-o", tmp_path / name, "--quiet")
            assert done.returncode == 0, done.stderr
            passed.append(np.abs(Results(tmp_path / name).field("reaction_heat")).max())
        assert passed[0] > 0.05
        assert passed[1] == pytest.approx(passed[0], rel=1e-6)

    @pytest.mark.parametrize("law", ["CONSTANT\n20", "TABLE\n1, 10\n2, 20"])
    def test_a_heat_conductance_of_a_spot_is_none_of_a_line(self, litz, tmp_path, law):
        deck = LAP_JOINT.read_text().replace("*CONTACT PAIR", f"*GAP CONDUCTANCE, LAW={law}\n*CONTACT PAIR")
        (tmp_path / "lap.inp").write_text(deck)
        done = litz("run", tmp_path / "lap.inp", "-o", tmp_path / "lap", "--quiet")
        assert done.returncode == 2
        assert "LAW=" + law.split("\n")[0] in done.stderr
        assert "which is that of a spot without PER=LENGTH" in done.stderr


class TestSpots:
    """What a spot makes and passes."""

    def test_the_heat_of_the_current_enters_both_wires(self, run):
        _, joule, *_, first, second = contacts_of(run())
        np.testing.assert_allclose(first + second, joule, rtol=1e-12)

    def test_the_hottest_place_is_that_of_kohlrausch(self, run):
        """Equal bulks: V^2 = 4 L (T_max^2 - T^2)."""
        results = run(heat=LAWS["METAL"], temperatures=(293, 293, 293, 293, 293))
        current, joule, *_ = contacts_of(results)
        _, _, bulk_1, bulk_2, hottest, first, _ = contacts_of(results)
        # the vertex from the side of the first wire: (q_1/I)^2 = L (T_max^2 - T_1^2)
        np.testing.assert_allclose(hottest**2 - bulk_1**2, (first / current) ** 2 / LORENZ, rtol=1e-9)
        assert (hottest > np.maximum(bulk_1, bulk_2)).all()
        assert (joule > 0).all()

    @pytest.mark.parametrize("heat", [LAWS["CONSTANT"], "*GAP CONDUCTANCE, LAW=TABLE\n0.001, 0.01\n0.1, 0.25"])
    def test_insulated_wires_pass_heat(self, run, heat):
        """The table is a power law of exponent 0.7; 5 mN."""
        results = run(current="", heat=heat, volts=0.0)
        _, joule, bulk_1, bulk_2, hottest, first, second = contacts_of(results)
        expected = 0.05 if "CONSTANT" in heat else 0.01 * 5.0 ** (np.log(25) / np.log(100))
        np.testing.assert_allclose(first, expected * (bulk_2 - bulk_1), rtol=1e-9)
        np.testing.assert_allclose(second, -first, rtol=1e-12)
        np.testing.assert_array_equal(hottest, np.maximum(bulk_1, bulk_2))
        assert (joule == 0).all()

    @pytest.mark.parametrize("fine", [True, False], ids=["at nodes", "within elements"])
    def test_spots_may_conduct_as_well_as_they_like(self, run, fine):
        """Then the wires have one temperature where they cross, and pass heat that round-off does not touch."""
        well, better = (
            contacts_of(run(heat=f"*GAP CONDUCTANCE, LAW=CONSTANT\n{h}", fine=fine)) for h in ("1e5", "1e9")
        )
        np.testing.assert_allclose(better[2], better[3], rtol=1e-9)
        np.testing.assert_allclose(better[5:], well[5:], rtol=1e-3, atol=1e-4)

    def test_a_force_outside_the_table_is_a_warning(self, run):
        """5 mN in each contact; a table from 10 mN on."""
        warnings = run(current="", heat="*GAP CONDUCTANCE, LAW=TABLE\n0.01, 0.01\n0.1, 0.25", volts=0.0).warnings
        found = [warning.message for warning in warnings if warning.kind == "outside_table"]
        # one for all three
        assert len(found) == 1
        assert "outside the table of its heat conductance (from 0.01 to 0.1 N)" in found[0]
        assert found[0].endswith("; it is the worst of 3 places of contact")

    def test_insulated_wires_pass_heat_in_the_spots_of_elastic_wires(self, run):
        """Round spots of crossed equal wires: 2 a lambda, a^3 = 3 F r/(4 E*)."""
        results = run(current="", heat="*GAP CONDUCTANCE, LAW=CONDUCTIVITY")
        _, _, bulk_1, bulk_2, _, first, _ = contacts_of(results)
        modulus = 1.2e11 / (2 * (1 - 0.34**2))
        radius = (3 * 5e-3 * RADIUS / (4 * modulus)) ** (1 / 3)
        np.testing.assert_allclose(first, 2 * radius * LAMBDA * (bulk_2 - bulk_1), rtol=1e-6)

    def test_insulated_wires_pass_none_without_the_keyword(self, refused):
        """Then nothing cools a wire that nothing else holds."""
        message = refused(2, current="", temperatures=(293, 320, None, 310, 320), volts=0.0)
        assert "the temperature of the wires at node 3 is not determined" in message
        assert "*GAP CONDUCTANCE" in message

    def test_a_contact_holds_the_temperature_of_a_wire(self, run):
        """No heat leaves a wire but through its contact, and none is made in it."""
        results = run(current="", heat=LAWS["CONSTANT"], temperatures=(293, 320, None, None, None), volts=0.0)
        _, _, bulk_1, bulk_2, _, first, second = contacts_of(results)
        np.testing.assert_allclose(bulk_2, 293 + 27 * (np.array(CROSSINGS) + 0.01) / 0.02, rtol=1e-7)
        np.testing.assert_allclose(bulk_1, bulk_2, rtol=1e-7)
        np.testing.assert_allclose([first, second], 0, atol=1e-9)

    def test_friction_heats_both_wires(self, litz, tmp_path):
        """A wire is drawn over another one: what enters is the work of friction, half of it in either."""
        passings = ("", "*GAP CONDUCTANCE, LAW=CONDUCTIVITY\n")
        for fraction, passing in itertools.product(("", "*GAP HEAT GENERATION\n0.25\n"), passings):
            (tmp_path / "rub.inp").write_text(RUB.format(generation=fraction + passing))
            done = litz("run", tmp_path / "rub.inp", "-o", tmp_path / "rub", "--quiet")
            assert done.returncode == 0, done.stderr
            results = Results(tmp_path / "rub")
            heat, work, before = 0.0, 0.0, 0.0
            for increment in range(len(results.times)):
                contacts = results.contacts_at(increment)
                span = results.times[increment] - before
                before = results.times[increment]
                if not passing:
                    np.testing.assert_allclose(contacts["heat_1"], contacts["heat_2"], rtol=1e-12)
                heat += span * (contacts["heat_1"] + contacts["heat_2"]).sum()
                work = contacts["dissipation"].sum()
            assert work > 1e-5
            assert heat == pytest.approx((0.25 if fraction else 1.0) * work, rel=1e-9)


class TestIteration:
    """Newton's method for potentials and temperatures."""

    def test_it_converges_quadratically(self, run):
        results = run(heat="*GAP CONDUCTANCE, LAW=METAL", volts=0.15, sigma=f"{1 / RHO:.17g}, 293\n{0.4 / RHO:.17g}, 693",
                      conductivity="400, 293\n350, 693", other="400, 293\n350, 693", temperatures=(293,) * 5)  # fmt: skip
        residuals = results.convergence["heat"]
        # the last step is from near the solution
        assert residuals[-2] > 10 * results.convergence["heat_allowed"][-2]
        assert residuals[-1] < residuals[-2] ** 2 / residuals.max()

    def test_a_metal_starts_at_absolute_zero(self, litz, tmp_path):
        """Temperatures begin at 0 where nothing says otherwise, where spots of a metal have no heat conductance: a steady
        state does not depend on it."""
        deck = HOT_SPOT.read_text()
        found = []
        for name, text in (("warm", deck), ("cold", re.sub(r"\*INITIAL CONDITIONS.*\n.*\n", "", deck))):
            (tmp_path / f"{name}.inp").write_text(text)
            done = litz("run", tmp_path / f"{name}.inp", "-o", tmp_path / name, "--quiet")
            assert done.returncode == 0, done.stderr
            found.append(Results(tmp_path / name).contacts_at(-1)["temperature_max"])
        np.testing.assert_allclose(found[1], found[0], rtol=1e-7)

    def test_a_restarted_run_goes_on_bit_for_bit(self, litz, tmp_path):
        storage = "*DENSITY\n8900\n*SPECIFIC HEAT\n390\n*EXPANSION, ZERO=293\n1.7e-5\n"
        text = net(heat="*GAP CONDUCTANCE, LAW=METAL", procedure="*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, DELTMX=20",
                   time="0.02, 0.2", material=storage, loads=KEEP_ALL, fine=True)  # fmt: skip
        assert_goes_on_from_everywhere(litz, tmp_path, text)


class TestRefusals:
    """What ends a run, or the reading of a deck."""

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            (dict(heat="*GAP CONDUCTANCE, LAW=METAL", constants=""), "LAW=METAL needs temperatures from absolute zero"),
            (dict(heat="*GAP CONDUCTANCE, LAW=CONDUCTIVITY, LORENZ=2e-8"), "LORENZ= is for LAW=METAL"),
            (dict(heat="*GAP CONDUCTANCE, LAW=METAL, PER=LENGTH"), "PER=LENGTH is for LAW=CONSTANT and LAW=TABLE"),
            (dict(heat="*GAP CONDUCTANCE, LAW=CONSTANT"), "a data line is missing"),
            (dict(heat="*GAP CONDUCTANCE, LAW=CONSTANT\n-1"), "greater than 0"),
            (dict(heat="*GAP CONDUCTANCE, LAW=TABLE\n2, 1\n1, 2"), "must ascend"),
            (dict(heat="*GAP CONDUCTANCE, LAW=HERTZ"), "CONDUCTIVITY"),
            (dict(heat="*GAP CONDUCTANCE, LAW=METAL\n*GAP CONDUCTANCE, LAW=METAL"), "has two *GAP CONDUCTANCE"),
            (dict(heat="*GAP HEAT GENERATION\n1.5"), "from 0 to 1, not 1.5"),
            (dict(heat="*GAP HEAT GENERATION\n1, 0.3"), "half and half"),
        ],
    )
    def test_decks(self, refused, changes, words):
        assert words in refused(1, **changes)

    def test_a_spot_that_melts_ends_the_run(self, refused):
        message = refused(2, heat="*GAP CONDUCTANCE, LAW=METAL, TMELT=330")
        assert "would be at" in message
        assert "and melt (TMELT=330 of *GAP CONDUCTANCE; MELTING=WARN lets it)" in message
        assert "no steady temperature" not in message

    def test_hot_spots_are_warnings(self, run):
        for heat, change in (
            ("TSOFT=325", "softens above 325"),
            ("TSOFT=325, TMELT=330, MELTING=WARN", "melts above 330"),
        ):
            warnings = run(heat=f"*GAP CONDUCTANCE, LAW=METAL, {heat}").warnings
            assert any(change in warning.message for warning in warnings if warning.kind == "hot_spot")


#: A wire pressed on another one is drawn along itself, over time
RUB = """\
*NODE, NSET=ALL
1, -0.01, 0, 0
2, 0.01, 0, 0
11, 0, -0.01, 0.9995e-3
12, 0, 0.01, 0.9995e-3
*ELEMENT, TYPE=B33, ELSET=A
1, 1, 2
*ELEMENT, TYPE=B33, ELSET=B
2, 11, 12
*MATERIAL, NAME=STEEL
*ELASTIC
2e11, 0.3
*CONDUCTIVITY
50
*DENSITY
7800
*SPECIFIC HEAT
460
*BEAM SECTION, ELSET=A, MATERIAL=STEEL, SECTION=CIRC
0.0005
*BEAM SECTION, ELSET=B, MATERIAL=STEEL, SECTION=CIRC
0.0005
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1e6
*FRICTION
0.3
{generation}*CONTACT PAIR, INTERACTION=TOUCH
A, B
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 293
*BOUNDARY
1, ENCASTRE
2, ENCASTRE
11, 2, 6
12, 2, 6
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT
0.1, 1
*BOUNDARY
11, 1, 1, 1e-3
12, 1, 1, 1e-3
ALL, 11, 11, 293
*END STEP
"""

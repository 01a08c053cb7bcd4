"""The list of claims stands up, and the quick claims hold."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))

from verification.cases.elastica import LOADS
from verification.cases.solvers import INPUTS, residual_difference
from verification.claims import Claim, ClaimError, judge, missed, read_claims
from verification.deck_text import Rigidity
from verification.deck_transform import Units, in_units, renumbered, rotated, swapped_contact_pairs
from verification.numerics import rotation
from verification.references import (
    contact_element,
    crossed_wires,
    elastica,
    greenwood,
    hertz,
    network,
    pushed_cantilever,
    rod,
    twisted_rod,
)
from verification.report import write_reports
from verification.run import CaseReport, verify

CLAIM = {
    "id": "elastica.test",
    "title": "a title",
    "script": "elastica",
    "source": "A. Author, Journal of Beams 1 (1900) 1-10, table 1",
    "provenance": "READ",
    "quantity": "deflection",
    "unit": "m",
    "reference": 2.0,
    "comparison": "relative",
    "tolerance": 1e-3,
    "reason": "three digits in the source",
}


@pytest.fixture
def claim():
    return Claim(**CLAIM)


def test_the_list_of_claims_can_be_read():
    assert len(read_claims()) > 5


@pytest.mark.parametrize("source", ["", "  ", "litz, an earlier run of the same deck", "a paper"])
def test_a_claim_without_a_source_outside_litz_is_refused(source):
    with pytest.raises(ClaimError, match="source"):
        Claim(**CLAIM | {"source": source})


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("provenance", "MEMORY", "allowed are READ"),
        ("reason", "", "reason is empty"),
        ("comparison", "roughly", "allowed are relative"),
        ("reference", 0.0, "needs an absolute tolerance"),
        ("tolerance", 0.0, "must be positive"),
        ("script", "nothing", "no cases/nothing.py"),
    ],
)
def test_a_claim_that_cannot_stand_is_refused(name, value, message):
    with pytest.raises(ClaimError, match=message):
        Claim(**CLAIM | {name: value})


def test_an_unknown_or_missing_entry_and_a_claim_given_twice_are_refused(tmp_path):
    def written(*entries):
        def lines(entry):
            return [f"{key} = {value!r}" for key, value in entry.items()]

        blocks = ["\n".join(["[[case.claim]]", *lines(entry)]) for entry in entries]
        (tmp_path / "claims.toml").write_text("\n".join(["[[case]]", *blocks]))
        return tmp_path / "claims.toml"

    assert read_claims(written(CLAIM)) == [Claim(**CLAIM)]
    with pytest.raises(ClaimError, match="unknown tolerence"):
        read_claims(written(CLAIM | {"tolerence": 1.0}))
    with pytest.raises(ClaimError, match="no reason"):
        read_claims(written({key: value for key, value in CLAIM.items() if key != "reason"}))
    with pytest.raises(ClaimError, match=r"twice: elastica\.test"):
        read_claims(written(CLAIM, CLAIM))


@pytest.mark.parametrize(("value", "passed"), [(2.0, True), (2.0019, True), (2.0021, False), (float("nan"), False)])
def test_a_relative_difference_is_judged(claim, value, passed):
    assert judge(claim, value).passed is passed


def test_a_list_is_judged_by_its_worst_value():
    claim = Claim(**CLAIM | {"reference": [0.0, 1.0], "comparison": "absolute"})
    assert judge(claim, [1e-4, 1.0]).passed
    assert not judge(claim, [1e-4, 1.01]).passed
    assert not judge(claim, [1e-4]).passed


def test_a_bound_is_judged():
    claim = Claim(**CLAIM | {"comparison": "at_most", "tolerance": 10, "reference": "36 elsewhere"})
    assert judge(claim, 10).passed
    assert not judge(claim, 11).passed


def test_the_reports_say_how_many_claims_were_not_asked_for_and_how_close_the_others_are(tmp_path, claim):
    # half of the tolerance is used
    near = judge(claim, claim.reference * (1 + claim.tolerance / 2))
    write_reports([CaseReport("elastica", "A title", [near], None, 1.0, ["a.inp", "b.inp"])], tmp_path)
    for name in ("report.md", "report.html"):
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert f"The other {len(read_claims()) - 1} of {len(read_claims())} claims were not asked for." in text
        assert "1 of 1" in text
        assert "50%" in text
        assert text.count("a.inp, b.inp") == 1


def test_the_reports_tell_what_is_compared_with_litz_itself_from_what_is_verified(tmp_path):
    claims = [Claim(**CLAIM), Claim(**CLAIM | {"id": "elastica.itself", "provenance": "CONSISTENCY"})]
    write_reports([CaseReport("elastica", "A title", [judge(claim, 2.0) for claim in claims], None, 1.0)], tmp_path)
    text = (tmp_path / "report.md").read_text(encoding="utf-8")
    assert "1 compare litz with other sources, 1 with itself (CONSISTENCY)." in text


def test_the_reports_show_misses(tmp_path, claim):
    report = CaseReport("elastica", "A title\n\nSource: ...", [judge(claim, 2.0), missed(claim, "it broke")], None, 1.0)
    write_reports([report], tmp_path)
    for name in ("report.md", "report.html"):
        text = (tmp_path / name).read_text()
        assert "1 hold, 1 missed" in text
        assert "MISS" in text
        assert "it broke" in text


# References: the numbers in the list are those that the modules compute, and these agree with each other.


@pytest.mark.slow
def test_the_values_of_the_elastica_are_those_of_the_elliptic_integrals():
    claims = {claim.id: claim for claim in read_claims()}
    exact = np.array([elastica.cantilever(load) for load in LOADS])
    for i, name in enumerate(("deflection", "shortening", "angle")):
        np.testing.assert_allclose(claims[f"elastica.B33.{name}"].reference, exact[:, i], rtol=1e-9)


@pytest.mark.slow
def test_shooting_and_elliptic_integrals_agree():
    rigidity = Rigidity(ea=1e12, ga=1e12, gj=1.0, ei2=1.0, ei3=1.0)
    deflection, shortening, _ = elastica.cantilever(5.0)
    tip = rod.tip([rod.Piece(1.0)], rigidity, (0.0, 5.0, 0.0))
    np.testing.assert_allclose(tip, [1.0 - shortening, deflection, 0.0], atol=1e-9)


def test_shooting_rolls_a_rod_up_to_the_circle_of_its_moment():
    rigidity = Rigidity(ea=1e12, ga=1e12, gj=1.0, ei2=1.0, ei3=1.0)
    tip = rod.tip([rod.Piece(1.0)], rigidity, (0.0, 0.0, 0.0), moment=(0.0, 0.0, np.pi))
    np.testing.assert_allclose(tip, [0.0, 2.0 / np.pi, 0.0], atol=1e-9)


def test_the_free_shape_of_a_curved_piece_is_its_arc():
    points = rod.free_shape([rod.Piece(np.pi, (0.0, 0.0, 1.0))], 2)
    np.testing.assert_allclose(points, [[0, 0, 0], [1, 1, 0], [0, 2, 0]], atol=1e-12)


@pytest.mark.parametrize(
    ("degrees", "ratio", "semi_major", "approach", "peak", "resistance"),
    [
        (90, 1.0, 0.9085602964, 0.8254818122, 0.5784074491, 0.5503212081),
        (45, 0.3134388680, 1.750307007, 0.7055505594, 0.4972331485, 0.4703670396),
        (20, 0.1080053783, 3.467076289, 0.4984602126, 0.3677639947, 0.3323068084),
    ],
)
def test_spots_of_crossed_wires_of_unit_radius_modulus_and_force(
    degrees, ratio, semi_major, approach, peak, resistance
):
    """Values computed by other means, ten digits; their product R dF/d(approach) is E* rho (Barber)."""
    spot = hertz.crossed_wires(1, np.radians(degrees), radius=(1, 1), modulus=1, resistivity=(1, 1))
    found = [spot.semi_minor / spot.semi_major, spot.semi_major, spot.approach, spot.peak_pressure, spot.resistance]
    np.testing.assert_allclose(found, [ratio, semi_major, approach, peak, resistance], rtol=1e-9)
    assert spot.resistance * spot.stiffness == pytest.approx(1.0, rel=1e-14)


def test_the_circular_spot_is_the_limit_of_the_elliptic_ones():
    for nearly_square in (np.pi / 2, np.pi / 2 - 1e-8):
        spot = hertz.crossed_wires(2, nearly_square, radius=(3, 3), modulus=5, resistivity=(1, 1))
        assert spot.semi_major == pytest.approx((3 * 2 * 3 / (4 * 5)) ** (1 / 3), rel=1e-7)
    assert hertz.force_of_approach(spot.approach, nearly_square, radius=(3, 3), modulus=5) == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("support", "bending", "shear"),
    [("supported", 1 / 48, 1 / 4), ("clamped", 1 / 192, 1 / 4), ("cantilever", 1 / 24, 1 / 2)],
)
def test_deflections_in_the_middle_are_those_of_the_handbooks(support, bending, shear):
    found = crossed_wires.deflection(support, 2.0, 1.0, 1.0, ei=3.0, ga=5.0)
    assert found == pytest.approx(bending * 2.0**3 / 3.0 + shear * 2.0 / 5.0, rel=1e-12)


@pytest.mark.parametrize("support", ["supported", "clamped", "cantilever"])
def test_deflections_are_reciprocal(support):
    pair = (0.3, 1.1)
    there, back = (crossed_wires.deflection(support, 2.0, *order, ei=3.0, ga=5.0) for order in (pair, pair[::-1]))
    assert there == pytest.approx(back, rel=1e-12)


@pytest.mark.slow
def test_wires_that_are_bent_little_have_the_force_of_clamped_beams_and_those_bent_far_a_larger_one():
    wire = {"ei": 3.0, "ea": 1e9}
    stiffness = 192 * 3.0 / 2.0**3
    little, far = (crossed_wires.force_of_large_deflection(push, 2.0, 0.0, **wire) for push in (1e-3, 0.4))
    assert little == pytest.approx(1e-3 * stiffness / 2, rel=1e-5)
    assert 1.02 < far / (0.4 * stiffness / 2) < 1.10


def test_a_twisted_rod_bends_as_a_supported_beam_without_torque_and_without_bound_at_that_of_greenhill():
    assert twisted_rod.deflection(1e-3).real == pytest.approx(1 / 48, rel=1e-6)
    near, nearer = (twisted_rod.deflection(2 * np.pi * (1 - distance)).real for distance in (1e-3, 1e-4))
    assert nearer / near == pytest.approx(10.0, rel=1e-2)


def test_a_grid_of_one_crossing_is_a_crossing_and_open_ones_carry_nothing():
    one = crossed_wires.force(0.1, 0.5, lambda f: f / 7.0)
    assert one == pytest.approx(0.1 / (0.5 + 1 / 7.0), rel=1e-12)
    forces = crossed_wires.grid_forces(
        np.array([-0.1, 0.2]), np.array([[0.5, 0.1], [0.1, 0.5]]), lambda o: 7.0 * o, lambda o: 7.0 * np.ones_like(o)
    )
    np.testing.assert_allclose(forces, [one, 0.0], rtol=1e-12)


@pytest.mark.parametrize("axis", ["linear", "hermite"])
def test_the_contact_element_in_complex_numbers_has_the_force_and_the_conductance_of_crossed_wires(axis):
    tangents = np.array([[1.0, 0.0, 0.0], [np.cos(np.pi / 3), np.sin(np.pi / 3), 0.0]]).repeat(2, axis=0)
    x = tangents * [[-1], [1], [-1], [1]]
    x[:2, 2] = 0.19
    pair = contact_element.Pair(
        x, tangents, np.array([3.0, 3.0, 1.0, 1.0]), *(np.full(2, value) for value in (2, 0.1, 2, 0, 0.5)),
        axis=axis, law="hertz",
    )  # fmt: skip
    state = contact_element.evaluate(pair, np.zeros(28))
    force = hertz.force_of_approach(0.01, np.pi / 3, radius=(0.1, 0.1), modulus=1)
    spot = hertz.crossed_wires(force, np.pi / 3, radius=(0.1, 0.1), modulus=1, resistivity=(0.5, 0.5))
    assert state.force.real == pytest.approx(force, rel=1e-12)
    assert 1 / state.conductance.real == pytest.approx(spot.resistance, rel=1e-12)
    forces, currents = state.mechanical().real.reshape(4, 6), state.electric().real
    assert forces[:2, 2].sum() == pytest.approx(-force, rel=1e-12)
    np.testing.assert_allclose(forces[:, :3].sum(axis=0), 0.0, atol=1e-15)
    np.testing.assert_allclose(currents, np.array([1, 1, -1, -1]) / spot.resistance, rtol=1e-12)


def test_spots_side_by_side_have_the_resistance_that_greenwood_gives():
    """In at one spot, out at another: rho (1/(4 a1) + 1/(4 a2) - 1/(pi d)); two in parallel: rho/(4 a) + rho/(2 pi s)."""
    v = greenwood.one_side([[0, 0], [100, 0]], [1, 1], [1, -1], 1e4)
    assert v[0] - v[1] == pytest.approx(4968.169011381, rel=1e-12)
    assert greenwood.together([[0, 0], [7, 0]], [0.5, 0.5], 3.0) == pytest.approx(3 / 2 + 3 / (14 * np.pi), rel=1e-12)


def test_a_cantilever_that_is_pushed_little_bends_as_a_beam_and_is_straight_beyond():
    found = pushed_cantilever.solve((0.5, 0.1 - 1e-5), 1.0, 0.1, 7.0, ei=3.0, ea=1e6, ga=5.0, support_compliance=0.2)
    compliance = 0.5**3 / (3 * 3.0) + 0.5 / 5.0
    assert found.force == pytest.approx(1e-5 / (compliance + 0.2 + 1 / 7.0), rel=1e-4)
    assert found.gap == pytest.approx(-found.force / 7.0)
    assert found.angle == pytest.approx(-found.force * 0.5**2 / (2 * 3.0), rel=1e-4)
    assert found.tip[1] == pytest.approx(found.position[1] + 0.5 * found.angle, rel=1e-4)


def test_potentials_of_a_network_follow_from_resistors_in_series():
    np.testing.assert_allclose(network.potentials(3, [(0, 1, 2.0), (1, 2, 3.0)], {0: 5.0, 2: 0.0}), [5.0, 3.0, 0.0])


# Transformed decks: each says something else than the deck it comes from, else equal results would prove nothing.

DECK = """*HEADING
A title, with a comma
*NODE, NSET=ALL
 1, 0., 0., 0.
 2, 2., 0., 0.
*ELEMENT, TYPE=B33, ELSET=WIRE
 5, 1, 2
*MATERIAL, NAME=M
*ELASTIC
 3., 0.25
*BEAM SECTION, ELSET=WIRE, MATERIAL=M, SECTION=CIRC
 0.5
 0., 0., 1.
*CONTACT PAIR, INTERACTION=TOUCH
 WIRE, OTHER
*BOUNDARY
 1, ENCASTRE
*STEP
*STATIC
*BOUNDARY
 2, 2, 2, 4.
 2, 9, 9, 7.
*CLOAD
 2, 1, 6.
 2, 5, 8.
*END STEP
"""


def rows(text, keyword):
    """The data lines after the last card of that keyword, as lists of words."""
    lines = text.split(f"*{keyword}")[-1].splitlines()[1:]
    end = next(i for i, line in enumerate(lines) if line.startswith("*"))
    return [[word.strip() for word in line.split(",")] for line in lines[:end]]


def test_other_units_scale_each_number_by_its_dimension():
    text = in_units(DECK, Units(length=10.0, force=3.0, voltage=5.0))
    assert [float(x) for x in rows(text, "NODE")[1]] == [2, 20, 0, 0]
    assert [float(x) for x in rows(text, "ELASTIC")[0]] == pytest.approx([3 * 3 / 100, 0.25])
    assert [float(row[0]) for row in rows(text, "BEAM SECTION")] == [5, 0]
    assert [float(row[3]) for row in rows(text, "BOUNDARY")] == [40, 35]
    assert [float(row[2]) for row in rows(text, "CLOAD")] == [18, 240]
    assert "A title, with a comma" in text


def test_renumbering_changes_every_number_and_keeps_the_model():
    text, nodes, elements = renumbered(DECK)
    assert set(nodes) == {1, 2}
    assert all(old != new for old, new in [*nodes.items(), *elements.items()])
    assert rows(text, "ELEMENT") == [[str(elements[5]), str(nodes[1]), str(nodes[2])]]
    assert {row[0]: float(row[1]) for row in rows(text, "NODE")} == {str(nodes[1]): 0.0, str(nodes[2]): 2.0}
    assert rows(text, "CLOAD")[0][0] == str(nodes[2])


def test_swapping_exchanges_the_contact_partners():
    assert rows(swapped_contact_pairs(DECK), "CONTACT PAIR") == [["OTHER", "WIRE"]]


def test_turning_moves_nodes_loads_and_prescribed_values():
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    text = rotated(DECK, quarter)
    assert [float(x) for x in rows(text, "NODE")[1]] == [2, 0, 2, 0]
    assert [(row[1], float(row[2])) for row in rows(text, "CLOAD")] == [("2", 6.0), ("4", -8.0)]
    assert [(row[1], float(row[3])) for row in rows(text, "BOUNDARY")] == [("9", 7.0), ("1", -4.0)]


def test_an_oblique_turn_of_a_single_prescribed_direction_is_refused():
    with pytest.raises(ValueError, match="cannot be turned obliquely"):
        rotated(DECK, rotation([0.3, 0.2, 0.1]))


def test_iterations_that_differ_are_seen():
    names = ("force", "moment", "current")
    first = {name: np.array([1.0, 1e-9]) for name in names} | {f"{name}_allowed": np.full(2, 1e-8) for name in names}
    first |= {name: np.ones(2, dtype=int) for name in ("step", "increment", "attempt")}
    first["iteration"] = np.array([0, 1])
    assert residual_difference(first, first) == 0.0
    assert residual_difference(first, first | {"force": np.array([1.01, 1e-9])}) == pytest.approx(0.01)
    assert residual_difference(first, first | {"force": np.array([1.0, 2e-9])}) == 0.0
    # above what is allowed, but round-off of the largest one
    tiny = {name: np.array([1.0, 1e-11]) for name in names} | {f"{name}_allowed": np.full(2, 1e-14) for name in names}
    assert residual_difference(first | tiny, first | tiny | {"force": np.array([1.0, 2e-11])}) == 0.0
    # one iteration more or fewer among small residuals is round-off, among large ones it is not
    assert residual_difference(first, first | {"iteration": np.array([0, 2])}) == 0.0
    assert residual_difference(first, first | {"iteration": np.array([1, 2])}) == np.inf


def test_there_are_decks_to_compare_solvers_on():
    assert len(list(INPUTS.glob("*.inp"))) >= 10


def test_the_quick_claims_hold(tmp_path):
    misses = [
        f"{verdict.claim.id}: {verdict.remark or verdict.difference}"
        for report in verify(quick=True, directory=tmp_path)
        for verdict in report.verdicts
        if not verdict.passed
    ]
    assert not misses

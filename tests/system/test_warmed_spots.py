"""Spots that their current warms (`SUPERTEMPERATURE=YES`): what a run has of each is what the kernel has."""

import re

import numpy as np
import pytest

from litz import Results
from litz.kernels import hot_spot
from run_of_deck import refusal_of_deck, run_of_deck
from test_heat_through_contacts import HEAT, LAP_JOINT, LORENZ, net

#: Resistivity and heat conductivity over the temperature
RHO = [[200, 1400], [1.0e-8, 8.2e-8]]
LAMBDAS = {"first": [[200, 1400], [410.0, 310.0]], "second": [[200, 1400], [120.0, 190.0]]}
SIGMA = "\n".join(f"{1 / rho:.17g}, {t}" for t, rho in zip(*RHO, strict=True))
FIRST, SECOND = ("\n".join(f"{x}, {t}" for t, x in zip(*table, strict=True)) for table in LAMBDAS.values())
HOT, COLD = ("*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ" + more for more in (", SUPERTEMPERATURE=YES", ""))
VALUES = (
    "current",
    "voltage_gap",
    "temperature_1",
    "temperature_2",
    "temperature_max",
    "heat_1",
    "heat_2",
    "resistance",
)


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, net)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, net)


def compare_with_kernel(warmed, cold, **metal):
    """The ledger of a run with `SUPERTEMPERATURE`; the shapes of the spots are those of the same run without."""
    assert len(warmed["current"]) == len(cold["current"]) > 0
    for i in range(len(warmed["current"])):
        current, volts, one, two, hottest, *heat, resistance = (float(warmed[name][i]) for name in VALUES)
        rho = [np.interp(cold[name][i], *RHO) for name in ("temperature_1", "temperature_2")]
        shape = float(cold["resistance"][i]) / sum(rho)
        found = hot_spot(volts, [one, two], shape=shape, resistivity=RHO, **metal)
        assert current == pytest.approx(found.current, rel=1e-8)
        assert heat == pytest.approx(found.heat, rel=1e-7, abs=1e-7 * abs(current * volts))
        assert hottest == pytest.approx(found.hottest.max(), rel=1e-10)
        assert volts == pytest.approx(resistance * current, rel=1e-12)


@pytest.mark.parametrize(
    ("law", "metal"),
    [
        ("CONDUCTIVITY", dict(conductivity=list(LAMBDAS.values()))),
        (f"METAL, LORENZ={LORENZ}", dict(lorenz=LORENZ)),
    ],
    ids=["two metals by their tables", "Wiedemann-Franz"],
)
def test_crossed_wires_within_elements(run, law, metal):
    """Three crossings on one element; all currents, heats and temperatures depend on each other."""
    changes = dict(sigma=SIGMA, conductivity=FIRST, other=SECOND, heat="*GAP CONDUCTANCE, LAW=" + law, volts=0.25)
    cold, warmed = (run(current=current, **changes).contacts_at(-1) for current in (COLD, HOT))
    compare_with_kernel(warmed, cold, **metal)
    assert (warmed["resistance"] > 1.02 * cold["resistance"]).any()


def test_it_converges_as_with_cold_spots(run):
    changes = dict(sigma=SIGMA, conductivity=FIRST, other=SECOND, volts=0.25)
    cold, warmed = (run(current=current, **changes).status["iterations"].copy().sum() for current in (COLD, HOT))
    assert warmed <= cold + 1


def test_resistivities_that_do_not_follow_the_temperature_change_nothing(run):
    cold, warmed = (run(current=current).contacts_at(-1) for current in (COLD, HOT))
    for name in VALUES:
        np.testing.assert_allclose(warmed[name], cold[name], rtol=1e-9, atol=1e-12)


def test_wires_side_by_side(litz, tmp_path):
    """Per length of a line the relation is the same."""
    deck = LAP_JOINT.read_text()
    deck = re.sub(
        r"\*ELECTRICAL CONDUCTIVITY\n.*\n", f"*CONDUCTIVITY\n{FIRST}\n*ELECTRICAL CONDUCTIVITY\n{SIGMA}\n", deck
    )
    ledgers = []
    for spot in ("LAW=HERTZ", "LAW=HERTZ, SUPERTEMPERATURE=YES"):
        text = deck.replace("LAW=FILM\n 1e-11", spot).replace(
            "*CONTACT PAIR", "*GAP CONDUCTANCE, LAW=CONDUCTIVITY\n*CONTACT PAIR"
        )
        heat = "*BOUNDARY\nPLUS, 11, 11, 300\nMINUS, 11, 11, 300\nPLUS, 9, 9, 0.02\n"
        (tmp_path / "lap.inp").write_text(text + f"*STEP\n{HEAT}\n1, 1\n{heat}*END STEP\n")
        done = litz("run", tmp_path / "lap.inp", "-o", tmp_path / "lap", "--quiet")
        assert done.returncode == 0, done.stderr
        ledgers.append(Results(tmp_path / "lap").contacts_at(-1))
    compare_with_kernel(*ledgers[::-1], conductivity=LAMBDAS["first"])


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            dict(current="*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT, SUPERTEMPERATURE=YES\n1e-3"),
            "LAW=CONSTANT gives the resistance",
        ),
        (
            dict(current=HOT, heat="*GAP CONDUCTANCE, LAW=CONSTANT\n0.1"),
            "how warm a spot gets follows from its heat conductivity",
        ),
        (
            dict(current=HOT, procedure="*STATIC", temperatures=(None,) * 5),
            "steps that solve for temperatures, and there is none",
        ),
    ],
)
def test_refused_decks(refused, changes, words):
    assert words in refused(1, **changes)


def test_a_spot_that_is_hotter_than_the_table_of_its_resistivity_ends_the_run(refused):
    """A constant resistivity beyond the table would hold what in truth runs away."""
    short = f"{1 / 1.6e-8:.17g}, 290\n{1 / 2.0e-8:.17g}, 345"
    message = refused(2, current=HOT, sigma=short, volts=0.25)
    assert "where the table of *ELECTRICAL CONDUCTIVITY ends at 345" in message

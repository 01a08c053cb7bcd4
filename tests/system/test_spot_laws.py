"""Runs with spots that are small against the mean free path of the electrons, or many."""

import numpy as np
import pytest

from litz import ClusterSpot, SharvinSpot, kernels
from test_yielding_contacts import BEHAVIOR, HARDNESS, POISSON, RADIUS, YIELD, YOUNG, contacts, held, to

ELASTIC = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"
WIRES = dict(radius=RADIUS, young=YOUNG, poisson=POISSON, resistivity=1 / 50e6)
#: As large as the spots: rho l of a mean free path of 20 micrometres
PRODUCT, FILM = 20e-6 / 50e6, 1e-13
CARD = "*GAP ELECTRICAL CONDUCTANCE, LAW="


@pytest.mark.parametrize("degrees", [90.0, 40.0])
@pytest.mark.parametrize(
    ("card", "law"),
    [
        (f"SHARVIN\n {PRODUCT!r}", dict(law="sharvin", law_value=PRODUCT)),
        (f"SHARVIN\n {PRODUCT!r}, {FILM!r}", dict(law="sharvin", law_value=[PRODUCT, FILM])),
        ("SHARVIN, MEAN FREE PATH=20e-6", dict(law="sharvin", mean_free_path=20e-6)),
        (f"SHARVIN, MEAN FREE PATH=20e-6\n , {FILM!r}", dict(law="sharvin", law_value=[PRODUCT, FILM])),
        ("CLUSTER\n 1e9, 12", dict(law="cluster", law_value=[1e9, 12])),
        (f"CLUSTER\n 1e9, 12, {FILM!r}", dict(law="cluster", law_value=[1e9, 12, FILM])),
    ],
)
def test_a_run_has_the_spot_of_the_kernel(run, card, law, degrees):
    _, results = run(held(to(2e-6, increments=2), degrees=degrees, behavior=ELASTIC, spot=CARD + card))
    for contact in contacts(results)[1:]:
        spot = kernels.contact_spot(contact["force"], angle=np.radians(degrees), **law, **WIRES)
        assert contact["resistance"] == pytest.approx(1 / spot.conductance, rel=1e-9)
        assert contact["semi_major"] == pytest.approx(spot.semi_major, rel=1e-9)


@pytest.mark.parametrize("card", [f"SHARVIN\n {PRODUCT!r}", "SHARVIN, MEAN FREE PATH=20e-6"])
def test_a_small_spot_of_metal_that_yields_comes_back_on_the_elastic_way(run, card):
    spot = f"{CARD}{card}"
    _, results = run(held(to(2e-6, increments=1), to(1.5e-6, increments=1), behavior=BEHAVIOR, spot=spot))
    pressed, back = contacts(results)[1:]
    yielding = dict(yield_stress=YIELD, hardness=HARDNESS, mean_free_path=PRODUCT * 50e6, angle=np.pi / 2)
    for contact in (pressed, back):
        found = kernels.contact_spot(contact["force"], largest_force=pressed["force"], **yielding, **WIRES)
        assert contact["resistance"] == pytest.approx(1 / found.conductance, rel=1e-8)


@pytest.mark.parametrize("card", ["SHARVIN\n 1e-15", "CLUSTER\n 1e9, 12"])
def test_wires_side_by_side_have_no_such_spots(litz, tmp_path, card):
    path = tmp_path / "deck.inp"
    path.write_text(held(to(2e-6, increments=1), degrees=1.0, behavior=ELASTIC, spot=CARD + card))
    process = litz("run", path, "-o", tmp_path)
    assert process.returncode in (1, 2)
    assert f"LAW={card.split()[0]}" in process.stderr
    assert "contact along a line" in process.stderr


def test_wires_that_yield_have_no_clusters_and_no_less_than_one_spot(litz, tmp_path):
    path = tmp_path / "deck.inp"
    path.write_text(held(to(2e-6), spot=f"{CARD}CLUSTER\n 1e9, 0.5"))
    process = litz("run", path, "-o", tmp_path)
    assert process.returncode == 1
    assert "LAW=CLUSTER makes a spot of its own" in process.stderr
    assert "1 or greater" in process.stderr


@pytest.mark.parametrize(
    ("card", "message"),
    [
        ("SHARVIN", "needs MEAN FREE PATH or, on its data line, rho_l"),
        (f"SHARVIN\n , {FILM!r}", "needs MEAN FREE PATH or, on its data line, rho_l"),
        (f"SHARVIN, MEAN FREE PATH=1e-8\n {PRODUCT!r}", "or rho_l, its product with the resistivity, not both"),
        ("HERTZ, MEAN FREE PATH=1e-8", "MEAN FREE PATH is for LAW=SHARVIN"),
        ("SHARVIN, MEAN FREE PATH=0", "greater than 0"),
    ],
)
def test_the_mean_free_path_or_its_product_is_given_once(litz, tmp_path, card, message):
    path = tmp_path / "deck.inp"
    path.write_text(held(to(2e-6), behavior=ELASTIC, spot=CARD + card))
    process = litz("check", path)
    assert process.returncode == 1
    assert process.stderr.count("error:") == 1
    assert message in process.stderr


def test_a_mean_free_path_belongs_to_one_conductivity(litz, tmp_path):
    path = tmp_path / "deck.inp"
    deck = held(to(2e-6), behavior=ELASTIC, spot=f"{CARD}SHARVIN, MEAN FREE PATH=1e-8")
    line = "*ELECTRICAL CONDUCTIVITY\n"
    place = deck.index("\n", deck.index(line) + len(line))
    path.write_text(deck[:place] + ", 300\n 4e7, 400" + deck[place:])
    process = litz("check", path)
    assert process.returncode == 1
    assert "conductivity over temperature, with which the MEAN FREE PATH" in process.stderr


def test_models_of_python_write_the_laws():
    assert SharvinSpot(1e-15).card()[1:] == ({"LAW": "SHARVIN"}, [[1e-15]])
    assert SharvinSpot(1e-15, 1e-13).card()[2] == [[1e-15, 1e-13]]
    assert SharvinSpot(mean_free_path=39e-9).card()[1:] == ({"LAW": "SHARVIN", "MEAN FREE PATH": 39e-9}, [])
    assert SharvinSpot(mean_free_path=39e-9, film_resistivity=1e-13).card()[2] == [[None, 1e-13]]
    assert ClusterSpot(1e9, 20).card()[1:] == ({"LAW": "CLUSTER"}, [[1e9, 20]])
    assert ClusterSpot(1e9, 20, 1e-13).card()[2] == [[1e9, 20, 1e-13]]
    for given in ({}, dict(resistivity_path=1e-15, mean_free_path=1e-8)):
        with pytest.raises(ValueError, match="resistivity_path or mean_free_path, not both"):
            SharvinSpot(**given)

"""FILM= of *GAP CONDUCTANCE: the resistance to heat of a film in a spot, in series with the constrictions beside it."""

import numpy as np
import pytest

from crossing_conductors import LAMBDA, METAL, ROOM, crossing
from decks import straight, wire
from litz import Results
from run_of_deck import refusal_of_deck, run_of_deck

FILM, HOT = 1e-7, 400.0


def deck(
    *, law="CONDUCTIVITY", film=f", FILM={FILM}", volts=0.0, hot=HOT, place=0.0, procedure="*COUPLED THERMAL-ELECTRICAL"
):
    """Crossed copper wires, the ends of the second one at another temperature, perhaps with a voltage between them."""
    law = f"{METAL}{film}" if law == "METAL" else f"*GAP CONDUCTANCE, LAW={law}{film}"
    text = crossing(2, "5.88e7", "1, 1", load=f"1001, 9, 9, {volts}\n1001, 11, 11, {hot}\n1003, 11, 11, {hot}\n", law=law,
                    procedure=", STEADY STATE", place=place)  # fmt: skip
    assert f"ENDS, 11, 11, {ROOM}\n" in text
    held = f"1, 11, 11, {ROOM}\n3, 11, 11, {ROOM}\n"
    return text.replace(f"ENDS, 11, 11, {ROOM}\n", held).replace("*COUPLED THERMAL-ELECTRICAL", procedure)


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, deck)


@pytest.fixture
def refused(litz, tmp_path):
    return refusal_of_deck(litz, tmp_path, deck)


def drop(results):
    """Difference of the temperatures of the wires over the heat that passes."""
    contacts = results.contacts_at(-1)
    return (contacts["temperature_2"] - contacts["temperature_1"])[0] / contacts["heat_1"][0]


@pytest.mark.parametrize("place", [0.0, 3e-3])
@pytest.mark.parametrize("procedure", ["*COUPLED THERMAL-ELECTRICAL", "*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL"])
def test_a_film_is_in_series_with_the_constrictions(run, place, procedure):
    """1/(4 a lambda) in either wire and R/(pi a^2) between them: the spot of equal wires at right angles is a circle."""
    contacts = (results := run(place=place, procedure=procedure)).contacts_at(-1)
    a = contacts["semi_major"][0]
    assert contacts["semi_minor"][0] == pytest.approx(a, rel=1e-6)
    assert drop(results) == pytest.approx(1 / (2 * a * LAMBDA) + FILM / (np.pi * a**2), rel=1e-9)


def test_metals_have_one_too(run):
    """L T G conducts the heat of a constriction, with its mean temperature; the heat is small enough for one temperature."""
    hot = ROOM + 0.01
    contacts = (results := run(law="METAL", hot=hot)).contacts_at(-1)
    a = contacts["semi_major"][0]
    of_metal = drop(run(law="METAL", hot=hot, film=""))
    assert drop(results) == pytest.approx(of_metal + FILM / (np.pi * a**2), rel=1e-5)


def test_the_heat_of_a_current_enters_wires_of_one_temperature_half_and_half(run):
    contacts = run(volts=0.05, hot=ROOM).contacts_at(-1)
    assert contacts["heat_1"][0] == pytest.approx(contacts["heat_2"][0], rel=1e-9)
    assert contacts["heat_1"][0] == pytest.approx(contacts["joule_heat"][0] / 2, rel=1e-9)


def test_a_strip_along_a_line_has_the_film_of_its_width(litz, tmp_path):
    """R over twice the half width, per length, beside the strips of the wires."""
    drops = []
    for film in ("", f", FILM={FILM}"):
        wires = "".join(
            wire(name, straight((0, 0, z), (0.004, 0, z), 8), first, element="B33")
            + f"*BEAM SECTION, ELSET={name}, MATERIAL=COPPER, SECTION=CIRC\n5e-4\n"
            for name, first, z in (("A", 1, 0.0), ("B", 101, 1e-3 - 1e-6))
        )
        (tmp_path / "line.inp").write_text(
            f"{wires}*NSET, NSET=ALL\nA, B\n*MATERIAL, NAME=COPPER\n*ELASTIC\n1.2e11, 0.3\n*CONDUCTIVITY\n{LAMBDA}\n"
            f"*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
            f"*GAP CONDUCTANCE, LAW=CONDUCTIVITY{film}\n*CONTACT PAIR, INTERACTION=TOUCH, INTERFERENCE FIT\nA, B\n"
            f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, {ROOM}\n*BOUNDARY\nALL, ENCASTRE\n"
            "*STEP\n*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE\n1, 1\n"
            f"*BOUNDARY\nA, 11, 11, {ROOM}\nB, 11, 11, {HOT}\n*END STEP\n"
        )
        done = litz("run", tmp_path / "line.inp", "-o", tmp_path / "line", "--quiet")
        assert done.returncode == 0, done.stderr
        contacts = Results(tmp_path / "line").contacts_at(-1)
        middle = np.argsort(abs(contacts["point_1_x"] - 0.002))[0]
        length = contacts["length"][middle]
        drops.append((HOT - ROOM) / (contacts["heat_1"][middle] / length))
        # half width by Hertz: b^2 = 4 f R*/(pi E*)
        width = 2 * np.sqrt(4 * contacts["force"][middle] / length * 2.5e-4 / (np.pi * 1.2e11 / (2 * (1 - 0.3**2))))
    assert drops[1] - drops[0] == pytest.approx(FILM / width, rel=1e-6)


def test_a_conductance_that_is_given_has_all_in_it(refused):
    message = refused(1, law="CONSTANT", film=f", FILM={FILM}\n0.1")
    assert "FILM= is for LAW=CONDUCTIVITY and LAW=METAL" in message

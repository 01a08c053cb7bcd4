"""An element whose ends rotate relative to each other by more than 150 degrees ends the run in words: beyond 180 degrees it would
answer as if it were turned the other way round. Wires of enough elements twist and roll up as far as they like."""

import re

import numpy as np
import pytest

from decks import MATERIAL, cantilever, straight, wire

INCREMENTS = ["1, 1, 1e-3, 1", "0.05, 1, 1e-5, 0.05"]
KINDS = ["B31", "B33"]


def twisted(turns, n, *, static, element):
    """The cantilever, its end turned about its own axis, and its torque printed."""
    angle = 2 * np.pi * turns
    end = n + 1
    cards = (
        f"*BOUNDARY\n {end}, 4, 4, {angle:.17g}\n {end}, 5, 6\n*NODE PRINT, NSET=WIRE, TOTALS=ONLY\n RF\n*ENERGY PRINT"
    )
    return cantilever(cards, element=element, static=static, n=n)


def rolled(turns, n, *, static, element):
    """The cantilever, its end turned about an axis across it."""
    cards = f"*BOUNDARY\n {n + 1}, 4, 5\n {n + 1}, 6, 6, {2 * np.pi * turns:.17g}"
    return cantilever(cards, element=element, static=static, n=n)


@pytest.mark.filterwarnings("ignore:.*did not finish")
class TestTooFewElements:
    @pytest.mark.parametrize("element", KINDS)
    @pytest.mark.parametrize("static", INCREMENTS, ids=["one increment", "twenty"])
    @pytest.mark.parametrize(("turns", "n"), [(3, 4), (2, 4)])
    def test_a_twisted_shaft_ends_the_run_in_words_and_soon(self, run, turns, n, static, element):
        process, results = run(twisted(turns, n, static=static, element=element), "--quiet")
        assert process.returncode == 2
        assert "are rotated relative to each other by" in process.stderr
        assert "Use shorter elements there" in process.stderr
        if results is not None:
            assert len(results.times) < 60

    @pytest.mark.parametrize("element", KINDS)
    def test_a_rolled_wire_ends_the_run_in_words_and_soon(self, run, element):
        process, results = run(rolled(2, 3, static="0.05, 1, 1e-5, 0.05", element=element), "--quiet")
        assert process.returncode == 2
        assert "are rotated relative to each other by" in process.stderr
        assert len(results.times) < 60

    def test_the_message_names_the_element_and_the_angle(self, run):
        # one increment that may not be cut: 3 turns over 4 elements are 270 degrees for each
        deck = twisted(3, 4, static="1, 1", element="B33").replace("*STATIC", "*STATIC, DIRECT")
        process, _ = run(deck, "--quiet")
        assert process.returncode == 2
        assert re.search("the ends of element [1-4] are rotated relative to each other by 270 degrees", process.stderr)


@pytest.mark.parametrize("element", KINDS)
@pytest.mark.parametrize("static", INCREMENTS, ids=["one increment", "twenty"])
class TestEnoughElements:
    def test_a_shaft_twisted_by_three_turns_stores_the_energy_of_them(self, run, static, element):
        process, results = run(twisted(3, 10, static=static, element=element), "--quiet")
        assert process.returncode == 0, process.stderr
        rigidity = 200e9 / 2.6 * np.pi / 2 * 1e-12
        # straight, uniform twist: the element is exact
        assert results.history["ALLSE"][-1] == pytest.approx(rigidity / 0.1 * (6 * np.pi) ** 2 / 2, rel=1e-9)

    @pytest.mark.parametrize("axis", [4, 5, 6])
    def test_a_wire_turned_as_a_whole_by_five_turns_bears_nothing(self, run, static, element, axis):
        others = "".join(f" 1, {k}, {k}\n" for k in (4, 5, 6) if k != axis)
        deck = (
            wire("WIRE", straight((0, 0, 0), (0.03, 0.02, 0.01), 3), element=element)
            + MATERIAL
            + "*BEAM SECTION, ELSET=WIRE, MATERIAL=STEEL, SECTION=CIRC\n 1e-3\n*BOUNDARY\n 1, 1, 3\n"
            + f"*STEP, INC=500\n*STATIC\n {static}\n*BOUNDARY\n{others} 1, {axis}, {axis}, {10 * np.pi:.17g}\n"
            + "*ENERGY PRINT\n*END STEP\n"
        )
        process, results = run(deck, "--quiet")
        assert process.returncode == 0, process.stderr
        # a turn of the one end against the other would take some 10 J
        assert abs(results.history["ALLSE"][-1]) < 1e-6

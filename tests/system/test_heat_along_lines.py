"""Current and heat between wires that lie side by side, of unlike metals and radii, and with conductances that are given."""

import math

import pytest
from verification.references.parallel_wires import ParallelWires, PressedWire

from line_wires import COPPER, HERTZ, lowered, pressed, spot
from run_of_deck import run_of_deck
from test_strips_of_one_wire import parallel

LENGTH, OVERLAP = 20e-3, 5e-7
#: Short enough that heat leaves them evenly
ELEMENTS = 64
VOLTS, KELVINS, ROOM = 0.01, 1.0, 300.0
#: Thinner than the copper, and forty times as resistive
ALLOY = PressedWire(0.3e-3, 200e9, 0.28, 7e-7)
#: Lorenz number times temperature: conductivities of both wires are in this ratio to heat conductivities
WIEDEMANN_FRANZ = 7e-6


@pytest.fixture
def run(litz, tmp_path):
    return run_of_deck(litz, tmp_path, str)


def entering(results, field):
    """What enters at the supports from which it comes, at the end."""
    values = results.field(field, len(results.times) - 1)
    return values[values > 0].sum()


def unlike_wires(gap, step):
    """A copper wire and one of an alloy are pressed together; all of their nodes have what the second step prescribes."""
    deck = pressed(OVERLAP, elements=(ELEMENTS, ELEMENTS), wires=(COPPER, ALLOY), law=HERTZ + gap)
    for name, each in (("LOWER", COPPER), ("UPPER", ALLOY)):
        deck = deck.replace(
            f"*MATERIAL, NAME={name}\n",
            f"*MATERIAL, NAME={name}\n*CONDUCTIVITY\n {WIEDEMANN_FRANZ / each.resistivity}\n",
        )
    start = f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n LOWER, {ROOM}\n UPPER, {ROOM}\n"
    held = "*BOUNDARY\n LOWER, 9\n UPPER, 9\n"
    deck = deck.replace("*STEP", start + held + "*STEP", 1)
    return deck + f"*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n 1, 1\n*BOUNDARY\n{step}*END STEP\n"


def test_unlike_wires_make_the_heat_of_their_power(run):
    """A strip along unlike wires has constrictions of unlike shapes, whose heat is that of the current and no more."""
    step = f" LOWER, 11, 11, {ROOM}\n UPPER, 11, 11, {ROOM}\n UPPER, 9, 9, {VOLTS}\n"
    results = run(unlike_wires(spot("HERTZ"), step))
    leaving = -results.field("reaction_heat", len(results.times) - 1).sum()
    assert leaving == pytest.approx(VOLTS * entering(results, "reaction_current"), rel=1e-9)


def test_heat_passes_between_unlike_wires_as_the_current_does(run):
    """Where no current flows, the strip is that of the heat conductivities: 1/g' with 1/lambda in place of rho."""
    step = f" LOWER, 11, 11, {ROOM}\n UPPER, 11, 11, {ROOM + KELVINS}\n"
    results = run(unlike_wires("*GAP CONDUCTANCE, LAW=CONDUCTIVITY\n", step))
    pair = ParallelWires(COPPER, ALLOY)
    per_length = pair.conductance(pair.force(OVERLAP)) * WIEDEMANN_FRANZ
    # within an element, from its nodes to where the heat leaves it: l^2/(12 lambda A) per length in either wire
    inside = sum(
        (LENGTH / ELEMENTS) ** 2 * each.resistivity / (12 * math.pi * each.radius**2 * WIEDEMANN_FRANZ)
        for each in (COPPER, ALLOY)
    )
    # places have lumps of heat
    expected = KELVINS * LENGTH / (1 / per_length + inside)
    assert entering(results, "reaction_heat") == pytest.approx(expected, rel=3e-3)


@pytest.mark.parametrize("current", [spot("HERTZ"), ""])
def test_wires_that_part_in_their_dent_pass_no_heat(run, current):
    """Their overlap is not that of the nodes any more: where they have yielded they do not touch."""
    step = f" LOWER, 11, 11, {ROOM}\n UPPER, 11, 11, {ROOM + KELVINS}\n"
    deck = unlike_wires(f"{current}*GAP CONDUCTANCE, LAW=CONDUCTIVITY\n", step)
    deck = deck.replace(HERTZ, HERTZ.replace("HERTZ", "HERTZ, YIELD=60e6"))
    deck = deck.replace(f"-{OVERLAP:.17g}", "-3e-6")
    before, heating = deck.split("*STEP\n*COUPLED")
    results = run(before + lowered(5e-7) + "*STEP\n*COUPLED" + heating)
    contacts = results.contacts
    assert contacts["force"][contacts["step"] == 1].sum() > 100
    assert not (contacts["step"] > 1).any()
    # along the wires nothing flows
    assert abs(results.field("reaction_heat", len(results.times) - 1)).max() < 1e-9 * KELVINS * COPPER.radius


def given_along(deck, given):
    """A deck of strips has a given heat conductance per length in place of their law, and a step of heat for its currents."""
    deck = deck.replace(f"*ELECTRICAL CONDUCTIVITY\n {1 / COPPER.resistivity:.17g}", f"*CONDUCTIVITY\n {CONDUCTIVITY}")
    deck = deck.replace(spot("HERTZ, VOLTAGE=LINEAR"), f"*GAP CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n {given}\n")
    before, pressed_step = deck.split("*STEP")
    static, prescribed = pressed_step.split("*BOUNDARY")
    heating = "*STEP\n*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n*BOUNDARY" + prescribed.replace("9, 9", "11, 11")
    return before + "*STEP" + static + "*END STEP\n" + heating


def as_resistances(deck, given):
    """The same with a resistance times length that is given [ohm m]."""
    return deck.replace(
        spot("HERTZ, VOLTAGE=LINEAR"),
        f"*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT, PER=LENGTH, VOLTAGE=LINEAR\n {1 / given}\n",
    )


#: Multiples of the conductance whose resistance is what a strip opposite adds, and beyond any strip
NUMBERS = [1e-3, 0.1, 0.3, 0.34, 0.5, 0.9, 1, 1.1, 3, 10]
CONDUCTIVITY = 400.0
#: What all strips of a section add is at most this part of what they resist in it, half of what is given (theory, 10.13a)
MOST = 0.7 / 2


@pytest.mark.parametrize("elements", [(ELEMENTS,), (64, 81, 70)], ids=["nodes match", "nodes do not match"])
@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("field", ["heat", "current"])
def test_a_conductance_that_is_given_and_what_strips_add(run, field, number, elements):
    """Heat, or a current, passes through the middle one of three wires in a stack. Its strips are opposite each other, where
    each takes away from the other one (ln 2 - 1/8)/(pi lambda) (10.13), nothing where the conductance is small, and a part
    of its resistance where it is larger than those of strips can be."""
    conductivity = CONDUCTIVITY if field == "heat" else 1 / COPPER.resistivity
    of_others = (math.log(2) - 1 / 8) / (math.pi * conductivity)
    given = number / of_others
    up = 2 * COPPER.radius - OVERLAP
    places = [(0, 0), (0, up), (0, 2 * up)]
    deck = parallel(places, [COPPER.radius] * 3, [(0, 1), (1, 2)], {0: KELVINS, 2: 0.0}, elements=elements)
    results = run(given_along(deck, given) if field == "heat" else as_resistances(deck, given))
    strips = 2 / given + 2 * min(of_others, MOST / given)
    # within elements: from nodes to where heat leaves evenly, or nothing where it leaves at the nodes
    inside = sum((LENGTH / n) ** 2 for n in (elements[0], elements[-1])) / (
        12 * conductivity * math.pi * COPPER.radius**2
    )
    passed = entering(results, "reaction_heat" if field == "heat" else "reaction_current") / (KELVINS * LENGTH)
    # places have lumps of heat
    assert 0.997 / (strips + inside) < passed < 1.003 / strips


@pytest.mark.parametrize("number", [1e-3, 0.1, 1, 10])
@pytest.mark.parametrize("field", ["heat", "current"])
def test_a_core_takes_up_what_six_wires_give_it(run, field, number):
    """Each strip resists less than by itself, by (ln 6 - 5/8)/(pi lambda), the sum of (10.13) over the five others, but
    heat does not flow to where it is warmer."""
    conductivity = CONDUCTIVITY if field == "heat" else 1 / COPPER.resistivity
    of_others = (math.log(6) - 5 / 8) / (math.pi * conductivity)
    given = number / of_others
    distance = 2 * COPPER.radius - OVERLAP
    around = [(distance * math.cos(k * math.pi / 3), distance * math.sin(k * math.pi / 3)) for k in range(6)]
    deck = parallel(
        [(0, 0), *around], [COPPER.radius] * 7, [(0, k) for k in range(1, 7)],
        {k: KELVINS if k else 0.0 for k in range(7)}, elements=(ELEMENTS,),
    )  # fmt: skip
    results = run(given_along(deck, given) if field == "heat" else as_resistances(deck, given))
    strip = 1 / given - min(of_others, MOST / given)
    # within an element, in a wire, and in the core, where those of six wires enter
    inside = (1 + 6) * (LENGTH / ELEMENTS) ** 2 / (12 * conductivity * math.pi * COPPER.radius**2)
    passed = entering(results, "reaction_heat" if field == "heat" else "reaction_current") / (6 * KELVINS * LENGTH)
    # places have lumps of heat
    assert 0.997 / (strip + inside) < passed < 1.003 / strip

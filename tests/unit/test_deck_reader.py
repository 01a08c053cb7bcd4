"""What the program understands of a deck: the model that `litz check` prints."""

import math
import re
import time

import pytest

MODEL = """\
*NODE
 30, 0., 0., 0.
 10, 1., 0., 0.
 20, 2., 0., 0.
*ELEMENT, TYPE=B31, ELSET=WIRE
 7, 30, 10
 3, 10, 20
*MATERIAL, NAME=CU
*ELASTIC
 1.2e11, 0.35
*BEAM SECTION, ELSET=WIRE, MATERIAL=CU, SECTION=CIRC
 0.01
"""
STEP = """\
*STEP
*STATIC
*BOUNDARY
30, 1, 6
*END STEP
"""


@pytest.fixture
def check(litz, tmp_path):
    """Check a deck that must be accepted without a warning, and return the lines of the summary."""

    def run(deck):
        units = "" if "units" in deck.lower() else "*UNITS, SYSTEM=SI\n"
        (tmp_path / "deck.inp").write_bytes(
            (deck[:1] + units + deck[1:] if deck.startswith("\ufeff") else units + deck).encode()
        )
        result = litz("check", "deck.inp", cwd=tmp_path)
        assert (result.returncode, result.stderr) == (0, "")
        return result.stdout.splitlines()

    return run


def value(lines, name):
    """The number behind `name = ` in the summary."""
    return float(re.search(rf"\b{name} = (\S+)", "\n".join(lines))[1])


def section(lines, begin):
    """Lines from the one that begins so to the last that is indented below it."""
    first = next(i for i, line in enumerate(lines) if line.startswith(begin))
    last = first + 1
    while last < len(lines) and lines[last].startswith("  "):
        last += 1
    return lines[first:last]


# sections


def test_a_round_section_has_the_moduli_of_a_circle_and_cowpers_shear_factor(check):
    lines = check(MODEL + STEP)
    radius, young, poisson = 0.01, 1.2e11, 0.35
    shear = 6 * (1 + poisson) / (7 + 6 * poisson) * young / (2 * (1 + poisson)) * math.pi * radius**2
    # the summary has six digits
    assert value(lines, "A") == pytest.approx(math.pi * radius**2, rel=1e-5)
    assert value(lines, "I2") == value(lines, "I3") == pytest.approx(math.pi * radius**4 / 4, rel=1e-5)
    assert value(lines, "J") == pytest.approx(math.pi * radius**4 / 2, rel=1e-5)
    assert value(lines, "GA2") == value(lines, "GA3") == pytest.approx(shear, rel=1e-5)
    assert "contact radius 0.01 m" in "\n".join(lines)


def test_a_general_section_keeps_its_data_and_has_the_full_shear_area(check):
    deck = MODEL.replace("SECTION=CIRC\n 0.01", "SECTION=GENERAL\n 2e-4, 3e-9, 0., 5e-9, 7e-9\n 0., 1., 1.")
    lines = check(deck + STEP)
    assert [value(lines, name) for name in ("A", "I2", "I3", "J")] == [2e-4, 3e-9, 5e-9, 7e-9]
    assert value(lines, "GA2") == pytest.approx(1.2e11 / 2.7 * 2e-4, rel=1e-5)
    assert "n1 = (0, 1, 1)" in "\n".join(lines)
    assert "contact radius" not in "\n".join(lines)


@pytest.mark.parametrize(
    ("line", "along_n1", "along_n2"),
    [
        ("11., 13.", 13, 11),
        ("11., 13., 0.25", 13, 11),
        ("11.", 11, 11),
        (", 13.", 13, 13),
        ("0., 13., 0.", 13, 13),
        ("11., 13., scf", 13, 11),
    ],
)
def test_shear_stiffnesses_are_given_in_the_order_of_abaqus(check, line, along_n1, along_n2):
    """K23, K13, slenderness compensation: one of the first two that is missing is like the other."""
    lines = check(MODEL + f"*TRANSVERSE SHEAR STIFFNESS\n {line}\n" + STEP)
    assert (value(lines, "GA2"), value(lines, "GA3")) == (along_n1, along_n2)


def test_with_the_word_scf_shear_stiffnesses_that_are_missing_are_those_of_the_section(check):
    own = check(MODEL + STEP)
    for line in (", , SCF", "0., 0., SCF"):
        assert check(MODEL + f"*TRANSVERSE SHEAR STIFFNESS\n {line}\n" + STEP) == own
    lines = check(MODEL + "*TRANSVERSE SHEAR STIFFNESS\n 11., , SCF\n" + STEP)
    assert (value(lines, "GA2"), value(lines, "GA3")) == (value(own, "GA2"), 11)


# sets


@pytest.mark.parametrize(
    ("cards", "n"),
    [
        ("*NSET, NSET=A\n 30, 20\n", 2),
        ("*NSET, NSET=A\n 30, 20, 30,\n 20\n", 2),
        ("*NSET, NSET=A\n 30\n*NSET, NSET=a\n 20\n", 2),
        ("*NSET, NSET=A, ELSET=WIRE\n", 3),
        ("*ELSET, ELSET=ONE\n 7\n*NSET, NSET=A, ELSET=ONE\n 20, 10\n", 3),
        ("*ELSET, ELSET=ONE\n 7\n*NSET, NSET=A\n 10\n*NSET, NSET=A, ELSET=ONE\n", 2),
        ("*NSET, NSET=A, GENERATE\n 10, 30, 10\n", 3),
        ("*NSET, NSET=A, GENERATE\n 1, 2000000000\n", 3),
        ("*NSET, NSET=A, GENERATE\n 10, 30, 20\n", 2),
        ("*NSET, NSET=B\n 10, 20\n*NSET, NSET=A\n B, 30\n", 3),
        ("*NSET, NSET=B\n 10\n*NSET, NSET=A\n B\n*NSET, NSET=B\n 20\n", 1),
    ],
    ids=[
        "ids",
        "twice",
        "two cards",
        "of elements",
        "of elements and ids",
        "more of elements",
        "range",
        "range with gaps",
        "range with a step",
        "set of a set",
        "set as it was",
    ],
)
def test_members_of_a_set(check, cards, n):
    lines = check(MODEL + cards + STEP)
    assert f"node set A: {n} member{'s' if n > 1 else ''}" in lines


def test_sets_on_node_and_element_lines(check):
    deck = MODEL.replace("*NODE\n", "*NODE, NSET=ENDS\n") + "*NODE, NSET=ends\n 4, 3., 0., 0.\n"
    deck += "*ELEMENT, TYPE=B33, ELSET=WIRE\n 12, 20, 4\n"
    lines = check(deck + STEP)
    assert "4 nodes, 3 elements (2 B31, 1 B33), 1 connected part" in lines
    assert "node set ENDS: 4 members" in lines
    assert "element set WIRE: 3 members" in lines


# the text of the deck


def test_blanks_tabs_case_comments_and_line_ends_do_not_matter(check):
    plain = check(MODEL + STEP)
    odd = (MODEL + STEP).replace("*NODE\n", "** comment\n\n  *node\n   ** another\n").replace(" 10, 1.,", "\t10 ,1.\t,")
    odd = odd.replace("*BEAM SECTION, ELSET=WIRE,", "*BeamSection ,elset = wire ,").replace("1.2e11", "1.2D+11")
    odd = odd.replace("30, 1, 6", "30, 1, 6,").replace("\n", "\r\n")
    assert check(odd) == plain
    assert check("\ufeff" + MODEL + STEP) == plain
    assert check((MODEL + STEP).rstrip("\n")) == plain


def test_a_keyword_line_goes_on_after_a_comma(check):
    deck = MODEL.replace("ELSET=WIRE, MATERIAL", "ELSET=WIRE,\n** in between\n  MATERIAL")
    deck = deck.replace("CU, SEC", "CU,\nSEC")
    assert check(deck + STEP) == check(MODEL + STEP)


def test_names_in_quotes_may_hold_blanks_and_commas(check):
    deck = MODEL.replace("NAME=CU", 'NAME="Cu, hard drawn"').replace("MATERIAL=CU", 'MATERIAL="CU, hard drawn"')
    assert "material CU, HARD DRAWN: E = 1.2e+11 Pa, nu = 0.35, insulator" in check(deck + STEP)


def test_included_files_stand_for_their_text(check, tmp_path):
    (tmp_path / "mesh").mkdir()
    nodes = MODEL[MODEL.index(" 30,") : MODEL.index("*ELEMENT")]
    (tmp_path / "mesh" / "nodes.txt").write_text(nodes.rstrip("\n"))
    rest = MODEL[MODEL.index("*ELEMENT") :]
    (tmp_path / "mesh" / "all.inp").write_text("*NODE\n*INCLUDE, INPUT=nodes.txt\n" + rest)
    assert check("*INCLUDE, INPUT=mesh/all.inp\n" + STEP) == check(MODEL + STEP)


@pytest.mark.parametrize(
    "number", ["1.2e11", "1.2E+11", "1.2d11", "+120000000000", "0.00000000012e21", "120000000000.000000000000001"]
)
def test_numbers_in_any_form(check, number):
    assert value(check(MODEL.replace("1.2e11", number) + STEP), "E") == 1.2e11


# steps


BASE = MODEL + "*NSET, NSET=END\n 20\n*AMPLITUDE, NAME=UP\n 0., 0., 1., 2.\n"


def test_a_step_keeps_what_it_does_not_redefine(check):
    lines = check(
        BASE + "*BOUNDARY\n30, 1, 6\n"
        "*STEP, NAME=FIRST\n*STATIC\n0.5, 2., 1e-3, 1.\n*CLOAD\nEND, 2, 3.\n*SOLVER, NAME=SKYLINE, COUPLING=UPDATED\n"
        "*NODE PRINT, NSET=END\nU\n*CONTACT PRINT\n*END STEP\n"
        "*STEP, INC=7\n*STATIC, DIRECT\n0.25, 1.\n*BOUNDARY\n20, 3, 3, 0.1\n"
        "*NODE PRINT, NSET=END, TOTALS=YES\nRF\n*END STEP\n"
        "*STEP\n*STATIC\n*CLOAD\nEND, 1, 4.\n*AMPLITUDE, NAME=LATE\n0., 1.\n*CLOAD, AMPLITUDE=LATE\nEND, 3, 1.\n"
        "*CLOAD, AMPLITUDE=UP\n10, 3, 1.\n*END STEP\n"
    )
    assert section(lines, "step 1 (FIRST)") == [
        (
            "step 1 (FIRST): time 2 s, increments first 0.5, smallest 0.001, largest 1 s, at most 100, solver SKYLINE, "
            "coupling updated"
        ),
        *[f"  prescribed at degree of freedom {dof}: 1 node, 0" for dof in range(1, 7)],
        "  loads at degree of freedom 2: 1 node, 3",
        "  output of node set END: U",
        "  output of contacts in the terminal",
    ]
    assert section(lines, "step 2") == [
        "step 2: time 1 s, increments of 0.25 s, at most 7, solver SKYLINE, coupling updated",
        "  prescribed at degree of freedom 1: 1 node, 0",
        "  prescribed at degree of freedom 2: 1 node, 0",
        "  prescribed at degree of freedom 3: 2 nodes, 0 to 0.1",
        *[f"  prescribed at degree of freedom {dof}: 1 node, 0" for dof in range(4, 7)],
        "  loads at degree of freedom 2: 1 node, 3",
        "  output of contacts in the terminal",
        "  output of node set END: RF",
        "  output of node set END: RF (sums)",
    ]
    assert section(lines, "step 3")[0].startswith("step 3: time 1 s, increments first 1, smallest 1e-05, largest 1 s")
    assert [line for line in section(lines, "step 3") if "loads" in line] == [
        "  loads at degree of freedom 1: 1 node, 4",
        "  loads at degree of freedom 2: 1 node, 3",
        "  loads at degree of freedom 3: 2 nodes, 1",
    ]


def loads_of_step_2(check, first, second, amplitudes=""):
    """Load lines of the second of two steps."""
    lines = check(
        BASE.replace("*AMPLITUDE, NAME=UP\n 0., 0., 1., 2.\n", amplitudes) + "*BOUNDARY\n30, 1, 6\n"
        f"*STEP\n*STATIC\n0.5, 0.5\n{first}*END STEP\n*STEP\n*STATIC\n{second}*END STEP\n"
    )
    return [line.strip() for line in section(lines, "step 2") if "loads" in line]


def test_a_load_of_a_later_step_replaces_the_earlier_one(check):
    assert loads_of_step_2(check, "*CLOAD\nEND, 1, 1.\n", "*CLOAD\nEND, 1, 5.\n") == [
        "loads at degree of freedom 1: 1 node, 5"
    ]


def test_loads_of_one_step_add_up(check):
    assert loads_of_step_2(check, "*CLOAD\nEND, 1, 1.\n*CLOAD\n20, 1, 2.\nEND, 1, 0.5\n", "") == [
        "loads at degree of freedom 1: 1 node, 3.5"
    ]


def test_op_new_removes_what_was_before(check):
    assert loads_of_step_2(check, "*CLOAD\nEND, 1, 1.\nEND, 2, 1.\n", "*CLOAD, OP=NEW\nEND, 3, 5.\n") == [
        "loads at degree of freedom 3: 1 node, 5"
    ]


def test_op_new_without_data_lines_removes_all_loads(check):
    assert loads_of_step_2(check, "*CLOAD\nEND, 1, 1.\nEND, 2, 1.\n", "*CLOAD, OP=NEW\n") == []


def test_op_new_without_data_lines_keeps_what_another_card_of_the_step_prescribes(check):
    both = "*CLOAD, OP=NEW\n*CLOAD, OP=NEW\nEND, 3, 5.\n"
    assert loads_of_step_2(check, "*CLOAD\nEND, 1, 1.\n", both) == ["loads at degree of freedom 3: 1 node, 5"]
    assert loads_of_step_2(check, "*CLOAD\nEND, 1, 1.\n", "".join(reversed(both.partition("*CLOAD, OP=NEW\n")))) == [
        "loads at degree of freedom 3: 1 node, 5"
    ]


@pytest.mark.parametrize(
    ("time", "factor"),
    [("STEP TIME", 1.0), ("TOTAL TIME", 3.0)],
)
def test_a_load_that_followed_step_time_keeps_the_value_of_the_step_end(check, time, factor):
    # the amplitude is 1/3 at the end of the first step, at 0.5 s; in total time it goes on, and the load stays 3
    amplitude = f"*AMPLITUDE, NAME=UP, TIME={time}\n 0., 0., 1.5, 1.\n"
    loads = loads_of_step_2(check, "*CLOAD, AMPLITUDE=UP\nEND, 1, 3.\n", "", amplitude)
    assert loads == [f"loads at degree of freedom 1: 1 node, {factor:g}"]


# contact


CROSSING = """\
*NODE
1, 0., -1., 0.
2, 0., 1., 0.
3, -1., 0., 0.03
4, 1., 0., 0.03
*ELEMENT, TYPE=B33, ELSET=A
1, 1, 2
*ELEMENT, TYPE=B33, ELSET=B
2, 3, 4
*ELSET, ELSET=BOTH
A, B
*MATERIAL, NAME=CU
*ELASTIC
1.2e11, 0.35
*ELECTRICAL CONDUCTIVITY
5.8e7
*BEAM SECTION, ELSET=BOTH, MATERIAL=CU, SECTION=CIRC
0.01
*BOUNDARY
1, ENCASTRE
3, ENCASTRE
1, 9
3, 9
"""


@pytest.mark.parametrize(
    ("laws", "words"),
    [
        ("", "Hermite axis, Hertz force, no current"),
        ("*GAP ELECTRICAL CONDUCTANCE, LAW=PAPER, VOLTAGE=LINEAR\n", "Hertz force, spot PAPER, linear voltage"),
        (
            "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR, PENETRATION=UNLIMITED\n1e3\n",
            "penalty 1000 N/m, unlimited penetration, no current",
        ),
        ("*GAP ELECTRICAL CONDUCTANCE, LAW=PLASTIC\n1e9\n", "spot PLASTIC with H = 1e+09 Pa, corrected voltage"),
        ("*GAP ELECTRICAL CONDUCTANCE, LAW=FILM\n1e-12\n", "spot FILM with sigma_f = 1e-12 ohm m^2"),
        ("*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT\n0.002\n", "spot CONSTANT with R_c = 0.002 ohm"),
        ("*GAP ELECTRICAL CONDUCTANCE, LAW=TABLE\n1., 2.\n2., 1.\n", "spot TABLE of 2 points"),
        ("*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n0.002\n", "spot CONSTANT with R_c = 0.002 ohm m, "),
        ("*GAP ELECTRICAL CONDUCTANCE, LAW=TABLE, PER=LENGTH\n1., 2.\n2., 1.\n", "TABLE of 2 points per length, "),
    ],
)
def test_the_laws_of_a_contact(check, laws, words):
    deck = f"{CROSSING}*SURFACE INTERACTION, NAME=TOUCH\n{laws}*CONTACT PAIR, INTERACTION=TOUCH\nA, B\n"
    (line,) = [line for line in check(deck + "*STEP\n*STATIC\n*END STEP\n") if line.startswith("contact pair")]
    assert line.startswith("contact pair A with B: TOUCH, ")
    assert words in line


def test_the_laws_of_wires_on_a_rigid_surface(check):
    """It has one potential: there is no voltage in it that a spot could have corrected."""
    laws = (
        "*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n0.002\n*GAP CONDUCTANCE, LAW=CONSTANT, PER=LENGTH\n5.\n"
    )
    deck = f"{CROSSING}*NODE\n9, 0., 0., -0.1\n*RIGID SURFACE, NAME=FLOOR, TYPE=PLANE, REF NODE=9\n"
    deck += f"0., 0., -0.1, 0., 0., 1.\n*SURFACE INTERACTION, NAME=TOUCH\n{laws}*CONTACT PAIR, INTERACTION=TOUCH\nA, FLOOR\n"
    (line,) = [line for line in check(deck + "*STEP\n*STATIC\n*END STEP\n") if line.startswith("contact pair")]
    assert line.endswith("spot CONSTANT with R_c = 0.002 ohm m, heat CONSTANT with h = 5 W/(m K)")


def test_contact_within_one_set_and_the_linear_axis(check):
    deck = CROSSING + "*SURFACE INTERACTION, NAME=TOUCH, AXIS=LINEAR\n"
    deck += "*CONTACT PAIR, INTERACTION=TOUCH, INTERFERENCE FIT\nBOTH\n"
    lines = check(deck + "*STEP\n*STATIC\n*END STEP\n")
    assert "contact pair BOTH within itself: TOUCH, linear axis, Hertz force, no current, interference fit" in lines


# size


@pytest.mark.slow
def test_a_large_deck_is_read_in_seconds(litz, tmp_path):
    # 300 000 lines, numbers in steps and backwards, a set per wire; the time allows for a slow and busy machine
    n = 150_000
    with (tmp_path / "large.inp").open("w") as deck:
        deck.write("*NODE\n")
        deck.writelines(f"{7 * (n - i)}, {i % 100 * 0.01:g}, {i // 100 * 0.1:g}, 0.123456789\n" for i in range(n))
        deck.write("*ELEMENT, TYPE=B31, ELSET=ALL\n")
        deck.writelines(f"{3 * i + 1}, {7 * (n - i)}, {7 * (n - i - 1)}\n" for i in range(n) if i % 100 < 99)
        for wire in range(n // 100):
            deck.write(f"*ELSET, ELSET=W{wire}, GENERATE\n{300 * wire + 1}, {300 * wire + 296}, 3\n")
            deck.write(f"*NSET, NSET=N{wire}\n{7 * (n - 100 * wire)}\n")
        deck.write("*MATERIAL, NAME=CU\n*ELASTIC\n1e11, 0.3, 0, 0.3\n")
        deck.write("*BEAM SECTION, ELSET=ALL, MATERIAL=CU, SECTION=CIRC\n0.001\n*STEP\n*STATIC\n*BOUNDARY\n")
        deck.writelines(f"N{wire}, 1, 6\n" for wire in range(n // 100))
        deck.write("*END STEP\n")
    start = time.perf_counter()
    # the one error, of too many values, comes after everything else was read, and keeps the analysis out of the time
    result = litz("check", "large.inp", cwd=tmp_path)
    assert time.perf_counter() - start < 20
    assert result.returncode == 1
    assert re.findall("^error: (.*):", result.stderr, re.MULTILINE) == [
        "too many values: *ELASTIC takes 3 on this line"
    ]


# the program


def test_the_keyword_list_names_every_keyword_of_the_reference(litz):
    listed = re.findall(r"^\*(.*?)  ", litz("keywords").stdout, re.MULTILINE)
    described = re.findall(r"^## \\\*(.*)$", litz("keywords", "--markdown").stdout, re.MULTILINE)
    assert listed == described
    assert {"NODE", "BEAM SECTION", "GAP ELECTRICAL CONDUCTANCE", "END STEP"} <= set(listed)


def test_one_keyword_in_any_spelling(litz):
    pages = [litz("keywords", *words).stdout for words in (["beam", "section"], ["*BEAM SECTION"], ["beamsection"])]
    assert pages[0] == pages[1] == pages[2]
    assert "SECTION=CIRC|GENERAL|RECT|BOX|PIPE|I|L: shape of the cross-section; required" in pages[0]


def test_an_unknown_keyword_gets_a_hint(litz):
    result = litz("keywords", "beam", "sektion")
    assert result.returncode == 1
    assert result.stderr == 'error: unknown keyword "beamsektion"; did you mean *BEAM SECTION?\n'


def test_the_version_names_compiler_and_libraries(litz):
    result = litz("--version")
    assert result.returncode == 0
    first, *rest = result.stdout.splitlines()
    assert first.startswith("litz ")
    names = [line.split(":")[0] for line in rest if not line.startswith("solver libraries:")]
    assert names == ["compiler", "HDF5", "BLAS", "solvers"]


def test_help_tells_all_commands(litz):
    for arguments in ([], ["--help"], ["help"]):
        result = litz(*arguments)
        assert result.returncode == 0
        assert all(f"litz {command}" in result.stdout for command in ("run", "check", "keywords", "--version"))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["rum", "x.inp"], 'unknown command "rum"; did you mean litz run?'),
        (["x.inp"], 'unknown command "x.inp"; did you mean litz run x.inp?'),
        (["run"], "litz run needs a deck: litz run deck.inp"),
        (["check"], "litz check needs a deck: litz check deck.inp"),
        (["run", "x.inp", "y.inp"], 'litz run: unexpected argument "y.inp"'),
        (["run", "x.inp", "--thread", "2"], 'unknown option "--thread" of litz run; did you mean --threads?'),
        (["check", "x.inp", "--solver", "block"], 'unknown option "--solver" of litz check, which has no options'),
        (["run", "x.inp", "--threads", "none"], "the number of threads must be a whole number of at least 1"),
        (["run", "x.inp", "--threads=0"], "the number of threads must be a whole number of at least 1"),
        (["run", "x.inp", "--solver", "skylin"], 'unknown solver "skylin"; there is BLOCK, UMFPACK, SKYLINE and MUMPS'),
        (["run", "x.inp", "-o"], "the option -o needs a value"),
        (["run", "x.inp", "--quiet=yes"], "the option --quiet takes no value"),
    ],
)
def test_wrong_arguments(litz, arguments, message):
    result = litz(*arguments)
    assert result.returncode == 1
    assert result.stderr.startswith("error: " + message)
    assert result.stdout == ""

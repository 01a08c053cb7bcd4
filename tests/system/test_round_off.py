"""What round-off excuses is measured where it arises: at each node, by the stiffness there and the size of what it acts on."""

import re

import numpy as np
import pytest

from decks import MATERIAL, straight, wire
from litz import Results
from litz.results.history_table import history_table

#: A machine part of 10 mm, as a beam: 8e11 times as stiff in bending as a thread
STIFF = "*BEAM SECTION, ELSET=PART, MATERIAL=STEEL, SECTION=GENERAL\n 1e-2, 1e-3, 0, 1e-3, 2e-3\n"
PARTS = {
    "none": "",
    "beside": wire("PART", straight((0.03, 0.03, 0), (0.04, 0.03, 0), 2), 901, element="B33") + STIFF,
    # it holds an end of the lower thread
    "attached": "*NODE\n 901, 0.03, 0, 0\n*ELEMENT, TYPE=B33, ELSET=PART\n 901, 901, 10\n" + STIFF,
}


def threads(part):
    """A thread of 0.4 mm is pushed 0.1 mm into another; the ends of both are held."""
    lower = wire("LOWER", straight((-0.02, 0, 0), (0.02, 0, 0), 9), 1, element="B33")
    upper = wire("UPPER", straight((0, -0.02, 4e-4), (0, 0.02, 4e-4), 9), 101, element="B33")
    return (
        f"{lower}{upper}{MATERIAL}{PARTS[part]}"
        "*NSET, NSET=UPPER_ENDS\n 101, 110\n"
        "*BEAM SECTION, ELSET=LOWER, MATERIAL=STEEL, SECTION=CIRC\n 2e-4\n"
        "*BEAM SECTION, ELSET=UPPER, MATERIAL=STEEL, SECTION=CIRC\n 2e-4\n"
        "*SURFACE INTERACTION, NAME=TOUCH\n*CONTACT PAIR, INTERACTION=TOUCH\n LOWER, UPPER\n"
        f"*BOUNDARY\n 1, ENCASTRE\n {10 if part != 'attached' else 901}, ENCASTRE\n"
        + ("901, ENCASTRE\n" if part == "beside" else "")
        + "*STEP, INC=200\n*STATIC\n 0.1, 1, 1e-4, 0.1\n*BOUNDARY\n"
        " UPPER_ENDS, 1, 2\n UPPER_ENDS, 4, 6\n UPPER_ENDS, 3, 3, -1e-4\n*END STEP\n"
    )


@pytest.mark.parametrize("part", ["beside", "attached"])
def test_a_stiff_part_does_not_excuse_a_soft_one(run, part):
    process, alone = run(threads("none"), name="alone")
    assert process.returncode == 0, process.stderr
    process, results = run(threads(part))
    assert process.returncode == 0, process.stderr
    force = results.contacts["force"]
    assert force[-1] > 0.03
    # the part gives way by its length over EA, 5e-12 m/N: nothing beside the thread
    assert force == pytest.approx(alone.contacts["force"], rel=1e-6)
    accepted = np.append(np.diff(results.convergence["increment"]) > 0, True)
    residual, allowed = (results.convergence[name][accepted] for name in ("force", "force_allowed"))
    assert (residual <= allowed).all()
    # what is reported is the worst for its node: one of the threads, not the stiff one
    assert (allowed <= 1e-7 * force[-1]).all()


def moved(text, by):
    """The deck with all nodes moved."""
    lines, in_nodes = [], False
    for line in text.splitlines():
        if line.startswith("*"):
            in_nodes = (in_nodes and line.startswith("**")) or re.match(
                r"\*NODE *(,|$)", line, re.IGNORECASE
            ) is not None
        elif in_nodes:
            number, *position = line.split(",")
            lines.append(",".join([number, *(repr(float(x) + d) for x, d in zip(position[:3], by, strict=True))]))
            continue
        lines.append(line)
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("by", [(0, 0, 0), (3, -2, 1)])
@pytest.mark.parametrize(
    "name", ["01_crossed_wires", "02_oblique_crossing", "04_wire_grid", "08_elastica", "09_paper_law", "13_stick_slip"]
)
def test_what_round_off_leaves_is_allowed(run, inputs, name, by):
    """With a tolerance that nothing can meet, round-off alone ends the iterations: never with a cut, and soon."""
    text = (inputs / f"{name}.inp").read_text()
    step, n = re.subn(
        r"(?m)^\*STATIC", "*CONTROLS, PARAMETERS=FIELD\n 1e-30\n*STATIC", moved(text, by) if any(by) else text, count=1
    )
    assert n == 1
    process, results = run(step)
    assert process.returncode == 0, process.stderr
    assert (results.status["attempts"] == 1).all()
    usual, expected = run(text, name="usual")
    assert usual.returncode == 0
    # one or two more for the last digits
    assert (results.status["iterations"] <= expected.status["iterations"] + 2).all()


def test_what_the_iteration_leaves_across_a_force_is_nothing_in_a_table(run_of_input):
    """Crossed wires pressed along z: the supports hold nothing along x and y."""
    results = Results(run_of_input("01_crossed_wires"))
    assert results.history["RF1 sum MOVING"].any()
    lines = history_table(results).splitlines()
    first = next(i for i, line in enumerate(lines) if "RF1 sum MOVING" in line)
    assert lines[first].split()[-9:] == ["RF1", "sum", "MOVING", "RF2", "sum", "MOVING", "RF3", "sum", "MOVING"]
    rows = [line.split() for line in lines[first + 2 :] if line.split()[0].replace(".", "").isdigit()]
    assert len(rows) == len(results.history["time"])
    assert all(row[-3:-1] == ["0", "0"] for row in rows)


#: Loads that bend a cantilever of 1 m, E = 2.1e11 and a side of 0.02 m in the second direction, and its deflection for 1 N
EI = 2.1e11 * 0.02**4 / 12
TINY = {
    "force": ("*CLOAD\n 9, 2, {}\n", 1 / (3 * EI)),
    "moment": ("*CLOAD\n 9, 6, {}\n", 1 / (2 * EI)),
    "on the length": ("*DLOAD\n BEAM, PY, {}\n", 1 / (8 * EI)),
}


def cantilever(load, increment, more=""):
    beam = wire("BEAM", straight((2, 1, 3), (3, 1, 3), 8), 1, element="B33")
    section = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n 0.02, 0.02\n 0, 1, 0\n"
    material = "*MATERIAL, NAME=STEEL\n*ELASTIC\n 2.1e11, 0.3\n"
    return (
        f"{beam}{material}{section}*BOUNDARY\n 1, ENCASTRE\n"
        f"*STEP\n*STATIC\n {increment}, 1, , {increment}\n{load}{more}*END STEP\n"
    )


@pytest.mark.parametrize("increment", [1.0, 0.1])
@pytest.mark.parametrize("kind", TINY)
@pytest.mark.parametrize("size", [1e-4, 1e-10, 1e-14, 1e-22, 1e-60])
def test_loads_that_round_off_of_positions_hides_move_wires_all_the_same(run, kind, size, increment):
    """EA/L is 8.4e7 N/m: 1e-10 N give what is left of a position of 3 m, 1e-22 N nothing."""
    card, compliance = TINY[kind]
    process, results = run(cantilever(card.format(size), increment))
    assert process.returncode == 0, process.stderr
    # in each increment as the loads grow; what is left are the digits of the result file
    assert results.field("displacement")[-1, 1] == pytest.approx(size * compliance, rel=2e-8)
    told = [warning.message for warning in results.warnings if warning.kind == "round_off"]
    assert any("lost in the round-off of the" in message and "no digits" in message for message in told) == (
        size < 1e-9
    )


def test_a_run_goes_on_from_loads_that_round_off_hides(run, litz, tmp_path):
    saved = cantilever("*CLOAD\n 9, 2, 1e-20\n", 0.25, "*RESTART, WRITE, FREQUENCY=1\n")
    process, results = run(saved)
    assert process.returncode == 0, process.stderr
    assert results.field("displacement")[-1, 1] == pytest.approx(1e-20 / (3 * EI), rel=2e-8)
    place = f"{results.path.with_name('deck.restart.h5')}:1:2"
    again = litz("run", "deck.inp", "--restart", place, "-o", "again", cwd=tmp_path)
    assert again.returncode == 0, again.stderr
    rest = Results(tmp_path / "again").field("displacement")[-1, 1]
    assert rest == pytest.approx(1e-20 / (3 * EI), rel=2e-8)


def test_displacements_that_round_off_of_positions_hides_are_told(run):
    process, results = run(cantilever("*BOUNDARY\n 9, 2, 2, 1e-20\n", 0.5))
    assert process.returncode == 0, process.stderr
    # of a cantilever with a force at its end
    assert results.field("displacement")[4, 1] == pytest.approx(1e-20 * 5 / 16, rel=2e-8)
    (told,) = (warning.message for warning in results.warnings if warning.kind == "round_off")
    assert "prescribed displacements of at most 5e-21" in told or "prescribed displacements of at most 1e-20" in told

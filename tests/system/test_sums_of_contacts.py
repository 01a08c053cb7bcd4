"""What numbers of contacts and sums of their forces contain: wires on each other and on rigid surfaces."""

import subprocess

import numpy as np
import pytest

import litz
from litz.results.history_table import history_table

#: A wire is pressed by another one across it onto a plate
DECK = """\
*HEADING
Pressed onto a plate
*UNITS, SYSTEM=SI
*NODE, NSET=ALL
 1, -0.01, 0., 0.
 2, -0.003, 0., 0.
 3, 0.004, 0., 0.
 4, 0.01, 0., 0.
 5, 0., -0.01, 0.002
 6, 0., -0.003, 0.002
 7, 0., 0.004, 0.002
 8, 0., 0.01, 0.002
*ELEMENT, TYPE=B31, ELSET=LOWER
 1, 1, 2
 2, 2, 3
 3, 3, 4
*ELEMENT, TYPE=B31, ELSET=UPPER
 4, 5, 6
 5, 6, 7
 6, 7, 8
*MATERIAL, NAME=CU
*ELASTIC
 120e9, 0.34
*BEAM SECTION, ELSET=LOWER, MATERIAL=CU, SECTION=CIRC
 0.001
*BEAM SECTION, ELSET=UPPER, MATERIAL=CU, SECTION=CIRC
 0.001
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ
*RIGID SURFACE, NAME=PLATE, TYPE=PLANE
 0., 0., -0.001, 0., 0., 1.
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, UPPER
*CONTACT PAIR, INTERACTION=TOUCH
 LOWER, PLATE
*BOUNDARY
 1, ENCASTRE
 4, ENCASTRE
 5, 1, 2
 5, 4, 6
 8, 1, 2
 8, 4, 6
*STEP
*STATIC
 0.25, 1
*BOUNDARY
 5, 3, 3, -2e-5
 8, 3, 3, -2e-5
*NODE PRINT, NSET=ALL, TOTALS=ONLY
 RF
*END STEP
"""


@pytest.fixture(scope="module")
def printed_and_results(litz_program, tmp_path_factory):
    folder = tmp_path_factory.mktemp("sums")
    (folder / "pressed.inp").write_text(DECK)
    command = [litz_program, "run", "pressed.inp", "-o", "out"]
    process = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return process.stdout, litz.Results(folder / "out")


def test_the_lines_of_a_run_add_the_forces_of_all_contacts_that_they_count(printed_and_results):
    printed, results = printed_and_results
    lines = printed.splitlines()
    first = next(i for i, line in enumerate(lines) if "sum of F [N]" in line) + 1
    wires, surfaces = results.contacts, results.surface_contacts
    assert wires.n_rows > 0 < surfaces.n_rows
    for line, step, increment in zip(lines[first:], results.steps[1:], results.increments[1:], strict=False):
        number, force = line.split()[6:8]
        now = [each.where((each["step"] == step) & (each["increment"] == increment)) for each in (wires, surfaces)]
        assert int(number) == sum(each.n_rows for each in now)
        assert float(force) == pytest.approx(sum(each["force"].sum() for each in now), rel=1e-5)


def test_over_time_each_kind_has_its_columns_and_all_have_their_sum(printed_and_results):
    results = printed_and_results[1]
    table = results.contacts_over_time
    now = results.contacts_at(-1), results.surface_contacts_at(-1)
    assert table.n_rows == len(results.times)
    assert [table[name][-1] for name in ("crossings", "zones", "on_surfaces")] == [1, 0, now[1].n_rows]
    assert table["contacts"][-1] == 1 + now[1].n_rows
    sums = [each["force"].sum() for each in now]
    assert [table[f"force_{kind}"][-1] for kind in ("between_wires", "on_surfaces")] == pytest.approx(sums)
    assert table["force"][-1] == pytest.approx(sum(sums))
    assert (table.units["force"], table.units["contacts"]) == ("N", "")


def test_the_table_of_the_history_says_what_it_counts(printed_and_results):
    results = printed_and_results[1]
    kinds, *_, last = history_table(results).splitlines()
    assert kinds == "contacts: crossings and elements on rigid surfaces; contact force: the sum of all their forces"
    table = results.contacts_over_time
    assert [float(cell) for cell in last.split()[1:3]] == pytest.approx([table["contacts"][-1], table["force"][-1]])


def test_the_table_of_the_history_has_zeros_for_round_off(printed_and_results):
    """The supports do not push along the wires, by symmetry; the file of the history has what the iteration leaves."""
    results = printed_and_results[1]
    _, heads, _, *rows = (line.split() for line in history_table(results).splitlines())
    assert heads[-9:] == ["RF1", "sum", "ALL", "RF2", "sum", "ALL", "RF3", "sum", "ALL"]
    along_x, along_y, along_z = (results.history[f"RF{i} sum ALL"] for i in (1, 2, 3))
    assert 0 < np.abs(np.append(along_x, along_y)).max() < 1e-9 * np.abs(along_z).max()
    for row, force in zip(rows, along_z, strict=True):
        assert row[-3:-1] == ["0", "0"]
        assert float(row[-1]) == pytest.approx(force, rel=1e-6)


def test_the_summary_has_contacts_of_wires_and_the_force_on_the_surface(printed_and_results):
    results = printed_and_results[1]
    text = " ".join(results.summary().split())
    assert "contacts of wires 1 contact forces" in text
    assert f"force on PLATE {results.contacts_over_time['force_on_surfaces'][-1]:.5g} N" in text


def test_a_sweep_counts_and_adds_as_a_run_does(printed_and_results, tmp_path):
    results = printed_and_results[1]
    table = litz.sweep(lambda depth: DECK.replace("2e-5", f"{depth}"), {"depth": [2e-5]}, directory=tmp_path)
    all_forces = np.concatenate([results.contacts_at(-1)["force"], results.surface_contacts_at(-1)["force"]])
    assert table["contacts"][0] == len(all_forces)
    assert table["contact force"][0] == pytest.approx(all_forces.sum(), rel=1e-9)

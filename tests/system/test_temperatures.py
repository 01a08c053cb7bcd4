"""Temperatures that are given: their values over the steps, what refuses them, and what they leave alone."""

import h5py
import numpy as np
import pytest

from decks import crossed
from litz import Results
from same_results import KEEP_ALL
from test_restart import assert_goes_on_from_everywhere

#: A wire of three nodes. Placeholders: model (cards before the steps), step, later (cards of two steps)
WIRE = """\
*NODE, NSET=ALL
 1, 0, 0, 0
 2, 0.01, 0, 0
 3, 0.02, 0, 0
*ELEMENT, TYPE=B33, ELSET=WIRE
 1, 1, 2
 2, 2, 3
*MATERIAL, NAME=COPPER
*ELASTIC
 120e9, 0.34
*BEAM SECTION, ELSET=WIRE, MATERIAL=COPPER, SECTION=CIRC
 1e-3
*AMPLITUDE, NAME=TRIANGLE
 0, 0, 0.5, 1, 1, 0.5
{model}
*BOUNDARY
 1, ENCASTRE
*STEP
*STATIC, DIRECT
 0.25, 1
{step}
*END STEP
*STEP
*STATIC, DIRECT
 0.5, 1
{later}
*END STEP
"""
ROOM = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n ALL, 293"


def run(litz, tmp_path, model=ROOM, step="", later=""):
    deck = tmp_path / "wire.inp"
    step += "" if "TRIANGLE" in step else "\n*CLOAD, AMPLITUDE=TRIANGLE\n 3, 2, 0"
    deck.write_text(WIRE.format(model=model, step=step, later=later))
    done = litz("run", deck, "-o", tmp_path / "wire")
    assert done.returncode == 0, done.stderr
    return Results(tmp_path / "wire")


def test_temperatures_ramp_from_the_initial_ones_and_stay(litz, tmp_path):
    results = run(
        litz,
        tmp_path,
        model="*UNITS, SYSTEM=SI\n" + ROOM,
        step="*TEMPERATURE\n 2, 393\n*NODE PRINT, NSET=ALL, TOTALS=YES\n NT",
    )
    temperature = results.field("temperature", None)
    assert results.units["temperature"] == "K"
    np.testing.assert_array_equal(temperature[:, [0, 2]], 293)
    np.testing.assert_allclose(temperature[:, 1], [293, 318, 343, 368, 393, 393, 393], rtol=1e-15)
    np.testing.assert_array_equal(results.history["NT node 2"], temperature[:, 1])
    np.testing.assert_allclose(results.history["NT mean ALL"], temperature.mean(axis=1), rtol=1e-15)


def test_temperatures_are_zero_where_nothing_is_said(litz, tmp_path):
    temperature = run(litz, tmp_path, model="", step="*TEMPERATURE\n 2, 10").field("temperature", None)
    assert not temperature[:, [0, 2]].any()
    assert not temperature[0].any()


def test_what_a_new_list_does_not_name_returns_to_its_initial_temperature(litz, tmp_path):
    later = "*TEMPERATURE, OP=NEW\n 3, 300"
    temperature = run(litz, tmp_path, step="*TEMPERATURE\n 2, 393", later=later).field("temperature", None)
    np.testing.assert_allclose(temperature[-3:, 1], [393, 343, 293], rtol=1e-15)
    np.testing.assert_allclose(temperature[-3:, 2], [293, 296.5, 300], rtol=1e-15)


def test_an_amplitude_of_the_step_is_met_at_its_corner_and_its_end_stays(litz, tmp_path):
    temperature = run(litz, tmp_path, step="*TEMPERATURE, AMPLITUDE=TRIANGLE\n ALL, 400").field("temperature", None)
    np.testing.assert_allclose(temperature[:, 0], [293, 200, 400, 300, 200, 200, 200], rtol=1e-15)


def test_a_run_with_temperatures_goes_on_bit_for_bit(litz, tmp_path):
    step = KEEP_ALL + "*TEMPERATURE, AMPLITUDE=TRIANGLE\n ALL, 400\n*NODE PRINT, NSET=ALL\n NT"
    text = WIRE.format(model=ROOM, step=step, later="*TEMPERATURE, OP=NEW\n 2, 350")
    assert_goes_on_from_everywhere(litz, tmp_path, text)


def test_a_label_of_temperatures_stands_in_heads_and_files(litz, tmp_path):
    results = run(litz, tmp_path, model="*UNITS, TEMPERATURE=degC\n" + ROOM, step="*NODE PRINT, NSET=ALL\n NT")
    assert results.units["temperature"] == "degC"
    assert "NT node 1 [degC]" in (tmp_path / "wire" / "wire_history.csv").read_text()


def test_models_without_temperatures_show_none(litz, tmp_path):
    deck = tmp_path / "deck.inp"
    deck.write_text(crossed(extra=KEEP_ALL))
    assert litz("run", deck, "-o", tmp_path / "out").returncode == 0
    results = Results(tmp_path / "out")
    assert not any("temperature" in name or "heat" in name.removeprefix("joule_heat") for name in results.fields)
    for ending in ("sta", "cvg"):
        assert "heat" not in (tmp_path / "out" / f"deck.{ending}").read_text()
    with h5py.File(tmp_path / "out" / "deck.restart.h5") as file:
        assert file["loading_value"].shape[1] == 7


@pytest.mark.parametrize(
    ("model", "step", "message"),
    [
        (
            ROOM,
            "*BOUNDARY\n 2, 11, 11, 300",
            "no material of its elements conducts heat; temperatures are given by *TEMPERATURE",
        ),
        (ROOM, "*CFLUX\n 2, , 1", "node 2 has no temperature as an unknown"),
        ("", "*NODE PRINT, NSET=ALL\n NT", "NT cannot be printed: the model has no temperatures"),
        ("", "*EL PRINT, ELSET=WIRE\n HFL", "HFL cannot be printed: the model has no temperatures"),
        (ROOM, "*TEMPERATURE\n 2, 300, 310", "the temperature is the same over a cross-section"),
        (ROOM, "*TEMPERATURE, FILE=job\n 2, 300", "give the values of the nodes in data lines"),
        (ROOM, "*TEMPERATURE\n 2, 300\n 2, 310", "is prescribed twice with different values"),
        ("*INITIAL CONDITIONS, TYPE=STRESS\n WIRE, 1", "", "a run begins without stress and current"),
        ("*INITIAL CONDITIONS, TYPE=TEMPERATURE\n ALL, 20\n 2, 30", "", "prescribed twice with different values"),
        ("*TEMPERATURE\n ALL, 20", "", "*TEMPERATURE"),
    ],
)
def test_errors_name_what_is_wrong(litz, tmp_path, model, step, message):
    deck = tmp_path / "bad.inp"
    deck.write_text(WIRE.format(model=model, step=step + "\n*CLOAD, AMPLITUDE=TRIANGLE\n 3, 2, 0", later=""))
    done = litz("check", deck)
    assert done.returncode == 1
    assert message in " ".join(done.stderr.split())

"""Wires that bend over each other, as `litz.build` generates them, are pressed without a warning, and the judge finds nothing."""

import pytest
from wire_judge import judge, read

from litz import build

MODELS = {
    "film": lambda: build.nanowire_film(
        (8e-6, 6e-6), 14, length=6e-6, radius=30e-9, seed=3, reach=0.5e-6, material=build.STEEL
    ),
    "mat": lambda: build.fibre_mat(
        (1e-3, 1e-3), 14, radius=10e-6, seed=3, orientation="deposited", length=1e-3, material=build.STEEL
    ),
}


@pytest.mark.parametrize("name", MODELS)
def test_pressed_piles(name, litz, tmp_path):
    model = MODELS[name]()
    model.press(0.1 * model.height, increment=0.5)
    done = litz("run", model.write(tmp_path / "pile.inp"), "-o", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert len((tmp_path / "pile_contacts.csv").read_text().splitlines()) > 5
    assert judge(read(tmp_path / "pile.vtkhdf")) == []

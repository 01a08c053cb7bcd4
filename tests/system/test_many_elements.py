"""A model of more elements than are evaluated between two scatters: nothing of the first ones is lost."""

import numpy as np
import pytest

LENGTH, RADIUS, YOUNG, CONDUCTIVITY = 9.0, 1e-3, 1e11, 5e7
FORCE, VOLTAGE = 30.0, 1e-3
# litz_scatter evaluates 1024 at once
ELEMENTS = 1300


def rod():
    """A straight rod, clamped at one end, pulled at the other one, with a voltage between both."""
    x = np.linspace(0, LENGTH, ELEMENTS + 1)
    nodes = "\n".join(f"{i + 1}, {x_i:.17g}, 0, 0" for i, x_i in enumerate(x))
    elements = "\n".join(f"{i}, {i}, {i + 1}" for i in range(1, ELEMENTS + 1))
    last = ELEMENTS + 1
    return f"""*NODE
{nodes}
*ELEMENT, TYPE=B33, ELSET=ROD
{elements}
*MATERIAL, NAME=M
*ELASTIC
{YOUNG}, 0.3
*ELECTRICAL CONDUCTIVITY
{CONDUCTIVITY}
*BEAM SECTION, ELSET=ROD, MATERIAL=M, SECTION=CIRC
{RADIUS}
*STEP
*STATIC
1., 1.
*BOUNDARY
1, 1, 6
1, 9, 9, 0
{last}, 9, 9, {VOLTAGE}
*CLOAD
{last}, 1, {FORCE}
*ENERGY PRINT
*END STEP
"""


def test_energy_and_heat_are_those_of_all_elements(run):
    process, results = run(rod())
    assert process.returncode == 0, process.stderr
    area = np.pi * RADIUS**2
    # N^2 L/(2 E A) and U^2/R; large displacements add a relative N/(E A) = 1e-4
    assert results.history["ALLSE"][-1] == pytest.approx(FORCE**2 * LENGTH / (2 * YOUNG * area), rel=2e-4)
    assert results.field("joule_heat").sum() == pytest.approx(VOLTAGE**2 * CONDUCTIVITY * area / LENGTH, rel=1e-9)

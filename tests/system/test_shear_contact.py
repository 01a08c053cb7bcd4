"""Contact on thick wires of B31: the axis that touches follows the centre line, not the normals of the sections."""

import math

import numpy as np
import pytest

RADIUS, YOUNG, POISSON = 0.05, 1e9, 0.3
#: Shear stiffness of a round wire of length 1 [N]: G A by Cowper's coefficient 6 (1 + nu)/(7 + 6 nu), as litz has it
SHEAR_STIFFNESS = YOUNG / (2 * (1 + POISSON)) * math.pi * RADIUS**2 * 6 * (1 + POISSON) / (7 + 6 * POISSON)


def rail_and_crossing(element, n, place, *, arch=0.0, crossing_young, penalty, rail_end, steps, overlap="LIMITED"):
    """A rail of length 1 along x, n elements, straight or an arch of this angle, clamped at x = 0; a B33 wire on it.

    place: x where the wire along y lies on the rail, just above an arch; rail_end: lines of *BOUNDARY for node END.
    """
    s = np.linspace(0, 1, n + 1)
    angle = (s - 0.5) * arch
    x = 0.5 + np.sin(angle) / arch if arch else s
    z = (np.cos(angle) - 1) / arch if arch else 0 * s
    top = (math.sqrt(1 - (arch * (place - 0.5)) ** 2) - 1) / arch if arch else 0.0
    upper = [(place, (i - 1.5) * 0.1, top + 2 * RADIUS + 2e-3 * bool(arch)) for i in range(4)]
    numbered = [f"{i}, {x[i - 1]!r}, 0., {z[i - 1]!r}" for i in range(1, n + 2)]
    lines = [
        "*NODE, NSET=RAIL", *(line.replace("np.float64(", "").replace(")", "") for line in numbered),
        f"*ELEMENT, TYPE={element}, ELSET=RAIL", *(f"{i}, {i}, {i + 1}" for i in range(1, n + 1)),
        "*NODE, NSET=WIRE", *(f"{9001 + i}, {a!r}, {b!r}, {c!r}" for i, (a, b, c) in enumerate(upper)),
        "*ELEMENT, TYPE=B33, ELSET=WIRE", *(f"{9001 + i}, {9001 + i}, {9002 + i}" for i in range(3)),
        f"*NSET, NSET=END\n{n + 1}",
        f"*MATERIAL, NAME=RAIL\n*ELASTIC\n{YOUNG}, {POISSON}",
        f"*MATERIAL, NAME=WIRE\n*ELASTIC\n{crossing_young}, {POISSON}",
        f"*BEAM SECTION, ELSET=RAIL, MATERIAL=RAIL, SECTION=CIRC\n{RADIUS}",
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=WIRE, SECTION=CIRC\n{RADIUS}",
        f"*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR, PENETRATION={overlap}\n{penalty}",
        "*CONTACT PAIR, INTERACTION=TOUCH\nRAIL, WIRE",
        f"*BOUNDARY\n1, ENCASTRE\n{rail_end}WIRE, 4, 6",
        steps,
    ]  # fmt: skip
    return "\n".join(lines) + "\n"


def tilt_under_a_light_wire(run, element, n, force=4e3):
    """Slope of the rail where a wire rests on it through a soft contact, by the normal there, and the contact force."""
    steps = (
        "*STEP\n*STATIC\n0.1, 1., 1e-4, 0.1\n*BOUNDARY\n9001, 1, 3\n9004, 1, 3\nWIRE, 1, 2\nWIRE, 3\n"
        f"*CLOAD\nEND, 3, {force}\n*END STEP"
    )
    text = rail_and_crossing(
        element, n, 0.43, crossing_young=1e5, penalty=force, overlap="UNLIMITED", rail_end="RAIL, 2\n", steps=steps
    )  # fmt: skip
    process, results = run(text)
    assert process.returncode == 0, process.stderr
    contact = results.contacts_at(-1)
    assert len(contact["force"]) == 1
    return -contact["normal_x"][0] / contact["normal_z"][0], contact["force"][0]


def test_the_normal_settles_under_refinement_at_the_slope_of_the_centre_line(run):
    """The load on the far end shears the rail by V/GA; the wire on it takes part of V.

    The tangents of the sections would scatter by about V/GA, as the place in the element is a different one with each n.
    """
    force = 4e3
    tilt, taken = zip(*(tilt_under_a_light_wire(run, "B31", n) for n in (20, 40, 80, 160)), strict=True)
    without_shear, _ = tilt_under_a_light_wire(run, "B33", 160)
    shear = (force - taken[-1] / 2) * math.cos(math.atan(without_shear)) / SHEAR_STIFFNESS
    # the shear jumps by the contact force at the contact
    uncertain = taken[-1] / SHEAR_STIFFNESS
    assert np.ptp(tilt) < uncertain
    # beside the shear itself, the deflection that it adds turns the rail, since the force stays vertical
    turned = np.arctan(tilt) - math.atan(without_shear)
    assert turned == pytest.approx(shear, abs=uncertain + 0.1 * shear)


@pytest.mark.parametrize("arch", [0.0, 2.0])
def test_a_contact_slides_over_nodes_as_one_contact_of_smooth_force(run, arch):
    """Fine steps over three nodes of a clamped rail: no contact is lost or counted twice, the force has no jumps."""
    n, increments = 20, 90
    steps = (
        "*STEP, NAME=PRESS, INC=100\n*STATIC\n0.1, 1., 1e-4, 0.1\n*BOUNDARY\nWIRE, 1, 2\nWIRE, 3, 3, -0.02\n*END STEP\n"
        f"*STEP, NAME=DRAG, INC=200\n*STATIC, DIRECT\n{1 / increments!r}, 1.\n*BOUNDARY\nWIRE, 1, 1, 0.15\n*END STEP"
    )
    text = rail_and_crossing(
        "B31", n, 0.4155, arch=arch, crossing_young=1e13, penalty=4e7, rail_end="END, ENCASTRE\n", steps=steps
    )
    process, results = run(text)
    assert process.returncode == 0, process.stderr
    ledger = [results.contacts_at(int(i)) for i in np.flatnonzero(results.steps > 1)]
    assert {len(contact["force"]) for contact in ledger} == {1}
    force = np.array([contact["force"][0] for contact in ledger])
    place = np.linspace(-1, 1, len(force))
    smooth = np.polyval(np.polyfit(place, force, 5), place)
    # elements miss a part of the deflection under a force inside them, h/(4 G A) and h^3/(192 E I) of it at most
    h, bending = 1 / n, YOUNG * math.pi * RADIUS**4 / 4
    missed = (h / (4 * SHEAR_STIFFNESS) + h**3 / (192 * bending)) * force.mean() / 0.02
    assert abs(force / smooth - 1).max() < missed

"""Contacts that conduct heat: a hot spot, and a current that presses its own contact together.

Source: F. Kohlrausch, Ann. Phys. 306 (1900) 132-158 (potential and temperature in a constriction); R. Holm, Electric Contacts,
4th ed. (1967), sections 13 to 17. In a metal with lambda rho = L T half of the heat of the current enters either wire, and
T_max^2 = T^2 + V^2/(4 L). Crossed wires of equal radius r that overlap by d have a round spot of radius sqrt(r d) (H. Hertz),
whose resistance is rho/2 over that radius.

The closed loop: wires between clamps, crossed in their middles, swell by the heat of the current and press their spot to
d = d0 + 2 r alpha (T - T0), while the resistivity rho0 (1 + b (T - T0)) rises. In an arm that carries the current I

    theta = T - T0 + 1/b,  theta'' = -k^2 theta,  k = (I/A) sqrt(rho0 b/lambda)

so that the temperature T of the crossing follows from one equation: what enters it from the arm and the spot leaves through
the cold arm. The resistance of the spot has a minimum over the current.

The warmed spot: in a metal of constant conductivity, rho = L T/lambda, a spot whose current warms it between wires of the
temperature T passes I = 2 sqrt(L) (T/R) arctan(V/(2 sqrt(L) T)), with its resistance R at that temperature.
"""

import numpy as np
from scipy.optimize import brentq

from verification import figures

RADIUS, ARM, ROOM = 0.5e-3, 0.01, 293.15
AREA = np.pi * RADIUS**2
CONDUCTIVITY, RESISTIVITY, SLOPE, LORENZ, ALPHA = 390.0, 1.7e-8, 4e-3, 2.44e-8, 17e-6
#: Overlaps at room temperature: of the hot spot, and of the closed loop
PRESSED, TOUCHING = 4e-7, 1.5e-6
VOLTS = (0.05, 0.1, 0.15)
CURRENTS = np.arange(10.0, 131.0, 10.0)
#: Those of the warmed spot
STRONG_CURRENTS = (50.0, 80.0, 110.0)


def crossed(elements, overlap, sigma, heat, material, steps, spot="LAW=HERTZ"):
    """Two wires between clamps, each of two arms, whose middles are a node; they carry a current from arm to arm."""
    n = 2 * elements + 1
    lines = [
        "*HEADING",
        " Crossed wires that a current heats",
        "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0",
        "*NODE, NSET=ALL",
    ]
    for wire in range(2):
        for i, s in enumerate(np.linspace(-ARM, ARM, n)):
            x, y, z = (s, 0.0, 0.0) if wire == 0 else (0.0, s, 2 * RADIUS - overlap)
            lines.append(f" {100 * wire + i + 1}, {x:.17g}, {y:.17g}, {z:.17g}")
    for wire, name in enumerate("AB"):
        lines.append(f"*ELEMENT, TYPE=B33, ELSET={name}")
        lines += [f" {100 * wire + i}, {100 * wire + i}, {100 * wire + i + 1}" for i in range(1, n)]
    lines += ["*ELSET, ELSET=BOTH", " A, B", f"*NSET, NSET=ENDS\n 1, {n}, 101, {100 + n}"]
    lines += ["*MATERIAL, NAME=COPPER", "*ELASTIC", " 120e9, 0.34", "*ELECTRICAL CONDUCTIVITY", sigma]
    lines += ["*CONDUCTIVITY", f" {CONDUCTIVITY}", *material]
    lines += ["*BEAM SECTION, ELSET=BOTH, MATERIAL=COPPER, SECTION=CIRC", f" {RADIUS}"]
    lines += ["*SURFACE INTERACTION, NAME=TOUCH", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"]
    lines += [f"*GAP ELECTRICAL CONDUCTANCE, {spot}", heat, "*CONTACT PAIR, INTERACTION=TOUCH", " A, B"]
    lines += ["*INITIAL CONDITIONS, TYPE=TEMPERATURE", f" ALL, {ROOM}", "*BOUNDARY", " ALL, ENCASTRE", " 101, 9"]
    return "\n".join([*lines, *steps, ""])


def hot_spot(workspace):
    """Temperature of the wires where they cross and the hottest one between them, at each voltage."""
    steps = []
    for volts in VOLTS:
        steps += ["*STEP", "*COUPLED THERMAL-ELECTRICAL, STEADY STATE", "*BOUNDARY"]
        steps += [f" ENDS, 11, 11, {ROOM}", f" 1, 9, 9, {volts}", "*END STEP"]
    heat = f"*GAP CONDUCTANCE, LAW=METAL, LORENZ={LORENZ}"
    results = workspace.run("hot_spot", crossed(1, PRESSED, f" {1 / RESISTIVITY:.17g}", heat, [], steps))
    found = [results.contacts_at(i) for i in range(1, len(VOLTS) + 1)]
    return [float(one[name][0]) for one in found for name in ("temperature_1", "temperature_max")]


def hot_spot_reference():
    """The same in closed form."""
    spot, arm = RESISTIVITY / (2 * np.sqrt(RADIUS * PRESSED)), RESISTIVITY * ARM / AREA
    values = []
    for volts in VOLTS:
        current = volts / (2 * arm + spot)
        wires = ROOM + current**2 * (spot + arm) / 2 * ARM / (2 * CONDUCTIVITY * AREA)
        values += [wires, np.sqrt(wires**2 + (current * spot) ** 2 / (4 * LORENZ))]
    return values


def warmed_spot(workspace, elements=40):
    """Voltage of the spot, temperature of the wires and hottest one at each current, with SUPERTEMPERATURE."""
    sigma = "\n".join(f" {CONDUCTIVITY / (LORENZ * t):.17g}, {t}" for t in (1.0, 5000.0))
    steps = []
    for current in STRONG_CURRENTS:
        steps += ["*STEP", "*COUPLED THERMAL-ELECTRICAL, STEADY STATE", "*BOUNDARY"]
        steps += [f" ENDS, 11, 11, {ROOM}", "*CECURRENT", f" 1, , {current}", "*END STEP"]
    heat = f"*GAP CONDUCTANCE, LAW=METAL, LORENZ={LORENZ}"
    text = crossed(elements, PRESSED, sigma, heat, [], steps, "LAW=HERTZ, SUPERTEMPERATURE=YES")
    results = workspace.run("warmed_spot", text)
    last = [np.flatnonzero(np.asarray(results.steps) == step)[-1] for step in range(1, len(STRONG_CURRENTS) + 1)]
    names = ("voltage_gap", "temperature_1", "temperature_max")
    return [float(results.contacts_at(int(i))[name][0]) for i in last for name in names]


def warmed_spot_reference():
    """The same from one equation for the rise, with the arms as in the closed loop."""
    resistivity, slope, root = LORENZ * ROOM / CONDUCTIVITY, 1 / ROOM, np.sqrt(LORENZ)

    def voltage(kelvin, current):
        cold = LORENZ * kelvin / CONDUCTIVITY / (2 * np.sqrt(RADIUS * PRESSED))
        return 2 * root * kelvin * np.tan(current * cold / (2 * root * kelvin))

    def left_over(rise, current):
        k = current / AREA * np.sqrt(resistivity * slope / CONDUCTIVITY)
        from_arm = -k * ((1 / slope + rise) * np.cos(k * ARM) - 1 / slope) / np.sin(k * ARM)
        return current * voltage(ROOM + rise, current) / 2 + CONDUCTIVITY * AREA * (from_arm - rise / ARM)

    values = []
    for current in STRONG_CURRENTS:
        kelvin = ROOM + brentq(left_over, 1e-6, 2000.0, args=(current,), xtol=1e-12)
        volts = voltage(kelvin, current)
        values += [volts, kelvin, np.sqrt(kelvin**2 + volts**2 / (4 * LORENZ))]
    return values


def closed_loop(workspace, elements=40):
    """Rise of the temperature where the wires cross, and resistance of the spot, at each current."""
    sigma = "\n".join(f" {1 / (RESISTIVITY * (1 + SLOPE * (t - ROOM))):.17g}, {t}" for t in (ROOM - 200, 5000.0))
    steps = []
    for current in CURRENTS:
        steps += ["*STEP", "*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, STEADY STATE", " 1., 1.", "*BOUNDARY"]
        steps += [f" ENDS, 11, 11, {ROOM}", "*CECURRENT", f" 1, , {current}", "*END STEP"]
    text = crossed(elements, TOUCHING, sigma, "*GAP CONDUCTANCE, LAW=CONDUCTIVITY", ["*EXPANSION", f" {ALPHA}"], steps)
    results = workspace.run("closed_loop", text)
    last = [np.flatnonzero(np.asarray(results.steps) == step)[-1] for step in range(1, len(CURRENTS) + 1)]
    found = [results.contacts_at(int(i)) for i in last]
    temperature, resistance = (
        np.array([float(one[name][0]) for one in found]) for name in ("temperature_1", "resistance")
    )
    return temperature - ROOM, resistance


def spot_resistance(rise):
    """Of wires that are warmer by `rise` than where they overlap by TOUCHING."""
    return RESISTIVITY * (1 + SLOPE * rise) / (2 * np.sqrt(RADIUS * (TOUCHING + 2 * RADIUS * ALPHA * rise)))


def closed_loop_reference():
    """The same from one equation for the rise, with the temperature of the arms in closed form."""

    def left_over(rise, current):
        k = current / AREA * np.sqrt(RESISTIVITY * SLOPE / CONDUCTIVITY)
        from_arm = -k * ((1 / SLOPE + rise) * np.cos(k * ARM) - 1 / SLOPE) / np.sin(k * ARM)
        return current**2 * spot_resistance(rise) / 2 + CONDUCTIVITY * AREA * (from_arm - rise / ARM)

    rises = np.array([brentq(left_over, 1e-6, 2000.0, args=(current,), xtol=1e-12) for current in CURRENTS])
    return rises, spot_resistance(rises)


def measure(workspace):
    temperature, resistance = closed_loop(workspace)
    return {
        "heated_contacts.hot_spot": hot_spot(workspace),
        "heated_contacts.warmed_spot": warmed_spot(workspace),
        "heated_contacts.loop_rise": list(temperature),
        "heated_contacts.loop_resistance": list(resistance),
        "figure": (temperature, resistance),
    }


def draw(values, path):
    """Resistance of the spot over the current."""
    rise, resistance = closed_loop_reference()
    found_rise, found_resistance = values["figure"]
    with figures.panels(path, columns=2) as (left, right):
        left.plot(CURRENTS, rise, label="one equation")
        left.plot(CURRENTS, found_rise, "o", label="litz")
        left.set(xlabel="current [A]", ylabel="rise where they cross [K]")
        right.plot(CURRENTS, 1e3 * resistance, label="one equation")
        right.plot(CURRENTS, 1e3 * found_resistance, "o", label="litz")
        right.set(xlabel="current [A]", ylabel="resistance of the spot [mohm]")
        left.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["heated_contacts"]))

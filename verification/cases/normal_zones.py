"""Normal zones that travel along superconducting wires: velocities without and with cooling, and how they depend on the mesh.

Source: W. H. Whetstone, C. E. Roos, J. Appl. Phys. 36 (1965) 783-791; W. H. Cherry, J. I. Gittleman, Solid-State Electron. 1
(1960) 287-305; M. N. Wilson, Superconducting Magnets (1983), chapter 9: v = (J/C) sqrt(rho k/(Ts - T0)) where the heat of the
current sets in at Ts, times (1 - 2 y)/sqrt(1 - y) with the part y that a film of that rise takes of the heat; the zone recovers
where y > 1/2. For a heat that grows between the temperature at which a current is shared and the critical one, or by the power
law, references/normal_zone.py. A strand of NbTi has the fit of L. Bottura, IEEE Trans. Appl. Supercond. 10 (2000) 1054-1057.
"""

import numpy as np
from scipy.optimize import brentq

from verification import figures
from verification.references.normal_zone import Wire, velocity_of_step

RADIUS, PART, SIGMA, CURRENT, COLD = 0.41e-3, 0.4, 5e9, 400.0, 4.2
CONDUCTIVITY, DENSITY, HEAT = 300.0, 8900.0, 1.0
AREA, CAPACITY = np.pi * RADIUS**2, DENSITY * HEAT
#: Heat of the current in the metal alone [W/m^3]
FULL = (CURRENT / AREA) ** 2 / (SIGMA * (1 - PART))
#: Temperatures between which the heat grows: at once but for 0.4 K, and over the range of a strand [K]
STEP, RAMP = (6.8, 7.2), (7.2, 9.2)
#: Parts of the heat that a film takes at the middle of the step, and the velocity without one [m/s]
COOLED = (0.2, 0.5, 0.7)
ADIABATIC = velocity_of_step(np.mean(STEP) - COLD, FULL, CONDUCTIVITY, CAPACITY)
#: Width of a front [m], elements of the finest mesh, path that is measured, increments that the front takes for an element
WIDTH, SIZE, WAY, PER_ELEMENT = CONDUCTIVITY / (ADIABATIC * CAPACITY), 0.25e-3, 20e-3, 4
#: A strand of NbTi at 5 T: exponent, jref, C0, Bc20, Tc0, alpha, beta, gamma; conductivity and heat at 4 and 24 K
N, CRITERION, FLUX, NBTI = 30, 1e-4, 5.0, (3e9, 27.04, 14.5, 9.2, 0.57, 0.9, 2.32)
RANGE, OF_RANGE = (4.0, 24.0), ((250.0, 650.0), (0.5, 4.5))


def filaments(between):
    """Filaments of a critical current that falls to the current, and from there linearly to nothing."""
    sharing, critical = between
    slope = CURRENT / (AREA * PART) / (critical - sharing)
    return f"N=1000, FRACTION={PART}\n {slope * critical:.17g}, 0, 0\n 0, {critical}, 0\n"


def deck(superconductor, nodes, temperatures, increment, time, *, film=0.0, properties=None):
    """A wire along x with a current, and temperatures to begin with."""
    count = len(nodes)
    conductivity, heat = properties or (f" {CONDUCTIVITY}\n", f" {HEAT}\n")
    return (
        "*HEADING\n A normal zone travels along a superconducting wire\n*NODE, NSET=ALL\n"
        + "".join(f" {i}, {x:.17g}, 0, 0\n" for i, x in enumerate(nodes, 1))
        + "*ELEMENT, TYPE=B33, ELSET=WIRE\n"
        + "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, count))
        + f"*MATERIAL, NAME=STRAND\n*ELASTIC\n 100.e9, 0.3\n*ELECTRICAL CONDUCTIVITY\n {SIGMA}\n*CONDUCTIVITY\n{conductivity}"
        f"*DENSITY\n {DENSITY}\n*SPECIFIC HEAT\n{heat}*SUPERCONDUCTOR, {superconductor}"
        f"*BEAM SECTION, ELSET=WIRE, MATERIAL=STRAND, SECTION=CIRC\n {RADIUS}\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\n"
        + "".join(f" {i}, {t:.17g}\n" for i, t in enumerate(temperatures, 1))
        + f"*STEP, INC=100000\n*COUPLED THERMAL-ELECTRICAL\n {increment:.17g}, {time:.17g}\n"
        f"*BOUNDARY\n 1, 9\n*CECURRENT\n {count}, , {-CURRENT}\n"
        + (f"*FILM\n WIRE, F, {COLD}, {film:.17g}\n" if film else "")
        + "*END STEP\n"
    )


def front_of_step(x, begin, at, cooling):
    """Temperatures of a front that has its step where x is `begin` [K]."""
    rise = at - COLD
    speed = CAPACITY * velocity_of_step(rise, FULL, CONDUCTIVITY, CAPACITY, cooling)
    root = np.sqrt(speed**2 + 4 * CONDUCTIVITY * cooling)
    ahead, behind = np.clip(x - begin, 0, None), np.clip(begin - x, 0, None)
    cold = rise * np.exp(-(root + speed) / (2 * CONDUCTIVITY) * ahead)
    if cooling:
        top = FULL / cooling - rise
        return COLD + cold + top * (1 - np.exp(-(root - speed) / (2 * CONDUCTIVITY) * behind))
    return COLD + cold + FULL / speed * behind


def travel(
    workspace, name, superconductor, at, expected, *, size=SIZE, per_element=PER_ELEMENT, cooling=0.0, properties=None
):
    """Velocity over the second half of a path [m/s], with places, times and temperatures.

    The front begins as that of a step in a wire of constant properties, far from both ends.
    """
    pace = max(abs(expected), ADIABATIC / 4)
    nodes = np.arange(0, round(80e-3 / size) + 1) * size
    begin = 30e-3 if expected > -ADIABATIC / 4 else 50e-3
    increment = size / (per_element * pace)
    text = deck(superconductor, nodes, front_of_step(nodes, begin, at, cooling), increment, WAY / pace,
                film=cooling * RADIUS / 2, properties=properties)  # fmt: skip
    results = workspace.run(name, text)
    temperatures, times = results.field("temperature", None), results.times
    place = np.array([_crossing(nodes, row, at) for row in temperatures])
    late = times >= times[-1] / 2
    return np.polyfit(times[late], place[late], 1)[0], nodes, times, temperatures


def _crossing(x, temperatures, level):
    """Where the temperature falls through a level, linear between the nodes [m]."""
    i = np.flatnonzero(temperatures > level)[-1]
    return x[i] + (temperatures[i] - level) / (temperatures[i] - temperatures[i + 1]) * (x[i + 1] - x[i])


def ramp(between):
    """Heat of a current that is shared between two temperatures [W/m^3]."""
    return lambda t: FULL * np.clip((t - between[0]) / (between[1] - between[0]), 0, 1)


def wire_of(between, cooling=0.0):
    """A wire of constant properties as the reference has it."""
    return Wire(COLD, between[1], ramp(between), FULL, lambda _: CONDUCTIVITY, lambda _: CAPACITY, cooling)


def strand():
    """The strand of NbTi as the reference has it."""
    critical = NBTI[3] * (1 - FLUX / NBTI[2]) ** (1 / 1.7)
    k, c = (lambda t, values=values: np.interp(t, RANGE, values) for values in OF_RANGE)
    return Wire(COLD, critical, _heat_of_strand, FULL, k, lambda t: DENSITY * c(t))


def _heat_of_strand(t):
    """E J of filaments and metal in parallel [W/m^3]."""
    jref, c0, bc20, tc0, alpha, beta, gamma = NBTI
    rest = max(1 - (t / tc0) ** 1.7, 0.0)
    b = FLUX / (bc20 * rest) if rest else 1.0
    critical = jref * c0 / FLUX * b**alpha * (1 - b) ** beta * rest**gamma if b < 1 else 0.0
    density, metal = CURRENT / AREA, (1 - PART) * SIGMA
    if critical == 0.0:
        return density**2 / metal
    excess = lambda e: np.logaddexp(np.log(metal) + e, np.log(PART * critical) + (e - np.log(CRITERION)) / N)  # noqa: E731
    return density * np.exp(brentq(lambda e: excess(e) - np.log(density), -800, 50, xtol=1e-13))


def measure(workspace):
    step, middle = filaments(STEP), np.mean(STEP)
    found, *front = travel(workspace, "step", step, middle, ADIABATIC, size=2 * SIZE)
    values = {"normal_zones.step": found, "figure": front}
    if workspace.quick:
        return values
    values["normal_zones.cooled"] = [
        travel(workspace, f"cooled_{y}", step, middle, ADIABATIC * (1 - 2 * y) / np.sqrt(1 - y),
               cooling=y * FULL / (middle - COLD))[0] / ADIABATIC
        for y in COOLED
    ]  # fmt: skip
    shared = velocity_of_step(np.mean(RAMP) - COLD, FULL, CONDUCTIVITY, CAPACITY)
    meshes = [
        travel(workspace, f"ramp_{factor}_{count}", filaments(RAMP), np.mean(RAMP), shared,
               size=factor * SIZE, per_element=count)[0]
        for factor, count in ((4, 8), (2, 8), (1, 8), (2, 4))
    ]  # fmt: skip
    values["normal_zones.ramp"] = meshes[2]
    values["normal_zones.mesh"] = np.log2((meshes[0] - meshes[1]) / (meshes[1] - meshes[2]))
    values["normal_zones.increments"] = abs(meshes[3] / meshes[1] - 1)
    properties = tuple(f" {a}, {RANGE[0]}\n {b}, {RANGE[1]}\n" for a, b in OF_RANGE)
    fit = f"LAW=NBTI, N={N}, FRACTION={PART}, FIELD={FLUX}\n {', '.join(map(str, NBTI))}\n"
    values["normal_zones.strand"] = travel(workspace, "strand", fit, 6.0, ADIABATIC, properties=properties)[0]
    return values


def draw(values, path):
    """The front of a step at several times, and the temperatures of the closed form."""
    nodes, times, temperatures = values["figure"]
    velocity = values["normal_zones.step"]
    with figures.panels(path, columns=1) as axes:
        for k in np.linspace(0.5, 1, 4) * (len(times) - 1):
            row = temperatures[round(k)]
            place = _crossing(nodes, row, np.mean(STEP))
            (line,) = axes.plot(1e3 * nodes, row, label=f"{1e3 * times[round(k)]:.2f} ms")
            near = np.arange(place - 8e-3, place + 8e-3, 1e-3)
            axes.plot(1e3 * near, front_of_step(near, place, np.mean(STEP), 0.0), ".", color=line.get_color())
        axes.set(
            xlabel="x [mm]",
            ylabel="T [K]",
            title=f"{velocity:.2f} m/s; points: front of a step",
            xlim=(15, 70),
            ylim=(4, 25),
        )
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["normal_zones"]))

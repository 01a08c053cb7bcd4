"""Crossed wires of metal that yields: onset, loading, dent, and resistance on the way up and back.

Source: R. L. Jackson, I. Green, J. Tribol. 127 (2005) 343-354, L. Kogut, I. Etsion, J. Appl. Mech. 69 (2002) 657-662 and
I. Etsion, Y. Kligerman, Y. Kadin, Int. J. Solids Struct. 42 (2005) 3716-3729: fits to finite elements of a sphere on a
plane (references/flattened_spheres.py); K. L. Johnson, Contact Mechanics (1985), sections 3.3 and 3.4: a half-space under
an even pressure, and flat punches; R. Holm, Electric Contacts, 4th ed. (1967): R = (rho/2) sqrt(pi H/F) of one spot at the
hardness; G. Wexler, Proc. Phys. Soc. 89 (1966) 927-941: spots smaller than the mean free path. The onset is that of the
largest pressure of Hertz with 30 digits (references/hertz.py). Values are those of `litz.kernels.normal_law` and
`contact_spot`.
"""

import math

import numpy as np

from litz import kernels
from verification import figures
from verification.references import flattened_spheres, hertz

RADIUS, YOUNG, POISSON, RESISTIVITY = 1e-3, 120e9, 0.3, 1.7e-8
YIELD_STRESS = 20e6
HARDNESS = 2.8 * YIELD_STRESS
WIRES = {"radius": RADIUS, "young": YOUNG, "poisson": POISSON, "yield_stress": YIELD_STRESS}
MODULUS = float(hertz.effective_modulus((YOUNG, YOUNG), (POISSON, POISSON)))
ANGLES = (90, 45, 20)
OMEGA = np.array([2, 3, 6, 10, 20, 50, 110])
KNUDSEN = (0.5, 1, 2, 5, 10)


def law(overlap, degrees=90, **more):
    return kernels.normal_law(overlap, angle=math.radians(degrees), **WIRES, **more)


def onset_of_sphere():
    """Force, overlap and area, R = r: a = pi p R/(2 E*)."""
    pressure = flattened_spheres.onset_pressure(POISSON) * YIELD_STRESS
    a = math.pi * pressure * RADIUS / (2 * MODULUS)
    return 2 / 3 * pressure * math.pi * a**2, a**2 / RADIUS, math.pi * a**2


def overlap_of_force(force, degrees=90):
    """By bisection."""
    low, high = 0.0, 0.05 * RADIUS
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if law(middle, degrees).force < force else (low, middle)
    return high


def pressure_of_first_dent(degrees):
    """Largest pressure of Hertz under the smallest force that leaves a dent."""
    low, high = 1e-12, 1e-6
    for _ in range(100):
        middle = math.sqrt(low * high)
        low, high = (low, middle) if law(middle, degrees).dissipation > 0 else (middle, high)
    force = law(low, degrees).force
    return hertz.crossed_wires(
        force, math.radians(degrees), radius=(RADIUS, RADIUS), modulus=MODULUS, resistivity=(1, 1)
    ).peak_pressure


def resistance(force, degrees=90, **more):
    spot = kernels.contact_spot(force, angle=math.radians(degrees), resistivity=RESISTIVITY, **WIRES, **more)
    return 1 / spot.conductance


def slope(force, **more):
    """Of log R over log F."""
    spot = kernels.contact_spot(force, angle=math.pi / 2, resistivity=RESISTIVITY, **WIRES, **more)
    return -spot.dconductance_dforce * force / spot.conductance


def share_of_holm(k):
    """What remains of Holm's resistance where the mean free path is k times the radius of the spot."""
    wires = {"radius": RADIUS, "young": YOUNG, "poisson": POISSON, "resistivity": RESISTIVITY, "angle": math.pi / 2}
    bare = kernels.contact_spot(1e-4, **wires)
    small = kernels.contact_spot(1e-4, mean_free_path=k * bare.semi_major, **wires)
    sharvin = 4 * RESISTIVITY * k / (3 * math.pi * bare.semi_major)
    return (1 / small.conductance - sharvin) * bare.conductance


def measure(workspace):
    force, overlap, area = onset_of_sphere()
    loading = law(OMEGA * overlap)
    largest = 1e5 * force
    top = law(overlap_of_force(largest))
    path = np.linspace(0, 1, 4001) ** 2
    down = law(top.dent + path * (overlap_of_force(largest) - top.dent), largest_force=largest)
    up = law(path * overlap_of_force(largest))
    loop = np.trapezoid(up.force, path) * overlap_of_force(largest) - np.trapezoid(down.force, path) * (
        overlap_of_force(largest) - top.dent
    )
    deep = overlap_of_force(1e3 * force, 20) * 1.5
    return {
        "yielding_spots.onset": [pressure_of_first_dent(degrees) / YIELD_STRESS for degrees in ANGLES],
        "yielding_spots.plastic_slope": [law(deep, degrees).stiffness for degrees in ANGLES],
        "yielding_spots.kogut_etsion.force": (loading.force / force).tolist(),
        "yielding_spots.kogut_etsion.area": (math.pi * loading.semi_major**2 / area).tolist(),
        "yielding_spots.jackson_green.force": (loading.force / force).tolist(),
        "yielding_spots.jackson_green.area": (math.pi * loading.semi_major**2 / area).tolist(),
        "yielding_spots.dent": (loading.dent / (OMEGA * overlap)).tolist(),
        "yielding_spots.even_pressure": (overlap_of_force(largest) - top.dent)
        * MODULUS
        / (2 * HARDNESS * top.semi_major),
        "yielding_spots.way_back": [
            resistance(largest) / resistance(x * largest, largest_force=largest) for x in (0.5, 0.1)
        ],
        "yielding_spots.loop": loop / top.dissipation,
        "yielding_spots.slopes": [
            slope(0.5 * force),
            slope(largest),
            slope(largest * (1 - 1e-9), largest_force=largest),
            slope(largest * 1e-6, largest_force=largest),
        ],
        "yielding_spots.holm": resistance(largest) / (RESISTIVITY / 2 * math.sqrt(math.pi * HARDNESS / largest)),
        "yielding_spots.knudsen": [share_of_holm(k) for k in KNUDSEN],
        "figure": {"onset": force},
    }


def draw(values, path):
    onset = values["figure"]["onset"]
    forces = onset * np.geomspace(1e-2, 1e5, 60)
    with figures.panels(path, height=3.2) as (force, resist):
        omega = np.geomspace(1, 110, 40)
        _, unit, _ = onset_of_sphere()
        force.loglog(omega, flattened_spheres.kogut_etsion(omega)[0], "--", color="#777777", label="Kogut and Etsion")
        strain = YIELD_STRESS / MODULUS
        of_spheres = flattened_spheres.jackson_green(omega, strain, POISSON)[0]
        force.loglog(omega, of_spheres, ":", color="#222222", label="Jackson and Green")
        force.loglog(omega, law(omega * unit).force / onset, color="#c4451c", label="litz")
        top = law(110 * unit)
        back = np.linspace(top.dent, 110 * unit, 200)[1:]
        force.loglog(back / unit, law(back, largest_force=top.force).force / onset, color="#0b62a4", label="unloading")
        force.set(xlabel=r"overlap $\delta/\delta_Y$", ylabel="force $F/F_Y$", ylim=(0.7, None))
        force.legend(fontsize=8)
        resist.loglog(forces, [resistance(f) * 1e3 for f in forces], color="#c4451c", label="loading")
        for multiple in (1e2, 1e5):
            largest = multiple * onset
            down = largest * np.geomspace(1e-4, 1, 40)
            values_down = [resistance(f, largest_force=largest) * 1e3 for f in down]
            resist.loglog(down, values_down, color="#0b62a4", label="unloading" if multiple == 1e2 else None)
        start = resistance(forces[0]) * 1e3
        resist.loglog(
            forces, start * (forces / forces[0]) ** (-1 / 3), "--", color="#777777", label="slope -1/3, Hertz"
        )
        holm = RESISTIVITY / 2 * np.sqrt(np.pi * HARDNESS / forces) * 1e3
        resist.loglog(forces, holm, ":", color="#222222", label="slope -1/2, Holm")
        resist.set(xlabel="contact force [N]", ylabel="contact resistance [mohm]")
        resist.legend(fontsize=8)


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["yielding_spots"]))

"""Spot and resistance of two crossed wires: over the crossing angle, and over the force for each law.

Source: H. Hertz (1882) in K. L. Johnson, Contact Mechanics (1985), section 4.2; R. Holm, Electric Contacts, 4th ed.
(1967): R_c = (rho1 + rho2) K(m)/(2 pi a) of an elliptic spot, rho/(2 a) of a circle, F = pi a^2 H of a plastic one;
values with 30 digits from references/hertz.py. The law of the paper (D. P. Boso, P. Litewka, B. A. Schrefler, P.
Wriggers, Electric-mechanical beam-to-beam contact) takes the mean radius r rb/(r + rb), which is that of two spheres.
Two equal cylinders at right angles have twice that radius, r: the paper's spot is smaller by 2^(-1/3) and its
resistance larger by 2^(1/3), which is 26 %, whatever the force. At other angles the spot is an ellipse and the
paper's is a circle: at 20 degrees the resistance is 2.09 times too large.
"""

import math

import numpy as np

from litz import kernels
from verification import figures
from verification.references import hertz
from verification.wire_decks import COPPER

ANGLES = (90, 60, 45, 30, 20)
#: Radii, E* and resistivities of 1
UNIT = {"radius": 1.0, "young": 2.0, "poisson": 0.0, "resistivity": 1.0}
WIRES = {"radius": COPPER.radius, "young": COPPER.young, "poisson": COPPER.poisson, "resistivity": COPPER.resistivity}
#: Forces and angles of the copper wires
COPPER_STATES = ((1.0, 90), (1.0, 60), (1.0, 30), (100.0, 90))
FORCES = np.geomspace(1e-4, 1e2, 25)
HARDNESS, FILM = 1e9, 1e-12
LAWS = {
    "hertz": {"law": "hertz"},
    "paper": {"law": "paper"},
    "plastic": {"law": "plastic", "hardness": HARDNESS},
    "film": {"law": "film", "film_resistivity": FILM},
}


def spot(force, degrees, wires=UNIT, **law):
    return kernels.contact_spot(force, **wires, angle=math.radians(degrees), **law)


def resistances(law, forces=FORCES):
    return np.array([1 / spot(force, 90, WIRES, **LAWS[law]).conductance for force in forces])


def slope(forces, values):
    """Slope in the log-log picture, between the ends."""
    return float(np.log(values[-1] / values[0]) / np.log(forces[-1] / forces[0]))


def measure(workspace):
    unit = [spot(1.0, degrees) for degrees in ANGLES]
    copper = [spot(force, degrees, WIRES) for force, degrees in COPPER_STATES]
    values = {
        "contact_spot.semi_major": [s.semi_major for s in unit],
        "contact_spot.semi_minor": [s.semi_minor for s in unit],
        "contact_spot.approach": [s.approach for s in unit],
        "contact_spot.resistance": [1 / s.conductance for s in unit],
        "contact_spot.shape_factor": [2 * math.sqrt(s.semi_major * s.semi_minor) / s.conductance for s in unit],
        "contact_spot.copper.resistance": [1 / s.conductance for s in copper],
        "contact_spot.copper.approach": [s.approach for s in copper],
    }
    found = {law: resistances(law) for law in LAWS}
    exact, paper = spot(1.0, 90, WIRES), spot(1.0, 90, WIRES, law="paper")
    values["contact_spot.paper.radius"] = paper.semi_major / exact.semi_major
    values["contact_spot.paper.resistance"] = [float(ratio) for ratio in (found["paper"] / found["hertz"])[[0, 12, 24]]]
    values["contact_spot.paper.angle"] = [
        spot(1.0, d).conductance / spot(1.0, d, law="paper").conductance for d in ANGLES
    ]
    values["contact_spot.plastic"] = float(1 / spot(1.0, 90, WIRES, **LAWS["plastic"]).conductance)
    values["contact_spot.slopes"] = [slope(FORCES, found[law]) for law in ("hertz", "paper", "plastic")]
    weak = np.array([1e-9, 1e-8])
    values["contact_spot.film_slope"] = slope(weak, resistances("film", weak))
    return values | {"figure": found}


def draw(values, path):
    with figures.panels(path, height=3.2) as (angle, force):
        degrees = np.linspace(12, 90, 40)
        exact = [hertz.crossed_wires(1, math.radians(d), radius=(1, 1), modulus=1, resistivity=(1, 1)) for d in degrees]
        angle.plot(degrees, [s.resistance for s in exact], label="Hertz and Holm, 30 digits", **figures.REFERENCE)
        angle.plot(ANGLES, values["contact_spot.resistance"], "s", color="#c4451c", label="litz, LAW=HERTZ")
        paper = [
            r * p for r, p in zip(values["contact_spot.resistance"], values["contact_spot.paper.angle"], strict=True)
        ]
        angle.plot(ANGLES, paper, "o--", color="#0b62a4", label="litz, LAW=PAPER")
        angle.annotate("", (90, paper[0]), (90, values["contact_spot.resistance"][0]), arrowprops={"arrowstyle": "<->"})
        angle.annotate("26 %", (80, 0.63))
        angle.set(
            xlabel="crossing angle [degrees]", ylabel=r"$R_c\,(FR/E^*)^{1/3}/\rho$", ylim=(0.2, 0.8), xticks=ANGLES
        )
        angle.legend(loc="lower right")
        colors = {"hertz": "#c4451c", "paper": "#0b62a4", "plastic": "#2a7f3f", "film": "#777777"}
        styles = {"hertz": "s", "paper": "o", "plastic": "^", "film": "d"}
        notes = {"hertz": ": slope -1/3", "paper": ": slope -1/3, 26 % more", "plastic": ": slope -1/2", "film": ""}
        modulus = hertz.effective_modulus((COPPER.young,) * 2, (COPPER.poisson,) * 2)
        elastic = (
            COPPER.resistivity / 2 * np.array([(4 * modulus / (3 * f * COPPER.radius)) ** (1 / 3) for f in FORCES])
        )
        plastic = COPPER.resistivity / 2 * np.sqrt(np.pi * HARDNESS / FORCES)
        film = elastic + FILM / np.pi * (2 * elastic / COPPER.resistivity) ** 2
        for line in (elastic, 2 ** (1 / 3) * elastic, plastic, film):
            force.loglog(FORCES, line.astype(float) * 1e3, **figures.REFERENCE)
        for law, found in values["figure"].items():
            force.loglog(
                FORCES[::3], found[::3] * 1e3, styles[law], color=colors[law], label=f"LAW={law.upper()}{notes[law]}"
            )
        force.set(xlabel="contact force [N]", ylabel="contact resistance [mohm]", ylim=(0.03, 5e3))
        force.legend(fontsize=8)


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["contact_spot"]))

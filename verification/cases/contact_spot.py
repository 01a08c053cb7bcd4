"""Spot and resistance of two crossed wires: over the crossing angle, of several metals, and over the force for each law.

Source: H. Hertz (1882) in K. L. Johnson, Contact Mechanics (1985), section 4.2; R. Holm, Electric Contacts, 4th ed.
(1967): R_c = (rho1 + rho2) K(m)/(2 pi a) of an elliptic spot, rho/(2 a) of a circle, F = pi a^2 H of a plastic one;
values with 30 digits from references/hertz.py. The law of the paper (D. P. Boso, P. Litewka, B. A. Schrefler, P.
Wriggers, Electric-mechanical beam-to-beam contact) takes the mean radius r rb/(r + rb), which is that of two spheres.
Two equal cylinders at right angles have twice that radius, r: the paper's spot is smaller by 2^(-1/3) and its
resistance larger by 2^(1/3), which is 26 %, whatever the force. At other angles the spot is an ellipse and the
paper's is a circle: at 20 degrees the resistance is 2.09 times too large. Deck: pairs of wires whose nodes are all led
and have a given potential, so that overlap and voltage of each contact are known; R_c is the voltage over the current.
"""

import math

import numpy as np

from verification import figures, led_wires
from verification.led_wires import LedPair
from verification.references import hertz
from verification.wire_decks import COPPER, Wire

ANGLES = (90, 60, 45, 30, 20)
#: Radius, E* of two wires and resistivity of 1
UNIT = Wire(radius=1.0, young=2.0, poisson=0.0, resistivity=1.0)
#: Approach under which the forces of these are measured, and force under which spots and resistances are
UNIT_APPROACH, UNIT_FORCE = 1e-4, 1e-6
#: Approaches of copper wires under 1 N at 90, 60 and 30 degrees and under 100 N at 90 degrees [m]
COPPER_APPROACHES = ((4.9625607e-7, 90), (4.6528594e-7, 60), (3.6043551e-7, 30), (1.0691513e-5, 90))
METALS = {
    "copper_and_aluminium": (COPPER, Wire(radius=1.5e-3, young=70e9, poisson=0.33, resistivity=2.8e-8)),
    "gold_and_tungsten": (
        Wire(radius=0.2e-3, young=78e9, poisson=0.44, resistivity=2.2e-8),
        Wire(radius=2e-3, young=411e9, poisson=0.28, resistivity=5.3e-8),
    ),
}
METAL_ANGLES, METAL_APPROACH = (90, 60, 45, 30, 20, 16), 5e-8
FORCES = np.geomspace(1e-4, 1e2, 25)
#: Overlap of wires under a given force [m]
OVERLAP = 1e-6
HARDNESS, FILM = 1e9, 1e-12
LAWS = {
    "hertz": "HERTZ",
    "paper": "PAPER",
    "plastic": f"PLASTIC\n {HARDNESS:.16g}",
    "film": f"FILM\n {FILM:.16g}",
}


def under(force, degrees, wire=COPPER, law="HERTZ", overlap=OVERLAP):
    """Two equal wires under a given force."""
    return LedPair(wire, wire, degrees, overlap, law, penalty=force / overlap)


def groups():
    """Pairs of wires of one deck, by what is measured with them."""
    found = {
        "unit_force": [LedPair(UNIT, UNIT, degrees, UNIT_APPROACH) for degrees in ANGLES],
        "unit": [under(UNIT_FORCE, degrees, UNIT, overlap=UNIT_APPROACH) for degrees in ANGLES],
        "unit_paper": [under(UNIT_FORCE, degrees, UNIT, "PAPER", UNIT_APPROACH) for degrees in ANGLES],
        "copper_force": [LedPair(COPPER, COPPER, degrees, approach) for approach, degrees in COPPER_APPROACHES],
        "copper": [under(force, degrees) for force, degrees in ((1.0, 90), (1.0, 60), (1.0, 30), (100.0, 90))],
        "weak_film": [under(force, 90, law=LAWS["film"]) for force in (1e-9, 1e-8)],
    }
    found |= {
        name: [LedPair(*pair, degrees, METAL_APPROACH) for degrees in METAL_ANGLES] for name, pair in METALS.items()
    }
    return found | {law: [under(force, 90, law=text) for force in FORCES] for law, text in LAWS.items()}


def ledgers(workspace):
    """Columns of the ledger for each group of pairs."""
    pairs = groups()
    every = [pair for group in pairs.values() for pair in group]
    note = "Source  Johnson, Contact Mechanics, section 4.2; Holm, Electric Contacts"
    found = led_wires.contacts(workspace.run("led_wires", led_wires.deck(every, "Spots of crossed wires", note)), every)
    ends = np.cumsum([len(group) for group in pairs.values()])[:-1]
    columns = {name: np.split(column, ends) for name, column in found.items()}
    return {group: {name: column[i] for name, column in columns.items()} for i, group in enumerate(pairs)}


def slope(forces, values):
    """Slope in the log-log picture, between the ends."""
    return float(np.log(values[-1] / values[0]) / np.log(forces[-1] / forces[0]))


def measure(workspace):
    found = ledgers(workspace)
    unit, copper = found["unit"], found["copper"]
    # axes grow with the cube root of the force, the resistance falls with it
    root = UNIT_FORCE ** (1 / 3)
    values = {
        "contact_spot.force": found["unit_force"]["force"].tolist(),
        "contact_spot.semi_major": (unit["semi_major"] / root).tolist(),
        "contact_spot.semi_minor": (unit["semi_minor"] / root).tolist(),
        "contact_spot.resistance": (unit["resistance"] * root).tolist(),
        "contact_spot.copper.force": found["copper_force"]["force"].tolist(),
        "contact_spot.copper.resistance": copper["resistance"].tolist(),
    }
    for name in METALS:
        for column in ("force", "semi_major", "semi_minor", "resistance"):
            values[f"contact_spot.{name}.{column}"] = found[name][column].tolist()
    values["contact_spot.paper.radius"] = found["paper"]["semi_major"][[0, 12, 24]].tolist()
    values["contact_spot.paper.resistance"] = found["paper"]["resistance"][[0, 12, 24]].tolist()
    values["contact_spot.paper.angle"] = (found["unit_paper"]["resistance"] * root).tolist()
    values["contact_spot.plastic"] = found["plastic"]["resistance"][[0, 12, 24]].tolist()
    values["contact_spot.film"] = found["film"]["resistance"][[0, 12, 24]].tolist()
    values["contact_spot.slopes"] = [slope(FORCES, found[law]["resistance"]) for law in ("hertz", "paper", "plastic")]
    values["contact_spot.film_slope"] = slope((1e-9, 1e-8), found["weak_film"]["resistance"])
    return values | {"figure": {law: found[law]["resistance"] for law in LAWS}}


def draw(values, path):
    with figures.panels(path, height=3.2) as (angle, force):
        degrees = np.linspace(12, 90, 40)
        exact = [hertz.crossed_wires(1, math.radians(d), radius=(1, 1), modulus=1, resistivity=(1, 1)) for d in degrees]
        angle.plot(degrees, [s.resistance for s in exact], label="Hertz and Holm, 30 digits", **figures.REFERENCE)
        angle.plot(ANGLES, values["contact_spot.resistance"], "s", color="#c4451c", label="litz, LAW=HERTZ")
        paper = values["contact_spot.paper.angle"]
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

"""A stated limit of the model: without `MUTUAL RESISTANCE=YES` contacts do not know of each other.

Source: J. A. Greenwood, Br. J. Appl. Phys. 17 (1966) 1621-1632: two spots of radius a at a distance s between the
same two bodies have rho/(4 a) + rho/(2 pi s) together; the second term, by which each raises the potential of the
other, is what litz leaves out: 6 % at s = 10 a, 1 % at s = 64 a. Where two wires cross a third one only that one is
shared, and half of the term is left out. Wires of radius r cannot cross it closer than 2 r. Deck: two thin wires 0.25
mm apart across a thick one, all nodes led and at given potentials: the force is the penalty times the overlap, and the
hardness of the plastic spots sets a (R. Holm, F = pi a^2 H). The resistance is the voltage over both currents.
"""

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.references import greenwood
from verification.wire_decks import Wire, interaction, section

DISTANCE, APPROACH, PENALTY, VOLTAGE = 0.25e-3, 1e-6, 1e5, 1e-3
RATIOS = (10, 20, 50, 100)
THICK = Wire(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
THIN = Wire(radius=0.1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
RHO = THICK.resistivity
THICK_NODES = np.linspace(-0.01, 0.01, 5)


def deck(spot_radius, distance=DISTANCE, angle=0.0, options="VOLTAGE=LINEAR", stations=4, thick=THICK_NODES):
    """A thick wire along x and two thin ones across it at a distance along it and an angle round it, which come down by a
    micrometre; `stations` are the nodes of a thin one, `thick` has those of the thick one."""
    hardness = PENALTY * APPROACH / (np.pi * spot_radius**2)
    blocks, moves = [chain(np.outer(thick, [1, 0, 0]), "B33", "THICK", 1)], []
    for name, first, x, turn in (("THIN1", 101, -distance / 2, 0.0), ("THIN2", 201, distance / 2, angle)):
        out, across = np.array([0, np.sin(turn), np.cos(turn)]), np.array([0, np.cos(turn), -np.sin(turn)])
        middle = np.array([x, 0, 0]) + (THICK.radius + THIN.radius) * out
        blocks.append(chain(middle + np.outer(np.linspace(-5e-3, 5e-3, stations), across), "B33", name, first))
        moves += [f" {name}, {i + 1}, {i + 1}, {-APPROACH * out[i]:.16g}" for i in (1, 2)] + [f" {name}, 9, 9, 0."]
    return join(
        heading(
            "Two thin wires cross a thick one next to each other",
            "Model   copper; radii 0.1 and 1 mm; all nodes led; plastic spots, whose radius is set by the hardness",
            "Source  Greenwood (1966)",
        ),
        *blocks,
        section(THICK, "COPPER", "THICK", conducting=True),
        section(THIN, "THIN_COPPER", "THIN1", "THIN2", conducting=True),
        interaction(
            ("THICK", "THIN1"),
            ("THICK", "THIN2"),
            penalty=PENALTY,
            spot=f"PLASTIC, {options}\n {hardness:.16g}",
        ),
        "*BOUNDARY\n THICK, ENCASTRE",
        *(f" THIN{k}, 1\n THIN{k}, 4, 6" for k in (1, 2)),
        step(f"*BOUNDARY\n THICK, 9, 9, {VOLTAGE}", *moves),
    )


def together(ratio):
    """Resistance of both contacts in parallel after Greenwood, the thick wire shared and the thin ones not, and the
    same of one body on each side; in parts of rho/(4 a)."""
    places, radii = [[0.0, 0.0], [ratio, 0.0]], [1.0, 1.0]
    shared = greenwood.one_side(places, radii, [0.5, 0.5], 1.0)[0]
    alone = greenwood.one_side([[0.0, 0.0]], [1.0], [0.5], 1.0)[0]
    return 4 * (shared + alone), 4 * greenwood.together(places, radii, 1.0)


def measure(workspace):
    found = []
    for ratio in RATIOS:
        radius = DISTANCE / ratio
        currents = workspace.run(f"ratio_{ratio}", deck(radius)).contacts_at(-1)["current"]
        found.append(float(VOLTAGE / np.abs(currents).sum() / (RHO / (4 * radius))))
    return {
        "two_spots.independent": found,
        "two_spots.left_out": [
            float(together(ratio)[1] / value - 1) for ratio, value in zip(RATIOS, found, strict=True)
        ],
    }


def draw(values, path):
    ratios = np.geomspace(5, 300, 40)
    one, two = np.array([together(ratio) for ratio in ratios]).T
    with figures.panels(path, columns=1, height=3.0) as axes:
        axes.semilogx(ratios, two, "--", label="Greenwood, two bodies that touch twice", **figures.REFERENCE)
        axes.semilogx(ratios, one, label="Greenwood, two wires across a third", **figures.REFERENCE)
        axes.semilogx(RATIOS, values["two_spots.independent"], "s", color="#c4451c", label="litz")
        axes.set(xlabel="distance of the spots / radius of a spot", ylabel=r"resistance of both $/\ (\rho/4a)$")
        axes.set_xticks([5, 10, 20, 50, 100, 200], ["5", "10", "20", "50", "100", "200"])
        axes.minorticks_off()
        axes.set(ylim=(0.99, 1.19))
        axes.legend(loc="upper right", fontsize=8)


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["two_spots"]))

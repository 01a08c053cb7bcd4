"""Friction: a cantilever dragged across another one, to and fro, and rigid wires rubbed in every direction.

Source: Coulomb friction with an elastic stick, whose loop under a constant normal force N has the area
4 mu N (U - mu N/k) (J. C. Simo, T. A. Laursen, Comput. Struct. 42 (1992) 97-116; any text on friction); tangential
stiffness of a Hertz contact, R. D. Mindlin, J. Appl. Mech. 16 (1949) 259-268; the dragged cantilever is derived in
references/dragged_cantilever.py. The frictional beam contact of the source paper's references, G. Zavarise, P. Wriggers,
Int. J. Numer. Methods Eng. 49 (2000) 977-1006, and P. Litewka, P. Wriggers, Comput. Mech. 28 (2002) 26-39, has a law for
each wire: it is not the same in all directions where the wires are oblique, this one is.
"""

import math

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.references import hertz
from verification.references.dragged_cantilever import DraggedCantilever
from verification.wire_decks import COPPER, INPUTS, section

MU, STIFFNESS, PENALTY, OVERLAP, AMPLITUDE = 0.3, 1e5, 1e7, 2e-7, 1e-4
FORCE = PENALTY * OVERLAP
DIRECTIONS = np.radians([0, 30, 75, 120, 180, 250, 310])
TIMES = (1.25, 1.5, 2.0, 2.25, 2.5, 3.0, 3.125, 3.25, 4.0)


def reference():
    """The dragged cantilever of the deck."""
    young, nu, radius = COPPER.young, COPPER.poisson, 0.5e-3
    modulus = hertz.effective_modulus((young, young), (nu, nu))
    unit = hertz.crossed_wires(1, math.pi / 2, radius=(radius, radius), modulus=modulus, resistivity=(1, 1)).approach
    return DraggedCantilever(
        a=0.0825, b=0.0825, ei=young * math.pi * radius**4 / 4, radius=radius, hertz=unit,
        gj=young / (2 * (1 + nu)) * math.pi * radius**4 / 2,
        stick_ratio=2 * (1 - nu) / (2 - nu), mu=MU, w=2e-4,
    )  # fmt: skip


def rubbed(degrees, *moves):
    """A rigid wire, pressed on another one with a constant force, is moved by each of `moves` (x, y)."""
    a = math.radians(degrees)
    along = 0.02 * np.array([math.cos(a), math.sin(a), 0.0])
    up = np.array([0.0, 0.0, 2e-3])
    cards = [f"*BOUNDARY\n UPPER, 1, 1, {x:.17g}\n UPPER, 2, 2, {y:.17g}\n UPPER, 3, 3, {-OVERLAP}" for x, y in moves]
    return join(
        heading("Rigid wires rubbed", "Model   all nodes are led", "Source  see verification/cases/friction.py"),
        chain(np.linspace([-0.02, 0, 0], [0.02, 0, 0], 5), "B33", "LOWER"),
        chain(np.linspace(up - along, up + along, 5), "B33", "UPPER", 101),
        section(COPPER, "COPPER", "LOWER", "UPPER"),
        f"*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n {PENALTY}",
        f"*FRICTION, STICK STIFFNESS={STIFFNESS}\n {MU}",
        "*CONTACT PAIR, INTERACTION=TOUCH\n LOWER, UPPER",
        "*BOUNDARY\n LOWER, ENCASTRE\n UPPER, 1, 6",
        *(step(card, "*NODE PRINT, NSET=UPPER, TOTALS=ONLY\n RF\n*ENERGY PRINT", increments=20) for card in cards),
    )


def loop(workspace):
    """Heat of one cycle of rigid wires."""
    moves = [(0.0, 0.0), *((x, 0.0) for x in (AMPLITUDE, -AMPLITUDE, AMPLITUDE))]
    history = workspace.run("loop", rubbed(90, *moves)).history
    heat = history["ALLFD"]
    return float(heat[-1] - heat[history["step"] == 2][-1])


def directions(workspace):
    """Force of slip against the push over mu N, in each direction, for wires at 50 degrees."""
    values = []
    for i, phi in enumerate(DIRECTIONS):
        push = np.array([math.cos(phi), math.sin(phi)])
        history = workspace.run(f"direction_{i}", rubbed(50, (0.0, 0.0), AMPLITUDE * push)).history
        force = np.array([history[f"RF{axis} sum UPPER"][-1] for axis in (1, 2)])
        values.append(float(force @ push) / (MU * FORCE))
    return values


def measure(workspace):
    results = workspace.run("dragged", (INPUTS / "13_stick_slip.inp").read_text(encoding="utf-8"))
    history = results.history
    forces = np.interp(TIMES, history["time"], history["RF1 node 201"])
    heat = history["ALLFD"]
    return {
        "friction.dragged": forces.tolist(),
        "friction.dragged.heat": float(heat[-1] - heat[history["step"] == 2][-1]),
        "friction.loop": loop(workspace),
        "friction.directions": directions(workspace),
        "figure": {
            "way": history["U1 node 201"].tolist(),
            "force": history["RF1 node 201"].tolist(),
            "resistance": results.contacts["resistance"].tolist(),
            "contact_time": results.contacts["time"].tolist(),
        },
    }


def draw(values, path):
    measured = values["figure"]
    with figures.panels(path) as (loop_axes, resistance):
        way = (
            np.concatenate([np.linspace(0, 1, 41), np.linspace(1, -1, 81)[1:], np.linspace(-1, 1, 81)[1:]]) * AMPLITUDE
        )
        exact = [force for _, force in reference().path(way)]
        loop_axes.plot(1e6 * way, 1e3 * np.array(exact), "k-", lw=1, label="two cantilevers, Hertz, Coulomb")
        loop_axes.plot(1e6 * np.array(measured["way"]), 1e3 * np.array(measured["force"]), "o", mfc="none", ms=4,
                       color=figures.STYLES["B33"]["color"], label="litz")  # fmt: skip
        loop_axes.set(xlabel="way of the clamp [µm]", ylabel="force along the way [mN]")
        loop_axes.set_ylim(-1.15, 1.5)
        loop_axes.legend(loc="upper left")
        resistance.plot(measured["contact_time"], 1e3 * np.array(measured["resistance"]), "o-", ms=3,
                        color=figures.STYLES["B33"]["color"])  # fmt: skip
        resistance.set(xlabel="time [s]", ylabel="resistance of the spot [mohm]")


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["friction"]))

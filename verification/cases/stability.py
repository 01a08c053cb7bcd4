"""Critical loads of rods: Euler, Prandtl, Greenhill, Michell.

Sources: Euler's column with E A and G A finite, E. Reissner's strains linearised about the compressed straight rod:
P (1 - P/EA + P/GA) = E I (pi/L_k)^2. Lateral buckling of a narrow cantilever under a load at the centroid of its tip:
L. Prandtl, Kipperscheinungen (1899), A. G. M. Michell, Phil. Mag. 48 (1899) 298-309: P = 4.0126 sqrt(E I GJ)/L^2.
Twisted rod: A. G. Greenhill, Proc. Inst. Mech. Eng. 34 (1883) 182-225, M = 2 pi E I/L with hinged ends and an axial
torque; with clamped ends tan(u) = u, u = M L/(2 E I) = 4.4934. Twisted ring: A. G. M. Michell (1889), E. E. Zajac, J.
Appl. Mech. 29 (1962) 136-142: twist 2 pi sqrt(3) E I/GJ.

Critical is where a run first reports negative pivots: levels of the load are narrowed down around the exact one. The
tangent of the hinged rod under a torque is not symmetric and has no pivots to count; its deflection by a small force
grows as in references/twisted_rod.py. The ring is a straight rod that is rolled up until its ends meet; the first end
then turns about its own axis. As the sections of a straight rod prefer no direction the ring could swing about its clamp
at no cost, were the node opposite not held in the plane. Meshes of 16, 32 and 64 elements.
"""

from dataclasses import dataclass

import numpy as np

from verification import figures
from verification.claims import read_claims
from verification.deck_text import Rigidity, chain, heading, join, step, straight
from verification.numerics import extrapolate
from verification.references import twisted_rod

MESHES = (16, 32, 64)
ELEMENTS = ("B31", "B33")
#: Bounds of the critical load, in parts of the exact one of infinitely many elements
BOUNDS = (0.97, 1.05)
#: Levels of the load in one run
LEVELS = 12
#: Torques of the hinged rod over the critical one, and the force in its middle
TORQUES, FORCE = (0.5, 0.8, 0.9), 1e-5
GJ = 0.7


@dataclass(frozen=True)
class Problem:
    """A rod of length 1 and E I = 1 along x under a load that grows."""

    rigidity: Rigidity
    #: Data lines of *BOUNDARY, and the card of the load; {tip} and {middle} are node numbers
    supports: tuple
    card: str
    #: Load of the deck over the number that the source gives
    unit: float = 1.0
    #: To how many parts of it the critical load is narrowed down
    resolution: float = 1e-6
    #: The rod is rolled up to a ring first
    rolled: bool = False


COLUMN = Rigidity(ea=1e4, ga=4e3, gj=1.0, ei2=1.0, ei3=1.0)
TWISTED = Rigidity(ea=1e6, ga=1e6, gj=GJ, ei2=1.0, ei3=1.0)
#: 1e5 times stiffer in the plane of the load
NARROW = Rigidity(ea=1e7, ga=1e7, gj=GJ, ei2=1.0, ei3=1e5)
PRESS = "*CLOAD\n {tip}, 1, -{load}"
PROBLEMS = {
    "euler.free": Problem(COLUMN, (" 1, ENCASTRE",), PRESS),
    "euler.hinged": Problem(COLUMN, (" 1, 1, 4", " {tip}, 2, 3"), PRESS),
    "euler.clamped": Problem(COLUMN, (" 1, ENCASTRE", " {tip}, 2, 6"), PRESS),
    # the round-off of the stiff direction leaves the critical load uncertain by some 1e-5
    "prandtl": Problem(NARROW, (" 1, ENCASTRE",), "*CLOAD\n {tip}, 2, {load}", GJ**0.5, resolution=1e-4),
    "greenhill.clamped": Problem(
        TWISTED, (" 1, ENCASTRE", " {tip}, 2, 3", " {tip}, 5, 6"), "*BOUNDARY\n {tip}, 4, 4, {load}", 1 / GJ
    ),
    "ring": Problem(
        TWISTED,
        (" 1, ENCASTRE", " {middle}, 3", " {tip}, 3, 5"),
        "*BOUNDARY\n 1, 4, 4, {load}",
        2 * np.pi / GJ,
        resolution=1e-5,
        rolled=True,
    ),
}


def roll_up(first):
    """Steps that make a ring of a straight rod, and turn its first end to just below the first level."""
    close = step(f"*BOUNDARY\n {{tip}}, 6, 6, {2 * np.pi:.16g}", increments=20, direct=False)
    turn = f"*BOUNDARY\n {{tip}}, 1, 1, -1.\n {{tip}}, 2, 2, 0.\n 1, 4, 4, {0.9 * first:.16g}"
    return [close, step(turn, increments=25, direct=False)]


def deck(name, element, n, levels):
    """All levels of the load, each a step: its last increment reports the pivots of the state at its end."""
    problem = PROBLEMS[name]
    loads = problem.unit * np.asarray(levels)
    steps = roll_up(loads[0]) if problem.rolled else []
    steps += [step(problem.card.replace("{load}", f"{load:.16g}"), direct=False) for load in loads]
    blocks = [
        heading(
            f"Critical load: {name}", f"Model   length 1, E I = 1; {n} {element}", "Source  see cases/stability.py"
        ),
        chain(straight(1.0, n), element, "ROD"),
        problem.rigidity.block("ROD", first_axis=(0.0, 1.0, 0.0)),
        "\n".join(["*BOUNDARY", *problem.supports]),
        *steps,
    ]
    return join(*blocks).replace("{tip}", str(n + 1)).replace("{middle}", str(n // 2 + 1))


def critical(workspace, name, element, n, exact):
    """The level at which negative pivots are first reported; not a number when that is not within the bounds."""
    low, high = BOUNDS[0] * exact, BOUNDS[1] * exact
    while high - low > PROBLEMS[name].resolution * exact:
        levels = np.linspace(low, high, LEVELS)
        status = workspace.run(f"{name}_{element}_{n}", deck(name, element, n, levels)).status
        last = [np.flatnonzero(status["step"] == number)[-1] for number in np.unique(status["step"])[-LEVELS:]]
        unstable = np.flatnonzero(status["negative_pivots"][last] > 0)
        if len(unstable) == 0 or unstable[0] == 0:
            return np.nan
        low, high = levels[unstable[0] - 1 : unstable[0] + 1]
    return (low + high) / 2


def hinged(workspace, element, n):
    """Deflection of the middle of a hinged rod by a small force, over that force, at each torque."""
    rigidity = Rigidity(ea=1e8, ga=1e8, gj=GJ, ei2=1.0, ei3=1.0)
    text = join(
        heading(
            "Small force on a twisted rod", f"Model   length 1, E I = 1; {n} {element}", "Source  Greenhill (1883)"
        ),
        chain(straight(1.0, n), element, "ROD"),
        rigidity.block("ROD"),
        f"*BOUNDARY\n 1, 1, 4\n {n + 1}, 2, 3",
        step(f"*CLOAD\n {n // 2 + 1}, 2, {FORCE}"),
        *(step(f"*CLOAD\n {n + 1}, 4, {2 * np.pi * torque:.16g}", increments=4) for torque in TORQUES),
    )
    results = workspace.run(f"hinged_{element}_{n}", text)
    last = [np.flatnonzero(results.steps == number + 2)[-1] for number in range(len(TORQUES))]
    return np.array([results.field("displacement", int(i))[n // 2, 1] for i in last]) / FORCE


def measure(workspace):
    values, loads = {}, {}
    exact = {claim.id: claim.reference for claim in read_claims() if claim.script == "stability"}
    for element in ELEMENTS:
        for name in PROBLEMS:
            claim = f"stability.{element}.{name}"
            found = [float(critical(workspace, name, element, n, exact[claim])) for n in MESHES]
            loads[f"{element}.{name}"] = found
            values[claim] = float(extrapolate(found[-2], found[-1], order=2))
        coarse, fine = (hinged(workspace, element, n) for n in MESHES[-2:])
        values[f"stability.{element}.greenhill.hinged"] = extrapolate(coarse, fine, order=2).tolist()
    return values | {"figure": loads}


def draw(values, path):
    exact = {claim.id: claim.reference for claim in read_claims()}
    with figures.panels(path, columns=3, height=3.4) as axes:
        for panel, element in zip(axes, ELEMENTS, strict=False):
            for name in PROBLEMS:
                limit = exact[f"stability.{element}.{name}"]
                error = [abs(load / limit - 1.0) for load in values["figure"][f"{element}.{name}"]]
                panel.loglog(MESHES, error, "o-", label=name.replace(".", ", "))
            figures.order_line(panel, MESHES, 2, 0.1)
            panel.set(xlabel="elements", ylabel="critical load / exact - 1", title=element)
        axes[1].legend(fontsize=7)
        torques = np.linspace(0.02, 0.95, 60)
        force = [twisted_rod.deflection(2 * np.pi * torque).real for torque in torques]
        axes[2].plot(torques, force, label="closed form", **figures.REFERENCE)
        for element in ELEMENTS:
            found = values[f"stability.{element}.greenhill.hinged"]
            axes[2].plot(TORQUES, found, linestyle="none", fillstyle="none", label=element, **figures.STYLES[element])
        axes[2].set(xlabel=r"$ML/(2\pi EI)$", ylabel="deflection by a unit force", title="hinged rod")
        axes[2].legend(fontsize=7)


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["stability"]))

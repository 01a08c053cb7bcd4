"""A rod with bending stiffness hangs over a rigid drum, and is drawn over it: tensions, arc and forces at the lift-offs.

Source: H. Singh, J. Elast. 151 (2022) 321-346, with the friction on the surface of the rod in references/capstan.py.
"""

import math

import numpy as np
from scipy.optimize import brentq

from verification import figures
from verification.references.helical_rods import Rod
from verification.surface_decks import rod_over_drum

WIRE = Rod(0.5e-3, 200e9, 0.3)
#: Radius of the centre line on the drum [m]
RADIUS = 0.05
UNIT = WIRE.young * math.pi * WIRE.radius**4 / 4 / RADIUS**2
THICKNESS = WIRE.radius / RADIUS
#: Slack tension over B/R^2, friction, and how far an end is drawn [m]
CASES = {"light": (5, 0.1, 0.2), "rough": (5, 0.3, 0.2015), "tight": (20, 0.3, 0.2015)}
#: Elements that are counted to the force at a lift-off
SPANS = 10


def measure(workspace):
    values, figure = {}, {}
    hanging = workspace.run("hanging", rod_over_drum(WIRE, RADIUS, 5 * UNIT, 200))
    values["capstan.hanging"] = _ends(hanging)
    for name, (tension, friction, pull) in CASES.items():
        deck = rod_over_drum(WIRE, RADIUS, tension * UNIT, 200, friction=friction, pull=pull)
        results = workspace.run(name, deck)
        last = results.field("reaction_force")[200]
        values[f"capstan.{name}.tension"] = float(-last[2] / (tension * UNIT))
        values[f"capstan.{name}.ends"] = _ends(results)
        angle, force = _loads(results)
        figure[name] = {"angle": angle.tolist(), "force": force.tolist()}
    values["figure"] = figure
    return values


def _loads(results):
    """Angle from the top, and force over B/R^2, of each element on the drum."""
    now = results.surface_contacts_at(-1)
    angle = np.arctan2(now["point_x"], now["point_z"])
    order = np.argsort(angle)
    return angle[order], now["force"][order] / UNIT


def _ends(results):
    """Contact arc [degrees], and the forces at the slack and at the pulling end over B/R^2."""
    angle, force = _loads(results)
    slack, first = _end(-angle[::-1], force[::-1])
    pulling, last = _end(angle, force)
    return [math.degrees(slack + pulling), first, last]


def _end(angle, force):
    """Angle and size of the point force at the end of the largest angle.

    Between the ends the force per angle is an exponential, here of the elements in the inner half. The rest at the end, force
    and moment, is that of a point force.
    """
    spacing = float(np.median(np.diff(angle)))
    inner = slice(len(angle) // 4, 3 * len(angle) // 4)
    growth, level = np.polyfit(angle[inner], np.log(force[inner] / spacing), 1)
    start = float(angle[-SPANS - 1] + angle[-SPANS]) / 2
    total, moment = force[-SPANS:].sum(), (force * (angle - start))[-SPANS:].sum()

    def line(end):
        """Force, and moment about the first of the spans, of the exponential up to an angle."""
        place = np.linspace(start, end, 2001)
        load = np.exp(level + growth * place)
        return np.trapezoid(load, place), np.trapezoid(load * (place - start), place)

    def misses(end):
        on_line, about = line(end)
        return (total - on_line) * (end - start) + about - moment

    end = brentq(misses, start + spacing, angle[-1] + 2 * spacing)
    return end, float(total - line(end)[0])


def draw(values, path):
    with figures.panels(path, columns=1) as axes:
        for (name, loads), colour in zip(values["figure"].items(), ("#0b62a4", "#c4451c", "#5b8e3e"), strict=True):
            axes.plot(np.degrees(loads["angle"]), loads["force"], ".-", markersize=3, color=colour, label=name)
        axes.set(xlabel="angle from the top [degrees]", ylabel="force of an element [B/R^2]", yscale="log")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["capstan"]))

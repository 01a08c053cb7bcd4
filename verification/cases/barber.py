"""Barber's identity: the conductance of an elastic contact is its stiffness, up to a constant of the materials.

Source: J. R. Barber, Bounds on the electrical resistance between contacting elastic rough bodies, Proc. R. Soc. A 459
(2003) 53-66: 1/R_c = 2/(E* (rho1 + rho2)) dF/d(approach), for spots of any number and shape. The stiffness is taken
from the tangent of the contact element, K_mm, by moving one wire along the normal; the conductance from its K_ee. In
decks it is taken from each line of the contact ledger, with F proportional to approach^(3/2).
"""

import math

import numpy as np

from litz import kernels
from verification import figures
from verification.references import hertz
from verification.wire_decks import INPUTS

ANGLES = (90, 60, 45, 30, 20, 12)
FORCES = np.geomspace(1e-4, 1e2, 7)
#: Radii, Young's moduli, Poisson's ratios, resistivities of both wires
PAIRS = {
    "copper and copper": ((1e-3, 1e-3), (120e9, 120e9), (0.34, 0.34), (1.7e-8, 1.7e-8)),
    "copper and aluminium": ((1e-3, 1.5e-3), (120e9, 70e9), (0.34, 0.33), (1.7e-8, 2.8e-8)),
    "gold and tungsten": ((0.2e-3, 2e-3), (78e9, 411e9), (0.44, 0.28), (2.2e-8, 5.3e-8)),
}
#: Decks with the pair of wires that touch in them
DECKS = {
    "01_crossed_wires": "copper and copper",
    "02_oblique_crossing": "copper and aluminium",
    "03_large_sliding": "copper and copper",
    "04_wire_grid": "copper and copper",
    "05_clamped_pair": "copper and copper",
}


def constant(pair):
    """E* (rho1 + rho2)/2 [N ohm/m]."""
    _, young, poisson, resistivity = PAIRS[pair]
    return float(hertz.effective_modulus(young, poisson)) * sum(resistivity) / 2


def element(pair, degrees, force):
    """Stiffness along the normal [N/m] and conductance [S] from the tangent of two elements of 0.1 m."""
    radius, young, poisson, resistivity = PAIRS[pair]
    angle = math.radians(degrees)
    modulus = hertz.effective_modulus(young, poisson)
    approach = hertz.crossed_wires(force, angle, radius=radius, modulus=modulus, resistivity=resistivity).approach
    bar, plain = np.array([1.0, 0.0, 0.0]), np.array([math.cos(angle), math.sin(angle), 0.0])
    up = np.array([0.0, 0.0, sum(radius) - approach])
    x = np.array([-0.04 * bar + up, 0.06 * bar + up, -0.07 * plain, 0.03 * plain])
    found = kernels.contact_em(
        x,
        np.array([bar, bar, plain, plain]),
        (0.1, 0.1),
        (1.0, 1.0, 0.0, 0.0),
        radius=radius,
        young=young,
        poisson=poisson,
        resistivity=resistivity,
        normal_law="hertz",
        spot_law="hertz",
    )
    move, raise_voltage = np.zeros(28), np.zeros(28)
    move[[2, 8]] = 1.0
    raise_voltage[[24, 25]] = 1.0
    return move @ found.K @ move, raise_voltage @ found.K @ raise_voltage


def measure(workspace):
    states, values = {}, {}
    for pair in PAIRS:
        found = np.array([[element(pair, degrees, force) for force in FORCES] for degrees in ANGLES])
        states[pair] = found
        error = np.abs(found[:, :, 0] / found[:, :, 1] / constant(pair) - 1)
        values[f"barber.element.{pair.replace(' ', '_')}"] = error.max(axis=1).tolist()
    if workspace.quick:
        return values
    ledgers = {}
    for deck, pair in DECKS.items():
        contacts = workspace.run(deck, (INPUTS / f"{deck}.inp").read_text()).contacts
        force, approach, resistance = (np.asarray(contacts[name]) for name in ("force", "gap", "resistance"))
        touching = force > 0
        stiffness = 1.5 * force[touching] / -approach[touching]
        ledgers[deck] = (stiffness, 1 / resistance[touching], constant(pair))
        values[f"barber.ledger.{deck}"] = float(np.abs(stiffness * resistance[touching] / constant(pair) - 1).max())
    return values | {"figure": (states, ledgers)}


def draw(values, path):
    states, ledgers = values["figure"]
    with figures.panels(path, height=3.2) as (line, error):
        ends = np.array([3e4, 1e8])
        line.loglog(ends, ends, label="Barber", **figures.REFERENCE)
        for marker, (pair, found) in zip("os^", states.items(), strict=True):
            x, y = found[:, :, 0].ravel(), (found[:, :, 1] * constant(pair)).ravel()
            line.loglog(x, y, marker, fillstyle="none", linestyle="none", label=f"element, {pair}")
            error.semilogy(
                ANGLES, values[f"barber.element.{pair.replace(' ', '_')}"], marker, linestyle="none", label=pair
            )
        x = np.concatenate([stiffness for stiffness, _, _ in ledgers.values()])
        y = np.concatenate([conductance * factor for _, conductance, factor in ledgers.values()])
        line.loglog(x, y, "k.", markersize=2, label=f"{len(x)} lines of ledgers, {len(ledgers)} decks")
        line.set(xlabel=r"$\mathrm{d}F/\mathrm{d}\delta$ [N/m]", ylabel=r"$E^*(\rho_1+\rho_2)/(2R_c)$ [N/m]")
        line.legend(fontsize=7)
        error.axhline(np.finfo(float).eps, **figures.REFERENCE)
        error.annotate("machine precision", (50, 1.2 * np.finfo(float).eps), fontsize=8)
        error.set(
            xlabel="crossing angle [degrees]", ylabel="largest relative difference", ylim=(1e-17, 1e-12), xticks=ANGLES
        )
        error.legend(fontsize=7)


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["barber"]))

"""Force, spot, resistance and current of two crossed wires that are pressed together: whole runs.

Source: deflections of clamped and simply supported beams, Roark's Formulas for Stress and Strain, 7th ed., table 8.1;
Hertz's contact, K. L. Johnson, Contact Mechanics, section 4.2; R. Holm, Electric Contacts: R_c = rho/(2 a);
Kirchhoff's laws. u = 2 F/k + delta(F) has no parameter to choose; values with ten digits. Decks:
inputs/05_clamped_pair, inputs/06_supported_pair, and inputs/09_paper_law with the law of the paper (D. P. Boso, P.
Litewka, B. A. Schrefler, P. Wriggers, Electric-mechanical beam-to-beam contact), penalty and linear voltage, contact
inside elements of h = 10 mm: cubic elements then miss h^3/(192 E I) of the deflection of each wire, linear voltages
rho h/(4 A) of each arm. The same wires under the laws of Hertz, of the paper and of a plastic spot give resistance
over force.
"""

import numpy as np

from verification import figures
from verification.references import crossed_wires, hertz
from verification.wire_decks import COPPER, INPUTS, Crossing, interaction

LENGTH, VOLTAGE = 0.1, 0.1
#: Levels of the supports of the decks [m]
DECKS = {"05_clamped_pair": ("clamped", (1e-5, 5e-5, 1e-4)), "06_supported_pair": ("supported", (1e-5, 1e-4))}
COLUMNS = ("force", "approach", "semi_major", "resistance", "current", "voltage_gap")
LEVELS = tuple(float(level) for level in np.geomspace(1e-6, 1e-3, 10))
HARDNESS = 1e9
LAWS = {"hertz": "HERTZ", "paper": "PAPER", "plastic": f"PLASTIC\n {HARDNESS:.16g}"}
PAPER_LEVELS, PAPER_PENALTY, PAPER_ELEMENT = (1e-5, 1e-4), 1e8, 0.01


#: Moment in the middle by a unit force there, over the length
MOMENTS = {"clamped": 1 / 8, "supported": 1 / 4}


def spot(force, support):
    """Of wires that bend about each other, with the curvature of the moment in the middle."""
    modulus = hertz.effective_modulus((COPPER.young,) * 2, (COPPER.poisson,) * 2)
    pair = (COPPER.radius, COPPER.radius), (COPPER.resistivity, COPPER.resistivity)
    curvature = (-force * MOMENTS[support] * LENGTH / COPPER.ei,) * 2
    return hertz.bent_wires(force, np.pi / 2, radius=pair[0], curvature=curvature, modulus=modulus, resistivity=pair[1])


def exact(support, level):
    """Force, approach, spot radius, R_c, current, voltage of the contact in closed form."""
    compliance = 2 * crossed_wires.deflection(support, LENGTH, LENGTH / 2, LENGTH / 2, ei=COPPER.ei)
    force = crossed_wires.force(level, compliance, lambda f: spot(f, support).approach if f > 0 else 0.0)
    found = spot(force, support)
    current = VOLTAGE / (COPPER.resistance(LENGTH) + found.resistance)
    return force, found.approach, found.semi_major, found.resistance, current, current * found.resistance


def exact_paper(level):
    """Force, spot radius, R_c and resistance between the electrodes of inputs/09_paper_law."""
    h = PAPER_ELEMENT
    compliance = 2 * crossed_wires.deflection("clamped", LENGTH, LENGTH / 2, LENGTH / 2, ei=COPPER.ei)
    compliance -= 2 * h**3 / (192 * COPPER.ei)
    force = crossed_wires.force(level, compliance, lambda f: f / PAPER_PENALTY)
    modulus = float(hertz.effective_modulus((COPPER.young,) * 2, (COPPER.poisson,) * 2))
    a = (3 * force * COPPER.radius / 2 / (4 * modulus)) ** (1 / 3)
    resistance = COPPER.resistivity / (2 * a)
    return force, a, resistance, COPPER.resistance(LENGTH) + resistance - 2 * COPPER.resistance(h) / 4


def ledger(results, columns):
    """Columns of the ledger at all levels; the approach is the negative gap."""
    contacts = results.contacts
    return {
        name: np.asarray(contacts[name]) if name != "approach" else -np.asarray(contacts["gap"]) for name in columns
    }


def over_force(workspace, name, law):
    """Force and resistance of ten levels."""
    nodes = np.linspace(0.0, LENGTH, 11)
    deck = Crossing(nodes, nodes, (LENGTH / 2, LENGTH / 2)).deck(
        interaction(("LOWER", "UPPER"), spot=law),
        LEVELS,
        "Model   copper, radius 1 mm, length 100 mm, clamped; Hertz's contact",
        "Source  elastic spots: R_c falls with F^(-1/3); plastic ones: F^(-1/2)",
        potentials=" PLUS, 9, 9, 1.e-3\n MINUS, 9, 9, 0.",
    )
    found = ledger(workspace.run(name, deck), ("force", "resistance"))
    return found["force"], found["resistance"]


def measure(workspace):
    values = {}
    for deck in DECKS:
        found = ledger(workspace.run(deck, (INPUTS / f"{deck}.inp").read_text()), COLUMNS)
        values |= {f"electromechanics.{deck}.{name}": column.tolist() for name, column in found.items()}
    results = workspace.run("09_paper_law", (INPUTS / "09_paper_law.inp").read_text())
    found = ledger(results, ("force", "semi_major", "resistance"))
    values |= {f"electromechanics.09_paper_law.{name}": column.tolist() for name, column in found.items()}
    between = results.history["resistance PLUS to MINUS"][1:]
    values["electromechanics.09_paper_law.total"] = [float(value) for value in between]
    curves = {name: over_force(workspace, f"over_force_{name}", law) for name, law in LAWS.items()}
    slopes = [np.diff(np.log(r)) / np.diff(np.log(f)) for f, r in curves.values()]
    values["electromechanics.slopes"] = [float(bound) for slope in slopes for bound in (slope.min(), slope.max())]
    ratio = curves["paper"][1] / curves["hertz"][1]
    values["electromechanics.paper_beside_hertz"] = [float(ratio.min()), float(ratio.max())]
    return values | {"figure": curves}


def draw(values, path):
    colors = {"hertz": "#c4451c", "paper": "#0b62a4", "plastic": "#2a7f3f"}
    with figures.panels(path, height=3.2) as (log, current):
        for name, (force, resistance) in values["figure"].items():
            log.loglog(force, resistance * 1e3, "s", color=colors[name], fillstyle="none", label=f"LAW={name.upper()}")
            power = -1 / 2 if name == "plastic" else -1 / 3
            log.loglog(force, resistance[0] * 1e3 * (force / force[0]) ** power, **figures.REFERENCE)
        force, resistance = values["figure"]["plastic"]
        log.annotate("slope -1/2", (force[1], 1.25e3 * resistance[1]), fontsize=8)
        force, resistance = values["figure"]["hertz"]
        log.annotate("slope -1/3", (force[1], 0.45e3 * resistance[1]), fontsize=8)
        log.annotate("26 %", (force[-3], 1.4e3 * resistance[-3]), fontsize=8)
        log.set(xlabel="contact force [N]", ylabel="contact resistance [mohm]")
        log.set_yticks([0.2, 0.5, 1, 2, 5], ["0.2", "0.5", "1", "2", "5"])
        log.minorticks_off()
        log.legend()
        levels = np.geomspace(2e-6, 1.5e-4, 40)
        for deck, marker in zip(DECKS, "so", strict=True):
            support, at = DECKS[deck]
            current.semilogx(levels * 1e6, [exact(support, level)[4] for level in levels], **figures.REFERENCE)
            found = values[f"electromechanics.{deck}.current"]
            current.semilogx(np.array(at) * 1e6, found, marker, color="#c4451c", label=f"litz, {support}")
        current.plot([], [], label="closed form", **figures.REFERENCE)
        current.set(xlabel="approach of the supports [µm]", ylabel="current at 0.1 V [A]")
        current.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["electromechanics"]))

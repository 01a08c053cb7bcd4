"""Where the time of one Newton iteration goes, and the memory

The strut lattice, by the table of `litz run --timing`: seconds of each phase over the iterations. The factorisation is the
numeric and, once for a pattern, the symbolic work. Memory: most of the process over the elements, and what a contact adds,
from a grid of wires (its crossings closed) and the same grid without contact.
"""

import statistics

from verification import figures
from verification.cases.crossings import Grid

from .growth import exponent
from .lattice import lattice_deck
from .process import OUTSIDE, median, run_litz

SIZES = (1_000, 10_000, 100_000)
QUICK_SIZES = (1_000, 3_000)
FACTORISATION = ("analyse", "factor")
#: Wires of each layer of the grid whose contacts are weighed
WIRES, QUICK_WIRES = 60, 20


def measure(quick, directory):
    rows = []
    for size in QUICK_SIZES if quick else SIZES:
        text, n = lattice_deck(size)
        deck = directory / f"profile_{n}.inp"
        deck.write_text(text, encoding="utf-8")
        runs = [run_litz(deck, directory / f"profile_{n}") for _ in range(3 if quick or n > 50_000 else 5)]
        iterations = sum(runs[0].iterations)
        share = [1 - sum(run.phases[name] for name in FACTORISATION) / run.newton_seconds for run in runs]
        rows.append(
            {
                "elements": n,
                "iterations": iterations,
                "seconds": median(runs, lambda run: run.run.seconds),
                "phases": {
                    name: statistics.median(run.phases[name] for run in runs) / (1 if name in OUTSIDE else iterations)
                    for name in runs[0].phases
                },
                "share_besides_factorisation": statistics.median(share),
                "memory": max(run.memory for run in runs),
            }
        )
    n = [row["elements"] for row in rows]
    growth = {key: exponent(n, [row[key] for row in rows]) for key in ("seconds", "memory")}
    return {"sizes": rows, "growth": growth, "contacts": weigh_contacts(QUICK_WIRES if quick else WIRES, directory)}


def weigh_contacts(wires, directory):
    """Memory with and without the contacts of a grid pressed by a small load on every node."""
    grid = Grid(wires, 1e4, load=1e-4, clearance=1e-9, length=0.008 * (wires + 1), elements=wires + 1)
    text = grid.deck()
    first = text.index("*SURFACE INTERACTION")
    last = text.index("*BOUNDARY", first)
    memory = {}
    for name, deck_text in (("with", text), ("without", text[:first] + text[last:])):
        deck = directory / f"grid_{name}.inp"
        deck.write_text(deck_text, encoding="utf-8")
        memory[name] = run_litz(deck, directory / f"grid_{name}").memory
    elements = 2 * wires * (wires + 1)
    contacts = wires**2
    return {
        "elements": elements,
        "contacts": contacts,
        **memory,
        "bytes": (memory["with"] - memory["without"]) / contacts,
    }


def tables(values):
    names = list(values["sizes"][0]["phases"])
    lines = [
        [name + (" (in all)" if name in OUTSIDE else ""), *(row["phases"][name] for row in values["sizes"])]
        for name in names
    ]
    lines.append(["share besides factorisation", *(row["share_besides_factorisation"] for row in values["sizes"])])
    lines.append(["memory [kB] per element", *(row["memory"] / row["elements"] / 1e3 for row in values["sizes"])])
    weighed = values["contacts"]
    return [
        ("Seconds of an iteration", ["phase", *(f"{row['elements']} elements" for row in values["sizes"])], lines),
        (
            "Memory of a contact",
            ["elements", "contacts", "with [MB]", "without [MB]", "per contact [kB]"],
            [
                [
                    weighed["elements"],
                    weighed["contacts"],
                    weighed["with"] / 1e6,
                    weighed["without"] / 1e6,
                    weighed["bytes"] / 1e3,
                ]
            ],
        ),
        ("Exponents of the growth", ["time", "memory"], [list(values["growth"].values())]),
    ]


def aims(values):
    row = values["sizes"][-1]
    return [(f"share besides the factorisation, {row['elements']} elements", row["share_besides_factorisation"], 0.25)]


def draw(values, path):
    with figures.panels(path, columns=1, height=3.6) as axes:
        labels = [str(row["elements"]) for row in values["sizes"]]
        bottom = [0.0] * len(labels)
        for name in values["sizes"][0]["phases"]:
            if name in OUTSIDE:
                continue
            whole = [sum(v for k, v in row["phases"].items() if k not in OUTSIDE) for row in values["sizes"]]
            share = [row["phases"][name] / total for row, total in zip(values["sizes"], whole, strict=True)]
            axes.bar(labels, share, bottom=bottom, label=name)
            bottom = [a + b for a, b in zip(bottom, share, strict=True)]
        axes.set(xlabel="elements", ylabel="share of an iteration")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=4)

"""Skyline, UMFPACK and block elimination take the same steps on the decks in inputs/ that do not magnify round-off.

Source: block forward substitution of a block triangular system is exact (G. H. Golub, C. F. Van Loan, Matrix
Computations, section 3.2): with currents that do not act on forces, one monolithic Newton step is a solve with the
mechanical matrix, then one with the electric matrix. The three solvers run with COUPLING=MONOLITHIC; iterations,
residuals (as far above round-off) and results are compared with those of the skyline solver.
"""

from pathlib import Path

import numpy as np

from verification import figures
from verification.deck_transform import Card, read_cards, write_cards

INPUTS = Path(__file__).parents[2] / "inputs"
SOLVERS = ("skyline", "umfpack", "block")
QUICK = ("06_supported_pair", "08_elastica")
#: The mat is too large for the skyline and for the full unsymmetric matrix; contacts along lines of wires that turn or slip
#: almost freely magnify round-off, so that the iterates differ; so do motions, currents and heat that are solved in turn
LEFT_OUT = ("11_fibre_mat", "13_stick_slip", "14_strand", "16_bent_strand", "17_knot", "18_rod_over_drum", "22_wiper",
            "25_cable_of_45_strands")  # fmt: skip
#: Round-off of a field that is zero [m, rad, V]
NOTHING = 1e-15
RESIDUALS = ("force", "moment", "current")
FIELDS = ("displacement", "rotation", "potential")


def with_solver(text, solver):
    """The deck with one solver and the monolithic step."""
    cards = [card for card in read_cards(text) if card.keyword != "SOLVER"]
    end = next(i for i, card in enumerate(cards) if card.keyword == "END STEP")
    cards.insert(end, Card("SOLVER", [f"NAME={solver.upper()}", "COUPLING=MONOLITHIC"], []))
    return write_cards(cards)


def residual_difference(first, second):
    """Largest relative difference of the residuals of all iterations that are 1e2 times what is allowed, or more.

    Smaller ones are differences of large numbers, and so are those below 1e-10 of the largest one; inf when the iterations
    that have larger ones are not the same.
    """
    rows, others = far_from_balance(first), far_from_balance(second)
    if keys(first)[rows].tolist() != keys(second)[others].tolist():
        return np.inf
    worst = 0.0
    for name in RESIDUALS:
        large = is_large(first, name)[rows]
        if np.any(large):
            worst = max(worst, float(np.abs(second[name][others][large] / first[name][rows][large] - 1.0).max()))
    return worst


def is_large(convergence, name):
    """Iterations in which round-off is nothing beside a residual."""
    residual = convergence[name]
    return (residual > 1e2 * convergence[f"{name}_allowed"]) & (residual > 1e-10 * residual.max())


def far_from_balance(convergence):
    """Iterations with a large residual."""
    return np.any([is_large(convergence, name) for name in RESIDUALS], axis=0)


def keys(convergence):
    """Step, increment, attempt and iteration of each row."""
    return np.column_stack([convergence[name] for name in ("step", "increment", "attempt", "iteration")])


def field_difference(first, second):
    """Largest difference of the fields over all increments, relative to the largest value of each."""
    worst = 0.0
    for name in FIELDS:
        a, b = first.field(name, None), second.field(name, None)
        scale = np.abs(a).max()
        if scale > NOTHING:
            worst = max(worst, float(np.abs(a - b).max() / scale))
    return worst


def measure(workspace):
    residuals = dict.fromkeys(SOLVERS[1:], 0.0)
    differences = dict.fromkeys(SOLVERS[1:], 0.0)
    figure = {}
    for path in sorted(INPUTS.glob("*.inp")):
        if path.stem in LEFT_OUT:
            continue
        if workspace.quick and path.stem not in QUICK:
            continue
        text = path.read_text(encoding="utf-8")
        runs = {name: workspace.run(f"{path.stem}_{name}", with_solver(text, name)) for name in SOLVERS}
        for solver in SOLVERS[1:]:
            residual = residual_difference(runs["skyline"].convergence, runs[solver].convergence)
            residuals[solver] = max(residuals[solver], residual)
            differences[solver] = max(differences[solver], field_difference(runs["skyline"], runs[solver]))
        figure[path.stem] = {name: runs[name].convergence["force"] for name in SOLVERS}
    values = {f"solvers.{solver}.residuals": value for solver, value in residuals.items()}
    values |= {f"solvers.{solver}.results": value for solver, value in differences.items()}
    return values | {"figure": figure}


def draw(values, path):
    history = values["figure"]["02_oblique_crossing"]
    with figures.panels(path, columns=1) as axes:
        for (name, forces), marker in zip(history.items(), "osx", strict=True):
            axes.semilogy(np.maximum(forces, 1e-18), marker=marker, linestyle="-", fillstyle="none", label=name)
        axes.set(xlabel="iteration, all increments", ylabel="largest force residual / N", title="02_oblique_crossing")
        axes.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["solvers"]))

"""The 28 x 28 matrix of the contact element, block by block, against complex steps of the residual.

Source: D. P. Boso, P. Litewka, B. A. Schrefler, P. Wriggers, Electric-mechanical beam-to-beam contact, "FE
discretisation": K = [K_mm 0; K_me1 + K_me2 + K_me3, K_ee], unknowns {ub, u, Vb, V}. The residual is written down a
second time in complex numbers (references/contact_element.py) and derived by complex steps: W. Squire, G. Trapp, SIAM
Rev. 40 (1998) 110-112. Each coupling block comes from what the paper derives in it, with the rest held: K_me1 the
voltage gap, K_me2 the conductance, K_me3 the place where the current enters. For elliptic spots the conductance
depends on the crossing angle, too; that part, K_me4, is what K_me2 is with the gap held. Forty crossings at 25 to 155
degrees: linear and Hermite axes, the laws of the paper and of Hertz, two materials, two radii, ends turned out of the
straight line.
"""

import numpy as np

from litz import kernels
from verification import figures
from verification.numerics import rotation
from verification.references import contact_element
from verification.references.contact_element import Pair, derivative, evaluate

AXES, LAWS, CROSSINGS = ("linear", "hermite"), ("paper", "hertz"), 10
BLOCKS = {
    "K_mm": np.s_[:24, :24],
    "upper_right": np.s_[:24, 24:],
    "K_me": np.s_[24:, :24],
    "K_ee": np.s_[24:, 24:],
}


def crossing(seed, axis, law):
    """Two elements of length 2 that cross off their middles, with overlaps of 1 to 10 % of the smaller radius."""
    rng = np.random.default_rng(seed)
    radius = np.array([0.1, 0.1 * rng.uniform(0.7, 1.4)])
    angle = np.radians(rng.uniform(25, 155))
    directions = np.array([[1.0, 0.0, 0.0], [np.cos(angle), np.sin(angle), 0.0]])
    place = rng.uniform(-0.6, 0.6, 2)
    x, t = np.empty((4, 3)), np.empty((4, 3))
    for node in range(4):
        beam, end = divmod(node, 2)
        x[node] = directions[beam] * (2 * end - 1 - place[beam])
        t[node] = rotation(rng.uniform(-0.1, 0.1, 3)) @ directions[beam]
    x[:2, 2] += sum(radius)
    material = {"young": np.array([3.0, 2.0]), "poisson": np.array([0.3, 0.2]), "resistivity": np.array([0.5, 0.4])}
    pair = Pair(x, t, rng.normal(size=4), np.array([2.0, 2.0]), radius, **material, axis=axis, law=law, penalty=2.0)
    overlap = rng.uniform(0.01, 0.1) * radius.min()
    gap = element(pair).gap
    x[2:, 2] += gap + overlap
    return pair


def arguments(pair):
    """Arguments of `litz.kernels.contact_em`."""
    laws = {"eps_n": pair.penalty} if pair.law == "paper" else {"normal_law": "hertz"}
    names = ("radius", "young", "poisson", "resistivity", "axis")
    return (pair.x, pair.t, pair.length, pair.v), {name: getattr(pair, name) for name in names} | {
        "spot_law": pair.law
    } | laws


def element(pair):
    positional, named = arguments(pair)
    return kernels.contact_em(*positional, **named)


def coupling(pair):
    """The coupling blocks of the paper by complex steps, each of one factor of R_e = G g_V N_V with the others held."""
    at = evaluate(pair, np.zeros(28))

    def vary(**names):
        def function(q):
            state = evaluate(pair, q)
            conductance = state.conductance if "conductance" in names else at.conductance
            gap = state.n_v @ at.v if "gap" in names else at.n_v @ at.v
            return conductance * gap * (state.n_v if "enters" in names else at.n_v)

        return derivative(function)[:, :24]

    return {"K_me1": vary(gap=True), "K_me2": vary(conductance=True), "K_me3": vary(enters=True)}


def differences(pair):
    """Largest difference of each block in parts of its largest entry, and the matrices."""
    ours, theirs = element(pair), derivative(lambda q: contact_element.residual(pair, q))
    r = contact_element.residual(pair, np.zeros(28)).real
    found = {"R_m": _distance(ours.R[:24], r[:24]), "R_e": _distance(ours.R[24:], r[24:])}
    for name, block in BLOCKS.items():
        scale = None if name != "upper_right" else 1.0
        found[name] = _distance(ours.K[block], theirs[block], scale)
    positional, named = arguments(pair)
    parts = kernels.contact_coupling(*positional, **named)
    for name, block in coupling(pair).items():
        mine = getattr(parts, name) + (parts.K_me4 if name == "K_me2" else 0.0)
        found[name] = _distance(mine, block)
    return found, ours.K, theirs


def _distance(a, b, scale=None):
    return float(np.abs(a - b).max() / (scale or np.abs(b).max()))


def measure(workspace):
    worst, figure = {}, {}
    for axis in AXES:
        for law in LAWS:
            rows = [differences(crossing(seed, axis, law)) for seed in range(CROSSINGS)]
            for name in rows[0][0]:
                worst.setdefault(f"element_matrix.{name}", []).append(max(found[name] for found, _, _ in rows))
            figure[axis, law] = rows[0][1:]
    return worst | {"figure": figure["hermite", "hertz"]}


def draw(values, path):
    ours, theirs = values["figure"]
    scale = np.ones_like(ours)
    for block in BLOCKS.values():
        scale[block] = max(np.abs(theirs[block]).max(), 1e-300)
    with figures.panels(path, height=3.4) as axes:
        shown = (np.abs(ours) / scale, np.abs(ours - theirs) / scale)
        limits = ((-4, 0, "entry / largest of its block"), (-17, -12, "difference / largest of the block"))
        for panel, matrix, (low, high, label) in zip(axes, shown, limits, strict=True):
            image = panel.imshow(
                np.log10(np.maximum(matrix, 10.0**low), where=matrix > 0, out=np.full(matrix.shape, np.nan)),
                vmin=low,
                vmax=high,
                cmap="viridis",
            )
            for edge in (11.5, 23.5, 25.5):
                panel.axhline(edge, color="w" if edge != 23.5 else "k", linewidth=0.8)
                panel.axvline(edge, color="w" if edge != 23.5 else "k", linewidth=0.8)
            panel.set_xticks([5.5, 17.5, 24.5, 26.5], [r"$\bar u$", "$u$", r"$\bar V$", "$V$"])
            panel.set_yticks([5.5, 17.5, 24.5, 26.5], [r"$\bar u$", "$u$", r"$\bar V$", "$V$"])
            panel.grid(visible=False)
            panel.text(25.5, 5.5, "0", ha="center", va="center")
            panel.set_title("the matrix" if high == 0 else "distance from complex steps", fontsize=9)
            panel.figure.colorbar(image, ax=panel, label=f"log10 of {label}", shrink=0.85)


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["element_matrix"]))

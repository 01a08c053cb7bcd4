"""Residuals of the coupled problem, iteration by iteration, and what each block of the matrix is worth.

Source: D. P. Boso, P. Litewka, B. A. Schrefler, P. Wriggers, Electric-mechanical beam-to-beam contact: monolithic
Newton method with K = [K_mm 0; K_me1 + K_me2 + K_me3, K_ee], K_mm of two terms, eps dg dg and eps g ddg. L. V.
Kantorovich (1948): with the exact matrix the residuals fall quadratically. G. H. Golub, C. F. Van Loan, Matrix
Computations, section 3.2: the matrix is block triangular, so that the wires move as if there were no current; without
a coupling block the voltages are those of the last but one displacements, and need one iteration more. Without eps g
ddg the wires themselves converge linearly. Two clamped wires cross at 60 degrees, with the law of the paper and
currents along both; one step of load presses them together with fourteen times the force and drags one along the
other. Newton's method is written down here, over litz.kernels alone, with no aids.
"""

import numpy as np

from litz import kernels
from verification import figures
from verification.deck_text import Rigidity
from verification.kernel_frame import KernelFrame
from verification.wire_decks import Wire

WIRE = Wire(radius=0.5e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
LENGTH, N, ANGLE, PENALTY = 0.05, 5, np.pi / 3, 1e6
#: Places of the crossing along both wires, inside their third elements
AT = (0.52, 0.46)
#: Forces at both ends of the third element of the upper wire before the step and after it [N]
LOADS = ((0.0, 0.0, -0.4), (2.5, -1.5, -6.0))
#: Potentials of the ends of the wires [V]
ENDS = {0: 2e-3, N: 0.5e-3, N + 1: 0.0, 2 * N + 1: 1.2e-3}
#: Allowed residuals in parts of the largest force and of the contact current
TOLERANCE, MOST = 1e-9, 20
VARIANTS = {
    "full": (),
    "without_K_me1": ("K_me1",),
    "without_K_me2": ("K_me2",),
    "without_K_me3": ("K_me3",),
    "without_K_me": ("K_me1", "K_me2", "K_me3"),
    "without_second_variation": ("second_variation",),
}


class CrossedWires:
    """Two wires, their voltages, and the contact element between their third elements."""

    def __init__(self):
        directions = np.array([[1.0, 0.0, 0.0], [np.cos(ANGLE), np.sin(ANGLE), 0.0]])
        stations = np.linspace(0.0, LENGTH, N + 1)
        points = np.concatenate([np.outer(stations - at * LENGTH, d) for at, d in zip(AT, directions, strict=True)])
        points[N + 1 :, 2] += 2 * WIRE.radius - 1e-7
        first = np.arange(N)
        elements = np.stack([np.append(first, first + N + 1), np.append(first, first + N + 1) + 1], axis=1)
        axes = np.array([np.column_stack([d, [0.0, 0.0, 1.0], np.cross(d, [0.0, 0.0, 1.0])]) for d in directions])
        triads = np.repeat(axes, N, axis=0)[:, None].repeat(2, axis=1)
        fixed = np.zeros((2 * N + 2, 6), dtype=bool)
        fixed[list(ENDS)] = True
        shear = WIRE.young / (2 * (1 + WIRE.poisson))
        rigidity = Rigidity(WIRE.young * WIRE.area, 1.0, shear * 2 * WIRE.ei / WIRE.young, WIRE.ei, WIRE.ei)
        self.frame = KernelFrame("B33", rigidity, points, elements, triads, fixed)
        self.v = np.zeros(2 * N + 2)
        self.v[list(ENDS)] = list(ENDS.values())
        self.free = np.concatenate([self.frame.free, [node not in ENDS for node in range(2 * N + 2)]])
        #: Upper wire barred, as its contact force acts along +z
        self.pair = np.concatenate([elements[N + 2], elements[2]])

    def contact(self):
        """The contact element and its coupling blocks."""
        tangents = [
            self.frame.rotations[node] @ self.frame.triads[e, 0, :, 0]
            for node, e in zip(self.pair, (N, N, 0, 0), strict=True)
        ]
        positional = self.frame.x[self.pair], tangents, (LENGTH / N, LENGTH / N), self.v[self.pair]
        named = {"radius": WIRE.radius, "young": WIRE.young, "poisson": WIRE.poisson, "resistivity": WIRE.resistivity}
        named |= {"eps_n": PENALTY, "spot_law": "paper", "axis": "hermite"}
        found = kernels.contact_em(*positional, **named)
        if not found.active:
            raise ArithmeticError("the wires are not in contact within the two elements")
        return found, kernels.contact_coupling(*positional, **named)

    def assemble(self, load, left_out):
        """Matrix without the blocks left out, and residual: displacements and spins of all nodes, then voltages."""
        n = 6 * len(self.v)
        k, r = np.zeros((n + len(self.v),) * 2), np.zeros(n + len(self.v))
        k[:n, :n], r[:n] = self.frame.assemble()
        for node in self.pair[:2]:
            r[6 * node : 6 * node + 3] -= load
        for nodes in self.frame.elements:
            wire = kernels.conductor(
                self.frame.x[nodes], self.v[nodes], LENGTH / N, area=WIRE.area, resistivity=WIRE.resistivity
            )
            k[np.ix_(n + nodes, n + nodes)] += wire.K
            r[n + nodes] += wire.R
        found, parts = self.contact()
        matrix = found.K.copy()
        for name in left_out:
            if name == "second_variation":
                # R_m = eps g dg, so that this leaves eps dg dg
                matrix[:24, :24] = np.outer(found.R[:24], found.R[:24]) / (PENALTY * found.gap**2)
            else:
                matrix[24:, :24] -= getattr(parts, name)
        rows = np.concatenate([(6 * self.pair[:, None] + np.arange(6)).ravel(), n + self.pair])
        k[np.ix_(rows, rows)] += matrix
        r[rows] += found.R
        return k[np.ix_(self.free, self.free)], r[self.free]

    def solve(self, load, left_out=()):
        """Newton's method; the largest force (or moment) and the largest current that are left at each iteration."""
        n = int(self.frame.free.sum())
        norms = []
        while len(norms) <= MOST:
            k, r = self.assemble(np.array(load), left_out)
            norms.append((np.abs(r[:n]).max(), np.abs(r[n:]).max()))
            allowed = TOLERANCE * np.array([np.abs(load).max(), abs(self.contact()[0].current)])
            if np.all(norms[-1] <= allowed):
                return np.array(norms)
            step = np.zeros(len(self.free))
            step[self.free] = np.linalg.solve(k, -r)
            self.frame.move(step[: 6 * len(self.v)].reshape(-1, 6))
            self.v = self.v + step[6 * len(self.v) :]
        raise ArithmeticError(f"no equilibrium after {MOST} iterations")


def run(left_out):
    """Residuals of the step, and force, place and current of the contact after it."""
    wires = CrossedWires()
    wires.solve(LOADS[0])
    norms = wires.solve(LOADS[1], left_out)
    found, _ = wires.contact()
    return norms, np.array([found.force, found.xi_bar, found.xi, found.current])


def order(residuals):
    """Order of convergence of three residuals."""
    first, second, third = np.log(residuals)
    return float((third - second) / (second - first))


def measure(workspace):
    norms, states = {}, {}
    for name, left_out in VARIANTS.items():
        norms[name], states[name] = run(left_out)
    full, rough = norms["full"], norms["without_second_variation"]
    extra = {name: len(found) - len(full) for name, found in norms.items()}
    different = [np.abs(state / states["full"] - 1).max() for state in states.values()]
    return {
        "coupling_blocks.force_order": order(full[-3:, 0]),
        "coupling_blocks.current_order": order(full[-3:, 1]),
        "coupling_blocks.extra_iterations": [extra[name] for name in VARIANTS if "K_me" in name],
        "coupling_blocks.rough_order": order(rough[-4:-1, 0]),
        "coupling_blocks.same_state": float(max(different)),
        "figure": norms,
    }


def draw(values, path):
    norms = values["figure"]
    styles = {
        "full": ("k", "o-", "the whole matrix"),
        "without_K_me1": ("#0b62a4", "s--", "without $K_{me1}$"),
        "without_K_me2": ("#c4451c", "^--", "without $K_{me2}$"),
        "without_K_me3": ("#2a7f3f", "v--", "without $K_{me3}$"),
        "without_K_me": ("#777777", "d:", "without all three"),
    }
    with figures.panels(path, height=3.2) as (curve, table):
        for name, (color, style, label) in styles.items():
            iteration = range(1, len(norms[name]))
            curve.semilogy(iteration, norms[name][1:, 1], style, color=color, label=label)
        curve.set(xlabel="iteration", ylabel="largest current residual [A]", ylim=(1e-13, 1e1))
        curve.legend(loc="lower left")
        table.axis("off")
        shown = ("full", "without_K_me", "without_second_variation")
        rows = max(len(norms[name]) for name in shown)
        cells = []
        for i in range(rows):
            row = [str(i)]
            for name, column in (("full", 0), ("full", 1), ("without_K_me", 1), ("without_second_variation", 0)):
                row.append(f"{norms[name][i, column]:.2e}" if i < len(norms[name]) else "")
            cells.append(row)
        heads = [
            "",
            "force [N]\nwhole",
            "current [A]\nwhole",
            "current [A]\nno $K_{me}$",
            "force [N]\nno $g\\Delta\\delta g$",
        ]
        drawn = table.table(cells, colLabels=heads, loc="center", edges="horizontal", colWidths=[0.06] + [0.235] * 4)
        drawn.auto_set_font_size(False)
        drawn.set_fontsize(7.5)
        drawn.scale(1, 1.35)
        for column in range(5):
            drawn[0, column].set_height(1.9 * drawn[1, 0].get_height())


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["coupling_blocks"]))

"""Many crossings that close at once: iterations in one load step, and the forces of all of them.

Source: deflections of clamped beams at every crossing by a force at every other, Roark's Formulas for Stress and
Strain, 7th ed., table 8.1; Hertz's contact at any angle, Johnson, Contact Mechanics, section 4.2; together one equation
for each crossing, references/crossed_wires.py. Iterations of others: a prototype outside litz (two-node beams,
derivatives by automatic differentiation), with plain Newton and with section and contact forces as independent
variables.

Where the grids are lowered at their supports, the crossings near these carry all and the middle rises; under a load on
every node of the upper layer nearly all of the crossings close. The hardest grid: thin wires clamped at both ends (length
400 radii) that a load bends by three radii, so that they stretch while 100 crossings close.
"""

import math
from dataclasses import dataclass

import numpy as np

from verification import figures
from verification.deck_text import chain, heading, join, step
from verification.references import crossed_wires, hertz
from verification.wire_decks import COPPER, Wire, interaction, section
from verification.workspace import iterations

STEEL = Wire(radius=0.25e-3, young=210e9, poisson=0.3, resistivity=1e-7)
ALUMINIUM = Wire(radius=0.3e-3, young=70e9, poisson=0.33, resistivity=2.7e-8)
THREAD = Wire(radius=0.05e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)


@dataclass(frozen=True)
class Grid:
    """Layers of `n` lower and `n` upper wires, clamped at both ends, the upper ones at `angle` to the lower ones."""

    n: int
    #: Penalty over the bending stiffness 192 E I/L^3 of a lower wire; None: Hertz
    penalty: float | None
    #: By how much the supports of the upper layer are lowered [m]
    push: float = 0.0
    #: Force on each node of the upper layer, downwards [N]
    load: float = 0.0
    lower: Wire = COPPER
    upper: Wire = COPPER
    #: Length of the wires and distance of neighbours [m]
    length: float = 0.1
    pitch: float = 0.008
    #: Angle of the two layers [degrees]
    angle: float = 90.0
    #: Clearance of the upper wires, and by up to how much each one lies higher, at random but always the same [m]
    clearance: float = 0.0
    unevenness: float = 0.0
    element: str = "B33"
    elements: int = 22

    @property
    def bending(self):
        """Stiffness of a lower wire against a force in its middle [N/m]."""
        return 192 * self.lower.ei / self.length**3

    def heights(self):
        """Clearance of each upper wire [m]."""
        return self.clearance + self.unevenness * np.random.default_rng(1).uniform(size=self.n)

    def lines(self):
        """First points and directions of the lower and of the upper wires."""
        offsets = (np.arange(self.n) - (self.n - 1) / 2) * self.pitch
        angle = math.radians(self.angle)
        layers = []
        for turn in (0.0, angle):
            t, normal = np.array([math.cos(turn), math.sin(turn)]), np.array([-math.sin(turn), math.cos(turn)])
            layers.append(([offset * normal - self.length / 2 * t for offset in offsets], t))
        return layers

    def deck(self, increments=1):
        """One step that lowers the upper layer."""
        blocks, ends = [], [[], []]
        for layer, (starts, t) in enumerate(self.lines()):
            for i, (start, clearance) in enumerate(zip(starts, self.heights(), strict=True)):
                first = 1 + 1000 * (layer * self.n + i)
                s = np.linspace(0.0, self.length, self.elements + 1)
                height = layer * (self.lower.radius + self.upper.radius + clearance) + 0 * s
                points = np.column_stack([start + s[:, None] * t, height])
                blocks.append(chain(points, self.element, ("LOWER", "UPPER")[layer], first))
                ends[layer] += [first, first + self.elements]
        penalty = None if self.penalty is None else self.penalty * self.bending
        return join(
            heading(
                f"{self.n**2} crossings that close at once",
                f"Model   {self.n} + {self.n} clamped wires; the upper layer goes down by {self.push:g} m",
                "Source  beam flexibilities and contact law, one equation for each crossing",
            ),
            *blocks,
            *(
                f"*NSET, NSET={name}_ENDS\n" + "\n".join(f" {node}" for node in nodes)
                for name, nodes in zip(("LOWER", "UPPER"), ends, strict=True)
            ),
            section(self.lower, "LOWER", "LOWER"),
            section(self.upper, "UPPER", "UPPER"),
            interaction(("LOWER", "UPPER"), penalty=penalty),
            "*BOUNDARY\n LOWER_ENDS, ENCASTRE\n UPPER_ENDS, 1, 2\n UPPER_ENDS, 4, 6",
            step(
                f"*BOUNDARY\n UPPER_ENDS, 3, 3, {-self.push:.16g}",
                f"*CLOAD\n UPPER, 3, {-self.load:.16g}" if self.load else "",
                increments=increments,
                direct=False,
            ),
        )

    def crossings(self):
        """Distances of the crossings (lower wire, upper wire) from the first ends of the two wires."""
        (lower, t), (upper, u) = self.lines()
        along = np.array([[np.linalg.solve(np.column_stack([t, -u]), q - p) for q in upper] for p in lower])
        return along[..., 0], along[..., 1]

    def unseen(self, properties, places):
        """Deflection of a wire at `places` by a unit force there that its mesh misses, between the nodes."""
        h = self.length / self.elements
        xi = 2 * np.modf(np.asarray(places) / h + 1e-9)[0] - 1
        return h**3 * np.maximum(1 - xi**2, 0.0) ** 3 / (192 * properties.ei)

    def exact(self):
        """Contact forces (lower wire, upper wire) for small deflections, as meshes of cubic elements see them."""
        on_lower, on_upper = self.crossings()
        n = self.n
        flexibility = np.zeros((n, n, n, n))

        def wire(properties, places, load_places):
            return [
                [crossed_wires.deflection("clamped", self.length, a, b, ei=properties.ei) for b in load_places]
                for a in places
            ]

        nodes = np.linspace(0.0, self.length, self.elements + 1)
        clearance = np.tile(self.heights() - self.push, (n, 1))
        for i in range(n):
            for properties, places, block in (
                (self.lower, on_lower[i], np.s_[i, :, i, :]),
                (self.upper, on_upper[:, i], np.s_[:, i, :, i]),
            ):
                flexibility[block] += wire(properties, places, places) - np.diag(self.unseen(properties, places))
            if self.load:
                clearance[:, i] -= self.load * np.sum(wire(self.upper, on_upper[:, i], nodes), 1)
        if self.penalty is not None:
            k = self.penalty * self.bending
            law = (lambda o: k * o), (lambda o: k + 0 * o)
        else:
            pair = (self.lower, self.upper)
            modulus = hertz.effective_modulus([w.young for w in pair], [w.poisson for w in pair])
            unit = hertz.crossed_wires(
                1, math.radians(self.angle), radius=[w.radius for w in pair], modulus=modulus, resistivity=(1, 1)
            ).approach
            law = (lambda o: (o / unit) ** 1.5), (lambda o: 1.5 * np.sqrt(o / unit) / unit)
        return crossed_wires.grid_forces(clearance.ravel(), flexibility.reshape(n * n, n * n), *law).reshape(n, n)


#: Penalty over bending stiffness, push [mm]: iterations of the prototype with plain Newton (None: it did not converge)
#: and with section and contact forces as independent variables; its grids had as many wires, of 22 elements each
PROTOTYPE = {
    4: {
        (1e2, 0.5): (15, 6),
        (1e4, 0.05): (22, 6),
        (1e4, 0.5): (22, 6),
        (1e6, 0.05): (25, 7),
        (1e6, 0.5): (None, 6),
        (None, 0.05): (8, 6),
        (None, 0.5): (11, 7),
    },
    10: {
        (1e2, 0.05): (None, 9),
        (1e2, 0.5): (None, 8),
        (1e4, 0.05): (None, 10),
        (1e4, 0.5): (None, 9),
        (None, 0.05): (15, 8),
        (None, 0.5): (None, 8),
    },
}
LAWS = {"linear": 1e4, "hertz": None}


def new(law):
    """Grids on which no constant of the iteration was chosen."""
    return {
        "64, steel": Grid(8, law, 5e-5, lower=STEEL, upper=STEEL, length=0.05, pitch=0.005),
        "64, steel, tenfold": Grid(8, law, 5e-4, lower=STEEL, upper=STEEL, length=0.05, pitch=0.005),
        "36, two metals and radii": Grid(6, law, 1e-4, upper=ALUMINIUM),
        "36, at 60 degrees": Grid(6, law, 5e-5, angle=60),
        "25, at 40 degrees, two metals": Grid(5, law, 2e-4, lower=STEEL, upper=ALUMINIUM, pitch=0.006, angle=40),
        "100, uneven": Grid(10, law, 2e-4, unevenness=3e-4),
        "36, thread": Grid(6, law, 1e-4, lower=THREAD, upper=THREAD, length=0.08, pitch=0.01),
        # twice the penalty, for an overlap of less than 5 % of the radius
        "36, thread, tenfold": Grid(6, law and 2 * law, 1e-3, lower=THREAD, upper=THREAD, length=0.08, pitch=0.01),
        "100, loaded": Grid(10, law, load=0.2, clearance=1e-6),
        "100, loaded, tenfold": Grid(10, law, load=2.0, clearance=1e-6),
        "64, oblique, loaded": Grid(8, law, load=0.2, clearance=1e-6, pitch=0.005, angle=50),
        "100, B31": Grid(10, law, 5e-4, element="B31"),
        "400": Grid(20, law, 2e-4, pitch=0.004, elements=42),
    }


def contact_forces(grid, results):
    """Forces at the last increment (lower wire, upper wire)."""
    contacts = results.contacts_at(-1)
    forces = np.zeros((grid.n, grid.n))
    for bar, element, force in zip(contacts["element_1"], contacts["element_2"], contacts["force"], strict=True):
        forces[bar // 1000, element // 1000 - grid.n] += force
    return forces


def small(law):
    """Grids whose deflections are small, against the radii as well, so that the wires do not stretch."""
    return [
        Grid(4, law, 1e-5, elements=50),
        Grid(10, law, 1e-5, elements=50),
        Grid(10, law, load=0.02, clearance=1e-6, elements=50),
        Grid(8, law, 2e-6, lower=STEEL, upper=STEEL, length=0.05, pitch=0.005),
        Grid(6, law, 5e-6, upper=ALUMINIUM),
        Grid(6, law, 1e-5, angle=60),
        Grid(5, law, 4e-6, lower=STEEL, upper=ALUMINIUM, pitch=0.006, angle=40),
        Grid(10, law, 1e-5, unevenness=1.5e-5),
        Grid(6, law, 5e-7, lower=THREAD, upper=THREAD, length=0.08, pitch=0.01),
        Grid(8, law, load=0.02, clearance=1e-6, pitch=0.005, angle=50),
        Grid(20, law, 1e-5, pitch=0.004, elements=50),
    ]


def count(workspace, name, grid):
    """Iterations in all, cut-backs included, and the results."""
    results = workspace.run(name, grid.deck())
    return iterations(results)[0], results


def measure(workspace):
    values, figure = {}, {}
    for n, others in PROTOTYPE.items():
        for name, hertz_law in (("linear", False), ("hertz", True)):
            values[f"crossings.{name}_{n**2}"] = [
                count(workspace, f"{n**2}_{penalty}_{push}", Grid(n, penalty, 1e-3 * push))[0]
                for penalty, push in others
                if (penalty is None) == hertz_law
            ]
    if workspace.quick:
        return values | {"figure": figure}
    for name, law in LAWS.items():
        values[f"crossings.new.{name}"] = [
            count(workspace, f"new_{name}_{i}", grid)[0] for i, grid in enumerate(new(law).values())
        ]
        values[f"crossings.forces.{name}"] = []
        for i, grid in enumerate(small(law)):
            forces, exact = contact_forces(grid, count(workspace, f"small_{name}_{i}", grid)[1]), grid.exact()
            values[f"crossings.forces.{name}"].append(float(np.abs(forces - exact).max() / exact.max()))
            if i == 2:
                figure[name] = forces, exact
        loose = Grid(10, law, load=0.05, lower=STEEL, upper=STEEL, clearance=1e-6)
        values[f"crossings.stretching.{name}"] = count(workspace, f"stretching_{name}", loose)[0]
    return values | {"figure": figure}


def draw(values, path):
    below = {"loc": "upper center", "bbox_to_anchor": (0.4, -0.16), "ncols": 3, "columnspacing": 1.0}
    with figures.panels(path, columns=3, height=3.8) as (known, fresh, field):
        labels, bars = [], []
        for n, others in PROTOTYPE.items():
            measured = values[f"crossings.linear_{n**2}"] + values[f"crossings.hertz_{n**2}"]
            for (penalty, push), (plain, mixed), litz in zip(others, others.values(), measured, strict=True):
                law = "Hertz" if penalty is None else f"$10^{{{math.log10(penalty):.0f}}}$"
                labels.append(f"{n**2}, {law}, {push:g} mm")
                bars.append((plain or 40, mixed, litz))
        place = np.arange(len(labels))
        looks = ((-0.27, "#bbbbbb", "prototype, plain"), (0.0, "#777777", "mixed"), (0.27, "#c4451c", "litz"))
        for (shift, color, name), column in zip(looks, zip(*bars, strict=True), strict=True):
            known.barh(place + shift, column, 0.25, color=color, label=name)
        known.set_yticks(place, labels)
        known.invert_yaxis()
        known.set(xlabel="iterations in one load step (40: diverged)", xticks=range(0, 41, 10))
        known.legend(**below)
        names = list(new(None))
        for shift, law in ((-0.2, "linear"), (0.2, "hertz")):
            fresh.barh(np.arange(len(names)) + shift, values[f"crossings.new.{law}"], 0.38, label=law)
        fresh.axvline(10, **figures.REFERENCE)
        fresh.set_yticks(np.arange(len(names)), names)
        fresh.invert_yaxis()
        fresh.set(xlabel="iterations in one load step, grids not tuned on", xticks=range(0, 11, 2))
        fresh.legend(**below)
        forces, exact = values["figure"]["hertz"]
        i, j = np.indices(exact.shape)
        size = 120 / exact.max()
        field.scatter(i, j, size * exact, facecolors="none", edgecolors="#222222", label="closed form")
        field.scatter(i, j, size * forces / 4, color="#c4451c", label="litz (area: a quarter)")
        field.set(xlabel="lower wire", ylabel="upper wire", title="forces of 100 crossings, Hertz", aspect="equal")
        field.legend(**below)


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["crossings"]))

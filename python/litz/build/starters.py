"""Commented decks as starting points: small, and ready to run."""

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..base.names import unknown_name
from ..deck import Card, Deck
from ..errors import FileError
from ..model import COPPER, FilmSpot, Hertz, HertzSpot, Interaction, Material, Model, SharvinSpot
from ..model.loading import describe_fields
from .cables import cable, strand
from .fabrics import wire_grid, woven_fabric
from .fibre_mats import fibre_mat
from .films import nanowire_film
from .jackets import compact

#: What a card is for, before the first of its kind; "STEP ..." for those in a step
_NOTES = {
    "UNITS": "units that results are labelled with; without it they have none",
    "NODE": "nodes: number, x, y, z [m]; NSET collects them in a node set",
    "ELEMENT": "beam elements between two nodes; ELSET collects them in an element set",
    "ELSET": "element sets of other sets",
    "NSET": "node sets, by which wires are held, moved and connected",
    "MATERIAL": "material of the wires: Young's modulus [Pa], Poisson's ratio; conductivity [S/m]",
    "BEAM SECTION": "round wires: the radius [m]",
    "SURFACE INTERACTION": "the laws of a contact: force, friction, resistance of the spot",
    "AMPLITUDE": "values over time: time, value, ...",
    "RIGID SURFACE": "a jacket: a point of its axis and the direction of it, its radius [m], which follows an amplitude",
    "CONTACT PAIR": "sets that may touch; a single set: contact among its wires",
    "BOUNDARY": "held from the start: nodes, first and last degree of freedom: {fields}",
    "STEP": "a load step, with the maximum number of increments",
    "STATIC": "first increment, time of the step, smallest and largest increment [s]",
    "STEP BOUNDARY": "value at the end of the step [{units}], reached in proportion to time",
    "STEP NODE PRINT": "output to the history file (.csv) at every increment",
    "INITIAL CONDITIONS": "temperature before the first step [K]",
    "STEP COUPLED THERMAL-ELECTRICAL": "currents and temperatures over time: increment, time of the step [s]",
    "STEP CECURRENT": "currents into nodes [A]",
    "STEP CONTROLS": "damping of strands that are loose until others hold them",
    "STEP ELECTRODE PRINT": "voltage, current and resistance between two node sets, also in the history file",
    "STEP ENERGY PRINT": "energies: the work of the supports is stored in wires and contacts, or dissipated by friction",
}


@dataclass(frozen=True)
class Starter:
    """A deck as a starting point.

    Attributes
    ----------
    what : str
        One line about it.
    make : callable
        Returns the model.
    """

    what: str
    make: Callable[[], Model]


def _crossing(friction: float | None = None) -> Model:
    """Two copper wires, one across the other."""
    model = Model("Two crossed copper wires")
    wire: dict[str, Any] = {"radius": 1e-3, "material": COPPER, "elements": 9}
    lower = model.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), **wire)
    upper = model.wire("UPPER", (0, -0.05, 2e-3), (0, 0.05, 2e-3), **wire)
    model.contact(lower, upper, behaviour=Hertz(), conductance=HertzSpot(), friction=friction)
    model.fix(lower.ends)
    model.fix(upper.ends, "rotations")
    return model


def _crossed_wires() -> Model:
    model = _crossing()
    model.title = "Two crossed copper wires pressed together, 1 mV between them"
    lower, upper = model.groups.values()
    step = model.step("PRESS", increment=0.1)
    step.hold(upper.ends, "x", "y")
    step.move(upper.ends, "z", -1e-4)
    step.potential(lower.start, 1e-3)
    step.potential(upper.start, 0.0)
    step.node_print(upper.ends, "RF", totals="ONLY")
    step.electrode_print(lower.start, upper.start)
    return model


def _friction() -> Model:
    model = _crossing(friction=0.3)
    model.title = "A copper wire pressed on another one and dragged along it: stick and slip"
    lower, upper = model.groups.values()
    press = model.step("PRESS", increment=0.2)
    press.hold(upper.ends, "x", "y")
    press.move(upper.ends, "z", -1e-4)
    press.potential(lower.start, 1e-3)
    press.potential(upper.start, 0.0)
    press.node_print(upper.ends, "U", totals="ONLY")
    press.node_print(upper.ends, "RF", totals="ONLY")
    press.electrode_print(lower.start, upper.start)
    press.energy_print()
    for name, place in (("DRAG", 2e-4), ("BACK", 0.0)):
        step = model.step(name, increment=0.05)
        step.move(upper.ends, "x", place)
    return model


def _grid() -> Model:
    model = wire_grid(4, 4, pitch=10e-3, radius=0.5e-3, elements_per_pitch=3)
    model.title = "Four wires on four wires, pressed together, 1 mV between the two layers"
    model.press(0.1e-3, voltage=1e-3).node_print("UPPER_ENDS", "RF", totals="ONLY")
    return model


def _fibre_mat() -> Model:
    model = fibre_mat((10e-3, 10e-3), 5, radius=0.1e-3, seed=1, n_layers=3, clearance=5e-6)
    model.title = "A random mat of 15 fibres pressed between two electrodes, 1 mV between them"
    model.press(40e-6, voltage=1e-3).node_print("PLUS", "RF", totals="ONLY")
    return model


def _strand() -> Model:
    model = strand(
        [1, 6],
        radius=[0.104e-3, 0.1e-3],
        lay_length=9e-3,
        length=9e-3,
    )
    model.title = "Six wires laid on a core, pulled by 0.1 %, 1 mV between the ends"
    model.comments = [
        "The wires touch the core along helices. It is 4 % thicker than they are, so that they do not touch each other.",
    ]
    model.press(-9e-6, voltage=1e-3, name="PULL").node_print("PLUS", "RF", totals="ONLY")
    return model


def _triplet() -> Model:
    film = Interaction(conductance=FilmSpot(1e-11))
    model = cable(
        [[3]], radius=0.41e-3, lay_lengths=[80e-3], length=20e-3, ends="sliding", interaction=film, elements_per_lay=60
    )
    model.title = "Three strands in a jacket that shrinks: the resistance between two of them"
    model.comments = [
        "Copper strands of 0.82 mm with an oxide of 1e-11 ohm m^2, laid together with 80 mm, in a jacket with 35 % of void in",
        "the end. A current of 1 A enters the first strand and leaves the second one at the same end: the voltage between",
        "them is the resistance. Others follow from the contacts: litz network, and results.interstrand_resistance() in Python.",
    ]
    step = compact(model, void_fraction=0.35, increments=10)
    first, second, _ = model.groups["LAYER1"].wires
    model.node_set("FIRST", first.nodes[0])
    model.node_set("SECOND", second.nodes[0])
    step.current("FIRST", 1.0)
    step.potential("SECOND", 0.0)
    step.electrode_print("FIRST", "SECOND")
    return model


def _film() -> Model:
    # spots are smaller than the mean free path of the electrons in silver; that times the resistivity [ohm m^2]
    touch = Interaction("TOUCH", conductance=SharvinSpot(8.46e-16))
    model = nanowire_film(
        (20e-6, 10e-6), 40, length=8e-6, radius=30e-9, seed=2, reach=2e-6, clearance=0.3e-9, interaction=touch
    )
    model.title = "A film of 40 silver nanowires between two electrodes, pressed, 1 mV between them"
    model.press(0.3 * (model.height or 0.0), voltage=1e-3, increment=0.2)
    return model


def _fabric() -> Model:
    model = woven_fabric(4, 4, pitch=1e-3, radius=0.1e-3, clearance=0.2e-6)
    model.title = "A plain weave of 4 x 4 copper wires pressed between two plates, which have 1 mV"
    # so far that warp and weft touch each other, too
    model.press(2e-6, voltage=1e-3, increment=0.25).node_print("PLUS", "RF", totals="ONLY")
    return model


def _cable() -> Model:
    # a pull as small as this one needs a fine mesh: overlaps between the nodes must be small beside those by the pull
    model = cable([[3], [2]], radius=0.1e-3, lay_lengths=[8e-3, 16e-3], length=4e-3, elements_per_lay=56)
    model.title = "Two strands of three wires laid to a cable, pulled by 0.1 %, 1 mV between the ends"
    model.comments = [
        "The wires of a strand touch along lines; the strands come to touch each other when they are pulled further."
    ]
    model.press(-4e-6, voltage=1e-3, name="PULL", increment=0.25).node_print("PLUS", "RF", totals="ONLY")
    return model


def _fuse() -> Model:
    rho, slope, room, melting = 1.72e-8, 3.93e-3, 293.15, 1357.0
    hot = 1700.0
    copper = Material(
        "COPPER",
        young=120e9,
        poisson=0.34,
        conductivity=[(1 / rho, room), (1 / (rho * (1 + slope * (hot - room))), hot)],
        thermal_conductivity=390.0,
        density=8960.0,
        specific_heat=385.0,
        latent_heat=(205e3, melting, melting + 1),
    )
    model = Model("A copper wire that a current of 60 A heats until it melts", units="SI")
    model.comments = ["The resistivity of copper rises with the temperature by 0.393 % of that at 293.15 K per kelvin."]
    fuse = model.wire("FUSE", (-10e-3, 0, 0), (10e-3, 0, 0), radius=0.1e-3, material=copper, elements=20)
    model.fix(fuse.start)
    model.fix(fuse.end, "potential")
    model.initial_temperature(room)
    step = model.step("SWITCHED_ON", procedure="COUPLED THERMAL-ELECTRICAL", first=1e-4, total=0.029)
    step.temperature(fuse.ends, room)
    step.current(fuse.start, 60.0)
    step.node_print(fuse.middle, "NT")
    step.electrode_print(fuse.start, fuse.end)
    return model


STARTERS = {
    "crossed-wires": Starter("two wires pressed together: force and resistance of one contact", _crossed_wires),
    "friction": Starter("a wire dragged along another one: stick and slip, energies", _friction),
    "grid": Starter("four wires across four others: current through a network of contacts", _grid),
    "fibre-mat": Starter("random fibres pressed between two electrodes", _fibre_mat),
    "film": Starter("silver nanowires that lie on each other, between two electrodes", _film),
    "fabric": Starter("woven wires pressed between two plates", _fabric),
    "cable": Starter("two strands laid to a cable, pulled: contact along lines", _cable),
    "strand": Starter("six wires laid on a core, pulled: contact along lines", _strand),
    "triplet": Starter("three strands in a jacket that shrinks: the resistance between strands", _triplet),
    "fuse": Starter("a wire heated by its current over time until it melts", _fuse),
}


def starter_list() -> str:
    """The starters, a line each."""
    width = max(map(len, STARTERS))
    return "".join(f"{name:{width}}  {starter.what}\n" for name, starter in STARTERS.items())


def new(task: str, path: str | os.PathLike | None = None) -> Path:
    """Write a commented deck as a starting point.

    Parameters
    ----------
    task : str
        "crossed-wires", "friction", "grid", "fibre-mat", "film", "fabric", "cable", "strand", "triplet" or "fuse".
    path : path, optional
        Path of the deck; default: `TASK.inp` in the current directory. An existing file is not replaced.

    Returns
    -------
    Path
        The deck.
    """
    name = task.lower().replace("_", "-")
    if name not in STARTERS:
        raise ValueError(unknown_name("starter", task, STARTERS))
    path = Path(f"{name}.inp") if path is None else Path(path)
    model = STARTERS[name].make()
    model.comments.append(
        f"To run it: litz run {path.name} -o {path.stem}; results: litz summary {path.stem}, litz plot {path.stem}"
    )
    text = _commented(model).text
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise FileError(f"{path} exists already and is not overwritten; choose another name") from None
    except OSError as error:
        raise FileError(f"cannot write {path}: {error.strerror}") from None
    return path


def _commented(model: Model) -> Deck:
    """The deck of a model with a note before the first card of each kind."""
    deck = Deck.parse(model.to_deck())
    noted = set()
    fields, units = describe_fields()
    place = ""
    for card in deck:
        key = f"{place}{card.name}" if card.name != "STATIC" else "STATIC"
        if key in _NOTES and key not in noted:
            noted.add(key)
            card.comments = [*_without_empty(card), f"** {_NOTES[key].format(fields=fields, units=units)}\n"]
        if card.is_a("STEP"):
            place = "STEP "
        elif card.is_a("END STEP"):
            place = ""
    return deck


def _without_empty(card: Card) -> list[str]:
    """The comments that say something."""
    return [line for line in card.comments if line.strip("* \n")]

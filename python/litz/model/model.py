"""A model of wires in contact, built in Python."""

from os import PathLike
from pathlib import Path
from typing import Any

from ..base.notebook import shown_by
from ..results import Results
from ..runs.run import run
from .description import described
from .loaded_model import LoadedModel
from .write_deck import deck_text
from .write_mesh import write_mesh_file


class Model(LoadedModel):
    """Everything a deck says: wires, materials, contacts, supports and steps.

    Nodes and elements are numbered from 1 in the order in which they are added. Errors are raised
    immediately, as ValueError with the allowed values; the checks are those of the keyword table (`litz keywords`).

    Parameters
    ----------
    title : str
        Heading of the deck.
    comments : list of str
        Lines that stand as `**` comments at the head of the deck.
    units : "SI" or mapping, optional
        The units that the numbers are in: "SI", or labels by the parameters of `*UNITS`, such as
        `{"length": "mm", "force": "mN"}`. Labels only: nothing is converted. Without them, a model with a material in SI
        (`litz.COPPER`) is in SI, and the results of any other model have no units in tables and pictures.

    Attributes
    ----------
    groups : dict of str to WireGroup
        The wires.
    node_sets : dict of str to list
        Node numbers of each node set besides those of the groups.
    element_sets : dict of str to list
        Names of groups, and numbers of elements, of each element set.
    surfaces : dict of str to RigidSurface
        The rigid surfaces.
    amplitudes : dict of str to Amplitude
        Factors over time.
    contacts : list of ContactPair
        What may touch what.
    supports : list of Prescribed
        Degrees of freedom that are zero from the start.
    guides : dict
        Factor on the displacement of a pressing for each node or node set: 0 is at rest, 1 follows fully (`press`).
    height : float, optional
        Displacement of a pressing that brings top and bottom to one level [m], the upper limit of
        any pressing; None without such a limit.
    ground : str, optional
        Node set that is written at 0 V if nothing else prescribes a potential or a current; set by `press`.
    steps : list of Step
        The loading.

    Examples
    --------
    >>> import litz
    >>> model = litz.Model("two crossed wires")
    >>> copper = model.material("COPPER", young=120e9, poisson=0.34, conductivity=58.8e6)
    >>> lower = model.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), radius=1e-3, material=copper, elements=9)
    >>> upper = model.wire("UPPER", (0, -0.05, 2e-3), (0, 0.05, 2e-3), radius=1e-3, material=copper, elements=9)
    >>> pair = model.contact(lower, upper, conductance=litz.HertzSpot(), friction=0.3)
    >>> model.fix(lower.ends)
    >>> model.fix(upper.ends, "x", "y", "rotations")
    >>> step = model.step(increment=0.1)
    >>> step.move(upper.ends, "z", -1e-4)
    >>> step.potential(lower.start, 1e-3)
    >>> step.potential(upper.start, 0)
    >>> step.electrode_print(lower.start, upper.start)
    >>> model
    <Model 'two crossed wires': 20 nodes, 18 elements
      <wire LOWER: 9 B33 elements, radius 0.001, COPPER>
      <wire UPPER: 9 B33 elements, radius 0.001, COPPER>
      contact LOWER with UPPER: TOUCH
      <Step STEP1: time 1, first increment 0.1; 3 prescribed; ELECTRODE PRINT>>
    >>> results = model.run("results/crossed")   # doctest: +SKIP
    """

    def _repr_html_(self) -> str:
        """What the model has, and a small picture of its wires, for notebooks."""
        return described(self, shown_by("pictures.model_picture", self))

    def to_deck(self) -> str:
        """The deck as text."""
        return deck_text(self)

    def write(self, path: str | PathLike, *, mesh_file: bool = False) -> Path:
        """Write the deck; numbers are written as the shortest decimals that are read back exactly.

        Parameters
        ----------
        path : path
            The deck; existing files are overwritten, missing directories are created.
        mesh_file : bool
            Nodes, elements and sets go into an HDF5 file of the same name with the ending `.h5` beside the deck, which
            litz reads faster than text.
        """
        path = Path(path)
        mesh = path.with_suffix(".h5")
        text = deck_text(self, mesh.name if mesh_file else None)
        path.parent.mkdir(parents=True, exist_ok=True)
        if mesh_file:
            write_mesh_file(self, mesh)
        path.write_text(text, encoding="utf-8")
        return path

    def run(self, output_directory: str | PathLike, **options: Any) -> Results:
        """Write the deck into a directory and run it there; both have the directory's name.

        Parameters
        ----------
        output_directory : path
            Directory of the deck and the results; created if necessary.
        **options
            As those of `litz.run`: `solver`, `threads`, `restart`, `quiet`, `progress`.
        """
        if not self.steps:
            raise ValueError("the model has no step: add one with model.step()")
        directory = Path(output_directory)
        deck = self.write(directory / f"{directory.resolve().name}.inp")
        return run(deck, output_directory=directory, **options)

"""The commands that write decks."""

import argparse
import sys
import textwrap
import warnings
from pathlib import Path

from ..build.starters import new, starter_list
from ..errors import FileError, InputError
from ..model import COPPER, Material, Model
from ..model.abaqus_mesh import DIALECTS
from ..model.foreign_deck import convert_deck, has_materials, has_steps, refusal, refusal_by_itself, sections_of
from ..model.mesh import element_types
from ..model.read_mesh import read_mesh
from .parsers import command_parser

#: Units of length, in metres
LENGTHS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6}
#: What the program says about wires that are not held
_LACKS_SUPPORTS = ("*BOUNDARY must prevent that", "has no path to a prescribed potential")


def new_command(arguments: list[str]) -> int:
    """`litz new`: a commented deck as a starting point."""
    parser = command_parser("new", "Write a commented deck as a starting point; it runs as is.", starter_list())
    parser.add_argument("task", metavar="TASK", nargs="?", help="one of those below")
    parser.add_argument(
        "deck", metavar="DECK", nargs="?", help="default: TASK.inp; an existing file is not overwritten"
    )
    parser.add_argument("--list", action="store_true", help="list the tasks")
    options = parser.parse_args(arguments)
    if options.list:
        print(starter_list(), end="")
        return 0
    if options.task is None:
        parser.error("which task? litz new --list shows them")
    try:
        deck = new(options.task, options.deck)
    except ValueError as error:
        parser.error(str(error))
    print(f"wrote {deck}\nrun it: litz run {deck} -o {deck.with_suffix('')}")
    return 0


def convert_command(arguments: list[str]) -> int:
    """`litz convert`: a deck from a mesh, or from a deck of another program."""
    parser = command_parser(
        "convert",
        "Write a deck of Abaqus or CalculiX as one of litz, or the wires and sets of a mesh as a deck to which supports and"
        " steps are added.",
    )
    parser.add_argument("mesh", metavar="MESH", help="Abaqus, gmsh or BeamMe (.inp), gmsh (.msh), or what meshio reads")
    parser.add_argument("deck", metavar="DECK", help="the deck to write; an existing file is not overwritten")
    parser.add_argument(
        "--dialect",
        choices=DIALECTS,
        help="whose deck it is; needed if it has a *BEAM SECTION, SECTION=CIRC, whose value is the radius in Abaqus, but the"
        " diameter in CalculiX, or a *DLOAD P1 or P2, which is a force per length in Abaqus, but a pressure in CalculiX",
    )
    parser.add_argument(
        "--radius",
        type=float,
        help="radius of the wires, in the length unit of the mesh; not needed if the mesh has sections",
    )
    parser.add_argument(
        "--length",
        choices=LENGTHS,
        help="unit of length of the mesh, with forces in N: the unit of the default material, and the label of *UNITS",
    )
    parser.add_argument("--young", type=float, help="Young's modulus; default: copper, in the units of --length")
    parser.add_argument("--poisson", type=float, help="Poisson's ratio; default: copper")
    parser.add_argument("--conductivity", type=float, help="electrical conductivity; without it an insulator")
    parser.add_argument(
        "--element",
        choices=element_types(),
        default="B33",
        help="element type if the mesh does not specify it; default B33",
    )
    options = parser.parse_args(arguments)
    if Path(options.deck).exists():
        raise FileError(f"{options.deck} exists already and is not overwritten; choose another name")
    given = [f"--{name}" for name in ("young", "poisson", "conductivity") if getattr(options, name) is not None]
    if given and options.radius is None:
        parser.error(
            f"{' and '.join(given)} would be of wires of --radius; without it sections and materials are those of the mesh"
        )
    try:
        sections = sections_of(Path(options.mesh))
        if options.radius is None and (
            has_steps(Path(options.mesh)) or any(one != "CIRC" for one in sections.values())
        ):
            return _convert_whole_deck(options)
        with warnings.catch_warnings():
            if options.radius is not None:
                warnings.filterwarnings("ignore", message=".*the section of .* is ignored")
            mesh = read_mesh(options.mesh, dialect=options.dialect)
        if options.radius is not None and options.young is None and has_materials(Path(options.mesh)):
            raise ValueError(
                f"{options.mesh} has materials of its own, which wires of --radius do not have: --young says what these have"
            )
        notes = ["Supports, contacts and loads must be added: outlines are below, `litz keywords` explains them."]
        units = {} if options.length is None else {"length": options.length}
        model = Model(f"Wires of {mesh.path.name}", notes, **({"units": units} if units else {}))
        poisson = COPPER.poisson if options.poisson is None else options.poisson
        material = Material("WIRE", _young(options), poisson, options.conductivity)
        model.mesh(
            mesh, radius=options.radius, material=None if options.radius is None else material, element=options.element
        )
        model.step()
        _write_with_outline(model, Path(options.deck))
        if options.radius is not None and sections:
            told = ", ".join(f"{name} ({shape or 'without a shape'})" for name, shape in sections.items())
            warnings.warn(f"wires of --radius replace the sections of {options.mesh}: {told}", stacklevel=2)
    except ValueError as error:
        raise InputError(str(error)) from None
    print(f"wrote {options.deck}: {len(mesh.x)} nodes, {len(mesh.connectivity)} elements")
    for what, sets in (("element sets", model.element_sets | model.groups), ("node sets", model.node_sets)):
        if sets:
            print(f"{what}: {', '.join(sets)}")
    print("supports, contacts and loads are missing: the deck has outlines of them as comments")
    refused = refusal(Path(options.deck))
    if _lacks_supports_alone(refused):
        return 0
    print(f"{options.deck} CANNOT RUN AS IT IS:\n{textwrap.indent(refused, '  ')}", file=sys.stderr)
    return 1


def _lacks_supports_alone(refused: str) -> bool:
    """Whether all that the program says of a deck is that it has no supports."""
    errors = [line for line in refused.splitlines() if line.startswith("error: ")]
    return all(any(lacks in line for lacks in _LACKS_SUPPORTS) for line in errors)


def _young(options: argparse.Namespace) -> float:
    """Young's modulus: as told, or that of copper in the units of the mesh."""
    if options.young is not None:
        return options.young
    if options.length is None and options.radius is not None:
        raise ValueError(
            "the material of the wires: --young (in the units of the mesh) or --length (copper in these, with forces in N)"
        )
    # N per square of the unit
    return COPPER.young * LENGTHS[options.length or "m"] ** 2


def _convert_whole_deck(options: argparse.Namespace) -> int:
    """A deck with steps keeps all that litz has; exit code 1: something that changes results is missing, or it cannot run."""
    units = {} if options.length is None else {"LENGTH": options.length}
    converted = convert_deck(Path(options.mesh), options.dialect, units)
    Path(options.deck).write_text(converted.text, encoding="utf-8", errors="surrogateescape")
    refused = refusal_by_itself(Path(options.deck), converted.left_out)
    is_mesh = not has_steps(Path(options.mesh))
    if is_mesh and _lacks_supports_alone(refused):
        refused = ""
    print(f"wrote {options.deck}" + ("" if refused or is_mesh else f"; look at it: litz check {options.deck}"))
    if is_mesh:
        print("supports, contacts and loads are missing: the deck has an empty *STEP")
    for title, reasons in (
        ("comments, without which the results are the same", converted.ignored),
        ("comments, WITHOUT WHICH THE RESULTS ARE OTHERS", converted.left_out),
        (f"{options.deck} CANNOT RUN AS IT IS", [refused] if refused else []),
    ):
        if reasons:
            print(f"{title}:", file=sys.stderr)
        for reason in dict.fromkeys(reasons):
            print(textwrap.indent(reason, "  "), file=sys.stderr)
    # what is missing must not go unnoticed in scripts
    return 1 if converted.left_out or refused else 0


def _write_with_outline(model: Model, path: Path) -> None:
    """Write the deck, with outlines of the missing cards as comments."""
    groups = model.groups
    # wires are not held at all their nodes
    whole = {len(group.nodes) for group in groups.values()}
    sets = [name for name, nodes in model.node_sets.items() if len(nodes) not in whole]
    conducts = any(group.material.conductivity is not None for group in groups.values())
    outline = ["*SURFACE INTERACTION, NAME=TOUCH", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ"]
    outline += ["*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ"] * conducts
    outline += ["*CONTACT PAIR, INTERACTION=TOUCH", f" {', '.join([*groups][:2])}"]
    loads = []
    if sets:
        outline += ["*BOUNDARY", *(f" {name}, ENCASTRE" for name in sets), *[f" {sets[0]}, 9"] * conducts]
        loads = ["*BOUNDARY", f" {sets[-1]}, 3, 3, {-next(iter(groups.values())).radius:g}"]
    text = model.to_deck()
    for before, lines in (("*STEP", outline), ("*END STEP", loads)):
        head, keyword, rest = text.rpartition(f"\n{before}")
        comments = "".join(f"\n** {line}" for line in lines)
        text = f"{head}{comments}{keyword}{rest}"
    path.write_text(text, encoding="utf-8")

"""The command `litz plot`."""

import argparse
import re
from importlib import import_module
from pathlib import Path

from ..errors import InputError
from ..pictures.kinds import KINDS
from ..pictures.loading import load_matplotlib
from ..pictures.scene import VIEWS
from ..results import Results
from ..results.found_files import is_there
from ..results.scalars import scalars
from .parsers import increment_of, results_parser

_PLOT_EXAMPLES = """
examples:
  litz plot deck.vtkhdf                                       the overview of the last increment
  litz plot deck.vtkhdf wires --field joule_heat --view iso   wires coloured by the heat in them
  litz plot deck.vtkhdf wires --field displacement.z --increment 2:15 --size 1600x1000
  litz plot deck.vtkhdf --animate -o deck.mp4                 the wires at one increment after the other
"""


def plot_command(arguments: list[str]) -> int:
    """`litz plot`: a picture, or an animation."""
    parser = results_parser("plot", "Draw results into a picture file, or an animation.", _PLOT_EXAMPLES)
    parser.add_argument("kind", nargs="?", metavar="KIND", help=f"{', '.join(KINDS)}; default: overview")
    parser.add_argument("-o", "--output", metavar="PICTURE", help="default: STEM_KIND.png next to the results")
    parser.add_argument("--increment", default="-1", metavar="N",
                        help="STEP:INCREMENT, or counted from 0, or from the end; default: -1, the last")  # fmt: skip
    parser.add_argument("--field", help="field that colours the wires: a field of the file, the length of a vector, or "
                        "VECTOR.x, .y, .z; default: the potential, or else the displacement")  # fmt: skip
    parser.add_argument(
        "--list-fields", action="store_true", help="list the fields that can colour the wires, without drawing"
    )
    parser.add_argument("--scale", type=float, default=1.0, help="factor on the displacements; default: 1")
    parser.add_argument(
        "--spots", choices=("current", "force", "none"), help="quantity shown by the size of the contact spots"
    )
    parser.add_argument("--view", type=_view, metavar="DIRECTION",
                        help=f"from the wires to the viewer: X,Y,Z or one of {', '.join(VIEWS)} (--view=-z)")  # fmt: skip
    parser.add_argument("--size", type=_size, metavar="WIDTHxHEIGHT", help="in pixels")
    parser.add_argument(
        "--wire", type=int, metavar="N", help="for lines: the wire, counted from 1, along which they are drawn"
    )
    parser.add_argument(
        "--place",
        type=float,
        default=0.5,
        metavar="PART",
        help="for section: place along the cable, 0 to 1; default: 0.5",
    )
    parser.add_argument("--no-reference", action="store_true", help="do not draw the undeformed axes")
    parser.add_argument("--animate", action="store_true", help="the wires over all increments, as .gif or .mp4")
    parser.add_argument("--frames-per-second", type=float, default=10.0, metavar="N", help="default: 10")
    options = parser.parse_args(arguments)
    if options.results in KINDS and not is_there(Path(options.results)):
        parser.error(f"the results come first: litz plot {options.kind or 'RESULTS'} {options.results}")
    look = {name: getattr(options, name) for name in ("field", "scale", "spots", "view", "size")}
    look["reference"] = not options.no_reference
    try:
        results = Results(options.results)
        # takes long to load, and is of no use without results
        load_matplotlib()
        plots = import_module("..pictures.plots", __package__)
        results = plots.with_increments(results)
        if options.list_fields:
            print(_fields(results), end="")
            return 0
        if options.animate or Path(options.output or "").suffix in (".gif", ".mp4"):
            if options.kind not in (None, "wires"):
                raise ValueError(f"only the wires can be animated, not {options.kind!r}")
            animate = import_module("..pictures.animation", __package__).animate
            picture = animate(results, options.output, frames_per_second=options.frames_per_second, **look)
        else:
            increment = increment_of(results, options.increment)
            kind, wire = options.kind or "overview", options.wire
            if wire is not None and (kind != "lines" or not 1 <= wire <= len(results.wires)):
                raise ValueError(f"--wire is for lines, a number from 1 to {len(results.wires)}")
            look["wire"] = None if wire is None else wire - 1
            look["place"] = options.place
            picture = plots.plot(results, kind, options.output, increment=increment, **look)
    except (ValueError, LookupError) as error:
        raise InputError(error.args[0]) from None
    print(f"picture: {picture}")
    return 0


def _fields(results: Results) -> str:
    """A line for each scalar: name, unit and meaning."""
    rows = [
        (name, scalar.unit, results.fields.get(scalar.fields[0], "") if len(scalar.fields) == 1 else scalar.text)
        for name, scalar in scalars(results).items()
        if scalar.component is None
    ]
    width = max(len(name) for name, _, _ in rows)
    lines = [f"{name:<{width}}  {'[' + unit + ']':<8}  {text}\n" for name, unit, text in rows]
    return "".join(lines) + "A vector is shown by its magnitude; NAME.x, NAME.y and NAME.z are its components.\n"


def _view(text: str) -> str | tuple[float, ...]:
    """A direction as `litz.plot` takes it."""
    if "," not in text:
        return text
    try:
        direction = tuple(float(number) for number in text.split(","))
    except ValueError:
        direction = ()
    if len(direction) != 3:
        raise argparse.ArgumentTypeError(f"a direction has three numbers, such as 1,-1,0.8, not {text!r}")
    return direction


def _size(text: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d+)x(\d+)", text)
    if not found:
        raise argparse.ArgumentTypeError(f"a size is WIDTHxHEIGHT in pixels, such as 1600x1000, not {text!r}")
    return int(found[1]), int(found[2])

"""The pictures of `litz report`: apart from its texts, which need no matplotlib."""

import base64
import html
import io
import math
import tempfile
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from pathlib import Path

import numpy as np
from PIL import Image

from ..pictures.friction_charts import has_friction
from ..pictures.kinds import INCHES
from ..pictures.plots import begin_wires, plot
from ..results import Results
from ..results.contact_history import has_lines
from ..results.scalars import default_scalar
from . import side_by_side

# Quality, of 100, and scale of pictures that need more: drawn twice as large as the page shows them, they bear three quarters
_SMALLER = ((75, 1.0), (75, 0.75), (60, 0.75), (60, 0.6), (40, 0.5))
# Size of pictures of the wires, and resolution of charts: twice what the page shows [pixels]
_SIZE_OF_WIRES = (1200, 840)
_PIXELS_PER_INCH = 110
_MAX_WIRES = 300
# Moments that are smaller beside those of forces over an element are round-off
_ROUND_OFF = 1e-10


class Pictures:
    """The pictures that a run has something for, drawn into files while this process does something else.

    Parameters
    ----------
    results : Results
    folder : Path
        Where the pictures are.
    processes : int
        Processes besides this one that draw charts.
    """

    def __init__(self, results: Results, folder: Path, processes: int) -> None:
        # Pillow would load what writes WebP in each process anew
        import_module("PIL.WebPImagePlugin")
        wanted = _wanted(results)
        self._texts = [one.text for one in wanted]
        self._paths = [folder / f"{number}.webp" for number in range(len(wanted))]
        charts: list[side_by_side.Job] = [
            (path, partial(plot, results, one.kind, path, size=_size(one.kind)))
            for path, one in zip(self._paths, wanted, strict=True)
            if one.kind != "wires"
        ]
        self._finish_charts = side_by_side.begin(charts, processes)
        wires = [number for number, one in enumerate(wanted) if one.kind == "wires"]
        self._finish_wires = begin_wires(
            results, [wanted[n].field for n in wires], [self._paths[n] for n in wires], _SIZE_OF_WIRES
        )

    def finish(self) -> None:
        """Wait for all pictures, and draw what nobody else does."""
        self._finish_wires()
        self._finish_charts()

    def figures(self, room: int) -> list[str]:
        """The section of a page with all pictures, in a number of letters."""
        _make_smaller(self._paths, room)
        figures = [_figure(picture, text) for picture, text in zip(self._paths, self._texts, strict=True)]
        return ["<h2>Pictures</h2>", '<div class="pictures">', *figures, "</div>"]


def last_iterate(results: Results) -> str:
    """A picture of the iterate at which a run gave up."""
    with tempfile.TemporaryDirectory() as folder:
        picture = plot(
            results, "wires", Path(folder, "wires.webp"), field="displacement", spots="force", size=_SIZE_OF_WIRES
        )
        return _figure(picture, "The last iterate of the failed run: not an equilibrium.")


@dataclass(frozen=True)
class _Wanted:
    """A kind of picture, what it shows, and what colours the wires."""

    kind: str
    text: str
    field: str | None = None


def _wanted(results: Results) -> list[_Wanted]:
    wanted = [_Wanted("wires", f"The wires at the last increment, coloured by {default_scalar(results, -1)}.")]
    contacts, field = results.contacts, lambda name: results.field(name).any()
    if field("joule_heat"):
        wanted.append(_Wanted("wires", "Joule heat per length of the wires.", "joule_heat_per_length"))
    if "temperature" in results.fields:
        wanted.append(_Wanted("wires", "Temperature.", "temperature"))
    if _bends(results):
        wanted.append(_Wanted("wires", "Bending moment.", "bending_moment"))
    wanted.append(_Wanted("residuals", "Residuals over the iterations."))
    if contacts.n_rows:
        wanted.append(_Wanted("contacts", "The contacts over time, and their spots at the last increment."))
    lines = has_lines(results)
    if lines and results.has_contacts()[-1]:
        wanted.append(_Wanted("lines", "Contact along lines: what passes per length, along the wires."))
    if results.surface_contacts.n_rows:
        wanted.append(_Wanted("surfaces", "Forces on the rigid surfaces."))
    if contacts.n_rows and not lines and (contacts["resistance"] < math.inf).any():
        wanted.append(_Wanted("resistance", "Contact resistance over contact force."))
    if field("element_current"):
        wanted.append(_Wanted("currents", "Currents in the wires."))
    network = results.contact_network() if results.has_contacts()[-1] else None
    if network and len(network.id) > 0 and len(network.wire_length) <= _MAX_WIRES:
        wanted.append(_Wanted("network", "Which wires touch, and how much current passes between them."))
    if has_friction(results):
        wanted.append(_Wanted("friction", "Friction."))
    if len(results.history) > 3:
        wanted.append(_Wanted("history", "Output requested in the deck."))
    return wanted


def _bends(results: Results) -> bool:
    """Whether wires bend by more than round-off: the moments of their section forces over an element."""
    moment = max(float(np.abs(results.field(f"bending_moment_{axis}")).max(initial=0)) for axis in (2, 3))
    forces = [results.field(name) for name in ("axial_force", "shear_force_2", "shear_force_3")] + [
        results.contacts["force"]
    ]
    force = max(float(np.abs(one).max(initial=0)) for one in forces)
    ends = results.nodes[results.elements]
    return moment > _ROUND_OFF * force * float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).max(initial=0))


def _make_smaller(pictures: list[Path], room: int) -> None:
    """Pictures of many wires have much detail: all are saved with less quality until the page has room for them."""
    drawn = [picture.read_bytes() for picture in pictures]
    for quality, scale in _SMALLER:
        if sum(4 * picture.stat().st_size / 3 for picture in pictures) <= room:
            return
        for picture, original in zip(pictures, drawn, strict=True):
            with Image.open(io.BytesIO(original)) as image:
                size = round(scale * image.width), round(scale * image.height)
                image.resize(size, Image.Resampling.LANCZOS).save(picture, "WEBP", quality=quality, method=2)


def _figure(picture: Path, text: str) -> str:
    content = base64.b64encode(picture.read_bytes()).decode()
    escaped = html.escape(text)
    return f'<figure><img alt="{escaped}" src="data:image/webp;base64,{content}"><figcaption>{escaped}</figcaption></figure>'


def _size(kind: str) -> tuple[int, int]:
    """Width and height of a chart [pixels]."""
    width, height = INCHES[kind]
    return round(_PIXELS_PER_INCH * width), round(_PIXELS_PER_INCH * height)

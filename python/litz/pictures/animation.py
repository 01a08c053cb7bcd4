"""Animations of the wires over the increments of a run."""

import warnings
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from ..base.notebook import Picture
from ..base.output import writing
from ..errors import FileError
from ..results import Results
from .plots import STYLE, Look, box_pixels, new_figure, place_wires, title, with_increments
from .prisms import reach_of_sections
from .scene import aim
from .wire_picture import render

_INCHES = (9.0, 6.3)
_PIXELS = (900, 630)
_BOX = (0.01, 0.15, 0.98, 0.72)
# Increments rendered together: few starts of VTK, little memory
_BATCH = 20
_HOLD_LAST = 1.5


def animate(
    results: Results | str | Path,
    filename: str | Path | None = None,
    *,
    field: str | None = None,
    scale: float = 1.0,
    spots: str | None = None,
    reference: bool = True,
    view: tuple[float, float, float] | str | None = None,
    size: tuple[int, int] | None = None,
    frames_per_second: float = 10.0,
    max_frames: int = 100,
    most_frames: int | None = None,
) -> Picture:
    """Animate the wires over the increments of a run.

    The camera, the range of the colours and the size of the spots are the same for all increments.

    Parameters
    ----------
    results : Results or path
        What `Results` takes.
    filename : path, optional
        `.gif`, or `.mp4`, which needs the package imageio-ffmpeg. Default: `STEM_wires.gif` beside the results.
    field, scale, spots, reference, view
        As in `litz.plot`.
    size : tuple of 2 int, optional
        Width and height in pixels; default 900 x 630.
    frames_per_second : float
        Increments that are shown in a second [1/s]; the last one stays for 1.5 s.
    max_frames : int
        Maximum number of increments that are shown; of more increments, an evenly spaced selection.
    most_frames : int, optional
        Former name of `max_frames`.

    Returns
    -------
    Path
        The file; a notebook shows a `.gif`.
    """
    look = Look(field, scale, spots, reference, view)
    if most_frames is not None:
        message = "most_frames is called max_frames now; the old name will be removed in the next version"
        warnings.warn(message, DeprecationWarning, stacklevel=2)
        max_frames = most_frames
    if not frames_per_second > 0 or max_frames < 1:
        raise ValueError("frames per second must be above 0, and the number of frames at least 1")
    results = with_increments(results)
    path = Picture(filename or results.path.with_name(f"{results.path.stem}_wires.gif"))
    if path.suffix not in _WRITERS:
        raise ValueError(f"an animation is a .gif or .mp4 file, not {path.name!r}")
    n = len(results.times)
    increments = np.unique(np.linspace(0, n - 1, min(n, max_frames)).round().astype(int)).tolist()
    pixels = size or _PIXELS
    with mpl.rc_context(STYLE), writing(path):
        _WRITERS[path.suffix](path, _frames(results, increments, look, pixels), frames_per_second)
    return path


def _frames(results: Results, increments: list[int], look: Look, size: tuple[int, int]) -> Iterator[np.ndarray]:
    """The pictures one after the other, each (height, width, 3) of bytes."""
    box = box_pixels(new_figure(_INCHES, size), _BOX)
    maker = look.scenes(results, increments)
    shown = [results.nodes + look.scale * results.field("displacement", increment) for increment in increments]
    shown += [results.nodes] if look.reference else []
    shown += maker.surface_points(increments)
    camera = aim(np.concatenate(shown), 1.5 * reach_of_sections(results), box[0] / box[1], look.direction)
    for start in range(0, len(increments), _BATCH):
        batch = increments[start : start + _BATCH]
        scenes = [maker.scene(increment) for increment in batch]
        for increment, scene, tubes in zip(batch, scenes, render(scenes, camera, box), strict=True):
            figure = new_figure(_INCHES, size)
            place_wires(figure, _BOX, scene, camera, tubes, look.scale)
            figure.text(0.03, 0.975, title(results, increment), va="top", fontsize="large", linespacing=1.4)
            yield _pixels(figure)


def _pixels(figure: Figure) -> np.ndarray:
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()


def _write_gif(path: Path, frames: Iterator[np.ndarray], frames_per_second: float) -> None:
    pictures = [Image.fromarray(frame).quantize(256, dither=Image.Dither.NONE) for frame in frames]
    duration = [round(1000 / frames_per_second)] * len(pictures)
    duration[-1] += round(1000 * _HOLD_LAST)
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=duration, loop=0)


def _write_mp4(path: Path, frames: Iterator[np.ndarray], frames_per_second: float) -> None:
    ffmpeg = _imageio_ffmpeg(path)
    # the codec wants even numbers of pixels
    even = (frame[: frame.shape[0] // 2 * 2, : frame.shape[1] // 2 * 2] for frame in frames)
    frame = next(even)
    height, width, _ = frame.shape
    writer = ffmpeg.write_frames(str(path), (width, height), fps=frames_per_second, macro_block_size=2)
    writer.send(None)
    writer.send(np.ascontiguousarray(frame))
    for frame in even:
        writer.send(np.ascontiguousarray(frame))
    for _ in range(round(_HOLD_LAST * frames_per_second)):
        writer.send(np.ascontiguousarray(frame))
    writer.close()


def _imageio_ffmpeg(path: Path) -> ModuleType:
    try:
        return import_module("imageio_ffmpeg")
    except ImportError:
        raise FileError(
            f"cannot write {path}: MP4 needs the Python package imageio-ffmpeg "
            "(pip install 'litz[video]' or pip install imageio-ffmpeg); .gif needs nothing more"
        ) from None


_WRITERS = {".gif": _write_gif, ".mp4": _write_mp4}

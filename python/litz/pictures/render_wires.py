"""Draws tubes with VTK into pictures, as a program of its own.

`litz.pictures.wire_picture` starts it by `python render_wires.py FOLDER`, which makes FOLDER/0.png of FOLDER/0.npz, and so on:
where no OpenGL is installed, VTK ends the whole process, which must not be the user's.
"""

import itertools
import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pyvista as pv


def main(folder: str) -> None:
    """Read the jobs, draw, write the pictures."""
    for job in sorted(Path(folder).glob("*.npz")):
        draw(np.load(job), job.with_suffix(".png"))


def draw(job: Mapping[str, np.ndarray], picture: Path) -> None:
    """Draw one job."""
    width, height = (int(n) for n in job["size"])
    plotter = pv.Plotter(off_screen=True, window_size=(width, height), lighting="none")
    plotter.set_background("white")
    add_lights(plotter, job)
    plotter.enable_anti_aliasing("ssaa")

    points, starts, radius, value = with_round_ends(job["points"], job["starts"], job["radius"], job["value"])
    tubes = polylines(points, starts)
    tubes["radius"], tubes["value"] = radius, value
    # the tube filter gives normals, also to the caps, which are too small to be seen
    plotter.add_mesh(
        tubes.tube(scalars="radius", absolute=True, n_sides=int(job["sides"]), capping=True),
        scalars="value", cmap=str(job["colours"]), clim=tuple(job["limits"]), show_scalar_bar=False,
        smooth_shading=True, ambient=0.25, diffuse=0.8, specular=0.35, specular_power=25,
    )  # fmt: skip
    if len(job["reference_starts"]) > 1:
        lines = polylines(job["reference"], job["reference_starts"])
        plotter.add_mesh(lines, color="#9a9a9a", line_width=1.5, lighting=False)
    if len(job["surface_quads"]):
        add_surfaces(plotter, job)

    camera = plotter.camera
    camera.focal_point = tuple(job["centre"])
    camera.position = tuple(job["centre"] + job["toward"] * job["distance"])
    camera.up = tuple(job["up"])
    camera.parallel_projection = True
    camera.parallel_scale = float(job["half_height"])
    plotter.reset_camera_clipping_range()
    plotter.screenshot(str(picture))
    plotter.close()


def add_surfaces(plotter: pv.Plotter, job: Mapping[str, np.ndarray]) -> None:
    """Rigid surfaces, half transparent, with their edges as lines."""
    colour, opacity = str(job["surface_colour"]), float(job["surface_opacity"])
    quads, rim = job["surface_quads"], job["surface_rim"]
    faces = pv.PolyData(job["surface_points"], np.column_stack([np.full(len(quads), 4), quads]).ravel())
    plotter.add_mesh(faces, color=colour, opacity=opacity, ambient=0.5, diffuse=0.5, show_edges=False)
    lines = pv.PolyData()
    lines.points = job["surface_points"]
    lines.lines = np.column_stack([np.full(len(rim), 2), rim]).ravel()
    plotter.add_mesh(lines, color=colour, line_width=1.5, lighting=False)


def polylines(points: np.ndarray, starts: np.ndarray) -> pv.PolyData:
    """Lines through points; `starts` has the first point of each and, at its end, the number of points."""
    cells = [np.concatenate(([stop - start], np.arange(start, stop))) for start, stop in itertools.pairwise(starts)]
    lines = pv.PolyData()
    lines.points = points
    lines.lines = np.concatenate(cells)
    return lines


def with_round_ends(
    points: np.ndarray, starts: np.ndarray, radius: np.ndarray, value: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Lines as in `polylines`, continued at both ends by half spheres: a tube whose radius decreases to almost nothing."""
    angles = np.radians([18.0, 36.0, 54.0, 70.0, 82.0, 89.0])
    along, across = np.sin(angles), np.cos(angles)
    pieces = []
    for start, stop in itertools.pairwise(starts):
        for end, neighbour, order in ((start, start + 1, -1), (stop - 1, stop - 2, 1)):
            outward = points[end] - points[neighbour]
            outward /= np.linalg.norm(outward)
            cap = (
                points[end] + radius[end] * along[:, None] * outward,
                radius[end] * across,
                np.full(len(along), value[end]),
            )
            pieces.append([column[::order] for column in cap])
        pieces.insert(-1, [points[start:stop], radius[start:stop], value[start:stop]])
    columns = [np.concatenate(column) for column in zip(*pieces, strict=True)]
    return columns[0], starts + 2 * len(along) * np.arange(len(starts)), columns[1], columns[2]


def add_lights(plotter: pv.Plotter, job: Mapping[str, np.ndarray]) -> None:
    """A strong light from the upper left of the viewer and a weak one from the right."""
    toward, up = job["toward"], job["up"]
    right = np.cross(up, toward)
    for direction, intensity in ((toward + 0.7 * up - 0.6 * right, 0.85), (toward - 0.1 * up + 0.9 * right, 0.35)):
        position = job["centre"] + direction * job["distance"]
        plotter.add_light(pv.Light(position=tuple(position), focal_point=tuple(job["centre"]), intensity=intensity))


if __name__ == "__main__":
    main(*sys.argv[1:])

"""Pictures where VTK does not find its OpenGL by itself."""

import sys

from litz import plot
from litz.pictures import wire_picture


def test_vtk_is_asked_to_take_osmesa_after_a_crash(results, tmp_path, monkeypatch, recwarn):
    picky = tmp_path / "picky"
    picky.write_text(f'#!/bin/sh\n[ "$VTK_DEFAULT_OPENGL_WINDOW" ] || kill -SEGV $$\nexec {sys.executable} "$@"\n')
    picky.chmod(0o755)
    asked = []
    run = wire_picture.subprocess.run
    monkeypatch.setattr(wire_picture.sys, "executable", str(picky))
    monkeypatch.setattr(wire_picture.subprocess, "run", lambda *a, **k: asked.append(k["env"]) or run(*a, **k))
    assert plot(results, "wires", tmp_path / "picture.png").stat().st_size > 10_000
    assert asked[0] is None
    assert asked[1]["VTK_DEFAULT_OPENGL_WINDOW"] == "vtkOSOpenGLRenderWindow"

"""The process in which VTK draws: where it does not find its OpenGL by itself, and where it is started early."""

import subprocess
import sys

import pytest

from litz import plot
from litz.pictures import drawing_process


def test_vtk_is_asked_to_take_osmesa_after_a_crash(results, tmp_path, monkeypatch, recwarn):
    picky = tmp_path / "picky"
    picky.write_text(f'#!/bin/sh\n[ "$VTK_DEFAULT_OPENGL_WINDOW" ] || kill -SEGV $$\nexec {sys.executable} "$@"\n')
    picky.chmod(0o755)
    asked = []
    run = drawing_process.run
    monkeypatch.setattr(drawing_process.sys, "executable", str(picky))
    monkeypatch.setattr(
        drawing_process, "run", lambda folder, longest, env, look: asked.append(env) or run(folder, longest, env, look)
    )
    assert plot(results, "wires", tmp_path / "picture.png").stat().st_size > 10_000
    assert asked[0] is None
    assert asked[1]["VTK_DEFAULT_OPENGL_WINDOW"] == "vtkOSOpenGLRenderWindow"


@pytest.fixture
def started(monkeypatch):
    """The processes that are started, in their order."""
    processes, start = [], drawing_process._start
    monkeypatch.setattr(drawing_process, "_start", lambda env: processes.append(start(env)) or processes[-1])
    return processes


def test_a_process_that_is_ready_makes_the_first_pictures_alone(results, tmp_path, started):
    with drawing_process.ready():
        assert len(started) == 1
        plot(results, "wires", tmp_path / "first.png")
        assert len(started) == 1
        plot(results, "wires", tmp_path / "second.png")
        assert len(started) == 2
    assert (tmp_path / "first.png").read_bytes() == (tmp_path / "second.png").read_bytes()


def test_a_process_that_is_of_no_use_ends(started):
    with pytest.raises(ZeroDivisionError), drawing_process.ready():
        raise ZeroDivisionError
    assert started[0].returncode is not None


def test_a_process_that_does_not_answer_is_ended(tmp_path, started, monkeypatch):
    idle = tmp_path / "idle"
    idle.write_text("#!/bin/sh\nexec sleep 60\n")
    idle.chmod(0o755)
    monkeypatch.setattr(drawing_process.sys, "executable", str(idle))
    with pytest.raises(subprocess.TimeoutExpired):
        drawing_process.run(str(tmp_path), 0.1)
    assert started[0].returncode is not None

"""From the sources to an archive, from the archive to a wheel, from the wheel to a run in a clean environment."""

import os
import shutil
import subprocess
import sys
import tarfile
import venv
import zipfile
from pathlib import Path

import numpy
import pytest

from documents import ROOT, copy_of_the_sources

pytestmark = [
    pytest.mark.skipif(shutil.which("git") is None, reason="the archive is made of what git has: needs git"),
    # the wheel is a whole compilation
    pytest.mark.slow,
]


def call(*command, **options):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=900, check=False, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """The sources as a repository of their own."""
    folder = copy_of_the_sources(tmp_path_factory.mktemp("sources"))
    call("git", "init", "--quiet", cwd=folder)
    call("git", "add", "--all", cwd=folder)
    author = ["-c", "user.name=test", "-c", "user.email=test@localhost"]
    call("git", *author, "commit", "--quiet", "--message", "sources", cwd=folder)
    return folder


@pytest.fixture(scope="module")
def archive(sources, tmp_path_factory):
    """The archive of the sources."""
    folder = tmp_path_factory.mktemp("archive")
    call(sys.executable, "-c", f"import mesonpy; mesonpy.build_sdist({str(folder)!r})", cwd=sources)
    (path,) = folder.glob("litz-*.tar.gz")
    return path


@pytest.fixture(scope="module")
def wheel(archive, tmp_path_factory):
    """The wheel that pip builds from the archive; without optimisation, which takes most of the time."""
    folder = tmp_path_factory.mktemp("wheel")
    options = [
        "--no-deps",
        "--no-build-isolation",
        "--wheel-dir",
        folder,
        "--config-settings=setup-args=-Doptimization=0",
    ]
    call(sys.executable, "-m", "pip", "wheel", *options, archive)
    (path,) = folder.glob("litz-*.whl")
    return path


@pytest.fixture(scope="module")
def clean_environment(wheel, tmp_path_factory):
    """An environment with the wheel, which borrows the packages that litz depends on from the one of the tests."""
    folder = tmp_path_factory.mktemp("clean") / "environment"
    venv.create(folder)
    commands = folder / "bin"
    call(sys.executable, "-m", "pip", "--python", commands / "python", "install", "--no-deps", "--no-index", wheel)
    packages = Path(call(commands / "python", "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip())
    # a path in a .pth file comes last, and .pth files in it, as that of an editable litz, are not read
    (packages / "borrowed.pth").write_text(f"{Path(numpy.__file__).parents[1]}\n", encoding="utf-8")
    return commands


@pytest.fixture
def plain():
    """The environment of processes, without what leads to another litz."""
    return {key: value for key, value in os.environ.items() if not key.startswith(("LITZ_", "PYTHON"))}


def test_the_archive_has_what_git_has(sources, archive):
    tracked = set(call("git", "ls-files", cwd=sources).split("\n")) - {""}
    with tarfile.open(archive) as file:
        packed = {member.name.partition("/")[2] for member in file if member.isfile()}
    assert tracked <= packed
    assert packed - tracked == {"PKG-INFO"}


def test_the_wheel_has_the_program_the_extension_and_every_file_of_the_package(wheel):
    with zipfile.ZipFile(wheel) as file:
        modes = {info.filename: info.external_attr >> 16 for info in file.infolist()}
    assert modes["litz/_bin/litz"] & 0o111
    assert [name for name in modes if name.startswith("litz/_core.") and name.endswith(".so")]
    package = ROOT / "python" / "litz"
    files = {path.relative_to(package.parent) for path in package.rglob("*") if path.is_file()}
    wanted = {str(path) for path in files if path.suffix != ".so" and "__pycache__" not in path.parts}
    assert wanted <= set(modes)
    assert not [name for name in modes if "__pycache__" in name]


def test_the_installed_litz_runs_a_deck(clean_environment, plain, tmp_path):
    litz = clean_environment / "litz"
    versions = call(litz, "--version", env=plain)
    call(litz, "run", ROOT / "inputs" / "05_clamped_pair.inp", "-o", tmp_path, "--quiet", env=plain)
    assert (tmp_path / "05_clamped_pair.vtkhdf").is_file()
    assert "contact force" in call(litz, "table", tmp_path, env=plain)
    code = "import litz; print(litz.__version__, litz.__file__, litz.kernels.contact_spot.__module__)"
    version, place, _ = call(clean_environment / "python", "-c", code, env=plain, cwd=tmp_path).split()
    assert versions.startswith(f"litz {version}\n")
    assert place.startswith(str(clean_environment.parent))


def test_the_version_names_compiler_and_libraries(clean_environment, plain):
    shown = dict(line.split(": ") for line in call(clean_environment / "litz", "--version", env=plain).splitlines()[1:])
    assert set(shown) == {"compiler", "HDF5", "BLAS", "solver libraries", "solvers"}
    for what in ("compiler", "HDF5", "solver libraries"):
        assert shown[what] == "none" or any(sign.isdigit() for sign in shown[what]), what

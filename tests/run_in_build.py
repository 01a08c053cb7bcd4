"""Runs pytest against a build directory without installing it (`meson test`)."""

import argparse
import os
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

# meson's exit code of a test that cannot be run here
SKIPPED = 77


def main():
    """Lay the package out by links, put it first on the module path, hand over to pytest."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("package", "extension", "program", "stage"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    arguments, pytest_arguments = parser.parse_known_args()
    if find_spec("pytest") is None:
        print(f"pytest is not installed in {sys.executable}: the Python tests are skipped")
        return SKIPPED

    package = arguments.stage / "litz"
    shutil.rmtree(arguments.stage, ignore_errors=True)
    (package / "_bin").mkdir(parents=True)
    for source in arguments.package.resolve().iterdir():
        if source.suffix != ".so" and source.name != "__pycache__":
            (package / source.name).symlink_to(source)
    (package / arguments.extension.name).symlink_to(arguments.extension.resolve())
    (package / "_bin" / "litz").symlink_to(arguments.program.resolve())

    paths = [str(arguments.stage.resolve()), os.environ.get("PYTHONPATH", "")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))}
    return subprocess.run([sys.executable, "-m", "pytest", *pytest_arguments], env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())

"""What the fuzz tests share: the program that reads decks in a loop."""

import shutil
import subprocess

import pytest


@pytest.fixture(scope="session")
def read_decks(litz_program):
    """Built in the build directory that the program comes from."""
    build = litz_program.resolve().parents[1]
    if not (build / "build.ninja").is_file() or shutil.which("ninja") is None:
        pytest.skip(f"{build} is no build directory: the program that reads decks in a loop is not there")
    subprocess.run(["ninja", "-C", build, "tests/read_decks"], check=True, capture_output=True)
    return build / "tests" / "read_decks"

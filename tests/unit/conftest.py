"""What the unit tests share: result files of a made-up run."""

import shutil
import subprocess

import pytest

import litz


@pytest.fixture(scope="session")
def writer(litz_program):
    """The Fortran test program, from the build directory that the program comes from."""
    build = litz_program.resolve().parents[1]
    if not (build / "build.ninja").is_file() or shutil.which("ninja") is None:
        pytest.skip(f"{build} is no build directory: the Fortran test program is not there")
    subprocess.run(["ninja", "-C", build, "tests/test_results"], check=True, capture_output=True)
    return build / "tests" / "test_results"


@pytest.fixture(scope="session")
def written(writer, tmp_path_factory):
    """Directory with the files of the complete run."""
    directory = tmp_path_factory.mktemp("results") / "made" / "on the way"
    done = subprocess.run([writer, directory], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    return directory


@pytest.fixture
def results(written):
    return litz.Results(written / "crossed.vtkhdf")

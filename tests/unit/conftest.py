"""What the unit tests share: result files of a made-up run."""

import subprocess

import pytest

import litz


@pytest.fixture(scope="session")
def writer(build_target):
    """The Fortran test program that writes them."""
    return build_target("tests/test_results")


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

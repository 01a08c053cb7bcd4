"""OpenBLAS works with the vectors that the processor has, also where it does not know the processor."""

import os
import subprocess
from pathlib import Path

import pytest

#: Kernels without vectors of 256 bits, which OpenBLAS takes for a processor that it does not know
OLDEST = {"Katmai", "Prescott", "Barcelona", "Nehalem", "Generic"}
#: What the program sets where the user has not, and then starts once more
CHOSEN = ("OPENBLAS_CORETYPE", "OMP_WAIT_POLICY")


def kernels(litz_program, **environment):
    """What `litz --version` says of the kernels of the BLAS."""
    inherited = {name: value for name, value in os.environ.items() if name not in CHOSEN}
    run = subprocess.run(
        [litz_program, "--version"], capture_output=True, text=True, check=True, env=inherited | environment
    )
    blas = next(line for line in run.stdout.splitlines() if line.startswith("BLAS: "))
    if "DYNAMIC_ARCH" not in blas:
        pytest.skip(f"this BLAS has no choice of kernels: {blas}")
    return set(blas.split())


def test_wide_vectors_are_used(litz_program):
    processor = Path("/proc/cpuinfo")
    if not processor.exists() or not {"avx2", "fma"} <= set(processor.read_text(encoding="utf-8").split()):
        pytest.skip("the processor has no vectors of 256 bits, or does not say so")
    assert not kernels(litz_program) & OLDEST


def test_the_choice_of_the_user_stays(litz_program):
    assert "Prescott" in kernels(litz_program, OPENBLAS_CORETYPE="Prescott")


def test_the_arguments_are_kept(litz_program):
    environment = {name: value for name, value in os.environ.items() if name not in CHOSEN}
    run = subprocess.run(
        [litz_program, "check", "two words"], capture_output=True, text=True, check=False, env=environment
    )
    assert run.returncode == 4
    assert '"two words" does not exist' in run.stderr

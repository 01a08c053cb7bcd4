"""Other programs: each in an environment of its own, made from the Python package index on first use.

The scripts of this folder but this one are run by the interpreters of these environments; they see nothing of litz.
"""

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from verification import environments
from verification.performance.process import Run, blas_kernels, run_process

#: Packages of each program
PACKAGES = {
    "OpenSeesPy": ("numpy", "openseespy"),
    "Kratos": (
        "numpy",
        "KratosMultiphysics",
        "KratosStructuralMechanicsApplication",
        "KratosLinearSolversApplication",
        "KratosConstitutiveLawsApplication",
    ),
    "Exudyn": ("numpy", "exudyn"),
}


@dataclass(frozen=True)
class PeerRun:
    """What came of one run of another program."""

    run: Run
    #: What its script printed: seconds, iterations of each increment, reaction, whether it finished; None: it failed
    result: dict | None

    @property
    def finished(self):
        return self.result is not None and self.result["finished"]


def interpreter(name):
    """Python of a program's environment, which is made when it is not there."""
    return environments.interpreter(f"peers/{name.lower()}", name, PACKAGES[name])


def version(name):
    """Version of a program's main package."""
    code = "import sys; from importlib.metadata import version; print(version(sys.argv[1]))"
    done = subprocess.run(
        [interpreter(name), "-c", code, PACKAGES[name][1]], capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


def write_frame(path, **arrays):
    """The problem file that all scripts read; see frame.py."""
    np.savez(path, **arrays)


def run_peer(name, problem, *options, limit=600.0):
    """Run a program's script on a problem; it stops by itself after `limit` seconds, and is ended after twice that."""
    script = Path(__file__).with_name(f"{name.lower()}_frame.py")
    command = [interpreter(name), script, problem, limit, *options]
    run = run_process(command, limit=2 * limit, environment=blas_kernels())
    result = None
    for line in run.printed.splitlines():
        if line.startswith('{"seconds"'):
            result = json.loads(line)
    return PeerRun(run, result if run.code == 0 else None)

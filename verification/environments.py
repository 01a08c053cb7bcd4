"""Python environments for programs that litz is not to share its own with, made from the Python package index on first use."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def interpreter(folder, name, packages):
    """Python of the environment `folder` (below .venv), which is made when it is not there.

    `name` is what the environment is for, in words; `packages` are those to install in it. It is made again when the list has
    changed.
    """
    environment = ROOT / ".venv" / folder
    python = environment / "bin" / "python"
    ready = environment / "ready"
    wanted = "\n".join(packages)
    if not ready.exists() or ready.read_text() != wanted:
        print(f"making an environment for {name} ...", flush=True)
        for command in (
            [sys.executable, "-m", "venv", "--clear", environment],
            [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *packages],
        ):
            done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise RuntimeError(f"{name} could not be installed: {done.stderr.strip().splitlines()[-1]}")
        ready.write_text(wanted)
    return python

"""Builds the documentation: Sphinx for the pages, FORD for the Fortran sources. `./setup docs` runs it.

    python docs/site/build.py [-o DIRECTORY]

Exit code 0: everything was built, without a warning, every link inside the site leads somewhere, no page needs a network, and
MathJax can read every equation; to find that out, a Chromium with chromedriver must be there.
"""

import argparse
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

SITE = Path(__file__).parent
ROOT = SITE.parents[1]
sys.path.insert(0, str(ROOT))

from verification.environments import interpreter  # noqa: E402

PACKAGES = ("sphinx", "furo", "myst-parser", "sphinx-copybutton", "sphinx-mathjax-offline", "ford", "bootstrap-flask")


def build(directory):
    """Build the site into a directory, which is replaced. Returns the exit code of the first program that fails, or 0."""
    python = interpreter("docs", "the documentation", PACKAGES)
    # The pages of the Python package are made from the package as it is installed here, with what it needs.
    own = os.pathsep.join([sysconfig.get_path("platlib"), os.environ.get("PYTHONPATH", "")])
    shutil.rmtree(directory, ignore_errors=True)
    doctrees = directory.parent / f"{directory.name}.doctrees"
    sphinx = [python, "-m", "sphinx", "-W", "--keep-going", "-q", "-c", SITE, "-d", doctrees, ROOT / "docs", directory]
    ford = [python, "-m", "ford", "-q", "-o", directory / "fortran", SITE / "ford.md"]
    offline = [python, SITE / "offline.py", directory / "fortran"]
    links = [python, SITE / "links.py", directory]
    equations = [sys.executable, SITE / "equations.py", directory]
    for command in (sphinx, ford, offline, links, equations):
        environment = {**os.environ, "PYTHONPATH": own} if command is sphinx else os.environ
        done = subprocess.run(list(map(str, command)), env=environment, check=False)
        if done.returncode != 0:
            return done.returncode
    shutil.rmtree(doctrees)
    return 0


def main():
    """Read the arguments, build, say where the site is."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "results" / "docs", metavar="DIRECTORY")
    arguments = parser.parse_args()
    code = build(arguments.output.resolve())
    if code == 0:
        print(f"documentation: {arguments.output / 'index.html'}")
    return code


if __name__ == "__main__":
    raise SystemExit(main())

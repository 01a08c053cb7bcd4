"""Builds litz with checks that a user's build leaves out, and runs the tests with it.

    traps      bounds, uninitialised numbers, invalid operations, divisions by zero and overflows end the program
    address    AddressSanitizer, leaks included, and UndefinedBehaviorSanitizer, in the program and the Python extension
    valgrind   memcheck over the Fortran tests and some decks: a small part, because it is slow

The Python extension is left out of `traps`, because numpy and its libraries divide by zero on purpose. Each build has a
directory of its own. Nothing is suppressed: a finding is cured in the sources.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).parents[2]
#: Tests that run the program or Fortran test programs
PROGRAM_TESTS = ("tests/system", "tests/fuzz", "tests/unit/test_results.py", "tests/unit/test_deck_reader.py")
#: Tests of the kernels through the extension
EXTENSION_TESTS = (
    "tests/unit/test_beams.py", "tests/unit/test_closest_points.py", "tests/unit/test_conductor.py",
    "tests/unit/test_contact_search.py", "tests/unit/test_contact_spot.py", "tests/unit/test_rotations.py",
    "tests/unit/test_contact_em.py", "tests/unit/test_line_law.py", "tests/unit/test_line_point.py",
)  # fmt: skip
#: What these checks cannot be used with, and why
LEFT_OUT = {
    "traps": (
        "--ignore=tests/system/test_verification.py",
    ),  # measures claims, some of them about time, with Python's kernels
    "address": (
        "--ignore=tests/system/test_verification.py",
        "--ignore=tests/system/test_size_limits.py",  # limits the memory, of which the sanitizer needs terabytes of addresses
    ),
}
MESON_OPTIONS = {
    "traps": ("-Dpython=disabled", "-Dfortran_args=['-ffpe-trap=invalid,zero,overflow', '-O1']"),
    "address": ("-Db_sanitize=address,undefined", "-Db_lundef=false", "-Dfortran_args=-O1", "-Dc_args=-O1"),
    "valgrind": ("-Dpython=disabled", "-Dfortran_args=-O1"),
}
#: Decks under valgrind: contacts with and without friction, elastic contacts, both elements, every solver
VALGRIND_DECKS = (
    ("01_crossed_wires",), ("03_large_sliding",), ("05_clamped_pair", "--solver", "umfpack"),
    ("06_supported_pair", "--solver", "skyline"), ("08_elastica",), ("13_stick_slip",),
)  # fmt: skip
VALGRIND = (
    "valgrind", "--quiet", "--error-exitcode=99", "--leak-check=full", "--errors-for-leak-kinds=definite",
    "--show-leak-kinds=definite",
)  # fmt: skip


def run(*command: object, **environment: str) -> bool:
    """Run a command in the source directory; say whether it succeeded."""
    words = [str(word) for word in command]
    print("+", " ".join(words), flush=True)
    return subprocess.run(words, cwd=ROOT, env=os.environ | environment, check=False).returncode == 0


def build(kind: str, place: Path) -> Path:
    """The build directory, with everything in it that the tests need."""
    directory = place / kind
    if not (directory / "build.ninja").is_file():
        shutil.rmtree(directory, ignore_errors=True)
        done = run("meson", "setup", directory, "--buildtype=debug", *MESON_OPTIONS[kind])
        if not done:
            sys.exit(f"the build directory {directory} cannot be set up")
    if not run("ninja", "-C", directory, "--quiet", "all", "tests/read_decks", "tests/test_results"):
        sys.exit(f"litz does not compile in {directory}")
    return directory


def run_pytest(directory: Path, *arguments: str, **environment: str) -> bool:
    paths = os.pathsep.join(str(ROOT / path) for path in ("python", "tests/system", "tests/unit", "."))
    environment = {"LITZ_PROGRAM": str(directory / "fortran" / "litz"), "LITZ_BUILD": str(directory)} | environment
    environment = {"PYTHONPATH": paths} | environment
    return run(sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments, **environment)


def check_traps(directory: Path) -> bool:
    fortran = run("meson", "test", "-C", directory, "--suite", "fortran", "--print-errorlogs")
    return run_pytest(directory, *PROGRAM_TESTS, *LEFT_OUT["traps"]) and fortran


def check_address(directory: Path) -> bool:
    """The tests load other libraries before the program, which the sanitizer would object to."""
    options = {
        "ASAN_OPTIONS": "verify_asan_link_order=0:detect_leaks=1",
        "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1",
    }
    fortran = run("meson", "test", "-C", directory, "--suite", "fortran", "--print-errorlogs", **options)
    program = run_pytest(directory, *PROGRAM_TESTS, *LEFT_OUT["address"], **options)
    return check_extension(directory, options) and fortran and program


def check_extension(directory: Path, options: dict[str, str]) -> bool:
    """The kernels, called from Python: the sanitizers are loaded before it. What Python itself keeps is no leak of litz."""
    libraries = [
        subprocess.run(["gcc", f"-print-file-name={name}"], capture_output=True, text=True, check=True).stdout.strip()
        for name in ("libasan.so", "libubsan.so")
    ]
    with tempfile.TemporaryDirectory() as name:
        stage = Path(name)
        shutil.copytree(ROOT / "python" / "litz", stage / "litz", ignore=shutil.ignore_patterns("*.so", "__pycache__"))
        (extension,) = (directory / "python").glob("_core*.so")
        shutil.copy(extension, stage / "litz")
        paths = os.pathsep.join(str(path) for path in (stage, ROOT / "tests" / "unit", ROOT))
        return run_pytest(
            directory, *EXTENSION_TESTS, **options | {
                "PYTHONPATH": paths, "LD_PRELOAD": " ".join(libraries),
                "ASAN_OPTIONS": "verify_asan_link_order=0:detect_leaks=0",
            },
        )  # fmt: skip


def check_valgrind(directory: Path) -> bool:
    """One thread: memcheck runs one at a time anyway. With these choices made, the program does not start itself again."""
    environment = {
        "OMP_NUM_THREADS": "1",
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_WAIT_POLICY": "passive",
        "OPENBLAS_CORETYPE": "Haswell",
    }
    wrapper = " ".join(VALGRIND)
    good = run(
        "meson", "test", "-C", directory, "--suite", "fortran", "--print-errorlogs", "--timeout-multiplier", "20",
        "--wrapper", wrapper, **environment,
    )  # fmt: skip
    with tempfile.TemporaryDirectory() as output:
        for name, *options in VALGRIND_DECKS:
            deck = ROOT / "inputs" / f"{name}.inp"
            good &= run(
                *VALGRIND, directory / "fortran" / "litz", "run", deck, "--quiet", "-o", output, *options, **environment
            )
    return good


CHECKS: dict[str, Callable[[Path], bool]] = {
    "traps": check_traps,
    "address": check_address,
    "valgrind": check_valgrind,
}


def main() -> int:
    """Run the checks that are named, or all; each ends with a line that says how it went."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checks", nargs="*", metavar="CHECK", help="traps, address, valgrind; all without a name")
    parser.add_argument("--builds", type=Path, default=ROOT / ".venv" / "checked", help="where the builds are")
    arguments = parser.parse_args()
    unknown = set(arguments.checks) - set(CHECKS)
    if unknown:
        parser.error(f"there is no check {', '.join(sorted(unknown))}; there are {', '.join(CHECKS)}")
    results = {}
    for kind in arguments.checks or CHECKS:
        results[kind] = CHECKS[kind](build(kind, arguments.builds.resolve()))
    for kind, good in results.items():
        print(f"{kind}: {'nothing found' if good else 'FAILED, see above'}")
    return 0 if all(results.values()) else 1


if __name__ == "__main__":
    sys.exit(main())

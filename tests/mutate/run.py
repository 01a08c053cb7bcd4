"""Do the tests find faults? Puts those of faults.toml into a copy of the sources, one at a time: ./setup mutate

With each of them the tests that the catalogue names are run, and if they pass the quick tests. At least 95 % of the faults
must be found; those that are not are listed with the reason that the catalogue gives.
"""

import argparse
import sys
from pathlib import Path

from catalogue import CATALOGUE, ROOT, CatalogueError, read_catalogue
from scratch import Scratch
from verdicts import judge, report


def main() -> int:
    """List the faults, or try them; exit code 1 when too few are found."""
    parser = argparse.ArgumentParser(
        prog="mutate", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--module", action="append", metavar="NAME", help="only faults of this file, with or without ending"
    )
    parser.add_argument("--list", action="store_true", help="only list the faults")
    parser.add_argument(
        "--place", type=Path, default=ROOT / ".venv" / "mutate", help="where the copy and its build are"
    )
    arguments = parser.parse_args()
    quick, faults = read_catalogue()
    if arguments.module:
        faults = [fault for fault in faults if {fault.file, Path(fault.file).stem} & set(arguments.module)]
    if not faults:
        parser.error(f"there is no fault in {', '.join(arguments.module)}")
    try:
        for fault in faults:
            fault.put_into(fault.path().read_text(encoding="utf-8"))
    except CatalogueError as error:
        sys.exit(f"{error}\nmend the catalogue, {CATALOGUE}")
    if arguments.list:
        print("\n".join(fault.name for fault in faults))
        return 0

    scratch = Scratch(arguments.place.resolve())
    if not scratch.compiles():
        sys.exit(f"litz does not compile in {scratch.build}, without any fault")
    failure = scratch.first_failure(sorted({test for fault in faults for test in fault.tests} | set(quick)))
    if failure:
        sys.exit(f"a test fails without any fault: {failure}")
    verdicts = []
    for number, fault in enumerate(faults, 1):
        verdicts.append(judge(fault, scratch, quick))
        _, verdict, by, seconds = verdicts[-1]
        print(f"{number:3} of {len(faults)}: {verdict} in {seconds:.0f} s, {fault.name}{by and f' [{by}]'}", flush=True)
    lines, enough = report(verdicts)
    print("\n" + "\n".join(lines))
    return 0 if enough else 1


if __name__ == "__main__":
    sys.exit(main())

"""Do wires pass through each other with exit code 0? Runs random decks: ./setup passages --count 2000 --seed 1

Prints how the cases ended, by family; decks of failures are kept in results/passages. One case again, with what the judge finds:
python tests/property/run.py --case thread-3. Failures of the last run again: ./setup passages --again
"""

import argparse
import importlib.resources
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from random_decks import FAMILIES, deck_of, names
from trials import FAILURES, table, try_all, try_case, try_deck

ROOT = Path(__file__).parents[2]


def find_program(named):
    """The program that is asked for, or that of the installed package.

    In place of the command of an environment that ./setup made, what it starts: the command looks at each start whether
    there is something to compile, which runs side by side must not do.
    """
    program = named or Path(str(importlib.resources.files("litz") / "_bin" / "litz"))
    built = program.absolute().parents[1] / "build" / "fortran" / "litz"
    if program.is_file() and program.read_bytes()[:2] == b"#!" and built.is_file():
        program = built
    if not program.is_file():
        sys.exit(f"there is no program {program}")
    return program.resolve()


def progress(trial):
    """A failure is shown at once, by its first finding."""
    if trial.verdict in FAILURES:
        print(f"{trial.name}: {trial.verdict}; {(trial.findings or [trial.message])[0]}", flush=True)


def forget(keep):
    """Decks that an earlier run kept go."""
    for kind in FAMILIES:
        for path in [*keep.glob(f"{kind}-*.inp"), *keep.glob(f"{kind}-*.txt")]:
            path.unlink()


def main():
    parser = argparse.ArgumentParser(
        prog="passages", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=2000, help="number of cases (2000)")
    parser.add_argument(
        "--seed", type=int, default=0, help="another seed, other cases (0: those of the test suite first)"
    )
    parser.add_argument("--family", action="append", choices=FAMILIES, help="cases of these families only")
    parser.add_argument("--case", metavar="FAMILY-NUMBER or DECK", help="one case, or a deck")
    parser.add_argument("--again", action="store_true", help="the failures of the last run, from cases.txt of --keep")
    parser.add_argument("--litz", type=Path, metavar="PATH", help="the program to run; that of this folder without")
    parser.add_argument("--jobs", type=int, help="runs at a time; as many as processors without")
    parser.add_argument("--limit", type=float, default=60.0, help="seconds of a run (60)")
    parser.add_argument(
        "--keep", type=Path, default=ROOT / "results" / "passages", help="where failed decks go (results/passages)"
    )
    parser.add_argument("--write", action="store_true", help="only write the deck of --case, to the standard output")
    arguments = parser.parse_args()
    program = find_program(arguments.litz)
    if arguments.case:
        deck = Path(arguments.case)
        if arguments.write:
            print(deck_of(arguments.case))
            return 0
        if deck.suffix == ".inp":
            trial = try_deck(deck.stem, deck.read_text(), program, limit=arguments.limit)
        else:
            trial = try_case(arguments.case, program, arguments.keep, arguments.limit)
        print(trial)
        return int(trial.verdict in FAILURES)
    if arguments.again:
        ended = (line.split()[:2] for line in (arguments.keep / "cases.txt").read_text().splitlines())
        cases = [name for name, verdict in ended if verdict in FAILURES]
    elif arguments.family:
        each = -(-arguments.count // len(arguments.family))
        cases = [f"{kind}-{arguments.seed * each + k}" for kind in arguments.family for k in range(each)]
    else:
        cases = names(arguments.count, arguments.seed)
    forget(arguments.keep)
    trials = try_all(cases, program, arguments.keep, arguments.jobs, arguments.limit, progress)
    arguments.keep.mkdir(parents=True, exist_ok=True)
    (arguments.keep / "cases.txt").write_text(
        "".join(f"{trial.name} {trial.verdict} {trial.message}\n" for trial in trials)
    )
    lines = table(trials)
    (arguments.keep / "table.txt").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    return int(any(trial.verdict in FAILURES for trial in trials))


if __name__ == "__main__":
    sys.exit(main())

"""Measure the claims and write the report.

    python -m verification.run [--quick] [--claims FILE] [-o DIRECTORY] [CASE ...]

Exit code 0: every claim holds; 1: there is a miss; 2: wrong arguments or a claim that cannot stand.
"""

import argparse
import importlib
import sys
import time
import traceback
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import matplotlib

from verification.claims import CLAIMS, FOLDER, ClaimError, judge, missed, read_claims
from verification.report import write_reports
from verification.workspace import Workspace, two_processes


@dataclass
class CaseReport:
    """What came of one case."""

    name: str
    #: First lines of the script: what is verified, and the source
    title: str
    verdicts: list
    picture: Path | None
    seconds: float
    decks: list = field(default_factory=list)


def run_case(name, claims, directory, quick):
    """Measure one case and compare; whatever goes wrong is a miss with its message."""
    matplotlib.use("Agg")
    begin = time.monotonic()
    workspace = Workspace(directory / name, quick)
    wanted = [claim for claim in claims if claim.script == name and (claim.quick or not quick)]
    module = importlib.import_module(f"verification.cases.{name}")
    picture = workspace.directory / f"{name}.svg"
    try:
        values = module.measure(workspace)
        unknown = set(values) - {claim.id for claim in claims if claim.script == name} - {"figure"}
        if unknown:
            raise ClaimError(f"cases/{name}.py measures what claims.toml does not have: {', '.join(sorted(unknown))}")
        verdicts = [
            judge(claim, values[claim.id]) if claim.id in values else missed(claim, "was not measured")
            for claim in wanted
        ]
        if not quick:
            module.draw(values, picture)
    except Exception as error:  # a case that fails must not hide the others
        (workspace.directory / "failure.txt").write_text(traceback.format_exc(), encoding="utf-8")
        verdicts = [missed(claim, f"{type(error).__name__}: {error}") for claim in wanted]
    title = (module.__doc__ or name).strip()
    return CaseReport(
        name, title, verdicts, picture if picture.exists() else None, time.monotonic() - begin, workspace.decks
    )


def verify(names=(), *, quick=False, directory=Path("results/verification"), processes=2, claims_file=CLAIMS):
    """Run cases and return their reports, in the order of the claims."""
    claims = read_claims(claims_file)
    cases = list(dict.fromkeys(claim.script for claim in claims if claim.quick or not quick))
    if unknown := set(names) - set(cases):
        raise ClaimError(f"there is no case {', '.join(sorted(unknown))}; there are {', '.join(cases)}")
    if names:
        cases = [name for name in cases if name in names]
    directory = Path(directory).resolve()
    directory.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor(max_workers=processes, initializer=two_processes) as pool:
        pending = [pool.submit(run_case, name, claims, directory, quick) for name in cases]
        reports = []
        for future in pending:
            reports.append(future.result())
            _print_case(reports[-1])
    return reports


def _print_case(report):
    passed = sum(verdict.passed for verdict in report.verdicts)
    print(f"{report.name:<32} {passed:>3} of {len(report.verdicts):>3} claims hold  ({report.seconds:.1f} s)")
    for verdict in report.verdicts:
        if not verdict.passed:
            what = verdict.remark or f"difference {verdict.difference:.3g}, allowed {verdict.claim.tolerance:.3g}"
            print(f"   MISS {verdict.claim.id}: {what}")
    sys.stdout.flush()


def main(arguments=None):
    """Command line; returns the exit code."""
    parser = argparse.ArgumentParser(prog="verification", description="Measure the claims and write the report.")
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"scripts in {FOLDER.name}/cases; default: all")
    parser.add_argument("--quick", action="store_true", help="only the claims marked quick")
    parser.add_argument("-o", "--output", type=Path, default=Path("results/verification"), metavar="DIRECTORY")
    parser.add_argument("--claims", type=Path, default=CLAIMS, metavar="FILE", help="the list of claims")
    options = parser.parse_args(arguments)
    try:
        reports = verify(options.cases, quick=options.quick, directory=options.output, claims_file=options.claims)
    except ClaimError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    write_reports(reports, options.output)
    misses = sum(not verdict.passed for report in reports for verdict in report.verdicts)
    total = sum(len(report.verdicts) for report in reports)
    print(f"{total - misses} of {total} claims hold; the report is {options.output / 'report.html'}")
    return 1 if misses else 0


if __name__ == "__main__":
    sys.exit(main())

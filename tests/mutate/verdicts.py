"""Whether tests find a fault, and the report about all of them."""

import time
from typing import NamedTuple

from catalogue import Fault
from scratch import Scratch

#: Share of the faults that the tests have to find [%]
LEAST = 95.0
FOUND, SURVIVED, BROKEN = "found", "survived", "does not compile"


class Verdict(NamedTuple):
    """How it went with a fault: the verdict, what has found it, and seconds."""

    fault: Fault
    verdict: str
    by: str
    seconds: float


def judge(fault: Fault, scratch: Scratch, quick: list[str]) -> Verdict:
    """Put a fault in, run the tests, and take it out again."""
    begin = time.monotonic()
    path = fault.path(scratch.source)
    whole = path.read_text(encoding="utf-8")
    path.write_text(fault.put_into(whole), encoding="utf-8")
    try:
        if not scratch.compiles():
            return Verdict(fault, BROKEN, "", time.monotonic() - begin)
        by = scratch.first_failure(list(fault.tests)) or scratch.first_failure(quick)
    finally:
        path.write_text(whole, encoding="utf-8")
    return Verdict(fault, FOUND if by else SURVIVED, by, time.monotonic() - begin)


def report(verdicts: list[Verdict]) -> tuple[list[str], bool]:
    """Lines about each file and each fault that was not found, and whether enough were."""
    lines = [f"{'faults':>6} {'found':>6}  file"]
    for file in dict.fromkeys(verdict.fault.file for verdict in verdicts):
        of_file = [verdict.verdict for verdict in verdicts if verdict.fault.file == file]
        lines.append(f"{len(of_file):6} {of_file.count(FOUND):6}  {file}")
    for verdict in verdicts:
        if verdict.verdict == SURVIVED:
            lines.append(f"survives: {verdict.fault.name} ({verdict.fault.survives or 'a test is missing'})")
        elif verdict.verdict == BROKEN:
            lines.append(f"does not compile: {verdict.fault.name}")
        elif verdict.fault.survives:
            lines.append(f"is found, although it is said to survive: {verdict.fault.name}")
    found = sum(verdict.verdict == FOUND for verdict in verdicts)
    share = 100 * found / len(verdicts)
    lines.append(f"{found} of {len(verdicts)} faults found: {share:.1f} %, wanted are {LEAST:g} %")
    return lines, share >= LEAST

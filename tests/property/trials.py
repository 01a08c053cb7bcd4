"""Runs random decks, and lets the judge look at what ends with exit code 0."""

import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
from collections import Counter, defaultdict
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from random_decks import FAMILIES, deck_of
from wire_judge import judge, read

#: What a run may end with, other than 0: wrong input, or not converged
REFUSALS = (1, 2)
RIGHT, WRONG, DEEP, REFUSED, ODD, SLOW = "right", "wrong", "deep", "refused", "odd", "slow"
#: What must not be: exit code 0 with wires that passed or overlap unseen; with contacts that are too deep; another exit code
#: than those of a refusal, or one without words; no end in time
FAILURES = (WRONG, DEEP, ODD, SLOW)


@dataclass
class Trial:
    """A case, how its run ended, and what the judge found in its accepted increments."""

    name: str
    verdict: str
    code: int | None
    message: str = ""
    findings: list[str] = field(default_factory=list)
    doubts: list[str] = field(default_factory=list)
    kinds: list[str] = field(default_factory=list)
    seconds: float = 0.0
    judged: float = 0.0

    @property
    def family(self):
        return self.name.rsplit("-", 1)[0]

    def __str__(self):
        lines = [f"{self.name}: {self.verdict}, exit code {self.code}, {self.seconds:.2f} s and {self.judged:.2f} s"]
        if self.message:
            lines.append(f"  litz: {self.message}")
        return "\n".join(lines + [f"  {found}" for found in self.findings + self.doubts])


def first_words(text):
    """The first line of a message of the program."""
    for line in text.splitlines():
        if "error" in line.lower():
            return line.strip()
    return next((line.strip() for line in text.splitlines() if line.strip()), "")


def run_deck(program, deck, directory, limit):
    """Exit code (None: too slow), output and seconds of a run."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    begin = time.monotonic()
    process = subprocess.Popen(
        [str(program), "run", str(deck), "-o", str(directory), "--quiet"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        start_new_session=True,
    )
    try:
        output, errors = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        # what it has started ends with it
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, "", time.monotonic() - begin
    return process.returncode, errors or output, time.monotonic() - begin


def try_case(name, program, keep=None, limit=60.0):
    """Runs one case; decks with findings, and what is odd, are kept in the directory `keep`."""
    return try_deck(name, deck_of(name), program, keep, limit)


def try_deck(name, text, program, keep=None, limit=60.0):
    with tempfile.TemporaryDirectory(dir="/dev/shm" if Path("/dev/shm").is_dir() else None) as directory:
        deck = Path(directory) / "case.inp"
        deck.write_text(text)
        code, output, seconds = run_deck(program, deck, directory, limit)
        trial = Trial(name, SLOW, code, first_words(output) if code else "", seconds=seconds)
        results = Path(directory) / "case.vtkhdf"
        begin = time.monotonic()
        if results.exists() and code in (0, *REFUSALS):
            findings = judge(read(results))
            trial.findings = [str(found) for found in findings if not found.doubt]
            trial.doubts = [str(found) for found in findings if found.doubt]
            trial.kinds = sorted({found.kind for found in findings if not found.doubt})
        trial.judged = time.monotonic() - begin
        if code == 0:
            trial.verdict = {(): RIGHT, ("deep",): DEEP}.get(tuple(trial.kinds), WRONG) if results.exists() else WRONG
        elif code in REFUSALS and re.search(r"[a-z]{3,} [a-z]{2,}", trial.message):
            trial.verdict = REFUSED
        elif code is not None:
            trial.verdict = ODD
        if keep is not None and trial.verdict in FAILURES:
            keep.mkdir(parents=True, exist_ok=True)
            shutil.copy(deck, keep / f"{name}.inp")
            (keep / f"{name}.txt").write_text(f"{trial}\n")
    return trial


def try_all(cases, program, keep=None, jobs=None, limit=60.0, each=None):
    """All trials, in the order of the cases."""
    jobs = jobs or os.cpu_count() or 1
    trials = []
    with ProcessPoolExecutor(jobs) as pool:
        n = len(cases)
        for trial in pool.map(try_case, cases, [program] * n, [keep] * n, [limit] * n, chunksize=1):
            trials.append(trial)
            if each is not None:
                each(trial)
    return trials


# Tables


def kind_of_message(message):
    """The first sentence of a message without its numbers, so that those of one kind are the same."""
    words = re.sub(r"/\S+", "FILE", message)
    words = re.sub(r"[-+]?\d+(\.\d*)?([eE][-+]?\d+)?", "#", words)
    words = re.sub(r"^.*?did not converge .*?increment of #:", "did not converge:", words)
    words = re.sub(r",.*", "", words) if "residual" in words else words
    return words.split(". ")[0][:150]


COLUMNS = (
    "family",
    "cases",
    "0 right",
    "0 WRONG",
    "0 DEEP",
    "refused",
    "odd",
    "slow",
    "doubts",
    "late",
    "run s",
    "judge s",
)
LEGEND = """
0 WRONG: exit code 0, but wires went through each other, or overlap where the ledger has no contact
0 DEEP: exit code 0, but contacts overlap by more than 5 % of the smaller radius; nothing else is wrong
odd, slow: another exit code than 0, 1 and 2, or no words; not finished in time
doubts: right, but on one of the two ways that were tried wires meet (they may have gone round an end)
late: refused, but an increment before the refusal has a finding
"""


def row_of(name, trials):
    """A row of the table of COLUMNS."""
    count = Counter(trial.verdict for trial in trials)
    n = len(trials)
    return (
        name,
        n,
        count[RIGHT],
        count[WRONG],
        count[DEEP],
        f"{count[REFUSED]} ({100 * count[REFUSED] / n:.0f} %)",
        count[ODD],
        count[SLOW],
        sum(trial.verdict == RIGHT and bool(trial.doubts) for trial in trials),
        sum(trial.verdict == REFUSED and bool(trial.findings) for trial in trials),
        f"{sum(trial.seconds for trial in trials) / n:.2f}",
        f"{sum(trial.judged for trial in trials) / n:.2f}",
    )


def table(trials):
    """Lines: how the cases of each family ended, and the refusals by kind."""
    by_family = defaultdict(list)
    for trial in trials:
        by_family[trial.family].append(trial)
    rows = [COLUMNS, *(row_of(name, by_family[name]) for name in FAMILIES if name in by_family), row_of("all", trials)]
    widths = [max(len(str(row[k])) for row in rows) for k in range(len(COLUMNS))]
    lines = ["  ".join(str(cell).rjust(width) for cell, width in zip(row, widths, strict=True)) for row in rows]
    lines += LEGEND.splitlines()
    kinds = Counter(kind for trial in trials if trial.verdict in (WRONG, DEEP) for kind in trial.kinds)
    if kinds:
        lines.append("found with exit 0: " + ", ".join(f"{kind} in {n}" for kind, n in kinds.most_common()))
    refusals = defaultdict(list)
    for trial in trials:
        if trial.verdict in (REFUSED, ODD):
            refusals[trial.code, kind_of_message(trial.message)].append(trial)
    if refusals:
        lines += ["", "refusals by kind (exit code, count, families, an example):"]
    for (code, kind), group in sorted(refusals.items(), key=lambda item: -len(item[1])):
        families = Counter(trial.family for trial in group)
        lines.append(f"  {code}  {len(group):4d}  {kind}")
        lines.append("           " + ", ".join(f"{name} {n}" for name, n in families.most_common()))
        lines.append(f"           {group[0].name}: {group[0].message}")
    wrong = [trial for trial in trials if trial.verdict in FAILURES]
    if wrong:
        lines += ["", "failures:"]
        lines += [f"  {trial.name}: {trial.verdict}; {(trial.findings or [trial.message])[0]}" for trial in wrong]
    return lines

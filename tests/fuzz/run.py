"""Give many wrong decks to the reader: python tests/fuzz/run.py --program BUILD/tests/read_decks --count 100000

Every deck of inputs/ is changed at random (`mutations.py`). The reader must answer each within ten seconds and without more
than 2 GB of memory, must not end, and what it accepts must be the model that a second reader (`plain_reader.py`) finds in the
deck. Decks that break a promise are kept in the directory --findings.
"""

import argparse
import resource
import select
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from random import Random

sys.path.insert(0, str(Path(__file__).parent))
from mutations import mutated
from plain_reader import listing

INPUTS = Path(__file__).parents[2] / "inputs"
SECONDS, GIGABYTES = 10, 2
ACCEPTED, REFUSED = b"0", (b"1", b"4")


class Reader:
    """The program that reads decks in a loop, started again after each end."""

    def __init__(self, program, *, limited):
        self.program, self.limited, self.process = program, limited, None

    def start(self):
        self.process = subprocess.Popen(
            [self.program],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            bufsize=0,
        )
        if self.limited:
            resource.prlimit(self.process.pid, resource.RLIMIT_AS, (GIGABYTES * 2**30,) * 2)

    def ask(self, path):
        """The answer in lines, without the full stop; None with a reason when there is none."""
        if self.process is None:
            self.start()
        self.process.stdin.write(f"{path}\n".encode())
        answer = b""
        while not (answer == b".\n" or answer.endswith(b"\n.\n")):
            ready, _, _ = select.select([self.process.stdout], [], [], SECONDS)
            piece = self.process.stdout.read(1 << 20) if ready else b""
            if not piece:
                self.process.kill()
                _, message = self.process.communicate()
                reason = f"ended with {self.process.returncode}" if ready else f"no answer for {SECONDS} s"
                self.process = None
                return None, f"{reason}\n{message.decode(errors='replace')}"
            answer += piece
        return answer.split(b"\n")[:-2], ""

    def stop(self):
        if self.process is not None:
            self.process.communicate()


def judge(deck, answer, reason):
    """What is wrong about the answer to a deck; an empty text when nothing is."""
    if answer is None:
        return reason
    code = answer[0].split()[0]
    if code in REFUSED:
        return ""
    if code != ACCEPTED:
        return f"exit code {code.decode()}"
    found = [line.decode("latin-1") for line in answer[1:]]
    try:
        expected = listing(deck)
    except Exception as error:
        return f"accepted, but the second reader does not understand it: {error!r}"
    for a, b in zip(found, expected, strict=False):
        if a != b:
            return f"accepted, but it means something else:\n litz   {a}\n second {b}"
    return "" if len(found) == len(expected) else f"accepted with {len(found)} entries in place of {len(expected)}"


def fuzz(program, count, seed, findings=None, *, limited=True, decks=None):
    """Number of decks that were accepted, refused, and with a finding; and what was found."""
    decks = decks or [path.read_bytes() for path in sorted(INPUTS.glob("*.inp"))]
    totals, found = Counter(), []
    reader = Reader(program, limited=limited)
    with tempfile.TemporaryDirectory(dir="/dev/shm" if Path("/dev/shm").is_dir() else None) as directory:
        path = Path(directory) / "deck.inp"
        for i in range(count):
            random = Random(f"{seed} {i}")
            deck = mutated(decks[i % len(decks)], random, decks)
            path.write_bytes(deck)
            answer, reason = reader.ask(path)
            wrong = judge(deck, answer, reason)
            if wrong:
                totals["findings"] += 1
                found.append((i, wrong))
                if findings is not None:
                    findings.mkdir(parents=True, exist_ok=True)
                    (findings / f"{seed}-{i}.inp").write_bytes(deck)
                    (findings / f"{seed}-{i}.txt").write_text(wrong + "\n")
            elif answer is not None:
                totals["accepted" if answer[0].startswith(ACCEPTED) else "refused"] += 1
    reader.stop()
    return totals, found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, required=True, help="the built tests/read_decks")
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--findings", type=Path, default=Path("fuzz_findings"))
    parser.add_argument("--no-memory-limit", action="store_true", help="for programs under the address sanitizer")
    arguments = parser.parse_args()
    totals, found = fuzz(
        arguments.program.resolve(),
        arguments.count,
        arguments.seed,
        arguments.findings,
        limited=not arguments.no_memory_limit,
    )
    for i, wrong in found[:20]:
        print(f"deck {arguments.seed}-{i}: {wrong}")
    print(
        f"{arguments.count} decks: " + ", ".join(f"{totals[key]} {key}" for key in ("accepted", "refused", "findings"))
    )
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

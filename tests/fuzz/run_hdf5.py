"""Give litz changed HDF5 files: meshes that decks name, and restart files.

A mesh must be refused, or mean the same as a deck in text that h5py has made from it. A restart file must be refused, or
lead to the results of the uninterrupted run. Never a crash, a hang, or more memory than the limit.

    python tests/fuzz/run_hdf5.py mesh --program BUILD/tests/read_decks --count 20000 --seed 7
    python tests/fuzz/run_hdf5.py restart --program BUILD/fortran/litz --count 2000 --seed 7
"""

import argparse
import resource
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from random import Random

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).parent))
from hdf5_mutations import mutate
from run import ACCEPTED, GIGABYTES, REFUSED, SECONDS, Reader

DECK = """\
*HEADING
A mesh in a file
{mesh}*MATERIAL, NAME=CU
*ELASTIC
 1.2e11, 0.35
*BEAM SECTION, ELSET=BEAM, MATERIAL=CU, SECTION=CIRC
 0.0005
*BOUNDARY
 ROOT, ENCASTRE
*STEP
*STATIC
*CLOAD
 7, 2, 1e-3
*END STEP
"""


def write_mesh(path):
    """Nine nodes with gaps in their numbers, elements of both types, sets."""
    ids = np.array([3, 5, 7, 11, 13, 17, 19, 23, 29])
    with h5py.File(path, "w") as file:
        file["nodes/id"] = ids
        file["nodes/position"] = np.c_[0.01 * np.arange(9), np.zeros(9), 0.001 * np.arange(9) ** 2]
        file["elements/B31/id"] = np.arange(4) + 101
        file["elements/B31/nodes"] = np.c_[ids[:4], ids[1:5]]
        file["elements/B33/id"] = np.arange(4) + 201
        file["elements/B33/nodes"] = np.c_[ids[4:8], ids[5:]]
        file["node_sets/root"] = ids[:1]
        file["node_sets/some"] = ids[2:6]
        file["element_sets/Beam"] = np.r_[101:105, 201:205]


def as_text(path):
    """The cards that a mesh file stands for, by a reader of its own; nothing where a deck cannot say it."""
    lines = []
    with h5py.File(path, "r") as file:
        if "nodes" in file:
            lines.append("*NODE")
            positions = file["nodes/position"][...].astype(float)
            if ((positions != 0) & (np.abs(positions) < np.finfo(float).tiny)).any():
                return ""
            rows = zip(file["nodes/id"][...], positions.tolist(), strict=True)
            lines += [f"{i}, {x!r}, {y!r}, {z!r}" for i, (x, y, z) in rows]
        for kind in ("B31", "B33"):
            if f"elements/{kind}" in file:
                group = file[f"elements/{kind}"]
                lines.append(f"*ELEMENT, TYPE={kind}")
                lines += [f"{i}, {a}, {b}" for i, (a, b) in zip(group["id"][...], group["nodes"][...], strict=True)]
        for keyword, group in (("NSET", "node_sets"), ("ELSET", "element_sets")):
            for name in file.get(group, ()):
                lines.append(f'*{keyword}, {keyword}="{name}"')
                lines += [str(member) for member in file[group][name][...]]
    return "\n".join(lines) + "\n"


class MeshFuzzer:
    """Meshes through the program that reads decks in a loop."""

    def __init__(self, program, directory, *, limited):
        self.reader = Reader(program, limited=limited)
        self.deck, self.text = directory / "deck.inp", directory / "text.inp"
        self.original, self.changed = directory / "original.h5", directory / "mesh.h5"
        self.deck.write_text(DECK.format(mesh="*MESH, INPUT=mesh.h5\n"))
        write_mesh(self.original)

    def judge(self):
        """Whether the changed mesh was accepted, and what is wrong about that; an empty text when nothing is."""
        answer, reason = self.reader.ask(self.deck)
        if answer is None:
            return False, reason
        code = answer[0].split()[0]
        if code != ACCEPTED:
            return False, "" if code in REFUSED else f"exit code {code.decode()}"
        try:
            text = as_text(self.changed)
        except Exception as error:
            # the HDF5 of h5py is another version, which may refuse to open what that of litz opens
            if isinstance(error, OSError) or (isinstance(error, KeyError) and "doesn't exist" not in str(error)):
                return True, ""
            return True, f"accepted, but h5py does not understand it: {error!r}"
        return True, self.compare(answer, text) if text else ""

    def compare(self, answer, text):
        """What is wrong about the answer to a mesh, beside that to its text."""
        self.text.write_text(DECK.format(mesh=text))
        expected, reason = self.reader.ask(self.text)
        if expected is None or expected[0].split()[0] != ACCEPTED:
            return f"accepted, but its text is not: {reason}"
        return "" if answer[1:] == expected[1:] else "accepted, but its text means something else"

    def stop(self):
        self.reader.stop()


RESTARTED = """\
*HEADING
A cantilever that is bent in four increments
*NODE, NSET=ALL
 1, 0, 0, 0
 2, 0.05, 0, 0
 3, 0.1, 0, 0
*ELEMENT, TYPE=B31, ELSET=BEAM
 1, 1, 2
 2, 2, 3
*MATERIAL, NAME=CU
*ELASTIC
 1.2e11, 0.35
*BEAM SECTION, ELSET=BEAM, MATERIAL=CU, SECTION=CIRC
 0.0005
*BOUNDARY
 1, ENCASTRE
*STEP
*STATIC, DIRECT
 0.25, 1
*CLOAD
 3, 2, 1e-2
*NODE PRINT, NSET=ALL
 U
*RESTART, WRITE
*END STEP
"""


class RestartFuzzer:
    """Restart files through the program, a process for each."""

    def __init__(self, program, directory, *, limited):
        self.program, self.limited = program, limited
        self.deck, self.output = directory / "deck.inp", directory / "out"
        self.original, self.changed = directory / "original.h5", directory / "restart.h5"
        self.deck.write_text(RESTARTED)
        assert self.run("-o", directory / "whole").returncode == 0
        shutil.copy(directory / "whole" / "deck.restart.h5", self.original)
        self.rows = (directory / "whole" / "deck_history.csv").read_text().splitlines()[1:]

    def run(self, *arguments):
        def limit():
            if self.limited:
                resource.setrlimit(resource.RLIMIT_AS, (GIGABYTES * 2**30,) * 2)

        return subprocess.run(
            [self.program, "run", self.deck, "--quiet", "--threads", "1", *arguments],
            capture_output=True, timeout=SECONDS, check=False, preexec_fn=limit,
        )  # fmt: skip

    def judge(self):
        """Whether the changed file was taken, and what is wrong about that; an empty text when nothing is."""
        shutil.rmtree(self.output, ignore_errors=True)
        try:
            done = self.run("-o", self.output, "--restart", self.changed)
        except subprocess.TimeoutExpired:
            return False, f"no end within {SECONDS} s"
        if done.returncode != 0:
            wrong = "" if str(done.returncode).encode() in REFUSED else f"ended with {done.returncode}\n"
            return False, wrong and wrong + done.stderr.decode(errors="replace")
        rows = (self.output / "deck_history.csv").read_text().splitlines()[1:]
        return True, "" if rows and set(rows) <= set(self.rows) else "taken, but the results are others"

    def stop(self):
        """Nothing is left running."""


FUZZERS = {"mesh": MeshFuzzer, "restart": RestartFuzzer}


def fuzz(kind, program, count, seed, findings=None, *, limited=True):
    """Number of files that were accepted, refused, and with a finding; and what was found."""
    totals, found = Counter(), []
    with tempfile.TemporaryDirectory(dir="/dev/shm" if Path("/dev/shm").is_dir() else None) as name:
        fuzzer = FUZZERS[kind](program, Path(name), limited=limited)
        for i in range(count):
            shutil.copy(fuzzer.original, fuzzer.changed)
            mutate(fuzzer.changed, Random(f"{seed} {i}"))
            accepted, wrong = fuzzer.judge()
            totals["findings" if wrong else "accepted" if accepted else "refused"] += 1
            if not wrong:
                continue
            found.append((i, wrong))
            if findings is not None:
                findings.mkdir(parents=True, exist_ok=True)
                shutil.copy(fuzzer.changed, findings / f"{kind}-{seed}-{i}.h5")
                (findings / f"{kind}-{seed}-{i}.txt").write_text(wrong + "\n")
        fuzzer.stop()
    return totals, found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=FUZZERS)
    parser.add_argument("--program", type=Path, required=True, help="the built tests/read_decks, or the program litz")
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--findings", type=Path, default=Path("fuzz_findings"))
    parser.add_argument("--no-memory-limit", action="store_true", help="for programs under the address sanitizer")
    arguments = parser.parse_args()
    totals, found = fuzz(
        arguments.kind, arguments.program.resolve(), arguments.count, arguments.seed, arguments.findings,
        limited=not arguments.no_memory_limit,
    )  # fmt: skip
    for i, wrong in found[:20]:
        print(f"{arguments.kind} {arguments.seed}-{i}: {wrong}")
    print(
        f"{arguments.count} files: " + ", ".join(f"{totals[key]} {key}" for key in ("accepted", "refused", "findings"))
    )
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

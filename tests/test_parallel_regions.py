"""What may stand in a parallel region of the Fortran sources."""

import re
from pathlib import Path

FORTRAN = Path(__file__).parents[1] / "fortran"


def parallel_regions(text):
    """The lines of each parallel region, from its directive to the end of it."""
    return re.findall(r"^\s*!\$omp parallel.*?^\s*!\$omp end parallel", text, re.MULTILINE | re.DOTALL)


def test_no_block_in_a_parallel_region():
    """gfortran shares the bounds of a BLOCK's arrays among the threads (12 does), which change them for each other."""
    regions = {path: parallel_regions(path.read_text(encoding="utf-8")) for path in sorted(FORTRAN.rglob("*.f90"))}
    assert sum(len(found) for found in regions.values()) >= 10
    block = re.compile(r"^\s*(\w+\s*:\s*)?block\s*$", re.MULTILINE | re.IGNORECASE)
    assert [path.name for path, found in regions.items() if any(map(block.search, found))] == []

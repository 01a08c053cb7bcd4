"""A newcomer adds a law by the blocks of its page: applied to a copy of the sources, built, run."""

import os
import shutil
import subprocess
import sys

import pytest

from documents import ROOT, blocks, copy_of_the_sources, setup_commands

# what `litz keywords` says of the law that the page adds
PAGES = {
    "new_spot_law.md": "ROUGH: many spots of rough surfaces",
    "new_normal_law.md": "POWER: a power law through a measured point",
}


@pytest.mark.parametrize("page", PAGES)
@pytest.mark.skipif(not all(map(shutil.which, ("meson", "ninja", "git"))), reason="needs meson, ninja and git")
def test_the_steps_of_the_page_lead_to_a_run_with_the_new_law(page, tmp_path):
    copy = copy_of_the_sources(tmp_path)
    paths = os.pathsep.join(map(str, sys.path))
    printed = []
    for block in blocks(ROOT / "docs" / page):
        if block.saved_as:
            (copy / block.saved_as).write_text(block.text)
        if block.not_run or setup_commands(block) is not None or block.language in ("diff", "fortran"):
            continue
        command = {"sh": ["bash", "-e", "-c"], "python": [sys.executable, "-c"]}[block.language]
        done = subprocess.run(
            [*command, block.text],
            cwd=copy,
            env={**os.environ, "PYTHONPATH": paths},
            capture_output=True,
            text=True,
            timeout=600,
            check=False,
        )
        assert done.returncode == 0, f"{block.place}: {done.stdout}{done.stderr}"
        printed.append(done.stdout)
    assert PAGES[page] in " ".join("".join(printed).split())
    assert "expected" in printed[-1]

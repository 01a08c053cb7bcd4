"""A newcomer adds a contact-spot law by the blocks of docs/new_spot_law.md: applied to a copy of the sources, built, run."""

import os
import shutil
import subprocess
import sys

import pytest

from documents import ROOT, blocks, copy_of_the_sources, setup_commands

PAGE = ROOT / "docs" / "new_spot_law.md"


@pytest.mark.skipif(not all(map(shutil.which, ("meson", "ninja", "git"))), reason="needs meson, ninja and git")
def test_the_steps_of_the_page_lead_to_a_run_with_the_new_law(tmp_path):
    copy = copy_of_the_sources(tmp_path)
    paths = os.pathsep.join(map(str, sys.path))
    printed = []
    for block in blocks(PAGE):
        if block.saved_as:
            (copy / block.saved_as).write_text(block.text)
        if block.not_run or setup_commands(block) is not None or block.language == "diff":
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
    assert "ROUGH: many spots of rough surfaces" in " ".join("".join(printed).split())
    assert "expected" in printed[-1]

"""What newcomers add by the documents: all of it in one copy of the sources, which is compiled once."""

import os
import subprocess
import sys

from documents import ROOT, blocks, copy_of_the_sources, setup_commands

#: Pages that lead from a clone to a run with something new, and what `litz keywords` says of that
PAGES = {
    "new_spot_law.md": "ROUGH: many spots of rough surfaces",
    "new_normal_law.md": "POWER: a power law through a measured point",
    "new_element.md": "B31F: B31 with residual bending flexibility",
    "new_term.md": "Concentrated flows, positive into the body",
}


def steps_of(page):
    """The blocks of a page that change the sources, and those that build and use them."""
    steps = [
        block
        for block in blocks(ROOT / "docs" / page)
        if block.saved_as
        or (block.language in ("sh", "python") and not block.not_run and setup_commands(block) is None)
    ]
    first = next(k for k, block in enumerate(steps) if block.text.startswith("meson setup "))
    return steps[:first], steps[first:]


def patch_of_outputs():
    """The example of CONTRIBUTING.md: two new outputs, a line each."""
    (patch,) = (block.text for block in blocks(ROOT / "CONTRIBUTING.md") if block.language == "diff")
    return patch


def do(block, copy):
    """Save a block in the copy or run it there; return what it prints."""
    if block.saved_as:
        (copy / block.saved_as).write_text(block.text)
        return ""
    command = {"sh": ["bash", "-e", "-c"], "python": [sys.executable, "-c"]}[block.language]
    return call([*command, block.text], copy, block.place)


def call(command, copy, place, text=None):
    """Run a command in the copy, with a text as its input; return what it prints."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, sys.path))}
    done = subprocess.run(
        command, cwd=copy, env=environment, input=text, capture_output=True, text=True, timeout=600, check=False
    )
    assert done.returncode == 0, f"{place}: {done.stdout}{done.stderr}"
    return done.stdout


def make_changed_sources(folder):
    """A copy of the sources in this folder to which everything is added; none needs or touches what another adds.

    All before it is configured: what is configured again is compiled again, as a whole.
    """
    copy = copy_of_the_sources(folder)
    for page in PAGES:
        changes, _ = steps_of(page)
        for block in changes:
            do(block, copy)
    call(["git", "apply", "-"], copy, "CONTRIBUTING.md", patch_of_outputs())
    return copy

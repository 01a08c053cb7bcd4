"""What the documents say can be done, works."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCUMENTS = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md")])


def code_blocks(document, language):
    """The fenced blocks of a language in a document."""
    return re.findall(rf"^```{language}\n(.*?)^```", document.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_links_lead_somewhere(document):
    links = re.findall(r"\]\((?!https?:)([^)#]+)(?:#[^)]*)?\)", document.read_text(encoding="utf-8"))
    missing = [link for link in links if not (document.parent / link).exists()]
    assert not missing


def test_the_python_of_the_readme_runs(tmp_path):
    blocks = code_blocks(ROOT / "README.md", "python")
    assert len(blocks) >= 2
    (tmp_path / "inputs").symlink_to(ROOT / "inputs")
    done = subprocess.run(
        [sys.executable, "-c", "\n".join(blocks)],
        cwd=tmp_path,
        env={**os.environ, "PYTHONWARNINGS": "error::UserWarning"},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_the_deck_of_the_readme_runs(tmp_path, litz):
    (deck,) = [block for block in code_blocks(ROOT / "README.md", "") if block.startswith("*HEADING")]
    (tmp_path / "deck.inp").write_text(deck)
    done = litz("run", "deck.inp", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "deck.vtkhdf").is_file()


def test_the_deck_reference_is_what_the_program_prints(litz):
    printed = litz("keywords", "--markdown")
    assert printed.returncode == 0, printed.stderr
    assert (ROOT / "docs" / "deck_reference.md").read_text(encoding="utf-8") == printed.stdout

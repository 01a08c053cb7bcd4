"""The fenced blocks of the documents, and how each kind of them is tried out.

| language | what is done with the blocks |
|---|---|
| `python` | those of one document run one after another in one interpreter, each seeing what those before it defined |
| `sh` | run by `bash -e`, in the folder in which the Python blocks of the document run |
| `inp` | a deck: `litz check` accepts it |
| `fortran` | compiled together with the contact element, or in a copy of the sources that it changes |
| `output` | what the block before it prints; `...` stands for anything |
| `math` | an equation: its braces and environments are closed, here; `./setup docs` typesets it |
| `diff` | patches: `tests/system/new_things.py` applies them to a copy of the sources |

After the words "Save this as `NAME`:" a block is put into that file for those that follow.

A block that cannot be tried out says why in its first line, where readers see it: `# not run by the tests: REASON`,
with the comment sign of its language. A fence of another language, or of none, is an error.
"""

import re
import shlex
import shutil
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
LANGUAGES = frozenset(["python", "sh", "inp", "fortran", "output", "diff", "math"])

_FENCE = re.compile(
    r"^(?P<indent> *)(?P<mark>`{3,})(?P<language>[^\n`]*)\n(?P<text>.*?)^(?P=indent)(?P=mark)[ \t]*$", re.M | re.S
)
_SAVED = re.compile(r"Save this as `([^`]+)`:\s*\Z")
_NOT_RUN = re.compile(r"\A(?:#|!|\*\*) not run by the tests: (?P<reason>\S.*)$", re.M)


@dataclass(frozen=True)
class Block:
    """One fenced block."""

    document: Path
    line: int
    language: str
    text: str
    #: Name of the file that readers are told to save it in, or None
    saved_as: str | None

    @property
    def not_run(self):
        """Why the block cannot be tried out, or None."""
        found = _NOT_RUN.match(self.text)
        return found["reason"] if found else None

    @property
    def place(self):
        return f"{self.document.relative_to(ROOT)}:{self.line}"


def documents():
    """All Markdown files of the project that are written for readers."""
    folders = [ROOT, ROOT / "docs", ROOT / "docs" / "tutorials", ROOT / "verification"]
    return sorted(path for folder in folders for path in folder.glob("*.md"))


def blocks(document):
    """The fenced blocks of a document, directives of the site (```` ```{name} ````) left out."""
    text = document.read_text(encoding="utf-8")
    found = []
    for match in _FENCE.finditer(text):
        language = match["language"].strip()
        if language.startswith("{"):
            continue
        line = text.count("\n", 0, match.start()) + 1
        body = re.sub(f"^{match['indent']}", "", match["text"], flags=re.MULTILINE)
        saved = _SAVED.search(text, 0, match.start())
        found.append(Block(document, line, language, body, saved and saved[1]))
    return found


def setup_commands(block):
    """The commands of a block that consists of `./setup COMMAND ...` lines alone; None for other blocks."""
    lines = [line for line in block.text.splitlines() if line.strip()]
    if block.language != "sh" or not all(re.match(r"\./setup\b", line) for line in lines):
        return None
    commands = [shlex.split(line, comments=True)[1:] for line in lines]
    return [words[0] if words else "" for words in commands]


def copy_of_the_sources(folder):
    """The project as a clone has it, in a folder `litz` in this one."""
    made_on_top = {".git", ".venv", "build", "debug", "results"}
    made_anywhere = shutil.ignore_patterns(".*_cache", "__pycache__", "*.so")

    def made(directory, names):
        return made_anywhere(directory, names) | (made_on_top if Path(directory) == ROOT else set())

    return Path(shutil.copytree(ROOT, folder / "litz", ignore=made))

"""What is to be known of a deck before it is taken to pieces: whether the program can read it as it is, and other files."""

import re
from collections.abc import Iterator
from pathlib import Path

#: Keyword lines of decks that place parts or generate nodes; a keyword line goes on behind a comma at its end
REARRANGED = re.compile(
    rb"^[ \t]*\*[ \t]*(part|ngen|nfill|ncopy|elgen|elcopy|system)\b"
    rb"|^[ \t]*\*[ \t]*node[ \t]*(?=,)(.*,[ \t]*\r?\n)*?.*\bsystem[ \t]*=",
    re.MULTILINE | re.IGNORECASE,
)
#: Those that name other decks
INCLUDED = re.compile(rb"^[ \t]*\*[ \t]*include[ \t]*,\s*input[ \t]*=([^,\r\n]+)", re.MULTILINE | re.IGNORECASE)
#: Those that name files of meshes
_MESHES = re.compile(rb"^[ \t]*\*[ \t]*mesh[ \t]*,\s*input[ \t]*=([^,\r\n]+)", re.MULTILINE | re.IGNORECASE)


def included_files(deck: Path) -> Iterator[Path]:
    """The deck and the decks that it includes, each once, where they are there."""
    waiting, seen = [deck], set()
    while waiting:
        path = waiting.pop(0).resolve()
        if path not in seen and path.is_file():
            seen.add(path)
            yield path
            waiting += _named(path, INCLUDED)


def files_beside(deck: Path) -> Iterator[Path]:
    """The files that a deck reads beside itself: those that it includes, and meshes of all of them."""
    for path in included_files(deck):
        if path != deck.resolve():
            yield path
        yield from (mesh for mesh in _named(path, _MESHES) if mesh.is_file())


def _named(path: Path, pattern: re.Pattern[bytes]) -> list[Path]:
    """The files that a deck names."""
    names = pattern.findall(path.read_bytes())
    return [path.parent / name.decode("utf-8", errors="surrogateescape").strip().strip('"') for name in names]

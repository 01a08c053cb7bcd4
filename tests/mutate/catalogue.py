"""The catalogue of faults: what goes wrong in which source file, and which tests look at that first."""

from dataclasses import dataclass
from pathlib import Path

try:
    import tomllib
except ModuleNotFoundError:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]
CATALOGUE = Path(__file__).with_name("faults.toml")
#: Folders of the sources that a fault may be put into
FOLDERS = ("fortran", "python/litz")


class CatalogueError(ValueError):
    """A fault that cannot be put into the sources."""


@dataclass(frozen=True)
class Fault:
    """One fault.

    Attributes
    ----------
    file : str
        The end of the path of the source file: its name, behind a folder where the name alone is not unique.
    what : str
        What the program does wrong with it.
    text, wrong : str
        A piece of the source, and what stands there instead.
    count : int
        How often the piece occurs; all of them are replaced.
    tests : tuple of str
        Paths of the tests that are run first: pytest files and Fortran test programs.
    survives : str
        Why no test can be expected to find it; empty where one is.
    """

    file: str
    what: str
    text: str
    wrong: str
    count: int
    tests: tuple[str, ...]
    survives: str

    @property
    def name(self) -> str:
        return f"{self.file}: {self.what}"

    def path(self, root: Path = ROOT) -> Path:
        """The source file, wherever it stands."""
        found = [
            path
            for folder in FOLDERS
            for path in (root / folder).rglob(Path(self.file).name)
            if f"/{path.relative_to(root).as_posix()}".endswith(f"/{self.file}")
        ]
        if len(found) != 1:
            raise CatalogueError(f"{self.name}: there are {len(found)} files of this name in {' and '.join(FOLDERS)}")
        return found[0]

    def put_into(self, source: str) -> str:
        """The text of the source file with the fault."""
        occurrences = source.count(self.text)
        if occurrences != self.count:
            raise CatalogueError(f"{self.name}: {self.text!r} occurs {occurrences} times, not {self.count}")
        return source.replace(self.text, self.wrong)


def read_catalogue(path: Path = CATALOGUE) -> tuple[list[str], list[Fault]]:
    """The paths of the quick tests, and all faults."""
    content = tomllib.loads(path.read_text(encoding="utf-8"))
    faults = [
        Fault(
            file=module["file"],
            what=fault["what"],
            text=fault["text"],
            wrong=fault["wrong"],
            count=fault.get("count", 1),
            tests=tuple(module["tests"]),
            survives=fault.get("survives", ""),
        )
        for module in content["module"]
        for fault in module["fault"]
    ]
    return content["quick"], faults

"""Which file is meant by a path: the result file of the wires, its directory, or the deck that was run."""

from pathlib import Path

import h5py

from ..errors import FileError

#: Ends of the names of files that runs and exports write beside the result file of the wires
_BESIDE_RUNS, _BESIDE_EXPORTS = ("_contacts", "_unconverged"), ("rigid", "surfaces", "zones")
_WHAT_IS_BESIDE = {
    "contacts": "contacts",
    "rigid": "rigid surfaces",
    "surfaces": "contacts on surfaces",
    "zones": "zones of contact",
}


def find_result_file(path: Path) -> Path:
    """Find the result file of the wires for a path."""
    if path.is_dir():
        found = sorted(file for file in path.glob("*.vtkhdf") if not _is_beside_another(file))
        if len(found) == 1:
            return found[0]
        what = "several: " + ", ".join(file.name for file in found) if found else "none"
        raise FileError(f"the directory {path} should have one result file (.vtkhdf); there are {what}")
    candidates = _candidates(path)
    for candidate in candidates:
        if candidate.is_file():
            _refuse_what_is_beside(candidate)
            return candidate
    raise FileError(
        f"there is no result file {' or '.join(dict.fromkeys(map(str, candidates)))}: has the deck been run?"
    )


def is_there(path: Path) -> bool:
    """Whether something of that name could be results."""
    return path.is_dir() or any(candidate.is_file() for candidate in _candidates(path))


def _candidates(path: Path) -> list[Path]:
    """Files that a path which is no directory may mean."""
    if path.suffix == ".vtkhdf":
        return [path]
    if path.suffix == ".inp":
        return [path.with_suffix(".vtkhdf"), Path(path.stem + ".vtkhdf")]
    return [path.with_name(path.name + ".vtkhdf")]


def _refuse_what_is_beside(file: Path) -> None:
    """An error for the file of contacts of a run, or one that `litz export` wrote, which have no run in them."""
    stem, _, ending = file.stem.rpartition("_")
    whole = file.with_name(f"{stem}.vtkhdf")
    if ending in _WHAT_IS_BESIDE and whole.is_file() and not _has_run(file):
        raise FileError(f"{file} has the {_WHAT_IS_BESIDE[ending]} of a run for ParaView: the results are in {whole}")


def _has_run(file: Path) -> bool:
    """A run may have a name like the file of another one."""
    try:
        with h5py.File(file, "r", locking=False) as opened:
            return "litz" in opened and "heading" in opened["litz"].attrs
    except OSError:
        # what cannot be read is told where it is opened
        return True


def _is_beside_another(file: Path) -> bool:
    """It is no result file of wires, but has been written beside one."""
    if file.stem.endswith(_BESIDE_RUNS):
        return True
    stem, _, ending = file.stem.rpartition("_")
    return ending in _BESIDE_EXPORTS and file.with_name(f"{stem}.vtkhdf").exists()

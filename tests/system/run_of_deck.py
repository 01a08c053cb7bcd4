"""Runs of decks that a test writes: those that must go through, and those that must end."""

from litz import Results


def run_of_deck(litz, folder, deck):
    """A function that writes a deck from its arguments, runs it, and returns the results."""

    def run(*arguments, **changes):
        done = _run(litz, folder, deck(*arguments, **changes))
        assert done.returncode == 0, done.stderr
        return Results(folder / "wire")

    return run


def refusal_of_deck(litz, folder, deck):
    """A function that runs a deck that must end with an exit code, and returns what the program says."""

    def run(code, *arguments, **changes):
        done = _run(litz, folder, deck(*arguments, **changes))
        assert done.returncode == code, done.stderr
        return done.stderr

    return run


def _run(litz, folder, text):
    (folder / "wire.inp").write_text(text)
    return litz("run", folder / "wire.inp", "-o", folder / "wire", "--quiet")

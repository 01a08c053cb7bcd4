"""Suggestions for unknown names."""

import difflib
from collections.abc import Iterable


def nearest_name(name: str, known: Iterable[str]) -> str:
    """Suggestion of the most similar known name; empty if none is similar."""
    spelt = {str(one).upper(): one for one in known}
    nearest = difflib.get_close_matches(str(name).upper(), spelt, n=1)
    if not nearest:
        # the first word of a longer name, as "resistance" of "resistance PLUS to MINUS"
        spelt = {one.split()[0]: full for one, full in reversed(spelt.items()) if one.strip()}
        nearest = difflib.get_close_matches(str(name).upper(), spelt, n=1)
    return f"; did you mean {spelt[nearest[0]]!r}?" if nearest else ""


def unknown_name(what: str, name: str, known: Iterable[str]) -> str:
    """Error message for an unknown name, with a suggestion and the known names."""
    known = list(known)
    hint = nearest_name(name, known)
    listed = ", ".join(known[:40]) + (", ..." if len(known) > 40 else "")
    return f"there is no {what} {name!r}{hint or '.'} There are: {listed or 'none'}"

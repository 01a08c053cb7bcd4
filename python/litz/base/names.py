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


#: Fields of elements that are in the results on request only, by the word of `*EL FILE` that asks for them
ON_REQUEST = {
    "SFN": ("end_force_1", "end_moment_1", "end_force_2", "end_moment_2"),
    "SE": ("axial_strain",),
    "SK": ("twist", "curvature_2", "curvature_3"),
    "E11": ("strain_max", "strain_min"),
    "S11": ("stress_max", "stress_min"),
}


def unknown_field(name: str, known: Iterable[str]) -> str:
    """Error message for an unknown field; of one that is there on request, how a step asks for it."""
    for word, fields in ON_REQUEST.items():
        if name in fields:
            return (
                f"there is no field {name!r}: the run did not write it. A step asks for it with *EL FILE and a line {word}, in "
                f'Python Step.el_file("{word}")'
            )
    return unknown_name("field", name, known)

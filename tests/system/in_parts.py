"""Decks with several mistakes: all are told in one pass."""


def in_parts(cases, size=10):
    """The cases, some at a time: the program shows 50 errors at most, and some mistakes lead to more than one."""
    cases = list(cases)
    return [cases[first : first + size] for first in range(0, len(cases), size)]

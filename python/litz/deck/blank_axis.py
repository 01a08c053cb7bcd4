"""The first axis of a `*BEAM GENERAL SECTION`, for which Abaqus takes a blank line."""

from .card import Card

_DEFAULT_AXIS = (0.0, 0.0, -1.0)


def write_blank_axis(section: Card) -> None:
    """Write the axis for which a blank line stands, between the dimensions and the moduli."""
    if not section.is_a("BEAM GENERAL SECTION") or "MATERIAL" in section or len(section.data) != 2:
        return
    lines = [line.strip() for line in section.body if not line.strip().startswith("**")]
    first = next(place for place, line in enumerate(lines) if line)
    if not lines[first + 1]:
        section.data = [section.data[0], _DEFAULT_AXIS, section.data[1]]

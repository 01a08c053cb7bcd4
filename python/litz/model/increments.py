"""The first and the largest increment of a step where they are left out."""

#: Default of the smallest increment as a fraction of the step
SMALLEST_FRACTION = 1e-5


def first_and_largest(
    total: float,
    increment: float | None,
    first: float | None,
    smallest: float | None,
    largest: float | None,
    follows_error: bool,
) -> tuple[float, float]:
    """Return both [s]; nothing tells the error of a first one, which is small where increments follow their error."""
    longest = total if increment is None else increment
    if first is None and increment is None and follows_error:
        first = SMALLEST_FRACTION * total if smallest is None else smallest
    return longest if first is None else first, longest if largest is None else largest

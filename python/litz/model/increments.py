"""The card with the procedure of a step: its parameters, and its increments where they are left out."""

from typing import Any

from ..deck.keyword_table import squeezed

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


def procedure_parameters(
    name: str, direct: bool, steady_state: bool, electrical: bool, limits: dict[str, float | None]
) -> dict[str, Any]:
    """Parameters of the card with the procedure of a step."""
    parameters: dict[str, Any] = {"DIRECT": True} if direct else {}
    if squeezed(name) == squeezed("COUPLED TEMPERATURE-DISPLACEMENT") and electrical:
        parameters["ELECTRICAL"] = True
    if steady_state:
        parameters["STEADY STATE"] = True
    return parameters | {limit: value for limit, value in limits.items() if value is not None}

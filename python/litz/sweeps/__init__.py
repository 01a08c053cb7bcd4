"""Many runs: over a grid of parameters, and the value of one at which the outcome changes."""

from .bisection import Bracket, bisect
from .sweep import sweep

__all__ = ["Bracket", "bisect", "sweep"]

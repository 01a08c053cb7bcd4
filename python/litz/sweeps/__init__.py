"""Many runs over a grid of parameters."""

from .sweep import sweep

__all__ = ["sweep"]

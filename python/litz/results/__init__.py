"""The results of a run as numpy arrays, and what follows from them."""

from .results import Results

__all__ = ["Results"]

"""Runs of the program."""

from .run import check, run

__all__ = ["check", "run"]

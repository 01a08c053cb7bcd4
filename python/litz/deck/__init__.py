"""Decks as lists of cards, and the table of keywords that they are checked against."""

from .card import Card
from .deck import Deck

__all__ = ["Card", "Deck"]

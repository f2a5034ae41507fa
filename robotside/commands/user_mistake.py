"""A mistake of the user on the command line."""

from __future__ import annotations

__all__ = ["UserMistake"]


class UserMistake(Exception):
    """A mistake on the command line; the text is one sentence."""

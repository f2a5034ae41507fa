"""The refusal of a command, with its sentence for the operator."""

from __future__ import annotations

__all__ = ["Refusal"]


class Refusal(Exception):
    """The robot does not do what it was asked; the text is one sentence for the operator."""

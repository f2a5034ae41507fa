"""The refusal of a command, with its sentence for the operator."""

from __future__ import annotations

from robotside.core.notice import Notice

__all__ = ["OrderRefused", "Refusal"]


class Refusal(Exception):
    """The robot does not do what it was asked, for the reason that its notice gives."""

    def __init__(self, notice: Notice) -> None:
        super().__init__(notice)
        self.notice = notice
        """One sentence for the operator, with its code."""


class OrderRefused(Refusal, ValueError):
    """The robot does not follow an order to move, which changes nothing: what gave it ends, and the robot rests."""

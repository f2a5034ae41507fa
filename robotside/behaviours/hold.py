"""Staying where it is."""

from __future__ import annotations

import math

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from robotside.behaviours.course import Span
from robotside.behaviours.situation import Situation
from robotside.guide import Guide

__all__ = ["Hold"]


class Hold(Behaviour):
    """Stands until the time of `span` is over, for ever when it has none; a pause does not count."""

    def __init__(self, span: Span, guide: Guide, situation: Situation) -> None:
        super().__init__("hold")
        self._span, self._guide, self._situation = span, guide, situation

    def initialise(self) -> None:
        """Come to rest."""
        self._guide.rest()
        self._span.begin()

    def update(self) -> Status:
        """Stay."""
        lasts = self._span.duration
        text = "until it is stopped" if math.isnan(lasts) else f"for {lasts:.0f} s"
        self.feedback_message = f"Holding here {text}."
        self._situation.tell("holding", self.feedback_message)
        return Status.SUCCESS if self._span.over else Status.RUNNING

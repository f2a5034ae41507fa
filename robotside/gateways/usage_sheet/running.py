"""What a usage sheet is told of a gateway that is up; loaded with the robot, unlike the sheet."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Running"]


@dataclass(frozen=True, slots=True)
class Running:
    """A gateway that is up, beside rosbridge and the web site."""

    name: str
    doc: str
    """What it is, in a few words."""
    url: str
    guide: str
    """How it is used, with lines that can be pasted."""
    fault: str = ""
    """Why it does not reach its broker, as a sentence; empty when it does."""

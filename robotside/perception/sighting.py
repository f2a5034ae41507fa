"""A thing that was seen in a picture."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Sighting"]


@dataclass(frozen=True, slots=True)
class Sighting:
    """A thing in a picture. Lengths are parts of the picture: 0 is its left or upper edge, 1 the right or lower."""

    left: float
    top: float
    right: float
    bottom: float
    score: float
    """0 to 1."""
    kind: str = "cone"
    """One of `bridge.msgs.additions.DETECTED_CLASSES`."""

    @property
    def centre(self) -> float:
        """Across the picture."""
        return (self.left + self.right) / 2

    @property
    def width(self) -> float:
        """Part of the picture's width."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Part of the picture's height."""
        return self.bottom - self.top

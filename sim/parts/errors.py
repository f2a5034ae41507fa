"""What is wrong with the file of a part."""

from __future__ import annotations

__all__ = ["PartError"]


class PartError(ValueError):
    """A part that is not there or whose file is wrong; the text is the reason, without a full stop."""

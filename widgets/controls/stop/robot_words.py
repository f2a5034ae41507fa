"""Number of robots in words, with those that cannot be heard."""

from __future__ import annotations

from widgets.core.language import trn

__all__ = ["brief_robot_words", "robot_words"]


def robot_words(robots: int, lost: int = 0, silent: int = 0) -> str:
    """As in `3 robots, 1 lost, 1 silent`: of so many `robots`, `lost` were heard and are not now, `silent` were not heard yet."""
    parts = [trn("{count} robot", "{count} robots", robots)]
    if lost:
        parts.append(trn("{count} lost", "{count} lost", lost))
    if silent:
        parts.append(trn("{count} silent", "{count} silent", silent))
    return ", ".join(parts)


def brief_robot_words(robots: int, lost: int = 0, silent: int = 0) -> str:
    """As in `3 · 2 silent`, for little room: those that are lost are silent too; `3 robots` where all are heard."""
    if silent:
        return f"{robots} · " + trn("{count} silent", "{count} silent", lost + silent)
    if lost:
        return f"{robots} · " + trn("{count} lost", "{count} lost", lost)
    return trn("{count} robot", "{count} robots", robots)

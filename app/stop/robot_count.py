"""Number of robots, judged once for every place that says it: the connect page, the fleet, STOP ALL."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple, Protocol

from app.discovery.known_robots import Entry
from widgets.controls.stop.robot_words import brief_robot_words, robot_words

__all__ = ["RobotCount", "count"]

LIVE, LOST, SILENT = range(3)


class _Robot(Protocol):
    url: str


class Linked(Protocol):
    """The session with the connected robot, as far as counting needs it."""

    @property
    def connected(self) -> bool:
        """The link stands."""

    @property
    def ever_connected(self) -> bool:
        """A robot has answered there: the address is no slip of the pen."""

    @property
    def robot(self) -> _Robot:
        """Who it is."""

    @property
    def boot(self) -> str:
        """Alike for one robot under two addresses; empty while it is not known."""


class RobotCount(NamedTuple):
    """Robots that STOP ALL is for."""

    robots: int
    """All of them, each once; none where none was ever met."""
    lost: int
    """Of them were heard, or connected, and are not now."""
    silent: int
    """Of them were met on an earlier day and have not been heard yet."""

    @property
    def words(self) -> str:
        """As of `robot_words`."""
        return robot_words(*self)

    @property
    def brief_words(self) -> str:
        """As of `brief_robot_words`."""
        return brief_robot_words(*self)


def count(entries: Iterable[Entry], linked: Linked | None) -> RobotCount:
    """How many robots there are, one that says to be the same at two addresses counted once, as near as it is at either.

    Those that are saved or paired are never counted as another: what they say may be a stranger's claim. The one with a link
    is as near as that link.
    """
    here = linked.robot.url if linked is not None and linked.ever_connected else ""
    found: dict[str, int] = {}
    for entry in entries:
        if entry.met and entry.url != here:
            who = entry.url if entry.kept else entry.boot or entry.url
            stands = {"live": LIVE, "lost": LOST}.get(entry.state, SILENT)
            found[who] = min(stands, found.get(who, SILENT))
    if linked is not None and here:
        who = linked.boot or here
        found[who] = LIVE if linked.connected else min(LOST, found.get(who, LOST))
    stands_of = list(found.values())
    return RobotCount(len(found), stands_of.count(LOST), stands_of.count(SILENT))

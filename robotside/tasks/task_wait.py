"""The waits that no behaviour knows of: a task rests while it is asked where the robot is, or its computer is too slow.

Its timers stand still meanwhile, and it goes on by itself.
"""

from __future__ import annotations

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.navigation.navigator import Navigator
from robotside.tasks.behaviours.situation import Situation
from robotside.tasks.place_trust import ENDS_AT_PLACE

__all__ = ["TaskWait"]

GOES_BY_PLACE = (*ENDS_AT_PLACE, "dock", "undock", "follow_heading")
"""Tasks that move the robot by where it believes to be and by what it sees."""

ASKED = Notice(Code.TASK_PLACE_ASKED, "Unsure of its place: several fit. Choose the right one on the map.")

LATE = Notice(Code.TASK_LOOP_LATE, "Waiting: the robot's computer is too slow to drive by itself.")


class TaskWait:
    """Has the task wait that runs."""

    def __init__(self, navigator: Navigator, situation: Situation) -> None:
        self._navigator, self._situation = navigator, situation
        self._waits = False

    def waits(self, task: str) -> bool:
        """The `task` must not go on now: the robot rests, and it is reported why."""
        now = self._situation
        waits = (now.place_asked or now.late) and task in GOES_BY_PLACE
        if waits and not self._waits:
            self._navigator.rest()
        self._waits = waits
        if waits:
            now.report(*(("unsure", ASKED) if now.place_asked else ("waiting", LATE)), place=now.doing.place)
            now.forget_confirmation()  # a card that is read meanwhile answers nothing
        return waits

    def begin(self) -> None:
        """A task begins; the robot has to be brought to rest anew where it must not go on."""
        self._waits = False

"""Trust in the robot's place: a task is not done at a place that may be another one, whatever its behaviour."""

from __future__ import annotations

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.navigation.arrival_check import UNSURE_THERE
from robotside.tasks.behaviours.situation import Situation

__all__ = ["ENDS_AT_PLACE", "objection"]

ENDS_AT_PLACE = ("patrol", "deliver", "guide", "go_to", "go_home")
"""Tasks that are done where the robot is at a place; a charge proves by itself that it is at a dock."""


def objection(task: str, situation: Situation) -> Notice | None:
    """Why the `task` is not done though it came to its end; None when it is."""
    if situation.sure or task not in ENDS_AT_PLACE:
        return None
    return Notice(Code.TASK_PLACE_UNSURE, UNSURE_THERE, place=situation.doing.place)

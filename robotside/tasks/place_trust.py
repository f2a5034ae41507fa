"""Trust in the robot's place: a task is not done at a place that may be another one, whatever its behaviour."""

from __future__ import annotations

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.navigation.arrival_check import UNSURE_THERE
from robotside.tasks.behaviours.situation import Situation

__all__ = ["BY_WORD_THERE", "ENDS_AT_PLACE", "objection"]

ENDS_AT_PLACE = ("patrol", "deliver", "guide", "go_to", "go_home")
"""Tasks that are done where the robot is at a place; a charge proves by itself that it is at a dock."""


BY_WORD_THERE = "There by your word: nothing on the way told this place from one that looks alike. See for yourself, or drive on and look."
"""The same where an operator has said at which of several places it was, and no look has confirmed that since."""


def objection(task: str, situation: Situation) -> Notice | None:
    """Why the `task` is not done though it came to its end; None when it is."""
    if task not in ENDS_AT_PLACE or (situation.sure and not situation.by_word):
        return None
    said = BY_WORD_THERE if situation.sure else UNSURE_THERE
    return Notice(Code.TASK_PLACE_UNSURE, said, place=situation.doing.place)

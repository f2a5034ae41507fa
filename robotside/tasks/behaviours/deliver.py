"""The delivery: to the pick-up, ask, to the addressee, ask, and on to the next place, if there is one.

rounds ── leg ─┬─ choose the next place
               ├─ drive to point
               ├─ arrived
               ├─ ask
               └─ count it
"""

from __future__ import annotations

from collections.abc import Sequence as Places

from py_trees.behaviour import Behaviour
from py_trees.composites import Sequence

from bridge.core.codes import Code
from bridge.msgs.pilothouse_msgs import Place
from robotside.core.notice import Notice
from robotside.navigation.navigator import Navigator
from robotside.records.events import Say
from robotside.tasks.behaviours.acts import Action, Rounds
from robotside.tasks.behaviours.ask import AskAt, Question
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.drive_to import DriveTo
from robotside.tasks.behaviours.patrol import at_place
from robotside.tasks.behaviours.situation import Situation

__all__ = ["deliver"]


def deliver(
    places: Places[Place], message: str, tag: str, navigator: Navigator, situation: Situation, say: Say
) -> tuple[Course, Behaviour]:
    """From the first of `places` to the second, and on to the third if there is one.

    `message` is for the person at the second, `tag` what the reader reads of that one's card, empty for the place's own.
    """
    start, end = places[0], places[1]
    course = Course([at_place(place) for place in places])
    questions = [
        Question(f"Has it been picked up at {start.name}?", f"Picked up at {start.name}", message, start.tag),
        Question(f"Has it been taken at {end.name}?", f"Delivered at {end.name}", message, tag or end.tag),
    ]

    def arrived() -> bool:
        goal = course.goal
        reached = Notice(Code.WAYPOINT_REACHED, f"{goal.name} reached.", place=goal.name.rstrip(","))
        say("waypoint", reached, "ok", at=(goal.x, goal.y))
        return True

    def count() -> bool:
        course.reached()
        return True

    leg = Sequence(
        "leg",
        memory=True,
        children=[
            Action("choose", lambda: bool(course.advance())),
            DriveTo(course, navigator, situation),
            Action("arrived", arrived),
            AskAt(course, questions, situation, say),
            Action("count", count),
        ],
    )
    return course, Rounds("deliver", leg, lambda: course.finished)

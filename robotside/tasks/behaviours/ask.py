"""The question to a person: the robot stands until someone answers by a tap, or with the right card at the reader."""

from __future__ import annotations

from dataclasses import dataclass

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from bridge.core.codes import Code
from robotside.core.notice import Notice
from robotside.records.events import Say
from robotside.tasks.behaviours.course import Course
from robotside.tasks.behaviours.situation import Situation

__all__ = ["AskAt", "Question"]


@dataclass(frozen=True, slots=True)
class Question:
    """The question at one place."""

    asks: str
    """As in: Has it been picked up at Office 12?"""
    done: str
    """As a sentence begins when it was answered: Picked up at Office 12."""
    message: str = ""
    """For the person there; empty for no message."""
    tag: str = ""
    """The tag of the card that answers; empty when only a tap does."""


class AskAt(Behaviour):
    """Waits for the answer to the question of the course's point; succeeds at once where there is none."""

    def __init__(self, course: Course, questions: list[Question], situation: Situation, say: Say) -> None:
        """One question a point, as far as there are."""
        super().__init__("ask")
        self._course, self._questions, self._situation, self._say = course, questions, situation, say
        self._strange = ""

    def initialise(self) -> None:
        """Answers that were given before count no more."""
        self._situation.forget_confirmation()
        self._strange = ""
        question = self._question
        if question and question.message:
            goal = self._course.goal
            said = f"At {goal.spoken}: {question.message}"
            told = Notice(Code.MESSAGE_TOLD, said, place=goal.place, message=question.message)
            self._say("task", told, "info")

    def update(self) -> Status:
        """Wait."""
        question, now = self._question, self._situation
        if question is None:
            return Status.SUCCESS
        if now.confirmed_by:
            said, place = f"{question.done}, confirmed by {now.confirmed_by}.", self._course.goal.place
            given = Notice(Code.ANSWER_GIVEN, said, name=now.confirmed_by, place=place)
            self._say("task", given, "ok")
            return Status.SUCCESS
        if now.tag and now.tag == question.tag:
            said, place = f"{question.done}, confirmed by the card.", self._course.goal.place
            self._say("task", Notice(Code.ANSWER_BY_CARD, said, place=place), "ok")
            return Status.SUCCESS
        if now.tag and now.tag != self._strange:
            self._strange = now.tag
            self._say("task", self._refusal(question), "warn")
        goal = self._course.goal
        text = f"Waiting at {goal.spoken}: {question.message or question.asks}"
        now.report("waiting", text, place=goal.place, asks=question.asks)
        return Status.RUNNING

    @property
    def _question(self) -> Question | None:
        number = self._course.index
        return self._questions[number] if 0 <= number < len(self._questions) else None

    def _refusal(self, question: Question) -> Notice:
        goal = self._course.goal
        if not question.tag:
            said = f"No card is known for {goal.spoken}; confirm by a tap."
            return Notice(Code.CARD_UNKNOWN, said, place=goal.place)
        said = f"This is not the right card for {goal.spoken}."
        return Notice(Code.CARD_WRONG, said, place=goal.place)

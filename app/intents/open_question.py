"""The question that is open on the screen: of the robot, or of the app about it; and its answer by any method."""

from __future__ import annotations

from collections.abc import Callable

from app.intents.executor_app import ScreenApp
from app.intents.robot_access import HELD
from widgets.core.language import tr

__all__ = ["OpenQuestion"]


class OpenQuestion:
    """Of one app. Everything in the UI thread."""

    def __init__(self, app: ScreenApp) -> None:
        """`app` is asked for its `shell`."""
        self._app = app

    def _asked(self) -> Callable[[bool], str] | None:
        """What answers the question on the glass; None while nothing asks that can be answered now."""
        shell = self._app.shell
        if shell is None:
            return None
        handover, reset, question = shell.cards.handover, shell.reset.card, shell.question
        if reset.parent is not None and reset.asked and not reset.sent and not reset.blocked:
            return self._answer_reset
        if (
            handover.parent is not None
            and handover.part == "asked"
            and not (handover.sent or handover.blocked)
        ):
            return self._answer_handover
        if question.parent is not None and question.open and not question.blocked:
            return self._answer_question
        where = shell.standing.where
        if where.parent is not None and where.open and not where.blocked:
            return self._answer_where
        return None

    def answer(self, yes: bool) -> str:
        """Answer it; one sentence of what was answered, empty where nothing asks."""
        asked = self._asked()
        return asked(yes) if asked is not None else ""

    def why_not_answer(self) -> str:
        """Why nothing can be answered, in one sentence; empty where something asks."""
        return "" if self._asked() is not None else tr("Nothing is asked just now.")

    def why_not_yes(self) -> str:
        """A task that was cut short is not resumed while STOP is pressed; that it be ended can be said."""
        if self._asked() == self._answer_question:
            card = self._app.shell.question
            if card.cut and card.held:
                return tr("{question} Not yet: {held}").format(question=card.question, held=tr(HELD))
        return self.why_not_answer()

    def _answer_reset(self, yes: bool) -> str:
        card = self._app.shell.reset.card
        (card.press if yes else card.close)()
        return tr("Put {name} back: {value}.").format(name=card.name, value=tr("yes") if yes else tr("no"))

    def _answer_handover(self, yes: bool) -> str:
        self._app.shell.cards.handover.ask("grant" if yes else "object")
        return tr("Control is handed over.") if yes else tr("Control is kept.")

    def _answer_where(self, yes: bool) -> str:
        """Yes says that the robot is at the first of its candidates, which the card says; no leads to the map."""
        card = self._app.shell.standing.where
        asked = card.headline
        if yes:
            card.choose(0)
            return f"{asked} {card.places[0].text}."
        card.dispatch("on_by_hand")
        return tr("{asked} Not yet.").format(asked=asked)

    def _answer_question(self, yes: bool) -> str:
        card = self._app.shell.question
        asked = card.question
        if card.cut:
            card.ask("resume" if yes else "cancel")
        elif yes:
            card.ask("confirm")
        else:
            return tr("{asked} Not yet.").format(asked=asked)
        return f"{asked} {tr('Yes') if yes else tr('No')}."

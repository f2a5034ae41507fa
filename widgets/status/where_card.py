"""The robot's question at which of several places of its map it is: a button for each, and one to place it by hand.

card = WhereCard()
robot.on("/localisation/candidates", card.show)
card.bind(on_choose=lambda _, number: commands.ask("choose_place", id=number))
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from kivy.properties import BooleanProperty, ListProperty, StringProperty
from kivy.uix.widget import Widget

from bridge.msgs.pilothouse_msgs import PlaceCandidate, PlaceCandidates
from widgets.core.candidate_letters import candidate_letters, share_words
from widgets.core.language import tr
from widgets.status.notice_card import NoticeCard

__all__ = ["MAX_BUTTONS", "WhereCard"]

MAX_BUTTONS = 3
"""Candidates that have a button here; all of them can be chosen on the map."""


class WhereCard(NoticeCard):
    """Dispatches `on_choose(number)` with the id of a candidate, or `on_by_hand` where it is none of them, `on_look` to see them on the map."""

    accepts = (PlaceCandidates,)
    __events__ = ("on_choose", "on_by_hand", "on_look")

    candidates: ListProperty[PlaceCandidate] = ListProperty()
    """Those that are asked about, the likeliest first; empty while nothing is asked."""
    why_not = StringProperty("")
    """Why it cannot be answered here, as one sentence; empty when it can."""

    mapped = BooleanProperty(True)
    """They are seen on a map beside the card and can be tapped there."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(icon="help", role="warn", **kwargs)
        self.look = self.add_beside(tr("Map"), "map")
        self.look.bind(on_release=lambda _: self.dispatch("on_look"))
        places = [("", "place", True)] * MAX_BUTTONS
        *self.places, self.by_hand = self.add_below(*places, (tr("By hand"), "edit", False))
        self._row = self.by_hand.parent
        for number, button in enumerate(self.places):
            button.bind(on_release=lambda _, number=number: self.choose(number))
        self.by_hand.bind(on_release=lambda _: self.dispatch("on_by_hand"))
        for name in ("candidates", "why_not", "blocked", "tiny", "mapped"):
            self.fbind(name, self._write)
        self._write()

    def on_choose(self, number: int) -> None:
        """The operator says that the robot is at the candidate of this id."""

    def on_by_hand(self) -> None:
        """The operator wants to point at the robot's place."""

    def on_look(self) -> None:
        """The operator wants to see where they are."""

    def show(self, msg: PlaceCandidates) -> None:
        """Take over what the robot asks; fewer than two candidates are no question."""
        self.candidates = list(msg.candidates) if len(msg.candidates) > 1 else []
        self.open = bool(self.candidates)

    def choose(self, index: int) -> None:
        """Answer with a candidate, as a finger would."""
        if index < len(self.candidates) and not self.blocked:
            self.dispatch("on_choose", self.candidates[index].id)

    def _write(self, *_: object) -> None:
        letters = candidate_letters(self.candidates)
        self.headline = tr("Am I at {places}?").format(places=_either(letters))
        words = (
            tr("Tap the right one on the map or here; yes means {place}.")
            if self.mapped
            else tr("The map shows them; yes means {place}.")
        )
        tap = words.format(place="".join(letters[:1]))
        row = self.ids.row
        if self.mapped != (self.look.parent is None):
            (row.remove_widget if self.mapped else row.add_widget)(self.look)
            self._fit()
        self.said = self.why_not or ("" if self.tiny else tap)
        for index, button in enumerate(self.places):
            shown = index < len(self.candidates)
            if shown != (button.parent is self._row):
                (self._row.add_widget(button, index=1) if shown else self._row.remove_widget(button))
            if shown:
                button.text = f"{letters[index]} · {share_words(self.candidates[index].share)}"
                button.meaning = self.headline
            button.disabled = self.blocked
        self.by_hand.disabled = self.blocked


def _either(letters: Sequence[str]) -> str:
    """As in `A, B or C`."""
    if len(letters) < 2:
        return "".join(letters)
    return tr("{names} or {last}").format(names=", ".join(letters[:-1]), last=letters[-1])


def samples() -> dict[str, Callable[[], Widget]]:
    """Two and three candidates, and a handheld that cannot answer."""
    found = [
        PlaceCandidate(1, 2.0, 1.0, 0.0, 0.61, 0.1),
        PlaceCandidate(2, 6.5, 1.0, 0.0, 0.39, 0.1),
        PlaceCandidate(3, 11.0, 1.0, 0.0, 0.2, 0.1),
    ]

    def make(count: int, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            card = WhereCard(size_hint_x=None, width="420dp", **kwargs)
            card.show(PlaceCandidates(candidates=found[:count]))
            return card

        return build

    return {
        "two": make(2),
        "three": make(3),
        "another has control": make(2, blocked=True, why_not="Anna has control and can answer."),
    }

"""The card over the map that asks for a place: its name, kind and direction, and what is to become of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec
from kivy.lang import Builder
from kivy.properties import BooleanProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout

from app.link.commands import Outcome
from app.screens.mission.place_pane import PlacePane
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Place
from widgets.core.language import tr
from widgets.parts.kit import Card, IconButton, PrimaryButton, QuietButton

__all__ = ["PlaceCard"]

Builder.load_string("""
<PlaceCard>:
    size_hint: None, None
    outline: 'accent'
    padding: dp(12), dp(4), dp(12), dp(12)
    spacing: dp(8)
""")


class CardButton(IconButton):
    """One of the head of the card, which has no room for its words."""

    scan_words = StringProperty("")
    """What it does, for a switch that steps over it."""


class PlaceCard(Card):
    """Dispatches `on_shut` once it has been saved, deleted or left, `on_move(place)` when a tap is to say where it is, and
    `on_go(place)` to have the robot go there."""

    __events__ = ("on_shut", "on_move", "on_go")

    edited = BooleanProperty(False)
    """Something of it was changed here and is not saved."""

    def __init__(self, session: Session, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session = session
        self.pane = PlacePane(session)
        self.form = self.pane.form
        self.form.bind(on_command=self._changed)
        self.pane.head.closable = True
        self.pane.head.bind(on_close=lambda _: self.leave())
        self._existing = [
            self._icon("near_me", tr("Go there"), lambda: self.dispatch("on_go", self.form.shown)),
            self._icon("edit_location_alt", tr("Move"), lambda: self.dispatch("on_move", self.form.place)),
            self._icon("delete", tr("Delete"), self._delete),
        ]
        self.save = PrimaryButton(text=tr("Save"), icon="check")
        self.save.bind(on_release=lambda _: self._keep())
        self.cancel = QuietButton(text=tr("Cancel"))
        self.cancel.bind(on_release=lambda _: self.leave())
        row = BoxLayout(size_hint_y=None, height=self.save.height, spacing="8dp")
        self.save.bind(height=row.setter("height"))
        for button in (self.cancel, self.save):
            row.add_widget(button)
        self.add_widget(self.pane)
        self.add_widget(row)

    def _icon(self, icon: str, words: str, act: Callable[[], object]) -> CardButton:
        button = CardButton(icon=icon, bare=True, scan_words=words, pos_hint={"center_y": 0.5})
        button.bind(on_release=lambda _: act())
        return button

    def edit(self, place: Place) -> None:
        """Ask for this place: a new one has the id 0."""
        self.pane.open = True
        self.pane.edit(place)
        line = self.pane.head.ids.line
        for button in self._existing:
            if button.parent is not None:
                button.parent.remove_widget(button)
            if place.id:
                line.add_widget(button)
        self.edited = False
        self.tick()

    def move_to(self, x: float, y: float) -> None:
        """Have it lie at (x, y) in `map` [m]; what was typed stays."""
        self.form.shown = msgspec.structs.replace(self.form.shown, x=x, y=y)
        self._changed()
        self.pane.refresh()

    @property
    def place(self) -> Place:
        """The place as it stands on the card."""
        return self.form.place

    def tick(self) -> None:
        """What cannot be asked for just now cannot be pressed."""
        mine = self._session.may_ask
        go, _, delete = self._existing
        self.save.disabled = not mine or bool(self.form.lacking)
        delete.disabled = not mine
        go.disabled = not self._session.robot.knows("go_to")

    def on_outcome(self, outcome: Outcome) -> None:
        """What became of a command: a place that the robot refused comes back with all that was typed."""
        self.pane.on_outcome(outcome)

    def rest(self) -> None:
        """Fingers let go of what they hold, and the keyboard goes."""
        self.pane.rest()

    def on_touch_down(self, touch: Any) -> bool:
        """The map behind the card gets no finger that comes down on it."""
        return bool(super().on_touch_down(touch)) or bool(self.collide_point(*touch.pos))

    def _changed(self, *_: object) -> None:
        self.edited = True
        self.tick()

    def _keep(self) -> None:
        self.pane.keep()
        self._shut()

    def _delete(self) -> None:
        self.pane.forget()
        self._shut()

    def leave(self) -> None:
        """Ask no more; what was typed is given up."""
        self.form.show(Place())
        self._shut()

    def _shut(self) -> None:
        self.rest()
        self.pane.open = False
        self.edited = False
        self.dispatch("on_shut")

    def on_shut(self) -> None:
        """It has nothing more to ask."""

    def on_move(self, place: Place) -> None:
        """The next tap on the map is to say where `place` is."""

    def on_go(self, place: Place) -> None:
        """The robot is to go to `place`."""

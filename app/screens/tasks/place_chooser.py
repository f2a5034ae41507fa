"""The map beside the form of an order: a tap on a place chooses it, and what is chosen is numbered in its order."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.session.dashboard import Dashboard
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Place, PlaceArray
from widgets import GridMap
from widgets.core.language import tr
from widgets.tasks.order_form import OrderForm

__all__ = ["PlaceChooser"]

Builder.load_string("""
<PlaceChooser>:
    orientation: 'vertical'
    spacing: dp(6)
    Text:
        text: root.hint
        role: 'muted'
        font_size: sp(14)
""")


class PlaceChooser(BoxLayout):
    """Takes the places of one form from a finger on the map."""

    hint = StringProperty("")
    """What a tap does."""

    def __init__(self, form: OrderForm, session: Session, dashboard: Dashboard, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._form = form
        self._told = PlaceArray()
        self.map = GridMap(mode="place")
        self.map.bind(
            on_open_place=lambda _, index: self._choose(index),
            on_new_place=lambda *_: self._miss(),
        )
        self.add_widget(self.map)
        form.bind(places=self._mark, task=self._mark)
        shows: dict[str, Callable[[Any], None]] = {
            "/map": self.map.show,
            "/limits": self.map.show,
            "/pose": self.map.show,
            "/localisation/candidates": self.map.show,
            "/places": self._show_places,
        }
        for topic, show in shows.items():
            dashboard.bind(self.map, topic, show, fresh=topic == "/pose")
            newest = session.feeds.latest(topic)
            if newest is not None:
                show(newest)
        self._mark()

    def rest(self) -> None:
        """Fingers let go of what they hold."""
        self.map.let_go()

    def _show_places(self, msg: PlaceArray) -> None:
        self._told = msg
        self._mark()

    def _choose(self, index: int) -> None:
        if index < len(self._told.places):
            self._form.choose(self._told.places[index])

    def _miss(self) -> None:
        self.hint = tr("There is no place with a name. Make one on the mission's map.")

    def _mark(self, *_: object) -> None:
        """The numbers of the chosen ones; a line between them where the robot goes from one to the next."""
        named: dict[str, Place] = {place.name: place for place in self._told.places}
        chosen = [named[name] for name in self._form.places if name in named]
        self.map.places = [
            (place.x, place.y, place.name, "" if place in chosen else place.kind or "place")
            for place in self._told.places
        ]
        self.map.waypoints = [(place.x, place.y) for place in chosen]
        self.map.motion_name = "loop" if len(chosen) < 3 or self._form.task == "patrol" else "random"
        self.hint = tr("Tap a place to choose it.") if self._told.places else tr("There are no places yet.")

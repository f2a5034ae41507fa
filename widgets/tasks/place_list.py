"""Places by name, to choose one: searched, grouped by floor and kind, the nearest first.

places = PlaceList()
robot.on("/places", places.show), robot.on("/pose", places.show)
places.bind(on_command=lambda _, place: print(place.name))
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from typing import Any

from kivy.lang import Builder
from kivy.properties import ListProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.text_field  # noqa: F401 - its rules draw the search
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Place, PlaceArray
from widgets.core.base import Control
from widgets.core.language import mark, tr
from widgets.core.task_words import KINDS, distance_words
from widgets.parts.labels import Text
from widgets.parts.rows import ListRow, group_label

__all__ = ["PlaceList", "found", "grouped"]

MAX_ROWS = 60
"""Rows shown at once; a search finds the others."""
MIN_MOVE = 1.0
"""Distances are updated when the robot has moved farther [m]."""

Builder.load_string("""
<PlaceList>:
    orientation: 'vertical'
    spacing: theme.gap * .6
    TextField:
        id: search
        hint_text: tr('Search by name, kind or floor')
        text: root.search
        on_text: root.search = self.text
    Roll:
        id: roll
        Column:
            id: column
            spacing: dp(6)
""")


def natural(name: str) -> list[tuple[int, int, str]]:
    """How a name is sorted: Office 9 before Office 12."""
    parts = re.findall(r"\d+|\D+", name.casefold())
    return [(0, int(part), "") if part.isdecimal() else (1, 0, part.strip()) for part in parts]


def found(places: Sequence[Place], search: str) -> list[Place]:
    """The places whose name, kind, floor or note have every word of `search`, in any case."""
    words = search.casefold().split()

    def text(place: Place) -> str:
        return f"{place.name} {place.kind} floor {place.floor} {place.note}".casefold()

    return [place for place in places if all(word in text(place) for word in words)]


def grouped(places: Sequence[Place], robot: Sequence[float]) -> list[tuple[str, list[Place]]]:
    """Floor and kind in words to the places there, the nearest first; by name while `robot` (x, y) is NaN."""
    located = math.isfinite(robot[0])

    def rank(place: Place) -> tuple[float, list[tuple[int, int, str]]]:
        return away(place, robot) if located else 0.0, natural(place.name)

    groups: dict[str, list[Place]] = {}
    for place in sorted(places, key=rank):
        word = tr(KINDS.get(place.kind, KINDS["place"])[2])
        groups.setdefault(tr("Floor {floor} · {word}").format(floor=place.floor, word=word), []).append(place)
    if located:
        return list(groups.items())
    return sorted(groups.items(), key=lambda group: natural(group[0]))


def away(place: Place, robot: Sequence[float]) -> float:
    """From the robot to a place as the crow flies [m]; NaN while it is not located."""
    return math.dist((place.x, place.y), robot[:2])


class PlaceList(Control, BoxLayout):
    """Dispatches `on_command(place)` for the row that was pressed."""

    accepts = (PlaceArray, PoseWithCovarianceStamped)
    sends = (Place,)

    places: ListProperty[Place] = ListProperty()
    """Every `Place` that there is."""
    robot: ListProperty[float] = ListProperty([math.nan, math.nan])
    """Where the robot is: x, y [m]; NaN while that is not known."""
    search = StringProperty("")
    """What is looked for; empty shows all."""
    chosen: ListProperty[str] = ListProperty()
    """Names of the places that stand out."""
    nothing = StringProperty(mark("No places yet. Hold a finger on the map to add one."))
    """What to say while there are no places."""

    def __init__(self, **kwargs: Any) -> None:
        self._rows: dict[int, ListRow] = {}
        self._measured = [math.nan, math.nan]
        super().__init__(**kwargs)
        self.bind(places=self.refresh, search=self.refresh, chosen=self._mark, nothing=self.refresh)
        self.refresh()

    def show(self, msg: Msg) -> None:
        """Take over the places, or where the robot is; the rows change their order only with the places or the search."""
        if isinstance(msg, PlaceArray):
            if list(msg.places) != list(self.places):
                self.places = list(msg.places)
        elif isinstance(msg, PoseWithCovarianceStamped):
            self._locate(msg)
        else:
            super().show(msg)

    def _locate(self, msg: PoseWithCovarianceStamped) -> None:
        self.robot = [msg.pose.pose.position.x, msg.pose.pose.position.y]
        if not math.isfinite(self._measured[0]):
            self.refresh()
        elif math.dist(self._measured, self.robot) > MIN_MOVE:
            self._measured = list(self.robot)
            for place in self.places:
                if place.id in self._rows:
                    self._rows[place.id].aside = distance_words(away(place, self.robot))

    def refresh(self, *_: object) -> None:
        """Make the rows anew, in the order of where the robot is now."""
        self._measured, self._rows = list(self.robot), {}
        column, left = self.ids.column, MAX_ROWS
        column.clear_widgets()
        hits = found(self.places, self.search)
        for title, places in grouped(hits, self.robot):
            if left <= 0:
                break
            column.add_widget(group_label(title))
            for place in places[:left]:
                column.add_widget(self._row(place))
            left -= len(places)
        if left < 0:
            column.add_widget(Text(text=tr("{left} more: search for them.").format(left=-left), role="muted"))
        if not hits:
            sentence = (
                tr("No place is called “{search}”.").format(search=self.search)
                if self.places
                else tr(self.nothing)
            )
            column.add_widget(Text(text=sentence, role="muted"))
        self.ids.roll.scroll_y = 1
        self._mark()

    def _row(self, place: Place) -> ListRow:
        far = away(place, self.robot)
        row = ListRow(
            icon=KINDS.get(place.kind, KINDS["place"])[0],
            title=place.name,
            detail=place.note,
            aside=distance_words(far) if math.isfinite(far) else "",
        )
        row.bind(on_release=lambda _: self.dispatch("on_command", place))
        self._rows[place.id] = row
        return row

    def _mark(self, *_: object) -> None:
        for place in self.places:
            if place.id in self._rows:
                self._rows[place.id].chosen = place.name in self.chosen
                self._rows[place.id].role = "accent" if place.name in self.chosen else "muted"


SOME = [
    Place(id=1, name="Office 12", kind="office", floor="1", x=3.0, y=1.0, note="Ms. Weber, second door"),
    Place(id=2, name="Office 9", kind="office", floor="1", x=9.0, y=1.0),
    Place(id=3, name="Lab", kind="lab", floor="0", x=1.0, y=8.0, note="Goggles, please"),
    Place(id=4, name="Reception", kind="reception", floor="0", x=0.0, y=0.0),
    Place(id=5, name="Charger", kind="dock", floor="0", x=-2.0, y=0.0, yaw=0.0),
]
"""For the samples here and elsewhere."""


def samples() -> dict[str, Callable[[], Widget]]:
    """Places near and far, a search, nothing found, none there."""

    def make(places: list[Place] = SOME, **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            widget = PlaceList(size_hint=(None, None), size=("360dp", "420dp"), **kwargs)
            widget.show(PlaceArray(places=places))
            return widget

        return build

    return {
        "by name": make(),
        "nearest first": make(robot=[2.0, 1.0], chosen=["Office 12"]),
        "searched": make(search="lab"),
        "not found": make(search="Office 99"),
        "none": make([]),
    }

"""Place with its name, kind, floor, note and tag, to be made or changed; its position is pointed at, never typed.

form = PlaceForm()
form.show(Place(name="Office 12", kind="office", x=3.0, y=1.0))
form.bind(on_command=lambda _, place: print(place))
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from kivy.lang import Builder
from kivy.properties import AliasProperty, ListProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

import widgets.parts.text_field  # noqa: F401 - its rules draw the fields
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import Place
from widgets.controls.heading_dial import HeadingDial
from widgets.core.base import Control
from widgets.core.language import tr
from widgets.core.task_words import KINDS, heading_of
from widgets.tasks.place_list import SOME
from widgets.tasks.task_chooser import TaskTile

__all__ = ["PlaceForm"]

MAX_LENGTHS = {"name": 60, "floor": 20, "tag": 100, "note": 200}
"""Characters of what is typed."""

Builder.load_string("""
<PlaceForm>:
    Roll:
        Column:
            id: column
            spacing: dp(8)
            TextField:
                id: name
                hint_text: tr('Name, as in Office 12')
                label: tr('Name')
                on_text: root.type('name', self.text)
            Grid:
                id: kinds
                cols: 4 if self.width < dp(560) else 7
                spacing: dp(6)
            TextField:
                id: note
                hint_text: tr('Announcement for people led here')
                label: tr('Announcement for people led here')
                on_text: root.type('note', self.text)
            BoxLayout:
                size_hint_y: None
                height: theme.target
                spacing: dp(8)
                Text:
                    text: tr('Floor')
                    role: 'muted'
                    size_hint_x: None
                    width: dp(44)
                    pos_hint: {'center_y': .5}
                TextField:
                    id: floor
                    hint_text: '0'
                    size_hint_x: .35
                    on_text: root.type('floor', self.text)
                TextField:
                    id: tag
                    hint_text: tr('Tag of the person here')
                    label: tr('Tag of the person here')
                    on_text: root.type('tag', self.text)
            Segmented:
                id: way
                options: [('any', tr('Stands in any direction')), ('set', tr('Faces {heading}').format(heading=root.faces))]
                value: 'any' if root.yaw != root.yaw else 'set'
                on_choose: root.face(args[1])
""")


class PlaceForm(Control, BoxLayout):
    """Dispatches `on_command(place)` at every change. Where it lies stays what `show` was given."""

    accepts = (Place, PoseWithCovarianceStamped)
    sends = (Place,)

    shown: ObjectProperty[Place] = ObjectProperty(Place())
    """The place as it came."""
    name = StringProperty("")
    kind = StringProperty("place")
    floor = StringProperty("0")
    tag = StringProperty("")
    note = StringProperty("")
    yaw = NumericProperty(math.nan)
    """Direction to stand in [rad]; NaN for any."""
    taken: ListProperty[str] = ListProperty()
    """Names of the other places."""

    def _place(self) -> Place:
        was = self.shown
        name, kind, floor = (text.strip() for text in (self.name, self.kind, self.floor))
        tag, note = self.tag.strip(), self.note.strip()
        return Place(was.id, name, kind, floor, was.x, was.y, self.yaw, tag, note, was.height)

    place = AliasProperty(_place, bind=["shown", "name", "kind", "floor", "tag", "note", "yaw"])
    """What it says so far."""

    def _faces(self) -> str:
        return heading_of(self.yaw) if math.isfinite(self.yaw) else tr("one way")

    faces = AliasProperty(_faces, bind=["yaw"], cache=True)
    """The direction to stand in as a heading, `one way` while there is none."""

    def _lacking(self) -> str:
        name = self.name.strip()
        if not name:
            return tr("Enter a name.")
        if name.casefold() in {other.casefold() for other in self.taken}:
            return tr("There is a {name} already. Choose another name.").format(name=name)
        if self.kind == "dock" and math.isnan(self.yaw):
            return tr("Set the direction in which the robot docks.")
        return ""

    lacking = AliasProperty(_lacking, bind=["name", "taken", "kind", "yaw"])
    """What is missing before it can be stored, as one sentence; empty when nothing is."""

    def __init__(self, **kwargs: Any) -> None:
        self._tiles: dict[str, TaskTile] = {}
        self.dial = HeadingDial(pos_hint={"center_x": 0.5})
        super().__init__(**kwargs)
        for kind, (icon, word, _) in KINDS.items():
            tile = self._tiles[kind] = TaskTile(icon=icon, text=tr(word))
            tile.bind(on_release=lambda _, kind=kind: self.set(kind=kind))
            self.ids.kinds.add_widget(tile)
        self.dial.bind(on_command=lambda _, yaw: self.set(yaw=yaw))
        self.bind(kind=self._mark, yaw=self._mark)
        self._mark()

    def show(self, msg: Msg) -> None:
        """Take over a place to be changed, or draw where the robot points; nothing is dispatched."""
        if isinstance(msg, PoseWithCovarianceStamped):
            self.dial.show(msg)
            return
        if not isinstance(msg, Place):
            super().show(msg)
            return
        self.shown = msg
        for name in ("name", "kind", "floor", "tag", "note", "yaw"):
            setattr(self, name, getattr(msg, name))
        for name in MAX_LENGTHS:
            self.ids[name].text = getattr(msg, name)
        self.dial.value = msg.yaw

    def set(self, **changes: Any) -> None:
        """Change `kind`, `yaw` or what is typed, as a finger would."""
        for name, value in changes.items():
            setattr(self, name, value)
        self.dispatch("on_command", self.place)

    def type(self, name: str, text: str) -> None:
        """Take what was typed; what the robot would cut off cannot be typed."""
        if len(text) > MAX_LENGTHS[name]:
            self.ids[name].text = text[: MAX_LENGTHS[name]]
        elif text != getattr(self, name):
            self.set(**{name: text})

    def face(self, way: str) -> None:
        """Let it stand in `any` direction or in one that is `set`, which begins with the robot's own."""
        here = self.dial.robot if math.isfinite(self.dial.robot) else 0.0
        self.dial.value = math.nan if way == "any" else here
        self.set(yaw=self.dial.value)

    def rest(self) -> None:
        """Let the dial go, and the keyboard."""
        self.dial.rest()
        for name in MAX_LENGTHS:
            self.ids[name].focus = False

    def _mark(self, *_: object) -> None:
        for kind, tile in self._tiles.items():
            tile.chosen = kind == self.kind
        column, wanted = self.ids.column.__self__, math.isfinite(self.yaw)
        if wanted != (self.dial.parent is column):
            (column.add_widget if wanted else column.remove_widget)(self.dial)


def samples() -> dict[str, Callable[[], Widget]]:
    """A new one, one to be changed, one with a direction, one that cannot be changed now."""

    def make(place: Place, high: str = "400dp", **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            form = PlaceForm(size_hint=(None, None), size=("388dp", high), **kwargs)
            form.show(place)
            return form

        return build

    return {
        "new": make(Place()),
        "changed": make(SOME[0]),
        "with a direction": make(SOME[4], "600dp"),
        "disabled": make(SOME[0], state="disabled"),
    }

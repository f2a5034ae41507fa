"""Editing by a finger on the map: points, home, places, and the place of the robot."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Protocol

from kivy.metrics import dp
from kivy.uix.widget import Widget

from app.missions.mission_editor import Draft
from app.missions.refusals import summary
from app.screens.mission.map_places import MapPlaces
from app.screens.mission.selection_bar import SelectionBar
from app.screens.shell.screen_host import ScreenHost
from app.session.session import Session
from widgets.core.language import mark, tr
from widgets.map.map_measure import total_words
from widgets.map.map_overlay import MapOverlay
from widgets.parts.kit import IconButton, PrimaryButton, QuietButton

__all__ = ["MODES", "MapPointing"]

MODES = [
    ("view", mark("View")),
    ("points", mark("Points")),
    ("home", mark("Home")),
    ("place", mark("Place")),
    ("place_robot", mark("Robot")),
]
"""What a finger on the map does, and its word."""
HINTS = {
    "points": mark("Tap to add a point, drag to move one."),
    "home": mark("Tap where the robot shall return to."),
    "place": mark("Tap to make or change a place."),
    "place_robot": mark("Drag it, turn it."),
    "measure": mark("Tap the places to measure between."),
}


class EditedMap(Protocol):
    """The mission screen, as far as fingers on its map need it."""

    ids: Any

    @property
    def app(self) -> ScreenHost:
        """The app behind the screen."""

    @property
    def map(self) -> MapOverlay:
        """The map on the glass."""

    @property
    def mode(self) -> str:
        """What a finger on the map does: one of `MODES`."""

    @mode.setter
    def mode(self, value: str) -> None: ...

    def show_selection(self, shown: bool) -> None:
        """Have the bar that says what is selected on the glass, or away."""

    def show_card(self, card: Widget | None) -> None:
        """Have a card over the map, beside which what it asks of is seen; None takes it away."""


class MapPointing:
    """The fingers on the map of one mission screen, and the bar that says what they hold."""

    def __init__(self, screen: EditedMap, session: Session) -> None:
        """`screen` is the MissionScreen: its map, its mode, the app behind it."""
        self._screen, self._session = screen, session
        self.bar = SelectionBar()
        self.places = MapPlaces(screen, session, self.show)
        self._judged: dict[str, str] = {}
        """Name of each point and of home that the robot would refuse where it is now, to why."""
        self._ids: dict[str, Any] = {}
        self._build()

    def _build(self) -> None:
        for button, icon, act in (
            ("earlier", "arrow_upward", lambda *_: self._reorder(-1)),
            ("later", "arrow_downward", lambda *_: self._reorder(1)),
            ("delete", "delete", lambda *_: self._delete()),
        ):
            widget = IconButton(icon=icon, bare=True, pos_hint={"center_y": 0.5})
            widget.bind(on_release=act)
            self._ids[button] = widget
        for button, text, width, act in (
            ("place_cancel", tr("Cancel"), "78dp", lambda *_: setattr(self._screen, "mode", "view")),
            ("place_here", tr("Set here"), "88dp", lambda *_: self._place_robot()),
            ("home_here", tr("Here"), "78dp", lambda *_: self._home_here()),
            ("measure_done", tr("Done"), "78dp", lambda *_: self.measure()),
        ):
            kind = QuietButton if button in ("place_cancel", "measure_done") else PrimaryButton
            word = kind(text=text, size_hint=(None, None), width=width, pos_hint={"center_y": 0.5})
            # a target as high as gloves need would stick out of the bar
            word.bind(on_release=act, height=lambda one, _: setattr(one, "height", dp(40)))
            word.height = dp(40)
            self._ids[button] = word
        self._screen.ids.update(self._ids)

    def follow(self, one: MapOverlay) -> None:
        """Do what fingers on this map ask for."""
        mission = self._session.mission
        one.bind(
            on_add=lambda _, x, y: mission.add(x, y),
            on_move=lambda _, index, x, y: mission.move(index, x, y),
            on_select=lambda *_: self.show(),
            on_set_home=lambda _, x, y: mission.set_home(x, y),
            on_new_place=lambda _, x, y: self.places.point(x, y),
            on_open_place=lambda _, index: self.places.open_at(index),
            on_choose_candidate=lambda _, number: self._session.command("choose_place", id=number),
            grip=self._say,
            measured=lambda *_: self.show(),
            fence=self._say,
            robot_radius=self._say,
        )

    @property
    def can_place(self) -> bool:
        """The robot can be told where it is."""
        offer = self._session.robot.capabilities
        return offer is None or offer.ours or not offer.rosapi or "/initialpose" in offer.topics

    def modes(self) -> list[tuple[str, str]]:
        """A finger on the map can do only what this robot takes."""
        lacks = self._session.robot.lacks_tasks
        modes = [one for one in MODES if not lacks or one[0] == "view"]
        if lacks and self.can_place:
            modes.append(MODES[-1])
        return [(name, tr(words)) for name, words in modes]

    def mode_changed(self) -> None:
        """Another mode was chosen."""
        if self._screen.mode != "place":
            self.places.stay()
        self.show()

    def commanded(self, name: str) -> None:
        """Who commands the robot, but for its end, is not placing it any more; what is refused leaves who draws to mend it."""
        if self._screen.mode == "place_robot" and name != "stop":
            self._screen.mode = "view"

    def set_going(self) -> None:
        """The robot drives: nobody places it any more, nor draws its way, which a tap that is meant otherwise would change."""
        if self._screen.mode in ("place_robot", "points", "home"):
            self._screen.mode = "view"

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self.places.tick()
        self._ids["place_here"].disabled = not self._session.connected or not self.can_place

    # the bar

    def show(self) -> None:
        """Bring the bar up to date: what is selected, and what can be done with it."""
        bar, row = self.bar, self.bar.ids.row
        bar.text, wanted = self._said()
        self._say()
        for child in row.children[:-1]:
            row.remove_widget(child)
        for name in wanted:
            row.add_widget(self._ids[name])
        self._screen.show_selection(bool(bar.text))

    def _said(self) -> tuple[str, tuple[str, ...]]:
        """The words of the bar and the names of its buttons."""
        screen, index, count = self._screen, int(self._screen.map.selected), len(self._screen.map.waypoints)
        if screen.mode == "place_robot":
            hint = tr(HINTS["place_robot"]) if self.can_place else tr("It takes no /initialpose.")
            return hint, ("place_cancel", "place_here")
        if screen.mode == "points" and 0 <= index < count:
            self._ids["earlier"].disabled = index == 0
            self._ids["later"].disabled = index == count - 1
            said = tr("Point {number} of {count}").format(number=index + 1, count=count)
            return said, ("earlier", "later", "delete")
        if self.places.asks:
            return self.places.asks, ()
        if screen.mode == "home":
            return tr(HINTS["home"]), ("home_here",) if screen.map.located else ()
        if screen.mode == "measure":
            return total_words(screen.map.measured) or tr(HINTS["measure"]), ("measure_done",)
        return tr(HINTS.get(screen.mode, "")), ()

    def _trouble(self) -> str:
        """Why the robot would refuse what is being edited, as one sentence; empty when it would not."""
        screen, area, index = self._screen, self._screen.map, int(self._screen.map.selected)
        found = self._judged
        if screen.mode == "home":
            return found.get(tr("Home"), "")
        points = {name: said for name, said in found.items() if name != tr("Home")}
        if screen.mode != "points" or not points:
            return ""
        if 0 <= index < len(area.waypoints):
            return points.get(tr("Point {number}").format(number=index + 1), "")
        return summary(points.values())

    def _held(self) -> Draft:
        """The draft with what a finger holds where the finger has brought it."""
        draft, grip = self._session.mission.draft, self._screen.map.grip
        if grip is None or not grip.moved:
            return draft
        if grip.what == "home":
            return replace(draft, home=(grip.x, grip.y))
        points = list(draft.points)
        if grip.what == "waypoint" and grip.index < len(points):
            points[grip.index] = (grip.x, grip.y)
        return replace(draft, points=tuple(points))

    def _say(self, *_: object) -> None:
        self.judge()

    def judge(self) -> None:
        """Mark what the robot would refuse, and say why in the bar."""
        held = self._held()
        faults = self._session.refusals.faults(held)
        self._judged = {name: fault.sentence for name, fault in faults.items()}
        places = {
            tr("Point {number}").format(number=number): point for number, point in enumerate(held.points, 1)
        }
        if held.home is not None:
            places[tr("Home")] = held.home
        self._screen.map.refused = [(*places[name], fault.brief) for name, fault in faults.items()]
        self.bar.trouble = self._trouble()

    def measure(self) -> None:
        """Begin to measure, or end it."""
        self._screen.mode = "view" if self._screen.mode == "measure" else "measure"

    def _home_here(self) -> None:
        """Home is where the robot is now."""
        area = self._screen.map
        if area.located:
            self._session.mission.set_home(*area.robot[:2])
            self._screen.mode = "view"

    def _reorder(self, step: int) -> None:
        area = self._screen.map
        index = int(area.selected)
        target = index + step
        if 0 <= index < len(area.waypoints) and 0 <= target < len(area.waypoints):
            area.selected = target
            self._session.mission.reorder(index, target)

    def _delete(self) -> None:
        area = self._screen.map
        index = int(area.selected)
        if 0 <= index < len(area.waypoints):
            area.selected = -1
            self._session.mission.remove(index)

    # the robot's own place

    def _place_robot(self) -> None:
        placed = self._screen.map.placed
        if len(placed) == 3 and all(map(math.isfinite, placed)):
            self._session.place_robot(*placed)
            shell = self._screen.app.shell
            if shell is not None:
                shell.say(tr("Told the robot where it is."), "info")
            self._screen.mode = "view"

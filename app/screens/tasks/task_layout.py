"""Where lists, panes and buttons of the tasks screen are."""

from __future__ import annotations

from typing import Any, Protocol

from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.layout import arrange
from app.layout.arrange import Rect
from app.screens.parts.placing import MIN_READABLE_HEIGHT, above, put
from app.screens.tasks.task_actions import TaskActions
from app.screens.tasks.task_lists import TaskLists
from app.screens.tasks.task_panes import TaskPanes
from app.session.session import Session

__all__ = ["TaskLayout"]

DETAILS = {
    "now": "order",
    "schedule": "schedule",
    "history": "order",
    "events": "order",
    "places": "place",
    "missions": "mission",
}
"""What is beside each list where there is room for both."""


MIN_TILES_HEIGHT = 66.0
"""Tiles to choose a task by can be scrolled through in no more than this [dp]."""


class TasksParts(Protocol):
    """The tasks screen, as far as it is laid out."""

    ids: Any
    session: Session
    tab: str
    detail: str
    lists: TaskLists
    panes: TaskPanes
    acts: TaskActions


class TaskLayout:
    """A list, and beside it or on a phone in its place what is opened."""

    def __init__(self, screen: TasksParts) -> None:
        self._screen = screen
        self.form = ""
        """Shape of the window, as in `app.layout.arrange.form`; empty before it is known."""
        self._dp = 1.0
        self._places: dict[str, Rect] = {}
        self._cover: Rect | None = None
        self._beside = BoxLayout(spacing="12dp")
        """A pane with the map beside it."""

    def arrange(self, body: Rect, form: str, dp: float) -> dict[str, Rect]:
        """Give each its place in a window of that `form`; returns the places, of STOP too. `lay` has to follow."""
        self.form, self._dp = form, dp
        places = self._places = arrange.tasks(body, form, dp)
        put(self._screen.ids.strip, places["strip"])
        self.clear(self._cover)
        self._screen.panes.arrange(form)
        return places

    def clear(self, cover: Rect | None) -> None:
        """Make room for what is said over the screen."""
        self._cover = cover
        tiles = self._screen.panes.order.chooses and self._shown_detail() in ("order", "schedule")
        for name, place, least in (
            ("listed", "list", MIN_READABLE_HEIGHT),
            ("detail", "detail", MIN_TILES_HEIGHT if tiles else MIN_READABLE_HEIGHT),
        ):
            put(self._screen.ids[name], above(self._places[place], cover, self._dp, least))

    def refresh(self) -> None:
        """Another task, or none, was chosen: what is shown of it may need more room, or less."""
        if self._places:
            self.clear(self._cover)

    def _shown_detail(self) -> str:
        """What is beside the list, or on a phone over it; empty for the list alone."""
        screen = self._screen
        if screen.session.robot.lacks_tasks:
            return ""
        return screen.detail if self.form == "tall" else screen.detail or DETAILS[screen.tab]

    def lay(self) -> None:
        """Show the list of the tab, and what is opened."""
        screen, shown = self._screen, self._shown_detail()
        pane = screen.panes.of(shown) if shown else None  # which may change its form, and so lay out within
        listed, area = screen.ids.listed, screen.ids.detail
        tall = self.form == "tall"
        listed.clear_widgets()
        area.clear_widgets()
        if not (tall and shown):
            for widget in self._list(shown, tall=tall):
                listed.add_widget(widget)
        if pane is not None:
            self._put_pane(area, shown, pane)
        listed.opacity, area.opacity = float(not (tall and shown)), float(bool(shown))
        screen.lists.tabs.at_settings = shown == "settings"
        if self._places:
            screen.acts.lay_for(screen.tab, shown, form=self.form, stop=self._places["stop"])

    def _list(self, shown: str, *, tall: bool) -> list[Widget]:
        """The tabs and the list under them, or on a phone's side the map that places are chosen on."""
        screen = self._screen
        if screen.panes.has_map(shown) and self.form == "short":
            return [screen.lists.tabs, screen.panes.chooser]
        below = [] if tall or screen.tab == "now" else [screen.acts.under]
        return [screen.lists.tabs, screen.lists.of(screen.tab), *below]

    def _put_pane(self, area: Any, shown: str, pane: Widget) -> None:
        """The pane, and on a tablet beside it the map where places are chosen on it."""
        self._beside.clear_widgets()
        if not (self._screen.panes.has_map(shown) and self.form == "wide"):
            area.add_widget(pane)
            return
        for widget in (pane, self._screen.panes.chooser):
            if widget.parent is not None:
                widget.parent.remove_widget(widget)
            self._beside.add_widget(widget)
        area.add_widget(self._beside)

"""The inputs screen: every way in with how it stands and a switch, and beside it how it is set up."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import ObjectProperty, StringProperty
from kivy.uix.widget import Widget

from app.core.optional_parts import bring
from app.layout import arrange
from app.layout.arrange import Body, Rect
from app.link.feeds import Post
from app.screens.inputs.method_row import MethodRow
from app.screens.inputs.pane_table import panes
from app.screens.parts.pane_head import PaneHead
from app.screens.parts.placing import Area, put  # noqa: F401 - a rule names the area
from app.screens.parts.robot_screen import RobotScreen
from widgets.core.language import tr
from widgets.parts.kit import Column, Remark, Roll

__all__ = ["InputsScreen"]

Builder.load_string("""
<InputsScreen>:
    Area:
        id: listed
    Area:
        id: detail
""")


NEEDS = {"study": "log", "voice": "talk"}
"""Pane to what else it sets up beside what it is called after."""


class FaultPane(Column):
    """In place of a pane: why what it sets up cannot be used."""

    def __init__(self, sentence: str) -> None:
        super().__init__()
        self.add_widget(Remark(text=sentence, role="warn"))

    def enter(self) -> None:
        """Come onto the glass."""

    def leave(self) -> None:
        """Leave the glass."""

    def tick(self) -> None:
        """Nothing changes."""


class InputsScreen(RobotScreen):
    """The same with a robot, in its frame, and without one, on a page of its own."""

    app = ObjectProperty()
    chosen = StringProperty("")
    """Name of the pane that is open, as in `PANES`; empty on a phone for the list."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for name in ("listed", "detail"):  # kv holds ids weakly
            self.ids[name] = self.ids[name].__self__
        self.panes = panes()
        self._made: dict[str, Any] = {}
        self._entered: Any = None
        """The pane that is on the glass and has been told so."""
        self._active = False
        self._form, self._dp, self._titled = "", 1.0, True
        self._places: dict[str, Rect] = {}
        self.notice = Rect(0, 0, 1, 1)
        self.head = PaneHead(title=tr("Inputs"), sentence=tr("Tap one to set it up."))
        self.back_head = PaneHead(closable=True)
        self.back_head.bind(on_close=lambda _: self.back())
        self.rows: dict[str, MethodRow] = {}
        self._fill()
        self.bind(chosen=self._lay)

    def _fill(self) -> None:
        listed, column = self.ids.listed, Column(spacing="6dp")
        for name, pane in self.panes.items():
            row = self.rows[name] = MethodRow(icon=pane.icon, title=tr(pane.title))
            row.bind(
                on_release=lambda _, name=name: self.open(name),
                on_turn=lambda _, on, name=name: self._turn(name, on),
            )
            column.add_widget(row)
        roll = Roll()
        roll.add_widget(column)
        listed.add_widget(self.head)
        listed.add_widget(roll)

    # what the frame calls

    def arrange(self, body: Body, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self._form, self._dp, self._titled = form, dp, form != "short"
        places = self._places = arrange.inputs(body, form, dp)
        self.notice = places["notice"]
        self._lay()
        return places["stop"]

    def spread(self, body: Rect, form: str, dp: float) -> None:
        """The same where there is no STOP, and the title is in the bar above."""
        self._form, self._dp, self._titled = form, dp, False
        self._places = arrange.inputs_alone(body, form, dp)
        self._lay()

    def clear(self, cover: Rect | None) -> None:
        """Make room for what is said over the screen; the lists scroll, so that nothing is lost below it."""

    def on_post(self, channel: str, post: Post) -> None:
        """A message came: to the pane on the glass, where it listens."""
        if self._entered is not None and hasattr(self._entered, "hear"):
            self._entered.hear(channel, post)

    def enter(self) -> None:
        """Come onto the glass."""
        self._active = True
        self._lay()
        self.tick()

    def leave(self) -> None:
        """Leave the glass."""
        self._active = False
        self._show(None)

    def rest(self) -> None:
        """Fingers let go of what they hold."""
        if self._entered is not None and hasattr(self._entered, "rest"):
            self._entered.rest()

    def tick(self) -> None:
        """Bring up to date how each stands."""
        for name, row in self.rows.items():
            row.show_method(self.app.methods.get(name), self._fault(name))
            row.chosen = name == self._shown()
        if self._entered is not None:
            self._entered.tick()

    def back(self) -> bool:
        """Back within the screen; False when it is at its list."""
        if self._entered is not None and hasattr(self._entered, "back") and self._entered.back():
            return True
        if self._form == "tall" and self.chosen:
            self.chosen = ""
            return True
        return False

    # what is where

    def open(self, name: str) -> None:
        """Open the pane of that name, as in `PANES`; nothing for one that there is not."""
        if name in self.panes:
            self.chosen = name

    def pane(self, name: str) -> Any:
        """The pane of that name, made when it is first asked for; KeyError where there is none."""
        if name not in self._made and self._fault(name):
            self._made[name] = FaultPane(self._fault(name))
        elif name not in self._made:
            self._made[name] = bring(self.panes[name].where)(app=self.app)
        return self._made[name]

    def _fault(self, name: str) -> str:
        """Why what that pane sets up cannot be used; empty where it can."""
        faults: dict[str, str] = self.app.methods.faults
        return next((faults[one] for one in (name, NEEDS.get(name)) if one in faults), "")

    def _shown(self) -> str:
        if self._form == "tall" or self.chosen:
            return str(self.chosen)
        return next(iter(self.panes), "")

    def _lay(self, *_: object) -> None:
        if not self._places or not self._active:
            return
        shown, tall = self._shown(), self._form == "tall"
        listed, detail = self.ids.listed, self.ids.detail
        if self._titled != (self.head.parent is listed):
            if self._titled:
                listed.add_widget(self.head, index=len(listed.children))
            else:
                listed.remove_widget(self.head)
        put(listed, self._places["list"])
        put(detail, self._places["detail"])
        here = [detail] if tall and shown else [listed] if tall or not shown else [listed, detail]
        for area in (listed, detail):
            if (area in here) != (area.parent is self):
                (self.add_widget if area in here else self.remove_widget)(area)
        self._show(self.pane(shown) if shown else None)
        if shown:
            self._place_pane(self.pane(shown), tr(self.panes[shown].title), tall=tall)

    def _place_pane(self, pane: Widget, title: str, *, tall: bool) -> None:
        detail = self.ids.detail
        self.back_head.title, self.back_head.closable = title, tall
        # on a phone's side the list says which one it is, and the pane needs the room
        wanted = [pane] if self._form == "short" else [self.back_head, pane]
        if list(reversed(detail.children)) != wanted:
            detail.clear_widgets()
            for widget in wanted:
                detail.add_widget(widget)

    def _show(self, pane: Any) -> None:
        """Have that pane entered, and the one before left."""
        if pane is self._entered:
            return
        before, self._entered = self._entered, pane
        if before is not None:
            before.leave()
        if pane is not None:
            pane.enter()

    def _turn(self, name: str, on: bool) -> None:
        self.app.methods.turn(name, on)
        self.tick()

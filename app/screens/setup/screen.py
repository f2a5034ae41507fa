"""The one setup screen: what is chosen for this handheld, what the robot has, and beside the list the one that is open."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import ObjectProperty

from app.core.optional_parts import bring
from app.core.robot_docs import payload_title
from app.layout import arrange
from app.layout.arrange import Body, Rect
from app.link.feeds import Post
from app.screens.parts.pane_head import PaneHead
from app.screens.parts.placing import Area, put  # noqa: F401 - a rule names the area
from app.screens.parts.robot_screen import RobotScreen
from app.screens.setup.pane_table import panes
from app.screens.setup.robot_section import TITLES, Key, RobotSection
from bridge.msgs.pilothouse_msgs import Gateway, Payload
from widgets.core.language import mark, tr
from widgets.parts.kit import Column, ListRow, Remark, Roll, SectionLabel

__all__ = ["HANDHELD", "SetupScreen"]

Builder.load_string("""
<SetupScreen>:
    Area:
        id: listed
    Area:
        id: detail
""")

HANDHELD = "handheld"
"""First part of the key of a pane of this handheld."""
HEADINGS = {HANDHELD: mark("This handheld"), **TITLES}
Entries = dict[Key, Gateway | Payload | None]


class SetupScreen(RobotScreen):
    """The same with a robot, in its frame, and without one, on a page of its own."""

    app = ObjectProperty()
    session = ObjectProperty(None, allownone=True)
    """None where there is no robot."""
    chosen = ObjectProperty(None, allownone=True)
    """The `Key` of what is open; None on a phone for the list."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for name in ("listed", "detail"):  # kv holds ids weakly
            self.ids[name] = self.ids[name].__self__
        self.robot = RobotSection(self.session, self._show) if self.session is not None else None
        self.panes = panes()
        self._made: dict[str, Any] = {}
        self._entered: Any = None
        """The pane of this handheld that is on the glass and has been told so."""
        self.rows: dict[Key, Any] = {}
        self._form, self._places, self._titled, self._active = "", dict[str, Rect](), True, False
        self.notice = Rect(0, 0, 1, 1)
        self.head, self.back_head = PaneHead(title=tr("Setup")), PaneHead(closable=True)
        self.back_head.bind(on_close=lambda _: self.back())
        self.column = Column(spacing="6dp", padding=(0, 0, "8dp", "8dp"))
        self.about = Remark(role="muted")
        """What is to be known of all that the robot has, over its first list."""
        roll = Roll()
        roll.add_widget(self.column)
        self.ids.listed.add_widget(self.head)
        self.ids.listed.add_widget(roll)
        self.bind(chosen=lambda *_: self._show())

    # what the frame calls

    def arrange(self, body: Body, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self._form, self._titled = form, True
        places = self._places = arrange.inputs(body, form, dp)
        self.notice = places["notice"]
        self._lay()
        return places["stop"]

    def spread(self, body: Rect, form: str, dp: float) -> None:
        """The same where there is no STOP, and the title is in the bar above."""
        self._form, self._titled = form, False
        self._places = arrange.inputs_alone(body, form, dp)
        self._lay()

    def on_post(self, channel: str, post: Post) -> None:
        """Something came from the robot or its link."""
        if self.robot is not None and self.robot.on_post(channel, post) and self.parent is not None:
            self._show()

    def enter(self) -> None:
        """Come onto the glass: the robot is asked."""
        self._active = True
        if self.robot is not None:
            self.robot.setup.enter()
        self._show()

    def leave(self) -> None:
        """Leave the glass: the robot need not tell any more."""
        self._active = False
        if self.robot is not None:
            self.robot.setup.leave()
        self._enter_pane(None)

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self._show()
        if self._entered is not None:
            self._entered.tick()

    def back(self) -> bool:
        """Back to the list on a phone; False when it is there."""
        if self._form == "tall" and self.chosen is not None:
            self.chosen = None
            return True
        return False

    def keep(self) -> object:
        """What is open."""
        return self.chosen

    def take_up(self, kept: Any) -> None:
        """Open it again."""
        self.chosen = kept

    def open(self, name: str) -> None:
        """Open the pane of this handheld of that name; nothing for one that there is not."""
        if name in self.panes:
            self.chosen = (HANDHELD, name)

    # what is shown

    def _entries(self) -> Entries:
        found: Entries = {(HANDHELD, name): None for name in self.panes}
        return found | (self.robot.entries() if self.robot is not None else {})

    def _show(self) -> None:
        entries = self._entries()
        if self.robot is not None:
            words = self.robot.setup.sentence
            self.about.text, self.about.role = words
        if list(self.rows) != list(entries):
            self._fill(entries)
        for key, entry in entries.items():
            self._show_row(key, entry)
        self._lay()
        shown = self._shown()
        if shown is not None and (entry := entries[shown]) is not None:
            self.pane(shown, entry).show(entry)

    def _fill(self, entries: Entries) -> None:
        """Rows in their order, under the heading of their list."""
        self.column.clear_widgets()
        kept, self.rows = self.rows, {}
        kind = ""
        for key in entries:
            if key[0] != kind:
                kind = key[0]
                heading = SectionLabel(title=tr(HEADINGS[kind]), size_hint_y=None, height="30dp")
                self.column.add_widget(heading)
                if kind != HANDHELD and self.about.parent is None:
                    self.column.add_widget(self.about)
            row = self.rows[key] = kept.get(key) or self._row(key)
            self.column.add_widget(row)

    def _row(self, key: Key) -> Any:
        if self.robot is not None and key[0] != HANDHELD:
            return self.robot.row(key, lambda key: setattr(self, "chosen", key))
        pane = self.panes[key[1]]
        row = ListRow(icon=pane.icon, title=tr(pane.title), whole=True)
        row.bind(on_release=lambda _: setattr(self, "chosen", key))
        return row

    def _show_row(self, key: Key, entry: Gateway | Payload | None) -> None:
        row = self.rows[key]
        row.chosen = key == self._shown()
        if self.robot is not None and entry is not None:
            self.robot.show_row(row, key, entry)
        else:
            row.detail = self.panes[key[1]].standing(self.app)

    def pane(self, key: Key, entry: Gateway | Payload | None = None) -> Any:
        """The pane of that key, made when it is first opened; what is typed there stays."""
        if self.robot is not None and entry is not None:
            return self.robot.pane(key, entry)
        name = key[1]
        if name not in self._made:
            self._made[name] = bring(self.panes[name].where)(app=self.app)
        return self._made[name]

    def _shown(self) -> Key | None:
        """What is beside the list, or on a phone in its place."""
        entries = self._entries()
        if self.chosen in entries:
            found: Key = self.chosen
            return found
        return None if self._form == "tall" else next(iter(entries), None)

    def _lay(self) -> None:
        if not self._places:
            return
        shown, listed, detail = self._shown(), self.ids.listed, self.ids.detail
        if self._titled != (self.head.parent is listed):
            if self._titled:
                listed.add_widget(self.head, index=len(listed.children))
            else:
                listed.remove_widget(self.head)
        put(listed, self._places["list"])
        put(detail, self._places["detail"])
        tall = self._form == "tall"
        here = [detail] if tall and shown else [listed] if tall else [listed, detail]
        for area in (listed, detail):
            if (area in here) != (area.parent is self):
                (self.add_widget if area in here else self.remove_widget)(area)
        wanted = self._beside(shown, tall=tall) if shown is not None else []
        if list(reversed(detail.children)) != wanted:
            detail.clear_widgets()
            for widget in wanted:
                detail.add_widget(widget)
        self._enter_pane(self.pane(shown) if shown is not None and shown[0] == HANDHELD else None)

    def _beside(self, shown: Key, *, tall: bool) -> list[Any]:
        """A head with the way back, and the pane that is open."""
        pane, head = self.pane(shown, self._entries()[shown]), self.back_head
        # without a robot the page above has the way back
        head.closable, head.sentence, head.refused = tall and self._titled, "", False
        if shown[0] == HANDHELD:
            head.title = tr(self.panes[shown[1]].title)
            # on a phone's side the list says which one it is, and the pane needs the room
            return [pane] if self._form == "short" else [head, pane]
        head.title = payload_title(shown[1])
        if self.robot is not None:
            words, role = self.robot.setup.sentence
            warned = role == "warn" or bool(self.robot.setup.why_not)  # beside a list, the list says it
            head.sentence, head.refused = words if tall and warned else "", role == "warn"
        return [head, pane]

    def _enter_pane(self, pane: Any) -> None:
        """Have that pane of this handheld entered, and the one before left."""
        pane = pane if self._active else None
        before, self._entered = self._entered, pane
        if before is pane:
            return
        if before is not None:
            before.leave()
        if pane is not None:
            pane.enter()

"""The setup screen: protocols and payloads of the robot, each with a switch, and beside them the one that is chosen."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import ObjectProperty

from app.layout import arrange
from app.layout.arrange import Body, Rect
from app.link.feeds import Post
from app.screens.parts.pane_head import PaneHead
from app.screens.parts.placing import Area, put  # noqa: F401 - a rule names the area
from app.screens.parts.robot_screen import RobotScreen
from app.screens.setup.gateway_pane import GatewayPane
from app.screens.setup.payload_pane import PayloadPane
from app.screens.setup.setup_row import SetupRow
from app.session.robot_setup import GATEWAYS, PAYLOADS, RobotSetup
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Gateway, Payload
from widgets.parts.kit import Column, Remark, Roll, SectionLabel

__all__ = ["SetupScreen"]

Builder.load_string("""
<SetupScreen>:
    Area:
        id: listed
    Area:
        id: detail
""")

ICONS = {
    "rosbridge": "cable",
    "http": "link",
    "robot": "smart_toy",
    "wheels": "directions_car",
    "camera": "photo_camera",
    "laser": "radar",
    "arm": "precision_manufacturing",
    "lights": "lightbulb",
    "imu": "explore",
    "satellite": "satellite_alt",
    "compass": "explore",
    "tasks": "list",
    "tag": "vpn_key",
    "follower": "group",
    "depth": "water",
}
"""Icon of a protocol or payload; others have that of their list."""
USUAL = {GATEWAYS: "lan", PAYLOADS: "sensors"}
TITLES = {GATEWAYS: "Protocols", PAYLOADS: "Payloads"}
Key = tuple[str, str]
"""`GATEWAYS` or `PAYLOADS`, and the name of one of them."""


class SetupScreen(RobotScreen):
    """What is shown is what the robot said; nothing counts as switched before it says so."""

    app = ObjectProperty()
    session: ObjectProperty[Session] = ObjectProperty()
    chosen = ObjectProperty(None, allownone=True)
    """The `Key` of what is open; None on a phone for the list."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        for name in ("listed", "detail"):  # kv holds ids weakly
            self.ids[name] = self.ids[name].__self__
        self.setup = RobotSetup(self.session)
        self.rows: dict[Key, SetupRow] = {}
        self._panes: dict[Key, GatewayPane | PayloadPane] = {}
        self._form, self._places = "", dict[str, Rect]()
        self.notice = Rect(0, 0, 1, 1)
        self.head, self.back_head = PaneHead(title="Setup"), PaneHead(closable=True)
        self.back_head.bind(on_close=lambda _: self.back())
        self.nothing = Remark(role="muted")
        self.column = Column(spacing="6dp", padding=(0, 0, "8dp", 0))
        self.roll = Roll()
        self.roll.add_widget(self.column)
        self.ids.listed.add_widget(self.head)
        self.ids.listed.add_widget(self.roll)
        self.bind(chosen=lambda *_: self._show())

    # what the frame calls

    def arrange(self, body: Body, form: str, dp: float) -> Rect:
        """Put everything into its place; returns where STOP goes."""
        self._form = form
        places = self._places = arrange.inputs(body, form, dp)
        self.notice = places["notice"]
        self._lay()
        return places["stop"]

    def on_post(self, channel: str, post: Post) -> None:
        """Something came from the robot or its link."""
        if self.setup.on_post(channel, post) and self.parent is not None:
            self._show()

    def enter(self) -> None:
        """Come onto the glass: the robot is asked."""
        self.setup.enter()
        self._show()

    def leave(self) -> None:
        """Leave the glass: the robot need not tell any more."""
        self.setup.leave()

    def tick(self) -> None:
        """Bring up to date what time changes."""
        self._show()

    def back(self) -> bool:
        """Back to the list on a phone; False when it is there."""
        if self._form == "tall" and self.chosen is not None:
            self.chosen = None
            return True
        return False

    # what is shown

    def _entries(self) -> dict[Key, Gateway | Payload]:
        found: dict[Key, Gateway | Payload] = {(GATEWAYS, each.name): each for each in self.setup.gateways}
        return found | {(PAYLOADS, each.key): each for each in self.setup.payloads}

    def _show(self) -> None:
        entries, words = self._entries(), self.setup.sentence
        self.head.sentence, self.head.refused = words[0], words[1] == "warn"
        if list(self.rows) != list(entries):
            self._fill(entries)
        for key, entry in entries.items():
            self._show_row(key, entry)
        self._lay()
        shown = self._shown()
        if shown is not None:
            self.pane(shown, entries[shown]).show(entries[shown])  # type: ignore[arg-type]

    def _fill(self, entries: dict[Key, Gateway | Payload]) -> None:
        """Rows in the robot's order, under the heading of their list."""
        self.column.clear_widgets()
        kept, self.rows = self.rows, {}
        kind = ""
        for key in entries:
            if key[0] != kind:
                kind = key[0]
                self.column.add_widget(SectionLabel(title=TITLES[kind], size_hint_y=None, height="30dp"))
            row = self.rows[key] = kept.get(key) or self._row(key)
            self.column.add_widget(row)

    def _row(self, key: Key) -> SetupRow:
        kind, name = key
        row = SetupRow(icon=ICONS.get(name, USUAL[kind]), title=name.replace("_", " "))
        row.bind(on_release=lambda _: setattr(self, "chosen", key), on_turn=lambda _, on: self._turn(key, on))
        return row

    def _show_row(self, key: Key, entry: Gateway | Payload) -> None:
        setup, row = self.setup, self.rows[key]
        row.chosen, may = key == self._shown(), setup.may(*key)
        refusal = setup.refusal(*key)
        if isinstance(entry, Gateway):
            state, on = setup.gateway_state(entry), entry.state in ("up", "lost", "going_down")
            may = may and entry.state in ("down", "up", "lost") and (on or not entry.package)
        else:
            state, on = setup.payload_state(entry), entry.on
        row.show((refusal, "danger") if refusal else state, on=on, fixed=entry.fixed, may=may)
        row.faded = not on

    def pane(self, key: Key, entry: Gateway | Payload) -> GatewayPane | PayloadPane:
        """The pane of a protocol or payload, made when it is first opened; what is typed there stays."""
        if key not in self._panes:
            gateway = isinstance(entry, Gateway)
            self._panes[key] = GatewayPane(self.setup, entry) if gateway else PayloadPane(self.setup, entry)  # type: ignore[arg-type]
        return self._panes[key]

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
        put(listed, self._places["list"])
        put(detail, self._places["detail"])
        tall = self._form == "tall"
        here = [detail] if tall and shown else [listed] if tall else [listed, detail]
        for area in (listed, detail):
            if (area in here) != (area.parent is self):
                (self.add_widget if area in here else self.remove_widget)(area)
        wanted: list[Any] = []
        if shown is not None:
            pane = self.pane(shown, self._entries()[shown])
            self.back_head.title, self.back_head.closable = shown[1].replace("_", " "), tall
            words, role = self.setup.sentence
            warned = role == "warn" or bool(self.setup.why_not)  # beside a list, the list's head says it
            self.back_head.sentence = words if tall and warned else ""
            self.back_head.refused = role == "warn"
            wanted = [self.back_head, pane]
        if list(reversed(detail.children)) != wanted:
            detail.clear_widgets()
            for widget in wanted:
                detail.add_widget(widget)

    # what the fingers do

    def _turn(self, key: Key, on: bool) -> None:
        """Ask the robot; the switch shows what it says, and not yet what was asked."""
        kind, name = key
        entry = self._entries().get(key)
        if kind == PAYLOADS:
            self.setup.switch(name, on)
        elif on and entry is not None:
            pane = self.pane(key, entry)
            if isinstance(pane, GatewayPane):
                pane.bring_up()
        else:
            self.setup.bring_down(name)
        self._show()

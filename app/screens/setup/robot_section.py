"""The robot's part of the setup screen: its protocols and payloads, a row and a pane each."""

from __future__ import annotations

from collections.abc import Callable

from app.core.robot_docs import payload_title
from app.link.feeds import Post
from app.screens.setup.gateway_pane import GatewayPane
from app.screens.setup.payload_pane import PayloadPane
from app.screens.setup.setup_row import SetupRow
from app.session.robot_setup import GATEWAYS, PAYLOADS, RobotSetup
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import Gateway, Payload
from widgets.core.language import mark

__all__ = ["TITLES", "Key", "RobotSection"]

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
TITLES = {GATEWAYS: mark("This robot: protocols"), PAYLOADS: mark("This robot: payloads")}
Key = tuple[str, str]
"""`GATEWAYS` or `PAYLOADS`, and the name of one of them; or `HANDHELD` and the name of a pane."""


class RobotSection:
    """What is shown is what the robot said; nothing counts as switched before it says so."""

    def __init__(self, session: Session, show: Callable[[], object]) -> None:
        """`show` brings the screen up to date."""
        self.setup, self._show = RobotSetup(session), show
        self.panes: dict[Key, GatewayPane | PayloadPane] = {}

    def on_post(self, channel: str, post: Post) -> bool:
        """Something came from the robot; True where it concerns this."""
        return self.setup.on_post(channel, post)

    def entries(self) -> dict[Key, Gateway | Payload]:
        """What the robot has, in its order."""
        found: dict[Key, Gateway | Payload] = {(GATEWAYS, each.name): each for each in self.setup.gateways}
        return found | {(PAYLOADS, each.key): each for each in self.setup.payloads}

    def row(self, key: Key, choose: Callable[[Key], object]) -> SetupRow:
        """A row, which a finger chooses."""
        kind, name = key
        row = SetupRow(icon=ICONS.get(name, USUAL[kind]), title=payload_title(name))
        row.bind(on_release=lambda _: choose(key), on_turn=lambda _, on: self._turn(key, on))
        return row

    def show_row(self, row: SetupRow, key: Key, entry: Gateway | Payload) -> None:
        """Bring a row up to date with what the robot said."""
        setup = self.setup
        may, refusal = setup.may(*key), setup.refusal(*key)
        if isinstance(entry, Gateway):
            state, on = setup.gateway_state(entry), entry.state in ("up", "lost", "going_down")
            may = may and entry.state in ("down", "up", "lost") and (on or not entry.package)
        else:
            state, on = setup.payload_state(entry), entry.on
        row.show((refusal, "danger") if refusal else state, on=on, fixed=entry.fixed, may=may)
        row.faded = not on

    def pane(self, key: Key, entry: Gateway | Payload) -> GatewayPane | PayloadPane:
        """The pane of a protocol or payload, made when it is first opened; what is typed there stays."""
        if key not in self.panes:
            gateway = isinstance(entry, Gateway)
            self.panes[key] = GatewayPane(self.setup, entry) if gateway else PayloadPane(self.setup, entry)  # type: ignore[arg-type]
        return self.panes[key]

    def _turn(self, key: Key, on: bool) -> None:
        """Ask the robot; the switch shows what it says, and not yet what was asked."""
        kind, name = key
        entry = self.entries().get(key)
        if kind == PAYLOADS:
            self.setup.switch(name, on)
        elif on and entry is not None:
            pane = self.pane(key, entry)
            if isinstance(pane, GatewayPane):
                pane.bring_up()
        else:
            self.setup.bring_down(name)
        self._show()

"""Robots that can be connected to: those that are heard, those that are saved, and their cards on the connect screen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

from app.core.settings_store import Settings
from app.discovery.beacon_listener import HELLO, LATENCY, BeaconListener
from app.discovery.known_robots import Entry, KnownRobots, check_address
from app.link.feeds import Post
from app.robot_trust import RobotTrust
from app.screens.connect.connect import ConnectScreen
from app.stop.fleet import Fleet
from bridge.msgs.pilothouse_msgs import RobotInfo

if TYPE_CHECKING:
    from app.session.session import Session

__all__ = ["RobotDirectory"]


class Host(Protocol):
    """The app, as far as the list of robots needs it."""

    root: Any
    connect: ConnectScreen

    @property
    def robots(self) -> KnownRobots:
        """Every robot that is heard or saved."""

    def say(self, text: str, level: str) -> None:
        """Show one sentence, wherever the operator looks."""

    @property
    def session(self) -> Session | None:
        """The session with the robot; None while none is wanted."""

    def open(self, url: str) -> None:
        """Connect to a robot."""


class RobotDirectory:
    """Everything here happens in the UI thread."""

    def __init__(self, app: Host, settings: Settings, client_name: str, now: Callable[[], float]) -> None:
        """`client_name` is what this handheld is called; `now` is our clock [s]."""
        self._app, self._settings, self._now = app, settings, now
        self.client_name = client_name
        """What this handheld is called."""
        self.trust = RobotTrust(app, settings.path.parent)
        """The robots that this handheld is paired with."""
        self.trust.on_address = self.ask_address
        self.robots = KnownRobots(
            now,
            settings.get("robots") or (),
            connected=self._connected,
            paired=lambda: self.trust.keys.claims,
        )
        """Every robot that is heard or saved."""
        self._unproven = ""
        """The address that was typed last, until something answers there."""

    def fleet(self, client_id: str) -> Fleet:
        """STOP ALL, which takes paired robots by their keys; `client_id` is who this handheld is to robots."""
        return Fleet(
            client_id=client_id,
            client_name=self.client_name,
            now=self._now,
            credentials=self.trust.credentials,
        )

    def on_post(self, channel: str, post: Post) -> bool:
        """Take in a HELLO or a measured latency; False for any other channel."""
        if channel == HELLO:
            for one in post.value.take():
                self.robots.heard(one.hello, one.received, one.source)
        elif channel.startswith(LATENCY):
            self.robots.measured(*post.value)
        else:
            return self.trust.on_post(channel, post)
        return True

    def on_info(self, url: str, info: RobotInfo) -> None:
        """A robot introduced itself: remember it where its address is saved."""
        self.robots.name(url, info.name, info.kind, info.description, info.icon)
        self._save()

    def show(self, nearby: BeaconListener) -> None:
        """Bring the cards up to date, and have `nearby` measure the robots on them."""
        entries = self.entries()
        self._app.connect.show_entries(entries, self.client_name)
        nearby.measure(entries)

    def entries(self) -> list[Entry]:
        """All robots that can be connected to, and how each is reached."""
        return [replace(entry, trust=self.trust.standing(entry.url)) for entry in self.robots.entries()]

    def ask_address(self, address: str = "") -> None:
        """Ask for an address to connect to; `address` is one that need only be confirmed."""
        from app.screens.parts.dialogs import AddressDialog

        dialog = AddressDialog(self.open_typed)
        self._app.root.add_widget(dialog)
        dialog.ids.field.text = address
        dialog.ids.field.focus = not address

    def open_typed(self, text: str) -> None:
        """Connect to an address that was typed, and save it once something answers there. ValueError for no address."""
        url = check_address(text)
        self._app.open(url)
        self._unproven = url

    def on_answer(self, session: Session) -> None:
        """A robot has answered: save an address that was typed, and where a paired one was met."""
        url = session.robot.url
        self.trust.on_answer(session)
        if self._unproven == url:
            self.robots.add(url, met=True)
            self._save()
        self._unproven = ""

    def refresh(self) -> None:
        """Show what is known on a connect page that was made anew."""
        self._app.connect.show_entries(self.entries(), self.client_name)

    def forget(self, url: str) -> None:
        """Take a saved address off the list; a paired robot is not paired any more, which a tap takes back."""
        kept = self.robots.remove(url)
        self._save()
        self.trust.forget(url, lambda: self._restore(url, kept))
        self._app.connect.show_entries(self.entries(), self.client_name)

    def _restore(self, url: str, kept: dict[str, str] | None) -> None:
        if kept is not None:
            self.robots.restore(url, kept)
            self._save()
        self._app.connect.show_entries(self.entries(), self.client_name)

    def _connected(self) -> tuple[str, ...]:
        session = self._app.session
        return () if session is None else (session.robot.url,)

    def _save(self) -> None:
        self._settings.set("robots", self.robots.save())

"""Paired robots: their keys, and pairing as it is asked for on the glass or by a link."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from kivy.clock import Clock

from app.device.opened_links import watch_links
from app.discovery.known_robots import KnownRobots, plain_name
from app.link.feeds import Post
from app.profiles.profile_link import is_profile_link
from app.screens.connect.connect import ConnectScreen
from app.trust.keyring import Keyring, RobotKey, host_of, place_of
from app.trust.pairing_attempts import PAIRING, Attempt, PairingAttempts
from bridge.client.credentials import Credentials
from bridge.discovery.hello import is_loopback
from bridge.trust.pairing import SCHEME, BadPairing, PairLink, split_code
from bridge.trust.robot_link import RobotLink, read_link
from widgets.core.language import mark, tr

if TYPE_CHECKING:
    from app.screens.trust.pair_dialog import PairDialog  # when somebody pairs, for a quick start
    from app.session.session import Session

__all__ = ["RobotTrust"]

NO_ROBOT = mark("A code is of one robot: choose that robot's card first, or paste its link.")
ROLES = {
    "watch": mark("may watch it"),
    "drive": mark("may drive it"),
    "manage": mark("may drive and manage it"),
}


class Host(Protocol):
    """The app, as far as pairing needs it."""

    root: Any
    connect: ConnectScreen

    @property
    def robots(self) -> KnownRobots:
        """Every robot that is heard or saved."""

    def open(self, url: str) -> None:
        """Connect to a robot."""

    def say(self, text: str, level: str) -> None:
        """Show one sentence, wherever the operator looks."""


class RobotTrust:
    """Everything here happens in the UI thread."""

    def __init__(self, app: Host, folder: Path) -> None:
        """`folder` is where the keys are kept."""
        self._app = app
        self.keys = Keyring(folder)
        """The robots that this handheld is paired with."""
        self.dialog: PairDialog | None = None
        """The question that is on the glass."""
        self.on_address: Callable[[str], object] = app.open
        """Takes the address of a link without a secret that was opened; any web page can open one."""
        self.on_profile: Callable[[str], object] = lambda _: None
        """Takes the link of a layout that was opened."""
        self.attempts: PairingAttempts
        """What carries attempts out; there while the app runs."""
        self._number = -1
        self._url = ""
        """Address of the robot that the dialog is about; empty for any."""
        self._silent: list[PairLink] = []
        """Links that are still to be paired with, without a question."""
        self._then = ""
        """Address to connect to once these are done; empty for none."""

    # who is known

    def key_for(self, url: str) -> RobotKey | None:
        """The key of the robot that is expected at `url`; None where it is not paired."""
        return self.keys.find(url, self._app.robots.claim(url))

    def credentials(self, url: str, claim: str) -> Credentials | None:
        """The credentials for the paired robot that is expected at `url` or makes that claim; None for any other."""
        key = self.keys.find(url, claim)
        return key.credentials if key else None

    def asks_first(self, url: str) -> bool:
        """Ask on the glass to pair where nothing else is possible: `url` is a link, or reached by TLS and not paired."""
        if url.startswith(f"{SCHEME}:"):
            self.open_link(url)
        elif url.startswith("wss:") and self.key_for(url) is None:
            self.ask(url)
        else:
            return False
        return True

    def on_answer(self, session: Session) -> None:
        """A robot has answered: a paired one has proved who it is, and is expected there from now on."""
        if session.key is not None:
            self.keys.met(session.key.fingerprint, session.robot.url)

    def standing(self, url: str) -> str:
        """How the robot at `url` is reached, as `app.discovery.known_robots.Entry.trust`."""
        if self.key_for(url) is not None:
            return "paired"
        if url.startswith("wss:"):
            return "stranger"
        return "" if is_loopback(host_of(url)) else "open"

    def forget(self, url: str, on_undo: Callable[[], object]) -> None:
        """Forget the key of a robot; it goes on knowing this handheld until somebody removes it there.

        A tap takes the key back, and calls `on_undo`.
        """
        key = self.key_for(url)
        if key is not None:
            self.keys.forget(key.fingerprint)
            said = tr("{name} is no longer paired with this handheld. Tap to undo.").format(name=key.name)

            def undo() -> None:
                self.keys.restore(key)
                on_undo()

            self._app.connect.say(said, "warn", undo)

    # pairing

    def ask(self, url: str = "", problem: str = "", link: PairLink | None = None) -> None:
        """Ask for the code of the robot at `url`, for any link, or whether to pair by `link`."""
        if self.dialog is not None:
            self.dialog.close()
        self._url = url
        name = self._app.robots.name_of(url) or place_of(url) if url else ""
        from app.screens.trust.pair_dialog import PairDialog

        self.dialog = PairDialog(
            self._answer, robot=name, link=link, problem=problem or self._doubt(name, link)
        )
        self.dialog.bind(on_close=self._closed)
        self._app.root.add_widget(self.dialog)

    def _doubt(self, name: str, link: PairLink | None) -> str:
        """What speaks against pairing with the robot of that name; empty for nothing."""
        if link is not None and self.keys.get(link.fingerprint) is not None:
            return tr("This handheld is paired with it already. Pair again only if the robot removed it.")
        called = plain_name(link.name if link is not None else name)
        other = next((key for key in self.keys if called and plain_name(key.name) == called), None)
        return (
            tr("This is not the {name} that you paired: another robot uses its name.").format(name=other.name)
            if other
            else ""
        )

    def open_link(self, text: str) -> None:
        """Somebody opened a link: ask whether to pair, or to connect by one without a secret; that of a layout is handed on."""
        if is_profile_link(text):
            self.on_profile(text)
            return
        try:
            link = read_link(text)
        except BadPairing as mistake:
            self._app.say(str(mistake), "danger")
            return
        if isinstance(link, RobotLink):
            self.on_address(link.url)
        else:
            self.ask(link=link)

    def begin(self, links: Iterable[str]) -> None:
        """Pair by `links` without a question, and ask about each link that the system opens with this app."""
        self.pair_silently(links)
        watch_links(lambda link: Clock.schedule_once(lambda _: self.open_link(link)))

    def pair_silently(self, links: Iterable[str], then: str = "") -> None:
        """Pair by links of robots that this app or who started it runs, without a question; then connect to `then`.

        One that is paired already, or whose link is damaged, is left out: on this machine it is reached without a key.
        """
        for text in links:
            try:
                link = PairLink.read(text)
            except BadPairing:
                continue
            if self.keys.get(link.fingerprint) is None:
                self._silent.append(link)
        self._then = then
        self._go_on()

    def _go_on(self) -> None:
        if self._silent:
            self._number = self.attempts.by_link(self._silent.pop(0))
        elif self._then:
            url, self._then = self._then, ""
            self._app.open(url)

    def _answer(self, text: str) -> None:
        """What the dialog was told; BadPairing for what is neither link nor code."""
        if text.strip().startswith(f"{SCHEME}:"):
            link = read_link(text)
            if isinstance(link, RobotLink):
                self._connect(link)
                return
            self._number = self.attempts.by_link(link)
        else:
            split_code(text)
            if not self._url:
                raise BadPairing(tr(NO_ROBOT))
            self._number = self.attempts.by_code(f"wss://{place_of(self._url)}", text)
        if self.dialog is not None:
            self.dialog.busy = True

    def _connect(self, link: RobotLink) -> None:
        """A link without a secret was pasted: there is nothing to pair by, and the robot is asked."""
        if self.dialog is not None:
            self.dialog.close()
        self._app.open(link.url)

    def _closed(self, dialog: PairDialog) -> None:
        if dialog is self.dialog:
            self.dialog, self._number = None, -1
            self.attempts.cancel()

    # what comes in

    def on_post(self, channel: str, post: Post) -> bool:
        """Take in an attempt that ended; False for any other channel."""
        if channel != PAIRING:
            return False
        attempt: Attempt = post.value
        if attempt.number == self._number:
            self._ended(attempt)
        return True

    def _ended(self, attempt: Attempt) -> None:
        dialog = self.dialog
        if attempt.paired is not None:
            key = self.keys.add(attempt.paired)
        if dialog is None:
            self._go_on()
        elif attempt.paired is None:
            dialog.fail(attempt.problem)
        else:
            there = place_of(attempt.paired.url)  # a link may name another robot than the card's
            url = self._url if place_of(self._url) == there else attempt.paired.url
            self.dialog = None
            dialog.close()
            self._app.open(url)
            self._app.say(
                tr("Paired with {name}. This handheld {roles}.").format(
                    name=key.name, roles=tr(ROLES[key.role])
                ),
                "ok",
            )

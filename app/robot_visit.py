"""The robot that the app is connected to, from Connect to Back: its session, its screens, its pictures and recordings."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from app.connector import Connector
from app.device.wifi import WifiLock
from app.frame_pacing import FramePacer
from app.link.camera_decoder import PICTURE, REFUSED
from app.link.feeds import Post
from app.pages import Pages
from app.screens.connect.connect import ConnectScreen
from app.session.connecting import connecting_words, has_failed
from app.session.last_pictures import LastPictures
from app.session.picture_feed import PictureFeed
from app.session.recordings import Recordings
from bridge.core.link_state import LinkFault
from widgets.core.language import tr

if TYPE_CHECKING:
    from app.screens.shell.shell import Shell  # made when there is a robot, for a quick start
    from app.session.session import Session

__all__ = ["RobotVisit"]


class RobotVisit:
    """At most one robot at a time. Everything here happens in the UI thread."""

    def __init__(
        self,
        pages: Pages,
        connect: ConnectScreen,
        records: Recordings,
        *,
        connector: Callable[[], Connector],
        make_shell: Callable[[Session], Shell],
        rest: Callable[[], object],
        on_cut: Callable[[Shell | None], object],
        on_left: Callable[[], object],
        ask_to_pair: Callable[[str, str], object],
        pacer: Callable[[], FramePacer],
        now: Callable[[], float],
    ) -> None:
        """`connector` gives what makes links, `make_shell` the screens of a robot that answered; `now` is our clock [s].

        `rest` is called when every control has to let go, `on_cut` with the robot's screens before its link is closed, `on_left` afterwards.
        `ask_to_pair` gets the address of a robot that does not let this handheld in, and why.
        `pacer` gives what knows whether a frame is being drawn: a picture is shown when none is. It knows as well whether drawing is slow.
        """
        self._pages, self._records = pages, records
        self.connect = connect
        """The connect page."""
        self._connector, self._make_shell = connector, make_shell
        self._rest, self._on_cut, self._on_left = rest, on_cut, on_left
        self._ask_to_pair, self._pacer = ask_to_pair, pacer
        self._pictures = PictureFeed(now)
        self._wifi = WifiLock()
        self.seen = LastPictures(now)
        """The last picture of each robot that was on the glass."""
        self.session: Session | None = None
        """None while no robot is wanted."""

    @property
    def draws_slowly(self) -> bool:
        """What is seen of it changes less often than usual, because this device takes long for a frame."""
        return self._pacer().slow

    def open(self, url: str, *, wants_control: bool, on_rest: Callable[[], object]) -> None:
        """Connect to a robot, leaving the one before; its screens come when it answers."""
        self.leave()
        self._wifi.hold()
        self.session = self._connector().session(url, wants_control=wants_control)
        self.session.on_rest = on_rest
        self.connect.say(tr("Connecting to {url} …").format(url=url), "info", self.leave)

    def suspend(self) -> None:
        """The app is put away: let go of the robot, and keep what is known of it."""
        if self.session is not None:
            self.session.link.close(0.3)
            self._wifi.let_go()

    def resume(self) -> None:
        """The app is back: connect again."""
        if self.session is not None:
            self._wifi.hold()
            link = self._connector().link(self.session.link.url, self.session.logbook.known)
            self.session.resume(link)
            self._pictures.ask_again()

    def leave(self) -> None:
        """Back to the connect screen; the robot goes on with what it does."""
        if self.session is None:
            return
        self._rest()
        self._on_cut(self._pages.close_shell())
        self.session.link.close()
        self._wifi.let_go()
        self.session = None
        self._records.frame = None
        self._pictures.forget()
        self.connect.say("")
        self._records.stop()
        self._pages.show_connect()
        self._on_left()

    def deliver(self, channel: str, post: Post) -> None:
        """Something came from the robot."""
        if channel in (PICTURE, REFUSED):
            # in their turn: no picture that was held back comes after its refusal
            self._pacer().when_free(partial(self._show, channel, post, self.session))
        elif self.session is not None:
            self.session.deliver(channel, post)
            self._records.put(channel, post.value)
            if channel == "/robot/info" and self._pages.shell is None and self.session.connected:
                self.enter()

    def _show(self, channel: str, post: Post, of: Session | None) -> None:
        if self.session is not of:
            return  # the robot was left meanwhile
        if channel == PICTURE:
            self._pictures.show(post.value, post.received, self._pages.shell, of)
            if of is not None:
                self.seen.take(of.link.url, post.value)
        else:
            self._pictures.refuse(post.value)

    def tick(self) -> None:
        """Bring everything up to date that time changes."""
        session, shell = self.session, self._pages.shell
        if session is not None and shell is None:
            self._tick_connecting(session)
        elif session is not None and shell is not None:
            shell.tick()
            self._pictures.judge(shell)
            self._pictures.watch(session)
            self._tick_recording()

    def _tick_connecting(self, session: Session) -> None:
        if session.ever_connected:
            self.enter()
            return
        if session.link_state.fault in (LinkFault.NOT_ACCEPTED, LinkFault.NOT_PROTECTED):
            url, why = session.robot.url, session.link_state.sentence
            self.leave()
            self._ask_to_pair(url, why)
            return
        self.connect.say(*connecting_words(session), self.leave)
        if has_failed(session):
            self.leave()
            self.connect.say(session.link_state.sentence, "danger")

    def enter(self) -> None:
        """The robot has answered: put its screens on the glass."""
        if self.session is not None:
            self._pictures.watch(self.session)  # the first is on its way while the screen is made
            self.connect.say("")
            self._pages.enter(self._make_shell(self.session), self.session)

    def toggle_recording(self) -> None:
        """Start recording, or finish the one that runs."""
        self._records.toggle(self.session)
        self._tick_recording()

    def _tick_recording(self) -> None:
        self._records.check()
        shell = self._pages.shell
        if shell is not None:
            shell.bar.recorded = f"REC {self._records.clock}" if self._records.recorder is not None else ""

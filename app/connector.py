"""New connections to robots, each with what this handheld is called and what it knows of the robot's events."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from app.core.settings_store import Settings
from app.link.feeds import Feeds, Mailbox
from app.trust.keyring import RobotKey
from bridge.core.camera_frames import Frame
from bridge.core.network_thread import NetworkThread

if TYPE_CHECKING:
    from app.link.event_order import KnownEvents
    from app.link.link import Link  # all these when there is a robot, for a quick start
    from app.session.session import Session

__all__ = ["Connector"]


class Connector:
    """Makes links and sessions; each link is started."""

    def __init__(
        self,
        settings: Settings,
        mailbox: Mailbox,
        network: NetworkThread,
        *,
        client_id: str,
        client_name: str,
        on_frame: Callable[[Frame, float], None],
        key_for: Callable[[str], RobotKey | None],
        now: Callable[[], float],
    ) -> None:
        """`on_frame` is called in the network thread with each camera frame and when it came [s]; `now` is our clock [s].

        `key_for` gives the key of the robot that is expected at an address; None where it is not paired.
        """
        self._key_for = key_for
        self._settings, self._mailbox, self._network = settings, mailbox, network
        self._client_id = client_id
        self.client_name = client_name
        """What this handheld is called for the next robot."""
        self._on_frame, self._now = on_frame, now

    def link(self, url: str, known: KnownEvents | None = None) -> Link:
        """A link to the robot at `url`; `known` is how far its events are known."""
        from app.link.link import Link
        from app.session.logbook import marks

        key = self._key_for(url)
        link = Link(
            url,
            self._mailbox,
            self._network,
            client_id=self._client_id,
            client_name=self.client_name,
            credentials=key.credentials if key else None,
            known=known,
            marks=marks(self._settings),
            on_picture=self._on_frame,
            now=self._now,
        )
        link.start()
        return link

    def session(self, url: str, *, wants_control: bool) -> Session:
        """A session with the robot at `url`."""
        link = self.link(url)  # it connects while the rest is made
        from app.session.session import Session

        return Session(
            link,
            Feeds(self._now),
            self._settings,
            now=self._now,
            client_id=self._client_id,
            wants_control=wants_control,
            key=self._key_for(url),
        )

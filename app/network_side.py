"""Everything that works in the network thread, and the mailbox by which it reaches the UI thread."""

from __future__ import annotations

import math
from collections.abc import Callable

from app.connector import Connector
from app.core.settings_store import Settings
from app.core.waking import wake_trigger
from app.discovery.beacon_listener import BeaconListener
from app.link.camera_decoder import CameraDecoder
from app.link.feeds import Mailbox, Post
from app.session.recordings import Recordings
from app.timers import GLASS_PERIOD
from app.trust.keyring import RobotKey
from app.trust.pairing_attempts import PairingAttempts
from bridge.core.camera_frames import Frame
from bridge.core.network_thread import NetworkThread

__all__ = ["NetworkSide"]


class NetworkSide:
    """Made when the app starts and closed when it stops."""

    def __init__(
        self,
        settings: Settings,
        records: Recordings,
        *,
        client_id: str,
        client_name: str,
        key_for: Callable[[str], RobotKey | None],
        deliver: Callable[[str, Post], object],
        discover: bool,
        now: Callable[[], float],
    ) -> None:
        """`key_for` gives the key of the robot that is expected at an address. `deliver` is called in the UI thread with each channel and post; `discover` listens to robots saying HELLO."""
        self._records, self._deliver, self._now = records, deliver, now
        self._drained = -math.inf
        self.mailbox = Mailbox(wake_trigger(self.drain))
        self._network = NetworkThread()
        self._camera = CameraDecoder(self.mailbox)
        self.nearby = BeaconListener(self.mailbox, self._network, now=now)
        if discover:
            self.nearby.start()
        self.pairing = PairingAttempts(self.mailbox, self._network, client_name, now)
        self.connector = Connector(
            settings,
            self.mailbox,
            self._network,
            client_id=client_id,
            client_name=client_name,
            on_frame=self._on_frame,
            key_for=key_for,
            now=now,
        )

    def drain(self) -> None:
        """Deliver everything that came."""
        self._drained = self._now()
        for channel, post in self.mailbox.drain():
            self._deliver(channel, post)

    def drain_if_due(self) -> None:
        """The same, unless something urgent has just brought it along: each time is a drawing."""
        if self._now() - self._drained >= GLASS_PERIOD * 0.6:
            self.drain()

    def _on_frame(self, frame: Frame, received: float) -> None:
        """In the network thread: keep the frame for a snapshot and for what is recorded, and have it decoded."""
        self._records.see(frame)
        self._camera.show(frame, received)

    def close(self) -> None:
        """Stop listening, and end every thread."""
        self.nearby.close()
        self._camera.close()
        self._network.close()

"""Drive commands on their way to the robot: from the slot to the topic of their type, again and again while the stick is held."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Callable

from app.core.command_origin import NOBODY, origins
from app.link.capabilities import MANOEUVRE
from app.link.capability_watch import CapabilityWatch
from app.link.drive_slot import Drive, DriveSlot, stamped_at
from app.link.link_health import LinkHealth
from bridge.client.client import BridgeClient
from bridge.core.network_thread import NetworkThread
from bridge.core.topic_choice import drive_message
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre

__all__ = ["DriveSender"]

SLOT_PERIOD = 0.05
"""Between two looks at the drive slot when nothing wakes the sender [s]."""


class DriveSender:
    """What is wanted is set in any thread; it is sent in the network thread."""

    def __init__(
        self,
        client: BridgeClient,
        network: NetworkThread,
        robot: CapabilityWatch,
        health: LinkHealth,
        *,
        now: Callable[[], float],
        forbidden: Callable[[], bool],
    ) -> None:
        """`now` is our clock [s]; while the link is silent or `forbidden` says so, nothing but rest is sent."""
        self._client, self._network, self._robot = client, network, robot
        self._health, self._forbidden = health, forbidden
        self.slot = DriveSlot(now)
        self._wake = asyncio.Event()
        self._moved = False
        """The robot was told over this link to move."""
        self.driven_by = NOBODY
        """Origin of the last command that moves the robot; the slot knows whether it still does."""

    # in any thread

    def want(self, order: Drive) -> None:
        """Drive so until told otherwise; leaves at once. ValueError for a manoeuvre that is no drive command."""
        if order != Twist():
            self.driven_by = origins.current()
        self.slot.want(order)
        self.wake()

    def amend(self, order: Drive) -> None:
        """Drive so instead of what is wanted; a robot that rests goes on resting."""
        self.slot.amend(order)
        self.wake()

    def latch(self, on: bool) -> None:
        """Send zero speed until the latch is off again; then the stick must be pushed anew."""
        self.slot.latch(on)
        self.wake()

    def wake(self) -> None:
        """Have the slot looked at now."""
        self._network.call(self._wake.set)

    # in the network thread

    async def run(self) -> None:
        """Send until cancelled, and measure the link before each look at the slot."""
        while True:
            try:
                async with asyncio.timeout(self.slot.patience(SLOT_PERIOD)):
                    await self._wake.wait()
            except TimeoutError:
                pass
            self._wake.clear()
            self._health.measure()
            stamp = self._client.robot_time()
            silent = self._health.silent or (math.isnan(stamp) and not self._robot.foreign)
            self._publish(self.slot.due(allowed=not (silent or self._forbidden())), stamp)

    def _publish(self, order: Drive | None, stamp: float) -> None:
        """Send a drive command by the topic of its type; `stamp` is the robot's clock [s], NaN while it is not known."""
        rest, steers = order == Twist(), self._robot.steers
        topic = MANOEUVRE if isinstance(order, Manoeuvre) and steers else self._robot.drive_topic
        if order is None or topic is None or (isinstance(order, Manoeuvre) and not steers):
            return
        # rest goes out whatever is known of the clock; what moves a robot of ours does not without one
        void = rest and (self.slot.latched or math.isnan(stamp))
        self._moved = self._moved or not rest
        self._client.publish(topic, self._message(order), stamp=None if void else stamp, even_late=rest)

    def _message(self, order: Drive) -> Msg:
        """A drive command as the robot takes it."""
        if isinstance(order, Manoeuvre):
            return stamped_at(order, self._client.robot_time())
        capabilities = self._robot.capabilities
        stamped = capabilities is not None and capabilities.stamped
        return drive_message(order, self._client.robot_time(), stamped=stamped)

    def _publish_rest(self) -> None:
        topic = self._robot.drive_topic
        if topic is not None:
            self._client.publish(topic, self._message(Twist()), even_late=True)

    def on_connected(self) -> None:
        """A link was made: bring a foreign robot to rest that was driven over the one before."""
        if self._robot.foreign and self._moved and self._robot.drive_topic is not None:
            # whatever is left of what was sent before the link was lost; who only watched says nothing
            self._publish_rest()
            self.slot.rest()

    def on_lost(self) -> None:
        """The link is gone: nothing old may leave later."""
        self.slot.drop()

    def finish(self) -> None:
        """Send rest a last time where the robot moves or is held, and forget what is unsent."""
        rest = self.slot.driving or self.slot.latched
        self.slot.drop()
        if rest:
            self._publish_rest()

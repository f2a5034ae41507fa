"""A rosbridge v2 client that reconnects by itself and never sends a message late."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import math
import random
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import msgspec
from msgspec import Raw

from bridge.client.camera_stream import CameraStream
from bridge.client.connection import Connection, open_connection
from bridge.client.credentials import Credentials
from bridge.client.heartbeat import Heartbeat
from bridge.client.liveness import Liveness
from bridge.client.message_receiver import MessageReceiver
from bridge.client.reconnecting import Reconnecting
from bridge.client.registrations import Registrations
from bridge.client.service_calls import ServiceCalls
from bridge.codec import to_server_json
from bridge.core.address import BadAddress, LinkLost, NotAccepted
from bridge.core.link_state import LinkFault, LinkState, Phase
from bridge.discovery.network_changes import Network, NetworkChanges, SystemNetwork
from bridge.driving.drive_rest import DriveRest
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.protocol import (
    ClientSession,
    Op,
    Publish,
    ServiceResponse,
    dump,
)

__all__ = ["BridgeClient", "CameraStream", "LinkState", "Phase"]

log = logging.getLogger(__name__)

OPEN_TIMEOUT = 3.0
"""Longest time for looking up the name, and again for opening the connection [s]."""
UNREAD_TIMEOUT = 0.25
"""Drive commands are held back while a foreign server leaves data unread for longer than this [s]."""
CHANGE_CHECK_PERIOD = 0.25
"""Time between two checks for changes of the network while waiting for the next attempt [s]."""


class BridgeClient(Registrations, ServiceCalls, Reconnecting):
    """A link to one robot; all methods belong to the event loop that `run` runs in."""

    def __init__(
        self,
        url: str,
        *,
        on_state: Callable[[LinkState], None] | None = None,
        now: Callable[[], float] = time.monotonic,
        backoff: tuple[float, float] = (0.5, 5.0),
        rng: random.Random | None = None,
        network: Network | None = None,
        credentials: Credentials | None = None,
        even_unknown: bool = False,
    ) -> None:
        """`url` is `ws://HOST:PORT`, or `wss://HOST:PORT` for TLS. `backoff` is the first and the longest wait between attempts [s].

        `on_state` is called with each new state. `now` is this machine's clock [s]. `rng` spreads the waits, so that
        many clients do not reconnect at once. `network` reports this machine's addresses; None asks the system. With
        `credentials` only the robot with that key is spoken to, as `bridge.client.connection.open_connection` says;
        `even_unknown` connects without the token where that robot does not accept it: what a stranger may is possible then.
        """
        Reconnecting.__init__(self, url, now, backoff, rng)
        session = ClientSession()
        ServiceCalls.__init__(self, session, self.place)
        Registrations.__init__(self, session, lambda: self.foreign)
        self.state = LinkState(Phase.CLOSED, "Not connected.", 0, 0.0)
        self._on_state = on_state
        self._network: Network = SystemNetwork() if network is None else network
        self._receiver = MessageReceiver(session, self._provider, url, now)
        self.traffic = self._receiver.traffic  # what came of each topic
        self._credentials, self._even_unknown = credentials, even_unknown
        self._connection: Connection | None = None
        self._address: tuple[str, int] | None = None
        self._heartbeat: Heartbeat | None = None
        self._rest = DriveRest(partial(self.publish, even_late=True), now)

    @property
    def rtt(self) -> float:
        """Round-trip time of the ping answered last [s]; NaN until there is one."""
        return self._heartbeat.statistics.rtt if self._heartbeat else math.nan

    @property
    def offset(self) -> float:
        """Offset of the operators' clock from `now()` [s], from the fastest of the last 20 pings; NaN until known."""
        return self._heartbeat.statistics.offset if self._heartbeat else math.nan

    @property
    def lost(self) -> int:
        """Number of the last 20 pings that were not answered within 1.5 s."""
        return self._heartbeat.statistics.lost(self._now()) if self._heartbeat else 0

    @property
    def foreign(self) -> bool:
        """Whether the server is not a Pilothouse server; False without a connection."""
        return self._connection is not None and not self._connection.ours

    @property
    def fingerprint(self) -> str:
        """Fingerprint of the robot's certificate; empty without a connection or without TLS."""
        return self._connection.fingerprint if self._connection else ""

    @property
    def ros2(self) -> bool:
        """Whether the server reported ROS 2: types are then spelled `pkg/msg/Type`, and times `sec`, `nanosec`."""
        return self._session.ros2

    @property
    def late(self) -> bool:
        """Whether a message that is sent now may arrive late, because nothing was received for a second.

        False before and after a connection. A connection that is being given up is late until `state` reports it.
        """
        if self.state.phase is not Phase.CONNECTED or self._heartbeat is None:
            return False
        return self._connection is None or self._heartbeat.liveness.is_late(self._now())

    def robot_time(self) -> float:
        """The operators' clock now [s], as the robot reported it; NaN until it is known."""
        return self._now() + self.offset

    def publish(self, topic: str, msg: Msg, *, stamp: float | None = None, even_late: bool = False) -> bool:
        """Send a message at once; False when it was dropped because there is no connection or it is stuck.

        A dropped message is never sent later. `stamp` [s] is the operators' clock at the operator's input and marks a
        drive command, which is also dropped when nothing was received from the robot for a second. NaN means that
        this clock is not known: the command then goes to a foreign server only, without a stamp. Foreign servers do
        not check the age of a command: for them a twist with a stamp is also dropped while they have left earlier
        data unread for 0.25 s.

        A server of another maker gets zero speed when no drive command follows a twist with a stamp for 0.25 s, and at `close`.
        It is tried until sent.

        `even_late` is for commands to rest, which are right at any age: they are sent unless the socket is full.
        ProtocolError for values that JSON cannot represent.
        """
        connection, heartbeat = self._connection, self._heartbeat
        if connection is None or heartbeat is None or self.state.phase is not Phase.CONNECTED:
            return False
        if connection.full if even_late else connection.stuck:
            return False
        if stamp is not None and not even_late and self._too_late(msg, stamp, connection, heartbeat):
            return False
        written = Raw(to_server_json(msg, self._session.ros2))
        if stamp is not None and not connection.ours:
            self._rest.note(topic, msg)
        stamp = None if stamp is not None and not math.isfinite(stamp) else stamp
        return self._send(Publish(topic=topic, msg=written, stamp=stamp))

    def _too_late(self, msg: Msg, stamp: float, connection: Connection, heartbeat: Heartbeat) -> bool:
        """Whether a drive command would wait on its way. A foreign server where it would not is asked for a sign of
        having read it."""
        now = self._now()
        if heartbeat.liveness.is_late(now) or (connection.ours and not math.isfinite(stamp)):
            return True
        if connection.ours or not isinstance(msg, (Twist, TwistStamped)):
            return False
        if heartbeat.liveness.answers_pings and connection.unread_time(now) > UNREAD_TIMEOUT:
            return True
        connection.probe(now)
        return False

    async def close(self) -> None:
        """End the link for good; `run` returns. Takes 0.5 s at most.

        A robot behind a server of another maker that this client drives gets zero speed before; for that a full socket is
        waited for, 0.2 s at most.
        """
        try:
            if not await self._rest.end():
                log.warning("%s could not be told to rest: nothing more could be sent to it", self.place)
        finally:
            await super().close()
        if self.state.phase is not Phase.CLOSED:
            self._set_state(Phase.CLOSED, "Not connected.")

    async def stay_connected(self) -> None:
        """Connect, and reconnect whenever the link is lost; returns when the address can never work."""
        attempt, trouble, fault = 0, "", LinkFault.NONE
        while True:
            attempt += 1
            opening = f"{trouble} Trying again." if trouble else f"Connecting to {self.place}."
            self._set_state(Phase.CONNECTING, opening, attempt, fault=fault)
            try:
                await self._connect_once()
            except BadAddress as error:
                self._set_state(Phase.CLOSED, str(error), attempt)
                return
            except LinkLost as error:
                trouble, fault = str(error), error.fault
            if self.state.phase is Phase.CONNECTED:
                attempt = 0
            wait = self.wait_before(max(1, attempt), fault)
            self._set_state(Phase.WAITING, trouble, attempt, wait, fault)
            await self._pause(wait)

    async def _pause(self, wait: float) -> None:
        """Wait `wait` [s], or less when the route to the robot changes or this machine wakes from sleep."""
        changes = NetworkChanges(self._network, self._address)
        clock = asyncio.get_running_loop().time
        until = clock() + wait
        while (left := until - clock()) > 0:
            await asyncio.sleep(min(left, CHANGE_CHECK_PERIOD))
            if changes.has_changed():
                return

    async def _connect_once(self) -> None:
        """Connect and serve the link until it is lost; always raises LinkLost or BadAddress."""
        connection = await self._open()
        self._address = connection.address
        self._heartbeat = heartbeat = Heartbeat(
            connection,
            self._session,
            send=self._send,
            place=self.place,
            now=self._now,
            network=self._network,
            on_robot=self._on_robot,
        )
        self._connection = connection
        work = {
            asyncio.create_task(self._receive(connection, heartbeat.liveness)),
            asyncio.create_task(heartbeat.run()),
            asyncio.create_task(self._rest.run()),
        }
        lost = False
        try:
            for op in self._session.opening():
                self._send(op)
            self._send(self._session.call("/rosapi/get_ros_version", b"{}", self._on_ros_version))
            done, _ = await asyncio.wait(work, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                task.result()
        except LinkLost:
            lost = True
            raise
        finally:
            self._connection = None
            self._rest.forget()
            for task in work:
                task.cancel()
            await asyncio.gather(*work, return_exceptions=True)
            self._session.on_lost()
            await self._provider.on_lost()
            await connection.close(lost=lost)

    async def _open(self) -> Connection:
        try:
            return await open_connection(self.url, OPEN_TIMEOUT, credentials=self._credentials)
        except NotAccepted:
            if self._credentials is None or not self._even_unknown:
                raise
        unknown = replace(self._credentials, token="")
        return await open_connection(self.url, OPEN_TIMEOUT, credentials=unknown)

    def _on_robot(self) -> None:
        clock = "" if math.isfinite(self.offset) else ", which does not report its time"
        self._set_state(Phase.CONNECTED, f"Connected to {self.place}{clock}.")

    def _on_ros_version(self, answer: ServiceResponse | None) -> None:
        """Note the server's generation of ROS. A ROS 1 server does not know the question: it refuses or is silent."""
        if answer is None:
            return
        ros2 = answer.result and _version_in(answer) >= 2
        if ros2 != self._session.ros2:
            self._session.ros2 = ros2
            for op in self._session.opening():
                self._send(op)

    async def _receive(self, connection: Connection, liveness: Liveness) -> None:
        await self._receiver.run(connection, liveness)
        raise LinkLost(f"The connection to {self.place} was cut.")

    def _send(self, op: Op) -> bool:
        return self._connection is not None and self._connection.send(dump(op))

    def _set_state(
        self,
        phase: Phase,
        sentence: str,
        attempt: int = 0,
        retry_in: float = 0.0,
        fault: LinkFault = LinkFault.NONE,
    ) -> None:
        self.state = LinkState(phase, sentence, attempt, retry_in, fault)
        if self._on_state is not None:
            try:
                self._on_state(self.state)
            except Exception:
                log.exception("Telling the state of %s failed", self.url)


def _version_in(answer: ServiceResponse) -> int:
    """The generation of ROS in an answer; 1 when it does not say."""
    with contextlib.suppress(msgspec.MsgspecError):
        found = msgspec.json.decode(answer.values)
        version = found.get("version") if isinstance(found, dict) else None
        return version if isinstance(version, int) else 1
    return 1

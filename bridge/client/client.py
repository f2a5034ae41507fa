"""The handheld's end of the socket: a rosbridge v2 client that connects again by itself and never sends late."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import math
import random
import time
from collections.abc import Callable
from typing import TypeVar

import msgspec
from msgspec import UNSET, Raw

from bridge.client.camera_stream import CameraStream
from bridge.client.client_goals import part_of
from bridge.client.connection import Connection, dial
from bridge.client.heartbeat import Heartbeat
from bridge.client.reconnecting import Reconnecting
from bridge.client.service_calls import ServiceCalls
from bridge.client.service_provider import Call, Run, ServiceProvider
from bridge.codec import from_builtins, from_json, to_json
from bridge.core.address import BadAddress, LinkLost
from bridge.core.errors import ProtocolError
from bridge.core.link_state import LinkState, Phase
from bridge.discovery.network_changes import Network, NetworkChanges, SystemNetwork
from bridge.msgs import Msg, ros1_name
from bridge.msgs.geometry_msgs import Twist, TwistStamped
from bridge.protocol import (
    ActionFeedback,
    ActionResult,
    BinaryPublish,
    CallService,
    CancelActionGoal,
    ClientSession,
    Op,
    Publish,
    Reduction,
    SendActionGoal,
    ServiceResponse,
    Status,
    Subscribe,
    dump,
)
from bridge.rosbytes import deserialize

__all__ = ["BridgeClient", "CameraStream", "LinkState", "Phase"]

log = logging.getLogger(__name__)
M = TypeVar("M", bound=Msg)
R = TypeVar("R", bound=Msg)

OPEN_TIMEOUT = 3.0
"""How long looking up a name may take, and then opening the connection [s]."""
UNREAD_TIMEOUT = 0.25
"""What a foreign server leaves unread for longer holds drive commands back until it was read [s]."""
CHANGE_CHECK_PERIOD = 0.25
"""While waiting for the next attempt the network is looked at this often [s]."""
_RAW = {"secs", "nsecs", "bytes"}
"""What stands for a message in cbor-raw: when it was received, and itself in the bytes of ROS."""
_MAX_REPORTED = 100
"""So many kinds of what is wrong are told of once each."""


class BridgeClient(ServiceCalls, Reconnecting):
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
    ) -> None:
        """`url` is `ws://HOST:PORT`. `backoff` is the first and the longest wait between attempts [s].

        `now` is this machine's clock [s]; `rng` spreads the waits, so that many handhelds do not come at once; `network`
        tells of this machine's addresses, None for asking the system.
        """
        Reconnecting.__init__(self, url, now, backoff, rng)
        ServiceCalls.__init__(self, ClientSession(), self.place)
        self.state = LinkState(Phase.CLOSED, "Not connected.", 0, 0.0)
        self._on_state = on_state
        self._network: Network = SystemNetwork() if network is None else network
        self._provider = ServiceProvider(self._session, self._send, lambda: self.foreign)
        self._connection: Connection | None = None
        self._address: tuple[str, int] | None = None
        self._heart: Heartbeat | None = None
        self._heard = -math.inf
        self._complained: set[str] = set()

    @property
    def rtt(self) -> float:
        """How long the last answered ping took [s]; NaN until there is one."""
        return self._heart.pings.rtt if self._heart else math.nan

    @property
    def offset(self) -> float:
        """The operators' clock minus `now()` [s], by the least rtt of the last 20 pings; NaN until known."""
        return self._heart.pings.offset if self._heart else math.nan

    @property
    def lost(self) -> int:
        """How many of the last 20 pings were not answered within 1.5 s."""
        return self._heart.pings.lost(self._now()) if self._heart else 0

    @property
    def foreign(self) -> bool:
        """The server is none of ours; False too while there is no connection."""
        return self._connection is not None and not self._connection.ours

    @property
    def ros2(self) -> bool:
        """The server said last that it speaks ROS 2: types are spelled `pkg/msg/Type` to it, and times `sec`, `nanosec`."""
        return self._session.ros2

    @property
    def late(self) -> bool:
        """Nothing came for a second: what is sent now may wait on its way. False before and after a connection.

        One that is being given up is late until `state` tells of it.
        """
        if self.state.phase is not Phase.CONNECTED or self._heart is None:
            return False
        return self._connection is None or self._heart.life.late(self._now())

    def robot_time(self) -> float:
        """The operators' clock, which the robot tells, now [s]; NaN until it is known."""
        return self._now() + self.offset

    def subscribe(
        self,
        topic: str,
        type: type[M],
        callback: Callable[[M, float], object],
        *,
        throttle_rate: int = 0,
        queue_length: int = 1,
        compression: str = "none",
        fragment_size: int | None = None,
        reduce: Reduction | None = None,
    ) -> Callable[[], None]:
        """Have `callback(msg, received)` called for each message, `received` by `now()` [s]; gives the unsubscriber.

        It is remembered over reconnects. `throttle_rate` is the shortest time between two messages [ms];
        `compression` is one of `protocol.COMPRESSIONS`; `fragment_size` the longest text frame [characters]. `reduce` asks for
        less of each message, which only our servers can do: fields that were left out have their defaults. A message that
        does not fit `type` is logged and left out.
        """
        wanted = Subscribe(
            topic=topic,
            type=type.MSGTYPE,
            throttle_rate=throttle_rate,
            queue_length=queue_length,
            compression=compression,
            fragment_size=UNSET if fragment_size is None else fragment_size,  # rosbridge_server refuses null
            reduce=reduce,
        )
        first, last = self._session.subscribe(wanted, type, callback)
        self._send(first)

        def unsubscribe() -> None:
            if self._session.unsubscribe(last):
                self._send(last)

        return unsubscribe

    def advertise(self, topic: str, type: type[Msg], *, latch: bool = False) -> None:
        """Say that this client publishes on `topic`, now and after each reconnect; foreign servers want to know.

        With `latch` whoever subscribes later gets the last message at once.
        """
        self._send(self._session.advertise(topic, type, latch=latch))

    def unadvertise(self, topic: str) -> None:
        """Say that this client publishes on `topic` no longer."""
        if op := self._session.unadvertise(topic):
            self._send(op)

    def publish(self, topic: str, msg: Msg, *, stamp: float | None = None, even_late: bool = False) -> bool:
        """Send a message at once. False when it was dropped, because there is no connection or it is stuck.

        It is never sent later. `stamp` is when the operator meant it [s], operators' clock: a drive command, which is
        dropped too when nothing came from the robot for a second. NaN is for when that clock is not known: such a command
        goes to a foreign server only, without a stamp. Foreign servers do not mind how old a command is: to them a twist with
        a stamp is dropped as well while they leave unread, for 0.25 s, what was sent before.

        `even_late` is for commands to rest, which are as right late as in time: they go out unless the socket is full.
        ProtocolError for what JSON cannot say.
        """
        connection, heart = self._connection, self._heart
        if connection is None or heart is None or self.state.phase is not Phase.CONNECTED:
            return False
        if connection.full if even_late else connection.stuck:
            return False
        if stamp is not None and not even_late and self._too_late(msg, stamp, connection, heart):
            return False
        stamp = None if stamp is not None and not math.isfinite(stamp) else stamp
        return self._send(Publish(topic=topic, msg=Raw(to_json(msg, self._session.ros2)), stamp=stamp))

    def _too_late(self, msg: Msg, stamp: float, connection: Connection, heart: Heartbeat) -> bool:
        """A drive command would wait on its way; of one to a foreign server that does not, it is asked when it was read."""
        now = self._now()
        if heart.life.late(now) or (connection.ours and not math.isfinite(stamp)):
            return True
        if connection.ours or not isinstance(msg, (Twist, TwistStamped)):
            return False
        if heart.life.pongs and connection.unread(now) > UNREAD_TIMEOUT:
            return True
        connection.sound(now)
        return False

    def serve(
        self, service: str, type: str, call: Call, *, request: type[Msg] | None = None
    ) -> Callable[[], None]:
        """Answer calls of `service`, of ROS type `type`, from now on and after each reconnect; gives what ends it.

        `call(request)` gives the response at once or as an awaitable; Refused with a sentence says no. `request` is needed
        for types that are not in `bridge.msgs.TYPES`; ProtocolError without.
        """
        name = ros1_name(type)
        kind = request or part_of(name, "Request")
        self._send(self._provider.serve(service, name, kind, call))

        def end() -> None:
            if op := self._session.stop_serving(service):
                self._send(op)

        return end

    def provide_action(
        self, action: str, type: str, run: Run, *, goal: type[Msg] | None = None
    ) -> Callable[[], None]:
        """Carry out goals of `action`, of ROS type `type`, from now on and after each reconnect; gives what ends it.

        `run(goal, tell)` gives the result when it is done and calls `tell(feedback)` on its way; it is cancelled when the goal
        is taken back or the connection is lost, and Refused with a sentence says no. `goal` is needed for types that
        are not in `bridge.msgs.TYPES`; ProtocolError without.
        """
        name = ros1_name(type)
        self._send(self._provider.provide(action, name, goal or part_of(name, "Goal"), run))

        def end() -> None:
            if op := self._session.stop_providing(action):
                self._send(op)

        return end

    async def close(self) -> None:
        """End the link for good; `run` returns. Takes 0.5 s at most."""
        await super().close()
        if self.state.phase is not Phase.CLOSED:
            self._become(Phase.CLOSED, "Not connected.")

    async def stay_connected(self) -> None:
        """Connect again and again; returns when the address can never work."""
        attempt, trouble = 0, ""
        while True:
            attempt += 1
            opening = f"{trouble} Trying again." if trouble else f"Connecting to {self.place}."
            self._become(Phase.CONNECTING, opening, attempt)
            try:
                await self._connect_once()
            except BadAddress as error:
                self._become(Phase.CLOSED, str(error), attempt)
                return
            except LinkLost as error:
                trouble = str(error)
            if self.state.phase is Phase.CONNECTED:
                attempt = 0
            wait = self.wait_before(max(1, attempt))
            self._become(Phase.WAITING, trouble, attempt, wait)
            await self._pause(wait)

    async def _pause(self, wait: float) -> None:
        """Wait `wait` [s], less when there is a new way to the robot or this machine wakes up."""
        changes = NetworkChanges(self._network, self._address)
        clock = asyncio.get_running_loop().time
        until = clock() + wait
        while (left := until - clock()) > 0:
            await asyncio.sleep(min(left, CHANGE_CHECK_PERIOD))
            if changes.seen():
                return

    async def _connect_once(self) -> None:
        """Connect and serve the link until it is lost; raises LinkLost or BadAddress always."""
        connection = await dial(self.url, OPEN_TIMEOUT)
        self._address = connection.address
        self._heard = self._now()
        self._heart = heart = Heartbeat(
            connection,
            self._session,
            send=self._send,
            place=self.place,
            now=self._now,
            network=self._network,
            on_robot=self._met,
        )
        self._connection = connection
        work = {asyncio.create_task(self._listen(connection, heart)), asyncio.create_task(heart.run())}
        lost = False
        try:
            for op in self._session.opening():
                self._send(op)
            self._send(self._session.call("/rosapi/get_ros_version", b"{}", self._told_version))
            done, _ = await asyncio.wait(work, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                task.result()
        except LinkLost:
            lost = True
            raise
        finally:
            self._connection = None
            for task in work:
                task.cancel()
            await asyncio.gather(*work, return_exceptions=True)
            self._session.lose()
            await self._provider.lose()
            await connection.hang_up(lost=lost)

    def _met(self) -> None:
        clock = "" if math.isfinite(self.offset) else ", which does not tell its time"
        self._become(Phase.CONNECTED, f"Connected to {self.place}{clock}.")

    def _told_version(self, answer: ServiceResponse | None) -> None:
        """A server of ROS 1 does not know the question: it refuses or says nothing."""
        if answer is None:
            return
        ros2 = answer.result and _version_in(answer) >= 2
        if ros2 != self._session.ros2:
            self._session.ros2 = ros2
            for op in self._session.opening():
                self._send(op)

    async def _listen(self, connection: Connection, heart: Heartbeat) -> None:
        async for raw in connection.arriving():
            self._heard = now = self._now()
            heart.life.heard(now)
            for found in self._session.receive(raw, now):
                try:
                    self._receive(found, heart)
                except ProtocolError as error:
                    self._complain(error.op or "", error)
        raise LinkLost(f"The connection to {self.place} was cut.")

    def _receive(self, found: Op | BinaryPublish | ProtocolError, heart: Heartbeat) -> None:
        if isinstance(found, (Publish, BinaryPublish)):
            self._hear(found, heart)
        elif isinstance(found, ServiceResponse):
            if self._session.on_response(found):
                heart.life.answered()
        elif isinstance(found, ActionFeedback):
            self._session.on_feedback(found)
        elif isinstance(found, ActionResult):
            self._session.on_result(found)
        elif isinstance(found, Status):
            log.warning("%s says: %s", self.url, found.msg)
        elif isinstance(found, (CallService, SendActionGoal)):
            self._asked(found, heart)
        elif isinstance(found, CancelActionGoal):
            self._session.goal_cancelled(found)
        else:
            self._misunderstood(found, heart)

    def _asked(self, op: CallService | SendActionGoal, heart: Heartbeat) -> None:
        """The server wants something of us."""
        try:
            if isinstance(op, CallService):
                self._session.called(op)
            else:
                self._session.goal_given(op)
        except ProtocolError as error:
            if heart.life.robot:
                self._provider.refuse(op, error)
            else:
                heart.life.strange()  # an echo, for instance
            raise

    def _misunderstood(self, found: Op | ProtocolError, heart: Heartbeat) -> None:
        if isinstance(found, ProtocolError):
            if found.op is None:
                heart.life.strange()
            raise found
        heart.life.strange()
        name = str(found.__struct_config__.tag)
        raise ProtocolError(f"{name} is for servers; it is passed over.", op=name)

    def _hear(self, op: Publish | BinaryPublish, heart: Heartbeat) -> None:
        decoded: dict[type[Msg], Msg] = {}
        for subscription in self._session.subscribers(op.topic):
            kind = subscription.type
            try:
                if kind not in decoded:
                    decoded[kind] = _decoded(op, kind, self._session.ros2)
                subscription.callback(decoded[kind], self._heard)
            except ProtocolError as error:
                self._complain(op.topic, ProtocolError(f"{op.topic} is left out: {error}"))
            except Exception:
                log.exception("Showing %s failed", op.topic)
        if decoded:
            heart.life.answered()

    def _complain(self, about: str, error: ProtocolError) -> None:
        """Tell of each kind of trouble once."""
        new = about not in self._complained and len(self._complained) < _MAX_REPORTED
        if new:
            self._complained.add(about)
        log.log(logging.WARNING if new else logging.DEBUG, "From %s: %s", self.url, error)

    def _send(self, op: Op) -> bool:
        return self._connection is not None and self._connection.post(dump(op))

    def _become(self, phase: Phase, sentence: str, attempt: int = 0, retry_in: float = 0.0) -> None:
        self.state = LinkState(phase, sentence, attempt, retry_in)
        if self._on_state is not None:
            try:
                self._on_state(self.state)
            except Exception:
                log.exception("Telling the state of %s failed", self.url)


def _decoded(op: Publish | BinaryPublish, type: type[M], cdr: bool) -> M:
    if isinstance(op, Publish):
        return from_json(op.msg, type)
    if isinstance(op.msg, dict) and op.msg.keys() == _RAW and isinstance(op.msg["bytes"], bytes):
        return deserialize(op.msg["bytes"], type, cdr)
    return from_builtins(op.msg, type)


def _version_in(answer: ServiceResponse) -> int:
    """The generation of ROS; 1 when the answer does not say."""
    with contextlib.suppress(msgspec.MsgspecError):
        told = msgspec.json.decode(answer.values)
        version = told.get("version") if isinstance(told, dict) else None
        return version if isinstance(version, int) else 1
    return 1

"""The heartbeat of one connection: pings that measure it and keep a check on its life."""

from __future__ import annotations

import asyncio
import math
from collections import deque
from collections.abc import Callable

from bridge.client.connection import Connection
from bridge.client.liveness import Liveness
from bridge.client.ping_statistics import Ping, PingStatistics
from bridge.codec import from_json
from bridge.core.address import LinkLost
from bridge.core.errors import ProtocolError
from bridge.discovery.network_changes import Network, NetworkChanges
from bridge.msgs.rosapi_msgs import GetTimeResponse
from bridge.protocol import ClientSession, Id, Op, ServiceResponse

__all__ = ["Heartbeat"]

PING_PERIOD = 0.5
"""Time between two pings [s]."""
_MAX_TIME_QUESTIONS = 10
"""Most questions for the time that wait for their answer."""


class Heartbeat:
    """Pings over one connection until it is lost."""

    def __init__(
        self,
        connection: Connection,
        session: ClientSession,
        *,
        send: Callable[[Op], bool],
        place: str,
        now: Callable[[], float],
        network: Network,
        on_robot: Callable[[], object],
    ) -> None:
        """`on_robot` is called once, when the other end has proved to be a robot's server."""
        self.statistics = PingStatistics()
        self.liveness = Liveness(place, connection.ours, now())
        self._connection = connection
        self._session = session
        self._send = send
        self._place = place
        self._now = now
        self._network = network
        self._on_robot = on_robot
        self._notified = False
        self._time_questions: deque[Id] = deque()

    async def run(self) -> None:
        """Send pings; raises LinkLost when the link is silent, the network changed under it, or the other end is no
        robot."""
        changes = NetworkChanges(self._network, self._connection.address)
        while True:
            self._ping()
            await asyncio.sleep(PING_PERIOD)
            now, local = self._now(), self._connection.local
            if local and not self._network.has(local):
                raise LinkLost(f"The network changed: this device is no longer {local}.")
            if changes.has_changed():
                self.liveness.alert(now)
            self.liveness.check(now)
            self._notify()

    def _ping(self) -> None:
        ping = self.statistics.on_sent(self._now())
        if not self._connection.ours:
            self._connection.ping(lambda: self._on_pong(ping))
        if not self.liveness.should_ask_time():
            return
        op = self._session.call("/rosapi/get_time", b"{}", lambda found: self._on_time(ping, found))
        self._time_questions.append(op.id)
        if len(self._time_questions) > _MAX_TIME_QUESTIONS:
            self._session.calls.forget(self._time_questions.popleft())
        self._send(op)

    def _on_pong(self, ping: Ping) -> None:
        now = self._now()
        self.liveness.on_pong(now)
        if math.isnan(ping.rtt):
            self.statistics.on_answer(ping, now, math.nan)

    def _on_time(self, ping: Ping, answer: ServiceResponse | None) -> None:
        if answer is None:
            return
        time = _time_in(answer)
        self.statistics.on_answer(ping, self._now(), time)
        self.liveness.on_time(not math.isnan(time))
        self._notify()

    def _notify(self) -> None:
        if self.liveness.robot and not self._notified:
            self._notified = True
            self._on_robot()


def _time_in(answer: ServiceResponse) -> float:
    """The operators' clock [s] in an answer; NaN when the robot does not know it."""
    try:
        return from_json(answer.values, GetTimeResponse).time.seconds if answer.result else math.nan
    except ProtocolError:
        return math.nan

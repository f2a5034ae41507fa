"""A robot as an object, for programs that have no event loop of their own.

with RemoteRobot("ws://192.168.1.7:9090") as robot:
    robot.on("/odom", print)
    robot.publish("/cmd_vel", Twist.planar(0.2, 0.0))
"""

from __future__ import annotations

import concurrent.futures
import contextlib
import math
import threading
from collections.abc import Callable
from typing import Any, Self, TypeVar

from bridge.client import BridgeClient, LinkState, Phase
from bridge.errors import BridgeError, NoReply, NotConnected
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandResponse
from bridge.network import NetworkThread
from bridge.topics import topic as entry_of

__all__ = ["RemoteRobot"]

M = TypeVar("M", bound=Msg)


class RemoteRobot:
    """A robot at the other end of a socket; connects by itself and may be used from any thread.

    Callbacks are called in the network thread: they must not block.
    """

    def __init__(self, url: str) -> None:
        """`url` is `ws://HOST:PORT`; returns at once, whether anybody answers there or not."""
        self._connected = threading.Event()
        self._client = BridgeClient(url, on_state=self._note)
        self._network = NetworkThread(f"link to {url}")
        self._network.start(self._client.run())

    @property
    def state(self) -> LinkState:
        """The state of the link."""
        return self._client.state

    def wait(self, timeout: float = 5.0) -> None:
        """Wait until connected; NotConnected after `timeout` [s], with the reason."""
        if not self._connected.wait(timeout):
            raise NotConnected(self.state.sentence)

    def on(
        self, topic: str, callback: Callable[[Any], object], type: type[Msg] | None = None
    ) -> Callable[[], None]:
        """Have `callback(msg)` called for each message on `topic`; gives the unsubscriber.

        `type` is needed for topics that are not in `bridge.topics`; KeyError without.
        """
        wanted = entry_of(topic).type if type is None else type
        stop: list[Callable[[], None]] = []

        def begin() -> None:
            stop.append(self._client.subscribe(topic, wanted, lambda msg, _: callback(msg)))

        def end() -> None:
            while stop:
                stop.pop()()

        def off() -> None:
            self._network.call(end)

        self._network.call(begin)
        return off

    def publish(self, topic: str, msg: Msg) -> None:
        """Send a message at once; without a connection it is dropped, never sent later.

        It carries the moment of this call, so that a robot can tell a drive command that was held up on its way.
        """
        self._network.call(self._publish, topic, msg, self._client.robot_time())

    def _publish(self, topic: str, msg: Msg, stamp: float) -> None:
        self._client.publish(topic, msg, stamp=stamp if math.isfinite(stamp) else None)

    def call(
        self,
        service: str,
        request: Msg | None = None,
        response: type[M] | None = None,
        *,
        timeout: float = 2.0,
    ) -> Msg:
        """Ask for something to be done once and wait for the answer, `timeout` at most [s].

        The answer is a CommandResponse unless `response` says otherwise. Raises Refused, NotConnected or NoReply;
        BridgeError when called from a callback, which must not wait.
        """
        if self._network.inside:
            raise BridgeError(f"{service} cannot be called from a callback; callbacks must not wait.")
        kind: type[Msg] = CommandResponse if response is None else response
        future = self._network.start(self._client.call(service, request, kind, timeout=timeout))
        try:
            return future.result(timeout + 1.0)
        except (concurrent.futures.TimeoutError, concurrent.futures.CancelledError) as error:
            raise NoReply(f"The robot did not answer {service}.") from error

    def close(self) -> None:
        """End the link and its thread; again does nothing."""
        with contextlib.suppress(NotConnected):
            self._network.start(self._client.close()).result()
        self._network.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _note(self, state: LinkState) -> None:
        if state.phase is Phase.CONNECTED:
            self._connected.set()
        else:
            self._connected.clear()

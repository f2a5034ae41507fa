"""A robot as an object, for programs that have no event loop of their own.

with RemoteRobot("ws://192.168.1.7:9090") as robot:
    robot.on("/odom", print)
    robot.publish("/cmd_vel", Twist.planar(0.2, 0.0))
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import contextlib
import math
import threading
from collections.abc import Callable, Coroutine
from typing import Any, Self, TypeVar

from bridge.client import BridgeClient, LinkState, Phase
from bridge.errors import BridgeError, NoReply, NotConnected
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import CommandResponse
from bridge.topics import topic as entry_of

__all__ = ["NetworkThread", "RemoteRobot"]

T = TypeVar("T")
M = TypeVar("M", bound=Msg)


class NetworkThread:
    """A thread with an event loop of its own, running from its making to `close()`."""

    def __init__(self, name: str = "network") -> None:
        self.loop = asyncio.new_event_loop()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def post(self, function: Callable[..., object], *args: Any) -> bool:
        """Have `function(*args)` called in the thread, from any thread; False when it is closed."""
        try:
            self.loop.call_soon_threadsafe(function, *args)
        except RuntimeError:  # the loop is closed
            return False
        return True

    def begin(self, work: Coroutine[Any, Any, T]) -> concurrent.futures.Future[T]:
        """Have a coroutine run in the thread, from any thread; NotConnected when it is closed."""
        try:
            return asyncio.run_coroutine_threadsafe(work, self.loop)
        except RuntimeError as error:
            work.close()
            raise NotConnected("The link is closed.") from error

    @property
    def inside(self) -> bool:
        """Whether the caller is in this thread."""
        return threading.current_thread() is self._thread

    def close(self) -> None:
        """Cancel what runs and end the thread; not from inside it. Again does nothing."""
        self.post(self.loop.stop)
        self._thread.join()

    def _run(self) -> None:
        asyncio.set_event_loop(self.loop)
        try:
            self.loop.run_forever()
        finally:
            left = asyncio.all_tasks(self.loop)
            for task in left:
                task.cancel()
            self.loop.run_until_complete(asyncio.gather(*left, return_exceptions=True))
            self.loop.run_until_complete(self.loop.shutdown_asyncgens())
            self.loop.close()


class RemoteRobot:
    """A robot at the other end of a socket; connects by itself and may be used from any thread.

    Callbacks are called in the network thread: they must not block.
    """

    def __init__(self, url: str) -> None:
        """`url` is `ws://HOST:PORT`; returns at once, whether anybody answers there or not."""
        self._connected = threading.Event()
        self._client = BridgeClient(url, on_state=self._note)
        self._network = NetworkThread(f"link to {url}")
        self._network.begin(self._client.run())

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
            self._network.post(end)

        self._network.post(begin)
        return off

    def publish(self, topic: str, msg: Msg) -> None:
        """Send a message at once; without a connection it is dropped, never sent later.

        It carries the moment of this call, so that a robot can tell a drive command that was held up on its way.
        """
        self._network.post(self._publish, topic, msg, self._client.robot_time())

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
        future = self._network.begin(self._client.call(service, request, kind, timeout=timeout))
        try:
            return future.result(timeout + 1.0)
        except (concurrent.futures.TimeoutError, concurrent.futures.CancelledError) as error:
            raise NoReply(f"The robot did not answer {service}.") from error

    def close(self) -> None:
        """End the link and its thread; again does nothing."""
        with contextlib.suppress(NotConnected):
            self._network.begin(self._client.close()).result()
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

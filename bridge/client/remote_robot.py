"""A robot as an object, for programs that have no event loop of their own.

with RemoteRobot("ws://192.168.1.7:9090") as robot:
    robot.on("/odom", print)
    robot.publish("/cmd_vel", Twist.planar(0.2, 0.0))
"""

from __future__ import annotations

import concurrent.futures
import contextlib
import functools
import threading
from collections.abc import Callable, Coroutine
from typing import Any, Protocol, Self, TypeVar, overload

from bridge.client.client import BridgeClient, LinkState, Phase
from bridge.client.client_goals import Goal, part_of
from bridge.client.credentials import Credentials
from bridge.client.service_provider import Call, Run
from bridge.core.errors import BridgeError, NoReply, NotConnected
from bridge.core.network_thread import NetworkThread
from bridge.core.topics import topic as entry_of
from bridge.msgs import Msg, ros1_name
from bridge.msgs.geometry_msgs import Twist
from bridge.protocol import Reduction

__all__ = ["RemoteGoal", "RemoteRobot"]

M = TypeVar("M", bound=Msg)
T = TypeVar("T")


class _WaitFor(Protocol):
    def __call__(self, work: Coroutine[Any, Any, T], about: str, timeout: float | None) -> T: ...


class RemoteGoal:
    """A goal of an action of a remote robot; may be used from any thread."""

    def __init__(self, goal: Goal[Any], network: NetworkThread, wait_for: _WaitFor) -> None:
        self._goal = goal
        self._network = network
        self._wait_for = wait_for

    @property
    def status(self) -> int:
        """As in action_msgs/GoalStatus: 2 executing, 4 succeeded, 5 canceled, 6 aborted; 0 when it is not known."""
        return self._goal.status

    @property
    def done(self) -> bool:
        """Whether the result is known or will never be known."""
        return self._goal.done

    def cancel(self) -> None:
        """Ask for cancellation; `result` gives the outcome."""
        self._network.call(self._goal.cancel)

    def result(self, timeout: float | None = None) -> Any:
        """Wait for the result, for `timeout` [s] at most; raises as `bridge.client.client_goals.Goal.result` does."""
        return self._wait_for(self._goal.result(timeout), self._goal.action, timeout)


class RemoteRobot:
    """A robot at the other end of a socket; reconnects by itself and may be used from any thread.

    Callbacks are called in the network thread: they must not block.
    """

    def __init__(self, url: str, *, credentials: Credentials | None = None) -> None:
        """`url` is `ws://HOST:PORT`, or `wss://HOST:PORT` for TLS; returns at once, before there is a connection.

        `credentials` are as in `bridge.client.connection.open_connection`.
        """
        self._connected = threading.Event()
        self._published: set[str] = set()
        self._client = BridgeClient(url, on_state=self._note, credentials=credentials)
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
        self,
        topic: str,
        callback: Callable[[Any], object],
        type: type[Msg] | None = None,
        *,
        throttle_rate: int = 0,
        compression: str = "none",
        reduce: Reduction | None = None,
    ) -> Callable[[], None]:
        """Subscribe `topic`: `callback(msg)` is called for each message. Returns the unsubscriber.

        `type` is needed for topics that are not in `bridge.core.topics`, KeyError without; `learn` finds it. The
        other arguments are as in `BridgeClient.subscribe`.
        """
        wanted = entry_of(topic).type if type is None else type
        return self._lasting(
            lambda: self._client.subscribe(
                topic,
                wanted,
                lambda msg, _: callback(msg),
                throttle_rate=throttle_rate,
                compression=compression,
                reduce=reduce,
            )
        )

    def publish(self, topic: str, msg: Msg) -> None:
        """Send a message at once; without a connection it is dropped and never sent later.

        It is stamped with the time of this call, so that a robot notices a drive command that was held up on its way.
        Foreign servers are informed of the topic with its first message, which those of ROS 1 may lose; `advertise`
        is sooner.
        """
        self._network.call(self._publish, topic, msg, self._client.robot_time())

    def _publish(self, topic: str, msg: Msg, stamp: float) -> None:
        if topic not in self._published:
            self._advertise(topic, type(msg), latch=False)
        self._client.publish(topic, msg, stamp=stamp, even_late=msg == Twist())

    def advertise(self, topic: str, type: type[Msg], *, latch: bool = False) -> None:
        """Announce that this program publishes on `topic`; with `latch` later subscribers get the last message at
        once."""
        self._network.call(functools.partial(self._advertise, topic, type, latch=latch))

    def _advertise(self, topic: str, type: type[Msg], *, latch: bool) -> None:
        self._published.add(topic)
        self._client.advertise(topic, type, latch=latch)

    @overload
    def call(self, service: str, request: Msg | None = None, *, timeout: float = 2.0) -> Any: ...

    @overload
    def call(self, service: str, request: Msg | None, response: type[M], *, timeout: float = 2.0) -> M: ...

    def call(
        self,
        service: str,
        request: Msg | None = None,
        response: type[Msg] | None = None,
        *,
        timeout: float = 2.0,
    ) -> Any:
        """Call a service and wait for the response, for `timeout` [s] at most.

        Without the class `response` it is a CommandResponse where the answer says `success`, as those of a Pilothouse robot do,
        and otherwise the answer's values, a dict. Raises Refused, NotConnected or
        NoReply; BridgeError when called from a callback, which must not wait.
        """
        if response is None:
            asked = self._client.call_untyped(service, request, timeout=timeout)
        else:
            asked = self._client.call(service, request, response, timeout=timeout)
        return self._wait_for(asked, service, timeout)

    def learn(self, type_name: str, *, timeout: float = 3.0) -> type[Msg]:
        """The class of a message type by its ROS name; the robot is asked about an unknown one. Raises as `call` does."""
        return self._wait_for(self._client.learn(type_name, timeout=timeout), type_name, timeout)

    def goal(
        self,
        action: str,
        goal: Msg,
        *,
        on_feedback: Callable[[Any], object] | None = None,
        result: type[Msg] | None = None,
        feedback: type[Msg] | None = None,
    ) -> RemoteGoal:
        """Send a goal of an action: `on_feedback(msg)` is called on its way, and `RemoteGoal` gives the result.

        `result` and `feedback` are needed for types that are not in `bridge.msgs.TYPES`. Raises NotConnected;
        ProtocolError without a needed type.
        """

        async def begin() -> Goal[Any]:
            return self._client.goal(action, goal, on_feedback=on_feedback, result=result, feedback=feedback)

        return RemoteGoal(self._wait_for(begin(), action, 2.0), self._network, self._wait_for)

    def serve(self, service: str, type: str, call: Call) -> Callable[[], None]:
        """Answer calls of `service`, of ROS type `type`, from now on; returns a function that ends it.

        `call(request)` returns the response, or an awaitable of it; it is called in the network thread and raises
        Refused to refuse.
        """
        part_of(ros1_name(type), "Request")  # says so here when it is not known
        return self._lasting(lambda: self._client.serve(service, type, call))

    def provide_action(self, action: str, type: str, run: Run) -> Callable[[], None]:
        """Carry out goals of `action`, of ROS type `type`, from now on; returns a function that ends it.

        `run(goal, on_feedback)` is a coroutine function that runs in the network thread, calls
        `on_feedback(feedback)` and returns the result.
        """
        part_of(ros1_name(type), "Goal")  # says so here when it is not known
        return self._lasting(lambda: self._client.provide_action(action, type, run))

    def _lasting(self, begin: Callable[[], Callable[[], None]]) -> Callable[[], None]:
        """Begin something in the network thread; returns a function that ends it there."""
        stop: list[Callable[[], None]] = []

        def end() -> None:
            while stop:
                stop.pop()()

        self._network.call(lambda: stop.append(begin()))
        return lambda: self._network.call(end)

    def _wait_for(self, work: Coroutine[Any, Any, T], about: str, timeout: float | None) -> T:
        if self._network.inside:
            work.close()
            raise BridgeError(f"{about} cannot be called from a callback; callbacks must not wait.")
        future = self._network.start(work)
        try:
            return future.result(None if timeout is None else timeout + 1.0)
        except (concurrent.futures.TimeoutError, concurrent.futures.CancelledError) as error:
            raise NoReply(f"The robot did not answer {about}.") from error

    def close(self) -> None:
        """End the link and its thread; a second call does nothing."""
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

"""The door to a robot, as a gateway meets it: the same for every protocol."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Hashable, Mapping
from typing import Protocol

from bridge.core.robot_catalogue import Action, Operator, Service
from bridge.core.topics import Topic
from bridge.msgs import Msg

__all__ = ["Callback", "RobotDoor"]

Callback = Callable[[str, Msg], None]
"""Takes a topic and its message; returns at once."""


class RobotDoor(Protocol):
    """One robot with its topics, services and actions, and the rules by which clients use them."""

    @property
    def topics(self) -> Mapping[str, Topic]:
        """The robot's own topics by absolute name."""

    @property
    def services(self) -> Mapping[str, Service]:
        """Its services by absolute name."""

    @property
    def actions(self) -> Mapping[str, Action]:
        """Its actions by absolute name."""

    def service(self, name: str) -> Service:
        """The service of that name; raises Refused when there is none."""

    def action(self, name: str) -> Action:
        """The action of that name; raises Refused when there is none."""

    def join(
        self, address: str, *, way: str = "", secure: bool = False, token: str = "", trusted: bool = True
    ) -> Operator:
        """A client came from `address`, `HOST:PORT`; the operator that it is from now on, with an id of its own.

        It came by the gateway `way`, over TLS when `secure`, and showed `token`, empty for none. One that is not `trusted`
        never counts as a program of this machine: a web page may have opened it. Raises Refused for a wrong token.
        """

    def authenticate(self, operator: Operator, token: str) -> None:
        """`operator` shows its token after it has joined; raises Refused for a wrong one."""

    def check(self, operator: Operator, verb: str, name: str) -> None:
        """Raises Refused when the role of `operator` is too small.

        `verb` is one of subscribe, publish, call, run, camera, advertise, page and rosapi; `name` is the topic, service,
        action, camera or page. `publish`, `call` and `run` check this themselves.
        """

    def leave(self, asker: Hashable) -> None:
        """An operator or another asker is gone: end its subscriptions and, if it drove, the driving."""

    def subscribe(
        self, asker: Hashable, topic: str, callback: Callback, *, wanted: bool = True
    ) -> Callable[[], None]:
        """Call back with each message of a topic of the robot, first with the last one if the topic is latched.

        The robot makes the messages while an asker has them `wanted`; with `wanted` False the asker takes only what is
        made for others. Returns the call that ends it. Raises Refused when there is no such topic.
        """

    def check_listens(self, topic: str) -> None:
        """Raises Refused when no message of a client is taken on `topic`."""

    def publish(self, operator: Operator, topic: str, msg: Msg, stamp: float | None) -> str | None:
        """Give a message of `operator` to the robot and to the subscribers of `topic`.

        Returns why the robot does not obey it, as one sentence, where that is known at once; empty or None where nothing
        is against it.

        `stamp` is when the operator meant it [s, operators' clock], None when that is not known. Raises Refused as
        `check_listens` does.
        """

    def is_urgent(self, service: str) -> bool:
        """Calls of `service` are always taken and their answers go before everything else: STOP and control."""

    def call(
        self, operator: Operator, service: str, request: Msg, timeout: float | None = None
    ) -> Msg | Awaitable[Msg]:
        """Have a service done; its answer, at once where it can be had at once.

        Not answered within `timeout` [s] it raises Refused, None and 0 wait for as long as it takes. Raises Refused with
        the sentence for the caller, now or when awaited.
        """

    async def run(
        self, operator: Operator, action: str, goal: Msg, on_feedback: Callable[[Msg], None]
    ) -> Msg:
        """Carry a goal out and give its result; cancelled, the goal is taken back. Raises Refused."""

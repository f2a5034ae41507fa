"""A robot that is not ours, on a server that is not ours, for tests that are no coroutines."""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from bridge.core.network_thread import NetworkThread
from tests.bridge.client.foreign_server import ForeignServer
from tests.bridge.foreign_robot import ForeignRobot

__all__ = ["Strange", "strange_robot"]


class Strange:
    """The server in a thread of its own, and the robot behind it."""

    def __init__(self, network: NetworkThread, server: ForeignServer) -> None:
        self._network, self._server = network, server
        self._awake = threading.Event()

    @property
    def url(self) -> str:
        return f"ws://127.0.0.1:{self._server.port}"

    @property
    def robot(self) -> ForeignRobot:
        return self._server.robot

    def operations(self, kind: str) -> list[dict[str, object]]:
        """What clients that are connected now have asked for with operation `kind`, oldest first."""
        return [op for peer in list(self._server.peers) for op in list(peer.heard) if op.get("op") == kind]

    def listened(self) -> set[str]:
        """Topics that somebody subscribes to."""
        return {name for peer in list(self._server.peers) for name in list(peer.wishes)}

    @property
    def clients(self) -> int:
        """How many are connected."""
        return len(self._server.peers)

    def withhold(self, *services: str) -> None:
        """Have no longer these services of rosapi; none at all without names."""
        for name in services or tuple(self._server.rosapi.asked):
            del self._server.rosapi.asked[name]

    def faint(self) -> None:
        """Neither read nor do anything until `wake`, with every connection open, as a process that hangs."""
        self._awake.clear()
        self._network.call(self._awake.wait)

    def wake(self) -> None:
        """Go on, beginning with what waits in the sockets."""
        self._awake.set()

    def drive_by(self, name: str, kind: str) -> None:
        """Have the robot take its commands on `name` and no longer on `/cmd_vel`, as Twist or TwistStamped."""
        del self._server.topics[self._server.command]
        self._server.command = name
        self._server.topic(name, kind)

    def take(self, name: str, kind: str = "std_msgs/Bool") -> list[dict[str, Any]]:
        """Have the robot listen to a topic beside its command; what it hears there, oldest first."""
        self._server.topic(name, kind)
        return self._server.taken.setdefault(name, [])

    def vanish(self) -> None:
        """Break every connection, and take no other: whoever connects is refused."""
        self._network.start(self._server.close()).result(5)

    def cut(self) -> None:
        """Break every connection; whoever connects again is served."""

        def abort() -> None:
            for peer in list(self._server.peers):
                peer.ws.transport.abort()

        self._network.call(abort)


@contextmanager
def strange_robot(ros: int = 1) -> Iterator[Strange]:
    """Serves with the manners of ROS 1 or 2 until the end of the block."""
    logging.getLogger("websockets.server").setLevel(logging.WARNING)  # Kivy logs every byte otherwise
    network = NetworkThread("strange robot")
    server = ForeignServer(ros)
    made = Strange(network, server)
    try:
        network.start(server.start()).result(5)
        yield made
    finally:
        made.wake()
        network.start(server.close()).result(5)
        network.close()

"""A robot that is not ours, on a server that is not ours, for tests that are no coroutines."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from bridge.network import NetworkThread
from tests.bridge.foreign_robot import ForeignRobot
from tests.bridge.foreign_server import ForeignServer

__all__ = ["Strange", "strange_robot"]


class Strange:
    """The server in a thread of its own, and the robot behind it."""

    def __init__(self, network: NetworkThread, server: ForeignServer) -> None:
        self._network, self._server = network, server

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

    def rename(self, old: str, new: str) -> None:
        """Offer a topic under another name, to clients that come later."""

        def change() -> None:
            self._server.topics[new] = self._server.topics.pop(old)

        self._network.call(change)


@contextmanager
def strange_robot(ros: int = 1) -> Iterator[Strange]:
    """Serves with the manners of ROS 1 or 2 until the end of the block."""
    network = NetworkThread("strange robot")
    server = ForeignServer(ros)
    try:
        network.start(server.start()).result(5)
        yield Strange(network, server)
    finally:
        network.start(server.close()).result(5)
        network.close()

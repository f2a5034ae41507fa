"""One robot that is served by every protocol at once."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from examples.demo.robot import RobotProcess
from tests.robotside.gateways.kafka.cluster import Cluster
from tests.robotside.gateways.mqtt.broker import Broker

__all__ = ["Everywhere", "everywhere"]


class Everywhere:
    """The robot's process, and the way to it by each protocol."""

    def __init__(self, process: RobotProcess, ways: dict[str, str]) -> None:
        self.process = process
        self.ways = ways
        """By the protocol's name, as for `examples.protocols.ways.way_to`."""


@contextmanager
def everywhere(folder: Path, *options: str) -> Iterator[Everywhere]:
    """A robot called Rex, served with `options`, by which everybody may drive."""
    broker, cluster = Broker(folder), Cluster()
    port, datagrams = _free_port(), _free_port(socket.SOCK_DGRAM)
    gateways = (
        f"mqtt={broker.url}?role=drive",
        f"websocket=ws://127.0.0.1:{port}?role=drive",
        "soap=?role=drive",
        f"coap=coap://127.0.0.1:{datagrams}?role=drive",
        "rest=?role=drive",
        f"kafka=kafka://{cluster.address}?role=drive",
    )
    brought = [each for gateway in gateways for each in ("--gateway", gateway)]
    try:
        with RobotProcess(
            *options, *brought, "--name", "Rex", "--state", str(folder / "state"), log=folder / "robot.log"
        ) as process:
            yield Everywhere(
                process,
                {
                    "rosbridge": process.url,
                    "mqtt": f"{broker.url}/pilothouse/Rex",
                    "websocket": f"websocket=ws://127.0.0.1:{port}",
                    "coap": f"coap://127.0.0.1:{datagrams}",
                    "rest": f"rest={process.web}/api",
                    "kafka": f"kafka://{cluster.address}/pilothouse.Rex",
                    "soap": f"soap={process.web}/soap",
                },
            )
    finally:
        cluster.close()
        broker.kill()


def _free_port(kind: socket.SocketKind = socket.SOCK_STREAM) -> int:
    with socket.socket(socket.AF_INET, kind) as taken:
        taken.bind(("127.0.0.1", 0))
        port: int = taken.getsockname()[1]
        return port

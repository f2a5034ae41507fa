"""A broker of the robot's own, for development on this machine: the mock cluster that librdkafka has for tests.

It lives in this process, keeps all in memory, and is gone with the robot. It picks its port itself.
"""

from __future__ import annotations

import asyncio
from importlib.util import find_spec
from typing import Any

from bridge.core.errors import BridgeError
from robotside.gateways.addresses import is_here

__all__ = ["OwnCluster"]

START_TIMEOUT = 10.0
"""For it to listen [s]."""


class OwnCluster:
    """A cluster of one broker; owns its threads."""

    host = "127.0.0.1"
    """Where it listens."""

    def __init__(self, host: str, port: int) -> None:
        """Raises BridgeError for an address that others reach, since it knows no keys, and for a port of one's own choice."""
        if not is_here(host):
            raise BridgeError(
                f"A Kafka cluster of the robot's own listens on this machine only, not on {host}; give the URL of one."
            )
        if port:
            raise BridgeError(
                f"A Kafka cluster of the robot's own picks its port itself, so {port} cannot be had: "
                f"kafka=kafka://{host}:{port} goes to a broker that is there."
            )
        self.port = 0
        """Where it listens, once started."""
        self._cluster: Any = None

    async def start(self) -> None:
        """Begin to listen. BridgeError with one sentence when that is not possible."""
        if find_spec("confluent_kafka") is None:
            raise BridgeError(
                "There is no Kafka cluster on this machine: install confluent-kafka, or give the URL of a broker."
            )
        self.port = await asyncio.to_thread(self._begin)

    async def stop(self) -> None:
        """End it; its port is free afterwards. Allowed before `start` too."""
        self._cluster = None

    def _begin(self) -> int:
        from confluent_kafka import KafkaException, Producer

        # "log_level" 2: that no servers are named is not worth a line
        self._cluster = Producer({"test.mock.num.brokers": 1, "log_level": 2})
        try:
            (broker,) = self._cluster.list_topics(timeout=START_TIMEOUT).brokers.values()
        except (KafkaException, ValueError) as error:
            self._cluster = None
            raise BridgeError(f"The robot's own Kafka cluster does not start: {error}.") from error
        return int(broker.port)

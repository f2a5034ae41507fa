"""rosbridge: JSON over the robot's WebSocket, `ws://HOST:9090`."""

from __future__ import annotations

import json
from contextlib import ExitStack

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from examples.protocols.ways import ANSWER_TIMEOUT, Answer, Way

__all__ = ["OWN_FAULTS", "open_way"]

OWN_FAULTS = (WebSocketException,)
"""What its library raises, beside what all raise."""


class _Rosbridge:
    def __init__(self, url: str) -> None:
        self._undo = ExitStack()
        self._socket = self._undo.enter_context(connect(url, max_size=None))

    def call(self, service: str, request: Answer) -> Answer:
        """As of `Way`; the robot is heard only while an answer is waited for."""
        asked = {"op": "call_service", "id": request["command_id"], "service": service, "args": request}
        self._socket.send(json.dumps(asked))
        while True:
            told = json.loads(self._socket.recv(timeout=ANSWER_TIMEOUT))
            if told.get("op") == "service_response" and told.get("id") == request["command_id"]:
                values = told["values"]
                return values if told["result"] else {"success": False, "message": str(values), "code": ""}

    def publish(self, topic: str, message: Answer) -> None:
        """As of `Way`."""
        self._socket.send(json.dumps({"op": "publish", "topic": topic, "msg": message}))

    def close(self) -> None:
        """End the connection."""
        self._undo.close()


def open_way(url: str, _: str) -> Way:
    """A connection to the robot."""
    return _Rosbridge(url)

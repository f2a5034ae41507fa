"""Plain JSON over the WebSocket gateway, `websocket=ws://HOST:9190`."""

from __future__ import annotations

import itertools
import json
from contextlib import ExitStack

from websockets.exceptions import WebSocketException
from websockets.sync.client import connect

from examples.protocols.ways import ANSWER_TIMEOUT, Answer, Way

__all__ = ["OWN_FAULTS", "open_way"]

OWN_FAULTS = (WebSocketException,)
"""What its library raises, beside what all raise."""


class _WebSocket:
    def __init__(self, url: str) -> None:
        self._undo = ExitStack()
        self._socket = self._undo.enter_context(connect(url, max_size=None))
        self._numbers = itertools.count(1)

    def call(self, service: str, request: Answer) -> Answer:
        """As of `Way`; the robot is heard only while an answer is waited for."""
        number = next(self._numbers)
        self._socket.send(json.dumps({"call": service, "request": request, "id": number}))
        while True:
            told = json.loads(self._socket.recv(timeout=ANSWER_TIMEOUT))
            if told.get("id") == number:
                answer: Answer = told.get("response", told)  # a refusal is an answer of its own
                return answer

    def publish(self, topic: str, message: Answer) -> None:
        """As of `Way`."""
        self._socket.send(json.dumps({"publish": topic, "message": message}))

    def close(self) -> None:
        """End the connection."""
        self._undo.close()


def open_way(url: str, _: str) -> Way:
    """A connection to the gateway."""
    return _WebSocket(url)

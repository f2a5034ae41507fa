"""REST at the robot's web site, `rest=http://HOST:8080/api`."""

from __future__ import annotations

import json
from contextlib import closing
from http.client import HTTPConnection, HTTPException, HTTPSConnection
from urllib.parse import urlsplit

from examples.protocols.ways import ANSWER_TIMEOUT, Answer, Way

__all__ = ["OWN_FAULTS", "open_way"]

OWN_FAULTS = (HTTPException,)
"""What its library raises, beside what all raise."""


class _Rest:
    def __init__(self, url: str, client: str) -> None:
        place = urlsplit(url)
        self._kind = HTTPSConnection if place.scheme == "https" else HTTPConnection
        self._place, self._path = place.netloc, place.path.rstrip("/")
        self._id = client

    def call(self, service: str, request: Answer) -> Answer:
        """As of `Way`."""
        return self._post(f"/services{service}", request)

    def publish(self, topic: str, message: Answer) -> None:
        """As of `Way`."""
        self._post(f"/topics{topic}", message)

    def _post(self, path: str, body: Answer) -> Answer:
        """The answer; a refusal has a status of its own, and is an answer like any other."""
        headers = {"Content-Type": "application/json", "Client-Id": self._id}
        with closing(self._kind(self._place, timeout=ANSWER_TIMEOUT)) as robot:
            robot.request("POST", self._path + path, json.dumps(body), headers)
            answer: Answer = json.loads(robot.getresponse().read())
        return answer

    def close(self) -> None:
        """Give back control, which the robot would keep for who comes again."""
        self._post("/services/control/release", {})


def open_way(url: str, client: str) -> Way:
    """The robot's web site."""
    return _Rest(url, client)

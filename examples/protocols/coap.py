"""CoAP: requests by UDP, `coap://HOST:5683`; each is stamped by this machine's clock, which the robot's has to agree with."""

from __future__ import annotations

import asyncio
import json
import time

from aiocoap import POST, Context, Message
from aiocoap.error import Error
from aiocoap.numbers import ContentFormat

from examples.protocols.ways import ANSWER_TIMEOUT, Answer, Way

__all__ = ["OWN_FAULTS", "open_way"]

OWN_FAULTS = (Error,)
"""What its library raises, beside what all raise."""


class _Coap:
    def __init__(self, url: str, client: str) -> None:
        self._url, self._client = url.rstrip("/"), client[:12]
        self._runner = asyncio.Runner()
        self._context: Context = self._runner.run(Context.create_client_context())

    def call(self, service: str, request: Answer) -> Answer:
        """As of `Way`."""
        return self._runner.run(self._send(service, request))

    def publish(self, topic: str, message: Answer) -> None:
        """As of `Way`."""
        self._runner.run(self._send(topic, message))

    async def _send(self, path: str, body: Answer) -> Answer:
        """The answer; a refusal has a code of its own, and is an answer like any other."""
        uri = f"{self._url}{path}?client={self._client}&stamp={time.time():.3f}"
        asked = Message(code=POST, uri=uri, payload=json.dumps(body).encode(), accept=ContentFormat.JSON)
        asked.opt.content_format = ContentFormat.JSON
        async with asyncio.timeout(ANSWER_TIMEOUT):
            told = await self._context.request(asked).response
        answer: Answer = json.loads(told.payload or b"{}")
        return answer

    def close(self) -> None:
        """Say goodbye, so that a robot that was driven from here rests, and end the socket."""
        self._runner.run(self._send("/bye", {}))
        self._runner.run(self._context.shutdown())
        self._runner.close()


def open_way(url: str, client: str) -> Way:
    """A socket to the robot."""
    return _Coap(url, client)

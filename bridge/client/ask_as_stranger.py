"""One question to a robot without a key, over a connection of its own, for what a robot lets everybody do."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from dataclasses import replace
from typing import Any, TypeVar

from bridge.client.client import BridgeClient, LinkState, Phase
from bridge.client.credentials import Credentials
from bridge.core.errors import NoReply, NotConnected
from bridge.core.link_state import LinkFault
from bridge.msgs import Msg

__all__ = ["ask_as_stranger", "even_as_stranger"]

M = TypeVar("M", bound=Msg)

CONNECT_TIMEOUT = 3.0
"""Longest time until the robot answers on the connection [s]."""


async def ask_as_stranger(
    url: str, robot: Credentials, service: str, request: Msg, response: type[M], *, timeout: float
) -> M:
    """What the robot answers whose key `robot` names, and no other one; its token is not shown.

    `timeout` [s] is for the answer. Raises what `BridgeClient.call` does; NoReply when no connection comes about.
    """
    arrived = asyncio.Event()

    def note(state: LinkState) -> None:
        if state.phase is Phase.CONNECTED:
            arrived.set()

    client = BridgeClient(url, on_state=note, credentials=replace(robot, token=""))
    running = asyncio.create_task(client.run())
    try:
        try:
            async with asyncio.timeout(CONNECT_TIMEOUT):
                await arrived.wait()
        except TimeoutError as error:
            raise NoReply(client.state.sentence) from error
        return await client.call(service, request, response, timeout=timeout)
    finally:
        await client.close()
        await running


def even_as_stranger(
    client: BridgeClient, robot: Credentials | None, free: str
) -> Callable[..., Coroutine[Any, Any, Any]]:
    """`client.call`; but the service `free` is asked for without a key where the robot does not accept that of `robot` any more."""

    async def call(service: str, request: Msg, response: type[Msg], *, timeout: float = 2.0) -> Msg:
        try:
            return await client.call(service, request, response, timeout=timeout)
        except NotConnected:
            if service != free or robot is None or client.state.fault is not LinkFault.NOT_ACCEPTED:
                raise
        return await ask_as_stranger(client.url, robot, service, request, response, timeout=timeout)

    return call

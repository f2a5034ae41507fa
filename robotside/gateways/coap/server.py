"""aiocoap's layers of tokens and messages on our socket, with a task of ours for each request."""

from __future__ import annotations

import asyncio
import logging
import socket
from collections.abc import Awaitable, Callable
from typing import Any

from aiocoap.messagemanager import MessageManager
from aiocoap.tokenmanager import TokenManager

from bridge.core.async_tasks import cancel_all
from robotside.gateways.coap.datagrams import DatagramSocket
from robotside.gateways.coap.flood_guard import FloodGuard

__all__ = ["CoapServer"]


class CoapServer:
    """What aiocoap calls a context; it answers and asks nothing."""

    client_credentials = None

    def __init__(
        self, answer: Callable[[Any], Awaitable[None]], sock: socket.socket, guard: FloodGuard
    ) -> None:
        """`answer(pipe)` answers a request, in a task of its own that is cancelled when the client does not want it any more.

        `sock` is bound and does not block; it is closed by `close`.
        """
        self.loop = asyncio.get_running_loop()
        self.log = logging.getLogger(f"{__name__}.aiocoap")
        self.log.setLevel(logging.CRITICAL)  # most of what it says is what strangers did
        self._answer = answer
        self._tasks: set[asyncio.Future[None]] = set()
        self._tokens = TokenManager(self)
        manager = MessageManager(self._tokens)
        self.socket = DatagramSocket(sock, manager, guard)
        manager.message_interface = self.socket
        self._tokens.token_interface = manager

    def render_to_pipe(self, pipe: Any) -> None:
        """A request came."""
        task = asyncio.ensure_future(self._answer(pipe))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)
        pipe.on_interest_end(task.cancel)

    async def close(self) -> None:
        """Close the socket and end all requests."""
        await self._tokens.shutdown()
        await cancel_all(self._tasks)

"""The CoAP gateway of one robot."""

from __future__ import annotations

import asyncio
import errno
import ipaddress
import socket
from collections.abc import Mapping

from bridge.core.address import at_port
from bridge.core.async_tasks import cancel_all
from bridge.core.codes import Code
from bridge.core.errors import BridgeError
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.server.reception.log_limit import STRANGERS
from robotside.core.notice import Notice
from robotside.gateways.adapter import Surroundings
from robotside.gateways.coap.flood_guard import FloodGuard
from robotside.gateways.coap.guide import guide, links
from robotside.gateways.coap.requests import LINKS, TEXT, Body
from robotside.gateways.coap.server import CoapServer
from robotside.gateways.coap.site import CORE, CoapSite
from robotside.gateways.gateway_url import GatewayUrl
from robotside.gateways.payloads.offered import offered
from robotside.gateways.plain.visitors import Visitors

__all__ = ["CoapGateway"]

_CHECK_PERIOD = 1.0
"""Between two looks for clients that are silent [s]."""
_BUFFER_BYTES = 1_048_576
"""Of the kernel, for what comes while the robot does something else."""


class CoapGateway:
    """An `AdapterGateway`: `coap://HOST:PORT/NAME` for each topic and service."""

    def __init__(self, robot: Surroundings, url: GatewayUrl) -> None:
        """Who shows no token has the role of the `url`; without one its address decides."""
        self._robot, self._door, self._url = robot, robot.door, url
        self._port = url.port
        self._clients = Visitors(
            robot.door, "coap", url.address, url.keys, role=url.role, secure=False, hosts=True
        )
        self._site: CoapSite | None = None
        self._server: CoapServer | None = None
        self._tasks: set[asyncio.Task[None]] = set()

    async def start(self) -> None:
        """Begin to listen. BridgeError with one sentence when that is not possible."""
        sock = _bound(self._url.host, self._url.port)
        self._port = sock.getsockname()[1]
        guard = FloodGuard(asyncio.get_running_loop().time())
        site = self._site = CoapSite(
            self._door,
            self._clients,
            self._url.keys,
            self._url.rate,
            plain_from=self._robot.plain_from,
            pages=self._page,
            turns=self._robot.turns,
        )
        self._server = CoapServer(site.answer, sock, guard)
        site.observers.socket = self._server.socket
        role = self._url.role
        if role is not None and role > Role.WATCH:
            said = f"Everybody who reaches the CoAP gateway may {role.word} without a key."
            self._robot.say(
                "control", Notice(Code.GATEWAY_OPEN, said, gateway="coap", role=role.word), "warn"
            )
        self._tasks.add(asyncio.create_task(self._look_after_clients()))

    async def stop(self) -> None:
        """End all observations and stop listening; nothing is left running."""
        await cancel_all(self._tasks)
        self._tasks.clear()
        try:
            self._clients.leave_all()  # first of all: a robot that one of them drives stops
            if self._site is not None:
                self._site.close()
        finally:
            server, self._server = self._server, None
            if server is not None:
                await server.close()

    def endpoints(self) -> Mapping[str, str]:
        """The URL that all names come behind."""
        return {"coap": f"coap://{at_port(self._url.host, self._port)}"}

    def guide(self) -> str:
        """How a program of this machine uses it now."""
        audience = self._door.join("127.0.0.1:0", way="coap", role=self._url.role)
        try:
            return self._guide_for(audience)
        finally:
            self._door.leave(audience)

    def _guide_for(self, operator: Operator) -> str:
        role = operator.role(self._door.now())
        return guide(self.endpoints()["coap"], offered(self._door, self._url.keys), role)

    def _page(self, path: str, operator: Operator) -> Body:
        if path == CORE:
            found = links(offered(self._door, self._url.keys), operator.role(self._door.now()))
            return Body(found.encode(), LINKS)
        return Body(self._guide_for(operator).encode(), TEXT)

    async def _look_after_clients(self) -> None:
        while True:
            await asyncio.sleep(_CHECK_PERIOD)
            self._clients.leave_silent()
            STRANGERS.flush()
            if self._server is not None:
                self._server.socket.sweep()


def _bound(host: str, port: int) -> socket.socket:
    """A UDP socket at one address of this machine, by which it answers too. BridgeError when that cannot be."""
    try:
        family, _, _, _, where = socket.getaddrinfo(host, port, type=socket.SOCK_DGRAM)[0]
        everywhere = ipaddress.ip_address(where[0]).is_unspecified
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        raise BridgeError(f"CoAP cannot listen at {host[:100]}: {why}.") from error
    if everywhere:
        said = f"CoAP listens at one address of this machine, as coap://192.168.1.7:{port}, not at {host}."
        raise BridgeError(said)
    sock = socket.socket(family, socket.SOCK_DGRAM)
    try:
        sock.setblocking(False)
        sock.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _BUFFER_BYTES)
        sock.bind(where)
    except OSError as error:
        sock.close()
        raise BridgeError(_cannot_listen(host, port, error)) from error
    return sock


def _cannot_listen(host: str, port: int, error: OSError) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"Port {port} on {host} is taken by another program; stop that one or choose another port."
    return f"CoAP cannot listen on {at_port(host, port)} ({error.strerror or error})."

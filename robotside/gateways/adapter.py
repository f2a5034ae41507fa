"""The form of an adapter: a gateway that a user asks for by name, and what it is given of its robot."""

from __future__ import annotations

import ssl
from collections.abc import Callable, Mapping, MutableMapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

from bridge.core.errors import BridgeError
from bridge.core.identity import Role
from bridge.server.reception.pages import PagePolicy
from robotside.door.station_door import StationDoor
from robotside.gateways.gateway import Gateway
from robotside.gateways.plain.turns import Turns
from robotside.gateways.usage_sheet.pasted import PLAIN, RobotKey
from robotside.records.events import Say

if TYPE_CHECKING:  # a robot that nobody asked a gateway of does not load it
    from robotside.gateways.gateway_url import GatewayUrl

__all__ = ["Adapter", "AdapterGateway", "Site", "Surroundings"]


class AdapterGateway(Gateway, Protocol):
    """A gateway that tells how it is used."""

    def guide(self) -> str:
        """How a client uses it now, with examples that can be pasted; known once started."""


class Site(Protocol):
    """As much of the robot's web site, `robotside.gateways.http.mounts.Mounts`, as adapters need."""

    def mount(
        self,
        path: str,
        app: Callable[..., Any],
        *,
        way: str,
        role: Role | None = ...,
        presses_stop: Callable[[MutableMapping[str, Any]], bool] = ...,
        written: Callable[[MutableMapping[str, Any], int, BridgeError], Any] = ...,
    ) -> Callable[[], None]:
        """Have the ASGI application `app` answer at `path` and below it; the call that ends it. BridgeError when it is taken."""

    def url(self, path: str) -> str:
        """The URL of a path of the site."""


@dataclass(frozen=True, slots=True)
class Surroundings:
    """What a gateway is given of its robot."""

    door: StationDoor
    say: Say
    """Writes an event."""
    tls: ssl.SSLContext | None = None
    """With which clients may come encrypted to a socket that listens."""
    plain_from: Callable[[str], bool] = lambda _: True
    """Whether a client from a host may come without TLS."""
    pages: PagePolicy | None = None
    """The web pages that may connect; None for none."""
    key: RobotKey = PLAIN
    """By what clients know it behind TLS."""
    site: Site | None = None
    """The robot's web site, for what is served there; None where it has none."""
    turns: Turns = field(default_factory=Turns)
    """In which requests begin, but for STOP, which waits for none."""


@dataclass(frozen=True, slots=True)
class Adapter:
    """One protocol that a user can ask for."""

    name: str
    """As the user writes it; the name of its folder."""
    doc: str
    """What it is, in a few words."""
    schemes: Mapping[str, int]
    """The schemes of its URLs, with the port of each where none is given."""
    default: str
    """The URL that counts where the user gives none."""
    package: str
    """The library that must be installed, empty for none."""
    make: Callable[[Surroundings, GatewayUrl], AdapterGateway]
    """Makes the gateway, which imports its library."""
    listens: frozenset[str] = frozenset()
    """The schemes by which it listens at its URL; by others it goes there, to a broker."""
    credentials: frozenset[str] = frozenset()
    """The schemes whose URLs may have a user and a password, which something asks for."""
    prefixes: frozenset[str] = frozenset()
    """The schemes whose URLs may have a path, the beginning of its names."""

"""A SOAP gateway on the web site of a station in virtual time, without sockets, and clients that speak to it by hand."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass
from xml.sax.saxutils import escape

import httpx
from lxml import etree

from bridge.core.errors import Refused
from bridge.core.identity import STRANGER, Identity, Role
from bridge.msgs.pilothouse_msgs import Place, SetPlaceRequest
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Surroundings
from robotside.gateways.discovery import read_wish
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from robotside.gateways.soap.fields import NS, SOAP
from robotside.gateways.soap.gateway import SoapGateway
from robotside.trust.permissions import needed_role
from tests.robotside.scene import Scene

__all__ = ["ACTION", "KEYS", "ROBOT", "TYPE", "Answer", "Gate", "Served", "body", "message", "serving"]

TYPE = "text/xml; charset=utf-8"
ACTION = f"{NS}#"
KEYS = {"watch": Role.WATCH, "drive": Role.DRIVE}
ROBOT = "http://192.0.2.1:8080"
PLACES = [Place(name="Office 12", x=3.0, y=0.0), Place(name="Lab", x=3.0, y=3.0)]


class Gate:
    """Knows two people; everybody else is a stranger."""

    def admit(self, address: str, *, trusted: bool) -> Identity:
        return STRANGER

    def identify(self, token: str, address: str, client: str = "") -> Identity:
        if token not in KEYS:
            raise Refused("This key is not known here.")
        return Identity(f"id-{token}", token.capitalize(), KEYS[token], proven=True)

    def needed(self, verb: str, name: str) -> Role:
        return needed_role(verb, name)


@dataclass(frozen=True)
class Answer:
    """What came back."""

    status: int
    text: str

    @property
    def top(self) -> etree._Element:
        return etree.fromstring(self.text.encode())[0][0]

    @property
    def fault(self) -> tuple[str, str, str]:
        """Whose fault, the sentence, and the code."""
        assert self.top.tag == f"{{{SOAP}}}Fault", self.text
        return (
            self.top.findtext("faultcode").partition(":")[2],
            self.top.findtext("faultstring"),
            self.top.findtext(f".//{{{NS}}}code"),
        )

    def value(self, field: str) -> str | None:
        """The first field of that name."""
        assert self.top.tag != f"{{{SOAP}}}Fault", self.text
        return self.top.findtext(f".//{{{NS}}}{field}")


def body(operation: str, **fields: object) -> str:
    """The element of an operation; a list is several of one name."""
    pairs = [
        (name, each)
        for name, value in fields.items()
        for each in (value if isinstance(value, list) else [value])
    ]
    inner = "".join(f"<{name}>{escape(str(value))}</{name}>" for name, value in pairs)
    return f'<{operation} xmlns="{NS}">{inner}</{operation}>'


def message(content: str, **caller: object) -> str:
    """An envelope round a body, with a header that says who calls."""
    header = f"<s:Header>{body('Caller', **caller)}</s:Header>" if caller else ""
    return f'<s:Envelope xmlns:s="{SOAP}">{header}<s:Body>{content}</s:Body></s:Envelope>'


class Served:
    """A gateway that answers."""

    def __init__(self, scene: Scene, door: StationDoor, http: HttpGateway, gateway: SoapGateway) -> None:
        self.scene, self.door, self.http, self.gateway = scene, door, http, gateway
        self.others: list[httpx.AsyncClient] = []

    async def ask(
        self,
        operation: str,
        caller: dict[str, object] | None = None,
        /,
        token: str = "drive",
        **fields: object,
    ) -> Answer:
        """Call an operation as its schema has it."""
        return await self.post(
            message(body(operation, **fields), **(caller or {})), token=token, action=operation
        )

    async def post(
        self,
        raw: str | bytes | AsyncIterator[bytes],
        *,
        token: str = "drive",
        action: str = "",
        kind: str = TYPE,
        host: str = "192.0.2.7",
        path: str = "/soap",
        **headers: str,
    ) -> Answer:
        """Send anything."""
        said = {"Content-Type": kind} | ({"Authorization": f"Bearer {token}"} if token else {}) | headers
        if action:
            said["SOAPAction"] = f'"{ACTION}{action}"'
        async with self.client(host) as web:
            told = await web.post(path, content=raw, headers=said)
        return Answer(told.status_code, told.text)

    def client(self, host: str = "192.0.2.7") -> httpx.AsyncClient:
        way = httpx.ASGITransport(self.http.site, client=(host, 5000))
        return httpx.AsyncClient(transport=way, base_url=ROBOT)

    @property
    def stopped(self) -> bool:
        return self.scene.station.controls.stopped


@asynccontextmanager
async def serving(scene: Scene, wish: str = "soap", gate: Gate | None = None) -> AsyncIterator[Served]:
    """The gateway of a scene that knows two places."""
    for place in PLACES:
        scene.ask("/places/set", SetPlaceRequest(place=place))
    door, pictures = StationDoor(scene.station, gate or Gate()), PictureScaler()
    http = HttpGateway(door, "127.0.0.1", 0, pictures, lambda: "")
    adapter, url = read_wish(wish)
    gateway = adapter.make(Surroundings(door, scene.station.events.say, site=http.mounts), url)
    assert isinstance(gateway, SoapGateway)
    await gateway.start()
    try:
        yield Served(scene, door, http, gateway)
    finally:
        await gateway.stop()
        await pictures.close()
        door.close()

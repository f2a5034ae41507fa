"""The web site's usage sheet, and what a stranger sees in its place."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from starlette.requests import Request
from starlette.responses import HTMLResponse, PlainTextResponse, Response

from bridge.core.address import at_port
from bridge.core.identity import Role
from bridge.trust.robot_link import RobotLink
from robotside.door.station_door import StationDoor
from robotside.gateways.addresses import is_here
from robotside.gateways.http.asker import is_known, operator_of
from robotside.gateways.http.camera_pages import cameras_part, cameras_text
from robotside.gateways.http.camera_streams import CameraStreams
from robotside.gateways.http.pairing_part import pairing_part
from robotside.gateways.usage_sheet.running import Running
from robotside.trust.pairing import Pairing
from robotside.trust.qr import as_svg

if TYPE_CHECKING:  # when somebody looks at the page
    from robotside.gateways.usage_sheet.sheet import Sheet

__all__ = ["NOTHING_BESIDE", "Usage", "UsagePages", "strangers"]

_PRIVATE = {
    "Cache-Control": "no-store",
    "X-Frame-Options": "DENY",
    "Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'; img-src 'self'; form-action 'self'; "
    "base-uri 'none'; frame-ancestors 'none'",
    "Referrer-Policy": "same-origin",
}
"""Pages are neither kept nor shown inside pages of others, run no script, and take nothing from elsewhere.

With no referrer at all browsers would send their STOP as from the origin null, that of pages of nobody.
"""


def _nothing() -> Sequence[Running]:
    return ()


@dataclass(frozen=True, slots=True)
class Usage:
    """What the sheet says beside what the door knows."""

    running: Callable[[], Sequence[Running]] = _nothing
    """The gateways that are up beside rosbridge and the web site."""
    pin: str = ""
    """Hash of the robot's public key, for curl; empty without TLS."""


NOTHING_BESIDE = Usage()
"""No gateway beside rosbridge and the web site, and no TLS."""


class UsagePages:
    """The answers to `/` and `/usage.txt`."""

    def __init__(
        self,
        door: StationDoor,
        bridge_url: Callable[[], str],
        streams: CameraStreams,
        pairing: Pairing | None,
        usage: Usage,
    ) -> None:
        self._door, self._bridge_url, self._streams = door, bridge_url, streams
        self._pairing, self._usage = pairing, usage

    async def page(self, request: Request) -> Response:
        """The sheet as a page; a stranger sees who the robot is."""
        if not is_known(self._door, request):
            return strangers(self._door, "Show the token that you were given to see more.")
        from robotside.gateways.usage_sheet.rendering import Parts, as_page

        manages = operator_of(request).role(self._door.now()) >= Role.MANAGE
        sheet = self._sheet(request)
        link = self._link()
        parts = Parts(
            self._bridge_url(),
            link=link,
            qr=as_svg(link) if link else "",
            offer=pairing_part(self._pairing) if manages else "",
            pairs=manages and self._pairing is not None,
            cameras=cameras_part(self._door, sheet.bridge, self._streams.delays),
        )
        return HTMLResponse(as_page(sheet, parts), headers=_PRIVATE)

    async def text(self, request: Request) -> Response:
        """The sheet as text; the doorkeeper has sent strangers away."""
        from robotside.gateways.usage_sheet.rendering import as_text

        site = _site(request)
        cameras = cameras_text(self._door, site, self._bridge_url(), self._streams.delays)
        text = as_text(self._sheet(request), cameras)
        return PlainTextResponse(text, headers={"Cache-Control": "no-store"})

    def _sheet(self, request: Request) -> Sheet:
        from robotside.gateways.usage_sheet.sheet import make_sheet

        running = self._usage.running()
        return make_sheet(self._door, self._bridge_url(), _site(request), running, self._usage.pin)

    def _link(self) -> str:
        """What brings the app here; empty where no other machine can come."""
        url = self._bridge_url()
        host = urlsplit(url).hostname
        return RobotLink.of(url, self._door.info.name).text if host and not is_here(host) else ""


def _site(request: Request) -> str:
    """The URL of this site as the asker reached it."""
    host, port = request.scope.get("server") or ("127.0.0.1", 0)
    return f"{request.scope.get('scheme', 'http')}://{at_port(host, port)}"


def strangers(door: StationDoor, said: str, status: int = 200) -> Response:
    """What a stranger sees: the robot's name, STOP, whether it is pressed, and where to show a token."""
    from robotside.gateways.usage_sheet.rendering import strangers_page
    from robotside.gateways.usage_sheet.sheet import stop_words

    page = strangers_page(door.info.name, said, stop_words(door, named=False))
    return HTMLResponse(page, status, _PRIVATE)

"""Logging in to the web site: a token that was shown in a form stays with the browser as a cookie."""

from __future__ import annotations

import re
from urllib.parse import parse_qs

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response

from bridge.core.errors import Refused
from bridge.server.reception.pages import PagePolicy
from robotside.door.station_door import StationDoor

__all__ = ["Sessions"]

MAX_FORM_BYTES = 4096
"""Longest form that is read [byte]."""
MAX_COOKIE_AGE = 30 * 86_400
"""A browser forgets its token after this [s]; the robot may end it before."""
_TOKEN = re.compile(r"[\w.~+/=-]{1,512}", re.ASCII)


class Sessions:
    """The cookies of one web site. A cookie is sent by the robot's own pages only, and no script can read it."""

    def __init__(self, door: StationDoor, pages: PagePolicy) -> None:
        self._door, self._pages = door, pages

    async def login(self, request: Request) -> Response:
        """Take the token of a form and send the browser to the page. Raises Refused for a wrong one."""
        token = await _token(request)
        operator = request.client.host if request.client else "unknown"
        secure = request.url.scheme == "https"
        joined = self._door.join(f"{operator}:0", way="http", secure=secure, token=token, trusted=False)
        self._door.leave(joined)
        answer = RedirectResponse("/", 303, {"Cache-Control": "no-store"})
        answer.set_cookie(
            self._pages.cookie_name,
            token,
            max_age=MAX_COOKIE_AGE,
            secure=secure,
            httponly=True,
            samesite="strict",
        )
        return answer

    def logout(self, request: Request) -> Response:
        """Have the browser forget its token."""
        answer = RedirectResponse("/", 303, {"Cache-Control": "no-store"})
        secure = request.url.scheme == "https"
        answer.delete_cookie(self._pages.cookie_name, secure=secure, httponly=True, samesite="strict")
        return answer


async def _token(request: Request) -> str:
    """The field `token` of a form; raises Refused with one sentence for what cannot be one."""
    body = b""
    async for piece in request.stream():
        body += piece
        if len(body) > MAX_FORM_BYTES:
            raise Refused(f"A form has at most {MAX_FORM_BYTES} bytes.")
    fields = parse_qs(body.decode("latin-1"), max_num_fields=5) if body.count(b"&") < 5 else {}
    token = "".join(fields.get("token", [])).strip()
    if not _TOKEN.fullmatch(token):
        raise Refused("Enter the token as it was shown: letters, digits, dots and dashes.")
    return token

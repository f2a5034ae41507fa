"""Credentials that a request shows, and the standing that they give its connection."""

from __future__ import annotations

from collections.abc import Sequence

from bridge.core.errors import Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.server.reception.places import Place

__all__ = ["bearer", "cookie", "introduce"]


def bearer(headers: Sequence[str]) -> str:
    """The token of the `Authorization` headers of a request; empty when it shows none.

    Raises Refused for more than one of them. Other schemes than `Bearer` are not ours and are left alone.
    """
    if len(headers) > 1:
        raise Refused("A request shows one token, not several.")
    scheme, _, token = "".join(headers).partition(" ")
    return token.strip() if scheme.lower() == "bearer" else ""


def cookie(headers: Sequence[str], name: str) -> str:
    """The value of a cookie in the `Cookie` headers of a request; empty when it has none of that name."""
    for header in headers:
        for part in header.split(";"):
            key, _, value = part.strip().partition("=")
            if key == name:
                return value
    return ""


def introduce(operator: Operator, place: Place | None, now: float) -> None:
    """Give the connection of `operator` the standing of its role at `now` [s, operators' clock]."""
    if place is not None and operator.role(now) > Role.NONE:
        place.meet(operator.identity.id, proven=operator.identity.proven)

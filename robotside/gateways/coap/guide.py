"""The guide of the CoAP gateway, with lines that a shell takes as they are, and the list of all that RFC 6690 has."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator

from bridge.core.identity import Role
from robotside.gateways.payloads import offered
from robotside.gateways.payloads.offered import Line, OfferedPayload
from robotside.gateways.plain.visitor import STOP, TIME

__all__ = ["guide", "links"]

ALIAS = "alias coap-client=coap-client-notls"
_STAMP = "?stamp=$(date +%s.%N)"
_PLAIN = f"<{STOP}>;if=call,</guide>;ct=0"
_HEAD = """\
CoAP at {url}, for the tools of libcoap. GET reads a topic, with observe (-s SECONDS) again and again; POST publishes and calls.
A command needs a stamp of less than 5 s ago, the robot's time in seconds, as the query `stamp`; to drive one of less than 0.25 s
ago, from a client that has called rosapi/get_time. Further queries: token, client (a name of your own, where several come from
one machine), rate [Hz]. What is in several blocks, as the map, is put together by the tool. POST to bye when you leave.
The role that everybody has here: {role}.
Debian has the tool as coap-client-notls, -openssl and -gnutls only; there paste the alias first.

{alias}
"""


def guide(url: str, payloads: Iterable[OfferedPayload], role: Role) -> str:
    """How to use the robot at `url` with that role; who has none is told of STOP alone."""
    lines = [_HEAD.format(url=url, role=role.word, alias=ALIAS), f"coap-client -m post {url}{STOP}"]
    if role > Role.NONE:
        lines += [f"coap-client -m post {url}{TIME}", f"coap-client {url}/.well-known/core"]
        lines += [line for each in payloads for line in _payload(url, each)]
    return "\n".join(lines)


def links(payloads: Iterable[OfferedPayload], role: Role) -> str:
    """All that can be read, published on and called, in CoRE's link format."""
    if role <= Role.NONE:
        return _PLAIN
    return ",".join(
        [f'</guide>;ct=0;title="how this robot is used",<{TIME}>;if=call']
        + [_link(line) for each in payloads for line in each.lines if line.verb != offered.RUN]
    )


def _link(line: Line) -> str:
    title = line.doc.replace('"', "'").replace("\\", "")
    kind = f'<{line.name}>;rt="{line.type}";title="{title}"'
    return f'{kind};ct="50 0";obs' if line.verb == offered.READ else f"{kind};if={line.verb}"


def _payload(url: str, each: OfferedPayload) -> Iterator[str]:
    yield ""
    yield f"{each.payload.key}: {each.payload.doc}"
    for line in each.lines:
        command = _command(url, line)
        if command:
            units = f"; {line.units}" if line.units else ""
            yield f"  # {line.doc} ({line.type}{units})"
            yield f"  {command}"


def _command(url: str, line: Line) -> str:
    if line.verb == offered.READ:
        return f"coap-client {url}{line.name}"
    if line.verb == offered.RUN:
        return ""
    stamp = "" if line.name == STOP else _STAMP
    return f'coap-client -m post -t json -e {shlex.quote(line.example)} "{url}{line.name}{stamp}"'

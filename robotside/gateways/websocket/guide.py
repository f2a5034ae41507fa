"""The guide of the plain WebSocket: every message that a client can send, as a line to paste into it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from bridge.core.identity import Role
from robotside.gateways.payloads import offered
from robotside.gateways.payloads.offered import Line, OfferedPayload
from robotside.gateways.plain.visitor import TIME

__all__ = ["guide"]

_HEAD = """\
Plain JSON by WebSocket at {url}; send each line below as one message, with Postman, a browser or python -m websockets {url}
An `id` of your own, a text or a number, is repeated in the answer. A stream comes at most as often as its `rate` [Hz] says.
A command may have a `stamp`, the robot's time in seconds; with one, a drive command counts for 0.25 s after it.
A picture is two messages: its topic, stamp and size, then its bytes. A token comes first, as {{"token": "…"}}.
The role that you have here: {role}.

{{"call": "/stop"}}
stop"""
_NAME = {
    offered.READ: "subscribe",
    offered.PUBLISH: "publish",
    offered.CALL: "call",
    offered.RUN: "run",
}
_CONTENT = {offered.PUBLISH: "message", offered.CALL: "request", offered.RUN: "goal"}


def guide(url: str, payloads: Iterable[OfferedPayload], role: Role) -> str:
    """How to use the robot at `url` with that role; who has none is told of STOP alone."""
    lines = [_HEAD.format(url=url, role=role.word)]
    if role > Role.NONE:
        lines += [f'{{"call": "{TIME}", "id": 1}}', *(line for each in payloads for line in _payload(each))]
    return "\n".join(lines)


def _payload(each: OfferedPayload) -> Iterator[str]:
    yield ""
    yield f"{each.payload.key}: {each.payload.doc}"
    for line in each.lines:
        units = f"; {line.units}" if line.units else ""
        yield f"  # {line.doc} ({line.type}{units})"
        yield f"  {_message(line)}"
    if each.payload.key == "arm":
        yield "  # the same by the name of the pose alone"
        yield "  home"


def _message(line: Line) -> str:
    """The message, whose parts are JSON already."""
    content = f', "{_CONTENT[line.verb]}": {line.example}' if line.verb in _CONTENT else ""
    more = (
        ', "id": 2'
        if line.verb == offered.RUN
        else ', "rate": 5'
        if line.verb == offered.READ and line.rate
        else ""
    )
    return f'{{"{_NAME[line.verb]}": "{line.name}"{content}{more}}}'

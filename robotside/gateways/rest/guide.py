"""The guide of the REST gateway: what can be read and sent, with lines that a shell takes as they are."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator

from bridge.core.identity import Role
from robotside.gateways.payloads import offered
from robotside.gateways.payloads.offered import Line, OfferedPayload
from robotside.gateways.plain.visitor import STOP
from robotside.gateways.usage_sheet.pasted import PLAIN, SHOWN, RobotKey, without_tls
from robotside.gateways.usage_sheet.pasted import curl as options

__all__ = ["guide"]

_CLIENT = "-H 'Client-Id: me'"
_STAMP = '-H "Stamp: $(date +%s.%N)"'


def guide(base: str, payloads: Iterable[OfferedPayload], role: Role | None, key: RobotKey = PLAIN) -> str:
    """How to use the robot by curl. `role` is that of who shows no key, None where the address decides; `key` is the robot's."""
    said = "by the address that it comes from" if role is None else role.word
    curl = f"curl -sS{options(base, key)}"
    return "\n".join(
        [
            f"REST at {base}; {base}/docs lists all paths, {base}/openapi.json has the schemas.",
            f"Answers are JSON, or text or XML by Accept. A token goes into -H '{SHOWN}'; without one the role is",
            f"{said}. Client-Id tells programs of one machine apart: control belongs to one of them.",
            "To drive takes the header Stamp, the robot's time in seconds, of less than 0.25 s ago, from who has asked for /time.",
            "",
            f"{curl} {_CLIENT} {base}/time",
            f"curl -sS -X POST {without_tls(base)}/stop",
            f"{curl} -H 'Accept: text/plain' {base}/robot",
            f"{curl} {base}/events?since=0",
            f"{curl} {_CLIENT} -X POST {base}/control",
            *(line for each in payloads for line in _payload(curl, base, each)),
        ]
    )


def _payload(curl: str, base: str, each: OfferedPayload) -> Iterator[str]:
    yield ""
    yield f"{each.payload.key}: {each.payload.doc}"
    for line in each.lines:
        command = _command(curl, base, line)
        if command:
            units = f"; {line.units}" if line.units else ""
            yield f"  # {line.doc} ({line.type}{units})"
            yield f"  {command}"


def _command(curl: str, base: str, line: Line) -> str:
    if line.verb == offered.READ:
        return f"{curl} {base}/topics{line.name}"
    if line.verb == offered.RUN:
        return ""
    kind = "services" if line.verb == offered.CALL else "topics"
    stamp = f" {_STAMP}" if line.verb == offered.PUBLISH else ""
    body = f"-H 'Content-Type: application/json' -d {shlex.quote(line.example or '{}')}"
    if line.name == STOP:
        curl, base = "curl -sS", without_tls(base)
    return f"{curl} {_CLIENT}{stamp} {body} {base}/{kind}{line.name}"

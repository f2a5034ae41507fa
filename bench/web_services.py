"""A call of a robot's web services, by SOAP, by REST and by the bare web site, in turns on connections that stay open.

The robot side is a process of its own with a robot that weighs nothing; the client is Python's own `http.client`, which parses nothing
of the answers. All three ask for little: SOAP for `GetStatus`, REST for the control status, the site for its health.
A call's CPU is that of the robot side, less what it spends anyway while nobody asks.
"""

from __future__ import annotations

import http.client
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import NamedTuple
from urllib.parse import urlsplit

from bench.support.figures import Figure, percentile
from bench.support.harness import Context, Sides
from bench.support.station import Serving, serving

__all__ = ["CALLS", "FIGURES", "REPEATS", "calls", "prepare"]

KINDS = {"soap": "SOAP", "rest": "REST", "http": "the bare site"}
MOST = {"soap": 10.0, "rest": 10.0, "http": None}
"""Of 99 of 100 calls [ms]."""
FIGURES = (
    *(Figure(f"{kind}_p50", "ms", f"a call by {what}, median") for kind, what in KINDS.items()),
    *(
        Figure(f"{kind}_p99", "ms", f"a call by {what}, 99 of 100", MOST[kind])
        for kind, what in KINDS.items()
    ),
    *(
        Figure(f"{kind}_cpu", "ms", f"the robot side's CPU for a call by {what}")
        for kind, what in KINDS.items()
    ),
)
REPEATS = 3
CALLS = 400
"""Of each kind in a repeat."""
_BATCH = 50
"""Calls of one kind before it is the next one's turn."""
_IDLE = 1.0
"""So long nobody asks [s]."""

NS = "urn:pilothouse:robot:1"
ENVELOPE = (
    '<s:Envelope xmlns:s="http://schemas.xmlsoap.org/soap/envelope/"><s:Body>'
    f'<GetStatus xmlns="{NS}"/></s:Body></s:Envelope>'
)


class _Request(NamedTuple):
    method: str
    path: str
    body: str | None
    headers: Mapping[str, str]


REQUESTS = {
    "soap": _Request(
        "POST", "/soap", ENVELOPE, {"Content-Type": "text/xml", "SOAPAction": f'"{NS}#GetStatus"'}
    ),
    "rest": _Request("GET", "/api/control", None, {}),
    "http": _Request("GET", "/healthz", None, {}),
}


@contextmanager
def prepare(_: Context) -> Iterator[Sides]:
    """One robot side for all repeats."""
    with serving("bench.support.filming", "--protocols", "rest,soap") as robot:
        yield Sides(lambda: calls(robot, CALLS))


def calls(robot: Serving, count: int) -> dict[str, float]:
    """One sample of every figure, with so many calls of each kind."""
    began, before = time.perf_counter(), robot.own_cpu()
    time.sleep(_IDLE)
    idle = (robot.own_cpu() - before) / (time.perf_counter() - began)
    times: dict[str, list[float]] = {kind: [] for kind in REQUESTS}
    spent = dict.fromkeys(REQUESTS, 0.0)
    for _ in range(max(1, count // _BATCH)):
        for kind, request in REQUESTS.items():
            began, before = time.perf_counter(), robot.own_cpu()
            times[kind] += _batch(robot.site, request, min(count, _BATCH))
            spent[kind] += robot.own_cpu() - before - idle * (time.perf_counter() - began)
    return {
        **{f"{kind}_p50": percentile(each, 0.5) * 1e3 for kind, each in times.items()},
        **{f"{kind}_p99": percentile(each, 0.99) * 1e3 for kind, each in times.items()},
        **{f"{kind}_cpu": spent[kind] / len(times[kind]) * 1e3 for kind in REQUESTS},
    }


def _batch(site: str, request: _Request, count: int) -> list[float]:
    """How long each of so many calls took, on one connection [s]. RuntimeError for one that is refused."""
    parts = urlsplit(site)
    connection = http.client.HTTPConnection(parts.hostname or "", parts.port, timeout=60)
    took = []
    try:
        connection.connect()
        for _ in range(count):
            began = time.perf_counter()
            connection.request(request.method, request.path, request.body, dict(request.headers))
            answer = connection.getresponse()
            said = answer.read()
            took.append(time.perf_counter() - began)
            if answer.status != 200:
                raise RuntimeError(f"{request.path} was answered {answer.status}: {said[:200]!r}.")
    finally:
        connection.close()
    return took

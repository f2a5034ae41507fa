"""Figures of the topics table: what comes of each topic that is listened to, who ties it, and the order of the lines.

Everything here happens in the UI thread. Nothing is subscribed to for a figure.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from app.screens.topics.ros_graph import RosGraph
from app.session.session import Session
from app.session.topic_list import Line
from bridge.client.message_receiver import Flow, Traffic

__all__ = ["COLUMNS", "ORDERS", "Entry", "Flows", "bytes_text", "entries"]

WINDOW = 4.0
"""Over which rate and bandwidth are measured [s]."""
SAMPLE_PERIOD = 0.5
"""Between two looks at what came [s]."""
ORDERS = ("name", "rate", "age", "bandwidth", "publishers", "subscribers")
"""By which lines can be put in order."""

COLUMNS = {"rate": 84.0, "age": 96.0, "bandwidth": 96.0, "publishers": 68.0, "subscribers": 68.0}
"""Columns of a wide table after the name's, and their widths where there is room for all of them [sp]."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One line of the table with its figures; NaN for what is not measured or known."""

    line: Line
    rate: float = math.nan
    """[Hz]"""
    age: float = math.nan
    """[s]"""
    bandwidth: float = math.nan
    """As it comes over this link, with its names and punctuation [B/s]."""
    publishers: float = math.nan
    subscribers: float = math.nan


class Flows:
    """Rate and bandwidth of each topic that comes over the link."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._traffic: Traffic | None = None
        self._samples: deque[tuple[float, dict[str, Flow]]] = deque()

    def tick(self) -> None:
        """Look at what came, now and then."""
        now, traffic = self._session.now(), self._session.link.health.traffic
        if traffic is not self._traffic:
            self._traffic = traffic
            self._samples.clear()
        if self._samples and now - self._samples[-1][0] < SAMPLE_PERIOD:
            return
        self._samples.append((now, traffic.read()))
        while len(self._samples) > 2 and now - self._samples[1][0] >= WINDOW:
            self._samples.popleft()

    def of(self, topic: str) -> tuple[float, float]:
        """Messages [Hz] and bytes [B/s] that came lately; NaN for a topic of which none did, or while that is not known."""
        if len(self._samples) < 2:
            return math.nan, math.nan
        (since, first), (until, last) = self._samples[0], self._samples[-1]
        now, before = last.get(topic), first.get(topic, Flow())
        if now is None or now.messages == before.messages or until - since < 2 * SAMPLE_PERIOD:
            return math.nan, math.nan
        return (now.messages - before.messages) / (until - since), (now.size - before.size) / (until - since)


def entries(
    lines: Iterable[Line],
    flow: Callable[[str], tuple[float, float]],
    graph: RosGraph | None,
    order: str = "name",
    *,
    descending: bool = False,
) -> list[Entry]:
    """Lines with their figures in that order, one of `ORDERS`; what is not known comes last whichever way."""
    found = [_entry(line, flow(line.name), graph) for line in lines]
    if order == "name":
        return sorted(found, key=lambda one: one.line.name, reverse=descending)
    sign = -1.0 if descending else 1.0
    return sorted(found, key=lambda one: _key(getattr(one, order), sign, one.line.name))


def _key(value: float, sign: float, name: str) -> tuple[bool, float, str]:
    unknown = math.isnan(value)
    return unknown, 0.0 if unknown else sign * value, name


def _entry(line: Line, flow: tuple[float, float], graph: RosGraph | None) -> Entry:
    rate, bandwidth = flow
    if line.state == "live" and math.isfinite(line.rate) and line.rate > 0:
        rate = line.rate
    if line.state == "stale":
        rate = bandwidth = 0.0
    ties = (math.nan, math.nan)
    if graph is not None:
        ties = float(len(graph.publishes.get(line.name, ()))), float(len(graph.subscribes.get(line.name, ())))
    return Entry(line, rate, line.age, bandwidth, *ties)


def bytes_text(rate: float) -> str:
    """A bandwidth [B/s] with its unit, as in `1.2 kB/s`; empty for NaN."""
    if math.isnan(rate):
        return ""
    for factor, unit in ((1e6, "MB/s"), (1e3, "kB/s")):
        if rate >= 0.9995 * factor:
            return f"{rate / factor:.1f} {unit}"
    return f"{rate:.0f} B/s"

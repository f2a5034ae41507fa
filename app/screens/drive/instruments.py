"""The instruments of a layout as widgets: each shows its topics, and says where what it shows comes from."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from kivy.uix.widget import Widget

import widgets
from app.layout.layout import Instrument, Layout
from app.link.capabilities import POSE, Capabilities
from app.link.feeds import Feeds
from app.session.dashboard import Dashboard
from widgets import Readout
from widgets.core.language import mark, tr

__all__ = ["Instruments"]

MAX_NAME_LENGTH = 14
"""Letters of a topic's name on an instrument."""
SENSES = "senses"
"""The slot whose widgets look after themselves, by what the robot has."""

CARRIED = (
    Instrument(
        SENSES,
        "UltrasoundView",
        "/range/front",
        title=mark("Ultrasound"),
        also=("/range/left", "/range/right", "/range/rear"),
    ),
    Instrument(SENSES, "SonarRingView", "/sonar", title=mark("Sonar")),
    Instrument(SENSES, "LineSensorView", "/line_sensor", title=mark("Line")),
    Instrument(SENSES, "LaserScanView", "/scan"),
)
"""Of what any robot may carry: among the small sensors of one whose layout does not name it, once it says something."""


BY_WHEELS = {"Map x": mark("Odom x"), "Map y": mark("Odom y")}
"""Titles of figures on the map, to those where the place is by the wheels alone."""


class Instruments:
    """Made once for a screen; the screen puts them where they belong."""

    def __init__(self, layout: Layout, dashboard: Dashboard, feeds: Feeds) -> None:
        """They are fed by `dashboard`."""
        self._dashboard, self._feeds = dashboard, feeds
        self.places: dict[str, list[Widget]] = {}
        """Widgets by slot, in the order of the layout; those of `readouts` are figures."""
        self.senses: list[tuple[Callable[[], Any], tuple[str, ...]]] = []
        """What makes each small sensor, with its topics: most robots have one or none of those that any may carry."""
        self._offer: Capabilities | None = None
        self._titled: list[tuple[Any, Instrument]] = []
        self._places_told: list[tuple[Readout, Instrument]] = []
        shown = {name for one in layout.instruments for name in one.topics}
        for one in (*layout.instruments, *(one for one in CARRIED if one.topic not in shown)):
            self._add(one)

    def _add(self, one: Instrument) -> None:
        if one.slot == SENSES:
            self.senses.append((partial(self._sense, one), one.topics))
            return
        widget = self._made(one)
        self.places.setdefault(one.slot, []).append(widget)
        for name in one.topics:
            # what it shows beside its own topic makes it neither younger nor older
            self._dashboard.bind(widget, name, fresh=name == one.topic)

    def _sense(self, one: Instrument) -> Any:
        widget = self._made(one)
        self.name_sources(self._offer)
        return widget

    def _made(self, one: Instrument) -> Any:
        return self._figure(one) if one.widget == "Readout" else self._picture(one)

    def _figure(self, one: Instrument) -> Readout:
        widget = Readout(
            name=tr(one.title),
            unit=one.unit,
            path=one.field,
            scale=one.factor,
            decimals=one.digits,
            plus=one.plus,
            minus=one.minus,
            fitted=False,
            font_size="21sp",
        )
        widget.size_hint_x = 1
        if one.topic == POSE:
            self._places_told.append((widget, one))
        return widget

    def _picture(self, one: Instrument) -> Any:
        kind = getattr(widgets, one.widget)
        offered = {"card": True, "title": tr(one.title)}
        small = one.slot == SENSES  # no room for a name that is not wanted
        widget = kind(
            **{key: value for key, value in offered.items() if hasattr(kind, key) and (value or small)}
        )
        if one.title and hasattr(kind, "title"):
            self._titled.append((widget, one))
        return widget

    def name_sources(self, offer: Capabilities | None) -> None:
        """An instrument that shows a topic of another name than the usual one says which."""
        self._offer = offer
        for widget, one in self._titled:
            source = offer.source(one.topic) if offer is not None else None
            title = tr(one.title)
            widget.title = f"{title} · {_brief(source)}" if source and source != one.topic else title
        for readout, one in self._places_told:
            by_wheels = offer is not None and offer.pose_by_odometry
            readout.name = tr(BY_WHEELS.get(one.title, one.title) if by_wheels else one.title)


def _brief(name: str) -> str:
    """The end of a topic's name, as much as an instrument has room for."""
    return name if len(name) <= MAX_NAME_LENGTH else f"…{name[1 - MAX_NAME_LENGTH :]}"

"""Robot widgets for Kivy: a message becomes a picture, a finger becomes a message.

`from widgets import Compass` imports only the module that Compass needs. `CATALOGUE` tells which modules there are,
`python -m widgets` shows them all.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

CATALOGUE: dict[str, str] = {
    "ArtificialHorizon": "widgets.horizon",
    "Battery": "widgets.battery",
    "Compass": "widgets.compass",
    "EventLog": "widgets.event_log",
    "FieldView": "widgets.field_view",
    "GeoMap": "widgets.geo_map",
    "GridMap": "widgets.grid_map",
    "HeadingTape": "widgets.heading_tape",
    "Joystick": "widgets.joystick",
    "LaserScanView": "widgets.laser_scan",
    "LinkQuality": "widgets.link_quality",
    "MotionSelector": "widgets.motion_selector",
    "Readout": "widgets.readout",
    "StopButton": "widgets.stop_button",
    "TaskButtons": "widgets.task_buttons",
    "Video": "widgets.video",
}
"""Class name of each widget to the module that holds it; the module's `samples()` shows its states."""

__all__ = ["CATALOGUE", *CATALOGUE]  # noqa: PLE0604


def __getattr__(name: str) -> Any:
    """Import a widget's module when its class is first asked for."""
    if name not in CATALOGUE:
        raise AttributeError(f"module 'widgets' has no attribute {name!r}")
    return getattr(import_module(CATALOGUE[name]), name)


def __dir__() -> list[str]:
    return [*globals(), *CATALOGUE]

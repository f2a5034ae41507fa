"""Widgets of panels that only show something, made by what a layout says of them."""

from __future__ import annotations

from typing import Any

from kivy.properties import AliasProperty, Property

import widgets
from app.layout.views import Panel
from widgets.fitting import offers

__all__ = ["make_instrument"]


def make_instrument(panel: Panel, type_name: str = "") -> Any:
    """The widget of a panel that shows a topic of that type; it has no name of its own, for its card has one."""
    kind: Any = getattr(widgets, panel.widget)
    wanted = _offered(panel, type_name) | {"card": False, "title": "", "name": "", "unit": panel.unit}
    if panel.field:
        wanted |= {"path": panel.field, "scale": panel.factor, "decimals": panel.digits}
    if panel.widget == "Readout":
        wanted |= {"plus": panel.plus, "minus": panel.minus, "fitted": False, "font_size": "30sp"}
    if panel.widget == "Plot":
        paths = [path.strip() for path in panel.field.split(",") if path.strip()]
        wanted |= {"paths": paths, "names": [panel.title] if panel.title and len(paths) == 1 else paths}
    if panel.widget == "Video":
        wanted = {"fit": "cover", "corner": 8}
    widget = kind(**{name: value for name, value in wanted.items() if _settable(kind, name)})
    widget.own_height = panel.widget == "Readout"
    return widget


def _settable(kind: Any, name: str) -> bool:
    """Widgets of that class have a property of that name that may be set."""
    found = getattr(kind, name, None)
    return isinstance(found, Property) and not isinstance(found, AliasProperty)


def _offered(panel: Panel, type_name: str) -> dict[str, Any]:
    """What the offer of that field says besides, as the names of its values."""
    if not panel.field or not type_name:
        return {}
    found = (
        one
        for one in offers(type_name, panel.topic, commanded=False)
        if one.widget == panel.widget and one.field == panel.field
    )
    offer = next(found, None)
    return offer.options if offer is not None else {}

"""Views of a layout file: free panels, each a widget with its topic, on a grid that every form of the window has its own of."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

import msgspec

from app.layout.panel_grid import Place, arrange

__all__ = ["MAX_PANELS", "MAX_VIEWS", "Panel", "View", "places_of", "stacks_of"]

MAX_VIEWS = 12
"""Views of one profile."""
MAX_PANELS = 40
"""Panels of one view."""
_Title = Annotated[str, msgspec.Meta(max_length=60)]
_Topic = Annotated[str, msgspec.Meta(max_length=200)]
_Cells = tuple[int, int, int, int]


class Panel(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """One widget of a view."""

    widget: str
    """Name in the widget catalogue, or `SpeedCard`."""
    topic: _Topic = ""
    """What it shows, by the robot's name of it; empty for a control that shows nothing."""
    also: tuple[_Topic, ...] = ()
    """Further topics that it shows with the first."""
    field: _Topic = ""
    """Path of the number that it shows, as in `twist.twist.linear.x`; empty for a widget that shows whole messages."""
    title: _Title = ""
    """What stands over it; empty for the widget's own name."""
    unit: _Title = ""
    factor: float = 1.0
    """What the number is multiplied by to be in `unit`."""
    digits: Annotated[int, msgspec.Meta(ge=0, le=6)] = 1
    """Figures behind the point."""
    plus: _Title = ""
    """What a figure says of a number above 0 and, in `minus`, below 0, in the place of a sign; both or neither."""
    minus: _Title = ""
    forward: str = "ahead"
    """Of a stick, as of `app.layout.layout.Control`; so are the next three."""
    left: str = "turn"
    pad: str = "left"
    action: str = ""
    icon: str = ""
    stack: _Title = ""
    """Panels of the same stack lie in the same place, that of the first, one in sight; empty for one that lies alone."""
    hidden: bool = False
    """It is in no sight until it is shown again in the editor."""
    wide: _Cells | None = None
    """Left, top, width and height on the grid of a tablet [cells]; None to be arranged automatically. So are the next two."""
    short: _Cells | None = None
    tall: _Cells | None = None

    @property
    def topics(self) -> tuple[str, ...]:
        """All topics that it shows."""
        return ((self.topic,) if self.topic else ()) + self.also

    def place(self, form: str) -> Place | None:
        """Where it was put by hand in a window of that form; None where it is arranged automatically."""
        cells = {"wide": self.wide, "short": self.short, "tall": self.tall}[form]
        return None if cells is None else Place(*cells)


class View(msgspec.Struct, frozen=True, forbid_unknown_fields=True, rename={"panels": "panel"}):
    """Panels that are on the glass together."""

    title: _Title
    panels: tuple[Panel, ...] = ()


def stacks_of(panels: Sequence[Panel]) -> list[list[int]]:
    """Indices of the panels that lie in one place together, each group in the order of the file, groups by their first."""
    groups: dict[object, list[int]] = {}
    for index, panel in enumerate(panels):
        groups.setdefault(panel.stack or index, []).append(index)
    return list(groups.values())


def places_of(panels: Sequence[Panel], form: str) -> list[Place]:
    """Where each panel is in a window of that form; those of one stack are in the place of its first."""
    groups = stacks_of(panels)
    firsts = [panels[group[0]] for group in groups]
    arranged = arrange([(one.widget, one.place(form)) for one in firsts], form)
    found = {index: place for group, place in zip(groups, arranged, strict=True) for index in group}
    return [found[index] for index in range(len(panels))]

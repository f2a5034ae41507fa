"""Tables of a layout file: a drive screen's arrangement, instruments, controls and actions, and the views beside it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated

import msgspec

from app.layout.views import View
from bridge.core.topics import TOPICS

__all__ = [
    "ACTIONS",
    "ARRANGEMENTS",
    "PADS",
    "SAYS",
    "SHOWN",
    "SLIDER",
    "SLIDER_SLOT",
    "Action",
    "Arrangement",
    "Control",
    "Instrument",
    "Layout",
    "LayoutFile",
]


@dataclass(frozen=True)
class Arrangement:
    """How a drive screen is cut up: places to the number of things that fit."""

    instruments: Mapping[str, int]
    controls: Mapping[str, int]
    actions: int


_FLOATING = {"top_left": 1, "top": 1, "top_right": 1, "readouts": 4, "senses": 3}
ARRANGEMENTS: Mapping[str, Arrangement] = {
    "float": Arrangement(_FLOATING, {"stick": 2, "slider": 1, "top_right": 1}, 4),
    "two_sticks": Arrangement(_FLOATING, {"stick": 1, "right_stick": 1, "slider": 1, "confirm": 2}, 4),
    "columns": Arrangement({"left": 3, "corner": 1, "motion": 1}, {"stick": 1, "lift": 1, "tilt": 1}, 8),
}
"""Video behind everything; the same with a control under either thumb; three columns with the video in the middle."""

SLIDER = "SpeedCard"
"""The app's own control among those of the widget catalogue: how fast the others are at the end of their way."""
SLIDER_SLOT = "slider"
STICK = "Stick"
"""What drives, where the layout has no word for it and it has to be told from another, or from an arm."""
SAYS = {"RudderThrottle": ("throttle", "steering"), "TiltCircle": ("roll", "pitch")}
"""Which of `app.link.control_mixer.PARTS` a control says; a stick says what its line says."""
ACTIONS = (
    *(f"task.{task}" for task in ("surface", "hold", "follow_heading", "take_off", "land", "go_home")),
    *("pause", "lights", "record", "snapshot", "camera", "reset"),
)
"""What a button or a slide may do: the keys of `app.session.layout_actions.ACTIONS`, which is known only once Kivy is set up."""
PADS = ("left", "right")
SHOWN = tuple(one.name for one in TOPICS if one.to == "handheld")
"""Topics that can be shown."""


class Instrument(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One instrument of a layout."""

    slot: str
    """Key in the instruments of its arrangement."""
    widget: str
    """Name in the widget catalogue."""
    topic: str
    field: str = ""
    """Path of the number that a Readout shows, as in `twist.twist.linear.x`, or `linear.xy` for how fast over ground whichever way;
    empty for other widgets."""
    title: str = ""
    unit: str = ""
    factor: float = 1.0
    """What the number is multiplied by to be in `unit`."""
    digits: Annotated[int, msgspec.Meta(ge=0, le=6)] = 1
    """Figures behind the point."""
    plus: str = ""
    """What a Readout says of a number above 0 and, in `minus`, below 0, in the place of a sign; both or neither."""
    minus: str = ""
    also: tuple[str, ...] = ()
    """Further topics that it shows with the first."""

    @property
    def topics(self) -> tuple[str, ...]:
        """All topics that it shows."""
        return (self.topic, *self.also)


class Control(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One control of a layout."""

    slot: str
    """Key in the controls of its arrangement. Of two in one slot one is on the glass, and a switch between them."""
    widget: str
    """Name in the widget catalogue, or `SLIDER`."""
    title: str = ""
    """What it is called where it has to be told from another."""
    topic: str = ""
    """What it shows beside what it says; empty for nothing."""
    forward: str = "ahead"
    """Of a stick: which of `app.link.control_mixer.PARTS` it says when it is pushed away from the operator."""
    left: str = "turn"
    """The same to the left; empty for one that goes up and down only."""
    pad: str = "left"
    """Which stick of a gamepad pushes it too; empty for none."""
    action: str = ""
    """Of one that does something once: which of `ACTIONS`."""
    icon: str = ""
    also: tuple[str, ...] = ()
    """Further topics that it shows with the first."""

    @property
    def topics(self) -> tuple[str, ...]:
        """All topics that it shows."""
        return ((self.topic,) if self.topic else ()) + self.also

    @property
    def called(self) -> str:
        """What tells it from another of its slot."""
        return self.title or STICK

    @property
    def says(self) -> tuple[str, ...]:
        """Which of `app.link.control_mixer.PARTS` it says, if it drives."""
        return SAYS.get(self.widget, tuple(part for part in (self.forward, self.left) if part))


class Action(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One button of a layout."""

    what: str
    """One of `ACTIONS`."""
    icon: str = ""
    """Empty for the usual one."""
    text: str = ""
    """Empty for the usual words."""


@dataclass(frozen=True)
class Layout:
    """A profile: a drive screen, and views of free panels."""

    name: str
    title: str
    instruments: tuple[Instrument, ...]
    arrangement: str = "float"
    """Key in `ARRANGEMENTS`."""
    robots: tuple[str, ...] = ()
    """Models and kinds of robots that it is for, as of RobotInfo."""
    controls: tuple[Control, ...] = ()
    actions: tuple[Action, ...] = ()
    views: tuple[View, ...] = ()
    """Screens of free panels beside the drive screen."""

    @property
    def drives(self) -> bool:
        """It says what is on the drive screen: an instrument, a control or a button."""
        return bool(self.instruments or self.controls or self.actions)

    def with_drive_of(self, other: Layout) -> Layout:
        """This one with the drive screen of `other`."""
        return replace(
            self,
            arrangement=other.arrangement,
            instruments=other.instruments,
            controls=other.controls,
            actions=other.actions,
        )


class LayoutFile(
    msgspec.Struct,
    rename={
        "robots": "for",
        "instruments": "instrument",
        "controls": "control",
        "actions": "action",
        "views": "view",
    },
    forbid_unknown_fields=True,
):
    """The tables and keys of a layout file."""

    title: str | None = None
    robots: tuple[str, ...] = ()
    arrangement: str = "float"
    instruments: tuple[Instrument, ...] = ()
    controls: tuple[Control, ...] = ()
    actions: tuple[Action, ...] = ()
    views: tuple[View, ...] = ()

    def layout(self, name: str) -> Layout:
        """The layout of that name that the file describes."""
        title = name if self.title is None else self.title
        return Layout(
            name,
            title,
            self.instruments,
            self.arrangement,
            self.robots,
            self.controls,
            self.actions,
            self.views,
        )

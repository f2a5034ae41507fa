"""Layout files: the drive screen of a robot as a table, and what is wrong with one in a sentence.

A file says for which robots it is, how the screen is arranged, which instruments and controls sit where, and what can be
done by a button. The app takes the one whose `for` names the robot's model, else its kind, else `DEFAULT`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import msgspec

from app.layout.layout_faults import (
    LayoutError,
    check_apart,
    check_field,
    check_room,
    one_of,
)
from app.link.control_mixer import PARTS
from bridge.core.toml_files import FileFault, read
from bridge.core.topics import TOPICS, topic

__all__ = [
    "ACTIONS",
    "ARRANGEMENTS",
    "DEFAULT",
    "FOLDER",
    "SAYS",
    "SLIDER",
    "Action",
    "Arrangement",
    "Control",
    "Instrument",
    "Layout",
    "LayoutError",
    "load",
    "names",
    "owners",
    "parse",
]

FOLDER = Path(__file__).parents[1] / "layouts"
DEFAULT = "patrol"
"""The layout of a robot that none is made for."""


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
_PADS = ("left", "right")
_SHOWN = tuple(one.name for one in TOPICS if one.to == "handheld")
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
    """A drive screen."""

    name: str
    title: str
    instruments: tuple[Instrument, ...]
    arrangement: str = "float"
    """Key in `ARRANGEMENTS`."""
    robots: tuple[str, ...] = ()
    """Models and kinds of robots that it is for, as of RobotInfo."""
    controls: tuple[Control, ...] = ()
    actions: tuple[Action, ...] = ()


def names(folder: Path = FOLDER) -> list[str]:
    """Names of the layouts there are."""
    return sorted(path.stem for path in folder.glob("*.toml"))


def load(name: str, widgets: Iterable[str], folder: Path = FOLDER) -> Layout:
    """The layout of that name, or in the file of that name where it ends in `.toml`; `widgets` are the names of the catalogue.

    LayoutError with a sentence.
    """
    if name.endswith(".toml"):
        try:
            return parse(name, Path(name).read_text(encoding="utf-8"), widgets)
        except (OSError, UnicodeDecodeError) as error:
            raise LayoutError(f"Layout {name} cannot be read: {error}.") from error
    if name not in names(folder):
        raise LayoutError(f"There is no layout {name!r}; there are: {', '.join(names(folder))}.")
    return parse(name, (folder / f"{name}.toml").read_text(encoding="utf-8"), widgets)


def owners(folder: Path = FOLDER) -> dict[str, str]:
    """Each model and kind of robots to the name of the layout that is made for it; no widget is looked at.

    LayoutError with a sentence, as where two layouts are for one robot.
    """
    found: dict[str, str] = {}
    for name in names(folder):
        try:
            text = (folder / f"{name}.toml").read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise LayoutError(f"Layout {name} cannot be read: {error}.") from error
        for robot in _read(name, text).robots:
            if robot in found:
                raise LayoutError(f"Layouts {found[robot]} and {name} are both for {robot}.")
            found[robot] = name
    return found


class _File(
    msgspec.Struct,
    rename={"robots": "for", "instruments": "instrument", "controls": "control", "actions": "action"},
    forbid_unknown_fields=True,
):
    """The tables and keys of a layout file."""

    title: str | None = None
    robots: tuple[str, ...] = ()
    arrangement: str = "float"
    instruments: tuple[Instrument, ...] = ()
    controls: tuple[Control, ...] = ()
    actions: tuple[Action, ...] = ()


def parse(name: str, text: str, widgets: Iterable[str]) -> Layout:
    """The layout in TOML text; LayoutError with a sentence."""
    from app.layout.layout_widgets import drives  # Kivy has to be set up before a widget is imported

    where, known = f"Layout {name}", tuple(widgets)
    file = _read(name, text)
    one_of(where, "arrangement", file.arrangement, ARRANGEMENTS)
    places = ARRANGEMENTS[file.arrangement]
    for number, instrument in enumerate(file.instruments, 1):
        _check_instrument(f"{where}, instrument {number}", instrument, known, places.instruments)
    for number, control in enumerate(file.controls, 1):
        _check_control(f"{where}, control {number}", control, known, places.controls)
    for number, action in enumerate(file.actions, 1):
        _check_action(f"{where}, action {number}", action)
    check_room(where, "instruments", [one.slot for one in file.instruments], places.instruments)
    check_room(where, "controls", [one.slot for one in file.controls], places.controls)
    check_room(where, "actions", ["the buttons"] * len(file.actions), {"the buttons": places.actions})
    hands = (one for one in file.controls if one.widget != SLIDER and not one.action)
    check_apart(where, ((one.slot, one.called, one.says if drives(one.widget) else ()) for one in hands))
    title = name if file.title is None else file.title
    return Layout(name, title, file.instruments, file.arrangement, file.robots, file.controls, file.actions)


def _read(name: str, text: str) -> _File:
    where = f"Layout {name}"
    try:
        return read(text, _File, where)
    except FileFault as fault:
        raise LayoutError(_sentence(fault, where)) from fault


def _sentence(fault: FileFault, where: str) -> str:
    """What is wrong with a layout, its tables counted as people count them: `instrument[0].slot` is in instrument 1."""
    found = re.fullmatch(r"(\w+)\[(\d+)\]\.(.*)", fault.where)
    place, key = (f"{where}, {found[1]} {int(found[2]) + 1}", found[3]) if found else (where, fault.where)
    if fault.known:
        return f"{place}: key is one of {', '.join(fault.known)}, not {key!r}."
    return f"{place}: {key} {fault.reason}." if key else str(fault)


def _check_instrument(where: str, made: Instrument, widgets: Iterable[str], slots: Iterable[str]) -> None:
    from app.layout.layout_widgets import check_instrument  # as above

    one_of(where, "slot", made.slot, slots)
    one_of(where, "widget", made.widget, sorted(widgets))
    one_of(where, "topic", made.topic, _SHOWN)
    if made.widget == "Readout":
        check_field(where, topic(made.topic).type, made.field)
    for name in made.also:
        one_of(where, "also", name, _SHOWN)
    check_instrument(where, made.slot, made.widget, made.topics, widgets)


def _check_control(where: str, made: Control, widgets: Iterable[str], slots: Iterable[str]) -> None:
    one_of(where, "slot", made.slot, slots)
    one_of(where, "widget", made.widget, [*sorted(widgets), SLIDER])
    if made.topic:
        one_of(where, "topic", made.topic, _SHOWN)
    one_of(where, "forward", made.forward, PARTS)
    one_of(where, "left", made.left, ("", *PARTS))
    one_of(where, "pad", made.pad, ("", *_PADS))
    if made.action:
        one_of(where, "action", made.action, ACTIONS)
    for name in made.also:
        one_of(where, "also", name, _SHOWN)
    if (made.slot == SLIDER_SLOT) != (made.widget == SLIDER):
        raise LayoutError(f"{where}: {SLIDER} goes into {SLIDER_SLOT}, and nothing else does.")
    if made.widget != SLIDER:
        _check_hand(where, made, widgets)


def _check_hand(where: str, made: Control, widgets: Iterable[str]) -> None:
    from app.layout.layout_widgets import check_control, check_icon, confirms  # as above

    check_control(where, made.widget, made.topics, widgets)
    if confirms(made.widget):
        one_of(where, "action", made.action or None, ACTIONS)
    elif made.action:
        raise LayoutError(f"{where}: {made.widget} confirms nothing, so it has no action.")
    if made.icon:
        check_icon(where, made.icon)


def _check_action(where: str, made: Action) -> None:
    from app.layout.layout_widgets import check_icon  # as above

    one_of(where, "what", made.what, ACTIONS)
    if made.icon:
        check_icon(where, made.icon)

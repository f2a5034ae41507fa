"""Layout files: the drive screen of a robot as a table, and what is wrong with one in a sentence.

A file says for which robots it is, how the screen is arranged, which instruments and controls sit where, and what can be
done by a button. The app takes the one whose `for` names the robot's model, else its kind, else `DEFAULT`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.layout.layout_faults import (
    LayoutError,
    check_apart,
    check_field,
    check_keys,
    check_room,
    one_of,
    said,
)
from app.link.control_mixer import PARTS
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
    "choose",
    "load",
    "load_all",
    "names",
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
_TEXTS = {"slot", "widget", "topic", "field", "title", "unit", "plus", "minus"}
_NUMBERS = {"factor", "digits"}
_CONTROL_TEXTS = {"slot", "widget", "topic", "title", "forward", "left", "pad", "action", "icon"}
_PADS = ("left", "right")


@dataclass(frozen=True)
class Instrument:
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
    digits: int = 1
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


@dataclass(frozen=True)
class Control:
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


@dataclass(frozen=True)
class Action:
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


def load_all(widgets: Iterable[str], folder: Path = FOLDER) -> tuple[Layout, ...]:
    """Every layout there is, each robot in one of them at most. LayoutError with a sentence."""
    known = tuple(widgets)
    layouts = tuple(load(name, known, folder) for name in names(folder))
    owners: dict[str, str] = {}
    for layout in layouts:
        for robot in layout.robots:
            if robot in owners:
                raise LayoutError(f"Layouts {owners[robot]} and {layout.name} are both for {robot}.")
            owners[robot] = layout.name
    return layouts


def choose(layouts: Iterable[Layout], model: str, kind: str) -> Layout:
    """The layout for a robot of that model and kind: models come before kinds, and a robot of neither gets `DEFAULT`.

    LayoutError where there is none of that name.
    """
    known = tuple(layouts)
    for robot in (model, kind):
        for layout in known:
            if robot and robot in layout.robots:
                return layout
    for layout in known:
        if layout.name == DEFAULT:
            return layout
    raise LayoutError(f"There is no layout {DEFAULT!r}, which robots get that none is made for.")


def parse(name: str, text: str, widgets: Iterable[str]) -> Layout:
    """The layout in TOML text; LayoutError with a sentence."""
    from app.layout.layout_widgets import drives  # Kivy has to be set up before a widget is imported

    where, known = f"Layout {name}", tuple(widgets)
    data = _read(where, text)
    for key in data:
        one_of(where, "key", key, ("title", "for", "arrangement", "instrument", "control", "action"))
    arrangement = data.get("arrangement", "float")
    one_of(where, "arrangement", arrangement, ARRANGEMENTS)
    places, robots, title = ARRANGEMENTS[arrangement], data.get("for", []), data.get("title", name)
    if not isinstance(robots, list) or not all(isinstance(robot, str) for robot in robots):
        raise LayoutError(f"{where}: for is a list of models and kinds of robots, not {said(robots)}.")
    if not isinstance(title, str):
        raise LayoutError(f"{where}: title is a text, not {said(title)}.")
    instruments = tuple(
        _instrument(f"{where}, instrument {i}", e, known, places.instruments)
        for i, e in enumerate(_tables(where, data, "instrument"), 1)
    )
    controls = tuple(
        _control(f"{where}, control {i}", e, known, places.controls)
        for i, e in enumerate(_tables(where, data, "control"), 1)
    )
    actions = tuple(
        _action(f"{where}, action {i}", e) for i, e in enumerate(_tables(where, data, "action"), 1)
    )
    check_room(where, "instruments", [one.slot for one in instruments], places.instruments)
    check_room(where, "controls", [one.slot for one in controls], places.controls)
    check_room(where, "actions", ["the buttons"] * len(actions), {"the buttons": places.actions})
    hands = (one for one in controls if one.widget != SLIDER and not one.action)
    check_apart(where, ((one.slot, one.called, one.says if drives(one.widget) else ()) for one in hands))
    return Layout(name, title, instruments, arrangement, tuple(robots), controls, actions)


def _read(where: str, text: str) -> Mapping[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise LayoutError(f"{where} is no TOML: {error}.") from error
    except RecursionError as error:
        raise LayoutError(f"{where} is no TOML that can be read: it is nested too deep.") from error
    except ValueError as error:  # of a number that has more figures than Python reads
        raise LayoutError(f"{where} is no TOML that can be read: {error}.") from error


def _tables(where: str, data: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    entries = data.get(key, [])
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise LayoutError(f"{where} lists its {key}s as [[{key}]] tables.")
    return entries


def _instrument(
    where: str, entry: Mapping[str, Any], widgets: Iterable[str], slots: Mapping[str, int]
) -> Instrument:
    from app.layout.layout_widgets import check_instrument  # as above

    check_keys(where, entry, texts=_TEXTS, numbers=_NUMBERS, lists={"also"})
    one_of(where, "slot", entry.get("slot"), slots)
    one_of(where, "widget", entry.get("widget"), sorted(widgets))
    one_of(where, "topic", entry.get("topic"), _TOLD)
    if entry["widget"] == "Readout":
        check_field(where, topic(entry["topic"]).type, entry.get("field", ""))
    also = entry.get("also", [])
    for name in also:
        one_of(where, "also", name, _TOLD)
    made = Instrument(**{**entry, "also": tuple(also)})
    check_instrument(where, made.slot, made.widget, made.topics, widgets)
    return made


def _control(
    where: str, entry: Mapping[str, Any], widgets: Iterable[str], slots: Mapping[str, int]
) -> Control:
    from app.layout.layout_widgets import check_control  # as above

    check_keys(where, entry, texts=_CONTROL_TEXTS, lists={"also"})
    one_of(where, "slot", entry.get("slot"), slots)
    one_of(where, "widget", entry.get("widget"), [*sorted(widgets), SLIDER])
    for key, allowed in (
        ("topic", _TOLD),
        ("forward", PARTS),
        ("left", ("", *PARTS)),
        ("pad", ("", *_PADS)),
        ("action", ACTIONS),
    ):
        if key in entry:
            one_of(where, key, entry[key], allowed)
    also = entry.get("also", [])
    for name in also:
        one_of(where, "also", name, _TOLD)
    made = Control(**{**entry, "also": tuple(also)})
    if (made.slot == SLIDER_SLOT) != (made.widget == SLIDER):
        raise LayoutError(f"{where}: {SLIDER} goes into {SLIDER_SLOT}, and nothing else does.")
    if made.widget != SLIDER:
        check_control(where, made.widget, entry, made.topics, widgets, ACTIONS)
    return made


def _action(where: str, entry: Mapping[str, Any]) -> Action:
    from app.layout.layout_widgets import check_icon  # as above

    check_keys(where, entry, texts={"what", "icon", "text"})
    one_of(where, "what", entry.get("what"), ACTIONS)
    if entry.get("icon"):
        check_icon(where, entry["icon"])
    return Action(**entry)


_TOLD = tuple(one.name for one in TOPICS if one.to == "handheld")
"""Topics that can be shown."""

"""Settings of switch access, as the handheld remembers them under `switches`; a value out of range becomes the default."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, Literal

from app.core.checked_settings import number, shown
from app.inputs.switch_access.scan.presses import Timing
from app.inputs.switch_access.scan.scan import Pace
from widgets.core.language import mark, tr

__all__ = ["RANGES", "Key", "Options", "read"]

RANGES: dict[str, tuple[float, float]] = {
    "interval": (0.5, 6.0),
    "first": (0.0, 3.0),
    "loops": (1, 9),
    "debounce": (0.0, 0.3),
    "ignore_repeat": (0.0, 1.0),
    "acceptance": (0.0, 1.0),
}
"""Least and most of each figure: seconds, and `loops` a number."""
MAX_KEYS = 6
"""Keys and buttons that one switch may have."""
WORDS = {"spacebar": mark("Space"), "numpadenter": mark("Number pad Enter")}
"""What keys are called here that Kivy calls otherwise."""
NAME = 80
"""Letters of a name, at most."""


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a keyboard, or a button of a gamepad, that is a switch; many switch boxes are one or the other."""

    source: str
    """`key` or `pad`."""
    name: str
    """As of `app.inputs.base.button_presses.Press`: `tab`, `enter`, `a`, `dpup`, `button 7`."""
    device: str = ""
    """Name of the gamepad; empty for a keyboard, and for any gamepad."""

    def fits(self, source: str, name: str, device: str) -> bool:
        """That one is meant."""
        return (self.source, self.name) == (source, name) and self.device in ("", device)

    @property
    def words(self) -> str:
        """For the operator, as in `Tab` or `Button A`."""
        said = tr(WORDS.get(self.name, self.name.replace("_", " ").capitalize()))
        return tr("Pad {said}").format(said=said) if self.source == "pad" else said


_PACE, _TIMING = Pace(), Timing()
TAB, ENTER, NUMPAD_ENTER = Key("key", "tab"), Key("key", "enter"), Key("key", "numpadenter")


@dataclass(frozen=True, slots=True)
class Options:
    """Everything about switches that the operator chooses."""

    on: bool = True
    """Without a press nothing is marked and nothing costs anything: two keys alone must be able to wake it."""
    one: bool = False
    """One switch, the mark moves by itself; every key is then the one that does."""
    a: tuple[Key, ...] = (TAB,)
    """Next."""
    b: tuple[Key, ...] = (ENTER, NUMPAD_ENTER)
    """Do it."""
    interval: float = _PACE.interval
    first: float = _PACE.first
    loops: int = _PACE.loops
    debounce: float = _TIMING.debounce
    ignore_repeat: float = _TIMING.ignore_repeat
    acceptance: float = _TIMING.acceptance
    tones: bool = True
    """Each step is heard."""
    vibrates: bool = True
    """Each step is felt, on what can vibrate."""
    spoken: bool = False
    """What is marked is said, where the app can speak."""

    @property
    def timing(self) -> Timing:
        """For the contacts."""
        return Timing(self.debounce, self.ignore_repeat, self.acceptance)

    @property
    def pace(self) -> Pace:
        """For the mark."""
        return Pace(self.one, self.interval, self.first, self.loops)

    @property
    def standing(self) -> str:
        """How the switches stand, in a few words."""
        if not self.on:
            return tr("off")
        if self.one:
            return tr("one switch: {b}").format(b=_first(self.b) or tr("no key yet"))
        return tr("{a} next, {b} does it").format(
            a=_first(self.a) or tr("no key"), b=_first(self.b) or tr("no key")
        )

    @property
    def hint(self) -> str:
        """What the switches do, as in `Tab next · Enter do it`; empty while they are off or have no keys."""
        do = tr("{b} do it").format(b=_first(self.b)) if self.on and self.b else ""
        return do if not do or self.one or not self.a else f"{_first(self.a)} next · {do}"

    @property
    def missing(self) -> str:
        """Which switch has no key, as one sentence; empty where none is missing."""
        if not self.b:
            return tr("No key is assigned to the switch that presses the marked target.")
        return "" if self.a or self.one else tr("No key is the switch for the next one.")

    def switch_of(self, source: str, name: str, device: str) -> Literal["A", "B"] | None:
        """The switch that a key or a button is; None where it is none."""
        if any(key.fits(source, name, device) for key in self.b):
            return "B"
        return "A" if any(key.fits(source, name, device) for key in self.a) else None

    def save(self) -> dict[str, Any]:
        """As JSON values."""
        return asdict(self)


def _first(keys: tuple[Key, ...]) -> str:
    """The first of them in words: the others stand in the pane."""
    return keys[0].words if keys else ""


DEFAULTS = Options()


def read(kept: object) -> tuple[Options, str]:
    """The options that `kept` says, and one sentence of what in it was not to be used; empty where all was."""
    if kept is None:
        return DEFAULTS, ""
    if not isinstance(kept, Mapping):
        return DEFAULTS, tr("The settings of the switches are no table but {kept}: as delivered.").format(
            kept=shown(kept)
        )
    options, wrong = DEFAULTS, []
    for one in fields(Options):
        if one.name not in kept:
            continue
        value = _checked(one.name, kept[one.name])
        if value is None:
            wrong.append(f"{one.name} {shown(kept[one.name])} ({_allowed(one.name)})")
        else:
            options = replace(options, **{one.name: value})
    if set(options.a) & set(options.b):
        options, wrong = (
            replace(options, a=DEFAULTS.a, b=DEFAULTS.b),
            [*wrong, tr("one key for both switches")],
        )
    return options, tr("Of the switches put to the default: {wrong}.").format(
        wrong=", ".join(wrong)
    ) if wrong else ""


def _checked(name: str, value: object) -> Any:
    """The value where it may be; None where it may not."""
    if name in ("a", "b"):
        return _keys(value)
    if name not in RANGES:
        return value if isinstance(value, bool) else None
    found = number(value, *RANGES[name])
    return int(found) if found is not None and name == "loops" else found


def _keys(value: object) -> tuple[Key, ...] | None:
    if not isinstance(value, list | tuple) or not len(value) <= MAX_KEYS:
        return None
    found = [_key(one) for one in value]
    return tuple(one for one in found if one is not None) if None not in found else None


def _key(value: object) -> Key | None:
    if not isinstance(value, Mapping):
        return None
    source, name, device = value.get("source"), value.get("name"), value.get("device", "")
    if source not in ("key", "pad") or not isinstance(name, str) or not isinstance(device, str):
        return None
    return Key(source, name, device) if 0 < len(name) <= NAME and len(device) <= NAME else None


def _allowed(name: str) -> str:
    if name in RANGES:
        low, high = RANGES[name]
        return f"{low:g} to {high:g}"
    return (
        tr("at most {max_keys} keys").format(max_keys=MAX_KEYS) if name in ("a", "b") else tr("true or false")
    )

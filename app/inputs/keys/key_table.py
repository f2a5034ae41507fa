"""The table of keys that the user changes, checked when it is read. No Kivy in here."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from app.core.checked_settings import number, shown
from widgets.core.language import mark, tr

__all__ = ["ARROWS", "DRIVING", "FIXED", "MEANT", "RISES", "SLOWS", "KeyTable", "key_words", "read"]

MEANT = {
    "p": "pause_resume",
    "g": "patrol",
    "b": "go_home",
    "e": "end_task",
    "o": "hold",
    "u": "surface",
    "pageup": "take_off",
    "pagedown": "land",
    "+": "faster",
    "-": "slower",
    "l": "lights",
    "k": "snapshot",
    "r": "record",
    "c": "camera",
    "m": "take_control",
    "y": "yes",
    "n": "no",
    "v": "hold.talk",
    "t": "hold.tilt",
    "1": "screen.drive",
    "2": "screen.mission",
    "3": "screen.tasks",
    "4": "screen.inputs",
    "f9": "theme",
    "f1": "help",
    "?": "help",
    "backspace": "back",
}
"""What the keys mean before anybody has said otherwise, by Kivy's names of them."""
FIXED = {"escape": "stop"}
"""What no table changes."""
DRIVING = {26: "w", 4: "a", 22: "s", 7: "d"}
"""Places of the keys that push the left control, to their names on a keyboard as in English: on every other the same four fingers."""
ARROWS = {82: "up", 80: "left", 81: "down", 79: "right"}
"""The same with the right control, and with the only one where a screen has one."""
WORDS = {
    "escape": mark("Esc"),
    "spacebar": mark("Space"),
    "enter": mark("Enter"),
    "tab": mark("Tab"),
    "backspace": mark("Backspace"),
    "pageup": mark("Page Up"),
    "pagedown": mark("Page Down"),
    "home": mark("Home", "key"),
    "end": mark("End", "key"),
    "insert": mark("Ins"),
    "delete": mark("Del"),
    "up": "↑",
    "left": "←",
    "down": "↓",
    "right": "→",
    "numpadadd": mark("+ (number pad)"),
    "numpadsubstract": mark("− (number pad)"),
    "numpadenter": mark("Enter (number pad)"),
    "shift": mark("Shift"),
    "-": "−",
}
TWINS = {"numpadadd": "+", "numpadsubstract": "-", "=": "+", "numpadenter": "enter", "rshift": "shift"}
"""Keys that mean what another one means unless they have a meaning of their own."""
RISES = (0.0, 2.0)
"""From rest to the whole way of a control that a key pushes [s]."""
SLOWS = (0.1, 1.0)
"""Of the whole way, with Shift held as well."""


@dataclass(frozen=True, slots=True)
class KeyTable:
    """How the keyboard is used."""

    on: bool = True
    """Shortcuts and driving; STOP by Escape is there all the same."""
    drives: bool = True
    """W A S D and the arrows drive while held."""
    space_stops: bool = True
    """Space is STOP where nothing is being typed; without it Space may be a switch."""
    rise: float = 0.3
    """From rest to the whole way [s]; back to rest is at once."""
    slow: float = 0.35
    """Of the whole way, with Shift held."""
    keys: Mapping[str, str] = field(default_factory=lambda: dict(MEANT))
    """Name of a key to what it means; one that is not named means nothing."""

    def meaning(self, key: str) -> str:
        """What a key means, by its name; empty for nothing."""
        if key in FIXED:
            return FIXED[key]
        if key == "spacebar" and self.space_stops:
            return "stop"
        return self.keys.get(key) or self.keys.get(TWINS.get(key, key), "")

    def keys_of(self, meaning: str) -> list[str]:
        """Names of the keys that mean this."""
        fixed = [key for key in (*FIXED, "spacebar") if self.meaning(key) == meaning]
        return fixed + [key for key, meant in self.keys.items() if meant == meaning and key not in fixed]

    def with_key(self, key: str, meaning: str) -> KeyTable:
        """The same with this key as the only one of this meaning; empty as the key takes it away. ValueError for a key that is taken."""
        if key in FIXED or (key == "spacebar" and self.space_stops):
            raise ValueError(tr("{key} is STOP and stays it.").format(key=key_words(key)))
        if self.drives and key in (*DRIVING.values(), *ARROWS.values(), "shift", "rshift"):
            raise ValueError(
                tr("{key} drives: choose another key, or let the keys drive no longer.").format(
                    key=key_words(key)
                )
            )
        kept = {name: meant for name, meant in self.keys.items() if meant != meaning and name != key}
        return replace(self, keys=kept | ({key: meaning} if key else {}))

    def kept(self) -> dict[str, Any]:
        """As JSON, for the settings."""
        return asdict(self)


def key_words(key: str) -> str:
    """What is printed on a key."""
    return tr(WORDS.get(key, key.upper() if len(key) < 4 else key.capitalize()))


def read(kept: object, meanings: Mapping[str, object] | None = None) -> tuple[KeyTable, list[str]]:
    """The table as the settings have it, and one sentence for each thing in it that cannot be; that is as it was at first.

    `meanings` are those that there are; None for any.
    """
    if not isinstance(kept, Mapping):
        return KeyTable(), [] if kept is None else [
            tr("The keys are not a table but {kept}.").format(kept=shown(kept))
        ]
    wrong: list[str] = []
    flags = {name: _flag(kept, name, wrong) for name in ("on", "drives", "space_stops")}
    usual = KeyTable()
    rise, slow = (
        _number(kept, name, ends, getattr(usual, name), wrong)
        for name, ends in (("rise", RISES), ("slow", SLOWS))
    )
    keys = _keys(kept["keys"], meanings, wrong) if "keys" in kept else dict(MEANT)
    return KeyTable(rise=rise, slow=slow, keys=keys, **flags), wrong


def _flag(kept: Mapping[Any, Any], name: str, wrong: list[str]) -> bool:
    value = kept.get(name, True)
    if not isinstance(value, bool):
        wrong.append(
            tr("The keys' {name} is true or false, not {value}: true is used.").format(
                name=name, value=shown(value)
            )
        )
        return True
    return value


def _number(
    kept: Mapping[Any, Any], name: str, ends: tuple[float, float], usual: float, wrong: list[str]
) -> float:
    value = kept.get(name, usual)
    if (found := number(value, *ends)) is not None:
        return found
    wrong.append(
        tr("The keys' {name} is from {ends} to {ends2}, not {value}: {usual} is used.").format(
            name=name, ends=ends[0], ends2=ends[1], value=shown(value), usual=usual
        )
    )
    return usual


def _keys(table: object, meanings: Mapping[str, object] | None, wrong: list[str]) -> dict[str, str]:
    if not isinstance(table, Mapping):
        wrong.append(tr("The meanings of the keys are not a table but {table}.").format(table=shown(table)))
        return dict(MEANT)
    found = {}
    for key, meaning in table.items():
        meant = isinstance(meaning, str) and (not meaning or meanings is None or meaning in meanings)
        if isinstance(key, str) and meant and key not in FIXED:
            found[key] = meaning
        else:
            wrong.append(
                tr("No key {key} can mean {meaning}.").format(key=shown(key), meaning=shown(meaning))
            )
    return found

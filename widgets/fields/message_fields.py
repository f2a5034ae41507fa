"""Fields of a message in words: rows of a tree, figures, summaries of arrays. No Kivy."""

from __future__ import annotations

import math
import re
import time
from array import array
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from bridge.msgs import Msg
from bridge.msgs.std_msgs import Duration, Time
from widgets.core.language import figure, tr
from widgets.fields.meanings import meaning_of

__all__ = [
    "ARRAY",
    "BRANCH",
    "DASH",
    "LEAF",
    "MORE",
    "Row",
    "clock",
    "describe",
    "number",
    "rows",
    "size_text",
    "spelled",
    "unit",
]

Path = tuple[str | int, ...]
"""Way to a field from the message: names of fields, and numbers for what is in a list."""

LEAF, ARRAY, BRANCH, MORE = "leaf", "array", "branch", "more"
"""Kinds of rows: a value, an array or a long text on two lines, something to fold, and what a list holds beyond the bound."""
DASH, MINUS = "—", "−"
MAX_ITEMS = 50
"""So many parts of a list have rows of their own."""
MAX_UNFOLDED_ROWS = 40
"""A message of at most so many rows is shown unfolded."""
MAX_VALUES = 6
"""Values of an array that are written out."""
MAX_SHORT_TEXT = 22
"""A text of more letters has a line of its own."""
MAX_TEXT_LENGTH = 400
"""Letters of a text that are shown on its line."""
MAX_LETTERS, MAX_LINES = 1000, 40
"""Letters and lines of a text that are shown when it is opened: no picture for a graphics card may be too high."""
NUMBER = re.compile(r"(?:u?int(?:8|16|32|64)|float(?:32|64)|byte|char)(?:\[.*)?")
"""ROS types of numbers."""
DECIMALS = 4
SMALL, LARGE = 0.5 * 10**-DECIMALS, 1e7
"""Between these a number is written plainly, beyond them with an exponent."""
EPOCH = 1e8
"""A time below this [s] counts from the start of a simulation, not from 1970."""
CLOCK_UNCERTAINTY = 0.3
"""The robot's clock is known to about this [s]: what is less ahead of it is from now."""
MAX_AGE = 86400.0
"""An age is shown up to this [s]; beyond it the clocks are different ones."""


@dataclass(frozen=True, slots=True)
class Row:
    """One line of the tree."""

    kind: str
    """`LEAF`, `ARRAY`, `BRANCH` or `MORE`."""
    path: Path
    depth: int
    name: str
    type: str
    """The field's ROS type as in `float64[36]`; empty where the message does not say."""
    value: Any
    open: bool = False
    """Of a branch: what is in it follows. Of a long text: all of it is shown."""
    unit: str = ""
    """Of the field, or of the message that it is in, as the definition writes it: `m/s2`; empty where it is not known."""
    meaning: str = ""
    """What the message's definition calls that value; empty where it has no name."""

    @property
    def long_text(self) -> bool:
        """A text on a line of its own, which may be too long for that."""
        return self.kind == ARRAY and isinstance(self.value, str)


@lru_cache(maxsize=512)
def _table(kind: type[Msg]) -> tuple[tuple[str, str, str], ...]:
    """Name, ROS type and unit of each field of a message class."""
    names: tuple[str, ...] = kind.__struct_fields__
    types: tuple[str, ...] = getattr(kind, "ROSTYPES", ())
    if len(types) != len(names):
        types = ("",) * len(names)
    told = getattr(kind, "UNITS", None)
    units = told if isinstance(told, dict) else {}  # a learned type may have a constant of that name
    return tuple((name, rostype, units.get(name, "")) for name, rostype in zip(names, types, strict=True))


@lru_cache(maxsize=512)
def _common_unit(kind: type[Msg], outer: str) -> str:
    """Of all numbers of a message class in a field of the unit `outer`: `angular_velocity` is in rad/s, and so is its x.

    Empty where it holds anything else than numbers, of which the word outside is not true, or numbers of several units.
    """
    fields = _table(kind)
    units = {unit for _, _, unit in fields}
    if len(units) != 1 or not all(NUMBER.fullmatch(rostype) for _, rostype, _ in fields):
        return ""
    return units.pop() or outer


def rows(message: Msg, folds: Mapping[Path, bool]) -> list[Row]:
    """The message as lines from top to bottom. `folds` says of branches whether they are open; others decide themselves.

    Of a list the first 50 parts have rows, so that no message makes the tree endless.
    """
    few = _count(message, MAX_UNFOLDED_ROWS) <= MAX_UNFOLDED_ROWS
    return list(_fields(message, (), 0, folds, few))


def _fields(
    msg: Msg, path: Path, depth: int, folds: Mapping[Path, bool], few: bool, outer: str = ""
) -> Iterator[Row]:
    common = _common_unit(type(msg), outer)
    for name, kind, unit in _table(type(msg)):
        value = getattr(msg, name)
        for row in _row(value, (*path, name), depth, (name, kind, unit or common), folds, few):
            meaning = meaning_of(type(msg), name, value) if row.kind == LEAF and type(value) is int else ""
            yield replace(row, meaning=meaning) if meaning else row


def _row(
    value: Any, path: Path, depth: int, label: tuple[str, str, str], folds: Mapping[Path, bool], few: bool
) -> Iterator[Row]:
    name, kind, unit = label
    parts = _is_parts(value)
    if not parts and (not isinstance(value, Msg) or _is_time(value)):
        opened = isinstance(value, str) and folds.get(path, False)
        yield Row(ARRAY if _needs_line(value) else LEAF, path, depth, name, kind, value, opened, unit)
        return
    usual = few and not _is_header(value) if not parts else depth == 0
    opened = folds.get(path, usual)
    yield Row(
        BRANCH, path, depth, name, kind, value, opened, unit if parts else _common_unit(value.__class__, unit)
    )
    if not opened:
        return
    if not parts:
        yield from _fields(value, path, depth + 1, folds, few, unit)
        return
    inner = kind.partition("[")[0]
    for index, part in enumerate(value[:MAX_ITEMS]):
        yield from _row(part, (*path, index), depth + 1, (f"[{index}]", inner, unit), folds, few=False)
    if len(value) > MAX_ITEMS:
        yield Row(MORE, (*path, -1), depth + 1, f"and {len(value) - MAX_ITEMS} more", "", None)


def _count(msg: Msg, most: int) -> int:
    """How many rows a message has unfolded; stops counting beyond `most`."""
    count = 0
    for name, _, _ in _table(type(msg)):
        value = getattr(msg, name)
        count += 1
        if isinstance(value, Msg) and not _is_time(value):
            count += _count(value, most - count)
        elif _is_parts(value):
            count += len(value)
        if count > most:
            break
    return count


def _is_time(value: object) -> bool:
    """A time or a duration."""
    return isinstance(value, Time)


def _is_header(value: object) -> bool:
    """A header of any class: a learned type may bring its own."""
    return isinstance(value, Msg) and value.MSGTYPE == "std_msgs/Header"


def _is_parts(value: object) -> bool:
    """A list whose parts are messages or texts, so that each has a row of its own."""
    return isinstance(value, list | tuple) and bool(value) and isinstance(value[0], Msg | str)


def _needs_line(value: object) -> bool:
    if isinstance(value, str):
        return len(value) > MAX_SHORT_TEXT
    return isinstance(value, list | tuple | array | np.ndarray) and len(value) > 0


# a value in words


def number(value: float) -> str:
    """A number of always as many decimals, a dash for NaN; whole numbers in groups of three from 10 000 on."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        text = f"{value:,}".replace(",", " ") if abs(value) >= 10_000 else str(value)
    elif math.isnan(value):
        return DASH
    elif math.isinf(value):
        text = "inf" if value > 0 else "-inf"
    elif value and not SMALL <= abs(value) < LARGE:
        text = f"{value:.3e}"
    else:
        text = f"{value:.{DECIMALS}f}"
        text = text if value else text.lstrip("-")
    return text.replace("-", MINUS)


def size_text(count: int) -> str:
    """So many bytes, as in `45.1 kB`."""
    if count < 1000:
        return f"{count} B"
    return f"{count / 1000:.1f} kB" if count < 1_000_000 else f"{count / 1_000_000:.1f} MB"


def clock(stamp: float, now: float = math.nan) -> str:
    """A time [s] as `14:02:11.120` by this device's zone, and how long ago that is where `now` [s] is known.

    A dash for 0, which is a stamp that was never set.
    """
    if not stamp or not math.isfinite(stamp):
        return DASH
    whole, thousandths = divmod(round(stamp * 1000), 1000)
    if whole < EPOCH:
        hours, rest = divmod(whole, 3600)
        text = f"{hours:02d}:{rest // 60:02d}:{rest % 60:02d}"
    else:
        text = time.strftime("%H:%M:%S", time.localtime(whole))
    text = f"{text}.{thousandths:03d}"
    age = now - stamp
    if not abs(age) < MAX_AGE:
        return text
    return (
        f"{text} · " + tr("{age} s ahead").format(age=figure(abs(age), 1))
        if age < -CLOCK_UNCERTAINTY
        else f"{text} · " + tr("{age} s ago").format(age=figure(max(0.0, age), 1))
    )


def describe(row: Row, now: float = math.nan) -> tuple[str, str]:
    """The value of a row, and its second line; `now` is the robot's clock [s], NaN while it is not known."""
    value = row.value
    if row.kind == MORE:
        return "", ""
    if row.kind == BRANCH:
        return _summary(value, now, opened=row.open), ""
    if isinstance(value, str):
        line = _whole(value) if row.open else _one_line(value)
        return ("", line) if row.kind == ARRAY else (value or "empty", "")
    if row.kind == ARRAY:
        return _array(value, spelled(row.unit))
    plain = _plain(value, now)
    return (f"{plain} · {row.meaning}" if row.meaning else plain), ""


def unit(row: Row) -> str:
    """What stands behind the value of a row, as in `m/s²`; empty where that is no number or its unit is unknown.

    Of an array it stands in the second line.
    """
    value = row.value
    if row.kind == BRANCH:
        closed = isinstance(value, Msg) and not row.open
        figures = closed and _is_figures([getattr(value, name) for name, _, _ in _table(value.__class__)])
        return spelled(row.unit) if figures else ""
    number_alone = row.kind == LEAF and isinstance(value, int | float) and not isinstance(value, bool)
    return spelled(row.unit) if number_alone else ""


@lru_cache(maxsize=256)
def spelled(unit: str) -> str:
    """A unit of a ROS text as people write it: `m/s²` for `m/s2` or `m/s^2`, `°C` for `degC`."""
    unit = re.sub(r"\bdeg(?=[CF]?(?:\b|\d))", "°", unit).replace("*", "·")
    return re.sub(r"(?<=[A-Za-z°)])\^?([23])(?!\d)", lambda found: "²³"[int(found[1]) - 2], unit)


def _plain(value: Any, now: float) -> str:
    """A value that is neither array nor message."""
    if value is None:
        return DASH
    if isinstance(value, int | float):
        return number(value)
    if isinstance(value, bytes | bytearray | memoryview):
        return size_text(len(value))
    if isinstance(value, Msg):
        return _moment(value, now)
    return str(value) if isinstance(value, str) else "empty"


def _moment(value: Any, now: float) -> str:
    """A time as the clock's, a duration in seconds."""
    seconds = value.secs + value.nsecs * 1e-9
    return f"{seconds:.3f} s".replace("-", MINUS) if isinstance(value, Duration) else clock(seconds, now)


def _one_line(text: str) -> str:
    return " ".join(text[:MAX_TEXT_LENGTH].split())


def _whole(text: str) -> str:
    """A text with its lines, as many as fit on the screen, and how much more there is."""
    shown = "".join(text[:MAX_LETTERS].splitlines(keepends=True)[:MAX_LINES])
    rest = len(text) - len(shown)
    lines = shown.expandtabs(4).splitlines()
    return "\n".join([*lines, tr("… and {rest} more letters").format(rest=number(rest))] if rest else lines)


def _is_figures(parts: list[Any]) -> bool:
    """Few enough numbers to stand side by side."""
    return 0 < len(parts) <= 3 and all(isinstance(part, float) for part in parts)


def _summary(value: Any, now: float, *, opened: bool) -> str:
    """What stands beside the name of something that can be folded."""
    if isinstance(value, list | tuple):
        return str(len(value))
    if opened:
        return ""
    if _is_header(value):
        return _moment(value.stamp, now)
    parts = [getattr(value, name) for name, _, _ in _table(value.__class__)]
    if _is_figures(parts):
        return "  ".join(_plainly(part, 2) if math.isfinite(part) else DASH for part in parts)
    texts = [part for part in parts if isinstance(part, str) and part]
    whole = len(texts) == len(parts) <= 2
    return _one_line(" · ".join(texts if whole else texts[:1]))


def _array(value: Any, unit: str) -> tuple[str, str]:
    """How many numbers; then the least and the greatest with their unit, and the first few."""
    with np.errstate(invalid="ignore"):
        numbers = np.asarray(value)
    count = f"{number(len(value))} values"
    if numbers.dtype == bool:
        return count, f"{int(numbers.sum())} true"
    if numbers.dtype.kind not in "iuf":
        return count, ""
    finite = numbers[np.isfinite(numbers)] if numbers.dtype.kind == "f" else numbers
    exponent, decimals = _manner(finite)
    first = "  ".join(_short(one, exponent, decimals) for one in numbers[:MAX_VALUES].tolist())
    if len(numbers) > MAX_VALUES:
        first += " …"
    if not len(finite):
        return count, first
    span = " to ".join(_short(one, exponent, decimals) for one in (finite.min().item(), finite.max().item()))
    return count, f"{span} {unit}   ({first})" if unit else f"{span}   ({first})"


def _manner(finite: np.ndarray) -> tuple[bool, int]:
    """How all figures of an array are written, so that they can be compared: with an exponent, with so many decimals."""
    greatest = float(np.abs(finite).max()) if len(finite) and finite.dtype.kind == "f" else 0.0
    exponent = bool(greatest) and not 0.0005 <= greatest < LARGE
    return exponent, 4 if 0 < greatest < 0.1 else 2


def _short(value: float, exponent: bool, decimals: int) -> str:
    """A number among many."""
    if not isinstance(value, float) or not math.isfinite(value):
        return number(value)
    return f"{value:.0e}".replace("-", MINUS) if exponent else _plainly(value, decimals)


def _plainly(value: float, decimals: int) -> str:
    """So many decimals and a real minus sign, which nothing that is written as 0 has."""
    text = f"{value:.{decimals}f}"
    return text.lstrip("-") if not text.strip("-0.") else text.replace("-", MINUS)

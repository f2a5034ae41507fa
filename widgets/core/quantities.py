"""Figures for people in the unit the operator chose; whatever goes to a robot stays in SI.

    said(0.62, "speed")                 # Figure(text="0.62", unit="m/s"); with knots Figure(text="1.21", unit="kn")
    said(1850.0, "distance").words      # "1.9 km"
    read("3,5", "speed")                # what is typed in the shown unit, in SI

Widgets bind `quantities.system` where they draw anew by themselves. `figure` gives decimals as the language writes them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import NamedTuple

from kivy.event import EventDispatcher
from kivy.properties import OptionProperty

from widgets.core.language import DASH, brief_figure, figure, mark, tr

__all__ = [
    "DASH",
    "KINDS",
    "SI_KINDS",
    "SYSTEMS",
    "Figure",
    "Quantities",
    "Unit",
    "digits_for",
    "from_shown",
    "quantities",
    "quantity_words",
    "read",
    "round_floor",
    "round_length",
    "said",
    "to_shown",
    "unit_of",
]

NO_BREAK = "\u00a0"
"""Between a figure and its unit: they are not torn apart at the end of a line."""
CLOSE_UNITS = ("°", "″", "′", "")
"""Units that stand at the figure without a space."""


class Unit(NamedTuple):
    """One unit: how it is written and what is one of it in SI."""

    sign: str
    si: float
    """SI units in one of these; `offset` SI units are its zero."""
    digits: int
    """Decimals that are usual near 1."""
    offset: float = 0.0
    least: float = 0.0
    """From how many of these on it is taken, where its kind has several."""


METRE, FOOT, MILE, NAUTICAL_MILE = Unit("m", 1.0, 1), Unit("ft", 0.3048, 0), 1609.344, 1852.0
_SPEED, _KNOTS, _MPH = (
    Unit("m/s", 1.0, 2),
    Unit("kn", NAUTICAL_MILE / 3600, 2),
    Unit("mph", MILE / 3600, 2),
)
_NEAR = (Unit("cm", 0.01, 0), Unit("m", 1.0, 2, least=0.995), Unit("m", 1.0, 1, least=9.95))
_NEAR_FEET = (Unit("in", 0.0254, 0), Unit("ft", 0.3048, 1, least=0.995), Unit("ft", 0.3048, 0, least=29.5))
_FAR = (Unit("m", 1.0, 0), Unit("km", 1000.0, 1, least=0.9995))
_AREA = (Unit("m²", 1.0, 0), Unit("ha", 1e4, 1, least=0.995))
_KELVIN = 273.15
SYSTEMS = {
    "metric": mark("Metric: m, m/s, °C"),
    "imperial": mark("Imperial: ft, mph, °F"),
    "nautical": mark("Nautical: m, knots, nautical miles"),
}
"""Name of each system of units to the words for it."""
KINDS: dict[str, dict[str, tuple[Unit, ...]]] = {
    "speed": {"metric": (_SPEED,), "imperial": (_MPH,), "nautical": (_KNOTS,)},
    "distance": {
        "metric": _FAR,
        "imperial": (Unit("ft", 0.3048, 0), Unit("mi", MILE, 1, least=0.5)),
        "nautical": (Unit("m", 1.0, 0), Unit("nmi", NAUTICAL_MILE, 1, least=0.5)),
    },
    "length": {"metric": _NEAR, "imperial": _NEAR_FEET, "nautical": _NEAR},
    "height": {"metric": (METRE,), "imperial": (FOOT,), "nautical": (METRE,)},
    "area": {
        "metric": _AREA,
        "imperial": (Unit("ft²", 0.3048**2, 0), Unit("acres", 4046.8564224, 1, least=0.5)),
        "nautical": _AREA,
    },
    "temperature": {
        "metric": (Unit("°C", 1.0, 1),),
        "imperial": (Unit("°F", 5 / 9, 0, offset=-160 / 9),),
        "nautical": (Unit("°C", 1.0, 1),),
    },
    "pressure": {
        "metric": (Unit("hPa", 100.0, 0),),
        "imperial": (Unit("inHg", 3386.389, 2),),
        "nautical": (Unit("hPa", 100.0, 0),),
    },
    "mass": {
        "metric": (Unit("kg", 1.0, 1),),
        "imperial": (Unit("lb", 0.45359237, 1),),
        "nautical": (Unit("kg", 1.0, 1),),
    },
    "acceleration": {
        "metric": (Unit("m/s²", 1.0, 1),),
        "imperial": (Unit("ft/s²", 0.3048, 0),),
        "nautical": (Unit("m/s²", 1.0, 1),),
    },
    "angle": {name: (Unit("°", math.pi / 180, 0),) for name in ("metric", "imperial", "nautical")},
}
"""Kind to system to its units, the finest first. In SI: m/s, m, m², °C, Pa, kg, m/s² and rad, as ROS has them; °C for K."""
SI_KINDS = {
    "m/s": "speed",
    "m": "height",
    "m²": "area",
    "°C": "temperature",
    "Pa": "pressure",
    "kg": "mass",
    "m/s²": "acceleration",
}
"""Unit that the makers of a screen write, to the kind of what is in it; what is in other units is shown as it is."""
_NUMBER = re.compile(r"([+\-−]?\s*(?:\d+(?:[.,]\d*)?|[.,]\d+))\s*(.*)", re.DOTALL)


class Quantities(EventDispatcher):
    """The units of the glass."""

    system = OptionProperty("metric", options=list(SYSTEMS))
    """One of `SYSTEMS`."""


quantities = Quantities()
"""The one choice of units of this process."""


class Figure(NamedTuple):
    """A value as it is shown."""

    text: str
    """The figure alone; a dash for what there is not."""
    unit: str
    """Empty where the figure is a dash of no unit."""

    @property
    def words(self) -> str:
        """Both, as in `0.62 m/s`, which no line breaks."""
        gap = "" if self.unit in CLOSE_UNITS else NO_BREAK
        return f"{self.text}{gap}{self.unit}" if self.text != DASH else DASH


def _units(kind: str) -> tuple[Unit, ...]:
    return KINDS[kind][quantities.system]


def _steady(kind: str) -> Unit:
    """The unit of a kind that does not change with the value: that of fields, tapes and steppers."""
    units = _units(kind)
    return next((unit for unit in units if unit.sign in ("m", "ft", "m²", "ft²")), units[0])


def _fitting(value: float, kind: str) -> Unit:
    units, size = _units(kind), abs(value)
    found = units[0]
    for unit in units[1:]:
        if size >= unit.least * unit.si:
            found = unit
    return found


def unit_of(kind: str) -> str:
    """Sign of the unit in which a field of that kind is shown and typed."""
    return _steady(kind).sign


def to_shown(value: float, kind: str) -> float:
    """`value` in SI, in `unit_of(kind)`."""
    unit = _steady(kind)
    return (value - unit.offset) / unit.si


def from_shown(value: float, kind: str) -> float:
    """`value` in `unit_of(kind)`, in SI."""
    unit = _steady(kind)
    return value * unit.si + unit.offset


def digits_for(kind: str, digits: int) -> int:
    """So many decimals in the shown unit tell as much as `digits` in SI's (a foot is shorter than a metre)."""
    unit = _steady(kind)
    usual = KINDS[kind]["metric"]
    metric = next((one for one in usual if one.sign in ("m", "m²")), usual[0])
    return max(0, digits - math.floor(math.log10(metric.si / unit.si) + 0.5))


def said(value: float | None, kind: str, digits: int | None = None, *, signed: bool = False) -> Figure:
    """`value` in SI as people read it; `digits` decimals of SI's unit in a unit that stays, else as fits the value.

    None, NaN and infinity are a dash. KeyError for a kind that is not in `KINDS`.
    """
    if value is None or not math.isfinite(value):
        return Figure(DASH, _steady(kind).sign)
    if digits is None:
        unit = _fitting(value, kind)
        shown, places = (value - unit.offset) / unit.si, unit.digits
    else:
        unit = _steady(kind)
        shown, places = to_shown(value, kind), digits_for(kind, digits)
    text = figure(shown, places)
    if signed and shown > 0 and any(digit in text for digit in "123456789"):
        text = f"+{text}"
    return Figure(text, unit.sign)


def read(text: str, kind: str) -> float:
    """What is typed, in SI: a number in the shown unit, or with any unit of that kind behind it, with a point or a comma.

    Raises ValueError with one sentence for anything else.
    """
    unit = _steady(kind)
    match = _NUMBER.fullmatch(text.strip())
    wanted = match.group(2).strip() if match else ""
    known = {one.sign: one for units in KINDS[kind].values() for one in units}
    if match is None or (wanted and wanted not in known):
        raise ValueError(
            tr("A number is needed, as in {example}, not {text}.").format(
                example=Figure(figure(1.5, 1), unit.sign).words, text=repr(text)
            )
        )
    taken = known[wanted] if wanted else unit
    number = float(match.group(1).replace("−", "-").replace(",", ".").replace(" ", ""))
    return number * taken.si + taken.offset


def quantity_words(value: float, kind: str) -> str:
    """A figure of a robot's sentence with its unit; `kind` as of `bridge.core.units.UNITS`, `value` in the unit there."""
    return _WRITTEN[kind](value)


def _duration(seconds: float) -> str:
    whole = abs(seconds - round(seconds)) < 0.05
    return f"{figure(seconds, 0 if whole else 1)}{NO_BREAK}s"


_WRITTEN: Mapping[str, Callable[[float], str]] = {
    "length": lambda value: said(value, "length").words,
    "height": lambda value: said(value, "height", 1).words,
    "speed": lambda value: said(value, "speed").words,
    "angle": lambda value: said(value, "angle").words,
    "turn": lambda value: f"{figure(math.degrees(value))}°/s",
    "duration": _duration,
    "share": lambda value: f"{figure(value * 100)}{NO_BREAK}%",
}


def round_floor(most: float) -> float:
    """The greatest of 1, 2, 5 times a power of ten that is not above `most` (> 0)."""
    power = 10.0 ** math.floor(math.log10(most) + 1e-9)
    return next(step * power for step in (5.0, 2.0, 1.0) if step * power <= most * (1 + 1e-9))


def round_length(most: float) -> tuple[float, str]:
    """The longest round length that is not above `most` [m, > 0], in SI, and in words: `5 m`, `20 ft`, `2 nmi`."""
    units = {
        "metric": (0.01, 1.0, 1000.0),
        "imperial": (0.0254, 0.3048, MILE),
        "nautical": (0.01, 1.0, NAUTICAL_MILE),
    }
    signs = {"metric": ("cm", "m", "km"), "imperial": ("in", "ft", "mi"), "nautical": ("cm", "m", "nmi")}
    rows = list(zip(units[quantities.system], signs[quantities.system], strict=True))
    si, sign = next((row for row in reversed(rows) if most >= row[0] * (1 - 1e-9)), rows[0])
    whole = round_floor(most / si)
    return whole * si, f"{brief_figure(whole)}{NO_BREAK}{sign}"

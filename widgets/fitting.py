"""Which widgets fit a topic, best first: from its message type alone, also of a type that nobody foresaw.

for offer in offers(Odometry, "/odom"):
    print(offer.widget, offer.field, offer.title)      # HeadingTape … Readout twist.twist.linear.x Linear x …

There is no table of types here. Each widget of the catalogue declares what it takes (`RobotWidget.accepts`, `shows_fields`,
`draws`, `Control.to_topic`), so that a new widget is offered as soon as the catalogue has it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import widgets
from bridge.core.topic_choice import command
from bridge.core.topics import TOPICS
from bridge.msgs import TYPES, Msg, ros1_name
from widgets.core.base import Control, RobotWidget
from widgets.fields.field_kinds import ENUM, NUMBER, TEXT, TRUTH, PlainField, plain_fields

__all__ = [
    "COMMAND",
    "FIGURE",
    "INSTRUMENT",
    "LAMP",
    "MAX_FIELD_OFFERS",
    "PICTURE",
    "PLOT",
    "TREE",
    "Offer",
    "best",
    "forget",
    "offers",
]

INSTRUMENT, PICTURE, COMMAND, FIGURE, LAMP, PLOT, TREE = (
    *("instrument", "picture", "command", "figure", "lamp", "plot", "tree"),
)
"""Kinds of offers: a widget made for the type, a camera's video, a control that publishes it, a field as a figure or word, a bool
as a lamp, a field over time, and the whole message as a tree."""
MAX_FIELD_OFFERS = 24
"""Fields of one topic that are offered one by one; the tree has all."""
MAX_SOLE = 2
_SOLE = {LAMP: 0.9, FIGURE: 0.8, PLOT: 0.7}
_AMONG = {LAMP: 0.09, FIGURE: 0.08, PLOT: 0.07}
"""How well a field's widget fits a topic that has at most `MAX_SOLE` fields, and one of more; a tree fits between the two."""
_TREE_FIT = 0.1
_MOTION = ("linear", "angular", "velocity", "speed", "voltage", "percentage", "temperature", "range", "data")
"""Words in the path of a field that people look for first."""


@dataclass(frozen=True, slots=True)
class Offer:
    """One widget for a topic."""

    widget: str
    """Name in `widgets.CATALOGUE`."""
    kind: str
    """One of the constants above."""
    field: str = ""
    """Path of the field that is shown; empty for whole messages."""
    title: str = ""
    """Of the field, or of the topic where it is that field alone; empty for a widget's own name."""
    unit: str = ""
    """In which the field is shown."""
    factor: float = 1.0
    """What the field is multiplied by to be in `unit`."""
    digits: int = 0
    """Decimals of a figure."""
    names: Mapping[int, str] = dataclasses.field(default_factory=lambda: MappingProxyType({}))
    """Value to name, of a field whose values have names."""
    size: tuple[int, int] = (3, 4)
    """Columns and rows that become it on a grid of 12 x 12 that fills a tablet."""
    fit: float = 0.0
    """How well it fits, 0 to 1."""

    @property
    def options(self) -> dict[str, Any]:
        """Keyword arguments with which the widget is made."""
        kind = getattr(widgets, self.widget)
        wanted = {
            "path": self.field,
            "paths": [self.field] if self.field else [],
            "name": self.title,
            "title": self.title,
            "unit": self.unit,
            "scale": self.factor,
            "decimals": self.digits,
            "value_names": dict(self.names),
        }
        return {
            key: value for key, value in wanted.items() if value not in ("", [], {}) and hasattr(kind, key)
        }


def offers(kind: type[Msg] | str, topic: str = "", *, commanded: bool | None = None) -> tuple[Offer, ...]:
    """The widgets for a topic, best first; never none: the tree of fields is for every type.

    `kind` is the class of its messages, made by hand, generated or learned, or the name of a type. Of a name that
    nobody knows only the tree is offered, which reads what comes. `commanded` says whether the robot takes the topic as
    a command, True, or tells it, False; None judges by the name.
    """
    if isinstance(kind, str):
        known = TYPES.get(ros1_name(kind))
        if known is None:
            return tuple(sorted(_trees(), key=_order))
        kind = known
    if commanded is None:
        commanded = _is_command(kind, topic)
    found = [*_made_for(kind, commanded=commanded), *_for_fields(kind, topic), *_trees()]
    return tuple(sorted(found, key=_order))


def best(kind: type[Msg] | str, topic: str = "", *, commanded: bool | None = None) -> Offer:
    """The first of `offers`."""
    return offers(kind, topic, commanded=commanded)[0]


def _order(offer: Offer) -> tuple[float, str]:
    return -offer.fit, offer.widget


def _is_command(kind: type[Msg], topic: str) -> bool | None:
    """True for a topic whose name says that the robot takes it, False for one that it tells, None for any other."""
    known = next((one for one in TOPICS if one.name == topic and one.type is kind), None)
    if known is not None:
        return known.to == "robot"
    if command({topic: kind.MSGTYPE}) is not None or any(
        part in ("cmd", "command", "set") for part in topic.replace("_", "/").split("/")
    ):
        return True
    return None


@lru_cache(maxsize=1)
def _kinds() -> tuple[tuple[str, type[RobotWidget]], ...]:
    """The robot widgets of the catalogue by name; imports all of them when it is first asked."""
    found = ((name, getattr(widgets, name)) for name in widgets.CATALOGUE)
    return tuple((name, kind) for name, kind in found if issubclass(kind, RobotWidget))


def _made_for(kind: type[Msg], *, commanded: bool | None) -> Iterator[Offer]:
    for name, widget in _kinds():
        size = widget.grid_size
        if issubclass(widget, Control):
            if commanded is not False and widget.to_topic and issubclass(kind, widget.sends):
                yield Offer(
                    name, COMMAND, size=size, fit=_fit(widget, kind, widget.sends, commanded=commanded)
                )
        elif commanded:
            continue
        elif issubclass(kind, widget.draws):
            yield Offer(name, PICTURE, size=size, fit=1.0)
        elif issubclass(kind, shown := _own(widget)):
            yield Offer(name, INSTRUMENT, size=size, fit=_fit(widget, kind, shown))


def _own(widget: type[RobotWidget]) -> tuple[type[Msg], ...]:
    """Types of which a widget is a picture by themselves."""
    return tuple(one for one in widget.accepts if one is not Msg and one not in widget.shown_beside)


def _fit(
    widget: type[RobotWidget], kind: type[Msg], types: tuple[type[Msg], ...], *, commanded: bool | None = True
) -> float:
    """What a widget declares, or the better the fewer other types it takes and the earlier it names this one."""
    place = next(number for number, one in enumerate(types) if issubclass(kind, one))
    told = widget.specificity if widget.specificity is not None else 1 / len(types) - 0.01 * place
    return max(told, 0.2) if commanded else max(told, 0.2) * 0.6


def _for_fields(kind: type[Msg], topic: str) -> Iterator[Offer]:
    fields = plain_fields(kind)
    sole = len(fields) <= MAX_SOLE
    order = sorted(range(len(fields)), key=lambda number: (_rank(fields[number]), number))
    for place, number in enumerate(order[:MAX_FIELD_OFFERS]):
        one = fields[number]
        title = one.title or _title(topic)
        for name, widget in _kinds():
            if one.kind not in widget.shows_fields:
                continue
            sort = _sort(widget, one.kind)
            fit = (_SOLE if sole else _AMONG)[sort] - 0.0001 * place
            yield Offer(
                name,
                sort,
                one.path,
                title,
                one.unit,
                one.factor,
                one.digits,
                one.names,
                widget.grid_size,
                fit,
            )


def _sort(widget: type[RobotWidget], kind: str) -> str:
    if kind == TRUTH and widget.shows_fields == (TRUTH,):
        return LAMP
    return PLOT if widget.over_time else FIGURE


def _rank(one: PlainField) -> int:
    """0 for what people look for first, then further numbers, states, truths, texts."""
    if one.kind == NUMBER and any(word in one.path.lower() for word in _MOTION):
        return 0
    return {NUMBER: 1, ENUM: 1, TRUTH: 2, TEXT: 3}[one.kind]


def _trees() -> Iterable[Offer]:
    """Widgets that show whole messages of any type."""
    return [
        Offer(name, TREE, size=widget.grid_size, fit=_TREE_FIT)
        for name, widget in _kinds()
        if Msg in widget.accepts and not widget.shows_fields
    ]


def _title(topic: str) -> str:
    """The end of a topic's name as people write it: `/cabin/door_open` as `Door open`."""
    words = topic.rsplit("/", 1)[-1].replace("_", " ").strip()
    return words[:1].upper() + words[1:]


def forget() -> None:
    """Look at the catalogue anew: it was changed."""
    _kinds.cache_clear()

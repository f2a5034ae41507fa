"""Whether rows are such as a program has written: SQLite keeps any value in any column, and a damaged file has some."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from functools import cache
from typing import Any

from sqlalchemy import inspect

from robotside.records.database.tables import Base

__all__ = ["Unsound", "check_columns", "check_counters"]

_COUNTERS = {
    "last mission": "missions",
    "last place": "places",
    "last order": "queue",
    "last scheduled": "schedule",
    "last run": "runs",
    "last event": "events",
    "last answer": "answers",
}
"""The facts that count the rows of a table, whose numbers are never given twice."""
_NUMBERS = (*_COUNTERS, "mission", "under way", "queue revision")
_NUMBER = re.compile(r"\d{1,15}", re.ASCII)


class Unsound(ValueError):
    """No program has written this; the text is one sentence."""


def check_columns(row: Base) -> None:
    """Raises TypeError or ValueError when a column holds what it may not: another type, nothing, no finite number."""
    for name, wanted in _columns(type(row)):
        value = getattr(row, name)
        if not isinstance(value, wanted):
            raise TypeError(f"{name} is {type(value).__name__}")
        if isinstance(value, float) and not math.isfinite(value):
            raise ValueError(f"{name} is {value}")


@cache
def _columns(model: type[Base]) -> list[tuple[str, tuple[type, ...]]]:
    """Each column, and what its values may be."""
    found = []
    for column in inspect(model).columns:
        wanted = column.type.python_type
        types = (int, float) if wanted is float else (wanted,)
        found.append((column.key, (*types, type(None)) if column.nullable else types))
    return found


def check_counters(content: Mapping[str, dict[Any, Any]]) -> None:
    """Bring counters up to the numbers that were given; raises Unsound for a fact that is not the number it must be."""
    facts = content["facts"]
    for name in _NUMBERS:
        if name in facts and not _NUMBER.fullmatch(facts[name]):
            raise Unsound(f"The database is damaged (its fact {name!r} is {facts[name][:20]!r}, no number).")
    for name, table in _COUNTERS.items():
        given = max(content[table], default=0)
        if given > int(facts.get(name, 0)):
            facts[name] = str(given)

"""Orders and events of the voice process as lines of JSON."""

from __future__ import annotations

import json
from dataclasses import asdict
from dataclasses import fields as dataclass_fields
from typing import Any

from app.inputs.voice.interfaces.speech_recognizer import (
    Event,
    Grammar,
    Level,
    Partial,
    Rejected,
    Result,
    State,
)

__all__ = ["THERE", "event_line", "grammar_fields", "read_event", "read_grammar"]

THERE = '{"there": true}'
"""An order that asks whether it is there, and the line that answers it."""
KINDS: dict[str, type[Event]] = {kind.__name__: kind for kind in (Partial, Result, Rejected, Level, State)}


def event_line(event: Event) -> str:
    """One line; NaN and infinities as Python's json writes them."""
    return json.dumps({"event": type(event).__name__, **asdict(event)})


def read_event(line: str) -> Event:
    """The event of a line; ValueError for anything else."""
    try:
        fields = json.loads(line)
        kind = KINDS[fields.pop("event")]
        if kind is Result:
            fields["alternatives"] = tuple((str(name), float(sure)) for name, sure in fields["alternatives"])
        if not all(_fits(one.type, fields[one.name]) for one in dataclass_fields(kind) if one.name in fields):
            raise TypeError("a value of another kind")
        return kind(**fields)
    except (AttributeError, KeyError, TypeError, OverflowError) as problem:
        raise ValueError(f"No event: {line[:80]!r}.") from problem


def _fits(kind: Any, value: object) -> bool:
    """The value is of the kind that the field says: a broken process may write anything."""
    if kind == "float":
        return isinstance(value, int | float) and not isinstance(value, bool)
    if kind == "bool":
        return isinstance(value, bool)
    if kind == "str":
        return isinstance(value, str)
    return isinstance(value, tuple | dict)


def grammar_fields(grammar: Grammar) -> dict[str, Any]:
    """For JSON."""
    return {
        "phrases": {command: list(said) for command, said in grammar.phrases.items()},
        "language": grammar.language,
        "urgent": sorted(grammar.urgent),
        "asked": sorted(grammar.asked),
    }


def read_grammar(fields: dict[str, Any]) -> Grammar:
    """The same back."""
    return Grammar(
        {command: tuple(said) for command, said in fields["phrases"].items()},
        fields["language"],
        frozenset(fields["urgent"]),
        frozenset(fields["asked"]),
    )

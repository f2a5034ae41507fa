"""The erasure of a person's name from what happened: events, the history of tasks, answers and STOP.

What people wrote themselves (places, missions, messages of tasks) is theirs to change. Backups and files that were moved aside have the
name until they are let go of.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import TypeVar

import msgspec

from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import Event, TaskRun
from robotside.records.database.audit_rows import ERASED
from robotside.records.ledger import Ledger

__all__ = ["erase"]

T = TypeVar("T", Event, TaskRun)


def erase(ledger: Ledger, name: str) -> None:
    """Put `erased` in the place of `name` wherever it stands as a word of its own; an empty name is nobody's."""
    if not name.strip():
        return
    # not \b: a name may begin or end with anything
    without = partial(re.compile(rf"(?<!\w){re.escape(name)}(?!\w)").sub, ERASED)
    with ledger.together():
        for key, event in list(ledger.rows("events").items()):
            clean = _event(event, without)
            if clean != event:
                ledger.fact("events", key, clean)
        for key, run in list(ledger.rows("runs").items()):
            clean_run = _run(run, without)
            if clean_run != run:
                ledger.fact("runs", key, clean_run)
        for key, answered in list(ledger.rows("answers").items()):
            if without(answered.content) != answered.content:
                ledger.fact("answers", key, None)
        pressed = ledger.rows("facts").get("stopped by", "")
        if pressed and without(pressed) != pressed:
            ledger.fact("facts", "stopped by", without(pressed))


def _event(event: Event, without: Callable[[str], str]) -> Event:
    by = without(event.acknowledged_by)
    clean = msgspec.structs.replace(event, text=without(event.text), acknowledged_by=by)
    return _parameters(clean, without)


def _run(run: TaskRun, without: Callable[[str], str]) -> TaskRun:
    clean = msgspec.structs.replace(run, by=without(run.by), reason=without(run.reason))
    return _parameters(clean, without)


def _parameters(msg: T, without: Callable[[str], str]) -> T:
    pairs = [KeyValue(pair.key, without(pair.value)) for pair in msg.parameters]
    return msgspec.structs.replace(msg, parameters=pairs)

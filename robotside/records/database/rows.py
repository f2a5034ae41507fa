"""Messages to rows and back. A row is named by its table and its key; its value is a message, a text or a `Queued`."""

from __future__ import annotations

import math
from base64 import b64decode
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import msgspec
from sqlalchemy import delete, select
from sqlalchemy.orm import Session

from bridge.codec import from_json, to_json
from bridge.core.errors import BridgeError
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import Event, Mission, Place, ScheduledTask, TaskOrder, TaskRun
from bridge.msgs.std_msgs import Time
from robotside.records.database.audit_rows import AUDIT, head, write_audit
from robotside.records.database.soundness import Unsound, check_columns, check_counters
from robotside.records.database.tables import (
    AnswerRow,
    Base,
    CropRow,
    EventRow,
    FactRow,
    MissionRow,
    PlaceRow,
    QueueRow,
    RunRow,
    ScheduleRow,
    SettingRow,
)

__all__ = [
    "TABLES",
    "Answered",
    "Content",
    "Key",
    "Put",
    "Queued",
    "Unsound",
    "empty",
    "read_all",
    "rows_of",
    "write",
]

MAX_INSTANT = 2**32 * 1_000_000_000
"""What a stamp of ROS holds [ns]."""

Key: TypeAlias = int | str
Content: TypeAlias = dict[str, dict[Key, Any]]
"""Values by table and key."""


class Put(NamedTuple):
    """One row as it shall be."""

    table: str
    key: Key
    value: Any
    """None deletes it."""


class Queued(NamedTuple):
    """An order that waits."""

    position: int
    """From 0, the next one."""
    order: TaskOrder


class Answered(NamedTuple):
    """A command that changed something, and its answer."""

    sender: str
    """The id of who sent it."""
    service: str
    command_id: str
    content: str
    """The answer as JSON."""


@dataclass(frozen=True, slots=True)
class _Table:
    model: type[Base]
    to_row: Callable[[Any], dict[str, Any]]
    """The columns of a value, but for the key."""
    from_row: Callable[[Any], Any]

    @property
    def key(self) -> str:
        """Name of the key's column."""
        return str(next(iter(self.model.__table__.primary_key)).name)


def empty() -> Content:
    """All tables without a row."""
    return {name: {} for name in (*TABLES, AUDIT)}


def rows_of(content: Content) -> list[Put]:
    """All rows."""
    return [Put(table, key, value) for table, rows in content.items() for key, value in rows.items()]


def read_all(session: Session) -> tuple[Content, list[str]]:
    """Everything there is, and a sentence for each table of which rows could not be read; they are left where they are.

    Raises Unsound when the facts are not as any program has ever written them.
    """
    content, problems = empty(), []
    for name, table in TABLES.items():
        bad: list[Key] = []
        for row in session.scalars(select(table.model)):
            key = getattr(row, table.key)
            try:
                check_columns(row)
                content[name][key] = table.from_row(row)
            except (BridgeError, ValueError, TypeError, OverflowError):
                bad.append(key)
        if bad:
            shown = ", ".join(map(repr, bad[:3]))
            problems.append(
                f"{len(bad)} of the {name} in the database cannot be read ({shown}) and are left out."
            )
    content[AUDIT] = head(session)
    check_counters(content)
    return content, problems


def write(session: Session, puts: Iterable[Put]) -> None:
    """Bring the rows to what they shall be; the caller commits."""
    for name, key, value in puts:
        if name == AUDIT:
            write_audit(session, key, value)
            continue
        table = TABLES[name]
        if value is None:
            session.flush()
            session.execute(delete(table.model).where(getattr(table.model, table.key) == key))
        else:
            session.merge(table.model(**{table.key: key}, **table.to_row(value)))


def _text(text: str) -> str:
    """Without the one character that PostgreSQL cannot store."""
    return text.replace("\0", "")


def _known(number: float) -> float | None:
    """None for NaN and infinities: not every number of ours is one for SQL."""
    return number if math.isfinite(number) else None


def _number(stored: float | None) -> float:
    return math.nan if stored is None else stored


def _instant(time: Time) -> int:
    return time.secs * 1_000_000_000 + time.nsecs


def _time(instant: int) -> Time:
    if not 0 <= instant < MAX_INSTANT:
        raise ValueError("no instant")
    return Time(*divmod(instant, 1_000_000_000))


def _json(msg: Any) -> str:
    return to_json(msg).decode()


def _code_row(msg: Event | TaskRun) -> dict[str, Any]:
    """The columns of a code, whom it is about and its parameters, the last as a JSON object."""
    parameters = {_text(pair.key): _text(pair.value) for pair in msg.parameters}
    return {
        "code": _text(msg.code),
        "actor_id": _text(msg.actor_id),
        "parameters": msgspec.json.encode(parameters).decode(),
    }


def _code(row: EventRow | RunRow) -> dict[str, Any]:
    """The fields of `_code_row`, empty in a row of an older program."""
    parameters = msgspec.json.decode(row.parameters or "{}", type=dict[str, str])
    return {
        "code": row.code or "",
        "actor_id": row.actor_id or "",
        "parameters": [KeyValue(key, value) for key, value in parameters.items()],
    }


def _place_row(place: Place) -> dict[str, Any]:
    return {
        "name": _text(place.name),
        "kind": _text(place.kind),
        "floor": _text(place.floor),
        "x": place.x,
        "y": place.y,
        "yaw": _known(place.yaw),
        "tag": _text(place.tag),
        "note": _text(place.note),
        "height": _known(place.height),
    }


def _place(row: PlaceRow) -> Place:
    yaw, height = _number(row.yaw), row.height or 0.0
    return Place(row.id, row.name, row.kind, row.floor, row.x, row.y, yaw, row.tag, row.note, height)


def _run_row(run: TaskRun) -> dict[str, Any]:
    return {
        "task": _text(run.order.task),
        "started": _instant(run.started),
        "ended": _instant(run.ended),
        "state": _text(run.state),
        "reason": _text(run.reason),
        "distance": run.distance,
        "visited": run.visited,
        "started_by": _text(run.by),
        "content": _json(run.order),
        **_code_row(run),
    }


def _run(row: RunRow) -> TaskRun:
    return TaskRun(
        row.id,
        from_json(row.content, TaskOrder),
        _time(row.started),
        _time(row.ended),
        row.state,
        row.reason,
        row.distance,
        row.visited,
        row.started_by,
        **_code(row),
    )


def _event_row(event: Event) -> dict[str, Any]:
    where = event.position
    return {
        "stamp": _instant(event.stamp),
        "level": _text(event.level),
        "kind": _text(event.kind),
        "text": _text(event.text),
        "x": _known(where.x),
        "y": _known(where.y),
        "z": _known(where.z),
        "acknowledged_by": _text(event.acknowledged_by),
        "acknowledged": _instant(event.acknowledged),
        **_code_row(event),
    }


def _event(row: EventRow) -> Event:
    return Event(
        id=row.id,
        stamp=_time(row.stamp),
        level=row.level,
        kind=row.kind,
        text=row.text,
        position=Point(_number(row.x), _number(row.y), _number(row.z)),
        acknowledged_by=row.acknowledged_by,
        acknowledged=_time(row.acknowledged),
        **_code(row),
    )


def _scheduled(row: ScheduleRow) -> ScheduledTask:
    return msgspec.structs.replace(from_json(row.content, ScheduledTask), id=row.id)


def _crop(row: CropRow) -> str:
    b64decode(row.picture, validate=True)  # a ValueError leaves out what is damaged
    return row.picture


TABLES: dict[str, _Table] = {
    "places": _Table(PlaceRow, _place_row, _place),
    "missions": _Table(
        MissionRow,
        lambda mission: {"name": _text(mission.name), "content": _json(mission)},
        lambda row: from_json(row.content, Mission),
    ),
    "settings": _Table(SettingRow, lambda text: {"value": _text(text)}, lambda row: row.value),
    "schedule": _Table(
        ScheduleRow, lambda task: {"enabled": task.enabled, "content": _json(task)}, _scheduled
    ),
    "queue": _Table(
        QueueRow,
        lambda queued: {"position": queued.position, "content": _json(queued.order)},
        lambda row: Queued(row.position, from_json(row.content, TaskOrder)),
    ),
    "runs": _Table(RunRow, _run_row, _run),
    "events": _Table(EventRow, _event_row, _event),
    "crops": _Table(CropRow, lambda text: {"picture": _text(text)}, _crop),
    "answers": _Table(
        AnswerRow,
        lambda answered: {name: _text(text) for name, text in answered._asdict().items()},
        lambda row: Answered(row.sender, row.service, row.command_id, row.content),
    ),
    "facts": _Table(FactRow, lambda text: {"value": _text(text)}, lambda row: row.value),
}
"""The conversion of each table's values."""

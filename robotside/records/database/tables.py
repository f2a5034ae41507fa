"""The tables of the database, as SQLAlchemy's models. `migrations` make them; names and types never change without one."""

from __future__ import annotations

from sqlalchemy import BigInteger, Boolean, Double, Integer, String, Text
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column

__all__ = [
    "AnswerRow",
    "AuditRow",
    "Base",
    "CropRow",
    "EventRow",
    "FactRow",
    "MissionRow",
    "PlaceRow",
    "QueueRow",
    "RunRow",
    "ScheduleRow",
    "SettingRow",
]

MAX_KEY = 64
"""Characters of a name that is a key."""


class Base(DeclarativeBase):
    """All tables."""


class PlaceRow(Base):
    """A named pose."""

    __tablename__ = "places"
    id: Mapped[int] = mapped_column(Integer, primary_key=True, autoincrement=False)
    name: Mapped[str] = mapped_column(Text)
    kind: Mapped[str] = mapped_column(Text)
    floor: Mapped[str] = mapped_column(Text)
    x: Mapped[float] = mapped_column(Double)
    y: Mapped[float] = mapped_column(Double)
    yaw: Mapped[float | None] = mapped_column(Double)
    tag: Mapped[str] = mapped_column(Text)
    note: Mapped[str] = mapped_column(Text)
    height: Mapped[float | None] = mapped_column(Double)


class MissionRow(Base):
    """One revision of a mission; the id counts them all."""

    __tablename__ = "missions"
    id: Mapped[int] = mapped_column(Integer, primary_key=True, autoincrement=False)
    name: Mapped[str] = mapped_column(Text)
    content: Mapped[str] = mapped_column(Text)


class SettingRow(Base):
    """One setting that an operator changed."""

    __tablename__ = "settings"
    name: Mapped[str] = mapped_column(String(MAX_KEY), primary_key=True)
    value: Mapped[str] = mapped_column(Text)


class ScheduleRow(Base):
    """A task that starts by itself."""

    __tablename__ = "schedule"
    id: Mapped[int] = mapped_column(Integer, primary_key=True, autoincrement=False)
    enabled: Mapped[bool] = mapped_column(Boolean)
    content: Mapped[str] = mapped_column(Text)


class QueueRow(Base):
    """A task that waits for its turn."""

    __tablename__ = "queue"
    id: Mapped[int] = mapped_column(Integer, primary_key=True, autoincrement=False)
    position: Mapped[int] = mapped_column(Integer)
    content: Mapped[str] = mapped_column(Text)


class RunRow(Base):
    """A task that was done or is under way; instants in nanoseconds since the epoch, 0 for not yet."""

    __tablename__ = "runs"
    id: Mapped[int] = mapped_column(Integer, primary_key=True, autoincrement=False)
    task: Mapped[str] = mapped_column(Text)
    started: Mapped[int] = mapped_column(BigInteger)
    ended: Mapped[int] = mapped_column(BigInteger)
    state: Mapped[str] = mapped_column(Text)
    reason: Mapped[str] = mapped_column(Text)
    distance: Mapped[float] = mapped_column(Double)
    visited: Mapped[int] = mapped_column(Integer)
    started_by: Mapped[str] = mapped_column(Text)
    content: Mapped[str] = mapped_column(Text)
    code: Mapped[str | None] = mapped_column(Text)
    actor_id: Mapped[str | None] = mapped_column(Text)
    parameters: Mapped[str | None] = mapped_column(Text)


class EventRow(Base):
    """Something that happened; instants in nanoseconds since the epoch, 0 for not yet."""

    __tablename__ = "events"
    id: Mapped[int] = mapped_column(Integer, primary_key=True, autoincrement=False)
    stamp: Mapped[int] = mapped_column(BigInteger)
    level: Mapped[str] = mapped_column(Text)
    kind: Mapped[str] = mapped_column(Text)
    text: Mapped[str] = mapped_column(Text)
    x: Mapped[float | None] = mapped_column(Double)
    y: Mapped[float | None] = mapped_column(Double)
    z: Mapped[float | None] = mapped_column(Double)
    acknowledged_by: Mapped[str] = mapped_column(Text)
    acknowledged: Mapped[int] = mapped_column(BigInteger)
    code: Mapped[str | None] = mapped_column(Text)
    actor_id: Mapped[str | None] = mapped_column(Text)
    parameters: Mapped[str | None] = mapped_column(Text)


class CropRow(Base):
    """The picture of an intruder, by the number of the event that reported it: a JPEG file in Base64."""

    __tablename__ = "crops"
    id: Mapped[int] = mapped_column(Integer, primary_key=True, autoincrement=False)
    picture: Mapped[str] = mapped_column(Text)


class AnswerRow(Base):
    """What was answered to a command that changed something."""

    __tablename__ = "answers"
    id: Mapped[int] = mapped_column(Integer, primary_key=True, autoincrement=False)
    sender: Mapped[str] = mapped_column(Text)
    service: Mapped[str] = mapped_column(Text)
    command_id: Mapped[str] = mapped_column(Text)
    content: Mapped[str] = mapped_column(Text)


class AuditRow(Base):
    """Something that somebody did, chained to the row before; an instant in nanoseconds since the epoch."""

    __tablename__ = "audit"
    id: Mapped[int] = mapped_column(Integer, primary_key=True, autoincrement=False)
    stamp: Mapped[int] = mapped_column(BigInteger)
    person_id: Mapped[str] = mapped_column(Text)
    name: Mapped[str] = mapped_column(Text)
    role: Mapped[str] = mapped_column(Text)
    way: Mapped[str] = mapped_column(Text)
    address: Mapped[str] = mapped_column(Text)
    operation: Mapped[str] = mapped_column(Text)
    outcome: Mapped[str] = mapped_column(Text)
    parameters: Mapped[str] = mapped_column(Text)
    salt: Mapped[str] = mapped_column(Text)
    digest: Mapped[str] = mapped_column(Text)
    hash: Mapped[str] = mapped_column(Text)


class FactRow(Base):
    """One thing of which there is only one: a counter, who pressed STOP, the identity of the log."""

    __tablename__ = "facts"
    name: Mapped[str] = mapped_column(String(MAX_KEY), primary_key=True)
    value: Mapped[str] = mapped_column(Text)

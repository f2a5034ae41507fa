"""The database engine, used by one thread at a time; its errors come as sentences."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from sqlalchemy import Engine, create_engine, event, select
from sqlalchemy.engine import URL
from sqlalchemy.exc import DBAPIError, SQLAlchemyError
from sqlalchemy.orm import Session
from sqlalchemy.pool import StaticPool

from bridge.core.errors import BridgeError
from robotside.records.database.audit_rows import Audited
from robotside.records.database.files import LOCK_TIMEOUT
from robotside.records.database.rows import Content, Put, Unsound, read_all, write
from robotside.records.database.tables import AuditRow, Base

__all__ = ["NotWritten", "Storage", "engine_of", "not_written"]

_DAMAGED = ("malformed", "not a database", "file is encrypted", "database corruption")


class NotWritten(Exception):
    """The database could not do it; the text is one sentence."""

    def __init__(
        self, said: str, *, damaged: bool = False, general: bool = True, locked: bool = False
    ) -> None:
        super().__init__(said)
        self.damaged = damaged
        """The file is broken, and will be for every later write."""
        self.general = general
        """Any other write would have failed as well."""
        self.locked = locked
        """Another program has it."""


class Storage:
    """Reads everything once and writes rows."""

    def __init__(self, engine: Engine) -> None:
        self.engine = engine

    @classmethod
    def in_memory(cls) -> Storage:
        """A database that is gone with the process, with all its tables."""
        engine = create_engine("sqlite://", poolclass=StaticPool, connect_args={"check_same_thread": False})
        Base.metadata.create_all(engine)
        return cls(engine)

    def load(self) -> tuple[Content, list[str]]:
        """Everything there is, and a sentence for each table of which rows could not be read. NotWritten when none can."""
        try:
            with Session(self.engine) as session:
                return read_all(session)
        except (SQLAlchemyError, Unsound) as error:
            raise not_written(error) from error

    def write(self, puts: Iterable[Put]) -> None:
        """Bring rows to what they shall be, all or none; on the disk when this returns. NotWritten when it cannot be."""
        try:
            with Session(self.engine) as session, session.begin():
                write(session, puts)
        except (SQLAlchemyError, BridgeError, ValueError, TypeError) as error:
            raise not_written(error) from error

    def audit(self) -> list[Audited]:
        """The rows of the audit log, oldest first."""
        try:
            with Session(self.engine) as session:
                rows = session.scalars(select(AuditRow).order_by(AuditRow.id))
                return [Audited(*(getattr(row, name) for name in Audited.__struct_fields__)) for row in rows]
        except SQLAlchemyError as error:
            raise not_written(error) from error

    def close(self) -> None:
        """Let go of it."""
        self.engine.dispose()


def engine_of(url: URL, patience: float = LOCK_TIMEOUT) -> Engine:
    """An engine whose commits are on the disk when they return; `patience` [s] waits for locks."""
    if url.get_backend_name() != "sqlite":
        return create_engine(url, pool_pre_ping=True, pool_size=1, max_overflow=1)
    engine = create_engine(url, connect_args={"timeout": patience, "check_same_thread": False})

    @event.listens_for(engine, "connect")
    def prepare(connection: Any, _: Any) -> None:
        connection.isolation_level = (
            None  # transactions begin where SQLAlchemy says so, those of the tables as well
        )
        for pragma in ("journal_mode=WAL", "synchronous=FULL", "secure_delete=ON"):
            connection.execute(f"PRAGMA {pragma}")

    @event.listens_for(engine, "begin")
    def begin(connection: Any) -> None:
        connection.exec_driver_sql("BEGIN IMMEDIATE")

    return engine


def not_written(error: Exception) -> NotWritten:
    """The error as a sentence for the operator."""
    cause = error.orig if isinstance(error, DBAPIError) and error.orig is not None else error
    text = " ".join(str(cause).split())
    small = text.lower()
    if any(word in small for word in _DAMAGED):
        return NotWritten(f"The database is damaged ({text}).", damaged=True)
    if "full" in small or "no space" in small or getattr(cause, "sqlstate", "") == "53100":
        return NotWritten("The disk is full: nothing was stored. Make room on the robot's computer.")
    if "locked" in small or "busy" in small or "lock wait timeout" in small:
        said = "The database is locked by another program: nothing was stored. End that one."
        return NotWritten(said, locked=True)
    if "readonly" in small or "read-only" in small or "unable to open" in small:
        return NotWritten(f"The database may not be written ({text}): nothing was stored.")
    if "disk i/o" in small:
        return NotWritten("The disk fails (input/output error): nothing was stored.")
    if any(word in small for word in ("connect", "server closed", "gone away", "terminating")):
        return NotWritten(f"The database server cannot be reached ({text[:120]}): nothing was stored.")
    return NotWritten(f"The database failed ({text[:160]}): nothing was stored.", general=False)

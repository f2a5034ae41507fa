"""The database itself: one engine, one writer; errors come as sentences."""

from __future__ import annotations

from collections.abc import Iterable

from sqlalchemy import Engine
from sqlalchemy.exc import SQLAlchemyError
from sqlalchemy.orm import Session

from robotside.database.rows import Content, Put, read_all, write
from robotside.database.tables import Base

__all__ = ["NotWritten", "Storage"]


class NotWritten(Exception):
    """The database could not do it; the text is one sentence."""

    def __init__(self, said: str, *, damaged: bool = False) -> None:
        super().__init__(said)
        self.damaged = damaged
        """The file is broken, and will be for every later write."""


class Storage:
    """Reads everything once and writes rows; used by one thread at a time."""

    def __init__(self, engine: Engine) -> None:
        self._engine = engine

    def make(self) -> None:
        """Make all tables at once, for a database that lives no longer than this process."""
        Base.metadata.create_all(self._engine)

    def load(self) -> Content:
        """Everything there is."""
        try:
            with Session(self._engine) as session:
                return read_all(session)
        except SQLAlchemyError as error:
            raise NotWritten(f"The database cannot be read: {error}.") from error

    def write(self, puts: Iterable[Put]) -> None:
        """Bring rows to what they shall be, all or none; on the disk when this returns. NotWritten when it cannot be."""
        try:
            with Session(self._engine) as session, session.begin():
                write(session, puts)
        except SQLAlchemyError as error:
            raise NotWritten(f"The database cannot be written: {error}.") from error

    def close(self) -> None:
        """Let go of it."""
        self._engine.dispose()

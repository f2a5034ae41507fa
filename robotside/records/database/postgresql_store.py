"""Records on a PostgreSQL server, whose owner mends and backs up."""

from __future__ import annotations

import time
from collections.abc import Iterable
from contextlib import suppress

from sqlalchemy import Connection, text
from sqlalchemy.engine import URL
from sqlalchemy.exc import SQLAlchemyError

from robotside.records.database.audit_rows import Audited
from robotside.records.database.rows import Put
from robotside.records.database.schema import upgrade
from robotside.records.database.storage import Storage, engine_of, not_written
from robotside.records.database.store import CannotOpen, Opened, Store

__all__ = ["PostgresqlStore"]

_KEEPALIVE = {"tcp_keepalives_idle": 5, "tcp_keepalives_interval": 5, "tcp_keepalives_count": 2}
"""After which a server gives up a robot that says nothing [s, s, times]."""


class PostgresqlStore(Store):
    """One database on a server."""

    def __init__(self, url: URL, patience: float) -> None:
        try:
            self._storage = Storage(engine_of(url, patience))
        except ImportError as missing:
            said = f"For {url.drivername} the package {missing.name!r} is needed, which is not installed."
            raise CannotOpen(said) from missing
        self._lock: Connection | None = None
        self._patience = patience

    def open(self) -> Opened:
        """Everything it has, unless another robot side works with it."""
        self._take_lock()
        upgrade(self._storage.engine)
        content, unread = self._storage.load()
        return Opened(content, unread, 0)

    def write(self, puts: list[Put]) -> None:
        """Write rows, all or none."""
        self._storage.write(puts)

    def audit(self) -> Iterable[Audited]:
        """The rows of the audit log, oldest first."""
        return self._storage.audit()

    def close(self) -> None:
        """Let go of the server."""
        if self._lock is not None:
            with suppress(SQLAlchemyError):
                self._lock.close()
        self._storage.close()

    def _take_lock(self) -> None:
        """Hold a lock for as long as the connection lives: what is in memory here would not know what others write.

        PostgreSQL looks after its connections, so that a robot without power loses it soon.
        """
        engine = self._storage.engine
        try:
            self._lock = engine.connect()
            for name, value in _KEEPALIVE.items():
                self._lock.execute(text(f"SET {name} = {value}"))
            end = time.monotonic() + self._patience
            while not (taken := self._lock.scalar(text("SELECT pg_try_advisory_lock(7474)"))):
                if time.monotonic() > end:
                    break
                time.sleep(0.05)
            self._lock.commit()
        except SQLAlchemyError as error:
            raise not_written(error) from error
        if not taken:
            where = engine.url.render_as_string(hide_password=True)
            raise CannotOpen(
                f"Another robot side keeps its records in {where}; each needs a database of its own."
            )

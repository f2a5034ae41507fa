"""The opening of the records: the database of a URL, with what older programs left taken over."""

from __future__ import annotations

import secrets
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError, NoSuchModuleError

from robotside.records.audit import Entry
from robotside.records.database.files import LOCK_TIMEOUT, MAX_BACKUPS, DatabaseFiles
from robotside.records.database.legacy import left_behind, put_away
from robotside.records.database.postgresql_store import PostgresqlStore
from robotside.records.database.rows import Put, rows_of
from robotside.records.database.sqlite_store import SqliteStore
from robotside.records.database.storage import NotWritten
from robotside.records.database.store import CannotOpen, Opened, Store
from robotside.records.database.unkept_store import UnkeptStore
from robotside.records.database.writer import CallSoon, WriterThread
from robotside.records.records import Records

__all__ = ["CannotOpen", "open_records"]


_BACKENDS = ("sqlite", "postgresql")

SKIPPED_AFTER_CRASH = 1_000
"""Numbers of events left out after a crash: some may have been published and are not on the disk."""


def open_records(
    directory: Path,
    url: str | None,
    call_soon: CallSoon,
    *,
    backups: int = MAX_BACKUPS,
    patience: float = LOCK_TIMEOUT,
    now: Callable[[], float] = time.time,
) -> Records:
    """Open what is kept in `directory`, or at `url` as SQLAlchemy writes it; CannotOpen says why it cannot be.

    `call_soon` calls a function in the thread of the records, as a loop's `call_soon_threadsafe`
    does. Of a SQLite file `backups` are kept. `patience` [s] is waited for another program that has the records. Anything
    unusual is in `problems`.
    """
    files = partial(DatabaseFiles, now=now, patience=patience, backups=backups)
    store, opened = _opened(directory, url, files, patience)
    try:
        puts, said = _first_words(opened, directory)
        trouble = _tried(store, opened, puts)
    except BaseException:
        store.close()
        raise
    writer = WriterThread(store, call_soon)
    records = Records(opened.content, writer, writer.close, store.audit)
    records.problems += [*opened.problems, *said]
    if trouble:
        records.owe(puts, trouble)
    else:
        put_away(directory)
    writer.on_idle = records.try_again
    writer.on_trouble = records.say_trouble
    writer.on_damage = lambda: records.rebuild(writer.rebuild)
    writer.start()
    for problem in records.problems:
        records.audit.record(Entry("records", problem), now())
    return records


def _opened(
    directory: Path, url: str | None, files: Callable[[Path], DatabaseFiles], patience: float
) -> tuple[Store, Opened]:
    """The store and what it has; one that keeps nothing where nothing can be written, so that the robot is served."""
    parsed = _parsed(url) if url else None
    if parsed is not None and parsed.get_backend_name() != "sqlite":
        return _open(PostgresqlStore(parsed, patience))
    if parsed is not None and parsed.database in (None, "", ":memory:"):
        raise CannotOpen(
            f"The database {url!r} would be gone with the process; name a file, as sqlite:///FILE."
        )
    path = directory / "records.sqlite3" if parsed is None else Path(str(parsed.database))
    try:
        return _open(SqliteStore(path, files, patience))
    except CannotOpen as problem:
        if not problem.around:
            raise
        return _open(UnkeptStore(path, patience, str(problem)))


def _open(store: Store) -> tuple[Store, Opened]:
    try:
        return store, store.open()
    except NotWritten as problem:
        store.close()
        raise CannotOpen(str(problem), around=not problem.locked) from problem
    except BaseException:
        store.close()
        raise


def _first_words(opened: Opened, directory: Path) -> tuple[list[Put], list[str]]:
    """The first rows to write, and the sentences about them."""
    facts = opened.content["facts"]
    skip = max(opened.skip, SKIPPED_AFTER_CRASH if facts.get("clean") == "0" else 0)
    puts = [Put("facts", "clean", "0")]
    if "log" not in facts:
        puts.append(Put("facts", "log", secrets.token_hex(4)))
    if skip:
        puts.append(Put("facts", "last event", str(int(facts.get("last event", 0)) + skip)))
    if "taken over" in facts:
        return puts, []
    left = left_behind(directory)
    puts.append(Put("facts", "taken over", "1"))
    if left.stopped_by:
        puts.append(Put("facts", "stopped by", left.stopped_by))
    if left.mission is not None:
        puts += [
            Put("missions", 1, left.mission),
            Put("facts", "mission", "1"),
            Put("facts", "last mission", "1"),
        ]
    return puts, left.problems


def _tried(store: Store, opened: Opened, puts: list[Put]) -> str:
    """Write the first rows; a robot whose disk is full is served all the same, with the reason as one sentence."""
    try:
        store.write(puts)
    except NotWritten as problem:
        if not problem.damaged:
            return str(problem)
        try:
            opened.problems.append(store.rebuild([*rows_of(opened.content), *puts]))
        except NotWritten as still:
            return str(still)
    for put in puts:
        opened.content[put.table][put.key] = put.value
    return ""


def _parsed(url: str) -> URL:
    try:
        parsed = make_url(url)
        if parsed.get_backend_name() not in _BACKENDS:
            raise NoSuchModuleError(parsed.drivername)
        parsed.get_dialect()
    except (ArgumentError, NoSuchModuleError) as error:
        allowed = "sqlite:///FILE and postgresql+psycopg://USER@HOST/NAME"
        raise CannotOpen(f"There is no database {_shown(url)!r}; allowed are {allowed}.") from error
    return parsed


def _shown(url: str) -> str:
    """Without what may be a password."""
    head, _, tail = url.rpartition("@")
    return f"{head.partition('://')[0]}://...@{tail}" if head else url

"""Opens the records: makes or mends the database, brings its tables up to date and takes over what older programs left."""

from __future__ import annotations

import secrets
import sqlite3
import time
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from sqlalchemy import Connection, Engine, inspect, text
from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError, NoSuchModuleError, SQLAlchemyError

from bridge.core.errors import BridgeError
from robotside.records.database.files import BACKUPS_KEPT, PATIENCE, Files, Taken
from robotside.records.database.legacy import left_behind, put_away
from robotside.records.database.rows import Content, Put
from robotside.records.database.storage import NotWritten, Storage, engine_of, not_written
from robotside.records.database.writer import CallSoon, Store, Threaded
from robotside.records.records import Records

if TYPE_CHECKING:
    from alembic.script import ScriptDirectory

__all__ = ["CannotOpen", "open_records", "upgrade"]

_KEEPALIVE = {"tcp_keepalives_idle": 5, "tcp_keepalives_interval": 5, "tcp_keepalives_count": 2}
"""After which a server gives up a robot that says nothing [s, s, times]."""

_BACKENDS = ("sqlite", "postgresql")

AFTER_CRASH, AFTER_RESTORE = 1_000, 100_000
"""Numbers of events left out: some may have been told to somebody and are not on the disk."""


class CannotOpen(BridgeError):
    """There are no records to work with; the text is one sentence."""


class _Opened(NamedTuple):
    storage: Storage
    content: Content
    problems: list[str]
    skip: int


def open_records(
    directory: Path,
    url: str | None,
    call_soon: CallSoon,
    *,
    backups: int = BACKUPS_KEPT,
    patience: float = PATIENCE,
    now: Callable[[], float] = time.time,
) -> Records:
    """Open what is kept in `directory`, or at `url` as SQLAlchemy writes it; CannotOpen says why it cannot be.

    `call_soon` brings what the writing thread tells to the thread of the records, as a loop's `call_soon_threadsafe`
    does. Of a SQLite file `backups` are kept. `patience` [s] is waited for another program that has the records. Anything
    unusual is in `problems`.
    """
    store = _store(directory, url, partial(Files, now=now, patience=patience, backups=backups), patience)
    try:
        opened = store.open()
        puts, said = _first_words(opened, directory)
        trouble = _tried(opened, puts)
    except NotWritten as problem:
        store.close()
        raise CannotOpen(str(problem)) from problem
    except BaseException:
        store.close()
        raise
    writer = Threaded(store, call_soon)
    records = Records(opened.content, writer, writer.close)
    records.problems += [*opened.problems, *said]
    if trouble:
        records.owe(puts, trouble)
    else:
        put_away(directory)
    writer.on_idle = records.try_again
    writer.on_trouble = records.say_trouble
    writer.on_damage = lambda: records.rebuild(writer.rebuild)
    writer.start()
    return records


def _store(
    directory: Path, url: str | None, files: Callable[[Path], Files], patience: float
) -> _Local | _Server:
    if not url:
        return _Local(directory / "records.sqlite3", files, patience)
    parsed = _parsed(url)
    if parsed.get_backend_name() != "sqlite":
        return _Server(parsed, patience)
    if not parsed.database or parsed.database == ":memory:":
        raise CannotOpen(
            f"The database {url!r} would be gone with the process; name a file, as sqlite:///FILE."
        )
    return _Local(Path(parsed.database), files, patience)


def _first_words(opened: _Opened, directory: Path) -> tuple[list[Put], list[str]]:
    """What is written before anything else, and what there is to say about it."""
    facts = opened.content["facts"]
    skip = max(opened.skip, AFTER_CRASH if facts.get("clean") == "0" else 0)
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


def _tried(opened: _Opened, puts: list[Put]) -> str:
    """Write the first rows; a robot whose disk is full is served all the same, with the reason as one sentence."""
    try:
        opened.storage.write(puts)
    except NotWritten as problem:
        if problem.damaged:
            raise
        return str(problem)
    for put in puts:
        opened.content[put.table][put.key] = put.value
    return ""


def upgrade(engine: Engine, before: Callable[[], object] = lambda: None) -> None:
    """Bring the tables up to date; `before` is called when there is an older database to change.

    CannotOpen when it was made by a newer program, NotWritten when it cannot be changed.
    """
    migrations = Path(__file__).with_name("database") / "migrations"
    try:
        revision = _revision(engine)
        if revision != _newest(migrations):
            _migrate(engine, migrations, revision, before)
    except SQLAlchemyError as error:
        raise not_written(error) from error


def _revision(engine: Engine) -> str | None:
    """What the tables are of, by alembic's own table; None when there are none."""
    with engine.connect() as connection:
        if not inspect(connection).has_table("alembic_version"):
            return None
        found = connection.scalar(text("SELECT version_num FROM alembic_version"))
        return None if found is None else str(found)


def _newest(migrations: Path) -> str:
    """The last revision, by the names of the files, which are `vREVISION_what.py`."""
    names = [path.stem for path in (migrations / "versions").glob("v*_*.py")]
    return max(names, default="").partition("_")[0].removeprefix("v")


def _migrate(engine: Engine, migrations: Path, revision: str | None, before: Callable[[], object]) -> None:
    # it takes 15 MB as long as the program runs, and nearly every start finds the tables up to date
    from alembic import command
    from alembic.config import Config
    from alembic.script import ScriptDirectory

    config = Config()
    config.set_main_option("script_location", str(migrations))
    if revision is not None:
        _check_known(ScriptDirectory.from_config(config), revision)
        before()
    with engine.begin() as connection:
        config.attributes["connection"] = connection
        command.upgrade(config, "head")


def _check_known(script: ScriptDirectory, revision: str) -> None:
    from alembic.util import CommandError

    try:
        script.get_revision(revision)
    except CommandError as error:
        said = (
            f"The database is of a newer program (its tables are of revision {revision!r}, this program knows"
        )
        raise CannotOpen(f"{said} up to {script.get_current_head()!r}); start that one.") from error


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


class _Local(Store):
    """A SQLite file, that is mended when it is broken and backed up."""

    def __init__(self, path: Path, files: Callable[[Path], Files], patience: float) -> None:
        self._patience = patience
        directory = path.parent
        try:
            self._files = files(path)
            self._files.take()
        except OSError as error:
            why = (error.strerror or str(error)).lower()
            said = f"Nothing can be kept in {str(directory)!r}: {why}; --state names another directory."
            raise CannotOpen(said) from error
        except Taken:
            said = (
                f"Another robot side keeps its records in {str(directory)!r}; end it or name another --state."
            )
            raise CannotOpen(said) from None
        self._storage: Storage | None = None

    def open(self) -> _Opened:
        """Everything it has; broken, what its newest backup has."""
        problems, skip = [], 0
        try:
            fault = self._files.missing() or self._files.fault()
        except sqlite3.Error as error:
            raise not_written(error) from error
        if fault:
            problems.append(self._mend(fault))
            skip = AFTER_RESTORE
        storage = self._connect()
        content, unread = storage.load()
        return _Opened(storage, content, problems + unread, skip)

    def write(self, puts: list[Put]) -> None:
        """Write rows, all or none."""
        if self._storage is None:
            raise NotWritten("The database is damaged: nothing was stored.", damaged=True)
        try:
            self._storage.write(puts)
        except NotWritten:
            self._check()
            raise
        self._check()

    def _check(self) -> None:
        """NotWritten when what was written just now is nowhere that a restart would look."""
        lost = self._files.lost()
        if lost:
            raise NotWritten(f"The database is damaged ({lost}).", damaged=True)

    def rebuild(self, puts: list[Put]) -> str:
        """Set the broken file aside and write a new one."""
        if self._storage is not None:
            self._storage.close()
            self._storage = None
        try:
            aside = self._files.set_aside()
        except OSError as error:
            raise NotWritten(f"The broken database cannot be moved aside: {error.strerror}.") from error
        self._connect().write(puts)
        became = f"damaged and is set aside as {aside.name}" if aside.exists() else "gone"
        return f"The database was {became}; a new one was written, nothing is lost."

    def back_up(self) -> None:
        """Copy it beside itself."""
        try:
            self._files.back_up()
        except (OSError, sqlite3.Error) as error:
            raise not_written(error) from error

    def backup_age(self) -> float:
        """Of the newest backup [s]; infinite when there is none, or it is of the future."""
        return self._files.backup_age()

    def close(self) -> None:
        """Let go of the file."""
        if self._storage is not None:
            self._storage.close()
            self._storage = None
        self._files.let_go()

    def _connect(self) -> Storage:
        engine = engine_of(URL.create("sqlite", database=str(self._files.path)), self._patience)
        self._storage = Storage(engine)
        upgrade(engine, self.back_up)
        self._files.watch()
        return self._storage

    def _mend(self, fault: str) -> str:
        try:
            aside = self._files.set_aside()
            backup = self._files.restore()
        except (OSError, sqlite3.Error) as error:
            raise CannotOpen(
                f"The database is damaged ({fault}) and cannot be moved aside: {error}."
            ) from error
        became = f"and is set aside as {aside.name}" if aside.exists() else "and nothing is left of it"
        said = f"The database was damaged ({fault[:80]}) {became}"
        if backup is None:
            return f"{said}; there was no backup, so it starts empty."
        return f"{said}; the backup {backup.name} was put in its place, what was stored after it is lost."


class _Server(Store):
    """A database on a server, whose owner mends and backs up."""

    def __init__(self, url: URL, patience: float) -> None:
        try:
            self._storage = Storage(engine_of(url, patience))
        except ImportError as missing:
            said = f"For {url.drivername} the package {missing.name!r} is needed, which is not installed."
            raise CannotOpen(said) from missing
        self._lock: Connection | None = None
        self._patience = patience

    def open(self) -> _Opened:
        """Everything it has, unless another robot side works with it."""
        self._take()
        upgrade(self._storage.engine)
        content, unread = self._storage.load()
        return _Opened(self._storage, content, unread, 0)

    def write(self, puts: list[Put]) -> None:
        """Write rows, all or none."""
        self._storage.write(puts)

    def close(self) -> None:
        """Let go of the server."""
        if self._lock is not None:
            with suppress(SQLAlchemyError):
                self._lock.close()
        self._storage.close()

    def _take(self) -> None:
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

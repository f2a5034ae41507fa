"""The revision of the database's tables, and the way up to the newest one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from sqlalchemy import Engine, inspect, text
from sqlalchemy.exc import SQLAlchemyError

from robotside.records.database.storage import NotWritten, not_written
from robotside.records.database.store import CannotOpen

if TYPE_CHECKING:
    from alembic.script import ScriptDirectory

__all__ = ["upgrade"]

NOTED_FROM = 3
"""From this revision on the header of a SQLite file says the revision too."""


def upgrade(engine: Engine, before: Callable[[], object] = lambda: None) -> None:
    """Bring the tables up to date; `before` is called when there is an older database to change.

    CannotOpen when it was made by a newer program, NotWritten when it cannot be changed.
    """
    migrations = Path(__file__).with_name("migrations")
    try:
        revision = _revision(engine)
        if revision != _newest(migrations):
            if revision is not None:
                _check_twice(engine, revision)
            _migrate(engine, migrations, revision, before)
    except SQLAlchemyError as error:
        raise not_written(error) from error


def _revision(engine: Engine) -> str | None:
    """The revision of the tables, by alembic's own table; None when there are none."""
    with engine.connect() as connection:
        if not inspect(connection).has_table("alembic_version"):
            return None
        found = connection.scalar(text("SELECT version_num FROM alembic_version"))
        return None if found is None else str(found)


def _check_twice(engine: Engine, revision: str) -> None:
    """NotWritten when the file's header says another revision than the table: one of them is damaged."""
    if engine.dialect.name != "sqlite":
        return
    with engine.connect() as connection:
        noted = int(connection.scalar(text("PRAGMA user_version")) or 0)
    if not revision.isdigit() or int(revision) != (noted or min(int(revision), NOTED_FROM - 1)):
        said = f"The database is damaged (its tables are of revision {revision[:20]!r}, its header says {noted})."
        raise NotWritten(said, damaged=True)


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
        if engine.dialect.name == "sqlite":
            connection.exec_driver_sql(f"PRAGMA user_version={int(_newest(migrations))}")


def _check_known(script: ScriptDirectory, revision: str) -> None:
    from alembic.util import CommandError

    try:
        script.get_revision(revision)
    except CommandError as error:
        said = (
            f"The database is of a newer program (its tables are of revision {revision!r}, this program knows"
        )
        raise CannotOpen(f"{said} up to {script.get_current_head()!r}); start that one.") from error

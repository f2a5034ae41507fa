"""The tables of every kind of database, brought up to date."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from alembic import command
from alembic.autogenerate import compare_metadata
from alembic.config import Config as AlembicConfig
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import create_engine, event, inspect, text
from sqlalchemy.engine import make_url

from robotside.records.database import schema
from robotside.records.database.schema import upgrade
from robotside.records.database.storage import engine_of
from robotside.records.database.tables import Base
from robotside.records.opening import CannotOpen, open_records
from tests.robotside.records.conftest import Open

MIGRATIONS = Path(schema.__file__).with_name("migrations")


async def test_the_migrations_make_the_tables_of_the_models(
    start: Open, tmp_path: Path, url: str | None
) -> None:
    start().close()
    engine = engine_of(make_url(url or f"sqlite:///{tmp_path / 'records.sqlite3'}"))
    with engine.connect() as connection:
        assert compare_metadata(MigrationContext.configure(connection), Base.metadata) == []
    upgrade(engine)
    engine.dispose()


def test_the_newest_revision_is_the_one_that_its_file_is_named_after() -> None:
    config = AlembicConfig()
    config.set_main_option("script_location", str(MIGRATIONS))
    script = ScriptDirectory.from_config(config)
    for each in script.walk_revisions():
        assert Path(each.path).name.startswith(f"v{each.revision}_")
    assert schema._newest(MIGRATIONS) == script.get_current_head()


def test_what_changes_tables_is_not_loaded_where_they_are_up_to_date(tmp_path: Path) -> None:
    open_records(tmp_path, None, print).close()
    program = (
        "import sys; from pathlib import Path; from robotside.records.opening import open_records;"
        "open_records(Path(sys.argv[1]), None, print).close(); sys.exit('alembic' in sys.modules)"
    )
    command = [sys.executable, "-c", program, tmp_path]
    done = subprocess.run(command, capture_output=True, timeout=60, check=False)
    assert done.returncode == 0


async def test_a_database_of_a_newer_program_is_not_touched(
    start: Open, tmp_path: Path, url: str | None
) -> None:
    start().close()
    engine = create_engine(url or f"sqlite:///{tmp_path / 'records.sqlite3'}")
    with engine.begin() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = '0999'"))
        if url is None:
            connection.execute(text("PRAGMA user_version = 999"))
    engine.dispose()
    with pytest.raises(
        CannotOpen, match="of a newer program.*revision '0999', this program knows up to '0005'"
    ):
        start()


async def test_what_an_older_program_kept_is_read_as_without_codes(
    start: Open, tmp_path: Path, url: str | None
) -> None:
    engine = engine_of(make_url(url or f"sqlite:///{tmp_path / 'records.sqlite3'}"))
    config = AlembicConfig()
    config.set_main_option("script_location", str(MIGRATIONS))
    with engine.begin() as connection:
        config.attributes["connection"] = connection
        command.upgrade(config, "0001")
        connection.execute(text("INSERT INTO facts (name, value) VALUES ('log', 'aa'), ('taken over', '1')"))
        connection.execute(
            text(
                "INSERT INTO events (id, stamp, level, kind, text, acknowledged_by, acknowledged)"
                " VALUES (7, 1, 'alarm', 'stop', 'STOP pressed by Anna.', '', 0)"
            )
        )
        connection.execute(
            text(
                "INSERT INTO runs VALUES (3, 'hold', 1, 2, 'FAILED', 'Held up.', 0.5, 0, 'Anna', '{\"task\": \"hold\"}')"
            )
        )
    engine.dispose()
    records = start()
    assert records.problems == []
    (event,), (run,) = records.events.since(0, ""), records.runs.before()
    assert (event.text, event.code, event.actor_id, event.parameters) == ("STOP pressed by Anna.", "", "", [])
    assert (run.reason, run.code, run.actor_id, run.parameters) == ("Held up.", "", "", [])
    records.close()


async def test_a_migration_that_is_cut_leaves_nothing_half_and_is_done_again(
    tmp_path: Path, url: str | None
) -> None:
    engine = engine_of(make_url(url or f"sqlite:///{tmp_path / 'x.sqlite3'}"))
    cut = [True]

    @event.listens_for(engine, "before_cursor_execute")
    def fail(_: object, __: object, statement: str, *___: object) -> None:
        if cut and "CREATE TABLE" in statement and "runs" in statement:
            raise RuntimeError("The power is gone.")

    with pytest.raises(RuntimeError, match="The power is gone."):
        upgrade(engine)
    assert inspect(engine).get_table_names() == []
    cut.clear()
    upgrade(engine)
    assert set(inspect(engine).get_table_names()) == {"alembic_version", *Base.metadata.tables}
    engine.dispose()

"""The databases that the records are tried on: SQLite, a PostgreSQL of our own where it is installed, others by URL."""

from __future__ import annotations

import asyncio
import os
import pwd
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from sqlalchemy import text
from sqlalchemy.engine import make_url
from sqlalchemy.exc import OperationalError

from robotside.records import Records
from robotside.records.database.storage import engine_of
from robotside.records.database.tables import Base
from robotside.records.opening import open_records
from tests.lacking import lacking, package

URLS = os.environ.get("PILOTHOUSE_TEST_DATABASES", "").split()
"""Of empty databases to run the same tests on, separated by spaces."""
OWNER = "postgres"
"""Who runs the server where the tests are run by root, whom it does not obey."""

Open = Callable[[], Records]


def run_by() -> str | None:
    """Who the server is to be run by, None for whoever runs the tests."""
    if os.getuid():
        return None
    try:
        pwd.getpwnam(OWNER)
    except KeyError:
        lacking("PostgreSQL", f"root runs the tests, and there is no user {OWNER} to run a server")
    return OWNER


@pytest.fixture(scope="session")
def postgresql() -> Iterator[str]:
    """URL of a PostgreSQL server of our own, without a port, that ends with the tests."""
    package("psycopg")
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    if not found:
        lacking("PostgreSQL")
    programs, owner = found[-1].parent, run_by()
    folder = Path(tempfile.mkdtemp(prefix="pg"))
    try:
        if owner:
            shutil.chown(folder, owner)
        make = [programs / "initdb", "-D", folder / "data", "-A", "trust", "-U", "robot", "-E", "UTF8"]
        subprocess.run([*make, "--locale=C"], check=True, capture_output=True, user=owner)
        serve = [programs / "postgres", "-D", folder / "data", "-k", folder, "-c", "listen_addresses="]
        with subprocess.Popen(serve, stderr=subprocess.DEVNULL, user=owner) as server:
            try:
                url = f"postgresql+psycopg://robot@/postgres?host={folder}"
                until_it_answers(url)
                yield url
            finally:
                server.send_signal(signal.SIGINT)
    finally:
        shutil.rmtree(folder)


def until_it_answers(url: str) -> None:
    end, engine = time.monotonic() + 20.0, engine_of(make_url(url))
    while True:
        try:
            engine.connect().close()
        except OperationalError:
            if time.monotonic() > end:
                raise
            time.sleep(0.05)
        else:
            engine.dispose()
            return


@pytest.fixture(params=["sqlite", "postgresql", *URLS])
def url(request: pytest.FixtureRequest) -> str | None:
    """Of an empty database; None for a SQLite file beside the state."""
    if request.param == "sqlite":
        return None
    found = request.getfixturevalue("postgresql") if request.param == "postgresql" else request.param
    engine = engine_of(make_url(found))
    with engine.begin() as connection:
        Base.metadata.drop_all(connection)
        connection.execute(text("DROP TABLE IF EXISTS alembic_version"))
    engine.dispose()
    return str(found)


@pytest.fixture
async def start(tmp_path: Path, url: str | None) -> Open:
    """Opens the records as a robot side does that starts."""
    loop = asyncio.get_running_loop()
    return lambda: open_records(tmp_path, url, loop.call_soon_threadsafe, patience=1.0)

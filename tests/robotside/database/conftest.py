"""The databases that the records are tried on: SQLite, a PostgreSQL of our own where it is installed, others by URL."""

from __future__ import annotations

import contextlib
import os
import pwd
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from sqlalchemy import text

from robotside.database import Records
from robotside.database.opening import open_records
from robotside.database.storage import engine_of
from robotside.database.tables import Base

OTHERS = "PILOTHOUSE_TEST_DATABASES"
"""Environment variable with URLs, separated by spaces, of empty databases to run the same tests on."""
URLS = os.environ.get(OTHERS, "").split()

Open = Callable[[], Records]


def _postgres() -> Path | None:
    found = [
        *Path("/usr/lib/postgresql").glob("*/bin/initdb"),
        *map(Path, filter(None, [shutil.which("initdb")])),
    ]
    return found[-1].resolve().parent if found else None


@pytest.fixture(scope="session")
def postgresql() -> Iterator[str]:
    """URL of a PostgreSQL server of our own, without a port, that ends with the tests."""
    programs = _postgres()
    pytest.importorskip("psycopg")
    if programs is None:
        pytest.skip("No PostgreSQL server is installed here.")
    owner = {} if os.getuid() else {"user": "postgres"}
    with contextlib.suppress(KeyError):
        if owner:
            pwd.getpwnam("postgres")
    folder = Path(tempfile.mkdtemp(prefix="pg"))
    try:
        if owner:
            shutil.chown(folder, "postgres")
        data = folder / "data"
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        subprocess.run(
            [programs / "initdb", "-D", data, "-A", "trust", "-U", "robot", "-E", "UTF8", "--locale=C"],
            check=True,
            **quiet,
            **owner,
        )  # type: ignore[call-overload]
        server = subprocess.Popen(
            [
                programs / "postgres",
                "-D",
                data,
                "-k",
                folder,
                "-c",
                "listen_addresses=",
                "-c",
                "max_connections=20",
            ],
            **quiet,
            **owner,
        )  # type: ignore[call-overload]
        try:
            url = f"postgresql+psycopg://robot@/postgres?host={folder}"
            _await(url)
            yield url
        finally:
            server.send_signal(2)
            server.wait()
    finally:
        shutil.rmtree(folder)


def _await(url: str) -> None:
    import time

    from sqlalchemy.engine import make_url

    end = time.monotonic() + 20.0
    engine = engine_of(make_url(url))
    while True:
        try:
            with engine.connect():
                break
        except Exception:
            if time.monotonic() > end:
                raise
            time.sleep(0.1)
    engine.dispose()


@pytest.fixture(params=["sqlite", "postgresql", *URLS])
def url(request: pytest.FixtureRequest) -> str | None:
    """Of an empty database; None for a SQLite file beside the state."""
    if request.param == "sqlite":
        return None
    found = request.getfixturevalue("postgresql") if request.param == "postgresql" else request.param
    from sqlalchemy.engine import make_url

    engine = engine_of(make_url(found))
    with engine.begin() as connection:
        Base.metadata.drop_all(connection)
        connection.execute(text("DROP TABLE IF EXISTS alembic_version"))
    engine.dispose()
    return str(found)


@pytest.fixture
async def start(tmp_path: Path, url: str | None) -> Open:
    """Opens the records as a robot side does that starts."""
    import asyncio

    loop = asyncio.get_running_loop()
    return lambda: open_records(tmp_path, url, loop.call_soon_threadsafe, patience=1.0)

"""What every test gets: a Kivy that needs no display, no collector in the middle of it, and a check that nothing is
left running.

`tests/pixels` and `tests/e2e` draw, and Kivy chooses its GL once in a process: they run when they are named
(`pytest tests/pixels`), everything else runs together.
"""

from __future__ import annotations

import asyncio
import gc
import inspect
import os
import threading
import time
from collections.abc import AsyncIterator, Generator, Iterator
from pathlib import Path
from uuid import uuid4

import pytest
from hypothesis import HealthCheck, settings

from app.garbage_collector import Collector
from bridge.discovery.domain import VARIABLE
from bridge.server.reception.log_limit import STRANGERS
from tests import headless
from tests.apart import Apart

# a machine that is busy otherwise fails no property: no time counts
settings.register_profile("untimed", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("untimed")

HERE = Path(__file__).parent
DRAWING = ("pixels", "e2e")
GRACE = 2.0
"""How long a thread may take to end after its test [s, real time]."""


def _draws(path: Path) -> bool:
    return path.is_relative_to(HERE) and path.relative_to(HERE).parts[:1] in [(name,) for name in DRAWING]


def _mode(config: pytest.Config) -> str:
    named = [Path(config.invocation_params.dir, arg.split("::")[0]).resolve() for arg in config.args]
    drawing = [_draws(path) for path in named]
    if any(drawing) and not all(drawing):
        raise pytest.UsageError("tests/pixels and tests/e2e draw: run them without the others.")
    return "pixel" if any(drawing) else "logic"


def pytest_configure(config: pytest.Config) -> None:
    """Prepare Kivy before any test module imports it, and have no robot of others on the network found or stopped."""
    os.environ[VARIABLE] = f"test-{uuid4().hex[:16]}"
    config.stash[MODE] = _mode(config)
    headless.prepare(config.stash[MODE])
    if config.stash[MODE] == "logic":
        config.pluginmanager.register(Apart())


MODE = pytest.StashKey[str]()
COLLECTOR = pytest.StashKey[Collector]()


def pytest_collection_finish(session: pytest.Session) -> None:
    """Keep Python's collector out of the tests: `app.garbage_collector` says what it does to a widget of an earlier one."""
    session.config.stash[COLLECTOR] = Collector()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    """Collect between the tests, when nothing holds what a test made any more; what is left then is not looked at again."""
    result = yield
    before = _looks_at_everything()
    item.config.stash[COLLECTOR].step()
    if _looks_at_everything() > before:
        gc.freeze()  # 0.3 s for each later look otherwise: all that the tests have imported
    return result


def _looks_at_everything() -> int:
    """How many there have been."""
    return int(gc.get_stats()[-1]["collections"])


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave the drawing tests out of a process that cannot draw."""
    return True if config.stash[MODE] == "logic" and _draws(collection_path) else None


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Give each coroutine test the check for tasks, first in and so last out."""
    for item in items:
        if isinstance(item, pytest.Function) and inspect.iscoroutinefunction(item.obj):
            item.fixturenames.insert(0, "no_task_left")


@pytest.fixture
async def no_task_left() -> AsyncIterator[None]:
    """Fail the test that leaves an asyncio task running in its loop."""
    yield
    for _ in range(5):  # lets tasks that were told to end do so
        await asyncio.sleep(0)
    left = [task for task in asyncio.all_tasks() if task is not asyncio.current_task()]
    assert not left, f"left running: {left}"


@pytest.fixture(autouse=True)
def no_thread_left() -> Iterator[None]:
    """Fail the test that leaves a thread running."""
    before = set(threading.enumerate())
    yield
    deadline = time.monotonic() + GRACE
    for thread in set(threading.enumerate()) - before:
        thread.join(max(0.0, deadline - time.monotonic()))
    left = [thread.name for thread in set(threading.enumerate()) - before]
    assert not left, f"left running: {left}"


@pytest.fixture
def stage() -> Iterator[headless.Stage]:
    """An empty window on a clock that only the test moves."""
    stage = headless.Stage()
    yield stage
    stage.close()


@pytest.fixture(autouse=True, scope="session")
def nothing_of_the_user(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Neither the robots nor the robot.toml of who runs the tests count in them, and nobody is asked."""
    os.environ["XDG_STATE_HOME"] = str(tmp_path_factory.mktemp("state"))
    os.environ["PILOTHOUSE_NO_ASK"] = "1"


@pytest.fixture(autouse=True)
def counted_anew() -> None:
    """Log lines of an earlier test are no reason to leave one out."""
    STRANGERS.forget()

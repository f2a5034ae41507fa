"""Runs the tests of whole apps in processes of their own, so that nobody has to take those apps apart again.

An app is 360 000 objects in cycles. For Python's collector to find and free them takes longer than to build the app and
to test it; the end of a process does it for nothing. So the first test of a module that builds apps forks, the child
runs the module's tests and hands their reports back, and a child that is full is followed by another. What a module
never closes is still heard: after a child's first test everything is collected. What a child had to import of ours the
next one finds imported.

Most of them begin on the drive screen. That app is made once, in a child that lasts (`tests.app.sleeper`), and each test
that asks for it is a fork of that child, which listens to what is not closed by itself.
"""

from __future__ import annotations

import gc
import importlib
import os
import sys
import tempfile
import traceback
import warnings
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection, Pipe
from pathlib import Path
from typing import Any

import pytest
from _pytest import runner

__all__ = ["Apart"]

FIXTURE = "glass"
"""Whoever asks for it has a whole app."""
READY = "driving"
"""Whoever asks for it has one that is on the drive screen already."""
FRESH = {"collecting", "fresh"}
"""Whoever asks for one of them as well looks at the app's start."""
FULL = 20
"""Tests in a child; each leaves 60 MB behind."""
OURS = ("app.", "bridge.", "widgets.")
"""Whose modules are imported for the next child: with their kv rules 0.4 s for an app."""


Told = tuple[list[Any], list[str]]
"""The reports of a test, and which modules of ours it imported."""


class Child:
    """A process that runs tests and hands their reports back, and whatever of ours they had to import."""

    def __init__(self, serve: Callable[[Connection], None]) -> None:
        """`serve` is what it does with its end of the pipe."""
        self.pipe, there = Pipe()
        with warnings.catch_warnings():
            warnings.simplefilter(
                "ignore", DeprecationWarning
            )  # from 3.12 on: threads of xdist's, that hold nothing
            self._pid = os.fork()
        if self._pid == 0:
            self.pipe.close()
            try:
                serve(there)
            except BaseException:  # noqa: BLE001 - the parent tells it
                with suppress(OSError):
                    there.send(traceback.format_exc())
            finally:
                os._exit(0)
        there.close()
        self.served = 0

    def ask(self, number: int) -> Told | str:
        """Have it run the test of that number; why there is nothing to tell when it ended instead."""
        self.served += 1
        try:
            self.pipe.send(number)
            told: Told | str = self.pipe.recv()
        except (EOFError, OSError):
            return "The process of this test ended before its report."
        return told

    def end(self) -> None:
        """Have it end; a pipe that is only closed here may be open still in one that was forked later."""
        with suppress(OSError):
            self.pipe.send(None)
        self.pipe.close()
        os.waitpid(self._pid, 0)


class Apart:
    """A plugin of pytest; nothing where Python cannot fork, or where a debugger wants the terminal."""

    def __init__(self) -> None:
        self._modules: set[object] = set()
        self._items: list[pytest.Item] = []
        self._numbers: dict[int, int] = {}
        self._child: Child | None = None
        """That of the module."""
        self._sleeper: Child | None = None
        self._wanted: list[str] = []
        """Modules that a child had to import."""

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Find the modules that build apps."""
        usable = hasattr(os, "fork") and not session.config.getoption("usepdb")
        self._items = session.items
        self._numbers = {id(item): number for number, item in enumerate(self._items)}
        if usable:
            self._modules = {_module(item) for item in session.items if FIXTURE in _fixtures(item)}

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item, nextitem: pytest.Item | None) -> object:
        """Run `item` where it belongs."""
        if _module(item) not in self._modules:
            if nextitem is None or _module(nextitem) not in self._modules:
                return None
            # nothing narrower than the session may stand when a child is forked
            return runner.pytest_runtest_protocol(item, item.session)  # type: ignore[arg-type]
        item.ihook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
        ready = READY in _fixtures(item) and FRESH.isdisjoint(_fixtures(item))
        for report in self._run_ready(item) if ready else self._run(item):
            item.ihook.pytest_runtest_logreport(report=report)
        item.ihook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
        if self._child and (nextitem is None or _module(nextitem) is not _module(item)):
            self._end_child()
        return True

    def _run(self, item: pytest.Item) -> list[pytest.TestReport]:
        if self._child is None:
            self._prepare(item.config)
            self._child = Child(self._serve)
        told = self._child.ask(self._numbers[id(item)])
        if isinstance(told, str) or self._child.served == FULL:
            self._end_child()
        return self._reports(item, told)

    def _run_ready(self, item: pytest.Item) -> list[pytest.TestReport]:
        if self._sleeper is None:
            self._prepare(item.config)
            self._sleeper = Child(self._serve_ready)
        told = self._sleeper.ask(self._numbers[id(item)])
        if isinstance(told, str):
            self._end_sleeper()
        return self._reports(item, told)

    def _prepare(self, config: pytest.Config) -> None:
        """Have here what every child would make for itself alone."""
        config._tmp_path_factory.getbasetemp()
        _bring(self._wanted)

    def _reports(self, item: pytest.Item, told: Told | str) -> list[pytest.TestReport]:
        if isinstance(told, str):
            return [_broken(item, told)]
        self._wanted += told[1]
        read = item.config.hook.pytest_report_from_serializable
        return [read(config=item.config, data=data) for data in told[0]]

    # in a child

    def _serve(self, pipe: Connection) -> None:
        """Run what the pipe says until it closes."""
        first = True
        gc.freeze()  # what was there before is none of the child's
        while (number := _asked(pipe)) is not None:
            told = _told(self._items[number])
            if first:
                gc.collect()  # what was not closed complains now, and with the next report
                first = False
            gc.freeze()  # what is left is not looked at again
            pipe.send(told)

    def _serve_ready(self, pipe: Connection) -> None:
        """Put an app to sleep, and run each test that the pipe says in a fork of it."""
        from tests.app import sleeper

        with tempfile.TemporaryDirectory() as folder:
            sleeper.lay(Path(folder))
            gc.collect()
            gc.freeze()
            while (number := _asked(pipe)) is not None:
                child = Child(lambda there: there.send(_told(self._items[there.recv()])))
                told = child.ask(number)
                child.end()
                pipe.send(told)
                if not isinstance(told, str):
                    _bring(told[1])

    # at the end

    def _end_child(self) -> None:
        if self._child is not None:
            self._child.end()
            self._child = None

    def _end_sleeper(self) -> None:
        if self._sleeper is not None:
            self._sleeper.end()
            self._sleeper = None

    def pytest_sessionfinish(self) -> None:
        """End the children that still wait."""
        self._end_child()
        self._end_sleeper()


def _module(item: pytest.Item) -> object:
    return item.getparent(pytest.Module)


def _fixtures(item: pytest.Item) -> list[str]:
    names: list[str] = getattr(item, "fixturenames", [])
    return names


def _bring(modules: list[str]) -> None:
    """Import them, and take each from the list."""
    while modules:
        with suppress(ImportError):  # where only what the child's test had put there made it one
            importlib.import_module(modules.pop(0))


def _asked(pipe: Connection) -> int | None:
    """The number of the next test; None when there is none, or nobody any more who asks."""
    try:
        number: int | None = pipe.recv()
    except EOFError:
        return None
    return number


def _told(item: pytest.Item) -> Told:
    """Run it here; its reports, and which modules of ours it imported."""
    known = set(sys.modules)
    # all is torn down that it set up: the next one may run elsewhere
    reports = runner.runtestprotocol(item, log=False, nextitem=item.session)  # type: ignore[arg-type]
    write = item.config.hook.pytest_report_to_serializable
    imported = [name for name in list(sys.modules) if name not in known and name.startswith(OURS)]
    return [write(config=item.config, report=report) for report in reports], imported


def _broken(item: pytest.Item, said: str) -> pytest.TestReport:
    return pytest.TestReport(item.nodeid, item.location, {}, "failed", said, "call")

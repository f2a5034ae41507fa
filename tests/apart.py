"""Runs the modules that build whole apps in processes of their own, so that nobody has to take those apart again.

An app is 360 000 objects in cycles. For Python's collector to find and free them takes longer than to build the app and
to test it; the end of a process does it for nothing. So the first test of such a module forks, the child runs the
module's tests and hands their reports back, and a child that is full is followed by another. What a module never closes
is still heard: after a child's first test everything is collected. What a child had to import of ours the next one
finds imported.
"""

from __future__ import annotations

import gc
import importlib
import os
import sys
import warnings
from contextlib import suppress
from multiprocessing.connection import Connection, Pipe
from typing import Any

import pytest
from _pytest import runner

__all__ = ["Apart"]

FIXTURE = "glass"
"""Whoever asks for it builds a whole app."""
FULL = 20
"""Tests in a child; each leaves 60 MB behind."""
OURS = ("app.", "bridge.", "widgets.")
"""Whose modules are imported for the next child: with their kv rules 0.4 s for an app."""


class Apart:
    """A plugin of pytest; nothing where Python cannot fork, or where a debugger wants the terminal."""

    def __init__(self) -> None:
        self._modules: set[object] = set()
        self._items: list[pytest.Item] = []
        self._child: tuple[Connection, int] | None = None
        self._served = 0
        self._wanted: list[str] = []
        """Modules that a child had to import."""

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Find the modules that build apps."""
        usable = hasattr(os, "fork") and not session.config.getoption("usepdb")
        self._items = session.items
        if usable:
            self._modules = {_module(item) for item in session.items if FIXTURE in item.fixturenames}  # type: ignore[attr-defined]

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item, nextitem: pytest.Item | None) -> object:
        """Run `item` where it belongs."""
        if _module(item) not in self._modules:
            if nextitem is None or _module(nextitem) not in self._modules:
                return None
            # nothing narrower than the session may stand when a child is forked
            return runner.pytest_runtest_protocol(item, item.session)  # type: ignore[arg-type]
        item.ihook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
        for report in self._run(item, nextitem):
            item.ihook.pytest_runtest_logreport(report=report)
        item.ihook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
        return True

    def _run(self, item: pytest.Item, nextitem: pytest.Item | None) -> list[pytest.TestReport]:
        if self._child is None:
            self._fork(item.config)
        pipe, _ = self._child or pytest.exit("no child")
        self._served += 1
        last = self._served >= FULL or nextitem is None or _module(nextitem) is not _module(item)
        numbers = {id(one): number for number, one in enumerate(self._items)}
        try:
            pipe.send((numbers[id(item)], None if last else numbers[id(nextitem)]))
            told, imported = pipe.recv()
            self._wanted += imported
        except (EOFError, OSError):
            last = True
            told = []
        if last:
            self._end()
        read = item.config.hook.pytest_report_from_serializable
        reports = [read(config=item.config, data=data) for data in told]
        return reports or [_broken(item)]

    def _fork(self, config: pytest.Config) -> None:
        config._tmp_path_factory.getbasetemp()  # else each child makes its own
        while self._wanted:
            with suppress(ImportError):  # where only what the child's test had put there made it one
                importlib.import_module(self._wanted.pop(0))
        here, there = Pipe()
        with warnings.catch_warnings():
            warnings.simplefilter(
                "ignore", DeprecationWarning
            )  # from 3.12 on: threads of xdist's, that hold nothing
            pid = os.fork()
        if pid == 0:
            here.close()
            status = 1
            try:
                _serve(there, self._items)
                status = 0
            finally:
                os._exit(status)
        there.close()
        self._child, self._served = (here, pid), 0

    def _end(self) -> None:
        if self._child is not None:
            pipe, pid = self._child
            pipe.close()
            os.waitpid(pid, 0)
            self._child = None

    def pytest_sessionfinish(self) -> None:
        """End a child that still waits, as when the run was broken off."""
        self._end()


def _module(item: pytest.Item) -> object:
    return item.getparent(pytest.Module)


def _serve(pipe: Connection, items: list[pytest.Item]) -> None:
    """In the child: run what the pipe says until it closes."""
    first, known = True, set(sys.modules)
    gc.freeze()  # what was there before is none of the child's
    while True:
        try:
            number, following = pipe.recv()
        except EOFError:
            return
        item = items[number]
        nextitem: Any = item.session if following is None else items[following]
        reports = runner.runtestprotocol(item, log=False, nextitem=nextitem)
        if first:
            gc.collect()  # what was not closed complains now, and with the next report
            first = False
        gc.freeze()  # what is left is not looked at again
        write = item.config.hook.pytest_report_to_serializable
        imported = [name for name in list(sys.modules) if name not in known and name.startswith(OURS)]
        known.update(imported)
        pipe.send(([write(config=item.config, report=report) for report in reports], imported))


def _broken(item: pytest.Item) -> pytest.TestReport:
    said = "The process of this test ended before its report."
    return pytest.TestReport(item.nodeid, item.location, {}, "failed", said, "call")

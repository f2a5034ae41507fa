"""A child process for code that must not share one with the measurement; it talks by lines of JSON."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

__all__ = ["Child", "child"]

ROOT = Path(__file__).parents[2]
COMPILED = ROOT / "out" / "compiled"
"""Where compiled modules are kept, unless the environment says where."""
EXIT_TIMEOUT = 0.5
"""Time in which a child ends after its standard input is closed [s]; then it is terminated."""
TERMINATE_TIMEOUT = 10.0
"""Time in which it ends after that [s]; then it is killed."""


class Child:
    """The parent's end of the conversation."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process = process

    def line(self) -> str:
        """The next line it prints; RuntimeError when it has ended."""
        if self.process.stdout is None or not (line := self.process.stdout.readline()):
            raise RuntimeError(f"{self.process.args!r} ended with {self.process.wait()}.")
        return line.rstrip("\n")

    def receive(self) -> Any:
        """The next line of JSON that it prints; other lines are passed over."""
        while not (line := self.line()).startswith(("{", "[")):
            pass
        return json.loads(line)

    def send(self, value: object) -> None:
        """Send it a line of JSON."""
        if self.process.stdin is None:
            raise RuntimeError("This child does not listen.")
        self.process.stdin.write(json.dumps(value) + "\n")
        self.process.stdin.flush()

    def ask(self, value: object) -> Any:
        """Send a request and return its answer."""
        self.send(value)
        return self.receive()


@contextmanager
def child(
    module: str,
    *arguments: str,
    environment: Mapping[str, str] | None = None,
    log: IO[str] | None = None,
    niceness: int = 0,
    own_session: bool = False,
) -> Iterator[Child]:
    """Run `python -m module arguments…`; at the end its standard input is closed, then it is terminated.

    Its standard error goes to `log`, to ours if None. With a `niceness` [1..19] it yields to processes that have none. In
    a session of its own it does not get the Ctrl-C of ours.
    """
    process = subprocess.Popen(
        [sys.executable, "-m", module, *arguments],
        cwd=ROOT,
        env={**_environment(), **(environment or {})},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=log,
        text=True,
        start_new_session=own_session,
    )
    if niceness:
        os.setpriority(os.PRIO_PROCESS, process.pid, niceness)
    try:
        yield Child(process)
    finally:
        _end(process)


def _environment() -> dict[str, str]:
    """Ours, in which modules are compiled once and kept, as for a program that is installed."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {"PYTHONPYCACHEPREFIX": str(COMPILED), **kept}


def _end(process: subprocess.Popen[str]) -> None:
    if process.stdin:
        process.stdin.close()
    for patience, harder in ((EXIT_TIMEOUT, process.terminate), (TERMINATE_TIMEOUT, process.kill)):
        try:
            process.wait(patience)
        except subprocess.TimeoutExpired:
            harder()
    process.wait()
    if process.stdout:
        process.stdout.close()

"""The built-in simulator: a child process that the app starts, owns and ends."""

from __future__ import annotations

import importlib.util
import re
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path

from widgets.core.language import tr

__all__ = ["Inquiry", "Simulator", "available", "command", "inquiry"]

READY = re.compile(r"^robotside: ready\b.*?\bbridge=(\S+)")
PAIR = re.compile(r"^robotside: pair (\S{1,600})$")
START_TIMEOUT = 60.0
"""How long it may take until it serves [s]: a first start compiles and draws much."""
GRACE = 5.0
"""How long it may take to bring the robot to rest and end [s]."""


def available() -> bool:
    """The robot side is on this machine; on a phone it is not."""
    return importlib.util.find_spec("robotside") is not None


def command(robot: str = "sim:patrol", world: str = "") -> list[str]:
    """What starts the robot side on free ports, in the robot's home unless a `world` is said; it works from any folder."""
    serve = [sys.executable, "-m", "robotside", "serve", "--robot", robot]
    where = ["--world", world] if world else []
    return [*serve, *where, "--port", "0", "--http-port", "0", "--pair", "--with-parent"]


def inquiry() -> list[str]:
    """What says which robots and worlds there are, as JSON."""
    return [sys.executable, "-m", "robotside", "offer", "--json"]


class Simulator:
    """One run of the robot side. `on_ready` and `on_failed` are called from a thread of its own."""

    def __init__(
        self,
        arguments: Sequence[str],
        on_ready: Callable[[str], object],
        on_failed: Callable[[str], object],
        *,
        robots: int = 1,
        after: Simulator | None = None,
        patience: float = START_TIMEOUT,
    ) -> None:
        """`on_ready` gets the bridge's url of the first of its `robots`, once all of them are served.

        `on_failed` gets one sentence that says why it does not run (any more). One that runs now, `after` which this one
        starts, is ended first: they may keep their things in the same place.
        """
        self._robots, self._after = robots, after
        self._arguments, self._on_ready, self._on_failed = list(arguments), on_ready, on_failed
        self._patience = patience
        self._process: subprocess.Popen[str] | None = None
        self._said: deque[str] = deque(maxlen=20)
        self._threads: list[threading.Thread] = []
        self._closing = threading.Event()
        self._late = False
        self._urls: list[str] = []
        self.links: tuple[str, ...] = ()
        """Links by which its robots can be paired with, as they were said; of a simulator that says none it is empty."""

    @property
    def url(self) -> str:
        """Where its first robot is served; empty until all of them are."""
        return self._urls[0] if len(self._urls) >= self._robots else ""

    def start(self) -> None:
        """Start the process; returns at once."""
        self._thread("simulator", self._watch)

    def close(self) -> None:
        """End the process, gently first; returns when it is gone."""
        self._closing.set()
        self._end()
        for thread in self._threads:
            if thread is not threading.current_thread():
                thread.join(GRACE)

    def _thread(self, name: str, target: Callable[[], None]) -> None:
        thread = threading.Thread(target=target, name=name, daemon=True)
        self._threads.append(thread)
        thread.start()

    def _end(self) -> None:
        process = self._process
        if process is None or process.poll() is not None:
            return
        process.terminate()
        try:
            process.wait(GRACE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def _watch(self) -> None:
        if self._after is not None:
            self._after.close()
            self._after = None
        try:
            self._process = process = subprocess.Popen(
                self._arguments,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                errors="replace",
                cwd=Path(__file__).parents[2],
            )
        except OSError as error:
            self._on_failed(
                tr("The simulator could not be started: {strerror}.").format(strerror=error.strerror or error)
            )
            return
        timer = threading.Timer(self._patience, self._give_up)
        timer.start()
        if self._closing.is_set():
            self._end()
        with process:
            for line in process.stdout or ():
                self._take(line.strip(), timer)
        timer.cancel()
        timer.join()
        if not self._closing.is_set():
            self._on_failed(self._why(process.returncode))

    def _give_up(self) -> None:
        self._late = True
        self._end()

    def _take(self, line: str, timer: threading.Timer) -> None:
        if line and not line.startswith("robotside: pair "):
            self._said.append(line)
        link = PAIR.match(line)
        if link and len(self.links) < self._robots:
            self.links = (*self.links, link[1])
        match = READY.match(line)
        if match and not self.url:
            self._urls.append(match[1])
            self._report_ready(timer)

    def _report_ready(self, timer: threading.Timer) -> None:
        """Once every robot is served there is nothing to give up any longer."""
        url = self.url
        if url:
            timer.cancel()
            if not self._closing.is_set():
                self._on_ready(url)

    def _why(self, code: int) -> str:
        if self._late:
            return tr("The simulator did not serve within {patience:.0f} s and was ended.").format(
                patience=self._patience
            )
        last = (
            self._said[-1].rstrip(".")
            if self._said
            else tr("it ended with exit code {code}").format(code=code)
        )
        return (
            tr("The simulator has stopped: {last}.").format(last=last)
            if self.url
            else tr("The simulator did not start: {last}.").format(last=last)
        )


class Inquiry:
    """Asks which robots and worlds can be simulated; `on_answer` and `on_failed` are called from a thread of its own."""

    def __init__(
        self,
        arguments: Sequence[str],
        on_answer: Callable[[str], object],
        on_failed: Callable[[str], object],
    ) -> None:
        """`on_answer` gets what was printed; `on_failed` one sentence."""
        self._arguments, self._on_answer, self._on_failed = list(arguments), on_answer, on_failed
        self._closing = threading.Event()
        self._process: subprocess.Popen[str] | None = None
        self._thread = threading.Thread(target=self._ask, name="inquiry", daemon=True)

    def start(self) -> None:
        """Ask; returns at once."""
        self._thread.start()

    def close(self) -> None:
        """Ask no longer; returns when the process is gone."""
        self._closing.set()
        process = self._process
        if process is not None:
            process.kill()
        if self._thread.is_alive():
            self._thread.join(GRACE)

    def _ask(self) -> None:
        try:
            self._process = process = subprocess.Popen(
                self._arguments,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
                errors="replace",
                cwd=Path(__file__).parents[2],
            )
            if self._closing.is_set():
                process.kill()
            said, problem = process.communicate(timeout=START_TIMEOUT)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            self._fail(
                tr("it did not answer within {start_timeout:.0f} s").format(start_timeout=START_TIMEOUT)
            )
        except OSError as error:
            self._fail(error.strerror or str(error))
        else:
            if process.returncode == 0:
                self._answer(said)
            else:
                lines = problem.strip().splitlines()
                self._fail(
                    lines[-1].rstrip(".")
                    if lines
                    else tr("it ended with exit code {returncode}").format(returncode=process.returncode)
                )

    def _answer(self, said: str) -> None:
        if not self._closing.is_set():
            self._on_answer(said)

    def _fail(self, why: str) -> None:
        if not self._closing.is_set():
            self._on_failed(tr("What can be simulated could not be asked: {why}.").format(why=why))

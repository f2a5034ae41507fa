"""The simulator's process: what it says is passed on, and it never outlives the app."""

from __future__ import annotations

import contextlib
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import psutil
import pytest

from app.discovery.simulator_process import Simulator, command

SERVES = (
    "print('robotside: ready bridge=ws://127.0.0.1:4711 http=http://127.0.0.1:1 robot=Patrol-1', flush=True)"
)
WAITS = "import time; time.sleep(600)"
PATIENCE = 20.0


class Run:
    """A simulator that runs a Python text, and what it told."""

    def __init__(self) -> None:
        self.told: queue.Queue[tuple[str, str]] = queue.Queue()
        self.simulators: list[Simulator] = []

    def python(self, text: str, patience: float = 60.0) -> Simulator:
        return self.run([sys.executable, "-c", text], patience)

    def run(self, arguments: list[str], patience: float = 60.0) -> Simulator:
        simulator = Simulator(
            arguments,
            lambda url: self.told.put(("ready", url)),
            lambda sentence: self.told.put(("failed", sentence)),
            patience=patience,
        )
        self.simulators.append(simulator)
        simulator.start()
        return simulator

    def next(self) -> tuple[str, str]:
        return self.told.get(timeout=PATIENCE)


@pytest.fixture
def run() -> Iterator[Run]:
    run = Run()
    yield run
    for simulator in run.simulators:
        simulator.close()


def test_the_links_of_its_robots_are_known_when_they_are_ready_and_shown_to_nobody(run: Run) -> None:
    """A link is a secret: it does not stand in the sentence of a simulator that failed."""
    link = "pilothouse://127.0.0.1:4711?c=aa&s=bb&n=Patrol-1"
    simulator = run.python(f"print('robotside: pair {link}', flush=True); {SERVES}")
    assert run.next() == ("ready", "ws://127.0.0.1:4711")
    assert simulator.links == (link,)
    assert "pilothouse:" not in run.next()[1]


def test_one_that_says_no_link_is_ready_all_the_same(run: Run) -> None:
    simulator = run.python(f"{SERVES}; {WAITS}")
    assert run.next() == ("ready", "ws://127.0.0.1:4711")
    assert simulator.links == ()


def test_a_program_that_is_not_there_is_said(run: Run) -> None:
    run.run(["/nowhere/python"])
    assert run.next() == ("failed", "The simulator could not be started: No such file or directory.")


def test_what_it_said_last_is_the_reason(run: Run) -> None:
    run.python("import sys; print('Port 9090 is taken by another program.', file=sys.stderr); sys.exit(2)")
    assert run.next() == ("failed", "The simulator did not start: Port 9090 is taken by another program.")


def test_one_that_ends_without_a_word_is_told_by_its_exit_code(run: Run) -> None:
    run.python("import sys; sys.exit(3)")
    assert run.next() == ("failed", "The simulator did not start: it ended with exit code 3.")


def test_one_that_never_serves_is_ended(run: Run) -> None:
    run.python(WAITS, patience=0.2)
    kind, sentence = run.next()
    assert kind == "failed"
    assert "did not serve within" in sentence


def test_its_address_is_told_when_it_serves(run: Run) -> None:
    simulator = run.python(f"print('warming up'); {SERVES}; {WAITS}")
    assert run.next() == ("ready", "ws://127.0.0.1:4711")
    assert simulator.url == "ws://127.0.0.1:4711"


def test_one_that_dies_while_it_serves_is_said(run: Run) -> None:
    run.python(f"{SERVES}; import sys; sys.exit('The robot fell over.')")
    assert run.next()[0] == "ready"
    assert run.next() == ("failed", "The simulator has stopped: The robot fell over.")


def test_closing_ends_the_process_and_is_no_failure(run: Run) -> None:
    simulator = run.python(f"{SERVES}; {WAITS}")
    run.next()
    simulator.close()
    assert simulator._process is not None
    assert simulator._process.returncode is not None
    assert run.told.empty()


def test_a_killed_app_leaves_no_simulator_behind(tmp_path: Path) -> None:
    starts = (
        "import subprocess, sys; from app.discovery.simulator_process import command; "
        "child = subprocess.Popen(command(), stdout=subprocess.PIPE, text=True); "
        "print(child.pid, child.stdout.readline().strip(), flush=True); child.wait()"
    )
    env = {**os.environ, "XDG_STATE_HOME": str(tmp_path)}
    parent = subprocess.Popen([sys.executable, "-c", starts], stdout=subprocess.PIPE, text=True, env=env)
    assert parent.stdout is not None
    with parent:
        pid, ready = parent.stdout.readline().split(" ", 1)
        child = psutil.Process(int(pid))
        try:
            assert ready.startswith("robotside: pair pilothouse:")
            parent.kill()
            child.wait(PATIENCE)
        finally:
            with contextlib.suppress(psutil.NoSuchProcess):
                child.kill()
    assert not child.is_running()


def test_the_command_takes_free_ports() -> None:
    arguments = command("sim:patrol", "office")
    assert arguments[1:4] == ["-m", "robotside", "serve"]
    assert arguments[arguments.index("--world") + 1] == "office"
    assert arguments[arguments.index("--port") + 1] == "0"
    assert "--world" not in command("sim:minnow")


def test_several_robots_are_ready_when_the_last_one_is(run: Run) -> None:
    simulator = Simulator(
        [],
        lambda url: run.told.put(("ready", url)),
        lambda sentence: run.told.put(("failed", sentence)),
        robots=2,
    )
    simulator._take("robotside: ready bridge=ws://a:1 http=x", threading.Timer(1, print))
    assert (simulator.url, run.told.empty()) == ("", True)
    simulator._take("robotside: ready bridge=ws://b:2 http=x", threading.Timer(1, print))
    assert run.next() == ("ready", "ws://a:1")


def test_the_next_one_starts_when_the_last_one_has_ended(run: Run) -> None:
    first = run.python(f"{SERVES}; {WAITS}")
    run.next()
    second = Simulator(
        [sys.executable, "-c", f"import psutil; print(psutil.pid_exists({first._process.pid}), flush=True)"],
        lambda url: run.told.put(("ready", url)),
        lambda sentence: run.told.put(("failed", sentence)),
        after=first,
    )
    run.simulators.append(second)
    second.start()
    assert run.next() == ("failed", "The simulator did not start: False.")
    assert first._process.returncode is not None

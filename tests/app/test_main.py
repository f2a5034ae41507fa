"""The command line: a mistake is one sentence and exit code 2, before any window opens."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from app.__main__ import _parse, end_at_once_by_signal, main
from app.discovery.beacon_listener import BeaconListener
from app.link.feeds import Mailbox
from bridge.discovery.domain import VARIABLE

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["http://10.0.0.3"], "An address begins with ws:// or wss://, not http://."),
        (["ws://10.0.0.3:99999"], "ws://10.0.0.3:99999 has no valid port: it is a number from 1 to 65535."),
        (
            ["--layout", "boat"],
            "There is no layout 'boat'; there are: aqua, ardrone, commander, minnow, patrol, scout.",
        ),
        (
            ["pilothouse://10.0.0.3"],
            "This is no link of a robot; one begins with pilothouse:// and is complete.",
        ),
        (
            ["pilothouse://layout?v=1&d=x"],
            "This link of a profile is not complete; copy it again.",
        ),
        (
            ["--pair", "ws://10.0.0.3"],
            "This is no pairing link of a robot; one begins with pilothouse:// and is complete.",
        ),
        (["--size", "large"], "A size is written as 412x892, not 'large'."),
        (
            ["--domain", "team 2"],
            "A discovery domain has at most 32 letters, digits, _ and -, which 'team 2' is not.",
        ),
        (["--colour"], "Unrecognized arguments: --colour."),
    ],
)
def test_a_mistake_is_one_sentence(
    arguments: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 2
    assert capsys.readouterr().err == f"{sentence}\n"


@pytest.mark.parametrize(
    ("arguments", "around", "domain"),
    [
        ([], "team_1", "team_1"),
        (["--domain", "team_2"], "team_1", "team_2"),
        (["--domain", ""], "team_1", ""),
    ],
)
def test_robots_are_looked_for_in_the_domain_of_the_option_else_of_the_environment(
    monkeypatch: pytest.MonkeyPatch, arguments: list[str], around: str, domain: str
) -> None:
    monkeypatch.setenv(VARIABLE, around)
    _parse(arguments)
    nearby = BeaconListener(Mailbox(lambda: None), None, now=lambda: 0.0)  # type: ignore[arg-type]
    assert nearby._domain == nearby._calls._domain == domain


def test_a_domain_of_the_environment_that_is_none_is_one_sentence(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(VARIABLE, "a/b")
    assert main([]) == 2
    assert capsys.readouterr().err.startswith(f"{VARIABLE}: A discovery domain has at most 32 letters")


@pytest.mark.parametrize("option", ["--screen", "--theme"])
def test_a_wrong_choice_names_what_is_allowed(option: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([option, "nothing"]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "choose from" in said


def test_a_mistake_is_said_without_starting_kivy() -> None:
    code = (
        "import sys; from app.__main__ import main; main(['--layout', 'x']); sys.exit('kivy' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-OO", "-c", code], cwd=ROOT, check=False, capture_output=True, text=True, timeout=60
    )
    assert (done.returncode, done.stderr.count("\n")) == (0, 1)


@pytest.mark.parametrize("android", [False, True])
def test_frames_are_paced_on_desktops_alone(android: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[dict[str, Any]] = []

    class App:
        def __init__(self, *_: object, **options: Any) -> None:
            made.append(options)

        def run(self) -> None:
            """Its window was closed."""

    monkeypatch.setattr("app.__main__.is_android", lambda: android)
    monkeypatch.setattr("app.__main__.prepare", lambda _: None)
    monkeypatch.setattr("app.application.PilothouseApp", App)
    assert main([]) == 0
    assert made[0]["poll"] is not android


def test_a_signal_ends_the_app_in_order_and_asks_nobody() -> None:
    from kivy.base import EventLoop

    before, quits = signal.getsignal(signal.SIGTERM), EventLoop.quit
    try:
        end_at_once_by_signal()
        os.kill(os.getpid(), signal.SIGTERM)
        assert EventLoop.quit
    finally:
        signal.signal(signal.SIGTERM, before)
        EventLoop.quit = quits

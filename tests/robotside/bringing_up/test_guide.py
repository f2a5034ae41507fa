"""`robotside guide` beside a robot that runs, and what it says where none does."""

from __future__ import annotations

import asyncio
import socket
from pathlib import Path

import pytest

from robotside.__main__ import main
from robotside.bringing_up import guide
from robotside.bringing_up.robot_file import kept_at
from tests.fakes import FakeRobot
from tests.robotside.serving.test_station_server import serving


async def test_it_shows_the_usage_sheet_of_the_robot_that_runs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    async with serving(tmp_path / "state", FakeRobot()) as serves:
        assert await asyncio.to_thread(main, ["guide", "--at", serves.addresses.http]) == 0
        (tmp_path / "robot.toml").write_text(f"[serve]\nhttp_port = {serves.addresses.http_port}\n")
        assert await asyncio.to_thread(main, ["guide", "--state", str(tmp_path)]) == 0
        await asyncio.get_running_loop().shutdown_default_executor()
    first, _, second = capsys.readouterr().out.partition("In Python:")
    assert serves.addresses.bridge in first
    assert '{"op": "call_service", "service": "/stop", "args": {}}' in first
    assert serves.addresses.bridge in second


def test_where_none_runs_it_says_where_it_asked(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        site = f"http://127.0.0.1:{closed.getsockname()[1]}"
        assert main(["guide", "--at", site]) == 2
    said = capsys.readouterr().err
    assert said == f"robotside: No robot answers at {site}: connection refused; --at names another.\n"


@pytest.mark.parametrize("site", ["https://127.0.0.1", "file:///etc/passwd", "8080"])
def test_it_opens_no_other_address_than_a_robots(site: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["guide", "--at", site]) == 2
    assert "--at is a URL as http://127.0.0.1:8080" in capsys.readouterr().err


def test_a_damaged_robot_toml_is_no_reason_not_to_ask(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guide, "_asked", lambda site: f"asked {site}")
    kept_at(tmp_path).write_text("[")
    assert main(["guide", "--state", str(tmp_path)]) == 0
    assert capsys.readouterr().out == "asked http://127.0.0.1:8080"

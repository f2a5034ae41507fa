"""The demo's summary."""

from __future__ import annotations

import json

import pytest

from examples.demo import report as module
from examples.demo.report import Report


@pytest.fixture
def report(tmp_path, monkeypatch):
    monkeypatch.setattr(module, "picture", lambda path: path.write_bytes(b"picture"))
    return Report(tmp_path / "demo")


def test_a_story_that_held_ends_with_0(report, capsys):
    report.begin("connect")
    assert report.check("the robot is listed [s]", 0.51234, True)
    report.end()
    assert report.write(speed=1.0) == 0
    summary = json.loads((report.folder / "summary.json").read_text())
    assert summary["ok"] is True
    assert summary["steps"][0]["checks"] == [
        {"expected": "the robot is listed [s]", "measured": 0.512, "ok": True, "timed": False}
    ]
    assert (report.folder / summary["steps"][0]["picture"]).exists()
    assert "ok    1 connect" in capsys.readouterr().out


def test_a_failed_expectation_ends_with_1_and_is_named(report, capsys):
    report.begin("home")
    report.check("home [m off]", 0.4, False)
    report.end()
    assert report.write() == 1
    assert "demo: home: expected home [m off], measured 0.4" in capsys.readouterr().err


def test_a_story_that_ended_early_says_where(report, capsys):
    report.begin("home")
    report.end()
    report.fault = "home: waited 5 s for a map in vain."
    assert report.write() == 1
    assert "demo: home: waited 5 s" in capsys.readouterr().err


def test_an_old_run_is_cleared_away(report):
    (report.folder / "99-old.png").write_bytes(b"")
    Report(report.folder)
    assert not list(report.folder.glob("*.png"))

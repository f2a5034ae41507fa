"""The main screens on a phone and a tablet, in all themes: what is wrong is known by name and reason, or it fails."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.app.fakes import FakeRobot
from tests.app.glass import running
from tests.headless import Stage
from tests.layout_lint.scenes import fill
from tests.layout_lint.walk import DAILY, Finding, Walk

GROUPS = tomllib.loads(Path(__file__).with_name("known.toml").read_text(encoding="utf-8"))["group"]
KNOWN = {fault for group in GROUPS for fault in group["faults"]}
"""What is wrong and may be for now, each as its kind and its place in the tree."""
MAIN = ("drive", "mission", "tasks", "panels", "more", "setup", "leave")
"""Scenes that are looked at each day."""


@pytest.fixture
def walk(stage: Stage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Walk]:
    """Over an app that drives a robot which has something to say on every screen."""
    # Kivy: its first import comes after tests/conftest.py prepared it
    from app.garbage_collector import Collector
    from widgets.core.language import language
    from widgets.core.theme import theme

    monkeypatch.setattr(Collector, "step", lambda *_, **__: None)
    robot, before = FakeRobot(), tuple(stage.window.size)
    try:
        with running(stage, tmp_path) as glass:
            glass.app.open(robot.url)
            glass.drives()
            fill(robot, glass)
            yield Walk(glass)
    finally:
        robot.close()
        stage.window.size, theme.gloves, language.name = before, False, "en"


def named(finding: Finding) -> str:
    return f"{finding.fault.kind}: {finding.fault.where}"


def unknown(findings: list[Finding]) -> list[str]:
    """The first of each that is in no group."""
    first: dict[str, Any] = {}
    for finding in findings:
        first.setdefault(named(finding), finding)
    return [str(finding) for name, finding in first.items() if name not in KNOWN]


def test_each_known_fault_has_a_reason_and_is_named_once() -> None:
    assert all(group["reason"].endswith(".") and group["faults"] for group in GROUPS)
    assert len(KNOWN) == sum(len(group["faults"]) for group in GROUPS), "one is named twice"


def test_nothing_new_is_wrong_with_the_main_screens_on_a_phone_and_a_tablet(walk: Walk) -> None:
    findings = list(walk.over(DAILY, MAIN))
    wrong, found = unknown(findings), {named(finding) for finding in findings}
    assert walk.looks == len(MAIN) * 2
    assert not wrong, "\n".join(wrong)
    assert not KNOWN - found, "mended, and still listed"

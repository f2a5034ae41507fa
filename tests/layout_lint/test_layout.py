"""The main screens on a phone upright and on its side: what is wrong is known by name and reason, or it fails."""

from __future__ import annotations

from pathlib import Path

from tests.headless import Stage
from tests.layout_lint.known import GROUPS, KNOWN, verdict
from tests.layout_lint.walk import Finding, Walk
from tests.layout_lint.ways import DAILY, WHOLE

MAIN = (
    "connect robots",
    "drive",
    "mission",
    "tasks",
    "topics",
    "setup",
    "setup name",
    "leave",
    "replay open",
)
"""Scenes that are looked at each day: those in which what many screens share has its place."""


def unknown(findings: list[Finding]) -> list[str]:
    """The first of each that is in no group."""
    first: dict[str, Finding] = {}
    for finding in findings:
        first.setdefault(finding.name, finding)
    return [str(finding) for name, finding in first.items() if name not in KNOWN]


def test_each_known_fault_has_a_reason_and_is_named_once() -> None:
    assert all(group["reason"].endswith(".") and group["faults"] for group in GROUPS)
    assert len(KNOWN) == sum(len(group["faults"]) for group in GROUPS), "one is named twice"


def test_a_new_fault_fails_and_one_that_is_mended_must_leave_the_list() -> None:
    some = min(KNOWN)
    assert verdict(KNOWN, whole=True) == []
    assert verdict([*KNOWN, "small: Root>Elsewhere"], whole=True) == ["new: small: Root>Elsewhere"]
    assert verdict(KNOWN - {some}, whole=True) == [f"mended, and still named: {some}"]
    assert verdict(KNOWN - {some}, whole=False) == [], "a part of the walk comes upon a part of them"


def test_the_whole_walk_has_each_language_in_each_size_of_text() -> None:
    assert len({(way.language, way.text) for way in WHOLE}) == len(WHOLE) == 18


def test_nothing_new_is_wrong_with_the_main_screens_on_a_phone(stage: Stage, tmp_path: Path) -> None:
    walk = Walk(stage, tmp_path)
    wrong = unknown(list(walk.over(DAILY, MAIN)))
    assert walk.looks == len(MAIN) * (2 + 3), "two sizes and three themes"
    assert not wrong, "\n".join(wrong)

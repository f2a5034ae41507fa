"""One number of robots, with those that cannot be heard, for every place that says how many there are."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from app.discovery.known_robots import Entry
from app.stop.robot_count import RobotCount, count

A, B, C = (f"ws://10.0.0.{number}:9090" for number in (1, 2, 3))


def entry(url: str, silent: float = 0.1, **told: Any) -> Entry:
    return replace(Entry(url, "Patrol-1", silent=silent), **told)


def linked(url: str = A, *, connected: bool = True, boot: str = "", ever: bool = True) -> Any:
    return SimpleNamespace(
        robot=SimpleNamespace(url=url), connected=connected, boot=boot, ever_connected=ever
    )


@pytest.mark.parametrize(
    ("entries", "link", "counted"),
    [
        ([], None, (0, 0, 0)),
        ([entry(A), entry(B)], None, (2, 0, 0)),
        ([entry(A), entry(B, 30.0)], None, (2, 1, 0)),
        ([entry(A, math.nan, met=True)], None, (1, 0, 1)),
        ([entry(A, math.nan, met=False)], None, (0, 0, 0)),
        ([entry(A, reached=False)], None, (1, 1, 0)),
        # one robot at two addresses is as near as it is at either
        ([entry(A, boot="b"), entry(B, 30.0, boot="b")], None, (1, 0, 0)),
        # what is saved is never counted as another
        ([entry(A, boot="b"), entry(B, 30.0, boot="b", kept=True)], None, (2, 1, 0)),
        # the one on the glass is as near as its link, whatever its HELLO says
        ([entry(A, 30.0)], linked(), (1, 0, 0)),
        ([entry(A)], linked(connected=False), (1, 1, 0)),
        ([entry(B, boot="b")], linked(boot="b"), (1, 0, 0)),
        ([entry(B, boot="b")], linked(boot="b", connected=False), (1, 0, 0)),
        ([], linked(ever=False), (0, 0, 0)),
        ([entry(A), entry(B, 30.0), entry(C, math.nan)], linked(), (3, 1, 1)),
    ],
)
def test_each_robot_is_counted_once_and_as_near_as_it_is(
    entries: list[Entry], link: Any, counted: tuple[int, int, int]
) -> None:
    assert count(entries, link) == RobotCount(*counted)

"""Other robots of one name: who counts as one, for how long, and when the own state is to be said again."""

from __future__ import annotations

import json
from typing import Any

import pytest

from bridge.core.codes import Code
from bridge.core.errors import Refused
from robotside.gateways.broker.namesakes import HOLD_TIME, MAX_NAMESAKES, Namesakes


class Robot:
    """Notes what its namesakes make it say and do."""

    def __init__(self) -> None:
        self.said: list[tuple[Any, ...]] = []
        self.left = 0
        self.namesakes = Namesakes(
            "mqtt", "MQTT broker", "own", "Rex", lambda *said, **_: self.said.append(said)
        )

    def hear(self, state: str, boot: str, now: float = 0.0) -> bool:
        raw = json.dumps({"state": state, "robot": "Rex", "boot": boot}).encode()
        return self.namesakes.hear(raw, now, self._leave)

    def _leave(self) -> None:
        self.left += 1


@pytest.fixture
def robot() -> Robot:
    return Robot()


def test_another_identity_that_is_online_is_an_alarm_and_refuses_all(robot: Robot) -> None:
    assert robot.hear("online", "other")
    assert not robot.hear("online", "third")
    assert robot.left == 1
    ((_, notice, level),) = robot.said
    assert (notice.code, level) == (Code.GATEWAY_NAMESAKE, "alarm")
    with pytest.raises(Refused, match="named Rex too, so both take STOP only"):
        robot.namesakes.check()


@pytest.mark.parametrize(
    "raw", [b"", b"[", b"[1]", b'{"state": "online"}', b"\xff", b'{"state": 1, "boot": "x"}']
)
def test_what_is_no_state_is_passed_over(raw: bytes, robot: Robot) -> None:
    assert not robot.namesakes.hear(raw, 0.0, lambda: None)
    robot.namesakes.check()


def test_an_end_of_its_own_that_comes_late_is_set_right(robot: Robot) -> None:
    assert robot.hear("lost", "own")
    assert not robot.hear("online", "own")
    assert not robot.hear("offline", "nobody")
    robot.namesakes.check()
    assert not robot.said


@pytest.mark.parametrize("end", ["offline", "lost"])
def test_it_obeys_again_when_the_last_namesake_has_ended(end: str, robot: Robot) -> None:
    robot.hear("online", "other")
    robot.hear("online", "third")
    robot.hear(end, "other")
    assert robot.namesakes
    assert robot.hear(end, "third")
    robot.namesakes.check()


def test_one_that_is_silent_is_forgotten_and_until_then_told_who_is_here(robot: Robot) -> None:
    assert not robot.namesakes.update(0.0)
    robot.hear("online", "other")
    robot.hear("online", "other", 1.0)
    assert robot.namesakes.update(HOLD_TIME)
    assert robot.namesakes
    assert robot.namesakes.update(HOLD_TIME + 1.0)
    assert not robot.namesakes
    assert not robot.namesakes.update(HOLD_TIME + 1.0)


def test_no_more_are_remembered_than_can_be(robot: Robot) -> None:
    for each in range(MAX_NAMESAKES + 5):
        robot.hear("online", f"{each}")
    assert len(robot.namesakes._until) == MAX_NAMESAKES

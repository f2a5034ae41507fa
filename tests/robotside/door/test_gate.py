"""The gate: what each role may do at the door, and what happens to who may nothing any more."""

from __future__ import annotations

import pytest

from bridge.core.errors import Refused
from bridge.core.identity import STRANGER, Identity, Role
from bridge.core.robot_catalogue import Action, Operator, Service
from bridge.core.topics import TOPICS
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    RunTaskFeedback,
    RunTaskGoal,
    RunTaskResult,
)
from robotside.door.door import Door
from robotside.door.gate import check_role
from robotside.trust.permissions import PERMISSIONS, needed_role

KEYS = {"w": Role.WATCH, "d": Role.DRIVE, "m": Role.MANAGE}


class OneKeyEach:
    """Knows one person of each role; everybody else is a stranger."""

    def admit(self, address: str, *, trusted: bool) -> Identity:
        return STRANGER

    def identify(self, token: str, address: str, client: str = "") -> Identity:
        if token not in KEYS:
            raise Refused("This key is not known here.")
        return Identity(token, f"Person {token}", KEYS[token], ends=100.0, proven=True)

    def needed(self, verb: str, name: str) -> Role:
        return needed_role(verb, name)


GATE = OneKeyEach()


def door(**more: object) -> Door:
    done = Service(
        "/task/start",
        "pilothouse_msgs/Command",
        CommandRequest,
        CommandResponse,
        lambda *_: CommandResponse(True),
    )
    return Door(gate=GATE, services=[done], **more)  # type: ignore[arg-type]


def test_a_stranger_neither_publishes_nor_calls_nor_listens() -> None:
    taken: list[object] = []
    own = door(on_message=lambda *all: taken.append(all))
    stranger = own.join("192.0.2.9:1")
    with pytest.raises(Refused, match="pair with it first"):
        own.publish(stranger, "/cmd_vel", Twist(), None)
    with pytest.raises(Refused, match="pair with it first"):
        own.call(stranger, "/task/start", CommandRequest())
    with pytest.raises(Refused, match="pair with it first"):
        own.check(stranger, "subscribe", "/pose")
    assert taken == []


def test_who_watches_does_not_drive_and_is_told_what_it_takes() -> None:
    own = door()
    watcher = own.join("192.0.2.9:1", token="w")
    own.check(watcher, "subscribe", "/pose")
    with pytest.raises(Refused, match="needs the role drive; you have watch"):
        own.publish(watcher, "/cmd_vel", Twist(), None)


def test_who_drives_drives() -> None:
    taken: list[object] = []
    own = door(on_message=lambda *all: taken.append(all))
    driver = own.join("192.0.2.9:1", token="d")
    own.publish(driver, "/cmd_vel", Twist(), None)
    assert own.call(driver, "/task/start", CommandRequest()) == CommandResponse(True)
    assert len(taken) == 1


async def test_a_goal_needs_a_role_as_a_service_does() -> None:
    begun: list[str] = []

    async def start(operator: Operator, *_: object) -> RunTaskResult:
        begun.append(operator.id)
        return RunTaskResult()

    goal = Action("/task/run", "pilothouse_msgs/RunTask", RunTaskGoal, RunTaskResult, RunTaskFeedback, start)
    own = door(actions=[goal])
    for key, sentence in (("", "pair with it first"), ("w", "needs the role drive")):
        with pytest.raises(Refused, match=sentence):
            await own.run(own.join("192.0.2.9:1", token=key), "/task/run", RunTaskGoal(), lambda _: None)
    assert begun == []
    driver = own.join("192.0.2.9:1", token="d")
    await own.run(driver, "/task/run", RunTaskGoal(), lambda _: None)
    assert begun == [driver.id]


def test_a_role_ends_at_its_time() -> None:
    clock = [99.9]
    own = door(now=lambda: clock[0])
    driver = own.join("192.0.2.9:1", token="d")
    own.publish(driver, "/cmd_vel", Twist(), None)
    clock[0] = 100.0
    with pytest.raises(Refused, match="pair with it first"):
        own.publish(driver, "/cmd_vel", Twist(), None)


def test_a_wrong_token_does_not_come_in() -> None:
    with pytest.raises(Refused, match="not known"):
        door().join("192.0.2.9:1", token="x")


def test_who_is_somebody_else_from_now_on_keeps_nothing_of_who_it_was() -> None:
    gone: list[Operator] = []
    own = door(on_gone=gone.append)
    client = own.join("192.0.2.9:1", token="d")
    own.authenticate(client, "d")
    assert gone == []
    own.authenticate(client, "w")
    assert gone == [client]
    assert client.identity.role is Role.WATCH


def test_who_is_expelled_may_nothing_stops_driving_and_is_cut_off() -> None:
    gone: list[Operator] = []
    cut: list[str] = []
    own = door(on_gone=gone.append)
    client, other = (own.join("192.0.2.9:1", token=key) for key in "dm")
    nobody = own.join("192.0.2.9:1")
    nobody.on_expelled = lambda: cut.append("nobody")
    client.on_expelled = lambda: cut.append("d")
    other.on_expelled = lambda: cut.append("m")
    own.expel(["d", ""])
    assert (gone, cut) == ([client], ["d"])
    with pytest.raises(Refused):
        own.publish(client, "/cmd_vel", Twist(), None)


def test_what_nobody_thought_of_is_for_managers() -> None:
    assert needed_role("call", "/made/up") is Role.MANAGE
    assert needed_role("conjure", "/pose") is Role.MANAGE


@pytest.mark.parametrize("topic", [topic.name for topic in TOPICS if topic.to == "robot"])
def test_every_topic_that_robots_listen_to_has_its_line(topic: str) -> None:
    assert PERMISSIONS[f"publish {topic}"] is Role.DRIVE


def test_the_gate_names_role_and_operation() -> None:
    watcher = Operator("1", "192.0.2.9:1", 0.0, identity=GATE.identify("w", ""))
    with pytest.raises(Refused) as refused:
        check_role(GATE, watcher, 0.0, "call", "/settings/set")
    notice = refused.value.args[0]
    assert notice.code == "trust_role"
    assert dict(notice.parameters) == {"operation": "call /settings/set", "role": "watch", "needed": "manage"}

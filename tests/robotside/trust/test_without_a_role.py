"""No sequence of operations by identities without the role moves the robot, changes what is kept, or shows the camera."""

from __future__ import annotations

import asyncio
import copy
import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bridge.core.errors import Refused
from bridge.core.identity import Identity, Role
from bridge.core.robot_catalogue import Operator
from bridge.core.topics import TOPICS
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    RunTaskGoal,
    SetMissionRequest,
    StartTaskRequest,
    TaskOrder,
    Waypoint,
)
from bridge.protocol import OPS
from bridge.server.flow.send_queue import WriteBatch
from bridge.server.rosbridge_session import RosbridgeSession
from robotside.door.station_door import StationDoor
from robotside.gateways.rosbridge.gateway import RosbridgeGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from robotside.trust.permissions import needed_role
from tests.bridge.server.flow.test_send_queue import FrameWriter
from tests.bridge.strategies import messages
from tests.fakes import FakeRobot
from tests.robotside.scene import SQUARE, Scene

LISTENS = [topic for topic in TOPICS if topic.to == "robot"]
SHOWN_TO_ALL = {"/robot/info"}
"""Topics that a stranger may read."""
NOTES = {"events", "answers", "audit"}
"""Tables in which the robot notes what happened: refusals stand there too."""
STOP_FACTS = {"stopped by", "stopped by id", "last event"}
"""What STOP changes, which anybody may press; and the counter of events."""

DRIVING: list[tuple[str, Any, Any]] = [
    ("call", "/control/acquire", CommandRequest()),
    ("publish", "/cmd_vel", Twist()),
    ("publish", "/cmd_vel", Twist.planar(0.5, 0.0)),
    ("run", "/task/run", RunTaskGoal(order=TaskOrder(task="patrol"))),
    ("call", "/task/start", StartTaskRequest()),
]


class OneRole:
    """Everybody has the same role."""

    def __init__(self, role: Role) -> None:
        self.role = role

    def admit(self, address: str, *, trusted: bool) -> Identity:
        return Identity("", "", self.role)

    def identify(self, token: str, address: str, client: str = "") -> Identity:
        raise Refused("This key is not known here.")

    def needed(self, verb: str, name: str) -> Role:
        return needed_role(verb, name)


class Guarded(Scene):
    """A station at rest with a mission, and a door at which everybody has one role."""

    def __init__(self, state: Path, role: Role) -> None:
        super().__init__(FakeRobot(), state)
        self.run(5.0)
        assert self.ask("/mission/set", _mission()).success
        self.gated = StationDoor(self.station, OneRole(role))
        self.robot.commands.clear()
        self.before = self.kept()

    def kept(self) -> dict[str, Any]:
        written = self.station.records._ledger.memory.current
        tables = {name: rows for name, rows in written.items() if name not in NOTES}
        facts = {key: value for key, value in tables["facts"].items() if key not in STOP_FACTS}
        return copy.deepcopy(tables | {"facts": facts})

    def check(self) -> None:
        """Nothing moved and nothing was changed."""
        self.run(0.5)
        moved = [each for each in self.robot.commands if each not in (None, Twist())]
        assert moved == []
        assert not self.station.autonomy.engine.running
        assert self.kept() == self.before


def _mission() -> SetMissionRequest:
    request = SetMissionRequest()
    request.mission.waypoints[:] = SQUARE
    request.mission.home[:] = [Waypoint(0.0, 0.0)]
    return request


def tried(door: StationDoor, operator: Operator, step: tuple[str, Any, Any]) -> str:
    """One operation; why it was refused, empty when it was not."""
    kind, name, message = step
    try:
        if kind == "call":
            door.call(operator, name, message)
        elif kind == "publish":
            door.publish(operator, name, message, None)
        else:
            asyncio.run(_begun(door, operator, name, message))
    except Refused as refused:
        return str(refused)
    return ""


async def _begun(door: StationDoor, operator: Operator, action: str, goal: Any) -> None:
    """Refused unless the goal is under way a few turns later; then it is taken back."""
    work = asyncio.ensure_future(door.run(operator, action, goal, lambda _: None))
    await asyncio.wait({work}, timeout=0.0)
    if work.done():
        work.result()
    work.cancel()
    await asyncio.wait({work})


def operations(door: StationDoor) -> st.SearchStrategy[tuple[str, Any, Any]]:
    calls = [
        st.tuples(st.just("call"), st.just(name), messages(service.request))
        for name, service in door.services.items()
    ]
    publishes = [
        st.tuples(st.just("publish"), st.just(topic.name), messages(topic.type)) for topic in LISTENS
    ]
    return st.one_of(
        *calls, *publishes, st.tuples(st.just("run"), st.just("/task/run"), messages(RunTaskGoal))
    )


@pytest.mark.slow
@pytest.mark.parametrize("role", [Role.NONE, Role.WATCH])
@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_nobody_without_the_role_moves_or_changes_anything(
    role: Role, data: st.DataObject, tmp_path_factory: pytest.TempPathFactory
) -> None:
    scene = Guarded(tmp_path_factory.mktemp("state"), role)
    operators = [scene.gated.join(f"192.0.2.{number}:1") for number in (1, 2, 3)]
    for step in data.draw(st.lists(operations(scene.gated), max_size=25)):
        operator = data.draw(st.sampled_from(operators))
        operator.asked_time, operator.last_heard, operator.answered = True, scene.clock, scene.clock
        tried(scene.gated, operator, step)
        scene.run(data.draw(st.sampled_from([0.0, 0.1])))
    scene.check()


@pytest.mark.parametrize("role", [Role.NONE, Role.WATCH])
def test_what_moves_the_robot_for_a_driver_does_nothing_without_the_role(role: Role, tmp_path: Path) -> None:
    scene = Guarded(tmp_path, role)
    operator = scene.gated.join("192.0.2.1:1")
    operator.asked_time, operator.last_heard, operator.answered = True, scene.clock, scene.clock
    for step in DRIVING:
        assert re.search("pair with it first|needs the role drive", tried(scene.gated, operator, step))
        scene.run(0.05)
    scene.check()


def test_the_same_operations_by_a_driver_are_done(tmp_path: Path) -> None:
    """Else the property above would hold of a robot that is broken."""
    scene = Guarded(tmp_path, Role.DRIVE)
    driver = scene.gated.join("192.0.2.1:1")
    driver.asked_time, driver.last_heard, driver.answered = True, scene.clock, scene.clock
    assert [tried(scene.gated, driver, step) for step in DRIVING] == [""] * len(DRIVING)
    scene.run(0.5)
    assert any(each not in (None, Twist()) for each in scene.robot.commands)


@contextmanager
def rosbridge(scene: Guarded) -> Iterator[tuple[RosbridgeSession, FrameWriter]]:
    """A client of the rosbridge gateway, within the program."""
    loop = asyncio.new_event_loop()
    pictures = PictureScaler()
    gateway = RosbridgeGateway(scene.gated, "127.0.0.1", 0, pictures, lambda now: now)
    writer, soon = FrameWriter(), []

    async def session() -> RosbridgeSession:
        operator = scene.gated.join("192.0.2.7:1")
        return RosbridgeSession(writer, WriteBatch(soon.append), operator, gateway.server._context)

    made = loop.run_until_complete(session())
    made.sent = lambda: [soon.pop(0)() for _ in list(soon)]  # type: ignore[attr-defined]
    made.run = loop.run_until_complete  # type: ignore[attr-defined]
    try:
        yield made, writer
    finally:
        loop.run_until_complete(made.close())
        loop.run_until_complete(gateway.stop())
        loop.run_until_complete(pictures.close())
        loop.close()


ANY_OP = st.fixed_dictionaries(
    {"op": st.sampled_from(sorted(str(each.__struct_config__.tag) for each in OPS))},
    optional={
        "topic": st.sampled_from([topic.name for topic in TOPICS] + ["/made_up"]),
        "service": st.sampled_from(["/task/start", "/stop", "/events/get", "/rosapi/topics", "/made_up"]),
        "action": st.sampled_from(["/task/run", "/made_up"]),
        "type": st.sampled_from(["std_msgs/String", "geometry_msgs/Twist", "std_srvs/Trigger"]),
        "id": st.sampled_from(["1", "2"]),
        "token": st.sampled_from(["", "guess"]),
        "msg": st.sampled_from([{}, {"linear": {"x": 0.5}}, {"data": "x"}]),
        "args": st.just({}),
        "values": st.just({}),
        "result": st.booleans(),
    },
)


@pytest.mark.slow
@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@given(ops=st.lists(ANY_OP, max_size=40))
def test_a_stranger_at_rosbridge_is_shown_and_moves_nothing(
    ops: list[dict[str, Any]], tmp_path_factory: pytest.TempPathFactory
) -> None:
    scene = Guarded(tmp_path_factory.mktemp("state"), Role.NONE)
    with rosbridge(scene) as (session, writer):

        async def say() -> None:
            for op in ops:
                session.on_message(json.dumps(op))
                scene.run(0.05)

        session.run(say())  # type: ignore[attr-defined]
        session.sent()  # type: ignore[attr-defined]
        shown = [json.loads(text) for text in writer.heard]
    topics = {op["topic"] for op in shown if op["op"] == "publish"}
    assert topics <= SHOWN_TO_ALL
    assert not [op for op in shown if op["op"] in ("call_service", "send_action_goal", "action_feedback")]
    scene.check()


def test_no_topic_and_no_camera_is_shown_to_a_stranger(tmp_path: Path) -> None:
    scene = Guarded(tmp_path, Role.NONE)
    stranger = scene.gated.join("192.0.2.7:1")
    hidden = [("subscribe", topic.name) for topic in TOPICS if topic.name not in SHOWN_TO_ALL]
    for verb, name in (*hidden, ("camera", "front"), ("camera", "camera"), ("page", "/snapshot/front.jpg")):
        with pytest.raises(Refused, match="pair with it first"):
            scene.gated.check(stranger, verb, name)

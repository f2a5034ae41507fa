"""The robot side as its clients meet it, without sockets and in virtual time."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from bridge.codec import to_json
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import (
    Point,
    Pose,
    PoseStamped,
    PoseWithCovariance,
    PoseWithCovarianceStamped,
    Quaternion,
    Twist,
)
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    ControlStatus,
    Event,
    GetEventsRequest,
    GetMissionRequest,
    IntruderArray,
    Mission,
    SetMissionRequest,
    StartTaskRequest,
    TaskProgress,
    TaskStatus,
    Waypoint,
)
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header, Time
from bridge.topics import TOPICS
from robotside.controls import STOP_SENTENCE
from robotside.orders import services
from robotside.station import Station
from robotside.store import Store
from tests.fakes import Box, FakeClient, FakeRobot, Pillar
from tests.robotside.test_detect import cone, jpeg, picture

TICK = 1 / 60
SQUARE = [Waypoint(4.0, 0.0), Waypoint(4.0, 3.0), Waypoint(-2.0, 3.0)]


class Scene:
    """A station on a fake robot, with its messages recorded and time in hand.

    `now` is the robot's clock, which runs `speed` times as fast as the operators', `clock`.
    """

    def __init__(self, robot: FakeRobot, state: Path, speed: float = 1.0) -> None:
        self.now = self.clock = 1000.0
        self._speed = speed
        self.robot = robot
        self.clients: list[FakeClient] = []
        self.anna = self.client("anna")
        self.station = Station(
            robot, Store(state), now=self.now, clock=lambda: self.clock, rng=random.Random(1), boot="b1"
        )
        self.said: list[tuple[str, Msg]] = []
        self.station.bus.subscribe(None, lambda topic, msg: self.said.append((topic, msg)))
        self._services = {service.name: service for service in services(self.station)}

    def client(self, name: str) -> FakeClient:
        client = FakeClient(name, self.clock)
        self.clients.append(client)
        return client

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / TICK)):
            self.now += TICK
            self.clock += TICK / self._speed
            for client in self.clients:
                client.last_heard = self.clock
            self.station.step(self.now)

    def run_task(self, limit: float = 200.0) -> TaskStatus:
        end = self.now + limit
        while self.station.autonomy.engine.running and self.now < end:
            self.run(0.1)
        return self.station.autonomy.engine.status

    def ask(self, name: str, request: Msg | None = None, client: FakeClient | None = None) -> CommandResponse:
        answer = self._services[name].call(client or self.anna, request or CommandRequest())  # type: ignore[arg-type]
        assert isinstance(answer, Msg)
        return answer  # type: ignore[return-value]

    def refused(self, name: str, request: Msg | None = None, client: FakeClient | None = None) -> str:
        answer = self.ask(name, request, client)
        assert not answer.success
        return answer.message

    def set(self, *points: Waypoint, **words: object) -> None:
        home = words.pop("home", [Waypoint(0.0, 0.0)])
        mission = Mission(waypoints=list(points), home=home, **words)  # type: ignore[arg-type]
        answer = self.ask("/mission/set", SetMissionRequest(mission=mission))
        assert answer.success, answer.message

    def start(self) -> None:
        answer = self.ask("/task/start", StartTaskRequest())
        assert answer.success, answer.message

    def drive(self, twist: Twist, client: FakeClient | None = None, stamp: float | None = None) -> None:
        self.station.hear(client or self.anna, "/cmd_vel", twist, stamp)

    def events(self, kind: str = "") -> list[str]:
        return [msg.text for _, msg in self.said if isinstance(msg, Event) and (not kind or msg.kind == kind)]

    def of(self, topic: str) -> list[Msg]:
        return [msg for name, msg in self.said if name == topic]

    @property
    def task(self) -> TaskStatus:
        return self.station.autonomy.engine.status

    @property
    def control(self) -> ControlStatus:
        last = self.station.bus.last("/control/status")
        assert isinstance(last, ControlStatus)
        return last


@pytest.fixture
def scene(tmp_path: Path) -> Iterator[Scene]:
    scene = Scene(FakeRobot(), tmp_path)
    scene.run(4.0)
    yield scene
    scene.station.close()


def test_a_drive_command_reaches_the_robot_at_once(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.2))
    assert scene.robot.commands[-1] == Twist.planar(0.3, 0.2)


def test_the_robot_is_at_rest_within_half_a_second_of_the_last_drive_command(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.2))
    scene.run(0.2)
    assert not scene.robot.at_rest
    scene.run(0.15)
    assert scene.robot.commands[-1] is None


def test_a_socket_that_closes_while_driving_stops_the_robot_at_once(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.2))
    scene.station.gone(scene.anna)
    assert scene.robot.commands[-1] is None
    assert scene.control.driver == ""


def test_control_given_back_while_driving_stops_the_robot_at_once(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.2))
    assert scene.ask("/control/release").success
    assert scene.robot.at_rest
    assert scene.control.driver == ""
    braked = len(scene.robot.commands)
    scene.run(1.0)
    assert len(scene.robot.commands) == braked


def test_control_is_free_again_when_its_driver_falls_silent(scene: Scene) -> None:
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    scene.clients.remove(scene.anna)
    scene.run(1.9)
    assert scene.control.driver == "Anna"
    scene.run(0.2)
    assert scene.control.driver == ""
    assert scene.events("control") == ["Anna has control.", "Control is free."]


def test_a_drive_command_that_is_no_number_is_said_once_and_moves_nothing(scene: Scene) -> None:
    before = len(scene.robot.commands)
    for _ in range(5):
        scene.drive(Twist.planar(math.nan, 0.0))
    assert len(scene.robot.commands) == before
    assert len(scene.events("command")) == 1


def test_a_late_drive_command_moves_nothing(scene: Scene) -> None:
    scene.drive(Twist.planar(0.3, 0.0), stamp=scene.now - 1.0)
    assert scene.robot.at_rest


def test_stop_is_obeyed_from_anyone_and_latched(scene: Scene) -> None:
    scene.ask("/control/acquire")
    scene.drive(Twist.planar(0.3, 0.0))
    bert = scene.client("bert")
    answer = scene.ask("/stop", CommandRequest(client_name="Bert"), bert)
    assert answer.success
    assert scene.robot.commands[-1] is None
    assert (scene.control.mode, scene.control.stopped_by) == ("STOPPED", "Bert")
    scene.drive(Twist.planar(0.3, 0.0))
    assert scene.robot.commands[-1] is None
    assert "STOP is pressed" in scene.events("command")[-1]


def test_stop_is_obeyed_however_old_and_however_often_it_comes(scene: Scene) -> None:
    old = CommandRequest(command_id="s1", stamp=scene.now - 100.0)
    assert scene.ask("/stop", old).success
    assert scene.ask("/stop/release").success
    assert scene.ask("/stop", old).success
    assert scene.control.stopped


def test_stop_is_released_only_with_control(scene: Scene) -> None:
    bert = scene.client("bert")
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    scene.ask("/stop", client=bert)
    assert "Anna has control" in scene.refused("/stop/release", client=bert)
    assert scene.ask("/stop/release").success
    assert scene.control.mode == "MANUAL"


def test_stop_holds_a_patrol_and_release_does_not_resume_it(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(3.0)
    scene.ask("/stop", CommandRequest(client_name="Anna"))
    assert (scene.task.state, scene.task.reason) == ("PAUSED", "Stopped by Anna.")
    scene.ask("/stop/release")
    scene.run(1.0)
    assert scene.robot.at_rest
    assert scene.control.mode == "PAUSED"
    assert scene.ask("/task/resume").success
    scene.run(1.0)
    assert not scene.robot.at_rest


def test_with_stop_pressed_tasks_are_refused(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.ask("/stop")
    for name, request in (
        ("/task/start", StartTaskRequest()),
        ("/task/go_home", None),
        ("/task/resume", None),
    ):
        assert "STOP is pressed" in scene.refused(name, request)


def test_with_stop_pressed_a_paused_task_stays_where_it_is_whatever_is_asked(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(2.0)
    scene.ask("/stop", CommandRequest(client_name="Anna"))
    before = len(scene.robot.commands)
    for name, request in (
        ("/task/start", StartTaskRequest()),
        ("/task/start", StartTaskRequest(task="go_home")),
        ("/task/go_home", None),
        ("/task/resume", None),
    ):
        assert scene.refused(name, request) == STOP_SENTENCE
        scene.run(0.5)
    assert (scene.task.task, scene.task.state, scene.task.reason) == ("patrol", "PAUSED", "Stopped by Anna.")
    assert not any(scene.robot.commands[before:])


def test_with_stop_pressed_a_goal_is_refused_and_said(scene: Scene) -> None:
    scene.ask("/stop")
    goal = PoseStamped(pose=Pose(Point(3.0, -2.0), Quaternion.from_yaw(0.5)))
    scene.station.hear(scene.anna, "/goal_pose", goal, None)
    assert scene.events("command") == [STOP_SENTENCE]
    assert (scene.task.state, scene.control.mode) == ("IDLE", "STOPPED")


def test_with_stop_pressed_the_robot_brakes_even_if_a_task_runs(scene: Scene) -> None:
    scene.ask("/stop")
    before = len(scene.robot.commands)
    scene.station.autonomy.start_goal(Waypoint(3.0, -2.0), scene.now)
    scene.run(1.0)
    assert scene.task.state == "RUNNING"
    assert scene.robot.commands[before:]
    assert not any(scene.robot.commands[before:])
    scene.ask("/stop/release")
    scene.run(1.0)
    assert not scene.robot.at_rest


def test_a_patrol_visits_every_point_and_ends(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    near = [math.inf] * 3
    while scene.station.autonomy.engine.running:
        scene.run(0.1)
        x, y, _ = scene.robot.pose
        near = [min(best, math.hypot(x - p.x, y - p.y)) for best, p in zip(near, SQUARE, strict=True)]
    assert max(near) < 0.15
    assert (scene.task.state, scene.task.visited) == ("SUCCEEDED", 3)
    assert scene.robot.at_rest
    assert scene.robot.contacts == 0


def test_task_status_is_said_once_per_change_and_progress_twice_a_second(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    before = scene.now
    scene.start()
    scene.run_task()
    states = [msg for msg in scene.of("/task/status") if isinstance(msg, TaskStatus)]
    assert len(states) == len({(s.state, s.waypoint, s.visited, s.lap, s.reason) for s in states})
    progress = [msg for msg in scene.of("/task/progress") if isinstance(msg, TaskProgress)]
    assert len(progress) == pytest.approx(2 * (scene.now - before), abs=3)
    parts = [p.progress for p in progress]
    assert parts == pytest.approx(sorted(parts), abs=0.02)
    assert progress[-1].distance_driven == pytest.approx(4 + 3 + 6, abs=1.0)


def test_everything_that_is_published_is_in_the_table_and_can_be_sent(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    scene.drive(Twist.planar(0.1, 0.0))
    scene.ask("/task/resume")
    scene.run_task()
    types = {entry.name: entry.type for entry in TOPICS}
    for topic, msg in scene.said:
        assert type(msg) is types[topic]
        assert to_json(msg)
    told = {topic for topic, _ in scene.said}
    assert told >= {"/pose", "/tf", "/plan", "/mission", "/robot/info", "/diagnostics", "/intruders", "/map"}


def test_pause_holds_within_five_centimetres_and_resume_goes_on(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    scene.run(4.0)
    assert scene.ask("/task/pause").success
    x, y, _ = scene.robot.pose
    scene.run(10.0)
    assert math.hypot(scene.robot.pose[0] - x, scene.robot.pose[1] - y) < 0.05
    assert scene.ask("/task/resume").success
    assert scene.run_task().state == "SUCCEEDED"


def test_taking_the_stick_pauses_the_patrol_and_letting_go_does_not_resume(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(2.0)
    scene.drive(Twist())
    assert scene.task.state == "RUNNING"
    scene.station.controls.introduce(scene.anna, "t1", "Anna")
    scene.drive(Twist.planar(-0.2, 0.0))
    assert scene.task.reason == "Paused: Anna took the stick."
    assert scene.robot.commands[-1] == Twist.planar(-0.2, 0.0)
    scene.run(2.0)
    assert scene.robot.at_rest
    assert scene.task.state == "PAUSED"


def test_the_patrol_goes_on_when_every_handheld_is_gone(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    scene.run(1.0)
    scene.station.gone(scene.anna)
    assert not scene.robot.at_rest
    assert scene.run_task().state == "SUCCEEDED"


def test_cancel_ends_the_patrol_at_rest(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(2.0)
    assert scene.ask("/task/cancel").success
    scene.run(0.5)
    assert scene.robot.at_rest
    assert scene.task.state == "CANCELED"
    assert "No task is running" in scene.refused("/task/cancel")


def test_home_is_reached_from_within_a_patrol(scene: Scene) -> None:
    scene.set(*SQUARE, home=[Waypoint(-1.0, -2.0, math.pi / 2)])
    scene.start()
    scene.run(5.0)
    assert scene.ask("/task/go_home").success
    first, second = scene.of("/task/status")[-2:]
    assert isinstance(first, TaskStatus)
    assert isinstance(second, TaskStatus)
    assert (first.state, second.task, second.task_id) == ("CANCELED", "go_home", 2)
    status = scene.run_task()
    assert (status.state, status.reason) == ("SUCCEEDED", "Home.")
    x, y, yaw = scene.robot.pose
    assert math.hypot(x + 1.0, y + 2.0) < 0.15
    assert yaw == pytest.approx(math.pi / 2, abs=0.1)


def test_a_mission_without_points_is_refused_at_the_start(scene: Scene) -> None:
    said = scene.refused("/task/start", StartTaskRequest())
    assert said == "The mission has no points; set at least one."


def test_a_point_in_a_wall_is_refused_with_its_number_and_place(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(boxes=[Box(2.0, 1.0, 5.0, 3.0)]), tmp_path)
    mission = Mission(waypoints=[Waypoint(1.0, 0.0), Waypoint(3.5, 2.0)])
    said = scene.refused("/mission/set", SetMissionRequest(mission=mission))
    assert said == "Point 2 at (3.5, 2.0) is in a wall or another obstacle."


@pytest.mark.parametrize(
    ("mission", "said"),
    [
        (Mission(motion="zigzag"), "There is no motion 'zigzag'; there are loop, random, intermittent."),
        (Mission(dwell=math.nan), "The dwell must be 0 to 600 s, not nan s."),
        (Mission(laps=-1), "The laps must be 0 to 999, not -1."),
        (Mission(waypoints=[Waypoint(math.nan, 0.0)]), "Point 1 at (nan, 0.0) is off the map."),
        (Mission(home=[Waypoint(99.0, 0.0)]), "Home at (99.0, 0.0) is off the map."),
    ],
)
def test_a_mission_that_makes_no_sense_is_refused_with_what_is_allowed(
    scene: Scene, mission: Mission, said: str
) -> None:
    assert scene.refused("/mission/set", SetMissionRequest(mission=mission)) == said


def test_a_command_from_somebody_without_control_names_the_driver(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.ask("/control/acquire", CommandRequest(client_id="t1", client_name="tablet-A"))
    bert = scene.client("bert")
    for name, request in (
        ("/task/start", StartTaskRequest()),
        ("/task/pause", None),
        ("/mission/set", SetMissionRequest()),
    ):
        assert scene.refused(name, request, bert).startswith("tablet-A has control")


def test_a_low_battery_refuses_the_start_with_its_value(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.robot.battery = 0.14
    scene.run(1.1)
    said = scene.refused("/task/start", StartTaskRequest())
    assert said == "The battery is at 14%; a patrol needs at least 15%."


def test_an_empty_battery_sends_the_robot_home_by_itself(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(5.0)
    scene.robot.battery = 0.09
    scene.run(1.1)
    assert scene.task.task == "go_home"
    assert scene.events("battery") == ["Battery low: 9%.", "Battery at 9%: going home."]
    assert scene.run_task().reason == "Home."


def test_a_command_that_is_too_old_is_refused(scene: Scene) -> None:
    request = CommandRequest(stamp=scene.now - 6.0)
    assert "too old" in scene.refused("/control/acquire", request)


def test_the_same_command_twice_is_done_once(scene: Scene) -> None:
    scene.set(*SQUARE)
    request = StartTaskRequest(command_id="c1")
    first = scene.ask("/task/start", request)
    assert scene.ask("/task/start", request) == first
    assert scene.task.task_id == 1
    assert "A task is running already" in scene.refused("/task/start", StartTaskRequest(command_id="c2"))


def test_the_bumper_halts_the_patrol(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    x, y, _ = scene.robot.pose
    scene.robot.pillars.append(Pillar(x + 0.25, y, 0.12))
    scene.run(0.2)
    assert scene.task.reason == "Paused: the bumper touched something."
    assert scene.robot.at_rest
    assert len(scene.events("contact")) == 1


@pytest.mark.parametrize(("topic", "sense"), [("/scan", "laser"), ("/odom", "odometry")])
def test_a_robot_that_has_become_blind_halts(scene: Scene, topic: str, sense: str) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    scene.robot.silent.add(topic)
    scene.run(0.9)
    assert scene.task.reason == f"Paused: the {sense} has been silent for 0.6 s."
    assert scene.robot.at_rest


def test_a_goal_is_driven_to_once(scene: Scene) -> None:
    goal = PoseStamped(pose=Pose(Point(3.0, -2.0), Quaternion.from_yaw(0.5)))
    scene.station.hear(scene.anna, "/goal_pose", goal, None)
    assert scene.run_task().state == "SUCCEEDED"
    assert math.hypot(scene.robot.pose[0] - 3.0, scene.robot.pose[1] + 2.0) < 0.15


def test_a_goal_in_a_wall_is_said_and_not_driven_to(scene: Scene) -> None:
    scene.station.hear(scene.anna, "/goal_pose", PoseStamped(pose=Pose(Point(10.2, 0.0))), None)
    assert scene.events("command") == ["The goal at (10.2, 0.0) is in a wall or another obstacle."]
    assert not scene.station.autonomy.engine.running


def test_a_robot_that_was_placed_by_a_finger_finds_its_exact_pose(tmp_path: Path) -> None:
    hall = FakeRobot(start=(-6.0, 2.0, 0.8), boxes=[Box(-1.0, 2.0, 1.0, 4.0), Box(3.0, -5.0, 4.0, -2.0)])
    scene = Scene(hall, tmp_path)
    told = Pose(Point(-5.5, 1.6), Quaternion.from_yaw(0.5))
    scene.run(0.5)
    scene.station.hear(
        scene.anna, "/initialpose", PoseWithCovarianceStamped(pose=PoseWithCovariance(told)), None
    )
    scene.run(2.0)
    pose = scene.station.autonomy.whereabouts.pose
    assert pose is not None
    assert pose == pytest.approx((-6.0, 2.0, 0.8), abs=0.08)
    assert scene.station.autonomy.whereabouts.sure


def test_a_pose_that_is_no_number_is_said_and_ignored(scene: Scene) -> None:
    before = scene.station.autonomy.whereabouts.pose
    bad = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(math.nan, 0.0))))
    scene.station.hear(scene.anna, "/initialpose", bad, None)
    assert scene.station.autonomy.whereabouts.pose == before
    assert scene.events("command")


@pytest.mark.parametrize(("x", "shown"), [(12.0, "12.0"), (1e6, "1e+06"), (-1e308, "-1e+308")])
def test_a_place_off_the_map_is_refused_with_what_the_map_holds(scene: Scene, x: float, shown: str) -> None:
    before = scene.station.autonomy.whereabouts.pose
    far = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(x, 0.0))))
    scene.station.hear(scene.anna, "/initialpose", far, None)
    assert scene.station.autonomy.whereabouts.pose == before
    assert scene.events("command") == [
        f"The place at ({shown}, 0.0) is off the map, which is x -11.0 to 11.0 m, y -7.0 to 7.0 m."
    ]


def test_what_operators_are_told_carries_their_clock_at_any_speed_of_the_robots(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(), tmp_path, speed=4.0)
    scene.run(40.0)
    assert scene.now - scene.clock == pytest.approx(30.0)
    told = len(scene.said)
    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    scene.ask("/task/pause")
    stamped = [
        (t, m)
        for t, m in scene.said[told:]
        if isinstance(m, Mission | Event | TaskStatus | TaskProgress | ControlStatus)
    ]
    assert {topic for topic, _ in stamped} == {
        "/mission",
        "/events",
        "/task/status",
        "/task/progress",
        "/control/status",
    }
    for topic, msg in stamped:
        assert msg.stamp.seconds == pytest.approx(scene.clock, abs=0.3), topic
    pose = scene.station.bus.last("/pose")
    assert isinstance(pose, PoseWithCovarianceStamped)
    assert pose.header.stamp.seconds == pytest.approx(scene.now, abs=0.06)


def test_what_was_missed_can_be_asked_for(scene: Scene) -> None:
    scene.set(*SQUARE)
    scene.start()
    everything = scene.ask("/events/get", GetEventsRequest()).events  # type: ignore[attr-defined]
    assert [event.id for event in everything] == list(range(1, len(everything) + 1))
    later = scene.ask("/events/get", GetEventsRequest(2, "b1")).events  # type: ignore[attr-defined]
    assert later == everything[2:]
    assert scene.ask("/events/get", GetEventsRequest(2, "another")).events == everything  # type: ignore[attr-defined]


def test_a_mission_survives_a_restart(tmp_path: Path) -> None:
    scene = Scene(FakeRobot(), tmp_path)
    scene.set(*SQUARE, motion="intermittent", dwell=3.0)
    again = Scene(FakeRobot(), tmp_path)
    mission = again.ask("/mission/get", GetMissionRequest()).mission  # type: ignore[attr-defined]
    assert mission == scene.station.mission
    assert mission.waypoints == SQUARE


@pytest.mark.parametrize("part", ["check", "take"])
def test_a_fault_in_the_robots_mind_ends_the_task_at_rest_and_the_robot_lives_on(
    scene: Scene, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture, part: str
) -> None:
    def fail(*_: object) -> None:
        raise OverflowError("too far")

    scene.set(*SQUARE)
    scene.start()
    scene.run(1.0)
    assert not scene.robot.at_rest
    with monkeypatch.context() as broken:
        broken.setattr(scene.station.autonomy, part, fail)
        scene.run(1.0)
    assert (scene.task.state, scene.robot.at_rest) == ("FAILED", True)
    assert scene.task.reason == "The task ended: the robot's program has a fault (OverflowError)."
    assert scene.events("task").count("The robot's program has a fault: OverflowError('too far').") == 1
    assert [record.exc_info[0] for record in caplog.records if record.exc_info] == [OverflowError]
    scene.drive(Twist.planar(0.3, 0.0))
    scene.run(0.1)
    assert not scene.robot.at_rest
    scene.run(1.0)
    scene.start()
    scene.run(1.0)
    assert scene.task.state == "RUNNING"


def test_what_others_call_things_is_cut_wherever_it_is_kept(scene: Scene) -> None:
    long = "A\n\u202e" + "b" * 900_000
    shown = "A " + "b" * 38
    scene.ask("/control/acquire", CommandRequest(client_id="c" * 900_000, client_name=long))
    assert (scene.control.driver, len(scene.control.driver_id)) == (shown, 64)
    scene.set(Waypoint(4.0, 0.0, name=long), home=[Waypoint(0.0, 0.0, name=long)])
    assert {place.name for place in (*scene.station.mission.waypoints, *scene.station.mission.home)} == {
        "A " + "b" * 58
    }
    assert len(scene.refused("/task/start", StartTaskRequest(task=long))) <= 300
    assert "at most 64 characters, not 65" in scene.refused("/task/pause", CommandRequest("c" * 65))
    assert scene.ask("/stop", CommandRequest("c" * 65)).success
    assert scene.events("stop") == [f"STOP pressed by {shown}."]


def test_stop_is_still_pressed_after_the_computer_died_and_says_so(scene: Scene, tmp_path: Path) -> None:
    scene.ask("/stop", CommandRequest(client_name="Anna"))
    again = Scene(FakeRobot(), tmp_path)
    assert (again.control.mode, again.control.stopped_by) == ("STOPPED", "Anna")
    assert [event.text for event in again.station.events.since(0, "b1")] == [
        "STOP, pressed by Anna before the restart, is still pressed."
    ]
    again.run(4.0)
    again.drive(Twist.planar(0.3, 0.0))
    assert again.robot.at_rest
    assert again.ask("/stop/release").success
    assert not Scene(FakeRobot(), tmp_path).control.stopped


def test_a_patrol_that_ran_when_the_computer_died_has_ended_and_that_is_said_once(
    scene: Scene, tmp_path: Path
) -> None:
    scene.set(*SQUARE)
    scene.start()
    again = Scene(FakeRobot(), tmp_path)
    said = "The robot's computer restarted; the patrol has ended."
    assert [event.text for event in again.station.events.since(0, "b1")] == [said]
    assert again.task.state == "IDLE"
    assert Scene(FakeRobot(), tmp_path).station.events.since(0, "b1") == []


def test_after_a_clean_end_nothing_but_a_persons_stop_is_left(scene: Scene, tmp_path: Path) -> None:
    scene.set(*SQUARE)
    scene.start()
    scene.station.end()
    scene.run(0.5)
    again = Scene(FakeRobot(), tmp_path)
    assert (again.control.stopped, again.station.events.since(0, "b1")) == (False, [])
    again.ask("/stop", CommandRequest(client_name="Anna"))
    again.station.end()
    assert Scene(FakeRobot(), tmp_path).control.stopped_by == "Anna"


def test_stop_is_obeyed_when_it_cannot_be_noted_and_that_is_said(
    scene: Scene, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Store, "leave", full)
    scene.drive(Twist.planar(0.3, 0.0))
    assert scene.ask("/stop").success
    assert scene.robot.at_rest
    assert scene.events("stop")[-1] == (
        "A restart will not know of STOP and the task: No space left on device."
    )


def test_the_camera_is_wanted_only_while_a_task_runs(scene: Scene) -> None:
    scene.set(*SQUARE, laps=1)
    scene.start()
    assert scene.robot.wanted["/camera/image/compressed"]
    scene.run_task()
    assert not scene.robot.wanted["/camera/image/compressed"]


@pytest.mark.parametrize("stop", [True, False])
def test_an_intruder_is_told_once_and_halts_the_patrol_if_asked(scene: Scene, stop: bool) -> None:
    image, draw = picture()
    focal = 320 / math.tan(0.6)
    cone(draw, 320, 240 + focal * 0.36 / 3.0, 0.6 * focal / 3.0)
    scene.set(Waypoint(6.0, -4.0), stop_on_intruder=stop)
    scene.start()
    scene.run(0.1)
    for n in range(5):
        shot = CompressedImage(Header(Time.at(scene.now - 0.5 + 0.21 * n), "camera"), "jpeg", jpeg(image))
        scene.station.autonomy.take("/camera/image/compressed", shot, scene.now)
    assert len(scene.events("intruder")) == 1
    known = scene.station.bus.last("/intruders")
    assert isinstance(known, IntruderArray)
    assert [intruder.id for intruder in known.intruders] == [1]
    assert scene.task.state == ("PAUSED" if stop else "RUNNING")


def test_a_map_with_a_damaged_mission_file_starts_empty_and_says_so(tmp_path: Path) -> None:
    (tmp_path / "mission.json").write_text('{"waypoints": [{"x": "left"}]')
    scene = Scene(FakeRobot(), tmp_path)
    assert scene.station.mission == Mission()
    assert "set aside as mission.damaged.json" in scene.station.events.since(0, "b1")[0].text
    assert (tmp_path / "mission.damaged.json").exists()


def test_a_robot_that_was_carried_away_says_that_it_is_unsure_creeps_and_can_be_placed_again(
    tmp_path: Path,
) -> None:
    boxes = [Box(-1.0, 2.0, 1.0, 4.0), Box(3.0, -5.0, 4.0, -2.0), Box(-8.0, -4.0, -6.0, -3.0)]
    scene = Scene(FakeRobot(boxes=boxes), tmp_path)
    scene.run(4.0)
    scene.set(Waypoint(8.0, 0.0))
    scene.start()
    scene.run(2.0)
    scene.robot.pose = (-4.0, 4.0, 2.0)
    scene.run(3.0)
    assert any(said.startswith("Position unsure") for said in scene.events("localisation"))
    assert abs(scene.robot.twist.linear.x) <= 0.15
    scene.ask("/task/pause")
    x, y, yaw = scene.robot.pose
    told = Pose(Point(x + 0.4, y - 0.3), Quaternion.from_yaw(yaw + 0.2))
    scene.station.hear(
        scene.anna, "/initialpose", PoseWithCovarianceStamped(pose=PoseWithCovariance(told)), None
    )
    scene.run(1.0)
    assert scene.events("localisation")[-1] == "Position sure again."
    scene.ask("/task/resume")
    assert scene.run_task().state == "SUCCEEDED"
    assert math.hypot(scene.robot.pose[0] - 8.0, scene.robot.pose[1]) < 0.2
    assert scene.robot.contacts == 0


def test_only_who_has_control_may_place_the_robot_while_somebody_has_it(scene: Scene) -> None:
    scene.ask("/control/acquire", CommandRequest(client_name="Anna"))
    before = scene.station.autonomy.whereabouts.pose
    there = PoseWithCovarianceStamped(pose=PoseWithCovariance(Pose(Point(3.0, 3.0))))
    scene.station.hear(scene.client("bert"), "/initialpose", there, None)
    assert scene.station.autonomy.whereabouts.pose == before
    assert scene.events("command")[-1].startswith("Anna has control")

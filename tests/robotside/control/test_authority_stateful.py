"""Hundreds of random sequences of what operators may do with control: never two drivers, never a stranger's command, STOP always.

Once with the controls alone; once with a whole station behind its door, where operators come by all gateways, by the adapters' own
code, and STOP by HTTP as well. Sequences of eight there are all gone through by `tests/slow`; these are longer.
"""

from __future__ import annotations

import itertools
import random

import pytest
from hypothesis import HealthCheck, settings, strategies
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from bridge.core.identity import public_id
from bridge.core.link_state import CONTROL_TIMEOUT
from bridge.core.robot_catalogue import Operator
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import CommandRequest, RobotInfo
from robotside.control.authority import OBJECTION_TIME
from robotside.control.command_expiry import VALID_TIME
from robotside.control.command_gate import CommandGate
from robotside.control.guarded_robot import GuardedRobot
from robotside.control.stop_release import MIN_HOLD_TIME
from robotside.door.station_door import StationDoor
from robotside.records import Records
from robotside.station.station import Station
from tests.fakes import FakeClient, FakeRobot
from tests.robotside.gateways.adapter_clients import WAYS
from tests.robotside.gateways.in_process import Client, Gateways

pytestmark = pytest.mark.slow

HOWS = ("rosbridge", "memory", *WAYS)
"""By which clients come to a station."""
NAMES = ("anna", "bert", "carl")
WHO = strategies.sampled_from(NAMES)
TICK = 1 / 60
WHOSE = {public_id(name): name for name in NAMES}
"""Who has a public id."""


class Operators(RuleBasedStateMachine):
    """Three handhelds that come, go, fall silent, drive and quarrel; the robot notes who moved it."""

    def __init__(self) -> None:
        super().__init__()
        self.now = 1000.0
        self.body = FakeRobot()
        self.numbers = itertools.count(1)
        self.controls = self._open()
        self.clients: dict[str, Operator] = {name: self._fresh(name) for name in NAMES}
        self.silent: set[str] = set()
        self.moved_by = ""
        self.valid = 0.0
        """When the command in force was given [s]."""

    def _open(self) -> CommandGate:
        controls = CommandGate(RobotInfo(max_speed=0.7, max_yaw_rate=1.9))
        self.robot = GuardedRobot(self.body, lambda: self.controls.stopped)
        return controls

    def _fresh(self, name: str) -> Operator:
        client = FakeClient(f"{name}-{next(self.numbers)}", self.now)
        self.controls.introduce(client, name, name.capitalize())
        return client

    def _heard(self, who: str) -> Operator:
        """Who does something is heard at that moment; what is due by then has happened."""
        client = self.clients[who]
        client.last_heard = self.now
        self._tick()
        return client

    def _driver(self) -> str:
        return WHOSE[self.controls.driver.client_id] if self.controls.driver else ""

    @rule(who=WHO)
    def acquire(self, who: str) -> None:
        client, before = self._heard(who), self._driver()
        problem = self._ask("acquire", client)
        assert self.controls.holds(client) == (not problem)
        assert before in ("", who, self._driver())

    @rule(who=WHO)
    def release(self, who: str) -> None:
        client, before = self._heard(who), self._driver()
        self._ask("release", client)
        assert before in ("", who) or self._driver() == before
        self._tick()

    @rule(who=WHO)
    def request(self, who: str) -> None:
        client, before = self._heard(who), self._driver()
        problem = self._ask("request", client)
        assert self._driver() == (before or who)
        asker = self.controls.asker
        assert problem or self.controls.holds(client) or (asker and WHOSE[asker.client_id] == who)

    @rule(who=WHO)
    def grant(self, who: str) -> None:
        client, before, asker = self._heard(who), self._driver(), self.controls.asker
        problem = self._ask("grant", client)
        if not problem:
            assert asker is not None
            assert (before, self._driver()) == (who, WHOSE[asker.client_id])
        else:
            assert self._driver() == before
        self._tick()

    @rule(who=WHO)
    def refuse(self, who: str) -> None:
        client, before = self._heard(who), self._driver()
        problem = self._ask("object", client)
        assert self._driver() == before
        assert problem or (who == before and self.controls.asker is None)

    @rule(who=WHO, age=strategies.floats(-0.2, 0.6), speed=strategies.sampled_from([0.0, 0.3, -0.7]))
    def drive(self, who: str, age: float, speed: float) -> None:
        self._drive(who, age, speed)

    def _drive(self, who: str, age: float, speed: float) -> None:
        client, before, stopped = self._heard(who), self._driver(), self.controls.stopped
        if not self._obeys(client, Twist.planar(speed, 0.0), self.now - age):
            return
        assert age <= VALID_TIME
        assert not stopped
        assert before in ("", who)
        assert self.controls.holds(client)
        self.moved_by, self.valid = client.id, self.now - max(age, 0.0)

    @rule(who=WHO)
    def stop(self, who: str) -> None:
        self._press_stop(self.clients[who])
        assert self.body.at_rest
        assert not self.controls.driving

    @precondition(lambda self: self.controls.stopped)
    @rule(who=WHO)
    def release_stop(self, who: str) -> None:
        self._release_stop(self.clients[who])
        assert self.body.at_rest

    @rule(who=WHO)
    def cut(self, who: str) -> None:
        self._leave(self.clients[who])
        self.clients[who] = self._fresh(who)
        self.silent.discard(who)
        self._tick()

    @rule(who=WHO)
    def fall_silent(self, who: str) -> None:
        self.silent.add(who)

    @rule(who=WHO)
    def come_back_over_another_connection(self, who: str) -> None:
        self.clients[who] = self._fresh(who)
        self.silent.discard(who)

    @rule(ticks=strategies.integers(1, 30))
    def wait(self, ticks: int) -> None:
        for _ in range(ticks):
            self._pass(TICK)

    @rule(seconds=strategies.sampled_from([1.1, CONTROL_TIMEOUT + 0.1, OBJECTION_TIME + 0.1]))
    def wait_long(self, seconds: float) -> None:
        end = self.now + seconds
        while self.now < end:
            self._pass(0.1 if not self.controls.driving else TICK)

    def _pass(self, seconds: float) -> None:
        self.now += seconds
        for name, client in self.clients.items():
            if name not in self.silent:
                client.last_heard = self.now
        self._tick()

    def _ask(self, what: str, client: Operator) -> str:
        """Do what the service `/control/WHAT` does; why not, empty when done."""
        timed = {
            "acquire": self.controls.acquire,
            "request": self.controls.request,
            "object": self.controls.object,
        }
        plain = {"release": self.controls.release, "grant": self.controls.grant}
        return timed[what](client, self.now) if what in timed else plain[what](client)

    def _obeys(self, client: Operator, twist: Twist, stamp: float) -> bool:
        """Give a drive command; True when the robot does it."""
        ruling = self.controls.drive(client, twist, self.now, stamp=stamp)
        if ruling.order is not None:
            self.robot.follow(ruling.order)
        return ruling.order is not None

    def _press_stop(self, client: Operator) -> None:
        self.controls.stop(self.controls.name(client))
        self.robot.stop()

    def _release_stop(self, client: Operator) -> None:
        self.controls.release_stop()

    def _leave(self, client: Operator) -> None:
        drove = self.controls.drives(client)
        self.controls.on_gone(client)
        if drove:
            self.robot.stop()

    def _tick(self) -> None:
        self.controls.update(self.now)
        if self.controls.expired(self.now):
            self.robot.stop()

    @invariant()
    def there_is_one_driver_at_most(self) -> None:
        holders = [each for each in self.clients.values() if self.controls.holds(each)]
        assert len(holders) <= 1
        driver, asker = self.controls.driver, self.controls.asker
        assert asker is None or (driver is not None and asker.client_id != driver.client_id)
        free = [each for each in self.clients.values() if not self.controls.objection(each)]
        if driver is not None:
            # only who drives may act, or the same person over a new connection
            assert {self.controls.id(each) for each in free} <= {driver.client_id}

    @invariant()
    def nobody_but_the_driver_moves_the_robot(self) -> None:
        if self.body.at_rest:
            return
        driver = self.controls.driver
        assert self.controls.driving
        assert driver is not None
        assert driver.client.id == self.moved_by or WHOSE[driver.client_id] == self.moved_by.split("-")[0]
        assert self.now - self.valid <= VALID_TIME

    @invariant()
    def with_stop_pressed_it_rests(self) -> None:
        assert not self.controls.stopped or self.body.at_rest


TestOperators = Operators.TestCase
TestOperators.settings = settings(
    max_examples=600,
    stateful_step_count=30,
    deadline=None,
    derandomize=True,
    suppress_health_check=list(HealthCheck),
)


class OperatorsAtTheDoor(Operators):
    """The same with a station, its door and its gateways: who connects comes by another one each time."""

    def _open(self) -> CommandGate:
        self.body.silent = {"/map", "/scan", "/battery_state", "/bumper"}
        self.station = Station(
            self.body, Records.in_memory(), now=self.now, clock=lambda: self.now, rng=random.Random(1)
        )
        self.gateways = Gateways(StationDoor(self.station))
        self.by_id: dict[str, Client] = {}
        self.hows = itertools.cycle(HOWS)
        return self.station.controls

    @initialize(hows=strategies.permutations(HOWS))
    def come(self, hows: list[str]) -> None:
        """All of them come, each by another gateway, and by the next ones whenever they come again."""
        self.hows = itertools.cycle(hows)
        for name in NAMES:
            self._leave(self.clients[name])
            self.clients[name] = self._fresh(name)

    @rule(who=WHO, speed=strategies.sampled_from([0.0, 0.3]))
    def let_go_and_drive(self, who: str, speed: float) -> None:
        """A stick counts once it was let go."""
        self._drive(who, 0.0, 0.0)
        self._pass(TICK)
        self._drive(who, 0.0, speed)

    def teardown(self) -> None:
        self.gateways.close()

    def _fresh(self, name: str) -> Operator:
        how = next(self.hows)
        client = self.gateways.connect(how, name)
        self.by_id[client.operator.id] = client
        self._call(client.operator, "/missions/get", client_id=name, client_name=name.capitalize())
        return client.operator

    def _call(self, operator: Operator, service: str, **words: str) -> str:
        answer = self.by_id[operator.id].ask(service, CommandRequest(**words))
        return "" if answer.success else answer.message

    def _ask(self, what: str, client: Operator) -> str:
        return self._call(client, f"/control/{what}")

    def _obeys(self, client: Operator, twist: Twist, stamp: float) -> bool:
        before = len(self.body.commands)
        self.by_id[client.id].publish("/cmd_vel", twist, stamp)
        return self.controls.drives(client) and len(self.body.commands) > before

    def _press_stop(self, client: Operator) -> None:
        if next(self.numbers) % 3:
            assert self._call(client, "/stop") == ""
        else:
            self.gateways.stop("Fred")

    def _release_stop(self, client: Operator) -> None:
        self._call(client, "/stop/hold")
        self.now += MIN_HOLD_TIME + 0.05
        self._tick()
        self._call(client, "/stop/release")

    def _leave(self, client: Operator) -> None:
        self.by_id.pop(client.id).leave()

    def _tick(self) -> None:
        self.station.step(self.now)


TestOperatorsAtTheDoor = OperatorsAtTheDoor.TestCase
TestOperatorsAtTheDoor.settings = settings(TestOperators.settings, max_examples=80)

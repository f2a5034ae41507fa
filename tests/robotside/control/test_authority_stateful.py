"""A thousand random sequences of what operators may do with control: never two drivers, never a stranger's command, STOP always."""

from __future__ import annotations

import itertools

from hypothesis import HealthCheck, settings, strategies
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from bridge.core.link_state import CONTROL_TIMEOUT
from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.pilothouse_msgs import RobotInfo
from robotside.control.authority import TO_OBJECT
from robotside.control.command_expiry import VALID
from robotside.control.command_gate import Controls
from robotside.control.guarded_robot import Guarded
from tests.fakes import FakeClient, FakeRobot

NAMES = ("anna", "bert", "carl")
WHO = strategies.sampled_from(NAMES)
TICK = 1 / 60


class Operators(RuleBasedStateMachine):
    """Three handhelds that come, go, fall silent, drive and quarrel; the robot notes who moved it."""

    def __init__(self) -> None:
        super().__init__()
        self.now = 1000.0
        self.controls = Controls(RobotInfo(max_speed=0.7, max_yaw_rate=1.9))
        self.body = FakeRobot()
        self.robot = Guarded(self.body, lambda: self.controls.stopped)
        self.numbers = itertools.count(1)
        self.clients = {name: self._fresh(name) for name in NAMES}
        self.silent: set[str] = set()
        self.moved_by = ""
        self.valid = 0.0
        """When the command in force was given [s]."""

    def _fresh(self, name: str) -> FakeClient:
        client = FakeClient(f"{name}-{next(self.numbers)}", self.now)
        self.controls.introduce(client, name, name.capitalize())
        return client

    def _heard(self, who: str) -> FakeClient:
        """Who does something is heard at that moment; what is due by then has happened."""
        client = self.clients[who]
        client.last_heard = self.now
        self._tick()
        return client

    def _driver(self) -> str:
        return self.controls.driver.client_id if self.controls.driver else ""

    @rule(who=WHO)
    def acquire(self, who: str) -> None:
        client, before = self._heard(who), self._driver()
        problem = self.controls.acquire(client, self.now)
        assert self.controls.holds(client) == (not problem)
        assert before in ("", who, self._driver())

    @rule(who=WHO)
    def release(self, who: str) -> None:
        client, before = self._heard(who), self._driver()
        self.controls.release(client)
        assert before in ("", who) or self._driver() == before
        self._tick()

    @rule(who=WHO)
    def request(self, who: str) -> None:
        client, before = self._heard(who), self._driver()
        problem = self.controls.request(client, self.now)
        assert self._driver() == (before or who)
        asker = self.controls.asker
        assert problem or self.controls.holds(client) or (asker and asker.client_id == who)

    @rule(who=WHO)
    def grant(self, who: str) -> None:
        client, before, asker = self._heard(who), self._driver(), self.controls.asker
        problem = self.controls.grant(client)
        if not problem:
            assert asker is not None
            assert (before, self._driver()) == (who, asker.client_id)
        else:
            assert self._driver() == before
        self._tick()

    @rule(who=WHO)
    def refuse(self, who: str) -> None:
        client, before = self._heard(who), self._driver()
        problem = self.controls.object(client, self.now)
        assert self._driver() == before
        assert problem or (who == before and self.controls.asker is None)

    @rule(who=WHO, age=strategies.floats(-0.2, 0.6), speed=strategies.sampled_from([0.0, 0.3, -0.7]))
    def drive(self, who: str, age: float, speed: float) -> None:
        client, before, stopped = self._heard(who), self._driver(), self.controls.stopped
        ruling = self.controls.drive(client, Twist.planar(speed, 0.0), self.now, stamp=self.now - age)
        if ruling.order is None:
            return
        assert age <= VALID
        assert not stopped
        assert before in ("", who)
        assert self.controls.holds(client)
        self.robot.follow(ruling.order)
        self.moved_by, self.valid = client.id, self.now - max(age, 0.0)

    @rule(who=WHO)
    def stop(self, who: str) -> None:
        self.controls.stop(self.controls.name(self.clients[who]))
        self.robot.stop()
        assert self.body.at_rest
        assert not self.controls.driving

    @precondition(lambda self: self.controls.stopped)
    @rule()
    def release_stop(self) -> None:
        self.controls.release_stop()
        assert self.body.at_rest

    @rule(who=WHO)
    def cut(self, who: str) -> None:
        drove = self.controls.drives(self.clients[who])
        self.controls.gone(self.clients[who])
        if drove:
            self.robot.stop()
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

    @rule(seconds=strategies.sampled_from([1.1, CONTROL_TIMEOUT + 0.1, TO_OBJECT + 0.1]))
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

    def _tick(self) -> None:
        self.controls.mind(self.now)
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
        assert driver.client.id == self.moved_by or driver.client_id == self.moved_by.split("-")[0]
        assert self.now - self.valid <= VALID

    @invariant()
    def with_stop_pressed_it_rests(self) -> None:
        assert not self.controls.stopped or self.body.at_rest


TestOperators = Operators.TestCase
TestOperators.settings = settings(
    max_examples=1000,
    stateful_step_count=30,
    deadline=None,
    derandomize=True,
    suppress_health_check=list(HealthCheck),
)

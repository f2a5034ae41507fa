"""Sensors that are switched off: they do not work, and the others do."""

from __future__ import annotations

from bridge.msgs import Msg
from sim.core.constants import STEPS_PER_SECOND
from sim.physics.backend_bullet import State
from sim.sensors.suite import Measure, SensorSuite


class Counting:
    """A suite of which it is counted how often each sensor worked."""

    def __init__(self) -> None:
        self.worked = {"sonar": 0, "both": 0}
        self.suite = SensorSuite()
        self.suite.add("sonar", STEPS_PER_SECOND, self._count("sonar", "/sonar"))
        self.suite.add("both", STEPS_PER_SECOND, self._count("both", "/front", "/rear"))
        self._step = 0

    def _count(self, name: str, *topics: str) -> Measure:
        def measure(_: State, __: float) -> list[tuple[str, Msg]]:
            self.worked[name] += 1
            return [(topic, Msg()) for topic in topics]

        return measure

    def measure(self, times: int = 1) -> list[str]:
        """The topics of the last of so many steps."""
        told: list[str] = []
        for _ in range(times):
            told = [topic for topic, _ in self.suite.measure(self._step, _state, 0.0)]
            self._step += 1
        return told


def _state() -> State:
    zero = (0.0, 0.0, 0.0)
    return State(zero, (0.0, 0.0, 0.0, 1.0), zero, zero)


def test_a_sensor_whose_topics_are_off_does_not_work_and_does_again() -> None:
    run = Counting()
    assert run.measure() == ["/sonar", "/front", "/rear"]
    run.suite.switch("/sonar", False)
    assert run.measure(10) == ["/front", "/rear"]
    assert run.worked["sonar"] <= 2, "once to find out what it tells"
    assert run.worked["both"] == 11
    run.suite.switch("/sonar", True)
    assert run.measure(10) == ["/sonar", "/front", "/rear"]


def test_one_that_tells_of_something_else_too_works_for_that() -> None:
    run = Counting()
    run.suite.switch("/front", False)
    assert run.measure(3) == ["/sonar", "/rear"]
    run.suite.switch("/rear", False)
    assert run.measure(3) == ["/sonar"]
    assert run.worked["both"] == 4
    run.suite.switch("/rear", True)
    assert run.measure(2) == ["/sonar", "/rear"]

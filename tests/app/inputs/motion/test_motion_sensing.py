"""The motion sensors: on while somebody listens, and judged."""

from __future__ import annotations

import math
from collections.abc import Collection

import pytest

from app.device.motion import GRAVITY, Axes, Hear, Kind, MotionError, NoMotion, SimulatedMotion
from app.inputs.motion.motion_sensing import MAX_QUEUE, MotionSensing


class Phone:
    """A simulated phone, what listens to it, and the time."""

    def __init__(self, kinds: Collection[Kind] = ("acceleration", "gravity")) -> None:
        self.now, self.count = 0.0, 0
        self.source = SimulatedMotion(kinds, lambda: self.now)
        self.sensing = MotionSensing(self.source, lambda: self.now)
        self.got: list[tuple[float, Axes]] = []

    def listen(self, kind: Kind = "acceleration") -> Phone:
        self.forget = self.sensing.listen(kind, lambda t, axes: self.got.append((t, axes)))
        return self

    def run(self, seconds: float, rate: float = 50.0, axes: Axes | None = None) -> None:
        for _ in range(round(seconds * rate)):
            self.now += 1.0 / rate
            self.count += 1
            still = (0.0, 0.0, GRAVITY + 0.01 * math.sin(self.count))
            for kind in ("acceleration", "gravity"):
                self.source.put(kind, self.now, axes or still)
            self.sensing.update()

    def fault(self, kind: Kind = "acceleration", least: float = 25.0) -> str:
        return self.sensing.health(kind, least).fault


@pytest.fixture
def phone() -> Phone:
    return Phone()


def test_the_sensor_is_on_exactly_while_somebody_listens(phone: Phone) -> None:
    assert not phone.source.running
    phone.listen()
    assert phone.sensing.running == {"acceleration"}
    other = phone.sensing.listen("gravity", lambda *_: None)
    phone.forget()
    assert phone.sensing.running == {"gravity"}
    other()
    other()
    assert not phone.source.running


def test_samples_are_handed_on_in_their_order_by_a_look(phone: Phone) -> None:
    phone.listen()
    phone.source.put("acceleration", 0.0, (1.0, 2.0, 9.0))
    assert phone.got == []
    phone.sensing.update()
    assert phone.got == [(0.0, (1.0, 2.0, 9.0))]


def test_without_a_look_no_more_wait_than_the_queue_holds(phone: Phone) -> None:
    phone.listen()
    for n in range(1000):
        phone.source.put("acceleration", n * 1e-4, (0.0, 0.0, n * 0.001))
    phone.sensing.update(0.1)
    assert len(phone.got) == MAX_QUEUE
    assert phone.got[-1][1][2] == pytest.approx(0.999), "the newest are kept"


def test_fifty_a_second_are_well(phone: Phone) -> None:
    phone.listen().run(2.0)
    health = phone.sensing.health("acceleration")
    assert (health.fault, health.sentence) == ("", "")
    assert health.rate == pytest.approx(50.0)


def test_five_a_second_are_too_slow_for_a_shake_and_named(phone: Phone) -> None:
    phone.listen().run(3.0, rate=5.0)
    assert phone.sensing.health("acceleration").sentence == (
        "The motion sensor delivers 5 Hz, and at least 25 Hz are needed."
    )
    assert phone.fault(least=4.0) == ""


def test_the_rate_is_that_of_the_last_second(phone: Phone) -> None:
    phone.listen().run(5.0)
    phone.run(1.2, rate=5.0)
    assert phone.fault() == "slow"


def test_who_stops_listening_while_being_told_takes_nothing_from_the_next(phone: Phone) -> None:
    got: list[str] = []

    def once(*_: object) -> None:
        got.append("once")
        forget()

    forget = phone.sensing.listen("acceleration", once)
    phone.sensing.listen("acceleration", lambda *_: got.append("always"))
    phone.run(0.04)
    assert got == ["once", "always", "always"]


def test_silence_is_told_after_a_third_of_a_second(phone: Phone) -> None:
    phone.listen().run(1.0)
    phone.now += 0.29
    assert phone.fault() == ""
    phone.now += 0.02
    assert phone.fault() == "silent"


def test_a_glass_that_is_slow_to_look_makes_no_sensor_silent(phone: Phone) -> None:
    phone.listen().run(1.0)
    for n in range(40):  # it builds a screen meanwhile
        phone.now += 0.02
        phone.source.put("acceleration", phone.now, (0.0, 0.1 * n, GRAVITY))
        assert phone.fault() == ""
    phone.sensing.update()
    assert phone.fault() == ""
    phone.now += 0.31
    assert phone.fault() == "silent"


def test_nor_one_that_began_meanwhile(phone: Phone) -> None:
    phone.listen()
    phone.now += 2.0
    phone.source.put("acceleration", phone.now, (0.0, 0.0, GRAVITY))
    assert phone.fault() == ""


def test_what_came_before_a_slow_look_and_nothing_since_is_silence(phone: Phone) -> None:
    phone.listen().run(1.0)
    phone.now += 0.02
    phone.source.put("acceleration", phone.now, (0.0, 0.0, GRAVITY))
    phone.now += 0.4
    phone.sensing.update()
    assert phone.fault() == "silent"


def test_a_sensor_whose_samples_are_all_of_no_use_is_silent(phone: Phone) -> None:
    phone.listen().run(1.0)
    for _ in range(20):
        phone.now += 0.02
        phone.source.put("acceleration", phone.now - 60.0, (0.0, 0.0, GRAVITY))
        phone.sensing.update()
    assert phone.fault() == "silent"


def test_a_sensor_that_never_says_anything_is_waited_for_and_then_silent(phone: Phone) -> None:
    phone.listen()
    assert phone.fault() == "waiting"
    phone.now += 1.6
    assert phone.fault() == "silent"


def test_what_came_before_the_sensor_was_off_tells_nothing_of_how_it_is_now(phone: Phone) -> None:
    phone.listen().run(2.0)
    phone.now += 0.1
    phone.source.put("acceleration", phone.now, (0.0, 0.0, GRAVITY))
    phone.forget()
    phone.listen()
    phone.now += 0.5
    health = phone.sensing.health("acceleration")
    assert (health.fault, health.age) == ("waiting", math.inf)


def test_the_same_to_the_last_bit_for_a_second_is_frozen_until_it_changes(phone: Phone) -> None:
    phone.listen().run(1.0)
    phone.run(1.2, axes=(0.0, 0.0, 9.8))
    assert phone.fault() == "frozen"
    phone.run(0.1)
    assert phone.fault() == ""


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_what_is_no_number_is_left_out_and_told_for_two_seconds(phone: Phone, value: float) -> None:
    phone.listen().run(1.0)
    phone.run(0.02, axes=(0.0, value, 9.8))
    assert all(math.isfinite(number) for _, axes in phone.got for number in axes)
    assert phone.fault() == "broken"
    phone.run(2.1)
    assert phone.fault() == ""


def test_a_single_leap_is_left_out_and_one_that_stays_is_taken(phone: Phone) -> None:
    phone.listen().run(1.0)
    count = len(phone.got)
    phone.run(0.02, axes=(150.0, 0.0, 0.0))
    assert len(phone.got) == count
    assert phone.fault() == "jumps"
    phone.run(0.02, axes=(150.0, 1.0, 0.0))
    assert len(phone.got) == count + 1


def test_gravity_that_is_not_1_g_jumps(phone: Phone) -> None:
    phone.listen("gravity").run(1.0)
    phone.run(0.02, axes=(0.0, 0.0, 3.0))
    assert phone.fault("gravity") == "jumps"
    assert "gravity sensor jumps" in phone.sensing.health("gravity").sentence


def test_a_hard_shake_is_no_leap(phone: Phone) -> None:
    phone.listen().run(1.0)
    for n in range(100):
        phone.run(0.02, axes=(35 * math.sin(n * 0.02 * 2 * math.pi * 3.5), 0.0, 9.8))
    assert phone.fault() == ""
    assert len(phone.got) == 150


def test_what_is_old_or_out_of_order_is_no_news(phone: Phone) -> None:
    phone.listen().run(1.0)
    count, phone.now = len(phone.got), 3.0
    for t in (1.5, 0.9, math.nan):
        phone.source.put("acceleration", t, (0.0, 0.0, 9.8))
    phone.sensing.update()
    assert len(phone.got) == count


def test_in_the_background_nothing_is_on_and_it_comes_back(phone: Phone) -> None:
    phone.listen()
    phone.sensing.pause()
    assert not phone.source.running
    assert phone.fault() == "paused"
    phone.sensing.resume()
    assert phone.source.running


def test_closed_nothing_is_started_again(phone: Phone) -> None:
    phone.listen()
    phone.sensing.close()
    phone.sensing.resume()
    phone.listen()
    assert not phone.source.running


def test_a_device_without_a_sensor_says_so(phone: Phone) -> None:
    phone.sensing.use(NoMotion("No sensor here."))
    phone.listen()
    assert not phone.sensing.possible
    assert phone.sensing.health("acceleration").sentence == "No sensor here."
    assert Phone(kinds=["acceleration"]).fault("gravity") == "absent"


class Refusing(SimulatedMotion):
    def start(self, kinds: Collection[Kind], hear: Hear) -> None:
        raise MotionError("The system keeps its sensors.")


def test_a_system_that_refuses_is_quoted_and_nothing_breaks(phone: Phone) -> None:
    phone.sensing.use(Refusing())
    phone.listen()
    phone.sensing.update()
    assert phone.sensing.running == frozenset()
    assert phone.sensing.health("acceleration").sentence == "The system keeps its sensors."


class WithoutGravity(SimulatedMotion):
    """A system that hands out one of its sensors."""

    def start(self, kinds: Collection[Kind], hear: Hear) -> None:
        self.stop()
        if "gravity" in kinds:
            raise MotionError("The system keeps its gravity.")
        super().start(kinds, hear)


def test_what_is_refused_takes_nothing_else_with_it(phone: Phone) -> None:
    phone.source = WithoutGravity(now=lambda: phone.now)
    phone.sensing.use(phone.source)
    phone.listen()
    forget = phone.sensing.listen("gravity", lambda *_: None)
    phone.run(1.0)
    assert phone.sensing.running == {"acceleration"}
    assert phone.got
    assert (phone.fault(), phone.fault("gravity")) == ("", "refused")
    forget()
    phone.run(1.0)
    assert phone.fault() == ""
    assert phone.sensing.health("gravity").fault == ""


def test_another_source_takes_over_from_the_one_before(phone: Phone) -> None:
    phone.listen()
    other = SimulatedMotion(now=lambda: phone.now)
    phone.sensing.use(other)
    assert (phone.source.running, other.running) == (False, True)


def test_a_stamp_from_the_future_makes_nothing_that_follows_old(phone: Phone) -> None:
    phone.listen()
    phone.run(1.0)
    phone.source.put("acceleration", phone.now + 3600.0, (0.0, 0.0, GRAVITY))
    phone.sensing.update()
    count = len(phone.got)
    phone.run(1.0)
    assert len(phone.got) == count + 50
    assert phone.got[-1][0] == phone.now
    assert not phone.fault()

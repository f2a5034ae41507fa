"""The gate between everything that drives and the robot."""

from __future__ import annotations

import msgspec
import pytest

from bridge.core.codes import Code
from bridge.msgs import Msg
from bridge.msgs.geometry_msgs import Pose, Twist
from bridge.msgs.pilothouse_msgs import Manoeuvre
from robotside.control.guarded_robot import GuardedRobot, port_info
from robotside.core.refusal import OrderRefused
from robotside.motion.manoeuvres import Order
from tests.fakes import FakeRobot

AHEAD = Twist.planar(0.3, 0.0)
HOVER, LAND = Manoeuvre(kind="hover"), Manoeuvre(kind="land")


class Flier(FakeRobot):
    """It knows two manoeuvres."""

    def __init__(self) -> None:
        super().__init__()
        self.info = msgspec.structs.replace(self.info, manoeuvres=["hover", "land"])
        self.orders: list[Manoeuvre] = []

    def manoeuvre(self, order: Manoeuvre) -> None:
        self.orders.append(order)


def held(order: Order, allowed: float) -> Order:
    return Twist.planar(min(order.linear.x, allowed), 0.0) if isinstance(order, Twist) else order


def test_a_twist_brakes_while_stop_is_pressed_and_drives_again_afterwards() -> None:
    robot, pressed = FakeRobot(), True
    guarded = GuardedRobot(robot, lambda: pressed)
    guarded.drive(AHEAD)
    assert robot.commands == [None]
    pressed = False
    guarded.drive(AHEAD)
    assert robot.commands == [None, AHEAD]


def test_a_twist_is_clamped_and_looked_at_again_wherever_the_robot_gets() -> None:
    robot, allowed = FakeRobot(), 0.3
    guarded = GuardedRobot(robot, lambda: False, lambda order: held(order, allowed))
    guarded.again()
    guarded.drive(Twist.planar(0.5, 0.0))
    guarded.again()
    assert robot.commands == [Twist.planar(0.3, 0.0)]
    allowed = 0.1
    guarded.again()
    allowed = 0.0
    guarded.again()
    guarded.again()
    assert robot.commands[1:] == [Twist.planar(0.1, 0.0), None]
    allowed = 0.3
    guarded.again()
    assert robot.commands[3:] == [Twist.planar(0.3, 0.0)]


def test_after_a_stop_nothing_is_looked_at_again() -> None:
    robot = FakeRobot()
    guarded = GuardedRobot(robot, lambda: False, lambda twist: Twist.planar(0.1 * len(robot.commands), 0.0))
    guarded.drive(AHEAD)
    guarded.stop()
    guarded.again()
    assert robot.commands[-1] is None


def test_stop_ends_what_was_wanted_even_when_a_twist_comes_while_it_is_pressed() -> None:
    robot, pressed = FakeRobot(), False
    guarded = GuardedRobot(robot, lambda: pressed, lambda twist: Twist.planar(0.1 * len(robot.commands), 0.0))
    guarded.drive(AHEAD)
    pressed = True
    guarded.drive(AHEAD)
    pressed = False
    guarded.again()
    assert robot.commands[-1] is None


def test_a_fault_in_the_limits_brakes_the_robot() -> None:
    robot, broken = FakeRobot(), False

    def clamp(order: Order) -> Order:
        if broken:
            raise ZeroDivisionError
        return order

    guarded = GuardedRobot(robot, lambda: False, clamp)
    guarded.drive(AHEAD)
    broken = True
    with pytest.raises(ZeroDivisionError):
        guarded.again()
    with pytest.raises(ZeroDivisionError):
        guarded.drive(AHEAD)
    assert robot.commands == [AHEAD, None, None]
    broken = False
    guarded.again()
    assert robot.at_rest


def test_a_manoeuvre_goes_to_who_knows_it_and_brakes_while_stop_is_pressed() -> None:
    robot, pressed = Flier(), False
    guarded = GuardedRobot(robot, lambda: pressed)
    guarded.manoeuvre(HOVER)
    guarded.again()
    assert robot.orders == [HOVER]
    pressed = True
    guarded.manoeuvre(LAND)
    assert (len(robot.orders), robot.commands) == (1, [None])
    pressed = False
    guarded.again()
    assert len(robot.orders) == 1
    guarded.manoeuvre(Manoeuvre(kind="rest"))
    assert robot.commands == [None, None]


def test_a_manoeuvre_that_the_robot_refuses_is_told_by_its_sentence() -> None:
    class Picky(Flier):
        def manoeuvre(self, order: Manoeuvre) -> None:
            raise ValueError("-5 m is below the ground; Fake-1 goes on as before.")

    with pytest.raises(OrderRefused) as refused:
        GuardedRobot(Picky(), lambda: False).manoeuvre(HOVER)
    assert refused.value.notice == "-5 m is below the ground; Fake-1 goes on as before."
    assert refused.value.notice.code == Code.EQUIPMENT_REFUSED


def test_a_manoeuvre_is_looked_at_again_wherever_the_robot_gets() -> None:
    robot, free = Flier(), True
    guarded = GuardedRobot(robot, lambda: False, lambda order: order if free else Twist())
    guarded.manoeuvre(HOVER)
    free = False
    guarded.again()
    assert robot.commands == [None]


def test_one_that_knows_no_manoeuvres_gets_what_its_limits_make_of_them_and_refuses_to_land() -> None:
    robot = FakeRobot()
    guarded = GuardedRobot(robot, lambda: False, lambda order: AHEAD)
    guarded.manoeuvre(Manoeuvre(kind="course"))
    assert robot.commands == [AHEAD]
    with pytest.raises(OrderRefused, match=r"^Fake-1 cannot land\.$"):
        guarded.manoeuvre(LAND)
    assert robot.commands == [AHEAD]


def test_a_robot_behind_a_port_that_takes_twists_only_is_not_said_to_know_more() -> None:
    robot = FakeRobot()
    robot.info = msgspec.structs.replace(robot.info, manoeuvres=["hover"])
    assert port_info(robot).manoeuvres == []
    assert port_info(Flier()).manoeuvres == ["hover", "land"]


def test_what_carries_nothing_and_is_real_says_so() -> None:
    guarded = GuardedRobot(FakeRobot(), lambda: False)
    with pytest.raises(ValueError, match=r"^Fake-1 has no arm that takes orders\.$"):
        guarded.command("arm", AHEAD)
    with pytest.raises(ValueError, match="Fake-1 is real"):
        guarded.reset()


def test_everything_but_driving_passes_through() -> None:
    robot = FakeRobot()
    guarded = GuardedRobot(robot, lambda: True)
    assert guarded.info == robot.info
    assert "/map" in [topic for topic, _ in guarded.read(0.0)]
    guarded.want("/camera/image/compressed", True)
    assert robot.wanted == {"/camera/image/compressed": True}
    guarded.stop()
    assert robot.commands == [None]
    guarded.close()
    assert robot.closed


class Placed(FakeRobot):
    """It can be put back."""

    def reset(self) -> Pose:
        self.stop()
        return Pose()


def test_who_was_put_back_rests_there_wherever_it_is_measured_next() -> None:
    robot = Placed()
    guarded = GuardedRobot(robot, lambda: False, lambda _: Twist.planar(0.1 * len(robot.commands), 0.0))
    guarded.drive(AHEAD)
    guarded.reset()
    guarded.again()
    assert robot.commands[1:] == [None]


class Loaded(FakeRobot):
    """It carries something that moves, and has a STOP of its own."""

    def __init__(self) -> None:
        super().__init__()
        self.held, self.pressed = 0, False

    def command(self, payload: str, order: Msg) -> None:
        self.held = 0

    def hold_payloads(self) -> None:
        self.held += 1

    def press_stop(self) -> None:
        self.pressed = True

    def release_stop(self) -> None:
        self.pressed = False


def test_stop_brakes_the_robot_holds_what_moves_on_it_and_presses_the_stop_behind() -> None:
    robot = Loaded()
    guarded = GuardedRobot(robot, lambda: True)
    guarded.press_stop()
    assert (robot.commands, robot.held, robot.pressed) == ([None], 1, True)
    guarded.release_stop()
    assert not robot.pressed


def test_a_manoeuvre_that_is_left_for_one_that_knows_none_brakes_it() -> None:
    robot = FakeRobot()
    guarded = GuardedRobot(robot, lambda: False)
    guarded.drive(AHEAD)
    guarded.manoeuvre(Manoeuvre(kind="course"))
    assert robot.commands == [AHEAD, None]

"""Inputs of a screen with a control under either thumb: each is looked at for itself, a gamepad pushes both or none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from app.link.control_mixer import ControlMixer, Parts, Reach
from bridge.msgs.geometry_msgs import Twist
from tests.app.inputs.pushing import PAD, Hands
from tests.headless import Stage


class Thumbs(Hands):
    """A stick that climbs and turns at the left, a circle that tilts at the right."""

    def __init__(self, stage: Stage) -> None:
        from widgets import TiltCircle

        super().__init__(stage)
        self.circle = TiltCircle(size_hint=(None, None), size=(200, 200), pos=(600, 100))
        self.page.add_widget(self.circle)
        self.shell.screens["drive"].sticks = [(self.stick, "left"), (self.circle, "right")]
        self.shell.rest = lambda: (self.stick.rest(), self.circle.rest())
        reach = Reach(climb=1.0)
        piloting = ControlMixer(
            self.slot.want, lambda: ("twist", "tilt"), lambda: reach, ("climb", "turn", "roll", "pitch")
        )
        self.stick.bind(on_command=lambda stick, _: piloting.set_parts(stick, Parts(climb=stick.forward)))
        self.circle.bind(on_command=lambda circle, said: piloting.set_parts(circle, Parts.of(said)))

    def touch(self, x: float, y: float) -> Any:
        touch = self.stage.touch(x, 200)
        touch.touch_down()
        touch.touch_move(x, y)
        self.pass_time(0.3)
        return touch

    @property
    def said(self) -> tuple[str, float, float]:
        """Kind, climb and pitch of the last order."""
        last = self.sent[-1][1]
        if isinstance(last, Twist):
            return "twist", last.linear.z, 0.0
        return last.kind, last.twist.linear.z, last.pitch


@pytest.fixture
def hands(stage: Stage) -> Iterator[Thumbs]:
    hands = Thumbs(stage)
    yield hands
    hands.inputs.close()


def test_two_fingers_make_one_order(hands: Thumbs) -> None:
    hands.touch(200, 290)
    hands.touch(700, 290)
    kind, climb, pitch = hands.said
    assert kind == "tilt"
    assert climb > 0.5
    assert pitch > 0.1


def test_a_finger_that_is_lost_ends_its_own_control_and_the_other_one_goes_on(hands: Thumbs) -> None:
    left, right = hands.touch(200, 290), hands.touch(700, 290)
    hands.stage.loop.touches.remove(right)
    hands.pass_time(0.3)
    assert hands.said[0] == "twist"
    assert hands.said[1] > 0.5
    hands.stage.loop.touches.remove(left)
    hands.rests_in_time(hands.stage.time.now)


@pytest.mark.parametrize("what", ["may not drive", "turned"])
def test_what_ends_one_of_them_for_all_ends_all(hands: Thumbs, what: str) -> None:
    hands.touch(200, 290)
    hands.touch(700, 290)
    if what == "turned":
        hands.turn = 2
    else:
        hands.session.may_drive = False
    hands.rests_in_time(hands.stage.time.now)


def both(hands: Thumbs) -> None:
    hands.source.there = {1: PAD}
    hands.pass_time(0.2)
    hands.source.there = {1: replace(PAD, forward=1.0, right=(1.0, 0.0))}
    hands.pass_time(0.5)


def test_a_gamepad_pushes_both_with_its_two_sticks(hands: Thumbs) -> None:
    both(hands)
    kind, climb, pitch = hands.said
    assert (kind, climb) == ("tilt", 1.0)
    assert pitch > 0.1
    hands.source.there = {1: PAD}
    hands.rests_in_time(hands.stage.time.now)


def test_a_finger_on_one_of_them_takes_both_from_the_gamepad(hands: Thumbs) -> None:
    both(hands)
    finger = hands.touch(200, 250)
    assert hands.said[0] == "twist", "the circle is let go"
    finger.touch_up()
    hands.rests_in_time(hands.stage.time.now)


def test_the_tablet_whose_clutch_is_held_takes_both_from_the_gamepad(hands: Thumbs) -> None:
    both(hands)
    pushed: list[float] = []
    hands.circle.needs_hold = hands.circle.clutched = True
    hands.circle.bind(on_command=lambda circle, _: pushed.append(circle.forward))
    for _ in range(10):
        hands.circle.steer((0.0, 0.3), (0.0, 0.3))
        hands.pass_time(0.05)
    assert pushed == [0.3]
    assert hands.stick.forward == 0.0
    assert hands.circle.clutched, "taking it from the gamepad opens no clutch"
    hands.circle.clutched = False
    hands.circle.rest()
    hands.rests_in_time(hands.stage.time.now)


def test_what_lies_over_one_of_them_takes_both_from_the_gamepad(hands: Thumbs) -> None:
    from widgets.parts.kit import Card

    both(hands)
    hands.page.add_widget(Card(size_hint=(None, None), size=(120, 60), pos=(640, 150)))
    hands.rests_in_time(hands.stage.time.now)

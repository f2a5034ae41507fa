"""Frames and fingers: nothing waits for a frame, no frame waits for good, and slow drawing is drawn less.

Frames take as long as a test says: a fence passes when the test's time has come.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from kivy.uix.button import Button

from app.device.gl_fences import GlFences
from app.frame_pacing import (
    CALM_DELAY,
    FINGER_SHARE,
    JUDGED_FRAMES,
    LOST_TIMEOUT,
    MAX_FRAME_PERIOD,
    MAX_LOST,
    SENDING_PAUSE,
    FramePacer,
)
from app.link.camera_decoder import PICTURE, Picture
from app.link.feeds import Post
from app.screens.shell.standing_banners import SLOW_DRAWING
from bridge.core.codes import Code
from bridge.msgs.geometry_msgs import Twist
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass, running
from tests.headless import FRAME, Stage
from widgets.controls.sticks.joystick import Joystick
from widgets.controls.stop.stop_button import StopButton

NEVER = 10**6
"""A frame that takes so long is not through in any test [s]."""


class SlowGl:
    """Fences of an OpenGL that takes `cost` [s] for a frame."""

    def __init__(self, now: Callable[[], float], cost: float) -> None:
        self._now, self.cost = now, cost
        self.due: dict[int, float] = {}
        self.made = 0

    def insert(self) -> int | None:
        self.made += 1
        self.due[self.made] = self._now() + self.cost
        return self.made

    def passed(self, fence: int) -> bool:
        return self._now() >= self.due[fence]

    def delete(self, fence: int) -> None:
        del self.due[fence]


class FullGl(SlowGl):
    """One that has no room for a fence."""

    def insert(self) -> None:
        self.made += 1


class Screen:
    """A pacer on the stage's window, and what it does in its order."""

    def __init__(self, stage: Stage, monkeypatch: pytest.MonkeyPatch, fences: SlowGl | None) -> None:
        self.stage, self.gl = stage, fences
        self.done: list[str] = []
        kind = type(stage.window)
        draw = kind.on_draw

        def drawn(window: Any) -> None:
            self.done.append("draw")
            draw(window)

        monkeypatch.setattr(kind, "on_draw", drawn)
        monkeypatch.setattr(kind, "on_flip", lambda _: self.done.append("flip"))
        self.pushed = False
        self.pacer = FramePacer(
            stage.window,
            fences,
            pushed=lambda: self.pushed,
            now=stage.time,
            sleep=lambda seconds: self.done.append(f"{seconds * 1e3:g} ms for the others"),
        )
        self.pacer.open()
        self.pacer._moved_at = stage.time.now  # a hand has just been at work

    def turns(self, count: int, period: float = FRAME) -> list[str]:
        """Turn the loop, with something new on the glass each time; what was done meanwhile."""
        before = len(self.done)
        for _ in range(count):
            self.stage.window.canvas.ask_update()
            self.stage.frames(1, period)
        return self.done[before:]


@pytest.fixture
def screen(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., Screen]]:
    made: list[Screen] = []

    def make(cost: float | None = 0.0, kind: type[SlowGl] = SlowGl) -> Screen:
        made.append(Screen(stage, monkeypatch, None if cost is None else kind(stage.time, cost)))
        return made[-1]

    yield make
    for one in made:
        one.pacer.close()


def begun(made: Screen) -> Screen:
    """A frame is being drawn."""
    made.turns(2)
    assert made.pacer.busy
    return made


# fingers during a frame


def test_a_finger_lifted_during_a_frame_of_200_ms_is_heard_in_the_next_turn(
    screen: Callable[..., Screen], stage: Stage
) -> None:
    said: list[Twist] = []
    stick = stage.show(Joystick(), (240, 240))
    stick.bind(on_command=lambda _, twist: said.append(twist))
    made = screen(0.2)
    touch = stage.touch(*stick.center)
    touch.touch_down()
    touch.touch_move(stick.center_x, stick.top - 10)
    begun(made)
    assert said[-1].linear.x > 0.1
    turned = stage.clock.frames
    touch.touch_up()
    made.turns(1)
    assert made.pacer.busy
    assert stage.clock.frames == turned + 1
    assert said[-1] == Twist()


def test_stop_pressed_during_it_is_said_before_it_is_through(
    screen: Callable[..., Screen], stage: Stage
) -> None:
    button = stage.show(StopButton(), (200, 100))
    said: list[object] = []
    button.bind(on_command=lambda *_: said.append(made.pacer.busy))
    made = begun(screen(0.2))
    stage.touch(*button.center).touch_down()
    assert said == [True]


def test_with_frames_that_are_never_through_the_robot_is_driven_and_comes_to_rest(
    driving: Glass, robot: FakeRobot
) -> None:
    app, stick = driving.app, driving.app.screens["drive"].stick
    app.timers.pacer = FramePacer(driving.stage.window, SlowGl(lambda: 0.0, NEVER), now=lambda: 0.0)
    app.timers.pacer.open()
    try:
        driving.until(lambda: app.timers.pacer.busy, "nothing was drawn")
        pushes: list[Any] = []

        def driven() -> bool:
            """Told to move again and again; a push that springs back on a machine that stood still is pushed anew."""
            if stick.finger is None and stick.state == "live":
                for gone in pushes[-1:]:
                    gone.touch_up()
                pushes.append(driving.hold(stick))
                pushes[-1].touch_move(stick.center_x, stick.top - 10)
            return sum(twist.linear.x > 0.1 for twist in robot.twists()) > 6

        driving.until(driven, "the heartbeat waits for frames")
        pushes[-1].touch_up()
        assert stick.order == Twist()
        driving.until(lambda: robot.twists()[-1] == Twist(), "it was not told to rest")
        stop = app.shell.stop
        driving.stage.touch(*stop.to_window(*stop.center)).touch_down()
        driving.until(lambda: any("stop" in name for name in robot.services()), "STOP was not sent")
        assert app.timers.pacer.busy
    finally:
        app.timers.pacer.close()


def test_what_a_finger_did_is_sent_before_the_next_frame_is_begun(
    screen: Callable[..., Screen], stage: Stage
) -> None:
    made = screen()
    finger = stage.touch(10, 10)
    finger.touch_down()
    finger.touch_up()
    assert made.turns(1) == [f"{SENDING_PAUSE * 1e3:g} ms for the others", "draw"]
    assert made.turns(1) == ["flip", "draw"], "nobody moved: nothing waits"


# one frame at a time


def test_no_frame_is_begun_while_one_is_being_drawn(screen: Callable[..., Screen]) -> None:
    made = begun(screen(10 * FRAME))
    assert made.done == ["draw"]
    assert made.turns(8) == [], "it is not on the glass before it is through"
    assert made.turns(2)[:2] == ["flip", "draw"]


def test_a_frame_that_is_never_through_is_given_up(screen: Callable[..., Screen]) -> None:
    made = begun(screen(NEVER))
    assert made.turns(round(LOST_TIMEOUT / FRAME) - 4) == []
    assert made.turns(6)[:2] == ["flip", "draw"]
    assert len(made.gl.due) == 1, "its fence went with it"


def lose_one(made: Screen) -> None:
    """A frame is begun whose fence does not pass; those that follow it do at once."""
    made.gl.cost = NEVER
    made.turns(4)
    assert made.pacer.busy
    made.gl.cost = 0.0
    made.turns(round(LOST_TIMEOUT / FRAME))
    assert not any(due > made.stage.time.now + 1 for due in made.gl.due.values()), "it was not given up"


def test_fences_that_are_lost_in_a_row_are_waited_for_no_longer(screen: Callable[..., Screen]) -> None:
    made = screen(NEVER)
    made.turns(round((MAX_LOST * LOST_TIMEOUT) / FRAME) + 10)
    made.stage.tap(10, 10)
    assert made.turns(60).count("flip") > 55, "the glass stands still"
    assert (made.gl.made, made.gl.due) == (MAX_LOST, {})
    assert not made.pacer.slow


def test_a_single_lost_one_is_forgiven(screen: Callable[..., Screen]) -> None:
    made = screen(0.0)
    for _ in range(MAX_LOST + 1):
        lose_one(made)
        made.turns(10)
    before = made.gl.made
    made.turns(10)
    assert made.gl.made > before


@pytest.mark.parametrize(("cost", "kind"), [(None, SlowGl), (0.0, FullGl)], ids=["no fences", "none left"])
def test_without_a_fence_a_frame_is_through_when_it_was_drawn(
    screen: Callable[..., Screen], cost: float | None, kind: type[SlowGl]
) -> None:
    made = screen(cost, kind)
    assert made.turns(3) == ["draw", "flip"] * 3
    assert not made.pacer.busy


def test_where_nothing_changed_nothing_is_drawn(screen: Callable[..., Screen], stage: Stage) -> None:
    made = screen()
    made.turns(2)
    stage.frames(3)
    drawn = made.done.count("draw")
    stage.frames(10)
    assert made.done.count("draw") == drawn
    assert made.done[-1] == "flip", "the last one is on the glass"


def test_sixty_frames_a_second_are_drawn_for_a_hand_and_thirty_for_nobody(
    screen: Callable[..., Screen], stage: Stage
) -> None:
    made = screen()
    stage.run_for(CALM_DELAY)
    assert made.turns(512, 1 / 512).count("draw") in range(28, 33)
    stage.tap(10, 10)
    assert made.turns(512, 1 / 512).count("draw") in range(55, 65)
    stage.run_for(CALM_DELAY)
    assert made.turns(512, 1 / 512).count("draw") in range(28, 33)


# what is held back


def test_what_writes_into_a_texture_waits_until_the_frame_is_through(screen: Callable[..., Screen]) -> None:
    made = screen(3 * FRAME)
    shown: list[str] = []
    made.pacer.when_free(lambda: shown.append("at once"))
    begun(made)
    for name in ("older", "newer"):
        made.pacer.when_free(lambda name=name: shown.append(name))
    assert shown == ["at once"]
    made.turns(3)
    assert shown == ["at once", "newer"]
    made.turns(8)
    assert shown == ["at once", "newer"]


def test_a_picture_that_waited_is_not_shown_of_a_robot_that_was_left(driving: Glass) -> None:
    app, frozen = driving.app, [0.0]
    pacer = FramePacer(driving.stage.window, SlowGl(lambda: frozen[0], 1.0), now=lambda: frozen[0])
    app.timers.pacer = pacer
    pacer.open()
    try:
        driving.until(lambda: pacer.busy, "nothing was drawn")
        shown = app.screens["drive"].video
        picture = Picture(1, 0.0, 4, 2, bytes(32))
        app.visit.deliver(PICTURE, Post(picture, app.now(), 1))
        assert list(shown.frame_size) == [0, 0], "it waits"
        frozen[0] = 2.0
        driving.until(lambda: list(shown.frame_size) == [4, 2], "it was never shown")
        driving.until(lambda: pacer.busy, "it was not drawn")
        app.visit.deliver(PICTURE, Post(Picture(2, 0.0, 8, 4, bytes(128)), app.now(), 1))
        app.leave()
        frozen[0] = 4.0
        pacer.step()
        assert not pacer.busy
        assert list(shown.frame_size) == [4, 2]
        assert math.isnan(app.visit._pictures._newest)
    finally:
        pacer.close()


# how often


def test_with_a_finger_down_drawing_takes_half_of_the_time_and_the_glass_goes_on(
    screen: Callable[..., Screen], stage: Stage
) -> None:
    cost = 0.025
    made = screen(cost)
    without = made.turns(512, 1 / 512).count("draw")
    finger = stage.touch(10, 10)
    finger.touch_down()
    touched = made.turns(512, 1 / 512).count("draw")
    assert touched == pytest.approx(FINGER_SHARE / cost, rel=0.15)
    assert touched < without
    finger.touch_up()
    made.gl.cost = 0.07
    made.turns(10)
    finger.touch_down()
    assert made.turns(512, 1 / 512).count("draw") == pytest.approx(1 / 0.07, rel=0.15)


@pytest.mark.parametrize(("cost", "drawn"), [(0.0, 60), (0.025, FINGER_SHARE / 0.025)])
def test_a_hand_on_a_gamepad_is_a_hand_at_work(
    screen: Callable[..., Screen], stage: Stage, cost: float, drawn: float
) -> None:
    made = screen(cost)
    stage.run_for(CALM_DELAY)
    assert made.turns(512, 1 / 512).count("draw") <= 33, "nobody is at work"
    made.pushed = True
    assert made.turns(512, 1 / 512).count("draw") == pytest.approx(drawn, rel=0.15)
    made.pushed = False
    assert made.turns(512, 1 / 512).count("draw") <= 33


def test_the_app_tells_it_of_a_control_that_is_pushed(driving: Glass) -> None:
    pacer, stick = driving.app.timers.pacer, driving.app.screens["drive"].stick
    assert not pacer._pushed()
    stick.lean(0.5, 0.0)
    assert pacer._pushed()
    stick.rest()
    assert not pacer._pushed()


def test_slow_drawing_and_its_end_are_logged_once_each_by_their_codes(
    screen: Callable[..., Screen], caplog: pytest.LogCaptureFixture
) -> None:
    made = screen(0.055)
    made.turns(JUDGED_FRAMES * 8)
    made.gl.cost = 0.01
    made.turns(1000)
    told = [record.getMessage().partition(":")[0] for record in caplog.records]
    assert told == [Code.DRAWING_SLOW, Code.DRAWING_FAST]


def test_below_twenty_frames_a_second_it_is_slow_and_draws_fifteen(screen: Callable[..., Screen]) -> None:
    made = screen(0.055)
    made.turns(JUDGED_FRAMES * 4 - 20)
    assert not made.pacer.slow
    made.turns(40)
    assert made.pacer.slow
    made.gl.cost = 0.04
    assert made.turns(512, 1 / 512).count("draw") == pytest.approx(1 / MAX_FRAME_PERIOD, abs=1)
    made.turns(1000)
    assert made.pacer.slow, "not fast before it is clearly faster"
    made.gl.cost = 0.01
    made.turns(1000)
    assert not made.pacer.slow


def test_a_few_slow_frames_are_not_slow_drawing(screen: Callable[..., Screen]) -> None:
    made = screen(0.0)
    for _ in range(10):
        made.gl.cost = 0.1
        made.turns((JUDGED_FRAMES - 6) * 7)
        assert not made.pacer.slow
        made.gl.cost = 0.0
        made.turns(8)


def test_slow_drawing_is_said_for_as_long_as_it_lasts_beside_a_refusal(driving: Glass) -> None:
    shell, refusal = driving.app.shell, "Move refused: the battery is low."
    shell.say(refusal, "warn", about="move")
    driving.app.timers.pacer.slow = True
    shell.tick()
    assert {refusal, SLOW_DRAWING} <= set(driving.banners())
    driving.stage.run_for(60, 1 / 8)
    shell.tick()
    assert SLOW_DRAWING in driving.banners()
    shell.say(refusal, "warn", about="move")
    assert {refusal, SLOW_DRAWING} <= set(driving.banners())
    driving.app.timers.pacer.slow = False
    shell.tick()
    assert refusal in driving.banners()
    assert SLOW_DRAWING not in driving.banners()


def test_of_a_robot_that_is_entered_later_it_is_said_at_once(glass: Glass, robot: FakeRobot) -> None:
    glass.app.timers.pacer.slow = True
    glass.app.open(robot.url)
    glass.until(lambda: glass.app.shell is not None, "no screens")
    assert SLOW_DRAWING in glass.banners()


def test_a_tap_takes_it_away_until_drawing_is_slow_anew(driving: Glass) -> None:
    shell, pacer = driving.app.shell, driving.app.timers.pacer

    def said(slow: bool) -> bool:
        pacer.slow = slow
        shell.tick()
        return SLOW_DRAWING in driving.banners()

    assert said(True)
    driving.tap(shell.standing.drawing)
    assert not said(True)
    assert not said(False)
    assert said(True)


def test_on_a_phone_it_gives_way_to_a_card_that_waits_for_a_finger(driving: Glass) -> None:
    shell, card = driving.app.shell, Button()
    driving.app.timers.pacer.slow = True
    for form, beside in (("wide", True), ("short", False), ("tall", False)):
        shell.form = form
        shell.tick()
        assert SLOW_DRAWING in driving.banners()
        shell.notices.keep(card, shown=True)
        shell.tick()
        assert (SLOW_DRAWING in driving.banners()) is beside
        shell.notices.keep(card, shown=False)


# in the app


def test_the_app_paces_its_frames_says_that_they_are_slow_and_leaves_them_to_kivy_in_the_end(
    stage: Stage, tmp_path: Path, robot: FakeRobot, monkeypatch: pytest.MonkeyPatch
) -> None:
    fences, drawn = SlowGl(stage.time, 0.1), [0]
    monkeypatch.setattr(GlFences, "of", lambda _: fences)
    kind = type(stage.window)
    monkeypatch.setattr(kind, "on_draw", lambda _: drawn.append(1))

    def frames(count: int) -> int:
        """How many of so many turns of the loop were drawn."""
        drawn.clear()
        for _ in range(count):
            stage.window.canvas.ask_update()
            stage.frames(1)
        return len(drawn)

    with running(stage, tmp_path, poll=True) as glass:
        glass.app.timers.pacer._now = stage.time
        glass.app.open(robot.url)
        glass.until(lambda: glass.app.shell is not None, "no screens")
        assert frames(64) in range(5, 12), "it does not wait for the frame before"
        frames(64 * 3)
        assert SLOW_DRAWING in glass.banners()
        assert fences.due
    assert fences.due == {}
    assert frames(64) == 64


# its end


def test_closed_it_leaves_the_frames_to_kivy_and_no_fence_behind(screen: Callable[..., Screen]) -> None:
    made = begun(screen(NEVER))
    made.pacer.close()
    assert made.gl.due == {}
    assert not made.pacer.busy
    assert made.turns(2) == ["draw", "flip"] * 2


def test_until_it_is_opened_kivy_draws_what_it_wants(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []
    monkeypatch.setattr(type(stage.window), "on_draw", lambda _: done.append("draw"))
    pacer = FramePacer(stage.window, None, now=stage.time)
    for _ in range(2):
        stage.window.canvas.ask_update()
        stage.frames(1, 0.001)
    assert done == ["draw"] * 2
    pacer.close()


def test_a_touch_counts_as_a_finger_and_a_mouse_that_hovers_does_not(stage: Stage) -> None:
    pacer = FramePacer(stage.window, None, now=stage.time)
    touch: Any = stage.touch(5, 5)
    touch.is_touch = False
    stage.loop.touches.append(touch)
    assert not pacer.touched
    touch.is_touch = True
    assert pacer.touched
    pacer.close()

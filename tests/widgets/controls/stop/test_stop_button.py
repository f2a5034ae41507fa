from __future__ import annotations

import pytest

from robotside.control.stop_release import MAX_HOLD_TIME, MIN_HOLD_TIME, StopRelease
from widgets.controls.stop.stop_button import (
    HOLD_MEMORY,
    LONG_HOLD_DURATION,
    PHASES,
    RELEASE_DURATION,
    StopButton,
)
from widgets.core.language import PSEUDO, language


@pytest.fixture
def stop(stage):
    button = stage.show(StopButton(), size=(300, 80))
    button.heard, button.holds = [], []
    button.bind(
        on_command=lambda _: button.heard.append("stop"),
        on_hold_stop=lambda _: button.holds.append("hold"),
        on_release_stop=lambda _: button.heard.append("release"),
    )
    return button


def test_stop_is_commanded_when_the_finger_comes_down(stage, stop):
    stage.touch(150, 40).touch_down()
    assert stop.heard == ["stop"]


def test_a_second_finger_commands_again(stage, stop):
    stage.touch(50, 40).touch_down()
    stage.touch(250, 40).touch_down()
    assert stop.heard == ["stop", "stop"]


def test_a_finger_beside_it_commands_nothing(stage, stop):
    stage.tap(400, 40)
    assert stop.heard == []


@pytest.mark.parametrize("phase", ["ready", "sent", "no_answer"])
def test_it_can_be_pressed_in_every_phase_but_stopped(stage, stop, phase):
    stop.phase = phase
    stage.tap(150, 40)
    assert stop.heard == ["stop"]


def test_a_disabled_look_does_not_take_stop_away(stage, stop):
    stop.state = "stale"
    stage.tap(150, 40)
    assert stop.heard == ["stop"]


def test_a_hold_releases_and_less_does_not(stage, stop):
    stop.phase = "stopped"
    finger = stage.touch(150, 40)
    finger.touch_down()
    stage.run_for(0.9 * RELEASE_DURATION)
    finger.touch_up()
    assert stop.heard == []
    assert stop.held == 0.0
    finger = stage.touch(150, 40)
    finger.touch_down()
    stage.run_for(0.9 * RELEASE_DURATION)
    assert 0.8 < stop.held < 1.0
    stage.run_for(0.2)
    assert stop.heard == ["release"]


def test_a_hold_is_told_when_its_first_finger_comes_down_and_only_where_it_releases(stage, stop):
    stage.tap(150, 40)
    assert stop.holds == []
    stop.phase = "stopped"
    stage.touch(50, 40).touch_down()
    assert (stop.holds, stop.heard) == (["hold"], ["stop"])
    stage.touch(250, 40).touch_down()
    assert stop.holds == ["hold"]


def test_it_takes_longer_on_the_glass_than_by_the_robots_clock():
    assert MIN_HOLD_TIME < RELEASE_DURATION < LONG_HOLD_DURATION < HOLD_MEMORY < MAX_HOLD_TIME


@pytest.mark.parametrize(("local", "phase"), [(False, "stopped"), (True, "no_answer")])
@pytest.mark.parametrize("frame", [1 / 64, 0.1, 0.2, 0.35, 0.39, 0.45, 1.0, 2.0])
def test_however_seldom_the_glass_is_drawn_a_hold_releases_when_the_robot_takes_it(
    stage, stop, local, phase, frame
):
    holds, refused = StopRelease(), []
    stop.bind(
        on_hold_stop=lambda _: holds.hold("me", stage.time.now, stage.time.now),
        on_release_stop=lambda _: refused.append(holds.objection("me", 0.0, stage.time.now)),
    )
    stop.local, stop.phase = local, phase
    stage.frames(1)
    finger = stage.touch(150, 40)
    finger.touch_down()
    stage.run_for(100.0, frame)
    finger.touch_up()
    assert refused == [""]


@pytest.mark.parametrize("frames", range(1, 5))
def test_on_a_glass_drawn_seldom_a_finger_that_leaves_before_the_end_releases_nothing(stage, stop, frames):
    stop.phase = "stopped"
    finger = stage.touch(150, 40)
    finger.touch_down()
    stage.frames(frames, 0.45)  # the fifth is the one that releases
    finger.touch_up()
    stage.run_for(20.0, 0.45)
    assert "release" not in stop.heard


@pytest.mark.parametrize("frame", [0.2, 0.45, 0.7, 1.0, 1.5])
def test_on_a_glass_drawn_seldom_six_seconds_are_enough_to_release(stage, stop, frame):
    stop.phase = "stopped"
    finger = stage.touch(150, 40)
    finger.touch_down()
    stage.frames(int(6.0 / frame), frame)
    finger.touch_up()
    assert stop.heard == ["release"]


def test_after_the_robot_was_told_anew_one_frame_that_takes_long_releases_nothing(stage, stop):
    stop.phase = "stopped"
    finger = stage.touch(150, 40)
    finger.touch_down()
    stage.frames(4, 2.0)
    assert stop.holds == ["hold"] * 2, "the robot has forgotten the first"
    stage.frames(1, 3.3)  # the finger left meanwhile, which is heard of after it
    assert "release" not in stop.heard
    finger.touch_up()
    stage.run_for(20.0, 0.45)
    assert (stop.heard, stop.held) == ([], 0)


def test_a_hold_releases_once(stage, stop):
    stop.phase = "stopped"
    stage.touch(150, 40).touch_down()
    stage.run_for(3.0)
    assert stop.heard == ["release"]


def test_the_finger_that_stopped_does_not_release(stage, stop):
    stage.touch(150, 40).touch_down()
    stop.phase = "stopped"
    stage.run_for(2.0)
    assert stop.heard == ["stop"]


def test_a_stop_held_here_alone_can_be_released_unconfirmed_but_not_by_a_frightened_press(stage, stop):
    stop.local, stop.phase = True, "no_answer"
    finger = stage.touch(150, 40)
    finger.touch_down()
    stage.run_for(2.5)
    assert stop.heard == ["stop"]
    stage.run_for(0.7)
    assert stop.heard == ["stop", "release"]
    finger.touch_up()


def test_a_stop_that_the_robot_owes_an_answer_to_is_not_released(stage, stop):
    for local, phase in ((False, "no_answer"), (True, "sent"), (True, "ready")):
        stop.local, stop.phase = local, phase
        finger = stage.touch(150, 40)
        finger.touch_down()
        stage.run_for(4.0)
        finger.touch_up()
    assert stop.heard == ["stop"] * 3


def test_rest_forgets_the_hold(stage, stop):
    stop.phase = "stopped"
    stage.touch(150, 40).touch_down()
    stage.run_for(0.5)
    stop.rest()
    stage.run_for(2.0)
    assert stop.heard == []


def test_every_phase_says_something_else(stop):
    said = set()
    for phase in PHASES:
        stop.phase = phase
        said.add((stop.word, stop.sentence))
    assert len(said) == len(PHASES)


@pytest.mark.parametrize(
    ("size", "upright"),
    [
        ((329, 76), False),
        ((210, 180), True),
        ((110, 173), True),
        ((150, 94), False),
        ((184, 68), False),
        ((128, 68), False),
    ],
)
@pytest.mark.parametrize("local", [False, True])
@pytest.mark.parametrize("phase", PHASES)
def test_its_words_fit_into_it_and_can_be_read(stage, size, upright, phase, local):
    button = stage.show(StopButton(phase=phase, local=local, ago="12 min"), size=size)
    stage.frames(3)
    column = button.children[0]
    assert button.upright is (upright or (phase == "ready" and size[0] < 2 * size[1]))
    assert column.width <= button.width
    assert column.height <= button.height
    assert min(button.ids.sentence.font_size, button.word_size) >= 14


@pytest.mark.parametrize("local", [False, True])
@pytest.mark.parametrize("phase", PHASES)
def test_on_a_phones_corner_its_words_keep_off_its_edges(stage, phase, local):
    button = stage.show(StopButton(phase=phase, local=local), size=(158, 106))
    stage.frames(3)
    assert button.children[0].height <= button.height - 12
    assert button.upright is (phase == "ready")


@pytest.mark.parametrize("local", [False, True])
def test_without_a_link_it_says_what_was_heard_last_and_lets_nothing_go(stage, stop, local):
    stop.local, stop.phase, stop.ago = local, "lost", "8 s"
    assert stop.word.replace("\u200a", "") != "STOPPED"
    assert stop.sentence == "no link, was STOPPED 8\u00a0s\u00a0ago"
    stage.touch(150, 40).touch_down()
    stage.run_for(4.0)
    assert stop.heard == ["stop"], "it can be pressed, and holding it releases nothing"


def test_one_that_is_pressed_and_moves_can_be_let_go_by_a_long_hold(stage, stop):
    stop.local, stop.phase = True, "moves"
    stage.touch(150, 40).touch_down()
    stage.run_for(3.2)
    assert stop.heard == ["stop", "release"]


@pytest.mark.parametrize(("local", "phase"), [(False, "stopped"), (True, "no_answer")])
def test_a_frame_that_takes_long_is_no_hold(stage, stop, local, phase):
    stop.local, stop.phase = local, phase
    finger = stage.touch(150, 40)
    finger.touch_down()
    stage.run_for(9.9, 3.3)
    finger.touch_up()
    assert "release" not in stop.heard


def test_a_second_finger_that_comes_and_goes_does_not_break_a_hold(stage, stop):
    stop.phase = "stopped"
    first, second = stage.touch(50, 40), stage.touch(250, 40)
    first.touch_down()
    stage.run_for(0.4 * RELEASE_DURATION)
    second.touch_down()
    stage.run_for(0.2 * RELEASE_DURATION)
    second.touch_up()
    assert stop.held == pytest.approx(0.6, abs=0.05)
    stage.run_for(0.5 * RELEASE_DURATION)
    assert stop.heard == ["release"]
    first.touch_up()


def test_a_hold_ends_with_the_last_finger(stage, stop):
    stop.phase = "stopped"
    first, second = stage.touch(50, 40), stage.touch(250, 40)
    first.touch_down()
    second.touch_down()
    first.touch_up()
    second.touch_up()
    stage.run_for(2 * RELEASE_DURATION)
    assert (stop.heard, stop.held, stop.pressed) == ([], 0, 0)


@pytest.mark.parametrize(
    ("local", "phase"), [(False, "stopped"), (True, "stopped"), (True, "no_answer"), (True, "moves")]
)
def test_a_thumb_that_rests_on_it_since_stop_does_not_go_on_with_the_hold_of_another_finger(
    stage, stop, local, phase
):
    stop.local = local
    thumb, frightened = stage.touch(50, 40), stage.touch(250, 40)
    thumb.touch_down()
    stop.phase = phase
    stage.run_for(0.5)
    frightened.touch_down()
    stage.run_for(0.2)
    frightened.touch_up()
    assert stop.held == 0
    stage.run_for(2 * LONG_HOLD_DURATION)
    thumb.touch_up()
    assert "release" not in stop.heard


def test_beside_a_thumb_that_rests_on_it_since_stop_a_hold_is_told_and_releases(stage, stop):
    stage.touch(50, 40).touch_down()
    stop.phase = "stopped"
    finger = stage.touch(250, 40)
    finger.touch_down()
    stage.run_for(1.1 * RELEASE_DURATION)
    assert (stop.holds, stop.heard) == (["hold"], ["stop", "release"])
    finger.touch_up()


def test_a_finger_that_came_during_a_hold_may_finish_it(stage, stop):
    stop.phase = "stopped"
    first, second = stage.touch(50, 40), stage.touch(250, 40)
    first.touch_down()
    stage.run_for(0.5 * RELEASE_DURATION)
    second.touch_down()
    first.touch_up()
    stage.run_for(0.6 * RELEASE_DURATION)
    assert (stop.holds, stop.heard) == (["hold"], ["release"])
    second.touch_up()


@pytest.mark.parametrize("size", [(132, 84), (300, 80), (344, 68), (200, 150)])
def test_its_word_keeps_to_it_in_a_language_of_longer_words(stage, size):
    language.name = PSEUDO
    try:
        stop = stage.show(StopButton(phase="stopped"), size)
        stage.frames(3)
        label = next(part for part in stop.walk() if getattr(part, "text", "") == stop.word)
        assert stop.word != "STOPPED"
        assert label.x >= stop.x
        assert label.right <= stop.right
    finally:
        language.name = "en"

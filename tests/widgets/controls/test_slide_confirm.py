from __future__ import annotations

import pytest

from widgets.controls.slide_confirm import OUTCOME_TIMEOUT, OUTCOMES, RETURN_DURATION, SlideToConfirm
from widgets.core.theme import theme


@pytest.fixture
def slide(stage):
    slide = stage.show(SlideToConfirm(text="take off", icon="arrow_upward"), size=(326, 63))
    slide.times = []
    slide.bind(on_confirm=lambda _: slide.times.append(1))
    return slide


def take(stage, slide):
    finger = stage.touch(*slide.knob[:2])
    finger.touch_down()
    return finger


def test_slid_to_the_end_it_confirms_once(stage, slide):
    finger = take(stage, slide)
    for x in (100, 200, 320, 325):
        finger.touch_move(x, 30)
    finger.touch_move(100, 30)
    finger.touch_move(325, 30)
    assert slide.times == [1]
    assert slide.share == 1.0


def test_let_go_early_it_slides_back_and_nothing_is_done(stage, slide):
    finger = take(stage, slide)
    finger.touch_move(250, 30)
    assert 0.5 < slide.share < 0.98
    finger.touch_up()
    stage.run_for(2 * RETURN_DURATION)
    assert (slide.times, slide.share) == ([], 0.0)


def test_a_finger_on_the_far_end_does_not_bring_the_knob_there(stage, slide):
    finger = stage.touch(310, 30)
    finger.touch_down()
    finger.touch_move(320, 30)
    finger.touch_up()
    assert (slide.times, slide.share) == ([], 0.0)


def test_the_knob_does_not_jump_to_the_finger(stage, slide):
    x, y, radius = slide.knob
    finger = stage.touch(x + radius * 0.8, y)
    finger.touch_down()
    assert slide.share == 0.0
    finger.touch_move(x + radius * 0.8 + 26, y)
    assert slide.share == pytest.approx(26 / (326 - 63))


def test_caught_while_it_slides_back_it_goes_on_from_there(stage, slide):
    finger = take(stage, slide)
    finger.touch_move(250, 30)
    finger.touch_up()
    stage.run_for(RETURN_DURATION / 3)
    caught = slide.share
    assert caught > 0.05
    take(stage, slide)
    stage.run_for(RETURN_DURATION)
    assert slide.share == pytest.approx(caught, abs=0.02)


@pytest.mark.parametrize("change", [{"state": "disabled"}, {"pos": (30, 0)}])
def test_disabled_or_moved_under_the_finger_it_slides_back(stage, slide, change):
    finger = take(stage, slide)
    finger.touch_move(250, 30)
    for name, value in change.items():
        setattr(slide, name, value)
    finger.touch_move(325, 30)
    stage.run_for(2 * RETURN_DURATION)
    assert (slide.times, slide.share) == ([], 0.0)


def test_confirmed_and_let_go_it_can_be_slid_again(stage, slide):
    for _ in range(2):
        finger = take(stage, slide)
        finger.touch_move(330, 30)
        finger.touch_up()
        stage.run_for(2 * RETURN_DURATION)
    assert slide.times == [1, 1]


def test_while_it_is_under_way_it_takes_no_finger(stage, slide):
    slide.answer("sent")
    take(stage, slide).touch_move(330, 30)
    assert slide.times == []


@pytest.mark.parametrize("outcome", ["accepted", "refused", "no_reply"])
def test_an_outcome_is_told_for_a_while(stage, slide, outcome):
    slide.answer("sent")
    slide.answer(outcome)
    stage.frames(2)
    assert f"take off: {OUTCOMES[outcome][0]}" in slide.texts
    stage.run_for(OUTCOME_TIMEOUT + 0.1)
    assert slide.outcome == "ready"
    assert "slide to take off" in slide.texts


def test_what_was_sent_is_told_until_there_is_an_answer(stage, slide):
    slide.answer("refused")
    slide.answer("sent")
    stage.run_for(OUTCOME_TIMEOUT + 0.1)
    assert slide.outcome == "sent"


def test_where_it_is_narrow_it_still_says_what_it_does(stage):
    slide = stage.show(SlideToConfirm(text="take off", icon="arrow_upward"), size=(176, 63))
    assert slide.texts[-2:] == ["slide to", "take off"]


def test_it_is_as_high_as_a_finger_needs(stage):
    slide = stage.show(SlideToConfirm())
    assert slide.height >= theme.target
    theme.gloves = True
    try:
        assert slide.height >= theme.target
    finally:
        theme.gloves = False


def test_slides_beside_each_other_have_their_words_on_as_many_lines(stage):
    slide = stage.show(SlideToConfirm(text="land"), size=(176, 62))
    stage.frames(2)
    assert "slide to land" in slide.texts
    slide.kin = ["take off"]
    stage.frames(2)
    assert {"slide to", "land"} <= set(slide.texts)

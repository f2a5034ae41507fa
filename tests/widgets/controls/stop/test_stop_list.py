from __future__ import annotations

import gc

import pytest

from widgets.controls.stop.stop_list import SOME, StopList


@pytest.fixture
def result(stage):
    widget = stage.show(StopList(), size=(388, 530))
    widget.heard = []
    widget.bind(
        on_command=lambda _: widget.heard.append("let go"),
        on_close=lambda _: widget.heard.append("close"),
    )
    return widget


def rows(result):
    return [(row.title, row.word) for row in reversed(result.ids.column.children)]


def test_each_robot_is_named_with_its_word_the_worst_first(stage, result):
    result.update(SOME, 2, 6)
    assert result.title == "STOPPED 2 of 6"
    assert rows(result) == [
        ("Commander", "MOVES"),
        ("Scout", "NO ANSWER"),
        ("Minnow-2", "SENT"),
        ("Aqua", "RELEASED"),
        ("Patrol-1", "STOPPED"),
        ("turtle1", "STOPPED"),
    ]
    assert not result.all_stopped


def test_rows_leave_with_their_robots(stage, result):
    result.update(SOME, 2, 6)
    result.update(SOME[:1], 1, 1)
    assert (rows(result), result.all_stopped) == ([("Patrol-1", "STOPPED")], True)


@pytest.mark.parametrize(
    ("robots", "offer"),
    [
        (SOME[:1], ""),
        (SOME[4:5], ""),
        (SOME[3:4], "Hold to stop sending"),
        (SOME[5:], "Hold to stop sending"),
    ],
    ids=["stopped", "released", "no answer", "held by zero speed"],
)
def test_what_can_be_let_go_is_what_is_still_sent(result, robots, offer):
    result.update(robots, 0, 1)
    assert result.offer == offer


def test_it_says_what_goes_on_and_who_was_too_many(result):
    result.update([SOME[3], SOME[5]], 1, 4, untried=2, since=1)
    assert result.footnote == (
        "1 more found since: press STOP ALL again."
        " 2 more not tried: too many at once. STOP is sent until every robot rests."
        " A robot without its own STOP rests only while zero speed is sent."
    )


def test_when_nothing_is_sent_any_more_it_says_how_to_release(result):
    result.update(SOME[:1], 1, 1)
    assert result.footnote == "To release one: connect to it, take control, hold STOP."


def test_letting_go_takes_a_hold_of_a_second(stage, result):
    result.update(SOME, 2, 6)
    stage.frames(3)
    button = result.ids.release
    finger = stage.touch(*button.to_window(*button.center))
    finger.touch_down()
    stage.run_for(0.8)
    finger.touch_up()
    assert (result.heard, button.held) == ([], 0.0)
    finger = stage.touch(*button.to_window(*button.center))
    finger.touch_down()
    stage.run_for(1.1)
    finger.touch_up()
    assert result.heard == ["let go"]


def test_the_cross_folds_it_and_nothing_behind_it_gets_a_finger(stage, result):
    result.update(SOME, 2, 6)
    stage.frames(3)
    beside = stage.touch(6, 6)  # within it, on nothing that can be pressed
    beside.touch_down()
    assert result.heard == []
    assert result.dispatch("on_touch_down", beside)
    cross = result.ids.close
    stage.tap(*cross.to_window(*cross.center))
    assert result.heard == ["close"]


def test_it_knows_the_height_that_shows_every_row(stage, result):
    result.update(SOME, 2, 6)
    stage.frames(3)
    result.height = result.wanted
    stage.frames(3)
    assert result.ids.column.height <= result.ids.roll.height + 1


def test_folded_it_is_one_line_that_names_the_worst(stage, result):
    result.update(SOME, 2, 6)
    result.cramped = result.folded = True
    stage.frames(2)
    assert result.worst == "Commander: MOVES"
    assert result.line < 80 < result.wanted
    assert result.ids.column.get_parent_window() is None
    stage.tap(*result.ids.fold.to_window(*result.ids.fold.center))
    result.folded = False
    stage.frames(2)
    assert result.ids.column.get_parent_window() is not None


def test_a_frame_that_takes_long_is_no_hold(stage, result):
    result.update(SOME, 2, 6)
    stage.frames(3)
    finger = stage.touch(*result.ids.release.to_window(*result.ids.release.center))
    finger.touch_down()
    stage.frames(2, 1.3)
    finger.touch_up()
    assert result.heard == []


def test_what_was_folded_comes_back_whole_after_the_collector_came(stage) -> None:
    folded = StopList(folded=True)
    gc.collect()
    folded.folded = False
    stage.frames(1)
    assert {child.__class__.__name__ for child in folded.ids.card.children} >= {"Roll", "HoldButton"}

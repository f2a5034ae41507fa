from __future__ import annotations

import math

import pytest

from bridge.core.units import yaw_from_heading
from bridge.msgs.pilothouse_msgs import Compass, Manoeuvre
from widgets.controls.course_dial import HOLD_DURATION, INNER, CourseDial
from widgets.controls.course_picture import KNOB
from widgets.core.geometry import dial_point


@pytest.fixture
def dial(stage):
    dial = stage.show(CourseDial(), size=(176, 176))
    dial.courses = []
    dial.bind(on_course=lambda _, yaw: dial.courses.append(yaw))
    return dial


def at(dial, heading, share=0.8):
    """The point of the dial in that direction [px]."""
    x, y, radius = dial.place
    across, up = dial_point(heading, radius * share)
    return x + across, y + up


def set_course(stage, dial, heading):
    """Rest on the rim until the dial takes the finger, and lift it."""
    finger = stage.touch(*at(dial, heading))
    finger.touch_down()
    stage.run_for(HOLD_DURATION + 0.1)
    finger.touch_up()


def course(heading):
    return Manoeuvre(kind="course", yaw=yaw_from_heading(heading))


@pytest.mark.parametrize("followed", [math.nan, 200.0])
@pytest.mark.parametrize("way", [(), (20, 30), (40, 90, 160)])
def test_a_tap_or_a_brush_sets_nothing(stage, dial, followed, way):
    if math.isfinite(followed):
        dial.show(course(followed))
    finger = stage.touch(*at(dial, 10))
    finger.touch_down()
    stage.run_for(HOLD_DURATION / 3)
    assert dial.course[1] == "keep holding"
    for heading in way:
        finger.touch_move(*at(dial, heading))
        stage.run_for(HOLD_DURATION / 4)
    finger.touch_up()
    stage.run_for(2 * HOLD_DURATION)
    assert (dial.courses, dial.dragged, dial.resting) == ([], False, False)
    assert math.isnan(dial.asked)


def test_a_finger_that_rests_sets_a_course_when_it_is_lifted_and_not_before(stage, dial):
    finger = stage.touch(*at(dial, 10))
    finger.touch_down()
    stage.run_for(HOLD_DURATION + 0.1)
    assert dial.course == (10.0, "let go to set")
    finger.touch_move(*at(dial, 88))
    assert (dial.aim, dial.courses) == (90.0, [])
    finger.touch_up()
    assert dial.courses == [pytest.approx(0.0)]
    assert (dial.asked, dial.course) == (90.0, (90.0, "sent"))


def test_the_mark_of_the_course_is_dragged_at_once_and_a_tap_on_it_sets_nothing(stage, dial):
    dial.show(course(45))
    stage.tap(*at(dial, 50, KNOB))
    assert (dial.courses, math.isnan(dial.asked)) == ([], True)
    finger = stage.touch(*at(dial, 45, KNOB))
    finger.touch_down()
    finger.touch_move(*at(dial, 120))
    finger.touch_up()
    assert dial.courses == [pytest.approx(yaw_from_heading(120))]


def test_let_go_in_the_middle_nothing_is_asked_for(stage, dial):
    dial.show(course(90))
    finger = stage.touch(*at(dial, 90, KNOB))
    finger.touch_down()
    finger.touch_move(*at(dial, 90, INNER * 0.5))
    assert dial.course == (90.0, "no change")
    finger.touch_up()
    assert (dial.courses, math.isnan(dial.asked)) == ([], True)


def test_a_finger_in_the_middle_does_not_take_hold(stage, dial):
    stage.tap(*dial.center)
    assert dial.courses == []


@pytest.mark.parametrize("how", ["rest", "disabled", "moved"])
def test_a_drag_that_is_broken_off_sets_no_course(stage, dial, how):
    finger = stage.touch(*at(dial, 90))
    finger.touch_down()
    stage.run_for(HOLD_DURATION + 0.1)
    assert dial.dragged
    if how == "rest":
        dial.rest()
    elif how == "disabled":
        dial.state = "disabled"
    else:
        dial.x = 50
    finger.touch_up()
    assert (dial.courses, dial.dragged) == ([], False)
    assert math.isnan(dial.aim)


def test_what_is_asked_for_becomes_the_course_only_when_the_robot_follows_it(stage, dial):
    dial.show(course(45))
    set_course(stage, dial, 120)
    dial.answer("accepted")
    assert (dial.wanted, dial.course) == (45.0, (120.0, "taken"))
    dial.show(course(120))
    assert (dial.wanted, dial.course) == (120.0, (120.0, ""))
    assert math.isnan(dial.asked)


@pytest.mark.parametrize(("outcome", "said"), [("refused", "refused"), ("no_reply", "no reply")])
def test_a_course_that_was_not_taken_goes_from_the_dial(stage, dial, outcome, said):
    dial.show(course(45))
    set_course(stage, dial, 120)
    dial.answer(outcome)
    assert dial.course == (45.0, said)


def test_a_robot_that_follows_no_course_shows_none(dial):
    dial.show(course(45))
    dial.show(Manoeuvre(kind="hover", yaw=1.0))
    assert math.isnan(dial.wanted)


@pytest.mark.parametrize(
    ("heading", "wanted", "words"),
    [
        (38.0, 45.0, "7° right"),
        (350.0, 20.0, "30° right"),
        (20.0, 350.0, "30° left"),
        (44.0, 45.0, "on course"),
        (math.nan, 45.0, ""),
        (38.0, math.nan, ""),
    ],
)
def test_how_far_off_it_is_is_said_the_shorter_way_round(dial, heading, wanted, words):
    dial.heading, dial.wanted = heading, wanted
    assert dial.off_words == words


def test_before_anything_is_known_there_are_dashes(stage, dial):
    stage.frames(2)
    assert [text for text in dial.texts if text not in "NESW"] == ["COURSE", "–", "bow –"]


def test_no_letter_stands_under_a_knob(stage, dial):
    dial.show(course(265))
    stage.frames(2)
    assert "W" not in dial.texts
    assert "N" in dial.texts


def test_while_the_robot_follows_no_course_it_says_how_to_set_one(dial):
    assert dial.course[1] == ""
    dial.show(Compass(heading=340.0))
    assert dial.course[1] == "hold to set"
    dial.show(course(75))
    assert dial.course[1] == ""
    dial.show(Manoeuvre(kind="rest"))
    dial.state = "disabled"
    assert dial.course[1] == ""


def test_where_it_is_wide_the_figures_stand_beside_the_dial(stage):
    dial = stage.show(CourseDial(), size=(326, 228))
    dial.show(Compass(heading=340.0))
    dial.show(course(75))
    stage.frames(2)
    assert dial.texts[-5:] == ["COURSE", "075°", "HEADING", "340°", "95° right"]


def test_where_little_is_left_beside_the_dial_the_figures_stand_in_it(stage):
    dial = stage.show(CourseDial(), size=(174, 134))
    dial.show(Compass(heading=340.0))
    stage.frames(2)
    assert not dial.beside
    assert dial.texts[-1] == "bow 340°"


def test_where_it_is_low_what_became_of_a_course_takes_the_place_of_its_name(stage):
    dial = stage.show(CourseDial(), size=(174, 96))
    dial.show(Compass(heading=340.0))
    dial.show(course(75))
    stage.frames(2)
    assert dial.texts[-4:] == ["COURSE", "075°", "HEADING", "340°"]
    set_course(stage, dial, 120)
    stage.frames(2)
    assert dial.texts[-4:] == ["SENT", "120°", "HEADING", "340°"]


def test_an_answer_that_comes_after_the_course_is_followed_leaves_no_word_behind(stage, dial):
    set_course(stage, dial, 120)
    dial.show(course(120))
    dial.answer("accepted")
    assert dial.course == (120.0, "")


def test_when_the_robot_goes_over_to_something_else_what_it_took_is_no_longer_said(stage, dial):
    dial.show(course(45))
    set_course(stage, dial, 120)
    dial.answer("accepted")
    dial.show(Manoeuvre(kind="hover"))
    assert (math.isnan(dial.asked), dial.outcome) == (True, "")

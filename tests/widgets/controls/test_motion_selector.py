from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import Mission
from widgets.controls.motion_selector import MotionSelector
from widgets.parts.choices import Segment
from widgets.parts.stepper import StepperEnd


@pytest.fixture
def selector(stage):
    selector = MotionSelector(size_hint=(None, None), width=330)
    stage.show(selector)
    stage.frames(4)
    selector.heard = []
    selector.bind(on_command=lambda _, change: selector.heard.append(change))
    return selector


def parts(selector, kind):
    return [widget for widget in selector.walk() if isinstance(widget, kind)]


def tap(stage, widget):
    stage.tap(*widget.to_window(*widget.center))


def test_showing_a_mission_commands_nothing(selector):
    selector.show(Mission(motion="random", dwell=8.0, laps=3, on_intruder="circle"))
    assert (selector.motion_name, selector.dwell, selector.laps, selector.reaction) == (
        "random",
        8.0,
        3,
        "circle",
    )
    assert selector.heard == []


def test_a_finger_chooses_the_motion(stage, selector):
    for segment in parts(selector, Segment)[1:3]:
        tap(stage, segment)
    assert selector.heard == [{"motion": "random"}, {"motion": "intermittent"}]


def test_the_dwell_can_be_set_in_intermittent_motion_only(stage, selector):
    more = parts(selector, StepperEnd)[1]
    tap(stage, more)
    assert selector.heard == []
    selector.show(Mission(motion="intermittent", dwell=5.0))
    tap(stage, more)
    assert selector.heard == [{"dwell": 6.0}]


def test_laps_go_from_until_stopped_upward(stage, selector):
    fewer, more = parts(selector, StepperEnd)[2:]
    tap(stage, fewer)
    tap(stage, more)
    tap(stage, more)
    assert selector.heard == [{"laps": 1}, {"laps": 2}]


def test_what_an_intruder_makes_it_do_is_chosen(stage, selector):
    for segment in parts(selector, Segment)[4:]:
        tap(stage, segment)
    assert selector.heard == [{"on_intruder": "stop"}, {"on_intruder": "circle"}]


def test_a_robot_that_only_knows_to_stop_is_understood(selector):
    selector.show(Mission(stop_on_intruder=True))
    assert selector.reaction == "stop"


def test_disabled_it_changes_nothing(stage, selector):
    selector.state = "disabled"
    for part in [*parts(selector, Segment), *parts(selector, StepperEnd)]:
        tap(stage, part)
    assert selector.heard == []


def test_a_motion_that_nobody_knows_is_shown_as_the_usual_one(selector):
    selector.show(Mission(motion="[b]sideways", on_intruder="dance"))
    assert (selector.motion_name, selector.reaction) == ("loop", "report")
    assert selector.heard == []

from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import ControlStatus
from widgets.core.icons import ICONS
from widgets.parts.option_list import OPTIONS, OptionList


@pytest.fixture
def options(stage):
    widget = stage.show(OptionList(), size=(388, 300))
    widget.heard = []
    widget.bind(on_command=lambda _, name, value: widget.heard.append((name, value)))
    return widget


def stands(widget):
    return {name: toggle.active for name, (_, toggle) in widget._rows.items()}


def tap(stage, widget, name):
    stage.frames(3)
    toggle = widget._rows[name][1]
    stage.tap(*toggle.to_window(*toggle.center))
    stage.frames(3)


def test_a_switch_stands_as_the_robot_says(options):
    options.show(ControlStatus(follows_link=False, lost_link_stops_task=True))
    assert stands(options) == {"follow_link": False, "lost_link_stops_task": True}


def test_a_finger_asks_and_the_switch_stays_until_the_robot_has_done_it(stage, options):
    options.show(ControlStatus())
    tap(stage, options, "follow_link")
    assert options.heard == [("follow_link", "off")]
    assert stands(options)["follow_link"]
    assert options._rows["follow_link"][0].detail == "Sent to the robot …"
    tap(stage, options, "follow_link")
    assert len(options.heard) == 1
    options.show(ControlStatus(follows_link=False))
    options.answered("follow_link")
    assert not stands(options)["follow_link"]
    assert options._rows["follow_link"][0].detail == OPTIONS["follow_link"].off


def test_a_refusal_leaves_it_as_it_was_and_it_can_be_asked_for_again(stage, options):
    options.show(ControlStatus())
    tap(stage, options, "lost_link_stops_task")
    options.answered("lost_link_stops_task")
    assert not stands(options)["lost_link_stops_task"]
    tap(stage, options, "lost_link_stops_task")
    assert options.heard == [("lost_link_stops_task", "on")] * 2


def test_what_the_robot_does_not_tell_cannot_be_switched(stage, options):
    tap(stage, options, "follow_link")
    assert options.heard == []
    assert options._rows["follow_link"][0].detail == "Not reported by the robot."


def test_who_does_not_drive_sees_them_and_switches_nothing(stage, options):
    options.show(ControlStatus())
    options.state = "disabled"
    tap(stage, options, "follow_link")
    assert (options.heard, stands(options)["follow_link"]) == ([], True)


def test_another_link_leaves_nothing_under_way(options):
    options.show(ControlStatus())
    options.ask("follow_link")
    options.forget()
    assert options.asked == {}


def test_every_icon_is_in_the_font():
    assert {option.icon for option in OPTIONS.values()} <= set(ICONS)

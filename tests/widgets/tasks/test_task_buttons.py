from __future__ import annotations

import pytest

from bridge.msgs.pilothouse_msgs import TaskStatus
from widgets.parts.buttons import PushButton
from widgets.tasks.task_buttons import COMMANDS, TaskButtons


@pytest.fixture
def panel(stage):
    panel = TaskButtons(size_hint=(None, None), width=420)
    stage.show(panel)
    stage.frames(3)
    panel.asked = []
    panel.bind(on_command=lambda _, name: panel.asked.append(name))
    return panel


def buttons(panel):
    return [widget for widget in panel.walk() if isinstance(widget, PushButton)]


@pytest.mark.parametrize(
    ("state", "commands"),
    [
        ("IDLE", ["start", "home"]),
        ("RUNNING", ["pause", "stop", "home"]),
        ("PAUSED", ["resume", "stop", "home"]),
        ("SUCCEEDED", ["start", "home"]),
        ("CANCELED", ["start", "home"]),
        ("FAILED", ["start", "home"]),
    ],
)
def test_each_state_offers_what_can_be_done(stage, panel, state, commands):
    panel.show(TaskStatus(state=state))
    stage.run_for(0.6)
    for button in buttons(panel):
        stage.tap(*button.to_window(*button.center))
    assert panel.asked == commands


def test_the_first_button_says_what_it_does(panel):
    said = []
    for state in ("IDLE", "RUNNING", "PAUSED"):
        panel.show(TaskStatus(state=state))
        said.append(buttons(panel)[0].text)
    assert said == ["Start patrol", "Pause", "Resume"]


@pytest.mark.parametrize(
    ("answer", "sentence", "role"),
    [
        (("start", "sent"), "Sent: start patrol", "muted"),
        (("start", "accepted", "", 0.018), "Accepted: start patrol (18 ms)", "ok"),
        (("start", "accepted", "", 0.3, "start heading 120°"), "Accepted: start heading 120° (300 ms)", "ok"),
        (("pause", "accepted"), "Accepted: pause", "ok"),
        (("start", "refused", "The mission has no points."), "Refused: The mission has no points.", "danger"),
        (("home", "no_reply"), "No reply to: go home", "warn"),
    ],
)
def test_it_says_what_became_of_a_command(panel, answer, sentence, role):
    panel.answer(*answer)
    assert (panel.sentence, panel.outcome_role) == (sentence, role)


def test_until_then_it_says_what_the_robot_says(panel):
    panel.show(TaskStatus(state="RUNNING", reason="Driving to point 3 of 6."))
    assert panel.sentence == "Driving to point 3 of 6."
    panel.answer("pause", "sent")
    assert panel.sentence == "Sent: pause"


@pytest.mark.parametrize(("outcome", "stays"), [("accepted", 6.0), ("refused", 15.0), ("no_reply", 15.0)])
def test_an_outcome_makes_room_for_what_the_robot_says(stage, panel, outcome, stays):
    panel.show(TaskStatus(state="RUNNING", reason="Driving to point 3 of 6."))
    panel.answer("resume", outcome)
    stage.run_for(stays - 0.2)
    assert panel.outcome == outcome
    stage.run_for(0.4)
    assert panel.sentence == "Driving to point 3 of 6."


def test_a_newer_outcome_is_told_for_its_own_time(stage, panel):
    panel.answer("pause", "accepted")
    stage.run_for(4.0)
    panel.answer("resume", "sent")
    stage.run_for(4.0)
    assert panel.outcome == "sent"


def test_what_was_accepted_is_told_until_the_task_goes_on_to_something_else(panel):
    panel.show(TaskStatus(state="RUNNING"))
    panel.answer("pause", "accepted")
    panel.show(TaskStatus(state="PAUSED", reason="Paused by tablet-B."))
    assert panel.sentence == "Accepted: pause"
    panel.show(TaskStatus(state="CANCELED", reason="Stopped."))
    assert panel.sentence == "Stopped."


def test_stop_takes_away_what_was_accepted(panel):
    panel.show(TaskStatus(state="RUNNING", reason="Stopped by tablet-B."))
    panel.answer("resume", "accepted")
    panel.held = True
    assert panel.sentence == "Stopped by tablet-B."


def test_a_press_claims_nothing_by_itself(stage, panel):
    stage.tap(*buttons(panel)[0].center)
    assert (panel.asked, panel.outcome, panel.task_state) == (["start"], "none", "IDLE")


def test_the_second_tap_on_pause_does_not_resume(stage, panel):
    panel.show(TaskStatus(state="RUNNING"))
    stage.run_for(0.6)
    first = buttons(panel)[0]
    stage.tap(*first.center)
    panel.show(TaskStatus(state="PAUSED"))
    stage.run_for(0.4)
    stage.tap(*first.center)
    assert panel.asked == ["pause"]
    stage.run_for(0.2)
    stage.tap(*first.center)
    assert panel.asked == ["pause", "resume"]


def test_a_finger_that_came_down_on_pause_does_not_resume(stage, panel):
    panel.show(TaskStatus(state="RUNNING"))
    stage.run_for(0.6)
    first = buttons(panel)[0]
    touch = stage.touch(*first.center)
    touch.touch_down()
    panel.show(TaskStatus(state="PAUSED"))
    stage.run_for(0.6)
    touch.touch_up()
    assert (panel.asked, first.state) == ([], "normal")


def test_disabled_it_asks_for_nothing(stage, panel):
    panel.state = "disabled"
    stage.tap(*buttons(panel)[0].center)
    assert panel.asked == []


def test_with_stop_pressed_only_what_ends_or_pauses_can_be_asked(stage, panel):
    panel.held = True
    for state in ("PAUSED", "RUNNING"):
        panel.show(TaskStatus(state=state))
        stage.run_for(0.6)
        for button in buttons(panel):
            stage.tap(*button.to_window(*button.center))
    assert panel.asked == ["stop", "pause", "stop"]


@pytest.mark.parametrize("brief", [False, True])
def test_the_buttons_stay_where_they_are_whatever_it_says(stage, panel, brief):
    places = set()
    panel.brief = brief
    for reason in (
        "",
        "Paused.",
        "The robot is not where the map says it is, so put it right before it drives on.",
    ):
        panel.answer("start", "refused" if reason else "none", reason)
        stage.frames(3)
        places.add(panel.height if brief else round(panel.top - buttons(panel)[0].y, 3))
    assert len(places) == 1


def test_a_refusal_is_told_to_its_end_with_what_to_do_about_it(stage):
    panel = TaskButtons(size_hint=(None, None), width=316)
    stage.show(panel)
    panel.answer("start", "refused", "Home is not set; set it on the map or let the robot be its home.")
    stage.frames(3)
    said = panel.ids.said
    assert not said.shorten
    assert panel.height >= buttons(panel)[0].height + said.texture_size[1]
    assert said.texture_size[1] > 1.8 * said.font_size


def test_a_command_that_there_is_not_is_an_error(panel):
    with pytest.raises(KeyError):
        panel.ask("fly")
    assert panel.asked == []


@pytest.mark.parametrize("width", [329, 360, 420])
@pytest.mark.parametrize("brief", [False, True])
def test_its_words_fit_into_its_buttons(stage, width, brief):
    for state in ("IDLE", "RUNNING", "PAUSED"):
        panel = TaskButtons(size_hint=(None, None), width=width, brief=brief)
        panel.show(TaskStatus(state=state))
        stage.show(panel)
        stage.frames(4)
        assert all(button.children[0].width <= button.width for button in buttons(panel))


def test_every_command_has_words_and_an_icon():
    assert set(COMMANDS) == {"start", "pause", "resume", "stop", "home"}


def test_why_nothing_can_be_pressed_is_not_veiled(stage):
    buttons = stage.show(TaskButtons(state="disabled", reason="It offers no tasks."), size=(380, 120))
    assert (buttons.veil[3], buttons.disabled) == (0.0, True)


@pytest.mark.parametrize("width", [180, 300, 420])
def test_all_buttons_are_written_in_one_size(stage, panel, width):
    panel.brief, panel.width = True, width
    panel.show(TaskStatus(state="RUNNING"))
    stage.frames(3)
    assert len({button.words_size for button in buttons(panel)}) == 1

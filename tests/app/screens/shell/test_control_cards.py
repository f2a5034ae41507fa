"""Control on the glass: asking, handing over, the mode, a task paused by the stick, a speed that follows the link."""

from __future__ import annotations

from typing import Any

from app.layout.arrange import Rect
from bridge.core.identity import public_id
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import Check, Checklist, ControlStatus, TaskStatus
from bridge.msgs.std_msgs import Time
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.controls.occlusion import covered

PATROL = TaskStatus(task="patrol", state="RUNNING", reason="Driving to point 2.")

COARSE = 1 / 16
"""Length of a frame where nothing is moved [s]."""


def cards(glass: Glass) -> list[str]:
    """Headlines of what lies over the screen, from top to bottom."""
    return [
        child.headline for child in reversed(glass.app.shell.notices.children) if hasattr(child, "headline")
    ]


def press(glass: Glass, button: Any) -> None:
    """As a finger that has seen what it presses."""
    glass.until(lambda: not button.disabled, button)
    glass.stage.run_for(0.6, COARSE)
    glass.tap(button)


def tell(robot: FakeRobot, **changes: Any) -> None:
    """Let the robot say so of itself, and go on from there."""
    fields = {name: getattr(robot.control, name) for name in robot.control.__struct_fields__}
    robot.control = ControlStatus(**{**fields, **changes})
    robot.publish("/control/status", robot.control)


def anna_asks(glass: Glass, robot: FakeRobot) -> Any:
    due = Time.at(robot.clock() + 8.0)
    tell(robot, requested_by="Anna", requested_by_id="a", handover=due)
    glass.until(lambda: glass.app.shell.cards.handover.parent is not None, "nobody asks")
    return glass.app.shell.cards.handover


def paused(glass: Glass, robot: FakeRobot, name: str, client_id: str) -> Any:
    """The card once the stick of `name`, who is published by that `client_id`, has paused the task."""
    robot.publish("/task/status", PATROL)
    glass.until(lambda: glass.app.session.running and not glass.app.shell.cards.paused.open, "not running")
    tell(robot, mode="PAUSED", driver=f"{glass.app.client_name} (2)")
    reason, names = f"Paused: {name} took the stick.", [KeyValue("name", name)]
    taken = {"code": "task_taken_over", "actor_id": client_id, "parameters": names}
    robot.publish("/task/status", TaskStatus(task="patrol", state="PAUSED", reason=reason, **taken))
    glass.until(lambda: glass.app.shell.cards.paused.open, "not paused")
    glass.stage.run_for(0.4, COARSE)
    return glass.app.shell.cards.paused


def test_the_driver_sees_on_every_screen_who_asks_and_hands_over(driving: Glass, robot: FakeRobot) -> None:
    card = anna_asks(driving, robot)
    for screen in ("mission", "tasks", "topics", "drive"):
        driving.app.show(screen)
        driving.stage.run_for(0.4, COARSE)
        (headline,) = cards(driving)
        assert headline.startswith("Anna asks for control · ")
    assert 0 < card.left <= 8.0
    press(driving, card.hand_over)
    assert robot.until(lambda: "/control/grant" in robot.services())
    driving.until(lambda: driving.banners() == ["Anna has control now."], driving.banners())
    stick = driving.app.screens["drive"].stick
    driving.until(lambda: stick.state == "disabled", "the stick still lives")


def test_who_has_control_now_is_not_said_any_more_once_it_is_free_or_the_link_is_gone(
    driving: Glass, robot: FakeRobot
) -> None:
    for end in ("free", "gone"):
        anna_asks(driving, robot)
        tell(robot, driver="Anna", driver_id="a", requested_by="", requested_by_id="")
        driving.until(lambda: driving.banners() == ["Anna has control now."], driving.banners())
        if end == "free":
            tell(robot, driver="", driver_id="")
            driving.until(lambda: not driving.banners(), driving.banners())
            driving.app.session.authority.acquire()
            driving.until(lambda: driving.app.session.control == "mine", "no control")
    robot.stop()
    driving.until(lambda: not driving.app.session.connected, "still connected")
    driving.stage.frames(8)
    assert not any("Anna" in text for text in driving.banners())


def test_the_driver_keeps_control(driving: Glass, robot: FakeRobot) -> None:
    card = anna_asks(driving, robot)
    robot.refusals["/control/object"] = "The disk is full."
    press(driving, card.keep)
    refused = "Refused: keep control. The disk is full."
    driving.until(lambda: refused in driving.banners(), driving.banners())
    del robot.refusals["/control/object"]
    press(driving, card.keep)
    assert robot.until(lambda: "/control/object" in robot.services())
    driving.until(lambda: not cards(driving), "the card stayed")
    assert driving.app.session.control == "mine"


def test_who_somebody_else_drives_is_asked_for_and_that_is_taken_back(
    driving: Glass, robot: FakeRobot
) -> None:
    tell(robot, driver="Bob", driver_id="b")
    driving.until(lambda: driving.app.session.control == "other", "still ours")
    driving.tap(driving.app.shell.ids.control)
    driving.until(lambda: cards(driving), "not asked")
    assert cards(driving)[0].startswith("You asked Bob · ")
    assert driving.app.shell.bar.control_text.startswith("asked Bob · ")
    press(driving, driving.app.shell.cards.handover.take_back)
    driving.until(lambda: not cards(driving), "still asked")
    assert [name for name in robot.services() if "control" in name][-2:] == [
        "/control/request",
        "/control/release",
    ]
    assert driving.app.session.control == "other"


def test_control_is_not_given_back_by_one_tap(driving: Glass, robot: FakeRobot) -> None:
    driving.tap(driving.app.shell.ids.control)
    driving.until(lambda: driving.app.shell.control.dialog is not None, "nobody asks")
    driving.stage.run_for(0.5, COARSE)
    driving.tap(driving.app.shell.control.dialog.ids.keep)
    driving.stage.run_for(0.5, COARSE)
    assert driving.app.session.control == "mine"
    assert "/control/release" not in robot.services()


def test_control_is_given_back_by_the_answer_to_a_question(driving: Glass, robot: FakeRobot) -> None:
    driving.tap(driving.app.shell.ids.control)
    driving.until(lambda: driving.app.shell.control.dialog is not None, "nobody asks")
    driving.stage.run_for(0.5, COARSE)
    driving.tap(driving.app.shell.control.dialog.ids.give_back)
    driving.until(lambda: driving.app.session.control == "free", "still ours")


def test_the_question_goes_when_control_is_gone_anyway(driving: Glass, robot: FakeRobot) -> None:
    driving.tap(driving.app.shell.ids.control)
    driving.until(lambda: driving.app.shell.control.dialog is not None, "nobody asks")
    dialog = driving.app.shell.control.dialog
    tell(robot, driver="Bob", driver_id="b")
    driving.until(lambda: dialog.parent is None, "it still asks")
    dialog.answer()
    driving.stage.run_for(0.5, COARSE)
    assert "/control/release" not in robot.services()


def test_the_mode_is_a_command_whose_answer_is_said(driving: Glass, robot: FakeRobot) -> None:
    chip, card = driving.app.shell.ids.mode, driving.app.shell.cards.mode
    driving.until(lambda: chip.pressable, "not offered")
    driving.tap(chip)
    driving.until(lambda: card.parent is not None, "no choice")
    assert card.auto.disabled
    assert card.said == "You are driving. Start a task to switch to AUTO."
    paused(driving, robot, "tablet-B", "b")
    driving.until(lambda: not card.auto.disabled, "no AUTO")
    robot.refusals["/mode/set"] = "The battery is empty."
    press(driving, card.auto)
    refused = "Refused: switch to AUTO. The battery is empty."
    driving.until(lambda: refused in driving.banners(), driving.banners())
    assert card.open
    del robot.refusals["/mode/set"]
    press(driving, card.auto)
    driving.until(lambda: "Done." in driving.banners(), driving.banners())
    driving.until(lambda: card.parent is None, "the card stayed")
    assert (robot.asked[-1][0], robot.asked[-1][1].mode) == ("/mode/set", "AUTO")
    driving.until(lambda: chip.text.startswith("AUTO"), chip.text)


def test_with_stop_pressed_or_another_driving_the_mode_is_not_to_be_changed(
    driving: Glass, robot: FakeRobot
) -> None:
    card = driving.app.shell.cards.mode
    paused(driving, robot, "tablet-B", "b")
    driving.app.shell.cards.ask_mode()
    driving.until(lambda: not card.auto.disabled, "no AUTO")
    tell(robot, stopped=True, mode="STOPPED")
    driving.until(lambda: card.auto.disabled, "AUTO under STOP")
    assert card.said == "STOP is pressed; hold it to release."
    tell(robot, stopped=False, mode="PAUSED", driver="Bob", driver_id="b")
    driving.until(lambda: card.said == "Bob has control.", card.said)
    assert card.auto.disabled


def test_taking_the_stick_pauses_the_task_and_offers_to_resume_it(driving: Glass, robot: FakeRobot) -> None:
    card = paused(driving, robot, f"{driving.app.client_name} (2)", public_id(driving.app.client_id))
    assert cards(driving) == ["Patrol is paused"]
    assert card.said == "You took the stick."
    stick = driving.app.screens["drive"].stick
    touch = driving.hold(stick)
    touch.touch_move(stick.center_x, stick.top - 10)
    driving.until(lambda: card.resume.disabled, "resumed under the stick")
    touch.touch_up()
    press(driving, card.resume)
    assert robot.until(lambda: "/task/resume" in robot.services())
    robot.publish("/task/status", PATROL)
    driving.until(lambda: not cards(driving), "still offered")


def test_what_was_paused_by_the_button_is_not_offered_twice(driving: Glass, robot: FakeRobot) -> None:
    robot.publish("/task/status", PATROL)
    pause = driving.app.screens["drive"].ids["pause"]
    press(driving, pause)
    assert robot.until(lambda: "/task/pause" in robot.services())
    robot.publish("/task/status", TaskStatus(task="patrol", state="PAUSED", reason="Paused by tablet."))
    driving.until(lambda: pause.text == "Resume", "not paused")
    driving.stage.run_for(0.4, COARSE)
    assert cards(driving) == []


def test_an_offer_to_resume_is_put_away_until_the_next_pause(driving: Glass, robot: FakeRobot) -> None:
    card = paused(driving, robot, "Bob", "b")
    assert card.said == "Bob took the stick."
    driving.tap(card.cross)
    driving.stage.run_for(0.4, COARSE)
    assert cards(driving) == []
    paused(driving, robot, "Bob", "b")
    assert cards(driving) == ["Patrol is paused"]


def test_a_capped_speed_is_shown_where_one_drives_and_switched_off_and_on(
    driving: Glass, robot: FakeRobot
) -> None:
    driving.app.session.link.health.measure = lambda: None
    driving.app.session.link.health.rtt = 0.32
    cap = driving.app.shell.cards.cap
    tell(robot, speed_cap=0.4)
    driving.until(lambda: cards(driving) == ["40 % speed"], cards(driving))
    driving.until(lambda: cap.said == "Slow link, 320 ms.", cap.said)
    driving.app.show("mission")
    driving.stage.run_for(0.4, COARSE)
    assert cards(driving) == []
    driving.app.show("drive")
    press(driving, cap.switch)
    driving.until(lambda: cards(driving) == ["Full speed always"], cards(driving))
    assert (robot.asked[-1][1].name, robot.asked[-1][1].value) == ("follow_link", "off")
    press(driving, cap.switch)
    driving.until(lambda: cards(driving) == ["40 % speed"], cards(driving))
    tell(robot, driver="Bob", driver_id="b")
    driving.until(lambda: cap.said == "Slow link of Bob.", cap.said)
    assert cap.switch.disabled


def test_no_card_lies_over_the_stick_or_over_stop(driving: Glass, robot: FakeRobot) -> None:
    anna_asks(driving, robot)
    tell(robot, speed_cap=0.4)
    paused(driving, robot, "Bob", "b")
    driving.app.shell.cards.ask_mode()
    before = tuple(driving.app.root.size)
    for size in ((412, 892), (892, 412), (1280, 800), (1920, 1200)):
        driving.app.root.size = size
        driving.stage.run_for(0.4, COARSE)
        assert cards(driving)[0].startswith("Anna asks for control")
        assert not covered(driving.app.screens["drive"].stick), size
        assert not covered(driving.app.shell.stop), size
    driving.app.root.size = before


def seen_in_part(glass: Glass, screen: Any) -> list[Any]:
    """What of the screen sticks out from under the cards, and can be seen."""
    notices = glass.app.shell.notices
    cover = Rect(*notices.pos, *notices.size)
    parts = {
        "drive": lambda: [
            screen.checks,
            screen.sight,
            *(one for slot in screen.places for one in screen.places[slot]),
        ],
        "mission": lambda: [screen.corner],
        "tasks": lambda: [screen.ids.listed, screen.ids.detail],
        "topics": lambda: [screen.list, screen.detail],
    }[glass.app.shell.screen]()
    controls = (screen.ids.get("stick"), getattr(screen, "video", None))
    return [
        one
        for one in parts
        if one not in controls
        and one.opacity
        and one.parent is not None
        and one.parent.opacity
        and cover.overlaps(Rect(*one.to_window(*one.pos), *one.size))
    ]


def test_what_would_be_seen_only_in_part_behind_the_cards_gives_way_and_comes_back(
    driving: Glass, robot: FakeRobot
) -> None:
    app, before = driving.app, tuple(driving.app.root.size)
    robot.publish("/checklist", Checklist(checks=[Check("battery", "bad", "Empty.")]))
    task = TaskStatus(task="deliver", state="RUNNING", asks="Has it been picked up?", reason="Waiting.")
    robot.publish("/task/status", task)
    driving.until(lambda: app.shell.question.open, "no question")
    anna_asks(driving, robot)
    for size in ((412, 892), (892, 412), (1280, 800)):
        app.root.size = size
        for name in ("drive", "mission", "tasks", "topics"):
            app.show(name)
            driving.stage.run_for(0.4, COARSE)
            assert not seen_in_part(driving, app.screens[name]), (size, name)
            assert app.shell.notices.top <= app.screens[name].top, (size, name)
    app.root.size = before
    tell(robot, requested_by="", requested_by_id="", handover=Time())
    robot.publish("/task/status", TaskStatus(task="", state="IDLE"))
    driving.until(lambda: not cards(driving) and not app.shell.question.open, "cards stay")
    app.shell.unsay("authority")
    app.show("tasks")
    driving.stage.run_for(0.4, COARSE)
    assert tasks_places(driving) == app.screens["tasks"].ids.detail.y


def tasks_places(glass: Glass) -> float:
    return float(glass.app.screens["tasks"].layout._places["detail"].y)


def test_a_stick_that_is_pushed_without_control_says_why_and_offers_to_ask(
    driving: Glass, robot: FakeRobot
) -> None:
    tell(robot, driver="Bob", driver_id="b")
    stick = driving.app.screens["drive"].stick
    driving.until(lambda: stick.disabled, "still mine")
    driving.tap(stick)
    driving.tap(stick)
    said = [
        one for one in driving.app.shell.notices.children if getattr(one, "text", "").startswith("Bob has")
    ]
    assert [one.text for one in said] == ["Bob has control; ask for it."], "once"
    said[0].dispatch("on_act")
    assert robot.until(lambda: "/control/request" in robot.services())
    tell(robot, driver="", driver_id="", stopped=True, mode="STOPPED")
    driving.until(lambda: driving.app.session.robot_stop.latched, "no STOP")
    driving.until(lambda: not any("Bob" in text for text in driving.banners()), "still said of Bob")
    driving.tap(stick)
    assert "STOP is pressed; hold it to release." in driving.banners()


def test_a_card_beside_a_picture_takes_no_word_from_it(driving: Glass, robot: FakeRobot) -> None:
    app, before = driving.app, tuple(driving.app.root.size)
    anna_asks(driving, robot)
    app.root.size = (412, 892)
    for name, over in (("drive", True), ("mission", False)):
        app.show(name)
        driving.stage.run_for(0.4, COARSE)
        assert (app.screens[name].video.below < 892) is over, name
    app.root.size = before


def test_the_age_of_the_map_does_not_stick_out_from_under_a_card(driving: Glass, robot: FakeRobot) -> None:
    driving.app.show("mission")
    driving.stage.run_for(0.2, COARSE)
    map_ = driving.app.screens["mission"].map
    assert map_.says_age
    x, y = map_.badge_pos
    driving.app.screens["mission"].clear(Rect(x - 50, y + 5, 200, 90))
    assert not map_.says_age


def test_on_a_phone_one_card_at_a_time_is_shown_and_what_cannot_wait_comes_first(
    driving: Glass, robot: FakeRobot
) -> None:
    shell = driving.app.shell
    for size, alone in (((412, 892), True), ((892, 412), True), ((1280, 800), False)):
        driving.app.root.size = size
        driving.stage.run_for(0.3, COARSE)
        tell(robot, speed_cap=0.4, requested_by="", requested_by_id="")
        driving.until(lambda: shell.cards.cap.parent is not None, "no word of the slow link")
        shell.cards.mode.open = True
        driving.stage.run_for(0.3, COARSE)
        assert (shell.cards.cap.parent is None) == alone, size
        assert shell.cards.mode.parent is not None
        anna_asks(driving, robot)
        driving.stage.run_for(0.3, COARSE)
        assert (shell.cards.mode.parent is None) == alone, size
        shell.reset.card.notify("Patrol-1 has turned over.")
        shell.cards.mode.open = False
        tell(robot, speed_cap=0.4, requested_by="", requested_by_id="")
        driving.until(lambda: shell.cards.handover.parent is None, "still asked")
        driving.stage.run_for(0.3, COARSE)
        assert (shell.cards.cap.parent is None) == (alone and shell.reset.card.parent is not None), size
        shell.reset.card.close()

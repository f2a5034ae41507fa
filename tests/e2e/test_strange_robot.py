"""The app on a robot and a server that are not ours: watched, driven by finger, stopped, and read field by field."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from kivy.core.window import Window

from tests.app.strange import Strange, strange_robot
from tests.e2e.handheld import Handheld, handheld


@pytest.fixture(params=[1, 2], ids=["ROS 1", "ROS 2"])
def strange(request: pytest.FixtureRequest) -> Iterator[Strange]:
    with strange_robot(request.param) as robot:
        yield robot


@pytest.fixture
def glass(strange: Strange, tmp_path: Path) -> Iterator[Handheld]:
    with handheld(tmp_path, url=strange.url, discover=False, screen="drive") as glass:
        glass.until(lambda: glass.app.shell is not None, "the robot's screens")
        yield glass


def press_and_hold(glass: Handheld, stop: Any) -> None:
    finger = glass.hand.down(stop.to_window(*stop.center))
    glass.until(lambda: stop.phase == "ready", "the release after a hold")
    glass.hand.up(finger)


def speeds(strange: Strange) -> list[float]:
    """Forward, of every drive command that clients connected now have sent [m/s]."""
    told = [op["msg"] for op in strange.operations("publish") if op["topic"] == "/cmd_vel"]
    return [msg["linear"]["x"] for msg in told]  # type: ignore[index]


def test_its_address_is_typed_and_what_is_missing_is_said(strange: Strange, tmp_path: Path) -> None:
    with handheld(tmp_path, discover=False, screen="drive") as glass:
        glass.tap("Add by address")
        glass.one("TextInput").text = strange.url
        glass.tap("Connect")
        glass.until(
            lambda: any("no Pilothouse services" in words for words in glass.words()), "what is missing"
        )
        glass.until(lambda: glass.one("Joystick").state == "live", "a stick to push")


def test_a_finger_that_lets_go_has_it_at_rest(glass: Handheld, strange: Strange) -> None:
    stick = glass.app.screens["drive"].stick
    glass.until(lambda: stick.state == "live", "a stick to push")
    finger = glass.drive(stick, lambda: strange.robot.speed > 0.1)
    glass.hand.up(finger)
    glass.until(lambda: strange.robot.speed == 0.0, "the robot to rest", 2.0)
    assert speeds(strange)[-1] == 0.0, "it was told to rest, and not left to its watchdog"


def test_a_cut_link_heals_and_nothing_old_moves_it(glass: Handheld, strange: Strange) -> None:
    stick = glass.app.screens["drive"].stick
    glass.until(lambda: stick.state == "live", "a stick to push")
    finger = glass.drive(stick, lambda: strange.robot.speed > 0.1)
    strange.cut()
    glass.until(lambda: stick.finger is None, "the stick to spring back")
    glass.until(lambda: glass.app.session.connected and stick.state == "live", "the link to heal")
    glass.run(1.0)
    assert strange.robot.speed == 0.0, "a finger that never left the glass must push anew"
    assert not any(speeds(strange))
    glass.hand.up(finger)
    finger = glass.drive(stick, lambda: strange.robot.speed > 0.1)
    glass.hand.up(finger)


def test_instruments_live_it_is_driven_and_stop_brings_it_to_rest(glass: Handheld, strange: Strange) -> None:
    drive = glass.app.screens["drive"]
    for kind in ("LaserScanView", "ArtificialHorizon", "HeadingTape", "Video"):
        glass.until(lambda kind=kind: glass.one(kind).state == "live", f"a live {kind}")
    glass.until(lambda: drive.stick.state == "live", "a stick to push")
    finger = glass.drive(drive.stick, lambda: strange.robot.speed > 0.1)
    before = strange.robot.x
    glass.until(lambda: strange.robot.x > before + 0.05, "the robot to get on")
    stop = glass.one("StopButton")
    glass.play(glass.hand.tap(stop.to_window(*stop.center)))
    glass.until(lambda: stop.phase == "stopped", "STOPPED, by its odometry", 4.0)
    assert strange.robot.speed == 0.0
    told = "zero speed is sent while the link stands. Its odometry says that it rests."
    assert any(told in words for words in glass.words())
    assert drive.stick.state == "disabled"
    heard = strange.robot.heard
    glass.until(lambda: strange.robot.heard >= heard + 5, "zero speed, again and again", 2.0)
    glass.hand.up(finger)
    press_and_hold(glass, stop)
    glass.until(lambda: drive.stick.state == "live", "a stick to push")
    assert strange.robot.speed == 0.0, "a release moves nothing"
    glass.hand.up(glass.push(drive.stick, 0.0, 1.0))


def test_the_fields_of_a_type_that_nobody_knew_are_on_the_glass(glass: Handheld, strange: Strange) -> None:
    glass.tap("Topics", "NavButton")
    glass.until(
        lambda: {"/scan", "sensor_msgs/LaserScan", "/gripper", "acme_msgs/Gripper"} <= set(glass.words()),
        "names and types",
    )
    glass.until(lambda: any(words.endswith(" Hz") for words in glass.words()), "rates")
    glass.one("TextInput").text = "GRIP"
    glass.until(lambda: "/scan" not in glass.words(), "only what is searched for")
    glass.tap("/gripper")
    glass.until(lambda: glass.app.screens["topics"].view.lines, "the fields")
    glass.until(
        lambda: (
            {"fingers", "limits", "raw", "acme_msgs/Finger[]", "−3 to 512   (−3  512)"} <= set(glass.words())
        ),
        "every field",
    )
    glass.tap("[1]")
    glass.until(lambda: {"force", "1.5000", "opening"} <= set(glass.words()), "what was folded")
    assert "/gripper" in strange.listened()
    glass.tap("Drive", "NavButton")
    glass.until(lambda: "/gripper" not in strange.listened(), "its subscription to end")


def test_what_is_said_once_is_shown_as_no_fault(glass: Handheld) -> None:
    glass.tap("Topics", "NavButton")
    listed = glass.app.screens["topics"].list
    floor = glass.app.screens["topics"]._places["detail"].y
    glass.until(lambda: listed.y == floor, "what is said over the list to go")
    glass.tap("/robot_description")
    glass.until(lambda: any(words.startswith("once, ") for words in glass.words()), "that it was said once")
    assert glass.app.screens["topics"].view.state == "live"


def test_what_it_does_not_offer_is_said_and_never_asked_for(glass: Handheld, strange: Strange) -> None:
    glass.tap("Mission", "NavButton")
    glass.until(
        lambda: any("stores no missions and offers no tasks" in words for words in glass.words()),
        "what is missing",
    )
    for words in ("Send to the robot", "Points", "Loop", "Start"):
        assert not glass.glass.labelled(words), "nothing that it cannot do is offered"
    glass.tap("anyone may drive")
    glass.until(lambda: any("has no control handling" in words for words in glass.words()), "why")
    glass.tap("Drive", "PrimaryButton")
    glass.until(lambda: glass.app.shell.screen == "drive", "the screen that fits it")
    glass.until(lambda: "It offers no tasks." in glass.words(), "why it can neither pause nor go home")
    assert not {"Pause", "Go home"} & set(glass.words())
    called = {str(op["service"]) for op in strange.operations("call_service")}
    assert {name for name in called if not name.startswith("/rosapi/")} == set()


@pytest.fixture(params=[(412, 892), (892, 412)], ids=["upright", "on its side"])
def phone(request: pytest.FixtureRequest) -> Iterator[None]:
    before, Window.size = tuple(Window.size), request.param
    yield
    Window.size = before


@pytest.mark.usefixtures("phone")
def test_a_lost_link_under_stop_leaves_stop_in_sight_and_says_what_is_so(
    glass: Handheld, strange: Strange
) -> None:
    stop, notices = glass.app.shell.stop, glass.app.shell.ids.notices
    glass.until(lambda: glass.one("Joystick").state == "live", "a stick to push")
    glass.play(glass.hand.tap(stop.to_window(*stop.center)))
    glass.until(lambda: stop.phase == "stopped", "STOPPED, by its odometry", 4.0)
    strange.vanish()
    for screen in ("drive", "topics", "mission"):
        glass.app.show(screen)
        glass.until(lambda: any("Nothing reaches it" in words for words in glass.words()), "the truth")
        assert not any("is sent while" in words for words in glass.words())
        glass.until(lambda: len(notices.children) == 2, "both sentences")
        glass.settle(notices)
        assert notices.right <= stop.x or notices.x >= stop.right or notices.y >= stop.top, screen


SENSIBLE = (
    *("Video", "LaserScanView", "Joystick", "ArtificialHorizon", "Battery", "Readout", "TurnTape"),
    "FieldView",
)
"""What a robot with these topics is driven and watched by."""
SCREEN_TIMEOUT = 10.0
"""From the first connection to a screen on which everything is live [s]."""


def test_its_topics_alone_make_a_screen_that_lives_within_ten_seconds_and_drives_it(
    glass: Handheld, strange: Strange
) -> None:
    glass.app.show("panels")
    screen = glass.app.screens["panels"]

    def live() -> bool:
        cards = {type(card.widget).__name__: card.widget for card in screen.board.cards}
        return set(SENSIBLE) <= set(cards) and all(cards[name].state == "live" for name in SENSIBLE)

    glass.until(live, "a live panel of each kind", SCREEN_TIMEOUT)
    stick = next(card.widget for card in screen.board.cards if type(card.widget).__name__ == "Joystick")
    finger = glass.drive(stick, lambda: strange.robot.speed > 0.1)
    glass.hand.up(finger)
    glass.until(lambda: strange.robot.speed == 0.0, "the robot to rest", 2.0)
    assert speeds(strange)[-1] == 0.0

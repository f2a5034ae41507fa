"""The fleet: the robot on the glass among all others, told apart where they have one name, and a tap to another."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from app.layout.views import Panel, View
from app.link.camera_decoder import Picture
from app.screens.parts.leave_dialog import LeaveDialog
from app.screens.shell import status_text
from bridge.discovery.hello import Hello
from bridge.msgs.geometry_msgs import Twist, TwistWithCovariance, Vector3
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.pilothouse_msgs import ControlStatus, TaskStatus
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass

OTHER = "ws://192.168.1.7:9090"


@pytest.fixture
def fleet(driving: Glass) -> Any:
    """The screen, with one more robot that says HELLO."""
    hear(driving, OTHER, "Scout-1")
    driving.app.show("fleet")
    driving.until(lambda: OTHER in driving.app.screens["fleet"].cards, "not listed")
    driving.stage.frames(3)
    return driving.app.screens["fleet"]


def hear(driving: Glass, url: str, name: str, **told: Any) -> None:
    hello = Hello(url=url, name=name, kind="wheels", boot=url, **told)
    driving.app.robots.heard(hello, driving.app.now())


def own(driving: Glass) -> str:
    return str(driving.app.session.link.url)


def test_the_one_on_the_glass_comes_first_and_says_what_it_does(
    driving: Glass, robot: FakeRobot, fleet: Any
) -> None:
    assert list(fleet.cards) == [own(driving), OTHER]
    robot.publish("/task/status", TaskStatus(task_id=1, task="patrol", state="RUNNING"))
    driving.until(lambda: "patrol" in fleet.cards[own(driving)].note, "its task is not told")
    assert fleet.cards[own(driving)].driver_text == "you"


def test_cards_beside_each_other_are_as_high_and_say_the_whole_address(driving: Glass, fleet: Any) -> None:
    fleet.grid.cols = 2
    driving.stage.frames(2)
    fleet._show()
    driving.stage.frames(3)
    mine, other = fleet.cards.values()
    assert mine.height == other.height
    assert mine.ids.connect.y == other.ids.connect.y
    for card in (mine, other):
        told = card.ids.told
        assert card.entry.address in told.text
        assert not told.shorten
        assert told.texture_size[1] <= told.height


def test_another_says_battery_and_driver_as_it_tells_them(driving: Glass, fleet: Any) -> None:
    hear(driving, OTHER, "Scout-1", battery=0.42, driver="Bob")
    card = fleet.cards[OTHER]
    driving.until(lambda: card.battery_text == "42 %", "old")
    assert "Bob" in card.driver_text


def test_robots_of_one_name_are_told_apart_by_address_and_by_their_last_picture(
    driving: Glass, fleet: Any
) -> None:
    name = driving.app.session.robot.name
    assert not fleet.cards[OTHER].note
    hear(driving, OTHER, name)
    driving.app.robots.heard(Hello(url=own(driving), name=name, boot="own"), driving.app.now())
    driving.until(lambda: "192.168.1.7" in fleet.cards[OTHER].note, "not told apart")
    assert "127.0.0.1" in fleet.cards[own(driving)].note
    assert fleet.cards[OTHER].snapshot is None
    driving.app.visit.seen.take(OTHER, Picture(1, 0.0, 400, 200, bytes(4 * 400 * 200)))
    driving.until(lambda: fleet.cards[OTHER].snapshot is not None, "no picture")
    assert fleet.cards[OTHER].snapshot.width <= 160


def test_a_tap_on_its_own_card_leads_to_the_drive_screen(driving: Glass, fleet: Any) -> None:
    driving.tap(fleet.cards[own(driving)].ids.connect)
    driving.until(lambda: driving.app.shell.screen == "drive", "not shown")


def test_a_tap_on_another_goes_there_and_asks_before_a_robot_that_moves_is_left(
    driving: Glass, robot: FakeRobot, fleet: Any
) -> None:
    opened: list[tuple[str, bool]] = []
    driving.app.open = lambda url, *, watch=False: opened.append((url, watch))
    robot.publish("/odom", Odometry(twist=TwistWithCovariance(Twist(Vector3(0.4), Vector3()))))
    driving.until(lambda: driving.app.session.checks.moves, "at rest")
    driving.tap(fleet.cards[OTHER].ids.connect)
    driving.stage.frames(3)
    (asked,) = [one for one in driving.app.root.children if isinstance(one, LeaveDialog)]
    assert opened == []
    driving.tap(asked.ids.leave)
    driving.until(lambda: opened == [(OTHER, False)], "not gone there")
    assert driving.app.session is None


def test_stop_all_is_there_for_them(driving: Glass, fleet: Any) -> None:
    driving.until(lambda: driving.app.corner.button.parent is not None, "no STOP ALL")


def test_cards_of_one_row_stand_at_its_upper_end(driving: Glass, fleet: Any) -> None:
    hear(driving, OTHER, driving.app.session.robot.name)
    hear(driving, "ws://192.168.1.9:9090", "Scout-9")
    driving.until(lambda: len(fleet.cards) == 3, "not listed")
    driving.stage.frames(4)
    columns = fleet.grid.cols
    assert columns > 1
    cards = list(fleet.cards.values())
    assert len({round(card.top) for card in cards[:columns]}) == 1


STATES = {
    "ready": (ControlStatus(mode="MANUAL"), "READY", "free", "take control"),
    "another's": (
        *(ControlStatus(mode="MANUAL", driver="Anna", driver_id="a"), "MANUAL · Anna"),
        *("other", "driven by Anna"),
    ),
    "another's task": (
        *(ControlStatus(mode="AUTO", driver="Anna", driver_id="a"), "AUTO"),
        *("other", "driven by Anna"),
    ),
    "stopped": (
        *(ControlStatus(mode="STOPPED", stopped=True, at_rest=True), "STOPPED"),
        *("free", "take control"),
    ),
}
"""What the robot tells, to the mode in words, who has control, and the words of that on the chip."""


def test_bar_chip_fleet_more_panels_stick_and_task_buttons_say_the_same_of_who_drives(
    driving: Glass, robot: FakeRobot, fleet: Any
) -> None:
    app, session = driving.app, driving.app.session
    session.authority.wanted = False
    app.show("more")
    drive, mission, more = (app.screens[name] for name in ("drive", "mission", "more"))
    panels = app.screens["panels"]
    places: dict[str, Any] = {"wide": (0, 0, 4, 6), "tall": (0, 0, 6, 6), "short": (0, 0, 4, 4)}
    info, views = session.robot.info, (View("Drive", (Panel("Joystick", **places),)),)
    app.profiles.save(info, replace(app.profiles.of(info), views=views))
    app.show("panels")
    driving.until(lambda: panels.sticks, "no stick on the view")
    for case, (status, words, who, chip_words) in STATES.items():
        robot.control = status
        robot.publish("/control/status", status)
        driving.until(lambda status=status: session.control_status.mode == status.mode, case)
        driving.until(lambda who=who: session.control == who, case)
        app.show("fleet")
        driving.until(
            lambda words=words: fleet.cards[own(driving)].note.startswith(words), f"{case}: the fleet"
        )
        for screen in (drive, mission, more):
            screen.tick()
        app.shell.tick()
        chip, card = app.shell.bar, fleet.cards[own(driving)]
        assert chip.mode_text.startswith(words.split(" · ")[0]), case
        assert bool(card.driver_text) == bool(chip.control_text), case
        assert chip.control_text == chip_words, f"{case}: the chip"
        assert more.tiles["control"].about == status_text.control(session, brief=False)[0], case
        held = who == "other" or status.stopped
        assert (drive.stick.state == "disabled") == held, f"{case}: the stick"
        app.show("panels")
        panels.tick()
        assert (panels.sticks[0][0].state == "disabled") == held, f"{case}: the panels"
        assert (mission.panel.tasks.disabled or mission.panel.tasks.held) == held, f"{case}: the tasks"
    app.show("fleet")
    robot.stop()
    driving.until(lambda: not session.connected, "it stands")
    driving.until(lambda: fleet.cards[own(driving)].note.startswith("no link"), "the fleet")
    app.shell.tick()
    drive.tick()
    mission.tick()
    assert (app.shell.bar.mode_text, fleet.cards[own(driving)].lost) == ("no link", True)
    assert (drive.stick.state, mission.panel.tasks.disabled) == ("disabled", True)

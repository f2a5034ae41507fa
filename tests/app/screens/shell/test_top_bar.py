"""The bar on top of a robot's screens, in the shapes of a window."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import Any

import pytest
from kivy.metrics import Metrics, sp

from app.screens.shell.top_bar import TopBar
from bridge.msgs.pilothouse_msgs import ControlStatus
from bridge.msgs.sensor_msgs import BatteryState
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.core.base import text_texture


@pytest.mark.parametrize("mode", ["AUTO", "STOPPED", "no link"])
def test_a_phone_has_room_for_the_name_and_keeps_clear_of_its_edge(stage: Any, mode: str) -> None:
    bar = TopBar()
    stage.show(bar, size=(412, 56))
    bar.arrange("tall")
    bar.robot_name, bar.mode_text = "Patrol-1", mode
    bar.ids.battery.state = bar.ids.link.state = "live"
    bar.ids.battery.show(BatteryState(percentage=0.62))
    bar.ids.link.rtt = 0.288
    stage.frames(4)
    name = bar.ids.name
    name.shorten = False
    name.text_size = None, None
    name.texture_update()
    assert name.texture_size[0] <= name.width
    assert bar.right - bar.ids.link.right >= 8


def test_upright_who_has_control_is_said_in_a_word_and_inputs_only_while_one_does_not_work(
    driving: Glass, robot: FakeRobot
) -> None:
    bar, session = driving.app.shell.bar, driving.app.session
    for chip in (bar.ids.battery, bar.ids.link):
        chip.state = "live"
    bar.arrange("tall")
    bar.tick(session)
    assert (bar.mode_text, bar.ids.control.text) == ("READY", "you")
    bar.show_methods([("touch", True), ("tilt", True)])
    assert bar.ids.inputs not in bar.children
    bar.show_methods([("touch", True), ("tilt", False)])
    assert bar.ids.inputs in bar.children
    robot.control = ControlStatus(mode="MANUAL", driver="Bartholomew", driver_id="b")
    robot.publish("/control/status", robot.control)
    driving.until(lambda: session.control == "other", "still mine")
    bar.tick(session)
    assert bar.ids.control.text == "Barthol…"
    session.authority.wanted = False
    robot.control = ControlStatus(mode="MANUAL")
    robot.publish("/control/status", robot.control)
    driving.until(lambda: session.control == "free", "not free")
    bar.tick(session)
    assert bar.ids.control.text == "free"


def test_a_long_name_is_written_smaller_and_not_cut(stage: Any) -> None:
    bar = TopBar()
    stage.show(bar, size=(412, 56))
    bar.arrange("tall")
    bar.robot_name, bar.mode_text = "Commander-1", "MANUAL"
    bar.ids.battery.state = bar.ids.link.state = "live"
    bar.ids.battery.show(BatteryState(percentage=0.62))
    bar.ids.link.rtt = 0.041
    stage.frames(4)
    name = bar.ids.name
    assert text_texture("Commander-1", name.font_size, bold=True).width <= name.width


def test_beside_a_silent_link_the_name_is_cut_and_never_too_small_to_read(stage: Any) -> None:
    bar = TopBar()
    stage.show(bar, size=(412, 56))
    bar.arrange("tall")
    bar.robot_name, bar.mode_text = "The tractor of the orchard", "STOPPED"
    bar.ids.battery.state = bar.ids.link.state = "live"
    bar.ids.battery.show(BatteryState(percentage=0.62))
    bar.ids.link.rtt, bar.ids.link.silence = 0.041, 12.0
    stage.frames(4)
    name = bar.ids.name
    assert name.font_size >= sp(13)
    assert name.is_shortened
    assert name.right <= bar.ids.mode.x


def test_what_has_no_satellites_to_tell_of_has_no_chip_for_them(stage: Any) -> None:
    bar = TopBar()
    stage.show(bar, size=(1280, 56))
    bar.arrange("wide")
    assert bar.ids.satellites in bar.children
    bar.located = False
    assert bar.ids.satellites not in bar.children


@pytest.mark.parametrize("width", [800, 892, 1280])
@pytest.mark.parametrize("name", ["Scout-1", "Commander-1", "The old tractor of the third orchard"])
def test_across_who_has_control_is_read_whole_and_the_name_is_cut_before(
    stage: Any, width: int, name: str
) -> None:
    bar = TopBar()
    stage.show(bar, size=(width, 56))
    bar.robot_name, bar.mode_text, bar.control_text = name, "PAUSED · patrol", "you"
    bar.fix_text = "±1.2 m"
    bar.arrange("short")
    bar.ids.battery.state = bar.ids.link.state = "live"
    bar.ids.battery.show(BatteryState(percentage=0.62))
    bar.ids.link.rtt = 0.288
    stage.frames(6)
    assert bar.ids.control.right <= bar.right
    assert bar.ids.name.right <= bar.ids.mode.x
    bar.mode_text = "AUTO"
    stage.frames(6)
    if width == 1280 and name == "Scout-1":
        assert bar.ids.satellites in bar.children
        assert bar.ids.name.width == bar.ids.name.texture_size[0]


@pytest.fixture
def large_text() -> Iterator[None]:
    """Text twice as large as usual."""
    Metrics.fontscale = 2.0
    yield
    Metrics.fontscale = 1.0


@pytest.mark.usefixtures("large_text")
@pytest.mark.parametrize(
    ("form", "width"), [("short", 800), ("short", 892), ("wide", 1280), ("tall", 412), ("tall", 360)]
)
def test_in_large_text_chips_give_up_words_and_what_it_does_and_who_has_it_stay(
    stage: Any, form: str, width: int
) -> None:
    bar = TopBar()
    stage.show(bar, size=(width, 56))
    bar.robot_name, bar.mode_text, bar.mode_brief = "Commander-1", "ANGEHALTEN · Rundgang", "ANGEHALTEN"
    bar.control_text, bar.control_brief, bar.fix_text = "Gefahren von tablet-B", "tablet-B", "±1.2 m"
    bar.protected = False
    bar.arrange(form)
    bar.ids.battery.state = bar.ids.link.state = "live"
    bar.ids.battery.show(BatteryState(percentage=0.62))
    bar.ids.link.rtt = 0.288
    stage.frames(6)
    shown = list(reversed(bar.children))
    assert {bar.ids.mode, bar.ids.control, bar.ids.name} <= set(shown)
    assert all(one.right <= other.x for one, other in itertools.pairwise(shown) if one.width), bar.given
    assert shown[-1].right <= bar.right, bar.given
    assert bar.ids.mode.text.startswith("ANGEHALTEN")
    assert "288 ms" in bar.ids.link.text
    before = dict(bar.given)
    stage.frames(3)
    assert bar.given == before, "it comes to rest"


def test_what_gave_way_comes_back_with_the_room(stage: Any) -> None:
    bar = TopBar()
    stage.show(bar, size=(700, 56))
    bar.robot_name, bar.mode_text, bar.mode_brief = "Commander-1", "PAUSED · patrol", "PAUSED"
    bar.control_text, bar.control_brief = "you have control", "you"
    bar.arrange("wide")
    stage.frames(4)
    assert bar.ids.control.text == "you"
    bar.width = 1280
    stage.frames(4)
    assert bar.ids.control.text == "you have control"
    assert bar.given == {}

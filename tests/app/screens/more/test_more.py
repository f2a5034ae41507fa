"""What a phone's navigation has no room for: every screen and every act of it at two taps from anywhere."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from app.screens.more.more import ACTS
from app.screens.parts.leave_dialog import LeaveDialog
from app.screens.parts.screen_table import MORE, beyond
from tests.app.glass import Glass
from widgets.core.theme import theme

PHONE = (412, 892)


@pytest.fixture
def more(driving: Glass) -> Iterator[Any]:
    """On a phone, after one tap on its last tab."""
    window, root = driving.stage.window, driving.app.root
    before = tuple(window.size)
    window.size = root.size = PHONE
    driving.stage.frames(2)
    driving.tap(driving.app.shell.nav.ids[MORE])
    driving.until(lambda: driving.app.shell.screen == MORE, "the tab leads nowhere")
    driving.stage.frames(3)
    yield driving.app.screens[MORE]
    window.size = root.size = before


def test_every_other_screen_and_every_act_has_a_tile_that_a_finger_hits(driving: Glass, more: Any) -> None:
    assert set(more.tiles) == {entry.name for entry in beyond("tall")} | set(ACTS)
    assert all(min(tile.size) >= theme.target for tile in more.tiles.values())


def test_a_tile_leads_to_its_screen_whose_tab_is_the_one_that_led_there(driving: Glass, more: Any) -> None:
    driving.tap(more.tiles["setup"])
    driving.until(lambda: driving.app.shell.screen == "setup", "not shown")
    driving.stage.run_for(0.2)
    assert driving.app.shell.nav.ids[MORE].active


def test_a_recording_is_started_and_ended_by_a_tile_that_says_how_long_it_runs(
    driving: Glass, more: Any
) -> None:
    records = driving.app.records
    driving.tap(more.tiles["record"])
    driving.until(lambda: records.recorder is not None, "nothing is recorded")
    driving.stage.run_for(0.2)
    assert (more.tiles["record"].words, more.tiles["record"].about) == ("Stop recording", "00:00")
    driving.tap(more.tiles["record"])
    driving.until(lambda: records.recorder is None, "it goes on")


def test_the_theme_goes_on_to_the_next(driving: Glass, more: Any) -> None:
    driving.tap(more.tiles["theme"])
    driving.until(lambda: theme.name == "sunlight", "the same")


def test_control_is_given_back_only_after_a_question(driving: Glass, more: Any) -> None:
    driving.tap(more.tiles["control"])
    driving.until(lambda: driving.app.shell.control.dialog is not None, "nothing asked")
    assert driving.app.session.control == "mine"


def test_help_opens_and_leaving_leads_to_the_robots(driving: Glass, more: Any) -> None:
    driving.tap(more.tiles["help"])
    driving.until(driving.app.pages.close_question, "no help")
    driving.tap(more.tiles["leave"])
    driving.stage.frames(3)
    asked = next(one for one in driving.app.root.children if isinstance(one, LeaveDialog))
    assert driving.app.session.control == "mine", "control is not given away at one tap"
    driving.tap(asked.ids.leave)
    driving.until(lambda: driving.app.session is None, "still there")

"""Gamepads in virtual time: the left stick leans, a button is STOP, and whatever is not held by a hand drives nothing."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.inputs.gamepad.gamepad import REARM_TIMEOUT, SILENCE_TIMEOUT, Gamepads, KivyPads, PadEvent
from app.inputs.gamepad.pad_map import Profile
from app.inputs.gamepad.sdl import PadState

BEAT = 0.03
DEAD_ZONE = Profile().dead_zone
REST = PadState(1, "Pad", 0.0, 0.0, stop=False, stop_button=1, raw=(0, 0))


def left_of(lean: dict[str, tuple[float, float]] | None) -> tuple[float, float] | None:
    return lean["left"] if lean is not None else None


class Desk:
    """Gamepads on a clock that the test moves; a hand trembles unless it is told not to."""

    def __init__(self) -> None:
        self.time = 100.0
        self.news: list[PadEvent] = []
        self.pads = Gamepads(lambda: self.time, on_news=self.news.append)
        self.there = {1: REST}
        self.leans: list[tuple[float, tuple[float, float] | None]] = []
        self.pass_time(0.1)

    def push(self, forward: float, left: float = 0.0, number: int = 1) -> None:
        self.there[number] = replace(REST, number=number, forward=forward, left=left)

    def pass_time(self, seconds: float, *, trembles: bool = True) -> None:
        end = self.time + seconds
        while self.time < end - 1e-9:
            self.time += BEAT
            if trembles:
                self.there = {
                    number: replace(state, raw=(round(state.forward * 99), int(self.time * 1000)))
                    for number, state in self.there.items()
                }
            self.pads.update(self.there.values())
            self.leans.append((self.time, left_of(self.pads.lean())))

    @property
    def lean(self) -> tuple[float, float] | None:
        return self.leans[-1][1]


@pytest.fixture
def desk() -> Desk:
    return Desk()


def test_the_left_stick_leans_and_let_go_it_drives_no_longer(desk: Desk) -> None:
    desk.push(1.0)
    desk.pass_time(1.0)
    assert desk.lean == (1.0, 0.0)
    assert desk.pads.standing == "drives"
    desk.push(0.0)
    desk.pass_time(BEAT)
    assert (desk.lean, desk.pads.standing) == (None, "ready")


def test_a_worn_stick_that_does_not_come_back_to_its_middle_commands_nothing(desk: Desk) -> None:
    desk.push(DEAD_ZONE - 0.01)
    desk.pass_time(1.0)
    assert desk.lean is None


def test_behind_the_dead_zone_it_begins_at_nothing_and_ends_at_all(desk: Desk) -> None:
    desk.push(DEAD_ZONE + 0.01)
    desk.pass_time(BEAT)
    assert desk.lean == (pytest.approx(0.0080, abs=1e-3), 0.0)
    desk.push(0.9, 0.9)
    desk.pass_time(BEAT)
    forward, left = desk.lean
    assert forward == left == pytest.approx(0.707, abs=1e-3)


def test_plugged_in_with_its_stick_pushed_it_does_not_drive_until_it_was_let_go(desk: Desk) -> None:
    desk.push(1.0, number=2)
    desk.pass_time(1.0)
    assert desk.lean is None
    desk.push(0.0, number=2)
    desk.pass_time(BEAT)
    desk.push(1.0, number=2)
    desk.pass_time(BEAT)
    assert desk.lean == (1.0, 0.0)


def test_unplugged_it_drives_nothing_at_the_next_heartbeat_and_that_is_told(desk: Desk) -> None:
    desk.push(1.0)
    desk.pass_time(0.5)
    del desk.there[1]
    desk.pass_time(BEAT)
    assert (desk.lean, desk.pads.standing) == (None, "none")
    assert desk.news == [PadEvent("plugged", "Pad"), PadEvent("unplugged driving", "Pad")]


def test_unplugged_at_rest_it_is_told_too(desk: Desk) -> None:
    del desk.there[1]
    desk.pass_time(BEAT)
    assert desk.news[-1] == PadEvent("unplugged", "Pad")


def test_silent_while_pushed_it_drives_nothing_within_the_limit_and_says_so_once(desk: Desk) -> None:
    desk.push(1.0)
    desk.pass_time(0.5)
    died = desk.time
    desk.pass_time(0.9, trembles=False)
    last = max(at for at, lean in desk.leans if lean is not None)
    assert last - died <= SILENCE_TIMEOUT
    assert desk.pads.standing == "silent"
    assert desk.news[1:] == [PadEvent("silent", "Pad")]


def test_heard_again_soon_it_drives_on_since_the_hand_is_there(desk: Desk) -> None:
    desk.push(1.0)
    desk.pass_time(0.5)
    desk.pass_time(0.5, trembles=False)
    desk.pass_time(BEAT)
    assert desk.lean == (1.0, 0.0)


def test_heard_again_after_long_it_must_be_let_go_first(desk: Desk) -> None:
    desk.push(1.0)
    desk.pass_time(0.5)
    desk.pass_time(REARM_TIMEOUT + 0.2, trembles=False)
    desk.pass_time(0.5)
    assert desk.lean is None
    desk.push(0.0)
    desk.pass_time(BEAT)
    desk.push(1.0)
    desk.pass_time(BEAT)
    assert desk.lean == (1.0, 0.0)


def test_on_a_cable_it_may_be_held_still(desk: Desk) -> None:
    desk.pads.wired = {"Pad"}
    desk.push(1.0)
    desk.pass_time(5.0, trembles=False)
    assert desk.lean == (1.0, 0.0)
    del desk.there[1]
    desk.pass_time(BEAT)
    assert desk.lean is None


def test_forbidden_while_pushed_it_must_be_let_go_before_it_drives(desk: Desk) -> None:
    desk.push(1.0)
    desk.pass_time(0.5)
    desk.pads.forbid()
    desk.pass_time(1.0)
    assert (desk.lean, desk.pads.standing) == (None, "let go")
    desk.push(0.0)
    desk.pass_time(BEAT)
    assert desk.pads.standing == "ready"
    desk.push(0.5)
    desk.pass_time(BEAT)
    assert desk.lean is not None


def test_of_two_the_first_that_is_pushed_drives_and_the_other_must_be_let_go(desk: Desk) -> None:
    desk.push(0.0, number=2)
    desk.pass_time(0.1)
    desk.push(1.0)
    desk.pass_time(0.1)
    desk.push(-1.0, number=2)
    desk.pass_time(0.5)
    assert desk.lean == (1.0, 0.0)
    desk.push(0.0)
    desk.pass_time(0.5)
    assert desk.lean is None
    desk.push(0.0, number=2)
    desk.pass_time(BEAT)
    desk.push(-1.0, number=2)
    desk.pass_time(BEAT)
    assert desk.lean == (-1.0, 0.0)


def test_it_knows_which_button_is_stop_also_of_a_gamepad_that_it_has_not_met(desk: Desk) -> None:
    assert not desk.pads.is_stop(1, "a")
    assert desk.pads.is_stop(1, "b")
    assert desk.pads.is_stop(7, "b")
    assert (desk.pads.button(7, 1), desk.pads.button(7, 9)) == ("b", "button 9")


def test_a_device_that_the_system_took_away_brings_the_gamepads_to_rest(desk: Desk) -> None:
    desk.push(1.0)
    desk.pass_time(0.5)
    desk.pads.lose()
    desk.pass_time(0.5)
    assert desk.lean is None
    assert desk.news[-1] == PadEvent("unplugged driving", "Pad")


def test_where_sdl_cannot_be_asked_kivys_events_tell_of_the_stick_and_silence_ends_it() -> None:
    desk, told = Desk(), KivyPads()
    desk.there.clear()
    told.axis(3, 1, 0)
    desk.pads.update(told.pads())
    desk.pads.lean()
    told.axis(3, 1, -32768)
    desk.pads.update(told.pads())
    assert left_of(desk.pads.lean()) == (1.0, 0.0)
    desk.time += SILENCE_TIMEOUT + BEAT
    desk.pads.update(told.pads())
    assert desk.pads.lean() is None


BOTH = ("left", "right")


def test_the_right_stick_is_looked_at_only_where_it_pushes_something(desk: Desk) -> None:
    desk.there[1] = replace(REST, right=(0.0, 1.0))
    desk.pass_time(0.5)
    assert desk.lean is None
    desk.pads.use(BOTH)
    desk.pass_time(0.5)
    assert desk.pads.lean() is None, "it was pushed already when it began to count"
    desk.there[1] = REST
    desk.pass_time(0.1)
    desk.there[1] = replace(REST, right=(0.0, 1.0))
    desk.pass_time(0.1)
    assert desk.pads.lean() == {"left": (0.0, 0.0), "right": (0.0, 1.0)}


def test_one_stick_let_go_the_other_one_drives_on(desk: Desk) -> None:
    desk.pads.use(BOTH)
    desk.pass_time(0.1)
    desk.there[1] = replace(REST, forward=1.0, right=(-1.0, 0.0))
    desk.pass_time(0.5)
    desk.there[1] = replace(REST, right=(-1.0, 0.0))
    desk.pass_time(BEAT)
    assert desk.pads.lean() == {"left": (0.0, 0.0), "right": (-1.0, 0.0)}
    desk.pass_time(SILENCE_TIMEOUT + 2 * BEAT, trembles=False)
    assert desk.pads.lean() is None, "it is silent"

"""Keys that drive while they are held, in virtual time: and no longer when nobody holds them, though nobody told."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.inputs.base.button_presses import Press
from app.inputs.keys.key_drive import MAX_HOLD, MIN_PUSH, REPEAT_TIMEOUT, KeyDrive
from app.inputs.keys.key_table import KeyTable

BEAT = 0.03
SCANCODES = {"w": 26, "a": 4, "s": 22, "d": 7, "up": 82, "left": 80}


class Desk:
    def __init__(self) -> None:
        self.time = 100.0
        self.table = KeyTable(rise=0.3, slow=0.4)
        self.said: list[str] = []
        self.system: set[int] = set()
        self.keys = KeyDrive(
            lambda: self.time, lambda: self.table, is_down=self.system.__contains__, on_lost=self.said.append
        )

    def press(self, name: str, *modifiers: str, scancode: int | None = None) -> Press:
        code = SCANCODES.get(name, 0) if scancode is None else scancode
        press = Press("key", ord(name[0]), name, self.time, scancode=code, modifiers=frozenset(modifiers))
        self.taken = self.keys.pressed(press)
        return press

    def pass_time(self, seconds: float, repeats: str = "") -> None:
        end = self.time + seconds
        while self.time < end - 1e-9:
            self.time += BEAT
            if repeats:
                self.keys.repeated(repeats)
            self.lean = self.keys.lean()

    @property
    def left(self) -> tuple[float, float] | None:
        return self.lean["left"] if self.lean is not None else None


@pytest.fixture
def desk() -> Desk:
    return Desk()


def test_a_held_key_drives_farther_and_farther_and_let_go_not_at_all(desk: Desk) -> None:
    press = desk.press("w")
    desk.pass_time(BEAT)
    assert desk.left == (MIN_PUSH, 0.0)
    desk.pass_time(1.0)
    assert desk.left == (1.0, 0.0)
    desk.keys.released(press)
    desk.pass_time(BEAT)
    assert desk.lean is None


def test_two_keys_make_a_curve_and_two_against_each_other_nothing(desk: Desk) -> None:
    desk.press("w")
    left = desk.press("a")
    desk.pass_time(1.0)
    assert desk.left == (1.0, 1.0)
    desk.keys.released(left)
    desk.press("s")
    desk.pass_time(BEAT)
    assert desk.lean is None


def test_the_place_of_the_key_counts_and_not_what_is_printed_on_it(desk: Desk) -> None:
    desk.press("z", scancode=26)
    desk.pass_time(1.0)
    assert desk.left == (1.0, 0.0)


def test_with_two_controls_the_arrows_push_the_right_one_else_the_same(desk: Desk) -> None:
    desk.keys.use({"left", "right"})
    desk.press("up")
    desk.press("a")
    desk.pass_time(1.0)
    assert desk.lean == {"left": (0.0, 1.0), "right": (1.0, 0.0)}
    other = Desk()
    other.press("up")
    other.pass_time(1.0)
    assert other.left == (1.0, 0.0)


def test_shift_drives_less_far(desk: Desk) -> None:
    desk.press("w")
    desk.keys.shifted(down=True)
    desk.pass_time(1.0)
    assert desk.left == (0.4, 0.0)
    desk.keys.shifted(down=False)
    desk.pass_time(BEAT)
    assert desk.left == (1.0, 0.0)


def test_with_ctrl_or_while_it_is_not_wanted_a_key_is_somebody_elses(desk: Desk) -> None:
    desk.press("w", "ctrl")
    assert not desk.taken
    desk.keys.wanted = lambda: False
    desk.press("w")
    assert not desk.taken
    desk.keys.wanted = lambda: True
    desk.table = replace(desk.table, drives=False)
    desk.press("w")
    assert not desk.taken


def test_forbidden_it_must_be_let_go_and_pressed_again(desk: Desk) -> None:
    press = desk.press("w")
    desk.pass_time(0.5)
    desk.keys.forbid()
    desk.pass_time(0.5, repeats="w")
    assert desk.lean is None
    desk.keys.released(press)
    desk.press("w")
    desk.pass_time(0.5)
    assert desk.left == (1.0, 0.0)


def test_repeats_that_stay_away_end_it_and_one_that_comes_again_goes_on(desk: Desk) -> None:
    desk.press("w")
    desk.pass_time(0.6, repeats="w")
    assert desk.left == (1.0, 0.0)
    died = desk.time
    while desk.lean is not None:
        desk.pass_time(BEAT)
    assert desk.time - died <= REPEAT_TIMEOUT + 2 * BEAT
    desk.pass_time(2 * BEAT, repeats="w")
    assert desk.lean is not None


def test_a_system_that_repeats_nothing_drives_on(desk: Desk) -> None:
    desk.press("w")
    desk.pass_time(5.0)
    assert desk.left == (1.0, 0.0)


def test_the_key_before_the_newest_repeats_no_longer_and_drives_on(desk: Desk) -> None:
    desk.press("w")
    desk.pass_time(0.6, repeats="w")
    turn = desk.press("a")
    desk.pass_time(0.6, repeats="a")
    desk.keys.released(turn)
    desk.pass_time(1.0)
    assert desk.left == (1.0, 0.0)


def test_a_key_that_the_system_has_down_no_longer_is_let_go_though_nobody_told(desk: Desk) -> None:
    desk.system.add(26)
    desk.press("w")
    desk.pass_time(0.5)
    assert desk.left == (1.0, 0.0)
    desk.system.clear()
    desk.pass_time(BEAT)
    assert desk.lean is None


def test_something_that_lies_on_a_key_drives_for_so_long_and_that_is_said(desk: Desk) -> None:
    desk.press("w")
    desk.pass_time(MAX_HOLD + 1.0, repeats="w")
    assert desk.lean is None
    assert desk.said == ["W is held for 30 s: the robot rests."]


def test_with_other_controls_on_the_glass_keys_must_be_let_go_first(desk: Desk) -> None:
    desk.press("w")
    desk.pass_time(0.5)
    desk.keys.use({"left", "right"})
    desk.pass_time(0.5)
    assert desk.lean is None

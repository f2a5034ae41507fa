"""Inputs expire: whatever pushes the stick and dies, at the sender zero speed leaves within 200 ms, in virtual time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from tests.app.inputs.pushing import (
    BACK,
    ESCAPE,
    LOSSES,
    PAD,
    SPACE,
    Hands,
    hands,
    paused,
    press,
    small_card,
    upright,
)

__all__ = ["hands", "upright"]


@pytest.mark.usefixtures("upright")
@pytest.mark.parametrize("happens", LOSSES.values(), ids=LOSSES)
def test_a_finger_that_is_lost_drives_no_longer(
    hands: Hands, happens: Callable[[Hands, Any], object]
) -> None:
    touch = hands.push()
    happens(hands, touch)
    hands.rests_in_time(hands.stage.time.now)


def test_a_finger_that_rests_without_a_move_drives_on(hands: Hands) -> None:
    hands.push()
    hands.pass_time(10.0)
    assert hands.moving


def test_a_second_finger_on_the_stick_and_its_end_change_nothing(hands: Hands) -> None:
    hands.push()
    second = hands.stage.touch(180, 220)
    second.touch_down()
    second.touch_up()
    hands.pass_time(0.5)
    assert hands.moving


def test_what_touches_only_the_corner_beside_the_round_is_not_over_the_stick(hands: Hands) -> None:
    hands.push()
    small_card(hands, (0, 60))
    hands.pass_time(0.5)
    assert hands.moving


def test_what_is_being_laid_out_is_over_the_stick_for_a_frame_and_does_not_end_the_drive(
    hands: Hands,
) -> None:
    from widgets.parts.kit import Card

    hands.push()
    card = Card(size_hint=(None, None), size=(120, 60), pos=(100, 100))
    hands.page.add_widget(card)
    hands.pass_time(0.02)
    card.pos = (900, 600)
    hands.pass_time(0.5)
    assert hands.moving


GAMEPAD: dict[str, Callable[[Hands], object]] = {
    "let go": lambda hands: setattr(hands.source, "there", {1: PAD}),
    "unplugged": lambda hands: hands.source.there.clear(),
    "taken away, and SDL does not know yet": lambda hands: setattr(hands, "devices", frozenset({1})),
    "silent": lambda hands: setattr(hands.source, "trembles", False),
    **{
        name: lambda hands, happens=happens: happens(hands, None)
        for name, happens in LOSSES.items()
        if name in ("out of focus", "hidden", "minimised", "turned", "turned upside down", "dialog over it")
        or name in ("card over it", "another screen", "may not drive", "disabled", "frozen", "paused")
    },
}


@pytest.mark.usefixtures("upright")
@pytest.mark.parametrize("happens", GAMEPAD.values(), ids=GAMEPAD)
def test_a_gamepad_that_is_lost_drives_no_longer(hands: Hands, happens: Callable[[Hands], object]) -> None:
    hands.lean()
    happens(hands)
    hands.rests_in_time(hands.stage.time.now)


def test_a_gamepad_that_was_held_through_a_dialog_must_be_let_go_first(hands: Hands) -> None:
    hands.lean()
    dialog = hands.cover()
    hands.pass_time(0.5)
    hands.root.remove_widget(dialog)
    hands.pass_time(0.5)
    assert not hands.moving
    hands.lean()


def test_a_gamepad_that_stop_brought_to_rest_must_be_let_go_first(hands: Hands) -> None:
    hands.lean()
    hands.stick.rest()
    hands.rests_in_time(hands.stage.time.now)


def test_a_finger_takes_the_stick_and_the_gamepad_waits_until_both_let_go(hands: Hands) -> None:
    hands.lean()
    finger = hands.stage.touch(200, 200)
    finger.touch_down()
    finger.touch_move(110, 200)
    hands.pass_time(0.5)
    assert hands.sent[-1][1].linear.x == pytest.approx(0.0)
    assert hands.sent[-1][1].angular.z > 0.5
    finger.touch_up()
    hands.rests_in_time(hands.stage.time.now)
    hands.lean()


def finger_on_it(hands: Hands) -> Callable[[], object]:
    return hands.push().touch_up  # type: ignore[no-any-return]


def dialog_over_it(hands: Hands) -> Callable[[], object]:
    return hands.cover().close  # type: ignore[no-any-return]


def other_screen(hands: Hands) -> Callable[[], object]:
    hands.shell.screen = "mission"
    return lambda: setattr(hands.shell, "screen", "drive")


@pytest.mark.parametrize("begin", [finger_on_it, dialog_over_it, other_screen, paused])
def test_a_gamepad_that_was_pushed_while_it_might_not_drive_does_not_begin_to_by_itself(
    hands: Hands, begin: Callable[[Hands], Callable[[], object]]
) -> None:
    hands.source.there = {1: PAD}
    hands.pass_time(0.2)
    end = begin(hands)
    hands.pass_time(0.2)
    hands.source.there = {1: replace(PAD, forward=-1.0)}
    hands.pass_time(0.5)
    end()
    hands.pass_time(1.0)
    assert not hands.moving
    hands.lean()


@pytest.mark.usefixtures("upright")
def test_while_the_window_has_no_focus_a_gamepad_does_not_drive(hands: Hands) -> None:
    hands.stage.window._focus = False
    with pytest.raises(AssertionError):
        hands.lean()
    hands.stage.window._focus = True
    hands.lean()


def test_the_stick_shows_what_the_gamepad_does_and_what_happens_to_it_is_said(hands: Hands) -> None:
    assert hands.stick.gamepad == "none"
    hands.lean()
    assert hands.stick.gamepad == "drives"
    hands.source.trembles = False
    hands.pass_time(0.5)
    assert hands.stick.gamepad == "silent"
    hands.source.there.clear()
    hands.pass_time(0.1)
    assert hands.stick.gamepad == "none"
    assert hands.shell.said == ["Pad: its left stick drives, B is STOP.", "Pad is unplugged."]
    assert [text for text, _ in hands.shell.offers] == [
        "The gamepad is silent: the robot rests. Is it wired?"
    ]


def test_a_gamepad_said_to_hang_on_a_cable_may_be_held_still_and_that_is_remembered(hands: Hands) -> None:
    hands.settings = Kept()
    hands.lean()
    hands.source.trembles = False
    hands.pass_time(0.5)
    assert not hands.moving
    hands.shell.offers[0][1]()
    hands.source.trembles = True
    hands.lean()
    hands.source.trembles = False
    hands.pass_time(2.0)
    assert hands.moving
    assert hands.settings["wired_gamepads"] == ["Pad"]


class Kept(dict):  # type: ignore[type-arg]
    def set(self, name: str, value: Any) -> None:
        self[name] = value


@pytest.mark.parametrize("keys", [ESCAPE, SPACE], ids=["Escape", "Space"])
def test_a_key_is_stop_once_however_long_it_is_held(hands: Hands, keys: tuple[int, int]) -> None:
    press(hands, keys)
    assert (hands.stops, hands.back_pressed) == (1, 0)
    press(hands, keys)
    assert hands.stops == 2


@pytest.mark.usefixtures("upright")
@pytest.mark.parametrize("keys", [ESCAPE, SPACE], ids=["Escape", "Space"])
def test_a_key_that_went_up_while_the_window_had_no_focus_is_stop_again(
    hands: Hands, keys: tuple[int, int]
) -> None:
    window = hands.stage.window
    window.dispatch("on_key_down", *keys, None, [])
    window._focus = False
    window._focus = True
    press(hands, keys)
    assert hands.stops == 2


def test_while_somebody_types_escape_is_stop_and_space_is_a_space(hands: Hands) -> None:
    dialog = hands.cover()
    field = dialog.ids.field
    field.focus = True
    press(hands, ESCAPE)
    assert (hands.stops, field.focus, dialog.parent) == (1, True, hands.root)
    press(hands, SPACE)
    assert hands.stops == 1
    dialog.close()


def test_androids_back_is_no_stop(hands: Hands) -> None:
    press(hands, BACK)
    assert (hands.stops, hands.back_pressed) == (0, 3)


def test_where_there_is_no_robot_escape_is_back(hands: Hands) -> None:
    hands.session = hands.shell = None  # type: ignore[assignment]
    press(hands, ESCAPE)
    assert (hands.stops, hands.back_pressed) == (0, 3)


@pytest.mark.parametrize("keys", [ESCAPE, SPACE], ids=["Escape", "Space"])
def test_where_several_robots_are_known_and_none_is_connected_a_key_stops_them_all(
    hands: Hands, keys: tuple[int, int]
) -> None:
    hands.session = hands.shell = None  # type: ignore[assignment]
    hands.corner.robots = 2
    press(hands, keys)
    assert (hands.corner.presses, hands.back_pressed) == (1, 0)


def test_the_gamepads_button_is_stop_on_every_screen(hands: Hands) -> None:
    hands.source.there = {1: PAD}
    hands.shell.screen = "mission"
    hands.pass_time(0.1)
    hands.stage.window.dispatch("on_joy_button_down", 1, 1)
    assert hands.stops == 1


def test_a_stick_that_a_freeze_took_from_the_robot_is_not_shown_as_pushed_afterwards(hands: Hands) -> None:
    touch = hands.push()
    hands.pass_time(0.2)
    hands.frozen = True
    hands.pass_time(1.5)
    hands.frozen = False
    hands.pass_time(0.2)
    assert not hands.stick.forward
    assert hands.stick.finger is None
    touch.touch_up()

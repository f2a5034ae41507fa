"""Keys that drive while they are held are lost as everything else is; and who of gamepad, keys and STOP comes first."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from tests.app.inputs.pushing import ESCAPE, LOSSES, PAD, Hands, hands, press, upright

__all__ = ["hands", "upright"]


def test_a_gamepad_that_is_pushed_slowly_out_of_its_dead_zone_drives(hands: Hands) -> None:
    hands.source.there = {1: PAD}
    hands.pass_time(0.1)
    for step in range(50):
        hands.source.there = {1: replace(PAD, forward=step / 50)}
        hands.pass_time(0.04)
    assert hands.moving


W, A, UP = (119, 26), (97, 4), (273, 82)


def hold(hands: Hands, keys: tuple[int, int], seconds: float = 0.0) -> None:
    """The key goes down and repeats, as under X11."""
    window = hands.stage.window
    window.dispatch("on_key_down", *keys, None, [])
    hands.pass_time(min(seconds, 0.66))
    while seconds > 0.66:
        window.dispatch("on_key_down", *keys, None, [])
        hands.pass_time(0.04)
        seconds -= 0.04


def drive_by_key(hands: Hands) -> None:
    hold(hands, W, 1.0)
    assert hands.moving
    assert hands.stick.gamepad == "keys"


def let_go(hands: Hands) -> object:
    return hands.stage.window.dispatch("on_key_up", *W)


KEYS: dict[str, Callable[[Hands], object]] = {
    "let go": let_go,
    **{
        name: lambda hands, happens=happens: happens(hands, None)
        for name, happens in LOSSES.items()
        if name in ("out of focus", "hidden", "minimised", "turned", "turned upside down", "dialog over it")
        or name in ("card over it", "another screen", "may not drive", "disabled", "frozen", "paused")
    },
}


@pytest.mark.usefixtures("upright")
@pytest.mark.parametrize("happens", KEYS.values(), ids=KEYS)
def test_a_key_that_is_lost_drives_no_longer(hands: Hands, happens: Callable[[Hands], object]) -> None:
    drive_by_key(hands)
    happens(hands)
    hands.rests_in_time(hands.stage.time.now)


def test_a_key_whose_end_is_never_told_ends_with_its_repeats(hands: Hands) -> None:
    drive_by_key(hands)
    hands.pass_time(1.0)
    assert not hands.moving


def test_stop_ends_what_keys_drive_and_they_must_be_let_go(hands: Hands) -> None:
    drive_by_key(hands)
    hands.stop.bind(on_command=lambda _: hands.stick.rest())
    press(hands, ESCAPE)
    hold(hands, W, 1.0)
    assert (hands.stops, hands.moving) == (1, False)
    hands.stage.window.dispatch("on_key_up", *W)
    drive_by_key(hands)


def test_keys_do_not_take_the_stick_from_a_gamepad_nor_it_from_them(hands: Hands) -> None:
    hands.lean()
    hold(hands, A, 0.5)
    assert hands.stick.gamepad == "drives"
    assert hands.stick.left == 0.0
    hands.source.there = {1: PAD}
    hands.pass_time(0.1)
    assert not hands.stick.left, "the key was pressed before, and must be let go"
    hands.stage.window.dispatch("on_key_up", *A)
    drive_by_key(hands)
    hands.source.there = {1: replace(PAD, forward=-1.0)}
    hands.pass_time(0.1)
    assert hands.stick.forward > 0
    hands.stage.window.dispatch("on_key_up", *W)
    hands.pass_time(0.3)
    assert not hands.moving, "the gamepad was pushed before, and must be let go"


def test_while_somebody_types_keys_do_not_drive(hands: Hands) -> None:
    from kivy.uix.textinput import TextInput

    field = TextInput(size_hint=(None, None), size=(100, 40), pos=(900, 600))
    hands.page.add_widget(field)
    field.focus = True
    hands.stage.window.dispatch("on_key_down", *W, "w", [])
    hands.pass_time(0.5)
    assert not hands.moving
    field.focus = False


def test_on_a_screen_with_nothing_to_drive_the_same_keys_are_left_to_others(hands: Hands) -> None:
    hands.shell.screen = "mission"
    assert not hands.stage.window.dispatch("on_key_down", *UP, None, [])


def test_the_origin_of_stop_is_the_key_or_the_button(hands: Hands) -> None:
    from app.core.command_origin import origins

    said: list[tuple[str, str]] = []
    hands.stop.bind(on_command=lambda _: said.append((origins.current().method, origins.current().intent)))
    press(hands, ESCAPE)
    hands.source.there = {1: PAD}
    hands.pass_time(0.1)
    hands.stage.window.dispatch("on_joy_button_down", 1, 1)
    assert said == [("keyboard", "stop"), ("gamepad", "stop")]


def test_where_nothing_can_be_stopped_a_study_hears_of_stop_all_the_same(hands: Hands) -> None:
    told: list[tuple[str, str, str]] = []
    hands.intents.practise = lambda heard: "" if hands.intents.possible("stop") else "STOP."
    hands.intents.on_taken.append(lambda heard, done: told.append((heard.intent, heard.method, done.what)))
    hands.shell = hands.session = None
    hands.source.there = {1: PAD}
    hands.pass_time(0.1)
    hands.stage.window.dispatch("on_joy_button_down", 1, 1)
    press(hands, ESCAPE)
    assert told == [("stop", "gamepad", "practised"), ("stop", "keyboard", "practised")]


def test_a_key_that_a_field_takes_is_the_origin_of_what_follows(hands: Hands) -> None:
    from app.core.command_origin import origins

    hands.shell.screen = "mission"
    hands.stage.window.dispatch("on_key_down", 13, 40, None, [])
    assert origins.current().method == "keyboard"
    origins.forget()


def test_stop_of_a_gamepad_that_is_switched_off_is_stop_all_the_same(hands: Hands) -> None:
    hands.inputs.mapped.pads_on = False
    hands.source.there = {1: PAD}
    hands.pass_time(0.1)
    hands.source.there = {1: replace(PAD, forward=1.0, buttons=frozenset({"b"}))}
    hands.pass_time(0.5)
    assert (hands.stops, hands.moving) == (1, False)


def test_what_a_hand_holds_on_a_gamepad_ends_when_it_is_pulled_out(hands: Hands) -> None:
    told: list[bool] = []
    hands.inputs.meanings.held["talk"].append(told.append)
    hands.source.there = {1: replace(PAD, buttons=frozenset({"lefttrigger"}))}
    hands.pass_time(0.1)
    hands.source.there.clear()
    hands.pass_time(0.1)
    assert told == [True, False]


def clutch(hands: Hands) -> list[bool]:
    told: list[bool] = []
    hands.inputs.meanings.held["tilt"].append(told.append)
    return told


def test_a_key_that_holds_the_clutch_is_lost_as_one_that_drives(hands: Hands) -> None:
    told = clutch(hands)
    hold(hands, (116, 23), 1.0)
    assert told == [True]
    hands.pass_time(0.5)
    assert told == [True, False], "its repeats stay away"


def test_a_gamepad_out_of_reach_holds_no_clutch_and_that_is_said(hands: Hands) -> None:
    told = clutch(hands)
    hands.source.there = {1: replace(PAD, buttons=frozenset({"righttrigger"}))}
    hands.pass_time(1.0)
    assert told == [True]
    hands.source.trembles = False
    hands.pass_time(0.2)
    assert told == [True, False]
    assert hands.shell.offers[-1][0].startswith("The gamepad is silent")


@pytest.mark.parametrize(
    "taken",
    [
        lambda hands: hands.source.there.clear(),
        lambda hands: setattr(hands, "devices", frozenset({1})),
    ],
    ids=["as SDL tells", "and SDL does not know yet"],
)
def test_a_gamepad_that_is_taken_away_holds_no_clutch(hands: Hands, taken: Callable[[Hands], object]) -> None:
    told = clutch(hands)
    hands.source.there = {1: replace(PAD, buttons=frozenset({"righttrigger"}))}
    hands.pass_time(1.0)
    taken(hands)
    hands.pass_time(0.3)
    assert told == [True, False]

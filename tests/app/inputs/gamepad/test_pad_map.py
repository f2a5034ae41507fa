"""What sticks, triggers and buttons of a gamepad mean, and what is wrong in a kept profile said in one sentence each."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.inputs.gamepad.pad_map import MEANT, Profile, axis, button_words, read
from app.inputs.gamepad.sdl import PadState

REST = PadState(1, "Pad", 0.0, 0.0, stop=False, stop_button=1, raw=(0,))


def left(profile: Profile, **state: object) -> tuple[float, float]:
    return profile.lean(replace(REST, **state))["left"]  # type: ignore[arg-type]


def test_a_stick_commands_nothing_in_its_dead_zone_and_all_at_its_rim() -> None:
    profile = Profile(dead_zone=0.2)
    assert left(profile, forward=0.2) == (0.0, 0.0)
    assert left(profile, forward=0.14, left=0.14) == (0.0, 0.0), "it is round"
    assert left(profile, forward=1.0) == (1.0, 0.0)
    assert left(profile, forward=0.21)[0] < 0.02, "it begins at nothing"


def test_a_diagonal_push_goes_no_farther_than_the_rim_and_keeps_its_direction() -> None:
    ahead, aside = left(Profile(), forward=0.9, left=0.9)
    assert ahead == aside == pytest.approx(0.7071, abs=1e-3)


def test_expo_makes_it_finer_in_the_middle_and_the_same_at_the_end() -> None:
    straight, fine = Profile(dead_zone=0.02, expo=0.0), Profile(dead_zone=0.02, expo=1.0)
    assert left(straight, forward=0.51)[0] == pytest.approx(0.5, abs=1e-3)
    assert left(fine, forward=0.51)[0] == pytest.approx(0.125, abs=1e-3)
    assert left(fine, forward=1.0)[0] == left(straight, forward=1.0)[0] == 1.0


@pytest.mark.parametrize("expo", [0.0, 0.3, 1.0])
def test_more_of_a_push_is_never_less_and_back_is_as_much_as_ahead(expo: float) -> None:
    profile = Profile(expo=expo)
    pushes = [left(profile, forward=step / 50)[0] for step in range(51)]
    assert pushes == sorted(pushes)
    assert [-left(profile, forward=-step / 50)[0] for step in range(51)] == pytest.approx(pushes)


def test_what_is_not_a_number_pushes_nothing() -> None:
    assert left(Profile(), forward=float("nan")) == (0.0, 0.0)


def test_a_way_can_be_turned_round_and_turned_back() -> None:
    turned = Profile().turned("left_ahead")
    assert left(turned, forward=1.0) == (-1.0, 0.0)
    assert left(turned.turned("left_ahead"), forward=1.0) == (1.0, 0.0)


def test_triggers_can_drive_as_the_pedals_of_a_car_and_then_mean_nothing_else() -> None:
    car = Profile().with_axis("left_ahead", "triggers")
    assert left(car, triggers=(0.0, 1.0)) == (1.0, 0.0)
    assert left(car, triggers=(1.0, 0.0)) == (-1.0, 0.0)
    assert left(car, triggers=(0.0, 1.0), left=0.1) == (1.0, 0.0), "each has a dead zone of its own"
    assert Profile().meaning("lefttrigger") == "hold.talk"
    assert car.meaning("lefttrigger") == ""


def test_the_sticks_can_be_swapped_and_the_cross_can_drive() -> None:
    swapped = Profile().with_axis("left_ahead", "right_y").with_axis("left_aside", "right_x")
    assert left(swapped, right=(0.0, 1.0)) == (0.0, 1.0)
    crossed = Profile().with_axis("left_ahead", "dpad_y")
    assert left(crossed, buttons=frozenset({"dpdown"})) == (-1.0, 0.0)
    assert crossed.driving == {"dpup", "dpdown"}


def test_the_last_stop_is_never_taken_away() -> None:
    with pytest.raises(ValueError, match="B, right is the only STOP"):
        Profile().with_button("b", "lights")
    moved = Profile().with_button("guide", "stop").with_button("b", "lights")
    assert moved.stops == ["guide"]
    only = Profile().with_button("dpup", "stop").with_button("b", "")
    with pytest.raises(ValueError, match="would take the only STOP"):
        only.with_axis("left_ahead", "dpad_y")


def test_what_was_kept_comes_back_as_it_was() -> None:
    profile = replace(
        Profile(dead_zone=0.2, expo=0.5), axes=Profile().with_axis("left_ahead", "triggers").axes
    )
    profile = profile.turned("right_aside").with_button("guide", "help")
    assert read(profile.kept(), dict.fromkeys([*MEANT.values(), "help"])) == (profile, [])


def test_nothing_kept_is_no_mistake() -> None:
    assert read(None) == (Profile(), [])


@pytest.mark.parametrize(
    ("kept", "said"),
    [
        ([1], "The gamepad's profile is not a table but [1]."),
        ({"dead_zone": 0.9}, "The gamepad's dead_zone is from 0.02 to 0.5, not 0.9: 0.12 is used."),
        ({"dead_zone": float("nan")}, "The gamepad's dead_zone is from 0.02 to 0.5, not nan: 0.12 is used."),
        ({"expo": True}, "The gamepad's expo is from 0.0 to 1.0, not True: 0.3 is used."),
        ({"axes": {"left_ahead": "wheel"}}, "The gamepad's axes know no 'left_ahead': 'wheel'."),
        ({"axes": {"up": "left_x"}}, "The gamepad's axes know no 'up': 'left_x'."),
        ({"axes": 3}, "The gamepad's axes are not a table but 3."),
        ({"inverted": ["up"]}, "The gamepad's inverted are some of left_ahead, left_aside, right_ahead, right_aside, not 'up'."),
        ({"buttons": {"b": "stop", "a": "jump"}}, "The gamepad's buttons know no 'a': 'jump'."),
    ],
)  # fmt: skip
def test_what_cannot_be_is_as_at_first_and_said(kept: object, said: str) -> None:
    profile, wrong = read(kept, dict.fromkeys(MEANT.values()))
    assert wrong == [said]
    assert profile.lean(REST) == Profile().lean(REST)
    assert profile.stops == ["b"]


def test_a_kept_profile_without_stop_has_one_again() -> None:
    profile, wrong = read({"buttons": {"a": "lights"}})
    assert wrong == ["The gamepad's profile has no STOP: B is STOP."]
    assert profile.stops == ["b"]


def test_a_button_that_nobody_knows_has_a_number_and_an_axis_that_there_is_not_is_at_rest() -> None:
    assert (button_words("a"), button_words("button 7")) == ("A, below", "Button 7")
    assert axis(REST, "wheel") == 0.0

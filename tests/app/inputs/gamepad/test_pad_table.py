"""Where things are on a gamepad by SDL's table: triggers of every make, a cross that is a hat, and gamepads that nobody knows."""

from __future__ import annotations

import pytest

from app.inputs.gamepad.pad_table import PadTable

XBOX = "a:b0,b:b1,x:b2,y:b3,leftx:a0,lefty:a1,rightx:a3,righty:a4,lefttrigger:a2,righttrigger:a5,dpup:h0.1,dpleft:h0.8,"
LOW, FULL = -32768, 32767


def test_a_trigger_goes_from_one_end_of_its_axis_to_the_other() -> None:
    table = PadTable(XBOX)
    axes = [0, 0, LOW, 0, 0, LOW]
    assert table.triggers(axes, []) == (0.0, 0.0)
    axes[2], axes[5] = FULL, -1
    assert list(table.triggers(axes, [])) == pytest.approx([1.0, 0.5], abs=1e-4)


def test_a_trigger_that_has_told_nothing_yet_is_not_half_pressed() -> None:
    table = PadTable(XBOX)
    axes = [0] * 6
    assert table.triggers(axes, []) == (0.0, 0.0)
    axes[2] = 16384
    assert table.triggers(axes, [])[0] == 0.75
    axes[2] = 0
    assert table.triggers(axes, [])[0] == 0.5, "it has moved: half is half"


@pytest.mark.parametrize(
    ("entry", "raw", "share"),
    [("+a2", 16384, 0.5), ("+a2", -16384, 0.0), ("-a2", -16384, 0.5), ("a2~", LOW, 1.0)],
)
def test_a_trigger_on_half_an_axis_or_turned_round(entry: str, raw: int, share: float) -> None:
    table = PadTable(f"a:b0,lefttrigger:{entry},")
    table.triggers([0, 0, 1], [])
    assert table.triggers([0, 0, raw], [])[0] == share


def test_a_trigger_may_be_a_button() -> None:
    table = PadTable("b:b1,righttrigger:b3,")
    assert table.triggers([0, 0], [0, 0, 0, 1]) == (0.0, 1.0)
    assert table.down([0, 0], [0, 0, 0, 1], []) == {"righttrigger"}


def test_a_trigger_is_pressed_beyond_one_mark_and_let_go_below_another() -> None:
    table = PadTable(XBOX)

    def down(share: float) -> bool:
        return "lefttrigger" in table.down([0, 0, round(LOW + share * 65535), 0, 0, LOW], [], [])

    assert [down(share) for share in (0.0, 0.5, 0.7, 0.5, 0.3, 0.5)] == [
        False,
        False,
        True,
        True,
        False,
        False,
    ]


def test_the_cross_may_be_a_hat() -> None:
    table = PadTable(XBOX)
    assert table.down([0, 0, LOW, 0, 0, LOW], [1, 0], [9]) == {"a", "dpup", "dpleft"}


def test_a_gamepad_that_sdl_does_not_know_has_four_buttons_with_letters_and_others_with_numbers() -> None:
    table = PadTable("")
    assert table.east == 1
    assert table.down([0, 0], [0, 1, 0, 0, 0, 1], []) == {"b", "button 5"}
    assert table.share("leftx", [LOW, 0]) == -1.0
    assert table.share("rightx", [LOW, 0]) == 0.0, "it has none"


def test_an_axis_that_the_table_turns_round() -> None:
    assert PadTable("lefty:a1~,").share("lefty", [0, LOW]) == 1.0

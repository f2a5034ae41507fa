"""The picture of a gamepad: what is pushed and pressed is lit, and without one it says so."""

from __future__ import annotations

from tests.headless import Stage
from widgets.inputs.pad_picture import PadPicture


def picture(stage: Stage) -> PadPicture:
    made = PadPicture(size_hint=(None, None), size=(360, 210))
    stage.show(made, (360, 210))
    return made


def words(made: PadPicture) -> list[str]:
    return made._words.texts


def test_without_a_gamepad_it_says_so(stage: Stage) -> None:
    made = picture(stage)
    assert (made.state, "No gamepad is plugged in." in words(made)) == ("never", True)


def test_with_one_it_is_live_and_says_only_the_letters(stage: Stage) -> None:
    made = picture(stage)
    made.update(left=(1.0, 0.0), down={"a"})
    stage.frames(2)
    assert (made.state, sorted(words(made))) == ("live", ["A", "B", "X", "Y"])


def test_buttons_that_have_no_place_are_named_by_their_numbers(stage: Stage) -> None:
    made = picture(stage)
    made.update(down={"button 7", "button 9"})
    stage.frames(2)
    assert "Button 7, 9" in words(made)


def test_pulled_out_nothing_is_pushed_any_more(stage: Stage) -> None:
    made = picture(stage)
    made.update(left=(1.0, 0.0), triggers=(1.0, 0.0), down={"a"})
    made.clear()
    assert (made.state, made.left_stick, made.triggers, made.down) == ("never", [0.0, 0.0], [0.0, 0.0], [])

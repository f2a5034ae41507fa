"""Presses of keys and buttons: told once each, STOP before everybody, and whoever took one hears of its end."""

from __future__ import annotations

from app.inputs.base.button_presses import Press, Presses

ESCAPE = 27


def key(code: int) -> Press:
    return Press("key", code, f"key {code}", at=0.0)


class Taker:
    def __init__(self, *codes: int) -> None:
        self.codes = codes
        self.heard: list[tuple[str, int]] = []

    def pressed(self, press: Press) -> bool:
        if press.code in self.codes:
            self.heard.append(("down", press.code))
        return press.code in self.codes

    def released(self, press: Press) -> None:
        self.heard.append(("up", press.code))


class Desk:
    def __init__(self, *takers: Taker) -> None:
        self.stops = 0
        self.presses = Presses(lambda press: press.code == ESCAPE, self._stop)
        self.presses.takers.extend(takers)

    def _stop(self, _: Press) -> None:
        self.stops += 1


def test_a_held_key_is_one_press_however_often_the_system_repeats_it() -> None:
    taker = Taker(9)
    presses = Desk(taker).presses
    assert [presses.press(key(9)) for _ in range(5)] == [True] * 5
    presses.release("key", 0, "key 9")
    presses.press(key(9))
    assert taker.heard == [("down", 9), ("up", 9), ("down", 9)]


def test_stop_comes_before_whoever_wants_the_same_key() -> None:
    taker = Taker(ESCAPE)
    desk = Desk(taker)
    assert desk.presses.press(key(ESCAPE))
    desk.presses.press(key(ESCAPE))
    desk.presses.release("key", 0, "key 27")
    assert (desk.stops, taker.heard) == (1, [])


def test_whoever_stands_first_takes_it_and_alone_hears_of_its_end() -> None:
    first, second = Taker(9), Taker(9, 13)
    presses = Desk(first, second).presses
    presses.press(key(9))
    presses.press(key(13))
    presses.release("key", 0, "key 9")
    assert first.heard == [("down", 9), ("up", 9)]
    assert second.heard == [("down", 13)]


def test_what_nobody_takes_means_nothing_and_neither_do_its_repeats() -> None:
    taker = Taker()
    presses = Desk(taker).presses
    assert not presses.press(key(9))
    taker.codes = (9,)
    assert not presses.press(key(9)), "it was down before anybody wanted it"


def test_what_will_not_be_told_to_end_ends_when_the_window_loses_its_focus() -> None:
    taker = Taker(9, 13)
    presses = Desk(taker).presses
    presses.press(key(9))
    presses.press(Press("pad", 13, "a", at=0.0, number=4))
    presses.forget("pad", 4)
    assert taker.heard[2:] == [("up", 13)]
    presses.forget()
    assert taker.heard[3:] == [("up", 9)]
    assert presses.down == []


def test_a_release_of_what_was_not_down_is_nothing() -> None:
    taker = Taker(9)
    Desk(taker).presses.release("key", 0, "key 9")
    assert taker.heard == []


def test_what_is_down_on_a_gamepad_is_pressed_once_and_released_when_it_is_missing() -> None:
    taker = Taker(-1)
    presses = Desk(taker).presses
    for down in ({"a"}, {"a", "dpup"}, {"dpup"}, set()):
        presses.buttons(4, "Pad", down, 0.0)
    assert [what for what, _ in taker.heard] == ["down", "down", "up", "up"]


def test_a_press_that_kivy_told_of_is_not_told_again_by_a_look() -> None:
    taker = Taker(0, -1)
    presses = Desk(taker).presses
    presses.press(Press("pad", 0, "a", at=0.0, device="Pad", number=4))
    presses.buttons(4, "Pad", {"a"}, 0.0)
    assert taker.heard == [("down", 0)]

"""Contacts become presses: none of those that bounce, tremble, repeat or stick, and STOP whatever else goes on."""

from __future__ import annotations

import pytest

from app.inputs.switch_access.scan.presses import Contacts, Event, Timing


class Box:
    """A switch box at a clock of its own."""

    def __init__(self, timing: Timing | None = None) -> None:
        self.heard: list[tuple[str, str, float]] = []
        self.contacts = Contacts(timing or Timing(), self._hear)
        self.now = 0.0

    def _hear(self, event: Event) -> None:
        self.heard.append((event.what, event.switch, round(event.at, 3)))

    @property
    def told(self) -> list[str]:
        return [f"{what} {switch}" for what, switch, _ in self.heard]

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.01)):
            self.now += 0.01
            self.contacts.update(self.now)

    def down(self, switch: str, source: object = "key") -> None:
        self.contacts.down("A" if switch == "A" else "B", source, self.now)

    def up(self, switch: str, source: object = "key") -> None:
        self.contacts.up("A" if switch == "A" else "B", source, self.now)

    def press(self, switch: str, seconds: float = 0.2) -> None:
        self.down(switch)
        self.wait(seconds)
        self.up(switch)
        self.wait(0.2)


def test_a_press_is_told_as_it_begins_and_its_end_once_it_cannot_be_a_bounce() -> None:
    box = Box()
    box.down("A")
    assert box.heard == [("down", "A", 0.0)]
    box.wait(0.2)
    box.up("A")
    assert box.told == ["down A"]
    box.wait(0.1)
    assert box.heard == [("down", "A", 0.0), ("up", "A", 0.2)]


def test_a_contact_that_bounces_at_both_ends_is_one_press() -> None:
    box = Box()
    for _ in range(4):
        box.down("B")
        box.wait(0.02)
        box.up("B")
        box.wait(0.02)
    box.down("B")
    box.wait(0.3)
    for _ in range(4):
        box.up("B")
        box.wait(0.03)
        box.down("B")
        box.wait(0.01)
    box.up("B")
    box.wait(0.2)
    assert box.told == ["down B", "up B"]


def test_a_key_that_the_system_repeats_while_it_is_held_is_one_press() -> None:
    box = Box()
    for _ in range(10):
        box.down("A")
        box.wait(0.04)
    box.up("A")
    box.wait(0.1)
    assert box.told == ["down A", "up A"]


def test_a_trembling_hand_presses_once_in_what_is_ignored() -> None:
    box = Box()
    box.press("A", 0.05)  # its second beginning comes 0.25 s after the first
    box.press("A", 0.05)
    assert box.told == ["down A", "up A"]
    box.press("A", 0.05)
    assert box.told == ["down A", "up A"] * 2


def test_what_brushes_over_a_switch_is_no_press() -> None:
    box = Box(Timing(acceptance=0.5))
    box.press("A", 0.4)
    assert box.told == []
    box.press("A", 0.6)
    assert box.heard == [("down", "A", 0.6), ("up", "A", 1.2)]


def test_a_held_goes_back_again_and_again() -> None:
    box = Box()
    box.press("A", 1.3)
    assert box.heard == [("down", "A", 0.0), ("held", "A", 0.6), ("held", "A", 1.2), ("up", "A", 1.3)]


@pytest.mark.parametrize("acceptance", [0.0, 0.4, 1.0])
def test_b_held_is_stop_and_nothing_more_comes_of_that_press(acceptance: float) -> None:
    box = Box(Timing(acceptance=acceptance))
    box.press("B", 2.0)
    stops = [at for what, _, at in box.heard if what == "stop"]
    assert stops == [pytest.approx(max(0.8, acceptance + 0.3), abs=0.02)]
    assert "up B" not in box.told


@pytest.mark.parametrize(("first", "second"), [("A", "B"), ("B", "A")])
def test_both_together_are_stop_at_once_though_one_of_them_would_not_count_as_a_press(
    first: str, second: str
) -> None:
    box = Box()
    box.press(second, 0.05)
    box.down(first)
    box.wait(0.02)
    box.down(second)
    assert box.told[-1] == f"stop {second}"
    told = len(box.told)
    box.wait(1.5)
    box.up(first)
    box.up(second)
    box.wait(0.2)
    assert len(box.told) == told


def test_b_of_a_trembling_hand_is_still_stop_when_it_is_held() -> None:
    box = Box()
    box.press("B", 0.05)
    box.press("B", 1.0)
    assert box.told == ["down B", "up B", "stop B"]


def test_one_after_the_other_is_no_stop() -> None:
    box = Box()
    box.down("A")
    box.wait(0.2)
    box.up("A")
    box.down("B")  # while A may still be bouncing
    box.wait(0.2)
    box.up("B")
    box.wait(0.2)
    assert "stop B" not in box.told


def test_a_contact_that_opens_for_a_moment_while_the_other_closes_is_both_together_all_the_same() -> None:
    for bounces, other in (("A", "B"), ("B", "A")):
        box = Box()
        box.down(bounces)
        box.wait(0.03)
        box.up(bounces)
        box.wait(0.02)
        box.down(other)
        box.wait(0.02)
        box.down(bounces)
        assert box.told[-1] == f"stop {bounces}"
        assert "up B" not in box.told
        told = len(box.told)
        box.up(bounces)
        box.down(bounces)
        box.wait(0.3)
        assert len(box.told) == told, "once for both"


def test_a_waits_for_the_end_of_a_press_of_b_that_may_still_bounce() -> None:
    box = Box()
    box.down("B")
    box.wait(0.1)
    box.up("B")
    box.wait(0.02)
    box.press("A", 0.03)
    told = [("down", "B", 0.0), ("up", "B", 0.1), ("down", "A", 0.12), ("up", "A", 0.15)]
    assert box.heard == told


def test_and_is_told_after_it_though_one_frame_was_drawn_meanwhile() -> None:
    box = Box()
    box.wait(0.1)
    box.press("B")
    box.down("B")
    box.wait(0.12)
    box.up("B")
    box.down("A")
    box.up("A")
    box.now += 0.2
    box.contacts.update(box.now)
    assert box.told[2:] == ["down B", "up B", "down A", "up A"]


def test_a_switch_that_sticks_is_told_and_ignored_until_it_comes_up() -> None:
    box = Box()
    box.down("A")
    box.wait(5.2)
    assert box.told[-1] == "stuck A"
    assert not box.contacts.is_closed("A")
    told = len(box.told)
    box.wait(3.0)
    assert len(box.told) == told
    box.press("B")  # with A stuck, B alone is no STOP
    assert box.told[told:] == ["down B", "up B"]
    box.up("A")
    box.wait(0.2)
    assert box.told[-1] == "free A"
    box.press("A")
    assert box.told[-2:] == ["down A", "up A"]


def test_a_switch_is_down_while_one_of_its_keys_is() -> None:
    box = Box()
    box.down("B", "enter")
    box.wait(0.1)
    box.down("B", "pad")
    box.up("B", "enter")
    box.wait(0.2)
    assert box.told == ["down B"]
    box.up("B", "pad")
    box.wait(0.2)
    assert box.told == ["down B", "up B"]


def test_a_press_that_ended_while_a_slow_frame_was_drawn_is_no_stop_and_nothing_at_all() -> None:
    box = Box()
    box.wait(0.1)
    box.down("B")
    box.wait(0.1)
    box.now += 1.2  # one frame
    box.contacts.update(box.now)  # its release waits in the queue behind the heartbeat
    assert box.told == ["down B"]
    box.up("B")
    box.wait(0.2)
    assert box.told == ["down B", "unsure B"]


def test_one_that_is_still_down_after_a_slow_frame_is_stop_with_the_next() -> None:
    box = Box()
    box.wait(0.1)
    box.down("B")
    box.now += 1.2
    box.contacts.update(box.now)
    assert box.told == ["down B"]
    box.wait(0.01)
    assert box.told == ["down B", "stop B"]


def test_where_every_frame_is_slow_b_is_stop_one_frame_later() -> None:
    box = Box()
    box.down("B")
    while "stop B" not in box.told:
        box.now += 0.3
        box.contacts.update(box.now)
    assert box.now == pytest.approx(1.2)


def test_nothing_comes_of_what_was_down_when_the_window_lost_its_focus() -> None:
    box = Box()
    box.down("B")
    box.wait(0.3)
    box.contacts.lost()
    box.wait(2.0)
    assert box.told == ["down B"]
    box.contacts.found(box.now)
    box.wait(1.2)
    box.press("B")
    assert box.told == ["down B", "down B", "up B"]


@pytest.mark.parametrize("told_up_before", [False, True])
def test_what_was_held_while_the_focus_was_away_is_no_new_press_when_the_system_repeats_it(
    *, told_up_before: bool
) -> None:
    box = Box()
    box.down("B")
    box.wait(0.3)
    if told_up_before:
        box.up("B")
    box.contacts.lost()
    box.wait(2.0)
    box.contacts.found(box.now)
    box.wait(0.04)
    box.down("B")
    box.wait(0.2)
    assert box.told == ["down B"]
    box.wait(0.8)
    assert box.told == ["down B", "stop B"], "to hold it on is STOP all the same"
    box.up("B")
    box.wait(0.5)
    box.press("B")
    assert box.told[2:] == ["down B", "up B"]

"""Events: none missed, none twice, in order; and what others have seen to."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

from app.link.event_order import FIRST_LIMIT, PART_LIMIT, EventStream, KnownEvents, Missed
from bridge.msgs.pilothouse_msgs import Event, GetEventsRequest, GetEventsResponse


def event(number: int, boot: str = "a", **words: str) -> Event:
    return Event(id=number, boot=boot, text=f"{boot}{number}", **words)


class Robot:
    """Answers as the robot side does, out of what it keeps."""

    def __init__(self, count: int, boot: str = "a", oldest: int = 1) -> None:
        self.boot = boot
        self.kept = {number: event(number, boot) for number in range(oldest, count + 1)}
        self.asked = 0

    def answer(self, asked: GetEventsRequest) -> GetEventsResponse:
        self.asked += 1
        known = asked.since if asked.boot == self.boot else 0
        found = [self.kept[id] for id in sorted(self.kept) if id > known]
        told = found[: asked.most] if asked.boot else found[-asked.most :]
        open = asked.open if asked.boot == self.boot else ()
        seen = [self.kept[id] for id in open if id <= known and self.kept[id].acknowledged_by]
        last = told[-1].id if told else 0
        return GetEventsResponse([*seen, *told], bool(told) and max(self.kept) > last, min(self.kept))

    def see_to(self, number: int, by: str) -> Event:
        old = self.kept[number]
        self.kept[number] = event(number, self.boot, level=old.level, acknowledged_by=by)
        return self.kept[number]


class Listener:
    """An event stream, and what it told."""

    def __init__(self, known: KnownEvents | None = None, marks: dict[str, int] | None = None) -> None:
        self.told: list[Event] = []
        self.missed: list[Missed] = []
        self.stream = EventStream(self.told.append, self.missed.append, known=known, marks=marks)

    def connect(self, robot: Robot, live: Iterable[Event] = ()) -> None:
        """Ask for as long as there is something to ask for; `live` comes before the first answer."""
        self.stream.start()
        for one in live:
            self.stream.live(one)
        self.ask(robot)

    def ask(self, robot: Robot) -> None:
        for _ in range(100):
            if not self.stream.behind:
                return
            self.stream.answered(robot.answer(self.stream.request()))
        pytest.fail("it never ends")

    @property
    def texts(self) -> list[str]:
        return [one.text for one in self.told]


def numbers(first: int, last: int, boot: str = "a") -> list[str]:
    return [f"{boot}{number}" for number in range(first, last + 1)]


def test_an_app_that_was_away_for_600_events_gets_all_of_them_in_several_rounds_and_once() -> None:
    listener, robot = Listener(), Robot(10)
    listener.connect(robot)
    robot.kept |= Robot(610).kept
    robot.asked = 0
    listener.connect(robot, live=[event(610)])
    assert listener.texts == numbers(1, 610)
    assert robot.asked == 600 // PART_LIMIT + 1
    assert listener.missed == [Missed("a", 10, 610, live=frozenset({610}))]


def test_an_app_that_was_killed_and_started_again_gets_what_it_missed_however_much() -> None:
    robot = Robot(3000)
    listener = Listener(marks={"z": 7, "a": 1200})
    listener.connect(robot)
    assert listener.texts == numbers(1201, 3000)
    assert listener.missed == [Missed("a", 1200, 3000)]


def test_an_app_that_missed_little_is_told_what_was_before_that_as_well() -> None:
    listener = Listener(marks={"a": 998})
    listener.connect(Robot(1000))
    assert listener.texts == numbers(1001 - FIRST_LIMIT, 1000)
    assert listener.missed == [Missed("a", 998, 1000)]


def test_who_is_new_to_a_robot_is_told_the_newest_and_has_missed_nothing() -> None:
    listener = Listener(marks={"z": 4})
    listener.connect(Robot(900))
    assert (listener.texts, listener.missed) == (numbers(401, 900), [])


def test_of_what_the_robot_keeps_no_longer_it_is_said_that_it_is_gone() -> None:
    listener = Listener(KnownEvents("a", 10))
    listener.connect(Robot(700, oldest=300))
    assert listener.texts == numbers(300, 700)
    assert listener.missed == [Missed("a", 10, 700, gone=True)]


def test_numbers_that_a_crash_of_the_robot_left_out_are_nothing_that_is_gone() -> None:
    robot = Robot(10)
    listener = Listener(KnownEvents("a", 10))
    robot.kept |= Robot(1012, oldest=1011).kept
    listener.connect(robot)
    assert (listener.texts, listener.missed) == (numbers(1011, 1012), [Missed("a", 10, 1012)])


def test_a_log_that_was_started_fresh_was_missed_from_its_first_event_on() -> None:
    listener = Listener()
    listener.connect(Robot(9))
    listener.connect(Robot(600, "b"))
    listener.stream.live(event(601, "b"))
    assert listener.texts == [*numbers(1, 9), *numbers(1, 601, "b")]
    assert listener.missed == [Missed("b", 0, 600)]


def test_what_was_missed_comes_before_what_came_live_meanwhile() -> None:
    listener = Listener()
    listener.stream.start()
    listener.stream.live(event(3))
    assert listener.texts == []
    listener.ask(Robot(3))
    assert listener.texts == numbers(1, 3)


def test_without_an_answer_live_events_go_on_and_what_lies_before_them_is_still_fetched() -> None:
    listener, robot = Listener(), Robot(4)
    listener.connect(robot)
    robot.kept |= Robot(8).kept
    listener.stream.start()
    listener.stream.live(event(8))
    listener.stream.no_answer()
    assert listener.texts == ["a1", "a2", "a3", "a4", "a8"]
    assert listener.stream.behind
    listener.ask(robot)
    assert listener.texts == ["a1", "a2", "a3", "a4", "a8", "a5", "a6", "a7"]
    assert listener.missed == [Missed("a", 4, 8, live=frozenset({8}))]


def test_a_link_that_is_cut_in_the_middle_of_the_rounds_leaves_nothing_out() -> None:
    listener, robot = Listener(KnownEvents("a", 10)), Robot(900)
    listener.stream.start()
    listener.stream.answered(robot.answer(listener.stream.request()))
    listener.connect(robot)
    assert listener.texts == numbers(11, 900)
    assert listener.missed == [Missed("a", 10, 900)]


def test_the_first_answer_may_fail_as_well() -> None:
    listener = Listener()
    listener.stream.start()
    listener.stream.live(event(5))
    listener.stream.no_answer()
    listener.ask(Robot(5))
    assert sorted(listener.texts) == numbers(1, 5)


def test_a_live_event_that_got_lost_on_its_way_is_asked_for() -> None:
    listener, robot = Listener(), Robot(2)
    listener.connect(robot)
    robot.kept |= Robot(5).kept
    listener.stream.live(event(5))
    assert listener.stream.behind
    listener.ask(robot)
    assert listener.texts == ["a1", "a2", "a5", "a3", "a4"]
    assert listener.missed == []


def test_a_live_event_that_overtook_the_last_answer_is_not_asked_for_again() -> None:
    listener = Listener()
    listener.connect(Robot(2))
    listener.stream.live(event(5))
    listener.ask(Robot(4))
    listener.stream.live(event(6))
    assert not listener.stream.behind
    assert listener.texts == ["a1", "a2", "a5", "a3", "a4", "a6"]


def test_of_a_log_that_counts_lower_than_is_remembered_nothing_was_missed_and_it_goes_on_from_there() -> None:
    listener = Listener(marks={"a": 50})
    listener.connect(Robot(9))
    listener.stream.live(event(10))
    assert not listener.stream.behind
    assert (listener.texts, listener.missed) == (numbers(1, 10), [])


def test_that_somebody_has_seen_to_an_event_is_told_once_more() -> None:
    listener, robot = Listener(), Robot(3)
    listener.connect(robot)
    listener.stream.live(robot.see_to(2, "Anna"))
    assert (listener.told[-1].id, listener.told[-1].acknowledged_by) == (2, "Anna")


def test_what_somebody_saw_to_while_the_link_was_down_is_asked_for_by_its_number() -> None:
    robot = Robot(3)
    robot.kept[2] = event(2, level="alarm")
    listener = Listener()
    listener.connect(robot)
    robot.see_to(2, "Anna")
    listener.connect(robot)
    assert (listener.told[-1].id, listener.told[-1].acknowledged_by) == (2, "Anna")
    assert list(listener.stream.request().open) == []
    assert listener.missed == []


def test_a_robot_without_an_event_store_loses_no_live_event() -> None:
    listener = Listener()
    listener.stream.start()
    listener.stream.live(event(1))
    listener.stream.without_store()
    listener.stream.live(event(4))
    assert listener.texts == ["a1", "a4"]
    assert not listener.stream.behind


def test_a_robot_that_says_forever_that_there_is_more_is_not_asked_forever() -> None:
    listener = Listener(KnownEvents("a", 3))
    listener.stream.start()
    listener.stream.answered(GetEventsResponse([event(3)], more=True))
    assert not listener.stream.behind

"""The people of a robot: who is listed, who is removed by whom, and how others are let in."""

from __future__ import annotations

import math
from typing import Any

import pytest

from app.link.channels import ANSWER, EVENT, Answer
from app.link.feeds import Post
from app.screens.trust.people_dialog import CONFIRM_TIMEOUT, PeopleDialog, seen_text
from bridge.msgs.pilothouse_msgs import (
    Event,
    GetPeopleResponse,
    InviteGuestResponse,
    InvitePersonResponse,
    Person,
    RemovePersonResponse,
)
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass


class Asked(list[tuple[str, Any]]):
    """What the robot was asked."""

    def __call__(self, service: str, request: Any, _: Any) -> None:
        self.append((service, request))


@pytest.fixture
def asked(driving: Glass, monkeypatch: pytest.MonkeyPatch) -> Asked:
    asked = Asked()
    monkeypatch.setattr(driving.app.session.link, "ask", asked)
    return asked


def opened(glass: Glass) -> PeopleDialog:
    glass.tap(glass.app.shell.bar.ids.trust)
    (dialog,) = (child for child in glass.app.root.children if isinstance(child, PeopleDialog))
    return dialog


def answer(glass: Glass, service: str, message: Any, problem: str = "") -> None:
    glass.app._deliver(ANSWER, Post(Answer(service, message, problem), 0.0, 1))
    glass.stage.frames(3)


def people(glass: Glass) -> list[Person]:
    return [
        Person(id=glass.app.session.own_id, name="tablet-A", role="manage", kind="handheld", connected=True),
        Person(id="b", name="tablet-B", role="drive", kind="handheld", last_seen=math.nan),
    ]


def rows(dialog: PeopleDialog) -> list[Any]:
    return list(reversed(dialog.ids.rows.children))


def test_the_lock_shows_who_has_a_key_and_marks_this_handheld(driving: Glass, asked: Asked) -> None:
    dialog = opened(driving)
    assert [service for service, _ in asked] == ["/people/list"]
    answer(driving, "/people/list", GetPeopleResponse(people=people(driving)))
    assert [row.title for row in rows(dialog)] == ["tablet-A · this handheld", "tablet-B"]
    assert [row.detail for row in rows(dialog)] == ["manages, here now", "drives, never here"]
    dialog.close()


def test_who_may_not_see_them_is_told_why_and_can_change_nothing(driving: Glass, asked: Asked) -> None:
    dialog = opened(driving)
    answer(driving, "/people/list", None, "/people/list needs the role manage; you have drive.")
    assert dialog.problem == "/people/list needs the role manage; you have drive."
    assert dialog.ids.invite.disabled
    assert dialog.ids.guest.disabled
    dialog.close()


def test_a_person_is_removed_by_a_second_tap_only(driving: Glass, asked: Asked) -> None:
    dialog = opened(driving)
    answer(driving, "/people/list", GetPeopleResponse(people=people(driving)))
    row = rows(dialog)[1]
    driving.tap(row.children[0])
    assert len(asked) == 1
    assert "Tap again" in row.detail
    driving.tap(row.children[0])
    assert asked[-1][0] == "/people/remove"
    assert asked[-1][1].id == "b"
    answer(driving, "/people/remove", RemovePersonResponse(name="tablet-B"))
    assert asked[-1][0] == "/people/list", "what is shown is what the robot says"
    dialog.close()


def test_a_second_tap_that_comes_late_or_on_another_person_only_asks(
    driving: Glass, asked: Asked, monkeypatch: pytest.MonkeyPatch
) -> None:
    dialog = opened(driving)
    answer(driving, "/people/list", GetPeopleResponse(people=people(driving)))
    first, second = rows(dialog)
    dialog.remove(first)
    dialog.remove(second)
    assert first.detail == "manages, here now"
    later = driving.app.session.now() + CONFIRM_TIMEOUT
    monkeypatch.setattr(driving.app.session, "now", lambda: later)
    dialog.remove(second)
    assert [service for service, _ in asked] == ["/people/list"]
    dialog.close()


def test_others_are_let_in_by_a_code(driving: Glass, asked: Asked) -> None:
    dialog = opened(driving)
    answer(driving, "/people/list", GetPeopleResponse(people=people(driving)))
    driving.tap(dialog.ids.invite)
    assert asked[-1][0] == "/people/invite"
    answer(driving, "/people/invite", InvitePersonResponse(code="493017"))
    assert dialog.code == "493 017"
    driving.tap(dialog.ids.guest)
    assert (asked[-1][0], asked[-1][1].duration) == ("/people/guest", 3600.0)
    answer(driving, "/people/guest", InviteGuestResponse(code="12493017"))
    assert dialog.code == "124 930 17"
    dialog.close()


def test_a_closed_list_hears_nothing_more(driving: Glass, asked: Asked) -> None:
    dialog = opened(driving)
    driving.tap(dialog.ids.close)
    answer(driving, "/people/list", GetPeopleResponse(people=people(driving)))
    assert not rows(dialog)


@pytest.mark.parametrize(
    ("person", "said"),
    [
        (Person(connected=True, last_seen=1.0), "here now"),
        (Person(last_seen=math.nan), "never here"),
        (Person(last_seen=990.0), "just now"),
        (Person(last_seen=1000.0 - 7 * 60), "7 min ago"),
        (Person(last_seen=1000.0 - 2 * 3600), "2 h ago"),
        (Person(last_seen=1000.0 - 3 * 86400), "3 d ago"),
    ],
)
def test_when_somebody_was_there_is_said_in_a_few_words(person: Person, said: str) -> None:
    assert seen_text(person, 1000.0) == said


def test_without_the_robots_clock_nothing_is_said_of_when() -> None:
    assert seen_text(Person(last_seen=1.0), math.nan) == ""


def test_a_question_that_was_not_answered_in_time_is_taken_back(driving: Glass, asked: Asked) -> None:
    dialog = opened(driving)
    answer(driving, "/people/list", GetPeopleResponse(people=people(driving)))
    row = rows(dialog)[1]
    dialog.remove(row)
    driving.stage.run_for(CONFIRM_TIMEOUT + 0.1)
    assert row.detail == "drives, never here"
    dialog.close()


def test_a_third_tap_asks_the_robot_nothing_more(driving: Glass, asked: Asked) -> None:
    dialog = opened(driving)
    answer(driving, "/people/list", GetPeopleResponse(people=people(driving)))
    row = rows(dialog)[1]
    for _ in range(3):
        driving.tap(row.children[0])
    assert [service for service, _ in asked].count("/people/remove") == 1
    assert row.detail == "Removing …"
    answer(driving, "/people/remove", None, "Nobody is called that.")
    assert asked[-1][0] == "/people/list", "what is shown is what the robot says"
    answer(driving, "/people/list", GetPeopleResponse(people=people(driving)))
    assert dialog.problem == "Nobody is called that."
    dialog.close()


def test_who_removes_itself_or_the_last_one_who_manages_is_told_what_that_means(
    driving: Glass, asked: Asked
) -> None:
    dialog = opened(driving)
    known = people(driving)
    answer(driving, "/people/list", GetPeopleResponse(people=known))
    first, second = rows(dialog)
    dialog.remove(first)
    assert "the last one who manages" in first.detail
    assert "`robotside pair`" in first.detail
    dialog.remove(second)
    assert second.detail.endswith("It cannot come in any more.")
    managing = Person(id="b", name="tablet-B", role="manage", kind="handheld", last_seen=math.nan)
    answer(driving, "/people/list", GetPeopleResponse(people=[known[0], managing]))
    first, _ = rows(dialog)
    dialog.remove(first)
    assert "this handheld itself" in first.detail
    dialog.close()


def test_a_code_that_was_used_or_has_run_out_is_shown_no_more(driving: Glass, asked: Asked) -> None:
    dialog = opened(driving)
    answer(driving, "/people/list", GetPeopleResponse(people=people(driving)))
    driving.until(lambda: math.isfinite(driving.app.session.link.robot_time()), "no robot clock")
    ends = driving.app.session.link.robot_time() + 20.0
    answer(driving, "/people/invite", InvitePersonResponse(code="493017", open_until=ends))
    driving.stage.run_for(5.0)
    assert dialog.code
    driving.stage.run_for(16.0)
    assert not dialog.code
    answer(driving, "/people/invite", InvitePersonResponse(code="493017", open_until=ends + 600.0))
    driving.app.session._publish(EVENT, Post(Event(code="person_paired"), 0.0, 1))
    driving.stage.frames(3)
    assert not dialog.code
    assert asked[-1][0] == "/people/list", "the new one is on the list"
    dialog.close()


def test_an_open_lock_says_what_it_means(
    driving: Glass, asked: Asked, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(type(driving.app.session), "protected", False)
    dialog = opened(driving)
    assert "not protected" in dialog.warning
    dialog.close()


def test_stop_acts_while_the_list_is_open(driving: Glass, asked: Asked, robot: FakeRobot) -> None:
    dialog = opened(driving)
    driving.tap(driving.app.shell.stop)
    driving.until(lambda: any(name == "/stop" for name, _ in robot.asked), "no STOP")
    assert dialog.parent is not None
    dialog.close()

"""Who has control, and how it goes from one to another."""

from __future__ import annotations

import pytest

from bridge.core.identity import Identity, Role, public_id
from bridge.core.link_state import CONTROL_TIMEOUT
from robotside.control.authority import (
    MAX_OBJECTIONS,
    MAX_REPEATED_OBJECTIONS,
    OBJECTION_MEMORY,
    OBJECTION_TIME,
    REQUEST_PAUSE,
    TAKEOVER_SILENCE,
    Authority,
)
from tests.fakes import FakeClient

NOW = 10.0


@pytest.fixture
def authority() -> Authority:
    return Authority()


@pytest.fixture
def anna(authority: Authority) -> FakeClient:
    return known(authority, "anna")


@pytest.fixture
def bert(authority: Authority) -> FakeClient:
    return known(authority, "bert")


def known(authority: Authority, name: str, now: float = NOW) -> FakeClient:
    client = FakeClient(name, now)
    authority.introduce(client, f"tablet-{name}", name.capitalize())
    return client


def driver(authority: Authority) -> str:
    return authority.driver.name if authority.driver else ""


def pass_time(authority: Authority, seconds: float, *clients: FakeClient, start: float = NOW) -> float:
    for client in clients:
        client.last_heard = start + seconds
    authority.update(start + seconds)
    return start + seconds


def test_who_asks_for_free_control_has_it_at_once(authority: Authority, anna: FakeClient) -> None:
    assert authority.request(anna, NOW) == ""
    assert (driver(authority), authority.asker) == ("Anna", None)


def test_control_goes_over_when_the_driver_does_not_object_for_ten_seconds(
    authority: Authority, anna: FakeClient, bert: FakeClient
) -> None:
    authority.acquire(anna, NOW)
    assert authority.request(bert, NOW) == ""
    pass_time(authority, OBJECTION_TIME - 0.1, anna, bert)
    assert driver(authority) == "Anna"
    assert authority.asker is not None
    assert (authority.asker.name, authority.asker.due) == ("Bert", NOW + OBJECTION_TIME)
    pass_time(authority, OBJECTION_TIME, anna, bert)
    assert (driver(authority), authority.asker) == ("Bert", None)


def test_asking_again_does_not_start_the_time_anew(
    authority: Authority, anna: FakeClient, bert: FakeClient
) -> None:
    authority.acquire(anna, NOW)
    authority.request(bert, NOW)
    later = pass_time(authority, 6.0, anna, bert)
    assert authority.request(bert, later) == ""
    pass_time(authority, OBJECTION_TIME, anna, bert)
    assert driver(authority) == "Bert"


def test_a_driver_who_objects_keeps_control_and_is_not_asked_again_at_once(
    authority: Authority, anna: FakeClient, bert: FakeClient
) -> None:
    authority.acquire(anna, NOW)
    authority.request(bert, NOW)
    assert authority.object(anna, NOW + 1.0) == ""
    pass_time(authority, OBJECTION_TIME + 1.0, anna, bert)
    assert driver(authority) == "Anna"
    assert authority.request(bert, NOW + 11.0) == "Anna has objected; ask again in 20.0 s."
    later = pass_time(authority, 1.0 + REQUEST_PAUSE, anna, bert)
    assert authority.request(bert, later) == ""
    assert authority.asker is not None


def test_an_objection_does_not_count_for_the_next_driver(
    authority: Authority, anna: FakeClient, bert: FakeClient
) -> None:
    carl = known(authority, "carl")
    authority.acquire(anna, NOW)
    authority.request(bert, NOW)
    authority.object(anna, NOW)
    authority.release(anna)
    authority.acquire(carl, NOW)
    assert authority.request(bert, NOW) == ""


def test_a_driver_may_hand_over_at_once(authority: Authority, anna: FakeClient, bert: FakeClient) -> None:
    authority.acquire(anna, NOW)
    authority.request(bert, NOW)
    assert authority.grant(anna) == ""
    assert driver(authority) == "Bert"


def test_only_the_driver_answers_who_asks(authority: Authority, anna: FakeClient, bert: FakeClient) -> None:
    assert authority.grant(anna) == "No one asks for control."
    authority.acquire(anna, NOW)
    assert authority.object(anna, NOW) == "No one asks for control."
    authority.request(bert, NOW)
    assert authority.grant(bert) == "Anna has control; only its holder can answer."
    assert authority.object(bert, NOW) == "Anna has control; only its holder can answer."
    assert driver(authority) == "Anna"


def test_there_is_one_who_asks_at_a_time(authority: Authority, anna: FakeClient, bert: FakeClient) -> None:
    authority.acquire(anna, NOW)
    authority.request(bert, NOW)
    said = authority.request(known(authority, "carl"), NOW)
    assert said == "Bert has asked Anna for control already; wait for the answer."


def test_control_that_is_given_back_goes_to_who_asks_and_not_to_who_is_quicker(
    authority: Authority, anna: FakeClient, bert: FakeClient
) -> None:
    carl = known(authority, "carl")
    authority.acquire(anna, NOW)
    authority.request(bert, NOW)
    assert authority.release(anna) == ""
    assert driver(authority) == "Bert"
    assert authority.acquire(carl, NOW).startswith("Bert has control")


@pytest.mark.parametrize("cut", ["silent", "gone"])
def test_control_of_a_driver_who_is_lost_goes_to_who_asks(
    authority: Authority, anna: FakeClient, bert: FakeClient, cut: str
) -> None:
    authority.acquire(anna, NOW)
    authority.request(bert, NOW)
    if cut == "gone":
        assert authority.on_gone(anna)
    else:
        pass_time(authority, CONTROL_TIMEOUT + 0.1, bert)
    assert driver(authority) == "Bert"


@pytest.mark.parametrize("cut", ["silent", "gone", "taken back"])
def test_who_asks_and_is_lost_asks_no_longer(
    authority: Authority, anna: FakeClient, bert: FakeClient, cut: str
) -> None:
    authority.acquire(anna, NOW)
    authority.request(bert, NOW)
    if cut == "gone":
        assert not authority.on_gone(bert)
    elif cut == "taken back":
        assert authority.release(bert) == ""
    else:
        pass_time(authority, CONTROL_TIMEOUT + 0.1, anna)
    assert authority.asker is None
    pass_time(authority, OBJECTION_TIME, anna)
    assert driver(authority) == "Anna"


def test_who_comes_back_over_another_connection_answers_from_there(
    authority: Authority, anna: FakeClient, bert: FakeClient
) -> None:
    authority.acquire(anna, NOW)
    authority.request(bert, NOW)
    again = FakeClient("7", NOW + TAKEOVER_SILENCE + 0.1)
    authority.introduce(again, "tablet-anna", "Anna")
    assert authority.grant(again).startswith("Anna has control")
    assert authority.acquire(again, NOW + TAKEOVER_SILENCE + 0.1) == ""
    assert authority.object(again, NOW + TAKEOVER_SILENCE + 0.1) == ""
    assert authority.holds(again)
    assert not authority.holds(anna)


def test_the_drivers_own_id_over_another_connection_is_refused_and_asks_nobody(
    authority: Authority, anna: FakeClient
) -> None:
    authority.acquire(anna, NOW)
    twin = FakeClient("7", NOW)
    authority.introduce(twin, "tablet-anna", "Anna")
    said = "Anna has control over another connection with the same client_id"
    assert authority.request(twin, NOW).startswith(said)
    assert authority.asker is None


@pytest.mark.parametrize("empty", ["", " \n"])
def test_who_introduces_itself_with_empty_words_is_called_as_before(
    authority: Authority, anna: FakeClient, empty: str
) -> None:
    authority.introduce(anna, empty, empty)
    assert (authority.id(anna), authority.name(anna)) == (public_id("tablet-anna"), "Anna")
    authority.introduce(anna, "", "Anna's phone")
    assert (authority.id(anna), authority.name(anna)) == (public_id("tablet-anna"), "Anna's phone")


def test_of_ever_more_objections_the_oldest_is_forgotten(authority: Authority, anna: FakeClient) -> None:
    authority.acquire(anna, NOW)
    others = [known(authority, f"other{number}") for number in range(MAX_OBJECTIONS + 1)]
    for other in others:
        assert authority.request(other, NOW) == ""
        authority.object(anna, NOW)
    assert "has objected" in authority.request(others[1], NOW)
    assert authority.request(others[0], NOW) == ""


def test_two_of_one_name_can_be_told_apart_and_keep_their_names(authority: Authority) -> None:
    one, other = FakeClient("c1", NOW), FakeClient("c2", NOW)
    authority.introduce(one, "id-1", "vm")
    authority.introduce(other, "id-2", "vm")
    assert (authority.name(one), authority.name(other)) == ("vm", "vm (2)")
    authority.on_gone(one)
    authority.on_gone(other)
    again, back = FakeClient("c3", NOW), FakeClient("c4", NOW)
    authority.introduce(again, "id-2", "vm")
    authority.introduce(back, "id-1", "vm")
    assert (authority.name(again), authority.name(back)) == ("vm (2)", "vm")
    authority.introduce(again, "id-2", "Bert's phone")
    assert authority.name(again) == "Bert's phone"


def test_a_crowd_of_one_name_is_bounded_and_nobody_s_name_too_long(authority: Authority) -> None:
    names = set()
    for number in range(300):
        client = FakeClient(f"c{number}", NOW)
        authority.introduce(client, f"id-{number}", "v" * 99)
        names.add(authority.name(client))
        authority.on_gone(client)
    assert len(names) >= 256
    assert max(map(len, names)) <= 40


def asks(authority: Authority, asker: FakeClient, driver: FakeClient, now: float) -> None:
    asker.last_heard = driver.last_heard = now
    authority.request(asker, now)


def test_objections_to_the_same_asker_run_out(
    authority: Authority, anna: FakeClient, bert: FakeClient
) -> None:
    authority.acquire(anna, 10.0)
    now = 10.0
    for _ in range(MAX_REPEATED_OBJECTIONS):
        asks(authority, bert, anna, now)
        assert authority.object(anna, now) == ""
        now += REQUEST_PAUSE
    asks(authority, bert, anna, now)
    assert authority.object(anna, now).endswith("control goes over.")
    anna.last_heard = bert.last_heard = now + OBJECTION_TIME
    authority.update(now + OBJECTION_TIME)
    assert authority.holds(bert)


def test_objections_that_are_long_ago_are_not_counted(
    authority: Authority, anna: FakeClient, bert: FakeClient
) -> None:
    authority.acquire(anna, 10.0)
    for number in range(10):
        now = 10.0 + number * OBJECTION_MEMORY / 2
        asks(authority, bert, anna, now)
        assert authority.object(anna, now) == ""
    assert authority.holds(anna)


@pytest.mark.parametrize(
    ("driver", "asker", "may"),
    [
        (Role.DRIVE, Role.DRIVE, True),
        (Role.DRIVE, Role.MANAGE, False),
        (Role.MANAGE, Role.MANAGE, True),
        (Role.MANAGE, Role.DRIVE, True),
    ],
)
def test_a_driver_does_not_object_to_who_manages_the_robot(driver: Role, asker: Role, may: bool) -> None:
    authority = Authority()
    anna = FakeClient("anna", 10.0, Identity("", "", driver))
    bert = FakeClient("bert", 10.0, Identity("", "", asker))
    authority.acquire(anna, 10.0)
    authority.request(bert, 10.0)
    assert (authority.object(anna, 11.0) == "") is may
    anna.last_heard = bert.last_heard = 10.0 + OBJECTION_TIME
    authority.update(10.0 + OBJECTION_TIME)
    assert authority.holds(anna) is may


def test_who_repeats_a_published_id_is_not_taken_for_its_owner(
    authority: Authority, anna: FakeClient
) -> None:
    authority.acquire(anna, NOW)
    thief = FakeClient("thief", NOW)
    authority.introduce(thief, authority.id(anna), "Anna")
    thief.last_heard = NOW + TAKEOVER_SILENCE + 0.5
    assert "Anna has control" in authority.acquire(thief, thief.last_heard)
    again = FakeClient("again", thief.last_heard)
    authority.introduce(again, "tablet-anna", "Anna")
    assert authority.acquire(again, again.last_heard) == "", "who knows the client_id itself comes back"


def test_who_proved_an_identity_is_known_by_it_whatever_it_says(
    authority: Authority, anna: FakeClient
) -> None:
    authority.acquire(anna, NOW)
    proven = FakeClient("proven", NOW + TAKEOVER_SILENCE + 0.5)
    proven.identity = Identity("f00d", "Carl", Role.DRIVE, proven=True)
    authority.introduce(proven, "tablet-anna", "Anna")
    assert (authority.id(proven), authority.name(proven)) == ("f00d", "Carl")
    assert "Anna has control" in authority.acquire(proven, proven.last_heard)


def test_who_proves_an_identity_after_it_has_spoken_is_known_by_it_from_then_on(
    authority: Authority, anna: FakeClient
) -> None:
    anna.identity = Identity("f00d", "Anna's phone", Role.DRIVE, proven=True)
    assert (authority.id(anna), authority.name(anna)) == ("f00d", "Anna's phone")

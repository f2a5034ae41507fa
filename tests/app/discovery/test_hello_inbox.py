"""HELLOs on their way to the UI thread: the newest of each robot, and never more than so many."""

from __future__ import annotations

from app.discovery.hello_inbox import MAX_NEW, MAX_NEW_PER_SOURCE, HeardHello, HelloInbox
from bridge.discovery.hello import Hello


def heard(host: str, port: int = 9090, name: str = "a", at: float = 1.0) -> HeardHello:
    return HeardHello(Hello(name=name, url=f"ws://{host}:{port}"), host, at)


def test_the_newest_of_each_robot_is_taken_once() -> None:
    inbox = HelloInbox()
    for one in (heard("10.0.0.1"), heard("10.0.0.2"), heard("10.0.0.1", name="b", at=2.0)):
        inbox.put(one)
    assert [(one.hello.name, one.received) for one in inbox.take()] == [("b", 2.0), ("a", 1.0)]
    assert inbox.take() == []


def test_strangers_that_wait_are_bounded_and_a_listed_robot_always_gets_in() -> None:
    inbox = HelloInbox()
    inbox.expect(["ws://10.0.0.1:9090"])
    for n in range(5000):
        inbox.put(heard(f"10.9.{n // 250}.{n % 250}"))
    inbox.put(heard("10.0.0.1"))
    waiting = inbox.take()
    assert (len(waiting), waiting[-1].source) == (MAX_NEW + 1, "10.0.0.1")
    inbox.put(heard("10.9.0.1"))
    assert len(inbox.take()) == 1, "there is room again"


def test_one_address_leaves_room_for_others() -> None:
    inbox = HelloInbox()
    for port in range(1, 5000):
        inbox.put(heard("10.9.0.1", port))
    inbox.put(heard("10.0.0.1"))
    assert len(inbox.take()) == MAX_NEW_PER_SOURCE + 1

"""STOP ALL over real sockets, to robots of ours, to one that is not, and to addresses where nobody answers."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

import pytest

from app.stop.fleet import Fleet
from bridge.msgs.geometry_msgs import Twist
from tests.app.fakes import FakeRobot
from tests.app.stop.lanes import heard, until
from tests.app.strange import strange_robot


@pytest.fixture
def real() -> Iterator[Fleet]:
    fleet = Fleet(client_id="me", client_name="tablet")
    yield fleet
    fleet.close()
    assert not any(thread.name == "STOP ALL" for thread in threading.enumerate())


@contextmanager
def fakes(count: int) -> Iterator[list[FakeRobot]]:
    with ExitStack() as stack:
        robots = [FakeRobot() for _ in range(count)]
        for robot in robots:
            stack.callback(robot.close)
        yield robots


def test_robots_on_the_network_are_stopped_by_who_drives_none_of_them(real: Fleet) -> None:
    with fakes(2) as robots:
        real.press(heard(robot.url) for robot in robots)
        until(lambda: (real.update(None), real.stopped == 2)[1], "not stopped")  # type: ignore[func-returns-value]
        assert [robot.services() for robot in robots] == [["/stop"], ["/stop"]]
        assert [robot.control.stopped for robot in robots] == [True, True]
        assert all(robot.asked[0][1].client_name == "tablet" for robot in robots)


def test_one_that_is_switched_on_later_is_stopped_then(real: Fleet) -> None:
    with fakes(2) as (here, later):
        later.stop()
        real.press([heard(here.url), heard(later.url)])
        until(lambda: (real.update(None), real.stopped == 1)[1], "not stopped")  # type: ignore[func-returns-value]
        later.start()
        until(lambda: (real.update(None), real.stopped == 2)[1], "not stopped")  # type: ignore[func-returns-value]
        assert later.control.stopped


def test_an_app_that_is_closed_right_after_the_press_leaves_it_a_moment_to_get_through() -> None:
    with fakes(1) as (robot,):
        fleet = Fleet(client_id="me", client_name="tablet")
        fleet.press([heard(robot.url)])
        fleet.close()
        assert robot.control.stopped


def test_one_that_is_not_ours_gets_zero_speed_until_it_is_let_go(real: Fleet) -> None:
    with strange_robot() as strange:
        real.press([heard(strange.url)])
        until(lambda: (real.update(None), real.stopped == 1)[1], "not stopped")  # type: ignore[func-returns-value]
        assert real.rows[0].foreign
        assert real.sending
        assert "No STOP of its own" in real.rows[0].sentence
        before = strange.robot.heard
        until(lambda: strange.robot.heard > before + 2, "zero speed is sent no longer")
        told = [op for op in strange.operations("publish") if op["topic"] == "/cmd_vel"]
        assert all(Twist.planar(0.0, 0.0) == Twist() and op["msg"]["linear"]["x"] == 0 for op in told)  # type: ignore[index]
        real.let_go()
        until(lambda: not strange.clients, "what says zero speed is still there")


@contextmanager
def deaf() -> Iterator[str]:
    """An address that takes connections, and never says a word."""
    with socket.create_server(("127.0.0.1", 0), backlog=64) as listener:
        yield f"ws://127.0.0.1:{listener.getsockname()[1]}"


@contextmanager
def hole() -> Iterator[str]:
    """An address that never answers a SYN, as of a host that is switched off: its queue is full."""
    with socket.create_server(("127.0.0.1", 0), backlog=0) as listener, ExitStack() as stack:
        place = listener.getsockname()
        for _ in range(3):
            filler = stack.enter_context(socket.socket())
            filler.setblocking(False)
            filler.connect_ex(place)
        yield f"ws://127.0.0.1:{place[1]}"


def test_fifty_addresses_of_which_one_lives_hold_up_neither_the_glass_nor_that_one(
    real: Fleet, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = set[int]()
    find = socket.getaddrinfo

    def noted(*args: Any, **kwargs: Any) -> Any:
        asked.add(threading.get_ident())
        return find(*args, **kwargs)

    monkeypatch.setattr(socket, "getaddrinfo", noted)
    with fakes(1) as (robot,), deaf() as silent, hole() as dead:
        entries = [heard(f"{dead}/{n}") for n in range(47)]
        entries += [heard(silent), heard("ws://no-such-robot.invalid:9090"), heard(robot.url)]
        real.press(entries)
        until(lambda: (real.update(None), real.stopped == 1)[1], "not stopped")  # type: ignore[func-returns-value]
        assert (real.stopped, real.total) == (1, 50)
        assert {row.phase for row in real.rows[:48]} == {"sent"}, "the living had to wait for the dead"
        real.let_go()
        assert threading.get_ident() not in asked, "the glass waited for the network"

"""The stage that widget tests stand on."""

from __future__ import annotations

import asyncio
import threading
import weakref

from kivy.clock import Clock
from kivy.uix.button import Button

from tests.thrown import Lasting, throw_away


def test_time_passes_only_when_the_test_says_so(stage):
    fired = []
    Clock.schedule_once(fired.append, 0.8)
    stage.run_for(0.75)
    assert not fired
    stage.run_for(0.1)
    assert len(fired) == 1


def test_a_finger_presses_the_button_under_it(stage):
    button = stage.show(Button(), size=(100, 60))
    pressed = []
    button.bind(on_press=pressed.append)
    stage.tap(50, 30)
    stage.tap(150, 30)
    assert pressed == [button]


def test_the_next_test_finds_an_empty_window(stage):
    assert stage.window.children == []


def test_a_widget_that_was_thrown_away_does_not_vanish_in_the_middle_of_a_test():
    lasting = Lasting()
    thrown = throw_away(lasting)
    lasting.name = "after"
    assert thrown().followed[0] == "after"


MUCH: list[weakref.ref[object]] = []


def test_what_a_test_threw_away():
    MUCH.extend(throw_away(Lasting()) for _ in range(100))
    assert all(thrown() is not None for thrown in MUCH)


def test_is_gone_in_the_next_one():
    assert MUCH
    assert not [thrown for thrown in MUCH if thrown() is not None]


async def test_a_finished_task_is_no_task_left():
    await asyncio.create_task(asyncio.sleep(0))


def test_a_joined_thread_is_no_thread_left():
    thread = threading.Thread(target=lambda: None)
    thread.start()
    thread.join()

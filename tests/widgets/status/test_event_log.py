from __future__ import annotations

import math

import pytest
from kivy.base import EventLoop

from bridge.core.codes import Code
from bridge.msgs.diagnostic_msgs import KeyValue
from bridge.msgs.pilothouse_msgs import Event
from bridge.msgs.std_msgs import Time
from widgets.core.icons import ICONS
from widgets.core.theme import theme
from widgets.status.event_log import MAX_EVENTS, EventLog, ago, appearance
from widgets.status.event_row import CODES, KINDS, is_open, note, row_height


def event(number, stamp=0.0, **kwargs):
    return Event(id=number, stamp=Time.at(stamp), **{"boot": "a", "text": f"event {number}", **kwargs})


@pytest.fixture
def log(stage):
    return stage.show(EventLog(state="live"), size=(330, 200))


def texts(log):
    return [row["text"] for row in rows(log)]


def rows(log):
    EventLoop.idle()
    return log.ids.view.data


def times(log):
    EventLoop.idle()
    return {row.text: row.when for row in log.ids.rows.children}


def test_an_empty_log_says_so(log):
    assert log.notice == "No events yet."
    log.show(event(1))
    assert log.notice == ""


def test_the_newest_is_on_top(log):
    for number in (1, 2, 3):
        log.show(event(number, number))
    assert texts(log) == ["event 3", "event 2", "event 1"]


def test_a_late_one_finds_its_place(log):
    for number in (1, 3, 2):
        log.show(event(number, number))
    assert texts(log) == ["event 3", "event 2", "event 1"]


def test_the_same_event_is_shown_once(log):
    log.show(event(1))
    log.show(event(1))
    log.show(event(1, boot="b"))
    assert log.count == 2


def test_it_keeps_the_newest_200(log):
    for number in range(MAX_EVENTS + 20):
        log.show(event(number, number))
    assert log.count == MAX_EVENTS == len(texts(log))
    assert texts(log)[0] == "event 219"
    assert log.events[-1].id == 20


def test_it_says_how_long_ago(log):
    log.show(event(1, 100.0))
    log.now = 162.4
    assert times(log) == {"event 1": "1 min"}
    log.now = 221.0
    assert times(log) == {"event 1": "2 min"}


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (0.3, "now"),
        (-4.0, "now"),
        (21, "21 s"),
        (62, "1 min"),
        (7300, "2 h"),
        (200000, "2 d"),
        (math.nan, ""),
    ],
)
def test_ages_are_short(seconds, text):
    assert ago(seconds) == text


@pytest.mark.parametrize(
    ("kind", "code", "name"),
    [
        ("task", Code.TASK_STARTED, "play_arrow"),
        ("task", Code.TASK_RESUMED, "play_arrow"),
        ("task", Code.TASK_BUMPED, "pause"),
        ("task", Code.TASK_PAUSED, "pause"),
        ("task", Code.TASK_STOPPED, "pan_tool"),
        ("task", Code.TASK_REPLACED, "stop"),
        ("stop", Code.STOP_PRESSED, "pan_tool"),
        ("stop", Code.STOP_RELEASED, "lock_open"),
        ("battery", Code.BATTERY_GOING_HOME, "battery_alert"),
    ],
)
def test_what_happened_to_a_task_has_an_icon_of_its_own(kind, code, name):
    assert appearance(event(1, kind=kind, text="Patrol stopped at home.", code=code.value))[0] == name


def test_the_way_home_has_an_icon_of_its_own():
    home = [KeyValue("task", "go_home")]
    assert appearance(event(1, kind="task", code="task_started", parameters=home))[0] == "home"
    assert appearance(event(1, kind="task", code="task_resumed", parameters=home))[0] == "play_arrow"


def test_without_a_code_an_event_has_the_icon_of_its_kind():
    assert appearance(event(1, kind="task", text="Paused by Ben."))[0] == KINDS["task"][0]


@pytest.mark.parametrize("state", ["stale", "alarm"])
def test_signs_of_the_state_hide_no_row(stage, log, state):
    log.show(event(1))
    log.state, log.age = state, 65.0
    stage.frames(3)
    assert log.ids.view.top <= log.badge_pos[1]
    assert log.ids.view.top <= log.top - log.alarm_texture.height - 6
    log.state = "live"
    stage.frames(3)
    assert log.ids.view.top == log.top


def test_a_grave_level_colours_any_kind():
    assert appearance(event(1, kind="waypoint")) == ("flag", "plan")
    assert appearance(event(1, kind="waypoint", level="alarm")) == ("flag", "danger")
    assert appearance(event(1, kind="command", level="warn")) == ("block", "warn")
    assert appearance(event(1, kind="no such kind")) == ("info", "muted")


def test_every_kind_has_an_icon_that_the_font_has():
    assert all(name in ICONS for name, _ in KINDS.values())
    assert set(CODES.values()) <= set(ICONS)


def test_a_long_sentence_is_given_a_taller_row(stage, log):
    log.show(event(1))
    log.show(Event(id=2, text="Refused: " + "the battery is too low for so long a way " * 3))
    stage.frames(4)
    high = {row["text"]: row["row_size"][1] for row in rows(log)}
    assert high["event 1"] < max(high.values())


def test_cleared_it_is_empty(log):
    log.show(event(1))
    log.clear()
    assert (texts(log), log.count) == ([], 0)
    log.show(event(1))
    assert log.count == 1


def test_who_has_seen_to_it_is_said_where_the_event_stands(log):
    log.show(event(1, level="alarm"))
    log.show(event(2))
    assert [(row["open"], row["note"]) for row in rows(log)] == [(False, ""), (True, "")]
    log.show(event(1, level="alarm", acknowledged_by="Anna"))
    assert [(row["text"], row["open"], row["note"]) for row in rows(log)] == [
        ("event 2", False, ""),
        ("event 1", False, "Seen by Anna"),
    ]


def test_the_time_of_day_is_said_where_it_is_known():
    seen = event(1, level="alarm", acknowledged_by="Anna", acknowledged=Time.at(1000.0))
    assert note(seen).startswith("Seen by Anna, ")
    assert not is_open(seen)
    assert note(event(1), asked=True) == "Sending to the robot …"


def test_one_tap_says_that_it_has_been_seen_to(stage, log):
    heard = []
    log.bind(on_command=lambda _, event: heard.append(event.id))
    log.acts = True
    for number, level in enumerate(("alarm", "info", "warn"), 1):
        log.show(event(number, number, level=level))
    stage.frames(4)
    buttons = {row.text: row.children[0] for row in log.ids.rows.children}
    assert {text: one.disabled for text, one in buttons.items()} == {
        "event 1": False,
        "event 2": True,
        "event 3": False,
    }
    stage.tap(*buttons["event 3"].to_window(*buttons["event 3"].center))
    stage.frames(4)
    assert heard == [3]
    log.asked = [("a", 3)]
    stage.frames(4)
    assert [row["act"] is None for row in rows(log)] == [True, True, False]


def test_what_was_missed_is_marked_and_counted_above(log):
    for number in (1, 2, 3):
        log.show(event(number, number))
    log.missed, log.head = [("a", 2), ("a", 3)], "2 while you were away"
    assert texts(log) == ["2 while you were away", "event 3", "event 2", "event 1"]
    assert [row.get("missed") for row in rows(log)] == [None, True, True, False]
    log.missed = []
    assert texts(log) == ["event 3", "event 2", "event 1"]


def test_a_row_that_can_be_pressed_is_large_enough_for_a_finger(log):
    assert row_height(event(1, level="alarm"), 300, acts=True) >= theme.target


def test_thousands_are_shown_without_laying_each_out(log):
    log.most = 5000
    log.show_all(event(number, number, text=f"Waypoint {number} reached") for number in range(3000))
    assert len(texts(log)) == 3000
    assert len(log.ids.rows.children) < 60

"""The tree on the glass: what it shows, what a finger folds, and how little a large message costs."""

from __future__ import annotations

import math
from typing import ClassVar

import pytest
from msgspec.structs import replace

import widgets.fields.field_view
import widgets.fields.message_fields
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import Imu
from bridge.msgs.std_msgs import String
from widgets.core.theme import theme
from widgets.fields.field_samples import battery, cells, diagnostics, imu, log, scan
from widgets.fields.field_view import FieldView
from widgets.parts.labels import Icon


class Texts(Msg, frozen=True, gc=False):
    MSGTYPE: ClassVar[str] = "x/Texts"
    lines: list[str] = []


class Nothing(Msg, frozen=True, gc=False):
    MSGTYPE: ClassVar[str] = "x/Nothing"


@pytest.fixture
def view(stage):
    return stage.show(FieldView(state="live"), size=(388, 500))


def shown(view):
    return sorted((row for row in view._pool if row.parent), key=lambda row: -row.top)


def figures(view):
    return {row.name: row.value for row in shown(view)}


def test_before_the_first_message_it_says_so_or_shows_dashes(stage, view):
    assert (view.notice, shown(view)) == ("No message received yet.", [])
    view.type = type(battery())
    stage.frames(2)
    assert view.notice == ""
    assert figures(view)["voltage"] == "—"


def test_a_message_is_shown_field_by_field_with_its_types(stage, view):
    view.show(cells())
    stage.frames(2)
    assert [(row.name, row.type, row.value) for row in shown(view)] == [
        ("cycles", "uint32", "18 204"),
        ("leak_rate", "float64", "—"),
        ("balanced", "bool", "true"),
        ("voltages", "float32[]", "4 values"),
        ("log", "uint8[]", "45.1 kB"),
    ]


def test_another_type_may_follow(stage, view):
    view.show(cells())
    view.show(String("hello"))
    stage.run_for(0.2)
    assert figures(view) == {"data": "hello"}
    view.show(Nothing())
    stage.run_for(0.2)
    assert view.notice == "This message has no fields."


def test_a_tap_folds_and_another_unfolds(stage, view):
    view.show(imu())
    stage.frames(2)
    row = next(row for row in shown(view) if row.name == "orientation")
    assert [one.name for one in shown(view)][2:6] == ["x", "y", "z", "w"]
    for folded in (True, False):
        stage.tap(*row.to_window(*row.center))
        stage.run_for(0.2)
        row = next(row for row in shown(view) if row.name == "orientation")
        assert row.open is not folded
        assert ([one.name for one in shown(view)][2] == "x") is not folded


def test_what_is_folded_stays_so_with_the_next_message(stage, view):
    view.show(imu())
    stage.frames(2)
    view.fold(("orientation",))
    view.show(Imu())
    stage.run_for(0.2)
    assert [row.name for row in shown(view)][2] == "orientation_covariance"


def test_a_finger_on_a_value_folds_nothing(stage, view):
    view.show(imu())
    stage.frames(2)
    row = next(row for row in shown(view) if row.name == "w")
    stage.tap(*row.to_window(*row.center))
    stage.run_for(0.2)
    assert dict(view.folds) == {}


def test_what_can_be_folded_is_as_high_as_a_finger_needs(stage, view):
    view.show(imu())
    for gloves in (False, True):
        theme.gloves = gloves
        stage.run_for(0.2)
        assert all(row.height >= theme.target for row in shown(view) if row.foldable)
    theme.gloves = False


def test_only_what_is_in_sight_has_widgets(stage, view):
    view.show(Texts(lines=[f"line {index}" for index in range(50)]))
    stage.frames(2)
    assert view.length > 1500
    assert len(view.ids.sheet.children) < 20
    view.ids.scroll.scroll_y = 0
    stage.frames(2)
    assert shown(view)[-1].value == "line 49"
    assert len(view.ids.sheet.children) < 20


def test_fifty_messages_a_second_are_written_ten_times(stage, view, monkeypatch):
    view.show(scan())
    stage.run_for(0.5)
    written = []
    tree = widgets.fields.field_view.rows
    monkeypatch.setattr(widgets.fields.field_view, "rows", lambda *args: written.append(1) or tree(*args))
    for _ in range(50):
        view.show(scan())
        stage.frames(1, 0.02)
    assert len(written) <= 10
    stage.run_for(0.2)
    assert view.message.ranges[100] == pytest.approx(figures_of(view))


def figures_of(view):
    row = next(row for row in view.lines if row.name == "ranges")
    return row.value[100]


def test_showing_a_message_only_assigns(view):
    before = list(view.lines)
    view.show(diagnostics())
    assert view.lines == before


def test_an_age_follows_the_robots_clock(stage, view):
    view.show(imu())
    view.now = 1763719271.12 + 2.0
    stage.run_for(0.2)
    assert figures(view)["header"].endswith("· 2.0 s ago")
    view.now = math.nan
    view.show(imu())
    stage.run_for(0.2)
    assert "ago" not in figures(view)["header"]


@pytest.mark.parametrize("width", [280, 388, 900])
def test_nothing_leaves_the_row(stage, view, width):
    view.width = width
    for message in (imu(), scan(), diagnostics(), cells()):
        view.show(message)
        stage.run_for(0.2)
        for row in shown(view):
            right = row.name_x + row.name_width + (row.type_width and row.type_width + 9)
            assert right <= row.right - 12 - row.value_width + 1, row.name


def test_its_age_stands_above_the_tree_and_what_is_old_can_be_read(stage, view):
    view.show(battery())
    view.age, view.state = 12.0, "stale"
    stage.frames(2)
    assert view.badge == "12 s old"
    assert view.badge_pos[1] >= view.ids.scroll.top
    assert view.veil[3] < 0.4
    view.aged = False
    assert (view.badge, view.strip) == ("", 0.0)


def test_a_type_is_written_whole_or_not_at_all(stage, view):
    view.now = 1763719271.2
    view.show(imu())
    view.width = 388
    stage.frames(3)
    header = next(row for row in shown(view) if row.name == "header")
    assert header.type_width == 0.0
    assert [label.opacity for label in header.children if getattr(label, "text", "") == header.type] == [0]


def test_an_age_goes_on_while_nothing_comes(stage, view):
    view.show(imu())
    view.now = 1763719271.12 + 2.0
    stage.run_for(0.3)
    view.now += 30.0
    stage.run_for(0.3)
    assert figures(view)["header"].endswith("· 32.0 s ago")


def test_what_has_not_come_needs_no_second_line(stage, view):
    view.type = Imu
    stage.frames(2)
    assert {row.height for row in shown(view) if not row.foldable} == {38.0}
    view.show(imu())
    stage.run_for(0.3)
    assert next(row for row in shown(view) if row.name == "orientation_covariance").height == 60.0


def test_a_type_does_not_come_and_go_with_the_length_of_a_figure(stage, view):
    narrow = next(width for width in range(120, 400, 2) if has_type(stage, view, width, "short"))
    assert not has_type(stage, view, narrow, "a longer figure")
    assert not has_type(stage, view, narrow, "short")


def has_type(stage, view, width, text):
    view.width = width
    view.show(String(text))
    stage.run_for(0.2)
    return next(row for row in shown(view) if row.name == "data").type_width > 0


def test_a_unit_stands_behind_its_figure(stage, view):
    view.show(battery())
    stage.frames(2)
    row = next(row for row in shown(view) if row.name == "voltage")
    assert (row.value, row.unit) == ("24.1300", "V")
    labels = {label.text: label for label in row.children if getattr(label, "text", "")}
    assert labels["24.1300"].right <= labels["V"].x + 1
    assert labels["V"].right == pytest.approx(row.right - 12)
    assert next(row.unit for row in shown(view) if row.name == "percentage") == ""


def test_a_unit_is_known_before_the_first_message(stage, view):
    view.type = type(battery())
    stage.frames(2)
    assert {row.name: (row.value, row.unit) for row in shown(view)}["current"] == ("—", "A")


def test_a_tap_opens_a_long_text_and_another_closes_it(stage, view):
    view.show(log())
    stage.frames(2)
    closed = text_row(view).height
    for opened in (True, False):
        stage.tap(*text_row(view).to_window(*text_row(view).center))
        stage.run_for(0.2)
        row = text_row(view)
        assert (row.open, row.second == log().msg) == (opened, opened)
        assert (row.height > closed + 60) is opened
        second = next(label for label in row.children if getattr(label, "text", "") == row.second)
        assert row.y <= second.y
        assert second.top <= row.top - row.lead - row.line + 2
        assert second.texture_size[1] <= second.height + 1


def test_an_open_text_stays_so_with_the_next_message_and_makes_room_where_it_is_narrow(stage, view):
    view.show(log())
    view.folds = {("msg",): True}
    stage.frames(2)
    before = text_row(view).height
    view.width = 280
    view.show(log())
    stage.run_for(0.2)
    assert text_row(view).height > before


def test_a_text_that_fits_its_line_has_nothing_to_open(stage, view):
    view.show(
        Texts(lines=["just a little too long for the first line", "w" * 90, "two\nlines of a text on a line"])
    )
    stage.frames(2)
    assert [row.foldable for row in shown(view)] == [True, False, True, True]
    view.fold(("lines", 0))
    assert dict(view.folds) == {}


def test_a_text_of_many_lines_is_no_higher_than_a_graphics_card_can_hold(stage, view):
    view.show(String("W" * 5000))
    view.folds = {("data",): True}
    view.width = 280
    stage.frames(2)
    row = shown(view)[0]
    second = next(label for label in row.children if getattr(label, "text", "") == row.second)
    assert 400 < second.texture_size[1] <= second.height <= row.height < 4096 / 3


def test_an_open_text_can_be_closed_when_a_shorter_one_has_come(stage, view):
    view.show(log())
    view.folds = {("msg",): True}
    stage.frames(2)
    view.show(replace(log(), msg="It found its way round them."))
    stage.run_for(0.2)
    assert text_row(view).foldable
    view.fold(("msg",))
    stage.run_for(0.2)
    assert not text_row(view).foldable


def text_row(view):
    return next(row for row in shown(view) if row.name == "msg")


def test_a_word_instead_of_fields_has_the_icon_and_the_inset_of_others(stage, view):
    view.show(Nothing())
    stage.frames(2)
    note = view.ids.note
    icon = next(child for child in note.parent.children if isinstance(child, Icon))
    assert (icon.name, icon.role, icon.x - view.x) == ("info", "muted", 8.0)
    assert note.x == icon.right + 8
    assert note.parent.opacity == 1
    view.show(battery())
    stage.run_for(0.2)
    assert note.parent.opacity == 0


def test_where_numbers_can_be_chosen_a_tap_on_one_tells_its_way_and_unit(stage):
    view, told = stage.show(FieldView(picks=True, state="live"), size=(400, 600)), []
    view.bind(on_pick=lambda _, path, unit: told.append((path, unit)))
    view.show(Imu())
    stage.frames(2)
    row = next(row for row in view._pool if row.path == ("angular_velocity", "z"))
    stage.tap(*row.to_window(*row.center))
    assert told == [("angular_velocity.z", "rad/s")]
    view.picked = ["angular_velocity.z"]
    stage.frames(2)
    assert next(row for row in view._pool if row.path == ("angular_velocity", "z")).picked
    view.picks = False
    stage.frames(2)
    stage.tap(*row.to_window(*row.center))
    assert len(told) == 1

from __future__ import annotations

import math

import numpy as np
import pytest

from bridge.msgs.geometry_msgs import Twist
from bridge.msgs.nav_msgs import Odometry
from bridge.msgs.sensor_msgs import JointState
from widgets.core.theme import theme
from widgets.plots.columns import FLOATS, NOTHING, PIECE
from widgets.plots.plot import Plot, samples
from widgets.plots.plot_layout import ago_text, value_text
from widgets.plots.trace import MAX_TRACES, ROLES, Trace
from widgets.plots.trace_ink import _Layer

PERIOD = 1 / 16
"""Between two messages of these tests [s]; exact in binary."""


@pytest.fixture
def plot(stage):
    made = stage.show(Plot(paths=["linear.x", "angular.z"], names=["ahead", "turn"]), size=(520, 300))
    made.state = "live"
    return made


def drive(plot, stage, count, ahead=lambda number: 0.5, turn=lambda number: 0.0):
    """So many messages, one each PERIOD."""
    for number in range(count):
        stage.frames(1, PERIOD)
        plot.show(Twist.planar(ahead(number), turn(number)))
    stage.frames(2)


def drawn(trace: Trace) -> int:
    """Columns of a line that show something."""
    columns = trace.columns
    return int((columns.quads[: columns.count, 0, 6] >= 0).sum())


def on_glass(plot, layer: int) -> np.ndarray:
    """Quads of a line as the graphics card has been given them last; a mesh keeps a view, so that each is asked when it is told."""
    return np.concatenate([piece for piece in plot.sent[layer] if piece is not None])


@pytest.fixture
def sent(plot, monkeypatch):
    """Copies of what is given to the graphics card, by layer and piece, and how many pieces that were."""
    told = {"pieces": 0}
    plot.sent = [[], []]

    def follow(layer, columns):
        seen = plot.sent[plot._ink._layers.index(layer)]
        if layer._quads is not columns.quads:
            seen[:] = [None] * -(-len(columns.quads) // PIECE)
            changed = set(range(len(seen)))
        else:
            changed = set(columns.changed)
        plain(layer, columns)
        told["pieces"] += len(changed)
        for piece in changed:
            seen[piece] = np.array(layer._meshes[piece].vertices).reshape(-1, 4, FLOATS)

    plain = _Layer.follow
    monkeypatch.setattr(_Layer, "follow", follow)
    plot.refresh()
    return told


def test_what_goes_to_the_graphics_card_is_what_has_changed_and_no_less(plot, stage, sent):
    plot.span = 5.0
    drive(plot, stage, 4)
    before = sent["pieces"]
    drive(plot, stage, 150, ahead=lambda number: math.sin(number * 0.3), turn=math.cos)
    for layer, trace in enumerate(plot.traces):
        assert np.array_equal(on_glass(plot, layer), trace.columns.quads)
    whole = -(-len(plot.traces[0].columns.quads) // PIECE)
    assert sent["pieces"] - before < 150 * 2 * whole / 3  # two lines


@pytest.mark.parametrize(
    "change",
    [
        {"size": (300, 200)},
        {"span": 2.0},
        {"until": 1003.0},
        {"state": "stale", "age": 1.0},
        {"paths": ["linear.y", "linear.x"]},
    ],
    ids=str,
)
def test_after_any_change_the_graphics_card_has_the_whole_lines(plot, stage, sent, change):
    drive(plot, stage, 80, ahead=lambda number: math.sin(number * 0.3))
    for name, value in change.items():
        setattr(plot, name, value)
    drive(plot, stage, 3, ahead=lambda _: 9.0)
    for layer, trace in enumerate(plot.traces):
        assert np.array_equal(on_glass(plot, layer), trace.columns.quads)


def test_a_line_that_is_taken_away_leaves_its_layer_to_the_next(plot, stage, sent):
    drive(plot, stage, 40, ahead=lambda number: number / 40, turn=lambda _: -1.0)
    plot.remove(plot.traces[0])
    drive(plot, stage, 2, turn=lambda _: -2.0)
    assert np.array_equal(on_glass(plot, 0), plot.traces[0].columns.quads)
    left = plot._ink._layers[1]._meshes
    assert [np.asarray(mesh.vertices).reshape(-1, FLOATS)[0, 6] for mesh in left] == [NOTHING]


def test_ink_for_a_cursor_is_there_while_a_cursor_is(plot, stage):
    drive(plot, stage, 40)
    assert plot._cursor.canvas.children == []
    plot.opacity = 0.5
    plot.pause()
    plot.cursor = plot.known[1] - 0.5
    stage.frames(2)
    assert plot._cursor.canvas.children == [plot._cursor._ink]
    assert plot._cursor._ink["seen"] == 0.5
    plot.cursor = math.nan
    stage.frames(2)
    assert plot._cursor.canvas.children == []


def test_lines_fade_with_the_plot(plot, stage):
    plot.opacity = 0.25
    stage.frames(2)
    assert [ink["seen"] for ink in (plot._grid, plot._ink, plot._keys)] == [0.25] * 3


def test_a_line_has_its_role_in_each_theme(plot, stage):
    drive(plot, stage, 3)
    try:
        for name in ("dark", "sunlight", "night"):
            theme.name = name
            stage.frames(2)
            inks = [tuple(layer._colour.rgba) for layer in plot._ink._layers]
            assert inks == [pytest.approx(tuple(theme.roles[trace.role])) for trace in plot.traces]
    finally:
        theme.name = "dark"


def test_it_takes_the_fields_at_its_paths(plot, stage):
    plot.span = 10.0  # a column of pixels for each message
    drive(plot, stage, 10, ahead=lambda number: number / 10, turn=lambda number: -1.0)
    ahead, turn = plot.traces
    assert ahead.history.values.tolist() == pytest.approx([number / 10 for number in range(10)])
    assert set(turn.history.values) == {-1.0}
    assert np.diff(ahead.history.times) == pytest.approx(PERIOD)
    assert [trace.name for trace in plot.traces] == ["ahead", "turn"]
    assert drawn(ahead) == 10


def test_lines_of_several_topics_meet_in_one_plot(plot, stage):
    odometry = plot.trace("twist.twist.linear.x", "odometry", unit="m/s", topic="/odom")
    odometry.show(Odometry())
    drive(plot, stage, 3)
    assert len(odometry.history) == 1
    assert len(plot.traces[0].history) == 3
    plot.remove(odometry)
    assert len(plot.traces) == 2


def test_each_line_has_a_mark_of_its_own_beside_its_colour(plot):
    while len(plot.traces) < MAX_TRACES:
        plot.trace("linear.y")
    assert [trace.mark for trace in plot.traces] == list(range(1, MAX_TRACES + 1))
    assert [trace.role for trace in plot.traces] == list(ROLES)


def test_a_ninth_line_is_refused(plot):
    with pytest.raises(ValueError, match="at most 8 fields"):
        Plot(paths=["x"] * 9)
    for _ in range(MAX_TRACES - 2):
        plot.trace("linear.y")
    with pytest.raises(ValueError, match="at most 8 fields"):
        plot.trace("linear.z")


def test_a_place_beyond_an_array_is_a_hole_and_an_unknown_field_is_an_error():
    trace = Trace("velocity[2]")
    trace.show(JointState(velocity=[1.0]), at=1.0)
    assert math.isnan(trace.history.last)
    with pytest.raises(AttributeError):
        Trace("speed").show(JointState())


@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan])
def test_what_is_no_number_is_a_hole(value):
    trace = Trace("x")
    trace.add(1.0, value)
    assert math.isnan(trace.history.last)


def test_the_newest_is_at_the_right_edge(plot, stage):
    drive(plot, stage, 40)
    newest = plot.traces[0].history.newest
    assert plot.seen == (newest - 30, newest)
    assert plot.x_of(newest) == plot.frame[2]
    assert plot.x_of(newest - 30) == pytest.approx(plot.frame[0])


def test_while_nothing_comes_the_line_moves_away_from_the_edge(plot, stage):
    drive(plot, stage, 40)
    newest = plot.traces[0].history.newest
    plot.state, plot.age = "stale", 5.0
    assert plot.x_of(newest) == pytest.approx(plot.frame[2] - 5 * plot.pace)


def test_while_it_is_paused_the_picture_stands_and_history_goes_on(plot, stage):
    drive(plot, stage, 40)
    plot.pause()
    stage.frames(2)
    held, count = plot.seen, drawn(plot.traces[0])
    drive(plot, stage, 40)
    assert (plot.seen, drawn(plot.traces[0])) == (held, count)
    assert len(plot.traces[0].history) == 80
    plot.resume()
    stage.frames(2)
    assert plot.seen[1] == plot.traces[0].history.newest
    assert drawn(plot.traces[0]) > count


def test_the_button_pauses_and_goes_on(plot, stage):
    drive(plot, stage, 5)
    assert plot.button.icon == "pause"
    stage.drag([plot.button.center])
    assert plot.paused
    assert plot.button.icon == "play_arrow"
    stage.drag([plot.button.center])
    assert not plot.paused


def test_nothing_can_be_paused_before_there_is_anything(plot):
    plot.pause()
    assert not plot.paused


def test_one_finger_moves_through_time(plot, stage):
    drive(plot, stage, 800)
    newest = plot.known[1]
    x, y = plot.center
    stage.drag([(x - 60, y), (x, y), (x + 40, y)])
    assert plot.paused
    assert plot.until == pytest.approx(newest - 100 / plot.pace)
    stage.drag([(x, y), (x - 400, y)])
    assert plot.until == newest


def test_nobody_gets_lost_beyond_what_there_is(plot, stage):
    drive(plot, stage, 800)
    oldest = plot.known[0]
    x, y = plot.center
    for _ in range(30):
        stage.drag([(x - 200, y), (x + 200, y)])
    assert oldest < plot.until < oldest + plot.span


def test_the_wheel_zooms_about_the_pointer_and_keeps_the_newest_while_that_is_followed(plot, stage):
    drive(plot, stage, 400)
    plot.zoom(2.0, plot.frame[0])
    assert plot.span == 15
    assert not plot.paused
    plot.pause()
    plot._pan(80.0)
    x = plot.frame[0] + 200
    there = plot.time_of(x)
    wheel = stage.touch(x, plot.center_y)
    wheel.button, wheel.profile = "scrolldown", ["button"]
    wheel.touch_down()
    assert plot.span == pytest.approx(12.5)
    assert plot.time_of(x) == pytest.approx(there)


def test_two_fingers_zoom_about_what_is_beneath_them(plot, stage):
    drive(plot, stage, 800)
    plot.pause()
    plot._pan(150.0)
    y = plot.center_y
    first, second = stage.touch(200, y), stage.touch(300, y)
    first.touch_down()
    second.touch_down()
    times = plot.time_of(200), plot.time_of(300)
    first.touch_move(150, y)
    second.touch_move(350, y)
    assert plot.span == pytest.approx(15.0)
    assert (plot.time_of(150), plot.time_of(350)) == pytest.approx(times)
    first.touch_up()
    second.touch_up()
    assert math.isnan(plot.cursor)


def test_a_tap_puts_a_cursor_with_the_values_of_all_lines_at_that_time(plot, stage):
    picked = []
    plot.bind(on_pick=lambda _, time: picked.append(time))
    drive(plot, stage, 200, ahead=float, turn=lambda number: -float(number))
    at = plot.traces[0].history.times[150]
    stage.drag([(plot.x_of(at), plot.center_y)])
    assert plot.cursor == pytest.approx(at)
    assert plot.values == [150.0, -150.0]
    assert picked == [plot.cursor]
    stage.frames(30)
    assert plot._figures.texts == [value_text(plot._scales, 150.0), value_text(plot._scales, -150.0)]


def test_the_cursor_follows_the_finger_that_holds_it_and_a_tap_takes_it_away(plot, stage):
    drive(plot, stage, 400)
    x, y = plot.frame[0] + 200, plot.center_y
    stage.drag([(x, y)])
    until = plot.until
    stage.drag([(x, y), (x + 50, y), (x + 90, y)])
    assert plot.x_of(plot.cursor) == pytest.approx(x + 90)
    assert plot.until == until
    stage.drag([(x + 90, y)])
    assert math.isnan(plot.cursor)


def test_without_a_cursor_the_legend_has_the_newest_values(plot, stage):
    drive(plot, stage, 10, ahead=float)
    assert plot.values == [9.0, 0.0]
    stage.frames(30)
    assert plot._figures.texts[0] == value_text(plot._scales, 9.0)


def test_before_the_first_message_values_are_dashes(stage):
    plot = stage.show(samples()["never"](), size=(520, 300))
    stage.frames(2)
    assert plot._figures.texts == ["—", "—"]
    assert "No message received yet." in plot._words.texts


def test_the_scale_has_room_for_what_is_seen_and_follows_it_down_again(plot, stage):
    drive(plot, stage, 20, ahead=lambda number: 50.0 if number == 3 else 0.5)
    assert plot._scales.high >= 50.0
    drive(plot, stage, 600)
    assert plot._scales.high < 2.0


def test_a_scale_that_is_given_stays(plot, stage):
    plot.low, plot.high = -1.0, 1.0
    drive(plot, stage, 20, ahead=lambda number: 50.0)
    assert (plot._scales.low, plot._scales.high) == (-1.0, 1.0)


def test_a_recording_is_shown_by_the_clock(plot, stage):
    plot.clear()
    trace = plot.trace("voltage")
    plot.epoch = 1763719271.0
    plot.load(trace, np.arange(0.0, 60.0, 0.1), np.arange(600.0))
    stage.frames(2)
    assert plot.known == (0.0, pytest.approx(59.9))
    assert any(text.count(":") == 2 for text in plot._words.texts)


def test_a_hundred_thousand_messages_take_no_more_room_than_some(stage):
    plot = stage.show(Plot(paths=["linear.x"], capacity=1000), size=(400, 240))
    message = Twist.planar(0.5, 0.0)

    def told(count: int) -> int:
        for _ in range(count):
            stage.time.now += PERIOD
            stage.clock._last_tick = stage.time.now
            plot.show(message)
        stage.frames(2)
        trace = plot.traces[0]
        return trace.columns.quads.nbytes + trace.history._times.nbytes + trace.history._values.nbytes

    some = told(2000)
    assert told(98_000) == some
    assert len(plot.traces[0].history) == 1000


@pytest.mark.parametrize(
    ("ago", "step", "text"),
    [
        (0.0, 1.0, "now"),
        (-10.0, 5.0, "−10 s"),
        (-90.0, 30.0, "−1:30"),
        (-3725.0, 60.0, "−1:02:05"),
        (-0.25, 0.05, "−0.25 s"),
    ],
)
def test_a_time_ago_is_said_shortly(ago, step, text):
    assert ago_text(ago, step) == text

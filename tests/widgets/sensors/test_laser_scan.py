from __future__ import annotations

import math
from itertools import combinations, pairwise

import numpy as np
import pytest

from bridge.msgs.arrays import Float32Array
from bridge.msgs.sensor_msgs import LaserScan
from widgets.core.base import text_texture
from widgets.core.geometry import scan_reach
from widgets.core.quantities import quantities
from widgets.core.shapes import FLOATS, LINE
from widgets.core.theme import theme
from widgets.sensors.laser_scan import LaserScanView, samples


def sweep(*ranges: float, half: float = math.pi / 2, least: float = 0.1) -> LaserScan:
    step = 2 * half / max(len(ranges) - 1, 1)
    return LaserScan(
        angle_min=-half,
        angle_max=half,
        angle_increment=step,
        range_min=least,
        range_max=10.0,
        ranges=Float32Array(ranges),
    )


@pytest.fixture
def view(stage):
    made = stage.show(LaserScanView(title="Front laser"), size=(326, 228))
    made.state = "live"
    return made


def drawn(view: LaserScanView, stage) -> np.ndarray:
    """Vertices of rings, robot and grounds, in the order in which they are drawn."""
    stage.frames(2)
    return np.concatenate([np.asarray(ink._mesh.vertices).reshape(-1, FLOATS) for ink in view.inks])


def places(view: LaserScanView, mesh) -> np.ndarray:
    """Where the vertices of a mesh of the sweep are that are drawn, shape (n, 2) [px]."""
    made = np.asarray(mesh.vertices).reshape(-1, 2)[np.asarray(mesh.indices)]
    return made * view.sweep["scale"] + np.array(view.sweep["middle"])


def free_space(view: LaserScanView, stage) -> np.ndarray:
    """Triangles of free space that have an area, shape (n, 3, 2) [px]."""
    stage.frames(2)
    middle, *rim = places(view, view.sweep.fan)
    corners = np.array([(middle, one, other) for one, other in pairwise(rim)]).reshape(-1, 3, 2)
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return corners[np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]) > 1.0]


def dots(view: LaserScanView, stage) -> np.ndarray:
    """Centres of the dots [px], shape (n, 2), as the shader leaves them."""
    stage.frames(2)
    made = np.asarray(view.sweep.dots.vertices).reshape(-1, 2)[np.asarray(view.sweep.dots.indices)]
    away = np.hypot(*made.T)
    return places(view, view.sweep.dots)[(away > 0) & (away <= view.sweep["reach"])]


def said(view: LaserScanView) -> list[str]:
    return [word.text for word in view._header()]


def test_ahead_is_up_and_left_is_left(view, stage):
    view.show(sweep(2.0, 2.0, 2.0))
    right, ahead, left = dots(view, stage)
    assert right[0] > view.center_x + 30
    assert left[0] < view.center_x - 30
    assert ahead[0] == pytest.approx(view.center_x)
    assert ahead[1] > left[1]


def test_only_returns_are_dots(view, stage):
    view.show(sweep(2.0, math.inf, math.nan, -math.inf, 0.02, 2.0))
    assert len(dots(view, stage)) == 3


def test_too_close_to_measure_is_a_danger_at_the_least_range(view):
    view.show(sweep(2.0, -math.inf, 2.0))
    assert view.nearest == pytest.approx(0.1)


def test_free_space_ends_where_nothing_is_known(view, stage):
    view.show(sweep(2.0, 2.0, math.nan, 2.0, math.inf))
    assert len(free_space(view, stage)) == 2


def test_each_sweep_is_drawn_as_if_it_were_the_first(view, stage):
    sweeps = (sweep(2.0, 0.4, math.nan, 3.0), sweep(*[1.0] * 7), sweep(2.5, math.nan, 0.4, 3.0))
    for scan in sweeps:
        view.show(scan)
        kept = drawn(view, stage)
        fresh = stage.show(LaserScanView(title="Front laser", state="live"), size=(326, 228))
        fresh._reach = view._reach
        fresh.show(scan)
        assert drawn(fresh, stage) == pytest.approx(kept)
        assert np.array_equal(dots(fresh, stage), dots(view, stage))
        assert np.array_equal(fresh.sweep.fan.vertices, view.sweep.fan.vertices)
        stage.window.remove_widget(fresh)


def test_of_more_beams_than_a_mesh_has_room_for_some_are_drawn(view, stage):
    view.show(sweep(*[2.0] * 100_000))
    assert len(dots(view, stage)) == 50_000


def test_a_sweep_that_changes_nothing_else_leaves_rings_and_words_alone(view, stage, monkeypatch):
    view.show(sweep(2.0, 3.0, 4.0))
    stage.frames(2)
    written = []
    for words in (view._words, view._head):
        monkeypatch.setattr(words, "write", written.append)
    view.show(sweep(2.1, 3.1, 4.0))
    stage.frames(2)
    assert not written
    view.show(sweep(2.1, 0.3, 4.0))
    stage.frames(2)
    assert len(written) == 1


def changed(view, stage, change) -> list[bytes]:
    """What is on the glass, as bytes, before and after `change`, with the newest sweep."""
    seen = []
    for act in (lambda: None, change):
        act()
        stage.frames(2)
        sweep_place = repr(sorted(view.sweep._told.items())).encode()
        seen.append(
            drawn(view, stage).tobytes() + sweep_place + repr((view._words.texts, view._head.texts)).encode()
        )
    return seen


@pytest.mark.parametrize(
    "change",
    [
        lambda view: setattr(view, "size", (228, 326)),
        lambda view: setattr(view, "pos", (30, 40)),
        lambda _: setattr(theme, "name", "sunlight"),
        lambda view: setattr(view, "state", "alarm"),
        lambda view: setattr(view, "reach", 12.0),
        lambda view: setattr(view, "near", 0.1),
        lambda view: setattr(view, "title", "Rear laser"),
        lambda _: setattr(quantities, "system", "imperial"),
    ],
    ids=["size", "place", "theme", "state", "reach", "near", "title", "units"],
)
def test_a_change_between_two_sweeps_looks_as_if_it_had_always_been_so(view, stage, change):
    scan = sweep(2.0, 0.9, 3.0)
    view.show(scan)
    try:
        before, after = changed(view, stage, lambda: (change(view), view.redraw()))
        assert before != after
        fresh = stage.show(LaserScanView(state=view.state, title=view.title, near=view.near), size=view.size)
        fresh.pos, fresh.reach = view.pos, view.reach
        fresh.show(scan)
        assert changed(fresh, stage, lambda: None)[1] == after
    finally:
        theme.name, quantities.system = "dark", "metric"


@pytest.mark.parametrize(("half", "triangles"), [(math.pi, 8), (math.pi / 2, 7)])
def test_only_a_sweep_all_round_is_closed(view, stage, half, triangles):
    step = 2 * half / 8
    scan = sweep(*[2.0] * 8, half=half)
    view.show(
        LaserScan(
            angle_min=-half,
            angle_max=half - step if half == math.pi else half,
            angle_increment=step if half == math.pi else 2 * half / 7,
            range_min=scan.range_min,
            range_max=scan.range_max,
            ranges=scan.ranges,
        )
    )
    assert len(free_space(view, stage)) == triangles


def test_everything_stays_inside_the_card(view, stage):
    for scan in (sweep(2.0, 30.0, 2.0), sweep(*[9.0] * 90, half=math.pi), sweep(*[0.3] * 9, half=0.4)):
        view.show(scan)
        made = np.concatenate([drawn(view, stage)[:, :2], dots(view, stage), *free_space(view, stage)])
        assert (made >= 0).all()
        assert (made <= view.size).all()


def test_the_rings_grow_at_once_and_shrink_late():
    assert scan_reach(5.5) == 6
    assert scan_reach(7.0, 6) == 9
    assert scan_reach(5.8, 9) == 9
    assert scan_reach(5.0, 9) == 6
    assert scan_reach(500.0) == 60


def test_the_nearest_return_is_said_when_it_is_near(view):
    view.show(sweep(2.0, 1.04, 3.0))
    assert said(view) == ["FRONT LASER", "1.0 m"]
    view.show(sweep(2.0, 1.5, 3.0))
    assert said(view) == ["FRONT LASER"]


def test_a_danger_has_a_sign_besides_its_colour(view):
    view.show(sweep(2.0, 0.4, 3.0))
    assert len(said(view)) == 3


def test_the_rate_is_in_the_title(view):
    view.rate = 30.2
    assert said(view)[0] == "FRONT LASER · 30 HZ"


def test_before_the_first_sweep_there_is_a_dash(view):
    assert said(view)[-1] == "–"


def test_an_empty_sweep_and_one_of_nan_are_shown_as_nothing(view, stage):
    for scan in (LaserScan(), sweep(math.nan, math.nan)):
        view.show(scan)
        assert len(dots(view, stage)) == 0
        assert view.nearest == math.inf


def box(word) -> tuple[float, float, float, float]:
    wide, high = text_texture(word.text, round(word.size, 1), word.font, bold=word.bold).size
    left, bottom = word.x - wide * word.anchor[0], word.y - high * word.anchor[1]
    return left, bottom, left + wide, bottom + high


@pytest.mark.parametrize("size", [(326, 228), (258, 118), (212, 148)])
@pytest.mark.parametrize("half", [math.pi / 2, math.pi])
def test_its_words_lie_neither_on_each_other_nor_on_the_robot(stage, size, half):
    view = stage.show(LaserScanView(title="Front laser", rate=30.0, state="live"), size=size)
    view.show(sweep(0.4, *[11.5] * 20, half=half))
    stage.frames(2)
    x, y, scale = view._place(half)
    words = [*view._ring_words((x, y), scale, half), *view._header()]
    boxes = [box(word) for word in words] + [(x - 9, y - 7, x + 9, y + 9)]
    for one, other in combinations(boxes, 2):
        beside = one[2] <= other[0] or other[2] <= one[0]
        assert beside or one[3] <= other[1] or other[3] <= one[1], (words, one, other)
    assert all(left >= 0 and right <= view.width for left, _, right, _ in boxes)


def test_words_stand_on_a_ground_above_the_dots(view, stage):
    view.show(sweep(*[2.0] * 50))
    made = drawn(view, stage)
    grounds = np.flatnonzero((made[:, 4] == LINE) & (made[:, 11] == np.float32(0.85)))
    assert len(grounds) == 4 * len(view._words.texts + view._head.texts)
    assert (
        view.canvas.indexof(view.inks[0])
        < view.canvas.indexof(view.sweep)
        < view.canvas.indexof(view.inks[1])
    )
    assert grounds.min() >= len(np.asarray(view.inks[0]._mesh.vertices)) // FLOATS


def test_an_alarm_shows_one_sign(view):
    view.show(sweep(2.0, 0.4, 3.0))
    view.state = "alarm"
    assert said(view) == ["FRONT LASER", "0.4 m"]


def test_a_sample_looks_the_same_when_it_is_built_again():
    for build in samples().values():
        assert tuple(build().size) == tuple(build().size)

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest

from bridge.msgs.arrays import Float32Array
from bridge.msgs.sensor_msgs import LaserScan
from widgets.core.base import text_texture
from widgets.core.geometry import scan_reach
from widgets.core.shapes import EDGES, FLOATS, LINE
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
    """Vertices of everything, in the order in which it is drawn."""
    stage.frames(2)
    return np.concatenate([np.asarray(ink._mesh.vertices).reshape(-1, FLOATS) for ink in view.inks])


def free_space(view: LaserScanView, stage) -> np.ndarray:
    """Triangles of free space that have an area, shape (n, 3, 2) [px]."""
    stage.frames(2)
    mesh = view.inks[1]._mesh
    made = np.asarray(mesh.vertices).reshape(-1, FLOATS)
    corners = made[np.asarray(mesh.indices).reshape(-1, 3)]
    corners = corners[(corners[:, :, 4] == EDGES).all(axis=1)][:, :, :2]
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return corners[np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]) > 1.0]


def dots(view: LaserScanView, stage) -> np.ndarray:
    """Centres of the dots [px], shape (n, 2)."""
    drawn(view, stage)
    made = np.asarray(view.inks[1]._mesh.vertices).reshape(-1, FLOATS)
    corners = made[(made[:, 4] == 0) & (made[:, 5] > 0)][:, :2].reshape(-1, 4, 2)
    return corners.mean(axis=1)[np.ptp(corners, axis=1).any(axis=1)]


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


def test_a_dot_has_the_colour_of_its_distance(view, stage):
    view.show(sweep(0.5, 0.6, 1.19, 1.2, 5.0))
    drawn(view, stage)
    made = np.asarray(view.inks[1]._mesh.vertices).reshape(-1, FLOATS)
    colours = made[(made[:, 4] == 0) & (made[:, 5] > 0)][::4, 8:]
    roles = [theme.danger, theme.warn, theme.warn, theme.accent, theme.accent]
    assert colours == pytest.approx(np.array(roles))


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
        stage.window.remove_widget(fresh)


def test_of_more_beams_than_a_mesh_has_room_for_some_are_drawn(view, stage):
    view.show(sweep(*[2.0] * 30_000))
    assert len(dots(view, stage)) == 10_000


def test_a_sweep_that_changes_nothing_else_leaves_rings_and_words_alone(view, stage, monkeypatch):
    view.show(sweep(2.0, 3.0, 4.0))
    stage.frames(2)
    written = []
    monkeypatch.setattr(view._words, "write", written.append)
    view.show(sweep(2.1, 3.1, 4.0))
    stage.frames(2)
    assert not written
    view.show(sweep(2.1, 0.3, 4.0))
    stage.frames(2)
    assert len(written) == 1


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
        places = drawn(view, stage)[:, :2]
        assert (places >= 0).all()
        assert (places <= view.size).all()


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
    assert len(grounds) == 4 * len(view._words.texts)
    assert grounds.min() > np.flatnonzero(made[:, 4] == 0).max()


def test_an_alarm_shows_one_sign(view):
    view.show(sweep(2.0, 0.4, 3.0))
    view.state = "alarm"
    assert said(view) == ["FRONT LASER", "0.4 m"]


def test_a_sample_looks_the_same_when_it_is_built_again():
    for build in samples().values():
        assert tuple(build().size) == tuple(build().size)

from __future__ import annotations

import numpy as np

from sim.rendering.patterns import LEAVES_SIZE, leaves, web


def picture():
    return np.frombuffer(leaves(), dtype=np.uint8).reshape(LEAVES_SIZE, LEAVES_SIZE, 4)


def test_leaves_lie_at_every_depth_with_few_gaps_between_them():
    depth = picture()[:, :, 3]
    assert 0.4 < (depth > 128).mean() < 0.9
    assert (depth == 0).mean() < 0.15


def test_leaves_and_web_go_on_over_their_edges():
    grey = picture()[:, :, 0].astype(float)
    for pattern in (grey, web()):
        for axis in (0, 1):
            across = np.abs(np.take(pattern, 0, axis) - np.take(pattern, -1, axis)).mean()
            within = np.abs(np.diff(pattern, axis=axis)).mean()
            assert across < 2.0 * within


def test_the_web_has_bright_lines_between_dark_cells():
    bright = web()
    assert bright.min() >= 0.0
    assert bright.max() <= 1.0
    assert (bright > 0.7).mean() < 0.25
    assert (bright < 0.2).mean() > 0.3

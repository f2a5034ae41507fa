"""Every sample of every widget is drawn as the gallery draws it."""

from __future__ import annotations

from contextlib import contextmanager

import numpy as np
import pytest
from kivy.utils import get_color_from_hex

from examples.demo.frames import seldom_drawn
from widgets.core.base import RobotWidget
from widgets.core.theme import PALETTES, theme
from widgets.gallery import MARGIN, all_samples, finish_pictures, framed, write_pictures

SAMPLES = list(all_samples())
BLEED = 4
"""A smooth edge may reach so far beyond its widget [px]."""
AGE = 14
"""Beside the age of what is stale, which hangs half out below a small widget so that it lies over no figure [px]."""


@pytest.fixture(autouse=True)
def dark_afterwards():
    yield
    theme.name = "dark"


@contextmanager
def hung(stage, widgets):
    """All of them framed at once; the window itself is left out, for each is drawn into a picture of its own."""
    frames = {state: framed(widget) for state, widget in widgets.items()}
    with seldom_drawn(1000):
        for frame in frames.values():
            stage.window.add_widget(frame)
        stage.frames(4)
        for frame in frames.values():
            finish_pictures(frame)
        yield frames
        for frame in frames.values():
            stage.window.remove_widget(frame)
            frame.clear_widgets()


def off_ground(pixels, palette):
    ground = np.array(get_color_from_hex(PALETTES[palette]["surface"])[:3]) * 255
    return (np.abs(pixels - ground.round().astype(pixels.dtype)) > 8).any(-1)


def fault(widget, pixels, palette):
    """What is wrong with the picture of one sample, or None."""
    marks = off_ground(pixels, palette)
    if marks.mean() <= 0.002:
        return "shows nothing"
    outer = MARGIN - BLEED
    stale = isinstance(widget, RobotWidget) and widget.state == "stale"
    below = MARGIN - AGE if stale else outer
    marks[outer : marks.shape[0] - below, outer:-outer] = False
    return "leaves its place" if marks.any() else None


@pytest.mark.parametrize("title", dict.fromkeys(title for title, _, _ in SAMPLES))
def test_every_sample_shows_something_stays_in_its_place_and_looks_like_no_other(stage, title):
    widgets = {state: build() for kind, state, build in SAMPLES if kind == title}
    for palette in ("dark", "sunlight"):
        theme.name = palette
        faults, looks = {}, {}
        with hung(stage, widgets) as frames:
            for state, frame in frames.items():
                pixels = stage.pixels(frame)[..., :3].astype(np.int16)
                if found := fault(widgets[state], pixels, palette):
                    faults[state] = found
                looks.setdefault(pixels.tobytes(), []).append(state)
        assert faults == {}, palette
        assert not [states for states in looks.values() if len(states) > 1], palette


def test_the_gallery_writes_pictures_and_a_page(stage, tmp_path):
    pictures = write_pictures(tmp_path, "StopButton")
    assert len(pictures) == len(PALETTES) * len([t for t, _, _ in SAMPLES if t == "StopButton"])
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in pictures)
    assert "<img" in (tmp_path / "index.html").read_text(encoding="utf-8")

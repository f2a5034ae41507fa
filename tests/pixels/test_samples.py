"""Every sample of every widget is drawn as the gallery draws it."""

from __future__ import annotations

import numpy as np
import pytest
from kivy.utils import get_color_from_hex

from widgets.core.base import RobotWidget
from widgets.core.theme import PALETTES, theme
from widgets.gallery import MARGIN, all_samples, finish_pictures, framed, write_pictures

SAMPLES = list(all_samples())
NAMES = [f"{title}-{state}" for title, state, _ in SAMPLES]
BLEED = 4
"""A smooth edge may reach so far beyond its widget [px]."""
AGE = 14
"""Beside the age of what is stale, which hangs half out below a small widget so that it lies over no figure [px]."""


@pytest.fixture(params=["dark", "sunlight"])
def palette(request):
    theme.name = request.param
    yield request.param
    theme.name = "dark"


def drawn(stage, build):
    frame = framed(build())
    stage.window.add_widget(frame)
    stage.frames(4)
    finish_pictures(frame)
    return stage.pixels(frame)[..., :3].astype(np.int16)


def off_ground(pixels, palette):
    ground = np.array(get_color_from_hex(PALETTES[palette]["surface"])[:3]) * 255
    return (np.abs(pixels - ground) > 8).any(-1)


@pytest.mark.parametrize("build", [build for _, _, build in SAMPLES], ids=NAMES)
def test_every_sample_shows_something_and_stays_in_its_place(stage, palette, build):
    widget = build()
    marks = off_ground(drawn(stage, lambda: widget), palette)
    assert marks.mean() > 0.002
    outer = MARGIN - BLEED
    stale = isinstance(widget, RobotWidget) and widget.state == "stale"
    below = MARGIN - AGE if stale else outer
    marks[outer : marks.shape[0] - below, outer:-outer] = False
    assert marks.mean() == 0.0


@pytest.mark.parametrize("title", dict.fromkeys(title for title, _, _ in SAMPLES))
def test_the_states_of_a_widget_look_different(stage, title):
    looks = {}
    for _, state, build in (sample for sample in SAMPLES if sample[0] == title):
        looks.setdefault(drawn(stage, build).tobytes(), []).append(state)
        stage.clear()
    assert not [states for states in looks.values() if len(states) > 1]


def test_the_gallery_writes_pictures_and_a_page(stage, tmp_path):
    pictures = write_pictures(tmp_path, "StopButton")
    assert len(pictures) == len(PALETTES) * len([t for t, _, _ in SAMPLES if t == "StopButton"])
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in pictures)
    assert "<img" in (tmp_path / "index.html").read_text(encoding="utf-8")

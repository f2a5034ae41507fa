"""Fences of the OpenGL that really draws: a frame is through some time after it was drawn, and then stays so."""

from __future__ import annotations

import time

from kivy.uix.label import Label

from app.device import sdl_library
from app.device.gl_fences import GlFences
from tests.headless import Stage

PATIENCE = 10.0
"""A fault, not a delay, uses this up [s]."""


def test_a_frame_passes_its_fence(stage: Stage) -> None:
    fences = GlFences.of(sdl_library())
    assert fences is not None, "the software OpenGL of the tests has fences"
    stage.show(Label(text="42"), (200, 100))
    fence = fences.insert()
    assert fence is not None
    end = time.monotonic() + PATIENCE
    while not fences.passed(fence):
        assert time.monotonic() < end, "the frame is never through"
    assert fences.passed(fence)
    fences.delete(fence)

"""What of the glass is behind a camera, a round corner or the system's own bars: nothing to be touched or read goes there."""

from __future__ import annotations

import logging
import math
import os
from collections.abc import Mapping
from typing import Any, NamedTuple

from app.device import is_android

__all__ = ["NONE", "VARIABLE", "Insets", "beyond_content", "insets", "read_insets"]

log = logging.getLogger(__name__)

VARIABLE = "PILOTHOUSE_INSETS"
"""In the environment, for a computer that shall look like a phone: left, top, right and bottom [dp], as in `30,0,0,12`."""
MAX_INSET = 200.0
"""More is no edge of a phone [dp]."""


class Insets(NamedTuple):
    """From each edge of the glass inward [px]."""

    left: float
    top: float
    right: float
    bottom: float


NONE = Insets(0.0, 0.0, 0.0, 0.0)


def read_insets(text: str, density: float) -> Insets:
    """What VARIABLE says, in pixels of `density` to one dp; ValueError with a sentence for anything else."""
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != 4 or not all(math.isfinite(value) and 0 <= value <= MAX_INSET for value in values):
        raise ValueError(
            f"{VARIABLE} is four numbers of 0 to {MAX_INSET:.0f} dp: left,top,right,bottom; not {text!r}."
        )
    return Insets(*(value * density for value in values))


def beyond_content(safe: Insets, window: tuple[int, int], content: tuple[int, int, int, int]) -> Insets:
    """Of what the system keeps of its window of that width and height, what lies over the `content` at (x, y, width, height) [px]."""
    x, y, width, height = content
    margins = Insets(x, y, window[0] - x - width, window[1] - y - height)
    return Insets(*(max(0.0, float(kept - margin)) for kept, margin in zip(safe, margins, strict=True)))


def insets(density: float, environment: Mapping[str, str] = os.environ) -> Insets:
    """Of the glass now; `density` is one dp [px]. Zero on a computer, and where a phone does not tell."""
    if text := environment.get(VARIABLE, ""):
        try:
            return read_insets(text, density)
        except ValueError as mistake:
            log.warning("%s", mistake)
            return NONE
    if not is_android():
        return NONE
    try:
        return _of_android()
    except Exception as problem:  # noqa: BLE001 - whatever a phone answers, its whole glass is used then
        log.warning("The phone does not tell its safe area: %s", problem)
        return NONE


def _of_android() -> Insets:
    """Cutouts and bars, as far as they lie over what the app draws on."""
    from jnius import autoclass

    activity: Any = autoclass("org.kivy.android.PythonActivity").mActivity
    window = activity.getWindow().getDecorView()
    told = window.getRootWindowInsets()
    if told is None:
        return NONE
    bars = (
        told.getSystemWindowInsetLeft(),
        told.getSystemWindowInsetTop(),
        told.getSystemWindowInsetRight(),
        told.getSystemWindowInsetBottom(),
    )
    cutout = told.getDisplayCutout()
    behind = (
        (
            cutout.getSafeInsetLeft(),
            cutout.getSafeInsetTop(),
            cutout.getSafeInsetRight(),
            cutout.getSafeInsetBottom(),
        )
        if cutout is not None
        else (0, 0, 0, 0)
    )
    content = window.findViewById(autoclass("android.R$id").content)
    place = [0, 0]
    content.getLocationInWindow(place)
    safe = Insets(*(float(max(pair)) for pair in zip(bars, behind, strict=True)))
    size = (window.getWidth(), window.getHeight())
    return beyond_content(safe, size, (*place, content.getWidth(), content.getHeight()))

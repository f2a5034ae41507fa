"""How somebody wants to see a camera, as a URL says it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from bridge.core.topics import CAMERA

__all__ = ["CODECS", "BadViewError", "View", "view_of"]

CODECS: Mapping[str, tuple[str, ...]] = {
    "jpg": ("jpeg",),
    "png": ("png",),
    "mjpeg": ("jpeg",),
    "mp4": ("h264",),
    "webm": ("vp8", "vp9"),
    "whep": ("h264", "vp8"),
}
"""The codecs of each kind of picture or film, the one that counts where none is named first."""


class BadViewError(ValueError):
    """What was asked for does not exist; the text is one sentence."""


class View(NamedTuple):
    """How somebody wants to see a camera."""

    width: int | None = None
    """At most so many columns [px]; None as many as there are."""
    quality: int | None = None
    """Of the picture, 1 to 95; None as it comes from the camera, and for film what suits most."""
    rate: float = math.inf
    """At most so many pictures a second [Hz]."""
    topic: str = CAMERA
    """Of the camera's pictures."""
    codec: str = "jpeg"
    """One of `CODECS`."""


_LIMITS = {"width": (16, 4096), "quality": (1, 95), "rate": (0.1, 60)}


def view_of(query: Mapping[str, str], kind: str = "mjpeg") -> View:
    """The view that a URL's `width`, `quality`, `rate` and `codec` ask for; other words are refused.

    `kind` is one of `CODECS`. Raises BadViewError.
    """
    unknown = sorted(set(query) - {*_LIMITS, "codec"})
    if unknown:
        known = ", ".join((*_LIMITS, "codec"))
        raise BadViewError(f"A camera is asked for {known}, not {unknown[0][:20]!r}.")
    if kind == "png" and "quality" in query:
        raise BadViewError("A png picture loses nothing and has no quality.")
    asked = {name: _number(name, query[name]) for name in _LIMITS if name in query}
    width, quality, rate = asked.get("width"), asked.get("quality"), asked.get("rate", math.inf)
    return View(
        None if width is None else int(width),
        None if quality is None else int(quality),
        rate,
        codec=_codec(query.get("codec"), kind),
    )


def _codec(asked: str | None, kind: str) -> str:
    known = CODECS[kind]
    if asked is None:
        return known[0]
    if asked not in known:
        raise BadViewError(f"The codec of {kind} must be {' or '.join(known)}, not {asked[:20]!r}.")
    return asked


def _number(name: str, text: str) -> float:
    least, most = _LIMITS[name]
    try:
        value = float(text) if name == "rate" else int(text)
    except ValueError:
        value = math.nan
    if not least <= value <= most:
        kind = "a number" if name == "rate" else "a whole number"
        raise BadViewError(f"The {name} must be {kind} from {least} to {most}, not {text[:20]!r}.")
    return value

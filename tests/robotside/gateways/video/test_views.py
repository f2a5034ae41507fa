"""What a URL may ask of a camera."""

from __future__ import annotations

import math

import pytest

from robotside.gateways.video.views import CODECS, BadViewError, View, view_of


def test_without_words_everything_is_as_it_comes() -> None:
    assert view_of({}) == View(None, None, math.inf, codec="jpeg")
    assert [view_of({}, kind).codec for kind in CODECS] == ["jpeg", "png", "jpeg", "h264", "vp8", "h264"]


def test_words_are_read() -> None:
    asked = {"width": "320", "quality": "40", "rate": "7.5", "codec": "vp9"}
    assert view_of(asked, "webm") == View(320, 40, 7.5, codec="vp9")


@pytest.mark.parametrize(
    ("kind", "asked", "said"),
    [
        ("mp4", {"codec": "av1"}, "The codec of mp4 must be h264, not 'av1'."),
        ("mp4", {"codec": ""}, "The codec of mp4 must be h264, not ''."),
        ("webm", {"codec": "h264"}, "The codec of webm must be vp8 or vp9, not 'h264'."),
        ("webm", {"codec": "x" * 500}, f"The codec of webm must be vp8 or vp9, not '{'x' * 20}'."),
        ("mp4", {"width": "15"}, "The width must be a whole number from 16 to 4096, not '15'."),
        ("webm", {"quality": "96"}, "The quality must be a whole number from 1 to 95, not '96'."),
        ("mp4", {"rate": "61"}, "The rate must be a number from 0.1 to 60, not '61'."),
        ("jpg", {"widht": "320"}, "A camera is asked for width, quality, rate, codec, not 'widht'."),
        ("png", {"quality": "50"}, "A png picture loses nothing and has no quality."),
    ],
)
def test_what_cannot_be_is_one_sentence(kind: str, asked: dict[str, str], said: str) -> None:
    with pytest.raises(BadViewError) as fault:
        view_of(asked, kind)
    assert str(fault.value) == said

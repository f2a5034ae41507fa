"""The camera by URL in a real browser: every kind of stream plays, and what it shows is what the camera films."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from bench.support.station import serving
from tests.examples.chromium import Chromium
from tests.lacking import package

pytestmark = pytest.mark.slow

SHOW = """
document.body.innerHTML = '<img id="mjpeg" src="/stream/front.mjpeg?width=320">' + ['mp4', 'webm', 'webm?codec=vp9'].map(
    kind => `<video width="100" muted autoplay playsinline id="${kind}" src="/stream/front.${kind}${kind.includes('?') ? '&' : '?'}width=320"></video>`
).join('');
"""
CLOCK = """
(id => {
    const shown = document.getElementById(id), canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [320, 240];
    const drawn = canvas.getContext('2d');
    drawn.drawImage(shown, 0, 0, 320, 240);
    const bits = [...Array(32).keys()].map(
        bit => drawn.getImageData(10 + 20 * (bit % 16), 10 + 20 * (bit >> 4), 1, 1).data[1] > 127);
    return bits.reduce((sum, bit, place) => sum + bit * 2 ** place, 0);
})
"""
"""The clock that is painted into the picture that is shown [0.1 ms]."""


@pytest.fixture
def page(tmp_path: Path) -> Iterator[Chromium]:
    package("av")
    with serving("bench.support.filming") as robot, Chromium(tmp_path) as chromium:
        chromium.open(f"{robot.site}/healthz")  # the page itself plays nothing but MJPEG
        chromium.run(SHOW)
        yield chromium


def test_every_kind_of_stream_plays_in_the_size_that_was_asked_for(page: Chromium) -> None:
    page.until("document.getElementById('mjpeg').naturalWidth === 320")
    for kind in ("mp4", "webm", "webm?codec=vp9"):
        page.until(f"document.getElementById({kind!r}).videoWidth === 320")
        page.until(f"document.getElementById({kind!r}).getVideoPlaybackQuality().totalVideoFrames >= 20")
    for kind in ("mjpeg", "mp4", "webm", "webm?codec=vp9"):
        first = page.run(f"{CLOCK}({kind!r})")
        assert first > 0
        page.until(f"{CLOCK}({kind!r}) > {first}")

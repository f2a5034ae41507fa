"""Pictures made smaller, with real JPEG files."""

from __future__ import annotations

import asyncio
import io
import threading
from collections.abc import AsyncIterator
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

from bridge.core.errors import BridgeError
from robotside.gateways.scaling import picture_scaling as pictures
from robotside.gateways.scaling.picture_scaling import LEVELS, PictureScaler, Superseded, smaller


def photo(width: int = 640, height: int = 480) -> bytes:
    x, y = np.meshgrid(np.arange(width), np.arange(height))
    rough = np.random.default_rng(1).normal(0, 12, (height, width))
    rows = np.stack([x * 255 / width, y * 255 / height, 128 + rough], axis=2).clip(0, 255)
    file = io.BytesIO()
    Image.fromarray(rows.astype(np.uint8)).save(file, "JPEG", quality=80)
    return file.getvalue()


def size(jpeg: bytes) -> tuple[int, int]:
    return Image.open(io.BytesIO(jpeg)).size


PHOTO = photo()


@pytest.fixture
async def worker() -> AsyncIterator[PictureScaler]:
    made = PictureScaler()
    yield made
    await made.close()


async def test_each_level_is_at_most_two_thirds_of_the_one_before(worker: PictureScaler) -> None:
    made = [PHOTO, *[await worker.shrink(PHOTO, level) for level in range(1, len(LEVELS) + 1)]]
    assert all(len(b) < len(a) * 2 / 3 for a, b in pairwise(made))
    assert [size(jpeg) for jpeg in made] == [(640, 480), (640, 480), (320, 240), (240, 180)]


@pytest.mark.parametrize(
    ("width", "said"), [(320, (320, 240)), (333, (333, 250)), (1, (1, 1)), (9999, (640, 480))]
)
def test_a_width_keeps_the_shape_and_never_makes_a_picture_larger(width: int, said: tuple[int, int]) -> None:
    assert size(smaller(PHOTO, width, 80)) == said


def test_less_quality_is_fewer_bytes() -> None:
    assert len(smaller(PHOTO, None, 20)) < len(smaller(PHOTO, None, 50)) < len(PHOTO)


@pytest.mark.parametrize("bad", [b"", b"no picture", PHOTO[:-5000], b"GIF89a" + bytes(100)])
async def test_what_is_no_jpeg_is_one_sentence(worker: PictureScaler, bad: bytes) -> None:
    with pytest.raises(BridgeError, match="it is no whole JPEG file"):
        await worker.make(bad, 100)


def test_a_picture_that_claims_to_be_huge_is_not_read() -> None:
    claim = bytearray(PHOTO)
    at = claim.index(b"\xff\xc0")
    claim[at + 5 : at + 9] = (60000).to_bytes(2, "big") * 2
    with pytest.raises(BridgeError, match="not 60000 x 60000"):
        smaller(bytes(claim), 100, 80)


async def test_whoever_wants_the_same_shares_one_picture(
    worker: PictureScaler, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[object] = []
    monkeypatch.setattr(pictures, "smaller", lambda *wish: calls.append(wish) or b"small")
    assert await asyncio.gather(*(worker.make(PHOTO, 100, 50) for _ in range(5))) == [b"small"] * 5
    assert await worker.make(PHOTO, 101, 50) == b"small"
    assert len(calls) == 2


async def test_when_more_is_wanted_than_can_be_made_the_newest_are(
    worker: PictureScaler, monkeypatch: pytest.MonkeyPatch
) -> None:
    go = threading.Event()
    monkeypatch.setattr(pictures, "smaller", lambda jpeg, width, *_: go.wait(5) and b"%d" % width)
    wanted = [worker.make(PHOTO, width) for width in range(10, 18)]
    await asyncio.sleep(0)
    go.set()
    made = await asyncio.gather(*wanted, return_exceptions=True)
    assert [type(one) for one in made[:4]] == [Superseded] * 4
    assert made[4:] == [b"14", b"15", b"16", b"17"]


async def test_who_asks_once_waits_however_much_is_wanted(
    worker: PictureScaler, monkeypatch: pytest.MonkeyPatch
) -> None:
    go = threading.Event()
    monkeypatch.setattr(pictures, "smaller", lambda jpeg, width, *_: go.wait(5) and b"%d" % width)
    watched = [worker.make(PHOTO, 9), worker.make(PHOTO, 9, patient=True)]
    wanted = [worker.make(PHOTO, width, patient=width < 20) for width in range(10, 28)]
    passed_over = worker.make(PHOTO, 20, patient=True)
    await asyncio.sleep(0)
    go.set()
    made = await asyncio.gather(*wanted, return_exceptions=True)
    assert made[:10] == [b"%d" % width for width in range(10, 20)]
    assert [type(one) for one in made[10:]] == [Superseded] * 4 + [bytes] * 4
    assert await passed_over == b"20"
    assert await asyncio.gather(*watched) == [b"9", b"9"]


async def test_who_no_longer_waits_takes_nothing_from_the_others(worker: PictureScaler) -> None:
    first, second = worker.make(PHOTO, 100), worker.make(PHOTO, 100)
    first.cancel()
    assert size(await second) == (100, 75)


async def test_closing_ends_the_worker_and_what_waits() -> None:
    worker = PictureScaler()
    wanted = [worker.make(PHOTO, width) for width in (10, 20, 30)]
    await asyncio.sleep(0)
    await worker.close()
    ended = await asyncio.gather(*wanted, return_exceptions=True)
    assert any(isinstance(one, asyncio.CancelledError) for one in ended)


async def test_a_picture_as_png_is_every_pixel_as_it_was(worker: PictureScaler) -> None:
    as_jpeg, made = await asyncio.gather(worker.make(PHOTO, 320), worker.make(PHOTO, 320, form="PNG"))
    assert [Image.open(io.BytesIO(one)).format for one in (as_jpeg, made)] == ["JPEG", "PNG"]
    assert size(made) == (320, 240)
    whole = Image.open(io.BytesIO(await worker.make(PHOTO, form="PNG")))
    assert np.array_equal(np.asarray(whole), np.asarray(Image.open(io.BytesIO(PHOTO))))

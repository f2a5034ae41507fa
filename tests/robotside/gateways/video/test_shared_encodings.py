"""Films that several look at: one encoding, and nobody waits for another one."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import AsyncIterator, Callable, Iterator
from contextlib import contextmanager

import pytest

from bridge.msgs.sensor_msgs import CompressedImage
from robotside.gateways.video import newest_picture, shared_encodings
from robotside.gateways.video.film_file import Mp4File
from robotside.gateways.video.newest_picture import NewestPicture
from robotside.gateways.video.shared_encodings import FilmViewer, FullError, SharedEncodings
from robotside.gateways.video.video_encoder import Encoded, VideoEncoder
from robotside.gateways.video.views import View
from tests.lacking import package
from tests.robotside.gateways.video.scenes import numbered, seen

FILM = View(codec="h264")


async def until(holds: Callable[[], object]) -> None:
    async with asyncio.timeout(60):
        while not holds():  # noqa: ASYNC110  # what happens in a thread rings no bell here
            await asyncio.sleep(0.001)


class Camera:
    """Gives a picture to all who look, when the test says so."""

    def __init__(self) -> None:
        self.looking: list[NewestPicture] = []
        self.films = SharedEncodings(self._look)
        self.encoders: list[VideoEncoder] = []
        self.closed: list[VideoEncoder] = []
        self.tried = 0

    @contextmanager
    def _look(self, _: str) -> Iterator[NewestPicture]:
        newest = NewestPicture(lambda: 0.0)
        self.looking.append(newest)
        try:
            yield newest
        finally:
            self.looking.remove(newest)

    async def shoot(self, picture: bytes | int, viewer: FilmViewer | None = None) -> Encoded | None:
        """Take a picture; what the viewer gets of it."""
        await until(lambda: self.looking)
        async with asyncio.timeout(60):
            for newest in self.looking:
                data = numbered(picture) if isinstance(picture, int) else picture
                newest.on_picture("", CompressedImage(data=data))
            return await viewer.next() if viewer else None


@pytest.fixture
async def camera(monkeypatch: pytest.MonkeyPatch) -> AsyncIterator[Camera]:
    package("av")
    monkeypatch.setattr(shared_encodings, "MIN_KEY_PERIOD", 0.0)
    made = Camera()

    class Noted(VideoEncoder):
        def __init__(self, codec: str, width: int | None = None, quality: int | None = None) -> None:
            super().__init__(codec, width, quality)
            made.encoders.append(self)

        def encode(self, picture: bytes, taken: float, *, key: bool) -> list[Encoded]:
            made.tried += 1
            return super().encode(picture, taken, key=key)

        def close(self) -> None:
            made.closed.append(self)
            super().close()

    monkeypatch.setattr(shared_encodings, "VideoEncoder", Noted)
    threads = threading.active_count()
    yield made
    await made.films.close()
    assert made.looking == []
    assert {*made.closed} == {*made.encoders}
    assert len(made.closed) == len(made.encoders)
    assert threading.active_count() == threads


def whole(viewer: FilmViewer, pictures: list[Encoded | None]) -> list[int]:
    file = Mp4File()
    return [each.number for each in seen(viewer.head + b"".join(file.add(one) for one in pictures if one))]


async def test_all_who_want_the_same_share_one_encoding_and_each_begins_with_a_complete_picture(
    camera: Camera,
) -> None:
    with camera.films.watching(FILM) as first:
        early = [await camera.shoot(number, first) for number in (1, 2)]
        with camera.films.watching(FILM) as second:
            assert camera.films.count == len(camera.looking) == len(camera.encoders) == 1
            early.append(await camera.shoot(3, first))
            late = [await second.next()]
            early.append(await camera.shoot(4, first))
            late.append(await second.next())
            assert late == early[2:]  # the very same
            assert [one.key for one in early if one] == [True, False, True, False]
            assert whole(first, early) == [1, 2, 3, 4]
            assert whole(second, late) == [3, 4]


async def test_another_size_rate_quality_codec_or_camera_is_another_encoding(
    camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    others = [
        FILM._replace(width=80),
        FILM._replace(rate=5.0),
        FILM._replace(quality=9),
        FILM._replace(codec="vp8"),
    ]
    monkeypatch.setattr(shared_encodings, "MAX_ENCODINGS", len(others) + 1)
    with camera.films.watching(FILM):
        for number, view in enumerate(others):
            with camera.films.watching(view), camera.films.watching(FILM):
                assert len(camera.encoders) == number + 2
        with camera.films.watching(FILM._replace(topic="/camera/rear/image/compressed")):
            assert len(camera.encoders) == len(others) + 2


async def test_there_are_only_so_many_encodings_but_more_who_look_at_the_same(
    camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shared_encodings, "MAX_ENCODINGS", 1)
    with camera.films.watching(FILM), camera.films.watching(FILM):
        with pytest.raises(FullError, match="1 films that differ in camera"):
            camera.films.check(FILM._replace(width=80))
        camera.films.check(FILM)
    with camera.films.watching(FILM._replace(width=80)):
        pass


async def test_the_last_one_who_leaves_ends_the_encoding_and_the_camera_rests(camera: Camera) -> None:
    with camera.films.watching(FILM) as first:
        await camera.shoot(1, first)
        with camera.films.watching(FILM):
            pass
        assert camera.films.count == 1
    await until(lambda: camera.films.count == 0)
    await until(lambda: camera.closed == camera.encoders)
    assert camera.looking == []


async def test_who_leaves_while_a_picture_is_being_made_leaves_nothing_behind(
    camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, go = asyncio.Event(), threading.Event()
    loop, encode = asyncio.get_running_loop(), VideoEncoder.encode

    def slow(self: VideoEncoder, picture: bytes, taken: float, *, key: bool) -> list[Encoded]:
        loop.call_soon_threadsafe(begun.set)
        assert self not in camera.closed
        assert go.wait(60)
        assert self not in camera.closed
        return encode(self, picture, taken, key=key)

    monkeypatch.setattr(VideoEncoder, "encode", slow)
    with camera.films.watching(FILM):
        await camera.shoot(1)
        await begun.wait()
    await until(lambda: camera.films.count == 0)
    assert camera.closed == []  # the thread still works with it
    go.set()
    await until(lambda: camera.closed == camera.encoders)


async def test_who_reads_nothing_is_left_out_until_a_complete_picture_and_holds_up_nobody(
    camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shared_encodings, "MAX_QUEUED", 2)
    with camera.films.watching(FILM) as quick, camera.films.watching(FILM) as lazy:
        got = [await camera.shoot(number, quick) for number in range(6)]
        assert [one.key for one in got if one] == [True, False, False, True, False, False]
        assert whole(quick, got) == [0, 1, 2, 3, 4, 5]
        got.append(await camera.shoot(6, quick))
        assert [await lazy.next()] == got[-1:]  # what it had not fetched is gone, and it begins anew
        assert got[-1] is not None
        assert got[-1].key


async def test_who_was_left_out_gets_nothing_that_it_cannot_begin_with(
    camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shared_encodings, "MAX_QUEUED", 2)
    with camera.films.watching(FILM) as quick, camera.films.watching(FILM) as lazy:
        await camera.shoot(0, quick)
        monkeypatch.setattr(shared_encodings, "MIN_KEY_PERIOD", 3600.0)
        for number in range(1, 5):
            picture = await camera.shoot(number, quick)
            assert picture is not None
            assert not picture.key
        waiting = asyncio.create_task(lazy.next())
        await asyncio.sleep(0)
        assert not waiting.done()
        monkeypatch.setattr(shared_encodings, "MIN_KEY_PERIOD", 0.0)
        assert await camera.shoot(5, quick) is await waiting


async def test_viewers_who_come_and_go_do_not_make_every_picture_a_complete_one(
    camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shared_encodings, "MIN_KEY_PERIOD", 3600.0)
    with camera.films.watching(FILM) as stays:
        keys = []
        for number in range(5):
            with camera.films.watching(FILM):
                picture = await camera.shoot(number, stays)
                keys.append(picture is not None and picture.key)
    assert keys == [True, False, False, False, False]


async def test_a_complete_picture_comes_without_being_asked_for_too(
    camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shared_encodings, "KEY_PERIOD", 0.0)
    with camera.films.watching(FILM) as viewer:
        got = [await camera.shoot(number, viewer) for number in range(3)]
    assert [one.key for one in got if one] == [True, True, True]


async def test_a_broken_picture_is_left_out_and_the_film_goes_on(camera: Camera) -> None:
    with camera.films.watching(FILM) as viewer:
        got = [await camera.shoot(1, viewer)]
        await camera.shoot(b"no picture")
        await until(lambda: camera.tried == 2)
        got.append(await camera.shoot(2, viewer))
        assert whole(viewer, got) == [1, 2]


async def test_an_encoder_that_fails_ends_the_film_for_its_viewers_and_the_next_one_gets_a_new_one(
    camera: Camera, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def fail(*_: object, **__: object) -> list[Encoded]:
        raise MemoryError("no room for a picture")

    with camera.films.watching(FILM) as first, camera.films.watching(FILM) as second:
        await camera.shoot(1, first)
        await second.next()
        with monkeypatch.context() as broken:
            broken.setattr(VideoEncoder, "encode", fail)
            assert await camera.shoot(2, first) is None
            assert await second.next() is None
        assert "no room for a picture" in caplog.text
        with camera.films.watching(FILM) as third:
            assert whole(third, [await camera.shoot(3, third)]) == [3]
    assert len(camera.encoders) == 2


async def test_a_camera_that_gives_nothing_ends_the_film(
    camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(newest_picture, "PICTURE_TIMEOUT", 0.02)
    with camera.films.watching(FILM) as viewer:
        async with asyncio.timeout(60):
            assert await viewer.next() is None


async def test_the_end_of_the_robot_side_ends_a_film_that_somebody_looks_at(camera: Camera) -> None:
    with camera.films.watching(FILM) as viewer:
        await camera.shoot(1, viewer)
        await camera.films.close()
        assert await viewer.next() is None

"""Film made and played: what goes in comes out, in order."""

from __future__ import annotations

import io
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from PIL import Image

from bridge.core.errors import BridgeError
from robotside.gateways.video.film_file import Mp4File, WebmFile
from robotside.gateways.video.video_encoder import MAX_WIDTH, NoVideo, VideoEncoder
from tests.lacking import package
from tests.robotside.gateways.video.scenes import SHADES, numbered, seen

FILES = {"h264": Mp4File, "vp8": WebmFile, "vp9": WebmFile}
pytestmark = pytest.mark.usefixtures("_library")


@pytest.fixture(scope="module")
def _library() -> None:
    package("av")


@pytest.fixture(params=FILES)
def codec(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def encoder(codec: str) -> Iterator[VideoEncoder]:
    made = VideoEncoder(codec)
    yield made
    made.close()


def test_every_picture_comes_out_at_once_in_order_and_at_its_time(codec: str, encoder: VideoEncoder) -> None:
    file, film = FILES[codec](), b""
    for number in range(SHADES):
        [picture] = encoder.encode(numbered(number), 50.0 + number / 25, key=False)
        assert picture.key == (number == 0)
        film += (encoder.head if number == 0 else b"") + file.add(picture)
        pictures = seen(film)  # without one more picture, and without an end
        assert [each.number for each in pictures] == [*range(number + 1)]
    assert [each.at for each in pictures] == pytest.approx([number / 25 for number in range(SHADES)])
    assert {each.size for each in pictures} == {(160, 120)}


def test_who_joins_later_sees_the_film_from_the_next_complete_picture_on_as_its_beginning(
    codec: str, encoder: VideoEncoder
) -> None:
    early, late, film = FILES[codec](), None, b""
    for number in range(8):
        [picture] = encoder.encode(numbered(number), number / 10, key=number == 5)
        early.add(picture)
        if picture.key and number:
            late, film = FILES[codec](), encoder.head
        film += late.add(picture) if late else b""
    assert [(each.number, each.at) for each in seen(film)] == [(5, 0.0), (6, 0.1), (7, 0.2)]


@pytest.mark.parametrize(
    ("width", "made"), [(None, (160, 120)), (80, (80, 60)), (101, (100, 76)), (4096, (160, 120))]
)
def test_a_width_keeps_the_shape_and_never_makes_a_film_larger(
    codec: str, width: int | None, made: tuple[int, int]
) -> None:
    encoder = VideoEncoder(codec, width)
    [picture] = encoder.encode(numbered(3), 0.0, key=False)
    assert [each.size for each in seen(encoder.head + FILES[codec]().add(picture))] == [made]
    encoder.close()


def test_a_large_picture_becomes_a_film_of_a_size_that_one_core_can_make(codec: str) -> None:
    encoder = VideoEncoder(codec)
    [picture] = encoder.encode(numbered(3, 2000, 4000), 0.0, key=False)
    assert [each.size for each in seen(encoder.head + FILES[codec]().add(picture))] == [
        (MAX_WIDTH // 2, MAX_WIDTH)
    ]
    encoder.close()


def test_a_camera_that_changes_its_size_goes_on_in_the_size_of_the_film(
    codec: str, encoder: VideoEncoder
) -> None:
    file, film = FILES[codec](), b""
    for number, width in enumerate((160, 320, 64)):
        [picture] = encoder.encode(numbered(number, width, width * 3 // 4), number / 10, key=False)
        film += (encoder.head if number == 0 else b"") + file.add(picture)
    assert [(each.number, each.size) for each in seen(film)] == [(n, (160, 120)) for n in range(3)]


def test_less_quality_is_fewer_bytes(codec: str) -> None:
    noise = Image.effect_noise((160, 120), 60)
    file = io.BytesIO()
    noise.save(file, "JPEG", quality=90)
    sizes = []
    for quality in (5, 50, 95):
        encoder = VideoEncoder(codec, None, quality)
        sizes.append(sum(len(one.data) for one in encoder.encode(file.getvalue(), 0.0, key=False)))
        encoder.close()
    assert sizes[0] < sizes[1] < sizes[2]


@pytest.mark.parametrize(
    "bad",
    [
        b"",
        b"no picture",
        numbered(3)[:-200],
        numbered(3)[:300],
        numbered(3, 16, 16).replace(b"\0\x10\0\x10", b"\xff\xff\xff\xff", 1),
    ],
)
def test_a_picture_that_cannot_be_read_is_one_sentence_and_the_film_goes_on(
    codec: str, encoder: VideoEncoder, bad: bytes
) -> None:
    file = FILES[codec]()
    [first] = encoder.encode(numbered(1), 0.0, key=False)
    film = encoder.head + file.add(first)
    with pytest.raises(BridgeError, match=r"^[^\n]*\.\)?\.?$"):
        encoder.encode(bad, 0.1, key=False)
    [second] = encoder.encode(numbered(2), 0.2, key=False)
    assert [each.number for each in seen(film + file.add(second))] == [1, 2]


def test_a_png_of_a_foreign_camera_is_a_picture_too(codec: str, encoder: VideoEncoder) -> None:
    file = io.BytesIO()
    Image.new("RGB", (160, 120), (68, 68, 68)).save(file, "PNG")
    [picture] = encoder.encode(file.getvalue(), 0.0, key=False)
    assert [each.number for each in seen(encoder.head + FILES[codec]().add(picture))] == [4]


def test_two_pictures_of_one_moment_or_a_clock_that_stands_do_not_end_a_film(
    codec: str, encoder: VideoEncoder
) -> None:
    made = [encoder.encode(numbered(n), taken, key=False) for n, taken in enumerate((5.0, 5.0, 4.0, 5.1))]
    times = [picture.at for [picture] in made]
    assert times == sorted(set(times))


def test_h264_is_what_every_browser_plays(encoder: VideoEncoder, codec: str) -> None:
    [picture] = encoder.encode(numbered(1), 0.0, key=False)
    with package("av").open(io.BytesIO(encoder.head + FILES[codec]().add(picture))) as file:
        profile = file.streams.video[0].codec_context.profile
    assert profile == {"h264": "Constrained Baseline", "vp9": "Profile 0"}.get(codec)


def test_without_the_library_one_sentence_names_what_brings_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    with pytest.raises(NoVideo, match="PyAV is not installed; make video brings it"):
        VideoEncoder("h264")
    root = Path(__file__).parents[4]
    extras = tomllib.loads((root / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    assert any(each.startswith("av") for each in extras["video"])

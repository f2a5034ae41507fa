"""Camera frames on the wire."""

from __future__ import annotations

import io

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from bridge.core.camera_frames import (
    MAX_PIXELS,
    MAX_SCANS,
    MAX_SIDE,
    Frame,
    pack,
    pack_same,
    picture_size,
    sequence,
    unpack,
)
from bridge.core.errors import ProtocolError

SIZE = st.integers(0, 2**32 - 1)


@given(seq=SIZE, stamp=st.floats(allow_nan=False), jpeg=st.binary(max_size=64), width=SIZE, height=SIZE)
def test_a_frame_comes_back_unchanged(seq, stamp, jpeg, width, height):
    raw = pack(seq, stamp, jpeg, width, height)
    assert unpack(raw) == Frame(seq, stamp, width, height, jpeg)
    assert sequence(raw) == seq


def test_the_sequence_number_begins_anew_after_its_largest():
    assert sequence(pack(2**32 + 3, 0.0, b"", 1, 1)) == 3


@given(raw=st.binary(max_size=40).filter(lambda raw: raw[:4] != b"PHF1"))
def test_what_is_no_frame_is_a_protocol_error(raw):
    with pytest.raises(ProtocolError, match="must begin with b'PHF1'"):
        unpack(raw)


def test_a_frame_cut_off_in_its_header_is_a_protocol_error():
    with pytest.raises(ProtocolError):
        sequence(pack(1, 0.0, b"", 640, 480)[:-1])


# pictures that others made


def picture(kind: str, size: tuple[int, int], mode: str = "L", **more) -> bytes:
    out = io.BytesIO()
    Image.new(mode, size).save(out, kind, **more)
    return out.getvalue()


@pytest.mark.parametrize(
    "more", [{}, {"progressive": True}, {"comment": b"x" * 1000}, {"exif": b"Exif\0\0" + b"y" * 500}]
)
def test_the_size_of_a_jpeg_is_that_of_its_header(more):
    assert picture_size(picture("JPEG", (64, 32), **more)) == ("jpeg", 64, 32)


def test_the_size_of_a_png_is_that_of_its_header():
    assert picture_size(picture("PNG", (64, 32))) == ("png", 64, 32)


@pytest.mark.parametrize("kind", ["GIF", "BMP", "TIFF", "WEBP", "PPM", "ICO"])
def test_a_picture_of_another_format_is_refused(kind):
    with pytest.raises(ProtocolError, match="neither JPEG nor PNG"):
        picture_size(picture(kind, (64, 32)))


@pytest.mark.parametrize("kind", ["JPEG", "PNG"])
@pytest.mark.parametrize("size", [(MAX_SIDE + 1, 1), (1, MAX_SIDE + 1), (4097, 4096)])
def test_a_picture_that_would_take_all_memory_is_refused_by_its_header(kind, size):
    with pytest.raises(ProtocolError, match=f"not {size[0]} x {size[1]}"):
        picture_size(picture(kind, size)[:1000])


def test_the_largest_pictures_are_allowed():
    assert picture_size(picture("PNG", (4096, 4096))[:100]) == ("png", 4096, 4096)
    assert MAX_SIDE * 2048 == MAX_PIXELS


def test_a_jpeg_with_two_sizes_or_none_is_refused():
    jpeg = picture("JPEG", (64, 32))
    at = jpeg.index(b"\xff\xc0")
    header = jpeg[at : at + 2 + int.from_bytes(jpeg[at + 2 : at + 4], "big")]
    for bad in (jpeg[:at] + header + jpeg[at:], jpeg.replace(header, b""), jpeg[:at], b"\xff\xd8\xff"):
        with pytest.raises(ProtocolError, match="no whole JPEG"):
            picture_size(bad)


def test_a_jpeg_of_endless_scans_is_refused():
    jpeg = picture("JPEG", (64, 32))
    with pytest.raises(ProtocolError, match="at most 100 scans"):
        picture_size(jpeg + b"\xff\xda\x00\x08" * MAX_SCANS)


@given(st.sampled_from([b"\xff\xd8\xff", b"\x89PNG\r\n\x1a\n", b""]), st.binary(max_size=200))
def test_whatever_the_bytes_are_it_is_a_bounded_picture_or_refused(magic, data):
    try:
        kind, columns, rows = picture_size(magic + data)
    except ProtocolError:
        return
    assert kind in ("jpeg", "png")
    assert 0 < columns * rows <= MAX_PIXELS


def test_a_header_alone_stands_for_the_picture_before_it_with_a_stamp_of_its_own():
    before = Frame(1, 1.0, 640, 480, b"jpeg")
    after = unpack(pack_same(Frame(2, 1.1, 640, 480, b"left out")), before)
    assert after == Frame(2, 1.1, 640, 480, b"jpeg")
    assert after.jpeg is before.jpeg


@pytest.mark.parametrize("stamp", [1.0, 0.9, float("nan")])
def test_a_header_alone_that_is_no_newer_proves_no_new_picture(stamp):
    with pytest.raises(ProtocolError, match="not sent before"):
        unpack(pack_same(Frame(2, stamp, 640, 480, b"")), Frame(1, 1.0, 640, 480, b"jpeg"))


def test_a_header_alone_with_nothing_before_it_is_a_protocol_error():
    with pytest.raises(ProtocolError, match="not sent before"):
        unpack(pack_same(Frame(2, 1.0, 640, 480, b"")))

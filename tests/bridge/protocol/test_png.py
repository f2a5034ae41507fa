"""Operations in the pixels of a picture and back; PIL, which the servers in use write theirs with, is the judge."""

from __future__ import annotations

import base64
import contextlib
import io
import random
import struct
import tracemalloc
import zlib

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from PIL import Image

from bridge.core.errors import ProtocolError
from bridge.protocol import MAX_FILTERED_BYTES, Png, dump, parse, pixels, to_png

LIMIT = 1_000_000


def from_png(op, limit):
    """Without the line breaks that fill the picture up."""
    return pixels(op, limit)[0].rstrip(b"\n")


SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunk(name, content):
    return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))


def header(width=2, height=2, depth=8, colour=2, packing=0, filtering=0, interlace=0):
    return chunk(
        b"IHDR", struct.pack(">IIBBBBB", width, height, depth, colour, packing, filtering, interlace)
    )


def op(*chunks):
    return Png(data=base64.b64encode(SIGNATURE + b"".join(chunks)).decode())


def rows(kind, lines):
    return chunk(b"IDAT", zlib.compress(b"".join(bytes([kind]) + line for line in lines)))


END = chunk(b"IEND", b"")
PIXELS = rows(0, [b"abcdef", b"ghijkl"])


def image(op):
    return Image.open(io.BytesIO(base64.b64decode(op.data)))


@settings(max_examples=200, deadline=None)
@given(text=st.binary(max_size=300))
@example(text=b"")
@example(text=b"\n\n")
def test_a_text_comes_back_from_its_picture(text):
    assert from_png(to_png(text), LIMIT) == text.rstrip(b"\n")


@settings(max_examples=50, deadline=None)
@given(text=st.binary(max_size=300))
def test_the_picture_is_nearly_square_rgb_with_the_text_in_its_pixels(text):
    picture = image(to_png(text))
    assert picture.mode == "RGB"
    assert 0 <= picture.height - picture.width <= 2
    assert picture.tobytes() == text.ljust(3 * picture.width * picture.height, b"\n")


def test_it_travels_as_an_operation():
    sent = dump(to_png(b'{"op":"publish","topic":"/a"}'))
    assert from_png(parse(sent), LIMIT) == b'{"op":"publish","topic":"/a"}'


def as_servers_do(text, mode="RGB", **options):
    """Nearly square, filled up with line breaks, and written by PIL, which chooses a filter for each row."""
    width = max(1, int((len(text) / 3) ** 0.5))
    height = -(-len(text) // (3 * width))
    file = io.BytesIO()
    picture = Image.frombytes("RGB", (width, height), text.ljust(3 * width * height, b"\n"))
    picture.convert(mode).save(file, "png", **options)
    return Png(data=base64.b64encode(file.getvalue()).decode())


@pytest.mark.parametrize("mode", ["RGB", "RGBA"])
@pytest.mark.parametrize("length", [1, 2, 3, 4, 100, 20_000])
def test_what_the_servers_in_use_write_is_read(length, mode):
    generator = random.Random(length)
    text = b'{"ranges":[' + b",".join(b"%d.%03d" % (i % 9, generator.randrange(1000)) for i in range(length))
    assert from_png(as_servers_do(text[:length], mode), LIMIT) == text[:length]
    assert from_png(as_servers_do(text[:length], mode, optimize=True), LIMIT) == text[:length]


def filtered(kind, line, above, channels):
    """A row as the PNG specification (W3C, section 9) filters it, by its own formulas."""
    out = bytearray()
    for place, value in enumerate(line):
        a = line[place - channels] if place >= channels else 0
        b = above[place]
        c = above[place - channels] if place >= channels else 0
        p = a + b - c
        nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        out.append((value - (0, a, b, (a + b) // 2, nearest)[kind]) % 256)
    return bytes(out)


@pytest.mark.parametrize("colour", [2, 6])
@pytest.mark.parametrize("kind", range(5))
def test_each_filter_is_undone(kind, colour):
    generator = random.Random(kind)
    channels = {2: 3, 6: 4}[colour]
    lines = [generator.randbytes(7 * channels) for _ in range(6)]
    above = [bytes(7 * channels), *lines]
    packed = rows(kind, [filtered(kind, line, up, channels) for line, up in zip(lines, above, strict=False)])
    whole = b"".join(lines)
    rgb = whole if channels == 3 else bytes(value for place, value in enumerate(whole) if place % 4 != 3)
    assert from_png(op(header(7, 6, colour=colour), packed, END), LIMIT) == rgb.rstrip(b"\n")


def test_pixels_may_come_in_several_chunks_among_others():
    packed = zlib.compress(b"\0abcdef\0ghijkl")
    pieces = [chunk(b"IDAT", packed[:5]), chunk(b"IDAT", packed[5:])]
    assert from_png(op(header(), chunk(b"tEXt", b"a\0b"), *pieces, END), LIMIT) == b"abcdefghijkl"


DAMAGED = {
    "data must be base64": [Png(data="a"), Png(data="é")],
    "data must be a PNG file": [Png(data=""), Png(data="!!!"), Png(data="aGVsbG8="), Png(data="/9j/")],
    "the picture is cut off": [op(), op(header()), op(header(), PIXELS)],
    "the picture is damaged or cut off": [
        op(header(), PIXELS[:-1] + b"x", END),
        op(header(), b"\xff\xff\xff\xffIDAT" + b"x" * 20),
    ],
    "the picture has no header": [op(PIXELS, END), op(chunk(b"IHDR", b""), PIXELS, END), op(END)],
    "must be RGB or RGBA with 8 bits": [
        op(header(depth=16), PIXELS, END),
        op(header(colour=0), PIXELS, END),
        op(header(colour=3), PIXELS, END),
        op(header(interlace=1), PIXELS, END),
        op(header(packing=1), PIXELS, END),
        op(header(filtering=1), PIXELS, END),
    ],
    "1 to 1048576 pixels a side": [op(header(0, 5), PIXELS, END), op(header(5, 2**32 - 1), PIXELS, END)],
    "at most 1000000 bytes, not 3000000": [op(header(1000, 1000), PIXELS, END)],
    "the picture's pixels are damaged": [op(header(), chunk(b"IDAT", b"abc"), END)],
    "more or fewer pixels than its header says": [
        op(header(), END),
        op(header(2, 3), PIXELS, END),
        op(header(2, 1), PIXELS, END),
        op(header(), rows(0, [bytes(10_000_000)]), END),
    ],
    "a row's filter must be 0 to 4, not 5": [op(header(), rows(5, [b"abcdef", b"ghijkl"]), END)],
}


@pytest.mark.parametrize(
    ("reason", "bad"), [(why, bad) for why, all_bad in DAMAGED.items() for bad in all_bad]
)
def test_what_is_no_such_picture_is_refused_with_the_reason(reason, bad):
    with pytest.raises(ProtocolError, match=f"A png cannot be read: .*{reason}") as caught:
        from_png(bad, LIMIT)
    assert caught.value.op == "png"


def test_the_limit_counts_what_fills_the_picture_up():
    sent = to_png(b"x" * 10)
    assert from_png(sent, 12) == b"x" * 10
    with pytest.raises(ProtocolError, match="at most 11 bytes, not 12"):
        from_png(sent, 11)


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
def test_pixels_whose_restoring_takes_long_are_refused_before_it_begins(kind):
    width = MAX_FILTERED_BYTES // 3 // 64
    large = op(header(width, 65), rows(kind, [bytes(3 * width)] * 65), END)
    with pytest.raises(
        ProtocolError, match=f"at most {MAX_FILTERED_BYTES} bytes of it may stand in filtered rows"
    ):
        pixels(large, LIMIT)
    small = op(header(width, 64), rows(kind, [bytes(3 * width)] * 64), END)
    assert pixels(small, LIMIT)[1] == 3 * width * 64
    plain = op(header(width, 650), rows(0, [bytes(3 * width)] * 650), END)
    assert pixels(plain, 10 * LIMIT)[1] == 0


def test_of_a_picture_no_more_is_unpacked_than_its_header_says():
    bomb = rows(0, [bytes(30_000_000)])
    tracemalloc.start()
    with pytest.raises(ProtocolError, match="more or fewer pixels"):
        pixels(op(header(), bomb, END), LIMIT)
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 1_000_000


@settings(max_examples=300, deadline=None)
@given(data=st.data())
def test_nothing_but_a_protocol_error_comes_of_a_damaged_picture(data):
    good = bytearray(base64.b64decode(as_servers_do(b"hello world" * 30).data))
    for place in data.draw(st.lists(st.integers(8, len(good) - 1), min_size=1, max_size=4)):
        good[place] = data.draw(st.integers(0, 255))
    if data.draw(st.booleans()):  # mend the checksums, so that the damage gets further
        good = mended(bytes(good))
    with contextlib.suppress(ProtocolError):
        assert len(from_png(Png(data=base64.b64encode(good).decode()), 2000)) <= 2000


def mended(raw):
    out, place = raw[:8], 8
    while place + 12 <= len(raw):
        (length,) = struct.unpack_from(">I", raw, place)
        out += chunk(raw[place + 4 : place + 8], raw[place + 8 : place + 8 + min(length, len(raw))])
        place += 12 + length
    return out

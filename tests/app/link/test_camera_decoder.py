"""The camera's worker: JPEG in, RGBA out, and a damaged picture is skipped."""

from __future__ import annotations

import io
import struct
import threading
import zlib

import pytest
from PIL import Image

from app.link.camera_decoder import PICTURE, REFUSED, CameraDecoder, Decoder, _kivy, _pillow, best_decoder
from app.link.feeds import Mailbox
from bridge.core.camera_frames import Frame


def jpeg() -> bytes:
    """Left half red, right half blue, 64 x 32."""
    image = Image.new("RGB", (64, 32), (255, 0, 0))
    image.paste((0, 0, 255), (32, 0, 64, 32))
    out = io.BytesIO()
    image.save(out, "JPEG", quality=95)
    return out.getvalue()


def pillow() -> Decoder:
    return _pillow(Image)


@pytest.mark.parametrize("decode", [pillow(), best_decoder(), _kivy], ids=["pillow", "best", "kivy"])
def test_a_picture_becomes_rows_of_four_bytes_from_the_top(decode: Decoder) -> None:
    width, height, rgba = decode(jpeg())
    assert (width, height, len(rgba)) == (64, 32, 64 * 32 * 4)
    red, blue = rgba[:3], rgba[63 * 4 : 63 * 4 + 3]
    assert red[0] > 200 > 60 > red[2]
    assert blue[2] > 200 > 60 > blue[0]


def test_a_damaged_picture_is_skipped_and_counted() -> None:
    posted = threading.Event()
    mailbox = Mailbox(posted.set)
    camera = CameraDecoder(mailbox, pillow())
    camera.show(Frame(1, 5.0, 64, 32, b"no picture"), 1.0)
    camera.close()
    assert camera.bad == 1
    assert [channel for channel, _ in mailbox.drain()] == [REFUSED], "no picture"


def test_a_decoded_picture_keeps_its_stamp_and_when_it_came() -> None:
    posted = threading.Event()
    mailbox = Mailbox(posted.set)
    camera = CameraDecoder(mailbox, pillow())
    camera.show(Frame(7, 5.0, 128, 64, jpeg()), 1.25)
    camera.close()
    ((channel, post),) = mailbox.drain()
    assert (channel, post.received) == (PICTURE, 1.25)
    assert (post.value.seq, post.value.stamp, post.value.width, post.value.height) == (7, 5.0, 64, 32)
    assert post.value.taken == (128, 64)
    assert posted.is_set()


def test_a_picture_is_decoded_in_a_thread_of_its_own() -> None:
    threads: list[threading.Thread] = []

    def decode(data: bytes) -> tuple[int, int, bytes]:
        threads.append(threading.current_thread())
        return 1, 1, bytes(4)

    camera = CameraDecoder(Mailbox(lambda: None), decode)
    camera.show(Frame(1, 5.0, 1, 1, jpeg()), 1.0)
    camera.close()
    assert [thread is not threading.current_thread() for thread in threads] == [True]


def png() -> bytes:
    out = io.BytesIO()
    Image.new("RGB", (64, 32), (255, 0, 0)).save(out, "PNG")
    return out.getvalue()


@pytest.mark.parametrize("decode", [pillow(), best_decoder(), _kivy], ids=["pillow", "best", "kivy"])
def test_a_png_is_a_picture_too(decode: Decoder) -> None:
    width, height, rgba = decode(png())
    assert (width, height, len(rgba), rgba[:3]) == (64, 32, 64 * 32 * 4, b"\xff\0\0")


HUGE = "A picture has 1 to 8192 px a side and 16 megapixels at most, not 30000 x 20000."


def bomb(kind: str) -> bytes:
    """Few bytes that ask for a gigabyte and more: the size in the head of a small picture is another one."""
    small = png() if kind == "PNG" else jpeg()
    if kind == "PNG":
        head = b"IHDR" + struct.pack(">II", 30000, 20000) + small[24:29]
        return small[:12] + head + struct.pack(">I", zlib.crc32(head)) + small[33:]
    frame = small.index(b"\xff\xc0") + 5
    return small[:frame] + struct.pack(">HH", 20000, 30000) + small[frame + 4 :]


def gif() -> bytes:
    out = io.BytesIO()
    Image.new("L", (64, 32)).save(out, "GIF")
    return out.getvalue()


@pytest.mark.parametrize(
    ("data", "sentence"),
    [
        (bomb("PNG"), HUGE),
        (bomb("JPEG"), HUGE),
        (gif(), "The picture is neither JPEG nor PNG."),
        (jpeg()[:60], "The picture is no whole JPEG file."),
    ],
    ids=["png", "jpeg", "gif", "cut"],
)
def test_a_bomb_never_reaches_a_decoder_and_it_is_said_why(data: bytes, sentence: str) -> None:
    decoded: list[bytes] = []

    def decode(data: bytes) -> tuple[int, int, bytes]:
        decoded.append(data)
        return 1, 1, bytes(4)

    mailbox = Mailbox(lambda: None)
    camera = CameraDecoder(mailbox, decode)
    camera.show(Frame(1, 5.0, 1, 1, data), 1.0)
    camera.close()
    assert decoded == []
    assert [(channel, post.value) for channel, post in mailbox.drain()] == [(REFUSED, sentence)]


def test_a_stream_of_bad_pictures_makes_one_log_line_a_minute(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level("INFO", "app.link.camera_decoder")
    camera = CameraDecoder(Mailbox(lambda: None), pillow())
    for second in range(120):
        camera._work((Frame(second, 5.0, 1, 1, b"no picture"), float(second)))
    assert camera.bad == 120
    assert len([one for one in caplog.records if one.name == "app.link.camera_decoder"]) == 2


def test_the_very_file_of_the_last_picture_is_decoded_once_and_keeps_its_own_stamps() -> None:
    decoded = []

    def decode(file: bytes) -> tuple[int, int, bytes]:
        decoded.append(file)
        return 1, 1, bytes(4)

    came = threading.Semaphore(0)
    mailbox = Mailbox(came.release)
    camera, file, other = CameraDecoder(mailbox, decode), jpeg(), bytes(bytearray(jpeg()))
    shown = []
    for seq, each in enumerate((file, file, other, file)):
        camera.show(Frame(seq, float(seq), 64, 32, each), float(seq))
        assert came.acquire(timeout=10)
        shown += [post.value for channel, post in mailbox.drain() if channel == PICTURE]
    camera.close()
    assert [picture.stamp for picture in shown] == [0.0, 1.0, 2.0, 3.0]
    assert shown[1].rgba is shown[0].rgba
    assert decoded == [file, other, file]


def test_a_damaged_picture_that_comes_again_is_refused_again() -> None:
    mailbox = Mailbox(lambda: None)
    camera = CameraDecoder(mailbox, pillow())
    broken = jpeg()[:200]
    for seq in range(2):
        camera._work((Frame(seq, 1.0 + seq, 64, 32, broken), 1.0))
    camera.close()
    assert camera.bad == 2

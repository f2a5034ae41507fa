"""Makes pixels of camera frames, in a thread of its own; newest wins.

The robot, or whoever plays one, made the picture: its format and size are checked before any decoder sees it.
"""

from __future__ import annotations

import importlib
import importlib.util
import io
import logging
import math
from collections.abc import Callable
from dataclasses import dataclass

from app.core.newest_worker import NewestWorker
from app.link.feeds import Mailbox
from bridge.core.camera_frames import Frame, picture_size
from bridge.core.errors import ProtocolError
from widgets.core.language import mark, tr

__all__ = ["PICTURE", "REFUSED", "CameraDecoder", "Picture", "best_decoder"]

log = logging.getLogger(__name__)

PICTURE, REFUSED = "picture", mark("picture refused")
"""Channels of the mailbox with decoded pictures, and with why the last one was not decoded, in one sentence."""
LOG_PERIOD = 60.0
"""Between two log lines about pictures that were not decoded [s]."""
FORMATS = ("JPEG", "PNG")

Decoder = Callable[[bytes], tuple[int, int, bytes]]
"""A checked JPEG or PNG file to width [px], height [px] and RGBA rows from the top; ValueError or OSError for what is none."""


@dataclass(frozen=True, slots=True)
class Picture:
    """A decoded frame."""

    seq: int
    stamp: float
    """When it was taken [s], robot clock."""
    width: int
    height: int
    rgba: bytes
    """Rows from the top, four bytes a pixel."""
    taken: tuple[int, int] = (0, 0)
    """Width and height before it was made smaller on its way [px]; 0 when nobody says."""


def best_decoder() -> Decoder:
    """The fastest decoder that is installed: simplejpeg, else Pillow, else Kivy's own."""
    for module, decoder in (("simplejpeg", _simplejpeg), ("PIL.Image", _pillow)):
        if importlib.util.find_spec(module.partition(".")[0]) is not None:
            return decoder(importlib.import_module(module))
    return _kivy


def _simplejpeg(module: object) -> Decoder:
    def decode(jpeg: bytes) -> tuple[int, int, bytes]:
        if not jpeg.startswith(b"\xff\xd8"):
            return _kivy(jpeg)
        rows = module.decode_jpeg(jpeg, "RGBA")  # type: ignore[attr-defined]
        height, width = rows.shape[:2]
        return width, height, rows.tobytes()

    return decode


def _pillow(module: object) -> Decoder:
    def decode(jpeg: bytes) -> tuple[int, int, bytes]:
        with module.open(io.BytesIO(jpeg), formats=FORMATS) as image:  # type: ignore[attr-defined]
            rgb = image.convert("RGB")
        return rgb.width, rgb.height, rgb.tobytes("raw", "RGBX")

    return decode


def _kivy(jpeg: bytes) -> tuple[int, int, bytes]:
    from kivy.core.image import ImageLoader

    ext = "jpg" if jpeg.startswith(b"\xff\xd8") else "png"
    able = next(one for one in ImageLoader.loaders if one.can_load_memory() and ext in one.extensions())
    loaded = able(
        f"frame.{ext}", ext=ext, rawdata=io.BytesIO(jpeg), inline=True, nocache=True, keep_data=True
    )
    (data,) = loaded._data  # noqa: SLF001 - the public way makes a texture, which only the UI thread may
    pixels = data.data
    if data.fmt == "rgb":
        import numpy as np

        rows = np.frombuffer(pixels, np.uint8).reshape(-1, 3)
        pixels = np.hstack([rows, np.full((len(rows), 1), 255, np.uint8)]).tobytes()
    return data.width, data.height, bytes(pixels)


class CameraDecoder:
    """Takes frames, posts pictures."""

    def __init__(self, mailbox: Mailbox, decode: Decoder | None = None) -> None:
        """`decode` is the best one that is installed unless given."""
        self._mailbox, self._decode = mailbox, decode
        self._worker: NewestWorker[tuple[Frame, float]] = NewestWorker(self._work, "camera")
        self.bad = 0
        """Frames that were no picture, or too large a one."""
        self._said_at = -math.inf
        self._last: tuple[bytes, tuple[int, int, bytes]] | None = None
        """The file that was decoded last, and what came of it."""

    def show(self, frame: Frame, received: float) -> None:
        """Decode a frame that came at `received` [s], our clock; a newer one takes its place in the queue."""
        self._worker.put((frame, received))

    def close(self) -> None:
        """End the thread."""
        self._worker.close()

    def _work(self, item: tuple[Frame, float]) -> None:
        frame, received = item
        if self._decode is None:
            self._decode = best_decoder()
        try:
            width, height, rgba = self._pixels(frame.jpeg, self._decode)
        except ProtocolError as error:
            self._refuse(str(error), received)
            return
        except Exception as error:  # noqa: BLE001 - decoders raise what they like at a damaged picture
            self._refuse(tr("The picture is damaged."), received, error)
            return
        picture = Picture(frame.seq, frame.stamp, width, height, rgba, (frame.width, frame.height))
        self._mailbox.post(PICTURE, picture, received, urgent=True)

    def _pixels(self, file: bytes, decode: Decoder) -> tuple[int, int, bytes]:
        """The file as pixels; those of the last one for the very same file, which a camera gives that sees the same."""
        if self._last is None or self._last[0] is not file:
            self._last = None
            picture_size(file)
            self._last = file, decode(file)
        return self._last[1]

    def _refuse(self, sentence: str, received: float, error: Exception | None = None) -> None:
        self.bad += 1
        if received - self._said_at >= LOG_PERIOD:
            self._said_at = received
            log.info("%d frames were no picture; the last: %s %.200s", self.bad, sentence, error or "")
        self._mailbox.post(REFUSED, sentence, received)

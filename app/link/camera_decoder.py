"""Makes pixels of camera frames, in a thread of its own; newest wins."""

from __future__ import annotations

import importlib
import importlib.util
import io
import logging
from collections.abc import Callable
from dataclasses import dataclass

from app.core.newest_worker import NewestWorker
from app.link.feeds import Mailbox
from bridge.core.camera_frames import Frame

__all__ = ["PICTURE", "CameraDecoder", "Picture", "best_decoder"]

log = logging.getLogger(__name__)

PICTURE = "picture"
"""Channel of the mailbox with decoded pictures."""

Decoder = Callable[[bytes], tuple[int, int, bytes]]
"""JPEG to width [px], height [px] and RGBA rows from the top; ValueError or OSError for what is none."""


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
        rows = module.decode_jpeg(jpeg, "RGBA")  # type: ignore[attr-defined]
        height, width = rows.shape[:2]
        return width, height, rows.tobytes()

    return decode


def _pillow(module: object) -> Decoder:
    def decode(jpeg: bytes) -> tuple[int, int, bytes]:
        with module.open(io.BytesIO(jpeg)) as image:  # type: ignore[attr-defined]
            rgb = image.convert("RGB")
        return rgb.width, rgb.height, rgb.tobytes("raw", "RGBX")

    return decode


def _kivy(jpeg: bytes) -> tuple[int, int, bytes]:
    from kivy.core.image import ImageLoader

    able = next(one for one in ImageLoader.loaders if one.can_load_memory() and "jpg" in one.extensions())
    loaded = able("frame.jpg", ext="jpg", rawdata=io.BytesIO(jpeg), inline=True, nocache=True, keep_data=True)
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
        """Frames that were no picture."""

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
            width, height, rgba = self._decode(frame.jpeg)
        except Exception as error:  # noqa: BLE001 - decoders raise what they like at a damaged picture
            self.bad += 1
            log.info("frame %d is no picture: %s", frame.seq, error)
            return
        picture = Picture(frame.seq, frame.stamp, width, height, rgba, (frame.width, frame.height))
        self._mailbox.post(PICTURE, picture, received, urgent=True)

"""Pictures become film: H.264, VP8 or VP9, by PyAV, which is loaded when the first film is asked for."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Mapping
from fractions import Fraction
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

from bridge.core.camera_frames import picture_size
from bridge.core.errors import BridgeError
from robotside.core.installing import how_to_install

if TYPE_CHECKING:
    from av.video.frame import VideoFrame

__all__ = ["MAX_WIDTH", "TIME_SCALE", "BrokenPicture", "Encoded", "NoVideo", "VideoEncoder", "library"]

TIME_SCALE = 90_000
"""Ticks of a film's clock in a second."""

MAX_WIDTH = 1920
"""Columns, and rows, of a film: what is larger is made smaller [px]."""

DEFAULT_QUALITY = 60
"""Where none is asked for."""

_MAX_BIT_RATE = 8_000_000
_NEVER = 1_000_000
"""Pictures between complete ones; the owner says when there is to be one."""


class NoVideo(BridgeError):
    """The package that makes film is not installed."""


class BrokenPicture(BridgeError):
    """One picture cannot be read; the next one may."""


class Encoded(NamedTuple):
    """One picture of a film."""

    data: bytes
    """H.264 with each unit behind its length, 4 bytes; else the codec's own frame."""
    key: bool
    """It is complete: a film can begin with it."""
    at: int
    """When it is shown, in ticks of `TIME_SCALE` since the encoder's first picture; it grows with each."""
    taken: float
    """When it was taken, by the loop's clock [s]."""


class _Codec(NamedTuple):
    name: str
    form: str
    """Of the file that it is put into."""
    worst: float
    better: float
    """Its quantiser is `worst` less `better` for each step of quality."""
    options: Mapping[str, str]


_REALTIME = {"deadline": "realtime", "cpu-used": "8", "lag-in-frames": "0"}
_CODECS = {
    "h264": _Codec(
        "libx264",
        "mp4",
        51.0,
        0.36,
        {
            "preset": "ultrafast",
            "tune": "zerolatency",
            "profile": "baseline",
            "forced-idr": "1",
            "sc_threshold": "0",
        },
    ),
    "vp8": _Codec("libvpx", "webm", 63.0, 0.55, _REALTIME),
    "vp9": _Codec("libvpx-vp9", "webm", 63.0, 0.55, _REALTIME),
}
_FILES: Mapping[str, Mapping[str, str]] = {
    "mp4": {"movflags": "empty_moov+default_base_moof", "video_track_timescale": str(TIME_SCALE)},
    "webm": {"live": "1"},
}
_READERS = {"jpeg": "mjpeg", "png": "png"}


def library() -> ModuleType:
    """PyAV; NoVideo, in one sentence, where it is not installed."""
    try:
        import av
    except ImportError as missing:
        raise NoVideo(
            f"This robot makes no film: PyAV is not installed; {how_to_install('video')} brings it."
        ) from missing
    return av


class VideoEncoder:
    """One film of one size; belongs to one thread at a time. Fails with NoVideo when made without PyAV."""

    def __init__(self, codec: str, width: int | None = None, quality: int | None = None) -> None:
        """`codec` is h264, vp8 or vp9; at most `width` columns [px], None as many as the pictures have; `quality` 1 to 95."""
        av = library()
        self._av, self._codec, self._width = av, _CODECS[codec], width
        self._quality = DEFAULT_QUALITY if quality is None else quality
        self._readers = {kind: _reader(av, name) for kind, name in _READERS.items()}
        self._reformatter = av.video.reformatter.VideoReformatter()
        self._file: Any = None
        self._stream: Any = None
        self._begun = 0.0
        self._last = -1
        self.head = b""
        """What a file of this film begins with; empty before the first picture."""
        self.parameters = b""
        """H.264's parameter sets, each behind a start code; empty for other codecs and before the first picture."""

    def encode(self, picture: bytes, taken: float, *, key: bool) -> list[Encoded]:
        """`picture`, taken at that time [s], as a part of the film, complete when `key`; one as a rule.

        BrokenPicture for one that cannot be read, another exception when the film cannot go on.
        """
        frame = self._read(picture)
        if not self.head:
            self._open(frame.width, frame.height)
            self._begun, key = taken, True
        context = self._stream.codec_context
        frame = self._reformatter.reformat(
            frame,
            context.width,
            context.height,
            "yuv420p",
            interpolation="AREA",
            dst_color_range="MPEG",
        )
        self._last = max(self._last + 1, round((taken - self._begun) * TIME_SCALE))
        frame.pts, frame.time_base = self._last, Fraction(1, TIME_SCALE)
        types = self._av.video.frame.PictureType
        frame.pict_type = types.I if key else types.NONE
        return [self._encoded(packet, taken) for packet in context.encode(frame)]

    def close(self) -> None:
        """Let go of the codec's memory."""
        self._readers.clear()
        if self._file is not None:
            with contextlib.suppress(self._av.FFmpegError):  # a file without a picture has no proper end
                self._file.close()
            self._file = self._stream = None

    def _read(self, picture: bytes) -> VideoFrame:
        kind, _, _ = picture_size(picture)
        try:
            frames = self._readers[kind].decode(self._av.Packet(picture))
        except self._av.FFmpegError as fault:
            raise BrokenPicture(f"The picture cannot be read ({fault.strerror}).") from fault
        if len(frames) != 1:
            raise BrokenPicture("The picture is not whole.")
        frame: VideoFrame = frames[0]
        return frame

    def _open(self, columns: int, rows: int) -> None:
        part = min(1.0, (self._width or MAX_WIDTH) / columns, MAX_WIDTH / columns, MAX_WIDTH / rows)
        codec, file = self._codec, io.BytesIO()
        quantiser = round(codec.worst - codec.better * self._quality)
        self._file = self._av.open(file, "w", format=codec.form, options=dict(_FILES[codec.form]))
        self._stream = self._file.add_stream(
            codec.name, rate=30, options={**codec.options, "crf": str(quantiser)}
        )
        context = self._stream.codec_context
        context.width, context.height = _even(columns * part), _even(rows * part)
        context.pix_fmt = "yuv420p"
        context.color_range = self._av.video.reformatter.ColorRange.MPEG
        context.time_base = Fraction(1, TIME_SCALE)
        context.gop_size = _NEVER
        context.thread_count = 1
        if codec.form == "webm":
            context.bit_rate, context.qmin, context.qmax = _MAX_BIT_RATE, quantiser, quantiser
        self._file.start_encoding()
        self.head = file.getvalue()
        self.parameters = bytes(context.extradata or b"") if codec.form == "mp4" else b""

    def _encoded(self, packet: Any, taken: float) -> Encoded:
        data = bytes(packet)
        if self._codec.form == "mp4":
            data = _behind_lengths(data)
        return Encoded(data, packet.is_keyframe, packet.pts, taken)


def _reader(av: ModuleType, name: str) -> Any:
    reader = av.CodecContext.create(name, "r")
    reader.options = {"err_detect": "explode"}  # half a picture is none
    reader.thread_count = 1
    return reader


def _even(length: float) -> int:
    """Colours are kept for two columns and two rows at a time."""
    return max(2, round(length / 2) * 2)


_PARAMETERS_OR_DELIMITER = (7, 8, 9)
"""Kinds of units that stand in the head of a file and not among its pictures."""


def _behind_lengths(stream: bytes) -> bytes:
    """H.264 whose units stand behind start codes, with each behind its length."""
    parts: list[bytes] = []
    at = stream.find(b"\0\0\1")
    while at >= 0:
        begin = at + 3
        at = stream.find(b"\0\0\1", begin)
        end = len(stream) if at < 0 else at - (stream[at - 1] == 0)
        if stream[begin] & 31 not in _PARAMETERS_OR_DELIMITER:
            parts += (end - begin).to_bytes(4, "big"), stream[begin:end]
    return b"".join(parts)

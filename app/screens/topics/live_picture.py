"""A topic of pictures as a picture: decoded in a thread, newest wins."""

from __future__ import annotations

import math

from app.core.waking import wake_trigger
from app.link.camera_decoder import PICTURE, REFUSED, CameraDecoder, Picture
from app.link.feeds import Mailbox
from bridge.core.camera_frames import Frame
from bridge.msgs import Msg
from bridge.msgs.sensor_msgs import CompressedImage
from widgets import Video

__all__ = ["LivePicture"]


class LivePicture:
    """Everything here happens in the UI thread but for the decoding."""

    def __init__(self) -> None:
        self.video = Video(fit="contain", show_chip=False)
        self._mailbox = Mailbox(wake_trigger(self._drain))
        self._decoder: CameraDecoder | None = None

    @staticmethod
    def takes(kind: type[Msg] | None) -> bool:
        """Messages of that class are pictures."""
        return kind is not None and kind.MSGTYPE == CompressedImage.MSGTYPE

    def show(self, message: CompressedImage, received: float) -> None:
        """Have a picture that came at `received` [s], our clock, decoded and shown."""
        if self._decoder is None:
            self._decoder = CameraDecoder(self._mailbox)
        self._decoder.show(Frame(0, message.header.stamp.seconds, 0, 0, bytes(message.data)), received)

    def _drain(self) -> None:
        for channel, post in self._mailbox.drain():
            if self._decoder is None:  # the topic was left meanwhile
                continue
            if channel == PICTURE:
                picture: Picture = post.value
                self.video.show_frame(picture.width, picture.height, picture.rgba, picture.taken)
                self.video.refusal = ""
            elif channel == REFUSED:
                self.video.refusal = post.value

    def tick(self, state: str, age: float) -> None:
        """Be as old as the topic is."""
        self._drain()
        self.video.state = state
        if state == "stale" and math.isfinite(age):
            self.video.age = age

    def close(self) -> None:
        """End the thread."""
        decoder, self._decoder = self._decoder, None
        if decoder is not None:
            decoder.close()

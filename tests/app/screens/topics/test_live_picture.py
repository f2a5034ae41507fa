"""A topic of pictures as a picture."""

from __future__ import annotations

import io
import time
from typing import Any

from PIL import Image

from app.screens.topics.live_picture import LivePicture
from bridge.msgs.sensor_msgs import CompressedImage, Imu
from tests.app.glass import PATIENCE


def shown(picture: LivePicture, stage: Any, condition: Any) -> None:
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end
        stage.frames(1)
        picture.tick("live", 0.0)


def test_pictures_are_told_from_other_messages() -> None:
    assert LivePicture.takes(CompressedImage)
    assert not LivePicture.takes(Imu)
    assert not LivePicture.takes(None)


def test_a_picture_is_decoded_and_shown_and_one_that_is_none_is_said(stage: Any) -> None:
    picture = LivePicture()
    stage.show(picture.video, (300, 200))
    file = io.BytesIO()
    Image.new("RGB", (64, 48), (200, 30, 30)).save(file, "JPEG")
    picture.show(CompressedImage(format="jpeg", data=file.getvalue()), 10.0)
    shown(picture, stage, lambda: picture.video.picture_size[0] > 0)
    picture.show(CompressedImage(format="jpeg", data=b"no picture"), 11.0)
    shown(picture, stage, lambda: picture.video.refusal)
    picture.tick("stale", 4.0)
    assert (picture.video.state, picture.video.age) == ("stale", 4.0)
    picture.close()
    picture.close()

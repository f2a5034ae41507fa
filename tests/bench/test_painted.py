"""The painted clock comes back out of a picture, also out of a smaller and a worse one."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from bench.support import painted


@pytest.mark.parametrize("ticks", [0, 1, 0x8000_0000, 0xFFFF_FFFF, 0x1234_ABCD])
@pytest.mark.parametrize(("width", "quality"), [(640, 80), (320, 20)])
def test_the_clock_is_read_back(
    monkeypatch: pytest.MonkeyPatch, ticks: int, width: int, quality: int
) -> None:
    monkeypatch.setattr(painted, "_now", lambda: ticks)
    file = io.BytesIO()
    picture = Image.open(io.BytesIO(painted.paint(7))).resize((width, width * 3 // 4))
    picture.save(file, "JPEG", quality=quality)
    grey = np.asarray(Image.open(file).convert("L"))
    assert painted.read(grey) == ticks
    assert painted.age(grey) == 0.0

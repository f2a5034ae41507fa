"""What is told of voices that nothing was learnt from."""

from __future__ import annotations

import numpy as np
import pytest

from scripts.stop_word import telling
from scripts.stop_word.telling import SCENES, SPOKEN, SURE, _times, tell
from scripts.stop_word.windows import Voice
from tests.scripts.stop_word.test_windows import Ear, tone


def test_each_scene_has_a_line_with_a_figure_for_each_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(telling, "SECONDS", 10)
    voices = {"somebody": Voice([tone(2.0, 200)], [tone(0.5, 300)], [tone(0.4, 1000)], [])}
    lines = list(tell(voices, Ear(), lambda _: 2.2))  # type: ignore[arg-type]
    assert len(lines) == 1 + len(SCENES) + len(SPOKEN)
    heard = [float(word) for word in lines[1].removeprefix("heard alone").split()]
    assert heard == [float(sure < 2.2) for sure in SURE]
    false = [float(word) for word in lines[-1].removeprefix("false an hour in music").split()]
    assert [rate > 0 for rate in false] == [sure < 2.2 for sure in SURE]


def test_what_goes_on_is_told_once() -> None:
    looks = np.zeros(200, bool)
    looks[[3, 4, 5, 9, 60, 62]] = True
    assert _times(looks) == 2
    assert _times(np.zeros(50, bool)) == 0

"""The windows that are learnt from."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from scripts.stop_word.windows import SIZE, Drawer, Voice, _placed


class Ear:
    """It hears how loud each 20 ms are."""

    def __init__(self) -> None:
        self.heard: list[Any] = []

    def frames(self, wave: Any) -> Any:
        self.heard.append(wave)
        return np.abs(wave[: len(wave) // 320 * 320]).reshape(-1, 320).mean(axis=1)[:, None] * np.ones(
            (1, 144)
        )


def tone(seconds: float, pitch: float) -> Any:
    return np.sin(2 * np.pi * pitch * np.arange(int(16000 * seconds)) / 16000)


@pytest.fixture
def voices() -> dict[str, Voice]:
    somebody = Voice([tone(2.0, 200)], [tone(0.5, 300)], [tone(0.4, 1000)], [(tone(2.0, 1000), 16000)])
    return {"somebody": somebody, "other": somebody}


def test_as_many_windows_as_wanted_have_the_word(voices: dict[str, Voice]) -> None:
    drawer = Drawer(voices, {"somebody": 3.0, "other": 0.5}, (1,))
    windows, truth = drawer.windows(200, 0.3, Ear(), lambda _: 0.0)  # type: ignore[arg-type]
    assert windows.shape == (200, SIZE // 320, 144)
    assert windows.dtype == np.float16
    assert np.mean(truth) == pytest.approx(0.3, abs=0.1)


def test_what_is_known_already_is_drawn_less_often(voices: dict[str, Voice]) -> None:
    weights = {"somebody": 1.0, "other": 1.0}
    one, two = Ear(), Ear()
    Drawer(voices, weights, (1,)).windows(60, 0.0, one, lambda _: 0.0)  # type: ignore[arg-type]
    Drawer(voices, weights, (1,)).windows(60, 0.0, two, lambda _: -9.0)  # type: ignore[arg-type]
    assert len(one.heard) == 60
    assert len(two.heard) > 90


def test_the_same_seed_draws_the_same(voices: dict[str, Voice]) -> None:
    weights = {"somebody": 1.0, "other": 1.0}
    first, second = (Drawer(voices, weights, (4, 2)).windows(5, 0.5, Ear(), lambda _: 0.0) for _ in range(2))  # type: ignore[arg-type]
    assert (first[0] == second[0]).all()
    assert (first[1] == second[1]).all()


@pytest.mark.parametrize(("end", "at"), [(100, SIZE - 50), (SIZE + 4000, SIZE - 4000), (SIZE, SIZE), (3, 2)])
def test_a_word_ends_where_it_should(end: int, at: int) -> None:
    sound = np.arange(2.0 * SIZE)
    window = _placed(sound, end, at)
    assert len(window) == SIZE
    assert window[at - 1] == end - 1
    assert (np.diff(window[max(0, at - end) :]) == 1).all()


def test_many_who_talk_at_once_are_no_word(voices: dict[str, Voice]) -> None:
    sound = Drawer(voices, {"somebody": 1.0, "other": 1.0}, (3,)).babble(SIZE)
    spectrum = np.abs(np.fft.rfft(sound))
    high = int(700 * SIZE / 16000)
    assert spectrum[:high].max() > 20 * spectrum[high:].max()

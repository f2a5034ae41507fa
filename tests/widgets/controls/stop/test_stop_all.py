from __future__ import annotations

import pytest

from widgets.controls.stop.stop_all import StopAll


@pytest.fixture
def stop_all(stage):
    button = stage.show(StopAll(robots=3), size=(200, 64))
    button.heard = []
    button.bind(on_command=lambda _: button.heard.append("all"))
    return button


def test_it_commands_when_the_finger_comes_down_and_again_with_each_further_press(stage, stop_all):
    finger = stage.touch(100, 30)
    finger.touch_down()
    assert stop_all.heard == ["all"]
    finger.touch_up()
    stop_all.active = True
    stage.tap(100, 30)
    assert stop_all.heard == ["all", "all"]
    assert stop_all.pressed == 0


def test_a_finger_beside_it_commands_nothing(stage, stop_all):
    stage.tap(300, 30)
    assert stop_all.heard == []


@pytest.mark.parametrize(
    ("known", "words"),
    [
        ({"robots": 1}, ("STOP ALL", "1 robot")),
        ({"robots": 4}, ("STOP ALL", "4 robots")),
        ({"robots": 2, "lost": 1}, ("STOP ALL", "2 robots, 1 lost")),
        ({"robots": 12, "lost": 8, "silent": 3}, ("STOP ALL", "12 robots, 8 lost, 3 silent")),
        ({"width": 150, "robots": 12, "lost": 8, "silent": 3}, ("STOP ALL", "12 · 11 silent")),
        ({"active": True, "stopped": 2, "total": 3}, ("2 of 3", "STOPPED")),
    ],
)
def test_it_says_how_many_it_is_for_and_then_how_many_are_stopped(stop_all, known, words):
    for name, value in known.items():
        setattr(stop_all, name, value)
    assert (stop_all.word, stop_all.note) == words


def test_it_is_filled_until_all_are_stopped(stop_all):
    assert not stop_all.filled
    stop_all.active, stop_all.total = True, 3
    assert stop_all.filled
    stop_all.stopped = 3
    assert not stop_all.filled


@pytest.mark.parametrize("size", [(54, 106), (54, 68), (84, 68), (84, 76), (111, 54), (150, 54), (240, 64)])
@pytest.mark.parametrize("active", [True, False])
def test_its_words_stay_within_it(stage, stop_all, size, active):
    stop_all.size = size
    stop_all.active, stop_all.stopped, stop_all.total, stop_all.robots = active, 48, 50, 50
    stop_all.lost = 7
    stage.frames(2)
    for label in stop_all.children[0].children:
        assert label.texture_size[0] <= size[0] - 4
        assert label.font_size >= 14 or not label.text
    assert stop_all.children[0].height <= size[1]

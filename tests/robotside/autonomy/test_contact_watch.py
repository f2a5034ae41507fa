"""A touch of the bumper: which is told, and which is meant."""

from __future__ import annotations

import math
from types import SimpleNamespace

import pytest

from bridge.msgs.pilothouse_msgs import Bumper
from robotside.autonomy.contact_watch import ContactWatch
from robotside.tasks.behaviours.situation import Situation


class Touched:
    """A watch with what it pauses and says kept."""

    def __init__(self, *, drifts: bool, running: bool = False) -> None:
        self.situation, self.said, self.paused = Situation(), [], []
        engine = SimpleNamespace(running=running, pause=lambda why, _: self.paused.append(str(why)))
        estimator = SimpleNamespace(pose=None, on_bumper=lambda _: None)
        self.watch = ContactWatch(
            engine,  # type: ignore[arg-type]  # what it asks of an engine
            estimator,  # type: ignore[arg-type]  # likewise
            self.situation,
            lambda _, text, *__, **___: self.said.append(str(text)),
            kind="boat" if drifts else "wheels",
        )

    def touch(self, now: float = 100.0) -> list[str]:
        self.watch.on_bumper(Bumper(pressed=True, bearing=0.0), now)
        self.watch.on_bumper(Bumper(pressed=False, bearing=math.nan), now + 1.0)
        return self.said


@pytest.mark.parametrize(("drifts", "charging"), [(False, False), (False, True), (True, False)])
def test_a_touch_is_told(*, drifts: bool, charging: bool) -> None:
    on = Touched(drifts=drifts)
    on.situation.charging = charging
    assert on.touch() == ["The bumper touched something ahead."]


def test_what_waves_move_at_its_charger_touches_it_without_an_alarm() -> None:
    on = Touched(drifts=True)
    on.situation.charging = True
    assert on.touch() == []
    on.situation.charging = False
    assert len(on.touch(200.0)) == 1


@pytest.mark.parametrize("touches", [False, True])
def test_under_way_only_a_touch_that_the_task_means_is_none(*, touches: bool) -> None:
    on = Touched(drifts=True, running=True)
    on.situation.charging, on.situation.touches = True, touches
    assert (on.touch() == []) is touches
    assert (on.paused == []) is touches

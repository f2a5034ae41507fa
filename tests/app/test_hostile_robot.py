"""A robot that means ill, or whose memory is damaged: every topic full of nonsense, on the screens that people drive by.

What comes is handed to the session as the link hands it over. That nothing is raised is the proof: an exception ends the app.
"""

from __future__ import annotations

import math
import typing
from typing import Any

import msgspec
import pytest

from app.link.feeds import Post
from bridge.core.topics import TOPICS
from bridge.msgs import arrays
from tests.app.glass import Glass
from tests.widgets.map.watched_map import pose

NUMBERS = {"NaN": math.nan, "infinity": math.inf, "far too much": 1e308, "far too little": -1e308}
EVIL = "[b][color=ff0000]\u202eevil\u2066\n\t\0]]&bl;[ref=x]"
"""Markup, letters that turn the direction of writing, a new line and a zero."""
LONG = 2000
"""So many times that, in one text: some 80 kB."""
WHOLE = {"NaN": 0, "infinity": 2**31 - 1, "far too much": 255, "far too little": -(2**31)}
TOLD = [topic for topic in TOPICS if topic.to == "handheld"]


def nonsense(kind: Any, what: str, usual: Any = None) -> Any:
    """A value of that type, with the worst in each place."""
    if kind is float:
        return NUMBERS[what]
    if kind is bool:
        return True
    if kind is int:
        return WHOLE[what]
    if kind is str:
        return EVIL * (LONG if what == "far too much" else 1)
    if typing.get_origin(kind) is list:
        return [nonsense(typing.get_args(kind)[0], what) for _ in range(3)]
    if isinstance(kind, type) and issubclass(kind, msgspec.Struct):
        sound, hints = kind(), typing.get_type_hints(kind)
        return kind(
            **{name: nonsense(hints[name], what, getattr(sound, name)) for name in kind.__struct_fields__}
        )
    if isinstance(kind, type) and kind.__module__ == arrays.__name__ and "Float" in kind.__name__:
        return kind([NUMBERS[what]] * 3)
    return usual


@pytest.mark.slow
@pytest.mark.filterwarnings(
    "ignore::RuntimeWarning"
)  # numpy's word on numbers that overflow, which ends nothing
@pytest.mark.parametrize("what", NUMBERS)
@pytest.mark.parametrize("screen", ["drive", "mission"])
def test_no_message_of_any_topic_ends_the_app_or_holds_up_the_glass(
    driving: Glass, screen: str, what: str
) -> None:
    app, stage = driving.app, driving.stage
    app.show(screen)
    for topic in TOLD:
        app.session.deliver(topic.name, Post(nonsense(topic.type, what), app.session.now(), 1))
        stage.frames(1)
    stage.run_for(1.0)
    app.show("mission")
    app.session.deliver("/pose", Post(pose(1.0, 2.0), app.session.now(), 1))
    stage.frames(3)
    assert app.screens["mission"]._maps.shown.located, "what makes sense again is shown again"

"""Every screen in a language that shows what was not translated: all that is written comes from a catalogue, or is known by name."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest

from bridge.discovery.domain import discovery_domain
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass, running
from tests.headless import Stage
from tests.layout_lint.scenes import EVENTS, MESSAGES, PLACES, RUNS, feed, fill, scenes
from tests.layout_lint.spoken import Written, foreign, points
from tests.looped import looped
from widgets.core.language import PSEUDO, language, tr

GROUPS = tomllib.loads(Path(__file__).with_name("spoken.toml").read_text(encoding="utf-8"))["group"]
ALLOWED = {word for group in GROUPS for word in group["words"]}
SCENES = {scene for group in GROUPS for scene in group.get("scenes", ())}
"""Whole scenes that are in English."""


def strings(value: object) -> Iterator[str]:
    """All texts in a message."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for each in value.values():
            yield from strings(each)
    elif isinstance(value, list):
        for each in value:
            yield from strings(each)


def told() -> set[str]:
    """What the robot says by itself: names, and sentences without a code."""
    said: list[Any] = [*MESSAGES.values(), *EVENTS, *RUNS, *PLACES]
    return {
        text
        for one in said
        for text in strings(msgspec.to_builtins(one, enc_hook=lambda _: None))
        if len(text) > 2
    }


@pytest.fixture
def spoken(stage: Stage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Written]:
    """What an app writes on all its screens, in front of a robot that has something to say on each."""
    from app.garbage_collector import Collector

    monkeypatch.setattr(Collector, "step", lambda *_, **__: None)
    (tmp_path / "settings.json").write_text(f'{{"language": "{PSEUDO}"}}')
    robot, written = FakeRobot(), Written()
    try:
        with written.listening(), running(stage, tmp_path) as glass:
            glass.app.open(robot.url)
            glass.drives()
            fill(robot, glass)
            look(glass, written)
            yield written
    finally:
        robot.close()
        language.name = "en"


def look(glass: Glass, written: Written) -> None:
    for name, show, leave in scenes():
        written.scene = name
        feed(glass)
        show(glass)
        glass.stage.frames(4)
        leave(glass)


@pytest.mark.slow
def test_every_word_on_the_glass_comes_from_a_catalogue_and_every_figure_is_written_as_the_language_does(
    spoken: Written,
) -> None:
    known = {*told(), glass_name(), discovery_domain()}
    left = {
        (scene, text): words
        for text, scene in spoken.texts.items()
        if scene not in SCENES
        and (words := [word for word in foreign(text, known) if word not in ALLOWED and not data(word)])
    }
    assert len(spoken.texts) > 500
    figures = [
        f"[{scene}] {text!r}" for text, scene in spoken.texts.items() if scene not in SCENES and points(text)
    ]
    wrong = [f"[{scene}] {text!r}: {', '.join(words)}" for (scene, text), words in left.items()]
    assert [*figures, *wrong] == [], "\n".join([*figures, *wrong])


def glass_name() -> str:
    import socket

    return socket.gethostname()


def data(word: str) -> bool:
    """A topic, a type, an address, a path or an ending of files."""
    return any(sign in word.strip(".") for sign in "/_@") or word.startswith((".", "ws"))


def test_each_word_that_is_allowed_has_a_reason_and_is_named_once() -> None:
    assert all(group["reason"].endswith(".") and (group["words"] or group["scenes"]) for group in GROUPS)
    assert len(ALLOWED) == sum(len(group["words"]) for group in GROUPS)


@looped(
    ("text", "words"),
    [
        ("Hold to talk", ["Hold", "to", "talk"]),
        ("[b]Fake-1[/b]: [Chèçks~~]", ["e"]),
        ("R\u200aO\u200aB", ["ROB"]),
        ("12 km", []),
    ],
)
def test_a_word_that_came_from_no_catalogue_is_found(text: str, words: list[str]) -> None:
    assert [word for word in foreign(text, ["Fake-1"]) if word != "Chèçks"] == [
        word for word in words if word != "e"
    ]


def test_what_a_catalogue_has_is_not_found_and_a_figure_with_a_point_is() -> None:
    language.name = PSEUDO
    try:
        assert foreign(tr("Hold to talk")) == []
        assert (points("0.25 m at 127.0.0.1"), points("0,25 m")) == (["0.25"], [])
    finally:
        language.name = "en"

"""What takes more than a press opens a pad of steps: sticks drive for a moment, fields are typed into, maps have a cross."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any

import pytest
from kivy.uix.floatlayout import FloatLayout

from app.inputs.switch_access.window.finding import in_window
from app.inputs.switch_access.window.openings import PUSH_TIME, Openings
from tests.headless import Stage
from widgets import GridMap, Joystick, LiftLever, SlideToConfirm, StopButton
from widgets.parts.kit import TextField
from widgets.parts.sliders import Fader

SIZE = (412, 892)


@pytest.fixture
def app(stage: Stage) -> Any:
    """A page with STOP on it, and nothing of the rest of the app."""
    root = stage.show(FloatLayout(), SIZE)
    stop = StopButton(size_hint=(None, None), size=(180, 120), pos=(222, 10))
    root.add_widget(stop)
    corner = SimpleNamespace(button=SimpleNamespace(parent=None))
    return SimpleNamespace(root=root, shell=SimpleNamespace(stop=stop), corner=corner)


@pytest.fixture
def openings(app: Any) -> Iterator[Openings]:
    openings = Openings(app, lambda _: ["Office 12", "Lab"])
    yield openings
    openings.close()


@pytest.fixture
def put(app: Any, stage: Stage) -> Callable[..., Any]:
    def put(widget: Any, size: tuple[float, float] = (160, 160), pos: tuple[float, float] = (10, 140)) -> Any:
        widget.size_hint, widget.size, widget.pos = (None, None), size, pos
        app.root.add_widget(widget)
        stage.frames(2)
        return widget

    return put


def press(openings: Openings, stage: Stage, *names: str) -> None:
    for name in names:
        assert openings.pad is not None, f"{name} without a pad"
        openings.pad.dispatch("on_key", name)
        stage.frames(1)


def test_a_stick_drives_for_a_moment_at_each_press_and_is_at_rest_then(
    openings: Openings, stage: Stage, put: Callable[..., Any]
) -> None:
    stick, said = put(Joystick()), []
    stick.bind(on_command=lambda _, twist: said.append(twist.linear.x))
    openings.open("stick", stick, "Stick")
    press(openings, stage, "ahead")
    assert 0 < stick.forward < 1, "gently at first"
    stage.run_for(PUSH_TIME * 0.6)
    press(openings, stage, "ahead")
    stage.run_for(PUSH_TIME * 0.6)
    assert stick.forward > 0, "the second press goes on with it"
    stage.run_for(PUSH_TIME * 0.6)
    assert (stick.forward, stick.left, said[-1]) == (0.0, 0.0, 0.0)


def test_it_rests_as_soon_as_something_else_is_marked(
    openings: Openings, stage: Stage, put: Callable[..., Any]
) -> None:
    stick = put(Joystick())
    openings.open("stick", stick, "Stick")
    press(openings, stage, "slow", "left")
    assert stick.left == 1.0, "not gently any more"
    openings.rest()
    assert stick.left == 0.0


def test_a_pad_that_is_taken_away_leaves_nothing_pushed(
    openings: Openings, stage: Stage, put: Callable[..., Any]
) -> None:
    lever = put(LiftLever(), (70, 200))
    openings.open("stick", lever, "Lift")
    press(openings, stage, "ahead")
    assert lever.forward > 0
    lever.disabled = True
    openings.update()
    assert openings.pad is None
    assert lever.forward == 0.0


@pytest.mark.parametrize("place", [(10, 140), (230, 140), (120, 400), (10, 720)])
def test_no_pad_lies_over_stop_or_over_the_stick_that_it_works(
    place: tuple[float, float], app: Any, openings: Openings, stage: Stage, put: Callable[..., Any]
) -> None:
    stick = put(Joystick(), pos=place)
    openings.open("stick", stick, "Stick")
    stage.frames(3)
    assert openings.pad is not None
    left, low, right, top = in_window(openings.pad)
    assert left >= 0
    assert low >= 0
    assert right <= SIZE[0]
    assert top <= SIZE[1]
    assert not openings.pad.collide_widget(app.shell.stop)
    assert not openings.pad.collide_widget(stick)


def test_a_field_is_typed_into_with_the_words_that_the_app_knows(
    openings: Openings, stage: Stage, put: Callable[..., Any]
) -> None:
    field, entered = put(TextField(hint_text="Where"), (300, 60)), []
    field.bind(on_text_validate=lambda one: entered.append(one.text))
    openings.open("field", field, "Where")
    press(openings, stage, "capital", "lettero")
    assert field.text == "O"
    press(openings, stage, "letterf")
    assert field.text == "Of"
    press(openings, stage, "word0")
    assert field.text == "Office 12"
    press(openings, stage, "delete", "enter")
    assert entered == ["Office 1"]
    assert openings.pad is None


def test_the_cross_sets_a_point_carries_it_and_goes_on_beyond_the_edge(
    app: Any, openings: Openings, stage: Stage, put: Callable[..., Any]
) -> None:
    area = put(GridMap(state="live", mode="points"), (412, 600), (0, 200))
    added: list[tuple[float, float]] = []
    moved: list[tuple[int, float, float]] = []
    area.bind(on_add=lambda _, x, y: added.append((x, y)), on_move=lambda _, *what: moved.append(what))
    openings.open("map", area, "Map")
    press(openings, stage, "touch")
    (first,) = added
    area.waypoints = [first]
    press(openings, stage, "carry", "fine", "right", "right", "right", "fine", "up", "carry")
    ((index, x, y),) = moved
    assert index == 0
    assert x > first[0]
    assert y > first[1]
    seen = area.view
    press(openings, stage, *["left"] * 30)
    assert area.view != seen, "at the edge it is the map that moves"
    assert area.collide_point(*openings._area.cross.at)  # type: ignore[union-attr]
    press(openings, stage, "done")
    assert [type(one).__name__ for one in app.root.children if type(one).__name__ == "Crosshair"] == []


def test_a_slide_and_a_latched_stop_ask_once_more(
    app: Any, openings: Openings, stage: Stage, put: Callable[..., Any]
) -> None:
    slide, done = put(SlideToConfirm(text="take off"), (300, 60)), []
    slide.bind(on_confirm=lambda _: done.append("took off"))
    openings.open("slide", slide, "take off")
    press(openings, stage, "done")
    assert not done
    openings.open("slide", slide, "take off")
    press(openings, stage, "sure")
    assert done == ["took off"]
    app.shell.stop.phase = "stopped"
    app.shell.stop.bind(on_release_stop=lambda _: done.append("released"))
    openings.open("hold", app.shell.stop, "Release STOP")
    press(openings, stage, "sure")
    stage.run_for(0.5)
    openings.rest()  # the mark has gone back to its first place
    assert done == ["took off"], "it takes as long as with a finger"
    stage.run_for(1.0)
    assert done == ["took off", "released"]


def test_a_hold_takes_as_many_slow_frames_as_it_needs(app: Any, openings: Openings, stage: Stage) -> None:
    released: list[object] = []
    app.shell.stop.phase = "stopped"
    app.shell.stop.bind(on_release_stop=released.append)
    openings.open("hold", app.shell.stop, "Release STOP")
    press(openings, stage, "sure")
    stage.run_for(4.0, 0.3)
    assert released == [app.shell.stop]
    assert not app.shell.stop.pressed


def test_stop_ends_a_hold_that_would_release_it(app: Any, openings: Openings, stage: Stage) -> None:
    released: list[object] = []
    app.shell.stop.phase = "stopped"
    app.shell.stop.bind(on_release_stop=released.append)
    openings.open("hold", app.shell.stop, "Release STOP")
    press(openings, stage, "sure")
    stage.run_for(0.5)
    openings.halt()
    stage.run_for(1.5)
    assert not released


def test_a_hold_that_is_left_before_its_end_releases_nothing(
    app: Any, openings: Openings, stage: Stage
) -> None:
    released: list[object] = []
    app.shell.stop.phase = "stopped"
    app.shell.stop.bind(on_release_stop=released.append)
    openings.open("hold", app.shell.stop, "Release STOP")
    press(openings, stage, "sure")
    stage.run_for(0.5)
    openings.rest()
    openings.close()
    stage.run_for(1.5)
    assert not released


def test_a_fader_goes_in_steps(openings: Openings, stage: Stage, put: Callable[..., Any]) -> None:
    fader, said = put(Fader(value=0.5), (60, 200)), []
    fader.bind(on_change=lambda _, value: said.append(round(value, 2)))
    openings.open("fader", fader, "Speed")
    press(openings, stage, "more", "less", "less")
    assert said == [0.6, 0.5, 0.4]

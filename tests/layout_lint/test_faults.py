"""The judge of what lies on the glass: each kind of fault is found where it is, and nothing where all is well."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from kivy.metrics import mm
from kivy.uix.floatlayout import FloatLayout
from kivy.uix.label import Label
from kivy.uix.scrollview import ScrollView

from tests.headless import Stage
from tests.layout_lint.faults import KINDS, contrasts, faults
from widgets.core.theme import theme
from widgets.parts.kit import Card, QuietButton, Text

SIZE = (400, 300)


@pytest.fixture
def root(stage: Stage) -> Any:
    return stage.show(FloatLayout(), SIZE)


@pytest.fixture(autouse=True)
def dark_afterwards() -> Any:
    yield
    theme.name, theme.gloves = "dark", False


def button(x: float, y: float, width: float, height: float, text: str = "Go") -> QuietButton:
    made = QuietButton(text=text, size_hint=(None, None), pos=(x, y))
    made.size = width, height  # after its rule, which has a height of its own
    return made


def label(**kwargs: Any) -> Label:
    return Label(size_hint=(None, None), pos=(150, 100), **kwargs)


def scrolled(root: Any) -> None:
    roll = ScrollView(size_hint=(None, None), size=(200, 100))
    inner = FloatLayout(size_hint=(None, None), size=(200, 400))
    inner.add_widget(button(0, 80, 100, 60))
    roll.add_widget(inner)
    root.add_widget(roll)


def in_card(root: Any) -> None:
    card = Card(size_hint=(None, None), size=(60, 60), pos=(100, 100))
    card.add_widget(label(text="Longer than its card", size=(300, 20)))
    root.add_widget(card)


def covered(root: Any) -> None:
    root.add_widget(button(50, 50, 100, 60))
    root.add_widget(Card(floating=True, size_hint=(None, None), size=(100, 100), pos=(100, 60)))


LAYOUTS: dict[str, tuple[str, Callable[[Any], object]]] = {
    "a label that is smaller than its words": (
        "cut",
        lambda root: root.add_widget(label(text="Start the patrol", size=(40, 20))),
    ),
    "words over the edge of their card": ("cut", in_card),
    "words that end in dots": (
        "shortened",
        lambda root: root.add_widget(
            label(text="Start the patrol", size=(60, 20), shorten=True, text_size=(60, None))
        ),
    ),
    "a button of 9 mm": ("small", lambda root: root.add_widget(button(20, 20, mm(30), mm(9)))),
    "a button that is half beside the window": (
        "outside",
        lambda root: root.add_widget(button(360, 20, 80, 60)),
    ),
    "two buttons that share glass": (
        "overlap",
        lambda root: [root.add_widget(button(x, 20, 100, 60)) for x in (20, 100)],
    ),
    "a button under a card": ("overlap", covered),
}
WELL: dict[str, Callable[[Any], object]] = {
    "a button": lambda root: root.add_widget(button(20, 20, 100, 60)),
    "two side by side": lambda root: [root.add_widget(button(x, 20, 100, 60)) for x in (20, 120)],
    "one that is scrolled half out": scrolled,
    "a name that ends in dots": lambda root: root.add_widget(
        label(text="/camera/front/image", size=(60, 20), shorten=True, text_size=(60, None))
    ),
    "what is not drawn": lambda root: root.add_widget(label(text="Start the patrol", size=(9, 9), opacity=0)),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_what_is_wrong_is_found(stage: Stage, root: Any, layout: str) -> None:
    kind, lay = LAYOUTS[layout]
    lay(root)
    stage.frames(3)
    assert {fault.kind for fault in faults(root, SIZE)} == {kind}
    assert kind in KINDS


@pytest.mark.parametrize("layout", WELL)
def test_what_is_well_is_not_found(stage: Stage, root: Any, layout: str) -> None:
    WELL[layout](root)
    stage.frames(3)
    assert faults(root, SIZE) == []


def test_gloves_ask_for_twice_the_size(stage: Stage, root: Any) -> None:
    root.add_widget(button(20, 20, mm(12), mm(30)))
    stage.frames(3)
    assert faults(root, SIZE) == []
    theme.gloves = True
    assert [fault.kind for fault in faults(root, SIZE)] == ["small"]


@pytest.mark.parametrize(("role", "found"), [("text", False), ("ground", True)])
def test_a_text_that_is_hard_to_read_on_its_ground_is_found(
    stage: Stage, root: Any, role: str, found: bool
) -> None:
    text = Text(text="Hard to read", pos=(20, 20), size_hint=(None, None), width=200)
    text.color = theme.roles[role]
    root.add_widget(text)
    stage.frames(3)
    assert bool(contrasts(root, SIZE)) == found

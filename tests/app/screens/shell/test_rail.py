"""The button to talk among those of the navigation: there while voice is on, held and let go, in everybody's room."""

from __future__ import annotations

import pytest
from kivy.uix.label import Label

from app.layout import arrange
from app.layout.arrange import Rect
from app.screens.shell.rail import Rail
from tests.headless import Stage
from widgets.core.theme import theme
from widgets.parts.labels import FittedLabel

FORMS = {"tall": Rect(0, 0, 412, 137), "short": Rect(0, 0, 68, 312), "wide": Rect(0, 0, 76, 744)}


def rail(stage: Stage, form: str, talk: str) -> Rail:
    made = stage.show(Rail())
    made.arrange(FORMS[form], form, 1.0)
    made.show("drive", talk=talk)
    stage.frames(2)
    return made


@pytest.mark.parametrize("form", FORMS)
def test_it_is_there_only_while_voice_is_on(stage: Stage, form: str) -> None:
    made = rail(stage, form, "")
    assert made.ids.talk.parent is None
    made.show("drive", talk="ready")
    assert made.ids.talk.parent is made


@pytest.mark.parametrize("form", FORMS)
def test_no_button_lies_on_another(stage: Stage, form: str) -> None:
    made = rail(stage, form, "ready")
    places = [Rect(one.x + 0.5, one.y + 0.5, one.width - 1, one.height - 1) for one in made.children]
    assert not any(a.overlaps(b) for n, a in enumerate(places) for b in places[:n])


def test_on_a_wide_glass_it_is_larger_than_the_others(stage: Stage) -> None:
    made = rail(stage, "wide", "ready")
    assert made.ids.talk.height > 1.5 * made.ids.tasks.height


def test_it_tells_when_it_is_held_and_when_it_is_let_go(stage: Stage) -> None:
    made, told = rail(stage, "wide", "ready"), []
    made.bind(on_talk=lambda _, down: told.append(down), on_press=lambda _, name: told.append(name))
    touch = stage.touch(*made.ids.talk.center)
    touch.touch_down()
    stage.frames(30)
    assert told == [True]
    touch.touch_up()
    stage.frames(10)
    assert told == [True, False]


@pytest.mark.parametrize(
    ("talk", "words"),
    [("ready", "Hold to talk"), ("listening", "Listens"), ("loud", "Too loud"), ("wrong", "Hold to talk")],
)
def test_it_says_how_voice_stands(stage: Stage, talk: str, words: str) -> None:
    assert rail(stage, "tall", talk).ids.talk.text == words


@pytest.mark.parametrize("form", FORMS)
def test_it_is_raised_with_a_ground_and_a_border_and_is_as_large_as_a_finger_needs(
    stage: Stage, form: str
) -> None:
    talk = rail(stage, form, "ready").ids.talk
    assert talk.ground == "raised"
    assert talk.rim == "accent"
    assert min(talk.size) >= theme.target


@pytest.mark.parametrize("form", FORMS)
def test_everything_keeps_within_its_room_and_no_word_leaves_its_button(stage: Stage, form: str) -> None:
    made, room = rail(stage, form, "ready"), FORMS[form]
    assert all(room.holds(Rect(*one.pos, *one.size)) for one in made.children)
    for one in made.children:
        for label in (child for child in one.walk(restrict=True) if isinstance(child, Label)):
            assert label.texture_size[0] <= one.width, label.text


def test_an_upright_window_has_a_row_for_it_while_it_is_there() -> None:
    silent, talking = (arrange.shell(412, 892, talks=talks) for talks in (False, True))
    assert talking["nav"].height - silent["nav"].height >= 60
    assert talking["body"].y == talking["nav"].top


@pytest.mark.parametrize("form", FORMS)
def test_every_word_stays_off_the_edges_of_its_button(stage: Stage, form: str) -> None:
    made = rail(stage, form, "")
    for button in made.buttons:
        if button.parent is made:
            label = next(part for part in button.children if isinstance(part, FittedLabel))
            assert label.texture_size[0] <= button.width - 4, button.text


@pytest.mark.parametrize("form", FORMS)
def test_a_count_of_two_figures_leaves_most_of_its_icon_to_be_seen(stage: Stage, form: str) -> None:
    made = rail(stage, form, "")
    button = made.ids.tasks
    button.count = 16
    assert button.badge_pos[0] >= button.center_x + 6
    assert button.badge_pos[0] + button.badge_size[0] <= button.right


@pytest.mark.parametrize("form", ["tall", "short"])
def test_a_phone_has_five_tabs_at_most_and_the_last_leads_to_all_others(stage: Stage, form: str) -> None:
    made = rail(stage, form, "")
    told: list[str] = []
    made.bind(on_press=lambda _, name: told.append(name))
    order = sorted(made.children, key=lambda one: (one.x, -one.y))
    for button in order:
        stage.tap(*button.center)
    assert told == ["drive", "mission", "tasks", "panels", "more"]
    assert {made.ids[name] for name in told} == set(order)


@pytest.mark.parametrize(("form", "lit"), [("tall", "more"), ("short", "more"), ("wide", "setup")])
def test_a_screen_without_a_tab_of_its_own_lights_the_one_that_leads_to_it(
    stage: Stage, form: str, lit: str
) -> None:
    made = rail(stage, form, "")
    made.show("setup")
    assert [name for name, button in made.ids.items() if getattr(button, "active", False)] == [lit]

"""Editing of views: nothing ever overlaps, every change can be undone, and what cannot be is said in a sentence."""

from __future__ import annotations

from itertools import combinations

import pytest

from app.layout.panel_grid import FORMS, Place
from app.layout.views import MAX_PANELS, MAX_VIEWS, Panel, View, places_of
from app.profiles.view_editor import MAX_UNDO, EditError, ViewEditor

COMPASS = Panel("Compass", "/pose")
LASER = Panel("LaserScanView", "/scan")
STICK = Panel("Joystick")


@pytest.fixture
def editor() -> ViewEditor:
    return ViewEditor((View("A", (COMPASS, LASER, STICK)),))


def panels(editor: ViewEditor) -> tuple[Panel, ...]:
    return editor.views[0].panels


def apart(editor: ViewEditor) -> bool:
    return all(
        one == other or not one.overlaps(other)
        for form in FORMS
        for one, other in combinations(places_of(panels(editor), form), 2)
    )


def test_a_moved_panel_lies_where_it_was_put_and_the_others_make_room(editor: ViewEditor) -> None:
    editor.place(0, 0, "wide", Place(4, 1, 5, 5))
    assert places_of(panels(editor), "wide")[0] == Place(4, 1, 5, 5)
    assert apart(editor)
    assert panels(editor)[0].tall is None, "the other forms are arranged as before"


def test_a_panel_cannot_be_moved_off_the_grid(editor: ViewEditor) -> None:
    editor.place(0, 1, "tall", Place(-3, -1, 9, 2))
    assert places_of(panels(editor), "tall")[1] == Place(0, 0, 6, 2)


def test_a_new_panel_overlaps_none_that_was_put_by_hand(editor: ViewEditor) -> None:
    editor.place(0, 0, "wide", Place(0, 0, 12, 3))
    index = editor.add(0, COMPASS)
    assert panels(editor)[index].widget == "Compass"
    assert apart(editor)


def test_every_change_is_undone_and_done_again(editor: ViewEditor) -> None:
    before = [editor.views]
    for change in (
        lambda: editor.add(0, COMPASS),
        lambda: editor.place(0, 0, "wide", Place(5, 5, 3, 3)),
        lambda: editor.change(0, 1, title="Front"),
        lambda: editor.change(0, 1, hidden=True),
        lambda: editor.stack(0, 0, 1),
        lambda: editor.unstack(0, 1),
        lambda: editor.remove(0, 0),
        lambda: editor.add_view("B"),
        lambda: editor.rename_view(1, "C"),
        lambda: editor.remove_view(0),
    ):
        change()
        before.append(editor.views)
    for views in reversed(before[:-1]):
        editor.undo()
        assert editor.views == views
    assert not editor.can_undo
    assert not editor.changed
    for views in before[1:]:
        editor.redo()
        assert editor.views == views
    assert not editor.can_redo


def test_a_change_after_an_undo_forgets_what_was_undone(editor: ViewEditor) -> None:
    editor.change(0, 0, title="One")
    editor.undo()
    editor.change(0, 0, title="Two")
    assert not editor.can_redo


def test_of_very_many_changes_the_last_can_be_undone(editor: ViewEditor) -> None:
    for number in range(MAX_UNDO + 20):
        editor.change(0, 0, title=str(number))
    while editor.can_undo:
        editor.undo()
    assert panels(editor)[0].title == "19"


def test_a_change_that_changes_nothing_is_none(editor: ViewEditor) -> None:
    editor.change(0, 0, title="")
    assert not editor.can_undo


def test_a_stack_lies_in_one_place_and_moves_as_one(editor: ViewEditor) -> None:
    editor.stack(0, 0, 2)
    first, second = (index for index, one in enumerate(panels(editor)) if one.stack)
    assert {panels(editor)[first].widget, panels(editor)[second].widget} == {"Compass", "Joystick"}
    editor.place(0, second, "wide", Place(6, 2, 4, 4))
    places = places_of(panels(editor), "wide")
    assert places[first] == places[second] == Place(6, 2, 4, 4)
    assert apart(editor)


def test_the_first_of_a_stack_hands_its_place_on_when_it_goes(editor: ViewEditor) -> None:
    editor.place(0, 2, "wide", Place(2, 7, 4, 4))
    editor.stack(0, 0, 2)
    first = next(index for index, one in enumerate(panels(editor)) if one.stack)
    editor.remove(0, first)
    left = next(index for index, one in enumerate(panels(editor)) if one.stack)
    assert places_of(panels(editor), "wide")[left] == Place(2, 7, 4, 4)


def test_what_leaves_a_stack_lies_beside_it(editor: ViewEditor) -> None:
    editor.place(0, 0, "wide", Place(0, 0, 3, 3))
    editor.stack(0, 2, 0)
    editor.unstack(0, next(index for index, one in enumerate(panels(editor)) if one.widget == "Joystick"))
    assert apart(editor)
    assert len(set(places_of(panels(editor), "wide"))) == 3


@pytest.mark.parametrize(
    ("title", "sentence"), [("", "Enter a name for the view."), ("x" * 61, "has at most 60 letters")]
)
def test_a_view_needs_a_name_of_some_length(editor: ViewEditor, title: str, sentence: str) -> None:
    with pytest.raises(EditError, match=sentence):
        editor.rename_view(0, title)


def test_there_are_bounds_to_views_and_panels(editor: ViewEditor) -> None:
    for number in range(MAX_PANELS - 3):
        editor.add(0, Panel("Battery", f"/b{number}"))
    with pytest.raises(EditError, match="at most 40 panels"):
        editor.add(0, COMPASS)
    for number in range(MAX_VIEWS - 1):
        editor.add_view(str(number))
    with pytest.raises(EditError, match="at most 12 views"):
        editor.add_view("more")


def test_what_the_check_refuses_is_not_done() -> None:
    editor = ViewEditor((View("A", (STICK,)),), lambda view: "Two sticks." if len(view.panels) > 1 else "")
    with pytest.raises(EditError, match="Two sticks"):
        editor.add(0, STICK)
    assert panels(editor) == (STICK,)
    assert not editor.can_undo


def test_places_by_hand_are_forgotten_in_one_form_alone(editor: ViewEditor) -> None:
    editor.place(0, 0, "wide", Place(4, 4, 4, 4))
    editor.place(0, 0, "tall", Place(0, 6, 3, 3))
    editor.arrange(0, "wide")
    assert all(one.wide is None for one in panels(editor))
    assert panels(editor)[0].place("tall") == Place(0, 6, 3, 3)

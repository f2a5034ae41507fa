from __future__ import annotations

import math

import pytest

from bridge.msgs.geometry_msgs import Pose, PoseWithCovariance, PoseWithCovarianceStamped, Quaternion
from bridge.msgs.pilothouse_msgs import Place
from widgets.parts.choices import Segment
from widgets.parts.text_field import TextField
from widgets.tasks.place_form import PlaceForm
from widgets.tasks.place_list import SOME
from widgets.tasks.task_chooser import TaskTile


@pytest.fixture
def form(stage):
    form = PlaceForm(size_hint=(None, None), size=(388, 640), taken=["Lab"])
    form.show(SOME[0])
    stage.show(form)
    stage.frames(4)
    form.heard = []
    form.bind(on_command=lambda _, place: form.heard.append(place))
    return form


def tap(stage, form, kind, text):
    (part,) = (one for one in form.walk(restrict=True) if isinstance(one, kind) and one.text == text)
    stage.tap(*part.to_window(*part.center))
    stage.run_for(0.3)


def test_a_place_goes_in_and_out_unchanged(form):
    assert form.place == SOME[0]
    assert form.heard == []


def test_no_coordinate_is_asked_for(form):
    shown = [part.hint_text + part.text for part in form.walk(restrict=True) if isinstance(part, TextField)]
    assert not any("3.0" in text or text.lower() == "x" for text in shown)
    assert (form.place.x, form.place.y) == (SOME[0].x, SOME[0].y)


def test_kind_and_words_are_changed(stage, form):
    tap(stage, form, TaskTile, "Lab")
    form.ids.name.text = " Lab 2 "
    form.ids.note.text = "Goggles"
    last = form.heard[-1]
    assert (last.name, last.kind, last.note, last.id) == ("Lab 2", "lab", "Goggles", 1)


@pytest.mark.parametrize(
    ("name", "sentence"),
    [("  ", "Enter a name."), ("lab", "There is a lab already"), ("Office 12", "")],
)
def test_what_is_lacking_is_said(form, name, sentence):
    form.set(name=name)
    assert form.lacking.startswith(sentence) if sentence else form.lacking == ""


def test_a_dock_needs_a_direction_which_begins_with_the_robots(stage, form):
    tap(stage, form, TaskTile, "Dock")
    assert form.lacking == "Set the direction in which the robot docks."
    pose = PoseWithCovariance(pose=Pose(orientation=Quaternion.from_yaw(math.pi / 2)))
    form.show(PoseWithCovarianceStamped(pose=pose))
    tap(stage, form, Segment, "Faces one way")
    assert form.faces == "000°"
    assert form.place.yaw == pytest.approx(math.pi / 2)
    assert form.lacking == ""
    tap(stage, form, Segment, "Stands in any direction")
    assert math.isnan(form.place.yaw)


def test_a_name_is_cut_where_the_robot_would_cut_it(form):
    form.ids.name.text = "x" * 90
    assert len(form.place.name) == 60


def test_a_new_one_begins_empty(form):
    form.show(Place(x=1.0, y=2.0))
    assert [form.ids[name].text for name in ("name", "note", "tag")] == ["", "", ""]
    assert form.kind == "place"

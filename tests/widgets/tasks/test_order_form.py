from __future__ import annotations

import math

import pytest

from bridge.msgs.pilothouse_msgs import Mission, PlaceArray, RobotInfo, TaskOrder, Waypoint
from robotside.kinds.registry import described
from widgets.controls.heading_dial import HeadingDial
from widgets.core.quantities import quantities, read
from widgets.core.task_words import TASKS
from widgets.parts.buttons import PushButton
from widgets.parts.choices import Segment
from widgets.parts.rows import ListRow
from widgets.parts.stepper import Stepper, StepperEnd
from widgets.parts.text_field import TextField
from widgets.tasks.order_form import OrderForm
from widgets.tasks.order_numbers import FormRow
from widgets.tasks.place_list import SOME


@pytest.fixture
def form(stage):
    form = OrderForm(size_hint=(None, None), size=(388, 600), robot=RobotInfo(max_speed=0.8))
    form.show(PlaceArray(places=SOME))
    form.show(Mission(waypoints=[Waypoint(1.0, 2.0)]))
    stage.show(form)
    form.asked = []
    form.bind(on_command=lambda _, order: form.asked.append(order))
    return form


def of(form, kind):
    return [part for part in form.walk() if isinstance(part, kind)]


def tap(stage, form, kind, text):
    stage.frames(4)
    (part,) = (one for one in of(form, kind) if getattr(one, "text", getattr(one, "title", "")) == text)
    stage.tap(*part.to_window(*part.center))
    stage.run_for(0.4)


def choose(stage, form, caption, name):
    stage.frames(4)
    row = next(one for one in of(form, ListRow) if one.aside == caption)
    stage.tap(*row.to_window(*row.center))
    stage.run_for(0.4)
    form.list.search = name  # brings it into sight
    stage.frames(4)
    row = next(one for one in of(form, ListRow) if one.title == name)
    stage.tap(*row.to_window(*row.center))
    stage.run_for(0.4)


@pytest.mark.parametrize("task", TASKS)
def test_each_task_is_asked_for_and_says_something(stage, form, task):
    form.begin(task)
    stage.frames(3)
    assert form.order.task == task
    assert form.sentence.endswith(".")
    shown = {
        "message": any(field.hint_text == "Message for the person" for field in of(form, TextField)),
        "heading": bool(of(form, HeadingDial)),
    }
    for field, there in shown.items():
        assert there == (field in TASKS[task].fields)


def test_a_delivery_is_chosen_by_names_alone(stage, form):
    form.begin("deliver")
    assert not form.complete
    choose(stage, form, "From", "Office 12")
    assert form.sentence == "Choose where to bring it."
    choose(stage, form, "To", "Lab")
    assert form.complete
    assert form.asked[-1].places == ["Office 12", "Lab"]
    choose(stage, form, "Then on to", "Charger")
    assert form.asked[-1].places == ["Office 12", "Lab", "Charger"]
    assert form.asked[-1].goals == []


def test_a_place_that_may_be_left_open_can_be_opened_again(stage, form):
    form.show(TaskOrder(task="deliver", places=["Lab", "Office 12", "Charger"]))
    form.ask("then")
    tap(stage, form, PushButton, "Stay there")
    assert form.asked[-1].places == ["Lab", "Office 12"]


def test_a_tour_has_as_many_places_as_are_added(stage, form):
    form.begin("guide")
    for name in ("Reception", "Lab"):
        tap(stage, form, PushButton, "Add a place")
        form.list.search = name
        tap(stage, form, ListRow, name)
    assert form.asked[-1].places == ["Reception", "Lab"]
    form._drop(0)
    assert form.asked[-1].places == ["Lab"]


def test_back_leaves_the_list_of_places_first(form):
    form.begin("go_to")
    form.ask("to")
    assert form.back()
    assert not form.back()


def test_a_finger_on_the_dial_turns_it_and_does_not_scroll(stage, form):
    form.height = 260  # so that there is something to scroll
    form.begin("follow_heading")
    stage.frames(4)
    (dial,) = of(form, HeadingDial)
    x, y = dial.to_window(*dial.center)
    before = form.ids.roll.scroll_y
    stage.drag([(x, y + 20), (x + 40, y + 20), (x + 40, y)])
    assert form.ids.roll.scroll_y == before
    assert form.asked[-1].heading == pytest.approx(0.0)
    assert dial.words == "090°"


def test_speed_and_time_are_left_to_the_robot_until_they_are_set(stage, form):
    form.begin("follow_heading")
    stage.frames(4)
    assert math.isnan(form.order.speed)
    assert math.isnan(form.order.duration)
    speed, span = of(form, Stepper)
    assert (speed.figures, span.figures) == ("default", "until stopped")
    for _ in range(12):
        speed.count(1)
    assert form.asked[-1].speed == pytest.approx(0.8)
    span.count(3)
    assert form.asked[-1].duration == 180.0
    assert len(of(form, StepperEnd)) == 4


@pytest.mark.parametrize(("system", "sign"), [("metric", "m/s"), ("imperial", "mph"), ("nautical", "kn")])
def test_what_is_counted_in_the_shown_unit_is_asked_for_in_si(stage, form, system, sign):
    quantities.system = system
    try:
        form.begin("follow_heading")
        stage.frames(4)
        speed, _ = of(form, Stepper)
        for _ in range(3):
            speed.count(1)
        assert speed.figures.endswith(f" {sign}")
        assert form.asked[-1].speed == pytest.approx(read(speed.figures, "speed"), abs=1e-3)
        speed.count(50)
        assert form.asked[-1].speed == pytest.approx(0.8), "the robot's own limit holds in every unit"
        form.set(speed=0.5)
        assert form.order.speed == 0.5, "what was asked for before is not rounded to another unit"
        height = Stepper(kind="height", step=0.5, value=0.0, maximum=30.0)
        height.count(1)
        assert height.value == pytest.approx({"metric": 0.5, "imperial": 0.3048, "nautical": 0.5}[system])
    finally:
        quantities.system = "metric"


def test_the_reaction_to_an_intruder_is_told_apart(stage, form):
    heard = []
    form.bind(on_react=lambda _, reaction: heard.append(reaction))
    form.begin("patrol")
    tap(stage, form, Segment, "Circle it")
    assert heard == ["circle"]


def test_a_long_message_is_cut_where_the_robot_would_cut_it(stage, form):
    form.begin("guide")
    stage.frames(2)
    (field,) = of(form, TextField)
    field.text = "x" * 300
    assert len(form.order.message) == 200


def test_an_order_to_be_changed_keeps_its_number(form):
    form.show(TaskOrder(id=7, task="go_to", places=["Lab"]))
    assert form.order.id == 7
    form.begin("go_to")
    assert form.order.id == 0


def steppers(form):
    return {row.title: row.children[0] for row in of(form, FormRow) if isinstance(row.children[0], Stepper)}


def test_only_a_robot_that_climbs_is_asked_for_a_height_and_a_diver_for_a_depth(stage, form):
    form.begin("hold")
    assert "Height" not in steppers(form)
    form.robot = described(RobotInfo(kind="hexapod", max_climb=0.5))
    steppers(form)["Depth"].count(3)
    assert form.asked[-1].height == -1.5
    assert form.sentence == "Keeps its place in the water, 1.5 m deep, until you stop it."
    form.robot = described(RobotInfo(kind="quadrotor", max_climb=1.0))
    form.begin("take_off")
    steppers(form)["Height"].count(4)
    assert form.asked[-1].height == 2.0


def test_a_boat_is_asked_for_its_throttle_in_place_of_a_speed(form):
    form.robot = described(RobotInfo(kind="boat"))
    form.begin("follow_heading")
    rows = steppers(form)
    assert "Speed" not in rows
    rows["Throttle"].count(6)
    assert form.asked[-1].throttle == 0.6
    rows["Throttle"].count(-6)
    assert math.isnan(form.asked[-1].throttle)

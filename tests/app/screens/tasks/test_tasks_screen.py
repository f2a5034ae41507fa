"""Tasks with fingers: what is chosen reaches the robot as an order, and what the robot says is answered, edited, undone."""

from __future__ import annotations

from typing import Any

import pytest
from msgspec.structs import replace

from app.layout.rects import Rect
from bridge.msgs.geometry_msgs import Point, Pose, PoseWithCovariance, PoseWithCovarianceStamped
from bridge.msgs.pilothouse_msgs import (
    ControlStatus,
    Following,
    Mission,
    Place,
    RobotInfo,
    ScheduledTask,
    TaskOrder,
    TaskRun,
    TaskStatus,
    Waypoint,
)
from bridge.msgs.std_msgs import Time
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from widgets.core.task_words import TASKS
from widgets.parts.rows import ListRow
from widgets.tasks.place_list import SOME

LAB, OFFICE = SOME[2], SOME[0]
GO, PATROL = TaskOrder(id=3, task="go_to", places=["Lab"]), TaskOrder(id=4, task="patrol")


@pytest.fixture
def tasks(driving: Glass, robot: FakeRobot) -> Any:
    """Connected, in control, on the tasks screen of a robot that knows some places."""
    robot.know(*SOME)
    driving.app.show("tasks")
    screen = driving.app.screens["tasks"]
    driving.until(lambda: len(screen.places.places) == len(SOME), "no places")
    return screen


def asked(robot: FakeRobot, service: str) -> list[Any]:
    return [request for name, request in robot.asked if name == service]


def press(glass: Glass, screen: Any, name: str) -> None:
    button = screen.ids[name]
    glass.until(lambda: not button.disabled, f"{name} cannot be pressed")
    glass.tap(button)


def row(screen: Any, title: str) -> Any:
    return next(one for one in screen.walk(restrict=True) if isinstance(one, ListRow) and one.title == title)


# orders


def test_a_delivery_by_names_is_ordered_once_with_all_that_was_said(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    tasks.begin("deliver", ("Office 12", "Lab"))
    tasks.pane.form.set(message="For Ms. Weber")
    glass.stage.run_for(0.2)
    assert tasks.pane.sentence.startswith("Fetches at Office 12, brings it to Lab;")
    press(glass, tasks, "start")
    assert robot.until(lambda: asked(robot, "/task/start"))
    (request,) = asked(robot, "/task/start")
    order = request.order
    assert (order.task, order.places, order.message) == ("deliver", ["Office 12", "Lab"], "For Ms. Weber")
    assert request.command_id
    assert request.valid_for == 5.0


def test_nothing_can_be_started_before_it_is_complete(glass: Glass, tasks: Any) -> None:
    tasks.begin("deliver", ("Office 12",))
    glass.stage.run_for(0.2)
    assert tasks.ids["start"].disabled
    assert tasks.pane.sentence == "Choose where to bring it."


def test_what_keeps_start_grey_is_said_where_start_is(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    tasks.begin("guide", ("Lab",))
    status = TaskStatus(task_id=3, task="go_to", state="PAUSED", places=["Office 12"])
    robot.publish("/task/status", status)
    said = "Not now: Go to Office 12 is paused; end it, or queue this."
    glass.until(lambda: tasks.pane.sentence.endswith(said), tasks.pane.sentence)
    assert tasks.pane.sentence.startswith("Leads a person to Lab and reads out the notes. Does not wait:")
    assert tasks.ids["start"].disabled
    assert not tasks.ids["queue"].disabled
    robot.publish("/task/status", TaskStatus(task_id=3, task="go_to", state="CANCELED"))
    robot.publish("/following", Following(present=True))
    whole = "Leads a person to Lab, waits when no one follows, and reads out the notes."
    glass.until(lambda: tasks.pane.sentence == whole, tasks.pane.sentence)
    assert not tasks.ids["start"].disabled


def test_a_refusal_is_said_whole_and_what_was_chosen_stays(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    robot.refusals["/task/start"] = "Lab lies 3.2 m outside the fence; stay within it."
    tasks.begin("go_to", ("Lab",))
    press(glass, tasks, "start")
    said = "Refused: start go to Lab. Lab lies 3.2 m outside the fence; stay within it."
    glass.until(lambda: said in glass.banners(), glass.banners())
    assert tasks.pane.order.places == ["Lab"]


def test_a_patrol_sends_its_points_first_and_starts_when_they_are_stored(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    glass.app.session.mission.add(1.0, 2.0)
    tasks.begin("patrol")
    glass.stage.run_for(0.2)
    assert tasks.pane.sentence.endswith("The points on the map are sent to the robot first.")
    press(glass, tasks, "start")
    glass.until(lambda: asked(robot, "/task/start"), "not started")
    names = [name for name in robot.services() if name in ("/mission/set", "/task/start")]
    assert names == ["/mission/set", "/task/start"]


def test_a_patrol_whose_points_are_refused_does_not_start(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    robot.refusals["/mission/set"] = "Point 1 is in a wall."
    glass.app.session.mission.add(1.0, 2.0)
    tasks.begin("patrol")
    press(glass, tasks, "start")
    glass.until(lambda: any("Point 1 is in a wall." in text for text in glass.banners()), glass.banners())
    glass.stage.run_for(0.5)
    assert asked(robot, "/task/start") == []


def test_what_a_patrol_does_about_an_intruder_belongs_to_the_mission(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    robot.publish("/mission", Mission(waypoints=[Waypoint(1.0, 1.0)]))
    glass.until(lambda: glass.app.session.mission.state == "stored", "no mission")
    tasks.begin("patrol")
    tasks.pane.form.dispatch("on_react", "circle")
    press(glass, tasks, "start")
    glass.until(lambda: asked(robot, "/task/start"), "not started")
    assert asked(robot, "/mission/set")[0].mission.on_intruder == "circle"


def test_who_does_not_drive_cannot_order(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    tasks.begin("go_to", ("Lab",))
    robot.publish("/control/status", ControlStatus(driver="tablet-B", driver_id="b"))
    glass.until(lambda: tasks.ids["start"].disabled and tasks.ids["queue"].disabled, "still offered")


# what the robot asks


def test_a_question_is_over_every_screen_and_one_tap_answers_it(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    question = glass.app.shell.question
    status = TaskStatus(task_id=2, task="deliver", state="RUNNING", asks="Has it been picked up at Lab?")
    robot.publish("/task/status", status)
    for screen in ("tasks", "mission", "drive", "topics"):
        glass.app.show(screen)
        glass.until(lambda: question.parent is not None, f"not on {screen}")
    assert question.question == "Has it been picked up at Lab?"
    glass.stage.run_for(0.7)
    glass.tap(question.ids.answer)
    assert robot.until(lambda: "/task/confirm" in robot.services())
    robot.publish("/task/status", TaskStatus(task_id=2, task="deliver", state="RUNNING"))
    glass.until(lambda: question.parent is None, "still asked")


def test_a_refused_answer_is_said_on_the_card(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    robot.refusals["/task/confirm"] = "The robot asks nothing just now."
    robot.publish("/task/status", TaskStatus(task="deliver", state="RUNNING", asks="Has it been picked up?"))
    question = glass.app.shell.question
    glass.until(lambda: question.parent is not None, "not asked")
    glass.stage.run_for(0.7)
    glass.tap(question.ids.answer)
    glass.until(lambda: question.said == "The robot asks nothing just now.", question.said)


@pytest.mark.parametrize(("button", "service"), [("answer", "/task/resume"), ("discard", "/task/cancel")])
def test_a_task_that_was_cut_short_is_offered(
    glass: Glass, robot: FakeRobot, tasks: Any, button: str, service: str
) -> None:
    question = glass.app.shell.question
    robot.publish("/task/status", TaskStatus(task="deliver", state="INTERRUPTED", places=["Lab", "Office 9"]))
    glass.until(lambda: question.parent is not None, "not offered")
    assert question.question == "Continue? Deliver: Lab → Office 9"
    glass.stage.run_for(0.7)
    glass.tap(question.ids[button])
    assert robot.until(lambda: service in robot.services())


# the queue


def test_a_task_is_added_dragged_deleted_and_brought_back(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    robot.wait_for(GO, PATROL)
    queue = tasks.now.queue
    glass.until(lambda: len(queue.orders) == 2, "no queue")
    tasks.begin("hold")
    press(glass, tasks, "queue")
    glass.until(lambda: len(robot.queue.orders) == 3 and not queue.waits, "not added")
    queue.dispatch("on_command", "move", 2, 0)
    glass.until(
        lambda: [order.task for order in robot.queue.orders] == ["hold", "go_to", "patrol"], "not moved"
    )
    glass.until(lambda: not queue.waits, "not confirmed")
    queue.remove(1)
    glass.until(lambda: [order.task for order in robot.queue.orders] == ["hold", "patrol"], "not deleted")
    glass.until(lambda: not queue.waits and not tasks.now.ids.undo.disabled, "cannot be undone")
    glass.tap(tasks.now.ids.undo)
    glass.until(
        lambda: [order.task for order in robot.queue.orders] == ["hold", "go_to", "patrol"], "not back"
    )


def test_a_queue_that_changed_meanwhile_is_shown_as_it_is(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    robot.wait_for(GO, PATROL)
    queue = tasks.now.queue
    glass.until(lambda: len(queue.orders) == 2, "no queue")
    robot.refusals["/task/queue/set"] = "The queue has changed since; look at it again."
    queue.remove(0)
    glass.until(lambda: any("has changed since" in text for text in glass.banners()), glass.banners())
    assert [order.task for order in queue.orders] == ["go_to", "patrol"]


def test_a_queue_that_waits_goes_on_when_told(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    robot.wait_for(GO)
    main = tasks.now.ids.main
    glass.until(lambda: main.text == "Go on with this" and not main.disabled, main.text)
    assert tasks.now.queue.held == ""
    robot.publish("/task/queue", replace(robot.queue, held="the robot's computer was restarted"))
    glass.until(lambda: tasks.now.queue.held, "not said to wait")
    glass.stage.run_for(0.6)
    glass.tap(main)
    assert robot.until(lambda: "/task/resume" in robot.services())


def test_what_charges_can_be_sent_on_now_or_told_to_stay(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    said = "Charging at Dock, 54%, goes on at 80% in about 12 min."
    charging = TaskStatus(task_id=3, task="patrol", state="RUNNING", phase="charging", reason=said)
    robot.publish("/task/status", charging)
    now = tasks.now
    glass.until(lambda: now.ids.main.text == "Go on now" and not now.ids.main.disabled, now.ids.main.text)
    glass.stage.run_for(0.6)
    assert now.card.reason == said
    glass.tap(now.ids.main)
    assert robot.until(lambda: "/task/confirm" in robot.services())
    glass.tap(now.ids.stay)
    assert robot.until(lambda: "/task/pause" in robot.services())
    robot.publish("/task/status", replace(charging, phase="driving", reason="Heading for point 2."))
    glass.until(lambda: now.ids.main.text == "Pause", now.ids.main.text)
    assert now.ids.stay.parent is None


# the schedule


def test_a_task_is_scheduled_switched_off_and_taken_off(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    tasks.tab = "schedule"
    tasks.open_scheduled(None)
    tasks.pane.begin("go_to", ("Lab",))
    tasks.pane.when.choose(hour=7, minute=30, days=[True] * 5 + [False] * 2)
    glass.stage.run_for(0.2)
    assert tasks.pane.sentence == "07:30, Mon to Fri: Goes to Lab and stays there."
    press(glass, tasks, "save")
    glass.until(lambda: len(tasks.schedule.tasks) == 1, "not scheduled")
    task = robot.schedule[0]
    assert (task.at, list(task.days), task.order.places) == ("07:30", [True] * 5 + [False] * 2, ["Lab"])
    tasks.schedule.dispatch("on_command", ScheduledTask(task.id, False, task.order, task.at, task.days))
    glass.until(lambda: not robot.schedule[0].enabled, "not switched off")
    tasks.open_scheduled(robot.schedule[0])
    press(glass, tasks, "unschedule")
    glass.until(lambda: robot.schedule == [], "not deleted")
    glass.until(lambda: any(text == "Deleted: Go to Lab." for text in glass.banners()), glass.banners())
    glass.app.shell.ids.notices.children[0].act()
    glass.until(lambda: len(robot.schedule) == 1, "not brought back")


def test_no_day_is_no_time(glass: Glass, tasks: Any) -> None:
    tasks.open_scheduled(None)
    tasks.pane.begin("go_home")
    tasks.pane.when.choose(days=[False] * 7)
    glass.stage.run_for(0.2)
    assert tasks.pane.sentence == "Choose at least one day."
    assert tasks.ids["save"].disabled


# the history


def test_the_history_is_read_when_it_is_looked_at_and_older_ones_on_demand(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    times = Time.at(1000.0), Time.at(1600.0)
    robot.runs = [
        TaskRun(n, PATROL, *times, "SUCCEEDED", "Patrol done.", 340.0, 6, "vm") for n in range(40, 0, -1)
    ]
    tasks.tab = "history"
    glass.until(lambda: len(tasks.runs.runs) == 30, "no history")
    assert row(tasks.runs, "Patrol").detail == "done · 340 m · 10 min · vm"
    assert tasks.runs.more
    tasks.runs.dispatch("on_command", tasks.runs.runs[-1].id)
    glass.until(lambda: len(tasks.runs.runs) == 40, "no older ones")
    assert not tasks.runs.more


# places


def test_a_deleted_place_comes_back_as_a_new_one(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    tasks.edit_place(OFFICE)
    press(glass, tasks, "forget")
    glass.until(lambda: "Deleted: Office 12." in glass.banners(), glass.banners())
    assert all(place.name != "Office 12" for place in robot.places)
    glass.app.shell.ids.notices.children[0].act()
    glass.until(lambda: any(place.name == "Office 12" for place in robot.places), "not brought back")
    assert asked(robot, "/places/set")[-1].place.id == 0


def test_a_place_that_could_not_be_deleted_offers_no_undo(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    robot.refusals["/places/delete"] = "The schedule still goes to Office 12."
    tasks.edit_place(OFFICE)
    press(glass, tasks, "forget")
    glass.until(lambda: any("still goes to Office 12" in text for text in glass.banners()), glass.banners())
    assert not any(text.startswith("Deleted") for text in glass.banners())


def test_two_places_never_have_the_same_name(glass: Glass, tasks: Any) -> None:
    tasks.edit_place(Place(x=1.0, y=1.0))
    tasks.form.set(name="LAB")
    glass.stage.run_for(0.2)
    assert tasks.place_pane.sentence == "There is a LAB already. Choose another name."
    assert tasks.ids["keep"].disabled


def test_a_place_that_is_refused_comes_back_with_all_that_was_typed(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    robot.refusals["/places/set"] = "Shop lies in the keep-out Ramp."
    tasks.edit_place(Place(name="Shop", x=1.0, y=2.0, note="Ring twice"))
    press(glass, tasks, "keep")
    glass.until(lambda: any("keep-out Ramp" in text for text in glass.banners()), glass.banners())
    place = tasks.form.place
    assert (tasks.detail, place.name, place.note, place.x) == ("place", "Shop", "Ring twice", 1.0)
    robot.refusals.clear()
    press(glass, tasks, "keep")
    glass.until(lambda: any(one.name == "Shop" for one in robot.places), "not stored")
    glass.stage.run_for(0.3)
    assert tasks.detail == ""


def test_with_no_place_chosen_there_is_no_form_to_fill_but_what_to_do(glass: Glass, tasks: Any) -> None:
    pane = tasks.place_pane
    tasks.tab = "places"
    assert pane.form.parent is None
    assert (pane.head.title, pane.sentence) == ("Places", "Choose a place to change it, or make a new one.")
    tasks.edit_place(Place(x=1.0, y=2.0))
    assert (pane.form.parent, pane.head.title) == (pane, "New place")
    tasks.close()
    assert pane.form.parent is None


def test_where_the_robot_stands_becomes_a_place(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    tasks.tab = "places"
    assert tasks.ids["here"].disabled
    pose = PoseWithCovariance(pose=Pose(Point(2.0, 3.0)))
    robot.publish("/pose", PoseWithCovarianceStamped(pose=pose))
    press(glass, tasks, "here")
    assert (tasks.form.place.x, tasks.form.place.y) == (2.0, 3.0)


def test_a_place_of_the_list_is_moved_by_a_tap_on_the_map(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    tasks.edit_place(LAB)
    press(glass, tasks, "move")
    mission = glass.app.screens["mission"]
    assert (glass.app.shell.screen, mission.selection.text) == ("mission", "Tap where Lab is.")
    mission.map.dispatch("on_new_place", 4.0, 5.0)
    glass.stage.run_for(0.2)
    glass.tap(mission.card.shown.save)
    assert robot.until(lambda: asked(robot, "/places/set"))
    place = asked(robot, "/places/set")[0].place
    assert (place.id, place.name, place.x, place.y, place.note) == (LAB.id, "Lab", 4.0, 5.0, LAB.note)
    assert mission.mode == "view"


def test_going_to_a_place_begins_with_its_name(glass: Glass, tasks: Any) -> None:
    tasks.edit_place(LAB)
    press(glass, tasks, "go")
    assert tasks.pane.sentence == "Goes to Lab and stays there."


# the screen


def test_turning_the_device_keeps_what_was_chosen_and_covers_nothing_with_stop(
    glass: Glass, tasks: Any
) -> None:
    tasks.begin("deliver", ("Office 12", "Lab"))
    for size in [(412, 892), (892, 412), (1280, 800), (1920, 1200)]:
        glass.app.shell.size = glass.app.root.size = size
        glass.stage.frames(4)
        assert tasks.pane.order.places == ["Office 12", "Lab"], size
        stop = glass.app.shell.stop
        assert size[0] - stop.right <= 16, size
        for name in ("start", "queue"):
            button = tasks.ids[name]
            assert button.to_window(button.right, button.y)[0] <= stop.x, (size, name)
            assert button.height >= 40, (size, name)


def test_on_a_phone_the_tasks_can_be_chosen_whatever_is_said_over_them(
    glass: Glass, robot: FakeRobot, tasks: Any
) -> None:
    robot.publish("/robot/info", RobotInfo(name="Fake-1", kind="wheels", tasks=list(TASKS), max_climb=1.0))
    glass.until(lambda: len(tasks.pane.chooser.tasks) == len(TASKS), "not all tasks are offered")
    shell, tiles = glass.app.shell, tasks.pane.chooser._tiles
    for size in [(892, 412), (412, 892)]:
        shell.size = glass.app.root.size = size
        tasks.open("order")
        tasks.begin("")
        for said in ("sentence", "card"):
            if said == "sentence":
                glass.app.say(
                    "Point 2 cannot be reached; the patrol goes on without it, and says so.", "warn"
                )
            else:
                shell.notices.hush()  # else it goes by itself, under the finger
                asks = TaskStatus(task="deliver", state="RUNNING", asks="Is it loaded at Lab?", place="Lab")
                robot.publish("/task/status", asks)
                glass.until(lambda: shell.question.parent is not None, "no card")
            shell.tick()
            glass.stage.frames(6)
            for name in ("patrol", "land"):
                tasks.pane._tiles.scroll_to(tiles[name], padding=0, animate=False)
                glass.stage.frames(4)
                tile = Rect(*tiles[name].to_window(*tiles[name].pos), *tiles[name].size)
                room = Rect(*tasks.pane._tiles.to_window(*tasks.pane._tiles.pos), *tasks.pane._tiles.size)
                middle = Rect(tile.x + tile.width / 2 - 2, tile.y + tile.height / 2 - 2, 4, 4)
                assert room.holds(middle), (size, said, name, tile, room)
                notices = shell.notices
                assert not Rect(*notices.pos, *notices.size).overlaps(room), (size, said)
                glass.tap(tiles[name])
                assert tasks.pane.form.task == name, (size, said)
                tasks.begin("")
                glass.stage.frames(2)
        shell.notices.hush()
        robot.publish("/task/status", TaskStatus())
        glass.until(lambda: shell.question.parent is None, "still asked")


def test_back_goes_from_the_list_of_places_to_the_form_to_the_lists(glass: Glass, tasks: Any) -> None:
    glass.app.shell.size = glass.app.root.size = (412, 892)
    tasks.begin("go_to")
    tasks.pane.form.ask("to")
    glass.stage.frames(2)
    steps = [glass.app.shell.back() for _ in range(4)]
    assert steps == [True, True, True, False]


def test_the_points_of_a_running_patrol_are_changed(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    robot.publish("/mission", Mission(waypoints=[Waypoint(1.0, 1.0), Waypoint(4.0, 1.0)]))
    robot.publish(
        "/task/status", TaskStatus(task_id=1, task="patrol", state="RUNNING", waypoint=1, waypoints=2)
    )
    glass.until(
        lambda: glass.app.session.running and glass.app.session.mission.state == "stored", "no patrol"
    )
    glass.app.show("mission")
    glass.app.session.mission.add(4.0, 4.0)
    send = glass.app.screens["mission"].ids["send"]
    glass.until(lambda: send.text == "Change the patrol: 3 points" and not send.disabled, send.text)
    glass.tap(send)
    assert robot.until(lambda: asked(robot, "/mission/set"))
    assert len(asked(robot, "/mission/set")[0].mission.waypoints) == 3


def test_no_card_covers_stop_or_leaves_the_glass(glass: Glass, robot: FakeRobot, tasks: Any) -> None:
    reason = "The robot's computer restarted in the middle of a delivery; choose Resume to go on, or Discard."
    cut = TaskStatus(task="deliver", state="INTERRUPTED", places=["Office 12", "Lab"], reason=reason)
    robot.publish("/task/status", cut)
    card, stop = glass.app.shell.question, glass.app.shell.stop
    for size in [(412, 892), (892, 412), (1280, 800)]:
        glass.app.shell.size = glass.app.root.size = size
        for screen in ("tasks", "mission", "drive", "topics"):
            glass.app.show(screen)
            glass.until(lambda: card.parent is not None and card.height > 100, f"not on {screen}")
            glass.stage.frames(6)
            seen = Rect(*card.to_window(card.x, card.y), *card.size)
            assert not seen.overlaps(Rect(*stop.pos, *stop.size)), (size, screen)
            assert Rect(0, 0, *size).holds(seen), (size, screen)

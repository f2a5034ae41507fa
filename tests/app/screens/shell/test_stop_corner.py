"""STOP ALL on the glass: in STOP's corner of every page, one finger away, and it says what became of it."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.layout import arrange
from app.layout.arrange import Rect
from bridge.discovery.beacon import Hello
from bridge.msgs.pilothouse_msgs import TaskStatus
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass, running
from tests.headless import Stage
from widgets import StopAll
from widgets.core.theme import theme
from widgets.parts.buttons import NavButton, PushButton

TABS = ("now", "schedule", "places", "missions", "history", "events")
SIZES = [(412, 892), (892, 412), (1280, 800), (1920, 1200)]


@pytest.fixture
def other() -> Iterator[FakeRobot]:
    robot = FakeRobot()
    yield robot
    robot.close()


def hear(glass: Glass, *robots: FakeRobot) -> None:
    """Each of them says HELLO."""
    for robot in robots:
        name = f"Robot-{robot.port}"
        glass.app.robots.heard(Hello(name=name, kind="wheels", url=robot.url), time.monotonic())
    glass.app._list()
    glass.app.corner.tick()
    glass.stage.frames(2)


def words(glass: Glass) -> dict[str, str]:
    """The list of STOP ALL: each robot's name with its word."""
    column = glass.app.corner.list.ids.column
    return {row.title: row.word for row in column.children}


def press(glass: Glass) -> None:
    glass.tap(glass.app.corner.button)


def test_every_place_tells_one_number_of_robots_and_those_that_are_lost_are_tried_all_the_same(
    driving: Glass, robot: FakeRobot, other: FakeRobot
) -> None:
    app = driving.app
    app.robots.heard(Hello(name="Gone", kind="wheels", url=other.url), app.now() - 10.0)
    app.show("fleet")
    button, fleet = app.corner.button, app.screens["fleet"]
    driving.until(lambda: button.lost == 1, "not counted")
    driving.until(lambda: other.url in fleet.cards, "not listed")
    assert (button.robots, fleet.head.text) == (2, "2 robots, 1 lost")
    assert button.note in ("2 robots, 1 lost", "2 · 1 lost"), "as there is room for it"
    assert fleet.cards[other.url].driver_text == "lost"
    press(driving)
    driving.until(lambda: words(driving).get("Gone") == "STOPPED", "a lost one is not tried")
    driving.app.leave()
    driving.until(lambda: app.connect.nearby.startswith("1 robot,"), "the one that was left says no HELLO")
    assert app.connect.nearby == "1 robot, 1 lost"


def test_it_is_there_when_a_robot_is_known_and_counts_who_is_stopped(
    glass: Glass, robot: FakeRobot, other: FakeRobot
) -> None:
    corner = glass.app.corner
    assert corner.button.parent is None, "nothing to stop"
    hear(glass, robot)
    assert (corner.button.word, corner.button.note) == ("STOP ALL", "1 robot")
    press(glass)
    glass.until(lambda: corner.button.word == "1 of 1", "not stopped")
    hear(glass, other)
    assert corner.list.footnote == "1 more found since: press STOP ALL again."
    press(glass)
    glass.until(lambda: corner.button.word == "2 of 2", "not both are stopped")
    assert corner.list.title == "STOPPED 2 of 2"
    assert words(glass) == {f"Robot-{one.port}": "STOPPED" for one in (robot, other)}
    assert other.services() == ["/stop"]
    glass.tap(corner.list.ids.close)
    glass.until(lambda: not glass.app.fleet.active, "nothing is sent, and it goes on")
    assert corner.list.parent is None
    assert robot.control.stopped, "it stays stopped until it is released"


def test_from_every_screen_of_a_robot_one_finger_stops_all(
    driving: Glass, robot: FakeRobot, other: FakeRobot
) -> None:
    hear(driving, robot, other)
    for count, screen in enumerate(("drive", "mission", "tasks", "topics"), 1):
        driving.app.show(screen)
        press(driving)
        assert robot.until(lambda n=count: robot.services().count("/stop") >= n), screen
        assert other.until(lambda n=count: other.services().count("/stop") >= n), screen
        driving.until(lambda: driving.app.fleet.stopped == 2, screen)
        for one in (robot, other):
            one.publish("/control/status", one.control)
        driving.app.fleet.let_go()
        driving.app.session.release_stop()
        driving.until(lambda: driving.app.session.robot_stop.phase == "ready", screen)


def test_with_one_robot_alone_stop_has_its_room_to_itself(driving: Glass, robot: FakeRobot) -> None:
    hear(driving, robot)
    assert driving.app.corner.button.parent is None
    assert driving.app.shell.stop.size == [
        driving.app.shell.stop_place.width,
        driving.app.shell.stop_place.height,
    ]


def test_who_only_watches_stops_all(glass: Glass, robot: FakeRobot, other: FakeRobot) -> None:
    glass.app.open(robot.url, watch=True)
    glass.until(lambda: glass.app.shell is not None, "no screens")
    hear(glass, robot, other)
    press(glass)
    glass.until(lambda: glass.app.fleet.stopped == 2, "not stopped")
    assert "/control/acquire" not in robot.services() + other.services()


def test_the_connected_robot_is_asked_once_over_its_own_link(
    driving: Glass, robot: FakeRobot, other: FakeRobot
) -> None:
    hear(driving, robot, other)
    press(driving)
    driving.until(lambda: driving.app.fleet.stopped == 2, "not stopped")
    assert driving.app.shell.stop.phase == "stopped"
    assert robot.services().count("/stop") == 1


def test_a_question_over_the_page_does_not_keep_it_from_a_finger(glass: Glass, robot: FakeRobot) -> None:
    hear(glass, robot)
    glass.app.robot_list.ask_address()
    press(glass)
    glass.until(lambda: glass.app.fleet.stopped == 1, "not stopped")


def test_leaving_a_robot_that_has_not_answered_goes_on_stopping_it(
    driving: Glass, robot: FakeRobot, other: FakeRobot
) -> None:
    hear(driving, robot, other)
    robot.hold_answers()
    press(driving)
    assert robot.until(lambda: "/stop" in robot.services())
    driving.app.leave()
    robot.give_answers()
    driving.until(lambda: driving.app.fleet.stopped == 2, "forgotten")


def test_a_glass_that_is_taken_away_goes_on_stopping(
    driving: Glass, robot: FakeRobot, other: FakeRobot
) -> None:
    hear(driving, robot, other)
    robot.stop()
    press(driving)
    driving.app.on_pause()
    robot.start()
    assert robot.until(lambda: robot.control.stopped), "nobody stops it while the app is away"
    driving.app.on_resume()
    driving.until(lambda: driving.app.fleet.stopped == 2, "not stopped")


def test_who_leaves_a_robot_whose_own_stop_is_not_confirmed_sees_that_it_is_sent_until_it_is(
    driving: Glass, robot: FakeRobot
) -> None:
    app, corner = driving.app, driving.app.corner
    hear(driving, robot)
    robot.refusals["/stop"] = "The robot cannot be reached."
    driving.tap(app.shell.stop)
    driving.until(lambda: app.shell.stop.phase == "no_answer", "it claims more than is known")
    app.leave()
    assert (app.session, corner.list.parent) == (None, corner.layer), "forgotten in silence"
    assert list(words(driving).values()) != ["STOPPED"]
    driving.until(lambda: words(driving) == {"Fake-1": "NO ANSWER"}, "it claims more than is known")
    assert corner.button.word == "STOP ALL", "that was not pressed"
    driving.tap(corner.list.ids.close)
    driving.until(lambda: corner.list.parent is None, "it is not folded away")
    driving.until(lambda: corner.button.word == "0 of 1", "folded away nothing says that it is sent")
    robot.refusals.clear()
    driving.until(lambda: not app.fleet.active, "it never ends")
    assert robot.control.stopped
    assert [child.text for child in app.connect.ids.notices.children] == ["STOP is done: 1 of 1 stopped."]


def test_the_robot_that_was_left_is_stopped_and_released_over_its_link_when_it_is_opened_again(
    driving: Glass, robot: FakeRobot
) -> None:
    app, corner = driving.app, driving.app.corner
    robot.refusals["/stop"] = "The robot cannot be reached."
    driving.tap(app.shell.stop)
    assert robot.until(lambda: "/stop" in robot.services())
    app.open(robot.url)
    driving.until(lambda: app.shell is not None and corner.list.parent is None, "two of them stop it")
    assert not app.fleet.active
    robot.refusals.clear()
    driving.until(lambda: app.shell.stop.phase == "stopped", "forgotten on the way")
    app.session.release_stop()
    driving.until(lambda: app.shell.stop.phase == "ready", "not released")
    asked = robot.services().count("/stop")
    app.leave()
    assert not app.fleet.active
    driving.stage.run_for(1.5, 0.1)
    assert (robot.services().count("/stop"), robot.control.stopped) == (asked, False)


def test_a_glass_that_is_taken_away_goes_on_with_the_stop_of_one_robot(
    driving: Glass, robot: FakeRobot
) -> None:
    robot.stop()
    driving.tap(driving.app.shell.stop)
    driving.app.on_pause()
    robot.start()
    assert robot.until(lambda: robot.control.stopped), "nobody stops it while the app is away"
    driving.app.on_resume()
    driving.until(lambda: driving.app.shell.stop.phase == "stopped", "not stopped")
    driving.until(lambda: not driving.app.fleet.active, "two of them stop it")


def test_whoever_ends_the_app_ends_what_stops_a_robot_that_has_not_confirmed(
    fresh: None, stage: Stage, tmp_path: Path, robot: FakeRobot
) -> None:
    with running(stage, tmp_path) as glass:
        glass.app.open(robot.url)
        glass.drives()
        robot.hold_answers()
        glass.tap(glass.app.shell.stop)
        assert robot.until(lambda: "/stop" in robot.services())
    assert "STOP ALL" not in {thread.name for thread in threading.enumerate()}


def test_the_list_folds_while_it_is_sent_and_a_hold_lets_go(glass: Glass, robot: FakeRobot) -> None:
    robot.refusals["/stop"] = "The robot cannot be reached."
    hear(glass, robot)
    corner = glass.app.corner
    press(glass)
    glass.until(lambda: "NO ANSWER" in words(glass).values(), "it claims more than is known")
    glass.tap(corner.list.ids.close)
    glass.stage.frames(10)
    assert (corner.list.parent, corner.button.word) == (None, "0 of 1"), "it goes on, and says so"
    press(glass)
    glass.stage.frames(3)
    release = corner.list.ids.release
    finger = glass.hold(release)
    glass.stage.run_for(1.3, 0.1)
    finger.touch_up()
    assert not glass.app.fleet.active
    asked = len(robot.asked)
    glass.stage.frames(3)
    assert len(robot.asked) <= asked + 1


def test_folded_away_it_ends_by_itself_and_says_so_when_the_last_one_rests(
    glass: Glass, robot: FakeRobot
) -> None:
    robot.refusals["/stop"] = "The robot cannot be reached."
    hear(glass, robot)
    press(glass)
    glass.until(lambda: "NO ANSWER" in words(glass).values(), "it claims more than is known")
    glass.tap(glass.app.corner.list.ids.close)
    robot.refusals.clear()
    glass.until(lambda: not glass.app.fleet.active, "it never ends")
    banners = [child.text for child in glass.app.connect.ids.notices.children]
    assert banners == ["STOP ALL is done: 1 of 1 stopped."]
    glass.app.corner.tick()
    assert glass.app.corner.button.word == "STOP ALL"


def crowded(size: tuple[int, int]) -> list[tuple[Any, dict[str, Any]]]:
    """The places of every screen where STOP ALL is there, each with what arranges it."""
    room, shape = arrange.shell(*size)["body"], arrange.form(*size)
    body = arrange.Body(room.x, room.y, room.width, room.height, crowded=True)
    screens = (arrange.mission, arrange.drive, arrange.topics, arrange.tasks)
    return [(screen, screen(body, shape)) for screen in screens]


@pytest.mark.parametrize("size", SIZES)
def test_neither_hides_the_other_nor_is_too_small_and_stop_is_the_larger(size: tuple[int, int]) -> None:
    for _, places in crowded(size):
        stop, all_of_them = places["stop"], places["stop"].other
        for name, place in places.items():
            if name not in ("map", "side", "video", "notice", "senses_open", "stop"):
                assert not all_of_them.overlaps(place), name
        assert not stop.overlaps(all_of_them)
        assert stop.width * stop.height > 1.5 * all_of_them.width * all_of_them.height
        assert min(all_of_them.width, all_of_them.height, stop.width, stop.height) >= theme.target


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("wanted", [180.0, 2000.0])
def test_the_list_stays_on_the_glass_and_leaves_stop_free(size: tuple[int, int], wanted: float) -> None:
    shape = arrange.form(*size)
    body = arrange.shell(*size)["body"]
    for _, places in crowded(size):
        stop = places["stop"]
        listed = arrange.stop_list(body, stop, shape, wanted)
        assert body.holds(listed)
        assert not listed.overlaps(stop)
        assert not listed.overlaps(stop.other)
        assert min(listed.width, listed.height) >= 170
        assert shape == "short" or listed.right == stop.right, "it juts out"


@pytest.mark.parametrize("size", SIZES)
def test_in_one_line_it_covers_nothing_that_drives_starts_or_stops(size: tuple[int, int]) -> None:
    body, shape = arrange.shell(*size)["body"], arrange.form(*size)
    for _, places in crowded(size):
        line = arrange.stop_list(body, places["stop"], shape, 80.0, folded=True)
        for name in {"stop", "stick", "slider", "actions", "tasks", "strip"} & places.keys():
            assert not line.overlaps(places[name]), name
        assert not line.overlaps(places["stop"].other)


def test_the_words_of_the_buttons_beside_stop_all_can_be_read(
    driving: Glass, robot: FakeRobot, other: FakeRobot
) -> None:
    driving.app.root.size = (412, 892)
    hear(driving, robot, other)
    driving.app.show("drive")
    driving.stage.frames(3)
    for name in ("snapshot", "pause", "home"):
        button = driving.app.screens["drive"].ids[name]
        assert button.words_size >= 12, name
        assert button.children[0].width <= button.width, name


def test_on_the_connect_screen_it_covers_nothing_that_can_be_pressed(glass: Glass, robot: FakeRobot) -> None:
    app: Any = glass.app
    for number in range(6):
        app.robots.add(f"10.0.0.{number + 1}")
    hear(glass, robot)
    for size in SIZES:
        app.root.size = size
        app.corner.tick()
        glass.stage.frames(4)
        taken = place(app.corner.button)
        assert Rect(0, 0, *size).holds(taken), size
        for part in (app.connect.ids.add, app.connect.ids.simulate, app.connect.ids.cards.parent):
            assert not taken.overlaps(place(part)), size


def place(widget: Any) -> Rect:
    """Where it is on the glass."""
    return Rect(*widget.to_window(*widget.pos), *widget.size)


def asking(robot: FakeRobot, question: str = "Has it been picked up?") -> None:
    robot.publish("/task/status", TaskStatus(task="deliver", task_id=3, state="RUNNING", asks=question))


def test_it_is_not_where_stop_is_for_a_single_frame(
    driving: Glass, robot: FakeRobot, other: FakeRobot
) -> None:
    hear(driving, robot, other)
    app = driving.app
    for screen in ("drive", "mission", "tasks", "topics"):
        app.show(screen)
        assert not place(app.corner.button).overlaps(place(app.shell.stop)), screen
    app.leave()
    assert app.corner.button.width == 240, "it stayed where it was beside STOP"
    app.open(robot.url)
    while app.shell is None:
        driving.stage.frames(1)
    assert not place(app.corner.button).overlaps(place(app.shell.stop))


@pytest.mark.parametrize("size", [(412, 892), (892, 412), (1280, 800)])
def test_a_question_is_not_covered_and_the_list_is_one_line_until_it_is_answered(
    driving: Glass, robot: FakeRobot, other: FakeRobot, size: tuple[int, int]
) -> None:
    app, corner = driving.app, driving.app.corner
    app.root.size = size
    hear(driving, robot, other)
    app.show("tasks")
    press(driving)
    driving.until(lambda: app.fleet.stopped == 2, "not stopped")
    assert not corner.list.folded
    asking(robot)
    for screen in ("drive", "mission", "topics", "tasks"):
        app.show(screen)
        driving.until(lambda: app.shell.question.height > 100, "nothing is asked")
        driving.stage.run_for(0.5, 0.1)
        assert not place(corner.list).overlaps(place(app.shell.question)), screen
    assert corner.list.folded, "it takes the room of the question"
    driving.tap(corner.list.ids.fold)
    driving.stage.run_for(0.3, 0.1)
    assert not corner.list.folded, "it cannot be read while something is asked"
    asking(robot, "")
    driving.until(lambda: not corner.list.cramped, "nothing is asked any more")
    assert not corner.list.folded


def test_what_is_only_said_is_said_above_the_list(driving: Glass, robot: FakeRobot, other: FakeRobot) -> None:
    app, corner = driving.app, driving.app.corner
    app.root.size = (412, 892)
    hear(driving, robot, other)
    app.show("tasks")
    press(driving)
    driving.until(lambda: app.fleet.stopped == 2, "not stopped")
    app.shell.say("The map was sent.", about="map")
    driving.stage.run_for(0.5, 0.1)
    assert not corner.list.folded
    assert not place(corner.list).overlaps(place(app.shell.notices))
    app.shell.say("The map was sent. " * 12, about="map")
    driving.stage.run_for(0.5, 0.1)
    assert corner.list.folded, "too little of the lists is left"


def test_no_button_is_as_large_as_stop(driving: Glass, robot: FakeRobot, other: FakeRobot) -> None:
    for robots in ((robot,), (robot, other)):
        hear(driving, *robots)
        for size in SIZES:
            driving.app.root.size = size
            assert_stop_is_largest_everywhere(driving, robot, f"{size} {len(robots)}")


def assert_stop_is_largest_everywhere(driving: Glass, robot: FakeRobot, where: str) -> None:
    app = driving.app
    for screen in ("drive", "mission", "topics", "tasks"):
        app.show(screen)
        for tab in TABS if screen == "tasks" else ("",):
            app.screens["tasks"].tab = tab or app.screens["tasks"].tab
            driving.stage.frames(3)
            assert_stop_is_largest(app, f"{where} {screen} {tab}")
    app.show("tasks")
    app.screens["tasks"].tab = "now"
    app.screens["tasks"].begin("deliver", ("Lab",))
    driving.stage.frames(3)
    assert_stop_is_largest(app, f"{where} order")
    app.screens["tasks"].close()
    asking(robot)
    for screen in ("drive", "mission", "topics", "tasks"):
        app.show(screen)
        driving.stage.run_for(0.3, 0.1)
        driving.until(lambda: app.shell.question.height > 80, "nothing is asked")
        assert_stop_is_largest(app, f"{where} {screen} asks")
    asking(robot, "")
    driving.until(lambda: app.shell.question.parent is None, "it is asked still")


def assert_stop_is_largest(app: Any, where: str) -> None:
    stop = app.shell.stop
    for widget in app.root.walk():
        if isinstance(widget, PushButton | NavButton | StopAll) and widget.opacity:
            large = widget.width * widget.height
            assert large < stop.width * stop.height, f"{where}: {getattr(widget, 'text', widget)}"


def test_without_a_link_stop_says_what_was_heard_last_and_a_hold_lets_nothing_go(
    driving: Glass, robot: FakeRobot
) -> None:
    stop, session = driving.app.shell.stop, driving.app.session
    driving.tap(stop)
    driving.until(lambda: stop.phase == "stopped", "not stopped")
    robot.stop()
    driving.until(lambda: not session.connected, "the link stands")
    driving.until(lambda: stop.phase == "lost", "it says more than is known")
    assert stop.sentence.startswith("no link, was STOPPED ")
    driving.tap(stop)
    driving.until(lambda: stop.phase == "no_answer", "it claims to be sent")
    assert stop.sentence == "no answer, sending again", "a hold is offered that lets nothing go"
    finger = driving.hold(stop)
    driving.stage.run_for(4.0, 0.1)
    finger.touch_up()
    driving.until(lambda: session.outcomes["stop"].phase == "no_reply", "it was let go and is sent no longer")


def test_a_hello_that_claims_to_be_the_connected_robot_does_not_take_the_button_away(
    driving: Glass, robot: FakeRobot, other: FakeRobot, monkeypatch: pytest.MonkeyPatch
) -> None:
    corner, app = driving.app.corner, driving.app
    monkeypatch.setattr(type(app.session), "boot", "b1")
    corner.tick()
    assert corner.button.parent is None
    app.robots.heard(Hello(name="Other", url=other.url, boot="b1"), time.monotonic())
    corner.tick()
    assert corner.button.parent is not None
    press(driving)
    driving.until(lambda: other.control.stopped, "it was meant too")

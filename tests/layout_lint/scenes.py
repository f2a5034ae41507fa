"""What the walk looks at with a robot: every screen, every pane of the setup and the inputs, drive screens of all kinds, the dialogs."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from app.link.feeds import Post
from app.screens.parts.screen_table import names
from bridge.msgs.pilothouse_msgs import (
    Check,
    Checklist,
    Event,
    Mission,
    Place,
    PlaceArray,
    RobotInfo,
    Schedule,
    ScheduledTask,
    TaskOrder,
    TaskQueue,
    TaskRun,
    TaskStatus,
    Waypoint,
)
from bridge.msgs.sensor_msgs import BatteryState
from bridge.msgs.std_msgs import Time
from tests.app.fakes import FakeRobot
from tests.app.glass import Glass
from tests.layout_lint.alone import Scene, close, kept_recording, nothing, opened_recording, tour_cards

__all__ = ["feed", "fill", "scenes"]

KINDS = {
    "commander": "ackermann",
    "scout": "wheels",
    "minnow": "boat",
    "ardrone": "quadrotor",
    "aqua": "hexapod",
}
"""Models whose drive screens differ, to their kinds."""

ROUTE = [Waypoint(x, y, name=name) for x, y, name in ((1, 1, ""), (7, 2, "Loading bay"), (4, 6, ""))]
PLACES = [Place(id=1, name="Loading bay", x=7, y=2), Place(id=2, name="Charging dock", kind="dock", x=0, y=0)]
ORDER = TaskOrder(id=7, task="patrol")
TASKS = ["patrol", "go_to", "deliver_message", "guide", "home"]
MESSAGES = {
    "/robot/info": RobotInfo(name="Fake-1", kind="wheels", max_speed=0.8, max_yaw_rate=1.5, tasks=TASKS),
    "/battery_state": BatteryState(voltage=24.1, percentage=0.42),
    "/mission": Mission(waypoints=ROUTE, home=[Waypoint(0.0, 0.0)], name="Night round"),
    "/task/status": TaskStatus(
        task_id=7, task="patrol", state="RUNNING", motion="loop", waypoint=1, waypoints=3
    ),
    "/checklist": Checklist(
        checks=[
            Check(name="battery", state="ok", text="Battery at 42 %."),
            Check(name="stop", state="warn", text="STOP was not tested today."),
        ]
    ),
    "/places": PlaceArray(places=PLACES),
    "/task/queue": TaskQueue(
        revision=3, orders=[ORDER, TaskOrder(id=8, task="go_to", places=["Charging dock"])]
    ),
    "/schedule": Schedule(
        tasks=[ScheduledTask(id=3, order=ORDER, at="08:30", days=[True] * 5 + [False] * 2)]
    ),
}
EVENTS = [
    Event(id=number, boot="b", stamp=Time.at(1.7e9 + number), level=level, kind=kind, text=text)
    for number, (level, kind, text) in enumerate(
        [
            ("info", "waypoint", "Point 2 was reached."),
            ("warn", "battery", "Battery at 20 %: the robot goes home soon."),
            ("error", "intruder", "A person was seen at the loading bay."),
        ],
        1,
    )
]
RUNS = [
    TaskRun(
        id=4, order=ORDER, started=Time.at(1.7e9), ended=Time.at(1.7e9 + 300), state="DONE", distance=52.0
    )
]


def fill(robot: FakeRobot, glass: Glass) -> None:
    """Have something to say on every screen."""
    robot.runs = list(RUNS)
    robot.know(*PLACES)
    robot.missions["Night round"] = MESSAGES["/mission"]
    for topic, message in MESSAGES.items():
        robot.publish(topic, message)
    robot.happen(*EVENTS)
    seen = glass.app.session.feeds.latest
    glass.until(lambda: seen("/schedule") and seen("/checklist"), "not told")


def feed(glass: Glass) -> None:
    """What is published is said again to screens made anew, and is not old."""
    now = glass.app.now()
    for topic, message in MESSAGES.items():
        glass.app._deliver(topic, Post(message, now, 1))


def scenes() -> Iterator[Scene]:
    """All of them."""
    for name in names():
        if name not in ("setup", "inputs"):
            yield name, lambda glass, name=name: glass.app.show(name), nothing
    yield from _panes("setup", "app.screens.setup.pane_table")
    yield from _panes("inputs", "app.screens.inputs.pane_table")
    for tab in ("schedule", "events", "places", "missions", "history"):
        yield f"tasks {tab}", lambda glass, tab=tab: _tab(glass, tab), nothing
    for task in TASKS[:3]:
        yield f"tasks {task}", lambda glass, task=task: _order(glass, task), _shut_task
    yield "tasks place", _edit_place, _shut_task
    yield "mission points", _points, lambda glass: setattr(glass.app.screens["mission"], "mode", "view")
    yield "place card", _place, _shut
    yield "layers card", _layers, lambda glass: glass.app.screens["mission"].back()
    yield "topics graph", lambda glass: _graph(glass, on=True), lambda glass: _graph(glass, on=False)
    yield "topics open", _topic, lambda glass: glass.app.screens["topics"].back()
    yield "replay open", _replay, lambda glass: glass.app.screens["replay"].back()
    yield "panels edit", _edit, lambda glass: glass.app.screens["panels"].back()
    yield "panels list", _list, _edited
    yield "panels selected", _select, _edited
    yield "panels share", _share, close
    yield "leave", _leave, close
    yield "people", lambda glass: glass.app.shell.show_people(), close
    yield "control", lambda glass: glass.app.shell.toggle_control(), close
    yield "keys", lambda glass: glass.app.toggle_help(), lambda glass: glass.app.toggle_help()
    yield from tour_cards("tour", 5)
    yield "STOP ALL", _stop_all, _release
    for model in KINDS:
        yield f"drive {model}", lambda glass, model=model: _drive(glass, model), _drive_own


def _panes(screen: str, table: str) -> Iterator[Scene]:
    from importlib import import_module

    yield screen, lambda glass: glass.app.show(screen), nothing
    for name in import_module(table).panes():
        yield (
            f"{screen} {name}",
            lambda glass, name=name: _pane(glass, screen, name),
            lambda glass: glass.app.back(),
        )


def _pane(glass: Glass, screen: str, name: str) -> None:
    glass.app.show(screen)
    glass.app.screens[screen].open(name)


def _tab(glass: Glass, tab: str) -> None:
    glass.app.show("tasks")
    glass.app.screens["tasks"].tab = tab


def _order(glass: Glass, task: str) -> None:
    glass.app.show("tasks")
    glass.app.screens["tasks"].begin(task)


def _edit_place(glass: Glass) -> None:
    glass.app.show("tasks")
    glass.app.screens["tasks"].edit_place(PLACES[0])


def _shut_task(glass: Glass) -> None:
    glass.app.screens["tasks"].close()


def _points(glass: Glass) -> None:
    glass.app.show("mission")
    mission = glass.app.screens["mission"]
    mission.mode = "points"
    mission.map.selected = 0
    mission.map.dispatch("on_select", 0)


def _place(glass: Glass) -> None:
    glass.app.show("mission")
    glass.app.screens["mission"].map.dispatch("on_open_place", 0)


def _shut(glass: Glass) -> None:
    mission = glass.app.screens["mission"]
    if mission.card.shown is not None:
        mission.card.shown.leave()


def _layers(glass: Glass) -> None:
    glass.app.show("mission")
    mission = glass.app.screens["mission"]
    mission._maps.toggle_card(mission)


def _graph(glass: Glass, *, on: bool) -> None:
    glass.app.show("topics")
    glass.app.screens["topics"].list.form = "graph" if on else "table"


def _topic(glass: Glass) -> None:
    glass.app.show("topics")
    glass.app.screens["topics"].open("/battery_state")


def _replay(glass: Glass) -> None:
    kept_recording(glass)
    glass.app.show("replay")
    opened_recording(glass, glass.app.screens["replay"])


def _edit(glass: Glass) -> None:
    glass.app.show("panels")
    glass.app.screens["panels"].editor.begin()


def _list(glass: Glass) -> None:
    _edit(glass)
    glass.app.screens["panels"].editor.act("list")


def _select(glass: Glass) -> None:
    _edit(glass)
    glass.app.screens["panels"].editor.select(0)


def _edited(glass: Glass) -> None:
    panels = glass.app.screens["panels"]
    while panels.editing and panels.back():
        pass


def _share(glass: Glass) -> None:
    glass.app.show("panels")
    glass.app.screens["panels"].editor.act("share")


def _leave(glass: Glass) -> None:
    from app.screens.parts.leave_dialog import LeaveDialog

    glass.app.show("drive")
    glass.app.root.add_widget(LeaveDialog(lambda: None, robot="Fake-1", cause="task"))


def _stop_all(glass: Glass) -> None:
    glass.app.show("mission")
    glass.app.corner.press()


def _release(glass: Glass) -> None:
    glass.app.corner.list.dispatch("on_close")
    glass.app.shell.tick()


def _drive(glass: Glass, model: str) -> None:
    info = msgspec.structs.replace(MESSAGES["/robot/info"], model=model, kind=KINDS[model])
    glass.app._deliver("/robot/info", Post(info, glass.app.now(), 1))
    glass.app.show("drive")


def _drive_own(glass: Glass) -> None:
    glass.app._deliver("/robot/info", Post(MESSAGES["/robot/info"], glass.app.now(), 1))

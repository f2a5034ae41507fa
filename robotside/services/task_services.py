"""The services that set tasks going, hold and end them, and those of queue and schedule."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    DeleteScheduleRequest,
    RunTaskGoal,
    SetQueueRequest,
    SetScheduleRequest,
    SetScheduleResponse,
    StartTaskRequest,
    TaskOrder,
    Waypoint,
)
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.services.command_service import CommandService
from robotside.services.preconditions import Preconditions
from robotside.station.station import Station
from robotside.tasks.engine import Task, charger
from robotside.tasks.task_factory import words_for

__all__ = ["TaskOrders", "task_services"]

NONE_RUNNING = Notice(Code.TASK_NONE_RUNNING, "No task is running.")


def task_services(station: Station, answering: CommandService) -> Iterable[Service]:
    """What the bridge offers about the tasks of `station`."""
    orders, service = TaskOrders(station), answering.service
    yield service("/task/start", orders.start, "StartTask", StartTaskRequest)
    for name, action in (
        ("/task/pause", orders.pause),
        ("/task/resume", orders.resume),
        ("/task/cancel", orders.cancel),
        ("/task/go_home", orders.go_home),
        ("/task/confirm", orders.confirm),
    ):
        yield service(name, action)
    yield service("/task/queue/set", orders.set_queue, "SetQueue", SetQueueRequest)
    yield service(
        "/schedule/set", orders.set_scheduled, "SetSchedule", SetScheduleRequest, SetScheduleResponse
    )
    yield service("/schedule/delete", orders.delete_scheduled, "DeleteSchedule", DeleteScheduleRequest)


class TaskOrders:
    """What each service does; a method returns the sentence of success or raises Refusal or NotRecorded."""

    def __init__(self, station: Station) -> None:
        self._station, self._permits = station, Preconditions(station)
        self._engine = station.autonomy.engine

    def start(self, client: Operator, asked: StartTaskRequest) -> str:
        """Start a task, on demand also instead of the one that is under way: that goes on if this one is refused."""
        order = asked.order if asked.order.task else msgspec.structs.replace(asked.order, task=asked.task)
        if order.task == "go_home":
            return self.go_home(client, asked)
        station, permits = self._station, self._permits
        permits.may_move(client)
        if not asked.instead:
            permits.idle()
        task = station.autonomy.task_factory.task(order, station.controls.name(client))
        permits.charged(task)
        if self._engine.active:
            station.agenda.hold("another task was requested instead")
        self._begin()
        self._engine.start(task, station.now)
        return " ".join(part for part in (_started(task), station.agenda.parked) if part)

    def run(self, client: Operator, asked: RunTaskGoal) -> str:
        """Start a task of any kind that is the only one."""
        if not asked.instead:
            self._permits.idle()
        return self.start(client, asked)

    def go_to(self, client: Operator, goal: Waypoint) -> str:
        """Go to a point, also instead of another that it is under way to; the queue waits then."""
        station, permits = self._station, self._permits
        permits.may_move(client)
        under_way = self._engine.task if self._engine.active else None
        if under_way is None or under_way.name != "go_to" or under_way.order.places:
            permits.idle()
        order = TaskOrder(task="go_to", goals=[goal])
        task = station.autonomy.task_factory.task(order, station.controls.name(client))
        permits.charged(task)
        if under_way is not None:
            station.agenda.hold("the robot was sent elsewhere")
        self._begin()
        self._engine.start(task, station.now)
        return _started(task)

    def go_home(self, client: Operator, _: CommandRequest) -> str:
        """Go to the stored home, also from another task; the queue waits then."""
        station = self._station
        self._permits.may_move(client)
        home = station.autonomy.task_factory.task(TaskOrder(task="go_home"), station.controls.name(client))
        station.agenda.manual.end()
        station.agenda.hold("the robot was sent home")
        station.controls.hold()
        self._engine.start(home, station.now)
        return "Going home."

    def pause(self, client: Operator, _: CommandRequest) -> str:
        """Hold the running task."""
        self._permits.need_control(client)
        if self._engine.paused:
            return "The task is paused already."
        if not self._engine.running:
            raise Refusal(NONE_RUNNING)
        name, who = self._station.controls.name(client), self._station.controls.id(client)
        if place := charger(self._engine.status):
            said = f"{name} had it stay at {place}, charging. Resume lets it go on."
            self._engine.pause(Notice(Code.TASK_STAYS, said, actor_id=who, name=name, place=place))
            return f"It stays at {place}."
        self._engine.pause(Notice(Code.TASK_PAUSED, f"Paused by {name}.", actor_id=who, name=name))
        return "Paused."

    def resume(self, client: Operator, _: CommandRequest) -> str:
        """Go on with the task that is paused or was cut by a restart, or with the queue that waits."""
        station, engine = self._station, self._engine
        self._permits.may_move(client)
        if engine.running:
            return "The task is running already."
        if engine.interrupted and station.interrupted:
            task = station.interrupted.task(station.autonomy.task_factory)
            self._permits.charged(task)
            self._begin()
            station.interrupted.resume(task, station.now)
            return f"Resumed. {station.agenda.parked}".strip()
        if engine.paused:
            self._begin()
            station.agenda.taken_up()
            engine.resume()
            return "Resumed."
        if station.agenda.release():
            station.agenda.manual.end()
            return "The queue goes on."
        raise Refusal(Notice(Code.TASK_NONE_PAUSED, "No task is paused."))

    def cancel(self, client: Operator, _: CommandRequest) -> str:
        """End the task, or discard the one that was cut by a restart; the queue waits then."""
        self._permits.need_control(client)
        name, who = self._station.controls.name(client), self._station.controls.id(client)
        if self._engine.interrupted:
            said = f"Discarded by {name}."
            self._engine.cancel(Notice(Code.TASK_DISCARDED, said, actor_id=who, name=name))
            return "Discarded."
        if not self._engine.active:
            raise Refusal(NONE_RUNNING)
        self._engine.cancel(Notice(Code.TASK_CANCELED, f"Canceled by {name}.", actor_id=who, name=name))
        self._station.agenda.hold("the task before it was canceled")
        return "Canceled."

    def confirm(self, client: Operator, _: CommandRequest) -> str:
        """Answer what the task asks."""
        self._permits.may_change(client)
        self._permits.charged_enough()
        if not self._engine.confirm(self._station.controls.name(client)):
            raise Refusal(Notice(Code.TASK_ASKS_NOTHING, "The robot asks nothing just now."))
        return "Confirmed."

    def set_queue(self, client: Operator, asked: SetQueueRequest) -> str:
        """Replace what comes after the task that runs."""
        self._permits.may_set_off(client, bool(asked.orders))
        self._permits.has_map()
        queue, why = self._station.agenda.set_queue(asked.orders, asked.revision)
        count, then = len(queue.orders), ""
        if count and why:
            then = f"; it waits, since {why}"
        elif count and not self._engine.active:
            then = "; it begins now" if count == 1 else "; the first one begins now"
        return f"{count} {'task waits' if count == 1 else 'tasks wait'} in the queue{then}."

    def set_scheduled(self, client: Operator, asked: SetScheduleRequest) -> SetScheduleResponse:
        """Keep a scheduled task."""
        self._permits.may_set_off(client, asked.task.enabled)
        self._permits.has_map()
        agenda = self._station.agenda
        task = agenda.set_scheduled(asked.task)
        words = words_for(task.order.task)
        said = f"{words[0].upper()}{words[1:]} is scheduled, {agenda.when(task)}."
        return SetScheduleResponse(True, said, id=task.id)

    def delete_scheduled(self, client: Operator, asked: DeleteScheduleRequest) -> str:
        """Forget a scheduled task."""
        self._permits.may_change(client)
        task = self._station.records.schedule.delete(asked.id)
        return f"The schedule has {words_for(task.order.task)} no more."

    def _begin(self) -> None:
        """The robot drives itself from now on. A queue that was said to wait until told goes on waiting for that."""
        self._station.controls.hold()
        self._station.agenda.manual.end()


def _started(task: Task) -> str:
    course = task.course
    if task.name == "patrol":
        return (
            f"Patrol started: {course.count} {'point' if course.count == 1 else 'points'}, {course.motion}."
        )
    return f"{task.title} started."

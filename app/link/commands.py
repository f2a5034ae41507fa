"""A command's way to the robot: one-shot commands with an answer, and STOP's own lane.

Nothing here knows a socket: the link gives a `call`.
"""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable, Hashable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from app.core.command_origin import NOBODY, Origin
from app.core.robot_sentences import sentence
from bridge.core.codes import Code
from bridge.core.errors import BridgeError, NoReply, NotConnected, Refused
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    AcknowledgeEventsRequest,
    AcknowledgeEventsResponse,
    BringDownGatewayRequest,
    BringDownGatewayResponse,
    BringUpGatewayRequest,
    BringUpGatewayResponse,
    ChoosePlaceRequest,
    ChoosePlaceResponse,
    CommandRequest,
    CommandResponse,
    ControlStatus,
    DeletePlaceRequest,
    DeletePlaceResponse,
    DeleteScheduleRequest,
    DeleteScheduleResponse,
    GetHistoryRequest,
    GetHistoryResponse,
    GetMissionsRequest,
    GetMissionsResponse,
    MoveArmRequest,
    MoveArmResponse,
    RecallMissionRequest,
    RecallMissionResponse,
    SetLightsRequest,
    SetLightsResponse,
    SetMissionRequest,
    SetModeRequest,
    SetModeResponse,
    SetOptionRequest,
    SetOptionResponse,
    SetPayloadRequest,
    SetPayloadResponse,
    SetPlaceRequest,
    SetPlaceResponse,
    SetQueueRequest,
    SetQueueResponse,
    SetScheduleRequest,
    SetScheduleResponse,
    StartTaskRequest,
)
from widgets.core.language import mark, tr, within
from widgets.core.task_words import title

__all__ = ["COMMANDS", "SERVICES", "Commands", "Kind", "Outcome"]

VALID_FOR = 5.0
"""A one-shot command is void when it reaches the robot later than this [s]."""
SLOW = 40.0
"""What takes a robot a while, such as a broker that begins, is asked for and waited for so long [s]."""
NEVER_VOID = 1e9
"""Validity of STOP [s]: whenever it arrives, it is meant."""
TRY = 1.0
"""Wait for one answer before asking again with the same id [s]."""
PAUSE = 0.2
"""Between two tries where the first failed at once [s]."""
STOP_TRY, STOP_PAUSE = 0.3, 0.1
"""The same for STOP [s]."""
STOP_DOUBT = 1.0
"""STOP without an answer for longer is said to be unanswered; it goes on being sent [s]."""
RELEASE = ("stop_release", None)
"""What a release of STOP is under way as."""
TAKEN_BACK = mark("STOP was pressed after it.")
"""Stands for the reason of a release that is asked for no longer."""
OWN_WORDS: Mapping[str, str] = {
    Code.STOP_NOT_HELD: mark("STOP stays: hold STOPPED again."),
    Code.STOP_HELD_SHORT: mark("STOP stays: hold STOPPED again, for longer."),
}
"""Codes of reasons that a robot gives to programs, to what stands on this glass."""
STILL_SENDING = mark("Still sending it.")
"""Stands for the reason of a STOP that has no answer at all."""


@dataclass(frozen=True, slots=True)
class Kind:
    """What a one-shot command is made of."""

    service: str
    request: type[Msg]
    label: str
    """In the operator's words, as in `start patrol`."""
    response: type[Msg] = CommandResponse
    about: Callable[[Mapping[str, Any]], Hashable] = lambda _: None
    """Which one of several things it changes; commands about different things do not wait for each other."""
    patience: float = VALID_FOR
    """It is asked for again, with the same id, for so long [s]."""


COMMANDS: dict[str, Kind] = {
    "start": Kind("/task/start", StartTaskRequest, mark("start patrol")),
    "pause": Kind("/task/pause", CommandRequest, mark("pause")),
    "resume": Kind("/task/resume", CommandRequest, mark("resume")),
    "cancel": Kind("/task/cancel", CommandRequest, mark("end the task")),
    "confirm": Kind("/task/confirm", CommandRequest, mark("confirm")),
    "home": Kind("/task/go_home", CommandRequest, mark("go home")),
    "mission": Kind("/mission/set", SetMissionRequest, mark("send the mission")),
    "place": Kind(
        "/places/set",
        SetPlaceRequest,
        mark("keep the place"),
        SetPlaceResponse,
        lambda fields: (fields["place"].id, fields["place"].id or fields["place"].name),
    ),
    "choose_place": Kind(
        "/localisation/choose", ChoosePlaceRequest, mark("choose where it is"), ChoosePlaceResponse
    ),
    "place_delete": Kind(
        "/places/delete",
        DeletePlaceRequest,
        mark("delete the place"),
        DeletePlaceResponse,
        lambda fields: fields["id"],
    ),
    "queue": Kind("/task/queue/set", SetQueueRequest, mark("change the queue"), SetQueueResponse),
    "schedule": Kind(
        "/schedule/set",
        SetScheduleRequest,
        mark("schedule the task"),
        SetScheduleResponse,
        lambda fields: fields["task"].id,
    ),
    "schedule_delete": Kind(
        "/schedule/delete",
        DeleteScheduleRequest,
        mark("take it off the schedule"),
        DeleteScheduleResponse,
        lambda fields: fields["id"],
    ),
    "history": Kind("/history/get", GetHistoryRequest, mark("read the history"), GetHistoryResponse),
    "acknowledge": Kind(
        "/events/acknowledge",
        AcknowledgeEventsRequest,
        mark("note that it was seen to"),
        AcknowledgeEventsResponse,
        lambda fields: tuple(fields["ids"]),
    ),
    "missions": Kind("/missions/get", GetMissionsRequest, mark("list the missions"), GetMissionsResponse),
    "recall": Kind(
        "/mission/recall", RecallMissionRequest, mark("recall the mission"), RecallMissionResponse
    ),
    "acquire": Kind("/control/acquire", CommandRequest, mark("take control")),
    "release": Kind("/control/release", CommandRequest, mark("release control")),
    "request": Kind("/control/request", CommandRequest, mark("ask for control")),
    "grant": Kind("/control/grant", CommandRequest, mark("hand over control")),
    "object": Kind("/control/object", CommandRequest, mark("keep control")),
    "mode": Kind("/mode/set", SetModeRequest, mark("change the mode"), SetModeResponse),
    "setting": Kind(
        "/settings/set",
        SetOptionRequest,
        mark("change the setting"),
        SetOptionResponse,
        lambda fields: fields["name"],
    ),
    "lights": Kind("/lights/set", SetLightsRequest, mark("switch the lights"), SetLightsResponse),
    "arm": Kind("/arm/move", MoveArmRequest, mark("move the arm"), MoveArmResponse),
    "gateway_up": Kind(
        "/gateways/bring_up",
        BringUpGatewayRequest,
        mark("bring the protocol up"),
        BringUpGatewayResponse,
        lambda fields: fields["name"],
        SLOW,
    ),
    "gateway_down": Kind(
        "/gateways/bring_down",
        BringDownGatewayRequest,
        mark("bring the protocol down"),
        BringDownGatewayResponse,
        lambda fields: fields["name"],
        SLOW,
    ),
    "payload": Kind(
        "/payloads/set",
        SetPayloadRequest,
        mark("switch the payload"),
        SetPayloadResponse,
        lambda fields: fields["key"],
    ),
    "reset": Kind("/robot/reset", CommandRequest, mark("put the robot back")),
    "stop": Kind("/stop", CommandRequest, "STOP"),
    "stop_hold": Kind("/stop/hold", CommandRequest, mark("hold Release")),
    "stop_release": Kind("/stop/release", CommandRequest, mark("release STOP")),
}
"""Every one-shot command by its name in the app."""
SERVICES = frozenset(kind.service for kind in COMMANDS.values())
"""What Pilothouse calls of a robot; nothing else of these names is sent to."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of a command so far."""

    name: str
    """Key in `COMMANDS`."""
    command_id: str
    phase: str
    """`sent`, `accepted`, `refused` or `no_reply`."""
    reason: str = ""
    """The robot's own sentence, or what went wrong; empty while it is under way."""
    latency: float = math.nan
    """From the touch to the answer [s]; NaN without one."""
    fields: dict[str, Any] = field(default_factory=dict)
    """What was asked for, beyond the name."""
    answer: Any = None
    """The robot's whole answer, as of `Kind.response`; None without one."""
    origin: Origin = NOBODY
    """By which method it was asked for, and when."""
    sent: float = math.nan
    """When it left for the robot, by our clock [s]."""
    silent: bool = False
    """Of STOP: the robot has not answered at all, and it is still being sent."""

    @property
    def label(self) -> str:
        """The command in the operator's words."""
        order = self.fields.get("order")
        if self.name == "start" and order is not None and order.task:
            return tr("start {task}").format(task=within(title(order)))
        if self.name == "mode":
            return tr("switch to {get}").format(get=self.fields.get("mode", ""))
        return tr(COMMANDS[self.name].label)

    @property
    def sentence(self) -> str:
        """The outcome in one line, as in `Accepted: start patrol (18 ms)`."""
        if self.phase == "sent":
            return tr("Sent: {label} …").format(label=self.label)
        if self.phase == "accepted":
            return tr("Accepted: {label} ({latency:.0f} ms)").format(
                label=self.label, latency=self.latency * 1000
            )
        if self.phase == "refused":
            return tr("Refused: {label}. {reason}").format(label=self.label, reason=self.reason)
        return tr("No reply: {label}. {reason}").format(label=self.label, reason=self.reason)


def _alike(one: object, other: object) -> bool:
    """Ask for the same; NaN is like NaN, and a place that is written alike is the same place."""
    return repr(one) == repr(other)


Call = Callable[..., Awaitable[Any]]
"""`BridgeClient.call`: service, request, response type, keyword timeout [s]."""


class Commands:
    """Sends one-shot commands and tells what became of each. Lives in the network thread."""

    def __init__(
        self,
        call: Call,
        report: Callable[[Outcome], None],
        *,
        now: Callable[[], float],
        robot_time: Callable[[], float],
        new_id: Callable[[], str],
        client_id: str,
        client_name: str,
    ) -> None:
        """`report` gets every step of every command; `robot_time` is NaN while the robot's clock is unknown."""
        self._call, self._report = call, report
        self._now, self._robot_time, self._new_id = now, robot_time, new_id
        self._who = {"client_id": client_id, "client_name": client_name}
        self._under_way: dict[Hashable, Outcome] = {}
        """By command and what it is about."""
        self._next: dict[Hashable, tuple[Origin, dict[str, Any]]] = {}
        """What to ask for, in the same way, once the one that is under way is answered."""
        self._released_before = ""
        """The release of STOP, by its id, that was under way when STOP was pressed: it is asked for no longer."""
        self._stopping: Outcome | None = None
        self.stopped = False
        """STOP is pressed, as the robot itself said last."""
        """The STOP that is being sent; None when there is none, or it was let go."""
        self._stop_confirmed = False

    @property
    def stopping(self) -> bool:
        """STOP was pressed and the robot has not confirmed it."""
        return self._stopping is not None

    async def send(self, name: str, origin: Origin = NOBODY, /, **fields: Any) -> Outcome:
        """Send a command from `origin` and wait for what becomes of it; KeyError for a name not in `COMMANDS`.

        While one of the same name about the same thing is under way, its state is the answer. One that asks for
        something else is sent after it, the newest only; one that asks for the same is not sent again.
        """
        what: Hashable = (name, COMMANDS[name].about(fields))
        under_way = self._under_way.get(what)
        if under_way is not None:
            self._next.pop(what, None)
            if not _alike(fields, under_way.fields):
                self._next[what] = origin, fields
            return under_way
        try:
            outcome = await self._send_one(name, what, origin, fields)
            while what in self._next:
                outcome = await self._send_one(name, what, *self._next.pop(what))
        finally:
            self._next.pop(what, None)
        return outcome

    async def _send_one(self, name: str, what: Hashable, origin: Origin, fields: dict[str, Any]) -> Outcome:
        started = self._now()
        outcome = Outcome(name, self._new_id(), "sent", fields=fields, origin=origin, sent=started)
        request = self._request(outcome, VALID_FOR, fields)
        self._under_way[what] = outcome
        self._report(outcome)
        try:
            outcome = await self._ask(outcome, request, started)
        finally:
            del self._under_way[what]
        self._report(outcome)
        return outcome

    def _request(self, outcome: Outcome, valid_for: float, fields: dict[str, Any]) -> Msg:
        return COMMANDS[outcome.name].request(
            command_id=outcome.command_id,
            stamp=self._robot_time(),
            valid_for=valid_for,
            **self._who,
            **fields,
        )

    async def _ask(self, outcome: Outcome, request: Msg, started: float) -> Outcome:
        """Ask with the same id until there is an answer or the command is too old."""
        kind = COMMANDS[outcome.name]
        deadline = started + kind.patience
        while True:
            if outcome.command_id == self._released_before:
                return replace(outcome, phase="no_reply", reason=tr(TAKEN_BACK))
            timeout = min(TRY, deadline - self._now())
            try:
                answer = await self._call(kind.service, request, kind.response, timeout=timeout)
            except (NoReply, NotConnected) as problem:
                if self._now() + PAUSE >= deadline:
                    return replace(outcome, phase="no_reply", reason=str(problem))
                await asyncio.sleep(PAUSE)
            except Refused as refusal:
                return replace(outcome, phase="refused", reason=str(refusal), latency=self._now() - started)
            except BridgeError as problem:
                return replace(outcome, phase="no_reply", reason=str(problem))
            else:
                phase = "accepted" if answer.success else "refused"
                took = self._now() - started
                code = getattr(answer, "code", "")
                said = sentence(code, getattr(answer, "parameters", ()), answer.message)
                reason = tr(OWN_WORDS.get(code, "")) or said
                return replace(outcome, phase=phase, reason=reason, latency=took, answer=answer)

    async def stop(self, origin: Origin = NOBODY) -> None:
        """Send STOP from `origin` until the robot confirms it, however long that takes and over reconnects.

        Pressed again while it is being sent, nothing changes. A release that is still being sent is taken back: STOP has
        a lane of its own and may come before it.
        """
        self._take_back_release()
        if self._stopping is not None:
            return
        started = self._now()
        outcome = Outcome("stop", self._new_id(), "sent", origin=origin, sent=started)
        self._stopping, self._stop_confirmed = outcome, False
        request = self._request(outcome, NEVER_VOID, {})
        self._report(outcome)
        try:
            await self._repeat_stop(outcome, request, started)
        finally:
            if (
                self._stopping is outcome
            ):  # and not the next one, pressed while this one still awaited an answer
                self._stopping = None

    def _take_back_release(self) -> None:
        self._next.pop(RELEASE, None)
        release = self._under_way.get(RELEASE)
        if release is not None:
            self._released_before = release.command_id

    async def _repeat_stop(self, outcome: Outcome, request: Msg, started: float) -> None:
        doubted = False
        while self._stopping is outcome:
            answer = await self._try_stop(request)
            latency = self._now() - started
            if self._stopping is not outcome:
                return
            if self._stop_confirmed or (answer is not None and answer.success):
                message = answer.message if answer is not None else ""
                self._report(replace(outcome, phase="accepted", reason=message, latency=latency))
                return
            if latency > STOP_DOUBT and not doubted:
                doubted = True
                reason = answer.message if answer is not None else tr(STILL_SENDING)
                self._report(replace(outcome, phase="no_reply", reason=reason, silent=answer is None))
            await asyncio.sleep(STOP_PAUSE)

    async def _try_stop(self, request: Msg) -> CommandResponse | None:
        try:
            answer = await self._call(COMMANDS["stop"].service, request, CommandResponse, timeout=STOP_TRY)
        except Refused as refusal:
            return CommandResponse(success=False, message=str(refusal))
        except BridgeError:
            return None
        return answer  # type: ignore[no-any-return]

    def on_status(self, status: ControlStatus) -> None:
        """What the robot says of STOP."""
        self.stopped = status.stopped
        if status.stopped and status.at_rest:
            self.confirm_stop()

    def confirm_stop(self) -> None:
        """The robot's own status says that it is stopped and rests: no need to go on asking."""
        self._stop_confirmed = True

    def void_stop(self) -> None:
        """The robot turned out to have no such service, or the operator lets STOP go: it is asked for no longer."""
        self._stopping = None

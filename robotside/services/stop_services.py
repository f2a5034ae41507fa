"""The services that press STOP and release it."""

from __future__ import annotations

import math
from collections.abc import Iterable

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import CommandRequest
from robotside.control.stop_release import MIN_HOLD_TIME, NOT_HELD, PRESSED_SINCE
from robotside.core.notice import Notice
from robotside.core.refusal import Refusal
from robotside.services.command_service import CommandService
from robotside.services.preconditions import Preconditions
from robotside.station.station import Station

__all__ = ["press_stop", "stop_services"]


def stop_services(station: Station, answering: CommandService) -> Iterable[Service]:
    """The services of the STOP of `station`."""
    orders = _StopOrders(station)
    yield answering.service("/stop", orders.stop, ageless=True)
    yield answering.service("/stop/hold", orders.hold)
    yield answering.service("/stop/release", orders.release_stop)


def press_stop(station: Station, name: str, client_id: str = "", given: float = math.inf) -> str:
    """Press STOP for `name`, who gave it then [s, operators' clock]; the sentence of success.

    Refusal while the robot may not have obeyed: STOP is pressed all the same, and who pressed it goes on asking.
    """
    station.stop.press(name, client_id, given)
    doubt = station.stop.doubt
    if doubt:
        said = f"STOP is pressed, but {doubt[0].lower()}{doubt[1:]}"
        raise Refusal(Notice(Code.STOP_UNSURE, said))
    return "Stopped."


class _StopOrders:
    """What each service does; a method returns the sentence of success or raises Refusal."""

    def __init__(self, station: Station) -> None:
        self._station, self._permits = station, Preconditions(station)

    def stop(self, client: Operator, asked: CommandRequest) -> str:
        """Latch STOP; it is not done while the robot cannot be reached, so that who pressed it goes on asking."""
        controls = self._station.controls
        given = math.inf if math.isnan(asked.stamp) else asked.stamp
        return press_stop(self._station, controls.name(client), controls.id(client), given)

    def hold(self, client: Operator, asked: CommandRequest) -> str:
        """Begin to hold Release."""
        station = self._station
        if not station.controls.stopped:
            return "STOP is not pressed."
        if not self._pressed(client):
            self._permits.may_change(client)
        given = math.inf if math.isnan(asked.stamp) else asked.stamp
        problem = station.stop.holds.hold(client.id, given, station.clock())
        if problem:
            raise Refusal(problem)
        return f"Hold Release for {MIN_HOLD_TIME:.0f} s."

    def release_stop(self, client: Operator, asked: CommandRequest) -> str:
        """Unlatch STOP after a hold, unless it was pressed after that was asked for: the release was late on its way.

        Without a hold this begins one, for clients that know no other service.
        """
        station = self._station
        controls = station.controls
        if not controls.stopped:
            self._permits.need_control(client)
            return "STOP was not pressed."
        pressed = self._pressed(client)
        if not pressed:
            self._permits.may_change(client)
        if asked.stamp < controls.stop_given:
            raise Refusal(PRESSED_SINCE)
        problem = station.stop.holds.objection(client.id, controls.stop_given, station.clock())
        if problem is NOT_HELD:
            self.hold(client, asked)
        if problem:
            raise Refusal(problem)
        problem = controls.acquire(client, station.clock())
        if problem and not pressed:
            raise Refusal(problem)
        station.stop.release(controls.name(client), controls.id(client))
        return "STOP is released."

    def _pressed(self, client: Operator) -> bool:
        """It was `client` who pressed STOP: it may release it whoever has control."""
        controls = self._station.controls
        return controls.stopped_by_id == controls.id(client)

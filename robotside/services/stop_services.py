"""The services that press STOP and release it."""

from __future__ import annotations

import math
from collections.abc import Iterable

from bridge.core.codes import Code
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs.pilothouse_msgs import CommandRequest
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

    def release_stop(self, client: Operator, asked: CommandRequest) -> str:
        """Unlatch STOP, unless it was pressed after that was asked for: the release was late on its way."""
        self._permits.need_control(client)
        controls = self._station.controls
        if not controls.stopped:
            return "STOP was not pressed."
        if asked.stamp < controls.stop_given:
            said = "STOP was pressed after this request: it stays."
            raise Refusal(Notice(Code.STOP_PRESSED_SINCE, said))
        self._station.stop.release(controls.name(client), controls.id(client))
        return "STOP is released."

"""HTTP statuses of refusals: the code decides, or the kind of error where it has none."""

from __future__ import annotations

from bridge.core.codes import Code
from bridge.core.errors import BridgeError, ProtocolError
from robotside.core.notice import Notice

__all__ = ["Rejected", "code_of", "status_of", "status_of_code"]

_STATUSES = {
    Code.TRUST_UNKNOWN: 401,
    Code.TRUST_KEY: 401,
    Code.TRUST_ROLE: 403,
    Code.TRUST_INSECURE: 403,
    Code.TRUST_ATTEMPTS: 429,
    Code.TRUST_PAIRING_PAUSED: 429,
    Code.WEBHOOK_ADDRESS: 403,
    Code.GATEWAY_FULL: 503,
    Code.GATEWAY_BUSY: 429,
    Code.GATEWAY_STALE: 503,
    Code.GATEWAY_LEFT_OUT: 404,
    Code.GATEWAY_UNDATED: 422,
    Code.DRIVE_UNSTAMPED: 422,
    Code.PLACE_ID_UNKNOWN: 404,
    Code.SCHEDULE_UNKNOWN: 404,
    Code.EVENT_UNKNOWN: 404,
    Code.PICTURE_MISSING: 404,
    Code.MISSION_UNKNOWN: 404,
    Code.TRUST_PERSON_UNKNOWN: 404,
    Code.STOP_UNSURE: 503,
    Code.ROBOT_FAULT: 503,
    Code.RECORDS_UNWRITTEN: 503,
    Code.ROBOT_UNREACHABLE: 503,
    Code.POSITION_UNKNOWN: 409,
    Code.FOLLOWER_UNKNOWN: 409,
    Code.DRIVE_CLOCK_UNKNOWN: 409,
    Code.ARM_GOAL_MISSING: 422,
    Code.MISSION_EMPTY: 422,
    Code.MISSION_TOO_LONG: 422,
    Code.PLACES_MISCOUNTED: 422,
    Code.PLACES_TOO_MANY: 422,
    Code.PLACE_UNNAMED: 422,
    Code.SCHEDULE_TIME_MISSING: 422,
    Code.SCHEDULE_DAY_MISSING: 422,
    Code.EVENTS_TOO_MANY: 422,
    Code.EQUIPMENT_REFUSED: 422,
}
_WRONG_VALUE = ("_invalid", "_unknown")
"""Ends of codes that say that a value of the request is wrong."""


class Rejected(BridgeError):
    """A request that is refused with a status of its own."""

    def __init__(self, status: int, sentence: str, headers: dict[str, str] | None = None) -> None:
        """`sentence` may be a Notice."""
        super().__init__(sentence)
        self.status, self.headers = status, headers or {}


def code_of(error: BridgeError) -> str:
    """The code of a refusal; empty where it has none."""
    said = error.args[0] if error.args else ""
    return said.code if isinstance(said, Notice) else ""


def status_of(error: BridgeError) -> int:
    """The status of a refusal."""
    if isinstance(error, Rejected):
        return error.status
    if isinstance(error, ProtocolError):
        return 422
    return status_of_code(code_of(error))


def status_of_code(code: str) -> int:
    """The status of an answer that says no with that code: 409, the robot's state is against it, where nothing else is known."""
    known = _STATUSES.get(code)  # type: ignore[call-overload]  # a code is a text
    if known is not None:
        return int(known)
    return 422 if code.endswith(_WRONG_VALUE) else 409

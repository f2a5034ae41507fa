"""Requests of the command line to a robot that runs: who may write into its state directory may open pairing.

answer = ask(state, PairRequest(role="drive"))
"""

from __future__ import annotations

import secrets
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import msgspec

from bridge.core.errors import BridgeError
from robotside.trust.private_file import write_private

__all__ = ["ANSWER_TIMEOUT", "NoRobot", "PairAnswer", "PairRequest", "PairRequests", "ask"]

ANSWER_TIMEOUT = 3.0
"""A robot that runs answers within this [s]."""
POLL_PERIOD = 0.05
MAX_BYTES = 10_000
_REQUEST, _ANSWER = "pair-request.json", "pair-answer.json"


class NoRobot(BridgeError):
    """Nobody answered, or with a refusal; the text is one sentence."""


class PairRequest(msgspec.Struct, frozen=True):
    """What is asked for."""

    role: str
    """Of who pairs."""
    duration: float = 0.0
    """Of a guest's role [s]; 0 for a handheld that stays."""
    nonce: str = ""
    """Tells requests apart."""


class PairAnswer(msgspec.Struct, frozen=True):
    """What a running robot answers."""

    nonce: str
    link: str = ""
    code: str = ""
    until: float = 0.0
    """When pairing ends, for a guest when its role ends [s], operators' clock."""
    problem: str = ""
    """Why it is refused, as one sentence; empty when it is open."""


class PairRequests:
    """The robot's side: answers what lies in its state directory."""

    def __init__(self, state: Path, answer: Callable[[PairRequest], PairAnswer]) -> None:
        """`answer` opens pairing. A request that was left from before is forgotten."""
        self._state, self._answer = state, answer
        with suppress(OSError):
            (state / _REQUEST).unlink(missing_ok=True)

    def update(self) -> None:
        """Answer a request if there is one."""
        path = self._state / _REQUEST
        try:
            with path.open("rb") as file:
                content = file.read(MAX_BYTES)
            path.unlink()
            request = msgspec.json.decode(content, type=PairRequest)
            write_private(self._state / _ANSWER, msgspec.json.encode(self._answer(request)))
        except (OSError, msgspec.MsgspecError):
            return  # none is there, or it is not ours to read


def ask(
    state: Path,
    request: PairRequest,
    *,
    sleep: Callable[[float], object] = time.sleep,
    timeout: float = ANSWER_TIMEOUT,
) -> PairAnswer:
    """The answer of the robot that runs with this state directory; NoRobot when none answers within `timeout` [s]."""
    nonce = secrets.token_hex(8)
    asked, answered = state / _REQUEST, state / _ANSWER
    try:
        write_private(asked, msgspec.json.encode(msgspec.structs.replace(request, nonce=nonce)))
        for _ in range(round(timeout / POLL_PERIOD)):
            with suppress(FileNotFoundError, msgspec.MsgspecError):
                answer = msgspec.json.decode(answered.read_bytes(), type=PairAnswer)
                if answer.nonce == nonce:
                    answered.unlink()
                    return _checked(answer)
            sleep(POLL_PERIOD)
        asked.unlink(missing_ok=True)
    except OSError as error:
        why = (error.strerror or str(error)).lower()
        raise NoRobot(f"Robots with their things in {state} cannot be asked: {why}.") from error
    raise NoRobot(f"No robot with its things in {state} runs; start it first, or name another by --state.")


def _checked(answer: PairAnswer) -> PairAnswer:
    if answer.problem:
        raise NoRobot(answer.problem)
    return answer

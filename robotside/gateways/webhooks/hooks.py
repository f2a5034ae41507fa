"""The webhooks of one robot: who wants which events, and their delivery, again after a failure and then no more."""

from __future__ import annotations

import asyncio
import itertools
import secrets
from collections import deque
from typing import Annotated, Any

import msgspec

from bridge.codec import to_json
from bridge.core.address import look_up
from bridge.core.async_tasks import cancel_all, wait
from bridge.core.codes import Code
from bridge.core.errors import ProtocolError, Refused
from bridge.core.identity import Role
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import Event
from robotside.core.notice import Notice
from robotside.door.station_door import StationDoor
from robotside.gateways.webhooks.delivery import TIMEOUT, Undelivered, deliver, signature
from robotside.gateways.webhooks.targets import Asker, Target, check_address, read_target
from robotside.records.events import Say

__all__ = ["BACKOFFS", "MAX_HOOKS", "MAX_WAITING", "Hooks", "Wish"]

MAX_HOOKS = 16
"""Of one robot."""
MAX_WAITING = 64
"""Events that wait for one receiver; beyond them the oldest are left out."""
BACKOFFS = (1.0, 2.0, 4.0, 8.0, 16.0)
"""Between one try and the next [s]; then the event is given up."""
LEVELS = ("info", "ok", "warn", "alarm")


class Wish(msgspec.Struct, forbid_unknown_fields=True):
    """What somebody wants to be told."""

    url: str
    levels: list[str] = []
    """Of the events; empty for all."""
    codes: list[str] = []
    """Of the events; empty for all."""
    secret: Annotated[str, msgspec.Meta(max_length=128)] = ""
    """Signs each delivery; empty for one that the robot makes."""


class _Hook:
    """One of them."""

    def __init__(self, id: int, wish: Wish, target: Target, asker: Asker, operator: Operator) -> None:
        self.id, self.wish, self.target, self.asker = id, wish, target, asker
        self.owner, self.ends = operator.identity.id, operator.identity.ends
        self.waiting: deque[Event] = deque(maxlen=MAX_WAITING)
        self.wake = asyncio.Event()
        self.delivered = self.failed = 0
        self.problem = ""
        self.task: asyncio.Task[None] | None = None

    def wants(self, event: Event) -> bool:
        levels, codes = self.wish.levels, self.wish.codes
        return (not levels or event.level in levels) and (not codes or event.code in codes)

    def shown(self) -> dict[str, Any]:
        return {
            "id": self.id,
            "url": self.target.shown,
            "levels": self.wish.levels,
            "codes": self.wish.codes,
            "delivered": self.delivered,
            "failed": self.failed,
            "waiting": len(self.waiting),
            "problem": self.problem,
        }


class Hooks:
    """Owns the webhooks; they end with it."""

    def __init__(self, door: StationDoor, say: Say) -> None:
        self._door, self._say = door, say
        self._hooks: dict[int, _Hook] = {}
        self._ids = itertools.count(1)

    def __len__(self) -> int:
        return len(self._hooks)

    async def add(self, operator: Operator, found: object) -> dict[str, Any]:
        """Have events sent; what was made, with its secret. ProtocolError or Refused with one sentence when that is not done."""
        self._role(operator)
        wish, owner = _read(found), operator.identity.id
        target = read_target(wish.url)
        try:
            address = await look_up(target.host, TIMEOUT)
        except OSError as error:
            raise ProtocolError(f"url has a host that is not found: {target.host[:100]!r}.") from error
        role = self._role(operator)  # who asks may be another one, or nobody, since the look-up began
        if operator.identity.id != owner:
            said = "The webhook is not made: you are somebody else than who asked for it."
            raise Refused(
                Notice(Code.TRUST_ROLE, said, operation="webhooks", role=role.word, needed=Role.DRIVE.word)
            )
        asker = Asker(operator.address.rpartition(":")[0], role)
        check_address(address, asker)
        if len(self._hooks) >= MAX_HOOKS:
            raise Refused(
                Notice(Code.GATEWAY_FULL, f"There are {MAX_HOOKS} webhooks; remove one.", max=MAX_HOOKS)
            )
        if not wish.secret:
            wish.secret = secrets.token_urlsafe(32)
        hook = _Hook(next(self._ids), wish, target, asker, operator)
        self._hooks[hook.id] = hook
        hook.task = asyncio.create_task(self._run(hook))
        if len(self._hooks) == 1:
            self._door.subscribe(self, "/events", self._on_event)
        self._door.trail.did(operator, "webhook add", target.shown)
        return hook.shown() | {"secret": wish.secret}

    def shown(self, operator: Operator) -> list[dict[str, Any]]:
        """Those that are the operator's; all for who manages the robot."""
        self._role(operator)
        return [hook.shown() for hook in self._hooks.values() if self._may(operator, hook)]

    def remove(self, operator: Operator, id: int) -> bool:
        """End one; False where there is none that the operator may end."""
        self._role(operator)
        hook = self._hooks.get(id)
        if hook is None or not self._may(operator, hook):
            return False
        self._door.trail.did(operator, "webhook remove", hook.target.shown)
        self._end(hook)
        return True

    async def close(self) -> None:
        """End all of them; nothing is left running."""
        tasks = [hook.task for hook in self._hooks.values() if hook.task]
        self._hooks.clear()
        self._door.leave(self)
        await cancel_all(tasks)

    def _role(self, operator: Operator) -> Role:
        """The role of who asks; Refused when it is too small to have anything sent."""
        role = operator.role(self._door.now())
        if role < Role.DRIVE:
            said = f"Webhooks need the role {Role.DRIVE.word}; you have {role.word}."
            raise Refused(
                Notice(Code.TRUST_ROLE, said, operation="webhooks", role=role.word, needed=Role.DRIVE.word)
            )
        return role

    def _may(self, operator: Operator, hook: _Hook) -> bool:
        if operator.role(self._door.now()) >= Role.MANAGE:
            return True
        own = operator.identity.id == hook.owner
        return own and (bool(hook.owner) or operator.address.rpartition(":")[0] == hook.asker.address)

    def _end(self, hook: _Hook) -> None:
        self._hooks.pop(hook.id, None)
        if hook.task is not None:
            hook.task.cancel()
        if not self._hooks:
            self._door.leave(self)

    def _on_event(self, _: str, msg: Msg) -> None:
        if not isinstance(msg, Event):
            return
        for hook in list(self._hooks.values()):
            gone = msg.code == Code.PERSON_REMOVED and hook.owner and msg.actor_id == hook.owner
            if gone or self._door.now() >= hook.ends:
                self._end(hook)
            elif hook.wants(msg) and msg.code != Code.WEBHOOK_FAILED:
                hook.waiting.append(msg)
                hook.wake.set()

    async def _run(self, hook: _Hook) -> None:
        while True:
            while not hook.waiting:
                await wait(hook.wake, None)
            await self._deliver(hook, hook.waiting.popleft())

    async def _deliver(self, hook: _Hook, event: Event) -> None:
        """Send one event until it is taken, or given up; the first that is given up is told of."""
        body = to_json(event)
        for backoff in (*BACKOFFS, None):
            try:
                await deliver(hook.target, hook.asker, self._headers(hook, event, body), body)
            except Undelivered as problem:
                reason = str(problem)[:200]
            else:
                hook.delivered, hook.problem = hook.delivered + 1, ""
                return
            if backoff is not None:
                await asyncio.sleep(backoff)
        hook.failed += 1
        if not hook.problem:
            said = f"The webhook at {hook.target.shown} takes no events: {reason}."
            self._say(
                "control", Notice(Code.WEBHOOK_FAILED, said, url=hook.target.shown, reason=reason), "warn"
            )
        hook.problem = reason

    def _headers(self, hook: _Hook, event: Event, body: bytes) -> dict[str, str]:
        time = f"{self._door.now():.0f}"
        return {
            "Content-Type": "application/json",
            "User-Agent": "Pilothouse",
            "Pilothouse-Robot": self._door.info.name.encode("ascii", "replace").decode(),
            "Pilothouse-Delivery": f"{event.boot}-{event.id}",
            "Pilothouse-Time": time,
            "Pilothouse-Signature": f"sha256={signature(hook.wish.secret, time, body)}",
        }


def _read(found: object) -> Wish:
    """What somebody wants; ProtocolError with one sentence for what cannot be."""
    try:
        wish = msgspec.convert(found, Wish)
    except msgspec.ValidationError as error:
        raise ProtocolError(f"A webhook has url, levels, codes and secret; {error}.") from error
    unknown = sorted(set(wish.levels) - set(LEVELS))
    if unknown:
        raise ProtocolError(f"levels are of {', '.join(LEVELS)}, not {', '.join(unknown)[:100]}.")
    strange = sorted(set(wish.codes) - {code.value for code in Code})
    if strange:
        raise ProtocolError(f"codes are those of docs/bridge.md, not {', '.join(strange)[:100]}.")
    if wish.secret and len(wish.secret) < 16:
        raise ProtocolError("secret has 16 to 128 characters, or is left out: then the robot makes one.")
    return wish

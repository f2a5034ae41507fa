"""Control of one robot: its holder, requests for it, and handover. Watching needs none.

Pure: every call is told the time. Times are seconds of the operators' clock.
"""

from __future__ import annotations

from dataclasses import dataclass

from bridge.core.codes import Code
from bridge.core.identity import Role, public_id
from bridge.core.link_state import CONTROL_TIMEOUT
from bridge.core.robot_catalogue import Operator
from robotside.core.notice import Notice, Problem
from robotside.core.text import number, plain

__all__ = [
    "REQUEST_PAUSE",
    "NOT_ASKED",
    "MAX_OBJECTIONS",
    "TAKEOVER_SILENCE",
    "OBJECTION_TIME",
    "Asker",
    "Authority",
    "Driver",
]

TAKEOVER_SILENCE = 1.0
"""A driver who was not heard for this long may come back over another connection [s]; until then that is somebody else."""

OBJECTION_TIME = 10.0
"""How long a driver has to object before control goes over to who asks for it [s]."""

REQUEST_PAUSE = 30.0
"""Whom a driver objected to may ask the same driver again so long afterwards [s]."""

MAX_REPEATED_OBJECTIONS = 3
"""So often drivers may object to the same asker within OBJECTION_MEMORY; then control goes over."""

OBJECTION_MEMORY = 600.0
"""So long an objection is counted [s]."""

NOT_ASKED = Notice(Code.CONTROL_NOT_ASKED, "No one asks for control.")

MAX_NAME_LENGTH = 40
"""Characters kept of what a client calls itself."""

MAX_ID_LENGTH = 64
"""Characters kept of a client's id."""

_MAX_NAMES = 256
"""Of as many ids it is remembered what they are called."""

MAX_OBJECTIONS = 64
"""As many objections are remembered."""


@dataclass(frozen=True, slots=True)
class Driver:
    """Who has control."""

    client_id: str
    """The public id, as of `Authority.id`."""
    name: str
    client: Operator


@dataclass(frozen=True, slots=True)
class Asker:
    """Who asks the driver for control."""

    client_id: str
    name: str
    client: Operator
    due: float
    """When it goes over unless the driver objects [s]."""


class Authority:
    """Gives control to one operator at a time. Methods that may refuse return why, empty when it is done."""

    def __init__(self) -> None:
        self._driver: Driver | None = None
        self._asker: Asker | None = None
        self._names: dict[str, tuple[str, str]] = {}
        self._called: dict[str, tuple[str, str]] = {}
        """What an id wants to be called and what it is called, the one that was heard last at the end."""
        self._fell = self.fell_id = ""
        """The name of a driver who fell silent, until `mind` has returned it, and the id of the last one who did."""
        self._refused: dict[tuple[str, str], float] = {}
        self._objections: dict[str, list[float]] = {}
        """When drivers objected to an asker lately, by its id [s]."""

    @property
    def driver(self) -> Driver | None:
        """Who has control; None when it is free."""
        return self._driver

    @property
    def asker(self) -> Asker | None:
        """The operator who asks for control; None without one, and always while it is free."""
        return self._asker

    def introduce(self, client: Operator, client_id: str, name: str) -> None:
        """Remember what `client` calls itself, cut to a readable line; empty words change nothing.

        Only a one-way hash of the `client_id` is kept, because whoever repeats it counts as the same client. Who proved
        an identity is known by that, whatever it calls itself. The second id of a name is called `name (2)`.
        """
        identity = client.identity
        if identity.proven:
            called = plain(identity.name, MAX_NAME_LENGTH)
            self._names[client.id] = identity.id, self._apart(identity.id, called)
            return
        client_id, name = public_id(plain(client_id, MAX_ID_LENGTH)), plain(name, MAX_NAME_LENGTH)
        known_id, known_name = self._identity(client)
        client_id, name = client_id or known_id, name or known_name
        own = client_id != client.id  # else there is nothing to tell it by the next time
        self._names[client.id] = (client_id, self._apart(client_id, name) if own else name)

    def _apart(self, client_id: str, name: str) -> str:
        """`name`, with a number behind it where another id is called so: one id is called the same each time."""
        asked, given = self._called.pop(client_id, ("", ""))
        if asked != name:
            taken = {one for _, one in self._called.values()}
            numbered = (f"{name[: MAX_NAME_LENGTH - 6]} ({number})" for number in range(2, _MAX_NAMES + 3))
            given = next(one for one in (name, *numbered) if one not in taken)
        self._called[client_id] = name, given
        while len(self._called) > _MAX_NAMES:
            del self._called[next(iter(self._called))]
        return given

    def knows(self, client: Operator) -> bool:
        """`client` has introduced itself and is still connected."""
        return client.id in self._names

    def name(self, client: Operator) -> str:
        """What to call `client`."""
        return self._identity(client)[1]

    def id(self, client: Operator) -> str:
        """The public id of `client`: the one it proved, else a hash of the `client_id` it gave, else one of its connection."""
        return self._identity(client)[0]

    def holds(self, client: Operator) -> bool:
        """`client` has control, over this connection."""
        return self._driver is not None and self._driver.client.id == client.id

    def objection(self, client: Operator, advice: str = "ask there, or wait until it is released") -> Problem:
        """Why `client` may not change what the robot will do, with an `advice`; empty when it may.

        One id may drive over one connection: another with the same counts as the same only when the first has been
        silent, as one that was cut is.
        """
        held = self._driver
        if held is None or client.id == held.client.id:
            return ""
        if self.id(client) != held.client_id:
            return _held(held, advice)
        if client.last_heard - held.client.last_heard > TAKEOVER_SILENCE:
            return ""
        said = f"{held.name} has control over another connection with the same client_id; {advice}."
        return Notice(Code.CONTROL_HELD_ELSEWHERE, said, actor_id=held.client_id, name=held.name)

    def acquire(self, client: Operator, now: float) -> Problem:
        """Give control to `client` if it is free or its own."""
        self._expire(now)
        problem = self.objection(client)
        if not problem:
            self._give(client)
        return problem

    def settled(self, now: float) -> Driver | None:
        """Who has control at `now` [s], once what is due by then has lapsed or gone over; None when it is free."""
        self._expire(now)
        return self._driver

    def give_back(self, client: Operator, before: Driver | None) -> None:
        """What `client` took control for is refused: if it took it since, control is again with who had it `before`."""
        if self.holds(client):
            self._driver = before

    def release(self, client: Operator) -> Problem:
        """Take control from `client`, for who asked for it if anybody did; or take back that `client` asks for it."""
        if self._asker is not None and self._asker.client.id == client.id:
            self._asker = None
            return ""
        problem = self.objection(client, "only its holder can release it")
        if not problem:
            self._pass_on()
        return problem

    def request(self, client: Operator, now: float) -> Problem:
        """Give control to `client` at once if it may have it, else ask the driver, who has TO_OBJECT to object.

        Asking again changes nothing; there is one who asks at a time.
        """
        problem = self.acquire(client, now)
        held, asker = self._driver, self._asker
        client_id, name = self._identity(client)
        if held is None or not problem or client_id == held.client_id:
            return problem
        if asker is not None:
            return "" if asker.client_id == client_id else _asked_already(asker, held)
        wait = self._refused.get((held.client_id, client_id), now) - now
        if wait > 0:
            said, code = (
                f"{held.name} has objected; ask again in {number(wait)} s.",
                Code.CONTROL_OBJECTED_LATELY,
            )
            return Notice(code, said, actor_id=held.client_id, name=held.name, seconds=wait)
        self._asker = Asker(client_id, name, client, now + OBJECTION_TIME)
        return ""

    def grant(self, client: Operator) -> Problem:
        """The driver hands control over to who asks for it."""
        problem = self._answering(client)
        if not problem:
            self._pass_on()
        return problem

    def object(self, client: Operator, now: float) -> Problem:
        """The driver keeps control; who asked may ask again after REQUEST_PAUSE.

        Not against a manager of the robot, unless the driver is one, and not for ever against the same asker.
        """
        problem = self._answering(client)
        driver, asker = self._driver, self._asker
        if problem or driver is None or asker is None:
            return problem
        if asker.client.role(now) is Role.MANAGE and driver.client.role(now) < Role.MANAGE:
            said = f"{asker.name} manages the robot: control goes over to them."
            return Notice(Code.CONTROL_MANAGER_ASKS, said, actor_id=asker.client_id, name=asker.name)
        who = driver.client_id, asker.client_id
        before = [
            moment for moment in self._objections.pop(asker.client_id, []) if now - moment < OBJECTION_MEMORY
        ]
        if len(before) >= MAX_REPEATED_OBJECTIONS:
            self._objections[asker.client_id] = before
            said = f"{asker.name} was refused {len(before)} times lately: control goes over."
            return Notice(Code.CONTROL_OBJECTED_OFTEN, said, actor_id=asker.client_id, name=asker.name)
        self._objections[asker.client_id] = [*before, now]
        self._refused[who] = now + REQUEST_PAUSE
        while len(self._refused) > MAX_OBJECTIONS:
            del self._refused[next(iter(self._refused))]
        while len(self._objections) > MAX_OBJECTIONS:
            del self._objections[next(iter(self._objections))]
        self._asker = None
        return ""

    def update(self, now: float) -> str:
        """Let control lapse and go over when it is time.

        Returns the name of a driver who fell silent since the last call, whose id is `fell_id`; empty when none did.
        """
        self._expire(now)
        fell, self._fell = self._fell, ""
        return fell

    def _expire(self, now: float) -> None:
        if self._asker is not None and now - self._asker.client.last_heard > CONTROL_TIMEOUT:
            self._asker = None
        if self._driver is not None and now - self._driver.client.last_heard > CONTROL_TIMEOUT:
            self._fell, self.fell_id = self._driver.name, self._driver.client_id
            self._pass_on()
        elif self._asker is not None and now >= self._asker.due:
            self._pass_on()

    def on_gone(self, client: Operator) -> bool:
        """Forget a client whose socket closed; True when it had control."""
        if self._asker is not None and self._asker.client.id == client.id:
            self._asker = None
        held = self.holds(client)
        if held:
            self._pass_on()
        self._names.pop(client.id, None)
        return held

    def _answering(self, client: Operator) -> Problem:
        if self._driver is None or self._asker is None:
            return NOT_ASKED
        if not self.holds(client):
            return _held(self._driver, "only its holder can answer")
        return ""

    def _pass_on(self) -> None:
        """Control leaves its driver: to the one who asks for it, else it is free."""
        asker, self._asker = self._asker, None
        self._driver = Driver(asker.client_id, asker.name, asker.client) if asker else None

    def _give(self, client: Operator) -> None:
        client_id, name = self._identity(client)
        self._driver = Driver(client_id, name, client)

    def _identity(self, client: Operator) -> tuple[str, str]:
        known = self._names.get(client.id, (client.id, f"a client at {client.address}"))
        identity = client.identity
        if identity.proven and known[0] != identity.id:
            return identity.id, plain(identity.name, MAX_NAME_LENGTH)  # it proved it later than it spoke
        return known


def _held(held: Driver, advice: str) -> Notice:
    said = f"{held.name} has control; {advice}."
    return Notice(Code.CONTROL_HELD, said, actor_id=held.client_id, name=held.name)


def _asked_already(asker: Asker, held: Driver) -> Notice:
    said = f"{asker.name} has asked {held.name} for control already; wait for the answer."
    code = Code.CONTROL_ASKED_ALREADY
    return Notice(code, said, actor_id=asker.client_id, name=asker.name, driver=held.name)

"""The audit trail: what is done through the door, as entries of the audit log."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from dataclasses import replace as replaced

from msgspec.structs import replace

from bridge.core.errors import BridgeError
from bridge.core.identity import Role, public_id
from bridge.core.robot_catalogue import Operator, Service
from bridge.msgs import Msg
from robotside.control.authority import Driver
from robotside.core.notice import Notice, coded
from robotside.core.text import plain
from robotside.records.audit import Audit, Entry
from robotside.records.database.audit_rows import UNPROVEN

__all__ = ["READ_ONLY", "AuditTrail"]

READ_ONLY = frozenset(
    {
        "call /events/get",
        "call /events/picture",
        "call /history/get",
        "call /mission/get",
        "call /missions/get",
        "call /people/list",
        "call /people/me",
    }
)
"""Operations that change nothing and are not recorded when they are done."""

PARAMETERS = {
    "/arm/move": ("order.action", "order.pose"),
    "/gateways/bring_down": ("name", "own"),
    "/gateways/bring_up": ("name",),
    "/lights/set": ("brightness",),
    "/localisation/choose": ("id",),
    "/mission/recall": ("name",),
    "/mission/set": ("mission.name",),
    "/mode/set": ("mode",),
    "/payloads/set": ("key", "on"),
    "/people/guest": ("role",),
    "/people/invite": ("role",),
    "/people/remove": ("id",),
    "/places/delete": ("id",),
    "/places/set": ("place.id",),
    "/schedule/delete": ("id",),
    "/schedule/set": ("task.id",),
    "/settings/set": ("name", "value"),
    "/task/queue/set": ("revision",),
    "/task/run": ("task", "instead"),
    "/task/start": ("task", "instead"),
}
"""Of each service the fields of its request that are recorded: no tokens, no names, nowhere that somebody is."""

PUBLISHED = frozenset({"/goal_pose", "/initialpose"})
"""Topics of which messages are recorded; of drive commands it is recorded who has control."""
COUNTED = frozenset(
    {
        "auth",
        "call /pair/begin",
        "call /pair/finish",
        "call /pair/scan",
        "call /stop",
        "stop",
        *(f"publish {topic}" for topic in PUBLISHED),
    }
)
"""Operations that need no role, or may come many times a second: repeated ones are counted, as refused ones are."""
PAIRING = frozenset({"/pair/scan", "/pair/finish"})
"""Services whose answer tells who was paired."""
ACTIONS = frozenset({"/task/run"})
"""Actions, which are carried out as services are."""

REPEAT_PERIOD = 10.0
"""The same again within this is counted, and recorded once [s]."""
MAX_REPEATED = 100
"""Entries whose repetition is counted; beyond, all of one verb count together, whoever asks."""
SEVERAL = "several"
"""Stands for the names of those that are counted together."""
MAX_EACH = 10
"""Of them of one person or host; what comes beyond is counted by its verb."""
MAX_OPERATION = 100
"""Characters of an operation."""
MAX_VALUE = 40
"""Characters of one parameter."""


@dataclass(slots=True)
class _Repeated:
    entry: Entry
    until: float
    more: int = field(default=0)


class AuditTrail:
    """Records who did what. None of its calls waits, and none fails."""

    def __init__(
        self, audit: Audit, clock: Callable[[], float], steady: Callable[[], float] = time.monotonic
    ) -> None:
        """`clock` is the operators' [s], by which entries are stamped; `steady` measures repetitions [s]."""
        self._audit, self._clock, self._steady = audit, clock, steady
        self._repeated: OrderedDict[tuple[str, str, str], _Repeated] = OrderedDict()
        self._driver: Entry | None = None

    def command(self, operator: Operator, service: str, request: Msg, answer: Msg) -> None:
        """A service was done or refused, as its answer says; what changes nothing is not recorded."""
        verb = "run" if service in ACTIONS else "call"
        if f"{verb} {service}" in READ_ONLY:
            return
        code = "" if getattr(answer, "success", True) else getattr(answer, "code", "") or "failed"
        claimed = public_id(getattr(request, "client_id", "")), getattr(request, "client_name", "")
        said = f"{_summary(service, request)} {_new_person(service, answer)}".strip()
        self._add(operator, f"{verb} {service}", f"refused {code}" if code else "done", said, claimed)

    def watched(self, service: Service) -> Service:
        """The service, of which each call is recorded with its outcome."""

        def call(operator: Operator, request: Msg) -> Msg | Awaitable[Msg]:
            try:
                answer = service.call(operator, request)
            except BridgeError as error:
                self.refused(operator, f"call {service.name}", error)
                raise
            if isinstance(answer, Msg):
                self.command(operator, service.name, request, answer)
                return answer
            return self._when_done(operator, service.name, request, answer)

        return replaced(service, call=call)

    async def _when_done(self, operator: Operator, service: str, request: Msg, answer: Awaitable[Msg]) -> Msg:
        try:
            done = await answer
        except BridgeError as error:
            self.refused(operator, f"call {service}", error)
            raise
        self.command(operator, service, request, done)
        return done

    def refused(self, operator: Operator, operation: str, error: BridgeError) -> None:
        """An operation was refused before it began, as for lack of a role."""
        self._add(operator, operation, f"refused {_code(error)}", "", ("", ""))

    def did(self, operator: Operator, operation: str, parameters: str = "") -> None:
        """Something that is no service was done, as `auth`, `pair` or `page /audit.csv`."""
        self._add(operator, operation, "done", parameters, ("", ""))

    def published(self, operator: Operator, topic: str) -> None:
        """A message was taken, whatever the robot made of it."""
        if topic in PUBLISHED:
            self._add(operator, f"publish {topic}", "done", "", ("", ""))

    def unknown(self, address: str, way: str, error: BridgeError) -> None:
        """Somebody showed a wrong key before anything else."""
        host = _host(address)
        self._note(Entry("auth", f"refused {_code(error)}", role=Role.NONE.word, way=way, address=host), host)

    def stopped(self, operator: Operator, name: str, outcome: str) -> None:
        """STOP was pressed by an operator without a session, who calls itself `name`."""
        self._add(operator, "stop", outcome, "", ("", name))

    def control(self, driver: Driver | None) -> None:
        """Who has control now, None when nobody has; what is driven is not recorded message by message."""
        entry = None
        if driver is not None:
            claimed = driver.client_id, driver.name
            entry = self._entry(driver.client, "control", "taken", "", claimed)
        before, self._driver = self._driver, entry
        if before == entry:
            return
        if before is not None:
            self._note(replace(before, outcome="lost"))
        if entry is not None:
            self._note(entry)

    def _add(
        self, operator: Operator, operation: str, outcome: str, parameters: str, claimed: tuple[str, str]
    ) -> None:
        entry = self._entry(operator, operation, outcome, parameters, claimed)
        counted = outcome != "done" or operation in COUNTED
        who = operator.identity
        self._note(entry, (who.id if who.proven else entry.address) if counted else "")

    def _entry(
        self, operator: Operator, operation: str, outcome: str, parameters: str, claimed: tuple[str, str]
    ) -> Entry:
        """What an operator did; `claimed` are its public id and the name that it gives itself."""
        who = operator.identity
        called = who.name if who.proven or not claimed[1] else f"{claimed[1]}{UNPROVEN}"
        return Entry(
            plain(operation, MAX_OPERATION),
            outcome,
            who.id or claimed[0],
            called,
            operator.role(self._clock()).word,
            operator.way,
            _host(operator.address),
            parameters,
        )

    def _note(self, entry: Entry, whose: str = "") -> None:
        """Record an entry; what anybody may cause is counted `whose` it is, so that nobody fills the log."""
        now = self._steady()
        self._tell_repeated(now)
        if whose:
            key = (entry.operation, entry.outcome, whose)
            if key not in self._repeated and sum(each[2] == whose for each in self._repeated) >= MAX_EACH:
                entry = replace(entry, operation=entry.operation.partition(" ")[0], parameters="")
                key = (entry.operation, entry.outcome, whose)
            if key not in self._repeated and len(self._repeated) >= MAX_REPEATED:
                entry = Entry(
                    entry.operation.partition(" ")[0], entry.outcome, "", SEVERAL, "", entry.way, "", ""
                )
                key = (entry.operation, entry.outcome, "")
            if key in self._repeated:
                self._repeated[key].more += 1
                return
            self._repeated[key] = _Repeated(entry, now + REPEAT_PERIOD)
        self._audit.record(entry, self._clock())

    def _tell_repeated(self, now: float) -> None:
        while self._repeated:
            oldest = next(iter(self._repeated.values()))
            if oldest.until > now:
                return
            self._repeated.popitem(last=False)
            if oldest.more:
                again = replace(oldest.entry, outcome=f"{oldest.entry.outcome}, {oldest.more} times more")
                self._audit.record(again, self._clock())


def _summary(service: str, request: Msg) -> str:
    found = []
    for path in PARAMETERS.get(service, ()):
        value: object = request
        for name in path.split("."):
            value = getattr(value, name, "")
        if value not in ("", 0, False):
            found.append(f"{path.rpartition('.')[2]}={plain(str(value), MAX_VALUE)}")
    return " ".join(found)


def _new_person(service: str, answer: Msg) -> str:
    """Who was paired."""
    if service not in PAIRING:
        return ""
    return f"id={getattr(answer, 'id', '')} role={getattr(answer, 'role', '')}"


def _code(error: BridgeError) -> str:
    notice = error.args[0] if error.args else ""
    code = coded(notice).get("code", "") if isinstance(notice, Notice) else ""
    return str(code) or "refused"


def _host(address: str) -> str:
    return address.rpartition(":")[0] or address

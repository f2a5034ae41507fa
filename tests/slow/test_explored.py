"""Every sequence of eight events, by theme: never two drivers, no motion without role and control, no STOP undone by who may not.

Of each theme the summary says how many states and transitions were seen. That the explorer finds what it looks for is shown
by taking safeguards away, one at a time.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from robotside.control.authority import Authority
from robotside.control.command_gate import CommandGate
from robotside.control.neutral_interlock import NeutralInterlock
from robotside.control.stop_release import StopRelease
from robotside.door.door import Door
from robotside.records.events import Events
from robotside.services.audit_trail import AuditTrail
from robotside.station.stop_control import StopControl
from tests.slow.conftest import SEEN
from tests.slow.explored_robot import EVENTS, Violation
from tests.slow.explorer import KILL, Explorer, Life
from tests.slow.snapshots import Living, Snapshot

pytestmark = pytest.mark.slow

DEPTH = 8
FEW_WALKS = 15
"""Enough where one sequence is looked for, not that there is none."""
IN_VAIN = {"W push", "S push", "W request", "W grant", "W hold", "S hold", "S unlatch"}
"""What who may not does: it changes nothing, whatever happened before."""


@pytest.fixture(autouse=True)
def silence(monkeypatch: pytest.MonkeyPatch) -> None:
    """The logs of events and of who did what only grow and move nothing; without them a state is saved in a tenth of the time."""
    monkeypatch.setattr(Events, "say", lambda *_, **__: None)
    for note in ("command", "refused", "did", "published", "control"):
        monkeypatch.setattr(AuditTrail, note, lambda *_: None)


@pytest.mark.parametrize("theme", EVENTS)
def test_no_sequence_breaks_what_must_hold(
    theme: str, record_property: Callable[[str, object], None]
) -> None:
    report = Explorer(EVENTS[theme]).run(DEPTH)
    record_property(SEEN, f"{theme}: {report}")
    assert report.depth == DEPTH
    assert len(report.by_depth) == DEPTH - 1
    assert min(report.by_depth) > 0
    assert set(EVENTS[theme]) - report.effective <= IN_VAIN
    assert not report.effective & IN_VAIN


@pytest.mark.parametrize("theme", EVENTS)
def test_a_state_that_is_put_back_is_the_one_that_was_saved(theme: str) -> None:
    life, choice = Life("", EVENTS[theme]), random.Random(7)

    def walk(length: int) -> list[str]:
        return [choice.choice(EVENTS[theme]) for _ in range(length)]

    for _ in range(60):
        before, after = walk(5), walk(5)
        digests = []
        Living.restore(life.first)
        for event in before:
            life.robot.do(event)
        middle = life.living.save()
        for _ in range(2):
            for event in after:
                life.robot.do(event)
            digests.append(life.digest())
            Living.restore(life.first)
            for event in walk(8):
                life.robot.do(event)
            Living.restore(middle)
        Living.restore(life.first)
        for event in before + after:
            life.robot.do(event)
        digests.append(life.digest())
        assert len(set(digests)) == 1


@pytest.mark.parametrize("theme", EVENTS)
def test_states_that_are_merged_go_on_alike(theme: str) -> None:
    life, choice = Life("", EVENTS[theme]), random.Random(3)
    seen: dict[int, tuple[list[str], Snapshot]] = {}
    pairs = 0
    for _ in range(600):
        before, after = (
            choice.choices(EVENTS[theme], k=choice.randint(2, 6)),
            choice.choices(EVENTS[theme], k=8),
        )
        Living.restore(life.first)
        for event in before:
            life.robot.do(event)
        other, saved = seen.setdefault(life.digest(), (before, life.living.save()))
        if other == before:
            continue
        pairs += 1
        one = [_then(life, event) for event in after]
        Living.restore(saved)
        assert [_then(life, event) for event in after] == one, (other, before, after)
    assert pairs > 100


def _then(life: Life, event: str) -> int:
    life.robot.do(event)
    return life.digest()


def _nothing(*_: object, **__: object) -> None:
    return


def _no_problem(*_: object, **__: object) -> str:
    return ""


def _yes(*_: object, **__: object) -> bool:
    return True


WITHOUT: dict[str, tuple[str, str, Callable[[pytest.MonkeyPatch], None]]] = {
    "roles": (
        "STOP",
        "may not|without the role",
        lambda patch: patch.setattr("robotside.door.door.check_role", _nothing),
    ),
    "the neutral interlock": (
        "lapses of one driver",
        "after a lapse and before a zero",
        lambda patch: patch.setattr(NeutralInterlock, "on_command", lambda *_: True),
    ),
    "its memory of cut connections": (
        "lapses of one driver",
        "after a lapse and before a zero",
        lambda patch: patch.setattr(NeutralInterlock, "_was_left", lambda *_: False),
    ),
    "expiry": (
        "lapses of one driver",
        "after its last command|no one drives it",
        lambda patch: patch.setattr(CommandGate, "expired", lambda *_: False),
    ),
    "the objection of who has control": (
        "two drivers",
        "takes control from who has it|without control",
        lambda patch: patch.setattr(Authority, "objection", _no_problem),
    ),
    "STOP after a restart": (
        "STOP",
        "STOP was undone",
        lambda patch: patch.setattr(StopControl, "recover", _nothing),
    ),
    "the note of STOP": (
        "STOP",
        "on the disk",
        lambda patch: patch.setattr(StopControl, "note", _nothing),
    ),
    "the hold to release STOP": (
        "STOP",
        "without a hold of a second",
        lambda patch: patch.setattr(StopRelease, "objection", _no_problem),
    ),
    "the end of a hold": (
        "STOP",
        "without a hold of a second",
        lambda patch: patch.setattr("robotside.control.stop_release.MAX_HOLD_TIME", 10.0),
    ),
    "the pause after a release": (
        "STOP",
        "right after the last release",
        lambda patch: patch.setattr("robotside.control.stop_release.RELEASE_PAUSE", 0.0),
    ),
    "whose STOP it is": (
        "STOP",
        "the STOP of another",
        lambda patch: patch.setattr("robotside.services.stop_services._StopOrders._pressed", _yes),
    ),
    "the end of who is unpaired": (
        "lapses of one driver",
        "is gone",
        lambda patch: patch.setattr(Door, "expel", _nothing),
    ),
    "the latch at the gate": (
        "STOP",
        "while STOP is pressed|STOP was undone",
        lambda patch: patch.setattr(CommandGate, "stopped", property(lambda _: False)),
    ),
}
"""Of each safeguard the theme that misses it, what is found, and how it is taken away."""


@pytest.mark.parametrize("safeguard", WITHOUT)
def test_a_robot_side_without_a_safeguard_is_found_out(
    safeguard: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    theme, found, take_away = WITHOUT[safeguard]
    take_away(monkeypatch)
    with pytest.raises(Violation, match=found):
        Explorer(EVENTS[theme], FEW_WALKS).run(DEPTH)


def test_a_kill_is_one_of_the_events() -> None:
    report = Explorer(EVENTS["STOP"], FEW_WALKS).run(3)
    assert KILL in report.effective

"""Commands: every one-shot has an answer, STOP does not give up."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import pytest

from app.core.command_origin import Origin
from app.link.commands import COMMANDS, Commands, Outcome
from bridge.core.codes import Code
from bridge.core.errors import NoReply, NotConnected, Refused
from bridge.msgs.pilothouse_msgs import (
    CommandRequest,
    CommandResponse,
    ControlStatus,
    Mission,
    Place,
    SetPlaceResponse,
    TaskOrder,
)
from tests.app import virtual


class Robot:
    """Answers calls by a script: each entry is a response, an error to raise, or a wait [s] before the next."""

    def __init__(self, *script: CommandResponse | Exception | float) -> None:
        self.script = list(script)
        self.calls: list[tuple[str, CommandRequest, float]] = []
        self.reports: list[Outcome] = []

    async def call(self, service: str, request: CommandRequest, response: Any, *, timeout: float) -> Any:
        self.calls.append((service, request, virtual.now()))
        entry = self.script.pop(0) if len(self.script) > 1 else self.script[0]
        while isinstance(entry, float):
            if entry > timeout:
                await asyncio.sleep(timeout)
                raise NoReply("The robot does not answer.")
            await asyncio.sleep(entry)
            entry = self.script.pop(0) if len(self.script) > 1 else self.script[0]
        if isinstance(entry, Exception):
            raise entry
        return entry

    def commands(self) -> Commands:
        numbers = iter(range(100))
        return Commands(
            self.call,
            self.reports.append,
            now=virtual.now,
            robot_time=lambda: virtual.now() + 7000.0,
            new_id=lambda: f"id-{next(numbers)}",
            client_id="me",
            client_name="tablet",
        )

    @property
    def phases(self) -> list[str]:
        return [outcome.phase for outcome in self.reports]

    @property
    def ids(self) -> set[str]:
        return {request.command_id for _, request, _ in self.calls}


YES = CommandResponse(success=True, message="Patrol started.")


def run(robot: Robot, what: Callable[[Commands], Any]) -> Any:
    async def main() -> Any:
        return await what(robot.commands())

    return virtual.run(main())


def test_a_refused_command_tells_the_robots_reason() -> None:
    robot = Robot(CommandResponse(success=False, message="The mission has no points."))
    outcome = run(robot, lambda commands: commands.send("start"))
    assert outcome.sentence == "Refused: start patrol. The mission has no points."
    assert robot.phases == ["sent", "refused"]


@pytest.mark.parametrize(
    ("code", "said"),
    [
        (Code.STOP_NOT_HELD, "STOP stays: hold STOPPED again."),
        (Code.STOP_HELD_SHORT, "STOP stays: hold STOPPED again, for longer."),
        (Code.STOP_PRESSED_SINCE, "Its own words."),
        ("", "Its own words."),
    ],
)
def test_a_release_that_is_refused_names_what_stands_on_the_glass(code: str, said: str) -> None:
    robot = Robot(CommandResponse(success=False, message="Its own words.", code=code))
    assert virtual.run(robot.commands().send("stop_release")).sentence == f"Refused: release STOP. {said}"


def test_a_robot_without_the_service_refuses_in_its_own_words() -> None:
    outcome = run(Robot(Refused("There is no service /task/start.")), lambda commands: commands.send("start"))
    assert (outcome.phase, outcome.reason) == ("refused", "There is no service /task/start.")


def test_a_silent_robot_is_asked_with_the_same_id_until_the_command_is_void() -> None:
    robot = Robot(NoReply("The robot does not answer."))

    async def what(commands: Commands) -> tuple[Outcome, float]:
        start = virtual.now()
        return await commands.send("start"), virtual.now() - start

    outcome, took = run(robot, what)
    assert (outcome.phase, outcome.reason) == ("no_reply", "The robot does not answer.")
    assert len(robot.calls) > 3
    assert len(robot.ids) == 1
    assert took <= 5.0


def test_an_answer_to_a_later_try_is_an_acceptance() -> None:
    robot = Robot(9.0, NotConnected("Not connected."), YES)
    outcome = run(robot, lambda commands: commands.send("start"))
    assert outcome.phase == "accepted"
    assert outcome.latency == pytest.approx(1.2 + 0.2, abs=0.01)
    assert len(robot.calls) == 3


def test_an_acceptance_says_how_long_it_took() -> None:
    outcome = run(Robot(0.018, YES), lambda commands: commands.send("start"))
    assert outcome.sentence == "Accepted: start patrol (18 ms)"


def test_two_taps_send_one_command() -> None:
    robot = Robot(0.2, YES)

    async def what(commands: Commands) -> None:
        await asyncio.gather(commands.send("start"), commands.send("start"))

    run(robot, what)
    assert len(robot.calls) == 1


def test_another_mission_is_sent_after_the_answer_to_the_first_and_only_the_newest() -> None:
    robot = Robot(0.2, YES)
    first, second, third = (Mission(laps=laps) for laps in (1, 2, 3))

    async def what(commands: Commands) -> None:
        await asyncio.gather(*(commands.send("mission", mission=one) for one in (first, second, third)))

    run(robot, what)
    assert [request.mission for _, request, _ in robot.calls] == [first, third]
    answered = [outcome.fields["mission"] for outcome in robot.reports if outcome.phase == "accepted"]
    assert answered == [first, third]
    assert len(robot.ids) == 2


def test_a_return_to_the_mission_that_is_under_way_sends_nothing_else() -> None:
    robot = Robot(0.2, YES)

    async def what(commands: Commands) -> None:
        await asyncio.gather(*(commands.send("mission", mission=Mission(laps=laps)) for laps in (1, 2, 1)))

    run(robot, what)
    assert [request.mission.laps for _, request, _ in robot.calls] == [1]


def test_two_taps_on_start_send_one_order_though_it_leaves_the_speed_open() -> None:
    robot = Robot(0.2, YES)

    async def what(commands: Commands) -> None:
        orders = [
            TaskOrder(task="deliver", places=["Office 12", "Lab"], speed=float("nan")) for _ in range(2)
        ]
        await asyncio.gather(*(commands.send("start", order=order) for order in orders))

    run(robot, what)
    assert len(robot.calls) == 1
    assert robot.reports[-1].sentence.startswith("Accepted: start deliver: Office 12 → Lab")


def test_no_place_takes_the_turn_of_another() -> None:
    robot = Robot(0.2, YES, YES, YES)

    async def what(commands: Commands) -> None:
        await asyncio.gather(*(commands.send("place_delete", id=number) for number in (4, 7, 9)))

    run(robot, what)
    assert sorted(request.id for _, request, _ in robot.calls) == [4, 7, 9]


def test_an_answer_that_says_more_is_handed_on() -> None:
    robot = Robot(SetPlaceResponse(success=True, message="Lab is saved.", id=12))
    outcome = run(robot, lambda commands: commands.send("place", place=Place(name="Lab")))
    assert outcome.answer.id == 12


def test_a_command_tells_who_when_and_how_long_it_is_valid() -> None:
    robot = Robot(YES)
    run(robot, lambda commands: commands.send("mission", mission=Mission(motion="random")))
    service, request, at = robot.calls[0]
    assert service == "/mission/set"
    assert request.mission.motion == "random"
    assert (request.client_id, request.client_name, request.valid_for) == ("me", "tablet", 5.0)
    assert request.stamp == at + 7000.0


def test_stop_is_repeated_with_one_id_over_a_lost_link_until_it_is_confirmed() -> None:
    robot = Robot(*[NotConnected("Not connected.")] * 30, YES)
    run(robot, lambda commands: commands.stop())
    assert len(robot.calls) == 31
    assert len(robot.ids) == 1
    assert robot.phases == ["sent", "no_reply", "accepted"]


def test_stop_does_not_wait_for_another_commands_answer() -> None:
    robot = Robot(0.9, YES, YES)

    async def what(commands: Commands) -> None:
        start = asyncio.create_task(commands.send("start"))
        await asyncio.sleep(0.01)
        await commands.stop()
        await start

    run(robot, what)
    assert [service for service, _, _ in robot.calls] == ["/task/start", "/stop"]
    assert robot.calls[1][2] - robot.calls[0][2] == pytest.approx(0.01)


def test_the_robots_own_status_confirms_stop() -> None:
    robot = Robot(9.0)
    seen: list[bool] = []

    async def what(commands: Commands) -> None:
        loop = asyncio.get_running_loop()
        loop.call_later(1.0, lambda: seen.append(commands.stopping))
        loop.call_later(2.0, commands.confirm_stop)
        await commands.stop()
        assert seen == [True]
        assert not commands.stopping

    run(robot, what)
    assert robot.phases == ["sent", "no_reply", "accepted"]


def test_a_stop_that_the_robot_has_no_service_for_is_given_up_without_a_word() -> None:
    async def run() -> tuple[list[str], bool]:
        robot = Robot(NotConnected("cut"))
        commands = robot.commands()
        asking = asyncio.create_task(commands.stop())
        await asyncio.sleep(0.35)
        commands.void_stop()
        await asyncio.wait_for(asking, 1.0)
        return [outcome.phase for outcome in robot.reports], commands.stopping

    assert virtual.run(run()) == (["sent"], False)


def test_a_stop_pressed_right_after_the_last_was_let_go_is_a_new_one() -> None:
    robot = Robot(9.0, YES)

    async def what(commands: Commands) -> None:
        first = asyncio.create_task(commands.stop())
        await asyncio.sleep(0.1)  # and its answer is still awaited when it is let go
        commands.void_stop()
        await commands.stop()
        await first

    run(robot, what)
    assert [service for service, _, _ in robot.calls] == ["/stop", "/stop"]
    assert len(robot.ids) == 2, "the robot would take the old one for done"
    assert robot.phases == ["sent", "sent", "accepted"]


def test_a_release_that_is_lost_is_taken_back_by_a_stop_after_it() -> None:
    robot = Robot(NotConnected("cut"), *[YES] * 9)

    async def what(commands: Commands) -> Outcome:
        releasing = asyncio.create_task(commands.send("stop_release"))
        await asyncio.sleep(0.01)
        await commands.stop()
        return await releasing

    outcome = run(robot, what)
    assert [service for service, _, _ in robot.calls] == ["/stop/release", "/stop"]
    assert (outcome.phase, outcome.reason) == ("no_reply", "STOP was pressed after it.")


def test_the_next_release_is_sent_as_ever() -> None:
    robot = Robot(NotConnected("cut"), *[YES] * 9)

    async def what(commands: Commands) -> Outcome:
        releasing = asyncio.create_task(commands.send("stop_release"))
        await asyncio.sleep(0.01)
        await commands.stop()
        await releasing
        return await commands.send("stop_release")

    assert run(robot, what).phase == "accepted"


def test_stop_is_never_too_old() -> None:
    robot = Robot(YES)
    run(robot, lambda commands: commands.stop())
    assert robot.calls[0][1].valid_for >= 1e6


def test_stop_pressed_twice_is_one_stop() -> None:
    robot = Robot(0.2, YES)

    async def what(commands: Commands) -> None:
        await asyncio.gather(commands.stop(), commands.stop())

    run(robot, what)
    assert len(robot.ids) == 1


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_every_command_asks_with_a_request_that_has_an_identity(name: str) -> None:
    assert issubclass(COMMANDS[name].request, CommandRequest)
    assert COMMANDS[name].service.startswith("/")
    assert COMMANDS[name].label


def test_each_step_of_a_command_says_whence_it_came_and_when_it_left() -> None:
    robot, voice = Robot(0.018, YES), Origin("voice", confidence=0.9)
    run(robot, lambda commands: commands.send("start", voice))
    assert [(one.phase, one.origin, one.sent) for one in robot.reports] == [
        ("sent", voice, 1000.0),
        ("accepted", voice, 1000.0),
    ]


def test_what_is_asked_for_after_another_of_its_kind_keeps_its_own_origin() -> None:
    robot = Robot(0.018, YES, 0.018, YES)

    async def ask(commands: Commands) -> None:
        first = commands.send("mission", Origin("button"), mission=Mission(laps=1))
        await asyncio.gather(first, commands.send("mission", Origin("shake"), mission=Mission(laps=2)))

    run(robot, ask)
    assert [one.origin.method for one in robot.reports if one.phase == "accepted"] == ["button", "shake"]


def test_stop_says_whence_it_came() -> None:
    robot = Robot(YES)
    run(robot, lambda commands: commands.stop(Origin("shake")))
    assert {one.origin.method for one in robot.reports} == {"shake"}


@pytest.mark.parametrize("answer", [YES, CommandResponse(success=False, message="The connection was cut.")])
def test_what_comes_to_a_stop_that_was_let_go_is_nobodys_news(answer: CommandResponse) -> None:
    """The robot's answer, or none for long, to a STOP that the operator has let go meanwhile."""
    robot = Robot(0.2, answer)

    async def what(commands: Commands) -> None:
        asking = asyncio.create_task(commands.stop())
        await asyncio.sleep(0.1)
        commands.void_stop()
        await asking

    run(robot, what)
    assert robot.phases == ["sent"]


def test_a_stop_that_was_let_go_is_not_confirmed_by_the_next_ones_confirmation() -> None:
    robot = Robot(0.25, NoReply("The robot does not answer."), YES)

    async def what(commands: Commands) -> None:
        first = asyncio.create_task(commands.stop())
        await asyncio.sleep(0.1)
        commands.void_stop()
        second = asyncio.create_task(commands.stop())
        await asyncio.sleep(0)
        commands.confirm_stop()
        await asyncio.gather(first, second)

    run(robot, what)
    assert [one.phase for one in robot.reports if one.command_id == "id-0"] == ["sent"]
    assert robot.phases[-1] == "accepted"


def test_a_command_that_is_asked_for_again_has_the_stamp_of_its_first_try() -> None:
    """The robot judges by it how old the operator's touch is."""
    robot = Robot(NoReply("The robot does not answer."))
    run(robot, lambda commands: commands.send("start"))
    assert {request.stamp for _, request, _ in robot.calls} == {8000.0}


@pytest.mark.parametrize(
    "refusal",
    [CommandResponse(success=False, message="The connection was cut."), Refused("There is no /stop.")],
)
def test_a_stop_that_is_refused_is_sent_again(refusal: CommandResponse | Exception) -> None:
    robot = Robot(refusal, refusal, YES)
    run(robot, lambda commands: commands.stop())
    assert len(robot.calls) == 3
    assert robot.phases == ["sent", "accepted"]


def test_what_confirmed_one_stop_does_not_confirm_the_next() -> None:
    robot = Robot(YES, NotConnected("cut"), NotConnected("cut"), YES)

    async def what(commands: Commands) -> None:
        await commands.stop()
        commands.confirm_stop()
        await commands.stop()

    run(robot, what)
    assert len(robot.calls) == 4


def test_what_takes_the_robot_a_while_is_asked_for_longer_with_one_id_and_is_no_less_void_when_late() -> None:
    robot = Robot(30.0, CommandResponse(success=True, message="mqtt is up."))
    robot.script = [NoReply("The robot does not answer.")] * 20 + [CommandResponse(True, "mqtt is up.")]  # type: ignore[list-item]
    outcome = run(robot, lambda commands: commands.send("gateway_up", name="mqtt", url=""))
    assert (outcome.phase, outcome.reason) == ("accepted", "mqtt is up.")
    assert robot.ids == {"id-0"}
    assert {request.valid_for for _, request, _ in robot.calls} == {5.0}
    silent = Robot(NoReply("The robot does not answer."))
    assert run(silent, lambda commands: commands.send("gateway_down", name="mqtt")).phase == "no_reply"
    assert 39.0 < silent.calls[-1][2] - silent.calls[0][2] <= 40.0


def test_stop_is_known_to_be_pressed_until_the_robot_says_that_it_is_not() -> None:
    robot = Robot(YES)

    async def what(commands: Commands) -> None:
        assert not commands.stopped
        commands.on_status(ControlStatus(stopped=True, at_rest=True))
        await commands.stop()
        assert not commands.stopping
        assert commands.stopped
        commands.on_status(ControlStatus())
        assert not commands.stopped

    run(robot, what)

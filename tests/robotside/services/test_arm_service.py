"""The arm: who has control moves it, STOP ends a motion, the newest order replaces the one before, and both answers say so."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Iterator
from pathlib import Path

import pytest

from bridge.codec import from_json, to_json
from bridge.core.robot_catalogue import Operator
from bridge.msgs import Msg
from bridge.msgs.arrays import Float64Array
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.pilothouse_msgs import ArmOrder, ArmState, MoveArmRequest, MoveArmResponse
from robotside.control.command_gate import STOP_SENTENCE
from robotside.services import arm_service
from tests.fakes import FakeClient
from tests.robotside.hand import Hand

STRETCH, HOME = ArmOrder(pose="stretch"), ArmOrder(pose="home")


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Hand]:
    hand = Hand("patrol", tmp_path, payloads=["arm"])
    yield hand
    hand.close()


def arm(run: Hand, seconds: float = 0.2) -> ArmState:
    """The arm after a while."""
    told: list[Msg] = []
    end = run.station.bus.subscribe("/arm", lambda _, msg: told.append(msg))
    run.wait(seconds)
    end()
    assert isinstance(told[-1], ArmState)
    return told[-1]


def move(run: Hand, order: ArmOrder) -> str:
    return run.ask("/arm/move", MoveArmRequest(order=order)).message


def roll(by: float) -> ArmOrder:
    return ArmOrder(increments=Float64Array([0.0, 0.0, 0.0, 0.0, by]))


# limits and STOP


def test_increments_beyond_a_joint_are_refused_whole_with_the_value_and_what_is_allowed(run: Hand) -> None:
    before = arm(run)
    for by in (9.0, -9.0, math.nan, math.inf):
        order = ArmOrder(increments=Float64Array([0.1, 0.0, 0.0, 0.0, by]))
        answer = run.ask("/arm/move", MoveArmRequest(order=order))
        assert (answer.success, answer.code) == (False, "equipment_refused"), by
        words = f"The joint wrist_roll goes from -2.83 to 2.83 rad, not to {by:g} rad"
        assert answer.message.startswith(words)
    after = arm(run, 0.5)
    assert list(after.angles) == list(after.wanted) == list(before.angles)


def test_increments_move_each_joint_by_so_much(run: Hand) -> None:
    assert move(run, roll(0.3)) == "The arm moves by these increments."
    assert arm(run, 0.5).angles[4] == pytest.approx(0.3)


def test_the_arm_goes_where_it_is_told_and_says_why_it_does_not(run: Hand) -> None:
    assert move(run, HOME) == "The arm goes to home."
    assert arm(run, 2.0).pose == "home"
    assert move(run, ArmOrder(point=Point(2.0, 0.0, 0.4))) == "The arm does not reach (2.00, 0.00, 0.40)."
    assert "knows no pose 'dance'; it knows rest, home, stretch, look_down" in move(
        run, ArmOrder(pose="dance")
    )
    assert move(run, ArmOrder()).startswith("Give the arm a goal")
    assert move(run, ArmOrder(gripper=0.02)) == "The gripper goes to 20 mm."


def test_its_poses_are_data_that_can_be_asked_for_one_by_one(run: Hand) -> None:
    poses = arm(run).poses
    assert len(poses) >= 3
    for pose in reversed(poses):
        move(run, ArmOrder(pose=pose))
        assert arm(run, 2.5).pose == pose


@pytest.mark.parametrize("order", [STRETCH, roll(2.8)])
def test_stop_ends_a_motion_and_the_arm_stays_until_it_is_told_anew(run: Hand, order: ArmOrder) -> None:
    move(run, order)
    run.wait(0.4)
    assert run.ask("/stop").success
    held, later = arm(run), arm(run, 1.0)
    assert list(later.angles) == list(held.angles) == list(later.wanted)
    for refused in (HOME, roll(0.1), ArmOrder(gripper=0.0)):
        assert move(run, refused) == STOP_SENTENCE
    assert run.release_stop().success
    assert list(arm(run, 0.5).angles) == list(held.angles)
    move(run, HOME)
    assert arm(run, 2.0).pose == "home"


def test_stop_holds_the_gripper_too(run: Hand) -> None:
    move(run, ArmOrder(pose="home", gripper=0.0))
    run.wait(0.2)
    run.ask("/stop")
    held = arm(run)
    assert arm(run, 0.5).gripper == held.gripper > 0.0


# who may move it


def test_a_second_client_without_control_is_told_who_has_it_and_moves_nothing(run: Hand) -> None:
    bert = FakeClient("bert", run.now)
    run.station.controls.introduce(bert, "tablet-bert", "Bert")
    assert run.ask("/arm/move", MoveArmRequest(order=STRETCH), by=bert).success, "it was free"
    run.wait(0.2)
    answer = run.ask("/arm/move", MoveArmRequest(order=HOME))
    assert (answer.success, answer.code) == (False, "control_held")
    assert answer.message.startswith("Bert has control; ")
    bert.last_heard = run.now
    assert arm(run, 2.0).pose == "stretch"


def test_the_newest_order_replaces_the_one_before_and_says_so(run: Hand) -> None:
    assert move(run, STRETCH) == "The arm goes to stretch."
    run.wait(0.3)
    assert move(run, HOME) == "The arm goes to home. This replaces an order that was not finished."
    assert arm(run, 2.0).pose == "home"
    assert move(run, STRETCH) == "The arm goes to stretch."


# answers that wait


class Waiting:
    """A call whose answer waits for the arm."""

    def __init__(self, run: Hand, order: ArmOrder, by: Operator | None = None, command_id: str = "") -> None:
        asked = MoveArmRequest(order=order, wait=True, command_id=command_id)
        answer = run.door.services["/arm/move"].call(by or run.anna, asked)
        self.task = asyncio.ensure_future(_given(answer))

    async def over(self, run: Hand, seconds: float = 3.0) -> MoveArmResponse:
        """The answer, within so many seconds of the robot's."""
        for _ in range(round(seconds / 0.1)):
            await _turns()
            if self.task.done():
                break
            run.wait(0.1)
        assert self.task.done(), "no answer"
        answer = self.task.result()
        assert from_json(to_json(answer), MoveArmResponse) == answer, "as it travels"
        return answer


async def _turns() -> None:
    """Let every task do what it can do now."""
    for _ in range(5):
        await asyncio.sleep(0)


async def _given(answer: Msg | Awaitable[Msg]) -> MoveArmResponse:
    given = answer if isinstance(answer, Msg) else await answer
    assert isinstance(given, MoveArmResponse)
    return given


async def test_an_answer_that_waits_comes_when_the_arm_is_there(run: Hand) -> None:
    waiting = Waiting(run, STRETCH)
    run.wait(0.5)
    await _turns()
    assert not waiting.task.done()
    answer = await waiting.over(run)
    assert (answer.success, answer.message) == (True, "The arm is there.")
    assert arm(run).pose == "stretch"


async def test_it_waits_for_the_gripper_as_well(run: Hand) -> None:
    waiting = Waiting(run, ArmOrder(gripper=0.03))
    assert (await waiting.over(run)).success
    assert arm(run, 0.05).gripper == pytest.approx(0.03, abs=1e-3)


async def test_the_older_ones_answer_says_who_replaced_it(run: Hand) -> None:
    run.station.controls.introduce(run.anna, "tablet-anna", "Anna")
    older = Waiting(run, STRETCH)
    await _turns()
    run.wait(0.3)
    newer = Waiting(run, HOME)
    answer = await older.over(run)
    assert (answer.success, answer.code) == (False, "arm_replaced")
    assert answer.message == "Anna gave the arm another order before it was there."
    assert [(each.key, each.value) for each in answer.parameters] == [("name", "Anna")]
    assert (await newer.over(run)).success
    assert arm(run).pose == "home"


async def test_stop_answers_who_waits(run: Hand) -> None:
    waiting = Waiting(run, STRETCH)
    await _turns()
    run.wait(0.3)
    run.ask("/stop")
    answer = await waiting.over(run)
    assert (answer.success, answer.message) == (False, STOP_SENTENCE)


async def test_an_arm_that_is_held_on_its_way_is_not_there(run: Hand) -> None:
    waiting = Waiting(run, STRETCH)
    await _turns()
    run.wait(0.3)
    run.station.robot.hold_payloads()
    answer = await waiting.over(run)
    assert (answer.success, answer.code) == (False, "arm_held")


async def test_what_was_measured_before_the_order_is_no_arrival(run: Hand) -> None:
    before = arm(run)
    waiting = Waiting(run, STRETCH)
    for _ in range(2):  # both came with one step
        run.station.bus.publish("/arm", before)
    await _turns()
    assert not waiting.task.done()
    assert (await waiting.over(run)).success
    assert arm(run).pose == "stretch"


async def test_stop_right_after_the_order_is_no_arrival(run: Hand) -> None:
    waiting = Waiting(run, STRETCH)
    run.ask("/stop")
    assert not (await waiting.over(run)).success


async def test_who_asks_again_with_the_same_id_waits_for_the_first_order_which_is_done_once(
    run: Hand,
) -> None:
    first = Waiting(run, roll(0.4), command_id="one")
    run.wait(0.1)
    again = Waiting(run, roll(0.4), command_id="one")
    assert (await first.over(run)).message == (await again.over(run)).message == "The arm is there."
    late = Waiting(run, roll(0.4), command_id="one")
    assert (await late.over(run)).success
    assert arm(run, 1.0).angles[4] == pytest.approx(0.4)


async def test_a_refusal_is_not_waited_for(run: Hand) -> None:
    answer = await Waiting(run, ArmOrder(pose="dance")).over(run, 0.1)
    assert (answer.success, answer.code) == (False, "equipment_refused")


async def test_an_arm_that_is_not_heard_is_not_waited_for_without_end(
    run: Hand, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(arm_service, "ARRIVAL_TIMEOUT", 0.01)
    answer = await Waiting(run, STRETCH).task
    assert (answer.success, answer.code) == (False, "arm_late")


async def test_who_gives_up_waiting_leaves_nothing_behind(run: Hand) -> None:
    waiting = Waiting(run, STRETCH)
    await _turns()
    waiting.task.cancel()
    await asyncio.gather(waiting.task, return_exceptions=True)
    other = Waiting(run, HOME)
    assert (await other.over(run)).success
    assert asyncio.all_tasks() == {asyncio.current_task()}


# control


@pytest.mark.parametrize("wait", [False, True])
def test_an_order_that_is_refused_takes_no_control(run: Hand, wait: bool) -> None:
    for order in (ArmOrder(pose="zzz"), ArmOrder(), roll(9.0)):
        assert not run.ask("/arm/move", MoveArmRequest(order=order, wait=wait)).success
        assert run.station.controls.driver is None
    run.wait(0.2)
    assert not any("has control" in said for said in run.events)
    assert run.ask("/arm/move", MoveArmRequest(order=STRETCH)).success
    assert run.station.controls.holds(run.anna)

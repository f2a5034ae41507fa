"""Commands by MQTT: who may do what, what is too old, and what is wrong with a message."""

from __future__ import annotations

from pathlib import Path

from bridge.core.codes import Code
from bridge.core.identity import Role
from bridge.msgs.nav_msgs import Odometry
from robotside.core.config import TrustSettings
from robotside.door.station_door import StationDoor
from robotside.trust.people import TOKEN
from robotside.trust.people_file import PeopleFile
from robotside.trust.trust import Trust
from tests.lacking import lacking
from tests.robotside.gateways.mqtt.broker import MOSQUITTO, Broker
from tests.robotside.gateways.mqtt.client import (
    AHEAD,
    FRESH,
    ROOT,
    client,
    codes,
    driving,
    online,
    serving,
    until,
)
from tests.robotside.scene import Scene


async def test_a_driver_drives_with_a_stamp_and_rests_when_it_says_goodbye(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await driving(scene, me)
        await me.send("bye")
        await until(lambda: scene.robot.at_rest)
        assert not scene.control.driver


async def test_a_goodbye_in_another_ones_name_needs_its_token(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await driving(scene, me)
        await me.send("bye", token="another")
        await me.ask("call/rosapi/get_time")
        assert not scene.robot.at_rest


async def test_a_drive_command_of_unknown_or_too_great_age_moves_nothing(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        await me.send("publish/cmd_vel", AHEAD)
        await me.send("publish/cmd_vel", AHEAD, stamp=str(scene.clock))  # of a clock that was never compared
        await me.ask("call/rosapi/get_time")
        await me.send("publish/cmd_vel", AHEAD, expiry=FRESH)
        await me.send("publish/cmd_vel", AHEAD, stamp=str(scene.clock - 1.0))
        await me.ask("call/rosapi/get_time")
        assert scene.robot.at_rest


async def test_a_call_needs_something_that_says_how_old_it_is(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        for said in ({}, {"expiry": 3600}):
            answer = await me.ask("call/control/acquire", **said)
            assert (answer["success"], answer["code"]) == (False, Code.GATEWAY_UNDATED)
        late = await me.ask("call/control/acquire", stamp=str(scene.clock - 60), expiry=FRESH)
        assert (late["success"], late["code"]) == (False, Code.COMMAND_LATE)
        assert not scene.control.driver
        assert (await me.ask("call/control/acquire", {"stamp": scene.clock}))["success"]
        assert (await me.ask("call/control/release", expiry=FRESH))["success"]
        assert (await me.ask("call/control/acquire", stamp=str(scene.clock)))["success"]
        assert scene.control.driver == "me"


async def test_a_retained_command_from_before_is_not_heard(scene: Scene, broker: Broker) -> None:
    async with client(broker) as me:
        await me.send("call/control/acquire", retain=True, expiry=FRESH)
        async with serving(scene, broker.url):
            await online(me)
            await me.ask("call/rosapi/get_time")
            assert not scene.control.driver


async def test_a_command_that_is_to_be_retained_is_refused(scene: Scene, broker: Broker) -> None:
    if not MOSQUITTO:
        lacking("mosquitto", "the other broker does not pass on what is retained")
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        answer = await me.ask("call/control/acquire", retain=True, expiry=FRESH)
        assert (answer["success"], answer["code"]) == (False, Code.GATEWAY_RETAINED)
        assert not scene.control.driver


async def test_a_command_that_is_sent_twice_is_done_once(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        place = {"command_id": "c1", "place": {"name": "Office", "x": 1.0, "y": 1.0}}
        first = await me.ask("call/places/set", place, expiry=FRESH)
        await me.send("bye")  # the next one comes by another operator
        again = await me.ask("call/places/set", place, expiry=FRESH)
        assert first["success"]
        assert again == first
    assert [place.name for place in scene.station.records.places.all()] == ["Office"]


WRONG: dict[str, tuple[bytes, str]] = {
    "publish/cmd_vel": (b'{"linear": {"x": "0.2"}}', "linear.x must be a number or null"),
    "publish/cmd_manoeuvre": (b'{"kind": "rest", "colour": 1}', "has no field"),
    "publish/goal_pose": (b'{"pose": {"position": {"x": NaN}}}', "not JSON"),
    "publish/initialpose": (b"[1]", "must be an object"),
    "publish/odom": (b"{}", "does not listen to"),
    "publish/nothing": (b"{}", "does not carry /nothing"),
    "call/task/start": (b'{"task": 1e999}', "not JSON"),
    "call/mode/set": (b'{"mode": true}', "mode must be a text"),
    "call/people/list": (b"{}", "does not carry /people/list"),
    "call/nothing": (b"{}", "does not carry /nothing"),
    "call/places/set": (b'{"place": {"name": "' + b"x" * 70000 + b'"}}', "at most 65536 bytes"),
}


async def test_what_is_wrong_with_a_message_is_answered_and_nothing_is_done(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        for what, (raw, why) in WRONG.items():
            answer = await me.ask(what, raw, expiry=FRESH)
            assert not answer["success"], what
            assert why in answer["message"], what
        late = await me.ask("call/task/start", {}, stamp="soon")
        assert "is a time in seconds, not 'soon'" in late["message"]
    assert scene.robot.at_rest


async def test_who_has_no_token_has_the_role_of_the_gateway_and_a_token_gives_more(
    scene: Scene, broker: Broker, tmp_path: Path
) -> None:
    trust = Trust(PeopleFile(tmp_path), scene.station.clock, TrustSettings())
    _, token = await trust.add("Anna", Role.DRIVE, TOKEN)
    door = StationDoor(scene.station, trust)
    try:
        async with serving(scene, broker.url, "role=watch", door), client(broker) as me:
            await online(me)
            refused = await me.ask("call/control/acquire", expiry=FRESH)
            assert (refused["success"], refused["code"]) == (False, Code.TRUST_ROLE)
            wrong = await me.ask("call/control/acquire", expiry=FRESH, token=token[:-1] + "~")
            assert (wrong["success"], wrong["code"]) == (False, Code.TRUST_KEY)
            assert (await me.ask("call/control/acquire", expiry=FRESH, token=token))["success"]
            assert scene.control.driver == "Anna"
        assert Code.GATEWAY_OPEN not in codes(scene)
    finally:
        door.close()
        trust.close()


async def test_wrong_tokens_of_one_client_lock_out_no_other_at_the_broker(
    scene: Scene, broker: Broker, tmp_path: Path
) -> None:
    trust = Trust(PeopleFile(tmp_path), scene.station.clock, TrustSettings())
    _, token = await trust.add("Anna", Role.DRIVE, TOKEN)
    door = StationDoor(scene.station, trust)
    try:
        async with (
            serving(scene, broker.url, "role=watch", door),
            client(broker) as me,
            client(broker, "other") as other,
        ):
            await online(me)
            for code in [Code.TRUST_KEY] * 5 + [Code.TRUST_ATTEMPTS]:
                wrong = await other.ask("call/control/acquire", expiry=FRESH, token=token[:-1] + "~")
                assert wrong["code"] == code
            assert (await me.ask("call/control/acquire", expiry=FRESH, token=token))["success"]
    finally:
        door.close()
        trust.close()


async def test_without_a_role_the_gateway_lets_watch(scene: Scene, broker: Broker, tmp_path: Path) -> None:
    async with serving(scene, broker.url, ""), client(broker) as me:
        await online(me)
        assert (await me.told("topics/control/status"))["mode"]
        refused = await me.ask("call/control/acquire", expiry=FRESH)
        assert refused["code"] == Code.TRUST_ROLE


async def test_an_answer_goes_below_the_clients_own_topic_and_nowhere_else(
    scene: Scene, broker: Broker
) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        mine = f"{ROOT}/clients/me/answer/42"
        assert "time" in await me.ask("call/rosapi/get_time", wish=mine)
        await me.send("call/rosapi/get_time", wish=f"{ROOT}/clients/other/call/stop")
        await until(lambda: f"{ROOT}/clients/me/answer/rosapi/get_time" in me.heard)
    assert not scene.station.controls.stopped


async def test_a_goal_runs_with_feedback_and_is_taken_back(scene: Scene, broker: Broker) -> None:
    scene.run(4.0)  # until it knows where it is
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        hold = {"order": {"task": "hold", "duration": 600.0}}
        await me.send("run/task/run", hold, expiry=FRESH)
        engine = scene.station.autonomy.engine
        await until(lambda: engine.running)
        scene.run(2.0)
        assert "progress" in await me.told("clients/me/feedback/task/run")
        await me.send("cancel/task/run")
        answer = await me.told("clients/me/answer/task/run")
        assert (answer["success"], answer["code"]) == (False, Code.GATEWAY_CANCELLED)
        scene.run(0.5)
        assert not engine.running


async def test_what_is_made_on_demand_comes_while_its_client_is_there(scene: Scene, broker: Broker) -> None:
    async with serving(scene, broker.url), client(broker) as me:
        await online(me)
        assert (await me.ask("read/sim/ground_truth"))["success"]
        scene.station.bus.publish("/sim/ground_truth", Odometry())
        assert "pose" in await me.told("topics/sim/ground_truth")
        await me.send("bye")
        await until(lambda: not scene.robot.wanted["/sim/ground_truth"])

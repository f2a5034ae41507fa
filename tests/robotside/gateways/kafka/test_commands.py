"""Commands by Kafka: who may do what, what is too old, and what is wrong with a record."""

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
from tests.robotside.gateways.kafka.client import AHEAD, client, codes, driving, online, serving, until
from tests.robotside.gateways.kafka.cluster import Cluster
from tests.robotside.scene import Scene

HOLD = {"order": {"task": "hold", "duration": 600.0}}


async def test_a_drive_command_of_unknown_or_too_great_age_moves_nothing(
    scene: Scene, cluster: Cluster
) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        await me.send("publish", "/cmd_vel", AHEAD)  # of a clock that was never compared
        await me.ask("call", "/rosapi/get_time")
        await me.send("publish", "/cmd_vel", AHEAD, stamp=None)
        await me.send("publish", "/cmd_vel", AHEAD, stamp=scene.clock - 0.3)
        await me.ask("call", "/rosapi/get_time")
        assert scene.robot.at_rest


async def test_commands_from_before_the_robot_came_are_not_heard(scene: Scene, cluster: Cluster) -> None:
    async with client(scene, cluster) as me:
        await me.send("call", "/control/acquire")
        async with serving(scene, cluster) as gateway:
            await online(gateway)
            await me.ask("call", "/rosapi/get_time")
            assert not scene.control.driver


async def test_every_command_needs_a_stamp_that_is_fresh(scene: Scene, cluster: Cluster) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        for said, code in (
            ({"stamp": None}, Code.GATEWAY_UNDATED),
            ({"stamp": scene.clock - 60}, Code.COMMAND_LATE),
            ({"stamp": scene.clock + 60}, Code.COMMAND_AHEAD),
        ):
            answer = await me.ask("call", "/control/acquire", **said)
            assert (answer["success"], answer["code"]) == (False, code)
        assert not scene.control.driver
        assert (await me.ask("call", "/control/acquire"))["success"]
        assert scene.control.driver == "me"


async def test_a_driver_drives_with_a_stamp_and_rests_when_it_says_goodbye(
    scene: Scene, cluster: Cluster
) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        await driving(scene, me)
        await me.send("bye", token="another")
        await me.ask("call", "/rosapi/get_time")
        assert not scene.robot.at_rest
        await me.send("bye", stamp=None)
        await until(lambda: scene.robot.at_rest)
        assert not scene.control.driver


async def test_a_command_that_is_sent_twice_is_done_once(scene: Scene, cluster: Cluster) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        place = {"command_id": "c1", "place": {"name": "Office", "x": 1.0, "y": 1.0}}
        first = await me.ask("call", "/places/set", place)
        await me.send("bye")  # the next one comes by another operator
        again = await me.ask("call", "/places/set", place)
        assert first["success"]
        assert again == first
    assert [place.name for place in scene.station.records.places.all()] == ["Office"]


WRONG: dict[tuple[str, str], tuple[bytes, str]] = {
    ("publish", "/cmd_vel"): (b'{"linear": {"x": "0.2"}}', "linear.x must be a number or null"),
    ("publish", "/cmd_manoeuvre"): (b'{"kind": "rest", "colour": 1}', "has no field"),
    ("publish", "/goal_pose"): (b'{"pose": {"position": {"x": NaN}}}', "not JSON"),
    ("publish", "/odom"): (b"{}", "does not listen to"),
    ("call", "/task/start"): (b'{"task": 1e999}', "not JSON"),
    ("call", "/people/list"): (b"{}", "does not carry /people/list"),
    ("call", "/places/set"): (b'{"place": {"name": "' + b"x" * 70000 + b'"}}', "at most 65536 bytes"),
    ("run", "/nothing"): (b"{}", "does not carry /nothing"),
    ("read", "/cmd_vel"): (b"{}", "it listens there"),
    ("call", "arm/move"): (b"{}", "a name with a slash before it"),
}


async def test_what_is_wrong_with_a_record_is_answered_and_nothing_is_done(
    scene: Scene, cluster: Cluster
) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        for number, ((verb, name), (raw, why)) in enumerate(WRONG.items()):
            await me.send(verb, name, raw)
            await until(lambda: len(me.heard.get("answers", ())) > number)  # noqa: B023 - awaited at once
            answer = me.heard["answers"][-1]
            assert not answer["success"], name
            assert why in answer["message"], name
        late = await me.ask("call", "/task/start", {}, stamp="soon")
        assert "The header stamp is a time in seconds, not 'soon'" in late["message"]
        await me.put("commands", b"{}", [("call", b"/task/start"), ("run", b"/task/run")])
        await until(lambda: "one header of publish, call" in me.heard["answers"][-1]["message"])
        for key in (b"", b"\xff", b"m" * 65):  # nobody to answer
            await me.put("commands", b"{}", [("call", b"/control/acquire")], key)
        await me.ask("call", "/rosapi/get_time")
    assert scene.robot.at_rest
    assert not scene.control.driver


async def test_who_has_no_token_has_the_role_of_the_gateway_and_a_token_gives_more(
    scene: Scene, cluster: Cluster, tmp_path: Path
) -> None:
    trust = Trust(PeopleFile(tmp_path), scene.station.clock, TrustSettings())
    _, token = await trust.add("Anna", Role.DRIVE, TOKEN)
    door = StationDoor(scene.station, trust)
    try:
        async with serving(scene, cluster, "", door) as gateway, client(scene, cluster) as me:
            await online(gateway)
            refused = await me.ask("call", "/control/acquire")
            assert (refused["success"], refused["code"]) == (False, Code.TRUST_ROLE)
            wrong = await me.ask("call", "/control/acquire", token=token[:-1] + "~")
            assert (wrong["success"], wrong["code"]) == (False, Code.TRUST_KEY)
            assert (await me.ask("call", "/control/acquire", token=token))["success"]
            assert scene.control.driver == "Anna"
        assert Code.GATEWAY_OPEN not in codes(scene)
    finally:
        door.close()
        trust.close()


async def test_a_goal_runs_with_feedback_and_is_taken_back(scene: Scene, cluster: Cluster) -> None:
    scene.run(4.0)  # until it knows where it is
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        await me.send("run", "/task/run", HOLD, id="g7")
        engine = scene.station.autonomy.engine
        await until(lambda: engine.running)
        scene.run(2.0)
        await until(lambda: any("feedback" in each for each in me.headers.get("answers", ())))
        await me.send("cancel", "/task/run", id="g7")
        answer = await me.answer("g7")
        assert (answer["success"], answer["code"]) == (False, Code.GATEWAY_CANCELLED)
        scene.run(0.5)
        assert not engine.running


async def test_what_is_made_on_demand_comes_while_its_client_is_there(scene: Scene, cluster: Cluster) -> None:
    async with serving(scene, cluster) as gateway, client(scene, cluster) as me:
        await online(gateway)
        assert (await me.ask("read", "/sim/ground_truth"))["success"]
        scene.station.bus.publish("/sim/ground_truth", Odometry())
        assert "pose" in await me.told("topics.sim.ground_truth")
        await me.send("bye")
        await until(lambda: not scene.robot.wanted["/sim/ground_truth"])

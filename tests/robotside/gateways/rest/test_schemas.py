"""Schemas and the OpenAPI description: of the message classes as they are, and of the paths as they run."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from jsonschema_rs import Draft202012Validator

from bridge.codec import to_json
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import ArmState, ScheduledTask, TaskOrder, Waypoint
from bridge.msgs.sensor_msgs import CompressedImage, LaserScan
from bridge.msgs.std_msgs import Time
from robotside.gateways.rest.commands import COMMANDS
from robotside.gateways.rest.schemas import Schemas
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.gateways.rest.served import serving
from tests.robotside.scene import Scene


def validator(cls: type[Msg]) -> Draft202012Validator:
    schemas = Schemas()
    return Draft202012Validator(schemas.of(cls) | {"components": {"schemas": schemas.components}})


@pytest.mark.parametrize(
    "msg",
    [
        ScheduledTask(at="08:00", order=TaskOrder(task="go_to", goals=[Waypoint(1.0)])),
        CompressedImage(data=b"\xff\xd8"),
        LaserScan(),
        ArmState(),
    ],
)
def test_what_the_robot_sends_is_as_its_schema_says(msg: Msg) -> None:
    validator(type(msg)).validate(json.loads(to_json(msg)))


@pytest.mark.parametrize(
    ("cls", "wrong"),
    [
        (TaskOrder, {"tusk": "patrol"}),
        (TaskOrder, {"speed": "1"}),
        (TaskOrder, {"speed": True}),
        (TaskOrder, {"places": "A"}),
        (TaskOrder, {"goals": [{"x": 1, "q": 2}]}),
        (TaskOrder, {"id": 2**31}),
        (ScheduledTask, {"days": [True] * 6}),
        (CompressedImage, {"data": 7}),
        (Time, {"secs": 1.5}),
    ],
)
def test_what_the_robot_refuses_its_schema_refuses(cls: type[Msg], wrong: dict[str, Any]) -> None:
    assert not validator(cls).is_valid(wrong)


async def test_the_description_has_each_path_that_runs_and_each_example_is_as_its_schema_says(
    tmp_path: Path,
) -> None:
    scene = Scene(EquippedRobot(), tmp_path)
    scene.run(1.0)
    async with serving(scene) as served, served.client() as web:
        told = (await web.get("openapi.json")).json()
    assert told["openapi"].startswith("3.1")
    examples = 0
    for path, methods in told["paths"].items():
        for method, operation in methods.items():
            assert operation["summary"].endswith("."), (method, path)
            assert "'S" not in operation["summary"], "as written, not in title case"
            assert {"401", "403", "503"} <= set(operation["responses"]) or path == "/stop"
            content = operation.get("requestBody", {}).get("content", {}).get("application/json", {})
            if "example" in content:
                examples += 1
                schema = content["schema"] | {"components": told["components"]}
                Draft202012Validator(schema).validate(content["example"])
    for command in COMMANDS:
        assert command.method.lower() in told["paths"][command.path]
    assert examples > 10
    ids = [each["operationId"] for methods in told["paths"].values() for each in methods.values()]
    assert len(set(ids)) == len(ids)

"""The sheet as page and text: all that runs is there, and nothing that somebody else wrote becomes HTML."""

from __future__ import annotations

import time
from pathlib import Path

import msgspec
import pytest

from robotside.gateways.usage_sheet.rendering import Parts, as_page, as_text, strangers_page
from robotside.gateways.usage_sheet.running import Running
from robotside.gateways.usage_sheet.sheet import Sheet, make_sheet, rosbridge_message
from tests.robotside.gateways.payloads.test_table import EquippedRobot
from tests.robotside.scene import Scene

EVIL = "\"><script>alert(1)</script>&'${7*7}"
GATEWAY = Running("mqtt", f"doc {EVIL}", f"mqtt://{EVIL}", f"guide {EVIL}\nmosquitto_pub -t x")


@pytest.fixture
def sheet(tmp_path: Path) -> Sheet:
    robot = EquippedRobot()
    robot.info = msgspec.structs.replace(robot.info, name=EVIL, description=EVIL, world=EVIL)
    scene = Scene(robot, tmp_path)
    scene.clock = time.time()
    scene.run(1.0)
    return make_sheet(scene.door, "ws://192.0.2.7:9090", "http://127.0.0.1:8080", [GATEWAY])


def test_nothing_that_others_wrote_becomes_html(sheet: Sheet) -> None:
    for page in (as_page(sheet, Parts(EVIL, link=EVIL, qr="<svg></svg>")), strangers_page(EVIL, EVIL)):
        assert "<script" not in page
        assert "49" not in page.partition("<body>")[2].partition("</header>")[0]
        assert "&lt;script&gt;" in page
        assert f'"{EVIL}' not in page


def test_every_gateway_and_payload_that_is_there_is_on_the_page(sheet: Sheet) -> None:
    page = as_page(sheet, Parts("ws://192.0.2.7:9090"))
    assert 'data-gateway="mqtt"' in page
    keys = [each.payload.key for each in sheet.payloads]
    assert {"robot", "wheels", "tasks"} <= set(keys)
    assert "sonar" not in keys, "this robot has none"
    for each in sheet.payloads:
        assert f"<summary>{each.payload.key} <span" in page
        for line in each.lines:
            assert f">{line.name}</span>" in page


def test_the_text_has_the_same_and_can_be_pasted_too(sheet: Sheet) -> None:
    text = as_text(sheet)
    lines = [line.strip() for line in text.splitlines()]
    for each in sheet.payloads:
        assert all(rosbridge_message(line) in lines for line in each.lines)
    assert all(command.line in lines for command in sheet.commands)
    assert GATEWAY.guide in text


def test_nothing_comes_from_another_place_and_no_script_is_needed(sheet: Sheet) -> None:
    page = as_page(sheet, Parts("ws://h:1", link="pilothouse://h:1?n=x", qr="<svg></svg>"))
    for word in ("src=", "<link", "@import", "url(", "<script"):
        assert word not in page


def test_without_a_way_from_outside_no_link_is_shown_and_what_opens_one_is_said(sheet: Sheet) -> None:
    page = as_page(sheet, Parts("ws://127.0.0.1:9090"))
    assert "pilothouse://" not in page
    assert "--host 0.0.0.0 --pair" in page

"""The lines at the head of a widget's module are all that somebody else's Kivy app needs: they run as they stand, without ours."""

from __future__ import annotations

import ast
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from widgets import CATALOGUE

ROOT = Path(__file__).parents[2]
LINES = 3
NAMES = ("DPad", "DiagnosticsTree", "Lamp", "MomentaryButton", "TickBox", "ToggleSwitch", "TurnTape")
PROGRAM = """
import json, sys
from tests.headless import Stage, prepare
prepare("logic")
stage, found = Stage(), {}
class Robot:
    def __init__(self): self.heard, self.sent = {}, []
    def on(self, topic, show): self.heard[topic] = show
    def publish(self, topic, msg): self.sent.append((topic, msg.MSGTYPE))
    def command(self, msg): self.sent.append(("drive", msg.MSGTYPE))
import widgets
for name, lines in json.load(sys.stdin).items():
    robot = Robot()
    scope = {name: getattr(widgets, name), "robot": robot, "drive": robot}
    exec(lines, scope)
    widget = next(one for one in scope.values() if isinstance(one, getattr(widgets, name)))
    stage.show(widget, size=(300, 160))
    for topic, show in robot.heard.items():
        kind = widget.accepts[0]
        show(kind() if kind is not widgets.core.base.Msg else __import__("bridge.msgs.std_msgs", fromlist=["Bool"]).Bool(True))
    finger = stage.touch(150, 130)
    finger.touch_down(); stage.frames(2); finger.touch_up(); stage.run_for(0.3)
    found[name] = [sorted(robot.heard), sorted({kind for _, kind in robot.sent})]
    stage.window.remove_widget(widget)
found["app"] = sorted(name for name in sys.modules if name.split(".")[0] in ("app", "robotside", "sim"))
print(json.dumps(found))
"""


def head(name: str) -> str:
    """The code in a module's docstring, which Python itself may have left out."""
    source = (ROOT / CATALOGUE[name].replace(".", "/")).with_suffix(".py").read_text(encoding="utf-8")
    _, _, code = ast.get_docstring(ast.parse(source)).partition("\n\n")
    return code.rpartition("\n\n")[2]


@pytest.fixture(scope="module")
def ran() -> dict[str, list[list[str]]]:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        input=json.dumps({name: head(name) for name in NAMES}),
        capture_output=True,
        text=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        check=False,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.parametrize("name", NAMES)
def test_a_widget_takes_three_lines(name):
    assert 1 <= len(head(name).splitlines()) <= LINES


def test_nothing_of_the_app_is_needed(ran):
    assert ran["app"] == []


@pytest.mark.parametrize(
    ("name", "hears", "sends"),
    [
        ("TurnTape", ["/imu/data"], []),
        ("DiagnosticsTree", ["/diagnostics"], []),
        ("Lamp", ["/door/open"], []),
        ("DPad", [], ["geometry_msgs/Twist"]),
        ("ToggleSwitch", ["/lights/on"], ["std_msgs/Bool"]),
        ("TickBox", ["/avoidance/on"], ["std_msgs/Bool"]),
        ("MomentaryButton", [], ["std_msgs/Bool"]),
    ],
)
def test_those_lines_show_and_send(ran, name, hears, sends):
    assert ran[name] == [hears, sends]

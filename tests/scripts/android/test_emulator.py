"""A device is installed on, turned and stopped through adb, and judged by a real robot side; the device itself is one that these tests play."""

from __future__ import annotations

import json
import socket
import sys
from pathlib import Path

import pytest

from scripts.android.emulator import Phone, Screen, passes, stop_point
from scripts.android.failure import Failed

DEVICE = '''#!{python}
"""Stands for adb and a phone: keeps how it is turned in a file, connects when a link is opened, and presses STOP where it is tapped."""
import json, subprocess, sys
from pathlib import Path
sys.path.insert(0, {root!r})
kept = Path({kept!r})
state = json.loads(kept.read_text())
words = sys.argv[1:]
if words[0] == "shell":
    words = words[1:]
state["calls"].append(" ".join(words))
width, height = (2400, 1080) if state["turned"] else (1080, 2400)
if words[:2] == ["am", "start"] and not state["deaf"]:
    state["port"] = int(words[words.index("-d") + 1].partition("?")[0].rpartition(":")[2])
    code = "from bridge.client.remote_robot import RemoteRobot\\nimport sys, time\\n" \\
        "with RemoteRobot('ws://127.0.0.1:%d') as robot:\\n robot.wait(30)\\n sys.stdin.read()" % state["port"]
    phone = subprocess.Popen([sys.executable, "-c", code], cwd={root!r}, stdin=open(kept.parent / "line"),
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
elif words[:2] == ["settings", "put"] and words[3] == "user_rotation":
    state["turned"] = words[4] == "1"
    state["pid"] += state["fragile"]
elif words[0] == "dumpsys":
    print("  init=1080x2400 420dpi cur=%dx%d app=1080x2274" % (width, height))
elif words[:2] == ["wm", "density"]:
    print("Physical density: 420")
elif words[0] == "pidof":
    print(state["pid"])
elif words[0] == "exec-out":
    sys.stdout.buffer.write(b"\\x89PNG" if state["shows"] else b"")
elif words[:2] == ["input", "tap"]:
    state["tapped"] = [int(words[2]), int(words[3])]
    if not state["numb"]:
        from bridge.client.remote_robot import RemoteRobot
        with RemoteRobot("ws://127.0.0.1:%d" % state["port"]) as robot:
            robot.wait(30)
            robot.call("/stop")
kept.write_text(json.dumps(state))
'''
ROOT = Path(__file__).parents[3]
GOOD = {"calls": [], "turned": False, "deaf": False, "fragile": 0, "numb": False, "shows": True, "pid": 4711}


class Device:
    """The played device; what it did is in `state`."""

    def __init__(self, folder: Path) -> None:
        self.kept, self.adb = folder / "state.json", folder / "adb"
        self.adb.write_text(DEVICE.format(python=sys.executable, root=str(ROOT), kept=str(self.kept)))
        self.adb.chmod(0o755)
        self.be()

    def be(self, **traits: object) -> None:
        self.kept.write_text(json.dumps({**GOOD, **traits}))

    @property
    def state(self) -> dict[str, object]:
        return json.loads(self.kept.read_text())


@pytest.fixture
def device(tmp_path):
    import os

    os.mkfifo(tmp_path / "line")
    # the app's connection lives as long as this end of it is open
    line = os.open(tmp_path / "line", os.O_RDWR)
    yield Device(tmp_path)
    os.close(line)


@pytest.fixture
def port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def story(device: Device, folder: Path, port: int, patience: float = 60.0) -> list[str]:
    out = folder / "pictures"
    return list(passes(Phone(str(device.adb)), folder / "app.apk", out, port=port, patience=patience))


@pytest.mark.parametrize(
    ("screen", "lower", "right"),
    [
        (Screen(1080, 2400, 2.625), 0.6, 0.5),
        (Screen(2400, 1080, 2.625), 0.6, 0.7),
        (Screen(1280, 800, 1.0), 0.6, 0.6),
    ],
)
def test_stop_is_in_the_lower_right_corner_of_every_screen(screen, lower, right):
    x, y = stop_point(screen)
    assert screen.width * right < x < screen.width
    assert screen.height * lower < y < screen.height


def test_a_good_device_passes_every_step(device, tmp_path, port):
    lines = story(device, tmp_path, port)
    assert [line.partition(":")[0] for line in lines] == [
        "installed",
        "connected",
        "turned",
        "stopped",
        "pictures",
    ]
    assert device.state["tapped"] == list(stop_point(Screen(2400, 1080, 2.625)))
    assert device.state["turned"] is False, "it is left as it was found"
    assert {path.name for path in (tmp_path / "pictures").iterdir()} == {
        "upright.png",
        "turned.png",
        "stopped.png",
    }


@pytest.mark.parametrize(
    ("trait", "why"),
    [
        ({"deaf": True}, "waited 2 s for the phone to connect"),
        ({"fragile": 1}, "ended, or began anew, when the phone was turned"),
        ({"numb": True}, "the robot is not stopped"),
        ({"shows": False}, "no picture of its glass"),
    ],
)
def test_a_device_that_fails_is_told_by_what_failed(device, tmp_path, port, trait, why, monkeypatch):
    monkeypatch.setattr("scripts.android.emulator.ANSWERS", 1.0)
    device.be(**trait)
    with pytest.raises(Failed, match=why):
        story(device, tmp_path, port, 2.0 if "deaf" in trait else 60.0)

"""What a study tells of how the methods were set up, where nobody has changed anything."""

from __future__ import annotations

import json
from types import SimpleNamespace
from typing import Any

from app.inputs.bindings import Bindings
from app.inputs.gamepad.pad_map import Profile
from app.inputs.input_snapshot import set_up
from app.inputs.motion.shake_input import ShakeInput
from app.inputs.motion.tilt_input import TiltInput
from app.inputs.switch_access.switches import SwitchAccess
from app.inputs.voice.voice_input import VoiceInput
from app.intents.method_permits import MethodPermits
from tests.app.inputs.pushing import Settings


def test_what_nobody_changed_is_told_as_well_and_can_be_written_as_json() -> None:
    app: Any = SimpleNamespace(settings=Settings(), now=lambda: 1.0, session=None)
    app.intents = SimpleNamespace(table=MethodPermits(app.settings))
    made = {"shake": ShakeInput(app), "voice": VoiceInput(app)}
    app.methods = SimpleNamespace(get=made.get)
    app.inputs = SimpleNamespace(mapped=Bindings(app.settings))
    told = json.loads(json.dumps(set_up(app)))
    assert told["voice"] == {"on": False, "hands_free": False, "language": "en"}
    assert told["shake"]["ud"] == made["shake"].meaning["ud"]
    assert len(told["shake"]["tuning"]["ways"]) == 3
    assert told["intents"]["shake"]["start"] is False
    assert told["keys"] == json.loads(json.dumps(app.inputs.mapped.keys.kept()))
    assert told["gamepads"]["usual"]["axes"] == Profile().kept()["axes"]
    assert "tilt" not in told, "there is none"


def test_each_method_that_is_told_of_says_what_it_is_set_to() -> None:
    assert all(
        isinstance(kind.set_to, property) for kind in (ShakeInput, VoiceInput, TiltInput, SwitchAccess)
    )

"""Whatever the settings hold, everything of it that is no good is said and as usual again, and every method goes on."""

from __future__ import annotations

import json
import math
from types import SimpleNamespace
from typing import Any

import pytest

from app.core.checked_settings import CheckedSettings, known, number, shown
from app.device.motion import NoMotion
from app.discovery.known_robots import KnownRobots
from app.inputs.bindings import Bindings
from app.inputs.motion.motion_sensing import MotionSensing
from app.inputs.motion.shake_input import ShakeInput
from app.inputs.motion.tilt_input import TiltInput
from app.inputs.switch_access.scan import settings as switches
from app.inputs.switch_access.switches import SwitchAccess
from app.inputs.switch_access.usage import Usage
from app.inputs.voice.talkback import Talkback
from app.inputs.voice.voice_input import VoiceInput
from app.intents.intents import Intents
from app.intents.method_permits import MethodPermits
from app.study.response_recording import ResponseRecording

GARBAGE: list[Any] = [
    [],
    {},
    [[1]],
    {"a": []},
    "nonsense",
    10**400,
    -(10**400),
    math.nan,
    math.inf,
    -5,
    5,
    1.5,
    True,
    False,
    None,
]
"""One or more of each kind of JSON."""
FIELDS = {
    "voice": ("on", "hands_free", "language"),
    "shake": ("on", "any", "ud", "fb", "own"),
    "tilt": ("on", "others", "neutral", "full", "dead", "walking", "expo"),
    "talk": ("on", "voice", "rate"),
    "switches": ("on", "one", "a", "b", *switches.RANGES),
    "study": ("log", "snippets", "remind", "plan"),
    "keys": ("on", "drives", "rise", "slow", "keys"),
    "gamepads": ("on", "profiles"),
    "intents": ("voice", "shake"),
}


class Desk:
    """As much of the app as methods ask for when they are made."""

    def __init__(self, folder: Any, kept: dict[str, Any]) -> None:
        self.kept = json.loads(json.dumps(kept))
        path = folder / "settings.json"
        self.settings = SimpleNamespace(
            path=path, get=lambda name, usual=None: self.kept.get(name, usual), set=self.kept.__setitem__
        )
        self.session = self.shell = None
        self.corner = SimpleNamespace(on_pressed=[])
        self.sensing = MotionSensing(NoMotion("none"), self.now)
        self.permits = MethodPermits(self.settings)
        self.intents = Intents(SimpleNamespace(), self.permits, self.now)

    def now(self) -> float:
        return 100.0

    def made(self, name: str) -> str:
        """Make what reads those settings; what it says about them."""
        if name in ("keys", "gamepads", "wired_gamepads"):
            mapped = Bindings(self.settings)
            mapped.profile("Pad")
            return " ".join(mapped.problems)
        if name == "intents":
            return self.permits.problem
        if name == "switches":
            return switches.read(SwitchAccess(self)._app.settings.get("switches"))[1]
        kinds = {
            "voice": VoiceInput,
            "shake": ShakeInput,
            "tilt": TiltInput,
            "talk": Talkback,
            "study": ResponseRecording,
        }
        method = kinds[name](self)
        return " ".join(method.faults) if name == "tilt" else method.mistaken


@pytest.mark.parametrize("name", [*FIELDS, "wired_gamepads"])
def test_what_is_no_table_is_said_and_as_usual(tmp_path: Any, name: str) -> None:
    for value in GARBAGE:
        said = Desk(tmp_path, {name: value}).made(name)
        right = value is None or isinstance(value, list if name == "wired_gamepads" else dict)
        assert right or said, value


@pytest.mark.parametrize(("name", "field"), [(name, field) for name, of in FIELDS.items() for field in of])
def test_no_value_in_any_place_stops_a_method(tmp_path: Any, name: str, field: str) -> None:
    said = [Desk(tmp_path, {name: {field: value}}).made(name) for value in GARBAGE]
    assert all(len(sentence) < 400 for sentence in said)
    # a list in a list and numbers that no float can hold are right nowhere
    assert all(said[GARBAGE.index(value)] for value in ([[1]], 10**400, -(10**400)))


@pytest.mark.parametrize("value", GARBAGE, ids=shown)
def test_nor_any_value_within_the_tables(tmp_path: Any, value: Any) -> None:
    profile = {"inverted": value, "axes": {"leftx": value}, "buttons": {"a": value}, "dead_zone": value}
    own = {"lr": {"way": [value, 0, 1], "peak": value, "gap": value}}
    for name, kept in {
        "keys": {"keys": {"p": value}},
        "gamepads": {"profiles": {"Pad": profile}},
        "shake": {"own": own},
        "tilt": {"neutral": [value, 0, 1]},
        "switches": {"a": [value], "b": [{"source": value, "name": value}]},
        "study": {"plan": {"user": value, "row": value, "methods": value, "postures": [value]}},
        "intents": {"voice": {"start": value}},
    }.items():
        assert len(Desk(tmp_path, {name: kept}).made(name)) < 600, f"{name}: a value was not cut short"
    Usage({"": {"pause": value}, "drive": value})
    assert all(entry.url for entry in KnownRobots(lambda: 0.0, value).entries())


def test_a_mistake_is_one_sentence_with_the_value_and_what_is_allowed() -> None:
    kept = CheckedSettings({"on": "yes", "rate": 9, "voice": []}, "talking")
    assert not kept.flag("on", usual=False)
    assert kept.number("rate", 0.5, 2.0, usual=1.0) == 1.0
    assert kept.word("voice", ("clear",), "clear") == "clear"
    assert kept.sentence == (
        "In the settings of talking on is true or false, not 'yes', rate is from 0.5 to 2, not 9, "
        "voice is one of the known, not []: reset to default."
    )


def test_what_is_not_there_is_as_usual_and_no_mistake() -> None:
    kept = CheckedSettings(None, "talking")
    assert kept.flag("on", usual=True)
    assert kept.number("rate", 0.5, 2.0, usual=1.0) == 1.0
    assert not kept.sentence


def test_only_numbers_in_their_range_are_numbers() -> None:
    assert number(2, 0.0, 2.0) == 2.0
    none: list[Any] = [True, math.nan, 10**400, "1", [], None]
    assert [number(value, 0.0, 2.0) for value in none] == [None] * 6


def test_only_texts_are_looked_up() -> None:
    assert known("a", {"a": 1})
    assert not known([], {"a": 1})


def test_a_long_value_is_not_shown_at_its_length() -> None:
    assert len(shown(10**400)) == 40


def test_a_value_that_stands_for_gigabytes_is_shown_in_a_few_letters():
    nested: object = "lol"
    for _ in range(40):
        nested = [nested] * 10
    assert len(shown(nested)) <= 40

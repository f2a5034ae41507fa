"""ROS text becomes typed classes."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bridge.codec import from_builtins, from_cbor, from_json, to_cbor, to_json
from bridge.core.errors import ProtocolError
from bridge.generate.model import TextError
from bridge.generate.writing import generate
from bridge.msgs.arrays import Float32Array, UInt16Array
from bridge.msgs.builtin_interfaces import Time
from bridge.msgs.geometry_msgs import Point
from bridge.msgs.std_msgs import Header
from bridge.server.rosapi.type_descriptions import typedefs
from tests.bridge.strategies import messages

ROOT = Path(__file__).parents[3]
FIRST = "lint.isort.known-first-party=['bridge']"
BOAT = """\
# A boat that sails by itself.
#
# Lengths are in its own frame.

uint8 IDLE=0
uint8 SAILING=1          # With the wind.
string CLASS="sloop"
float32 SLOPE=-1.5e-3

std_msgs/Header header
string<=12 name "Minnow"  # What people call it.
uint8 state 1
# How deep the keel goes
# below the surface [m].
float32 draught 0.75
Sail[<=3] sails           # The main sail first.
Sail[2] masts
float32[<=4] currents [1.0, 2, 3.5]  # Of each motor [A].
uint16[] echoes [7, 8]
float64[4] gains [0.1, 0.2, 0.3, 0.4]
geometry_msgs/Point[] corners
uint8[] chart
uint8[4] address
string<=5[<=2] flags ["a", "bc"]
bool afloat true
time launched
int64 distance -5
wstring motto
"""
SAIL = """\
float64 area    # [m2]
float64[2] foot # From the mast [m].
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    messages = tmp_path / "boat_msgs" / "msg"
    messages.mkdir(parents=True)
    (messages / "Boat.msg").write_text(BOAT)
    (messages / "Sail.msg").write_text(SAIL)
    return tmp_path


def load(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"made_{path.stem}", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def run(code: str, folder: Path) -> str:
    """What a program prints that runs in `folder`, where the made modules lie."""
    command = [sys.executable, "-c", code]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder, env=environment)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def written(tmp_path: Path, text: str, name: str = "Thing.msg") -> str:
    path = tmp_path / "thing_msgs" / name.rpartition(".")[2] / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    generate([path], tmp_path / "out")
    return (tmp_path / "out" / "thing_msgs.py").read_text()


def made(tmp_path: Path, text: str, name: str = "Thing.msg") -> ModuleType:
    written(tmp_path, text, name)
    return load(tmp_path / "out" / "thing_msgs.py")


@pytest.fixture(scope="module")
def boats(tmp_path_factory) -> ModuleType:
    messages = tmp_path_factory.mktemp("boats") / "boat_msgs" / "msg"
    messages.mkdir(parents=True)
    (messages / "Boat.msg").write_text(BOAT)
    (messages / "Sail.msg").write_text(SAIL)
    generate([messages / "Boat.msg"], messages / "out")
    return load(messages / "out" / "boat_msgs.py")


def test_an_own_message_has_its_fields_defaults_and_constants(boats):
    boat = boats.Boat()
    assert (boat.header, boat.name, boat.state, boat.draught, boat.afloat) == (
        Header(),
        "Minnow",
        1,
        0.75,
        True,
    )
    assert (boat.sails, boat.masts) == ([], [boats.Sail(0.0, [0.0, 0.0])] * 2)
    assert (boat.currents, boat.gains, boat.flags) == ([1.0, 2.0, 3.5], [0.1, 0.2, 0.3, 0.4], ["a", "bc"])
    assert (boat.echoes, boat.chart, boat.address) == (UInt16Array([7, 8]), b"", bytes(4))
    assert (boat.launched, boat.distance, boat.motto) == (Time(), -5, "")
    assert (boats.Boat.SAILING, boats.Boat.CLASS, boats.Boat.SLOPE) == (1, "sloop", -0.0015)


def test_it_knows_its_types_exactly(boats):
    assert boats.Boat.MSGTYPE == "boat_msgs/Boat"
    types = dict(zip(boats.Boat.__struct_fields__, boats.Boat.ROSTYPES, strict=True))
    assert types["sails"] == "boat_msgs/Sail[<=3]"
    assert types["flags"] == "string<=5[<=2]"
    assert (types["header"], types["launched"], types["motto"]) == ("std_msgs/Header", "time", "wstring")
    assert types["address"] == "uint8[4]"
    assert typedefs(boats.Boat)[0]["type"] == "boat_msgs/Boat"


def test_no_two_messages_share_a_list(boats):
    boats.Boat().gains.append(5.0)
    boats.Boat().masts[0].foot.append(5.0)
    assert len(boats.Boat().gains) == 4
    assert len(boats.Boat().masts[0].foot) == 2


@settings(max_examples=40, deadline=None)
@given(data=st.data())
def test_it_goes_through_json_and_cbor_and_comes_back(boats, data):
    boat = data.draw(messages(boats.Boat))
    assert to_json(from_json(to_json(boat), boats.Boat)) == to_json(boat)
    assert repr(from_builtins(from_cbor(to_cbor(boat)), boats.Boat)) == repr(boat)


@pytest.mark.parametrize(
    "text",
    [
        b'{"state":256}',
        b'{"name":"a name that is too long"}',
        b'{"currents":[1,2,3,4,5]}',
        b'{"gains":[1,2,3]}',
        b'{"flags":["a","b","c"]}',
        b'{"flags":["too long"]}',
        b'{"address":"AAAA"}',
        b'{"echoes":[65536]}',
        b'{"sails":[{},{},{},{}]}',
    ],
)
def test_what_its_types_do_not_allow_is_refused(boats, text):
    with pytest.raises(ProtocolError):
        from_json(text, boats.Boat)


def test_comments_become_docstrings(folder):
    generate([folder / "boat_msgs"], folder / "out")
    text = (folder / "out" / "boat_msgs.py").read_text()
    assert '    """A boat that sails by itself.\n\n    Lengths are in its own frame.\n    """\n' in text
    assert '    """How deep the keel goes\n    below the surface [m].\n    """\n' in text
    assert '    SAILING: ClassVar[int] = 1\n    """With the wind."""\n' in text
    assert '    area: float = 0.0\n    """[m2]"""\n' in text


def test_what_is_made_satisfies_the_linters(folder):
    generate([folder / "boat_msgs"], folder / "out")
    for command in (["check", "--select", "E,F,I,W,UP,RUF,Q"], ["format", "--check"]):
        done = subprocess.run(
            [
                sys.executable,
                "-m",
                "ruff",
                *command,
                "--isolated",
                "--line-length=110",
                "--target-version=py311",
            ]
            + (["--ignore=E501,RUF001,RUF002,RUF012,RUF022"] if command[0] == "check" else [])
            + [str(folder / "out")],
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout


def test_the_same_text_makes_the_same_bytes(folder):
    first = {path.name: path.read_bytes() for path in generate([folder / "boat_msgs"], folder / "a")}
    boats = [folder / "boat_msgs" / "msg" / name for name in ("Sail.msg", "Boat.msg", "Sail.msg")]
    second = {path.name: path.read_bytes() for path in generate(boats, folder / "b")}
    assert first == second


def test_a_service_becomes_two_classes(tmp_path):
    text = "# Sail there.\nstring where\n---\n# It went.\n\nbool went\n"
    things = made(tmp_path, text, "Sail.srv")
    assert things.__all__ == ["SailRequest", "SailResponse"]
    assert (things.SailRequest("home").where, things.SailResponse().went) == ("home", False)
    assert things.SailRequest.MSGTYPE == "thing_msgs/SailRequest"


def test_an_action_becomes_three_classes(tmp_path):
    things = made(
        tmp_path, "int32 order\n---\nint32[] sequence\n---\nfloat32 done # 0 to 1\n", "Count.action"
    )
    assert things.__all__ == ["CountFeedback", "CountGoal", "CountResult"]
    assert things.CountFeedback.ROSTYPES == ("float32",)


def test_parts_may_be_empty(tmp_path):
    things = made(tmp_path, "---\n---\n", "Idle.action")
    assert things.IdleGoal() == things.IdleGoal()
    assert things.IdleResult.ROSTYPES == ()


def test_it_knows_the_units_that_comments_name(boats):
    assert boats.Boat.UNITS == {"draught": "m", "currents": "A"}
    assert boats.Sail.UNITS == {"area": "m2", "foot": "m"}


def test_what_names_no_unit_has_no_table_of_them(tmp_path):
    assert not hasattr(made(tmp_path, "float64 x\nstring name  # At most 5 [m] long.\n"), "UNITS")


def test_a_unit_of_the_whole_is_that_of_all_its_numbers(tmp_path):
    things = made(
        tmp_path,
        "# A place [km].\n\nfloat64 from\nfloat64 x\n---\n# Off [m].\n\nbool far\nfloat64 x\n",
        "Go.srv",
    )
    assert things.GoRequest.UNITS == {"from_": "km", "x": "km"}
    assert not hasattr(things.GoResponse, "UNITS")


def test_a_unit_of_a_message_is_kept_for_what_is_in_it_and_a_moment_has_its_own(tmp_path):
    things = made(tmp_path, "geometry_msgs/Vector3 speed  # [m/s]\ntime at  # [s]\n")
    assert things.Thing.UNITS == {"speed": "m/s"}


def test_a_text_may_have_a_constant_or_a_field_called_units(tmp_path):
    things = made(tmp_path, 'string UNITS="SI"\nfloat64 x  # [m]\n---\nfloat64 UNITS  # [m]\n', "Go.srv")
    assert things.GoRequest.UNITS == "SI"
    assert (tmp_path / "out" / "thing_msgs.py").read_text().count("    UNITS: ") == 2  # one of each class
    assert things.GoResponse.UNITS == {"UNITS_": "m"}
    assert to_json(things.GoResponse(2.0)) == b'{"UNITS":2.0}'


@pytest.mark.parametrize("name", ["from", "bytes", "field", "list", "uint8", "MSGTYPE", "float"])
def test_a_field_that_python_cannot_name_has_an_underscore_and_travels_under_its_own(tmp_path, name):
    things = made(tmp_path, f"uint8 {name} 3\nuint8[] data\nfloat64[2] pair\nuint8 last\nfloat64 x\n")
    thing = things.Thing()
    assert getattr(thing, f"{name}_") == 3
    assert f'"{name}":3'.encode() in to_json(thing)
    assert getattr(from_json(f'{{"{name}":4}}'.encode(), things.Thing), f"{name}_") == 4


def test_a_type_that_is_called_as_what_the_module_needs_has_an_underscore(tmp_path):
    things = made(tmp_path, "float64[2] pair\n", "Meta.msg")
    assert things.Meta_.MSGTYPE == "thing_msgs/Meta"


def test_types_of_one_name_in_two_packages_are_told_apart(tmp_path):
    text = "geometry_msgs/Pose2D a\nvision_msgs/Pose2D b\ngeometry_msgs/Point Point\n"
    thing = made(tmp_path, text).Thing()
    assert (type(thing.a).MSGTYPE, type(thing.b).MSGTYPE) == ("geometry_msgs/Pose2D", "vision_msgs/Pose2D")
    assert thing.Point_ == Point()


def test_what_is_needed_is_found_beside_the_file_in_its_own_or_a_neighbour_package(folder):
    (folder / "fleet_msgs" / "srv").mkdir(parents=True)
    (folder / "fleet_msgs" / "msg").mkdir()
    (folder / "fleet_msgs" / "msg" / "Flag.msg").write_text("string colour\n")
    (folder / "fleet_msgs" / "srv" / "Join.srv").write_text("boat_msgs/Sail sail\nFlag flag\n---\n")
    paths = generate([folder / "fleet_msgs" / "srv" / "Join.srv"], folder / "made_fleet")
    assert [path.name for path in paths] == ["__init__.py", "boat_msgs.py", "fleet_msgs.py"]
    code = "from made_fleet.fleet_msgs import JoinRequest as J; print(type(J().sail).__module__)"
    assert run(code, folder) == "made_fleet.boat_msgs"


def test_a_package_is_one_module_however_long(folder):
    for number in range(60):
        text = "".join(f"float64 x{n} # Number {n} [m].\n" for n in range(10)) + (
            f"Part{number - 1} before\n" if number else ""
        )
        (folder / "boat_msgs" / "msg" / f"Part{number}.msg").write_text(text)
    generate([folder / "boat_msgs"], folder / "many")
    assert sorted(path.name for path in (folder / "many").rglob("*.py")) == ["__init__.py", "boat_msgs.py"]
    code = "from many.boat_msgs import Part59, Boat; print(Part59().before.before.x3)"
    assert run(code, folder) == "0.0"


def test_the_folder_of_modules_that_an_earlier_version_made_of_a_package_is_replaced(folder):
    old = folder / "made" / "boat_msgs"
    old.mkdir(parents=True)
    for name in ("__init__.py", "part1.py"):
        (old / name).write_text('"""boat_msgs: made by `python -m bridge.generate`; old."""\n')
    generate([folder / "boat_msgs"], folder / "made")
    assert not old.exists()
    assert run("from made.boat_msgs import Boat; print(Boat.MSGTYPE)", folder) == "boat_msgs/Boat"


def test_quotes_and_backslashes_survive(tmp_path):
    text = 'string a "say \\"hi\\""  # A "word"\nstring b "it\'s"  # C:\\new """x"""\n'
    thing = made(tmp_path, text).Thing()
    assert (thing.a, thing.b) == ('say "hi"', "it's")


WRONG = [
    ("float64 x\nflaot 64 y\n", "line 2: 'flaot 64 y' is neither a field nor a constant."),
    ("float64\n", "line 1: 'float64' is neither a field nor a constant."),
    ("uint8 x 256\n", "thing_msgs/Thing.x: a uint8 must be a whole number from 0 to 255, not 256."),
    ("uint8 x 1.5\n", "a uint8 must be a whole number from 0 to 255, not 1.5."),
    ("float64 x deep\n", "a float64 must be a number, not 'deep'."),
    ("bool x 2\n", "a bool must be true or false, not 2."),
    ("string<=3 x 'long'\n", "'long' is longer than 3 characters."),
    ("uint8[2] x [1]\n", "uint8[2] cannot hold 1 values."),
    ("uint8[<=2] x [1, 2, 3]\n", "uint8[<=2] cannot hold 3 values."),
    ("uint8 x [1]\n", "[1] is a list, and uint8 holds one value."),
    ("uint8[] x 1\n", "1 is no list, and uint8[] is one."),
    ("time x 5\n", "a time can have no default."),
    ("float64 x\nfloat32 x\n", "defines x twice."),
    ("int8 LOW=-129\n", "thing_msgs/Thing.LOW: a int8 must be a whole number from -128 to 127, not -129."),
    ("Nothing x\n", "needs thing_msgs/Nothing, of which nothing is known; give its .msg file as well."),
    ("far_msgs/Away x\n", "needs far_msgs/Away, of which nothing is known"),
    ("Thing x\n", "thing_msgs/Thing holds thing_msgs/Thing, which cannot be."),
    ("float64 x\n---\nfloat64 y\n", "has 2 parts divided by ---, not 1."),
]


@pytest.mark.parametrize(("text", "sentence"), WRONG)
def test_what_is_wrong_is_said_in_one_sentence_and_nothing_is_written(tmp_path, text, sentence):
    with pytest.raises(TextError) as caught:
        written(tmp_path, text)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_two_files_of_one_type_are_refused(folder):
    twin = folder / "other" / "boat_msgs" / "msg"
    twin.mkdir(parents=True)
    (twin / "Sail.msg").write_text(SAIL)
    with pytest.raises(TextError, match=r"both define boat_msgs/Sail\."):
        generate([folder / "boat_msgs", folder / "other"], folder / "out")


def test_what_was_written_by_hand_is_left_alone(folder):
    (folder / "out").mkdir()
    (folder / "out" / "boat_msgs.py").write_text('"""Mine."""\n')
    with pytest.raises(TextError, match=r"was not generated and is left alone; nothing was written\."):
        generate([folder / "boat_msgs"], folder / "out")
    assert (folder / "out" / "boat_msgs.py").read_text() == '"""Mine."""\n'


def test_a_float32_array_is_typed(tmp_path):
    assert made(tmp_path, "float32[] x\n").Thing().x == Float32Array()

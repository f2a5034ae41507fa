"""Messages survive the socket, and what is no message is named."""

from __future__ import annotations

import base64
import contextlib
import math
from array import array

import cbor2
import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bridge.codec import from_builtins, from_cbor, from_json, shown, to_builtins, to_cbor, to_json
from bridge.core.errors import ProtocolError
from bridge.msgs import TYPES
from bridge.msgs.arrays import Float32Array
from bridge.msgs.geometry_msgs import PoseWithCovariance, Twist, Vector3
from bridge.msgs.nav_msgs import OccupancyGrid, Odometry
from bridge.msgs.pilothouse_msgs import Check, Mission, Waypoint
from bridge.msgs.sensor_msgs import CompressedImage, JointState, LaserScan, NavSatFix
from bridge.msgs.std_msgs import Time
from tests.bridge.strategies import messages
from tests.looped import looped


def plain(value: object) -> object:
    """As JSON can say it: no infinities, arrays as lists."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, (list, array)):
        return [plain(item) for item in value]
    return math.nan if isinstance(value, float) and math.isinf(value) else value


@looped("cls", TYPES.values())
@settings(max_examples=15, deadline=None)
@given(data=st.data())
def test_every_message_type_comes_back_from_cbor_unchanged_and_from_json_with_infinities_as_nan(cls, data):
    msg = data.draw(messages(cls))
    back = from_json(to_json(msg), cls)
    assert type(back) is cls
    assert repr(plain(to_builtins(back))) == repr(plain(to_builtins(msg)))
    assert repr(from_builtins(from_cbor(to_cbor(msg)), cls)) == repr(msg)


def test_not_a_number_travels_as_null_and_comes_back():
    raw = to_json(NavSatFix(latitude=math.inf, longitude=8.5))
    assert b'"latitude":null' in raw
    back = from_json(raw, NavSatFix)
    assert math.isnan(back.latitude)
    assert back.longitude == 8.5


def test_missing_fields_take_their_defaults_on_both_paths():
    assert from_json(b"{}", Odometry) == Odometry()
    waypoint = from_json(b'{"x":1,"yaw":null}', Waypoint)
    assert (waypoint.x, waypoint.y, math.isnan(waypoint.yaw)) == (1.0, 0.0, True)


def test_fields_that_nobody_knows_are_passed_over():
    assert from_json(b'{"linear":{"x":1,"colour":"red"},"w":null}', Twist) == Twist(Vector3(1.0))


def test_a_whole_number_is_a_number():
    assert from_json(b'{"linear":{"x":2,"y":null}}', Twist).linear.x == 2.0


def test_bytes_travel_as_base64_and_are_taken_as_numbers_too():
    picture = CompressedImage(data=b"\xff\xd8")
    assert b'"data":"' + base64.b64encode(b"\xff\xd8") + b'"' in to_json(picture)
    assert from_json(b'{"data":[255,216]}', CompressedImage).data == b"\xff\xd8"


def test_the_time_of_ros_2_is_understood_and_that_of_ros_1_is_sent():
    stamp = from_json(b'{"sec":5,"nanosec":7}', Time)
    assert to_json(stamp) == b'{"secs":5,"nsecs":7}'


def test_cbor_holds_number_arrays_as_typed_arrays():
    raw = to_cbor(LaserScan(ranges=Float32Array([1.0, math.inf])))
    tag = cbor2.loads(raw)["ranges"]
    assert (tag.tag, tag.value) == (85, b"\x00\x00\x80\x3f\x00\x00\x80\x7f")


def test_any_typed_array_of_rfc_8746_is_taken_for_a_list_of_numbers():
    raw = cbor2.dumps({"position": cbor2.CBORTag(86, b"\0\0\0\0\0\0\xf0\x3f"), "name": ["a"]})
    assert list(from_builtins(from_cbor(raw), JointState).position) == [1.0]


WRONG = [
    (Twist, b'{"linear":{"x":"fast"}}', 'linear.x must be a number or null, not "fast".'),
    (Twist, b'{"linear":{"x":true}}', "linear.x must be a number or null, not true."),
    (Twist, b'{"linear":null}', "linear must be an object, not null."),
    (Twist, b"[1]", "geometry_msgs/Twist must be an object, not [1]."),
    (Time, b'{"secs":1.5}', "secs must be a whole number of at most 64 bits, not 1.5."),
    (
        Time,
        b'{"secs":18446744073709551616}',
        "secs must be a whole number of at most 64 bits, not 18446744073709551616.",
    ),
    (LaserScan, b'{"ranges":["near"]}', 'ranges must be a list of numbers, not ["near"].'),
    (LaserScan, b'{"ranges":5}', "ranges must be a list of numbers, not 5."),
    (OccupancyGrid, b'{"data":[300]}', "data must be a list of whole numbers from -128 to 127, not [300]."),
    (Mission, b'{"waypoints":[{},{"x":[]}]}', "waypoints[1].x must be a number or null, not []."),
    (Mission, b'{"waypoints":{}}', "waypoints must be a list, not {}."),
    (Mission, b'{"stop_on_intruder":1}', "stop_on_intruder must be true or false, not 1."),
    (Mission, b'{"motion":null}', "motion must be a text, not null."),
    (
        CompressedImage,
        b'{"data":"%%"}',
        'data must be base64 text or a list of whole numbers from 0 to 255, not "%%".',
    ),
]


@pytest.mark.parametrize(("cls", "raw", "sentence"), WRONG)
def test_what_is_wrong_is_named_with_its_value_and_what_is_allowed(cls, raw, sentence):
    with pytest.raises(ProtocolError) as caught:
        from_json(raw, cls)
    assert str(caught.value) == sentence


@pytest.mark.parametrize("raw", [b"", b"{", b"\xff", b"[" * 100_000, b'{"linear":{"x":1e999}}'])
def test_what_is_not_json_is_a_protocol_error(raw):
    with pytest.raises(ProtocolError, match="is not JSON"):
        from_json(raw, Twist)


def test_a_long_value_is_shortened_in_the_sentence():
    with pytest.raises(ProtocolError) as caught:
        from_json(msgspec.json.encode({"motion": ["x" * 500]}), Mission)
    assert len(str(caught.value)) < 100


@pytest.mark.parametrize("cls", [Twist, Mission, LaserScan, CompressedImage])
@settings(max_examples=60, deadline=None)
@given(raw=st.binary(max_size=64))
def test_nothing_but_a_protocol_error_leaves_the_cbor_decoder(cls, raw):
    with contextlib.suppress(ProtocolError):
        from_builtins(from_cbor(raw), cls)


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(["x", "linear", "waypoints", "ranges", "data", "stamp", "secs", "header"]), inner
        )
    ),
    max_leaves=10,
)


@pytest.mark.parametrize("cls", [Twist, Mission, LaserScan, CompressedImage, Odometry])
@settings(max_examples=60, deadline=None)
@given(obj=JSON)
def test_nothing_but_a_protocol_error_leaves_the_json_decoder(cls, obj):
    try:
        found = from_json(msgspec.json.encode(obj), cls)
    except (ProtocolError, OverflowError):
        return
    assert type(found) is cls


def test_what_has_no_form_on_the_wire_is_a_protocol_error_when_sent():
    with pytest.raises(ProtocolError, match="pilothouse_msgs/Mission cannot be sent"):
        to_json(Mission(motion="\ud800"))
    with pytest.raises(ProtocolError, match="cannot be sent as CBOR"):
        to_cbor({"a": object()})


def test_a_list_may_come_as_a_number_array_of_another_kind():
    covariance = from_builtins({"covariance": array("B", range(36))}, PoseWithCovariance).covariance
    assert covariance == [float(each) for each in range(36)]
    assert {type(each) for each in covariance} == {float}
    with pytest.raises(ProtocolError, match="must hold 36, not 0"):
        from_builtins({"covariance": array("B")}, PoseWithCovariance)


def test_a_number_with_more_digits_than_python_writes_can_be_shown():
    assert shown({"a": 2**20_000}) == "a number with too many digits"


def test_a_text_that_carries_more_is_its_text_in_json() -> None:
    class Said(str):
        __slots__ = ("code",)

    assert from_json(to_json(Check(name=Said("clock"))), Check).name == "clock"

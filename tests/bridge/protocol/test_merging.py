"""Several subscriptions of one client to one topic as one delivery."""

from __future__ import annotations

import functools
import itertools

import pytest

from bridge.core.compat import Compat
from bridge.core.errors import ProtocolError
from bridge.protocol import COMPRESSIONS, Reduction, Subscribe, Subscribed
from bridge.protocol.merging import merged, wish

KEPT, STRICT = Compat(), Compat.strict()
A, B = Reduction(beams=90), Reduction(beams=180)


def asked(compat=KEPT, **wishes):
    return wish(Subscribe(topic="/odom", **wishes), compat)


def together(*wishes, compat=KEPT):
    several = [asked(compat, **each) for each in wishes]
    one_by_one = functools.reduce(lambda one, other: merged([one, other], compat), several)
    assert merged(several, compat) == one_by_one
    return one_by_one


def test_a_subscription_says_what_it_wants():
    assert asked(
        type="nav_msgs/msg/Odometry",
        throttle_rate=50,
        queue_length=3.0,
        fragment_size=100.0,
        compression="cbor",
        reduce=A,
    ) == Subscribed("/odom", 0.05, 3, "cbor", 100, A, ros2=True)


def test_one_that_says_nothing_wants_everything_at_once_and_whole():
    assert asked() == Subscribed("/odom")
    assert asked(throttle_rate=None, queue_length=None, compression=None, fragment_size=None) == Subscribed(
        "/odom"
    )


@pytest.mark.parametrize("number", [-1, -0.5, 0])
def test_less_than_nothing_is_nothing(number):
    assert (asked(throttle_rate=number).period, asked(queue_length=number).queue) == (0, 0)


def test_the_fastest_rate_counts():
    assert together({"throttle_rate": 200}, {"throttle_rate": 50}, {"throttle_rate": 100}).period == 0.05
    assert together({"throttle_rate": 200}, {}).period == 0


@pytest.mark.parametrize(
    ("lengths", "kept", "strict"), [((5, 1, 3), 1, 5), ((5, 0), 0, 0), ((0, 5), 0, 0), ((2,), 2, 2)]
)
def test_the_shortest_queue_counts_as_for_the_servers_in_use_or_the_longest_as_specified(
    lengths, kept, strict
):
    wishes = [{"queue_length": length} for length in lengths]
    assert together(*wishes).queue == kept
    assert together(*wishes, compat=STRICT).queue == strict


def test_the_smallest_fragments_count():
    assert together({"fragment_size": 500}, {}, {"fragment_size": 200}).fragment_size == 200
    assert together({}, {}).fragment_size is None


@pytest.mark.parametrize(("one", "other"), list(itertools.product(COMPRESSIONS, repeat=2)))
def test_the_densest_compression_counts(one, other):
    assert COMPRESSIONS == ("none", "png", "cbor", "cbor-raw")
    densest = COMPRESSIONS[max(COMPRESSIONS.index(one), COMPRESSIONS.index(other))]
    assert together({"compression": one}, {"compression": other}).compression == densest


def test_a_compression_that_nobody_knows_is_none_or_is_refused():
    assert asked(compression="zip").compression == "none"
    with pytest.raises(
        ProtocolError, match='compression must be one of none, png, cbor, cbor-raw, not "zip"'
    ):
        asked(STRICT, compression="zip")


@pytest.mark.parametrize(
    ("reductions", "expected"),
    [([A, A], A), ([A, B], None), ([A, None], None), ([A, B, A], None), ([None, A, A], None), ([A, A, A], A)],
)
def test_equal_reductions_stay_and_different_ones_bring_everything(reductions, expected):
    for order in itertools.permutations(reductions):
        assert together(*({"reduce": each} for each in order)).reduction == expected


def test_the_name_is_that_of_the_first():
    one, other = wish(Subscribe(topic="odom"), KEPT), wish(Subscribe(topic="/odom"), KEPT)
    assert merged([one, other], KEPT).name == "odom"


@pytest.mark.parametrize("type", [None, "", "*"])
def test_who_names_no_type_is_known_by_what_it_named_before(type):
    assert [wish(Subscribe(topic="/a", type=type), KEPT, ros2=before).ros2 for before in (False, True)] == [
        False,
        True,
    ]
    assert not wish(Subscribe(topic="/a", type="nav_msgs/Odometry"), KEPT, ros2=True).ros2


REFUSED = {
    "fragment_size must be at least 1 or null, not 0": {"fragment_size": 0},
    "fragment_size must be at least 1 or null, not -5": {"fragment_size": -5},
    "throttle_rate must be at most": {"throttle_rate": 1e300},
    "queue_length must be at most": {"queue_length": 10**400},
    "reduce.beams must be a whole number from 1 to 2147483648, not 0": {"reduce": Reduction(beams=0)},
    "reduce.width must be": {"reduce": Reduction(width=-1)},
    "reduce.quality must be a whole number from 1 to 95, not 96": {"reduce": Reduction(quality=96)},
    "reduce.resolution must be above 0, not 0.0": {"reduce": Reduction(resolution=0.0)},
    "reduce.fields may name at most 100 fields, not 101": {"reduce": Reduction(fields=("a",) * 101)},
    "a path has 1 to 256 characters, not 0": {"reduce": Reduction(fields=("",))},
}


@pytest.mark.parametrize("reason", REFUSED)
def test_what_cannot_be_had_is_refused_with_field_value_and_what_is_allowed(reason):
    with pytest.raises(ProtocolError, match=reason) as caught:
        asked(id="s", **REFUSED[reason])
    assert (caught.value.op, caught.value.id) == ("subscribe", "s")

"""Each intruder once; and where the camera's sightings come to lie on the map."""

from __future__ import annotations

import io
import math

import numpy as np
import pytest
from PIL import Image

from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import Intruder
from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.std_msgs import Header, Time
from bridge.msgs.vision_msgs import Detection2DArray
from robotside.core.pose2 import Pose2
from robotside.core.worker import Worker
from robotside.localisation.odometry_track import OdometryTrack
from robotside.perception import intruder_watch
from robotside.perception.intruder_tracker import MIN_DOUBTFUL_SIGHTINGS, MIN_SIGHTINGS, IntruderTracker
from robotside.perception.intruder_watch import IntruderWatch
from tests.robotside.held_worker import HeldWorker
from tests.robotside.perception.drawn import cone_ahead, person_ahead

FOV = 1.2


def test_a_thing_is_reported_with_its_third_sighting_and_never_again() -> None:
    intruders = IntruderTracker()
    told = [intruders.update(5.0 + 0.1 * (n % 2), 2.0, 4.0, float(n)) for n in range(20)]
    assert [n for n, intruder in enumerate(told) if intruder] == [MIN_SIGHTINGS - 1]
    assert len(intruders.known) == 1
    assert intruders.known[0].sightings == 20


@pytest.mark.parametrize(
    ("scores", "kind"), [((0.9, 0.9, 0.4), "cone"), ((0.4, 0.5, 0.7) + (0.5,) * 5, "unknown")]
)
def test_what_hardly_looks_like_a_cone_is_an_intruder_of_no_known_class(
    scores: tuple[float, ...], kind: str
) -> None:
    tracker = IntruderTracker()
    found = [tracker.update(1.0, 2.0, 3.0, 0.1 * n, score) for n, score in enumerate(scores)]
    assert found[-1] is not None
    assert found[-1].class_id == kind


def test_what_hardly_looks_like_a_cone_is_told_only_when_it_stays() -> None:
    tracker = IntruderTracker()
    for n in range(MIN_DOUBTFUL_SIGHTINGS - 1):
        assert tracker.update(1.0, 2.0, 3.0, 0.1 * n, 0.5) is None
    assert tracker.known == []


def test_what_comes_to_look_like_a_cone_is_told_at_once() -> None:
    tracker = IntruderTracker()
    scores = (0.5, 0.5, 0.5, 0.95, 0.95)
    told = [tracker.update(1.0, 2.0, 3.0, 0.1 * n, score) is not None for n, score in enumerate(scores)]
    assert told == [False, False, False, True, False]


def test_two_things_are_numbered_in_the_order_of_their_reports() -> None:
    intruders = IntruderTracker()
    for n in range(MIN_SIGHTINGS):
        intruders.update(0.0, 0.0, 4.0, float(n))
        intruders.update(3.0, 0.0, 4.0, float(n))
    assert [(i.id, i.position.x) for i in intruders.known] == [(1, 0.0), (2, 3.0)]


def test_near_sightings_count_more_than_far_ones() -> None:
    intruders = IntruderTracker()
    intruders.update(5.8, 0.0, 6.0, 0.0)
    intruders.update(5.0, 0.0, 1.0, 1.0)
    intruders.update(5.0, 0.0, 1.0, 2.0)
    assert intruders.known[0].position.x == pytest.approx(5.0, abs=0.05)


def test_scattered_single_sightings_are_nothing() -> None:
    intruders = IntruderTracker()
    for n in range(10):
        intruders.update(3.0 * n, 0.0, 4.0, float(n))
    assert intruders.known == []


def test_sightings_that_are_long_past_do_not_count() -> None:
    intruders = IntruderTracker()
    for n in range(MIN_SIGHTINGS):
        assert intruders.update(0.0, 0.0, 4.0, 30.0 * n) is None


class Scene:
    """A cone 3 m ahead and a little to the left of a robot at (1, 2) that looks north."""

    def __init__(self, worker: Worker | None = None) -> None:
        self.said: list[tuple[str, Msg]] = []
        self.found: list[Intruder] = []
        self.crops: list[bytes] = []
        track = OdometryTrack()
        for n in range(40):
            track.add(n * 0.05, Pose2(1.0, 2.0, math.pi / 2))
        self.watch = IntruderWatch(
            track,
            FOV,
            lambda topic, msg: self.said.append((topic, msg)),
            self._report,
            worker=worker,
            counts=lambda: self.counted,
        )
        self.counted = ("cone", "person")
        self.jpeg = cone_ahead(2.92, 0.5)

    def _report(self, intruder: Intruder, crop: bytes) -> None:
        self.found.append(intruder)
        self.crops.append(crop)

    def look(self, stamp: float, *, placing: bool = True) -> None:
        data = bytes(bytearray(self.jpeg))  # a file of its own
        self.watch.on_image(CompressedImage(Header(Time.at(stamp), "camera"), "jpeg", data), placing=placing)

    def detections(self) -> list[Detection2DArray]:
        return [msg for _, msg in self.said if isinstance(msg, Detection2DArray)]


@pytest.mark.parametrize("laser", [True, False])
def test_a_cone_is_placed_on_the_map_by_the_laser_or_by_the_ground(laser: bool) -> None:
    scene = Scene()
    for n in range(MIN_SIGHTINGS):
        if laser:
            scene.watch.on_scan(np.array([[0.5, 4.97], [0.52, 4.95], [5.0, 2.0]]), 0.2 * n)
        scene.look(0.2 * n)
    assert len(scene.found) == 1
    place = scene.found[0].position
    assert math.hypot(place.x - 0.5, place.y - 5.0) < (0.15 if laser else 0.4)


def test_pictures_are_searched_five_times_a_second_and_each_search_is_told() -> None:
    scene = Scene()
    for n in range(30):
        scene.look(n / 15)
    assert len(scene.detections()) == pytest.approx(10, abs=1)
    detection = scene.detections()[0].detections[0]
    assert detection.results[0].hypothesis.class_id == "cone"
    assert detection.bbox.center.position.x == pytest.approx(320 - 80, abs=8)
    assert {each.detections[0].id for each in scene.detections()} == {"1"}, "one thing, one number"


def test_a_person_is_an_intruder_of_that_class_with_a_picture_where_people_count() -> None:
    scene = Scene()
    scene.jpeg = person_ahead(3.0, 0.5)
    for n in range(MIN_SIGHTINGS):
        scene.look(0.2 * n)
    assert [intruder.class_id for intruder in scene.found] == ["person"]
    wide, high = Image.open(io.BytesIO(scene.crops[0])).size
    assert high > wide, "somebody who stands"
    scene = Scene()
    scene.jpeg, scene.counted = person_ahead(3.0, 0.5), ("cone",)
    for n in range(MIN_SIGHTINGS):
        scene.look(0.2 * n)
    assert scene.detections()[-1].detections[0].results[0].hypothesis.class_id == "person"
    assert scene.found == []


def test_who_walks_about_is_one_intruder_and_a_person_beside_a_cone_is_another() -> None:
    intruders = IntruderTracker()
    for n in range(20):
        intruders.update(0.3 * n, 0.0, 4.0, 0.2 * n, kind="person", track=1)
        intruders.update(2.0, 0.5, 4.0, 0.2 * n, kind="cone", track=2)
    assert [(one.id, one.class_id) for one in intruders.known] == [(1, "person"), (2, "cone")]
    assert intruders.known[0].position.x > 4.0


def test_an_intruder_that_has_moved_on_is_told_again() -> None:
    scene = Scene()
    for n in range(8):
        scene.jpeg = person_ahead(2.5 + 0.5 * (n // 2), 0.0)
        scene.look(0.2 * n)
    told = [msg for topic, msg in scene.said if topic == "/intruders"]
    assert len(scene.found) == 1
    assert len(told) >= 2


def test_with_an_unsure_position_a_cone_is_shown_but_not_placed() -> None:
    scene = Scene()
    for n in range(10):
        scene.look(0.2 * n, placing=False)
    assert scene.detections()[-1].detections
    assert scene.found == []


def test_what_the_edge_of_the_picture_cuts_is_shown_but_not_placed() -> None:
    scene = Scene()
    scene.jpeg = cone_ahead(2.92, 1.85)
    for n in range(2 * MIN_DOUBTFUL_SIGHTINGS):
        scene.look(0.2 * n)
    assert scene.detections()[-1].detections
    assert scene.found == []


@pytest.mark.parametrize("junk", [b"", b"a picture", b"\xff\xd8\xff\xe0"])
def test_a_picture_that_cannot_be_read_shows_nothing(junk: bytes) -> None:
    scene = Scene()
    scene.jpeg = junk
    scene.look(0.0)
    assert [each.detections for each in scene.detections()] == [[]]


def test_where_the_robot_was_is_asked_between_two_poses() -> None:
    track = OdometryTrack()
    assert track.at(0.0) is None
    track.add(0.0, Pose2(0.0, 0.0, 3.1))
    track.add(1.0, Pose2(2.0, 0.0, -3.1))
    middle = track.at(0.5)
    assert middle is not None
    assert middle.x == pytest.approx(1.0)
    assert abs(middle.yaw) == pytest.approx(math.pi, abs=0.01)
    assert track.at(5.0) == Pose2(2.0, 0.0, -3.1)


# searched beside the loop


@pytest.fixture
def worker() -> HeldWorker:
    """It keeps each picture until the test lets it go."""
    worker = HeldWorker()
    worker.holds = True
    return worker


def finish(worker: HeldWorker, scene: Scene, *, placing: bool = True) -> None:
    worker.holds = False
    scene.watch.update(placing=placing)
    worker.holds = True


def stamps(scene: Scene) -> list[float]:
    return [each.header.stamp.seconds for each in scene.detections()]


def test_a_picture_that_is_searched_elsewhere_is_told_with_its_own_stamp_once_it_is_done(
    worker: HeldWorker,
) -> None:
    scene = Scene(worker)
    scene.look(0.0)
    scene.look(0.4)
    scene.watch.update(placing=True)
    assert (stamps(scene), worker.submitted) == ([], 1), "one at a time, and nothing waits for it"
    finish(worker, scene)
    scene.watch.update(placing=True)
    assert stamps(scene) == [0.0]
    scene.look(0.5)
    finish(worker, scene)
    assert stamps(scene) == [0.0, 0.5]


@pytest.mark.parametrize(("at_first", "by_now"), [(True, False), (False, True)])
def test_a_cone_is_not_placed_when_the_position_was_or_became_unsure(
    worker: HeldWorker, at_first: bool, by_now: bool
) -> None:
    scene = Scene(worker)
    for n in range(MIN_SIGHTINGS):
        scene.look(0.2 * n, placing=at_first)
        finish(worker, scene, placing=by_now)
    assert len(scene.detections()) == MIN_SIGHTINGS
    assert scene.found == []


def test_a_search_that_fails_is_raised_once_and_the_next_picture_is_searched(
    worker: HeldWorker, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = Scene(worker)
    with monkeypatch.context() as patched:
        patched.setattr(intruder_watch, "find_things", lambda _: 1 // 0)
        scene.look(0.0)
        with pytest.raises(ZeroDivisionError):
            finish(worker, scene)
    finish(worker, scene)
    scene.look(0.4)
    finish(worker, scene)
    assert stamps(scene) == [0.4]


def test_a_picture_that_came_out_the_same_is_searched_once_and_told_each_time(worker: HeldWorker) -> None:
    scene = Scene(worker)
    same = scene.jpeg
    for n in range(5):
        image = CompressedImage(Header(Time.at(0.2 * n), "camera"), "jpeg", same)
        scene.watch.on_image(image, placing=True)
        finish(worker, scene)
    assert stamps(scene) == pytest.approx([0.2 * n for n in range(5)])
    assert worker.submitted == 1

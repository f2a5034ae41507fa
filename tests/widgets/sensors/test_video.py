from __future__ import annotations

import math

import pytest

from bridge.msgs.vision_msgs import (
    BoundingBox2D,
    Detection2D,
    Detection2DArray,
    ObjectHypothesis,
    ObjectHypothesisWithPose,
    Point2D,
    Pose2D,
)
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.sensors.video import Video
from widgets.sensors.video_marks import box_role

FRAME = bytes(64 * 48 * 4)


@pytest.fixture
def video(stage):
    return stage.show(Video(), size=(320, 320))


def detection(label: str = "cone", score: float = 0.9) -> Detection2D:
    results = [ObjectHypothesisWithPose(ObjectHypothesis(label, score))] if label else []
    return Detection2D(results=results, bbox=BoundingBox2D(Pose2D(Point2D(32, 24)), 10, 20))


def test_a_detection_becomes_a_box_from_its_top_left_corner(video):
    video.show(Detection2DArray(detections=[detection()]))
    assert list(video.boxes) == [("cone", 0.9, 27, 14, 10, 20)]


def test_a_detection_without_a_name_has_a_question_mark(video):
    video.show(Detection2DArray(detections=[detection(label="")]))
    label, score, *_ = video.boxes[0]
    assert label == "?"
    assert math.isnan(score)


def test_no_detection_takes_the_boxes_away(video):
    video.show(Detection2DArray(detections=[detection()]))
    video.show(Detection2DArray())
    assert list(video.boxes) == []


def test_a_covering_picture_is_cut_at_the_sides(video):
    video.show_frame(64, 48, FRAME)
    assert video.picture_size == pytest.approx((320 * 4 / 3, 320))
    assert video.place_on_glass(32, 24) == pytest.approx(video.center)
    assert video.place_on_glass(0, 0)[0] < video.x


def test_boxes_stay_in_their_places_when_the_picture_was_made_smaller_on_its_way(video):
    video.show_frame(64, 48, FRAME)
    before = video.place_on_glass(27, 14)
    video.show_frame(32, 24, bytes(32 * 24 * 4), (64, 48))
    assert video.place_on_glass(27, 14) == pytest.approx(before)


def test_a_contained_picture_is_whole(video):
    video.fit = "contain"
    video.show_frame(64, 48, FRAME)
    assert video.place_on_glass(0, 0) == pytest.approx((0, 280))
    assert video.place_on_glass(64, 48) == pytest.approx((320, 40))


def test_the_texture_is_kept_from_frame_to_frame(video):
    video.show_frame(64, 48, FRAME)
    first = video._texture
    video.show_frame(64, 48, bytearray(FRAME))
    assert video._texture is first
    video.show_frame(32, 48, bytes(32 * 48 * 4))
    assert video._texture is not first


def test_a_frame_of_the_wrong_length_is_refused_in_one_sentence(video):
    with pytest.raises(ValueError, match="64 x 48 has 12288 bytes, not 10"):
        video.show_frame(64, 48, bytes(10))


def test_the_chip_says_size_rate_and_latency(video):
    video.show_frame(64, 48, FRAME)
    video.rate, video.latency = 15.2, 0.061
    assert video.chip_text() == "64×48 · 15 fps · 61 ms"


def test_a_picture_too_old_to_drive_by_is_said_to_be_late(video):
    video.latency = 0.789
    assert video.chip_text().endswith("789 ms late")
    video.latency = 0.2
    assert video.chip_text().endswith("200 ms")


def test_how_old_the_last_picture_is_stands_under_what_lies_over_it(stage, video):
    video.show_frame(64, 48, FRAME)
    video.state, video.age = "stale", 9.0
    stage.frames(1)
    (sentence,) = video._sentence()
    assert sentence.y == video.center_y
    video.below = video.center_y - 10
    (sentence,) = video._sentence()
    assert video.y < sentence.y < video.below - 10
    video.below = video.y - 5
    (sentence,) = video._sentence()
    assert sentence.y == video.center_y, "where there is no room under it, it stays where it is"


def test_the_chip_leaves_out_what_is_not_known(video):
    assert video.chip_text() == ""
    video.show_frame(64, 48, FRAME)
    assert video.chip_text() == "64×48"


def said(video: Video) -> list[str]:
    return [word.text for word in video._sentence()]


def test_before_the_first_frame_it_says_so(video):
    assert said(video)[-1] == "No picture yet"


def test_an_old_picture_says_how_old_it_is(video):
    video.show_frame(64, 48, FRAME)
    video.state, video.age = "stale", 3.2
    assert said(video) == ["Last picture 3 s ago"]


def test_a_live_picture_says_nothing(video):
    video.show_frame(64, 48, FRAME)
    video.state = "live"
    assert said(video) == []


def test_boxes_that_lie_outside_the_cut_picture_are_not_drawn(video, stage):
    video.show_frame(64, 48, FRAME)
    video.state = "live"
    video.boxes = [("left", 0.9, 0, 10, 6, 10), ("middle", 0.9, 30, 10, 6, 10)]
    from widgets.core.shapes import Shapes

    assert [word.text for word in video._box_marks(Shapes())] == ["middle 0.90"]


def marked(stage, *marks, **more):
    video = stage.show(Video(state="live", field_of_view=1.2, **more), size=(640, 480))
    video.show_frame(640, 480, bytes(640 * 480 * 4))
    video.marks = list(marks)
    stage.frames(2)
    return {word.text: word for word in video._pointers(Shapes())}


def test_only_what_counts_as_an_intruder_is_boxed_in_the_colour_of_danger(stage):
    video = stage.show(Video(state="live", field_of_view=1.2), size=(640, 480))
    video.show_frame(640, 480, bytes(640 * 480 * 4))
    video.boxes = [("cone", 0.97, 300, 200, 40, 80), ("person", 0.9, 20, 200, 40, 80)]
    stage.frames(2)

    def inks():
        return [tuple(word.colour) for word in video._box_marks(Shapes())]

    assert inks() == [tuple(theme.ink_accent)] * 2, "what is only recognised alarms nobody"
    video.counted = [0.0]
    assert inks() == [tuple(theme.ink_danger), tuple(theme.ink_accent)]
    video.field_of_view = math.nan
    assert inks() == [tuple(theme.ink_accent)] * 2, "nobody knows where it looks"


@pytest.mark.parametrize(
    ("column", "role"), [(109, "accent"), (110, "danger"), (130, "danger"), (150, "danger"), (151, "accent")]
)
def test_a_thing_half_a_width_beside_its_box_is_the_one_that_counts(column, role):
    assert box_role(120, 20, [400.0, column]) == role


def test_a_picture_of_another_size_does_not_stand_on_its_head_until_it_is_laid_out(stage):
    video = stage.show(Video(state="live", corner=0), size=(320, 240))
    video.show_frame(64, 48, FRAME)
    stage.frames(2)
    upright = list(video._plain.tex_coords)
    assert upright[1] > upright[5]
    video.show_frame(32, 24, bytes(32 * 24 * 4))
    assert list(video._plain.tex_coords) == upright


def test_what_is_known_to_be_ahead_is_marked_in_the_middle_and_to_the_left_on_the_left(stage):
    found = marked(stage, ("1", 0.0), ("2", 0.3))
    assert found["1"].x == pytest.approx(320)
    assert found["2"].x == pytest.approx(320 - 320 * math.tan(0.3) / math.tan(0.6))


@pytest.mark.parametrize(("angle", "side"), [(1.0, "left"), (3.0, "left"), (-0.7, "right"), (-2.0, "right")])
def test_what_is_outside_the_picture_is_marked_at_the_edge_that_leads_there(stage, angle, side):
    (word,) = marked(stage, ("1", angle)).values()
    assert word.x < 40 if side == "left" else word.x > 600


def test_a_mark_keeps_clear_of_what_lies_over_the_picture(stage):
    (word,) = marked(stage, ("1", 2.0), insets=[100, 0, 50, 0]).values()
    assert 100 < word.x < 150


def test_what_is_boxed_is_not_marked_twice(stage):
    assert not marked(stage, ("1", 0.0), boxes=[("cone", 0.9, 300, 100, 40, 80)])


def test_without_a_field_of_view_nothing_is_marked(stage):
    video = stage.show(Video(state="live", marks=[("1", 0.0)]), size=(640, 480))
    video.show_frame(640, 480, bytes(640 * 480 * 4))
    assert not list(video._pointers(Shapes()))


def test_it_says_why_no_newer_picture_is_shown(video, stage):
    video.refusal = "The picture is neither JPEG nor PNG."
    stage.frames(2)
    assert [word.text for word in video._sentence()][-1] == video.refusal
    video.show_frame(64, 48, FRAME)
    video.state, video.age = "stale", 5.0
    stage.frames(2)
    assert [word.text for word in video._sentence()] == ["Last picture 5 s ago", video.refusal]
    video.refusal = ""
    assert [word.text for word in video._sentence()] == ["Last picture 5 s ago"]


@pytest.mark.parametrize(("corner", "fit"), [(12, "cover"), (0, "cover"), (0, "contain")])
def test_an_old_picture_is_faded_and_a_fresh_one_is_not(video, stage, corner, fit):
    video.corner, video.fit = corner, fit
    video.show_frame(64, 48, FRAME)
    for state, faded in (("live", False), ("stale", True), ("live", False), ("never", True)):
        video.state = state
        stage.frames(2)
        through_the_lens = video._picture.size[0] > 0
        strength = video._lens["strength"] if through_the_lens else 1.0
        assert (strength < 0.5) is faded, state
        assert (video._plain.size[0] > 0) is not through_the_lens, "drawn once, plain or by the lens"


def test_a_new_rate_and_latency_write_the_chip_and_draw_nothing_else_anew(video, stage, monkeypatch):
    video.show_frame(64, 48, FRAME)
    video.state = "live"
    stage.frames(2)
    drawn = []
    monkeypatch.setattr(Video, "draw", lambda _: drawn.append("all"))
    video.rate, video.latency = 15.0, 0.042
    stage.frames(2)
    assert video._chip.words.texts == ["64×48 · 15 fps · 42 ms"]
    video.show_chip = False
    stage.frames(2)
    assert (video._chip.words.texts, video._chip.ground.drawn) == ([], False)
    video.show_chip = True
    stage.frames(2)
    assert video._chip.ground.drawn
    assert drawn == []


def test_a_picture_is_mixed_with_the_ground_only_where_it_does_not_fill_its_frame(video, stage):
    video.corner = 0
    stage.frames(2)
    assert not video._unblended.on, "there is no picture yet"
    video.state = "live"
    video.show_frame(64, 48, FRAME)
    stage.frames(2)
    assert video._unblended.on
    video.opacity = 0.5
    assert not video._unblended.on, "it lets through what is below"
    video.opacity = 1
    assert video._unblended.on
    video.state = "stale"
    stage.frames(2)
    assert not video._unblended.on

from __future__ import annotations

import math
import os
import tracemalloc

import numpy as np
import pytest
from PIL import Image

from app.maps.floor_plan import FREE, MAX_PICTURE_BYTES, WALL, read_floor_plan
from app.maps.placed_picture import MAX_TEXTURE_SIDE

PLAIN = "image: a.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
SHADES = bytes([0, 255, 205, 254])


def write(folder, text=PLAIN, picture=b"P5\n# made by hand\n4 1\n255\n" + SHADES, name="a.pgm"):
    (folder / name).write_bytes(picture)
    (folder / "a.yaml").write_text(text)
    return folder / "a.yaml"


def seen(plan):
    return [tuple(plan.rgba[at : at + 4]) for at in range(0, 16, 4)]


def test_walls_floor_and_what_is_unknown_are_told_apart_by_the_thresholds(tmp_path):
    plan = read_floor_plan(write(tmp_path))
    assert (plan.width, plan.height) == (4, 1)
    assert seen(plan) == [WALL, FREE, (0, 0, 0, 0), FREE]


def test_a_negative_has_dark_floors(tmp_path):
    plan = read_floor_plan(write(tmp_path, PLAIN.replace("negate: 0", "negate: 1")))
    assert seen(plan)[:2] == [FREE, WALL]


def test_it_lies_where_its_origin_says_turned_by_its_yaw(tmp_path):
    plan = read_floor_plan(write(tmp_path))
    assert not plan.on_earth
    assert plan.box is None
    assert plan.corners == ((-1.0, 2.0), (1.0, 2.0), (1.0, 2.5), (-1.0, 2.5))
    turned = read_floor_plan(write(tmp_path, PLAIN.replace("0.0]", f"{math.pi / 2}]")))
    assert turned.corners[1] == pytest.approx((-1.0, 4.0))
    assert turned.corners[3] == pytest.approx((-1.5, 2.0))


def test_plain_and_deep_greys_and_png_are_read_alike(tmp_path):
    deep = b"P5 4 1 65535\n" + np.array([0, 65535, 52685, 65278], ">u2").tobytes()
    plain = b"P2\n4 1\n255\n0 255 205 254\n"
    for picture in (deep, plain):
        assert seen(read_floor_plan(write(tmp_path, picture=picture))) == [WALL, FREE, (0, 0, 0, 0), FREE]
    Image.frombytes("L", (4, 1), SHADES).save(tmp_path / "b.png")
    path = write(tmp_path, PLAIN.replace("a.pgm", "b.png"))
    assert seen(read_floor_plan(path)) == [WALL, FREE, (0, 0, 0, 0), FREE]


def test_lists_may_be_written_below_each_other_and_thresholds_left_out(tmp_path):
    text = (
        "image: 'a.pgm'  # beside it\nresolution: 5e-1\norigin:\n  - -1.0\n  - 2.0\n  - 0.0\nnegate: false\n"
    )
    assert read_floor_plan(write(tmp_path, text)).corners[0] == (-1.0, 2.0)


def test_a_picture_whose_path_is_of_another_computer_is_found_beside_the_file(tmp_path):
    assert read_floor_plan(write(tmp_path, PLAIN.replace("a.pgm", "/home/me/maps/a.pgm"))).width == 4


@pytest.mark.parametrize("name", ["../secret.pgm", "below/../../secret.pgm", "{above}/secret.pgm"])
def test_a_picture_outside_of_the_files_own_folder_is_not_opened(tmp_path, name):
    (tmp_path / "secret.pgm").write_bytes(b"P5 4 1 255\n" + SHADES)
    (tmp_path / "maps" / "below").mkdir(parents=True)
    path = write(tmp_path / "maps", PLAIN.replace("a.pgm", name.format(above=tmp_path)))
    with pytest.raises(ValueError, match=r"secret\.pgm cannot be read"):
        read_floor_plan(path)
    (tmp_path / "maps" / "secret.pgm").write_bytes(b"P5 2 1 255\n" + SHADES[:2])
    assert read_floor_plan(path).width == 2


@pytest.mark.parametrize("name", ["below/b.pgm", "below/../below/b.pgm", "{here}/below/b.pgm"])
def test_a_picture_below_the_files_folder_is_shown(tmp_path, name):
    (tmp_path / "below").mkdir()
    (tmp_path / "below" / "b.pgm").write_bytes(b"P5 2 1 255\n" + SHADES[:2])
    path = write(tmp_path, PLAIN.replace("a.pgm", name.format(here=tmp_path)))
    assert read_floor_plan(path).width == 2


def test_a_large_plan_loses_no_wall(tmp_path):
    side = 2 * MAX_TEXTURE_SIDE - 2
    levels = np.full((4, side), 255, np.uint8)
    levels[1, 7] = 0
    plan = read_floor_plan(write(tmp_path, picture=b"P5 %d 4 255\n" % side + levels.tobytes()))
    pixels = np.frombuffer(plan.rgba, np.uint8).reshape(plan.height, plan.width, 4)
    assert pixels.shape[:2] == (2, MAX_TEXTURE_SIDE - 1)
    assert tuple(pixels[0, 3]) == WALL
    assert (pixels == WALL).all(axis=-1).sum() == 1


@pytest.mark.parametrize(
    ("text", "picture", "sentence"),
    [
        ("[1, 2]", b"", "is no floor plan"),
        ("a: [", b"", "cannot be read as a floor plan"),
        ("\x00", b"", "cannot be read as a floor plan"),
        ("resolution: 0.5\norigin: [0, 0, 0]\n", b"", "does not name its picture"),
        (PLAIN.replace("0.5", "0"), b"", r"has resolution 0; 0\.001 to 100"),
        (PLAIN.replace("0.5", ".nan"), b"", "has resolution nan"),
        (
            PLAIN.replace("[-1.0, 2.0, 0.0]", "here"),
            b"P5 1 1 255\n1",
            "has the origin 'here', which is not x, y and yaw",
        ),
        (PLAIN, b"P5 4 1 255\n1", "is no PGM, PNG or JPEG picture"),
        (PLAIN, b"P5 90000 90000 255\n1", "90000 x 90000 pixels"),
        (PLAIN, b"P5", "is no PGM"),
        (PLAIN, b"words", "is no PGM"),
        (PLAIN.replace("a.pgm", "none.pgm"), b"", "none.pgm cannot be read"),
    ],
)
def test_what_cannot_be_shown_says_why(tmp_path, text, picture, sentence):
    with pytest.raises(ValueError, match=sentence):
        read_floor_plan(write(tmp_path, text, picture))


def test_a_picture_without_end_or_of_gigabytes_is_not_read(tmp_path):
    with pytest.raises(ValueError, match=r"picture zero cannot be read \(no file of at most 64 MB\)"):
        read_floor_plan(write(tmp_path, PLAIN.replace("a.pgm", "/dev/zero")))
    path = write(tmp_path)
    os.truncate(tmp_path / "a.pgm", MAX_PICTURE_BYTES + 1)
    with pytest.raises(ValueError, match="no file of at most 64 MB"):
        read_floor_plan(path)


def test_a_plan_that_is_long_and_narrow_takes_no_more_memory_than_its_picture(tmp_path):
    wide = 400_000
    path = write(tmp_path, PLAIN, b"P5 %d 2 255\n" % wide + bytes(2 * wide))
    tracemalloc.start()
    try:
        plan = read_floor_plan(path)
        assert tracemalloc.get_traced_memory()[1] < 50 * 2 * wide
    finally:
        tracemalloc.stop()
    assert plan.height == 1


def test_a_picture_with_an_endless_name_is_none(tmp_path):
    with pytest.raises(ValueError, match="does not name its picture"):
        read_floor_plan(write(tmp_path, PLAIN.replace("a.pgm", "a" * 5000)))

from __future__ import annotations

import math
import sys

import pytest
from PIL import Image
from PIL.TiffImagePlugin import ImageFileDirectory_v2

from app.maps.geotiff import read_geotiff, utm_to_geographic
from app.maps.placed_picture import MAX_TEXTURE_SIDE
from bridge.core.geo import Datum


def geo_keys(code: int, projected: bool, point: bool = False) -> tuple[int, ...]:
    keys = [
        (1024, 0, 1, 1 if projected else 2),
        (1025, 0, 1, 2 if point else 1),
        (3072 if projected else 2048, 0, 1, code),
    ]
    return (1, 1, 0, len(keys), *(number for key in keys for number in key))


def write(path, image=None, *, keys=(), scale=None, tie=None, matrix=None, nothing=None, **how):
    tags = ImageFileDirectory_v2()
    for tag, kind, value in ((34735, 3, keys), (33550, 12, scale), (33922, 12, tie), (34264, 12, matrix)):
        if value:
            tags[tag] = value
            tags.tagtype[tag] = 2 if isinstance(value, str) else kind
    if nothing is not None:
        tags[42113] = nothing
        tags.tagtype[42113] = 2
    (image or Image.new("RGB", (40, 20), "red")).save(path, "TIFF", tiffinfo=tags, **how)
    return path


def test_places_of_utm_are_those_of_the_surveyors():
    assert utm_to_geographic(500_000, 0, 31) == pytest.approx((0, 3), abs=1e-9)
    cn_tower = utm_to_geographic(630_084, 4_833_438, 17)
    assert cn_tower == pytest.approx((43.642567, -79.387139), abs=1e-5)
    assert utm_to_geographic(500_000, 0.9996 * 4_984_944.378, 32)[0] == pytest.approx(45.0, abs=1e-8)
    south = utm_to_geographic(630_084, 10_000_000 - 4_833_438, 17, south=True)
    assert south == pytest.approx((-cn_tower[0], cn_tower[1]))


@pytest.mark.parametrize("compression", [None, "tiff_lzw", "tiff_adobe_deflate"])
def test_a_picture_in_degrees_lies_where_its_file_says(tmp_path, compression):
    path = write(
        tmp_path / "a.tif",
        keys=geo_keys(4326, False),
        scale=(0.001, 0.001, 0),
        tie=(0, 0, 0, 8.0, 47.0, 0),
        compression=compression,
    )
    picture = read_geotiff(path)
    assert (picture.width, picture.height) == (40, 20)
    assert picture.rgba[:4] == bytes([255, 0, 0, 255])
    lower_left, _, upper_right, _ = picture.corners
    assert lower_left == pytest.approx((46.98, 8.0))
    assert upper_right == pytest.approx((47.0, 8.04))
    assert picture.box == pytest.approx((8.0, 46.98, 8.04, 47.0))


def test_a_picture_in_web_mercators_metres_lies_where_its_file_says(tmp_path):
    x, y = math.radians(8.0) * 6378137, math.asinh(math.tan(math.radians(47.0))) * 6378137
    path = write(tmp_path / "a.tif", keys=geo_keys(3857, True), scale=(1, 1, 0), tie=(0, 0, 0, x, y, 0))
    picture = read_geotiff(path)
    assert picture.corners[3] == pytest.approx((47.0, 8.0))
    across = math.dist(*(Datum(47.0, 8.0).to_local(*corner) for corner in picture.corners[:2]))
    assert across == pytest.approx(40 * math.cos(math.radians(47.0)), rel=0.01)


@pytest.mark.parametrize("code", [32632, 25832])
def test_a_picture_in_utm_has_its_size_in_metres_and_lies_where_its_file_says(tmp_path, code):
    path = write(
        tmp_path / "a.tif",
        keys=geo_keys(code, True),
        scale=(0.5, 0.5, 0),
        tie=(0, 0, 0, 500_000, 5_200_000, 0),
    )
    picture = read_geotiff(path)
    left, right, upper_right, _ = picture.corners_on(Datum(*picture.corners[3]))
    assert math.dist(left, right) == pytest.approx(20, rel=0.001)
    assert math.dist(right, upper_right) == pytest.approx(10, rel=0.001)


def test_a_file_that_places_the_middles_of_its_pixels_is_shifted_by_half_of_one(tmp_path):
    path = write(
        tmp_path / "a.tif",
        keys=geo_keys(4326, False, point=True),
        scale=(0.01, 0.01, 0),
        tie=(0, 0, 0, 8.0, 47.0, 0),
    )
    assert read_geotiff(path).corners[3] == pytest.approx((47.005, 7.995))


def test_a_turned_picture_is_placed_by_its_matrix(tmp_path):
    matrix = (0.0, 0.01, 0, 8.0, 0.01, 0.0, 0, 47.0, 0, 0, 0, 0, 0, 0, 0, 1)
    path = write(tmp_path / "a.tif", keys=geo_keys(4326, False), matrix=matrix)
    assert read_geotiff(path).corners[1] == pytest.approx((47.4, 8.2))


def test_what_is_no_data_is_seen_through(tmp_path):
    image = Image.new("RGB", (4, 1), (10, 20, 30))
    image.putpixel((0, 0), (0, 0, 0))
    path = write(
        tmp_path / "a.tif",
        image,
        keys=geo_keys(4326, False),
        scale=(1, 1, 0),
        tie=(0, 0, 0, 8.0, 47.0, 0),
        nothing="0",
    )
    rgba = read_geotiff(path).rgba
    assert (rgba[3], rgba[7]) == (0, 255)


def test_a_large_picture_is_made_as_small_as_a_texture_and_keeps_its_place(tmp_path):
    path = write(
        tmp_path / "a.tif",
        Image.new("L", (2 * MAX_TEXTURE_SIDE, 50)),
        keys=geo_keys(4326, False),
        scale=(1e-5, 1e-5, 0),
        tie=(0, 0, 0, 8.0, 47.0, 0),
    )
    picture = read_geotiff(path)
    assert (picture.width, picture.height) == (MAX_TEXTURE_SIDE, 25)
    assert picture.corners[2] == pytest.approx((47.0, 8.0 + 2e-5 * MAX_TEXTURE_SIDE))


PLACED = {"scale": (1, 1, 0), "tie": (0, 0, 0, 8.0, 47.0, 0)}


@pytest.mark.parametrize(
    ("file", "sentence"),
    [
        ({"keys": geo_keys(2154, True), **PLACED}, "lies in EPSG:2154; 4326, 3857 and UTM"),
        ({**PLACED}, r"lies in EPSG:\?"),
        ({"keys": geo_keys(4326, False)}, "does not say where on earth it lies"),
        ({"keys": geo_keys(4326, False), "scale": (0, 0, 0), "tie": PLACED["tie"]}, "does not say where"),
        ({"keys": geo_keys(4326, False), "scale": (9, 9, 0), "tie": PLACED["tie"]}, "lies nowhere on earth"),
        *(
            ({"keys": geo_keys(4326, False), **PLACED, **odd}, "a.tif does not say where on earth it lies.")
            for name in ("keys", "scale", "tie", "matrix")
            for odd in ({name: (7,)}, {name: "seven and some more"})
        ),
        (
            {"image": Image.new("F", (4, 4)), "keys": geo_keys(4326, False), **PLACED},
            r"holds measurements \(F\)",
        ),
        (
            {"image": Image.new("1", (12_000, 9_000)), "keys": geo_keys(4326, False), **PLACED},
            "has 108 million pixels",
        ),
    ],
)
@pytest.mark.filterwarnings("ignore::PIL.Image.DecompressionBombWarning")
def test_a_file_that_cannot_be_placed_says_why(tmp_path, file, sentence):
    with pytest.raises(ValueError, match=sentence):
        read_geotiff(write(tmp_path / "a.tif", **file))


def test_a_file_that_is_damaged_or_none_is_one_sentence(tmp_path):
    whole = write(
        tmp_path / "a.tif",
        Image.effect_noise((200, 200), 90),
        keys=geo_keys(4326, False),
        scale=(1e-3, 1e-3, 0),
        tie=(0, 0, 0, 8.0, 47.0, 0),
    )
    (tmp_path / "cut.tif").write_bytes(whole.read_bytes()[:9000])
    (tmp_path / "text.tif").write_text("no picture")
    for name in ("cut.tif", "text.tif", "none.tif"):
        with pytest.raises(ValueError, match=f"{name} cannot be read as a GeoTIFF file"):
            read_geotiff(tmp_path / name)


def test_where_pillow_lacks_it_is_said(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "PIL", None)
    with pytest.raises(ValueError, match="need Pillow, which this app was built without"):
        read_geotiff(tmp_path / "a.tif")

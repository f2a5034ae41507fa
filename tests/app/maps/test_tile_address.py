from __future__ import annotations

import pytest

from app.maps.tile_address import TileAddress


def test_rows_count_from_the_north_unless_the_address_says_otherwise():
    tile = (3, 5, 1)
    assert TileAddress("https://a.org/{z}/{x}/{y}.png").url(tile) == "https://a.org/3/5/6.png"
    assert TileAddress("https://a.org/{z}/{x}/{-y}.png").url(tile) == "https://a.org/3/5/1.png"
    assert TileAddress("https://a.org/{z}/{x}/{y}", from_south=True).url(tile) == "https://a.org/3/5/1"


def test_hosts_take_turns_dense_tiles_are_asked_for_and_the_key_goes_in():
    address = TileAddress("https://{s}.a.org/{z}/{x}/{y}{r}.png?k={key}", key="geheim", dense=True)
    urls = [address.url((3, column, 7)) for column in range(3)]
    assert urls[0] == "https://b.a.org/3/0/0@2x.png?k=geheim"
    assert {url[8] for url in urls} == set("abc")


def test_what_is_shown_of_an_address_holds_no_key():
    address = TileAddress("https://a.org/{z}/{x}/{y}.png?apikey=geheim")
    assert address.shown == "https://a.org/{z}/{x}/{y}.png"
    assert TileAddress("https://{s}.tiles.a.org:81/{z}/{x}/{y}").host == "s.tiles.a.org"


@pytest.mark.parametrize(
    ("template", "sentence"),
    [
        ("", "begins with https://"),
        ("file:///etc/{z}/{x}/{y}", "begins with https:// or http:// and a host"),
        ("https:///{z}/{x}/{y}", "and a host"),
        ("https://a.org/{x}/{y}", "lacks {z}"),
        ("https://a.org/{z}/{x}/", "lacks {y}"),
        ("https://a.org/{z}/{x}/{y}/{quadkey}", "has {quadkey}, which nothing stands for"),
        ("https://a.org/{z}/{x}/{y}?k={key}", "has {key}, and no key is given"),
        ("https://me:pw@a.org/{z}/{x}/{y}", "no user and no password"),
        ("https://a.org:99999/{z}/{x}/{y}", "host or port cannot be read"),
        ("https://a.org/{z}/{x}/ {y}", "no spaces"),
        ("https://a.org/{z}/{x}/{y}" + "a" * 1000, "at most 1000"),
    ],
)
def test_an_address_that_names_no_tiles_says_why(template, sentence):
    with pytest.raises(ValueError, match=sentence.replace("{", r"\{").replace("?", r"\?")):
        TileAddress(template)

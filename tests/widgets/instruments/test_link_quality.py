from __future__ import annotations

import math

import pytest

from widgets.instruments.link_quality import LOOKS, LinkQuality, quality


@pytest.mark.parametrize(
    ("rtt", "lost", "word"),
    [
        (0.012, 0, "good"),
        (0.012, 2, "fair"),
        (0.1, 0, "fair"),
        (0.3, 0, "bad"),
        (0.012, 6, "bad"),
        (math.nan, 20, "unknown"),
    ],
)
def test_round_trip_and_losses_decide_the_quality(rtt, lost, word):
    assert quality(rtt, lost) == word


def test_it_says_the_round_trip_and_the_losses():
    link = LinkQuality(state="live", rtt=0.0124, lost=3)
    assert link.text == "12 ms · 3 lost"
    link.brief = True
    assert link.text == "12 ms"
    link.rtt = 2.34
    assert link.text == "2.3 s"


def test_before_it_is_measured_it_shows_a_dash():
    assert LinkQuality().text == "—"
    assert LinkQuality(state="live").text == "—"


def test_a_lost_link_is_a_sentence_and_stands_out():
    link = LinkQuality(state="live", rtt=0.012, sentence="no heartbeat for 6 s")
    assert (link.quality, link.text) == ("lost", "no heartbeat for 6 s")
    assert link.children[0].outlined
    link.sentence = ""
    assert (link.quality, link.children[0].outlined) == ("good", False)


def test_every_quality_has_an_icon_of_its_own_or_another_role():
    assert len(set(LOOKS.values())) == len(LOOKS)


def test_silence_is_said_instead_of_an_old_round_trip():
    link = LinkQuality(state="live", rtt=0.028, brief=True)
    link.silence = 1.52
    assert (link.quality, link.text, link.children[0].role) == ("silent", "silent 1.5 s", "warn")
    link.silence = 0.0
    assert (link.quality, link.text) == ("good", "28 ms")
    link.sentence = "no link"
    link.silence = 4.0
    assert link.text == "no link"

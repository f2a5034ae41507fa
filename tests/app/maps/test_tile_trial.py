from __future__ import annotations

import math

import pytest

from app.maps.tile_address import TileAddress
from app.maps.tile_server import NoAnswer, Tile
from app.maps.tile_store import Stored
from app.maps.tile_trial import TileTrial, tile_at

ADDRESS = TileAddress("https://a.org/{z}/{x}/{y}.png")


class Server:
    def __init__(self, answer):
        self.answer = answer

    def fetch(self, address, tile, kept=None):
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (NoAnswer("It is gone."), "It is gone."),
        (Tile(Stored(None), None), "The server has no tile of this place at zoom level 3."),
        (MemoryError(), "The tile cannot be shown (MemoryError)."),
        (KeyError("x"), "The tile cannot be shown (KeyError)."),
    ],
)
def test_whatever_goes_wrong_is_a_sentence_and_never_an_endless_try(answer, said, caplog):
    trial = TileTrial(Server(answer), ADDRESS, (3, 4, 5))
    trial.wait()
    assert (trial.over, trial.picture, trial.problem) == (True, None, said)


def test_the_tile_that_is_tried_shows_where_the_robot_is_or_somewhere():
    assert tile_at(math.nan, math.nan, 0, 19) == (3, 4, 5)
    assert tile_at(0.1, 0.1, 0, 4) == (4, 8, 8)

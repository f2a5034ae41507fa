"""The detector of things in a camera picture: people, traffic cones, cars and boxes, by a small network that was trained on drawn scenes.

`scripts/train_detector.py` has made `detector.npz`, the network's weights; `bench/detector.py` judges it. Orange cones have a second witness,
the rule of their colours, which sees small ones that the network is not sure of; where the network sees a person it is not asked.
"""

from __future__ import annotations

import io
import math
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from bridge.core.camera_frames import picture_size
from bridge.core.errors import ProtocolError
from bridge.msgs.additions import DETECTED_CLASSES
from robotside.perception.cone_detector import cones_in
from robotside.perception.intruder_tracker import SURE_SCORE
from robotside.perception.network import CELL, LAYERS, Layers, run
from robotside.perception.sighting import Sighting

__all__ = ["CLASSES", "SEARCHED", "decoded", "find_things"]

CLASSES = DETECTED_CLASSES
"""What it knows, in the order of the network's scores."""

SEARCHED = (320, 240)
"""Columns and rows that are searched; larger pictures are made smaller first."""

SURE_OUTPUTS = (0.33, 0.42, 0.44, 0.44)
"""By class, the network's output at which a thing is as sure as `SURE_SCORE`: by day 95 % of what is told is right, on scenes that are not judged by."""

LEAST_SCORE = 0.5
"""What looks less like its class, 0 to 1, is not told."""

SAME_OVERLAP = 0.5
"""Of two boxes of one class that share more than this of what they cover together, the better one is told."""

MAX_THINGS = 40
"""That are told of one picture."""

MAX_SHARED = 0.3
"""A cone by its colours of which more lies within a cone or a person of the network is none of its own."""

MAX_REACH = 5.0
"""Exponent of the largest distance from a cell to an edge; beyond it lies no picture."""

WEIGHTS = Path(__file__).with_name("detector.npz")

Picture = NDArray[np.uint8]


def find_things(jpeg: bytes) -> list[Sighting]:
    """The things in a picture, best first; a picture that cannot be read shows none."""
    picture = decoded(jpeg)
    if picture is None:
        return []
    found = _witnessed(_seen(picture), cones_in(picture))
    return sorted(found, key=lambda one: -one.score)[:MAX_THINGS]


def _seen(picture: Picture) -> list[Sighting]:
    """What the network sees in a picture that has the size that is searched or less."""
    framed, wide, high = _framed(picture)
    across, down = SEARCHED[0] / wide, SEARCHED[1] / high
    return [_within(one, across, down) for one in _sightings(run(framed, _layers()))]


def _witnessed(seen: list[Sighting], orange: list[Sighting]) -> list[Sighting]:
    """What the network sees, and what by the rule of colours is surely a cone where the network sees none and no person."""
    sure = [cone for cone in orange if cone.score >= SURE_SCORE]
    others = [one for one in seen if one.kind in {"cone", "person"}]
    return [
        *seen,
        *(cone for cone in sure if not any(_part_within(cone, one) > MAX_SHARED for one in others)),
    ]


def _part_within(inner: Sighting, outer: Sighting) -> float:
    """How much of one lies within the other, 0 to 1."""
    wide = min(inner.right, outer.right) - max(inner.left, outer.left)
    high = min(inner.bottom, outer.bottom) - max(inner.top, outer.top)
    return max(0.0, wide) * max(0.0, high) / max(inner.width * inner.height, 1e-9)


def decoded(jpeg: bytes) -> Picture | None:
    """A picture as it is searched; None where it cannot be read."""
    try:
        picture_size(jpeg)
        with Image.open(io.BytesIO(jpeg), formats=("JPEG",)) as image:
            image.draft("RGB", SEARCHED)
            small = image.convert("RGB")
    except (ProtocolError, UnidentifiedImageError, OSError, ValueError):
        return None
    scale = min(SEARCHED[0] / small.width, SEARCHED[1] / small.height)
    fitting = max(1, round(small.width * scale)), max(1, round(small.height * scale))
    if fitting != small.size:
        small = small.resize(fitting, Image.Resampling.BILINEAR)
    return np.asarray(small)


def _framed(picture: Picture) -> tuple[Picture, int, int]:
    """The picture in the upper left of a grey one of the size that is searched, and its own width and height."""
    high, wide = picture.shape[:2]
    if (wide, high) == SEARCHED:
        return picture, wide, high
    framed = np.full((SEARCHED[1], SEARCHED[0], 3), int(picture.mean()), dtype=np.uint8)
    framed[:high, :wide] = picture
    return framed, wide, high


def _within(one: Sighting, across: float, down: float) -> Sighting:
    """The same in parts of a picture that does not fill the one that was searched."""
    left, right = min(one.left * across, 1.0), min(one.right * across, 1.0)
    return Sighting(left, min(one.top * down, 1.0), right, min(one.bottom * down, 1.0), one.score, one.kind)


@lru_cache(maxsize=1)
def _layers() -> Layers:
    """The weights, which are kept as half precision."""
    with np.load(WEIGHTS) as file:
        return {
            name: (file[f"{name}.w"].astype(np.float32), file[f"{name}.b"].astype(np.float32))
            for name in LAYERS
        }


def _sightings(cells: NDArray[np.float32]) -> list[Sighting]:
    """What the cells of a picture say: of those that see the same thing the surest."""
    count = len(CLASSES)
    shift = [_odds(SURE_SCORE) - _odds(output) for output in SURE_OUTPUTS]
    odds = cells[..., :count] + np.array(shift, dtype=np.float32)
    rows, columns, kinds = np.nonzero(odds > _odds(LEAST_SCORE))
    if not len(rows):
        return []
    scores = 1 / (1 + np.exp(-odds[rows, columns, kinds]))
    reach = np.exp(np.clip(cells[rows, columns, count:], -MAX_REACH, MAX_REACH)) * CELL
    middle = np.stack(((columns + 0.5) * CELL, (rows + 0.5) * CELL), axis=1)
    size = cells.shape[1] * CELL, cells.shape[0] * CELL
    low = np.clip(middle - reach[:, :2], 0.0, size)
    high = np.clip(middle + reach[:, 2:], 0.0, size)
    boxes = np.concatenate((low, high), axis=1) / np.array((*size, *size))
    found: list[Sighting] = []
    for at in _distinct(boxes, scores, kinds):
        left, top, right, bottom = (float(part) for part in boxes[at])
        found.append(Sighting(left, top, right, bottom, float(scores[at]), CLASSES[kinds[at]]))
    return found


def _odds(score: float) -> float:
    """The logarithm of how much likelier it is than not."""
    return math.log(score / (1 - score))


def _distinct(
    boxes: NDArray[np.floating], scores: NDArray[np.floating], kinds: NDArray[np.integer]
) -> list[int]:
    """Of boxes of one class that overlap the surest one, by falling score."""
    area = (boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1])
    waiting = np.argsort(-scores, kind="stable")
    kept: list[int] = []
    while len(waiting) and len(kept) < MAX_THINGS:
        first, others = int(waiting[0]), waiting[1:]
        kept.append(first)
        low = np.maximum(boxes[first, :2], boxes[others, :2])
        high = np.minimum(boxes[first, 2:], boxes[others, 2:])
        shared = np.prod(np.maximum(high - low, 0.0), axis=1)
        overlap = shared / np.maximum(area[first] + area[others] - shared, 1e-9)
        waiting = others[(overlap < SAME_OVERLAP) | (kinds[others] != kinds[first])]
    return kept

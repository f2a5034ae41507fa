"""Places on a drive screen in three columns: rectangles by the shape of the window.

Pure arithmetic in the window's pixels, origin at the lower left.
"""

from __future__ import annotations

from app.layout.arrange_phone import phone_dive
from app.layout.rects import (
    EDGE,
    Rect,
    StopPlace,
    all_mirrored,
    between,
    left_handed,
    mirrored,
    right_handed,
    stop_place,
    stop_tall,
)

__all__ = ["dive"]

USUAL = (1204.0, 744.0)
"""Width and height of the body that the sizes below are made for [dp]; a larger one has everything larger."""
STRIP = 54
"""Height of the folded card of the small sensors: a finger opens it [dp]."""
INSET, INSET_TALL, INSET_ASPECT = 220.0, 96.0, 1.25
"""Width of what is small over the picture, and on an upright phone [dp], and that by its height."""
LINE = 42
"""Height of depth and commanded motion on a small picture [dp]."""
LARGEST = 1.45
"""How much larger at most."""


def dive(
    body: Rect, shape: str, dp: float = 1.0, *, pulled: bool = False, sensed: bool = False
) -> tuple[dict[str, Rect], StopPlace]:
    """Of the dive screen: what is seen of the robot in `legs`, `compass` and `horizon` on their `panel`, the `video` with
    `corner` and `motion`, `stick`, `lift` and `tilt`, which have a card `hands` on a tablet, and the column of `actions`;
    and where STOP is, at the foot of the column.

    `inset` is for what is small over the video: the map, or the video itself while the map is large; it is left out where there
    is no room. `senses` is the strip of the small sensors and `senses_open` where it unfolds. `notice` is for what is said, `notice_low` for what holds on until it is dealt with.
    On a phone's side the picture is the screen, and `pulled` and `sensed` as of `phone_dive`.
    """
    if left_handed(body):
        places, stop = dive(right_handed(body), shape, dp, pulled=pulled, sensed=sensed)
        return all_mirrored(places, body), mirrored(stop, body)
    if shape == "tall":
        return _tall(body, dp)
    return _wide(body, dp) if shape == "wide" else phone_dive(body, dp, pulled=pulled, sensed=sensed)


def _wide(body: Rect, dp: float) -> tuple[dict[str, Rect], StopPlace]:
    """As on a tablet: three columns, the hands under the picture."""
    scale = min(LARGEST, max(0.8, min(body.width / (USUAL[0] * dp), body.height / (USUAL[1] * dp))))
    unit, gap = dp * scale, 14 * dp
    low, top = body.y + gap, body.top - gap
    left = Rect(body.x + gap, low, 284 * unit, top - low)
    stop = stop_place(body, "wide", dp)
    column = max(286 * unit, stop.width)
    right = between(body.right - EDGE * dp - column, stop.head + gap, body.right - EDGE * dp, top)
    middle = between(left.right + gap, low, right.x - gap, top)
    legs = between(left.x, top - 236 * unit, left.right, top)
    panel = between(left.x, low, left.right, legs.y - gap)
    hands = Rect(middle.x, low, middle.width, 216 * unit)
    motion = Rect(middle.x, hands.top + gap, middle.width, 84 * unit)
    video = between(middle.x, motion.top + gap, middle.right, top)
    size = hands.height - 24 * dp
    stick = Rect(hands.x + 12 * dp, low + 12 * dp, size, size)
    lift = Rect(stick.right + 1.5 * gap, stick.y, 72 * unit, size)
    tilt = between(lift.right + 1.5 * gap, stick.y, hands.right - 12 * dp, stick.top)
    places = {"legs": legs, "panel": panel, "video": video, "motion": motion, "actions": right}
    places |= {"hands": hands, "stick": stick, "lift": lift, "tilt": tilt} | _stacked(panel, 14 * dp)
    places["corner"] = Rect(video.x + gap, video.top - gap - 150 * unit, 176 * unit, 150 * unit)
    places |= _sensors(video, places["corner"], dp)
    free = between(video.x, video.y, video.right, places["corner"].y)
    places["inset"] = _inset(free, 14 * dp, min(INSET * unit, 0.36 * video.width))
    return places | _notices(free, dp, places["inset"]), stop


def _tall(body: Rect, dp: float) -> tuple[dict[str, Rect], StopPlace]:
    """A phone held upright: the picture on top, the hands at its foot beside STOP."""
    gap = 12 * dp
    stop, strip = stop_tall(body, dp)
    video_high = min(body.width * 0.62, body.height * 0.34)
    video = Rect(body.x, body.top - video_high, body.width, video_high)
    across = body.width - 2 * gap
    lift = Rect(strip.right - 58 * dp, strip.y, 58 * dp, strip.height)
    stick = between(strip.x, strip.y, lift.x - 8 * dp, strip.top)
    second = stop.head + gap
    seen_high = min(max(126 * dp, (video.y - second) * 0.38), 260 * dp)
    seen = Rect(body.x + gap, video.y - gap - seen_high, across, seen_high)
    dials = min(2 * seen.height, across * 0.49)
    legs = between(seen.x, seen.y, seen.right - dials - gap, seen.top)
    panel = between(legs.right + gap, seen.y, seen.right, seen.top)
    tilt_size = min(across * 0.4, seen.y - gap - second)
    tilt = Rect(seen.x, seen.y - gap - tilt_size, tilt_size, tilt_size)
    actions = between(tilt.right + gap, second, seen.right, seen.y - gap)
    places = {"legs": legs, "panel": panel, "video": video, "actions": actions}
    places |= {"stick": stick, "lift": lift, "tilt": tilt} | _stacked(panel, 8 * dp)
    shown = _on_video(video, dp)
    free = between(video.x, shown["motion"].top, video.right, shown["senses"].y)
    small = _inset(free, 8 * dp, min(INSET_TALL * dp, (free.height - 16 * dp) * INSET_ASPECT))
    return places | shown | {"inset": small} | _notices(free, dp, small), stop


def _stacked(panel: Rect, edge: float) -> dict[str, Rect]:
    """Two round instruments on their panel: above or beside each other, however they are larger."""
    room = Rect(panel.x + edge, panel.y + edge, panel.width - 2 * edge, panel.height - 2 * edge)
    half = (room.height - edge) / 2
    if min(room.width, half) >= min((room.width - edge) / 2, room.height):
        return {
            "compass": Rect(room.x, room.top - half, room.width, half),
            "horizon": Rect(room.x, room.y, room.width, half),
        }
    half = (room.width - edge) / 2
    return {
        "compass": Rect(room.x, room.y, half, room.height),
        "horizon": Rect(room.right - half, room.y, half, room.height),
    }


def _on_video(video: Rect, dp: float) -> dict[str, Rect]:
    """Depth and commanded motion on a small picture, each in a line."""
    gap, high = 8 * dp, LINE * dp
    corner = Rect(video.x + gap, video.top - gap - high, 132 * dp, high)
    motion = Rect(video.x + gap, video.y + gap, video.width - 2 * gap, high)
    return {"corner": corner, "motion": motion} | _sensors(video, corner, dp)


def _sensors(video: Rect, corner: Rect, dp: float) -> dict[str, Rect]:
    """The strip of the small sensors beside the corner, and where it unfolds: over the picture, from its upper edge."""
    gap = 8 * dp
    wide = min(video.right - corner.right - 2 * gap, 326 * dp)
    strip = Rect(video.right - gap - wide, corner.top - STRIP * dp, wide, STRIP * dp)
    room = Rect(video.x + gap, video.y + gap, video.width - 2 * gap, corner.top - video.y - gap)
    width, height = min(room.width, 420 * dp), min(room.height, 240 * dp)
    return {
        "senses": strip,
        "senses_open": Rect(room.right - width, room.top - height, width, height),
    }


def _inset(free: Rect, gap: float, width: float) -> Rect:
    """In the lower right corner of what is free of the picture."""
    high = width / INSET_ASPECT
    return Rect(free.right - gap - width, free.y + gap, width, high)


def _notices(video: Rect, dp: float, small: Rect) -> dict[str, Rect]:
    """What holds on until it is dealt with is beside what is `small`."""
    gap = 8 * dp
    room = between(video.x + gap, video.y + gap, video.right - gap, video.top - gap)
    return {"notice": room, "notice_low": between(room.x, room.y, small.x - gap, room.top)}

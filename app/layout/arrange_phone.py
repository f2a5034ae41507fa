"""Places on a drive screen of a phone on its side: the picture is the screen, and a finger pulls the rest out of a drawer.

Pure arithmetic in the window's pixels, origin at the lower left.
"""

from __future__ import annotations

from dataclasses import replace

from app.layout.rects import Rect, StopPlace, between, stop_place

__all__ = ["phone_dive", "phone_drive", "whole"]

AWAY_X = -1e4
"""x of what is off the glass [px]."""
USUAL_HEIGHT = 364
"""Of the body that the sizes below are made for; in a lower one everything is smaller [dp]."""
GAP = 10
"""[dp]"""
STICK = 168
FIGURES, TAPE, BADGE = (252, 48), (204, 44), (186, 44)
"""Width and height of what is seen while driving, along the upper edge [dp]."""
NARROW = 200
"""Width of the figures beside two sticks [dp]."""
HANDLE = 96, 44
"""Width and height of what a finger pulls [dp]."""
INSET_DIVE, LEAST_INSET, COMPASS, DEPTH = (92, 72), 70, 92, 170
"""On a dive screen: width and height of what is small over the picture, and its least width; side of the compass, width of the depth [dp]."""
SLIDE = 52
SWITCH = 48
CHECKS = 340
"""Width of the robot's own checks [dp]."""
LEFT, RIGHT, SENSES, SLIDER, ACTIONS = 190, 150, 190, 84, 132
"""Widths in the drawer, from left to right [dp]; all are as much narrower as there is less room."""


def whole(shown: dict[str, Rect], hidden: dict[str, Rect]) -> dict[str, Rect]:
    """`shown`, and what only `hidden` has as large but off the glass."""
    gone = {name: Rect(AWAY_X, place.y, place.width, place.height) for name, place in hidden.items()}
    return gone | shown


def phone_drive(
    body: Rect, dp: float = 1.0, *, two: bool = False, switch: bool = False, pulled: bool = False
) -> dict[str, Rect]:
    """As `app.layout.arrange.drive` on a phone's side. The drawer comes down from the bar; it covers neither a stick nor STOP.

    `drawer` is its ground and `handle` what pulls it; in it are the instruments, `slider`, `actions`, `senses` and `switch`.
    `pulled`: it is out, and the places of what is seen while driving are left out; else those of what is in it. `two`: there is a
    `right_stick`, and `confirm` for slides. `alone` is for what takes the place of the stick and is none.
    """
    unit = _unit(body, dp)
    gap = GAP * unit
    stick, stop = _hands(body, unit, dp)
    places: dict[str, Rect] = {"video": body, "stop": stop, "stick": stick}
    low, right = body.y + gap, stop.left - gap
    if two:
        places["right_stick"] = Rect(right - stick.width, stick.y, stick.width, stick.height)
        right = places["right_stick"].x - gap
        left = stick.right + (SLIDER * unit + gap if switch else 0) + gap
        places["confirm"] = between(left, low, right, low + 2 * SLIDE * unit + 8 * unit)
        low = places["confirm"].top + gap
    places["alone"] = Rect(stick.x, stick.y, stick.width + SLIDER * unit + gap, stick.height)
    seen = _seen(body, unit)
    if two:  # whose right one takes as much of the picture
        seen["readouts"] = replace(seen["readouts"], width=min(seen["readouts"].width, NARROW * unit))
    sheet = _drawer(body, stick.top, unit, switch=switch)
    middle = (stick.right + right) / 2 if two else body.x + body.width / 2
    handle = _handle(middle, seen["top"].y - 4 * unit, unit)
    left = places["alone"].right if switch else stick.right
    places["notice"] = between(left + gap, low, right, handle.y - 8 * unit)
    if pulled:
        return places | sheet | {"handle": _handle(middle, sheet["drawer"].y - 4 * unit, unit)}
    seen["notice_low"] = _checks(body, stick.top, seen["readouts"].y, handle.x, unit)
    return places | seen | {"handle": handle}


def _unit(body: Rect, dp: float) -> float:
    """One dp, or less where there is less height [px]."""
    return dp * min(1.0, body.height / (USUAL_HEIGHT * dp))


def _hands(body: Rect, unit: float, dp: float) -> tuple[Rect, StopPlace]:
    """The stick under the left thumb and STOP under the right one."""
    gap = GAP * unit
    stick = Rect(body.x + gap, body.y + gap, STICK * unit, STICK * unit)
    return stick, stop_place(body, "short", dp)


def _seen(body: Rect, unit: float) -> dict[str, Rect]:
    """Figures at the left, the heading in the middle, what was found at the right."""
    gap = GAP * unit

    def top(x: float, size: tuple[float, float]) -> Rect:
        return Rect(x, body.top - gap - size[1] * unit, size[0] * unit, size[1] * unit)

    left, tape = body.x + gap, body.x + (body.width - TAPE[0] * unit) / 2
    return {
        "readouts": top(left, (min(FIGURES[0], (tape - gap - left) / unit), FIGURES[1])),
        "top": top(tape, TAPE),
        "badge": top(body.right - gap - BADGE[0] * unit, BADGE),
    }


def _checks(body: Rect, low: float, top: float, handle: float, unit: float) -> Rect:
    """Between the stick and what is seen, so that it covers nothing that is touched; below the words of the picture."""
    left = body.x + GAP * unit
    right = min(left + CHECKS * unit, handle - 8 * unit)
    return between(left, low + 6 * unit, right, max(top - 34 * unit, low + 16 * unit))


def _handle(middle: float, top: float, unit: float) -> Rect:
    width, height = HANDLE[0] * unit, HANDLE[1] * unit
    return Rect(middle - width / 2, top - height, width, height)


def _drawer(body: Rect, low: float, unit: float, *, switch: bool) -> dict[str, Rect]:
    """From the bar down to the thumbs."""
    gap = GAP * unit
    ground = between(body.x, low + gap, body.right, body.top)
    high, low = ground.top - gap, ground.y + gap
    widths: dict[str, float] = {
        "top_left": LEFT,
        "top_right": RIGHT,
        "senses": SENSES,
        "slider": SLIDER,
        "actions": ACTIONS,
    }
    row = between(ground.x + gap, low, ground.right - gap, high)
    places = {"drawer": ground} | _beside(row, widths, gap)
    if switch:
        room = places["top_left"]
        places["switch"] = Rect(room.x, room.top - SWITCH * unit, room.width, SWITCH * unit)
        places["top_left"] = between(room.x, room.y, room.right, places["switch"].y - 8 * unit)
    return places | {"senses_open": places["senses"]}


def _beside(row: Rect, widths: dict[str, float], gap: float) -> dict[str, Rect]:
    """Side by side in `row`, as wide as `widths` are to each other."""
    share, x = (row.width - (len(widths) - 1) * gap) / sum(widths.values()), row.x
    places: dict[str, Rect] = {}
    for name, width in widths.items():
        places[name] = Rect(x, row.y, width * share, row.height)
        x += width * share + gap
    return places


def _inset_dive(seen: dict[str, Rect], unit: float) -> dict[str, Rect]:
    """What is small over the picture, between the motion and the compass; nothing where there is too little room."""
    gap, compass = 8 * unit, seen["compass"]
    left = max(seen["motion"].right + gap, compass.x - gap - INSET_DIVE[0] * unit)
    small = between(left, compass.top - INSET_DIVE[1] * unit, compass.x - gap, compass.top)
    return {"inset": small} if small.width >= LEAST_INSET * unit else {}


def phone_dive(
    body: Rect, dp: float = 1.0, *, pulled: bool = False, sensed: bool = False
) -> tuple[dict[str, Rect], StopPlace]:
    """As `app.layout.arrange_dive.dive` on a phone's side; `pulled` as of `phone_drive`. `sensed`: there are small sensors."""
    unit = _unit(body, dp)
    gap = GAP * unit
    stick, stop = _hands(body, unit, dp)
    lift = Rect(stick.right + gap, stick.y, 60 * unit, stick.height)
    tilt = Rect(stop.left - gap - stick.width, stick.y, stick.width, stick.height)
    row = _seen(body, unit)
    seen = {
        "corner": replace(row["readouts"], width=min(row["readouts"].width, DEPTH * unit)),
        "motion": between(
            row["top"].x - 40 * unit, row["top"].y - 2 * unit, row["top"].right + 40 * unit, row["top"].top
        ),
        "compass": Rect(
            body.right - gap - COMPASS * unit, body.top - gap - COMPASS * unit, COMPASS * unit, COMPASS * unit
        ),
    }
    seen |= _inset_dive(seen, unit)
    ground = between(body.x, stick.top + gap, body.right, body.top)
    high, low = ground.top - gap, ground.y + gap
    widths: dict[str, float] = {
        "legs": 190,
        "panel": 165,
        **({"senses": 190} if sensed else {}),
        "actions": 360,
    }
    sheet = {"drawer": ground} | _beside(between(ground.x + gap, low, ground.right - gap, high), widths, gap)
    panel = sheet["panel"]
    edge = 4 * unit
    sheet["horizon"] = between(panel.x + edge, panel.y + edge, panel.right - edge, panel.top - edge)
    sheet.setdefault("senses", Rect(AWAY_X, low, 1, 1))
    sheet["senses_open"] = sheet["senses"]
    middle = (lift.right + tilt.x) / 2
    handle = _handle(middle, seen["motion"].y - 4 * unit, unit)
    room = between(lift.right + gap, body.y + gap, tilt.x - gap, handle.y - 8 * unit)
    places = {"video": body, "stick": stick, "lift": lift, "tilt": tilt, "notice": room}
    if pulled:
        return places | sheet | {"handle": _handle(middle, ground.y - 4 * unit, unit)}, stop
    seen["notice_low"] = _checks(body, stick.top, seen["corner"].y, handle.x, unit)
    return places | seen | {"handle": handle}, stop

"""Places on every screen: rectangles by screen and by the shape of the window.

Pure arithmetic in the window's pixels, origin at the lower left. Turning the device moves widgets and
makes none anew, so nothing that was entered is lost.
"""

from __future__ import annotations

from app.layout.arrange_drive import drive, two_sticks
from app.layout.rects import (
    ALL_BESIDE,
    EDGE,
    Body,
    Rect,
    StopPlace,
    between,
    crowded,
    handed,
    left_handed,
    mirrored,
    right_handed,
    stop_place,
    stop_tall,
)

__all__ = [
    "CORNER",
    "Body",
    "Rect",
    "StopPlace",
    "connect_columns",
    "corner",
    "drive",
    "form",
    "inputs",
    "inputs_alone",
    "mission",
    "more",
    "shell",
    "stop_list",
    "talk_row",
    "tasks",
    "topics",
    "two_sticks",
]

MODES_HEIGHT = 46
"""Of what chooses what a finger on the map does [dp]; in gloves a whole target."""
SELECTION = 310
"""Width of the bar for what is selected on a phone's map [dp]."""
MAX_LIST_WIDTH = 720
"""Width from which a row's switch is too far from its words [dp]."""
STRIP = 190
"""A strip beside STOP that is narrower has no room for a sentence [dp]."""


def form(width: float, height: float, dp: float = 1.0) -> str:
    """Shape of a window of that size [px]: `tall`, `short` (a phone on its side) or `wide`; `dp` is one dp [px]."""
    if height >= width:
        return "tall"
    return "short" if height < 600 * dp else "wide"


def talk_row(height: float, dp: float = 1.0) -> float:
    """How high the row of the button to talk is above the navigation of an upright window [px]."""
    return min(max(0.086 * height, 52 * dp), 96 * dp)


def shell(
    width: float,
    height: float,
    dp: float = 1.0,
    *,
    talks: bool = False,
    inside: Rect | None = None,
    target: float = 0.0,
    left_hand: bool = False,
) -> dict[str, Rect]:
    """Of the frame round every screen of a robot: `bar` on top, `nav`, and the `body` between.

    `talks`: the navigation holds the button to talk as well, in an upright window in a row of its own. `inside` is what of
    the window no edge of a phone takes; all of it where that is None. Bar and navigation are no narrower than a `target` [px].
    For a `left_hand` the navigation of a window that is not upright is at the right.
    """
    shape, room = form(width, height, dp), inside or Rect(0, 0, width, height)
    bar = max((48 if shape == "short" else 56) * dp, target)
    top = Rect(room.x, room.top - bar, room.width, bar)
    if shape == "tall":
        high = max(60 * dp, target) + (talk_row(height, dp) if talks else 0)
        nav = Rect(room.x, room.y, room.width, high)
        return {"bar": top, "nav": nav, "body": Rect(room.x, nav.top, room.width, room.height - bar - high)}
    rail = max((68 if shape == "short" else 76) * dp, target + 12 * dp if target else 0)
    body = Rect(room.x + rail, room.y, room.width - rail, room.height - bar)
    nav = Rect(room.x, room.y, rail, room.height - bar)
    if left_hand:
        nav, body = mirrored(nav, room), mirrored(body, room)
    return {"bar": top, "nav": nav, "body": body}


def connect_columns(width: float, dp: float = 1.0) -> int:
    """How many cards stand side by side."""
    return max(1, min(4, int(width // (330 * dp))))


@handed
def mission(
    body: Rect, shape: str, dp: float = 1.0, *, sheet_open: bool = False, grip: float = 0.0
) -> dict[str, Rect]:
    """Of the mission screen: `map`, `panel`, `stop`, and what floats on the map.

    `sheet_open` draws the sheet of the tall form up over most of the map; a finger reaches no less than `grip` of its edge [px].
    """
    if shape == "tall":
        return _mission_tall(body, dp, sheet_open, grip)
    gap, wide, target = 14 * dp, shape == "wide", body.target if isinstance(body, Body) else 0.0
    side = min(max(344 * dp, body.width * 0.22), 420 * dp) if wide else 304 * dp
    panel = Rect(body.right - side, body.y, side, body.height)
    stop = stop_place(body, shape, dp)
    if not wide:  # on a phone's side it has room beside STOP
        beside = min(stop.x - (8 + EDGE) * dp - panel.x, 0.6 * stop.width)
        stop = stop_place(body, shape, dp, beside=beside)
    area = Rect(body.x, body.y, body.width - side, body.height)
    places = {
        "map": area,
        "panel": _above(panel, stop, gap if wide else 10 * dp),
        "side": panel,
        "stop": stop,
    }
    button, modes = max((52 if wide else 46) * dp, target), max(MODES_HEIGHT * dp, target)
    free = Rect(area.x, area.y + 142 * dp, area.width, area.height - 142 * dp) if wide else area
    places["tools"] = _column(free, button, 8, gap, 8 * dp if wide else 6 * dp)
    places["modes"] = Rect(
        area.x + gap, area.top - gap - modes, min(384 * dp, places["tools"].x - area.x - 2 * gap), modes
    )
    if wide:
        places |= _mission_instruments(area, places["modes"].y, gap, dp)
    else:
        places |= _mission_short(area, places["tools"].x - gap, gap, dp)
    return places | {"notice": _mission_notice(places, gap, dp)}


def _mission_short(area: Rect, right: float, gap: float, dp: float) -> dict[str, Rect]:
    """The video in the corner of a phone's map, and beside it, or above it where that is too narrow, the selection."""
    picture = min(112 * dp, 0.4 * (right - area.x))
    video = Rect(area.x + gap, area.y + gap, picture, picture * 0.75)
    beside = right - video.right - 8 * dp
    if beside >= SELECTION * dp:
        return {"video": video, "selection": Rect(video.right + 8 * dp, video.y, SELECTION * dp, 52 * dp)}
    width = min(SELECTION * dp, right - video.x)
    return {"video": video, "selection": Rect(video.x, video.top + 8 * dp, width, 52 * dp)}


def _mission_notice(places: dict[str, Rect], gap: float, dp: float) -> Rect:
    """Over the map for what happened: beside the modes, or below them where that is too narrow."""
    modes, right, low = places["modes"], places["tools"].x - gap, places["map"].y + gap
    beside = right - modes.right - gap
    if beside >= 320 * dp:
        return Rect(modes.right + gap, low, beside, modes.top - low)
    return Rect(modes.x, low, right - modes.x, modes.y - 8 * dp - low)


def _mission_instruments(area: Rect, low: float, gap: float, dp: float) -> dict[str, Rect]:
    """Along the lower edge of the map; the selection below the modes, which end at `low` [px]."""
    picture = min(252 * dp, area.width * 0.28)
    video = Rect(area.x + gap, area.y + gap, picture, picture * 0.75)
    compass = Rect(video.right + 20 * dp, area.y + gap, 154 * dp, 154 * dp)
    readouts = Rect(area.right - gap - 232 * dp, area.y + gap, 232 * dp, 128 * dp)
    selection = Rect(area.x + gap, low - gap - 52 * dp, 330 * dp, 52 * dp)
    return {"video": video, "compass": compass, "readouts": readouts, "selection": selection}


def _mission_tall(body: Rect, dp: float, sheet_open: bool, grip: float) -> dict[str, Rect]:
    gap = 12 * dp
    stop, tasks = stop_tall(body, dp)
    taken = stop.head - body.y
    low = min(196 * dp + taken, body.height * (0.58 if crowded(body) else 0.5))
    height = body.height - 120 * dp if sheet_open else low
    sheet = Rect(body.x, body.y, body.width, height)
    handle = max(22 * dp, grip - gap)
    panel = Rect(
        sheet.x + gap,
        stop.head + 8 * dp,
        sheet.width - 2 * gap,
        sheet.height - taken - 8 * dp - handle,
    )
    area = Rect(body.x, body.y + low, body.width, body.height - low)
    picture = min(148 * dp, body.width * 0.4)
    video = Rect(area.x + gap, area.top - gap - picture * 0.66, picture, picture * 0.66)
    target = body.target if isinstance(body, Body) else 0.0
    button = max(50 * dp, target)
    tools = _column(area, button, 5, gap, 8 * dp)
    modes = Rect(area.x + gap, area.y + gap, tools.x - area.x - 2 * gap, max(MODES_HEIGHT * dp, target))
    return {
        "map": area,
        "side": sheet,
        "notice": between(video.x, modes.top + 8 * dp, tools.x - gap, video.y - 8 * dp),
        "handle": Rect(sheet.x, sheet.top - handle, sheet.width, handle + gap),  # up to the modes
        "panel": panel,
        "stop": stop,
        "tasks": tasks,
        "tools": tools,
        "video": video,
        "modes": modes,
        "selection": Rect(area.x + gap, modes.top + gap, min(340 * dp, tools.x - area.x - 2 * gap), 52 * dp),
    }


def _column(area: Rect, button: float, count: int, gap: float, between: float) -> Rect:
    """A column of square buttons in the upper right corner; as many as fit of `count`."""
    fit = max(1, min(count, int((area.height - 2 * gap + between) // (button + between))))
    height = fit * button + (fit - 1) * between
    return Rect(area.right - gap - button, area.top - gap - height, button, height)


def _above(panel: Rect, stop: Rect, gap: float) -> Rect:
    low = getattr(stop, "head", stop.top) + gap
    return Rect(panel.x + gap, low, panel.width - 2 * gap, panel.top - gap - low)


SENTENCE = 62
"""Height of a sentence over a screen; over lists it stands on the floor of its room, and takes no more of them [dp]."""


@handed
def topics(body: Rect, shape: str, dp: float = 1.0) -> dict[str, Rect]:
    """Of the topics screen: `list` and `detail`, side by side or in the same place on a phone, `strip` and `stop`.

    The strip is what is left beside STOP: under the list on a phone, under the detail elsewhere.
    """
    gap = 12 * dp
    if shape == "tall":
        stop, strip = stop_tall(body, dp)
        low = stop.head + 10 * dp
        whole = Rect(body.x + gap, low, body.width - 2 * gap, body.top - gap - low)
        notice = Rect(whole.x, low, whole.width, SENTENCE * dp)
        return {"list": whole, "detail": whole, "strip": strip, "stop": stop, "notice": notice}
    wide = shape == "wide"
    stop = _stop_of_lists(body, shape, dp)
    left = min(max(420 * dp, 0.3 * body.width) if wide else 320 * dp, body.width * 0.42)
    listed = Rect(body.x + gap, body.y + gap, left, body.height - 2 * gap)
    x, low = listed.right + gap, stop.top + gap
    detail = Rect(x, low, body.right - gap - x, body.top - gap - low)
    strip = Rect(x, stop.y, stop.left - gap - x, stop.height)
    notice = Rect(detail.x, low, detail.width, SENTENCE * dp)
    return {"list": listed, "detail": detail, "strip": strip, "stop": stop, "notice": notice}


@handed
def more(body: Rect, shape: str, dp: float = 1.0) -> dict[str, Rect]:
    """Of a page of tiles: `list` above STOP, on a phone's side beside it, and `notice` over its lower end or beside STOP."""
    gap = 12 * dp
    if shape == "short":
        stop = stop_place(body, shape, dp)
        whole = Rect(body.x + gap, body.y + gap, stop.x - body.x - 2 * gap, body.height - 2 * gap)
        return {"list": whole, "stop": stop, "notice": whole}
    stop = stop_tall(body, dp)[0] if shape == "tall" else _stop_of_lists(body, shape, dp)
    low = stop.head + gap
    whole = Rect(body.x + gap, low, body.width - 2 * gap, body.top - gap - low)
    left = Rect(body.x + gap, body.y + gap, stop.left - body.x - 2 * gap, stop.height)
    return {"list": whole, "stop": stop, "notice": left if left.width >= STRIP * dp else whole}


def _stop_of_lists(body: Rect, shape: str, dp: float) -> StopPlace:
    """With STOP ALL beside it, so that it takes nothing of the lists above."""
    return stop_place(body, shape, dp, beside=(84 if shape == "wide" else ALL_BESIDE) * dp)


@handed
def tasks(body: Rect, shape: str, dp: float = 1.0) -> dict[str, Rect]:
    """Of the tasks screen: as `topics`; a phone on its side has a wider list, so that the words over it can be read."""
    places = topics(body, shape, dp)
    if shape == "short":
        more = 44 * dp
        for name, less in (("list", 0.0), ("strip", more), ("detail", more), ("notice", more)):
            place = places[name]
            wide = place.width - more if less else place.width + more
            places[name] = Rect(place.x + less, place.y, wide, place.height)
    return places


@handed
def inputs(body: Rect, shape: str, dp: float = 1.0) -> dict[str, Rect]:
    """Of the inputs screen: as `topics`; what is said stands in the strip beside STOP, where nothing is operated.

    A detail is no wider than its rows are read across.
    """
    places = topics(body, shape, dp)
    strip = places.pop("strip")
    if strip.width >= STRIP * dp:
        places["notice"] = strip
    return places | {"detail": _readable(places["detail"], dp)}


def _readable(detail: Rect, dp: float) -> Rect:
    return Rect(detail.x, detail.y, min(detail.width, MAX_LIST_WIDTH * dp), detail.height)


@handed
def inputs_alone(body: Rect, shape: str, dp: float = 1.0) -> dict[str, Rect]:
    """The same where no robot is connected: `list` and `detail`, above STOP ALL where that is there."""
    gap = 12 * dp
    low = body.y + (CORNER * dp if crowded(body) else gap)
    whole = Rect(body.x + gap, low, body.width - 2 * gap, body.top - gap - low)
    if shape == "tall":
        return {"list": whole, "detail": whole}
    left = min(max(420 * dp, 0.3 * body.width) if shape == "wide" else 320 * dp, body.width * 0.42)
    listed = Rect(whole.x, body.y + gap, left, body.height - 2 * gap)
    x = listed.right + gap
    return {"list": listed, "detail": _readable(Rect(x, low, whole.right - x, whole.height), dp)}


CORNER = 88
"""Height that STOP ALL takes up below the robots that can be connected to [dp]."""


def corner(inside: Rect, dp: float = 1.0, *, left_hand: bool = False) -> Rect:
    """STOP ALL where no robot is connected, in STOP's corner of a window, of which `inside` is free [px]."""
    across = min(240 * dp, inside.width - 28 * dp)
    place = Rect(inside.right - 14 * dp - across, inside.y + 12 * dp, across, 64 * dp)
    return mirrored(place, inside) if left_hand else place


def stop_list(
    body: Rect, stop: StopPlace, shape: str, wanted: float, dp: float = 1.0, *, folded: bool = False
) -> Rect:
    """What became of STOP ALL, `wanted` high [px] where there is room: above STOP, on a phone's side left of it.

    `folded` is above STOP everywhere: there it covers nothing that is pressed to drive, to start or to stop.
    """
    if left_handed(body):
        seen, there = right_handed(body), mirrored(stop, body)
        return mirrored(stop_list(seen, there, shape, wanted, dp, folded=folded), body)
    gap = 8 * dp
    if shape == "short" and not folded:
        width = min(440 * dp, stop.left - body.x - 2 * gap)
        height = min(wanted, body.height - 2 * gap)
        return Rect(stop.left - gap - width, body.y + gap, width, height)
    low, edge = stop.head + gap, body.right - stop.right
    across = 250 * dp if shape == "short" else stop.width if folded and shape == "wide" else 440 * dp
    width = min(across, body.width - 2 * edge)
    return Rect(stop.right - width, low, width, min(wanted, body.top - gap - low))

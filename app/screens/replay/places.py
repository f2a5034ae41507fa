"""Places of the replay screen: what is seen of a moment, the line of time, its buttons, and STOP of the robot of now."""

from __future__ import annotations

from app.layout.arrange import CORNER, more
from app.layout.rects import ALL_BESIDE, Rect, StopPlace, between, crowded, handed, stop_place
from widgets.core.theme import theme

__all__ = ["SPACING", "buttons_width", "moment", "panes", "replay", "replay_alone"]

SPACING = 6
"""Between the buttons of the line of time, and between their rows [dp]."""
BUTTONS_HEIGHT = 118
"""Greatest height of the buttons beside STOP on an upright screen, above which STOP ALL may be [dp]."""
CHOOSER_WIDTH = 380
"""Of the list of numbers that can be drawn [dp]."""
LINE_HEIGHT = 56
"""Height of the line of time where it has a row of its own [dp]."""


def buttons_width(least: float, dp: float) -> float:
    """Width of the buttons in one row, each at least so large [px]."""
    button = max(53 * dp, least)
    return 3 * button + max(72 * dp, button) + 3 * SPACING * dp + 1


@handed
def replay(body: Rect, shape: str, dp: float = 1.0, least: float = 0.0) -> dict[str, Rect]:
    """With a robot: `main`, `line`, `buttons`, `stop` and `notice`; `least` is the least height of a button [px]."""
    gap = 12 * dp
    places = more(body, shape, dp)
    stop = places["stop"] if shape != "short" else stop_place(body, shape, dp, beside=ALL_BESIDE * dp)
    beside = stop.left if shape != "tall" and isinstance(stop, StopPlace) else stop.x
    high = min(stop.height, BUTTONS_HEIGHT * dp) if shape == "tall" else stop.height
    left = Rect(body.x + gap, stop.y, beside - body.x - 2 * gap, high)
    low = stop.y + stop.height + gap if shape == "short" else places["list"].y
    if shape == "tall":
        rows = 1 if left.width >= buttons_width(least, dp) else 2
        # two rows take what is below them too, and stay clear of STOP ALL
        low_edge = left.y - (rows - 1) * SPACING * dp
        left = Rect(
            left.x, low_edge, left.width, max(high, rows * max(53 * dp, least) + (rows - 1) * SPACING * dp)
        )
        low = max(low, left.top + 4 * dp)
        line = Rect(body.x + gap, low, body.width - 2 * gap, LINE_HEIGHT * dp)
        main = Rect(body.x + gap, line.top + 4 * dp, line.width, body.top - 8 * dp - line.top - 4 * dp)
        return {"main": main, "line": line, "buttons": left, "stop": stop, "notice": main}
    main = Rect(body.x + gap, low, body.width - 2 * gap, body.top - 8 * dp - low)
    return {"main": main, **_row(left, dp, least), "stop": stop, "notice": main}


@handed
def replay_alone(body: Rect, shape: str, dp: float = 1.0, least: float = 0.0) -> dict[str, Rect]:
    """Where no robot is connected: the same without `stop`, above STOP ALL where that is there."""
    gap = 12 * dp
    low = body.y + (CORNER * dp if crowded(body) else gap)
    if shape == "tall":
        rows = 1 if body.width - 2 * gap >= buttons_width(least, dp) else 2
        high = rows * max(60 * dp, least) + (rows - 1) * SPACING * dp
        buttons = Rect(body.x + gap, low, body.width - 2 * gap, high)
        line = Rect(buttons.x, buttons.top + 4 * dp, buttons.width, LINE_HEIGHT * dp)
        main = Rect(line.x, line.top + 4 * dp, line.width, body.top - 8 * dp - line.top - 4 * dp)
        return {"main": main, "line": line, "buttons": buttons, "notice": main}
    row = Rect(body.x + gap, low, body.width - 2 * gap, max(64 * dp, least))
    main = Rect(row.x, row.top + 4 * dp, row.width, body.top - 8 * dp - row.top - 4 * dp)
    return {"main": main, **_row(row, dp, least), "notice": main}


def _row(row: Rect, dp: float, least: float) -> dict[str, Rect]:
    """Buttons and line beside each other."""
    wide = min(buttons_width(least, dp), row.width * 0.6)
    x = row.x + wide + 8 * dp
    return {
        "buttons": Rect(row.x, row.y, wide, row.height),
        "line": Rect(x, row.y, row.right - x, row.height),
    }


def moment(main: Rect, shape: str, dp: float, least: float, *, chooser: bool) -> dict[str, Rect]:
    """Of an open recording in `main`: its `head`, `view` and, on a phone, `tabs`; and the `chooser` of numbers where it is open."""
    head = between(main.x, main.top - max(52 * dp, least), main.right, main.top)
    rest = Rect(main.x, main.y, main.width, head.y - 4 * dp - main.y)
    places = {"head": head}
    if shape != "wide":
        high = max(44 * dp, least + 2 * theme.outline)
        places["tabs"] = Rect(rest.x, rest.top - high, rest.width, high)
        rest = Rect(rest.x, rest.y, rest.width, rest.height - high - 6 * dp)
    if chooser:
        wide = min(CHOOSER_WIDTH * dp, rest.width)
        room = rest if shape == "wide" else main  # a phone has no room for anything beside it
        places["chooser"] = Rect(room.right - wide, room.y, wide, room.height)
        if shape == "wide":
            rest = Rect(rest.x, rest.y, rest.width - wide - 8 * dp, rest.height)
    return {**places, "view": rest}


def panes(main: Rect, shape: str, dp: float, *, pictures: bool, chosen: str) -> dict[str, Rect]:
    """What is seen in `main`: of `video`, `map`, `plots` and `events` those that have a place; on a phone the `chosen` one."""
    gap = 8 * dp
    if shape == "wide":
        left = Rect(main.x, main.y, main.width * 0.46, main.height)
        x = left.right + gap
        right = Rect(x, main.y, main.right - x, main.height)
        events = Rect(right.x, right.y, right.width, min(right.height * 0.34, 260 * dp))
        plots = Rect(right.x, events.top + gap, right.width, right.top - events.top - gap)
        found = {"plots": plots, "events": events, "map": left}
        if pictures:
            high = (left.height - gap) / 2
            found["map"] = Rect(left.x, left.y, left.width, high)
            found["video"] = Rect(left.x, left.y + high + gap, left.width, high)
        return found
    if not pictures:
        return {chosen: main}
    if shape == "tall":
        high = min(main.width * 0.62, main.height * 0.42)
        video = Rect(main.x, main.top - high, main.width, high)
        return {"video": video, chosen: Rect(main.x, main.y, main.width, main.height - high - gap)}
    half = (main.width - gap) / 2
    return {
        "video": Rect(main.x, main.y, half, main.height),
        chosen: Rect(main.x + half + gap, main.y, half, main.height),
    }

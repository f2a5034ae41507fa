"""Places on the panels screen: the board, the row of its views, what can be done, and what is edited beside it.

Pure arithmetic in the window's pixels, origin at the lower left.
"""

from __future__ import annotations

from app.layout.rects import ALL_BESIDE, EDGE, Rect, crowded, handed, stop_place, stop_tall

__all__ = ["panels"]

SIDE = 320
"""Width of what is edited beside the board [dp]."""
PANE = 280
"""The same on a phone on its side, where it lies over the board [dp]."""


@handed
def panels(body: Rect, shape: str, dp: float = 1.0, *, editing: bool = False) -> dict[str, Rect]:
    """`board`, `tabs` of the views, `acts`, `side` for what is edited, `stop` and `notice`."""
    if shape == "tall":
        return _tall(body, dp)
    if shape == "short":
        return _short(body, dp, editing)
    return _wide(body, dp, editing)


def _wide(body: Rect, dp: float, editing: bool) -> dict[str, Rect]:
    gap, row = EDGE * dp, 56 * dp
    stop = stop_place(body, "wide", dp, beside=84 * dp)
    wide = max(SIDE * dp, stop.end - stop.left if editing else stop.width) + 2 * gap
    side = Rect(body.right - wide, body.y, wide, body.height)
    room, high = Rect(side.x + gap, stop.y, wide - 2 * gap, stop.height), stop.head
    if editing:
        top = Rect(body.x + gap, body.top - row, side.x - body.x - 2 * gap, row - 8 * dp)
        board = Rect(body.x, body.y, side.x - body.x, body.height - row)
        acts = Rect(top.right - 470 * dp, top.y, 470 * dp, top.height)
        tabs = Rect(top.x, top.y, acts.x - gap - top.x, top.height)
        pane = Rect(room.x, high + gap, room.width, body.top - gap - high - gap)
        return _all(board, tabs, acts, pane, stop, gap)
    board = Rect(body.x, high, body.width, body.top - high)
    acts = Rect(stop.left - gap - 300 * dp, room.y + (room.height - row) / 2, 300 * dp, row)
    tabs = Rect(body.x + gap, acts.y, acts.x - gap - body.x - gap, row)
    return _all(board, tabs, acts, Rect(room.x, high, room.width, body.top - high), stop, gap)


def _short(body: Rect, dp: float, editing: bool) -> dict[str, Rect]:
    """STOP, STOP ALL and what can be done stay where they are whether panels are edited or not; what is edited lies over the board then."""
    gap, row = 8 * dp, 52 * dp
    stop = stop_place(body, "short", dp, beside=ALL_BESIDE * dp)
    side = Rect(stop.left, body.y, body.right - stop.left, body.height)
    tabs = Rect(body.x + gap, body.top - row, side.x - body.x - 2 * gap, row - 4 * dp)
    board = Rect(body.x, body.y, side.x - body.x, body.height - row)
    rows = 4 if editing and not crowded(body) else 2
    high = min(row * rows, body.top - 2 * gap - stop.head)
    acts = Rect(side.x, body.top - gap - high, stop.right - stop.left, high)
    pane = Rect(side.x - gap - PANE * dp, body.y + gap, PANE * dp, tabs.y - body.y - 2 * gap)
    return _all(board, tabs, acts, pane, stop, gap)


def _tall(body: Rect, dp: float) -> dict[str, Rect]:
    gap, row = 12 * dp, 56 * dp
    stop, strip = stop_tall(body, dp)
    tabs = Rect(body.x + gap, body.top - row, body.width - 2 * gap, row - 8 * dp)
    low = stop.head + 8 * dp
    board = Rect(body.x, low, body.width, tabs.y - low)
    pane = Rect(body.x + gap, low, body.width - 2 * gap, min(0.62 * board.height, 460 * dp))
    return _all(board, tabs, strip, pane, stop, gap)


def _all(board: Rect, tabs: Rect, acts: Rect, side: Rect, stop: Rect, gap: float) -> dict[str, Rect]:
    notice = Rect(board.x + gap, board.y + gap, min(board.width - 2 * gap, 560 * gap / 8), board.height * 0.4)
    return {"board": board, "tabs": tabs, "acts": acts, "side": side, "stop": stop, "notice": notice}

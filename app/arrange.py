"""Where everything sits on the glass: rectangles by screen and by the shape of the window.

Pure arithmetic in the window's pixels, origin at the lower left. Turning the device moves widgets and
makes none anew, so nothing that was entered is lost.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = [
    "CORNER",
    "Body",
    "Rect",
    "StopPlace",
    "connect_columns",
    "corner",
    "drive",
    "form",
    "mission",
    "shell",
    "stop_list",
    "tasks",
    "topics",
]

SELECTION = 310
"""Width of the bar for what is selected on a phone's map [dp]."""
SENSES, SENSES_LEAST = 196, 148
"""Height of the card with the small sensors, and the least that it is still open with [dp]."""
STRIP = 54
"""Height of the folded card: a finger opens it [dp]."""
BADGE = 46
"""Height of what says that intruders were found [dp]."""
ALL = 54
"""Height of STOP ALL where it is above something [dp]."""
CHIP = 200
"""Width of a phone's glass that the picture's size and rate need [dp]."""


@dataclass(frozen=True, slots=True)
class Rect:
    """A place on the glass [px]."""

    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """x of the right edge [px]."""
        return self.x + self.width

    @property
    def top(self) -> float:
        """y of the upper edge [px]."""
        return self.y + self.height

    def overlaps(self, other: Rect) -> bool:
        """Whether the two share any pixel."""
        return self.x < other.right and other.x < self.right and self.y < other.top and other.y < self.top

    def holds(self, other: Rect) -> bool:
        """Whether `other` lies within."""
        inside = self.x <= other.x and other.right <= self.right + 1e-6
        return inside and self.y <= other.y and other.top <= self.top + 1e-6


@dataclass(frozen=True, slots=True)
class Body(Rect):
    """The room of a screen between bar and navigation."""

    crowded: bool = False
    """STOP ALL is in STOP's corner as well."""


@dataclass(frozen=True, slots=True)
class StopPlace(Rect):
    """Where STOP is, the largest thing to press, and the smaller STOP ALL beside or above it."""

    other: Rect | None = None
    """Where STOP ALL is; None where there is none."""

    @property
    def left(self) -> float:
        """x of the left edge of both [px]."""
        return self.x if self.other is None else min(self.x, self.other.x)

    @property
    def head(self) -> float:
        """y of the upper edge of both [px]."""
        return self.top if self.other is None else max(self.top, self.other.top)


def _crowded(body: Rect) -> bool:
    return isinstance(body, Body) and body.crowded


def _stop_place(room: Rect, body: Rect, dp: float) -> StopPlace:
    """STOP in the room that it has alone, or together with STOP ALL: beside each other, or one above the other."""
    gap = 8 * dp
    if not _crowded(body):
        return StopPlace(room.x, room.y, room.width, room.height)
    if room.width >= 1.3 * room.height:
        small = (84 if room.width >= 250 * dp else 54) * dp
        other = Rect(room.x, room.y, small, room.height)
        return StopPlace(room.x + small + gap, room.y, room.width - small - gap, room.height, other)
    low = room.height - ALL * dp - gap
    return StopPlace(room.x, room.y, room.width, low, Rect(room.x, room.y + low + gap, room.width, ALL * dp))


def form(width: float, height: float, dp: float = 1.0) -> str:
    """Shape of a window of that size [px]: `tall`, `short` (a phone on its side) or `wide`; `dp` is one dp [px]."""
    if height >= width:
        return "tall"
    return "short" if height < 600 * dp else "wide"


def shell(width: float, height: float, dp: float = 1.0) -> dict[str, Rect]:
    """Of the frame round every screen of a robot: `bar` on top, `nav`, and the `body` between."""
    shape = form(width, height, dp)
    bar = (48 if shape == "short" else 56) * dp
    top = Rect(0, height - bar, width, bar)
    if shape == "tall":
        nav = 60 * dp
        return {"bar": top, "nav": Rect(0, 0, width, nav), "body": Rect(0, nav, width, height - bar - nav)}
    rail = (68 if shape == "short" else 76) * dp
    body = Rect(rail, 0, width - rail, height - bar)
    return {"bar": top, "nav": Rect(0, 0, rail, height - bar), "body": body}


def connect_columns(width: float, dp: float = 1.0) -> int:
    """How many cards stand side by side."""
    return max(1, min(4, int(width // (330 * dp))))


def mission(body: Rect, shape: str, dp: float = 1.0, *, sheet_open: bool = False) -> dict[str, Rect]:
    """Of the mission screen: `map`, `panel`, `stop`, and what floats on the map.

    `sheet_open` draws the sheet of the tall form up over most of the map.
    """
    if shape == "tall":
        return _mission_tall(body, dp, sheet_open)
    gap, wide = 14 * dp, shape == "wide"
    side = min(max(344 * dp, body.width * 0.22), 420 * dp) if wide else 304 * dp
    panel = Rect(body.right - side, body.y, side, body.height)
    high = 84 if wide or _crowded(body) else 68  # narrower beside STOP ALL, and still larger than all else
    room = Rect(panel.x + gap, body.y + gap, side - 2 * gap, high * dp)
    stop = _stop_place(room, body, dp)
    area = Rect(body.x, body.y, body.width - side, body.height)
    places = {"map": area, "panel": _above(panel, stop, gap), "side": panel, "stop": stop}
    button = (52 if wide else 46) * dp
    free = Rect(area.x, area.y + 142 * dp, area.width, area.height - 142 * dp) if wide else area
    places["tools"] = _column(free, button, 7, gap, 8 * dp if wide else 6 * dp)
    places["modes"] = Rect(
        area.x + gap, area.top - gap - 46 * dp, min(384 * dp, places["tools"].x - area.x - 2 * gap), 46 * dp
    )
    if wide:
        places |= _mission_instruments(area, gap, dp)
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


def _mission_instruments(area: Rect, gap: float, dp: float) -> dict[str, Rect]:
    """Along the lower edge of the map."""
    picture = min(252 * dp, area.width * 0.28)
    video = Rect(area.x + gap, area.y + gap, picture, picture * 0.75)
    compass = Rect(video.right + 20 * dp, area.y + gap, 154 * dp, 154 * dp)
    readouts = Rect(area.right - gap - 232 * dp, area.y + gap, 232 * dp, 128 * dp)
    selection = Rect(area.x + gap, area.top - 2 * gap - 98 * dp, 330 * dp, 52 * dp)
    return {"video": video, "compass": compass, "readouts": readouts, "selection": selection}


def _mission_tall(body: Rect, dp: float, sheet_open: bool) -> dict[str, Rect]:
    gap = 12 * dp
    stop, tasks = _stop_tall(body, gap, dp)
    low = min(208 * dp + stop.height, body.height * (0.58 if _crowded(body) else 0.5))
    height = body.height - 120 * dp if sheet_open else low
    sheet = Rect(body.x, body.y, body.width, height)
    handle = 22 * dp
    panel = Rect(
        sheet.x + gap,
        stop.top + 8 * dp,
        sheet.width - 2 * gap,
        sheet.height - stop.height - gap - 8 * dp - handle,
    )
    area = Rect(body.x, body.y + low, body.width, body.height - low)
    picture = min(148 * dp, body.width * 0.4)
    video = Rect(area.x + gap, area.top - gap - picture * 0.66, picture, picture * 0.66)
    tools = _column(area, 50 * dp, 4, gap, 8 * dp)
    modes = Rect(area.x + gap, area.y + gap, body.width - 3 * gap - 50 * dp, 46 * dp)
    return {
        "map": area,
        "side": sheet,
        "notice": _between(video.x, modes.top + 8 * dp, tools.x - gap, video.y - 8 * dp),
        "handle": Rect(sheet.x, sheet.top - handle, sheet.width, handle),
        "panel": panel,
        "stop": stop,
        "tasks": tasks,
        "tools": tools,
        "video": video,
        "modes": modes,
        "selection": Rect(
            area.x + gap, area.y + 2 * gap + 46 * dp, min(340 * dp, body.width - 3 * gap - 50 * dp), 52 * dp
        ),
    }


def _stop_tall(body: Rect, gap: float, dp: float) -> tuple[StopPlace, Rect]:
    """STOP in an upright screen's corner, and the strip beside it; STOP ALL is above the strip, and STOP grows with it."""
    width, height = min(max(158 * dp, body.width * 0.43), 260 * dp), 118 * dp
    x = body.right - gap - width
    strip = Rect(body.x + gap, body.y + gap, x - body.x - 2 * gap, height)
    if not _crowded(body):
        return StopPlace(x, strip.y, width, height), strip
    other = Rect(strip.x, strip.top + 8 * dp, strip.width, ALL * dp)
    return StopPlace(x, strip.y, width, other.top - strip.y, other), strip


def _between(left: float, low: float, right: float, top: float) -> Rect:
    return Rect(left, low, right - left, top - low)


def _column(area: Rect, button: float, count: int, gap: float, between: float) -> Rect:
    """A column of square buttons in the upper right corner; as many as fit of `count`."""
    fit = max(1, min(count, int((area.height - 2 * gap + between) // (button + between))))
    height = fit * button + (fit - 1) * between
    return Rect(area.right - gap - button, area.top - gap - height, button, height)


def _above(panel: Rect, stop: Rect, gap: float) -> Rect:
    low = stop.top + gap
    return Rect(panel.x + gap, low, panel.width - 2 * gap, panel.top - gap - low)


def drive(body: Rect, shape: str, dp: float = 1.0) -> dict[str, Rect]:
    """Of the drive screen: `video` behind all, the slots `top_left`, `top`, `top_right`, `readouts`, and the controls.

    `badge` says what was found, `senses` is the strip or card of the small sensors and `senses_open` where the strip
    unfolds. `notice_low` is for what holds on until it is dealt with, from its lower edge upwards.
    """
    if shape == "tall":
        return _drive_tall(body, dp)
    wide = shape == "wide"
    dp = dp * min(1.0, body.height / ((590 if wide else 364) * dp))
    gap = (16 if wide else 10) * dp
    room = Rect(
        body.right - gap - (210 if wide else 150) * dp, body.y + gap, *_pair(wide, (210, 180), (150, 156), dp)
    )
    stop = _stop_place(room, body, dp)
    size = (242 if wide else 176) * dp
    stick = Rect(body.x + gap, body.y + gap, size, size)
    slider = Rect(stick.right + (38 if wide else 12) * dp, stick.y, *_pair(wide, (96, 238), (80, 176), dp))
    actions = Rect(
        room.x - 16 * dp - (150 if wide else 132) * dp, room.y, (150 if wide else 132) * dp, room.height
    )
    left = Rect(
        body.x + gap, body.top - gap - (228 if wide else 148) * dp, *_pair(wide, (326, 228), (212, 148), dp)
    )
    right_size = _pair(wide, (194, 194), (128, 128), dp)
    right = Rect(body.right - gap - right_size[0], body.top - gap - right_size[1], *right_size)
    places = {
        "video": body,
        "stop": stop,
        "stick": stick,
        "slider": slider,
        "actions": actions,
        "top_left": left,
    }
    tape_width = min((420 if wide else 260) * dp, 2 * (body.x + body.width / 2 - left.right - gap))
    tape = Rect(body.x + (body.width - tape_width) / 2, body.top - gap - 52 * dp, tape_width, 52 * dp)
    readouts_size = _pair(wide, (194, 116), (116, 128), dp)
    readouts = Rect(right.right - readouts_size[0], right.y - 12 * dp - readouts_size[1], *readouts_size)
    if not wide:
        readouts = Rect(right.x - gap - readouts_size[0], right.y, *readouts_size)
        tape = Rect(left.right + gap, tape.y, readouts.x - gap - left.right - gap, 52 * dp)
    places |= {"top": tape, "top_right": right, "readouts": readouts}
    return places | (_senses_wide(places, dp) if wide else _senses_short(places, dp))


def _senses_wide(places: dict[str, Rect], dp: float) -> dict[str, Rect]:
    """A card under the laser, or a strip where there is no height for one."""
    laser, stick, tape, slider = places["top_left"], places["stick"], places["top"], places["slider"]
    free = laser.y - stick.top - 24 * dp
    height = min(free, SENSES * dp) if free >= SENSES_LEAST * dp else STRIP * dp
    senses = Rect(laser.x, laser.y - 12 * dp - height, laser.width, height)
    badge = Rect(tape.x, tape.y - 8 * dp - BADGE * dp, tape.width, BADGE * dp)
    left, right = slider.right + 12 * dp, places["actions"].x - 12 * dp
    return {
        "badge": badge,
        "senses": senses,
        "senses_open": senses if free >= SENSES_LEAST * dp else laser,
        "notice_low": Rect(left, slider.y, right - left, places["actions"].height),
        "notice": _between(tape.x, slider.top + 8 * dp, tape.right, badge.y - 32 * dp),
    }


def _senses_short(places: dict[str, Rect], dp: float) -> dict[str, Rect]:
    """A strip between slider and buttons, or above them where that is too narrow; the badge above STOP."""
    tape, slider, actions, right = places["top"], places["slider"], places["actions"], places["top_right"]
    low = places["readouts"].x
    badge = _between(low, actions.top + 8 * dp, right.right, right.y - 8 * dp)
    notice = _between(tape.x, slider.top + 8 * dp, tape.right, tape.y - 8 * dp)
    left, wide = slider.right + 12 * dp, actions.x - slider.right - 24 * dp
    if wide >= 180 * dp:
        strip = Rect(left, slider.y, wide, STRIP * dp)
        above = _between(left, strip.top + 8 * dp, left + wide, slider.top)
    else:
        strip = Rect(notice.x, notice.y, notice.width, min(STRIP * dp, notice.height / 2))
        above = _between(notice.x, strip.top + 4 * dp, notice.right, notice.top)
    return {
        "badge": badge,
        "senses": strip,
        "senses_open": places["top_left"],
        "notice_low": above,
        "notice": notice,
    }


def _pair(
    wide: bool, large: tuple[float, float], small: tuple[float, float], dp: float
) -> tuple[float, float]:
    width, height = large if wide else small
    return width * dp, height * dp


def _drive_tall(body: Rect, dp: float) -> dict[str, Rect]:
    gap = 12 * dp
    picture = min(body.width * 0.75, body.height * 0.42)
    video = Rect(body.x, body.top - picture, body.width, picture)
    stick = min(176 * dp, body.width * 0.42)
    controls = Rect(body.x + gap, body.y + gap, stick, stick)
    slider = Rect(controls.right + gap, body.y + gap, 80 * dp, stick)
    spare = body.right - gap - slider.right - gap
    width = min(spare, 240 * dp)
    room = Rect(body.right - gap - width, body.y + gap, width, stick)
    stop, across, low = StopPlace(room.x, room.y, width, stick), body.width - 2 * gap, controls.top + gap
    if _crowded(body):  # in a row with what is done once, so that STOP keeps its size
        stop = StopPlace(room.x, room.y, width, stick, Rect(room.x, low, width, ALL * dp))
        across -= width + gap
    actions = Rect(body.x + gap, low, across, (ALL if _crowded(body) else 52) * dp)
    cards_low = actions.top + gap
    cards = Rect(body.x + gap, cards_low, body.width - 2 * gap, video.y - gap - cards_low)
    side = min(cards.height, cards.width * 0.52)
    left = Rect(cards.x, cards.top - side, side, side)
    right = Rect(left.right + gap, cards.y, cards.right - left.right - gap, cards.height)
    readouts_height = min(64 * dp, cards.height * 0.34)
    tape = Rect(body.x + body.width * 0.1, body.top - gap - 52 * dp, body.width * 0.8, 52 * dp)
    return {
        "video": video,
        "stop": stop,
        "stick": controls,
        "slider": slider,
        "actions": actions,
        "top_left": left,
        "top_right": Rect(
            right.x, right.y + readouts_height + gap, right.width, right.height - readouts_height - gap
        ),
        "readouts": Rect(right.x, right.y, right.width, readouts_height),
        "top": tape,
        **_senses_tall(video, cards, tape, gap, dp),
    }


def _senses_tall(video: Rect, cards: Rect, tape: Rect, gap: float, dp: float) -> dict[str, Rect]:
    """Over the edges of the picture; the strip unfolds over the instruments, never over what is touched to drive."""
    strip = Rect(video.x + gap, video.y + 8 * dp, video.width - 2 * gap, STRIP * dp)
    left = video.x + CHIP * dp
    badge = Rect(left, tape.y - 8 * dp - BADGE * dp, video.right - gap - left, BADGE * dp)
    room = badge.y - 8 * dp - strip.top
    return {
        "badge": badge,
        "senses": strip,
        "senses_open": Rect(cards.x, cards.y, cards.width, max(cards.height, SENSES_LEAST * dp)),
        "notice_low": Rect(strip.x, strip.top + 8 * dp, strip.width, max(room - 8 * dp, 8 * dp)),
        "notice": _between(cards.x, cards.y, cards.right, badge.y - 8 * dp),
    }


def topics(body: Rect, shape: str, dp: float = 1.0) -> dict[str, Rect]:
    """Of the topics screen: `list` and `detail`, side by side or in the same place on a phone, `strip` and `stop`.

    The strip is what is left beside STOP: under the list on a phone, under the detail elsewhere.
    """
    gap = 12 * dp
    if shape == "tall":
        stop, strip = _stop_tall(body, gap, dp)
        low = stop.head + 10 * dp
        whole = Rect(body.x + gap, low, body.width - 2 * gap, body.top - gap - low)
        notice = Rect(whole.x, low, whole.width, 120 * dp)
        return {"list": whole, "detail": whole, "strip": strip, "stop": stop, "notice": notice}
    wide = shape == "wide"
    stop = _stop_of_lists(body, shape, dp)
    left = min(max(420 * dp, 0.3 * body.width) if wide else 320 * dp, body.width * 0.42)
    listed = Rect(body.x + gap, body.y + gap, left, body.height - 2 * gap)
    x, low = listed.right + gap, stop.top + gap
    detail = Rect(x, low, body.right - gap - x, body.top - gap - low)
    strip = Rect(x, stop.y, stop.left - gap - x, stop.height)
    notice = Rect(detail.x, low, detail.width, 110 * dp)
    return {"list": listed, "detail": detail, "strip": strip, "stop": stop, "notice": notice}


def _stop_of_lists(body: Rect, shape: str, dp: float) -> StopPlace:
    """As on the mission screen; where there is room STOP ALL is beside it and takes nothing away from it."""
    places = mission(body, shape, dp)
    stop, right = places["stop"], places["stop"].right
    width = right - places["panel"].x
    more = 92 * dp if shape == "wide" and _crowded(body) else 0.0
    return _stop_place(Rect(right - width - more, stop.y, width + more, stop.height), body, dp)


def tasks(body: Rect, shape: str, dp: float = 1.0) -> dict[str, Rect]:
    """Of the tasks screen: as `topics`; a phone on its side has a narrower STOP, so that buttons fit beside it, and
    a wider list, so that the words over it can be read."""
    places, gap = topics(body, shape, dp), 12 * dp
    if shape == "short":
        whole, listed, detail = places["stop"], places["list"], places["detail"]
        width, more = 190 * dp, 44 * dp
        x = detail.x + more
        stop = _stop_place(Rect(whole.right - width, whole.y, width, whole.height), body, dp)
        places["stop"] = stop
        places["list"] = Rect(listed.x, listed.y, listed.width + more, listed.height)
        places["strip"] = Rect(x, stop.y, stop.left - gap - x, stop.height)
        places["detail"] = Rect(x, detail.y, detail.width - more, detail.height)
        places["notice"] = Rect(x, places["notice"].y, detail.width - more, places["notice"].height)
    return places


CORNER = 88
"""Height that STOP ALL takes up below the robots that can be connected to [dp]."""


def corner(width: float, dp: float = 1.0) -> Rect:
    """STOP ALL where no robot is connected, in STOP's corner of a window of that width [px]."""
    across = min(240 * dp, width - 28 * dp)
    return Rect(width - 14 * dp - across, 12 * dp, across, 64 * dp)


def stop_list(
    body: Rect, stop: StopPlace, shape: str, wanted: float, dp: float = 1.0, *, folded: bool = False
) -> Rect:
    """What became of STOP ALL, `wanted` high [px] where there is room: above STOP, on a phone's side left of it.

    `folded` is above STOP everywhere: there it covers nothing that is pressed to drive, to start or to stop.
    """
    gap = 8 * dp
    if shape == "short" and not folded:
        width = min(440 * dp, stop.left - body.x - 2 * gap)
        height = min(wanted, body.height - 2 * gap)
        return Rect(stop.left - gap - width, body.y + gap, width, height)
    low, edge = stop.head + gap, body.right - stop.right
    width = min((250 if shape == "short" else 440) * dp, body.width - 2 * edge)
    return Rect(stop.right - width, low, width, min(wanted, body.top - gap - low))

"""Places on a drive screen whose instruments float on the video: rectangles by the shape of the window."""

from __future__ import annotations

from dataclasses import replace

from app.layout.arrange_phone import AWAY_X, phone_drive
from app.layout.rects import ALL, Rect, between, crowded, handed, left_handed, stop_place

__all__ = ["drive", "two_sticks"]

SENSES, SENSES_LEAST = 196, 148
"""Height of the card with the small sensors, and the least that it is still open with [dp]."""
STRIP = 54
"""Height of the folded card: a finger opens it [dp]."""
SWITCH = 54
"""Height of the switch between two controls [dp]."""
SLIDE = 64
"""Height of a slide that confirms [dp]."""
BADGE = 46
"""Height of what says that intruders were found [dp]."""
CARDS = 136
"""Height of the instruments of an upright phone that they are read in [dp]."""
LEAST_CARDS = 90
"""The least of it, beside a switch [dp]."""
TAPE = 44
"""Height of the heading over the picture of an upright phone [dp]."""
CHIP = 200
"""Width of a phone's glass that the picture's size and rate need [dp]."""


@handed
def drive(
    body: Rect,
    shape: str,
    dp: float = 1.0,
    *,
    switch: bool = False,
    pulled: bool = False,
    sensed: bool = True,
) -> dict[str, Rect]:
    """Of the drive screen: `video` behind all, the slots `top_left`, `top`, `top_right`, `readouts`, and the controls.

    `badge` says what was found, `senses` is the strip or card of the small sensors and `senses_open` where the strip
    unfolds. `notice_low` is for what holds on until it is dealt with, from its lower edge upwards. `switch` chooses between
    two controls in the place of `stick`; it has none without. `pulled` as of `phone_drive`. `sensed`: there are small sensors,
    which take room from the instruments of an upright phone.
    """
    if shape == "tall":
        return _drive_tall(body, dp, switch, sensed)
    if shape == "short":
        return phone_drive(body, dp, switch=switch, pulled=pulled)
    stop, least = stop_place(body, shape, dp), (SWITCH + 12 if switch else 0) + 590
    dp = dp * min(1.0, body.height / (least * dp))
    gap = 16 * dp
    stick = Rect(body.x + gap, body.y + gap, 242 * dp, 242 * dp)
    slider = Rect(stick.right + 38 * dp, stick.y, 96 * dp, 238 * dp)
    actions = Rect(stop.x - (16 + 150) * dp, stick.y, 150 * dp, 180 * dp)
    places = {"video": body, "stop": stop, "stick": stick, "slider": slider, "actions": actions}
    places |= _instruments(body, gap, dp)
    if switch:
        places["switch"] = Rect(stick.x, stick.top + 12 * dp, slider.right - stick.x, SWITCH * dp)
    places |= _senses_wide(places, dp)
    return places | (_switch_wide(places, dp) if switch else {})


def _instruments(body: Rect, gap: float, dp: float) -> dict[str, Rect]:
    """Along the upper edge."""
    left = Rect(body.x + gap, body.top - gap - 228 * dp, 326 * dp, 228 * dp)
    right = Rect(body.right - gap - 194 * dp, body.top - gap - 194 * dp, 194 * dp, 194 * dp)
    tape_width = min(420 * dp, 2 * (body.x + body.width / 2 - left.right - gap))
    tape = Rect(body.x + (body.width - tape_width) / 2, body.top - gap - 52 * dp, tape_width, 52 * dp)
    readouts = Rect(right.x, right.y - 12 * dp - 116 * dp, 194 * dp, 116 * dp)
    return {"top_left": left, "top": tape, "top_right": right, "readouts": readouts}


def _senses_wide(places: dict[str, Rect], dp: float) -> dict[str, Rect]:
    """A card under the laser, or a strip where there is no height for one."""
    laser, stick, tape, slider = places["top_left"], places["stick"], places["top"], places["slider"]
    free = laser.y - places.get("switch", stick).top - 24 * dp
    height = min(free, SENSES * dp) if free >= SENSES_LEAST * dp else STRIP * dp
    senses = Rect(laser.x, laser.y - 12 * dp - height, laser.width, height)
    badge = Rect(tape.x, tape.y - 8 * dp - BADGE * dp, tape.width, BADGE * dp)
    left, right = slider.right + 12 * dp, places["actions"].x - 12 * dp
    return {
        "badge": badge,
        "senses": senses,
        "senses_open": senses if free >= SENSES_LEAST * dp else laser,
        "notice_low": Rect(left, slider.y, right - left, places["actions"].height),
        "notice": between(tape.x, slider.top + 8 * dp, tape.right, badge.y - 32 * dp),
    }


def _drive_tall(body: Rect, dp: float, switch: bool, sensed: bool) -> dict[str, Rect]:
    least, dp_of_stop = SENSES_LEAST * dp, dp
    dp *= min(1.0, body.height / (640 * dp)) if switch else 1.0
    gap, stop = 12 * dp, stop_place(body, "tall", dp_of_stop)
    slide = min(80 * dp, 0.19 * body.width)
    stick = min(176 * dp, stop.x - body.x - 4 * gap + gap / 2 - slide)
    controls = Rect(body.x + gap, body.y + gap, stick, stick)
    slider = Rect(controls.right + gap, body.y + gap, slide, max(stick, stop.height))
    across, low = body.width - 2 * gap, max(controls.top, slider.top) + gap
    chosen = {}
    if switch:
        chosen = {"switch": Rect(controls.x, low, slider.right - controls.x, SWITCH * dp)}
        low += (SWITCH + 12) * dp
    if stop.head + gap > low:  # beside STOP ALL, so that the picture keeps its height
        across = stop.x - gap - body.x - gap
    actions = Rect(body.x + gap, low, across, (ALL if crowded(body) else 52) * dp)
    cards_low = max(actions.top, stop.head) + gap
    row = (STRIP + 8) * dp if sensed else 0.0
    picture = _picture_tall(body, cards_low + gap + row, dp, switch=switch)
    video = Rect(body.x, body.top - picture, body.width, picture)
    cards = Rect(body.x + gap, cards_low, body.width - 2 * gap, video.y - gap - cards_low)
    tape = _tape_tall(body, 8 * dp, dp)
    senses = _senses_tall(video, cards, tape, least, dp)
    if sensed and cards.height - row >= LEAST_CARDS * dp:
        cards = between(cards.x, cards.y, cards.right, cards.top - row)
        strip = Rect(cards.x, cards.top + 8 * dp, cards.width, STRIP * dp)
        senses |= {"senses": strip, "notice_low": _low_tall(video, senses["badge"], dp)}
    elif not sensed:
        strip = replace(senses["senses"], x=AWAY_X)
        senses |= {"senses": strip, "notice_low": _low_tall(video, senses["badge"], dp)}
    return {
        "video": video,
        "stop": stop,
        "stick": controls,
        "slider": slider,
        "actions": actions,
        "top": tape,
        **chosen,
        **_cards_tall(cards, gap, dp),
        **senses,
    }


def _tape_tall(body: Rect, gap: float, dp: float) -> Rect:
    """Over the picture of an upright phone, most of which is to be seen."""
    return Rect(body.x + body.width * 0.2, body.top - gap - TAPE * dp, body.width * 0.6, TAPE * dp)


def _low_tall(video: Rect, badge: Rect, dp: float) -> Rect:
    """At the foot of a picture that no strip lies on."""
    low = video.y + 8 * dp
    return Rect(video.x + 12 * dp, low, video.width - 24 * dp, max(badge.y - 8 * dp - low, 8 * dp))


def _picture_tall(body: Rect, low: float, dp: float, *, switch: bool) -> float:
    """Height of the picture over the instruments [px], which begin at `low` and have to be readable."""
    picture = min(body.width * 0.75, body.height * (0.33 if switch else 0.42))
    if switch:
        return min(picture, body.top - low - LEAST_CARDS * dp)
    least = min(picture, 196 * dp)  # for the tape, a badge and the strip
    return max(least, min(picture, body.top - low - CARDS * dp))


def _cards_tall(cards: Rect, gap: float, dp: float) -> dict[str, Rect]:
    """A square, and beside it the other instrument above the figures."""
    side = min(cards.height, cards.width * 0.52)
    left = Rect(cards.x, cards.top - side, side, side)
    x, figures = left.right + gap, min(64 * dp, cards.height * 0.34)
    return {
        "top_left": left,
        "top_right": between(x, cards.y + figures + gap, cards.right, cards.top),
        "readouts": Rect(x, cards.y, cards.right - x, figures),
    }


def _senses_tall(video: Rect, cards: Rect, tape: Rect, least: float, dp: float) -> dict[str, Rect]:
    """Over the edges of the picture; the strip unfolds, to no less than `least` high [px], never over what is touched to drive."""
    gap = 12 * dp
    strip = Rect(video.x + gap, video.y + 8 * dp, video.width - 2 * gap, STRIP * dp)
    left = video.x + CHIP * dp
    badge = Rect(left, tape.y - 8 * dp - BADGE * dp, video.right - gap - left, BADGE * dp)
    room = badge.y - 8 * dp - strip.top
    return {
        "badge": badge,
        "senses": strip,
        "senses_open": Rect(cards.x, cards.y, cards.width, max(cards.height, least)),
        "notice_low": Rect(strip.x, strip.top + 8 * dp, strip.width, max(room - 8 * dp, 8 * dp)),
        "notice": between(cards.x, cards.y, cards.right, badge.y - 8 * dp),
    }


def two_sticks(
    body: Rect,
    shape: str,
    dp: float = 1.0,
    *,
    switch: bool = False,
    pulled: bool = False,
    sensed: bool = True,
) -> dict[str, Rect]:
    """As `drive`, with a control under the right thumb as well: `right_stick`, left of STOP, and `confirm` for slides.

    For a left hand too the right stick is under the right thumb: which of two sticks does what is learnt by heart.
    """
    places = _two_sticks(body, shape, dp, switch=switch, pulled=pulled)
    if shape == "tall" and not sensed:
        places["senses"] = replace(places["senses"], x=AWAY_X)
    if left_handed(body):
        places["stick"], places["right_stick"] = places["right_stick"], places["stick"]
        if "alone" in places:
            places["alone"] = places["stick"]
    return places


@handed
def _two_sticks(body: Rect, shape: str, dp: float, *, switch: bool, pulled: bool) -> dict[str, Rect]:
    if shape == "tall":
        return _two_tall(body, dp, switch)
    if shape == "short":
        return phone_drive(body, dp, two=True, switch=switch, pulled=pulled)
    return _two_wide(body, dp, switch)


def _two_wide(body: Rect, dp: float, switch: bool) -> dict[str, Rect]:
    """The slides above the right control and STOP, what is done once in the middle."""
    scale = dp * min(1.0, body.height / (690 * dp))
    places, gap = drive(body, "wide", scale, switch=switch), 16 * scale
    stop, slider, stick = stop_place(body, "wide", dp), places["slider"], places["stick"]
    right = Rect(stop.x - gap - stick.width, stick.y, stick.width, stick.height)
    confirm = Rect(right.x, max(right.top, stop.head) + 12 * scale, body.right - gap - right.x, SLIDE * scale)
    width = min(150 * scale, right.x - slider.right - 4 * gap)
    actions = Rect((slider.right + right.x - width) / 2, stick.y, width, places["actions"].height)
    badge, tape = places["badge"], places["top"]
    low = max(actions.top, slider.top, confirm.top) + 8 * scale
    left = max(tape.x, places["switch"].right + gap) if switch else tape.x
    return places | {
        "stop": stop,
        "right_stick": right,
        "confirm": confirm,
        "actions": actions,
        "notice": between(left, low, tape.right, badge.y - 32 * scale),
        "notice_low": between(slider.right + gap, actions.top + 12 * scale, right.x - gap, confirm.top),
    }


def _two_tall(body: Rect, dp: float, switch: bool) -> dict[str, Rect]:
    """Both thumbs with the slider between them, the slides and STOP below, what is done once above."""
    scale = dp * min(1.0, body.height / ((740 + (SWITCH + 12 if switch else 0)) * dp))
    gap = 12 * scale
    across, left = body.width - 2 * gap, body.x + gap
    stop = stop_place(body, "tall", dp)
    confirm = between(left, stop.y, stop.left - gap, stop.y + 2 * 56 * scale + gap)
    row = max(confirm.top, stop.head) - body.y - gap
    size = min((across - 80 * scale - 2 * gap) / 2, body.height * 0.24)
    low, high = body.y + 2 * gap + row, max(size, 186 * scale)
    stick = Rect(left, low + (high - size) / 2, size, size)
    right = Rect(body.right - gap - size, stick.y, size, size)
    slider = Rect(body.x + (body.width - 80 * scale) / 2, low, 80 * scale, high)
    chosen = Rect(left, low + high + gap, slider.right - left, SWITCH * scale)
    actions = Rect(left, (chosen.top if switch else low + high) + gap, across, 52 * scale)
    spare = body.top - actions.top - 2 * gap - 260 * scale
    picture = min(body.width * 0.75, max(body.height * 0.28, spare))
    video = Rect(body.x, body.top - picture, body.width, picture)
    cards = between(left, actions.top + gap, left + across, video.y - gap)
    figures = min(116 * scale, across * 0.3)
    side = (cards.width - figures - 2 * gap) / 2
    tape = _tape_tall(body, gap / 2, scale)
    places = {
        "video": video,
        "stop": stop,
        "stick": stick,
        "right_stick": right,
        "slider": slider,
        "actions": actions,
        "confirm": confirm,
        "top": tape,
        **({"switch": chosen} if switch else {}),
        "top_left": Rect(cards.x, cards.y, side, cards.height),
        "top_right": Rect(cards.x + side + gap, cards.y, side, cards.height),
        "readouts": Rect(cards.right - figures, cards.y, figures, cards.height),
    }
    places |= _senses_tall(video, cards, tape, SENSES_LEAST * dp, scale)
    return places | _strip_beside(places, gap)


def _strip_beside(places: dict[str, Rect], gap: float) -> dict[str, Rect]:
    """A short strip at the foot of a low picture, so that the map has room beside it; what holds on is above it, beside what was found."""
    strip, badge = places["senses"], places["badge"]
    strip = Rect(strip.x, places["video"].y + gap / 3, 0.55 * strip.width, strip.height)
    beside = between(strip.x, strip.top + gap / 3, badge.x - gap / 3, places["top"].y - gap / 3)
    return {"senses": strip, "notice_low": beside}


def _switch_wide(places: dict[str, Rect], dp: float) -> dict[str, Rect]:
    """What is said begins right of the switch."""
    room, left = places["notice"], max(places["top"].x, places["switch"].right + 12 * dp)
    return {"notice": between(left, room.y, room.right, room.top)}

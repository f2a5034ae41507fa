"""Live picture of a camera, with what was recognised in it.

video = Video()
video.show_frame(640, 480, rgba)
robot.on("/detections", video.show)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any, ClassVar

import numpy as np
from kivy.clock import Clock
from kivy.graphics import Color, Rectangle
from kivy.graphics.texture import Texture
from kivy.metrics import dp, sp
from kivy.properties import (
    AliasProperty,
    BooleanProperty,
    ListProperty,
    NumericProperty,
    OptionProperty,
    StringProperty,
)
from kivy.uix.widget import Widget

from bridge.msgs.sensor_msgs import CompressedImage
from bridge.msgs.vision_msgs import Detection2D, Detection2DArray
from widgets.core.base import VEIL, fitting_size
from widgets.core.canvas_ink import Drawing, Ink, Word, Words, shader
from widgets.core.detected import kind_word
from widgets.core.geometry import contain, cover
from widgets.core.icons import icon
from widgets.core.language import figure, tr
from widgets.core.rounded import Rounded
from widgets.core.shapes import Shapes
from widgets.core.theme import theme
from widgets.core.unblended import Unblended
from widgets.sensors.video_chip import VideoChip, chip_width
from widgets.sensors.video_marks import box_role, column, draw_box, draw_pointer

__all__ = ["Video", "samples"]

MAX_LATENCY = 0.5
"""A picture that is shown later than this is called late [s]."""
FADED_OPACITY = 0.45
"""Opacity of a picture that is old, 0 to 1."""
NIGHT_LIGHT = 0.6
"""Light of a white point of the picture at night, which is in the ink of the theme then: eyes stay used to the dark."""


WHOLE = (0, 0, 1, 0, 1, 1, 0, 1)
"""Corners of a picture from its lower left, anticlockwise."""

FRAGMENT = """
$HEADER$
uniform vec2 half_size;
uniform vec2 seen;
uniform float corner;
uniform float strength;
uniform float night;
uniform vec3 ink;
void main() {
    vec2 middle = tex_coord0 - 0.5;
    vec2 beyond = abs(middle) * 2.0 * half_size - half_size + corner;
    float outside = min(max(beyond.x, beyond.y), 0.0) + length(max(beyond, 0.0)) - corner;
    vec4 colour = texture2D(texture0, vec2(0.5 + middle.x * seen.x, 0.5 - middle.y * seen.y));
    float light = dot(colour.rgb, vec3(0.299, 0.587, 0.114));
    vec3 seen_as = mix(colour.rgb, ink * light, night);
    gl_FragColor = vec4(seen_as, strength * clamp(0.5 - outside, 0.0, 1.0));
}
"""


class Video(Drawing):
    """The newest camera frame on one kept texture."""

    accepts: ClassVar = (Detection2DArray,)
    shown_beside: ClassVar = (Detection2DArray,)
    draws: ClassVar = (CompressedImage,)
    grid_size: ClassVar = (6, 6)
    drawn_from: ClassVar = (
        "frame_size", "taken_size", "fit", "boxes", "age", "corner", "insets", "below", "marks", "counted",
        "field_of_view", "refusal",
    )  # fmt: skip

    frame_size: ListProperty[int] = ListProperty([0, 0])
    """Width and height of the picture [pixel]; 0 before the first."""
    fit = OptionProperty("cover", options=("cover", "contain"))
    """Fill the frame and cut the picture, or show all of it."""
    taken_size: ListProperty[int] = ListProperty([0, 0])
    """Width and height of the picture as it was taken [pixel]; more than `frame_size` where it was made smaller on its way."""
    boxes: ListProperty[tuple[str, float, float, float, float, float]] = ListProperty()
    """What was recognised: (label, score, left, top, width, height), from the top left corner of the picture as taken [pixel]."""
    marks: ListProperty[tuple[str, float]] = ListProperty()
    """What is known to be somewhere: (label, direction [rad, 0 ahead, positive left]), also where it is not in the picture."""
    counted: ListProperty[float] = ListProperty()
    """Directions of the intruders that the robot counts [rad, 0 ahead, positive left]; what is boxed elsewhere is only recognised."""
    field_of_view = NumericProperty(math.nan)
    """Horizontal, of the camera, which looks ahead [rad]; NaN when not known, and then nothing is marked."""
    rate = NumericProperty(math.nan)
    """Frames a second [Hz]; NaN when not known."""
    latency = NumericProperty(math.nan)
    """From the exposure to the screen [s]; NaN when not known."""
    refusal = StringProperty("")
    """Why no newer picture is shown, as a sentence; empty where nobody knows."""
    chip_room = NumericProperty(math.inf)
    """How wide the chip may be [px]: what is not needed to drive by is left out of a narrower one."""
    chip_inset = NumericProperty(0.0)
    """How far the chip begins right of what covers the picture's left edge [px]."""
    show_chip = BooleanProperty(True)
    """Say size, rate and latency in the corner."""
    corner = NumericProperty("12dp")
    """Radius of the frame's corners [px]; 0 for a picture that fills the screen."""
    insets: ListProperty[float] = ListProperty([0, 0, 0, 0])
    """How much is covered by what lies over the picture [px]: left, bottom, right, top; the chip keeps clear of it."""
    below = NumericProperty(math.inf)
    """Lower edge of what lies over the picture for now [px]: the sentence stands under it where there is room."""

    veils: ClassVar = {"disabled": VEIL["disabled"]}
    """An old picture fades by itself, and says so in its middle."""
    badge = AliasProperty(lambda _: "", cache=True)
    """Not used: the sentence in the middle says the age."""

    def _picture_size(self) -> tuple[float, float]:
        if not all(self.frame_size):
            return self.width, self.height
        scaled = cover if self.fit == "cover" else contain
        wide, high = self.frame_size
        return scaled(wide, high, self.width, self.height)

    picture_size = AliasProperty(_picture_size, bind=["frame_size", "size", "fit"], cache=True)
    """Size of the whole picture on the screen, also where it is cut off [px]."""

    def __init__(self, **kwargs: Any) -> None:
        self._texture: Texture | None = None
        self._frame = Rounded()
        self._lens = shader(FRAGMENT, corner=0, strength=0, night=0)
        self._lens["ink"] = (0.0, 0.0, 0.0)
        self._lens["half_size"] = self._lens["seen"] = (1.0, 1.0)
        self._picture = Rectangle(size=(0, 0), tex_coords=WHOLE)
        self._lens.add(self._picture)
        self._plain, self._unblended = Rectangle(size=(0, 0)), Unblended()
        for below in (Color(1, 1, 1, 1), self._plain):
            self._unblended.add_part(below)
        self._ink, self._words, self._chip = Ink(), Words(), VideoChip()
        self._redraw_chip = Clock.create_trigger(lambda _: self._draw_chip(), -1)
        super().__init__(**kwargs)
        for name in (
            "rate",
            "latency",
            "show_chip",
            "chip_room",
            "chip_inset",
        ):  # with each picture: the marks stay as they are
            self.fbind(name, self._redraw_chip)
        for part in (
            self._frame, self._lens, self._unblended,
            self._ink, self._words.canvas, self._chip.ground, self._chip.words.canvas,
        ):  # fmt: skip
            self.canvas.add(part)
        self.bind(corner=self.setter("veil_radius"), opacity=lambda *_: self._place_picture())
        self.veil_radius = self.corner

    def show_frame(
        self,
        width: int,
        height: int,
        rgba: bytes | bytearray | memoryview | np.ndarray,
        taken: tuple[int, int] = (0, 0),
    ) -> None:
        """Show a decoded picture, top row first, four bytes to a pixel, as a worker thread has made it.

        `taken` is its size before it was made smaller on its way, to which boxes refer; 0 when unknown.
        ValueError when `rgba` is not as long as `width` and `height` say.
        """
        if len(rgba) != width * height * 4:
            raise ValueError(
                tr("a picture of {width} x {height} has {width2} bytes, not {rgba}").format(
                    width=width, height=height, width2=width * height * 4, rgba=len(rgba)
                )
            )
        if self._texture is None or self._texture.size != (width, height):
            self._texture = Texture.create(size=(width, height), colorfmt="rgba")
            seen = self._plain.tex_coords  # a texture brings its own, by which the picture stands on its head
            self._picture.texture = self._plain.texture = self._texture
            self._picture.tex_coords, self._plain.tex_coords = WHOLE, seen
            self.frame_size = [width, height]
        self.taken_size = list(taken) if all(taken) else [width, height]
        self._texture.blit_buffer(rgba, colorfmt="rgba", bufferfmt="ubyte")
        self.canvas.ask_update()

    def show(self, msg: Detection2DArray) -> None:
        """Show what was recognised, in place of what was before."""
        self.boxes = [_box(detection) for detection in msg.detections]

    def place_on_glass(self, x: float, y: float) -> tuple[float, float]:
        """Position on the screen [px] of a pixel of the picture as taken, counted from its top left corner."""
        wide, high = self.picture_size
        columns, rows = self.taken_size
        left, top = self.center_x - wide / 2, self.center_y + high / 2
        return left + x * wide / columns, top - y * high / rows

    def draw(self) -> None:
        """Bring the frame, the boxes and the words up to date; the picture itself comes by `show_frame`."""
        self._frame.rgba = theme.raised if self._texture is None else theme.bg
        self._place_picture()
        self._frame.pos, self._frame.size = self.pos, (0, 0) if self._fills() else self.size
        self._frame.radius = [self.corner]
        shapes = Shapes()
        self._words.write([*self._box_marks(shapes), *self._pointers(shapes), *self._sentence()])
        self._ink.fill(shapes)
        self._draw_chip()

    def _fills(self) -> bool:
        """The picture covers all of a square-cornered frame and is fresh: no lens and no ground are needed, which
        on a screen full of video is two thirds of the pixels."""
        fresh = self._texture is not None and self.state not in ("stale", "never")
        return fresh and self.corner == 0 and self.fit == "cover" and theme.name != "night"

    def _place_picture(self) -> None:
        wide, high = self.picture_size
        seen = min(wide, self.width), min(high, self.height)
        light = 0.0 if self._texture is None else FADED_OPACITY if self.state in ("stale", "never") else 1.0
        place = self.center_x - seen[0] / 2, self.center_y - seen[1] / 2
        self._picture.pos = self._plain.pos = place
        self._picture.size, self._plain.size = ((0, 0), seen) if self._fills() else (seen, (0, 0))
        self._unblended.on = self._fills() and self.opacity == 1
        x, y = seen[0] / wide / 2, seen[1] / high / 2
        self._plain.tex_coords = (0.5 - x, 0.5 + y, 0.5 + x, 0.5 + y, 0.5 + x, 0.5 - y, 0.5 - x, 0.5 - y)
        whole = seen == (self.width, self.height)
        part = self._lens
        part["half_size"] = float(seen[0] / 2), float(seen[1] / 2)
        part["seen"] = float(seen[0] / wide), float(seen[1] / high)
        part["corner"] = float(min(self.corner, *seen)) if whole else 0.0
        part["strength"] = float(light)
        part["night"] = float(theme.name == "night")
        part["ink"] = tuple(float(NIGHT_LIGHT * colour) for colour in theme.text[:3])

    def _box_marks(self, shapes: Shapes) -> Iterator[Word]:
        if self._texture is None or self.state == "stale":
            return
        frame, small = (self.x, self.y, self.right, self.top), min(self.size) < dp(260)
        found = [self._column(angle) for angle in self.counted if 0 < self.field_of_view < math.pi]
        for label, score, left, top, width, height in self.boxes:
            x1, y1 = self.place_on_glass(left, top)
            x2, y2 = self.place_on_glass(left + width, top + height)
            x1, x2 = max(x1, self.x + dp(2)), min(x2, self.right - dp(2))
            y1, y2 = min(y1, self.top - dp(2)), max(y2, self.y + dp(2))
            if x2 - x1 > 1 and y1 - y2 > 1:
                text, role = f"{kind_word(label, score)} {figure(score, 2)}", box_role(left, width, found)
                yield draw_box(shapes, (x1, y2, x2, y1), text, frame, role=role, small=small)

    def _pointers(self, shapes: Shapes) -> Iterator[Word]:
        """Over what is in the picture and not boxed there; at the edge, which way to turn for the rest."""
        if self._texture is None or self.state == "stale" or not 0 < self.field_of_view < math.pi:
            return
        left, right = self.x + self.insets[0] + dp(20), self.right - self.insets[2] - dp(20)
        for label, angle in self.marks:
            x = self._column(angle)
            if any(box[2] <= x <= box[2] + box[4] for box in self.boxes):
                continue
            at = self.place_on_glass(x, 0)[0]
            seen = left <= at <= right and abs(angle) < self.field_of_view / 2
            at = at if seen else left if angle > 0 else right
            turn = -math.pi / 2 if seen else math.pi * (angle > 0)
            yield draw_pointer(shapes, (at, self.center_y - dp(8)), (left, right), label, turn)

    def _column(self, angle: float) -> float:
        return column(angle, float(self.taken_size[0]), float(self.field_of_view))

    def _sentence(self) -> Iterator[Word]:
        if self._texture is None:
            if self.below < self.center_y + dp(34):
                return  # half of it would stick out from under the words
            yield Word(
                icon("videocam_off"),
                self.center_x,
                self.center_y + dp(14),
                sp(30),
                theme.muted,
                font=theme.icons,
            )
            yield self._refused(self.center_y - dp(16), theme.muted, tr("No picture yet"))
        elif self.state == "stale":
            told = tr("Last picture") if math.isnan(self.age) else tr("Last picture {age:.0f} s ago")
            words = told.format(age=self.age)
            size = fitting_size([words], sp(17), self.width - dp(16), bold=True)
            low = min(self.center_y, self.below - dp(20))
            middle = low if low >= self.y + dp(16) else self.center_y
            yield Word(words, self.center_x, middle, size, theme.text, bold=True)
            if self.refusal and middle - dp(24) >= self.y + dp(16):
                yield self._refused(middle - dp(24), theme.text)

    def _refused(self, y: float, colour: Any, otherwise: str = "") -> Word:
        size = fitting_size([self.refusal], sp(14), self.width - dp(16)) if self.refusal else sp(14)
        return Word(self.refusal or otherwise, self.center_x, y, size, colour)

    @property
    def late(self) -> bool:
        """The picture is too old to drive by."""
        return self.latency > MAX_LATENCY

    def _delay(self) -> str:
        delay = figure(self.latency * 1000)
        return tr("{delay} ms late").format(delay=delay) if self.late else f"{delay} ms"

    def chip_text(self) -> str:
        """Size, rate and latency of the picture in words; what is not known is left out, and what there is no room for."""
        parts = [f"{self.frame_size[0]}×{self.frame_size[1]}"] if all(self.frame_size) else []
        if not math.isnan(self.rate):
            parts.append(tr("{rate:.0f} fps").format(rate=self.rate))
        if not math.isnan(self.latency):
            parts.append(self._delay())
        while len(parts) > 1 and chip_width(" · ".join(parts)) > self.chip_room:
            parts.pop(0)
        return " · ".join(parts)

    def _draw_chip(self) -> None:
        text = self.chip_text() if self.show_chip and self.state != "stale" else ""
        left = self.x + self.insets[0] + self.chip_inset + dp(8)
        top = self.top - self.insets[3] - dp(8)
        self._chip.draw(text, left, top, late=self.late)


def _box(detection: Detection2D) -> tuple[str, float, float, float, float, float]:
    hypothesis = detection.results[0].hypothesis if detection.results else None
    label, score = (hypothesis.class_id, hypothesis.score) if hypothesis else ("?", math.nan)
    box, centre = detection.bbox, detection.bbox.center.position
    return label, score, centre.x - box.size_x / 2, centre.y - box.size_y / 2, box.size_x, box.size_y


def _scene(width: int = 640, height: int = 480) -> bytes:
    """A lot under a sky with lane lines and a cone, as RGBA bytes, top row first."""
    rows, columns = np.mgrid[0:height, 0:width].astype(np.float32)
    down = (rows / height)[..., None]
    light = np.asarray(theme.knob[:3])
    picture = np.asarray(theme.sky[:3]) + (light - theme.sky[:3]) * np.minimum(1.5 * down, 0.7)
    ground = rows > height * 0.48
    across = (columns - width / 2) / np.maximum(rows - height * 0.46, 1.0)
    stripes = np.abs((across * 1.1) % 1.0 - 0.5) > 0.475
    asphalt = light * (0.58 - 0.24 * down)
    picture[ground] = np.where(stripes[..., None], light * 0.82, asphalt)[ground]
    hills = (rows > height * (0.44 - 0.035 * np.sin(columns / 62))) & ~ground
    picture[hills] = np.asarray(theme.ok[:3]) * 0.5
    high = (rows - height * 0.60) / (height * 0.24)
    cone = (high > 0) & (high < 1) & (np.abs(columns - width * 0.68) < 38 * high)
    picture[cone] = np.asarray(theme.warn[:3]) * (1.0, 0.72, 0.6)
    picture[cone & (np.abs(high - 0.58) < 0.11)] = light
    opaque = np.concatenate([picture, np.ones((height, width, 1))], axis=2)
    return (opaque * 255).astype(np.uint8).tobytes()


def samples() -> dict[str, Callable[[], Widget]]:
    """The states of the picture by name."""
    seen = ("intruder", 0.94, 394.0, 276.0, 84.0, 130.0)

    def made(
        *, picture: bool = True, size: tuple[float, float] = (320, 240), **more: Any
    ) -> Callable[[], Widget]:
        def build() -> Video:
            video = Video(size_hint=(None, None), size=(dp(size[0]), dp(size[1])), **more)
            if picture:
                video.show_frame(640, 480, _scene())
            return video

        return build

    live: dict[str, Any] = {"state": "live", "rate": 15.0, "latency": 0.061, "boxes": [seen]}
    return {
        "never": made(picture=False),
        "live": made(**live),
        "large": made(size=(960, 540), corner=0, **live),
        "marked": made(
            size=(480, 270), field_of_view=1.2, marks=[("2 · 4.2 m", 0.3), ("3 · 6 m", -2.0)], **live
        ),
        "contain": made(size=(420, 240), fit="contain", **live),
        "stale": made(state="stale", age=3.0, boxes=[seen], rate=0.0),
        "alarm": made(**{**live, "state": "alarm"}),
        "disabled": made(**{**live, "state": "disabled"}),
    }

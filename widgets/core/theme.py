"""Colours by role, fonts and sizes: the only file of `widgets` that names a hue.

kv rules write `theme.accent`, `theme.font`, `theme.target` and follow when `theme.name` or `theme.gloves` changes.
"""

from __future__ import annotations

import gc
from pathlib import Path

from kivy.core.text import DEFAULT_FONT, LabelBase
from kivy.event import EventDispatcher
from kivy.factory import Factory
from kivy.lang import global_idmap
from kivy.metrics import Metrics, mm
from kivy.properties import (
    BooleanProperty,
    ColorProperty,
    DictProperty,
    NumericProperty,
    OptionProperty,
    StringProperty,
)
from kivy.utils import get_color_from_hex

from widgets.core.icons import ICONS
from widgets.core.language import language, tr

__all__ = ["PALETTES", "Theme", "contrast", "theme"]

FONTS = Path(__file__).parents[1] / "fonts"

PALETTES: dict[str, dict[str, str]] = {
    "dark": {
        "bg": "0C1015",
        "surface": "141A22",
        "raised": "1D2530",
        "line": "2C3746",
        "text": "EAF0F7",
        "muted": "8FA0B5",
        "faint": "5A697C",
        "accent": "4CC2FF",
        "plan": "B79CFF",
        "ok": "41D98D",
        "warn": "FFB224",
        "danger": "FF4B4B",
        "sky": "2F80C3",
        "ground": "6B4A2B",
        "ink_accent": "08131C",
        "ink_plan": "120A24",
        "ink_danger": "1A0303",
        "stop": "DC2A2A",
        "ink_stop": "FFFFFF",
        "knob": "FFFFFF",
        "shade": "000000",
    },
    "sunlight": {
        "bg": "FFFFFF",
        "surface": "FFFFFF",
        "raised": "F1F3F5",
        "line": "111111",
        "text": "000000",
        "muted": "3A3A3A",
        "faint": "8A8A8A",
        "accent": "0048A8",
        "plan": "5A1FA8",
        "ok": "005F2C",
        "warn": "774700",
        "danger": "A90000",
        "sky": "9CCBF2",
        "ground": "C79A63",
        "ink_accent": "FFFFFF",
        "ink_plan": "FFFFFF",
        "ink_danger": "FFFFFF",
        "stop": "B00000",
        "ink_stop": "FFFFFF",
        "knob": "FFFFFF",
        "shade": "000000",
    },
    "night": {
        "bg": "000000",
        "surface": "0B0101",
        "raised": "170303",
        "line": "52140F",
        "text": "FF5F4C",
        "muted": "F23E30",
        "faint": "8A2A22",
        "accent": "FF6E4E",
        "plan": "FF6080",
        "ok": "F2743E",
        "warn": "FF8E3E",
        "danger": "FF3E3E",
        "sky": "4A1410",
        "ground": "200605",
        "ink_accent": "140202",
        "ink_plan": "140202",
        "ink_danger": "140202",
        "stop": "E6362C",
        "ink_stop": "0A0000",
        "knob": "FFA08C",
        "shade": "000000",
    },
}
"""Theme name to role to colour. `ink_*` is text on that role; `stop` is the ground of STOP; `knob` is the part of a
control that moves; `shade` lies between an open sheet and what is behind it."""


def _colours(palette: str) -> dict[str, list[float]]:
    """Role to colour, that of `glass` with the others."""
    roles = {role: get_color_from_hex(colour) for role, colour in PALETTES[palette].items()}
    return {**roles, "glass": [*roles["surface"][:3], 0.92]}


class Theme(EventDispatcher):
    """Appearance of everything on the screen. Set `name` and `gloves`; read the rest."""

    name = OptionProperty("dark", options=list(PALETTES))
    """`dark`, `sunlight` or `night`."""
    gloves = BooleanProperty(False)
    """Targets for a gloved finger."""

    bg = ColorProperty(PALETTES["dark"]["bg"])
    """The window."""
    surface = ColorProperty(PALETTES["dark"]["surface"])
    """Cards."""
    raised = ColorProperty(PALETTES["dark"]["raised"])
    """Things on cards."""
    line = ColorProperty(PALETTES["dark"]["line"])
    """Borders, rings, grids."""
    text = ColorProperty(PALETTES["dark"]["text"])
    """Values."""
    muted = ColorProperty(PALETTES["dark"]["muted"])
    """Labels, units."""
    faint = ColorProperty(PALETTES["dark"]["faint"])
    """What cannot be used now."""
    accent = ColorProperty(PALETTES["dark"]["accent"])
    """The robot, what is live, what can be touched."""
    plan = ColorProperty(PALETTES["dark"]["plan"])
    """What is intended: waypoints, path, goal."""
    ok = ColorProperty(PALETTES["dark"]["ok"])
    warn = ColorProperty(PALETTES["dark"]["warn"])
    danger = ColorProperty(PALETTES["dark"]["danger"])
    sky = ColorProperty(PALETTES["dark"]["sky"])
    ground = ColorProperty(PALETTES["dark"]["ground"])
    ink_accent = ColorProperty(PALETTES["dark"]["ink_accent"])
    ink_plan = ColorProperty(PALETTES["dark"]["ink_plan"])
    ink_danger = ColorProperty(PALETTES["dark"]["ink_danger"])
    stop = ColorProperty(PALETTES["dark"]["stop"])
    """The ground of STOP."""
    ink_stop = ColorProperty(PALETTES["dark"]["ink_stop"])
    knob = ColorProperty(PALETTES["dark"]["knob"])
    shade = ColorProperty(PALETTES["dark"]["shade"])

    font = StringProperty("B612")
    """For everything, by the language of the glass; its figures are all of one width."""
    icons = StringProperty("Icons")

    roles = DictProperty(_colours("dark"))
    """Role to colour, for a rule that has the role by name: `theme.roles[root.role]`."""

    glass = ColorProperty(_colours("dark")["glass"])
    """Cards that float over a picture: `surface`, not quite opaque."""

    target = NumericProperty()
    """Least width and height of what a finger must hit [px]: 14 mm, in gloves 20 mm."""
    least = NumericProperty()
    """Width and height of the least of what a finger hits, as an icon without a ground [px]: 10 mm, in gloves 20 mm."""
    radius = NumericProperty("14dp")
    """Corners of cards [px]."""
    corner = NumericProperty("11dp")
    """Corners of buttons [px]."""
    gap = NumericProperty("12dp")
    """Between neighbours, and from a card's edge to what is in it [px]."""
    outline = NumericProperty("1dp")
    """Width of a border [px]; 2 dp in sunlight would blot, 1 dp is dark enough there."""
    size_value = NumericProperty("26sp")
    size_title = NumericProperty("20sp")
    size_body = NumericProperty("16sp")
    size_label = NumericProperty("13sp")
    size_icon = NumericProperty("24sp")

    def __init__(self) -> None:
        super().__init__()
        self.on_gloves()
        Metrics.bind(dpi=self.on_gloves)

    def __setattr__(self, key: str, value: object) -> None:
        """Keep Python's collector away until every rule has followed.

        The theme outlives all widgets, and a rule knows its widget weakly: one that was thrown away and is still bound
        must not vanish while its rule is computed, which ends in a ReferenceError out of whoever set the theme.
        """
        collecting = gc.isenabled()
        gc.disable()
        try:
            super().__setattr__(key, value)
        finally:
            if collecting:
                gc.enable()

    def on_name(self, *_: object) -> None:
        """Take every colour from the palette of that name."""
        roles = _colours(self.name)
        for role, colour in roles.items():
            setattr(self, role, colour)
        self.roles = roles

    def on_gloves(self, *_: object) -> None:
        """Widen or narrow the targets."""
        self.least = mm(20) if self.gloves else mm(10)
        self.target = mm(20) if self.gloves else mm(14)


def contrast(one: str, other: str) -> float:
    """Contrast of two colours `RRGGBB` by WCAG 2: 1 (none) to 21 (black on white)."""
    light, dark = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def _luminance(colour: str) -> float:
    parts = [
        value / 12.92 if value <= 0.03928 else ((value + 0.055) / 1.055) ** 2.4
        for value in get_color_from_hex(colour)[:3]
    ]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


FACES = {"B612": "B612-{}.ttf", "Noto Sans SC": "NotoSansSC-{}.otf"}
"""Typefaces for text, to their files."""


def _take_font(name: str) -> None:
    """Have text drawn in the typeface of that name; it is loaded when it is first drawn."""
    regular, bold = (str(FONTS / FACES[name].format(weight)) for weight in ("Regular", "Bold"))
    # Kivy's own widgets, such as TextInput, ask for its default font
    for one in (name, DEFAULT_FONT):
        LabelBase.register(one, regular, fn_italic=regular, fn_bold=bold, fn_bolditalic=bold)
    theme.font = name


LabelBase.register("Icons", str(FONTS / "Icons.ttf"))
theme = Theme()
"""The one theme of this process; kv knows it under the same name."""
language.follow(lambda: _take_font(language.tongue.font))
_take_font(language.tongue.font)
global_idmap.update(theme=theme, icons=ICONS, tr=tr)
for name, module in {"Rounded": "rounded", "Outline": "visible", "Tinted": "visible"}.items():
    Factory.register(name, module=f"widgets.core.{module}")

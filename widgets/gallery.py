"""Gallery of every widget in every state: a window to try them in, or pictures with a page that shows them."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterator
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from kivy.graphics import Color, Rectangle
from kivy.lang import Builder
from kivy.properties import StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from widgets import CATALOGUE
from widgets.core.theme import PALETTES, theme
from widgets.parts.kit import SectionLabel, Text

__all__ = [
    "KIT",
    "Exhibit",
    "Gallery",
    "Sample",
    "all_samples",
    "finish_pictures",
    "modules",
    "page",
    "write_pictures",
]

KIT = {
    "Labels": "widgets.parts.labels",
    "Cards": "widgets.parts.cards",
    "Buttons": "widgets.parts.buttons",
    "Choices": "widgets.parts.choices",
    "Stepper": "widgets.parts.stepper",
    "Amounts": "widgets.parts.sliders",
    "TextField": "widgets.parts.text_field",
    "Rows": "widgets.parts.rows",
    "EventRow": "widgets.status.event_row",
    "PromptCard": "widgets.study.prompt_card",
    "ResponseChart": "widgets.study.response_chart",
    "ScoreHistory": "widgets.study.score_history",
    "SuccessBars": "widgets.study.success_bars",
    "Crosshair": "widgets.controls.crosshair",
    "NoiseMeter": "widgets.inputs.noise_meter",
    "ReactionTest": "widgets.inputs.reaction_test",
    "ScanKeyboard": "widgets.inputs.scan_keyboard",
    "TimeLine": "widgets.plots.time_line",
    "ScanPad": "widgets.inputs.scan_pad",
    "ShakeLesson": "widgets.inputs.shake_lesson",
}
"""The kit's modules, shown after the robot widgets."""

DEFAULT_SIZE = 260.0, 180.0
"""Of a sample that takes the size it is given [dp]."""

MARGIN = 16
"""Round a sample in its picture [px]."""

Sample = Callable[[], Widget]

Builder.load_string("""
<Gallery>:
    orientation: 'vertical'
    canvas.before:
        Color:
            rgba: theme.bg
        Rectangle:
            pos: self.pos
            size: self.size
    BoxLayout:
        size_hint_y: None
        height: theme.target + theme.gap
        padding: theme.gap, theme.gap / 2
        spacing: theme.gap
        Text:
            text: root.title
            font_size: theme.size_title
            bold: True
            pos_hint: {'center_y': .5}
        Segmented:
            options: root.themes
            value: theme.name
            size_hint_x: None
            width: dp(330)
            on_choose: root.set_theme(args[1])
    ScrollView:
        StackLayout:
            id: wall
            size_hint_y: None
            height: self.minimum_height
            padding: theme.gap
            spacing: theme.gap * 2

<Exhibit>:
    orientation: 'vertical'
    size_hint: None, None
    size: self.minimum_size
    spacing: theme.gap / 2
""")


def modules(name: str = "") -> dict[str, str]:
    """Title to module of everything that can be shown, or of what `name` asks for; KeyError when it is unknown."""
    known = {title: module for title, module in {**CATALOGUE, **KIT}.items() if find_spec(module)}
    if not name:
        return known
    wanted = {
        title: module
        for title, module in known.items()
        if name.lower() in {title.lower(), module.rpartition(".")[2]}
    }
    if not wanted:
        raise KeyError(f"There is no widget {name!r}; there are {', '.join(known)}.")
    return wanted


def all_samples(name: str = "") -> Iterator[tuple[str, str, Sample]]:
    """Title, state and builder of every sample, or of the widget called `name`."""
    for title, module in modules(name).items():
        for state, build in import_module(module).samples().items():
            yield title, state, build


class Exhibit(BoxLayout):
    """One sample under its name."""

    def __init__(self, state: str, widget: Widget) -> None:
        super().__init__()
        label = SectionLabel(title=state)
        label.size_hint_x, label.width = None, "240dp"
        self.add_widget(label)
        give_size(widget)
        self.add_widget(widget)


class Gallery(BoxLayout):
    """The wall of exhibits with a switch for the theme."""

    title = StringProperty("Widgets")
    themes = list(PALETTES)

    def __init__(self, name: str = "") -> None:
        super().__init__()
        self.title = name or "Widgets"
        for title, state, build in all_samples(name):
            self.ids.wall.add_widget(Exhibit(f"{title} · {state}", build()))
        if not self.ids.wall.children:
            self.ids.wall.add_widget(Text(text="Nothing to show."))

    def set_theme(self, name: str) -> None:
        """Show everything in another theme."""
        theme.name = name


def give_size(widget: Widget) -> None:
    """Give a widget that would fill its parent a size of its own."""
    for axis, side, length in ((0, "width", DEFAULT_SIZE[0]), (1, "height", DEFAULT_SIZE[1])):
        if widget.size_hint[axis] is not None:
            setattr(widget, f"size_hint_{'xy'[axis]}", None)
            setattr(widget, side, f"{length}dp")


def framed(widget: Widget) -> Widget:
    """The widget on the ground of a card, with a margin, ready to be drawn."""
    give_size(widget)
    frame = Widget(size_hint=(None, None))
    with frame.canvas.before:
        Color(*theme.surface)
        ground = Rectangle()
    frame.add_widget(widget)
    widget.pos = MARGIN, MARGIN

    def fit(*_: object) -> None:
        frame.size = ground.size = round(widget.width) + 2 * MARGIN, round(widget.height) + 2 * MARGIN

    widget.bind(size=fit)
    fit()
    return frame


def draw(build: Sample, path: Path) -> None:
    """Write one sample as a PNG. Needs a window that draws."""
    from kivy.base import EventLoop
    from kivy.core.window import Window

    frame = framed(build())
    Window.add_widget(frame)
    for _ in range(4):  # layouts inside layouts settle one after the other
        EventLoop.idle()
    finish_pictures(frame)
    path.parent.mkdir(parents=True, exist_ok=True)
    frame.export_to_png(str(path))
    Window.remove_widget(frame)


def finish_pictures(frame: Widget) -> None:
    """Wait for what a sample reads in a thread, as the tiles of a map."""
    for widget in frame.children:
        finish = getattr(widget, "finish_pictures", None)
        if finish is not None:
            finish()


def write_pictures(folder: Path, name: str = "") -> list[Path]:
    """Draw every sample in every theme below `folder`, and `index.html` to look at them; gives the pictures' paths."""
    pictures = []
    for palette in PALETTES:
        theme.name = palette
        for title, state, build in all_samples(name):
            path = folder / palette / f"{title}-{state}.png".replace(" ", "_").lower()
            draw(build, path)
            pictures.append(path)
    theme.name = "dark"
    (folder / "index.html").write_text(page(folder, pictures), encoding="utf-8")
    return pictures


def page(folder: Path, pictures: list[Path]) -> str:
    """The page that shows the pictures, a section for each theme."""
    parts = ["<!doctype html><meta charset=utf-8><title>Pilothouse widgets</title>", STYLE]
    for palette, roles in PALETTES.items():
        style = f"background:#{roles['bg']};color:#{roles['text']}"
        parts.append(f'<section style="{style}"><h2>{palette}</h2>')
        for path in pictures:
            if path.parent.name == palette:
                source = html.escape(path.relative_to(folder).as_posix())
                parts.append(
                    f'<figure><img src="{source}" alt=""><figcaption>{html.escape(path.stem)}</figcaption></figure>'
                )
        parts.append("</section>")
    return "\n".join(parts) + "\n"


STYLE = """<style>
body { margin: 0; font: 15px sans-serif; }
section { padding: 24px; }
figure { display: inline-block; margin: 0 16px 24px 0; vertical-align: top; }
figcaption { opacity: 0.7; }
</style>"""

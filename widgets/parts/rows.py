"""Lists for fingers: rows to press, a column that scrolls, and handles that are dragged within it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from kivy.effects.scroll import ScrollEffect
from kivy.lang import Builder
from kivy.properties import BooleanProperty, NumericProperty, ObjectProperty, StringProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.scrollview import ScrollView
from kivy.uix.widget import Widget

from widgets.core.surfaces import Pressable
from widgets.parts.buttons import IconButton
from widgets.parts.choices import Toggle
from widgets.parts.column import Column
from widgets.parts.labels import Icon, SectionLabel, Text

__all__ = ["DragHandle", "ListRow", "Roll", "TwoLines", "group_label"]

Builder.load_string("""
<ListRow>:
    size_hint_y: None
    height: max(theme.target, words.height + dp(14))
    padding: dp(12), 0, root.end, 0
    spacing: dp(10)
    rim: 'accent' if root.chosen else 'line'
    rim_width: dp(3) if root.chosen else 1.5
    bar_width: dp(9) if root.chosen else 0
    canvas.before:
        Rounded:
            rgba: theme.accent[:3] + [.16 if root.chosen else 0]
            pos: self.x + self.bar_width, self.y
            size: self.width - self.bar_width, self.height
            radius: [0, self.corner, self.corner, 0]
    Icon:
        id: sign
        name: root.icon
        role: root.role
        pos_hint: {'center_y': .5}
    TwoLines:
        id: words
        spacing: dp(1)
        title: root.title
        detail: root.detail
        faded: root.faded
        whole: root.whole
    Label:
        text: root.aside
        font_name: theme.font
        font_size: sp(13)
        color: theme.muted
        disabled_color: self.color
        size_hint: None, None
        size: self.texture_size[0] if root.aside else 0, self.texture_size[1]
        opacity: 1 if root.aside else 0
        pos_hint: {'center_y': .5}

<TwoLines>:
    pos_hint: {'center_y': .5}
    Text:
        text: root.title
        bold: True
        font_size: sp(15)
        role: 'muted' if root.faded else 'text'
        shorten: not root.whole
        shorten_from: 'right'
    Remark:
        text: root.detail
        shorten: not root.whole
        shorten_from: 'right'

<Roll>:
    do_scroll_x: False
    bar_width: dp(3)
    bar_margin: dp(-4)
    bar_color: theme.faint
    bar_inactive_color: theme.line

<DragHandle>:
    name: 'drag_handle'
    role: 'muted'
    size: max(theme.least, dp(42)), min(theme.target, max(dp(53), theme.least))
    text_size: self.size
    halign: 'center'
    valign: 'middle'
    pos_hint: {'center_y': .5}
""")


class ListRow(Pressable, BoxLayout):
    """One line of a list: icon, title, a second line, a word at its end; more can be added behind that."""

    icon = StringProperty("place")
    role = StringProperty("muted")
    """Role of the icon's colour."""
    title = StringProperty("")
    detail = StringProperty("")
    """The second line; empty for none."""
    end = NumericProperty("12dp")
    """From what stands at its end to the border; less for a button without a ground, which brings its own [px]."""
    aside = StringProperty("")
    """At the end, as a distance or a time; empty for none."""
    chosen = BooleanProperty(False)
    faded = BooleanProperty(False)
    """Its subject is switched off or over."""
    whole = BooleanProperty(False)
    """What it says is shown to the end, on as many lines as that takes."""


class TwoLines(Column):
    """What a row says: a title, and a second line where there is one."""

    title = StringProperty("")
    detail = StringProperty("")
    """Empty for none."""
    faded = BooleanProperty(False)
    """Its subject is switched off or over."""
    whole = BooleanProperty(False)
    """The second line is shown to the end, on as many lines as that takes."""


class DragHandle(Icon):
    """What a row is held by; dispatches `on_drag` with how far the finger went up [px], and `on_drop`."""

    __events__ = ("on_drag", "on_drop")

    drags = True
    """A finger that comes down here does not scroll."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._finger: tuple[int, float] | None = None

    def on_touch_down(self, touch: Any) -> bool:
        """Take one finger."""
        if self.disabled or self._finger is not None or not self.collide_point(*touch.pos):
            return False
        touch.grab(self)
        self._finger = (touch.uid, touch.y)
        return True

    def on_touch_move(self, touch: Any) -> bool:
        """Tell how far it went."""
        if touch.grab_current is not self or self._finger is None:
            return False
        self.dispatch("on_drag", touch.y - self._finger[1])
        return True

    def on_touch_up(self, touch: Any) -> bool:
        """Let go."""
        if touch.grab_current is not self:
            return False
        touch.ungrab(self)
        self._finger = None
        self.dispatch("on_drop")
        return True

    def on_drag(self, up: float) -> None:
        """The finger is `up` [px] above where it came down."""

    def on_drop(self) -> None:
        """The finger let go."""


class Roll(ScrollView):
    """A column that scrolls, but not under a finger that came down on something to be dragged.

    Its bar is beside it, where it hides nothing of what it scrolls.
    """

    effect_cls = ObjectProperty(ScrollEffect, allownone=True)
    """It stops at its ends: Kivy's own spring swings ever further when frames are few."""

    def on_scroll_y(self, _: Roll, at: float) -> None:
        """Stay within what there is."""
        self.scroll_y = min(max(at, 0.0), 1.0)

    def on_touch_down(self, touch: Any) -> bool:
        """Hand a finger at once to what it drags."""
        if self.collide_point(*touch.pos) and self.children and not touch.is_mouse_scrolling:
            x, y = self.to_local(*touch.pos)
            for widget in self.children[0].walk(restrict=True):
                if getattr(widget, "drags", False) and not widget.disabled:
                    at = (
                        widget.parent.to_widget(*self.children[0].to_window(x, y))
                        if widget.parent
                        else (x, y)
                    )
                    if widget.collide_point(*at):
                        touch.push()
                        touch.apply_transform_2d(lambda *_, at=at: at)
                        taken = widget.on_touch_down(touch)
                        touch.pop()
                        return bool(taken)
        return bool(super().on_touch_down(touch))


def group_label(title: str) -> SectionLabel:
    """The name over some rows, with a little room above it."""
    label = SectionLabel(title=title, size_hint_y=None, height="30dp")
    label.bind(height=lambda one, _: setattr(one, "height", "30dp"))
    label.valign = "bottom"
    return label


def samples() -> dict[str, Callable[[], Widget]]:
    """A row in the states that it knows, and with something to do behind it."""

    def make(*behind: Callable[[], Widget], **kwargs: Any) -> Callable[[], Widget]:
        def build() -> Widget:
            row = ListRow(size_hint_x=None, width="340dp", **kwargs)
            for part in behind:
                row.add_widget(part())
            return row

        return build

    long = "Failed: no way to Office 12; the way is blocked at the second door."
    return {
        "row": make(icon="door_front", title="Office 12", detail="Ms. Weber, second door", aside="12 m"),
        "row chosen": make(icon="door_front", title="Office 12", aside="12 m", chosen=True),
        "row faded": make(
            lambda: Toggle(pos_hint={"center_y": 0.5}),
            icon="route",
            title="Patrol",
            detail="22:00",
            faded=True,
        ),
        "row whole": make(icon="error", role="danger", title="Deliver", detail=long, whole=True),
        "row dragged": make(
            lambda: IconButton(icon="delete", bare=True, pos_hint={"center_y": 0.5}),
            DragHandle,
            icon="near_me",
            title="Go to Lab",
        ),
        "group": lambda: Text(text="Floor 0 · Offices", size_hint_x=None, width="200dp", role="muted"),
    }

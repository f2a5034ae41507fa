"""The card of one robot on the connect and fleet pages: what it is, how it stands, and one big button."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence

from kivy.graphics.texture import Texture
from kivy.lang import Builder
from kivy.metrics import Metrics
from kivy.properties import BooleanProperty, NumericProperty, ObjectProperty, StringProperty

from app.discovery.known_robots import Entry
from app.session.last_pictures import Thumb
from widgets.core.icons import ICONS
from widgets.core.language import mark, tr
from widgets.parts.kit import Card

__all__ = ["RobotCard", "robot_icon", "same_named"]

GENERIC_ICON = "smart_toy_fill"
"""Of a robot that names none, or one that this app cannot draw."""
NARROW = 420.0
"""A card narrower than this has no room for the words `driven by` [dp]."""

TRUST = {
    "paired": ("lock", mark("Paired"), "ok"),
    "stranger": ("vpn_key", mark("Not paired"), "muted"),
    "open": ("lock_open", mark("Not protected"), "warn"),
    "": ("", "", "muted"),
}
"""How a robot is reached, to icon, words and role of the colour."""
LOW, MIDDLE = 0.20, 0.40
"""Below these a battery is empty or getting low, 0 to 1."""

Builder.load_string("""
#:import tr widgets.core.language.tr
#:import safe_area app.screens.parts.safe_area.safe_area
<RobotCard>:
    size_hint: None, None
    height: max(self.minimum_height, self.row_height)
    padding: dp(18), dp(18)
    spacing: dp(14)
    outline: 'danger' if root.lost else 'line'
    BoxLayout:
        size_hint_y: None
        height: max(dp(50), titles.height, remove.height if root.saved else 0)
        spacing: dp(11)
        Icon:
            name: root.icon
            role: 'muted' if root.lost else 'accent'
            font_size: sp(44)
            pos_hint: {'center_y': .5}
        Widget:
            id: snapshot
            size_hint: None, None
            size: (dp(72) if root.snapshot and root.width >= sp(330) else 0), dp(50)  # gives way to enlarged words
            pos_hint: {'center_y': .5}
            canvas:
                Color:
                    rgba: (1, 1, 1, .5 if root.lost else 1) if root.snapshot else (0, 0, 0, 0)
                RoundedRectangle:
                    texture: root.snapshot
                    pos: self.pos
                    size: self.size
                    radius: [dp(8)]
        BoxLayout:
            id: titles
            orientation: 'vertical'
            size_hint_y: None
            height: self.minimum_height
            pos_hint: {'center_y': .5}
            Text:
                text: root.title
                bold: True
                font_size: theme.size_title
                size_hint_y: None
                height: sp(25)
                shorten: True
                shorten_from: 'right'
            BoxLayout:
                size_hint_y: None
                height: max(sp(25), told.height)
                spacing: dp(5) if root.trust_text else 0
                Icon:
                    id: lock
                    name: root.trust_icon or 'lock'
                    role: root.trust_role
                    font_size: sp(18)
                    size_hint: None, 1
                    width: dp(20) if root.trust_text else 0
                    opacity: 1 if root.trust_text else 0
                Label:
                    id: trust
                    text: root.trust_text
                    font_name: theme.font
                    font_size: sp(15)
                    color: theme.roles[root.trust_role]
                    disabled_color: self.color
                    size_hint: None, 1
                    width: self.texture_size[0]
                Text:
                    id: told
                    text: '· ' + root.subtitle if root.trust_text else root.subtitle  # whole, in as many lines as it takes
                    role: 'muted'
                    font_size: sp(15)
                    pos_hint: {'center_y': .5}
        IconButton:
            id: remove
            icon: 'delete'
            role: 'muted'
            bare: True
            size: (max(dp(53), theme.least) if root.saved else 0, max(dp(50), theme.least))
            opacity: 1 if root.saved else 0
            disabled: not root.saved
            on_release: root.dispatch('on_remove')
    BoxLayout:
        orientation: 'vertical'
        size_hint_y: None
        height: self.minimum_height
        Remark:
            text: root.note
            role: root.note_role
            font_size: sp(15)
            size_hint_y: None
            height: self.texture_size[1] if root.note else 0
        Remark:
            text: root.warning
            role: 'danger'
            font_size: sp(15)
            size_hint_y: None
            height: self.texture_size[1] if root.warning else 0
    StackLayout:
        size_hint_min_y: max(self.minimum_height, dp(34))  # takes what its row leaves, so that the buttons are in line
        spacing: dp(10)
        Chip:
            icon: 'bolt'
            role: root.battery_role
            text: root.battery_text
        Chip:
            icon: 'signal_disconnected' if root.lost else 'wifi'
            role: root.link_role
            text: root.link_text
        Chip:
            icon: root.driver_icon
            text: root.driver_text
            role: root.driver_role
            tinted: True
            spacing: dp(6) if root.driver_icon else 0
            opacity: 1 if root.driver_text else 0
    PushButton:
        id: connect
        height: max(root.button_height, theme.least)
        text: root.action
        fill: 'raised' if root.quiet else 'accent'
        border: 'line' if root.quiet else 'accent'
        ink: 'text' if root.quiet else 'ink_accent'
        on_release: root.dispatch('on_connect')
""")


def _shortened(name: str, most: int) -> str:
    """`name`, cut to `most` characters with a sign that it was cut; `somebody` where there is nothing to read in it."""
    name = " ".join(letters for letters in name.split() if letters.isprintable()) or "somebody"
    return name if len(name) <= most else f"{name[: most - 1].rstrip()}…"


def robot_icon(name: str) -> str:
    """The icon that a robot calls `name`; GENERIC_ICON for one that is not in this app's font."""
    return name if name in ICONS else GENERIC_ICON


def same_named(entries: Sequence[Entry]) -> set[str]:
    """Names that more than one robot has."""
    named = Counter(
        name for name, _ in {(entry.name, entry.boot or entry.url) for entry in entries if entry.name}
    )
    return {name for name, count in named.items() if count > 1}


class RobotCard(Card):
    """One robot: what it is, its battery, how far, who drives, and one big button."""

    __events__ = ("on_connect", "on_remove")

    title = StringProperty("")
    subtitle = StringProperty("")
    icon = StringProperty(GENERIC_ICON)
    lost = BooleanProperty(False)
    saved = BooleanProperty(False)
    warning = StringProperty("")
    """What is wrong with it, as a sentence; empty when nothing is known to be."""
    note = StringProperty("")
    """What it does, or by what it is told from others of its name; empty for nothing."""
    note_role = StringProperty("muted")
    snapshot = ObjectProperty(None, allownone=True)
    """The last picture that this handheld has seen of it, as a texture; None without one."""
    quiet = BooleanProperty(False)
    """The button offers nothing to look forward to: it tries again."""
    battery_text = StringProperty("—")
    battery_role = StringProperty("muted")
    link_text = StringProperty("")
    link_role = StringProperty("ok")
    driver_text = StringProperty("")
    driver_icon = StringProperty("")
    """Stands for `driven by` where a card has no room for the words."""
    driver_role = StringProperty("ok")
    action = StringProperty("")
    watches = BooleanProperty(False)
    """Another person drives, and the big button only looks on."""
    button_height = NumericProperty("52dp")
    row_height = NumericProperty(0)
    """Height of the highest card beside it [px]; 0 for its own."""
    trust_text = StringProperty("")
    """How it is reached, in a word; empty within this machine."""
    trust_icon = StringProperty("")
    trust_role = StringProperty("muted")
    entry = ObjectProperty(None, allownone=True)
    """The robot, as of the list."""

    def show_entry(self, entry: Entry, me: str) -> None:
        """Take over what is known of the robot; `me` is what this handheld is called."""
        self.entry = entry
        self.icon, self.lost = robot_icon(entry.icon), entry.state == "lost"
        self.title = entry.name or entry.address
        about = tr(entry.description or mark("Saved address"))
        self.warning = entry.warning
        self.subtitle = (
            f"{entry.address} · {about}" if entry.name else about
        )  # the address tells two of one name apart, and its end counts
        self.saved = entry.saved or entry.trust == "paired"
        self.trust_icon, words, self.trust_role = TRUST[entry.trust]
        self.trust_text = tr(words)
        self._show_battery(entry)
        self._show_link(entry)
        self._show_driver(entry, me)

    def show_place(self, *, twin: bool) -> None:
        """Say by what it is told from a robot that has its name too; nothing where none has."""
        said = tr("Another robot has this name too. This one is at {address}.")
        self.note = said.format(address=self.entry.address) if twin else ""
        self.note_role = "warn" if twin else "muted"

    def show_thumb(self, thumb: Thumb | None) -> None:
        """Show the last picture of it; None for none."""
        at = thumb.at if thumb is not None else math.nan
        if thumb is None:
            self.snapshot = None
        elif at != self._seen_at:
            texture = Texture.create(size=(thumb.width, thumb.height), colorfmt="rgba")
            texture.blit_buffer(thumb.rgba, colorfmt="rgba", bufferfmt="ubyte")
            texture.flip_vertical()
            self.snapshot = texture
        self._seen_at = at

    _seen_at = math.nan

    def _show_battery(self, entry: Entry) -> None:
        known = not math.isnan(entry.battery) and not self.lost
        self.battery_text = f"{entry.battery * 100:.0f} %" if known else "—"
        level = "danger" if entry.battery < LOW else "warn" if entry.battery < MIDDLE else "ok"
        self.battery_role = level if known else "muted"

    def _show_link(self, entry: Entry) -> None:
        if entry.state == "lost":
            said = (
                tr("no heartbeat for {silent:.0f} s").format(silent=entry.silent)
                if entry.reached
                else tr("its robot is not reached")
            )
            self.link_text, self.link_role = said, "danger"
        elif not math.isnan(entry.latency):
            ms = entry.latency * 1000
            self.link_text, self.link_role = (f"{ms:.0f} ms" if ms >= 1 else "< 1 ms"), "ok"
        elif entry.state == "live":
            self.link_text, self.link_role = tr("in reach"), "ok"
        else:
            self.link_text, self.link_role = tr("not heard yet"), "muted"

    def _show_driver(self, entry: Entry, me: str) -> None:
        # a HELLO tells a name and not an identity: under this handheld's own name it may have control from before
        mine, other = entry.driver == me and bool(me), bool(entry.driver)
        if entry.state != "live":
            self.driver_text, self.driver_role = ("lost" if self.lost else ""), "danger"
        elif other:
            narrow = self.width < NARROW * Metrics.density
            name = _shortened(entry.driver, 10 if narrow else 18)
            self.driver_text, self.driver_role = (
                name if narrow else tr("driven by {name}").format(name=name),
                "warn",
            )
        else:
            self.driver_text, self.driver_role = tr("free"), "ok"
        self.driver_icon = "person" if other and self.driver_text == _shortened(entry.driver, 10) else ""
        self.quiet = self.lost
        self.watches = other and not mine and not self.lost
        self.action = tr("Retry") if self.lost else tr("Watch") if self.watches else tr("Connect")
        if entry.trust == "stranger" and not self.lost:
            self.watches, self.action = False, tr("Pair")

    def on_connect(self) -> None:
        """The big button was pressed."""

    def on_remove(self) -> None:
        """The saved address is to be forgotten."""

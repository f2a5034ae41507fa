"""Help for keys and gamepad, over everything else until it is closed."""

from __future__ import annotations

from typing import Any, Protocol

from kivy.lang import Builder

import widgets.inputs.key_help  # noqa: F401 - its rule draws what is used here
from app.inputs.binding_actions import MEANINGS, meaning_words
from app.inputs.bindings import Bindings
from app.inputs.gamepad.pad_map import AXES, WAYS, Profile, button_words
from app.inputs.inputs import Inputs
from app.inputs.keys.key_table import ARROWS, DRIVING, KeyTable, key_words
from app.inputs.methods import Methods
from app.inputs.switch_access.scan.settings import Options
from app.screens.parts.dialogs import Question
from widgets.core.language import figure, tr

__all__ = ["HelpCard", "help_groups", "toggle_help"]

Rows = list[tuple[list[str], str]]
OF_THE_APP = ("screen.", "theme", "help", "back", "record", "snapshot")
"""Beginnings of what concerns the app and not the robot."""

Builder.load_string("""
<HelpCard>:
    Card:
        id: card
        size_hint: None, None
        width: min(dp(1180), root.room[2] - dp(28))
        height: min(theme.target + help.whole + 2 * dp(12) + dp(8), root.room[3] - dp(20))
        x: max(root.room[0] + dp(10), min(root.center_x - self.width / 2, root.room[0] + root.room[2] - self.width - dp(10)))
        y: root.room[1] + (root.room[3] - self.height) / 2
        padding: dp(18), dp(12)
        spacing: dp(8)
        BoxLayout:
            size_hint_y: None
            height: theme.target
            Text:
                text: tr('Keys and gamepad')
                bold: True
                font_size: theme.size_title
                pos_hint: {'center_y': .5}
            IconButton:
                icon: 'close'
                bare: True
                pos_hint: {'center_y': .5}
                on_release: root.close()
        KeyHelp:
            id: help
            state: 'live'
""")


class HelpCard(Question):
    """Closed by its cross, by a finger beside it, by the key that opened it, and by Back."""

    def show(self, groups: list[tuple[str, Rows]]) -> None:
        """Show these."""
        self.ids.help.groups = groups


class Host(Protocol):
    """The app, as far as the help needs it."""

    inputs: Inputs
    methods: Methods
    root: Any


def toggle_help(app: Host) -> None:
    """Open it over the app's screen, or close it where it is open."""
    shown = [child for child in app.root.children if isinstance(child, HelpCard)]
    if shown:
        shown[0].close()
        return
    card = HelpCard()
    inputs = app.inputs
    switches = app.methods.made("switches")
    options = switches.options if switches is not None else None
    card.show(help_groups(inputs.mapped, [state.name for state in inputs.gamepads.states], options))
    app.root.add_widget(card)


def help_groups(mapped: Bindings, pads: list[str], switches: Options | None = None) -> list[tuple[str, Rows]]:
    """Title and rows of each group: caps, and what they do; `pads` are the names of the gamepads that are plugged in.

    `switches` are the options of the switches; None where there are none.
    """
    table = mapped.keys
    groups = [("STOP", [([key_words(key) for key in table.keys_of("stop")], "STOP")])]
    if switches is not None and switches.on:
        groups.append((tr("Switches"), _switches(switches)))
    if table.on:
        groups += [
            (tr("Driving"), _driving(table)),
            (tr("Robot"), _rows(table, app=False)),
            (tr("App"), _rows(table, app=True)),
        ]
    groups += [(name, _pad(mapped.profile(name), mapped.pads_on)) for name in dict.fromkeys(pads)]
    return [(title, rows) for title, rows in groups if rows]


def _switches(options: Options) -> Rows:
    following = [key.words for key in options.a[:1]] if not options.one else []
    doing, timing = [key.words for key in options.b[:1]], options.timing
    rows = [
        (following, tr("Next on the screen")),
        (doing, tr("Do it, when let go")),
        (following, tr("Back, held {hold_back} s").format(hold_back=figure(timing.hold_back, 1))),
        (doing, tr("STOP, held {seconds} s").format(seconds=figure(timing.hold_stop, 1))),
        (following + doing if following and doing else [], tr("STOP, both together")),
    ]
    return [(caps, words) for caps, words in rows if caps]


def _driving(table: KeyTable) -> Rows:
    if not table.drives:
        return []
    return [
        ([name.upper() for name in DRIVING.values()], tr("Drive while held")),
        ([key_words(name) for name in ARROWS.values()], tr("The right control, or the only one")),
        ([key_words("shift")], tr("Slower, held with them")),
    ]


def _rows(table: KeyTable, *, app: bool) -> Rows:
    wanted = [name for name in MEANINGS if name != "stop" and name.startswith(OF_THE_APP) == app]
    named = [(table.keys_of(name), meaning_words(name)) for name in wanted]
    return [([key_words(key) for key in keys], words) for keys, words in named if keys]


def _pad(profile: Profile, on: bool) -> Rows:
    rows: Rows = [([_short(button)], "STOP") for button in profile.stops]
    if not on:
        return rows
    for way, words in WAYS.items():
        source = profile.axes.get(way, "none")
        if source != "none":
            rows.append(([tr(AXES[source]).partition(",")[0]], _way(words, turned=way in profile.inverted)))
    for button in profile.buttons:
        meaning = profile.meaning(button)
        if meaning and meaning != "stop":
            rows.append(([_short(button)], meaning_words(meaning)))
    return rows


def _way(words: str, *, turned: bool) -> str:
    side, _, how = words.partition(", ")
    return f"{side}: {how}{tr(', turned round') if turned else ''}"


def _short(button: str) -> str:
    """What is printed on it."""
    words = button_words(button)
    return (
        words.partition(",")[0]
        if len(button) == 1
        else words.replace(", pressed", " press").replace("Cross, ", "Cross ")
    )

"""How a profile is handed on and taken in: a QR code, a link, a file; what comes from outside is shown before it is used."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from kivy.core.clipboard import Clipboard
from kivy.lang import Builder
from kivy.properties import BooleanProperty, ListProperty, StringProperty

from app.device.file_picking import FilePicking, file_picking
from app.device.sharing import sharing
from app.layout.layout import Layout, LayoutError
from app.layout.layout_text import text_of
from app.layout.views import View
from app.profiles.profile_choice import ProfileChoice
from app.profiles.profile_code import code_of
from app.profiles.profile_link import BadProfileLink, fits_code, is_profile_link, link_of, text_of_link
from app.profiles.profile_store import write_whole
from app.screens.panels.sharing.fault_dialog import FaultRows
from app.screens.panels.sharing.summary import summary
from app.screens.parts.dialogs import Question
from bridge.msgs.pilothouse_msgs import RobotInfo
from widgets.core.language import tr, trn

__all__ = ["ShareDialog"]

Builder.load_string("""
#:import tr widgets.core.language.tr
<ShareDialog>:
    RoomCard:
        id: card
        room: root.room
        wide: dp(620)
        high: dp(640)
        Text:
            text: tr('Share this profile')
            bold: True
            font_size: theme.size_title
        ScrollView:
            id: scroll
            do_scroll_x: False
            bar_width: dp(3)
            bar_color: theme.muted
            Column:
                spacing: dp(10)
                padding: 0, 0, dp(8), 0
                FloatLayout:
                    size_hint_y: None
                    height: min(dp(330), card.width - dp(80)) if root.rows else 0
                    QrCode:
                        rows: root.rows
                        pos_hint: {'center_x': .5, 'y': 0}
                        size_hint: None, 1
                        width: self.height
                Text:
                    text: root.told
                    role: 'muted'
                    font_size: sp(14)
                GridLayout:
                    cols: 2
                    size_hint_y: None
                    height: theme.target
                    spacing: dp(10)
                    QuietButton:
                        id: file
                        text: tr('Save as file')
                        icon: 'save'
                        on_release: root.save()
                    QuietButton:
                        id: copy
                        text: tr('Copy link')
                        icon: 'content_copy'
                        on_release: root.copy()
                SectionLabel:
                    title: tr('Take one in')
                TextField:
                    id: field
                    hint_text: tr('Link, or path of a .toml file')
                    wrong: root.wrong
                    on_text_validate: root.read(self.text)
                GridLayout:
                    cols: 2
                    size_hint_y: None
                    height: theme.target
                    spacing: dp(10)
                    QuietButton:
                        id: browse
                        text: tr('Choose a file')
                        icon: 'folder_open'
                        on_release: root.browse()
                    QuietButton:
                        id: read
                        text: tr('Look at it first')
                        icon: 'search'
                        on_release: root.read(field.text)
                Text:
                    text: root.found
                    role: 'danger' if root.wrong else 'text'
                    font_size: sp(15)
                    height: self.texture_size[1] if self.text else 0
                Column:
                    id: faults
        BoxLayout:
            size_hint_y: None
            height: theme.target
            spacing: dp(12)
            QuietButton:
                id: cancel
                text: tr('Close')
                on_release: root.close()
            PrimaryButton:
                id: use
                text: tr('Use it for this robot')
                disabled: not root.usable
                on_release: root.use()
""")


class ShareDialog(Question):
    """Calls `on_import` once another profile was taken in."""

    rows = ListProperty()
    """Of the QR code; empty where the profile does not fit into one."""
    told = StringProperty("")
    found = StringProperty("")
    """What was read, or why nothing was."""
    wrong = BooleanProperty(False)
    usable = BooleanProperty(False)
    wanted = (640.0, 620.0)

    def __init__(
        self,
        profiles: ProfileChoice,
        info: RobotInfo,
        views: tuple[View, ...] | None,
        on_import: Callable[[], object],
        **kwargs: Any,
    ) -> None:
        """`views` are those under change; None for those that are kept."""
        super().__init__(**kwargs)
        self._profiles, self._info, self._on_import = profiles, info, on_import
        layout = profiles.of(info)
        self._layout = layout if views is None else replace(layout, views=views)
        self._read: Layout | None = None
        self._picking: FilePicking | None = None
        self._incoming = profiles.store.folder / "incoming"
        self.text = text_of(self._layout)
        """The profile's file."""
        self.link = link_of(self.text)
        self._show_code()

    def _show_code(self) -> None:
        if fits_code(self.link):
            self.rows = code_of(self.link)
            self.told = tr("Another camera reads it as a link. Paste that there under “Take one in”.")
            return
        told = tr(
            "This profile is too long for one QR code ({letters} letters, {most} fit). Use the file or the link."
        )
        from app.profiles.profile_link import MAX_CODE

        self.told = told.format(letters=len(self.link), most=MAX_CODE)

    def copy(self) -> None:
        """Put the link where it can be pasted from."""
        Clipboard.copy(self.link)
        self.told = tr("The link is copied.")

    def save(self) -> None:
        """Write the file where a file manager finds it, or hand it to Android's share sheet."""
        folder = self._profiles.store.folder / "exported"
        path = folder / f"{self._layout.name}.toml"
        try:
            write_whole(path, self.text)
            way = sharing()
            if way is not None:
                way.share(path)
            where = str(path) if way is None else way.where
        except OSError as error:
            self.told = tr("The file could not be written: {reason}.").format(reason=error.strerror or error)
        else:
            self.told = tr("Saved: {path}").format(path=where)

    def browse(self) -> None:
        """Let the operator choose a file by what the system has for it."""
        if self._picking is None:
            self._picking = file_picking()
        if self._picking is not None:
            self._picking.pick(self._incoming, self._picked)

    def _picked(self, paths: list[Path], problem: str) -> None:
        """What was chosen; copies of it that the system made for this are not kept."""
        if self.parent is not None and problem:
            self.found, self.wrong = problem, True
        elif self.parent is not None and paths:
            self.ids.field.text = str(paths[0])
            self.read(str(paths[0]))
        for path in paths:
            if path.parent == self._incoming:
                path.unlink(missing_ok=True)

    def read(self, text: str) -> None:
        """Look at what a link or a file brings; nothing is used yet."""
        self._read, self.usable, self.wrong = None, False, False
        self.ids.faults.clear_widgets()
        try:
            content = text_of_link(text) if is_profile_link(text) else self._file(text)
            self._read = self._profiles.store.read("imported", content)
        except BadProfileLink as error:
            self.found, self.wrong = str(error), True
        except LayoutError as error:
            count = len(error.faults)
            told = trn("It has a fault and is not used:", "It has {count} faults and is not used:", count)
            self.found, self.wrong = told.format(count=count), True
            self.ids.faults.add_widget(FaultRows(error.faults))
        else:
            self.found, self.usable = summary(self._read), True

    def _file(self, text: str) -> str:
        if not text.strip():
            raise BadProfileLink(tr("Paste a link, or enter the path of a file."))
        return self._profiles.store.text(Path(text.strip()).expanduser())

    def use(self) -> None:
        """Take what was read as this robot's profile, under a name of its own: nothing that was there is lost."""
        if self._read is None:
            return
        try:
            self._profiles.adopt(self._info, self._read)
        except OSError as error:
            self.found, self.wrong = str(error), True
            return
        self._on_import()
        self.close()

    def on_close(self) -> None:
        """The keyboard leaves the glass with it."""
        self.ids.field.focus = False

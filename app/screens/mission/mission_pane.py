"""A mission that the robot keeps, to be recalled; or the points on the map, to be kept under a name."""

from __future__ import annotations

from typing import Any

from kivy.lang import Builder
from kivy.properties import ObjectProperty
from kivy.uix.boxlayout import BoxLayout
from kivy.uix.widget import Widget

from app.missions.stored_missions import MAX_NAME_LENGTH
from app.screens.parts.pane_head import PaneHead
from app.session.session import Session
from bridge.msgs.pilothouse_msgs import KeptMission
from widgets.core.language import mark, tr, trn
from widgets.parts.kit import TextField
from widgets.tasks.mission_list import mission_words

__all__ = ["MissionPane"]

REPLACES = mark("It replaces the robot's mission and the points on the map. You can undo that.")

Builder.load_string("""
<MissionPane>:
    orientation: 'vertical'
    spacing: dp(8)
""")


class MissionPane(BoxLayout):
    """Dispatches `on_close`."""

    __events__ = ("on_close",)

    chosen: ObjectProperty[KeptMission | None] = ObjectProperty(None, allownone=True)
    """The kept mission that is looked at; None to save one."""

    def __init__(self, session: Session, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session = session
        self.head = PaneHead()
        self.field = TextField(hint_text=tr("Name, as in Night patrol"), label=tr("Name"))
        self.add_widget(self.head)
        self.add_widget(self.field)
        self.add_widget(Widget())
        self.head.bind(on_close=lambda _: self.dispatch("on_close"))
        self.field.bind(text=self._typed)
        self.bind(chosen=lambda *_: self.refresh())

    @property
    def lacking(self) -> str:
        """What is missing before it can be saved, as a sentence; empty when nothing."""
        return self._session.missions.lacking(self.field.text)

    def _typed(self, *_: object) -> None:
        if len(self.field.text) > MAX_NAME_LENGTH:  # the robot would cut it off
            self.field.text = self.field.text[:MAX_NAME_LENGTH]
        self.refresh()

    def begin(self) -> None:
        """Save what is on the map; the name of the mission that it was is there already."""
        self.chosen = None
        self.field.text = self._session.mission.draft.name
        self.refresh()

    def refresh(self) -> None:
        """Say what will happen."""
        saves = self.chosen is None
        self.field.opacity, self.field.disabled = float(saves), not saves
        if self.chosen is not None:
            self.head.title = self.chosen.name
            self.head.sentence = f"{mission_words(self.chosen)}\n{tr(REPLACES)}"
            return
        self.head.title = tr("Save the mission")
        self.head.sentence = self.lacking or self._promise()

    def _promise(self) -> str:
        count, name = len(self._session.mission.draft.points), self.field.text.strip()
        if any(kept.name == name for kept in self._session.missions.kept):
            words = trn(
                "The point on the map becomes the newest revision of {name}, and the robot patrols it from now on.",
                "The {count} points on the map become the newest revision of {name}, and the robot patrols them from now on.",
                count,
            )
        else:
            words = trn(
                "The point on the map is kept as {name}, and the robot patrols it from now on.",
                "The {count} points on the map are kept as {name}, and the robot patrols them from now on.",
                count,
            )
        return words.format(name=name)

    def recall(self) -> None:
        """Make the chosen one the robot's mission."""
        if self.chosen is not None:
            self._session.missions.recall(self.chosen.name)

    def save(self) -> None:
        """Keep what is on the map."""
        self._session.missions.save(self.field.text)

    def rest(self) -> None:
        """The keyboard goes."""
        self.field.focus = False

    def on_close(self) -> None:
        """A finger asked to go back to the lists."""

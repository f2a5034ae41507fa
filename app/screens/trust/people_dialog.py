"""The people whom a robot knows: who they are, what they may do, when they were last there; and letting others in."""

from __future__ import annotations

import math
from typing import Any

from kivy.clock import Clock
from kivy.lang import Builder
from kivy.properties import BooleanProperty, ListProperty, NumericProperty, StringProperty

import widgets.parts.kit  # noqa: F401 - its rules draw what is used here
from app.link.channels import ANSWER, EVENT, Answer
from app.link.feeds import Post
from app.screens.parts.dialogs import Question
from app.session.session import Session
from bridge.core.codes import Code
from bridge.core.identity import Role
from bridge.msgs import Msg
from bridge.msgs.pilothouse_msgs import (
    GetPeopleRequest,
    GetPeopleResponse,
    InviteGuestRequest,
    InviteGuestResponse,
    InvitePersonRequest,
    InvitePersonResponse,
    Person,
    RemovePersonRequest,
    RemovePersonResponse,
)
from widgets.core.language import mark, tr
from widgets.parts.buttons import IconButton
from widgets.parts.qr_code import QrCode  # noqa: F401 - its rule draws what is used here
from widgets.parts.rows import ListRow

__all__ = ["PeopleDialog", "seen_text"]

ICONS = {"handheld": "touch_app", "token": "vpn_key", "guest": "person"}
ROLES = {"watch": mark("watches"), "drive": mark("drives"), "manage": mark("manages")}
GUEST_TIME = 3600.0
"""How long a guest is let in [s]."""
REMOVE = mark("Tap again to remove. It cannot come in any more.")
REMOVE_OWN = mark("Tap again to remove this handheld itself: it cannot come in any more.")
REMOVE_LAST = mark(
    "Tap again to remove the last one who manages. Then only `robotside pair` at the robot lets others in."
)
NOT_PROTECTED = mark(
    "This link is not protected: anybody in this network can read and change it. Pair by the robot's link."
)
BY_CODE = mark(
    "Scan it with the other handheld's camera, or type the code there. For one, which may drive; for ten minutes."
)
GUEST_BY_CODE = mark(
    "Scan it with the guest's camera, or type the code there. For one, which may drive; for one hour."
)
NOT_SHOWN = mark("Who manages this robot sees here who has a key, and lets others in.")
CHANGES = frozenset((Code.PERSON_PAIRED, Code.PERSON_REMOVED))
"""Codes of the events after which the list is another."""
CONFIRM_TIMEOUT = 4.0
"""A person is removed by a second tap within this [s]."""
CODE_TIME = 600.0
"""A code is for so long, where the robot's clock is not known [s]."""
SERVICES = ("/people/list", "/people/invite", "/people/guest", "/people/remove")

Builder.load_string("""
<PeopleDialog>:
    short: root.room[3] < dp(520)
    qr_side: max(dp(120), min(dp(330), root.room[2] - dp(60), root.room[3] - head.height - foot.height - (dp(84) if root.short else dp(190))))
    Card:
        id: card
        size_hint: None, None
        width: min(dp(620), root.room[2] - dp(20))
        height: min(root.room[3] - dp(24), head.height + (0 if root.code else rows.height) + foot.height + invitation.height + 3 * self.spacing + self.padding[1] + self.padding[3])
        pos: root.room[0] + (root.room[2] - self.width) / 2, root.room[1] + (root.room[3] - self.height) / 2
        padding: dp(14)
        spacing: dp(10)
        Column:
            id: head
            spacing: dp(2)
            Text:
                text: root.title
                bold: True
                font_size: theme.size_title
                shorten: True
                shorten_from: 'right'
            Remark:
                text: root.problem
                role: 'danger'
            Remark:
                text: root.sentence
                role: 'muted'
            Remark:
                text: root.warning
                role: 'warn'
        BoxLayout:
            id: invitation
            orientation: 'horizontal' if root.short else 'vertical'
            size_hint_y: None
            height: self.minimum_height if root.code else 0
            opacity: 1 if root.code else 0
            spacing: dp(10) if root.code else 0
            QrCode:
                id: qr
                size_hint: None, None
                rows: root.qr_rows
                size: (root.qr_side, root.qr_side) if root.code and root.qr_rows else (0, 0)
                pos_hint: {'center_x': .5, 'center_y': .5}
            Column:
                spacing: dp(2)
                pos_hint: {'center_x': .5, 'center_y': .5}
                Text:
                    text: root.code
                    bold: True
                    halign: 'center'
                    font_size: sp(38) if root.code else sp(1)
                Remark:
                    text: root.code_sentence if root.code else ''
                    halign: 'center'
        Roll:
            id: roll
            Column:
                id: rows
                spacing: dp(6)
        BoxLayout:
            id: foot
            size_hint_y: None
            height: theme.target
            spacing: dp(8)
            QuietButton:
                id: close
                text: tr('Done') if root.code else tr('Close')
                size_hint_x: .7
                on_release: root.leave()
            QuietButton:
                id: guest
                text: tr('Guest, 1 h')
                disabled: not root.manages
                on_release: root.invite_guest()
            PrimaryButton:
                id: invite
                text: tr('Let in')
                disabled: not root.manages
                on_release: root.invite()
""")


def seen_text(person: Person, now: float) -> str:
    """When a person was last there, in a few words; `now` is the operators' clock [s], NaN where it is not known."""
    if person.connected:
        return tr("here now")
    since = now - person.last_seen
    if math.isnan(person.last_seen):
        return tr("never here")
    if math.isnan(since):
        return ""
    for length, word in ((86400.0, "d"), (3600.0, "h"), (60.0, "min")):
        if since >= length:
            return f"{since / length:.0f} {word} ago"
    return tr("just now")


class PersonRow(ListRow):
    """One person, and a button that asks whether to remove it."""

    def __init__(self, person: Person, seen: str, *, mine: bool, manages: bool, on_remove: Any) -> None:
        super().__init__(whole=True)
        self.person = person
        self.question = tr(REMOVE_OWN) if mine else tr(REMOVE)
        self.icon = ICONS.get(person.kind, "person")
        title = person.name or tr("Somebody")
        self.title = tr("{name} · this handheld").format(name=title) if mine else title
        self.chosen = mine
        self._detail = ", ".join(part for part in (tr(ROLES.get(person.role, person.role)), seen) if part)
        self.detail = self._detail
        self._remove = IconButton(icon="delete", role="muted", bare=True, disabled=not manages)
        self._remove.bind(on_release=lambda _: on_remove(self))
        self.add_widget(self._remove)

    def arm(self, *, armed: bool) -> None:
        """Ask whether to remove it, or ask no longer."""
        self.detail = self.question if armed else self._detail
        self._remove.role = "danger" if armed else "muted"

    def goes(self) -> None:
        """The robot was asked to remove it."""
        self.detail, self._remove.disabled = tr("Removing …"), True


class PeopleDialog(Question):
    """Asks the robot who is there, and what the buttons say."""

    wanted = (640.0, 420.0)
    title = StringProperty("")
    sentence = StringProperty("")
    problem = StringProperty("")
    warning = StringProperty("")
    """What is to be known of the link; empty for a protected one."""
    code = StringProperty("")
    """By which somebody may pair now; empty for none."""
    code_sentence = StringProperty("")
    qr_rows = ListProperty()
    """Of the link by which the same may pair, as in `widgets.parts.qr_code`."""
    qr_side = NumericProperty(0)
    """[px]"""
    short = BooleanProperty(False)
    """There is no room for the code below its picture."""
    manages = BooleanProperty(False)
    """The robot lets this handheld see and change who is known."""

    def __init__(self, session: Session, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._session, self._roll = session, self.ids.roll.__self__
        self._armed: PersonRow | None = None
        self._armed_until = -math.inf
        self._disarming = Clock.create_trigger(lambda _: self._disarm(), CONFIRM_TIMEOUT)
        self._code_ends = Clock.create_trigger(lambda _: self._end_code())
        self.title = tr("People of {name}").format(name=session.robot.name)
        self.warning = "" if session.protected else tr(NOT_PROTECTED)
        session.listeners.append(self._hear)
        self._list()

    def _ask(self, service: str, request: Msg, response: type[Msg]) -> None:
        self._session.link.ask(service, request, response)

    def invite(self) -> None:
        """Let one more handheld pair."""
        self._ask("/people/invite", InvitePersonRequest(role="drive"), InvitePersonResponse)

    def invite_guest(self) -> None:
        """Let somebody in for an hour."""
        self._ask("/people/guest", InviteGuestRequest(role="drive", duration=GUEST_TIME), InviteGuestResponse)

    def remove(self, row: PersonRow) -> None:
        """Remove a person at the second tap."""
        if row is self._armed and self._session.now() < self._armed_until:
            self._armed = None
            row.goes()
            self._ask("/people/remove", RemovePersonRequest(id=row.person.id), RemovePersonResponse)
            return
        self._disarm()
        self._armed, self._armed_until = row, self._session.now() + CONFIRM_TIMEOUT
        row.arm(armed=True)
        self._disarming.cancel()
        self._disarming()

    def _disarm(self) -> None:
        if self._armed is not None:
            self._armed.arm(armed=False)
        self._armed = None

    def _hear(self, channel: str, post: Post) -> None:
        answer = post.value
        if channel == EVENT and answer.code in CHANGES and self.manages:
            if answer.code == Code.PERSON_PAIRED:
                self._end_code()
            self._list()
        if channel != ANSWER or not isinstance(answer, Answer) or answer.service not in SERVICES:
            return
        found = answer.message
        if answer.problem or answer.service != "/people/list":
            self.problem = answer.problem
        if isinstance(found, GetPeopleResponse):
            self._show(found.people)
        elif isinstance(found, InvitePersonResponse):
            self._show_code(found, tr(BY_CODE), found.open_until)
        elif isinstance(found, InviteGuestResponse):
            self._show_code(found, tr(GUEST_BY_CODE), found.ends)
        elif answer.service == "/people/remove":
            self._list()
        elif answer.service == "/people/list":
            self.manages, self.sentence = False, tr(NOT_SHOWN)

    def _show(self, people: list[Person]) -> None:
        self.manages, self._armed = True, None
        count = len(people)
        self.sentence = (
            tr("Nobody has a key of this robot.")
            if not count
            else tr("{count} with a key of this robot").format(count=count)
        )
        self.ids.rows.clear_widgets()
        managing = [person for person in people if person.role == Role.MANAGE.word]
        now = self._session.link.robot_time()
        for person in people:
            mine = person.id == self._session.own_id
            row = PersonRow(person, seen_text(person, now), mine=mine, manages=True, on_remove=self.remove)
            if managing == [person]:
                row.question = tr(REMOVE_LAST)
            self.ids.rows.add_widget(row)

    def _list(self) -> None:
        self._ask("/people/list", GetPeopleRequest(), GetPeopleResponse)

    def _end_code(self) -> None:
        """The code was used or has run out."""
        self._code_ends.cancel()
        self.code, self.qr_rows = "", []

    def _show_code(
        self, offer: InvitePersonResponse | InviteGuestResponse, sentence: str, ends: float
    ) -> None:
        """Show a code until `ends` [s, robot clock]."""
        left = ends - self._session.link.robot_time()
        self._code_ends.cancel()
        self._code_ends = Clock.create_trigger(
            lambda _: self._end_code(), min(max(left, 1.0), GUEST_TIME) if math.isfinite(left) else CODE_TIME
        )
        self._code_ends()
        digits = "".join(letter for letter in offer.code if letter.isdigit())[:8]
        self.code = " ".join(digits[start : start + 3] for start in range(0, len(digits), 3))
        self.code_sentence, self.qr_rows = sentence, offer.qr_rows

    def on_code(self, *_: object) -> None:
        """The list gives way to a code."""
        if self.code and self._roll.parent is not None:
            self.ids.card.remove_widget(self._roll)
        elif not self.code and self._roll.parent is None:
            self.ids.card.add_widget(self._roll, index=1)

    def leave(self) -> None:
        """Back to the list, or off the glass."""
        if self.code:
            self._end_code()
        else:
            self.close()

    def on_close(self) -> None:
        """It hears the session no more, and no clock runs for it."""
        self._disarming.cancel()
        self._code_ends.cancel()
        if self._hear in self._session.listeners:
            self._session.listeners.remove(self._hear)

"""The app's own simulator: what is chosen, what runs, and what is told of it on the connect screen."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any, Protocol

from app.core.settings_store import Settings
from app.discovery import simulator_process as simulator
from app.discovery.simulator_options import SimulationChoice, SimulatorOptions
from app.link.feeds import Mailbox, Post
from app.screens.connect.connect import ConnectScreen
from widgets.core.language import mark, tr

if TYPE_CHECKING:
    # when it is asked for, for a quick start
    from app.screens.connect.simulator_dialog import SimulatorDialog
    from app.session.session import Session

__all__ = ["CHANNEL", "SimulatorLauncher"]

CHANNEL = "simulator"
"""Of the mailbox, on which its threads tell."""
IDLE, STARTING, RUNNING = (
    mark("Start the built-in simulator"),
    mark("Starting the simulator …"),
    mark("Start another simulation"),
)


class Trust(Protocol):
    """The paired robots, as far as the simulator needs them."""

    def pair_silently(self, links: Iterable[str], then: str = "") -> None:
        """Pair by links without a question; then connect to `then`."""


class RobotList(Protocol):
    """The list of robots, as far as the simulator needs it."""

    @property
    def trust(self) -> Trust:
        """The paired robots."""


class Host(Protocol):
    """The app, as far as its simulator needs it."""

    settings: Settings
    connect: ConnectScreen
    mailbox: Mailbox
    root: Any

    @property
    def robot_list(self) -> RobotList:
        """Every robot that can be connected to."""

    @property
    def session(self) -> Session | None:
        """The session with the robot; None while none is wanted."""


class SimulatorLauncher:
    """Starts the simulator and ends it with the app. `app` has what it needs: mailbox, settings, the connect screen."""

    def __init__(
        self,
        app: Host,
        command: Sequence[str] | None,
        say: Callable[[str, str], None],
        now: Callable[[], float],
    ) -> None:
        """`command` starts another simulator, about which nothing is asked; None for the one that is built in."""
        self._app, self._command, self._say, self._now = app, command, say, now
        self.current: simulator.Simulator | None = None
        """The one that starts or runs."""
        self.dialog: SimulatorDialog | None = None
        """The question that is on the glass."""
        self._inquiry: simulator.Inquiry | None = None
        self._offered: SimulatorOptions | None = None
        self._count = 1
        self._started = 0

    @property
    def possible(self) -> bool:
        """There is a simulator on this machine."""
        return bool(self._command) or simulator.available()

    def ask(self) -> None:
        """Ask which robots are to be simulated, and where."""
        if self._command:
            self.start()
            return
        remembered = SimulationChoice.remembered(self._app.settings.get("simulated"))
        from app.screens.connect.simulator_dialog import SimulatorDialog

        self.dialog = SimulatorDialog(remembered, self._chosen, running=self._runs)
        self.dialog.bind(on_close=lambda *_: setattr(self, "dialog", None))
        self._app.root.add_widget(self.dialog)
        if self._offered is not None:
            self.dialog.show_offered(self._offered)
        elif self._inquiry is None:
            tell = self._app.mailbox.queue
            self._inquiry = simulator.Inquiry(
                simulator.inquiry(),
                lambda text: tell(CHANNEL, ("offered", text), self._now()),
                lambda sentence: tell(CHANNEL, ("not offered", sentence), self._now()),
            )
            self._inquiry.start()

    def _pair(self, links: Sequence[str], then: str) -> None:
        """Pair with its robots, and connect to `then`; empty for none."""
        self._app.robot_list.trust.pair_silently(links, then)

    def start(self, choice: SimulationChoice | None = None) -> None:
        """Start the simulator with what was chosen, the usual robot when nothing was; one that runs is ended."""
        choice = choice or SimulationChoice()
        self._started += 1
        self._count = 1 if self._command else len(choice.robots)
        arguments = self._command or simulator.command(f"sim:{','.join(choice.robots)}", choice.world)
        self.current = simulator.Simulator(
            arguments,
            self._teller("ready"),
            self._teller("failed"),
            robots=self._count,
            after=self.current,
        )
        self._show(tr(STARTING), busy=True)
        self._app.connect.say("")
        self.current.start()

    def on_post(self, channel: str, post: Post) -> bool:
        """Take in what a thread told; False for any other channel."""
        if channel == CHANNEL:
            self.on_report(*post.value)
        return channel == CHANNEL

    def on_report(self, what: str, text: str) -> None:
        """Take in what a thread told."""
        if what == "offered":
            self._take(text)
        elif what == "not offered":
            self._inquiry = None
            if self.dialog is not None:
                self.dialog.problem = text
        elif what == "failed":
            self.current = None
            self._show(tr(IDLE), busy=False)
            self._say(text, "danger")
        elif self.current is not None and self.current.url == text:
            self._show(tr(RUNNING), busy=bool(self._command))
            self._pair(self.current.links, text if self._count == 1 and self._app.session is None else "")
            if self._count > 1:
                self._app.connect.say(
                    tr("{count} simulated robots are ready.").format(count=self._count), "ok"
                )

    def close(self) -> None:
        """End what runs."""
        for each in (self._inquiry, self.current):
            if each is not None:
                each.close()

    @property
    def _runs(self) -> bool:
        return self.current is not None

    def _chosen(self, choice: SimulationChoice) -> None:
        self._app.settings.set("simulated", choice.kept)
        self.start(choice)

    def _take(self, text: str) -> None:
        try:
            self._offered = SimulatorOptions.read(text)
        except ValueError:
            self.on_report("not offered", tr("What the simulator offers is not to be understood."))
            return
        self._inquiry = None
        if self.dialog is not None:
            self.dialog.show_offered(self._offered)

    def _show(self, text: str, *, busy: bool) -> None:
        self._app.connect.simulating, self._app.connect.simulator_text = busy, text

    def _teller(self, what: str) -> Callable[[str], None]:
        started = self._started

        def tell(text: str) -> None:
            if started == self._started:  # else it is of one that was ended in the meantime
                self._app.mailbox.queue(CHANNEL, (what, text), self._now())

        return tell
